//! Results in formats that other programs read. Every export is streamed: it takes the memory of
//! a block of rows or of one frame, however long the flight.
//!
//! | format | what | read by |
//! |---|---|---|
//! | `hdf5` | history, frames, case and summary, units and frames as attributes | h5py, xarray, MATLAB |
//! | `vtkhdf` | surfaces, wakes and vortex particles as time series | ParaView, VTK |
//! | `parquet` | the history as a table | pandas, polars, DuckDB |
//! | `gltf` | the moving animal | Blender, browsers |
//!
//! The formats are written here and not by libraries: what is needed of each is small, while their
//! libraries need minutes to build (Arrow) or a C compiler and CMake (HDF5).

mod block;
mod gltf;
pub mod hdf5;
pub mod parquet;
mod source;
mod tables;
mod vtkhdf;

use std::path::{Path, PathBuf};

use crate::ResultDir;
use crate::run::file::{Existing, NewFile, make_folder};
use crate::snapshots::frames::{self, Frame};
use wingbeat_case::IoError;

use source::Source;

/// A format to export to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// HDF5: everything.
    Hdf5,
    /// VTKHDF: surfaces and wakes.
    Vtkhdf,
    /// Parquet: the history.
    Parquet,
    /// glTF: the moving animal.
    Gltf,
}

impl Format {
    /// All formats by the names that the command line knows.
    pub const ALL: [(&'static str, Self); 4] = [
        ("hdf5", Self::Hdf5),
        ("vtkhdf", Self::Vtkhdf),
        ("parquet", Self::Parquet),
        ("gltf", Self::Gltf),
    ];

    /// Files it makes, by their names in the result directory; of a flight with vortex particles
    /// or without.
    pub fn files(self, particles: bool) -> &'static [&'static str] {
        match self {
            Self::Vtkhdf if particles => &["surfaces.vtkhdf", "wakes.vtkhdf", "particles.vtkhdf"],
            Self::Hdf5 => &["flight.h5"],
            Self::Vtkhdf => &["surfaces.vtkhdf", "wakes.vtkhdf"],
            Self::Parquet => &["history.parquet"],
            Self::Gltf => &["flight.glb"],
        }
    }
}

/// Exports a result into its own directory or another folder; returns the files.
///
/// # Errors
/// A result that cannot be read; a file that cannot be written, or exists already and is to be kept.
pub fn export(
    dir: &ResultDir,
    format: Format,
    into: &Path,
    existing: Existing,
) -> Result<Vec<PathBuf>, IoError> {
    let source = Source {
        case: dir.case()?,
        manifest: dir.manifest()?,
        dir,
    };
    source.columns()?;
    dir.check_folder(into)?;
    let is_new = !into.exists();
    make_folder(into)?;
    let made = write_files(&source, format, into, existing);
    if made.is_err() && is_new {
        std::fs::remove_dir(into).ok(); // it stays if there is something in it
    }
    made
}

/// The files of a format in a folder.
fn write_files(
    source: &Source<'_>,
    format: Format,
    into: &Path,
    existing: Existing,
) -> Result<Vec<PathBuf>, IoError> {
    let dir = source.dir;
    let particles = format == Format::Vtkhdf
        && (frames::steps(dir.path())?.first())
            .is_some_and(|k| Frame::particles_path(dir.path(), *k).is_file());
    let claim = |name: &&'static str| {
        let file = NewFile::claim_own(&into.join(name), existing)?;
        Ok((*name, file))
    };
    let files: Result<Vec<_>, IoError> = format.files(particles).iter().map(claim).collect();
    let mut made = vec![];
    for (name, file) in files? {
        file.make(|part| match format {
            Format::Hdf5 => tables::hdf5(source, part),
            Format::Parquet => tables::parquet(source, part),
            Format::Gltf => gltf::write(source, part),
            Format::Vtkhdf => vtkhdf::write(source, name, part),
        })?;
        made.push(file.path().to_owned());
    }
    Ok(made)
}
