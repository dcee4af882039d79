//! The case file, and the files it refers to: they are read in, so that the case stands alone
//! afterwards.

use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use csv::StringRecord;
use wingbeat_model::motion::{Fourier, PeriodicSpline};
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
    let columns = [&table.phase_column, &table.angle_column];
    let columns = columns.map(|c| c.as_deref());
    let rows = TableFile {
        file: base.join(&name),
        key,
    }
    .rows(columns, table.harmonics)?;
    table.rows_deg = Some(rows);
    (table.phase_column, table.angle_column) = (None, None);
    Ok(())
}

/// The angles of a wing.
const ANGLES: [&str; 3] = ["phi", "theta", "psi"];

/// A table of phases and angles, and the key that names it.
struct TableFile {
    key: String,
    file: PathBuf,
}

impl TableFile {
    /// Phase \[1\] and angle \[deg\] of each row, from these columns, or the first two.
    fn rows(
        &self,
        names: [Option<&str>; 2],
        harmonics: Option<usize>,
    ) -> Result<Vec<[f64; 2]>, Fault> {
        let text = bytes_of(&self.key, &self.file)?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .delimiter(delimiter(&text))
            .trim(csv::Trim::All)
            .from_reader(text.as_slice());
        let header = reader.headers().map_err(|e| self.bad(&e.to_string()))?;
        self.check_names(header)?;
        let columns = [
            self.column(header, names[0], 0)?,
            self.column(header, names[1], 1)?,
        ];
        if names[1].is_none() {
            self.check_angle(header)?;
        }
        let unit = header.get(columns[1]).map_or(Ok(1.0), degrees);
        let to_degrees = unit.map_err(|problem| self.bad(&problem))?;
        let (mut rows, mut lines) = (vec![], vec![]);
        for record in reader.records() {
            let record = record.map_err(|e| self.bad(&e.to_string()))?;
            let [x, q] = columns.map(|k| self.number(&record, k));
            rows.push([x?, to_degrees * q?]);
            lines.push(line_of(&record));
        }
        self.check(&rows, &lines, harmonics)?;
        Ok(rows)
    }

    /// A header that is numbers is the first row of a table without one.
    fn check_names(&self, header: &StringRecord) -> Result<(), Fault> {
        if header.is_empty() || header.iter().any(|h| h.parse::<f64>().is_err()) {
            return Ok(());
        }
        let numbers = header.iter().collect::<Vec<_>>().join(",");
        let problem = format!(
            "its first row, `{numbers}`, consists of numbers, and there is no header line above it"
        );
        let mut fault = self.bad(&problem);
        fault.remedy =
            "write the names of the columns above the numbers, for instance phase,angle_deg".into();
        Err(fault)
    }

    /// Which column has this name; where none is asked for, the one at `default`.
    fn column(
        &self,
        header: &StringRecord,
        name: Option<&str>,
        default: usize,
    ) -> Result<usize, Fault> {
        let Some(name) = name else {
            return Ok(default);
        };
        header.iter().position(|h| h == name).ok_or_else(|| {
            let names = header.iter().collect::<Vec<_>>().join(", ");
            self.bad(&format!("there is no column `{name}` among {names}"))
        })
    }

    /// Refuses a second column that is named after another angle than the key's.
    fn check_angle(&self, header: &StringRecord) -> Result<(), Fault> {
        let name = header.get(1).unwrap_or_default();
        let own = ANGLES.iter().find(|a| self.key.contains(&format!(".{a}.")));
        let named = ANGLES.iter().find(|a| name.starts_with(**a));
        match (own, named) {
            (Some(own), Some(named)) if own != named => {
                let problem =
                    format!("its second column is `{name}`, and this is the table of {own}");
                let mut fault = self.bad(&problem);
                fault.remedy = format!("name the column of {own}: angle_column = \"...\"");
                Err(fault)
            }
            _ => Ok(()),
        }
    }

    fn number(&self, record: &StringRecord, column: usize) -> Result<f64, Fault> {
        let text = record.get(column).unwrap_or("");
        let value = text.parse::<f64>().ok().filter(|x| x.is_finite());
        value.ok_or_else(|| {
            let line = line_of(record);
            self.bad(&format!("line {line}: `{text}` is not a finite number"))
        })
    }

    /// Rows, at these lines of the file, that are no motion are refused here, where their lines are known.
    fn check(
        &self,
        rows: &[[f64; 2]],
        lines: &[u64],
        harmonics: Option<usize>,
    ) -> Result<(), Fault> {
        if rows.is_empty() {
            return Err(self.bad("there are no rows below the header"));
        }
        let pairs: Vec<(f64, f64)> = rows.iter().map(|&[x, q]| (x, q)).collect();
        let motion = match harmonics {
            None => PeriodicSpline::new("", &pairs).map(|_| ()),
            Some(n) => Fourier::fitted("", &pairs, n).map(|_| ()),
        };
        if let Err(ModelError::Table { row, problem, .. }) = motion {
            let line = row.checked_sub(1).and_then(|k| lines.get(k)).copied();
            let line = line.unwrap_or_default();
            return Err(self.bad(&format!("line {line}: {problem}")));
        }
        Ok(())
    }

    fn bad(&self, problem: &str) -> Fault {
        Fault::new(
            self.key.clone(),
            format!("`{}`: {problem}", self.file.display()),
            "a CSV file with one header line and finite numbers, a point before decimals; commas, semicolons or tabs part its columns",
            "correct the file",
        )
    }
}

/// What parts the columns: a comma, or a semicolon or tab where the header has no comma.
fn delimiter(text: &[u8]) -> u8 {
    let is_comment = |line: &&[u8]| line.starts_with(b"#") || line.trim_ascii().is_empty();
    let mut lines = text.split(|&b| b == b'\n');
    let header = lines.find(|line| !is_comment(line)).unwrap_or_default();
    let others = [b';', b'\t'];
    let other = others.into_iter().find(|sign| header.contains(sign));
    other.filter(|_| !header.contains(&b',')).unwrap_or(b',')
}

fn line_of(record: &StringRecord) -> u64 {
    record.position().map_or(0, csv::Position::line)
}
