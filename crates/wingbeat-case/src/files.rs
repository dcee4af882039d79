//! The case file, and the files it refers to: they are read in, so that the case stands alone
//! afterwards.

mod angles;
mod csv_file;
mod outline;
mod read;

pub use csv_file::csv_reader;

use std::io::Read as _;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use wingbeat_model::mesh::import;

use self::read::{MAX_BYTES, bytes_of, check_file, check_size, twice};
use super::raw::{AngleCase, Case, PartCase, PlanformCase};
use crate::error::{Fault, IoError};

/// The text of a case file.
///
/// # Errors
/// A file that cannot be read or is none.
pub(crate) fn text_of(path: &Path) -> Result<String, IoError> {
    let refused = |source, remedy| IoError::File {
        action: "read",
        path: path.to_owned(),
        source,
        remedy,
    };
    if path.is_dir() {
        return Err(refused(
            std::io::ErrorKind::IsADirectory.into(),
            "name the case file in it; a result directory holds its case as case.toml",
        ));
    }
    check_file(path).map_err(|e| refused(e, "name an ordinary file"))?;
    std::fs::read_to_string(path).map_err(IoError::read(path))
}

/// The case that stands for the standard input.
pub(crate) const STANDARD_INPUT: &str = "-";

/// What was read from the standard input: it can be read once, and who asks again gets the same.
static INPUT: Mutex<Option<String>> = Mutex::new(None);

/// The text on the standard input, to its end.
///
/// # Errors
/// A text that cannot be read, is not UTF-8 or too long.
pub(crate) fn text_of_input() -> Result<String, IoError> {
    let mut input = INPUT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(text) = &*input {
        return Ok(text.clone());
    }
    let refused = |source| IoError::File {
        action: "read",
        path: "standard input".into(),
        source,
        remedy: "give it a case file as text; a file whose name is `-` is `./-`",
    };
    let mut text = String::new();
    let mut source = std::io::stdin().lock().take(MAX_BYTES + 1);
    source.read_to_string(&mut text).map_err(refused)?;
    check_size(text.len() as u64).map_err(refused)?;
    if text.trim().is_empty() {
        return Err(refused(std::io::Error::other("it is empty")));
    }
    *input = Some(text.clone());
    Ok(text)
}

/// Rows of a table of angles that hold no angle, and are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableGaps {
    /// The key of the table.
    pub key: String,
    /// Rows of its file without an angle \[1\].
    pub left_out: usize,
    /// Rows of its file with one \[1\].
    pub kept: usize,
}

/// Reads files of meshes, outlines and tables; paths are relative to `base`. What the tables lack comes back.
pub(crate) fn read_in(case: &mut Case, base: &Path) -> Result<Vec<TableGaps>, Fault> {
    let mut gaps = vec![];
    for (name, part) in &mut case.body.part {
        read_mesh(&format!("body.part.{name}"), part, base)?;
    }
    for (name, wing) in &mut case.wing {
        if let Some(PlanformCase::Outline(outline)) = &mut wing.planform {
            outline::read(&format!("wing.{name}.planform.outline"), outline, base)?;
        }
        let Some(motion) = &mut wing.motion else {
            continue;
        };
        let path = format!("wing.{name}.motion");
        for (key, angle) in motion.angles_mut() {
            if let AngleCase::Table(table) = angle {
                let key = format!("{path}.{key}.table");
                let left_out = angles::read(&key, table, base)?;
                let kept = table.rows_deg.as_ref().map_or(0, Vec::len);
                gaps.push(TableGaps {
                    key,
                    left_out,
                    kept,
                });
            }
        }
    }
    gaps.retain(|table| table.left_out > 0);
    Ok(gaps)
}

fn read_mesh(path: &str, part: &mut PartCase, base: &Path) -> Result<(), Fault> {
    let Some(name) = part.file.take() else {
        return Ok(());
    };
    let key = format!("{path}.file");
    if part.nodes_m.is_some() || part.quads.is_some() {
        return Err(twice(key, "the mesh", "file, or nodes_m with quads"));
    }
    let file = base.join(&name);
    let bytes = bytes_of(&key, &file)?;
    let unit = part.file_unit_m.take().unwrap_or(1.0);
    let extension = file
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or("")
        .to_lowercase();
    let found = match extension.as_str() {
        "obj" => import::obj(&name, &mut bytes.as_slice(), unit),
        "stl" => import::stl(&name, &bytes, unit),
        _ => {
            return Err(Fault::new(
                key,
                "the format of this mesh is unknown",
                "files ending in .obj or .stl",
                "export the mesh as Wavefront OBJ",
            ));
        }
    };
    let mesh = found.map_err(|e| {
        Fault::new(
            key,
            e.to_string(),
            "one closed surface",
            "repair the mesh and export it again",
        )
    })?;
    part.nodes_m = Some(mesh.mesh.nodes.iter().map(|x| x.to_array()).collect());
    part.quads = Some(mesh.mesh.quads);
    Ok(())
}
