//! The case file, and the files it refers to: they are read in, so that the case stands alone
//! afterwards.

use std::io::Read as _;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use wingbeat_model::motion::PeriodicSpline;
use wingbeat_model::{ModelError, import};

use super::raw::{AngleCase, Case, PartCase, TableCase};
use crate::error::{Fault, IoError};

/// Bytes of a file at most: a mesh of some million panels.
const MAX_BYTES: u64 = 200_000_000;

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

/// Devices and pipes, which may never end, are not read; nor is what would fill the memory.
fn check_file(path: &Path) -> std::io::Result<()> {
    let data = std::fs::metadata(path)?;
    if !data.is_file() {
        return Err(std::io::Error::other("it is not a file"));
    }
    check_size(data.len())
}

fn check_size(bytes: u64) -> std::io::Result<()> {
    if bytes > MAX_BYTES {
        let problem = format!("it is larger than {} MB", MAX_BYTES / 1_000_000);
        return Err(std::io::Error::other(problem));
    }
    Ok(())
}

/// Reads mesh and table files; paths are relative to `base`.
pub(crate) fn read_in(case: &mut Case, base: &Path) -> Result<(), Fault> {
    for (name, part) in &mut case.body.part {
        read_mesh(&format!("body.part.{name}"), part, base)?;
    }
    for (name, wing) in &mut case.wing {
        let Some(motion) = &mut wing.motion else {
            continue;
        };
        let path = format!("wing.{name}.motion");
        let angles = [
            ("phi", &mut motion.phi),
            ("theta", &mut motion.theta),
            ("psi", &mut motion.psi),
        ];
        for (key, angle) in angles {
            if let Some(AngleCase::Table(table)) = angle {
                read_table(&format!("{path}.{key}.table"), table, base)?;
            }
        }
    }
    Ok(())
}

fn twice(key: String, what: &str, allowed: &str) -> Fault {
    let problem = format!("{what} is given twice");
    Fault::new(key, problem, allowed, "remove one of them")
}

fn unreadable(key: String, file: &Path, e: &std::io::Error) -> Fault {
    Fault::new(
        key,
        format!("cannot read `{}`: {e}", file.display()),
        "a file; paths are relative to the case file",
        "check the name and the folder",
    )
}

/// The bytes of a file.
fn bytes_of(key: &str, file: &Path) -> Result<Vec<u8>, Fault> {
    let read = check_file(file).and_then(|()| std::fs::read(file));
    read.map_err(|e| unreadable(key.to_owned(), file, &e))
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

/// Degrees in the unit that the name of a column says, as `psi_rad` or `psi [deg]`; degrees where it says none.
fn degrees(column: &str) -> Result<f64, String> {
    let words = column.split(|c: char| !c.is_alphanumeric());
    let words: Vec<String> = words.map(str::to_lowercase).collect();
    let any = |names: &[&str]| words.iter().any(|w| names.contains(&w.as_str()));
    let radians = any(&["rad", "rads", "radian", "radians"]);
    match (radians, any(&["deg", "degs", "degree", "degrees"])) {
        (true, true) => Err(format!(
            "the name of the column `{column}` says both radians and degrees"
        )),
        (true, false) => Ok(1f64.to_degrees()),
        (false, _) => Ok(1.0),
    }
}

fn read_table(path: &str, table: &mut TableCase, base: &Path) -> Result<(), Fault> {
    let Some(name) = table.file.take() else {
        return Ok(());
    };
    let key = format!("{path}.file");
    if table.rows_deg.is_some() {
        return Err(twice(key, "the table", "file or rows_deg"));
    }
    let file = base.join(&name);
    let text = bytes_of(&key, &file)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_slice());
    let bad = |problem: String| {
        Fault::new(
            key.clone(),
            format!("`{}`: {problem}", file.display()),
            "a CSV file with one header line and finite numbers",
            "correct the file",
        )
    };
    let header = reader.headers().map_err(|e| bad(e.to_string()))?.clone();
    if !header.is_empty() && header.iter().all(|h| h.parse::<f64>().is_ok()) {
        let numbers = header.iter().collect::<Vec<_>>().join(",");
        return Err(Fault::new(
            key,
            format!(
                "`{}`: its first row, `{numbers}`, consists of numbers, and there is no header line above it",
                file.display()
            ),
            "a CSV file with one header line and finite numbers",
            "write the names of the columns above the numbers, for instance phase,angle_deg",
        ));
    }
    let column = |wanted: &Option<String>, default: usize| match wanted {
        None => Ok(default),
        Some(w) => header.iter().position(|h| h == w).ok_or_else(|| {
            bad(format!(
                "there is no column `{w}` among {}",
                header.iter().collect::<Vec<_>>().join(", ")
            ))
        }),
    };
    let columns = [
        column(&table.phase_column, 0)?,
        column(&table.angle_column, 1)?,
    ];
    let to_degrees = header
        .get(columns[1])
        .map_or(Ok(1.0), degrees)
        .map_err(bad)?;
    let (mut rows, mut lines) = (vec![], vec![]);
    for record in reader.records() {
        let record = record.map_err(|e| bad(e.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |k: usize| {
            let text = record.get(k).unwrap_or("");
            let value = text.parse::<f64>().ok().filter(|x| x.is_finite());
            value.ok_or_else(|| bad(format!("line {line}: `{text}` is not a finite number")))
        };
        rows.push([number(columns[0])?, to_degrees * number(columns[1])?]);
        lines.push(line);
    }
    if rows.is_empty() {
        return Err(bad("there are no rows below the header".to_owned()));
    }
    let pairs: Vec<(f64, f64)> = rows.iter().map(|&[x, q]| (x, q)).collect();
    if let Err(ModelError::Table { row, problem, .. }) = PeriodicSpline::new("", &pairs) {
        let line = row.checked_sub(1).and_then(|k| lines.get(k)).copied();
        return Err(bad(format!("line {}: {problem}", line.unwrap_or_default())));
    }
    table.rows_deg = Some(rows);
    (table.phase_column, table.angle_column) = (None, None);
    Ok(())
}
