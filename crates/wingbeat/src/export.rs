//! `wingbeat export`: a run in a format of other programs.

use std::path::PathBuf;

use clap::Args;
use wingbeat::case::IoError;
use wingbeat::results::ResultDir;
use wingbeat::results::export::{self, Format};

/// What `wingbeat export` is told.
#[derive(Args)]
pub(crate) struct ExportArgs {
    /// Result directory of the run.
    dir: PathBuf,
    /// Format: hdf5, vtkhdf, parquet or gltf.
    #[arg(long, value_parser = format)]
    format: Format,
    /// Folder for the files; default the result directory.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

fn format(name: &str) -> Result<Format, String> {
    let known = Format::ALL.iter().find(|f| f.0 == name);
    known.map(|f| f.1).ok_or_else(|| {
        let names: Vec<&str> = Format::ALL.iter().map(|f| f.0).collect();
        format!("choose one of {}", names.join(", "))
    })
}

/// The whole command.
pub(crate) fn export(args: &ExportArgs) -> Result<(), IoError> {
    let dir = ResultDir::read(&args.dir)?;
    let into = args.out.as_ref().unwrap_or(&args.dir);
    for file in export::export(&dir, args.format, into)? {
        println!("wrote {}", file.display());
    }
    Ok(())
}
