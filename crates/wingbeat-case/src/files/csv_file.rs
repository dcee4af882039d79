//! Columns of numbers in CSV files.

use std::path::PathBuf;

use csv::StringRecord;

use super::read::bytes_of;
use crate::error::Fault;
use crate::text::nearest::nearest;

/// The byte order mark of UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// What cells hold in which there is no number, in letters of either case.
const NONE: [&str; 5] = ["", "nan", "-nan", "na", "n/a"];

/// A CSV file, and the key that names it.
pub(super) struct CsvFile {
    pub key: String,
    pub file: PathBuf,
}

/// Two columns of numbers, row by row.
pub(super) struct Columns {
    /// Their names; empty where the header has none.
    pub names: [String; 2],
    pub rows: Vec<[f64; 2]>,
    /// The line of the file that each row stands in, counted from 1.
    pub lines: Vec<u64>,
    /// The lines of the rows left out, whose second cell, or both, are empty or no number (`NaN`, `NA`).
    pub gaps: Vec<u64>,
}

impl CsvFile {
    /// The numbers of two columns, which `choose` finds in the header; its error is what is wrong with that.
    pub fn columns(
        &self,
        choose: impl FnOnce(&StringRecord) -> Result<[usize; 2], Fault>,
    ) -> Result<Columns, Fault> {
        let text = bytes_of(&self.key, &self.file)?;
        let mut reader = csv_reader(&text);
        let header = reader.headers().map_err(|e| self.bad(&e.to_string()))?;
        self.check_names(header)?;
        let columns = choose(header)?;
        let name = |k: usize| header.get(k).unwrap_or_default().to_owned();
        let mut found = Columns {
            names: columns.map(name),
            rows: vec![],
            lines: vec![],
            gaps: vec![],
        };
        for record in reader.records() {
            let record = record.map_err(|e| self.bad(&e.to_string()))?;
            let line = line_of(&record);
            let [x, y] = columns.map(|k| self.number(&record, k));
            match (x?, y?) {
                (Some(x), Some(y)) => {
                    found.rows.push([x, y]);
                    found.lines.push(line);
                }
                (_, None) => found.gaps.push(line),
                (None, Some(_)) => return Err(self.empty(line, &found.names[..1])),
            }
        }
        if found.rows.is_empty() {
            return Err(self.bad("there are no rows of numbers below the header"));
        }
        Ok(found)
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
            "write the names of the columns above the numbers, for instance phase,angle_deg or x_mm,y_mm".into();
        Err(fault)
    }

    /// Which column has the name that `key`, beside that of the file, asks for; where it asks for none, the one at
    /// `default`.
    pub fn column(
        &self,
        header: &StringRecord,
        (key, name): (&str, Option<&str>),
        default: usize,
    ) -> Result<usize, Fault> {
        let Some(name) = name else {
            return Ok(default);
        };
        let mut found = (0..header.len()).filter(|c| &header[*c] == name);
        match (found.next(), found.next()) {
            (Some(column), None) => Ok(column),
            (Some(_), Some(_)) => Err(self.bad(&format!("two of its columns are named `{name}`"))),
            (None, _) => Err(self.no_column(header, key, name)),
        }
    }

    fn no_column(&self, header: &StringRecord, key: &str, name: &str) -> Fault {
        let names: Vec<&str> = header.iter().filter(|n| !n.is_empty()).collect();
        let lower = name.to_lowercase();
        let holds = |other: &&str| !name.is_empty() && other.to_lowercase().contains(&lower);
        let near: Vec<&str> = match nearest(name, &names) {
            Some(near) => vec![near],
            None => names.iter().copied().filter(|n| holds(n)).collect(),
        };
        let remedy = match near[..] {
            [] => "name one of its columns".to_owned(),
            _ => format!("did you mean `{}`?", near.join("` or `")),
        };
        let (table, _) = self.key.rsplit_once('.').unwrap_or_default();
        Fault::new(
            format!("{table}.{key}"),
            format!("`{}` has no column `{name}`", self.file.display()),
            names.join(", "),
            remedy,
        )
    }

    /// The number in a cell; none in one that is empty or says that there is none.
    fn number(&self, record: &StringRecord, column: usize) -> Result<Option<f64>, Fault> {
        let text = record.get(column).unwrap_or("");
        if NONE.iter().any(|none| text.eq_ignore_ascii_case(none)) {
            return Ok(None);
        }
        let value = text.parse::<f64>().ok().filter(|x| x.is_finite());
        value.map(Some).ok_or_else(|| {
            let line = line_of(record);
            self.bad(&format!("line {line}: `{text}` is not a finite number"))
        })
    }

    /// A row of this line has to have the numbers of these columns, and one is missing.
    pub fn empty(&self, line: u64, columns: &[String]) -> Fault {
        let named = columns.iter().any(|name| !name.is_empty());
        let of = match named {
            true => format!(" of `{}`", columns.join("` or `")),
            false => String::new(),
        };
        let mut fault = self.bad(&format!(
            "line {line}: a cell{of} is empty, or says that there is no number"
        ));
        fault.remedy = "write the number, or leave the row out".into();
        fault
    }

    /// What is wrong with the file.
    pub fn bad(&self, problem: &str) -> Fault {
        Fault::new(
            self.key.clone(),
            format!("`{}`: {problem}", self.file.display()),
            "a CSV file with one header line and finite numbers, a point before decimals; commas, semicolons or tabs part its columns",
            "correct the file",
        )
    }
}

/// The words of the name of a column, in small letters: `psi [deg]` has two.
pub(super) fn words_of(column: &str) -> Vec<String> {
    let words = column.split(|c: char| !c.is_alphanumeric());
    words.map(str::to_lowercase).collect()
}

/// Reads a CSV file with a header: without the byte order mark that spreadsheets put before everything, without
/// comments (`#`), columns parted by what its header has.
pub fn csv_reader(text: &[u8]) -> csv::Reader<&[u8]> {
    let text = text.strip_prefix(MARK).unwrap_or(text);
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .delimiter(delimiter(text))
        .trim(csv::Trim::All)
        .from_reader(text)
}

/// What parts the columns of a CSV file: a comma, or a semicolon or tab where the header has no comma.
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
