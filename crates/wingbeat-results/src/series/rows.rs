//! history.csv row by row: reading needs the memory of one row, however long the flight.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use wingbeat_case::IoError;

/// An open history.
pub struct Rows {
    path: PathBuf,
    reader: BufReader<File>,
    names: Vec<String>,
    line: String,
    values: Vec<f64>,
    read: usize,
}

impl Rows {
    /// Opens a history and reads its column names.
    ///
    /// # Errors
    /// A file that cannot be read or is not a history.
    pub fn open(path: &Path) -> Result<Self, IoError> {
        let file = File::open(path).map_err(IoError::read(path))?;
        let mut rows = Self {
            path: path.to_owned(),
            reader: BufReader::with_capacity(1 << 16, file),
            names: vec![],
            line: String::new(),
            values: vec![],
            read: 0,
        };
        if !rows.next_line()? || !rows.line.starts_with("step_count,") {
            return Err(rows.damaged("this is not a history of wingbeat".to_owned()));
        }
        rows.names = rows.line.trim_end().split(',').map(str::to_owned).collect();
        Ok(rows)
    }

    /// Column names in their order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Numbers of the next row; none at the end. A last row that was cut by a kill is left out.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn next_row(&mut self) -> Result<Option<&[f64]>, IoError> {
        if !self.next_line()? {
            return Ok(None);
        }
        self.read += 1;
        self.values.clear();
        for field in self.line.trim_end_matches(['\n', '\r']).split(',') {
            match field.parse() {
                Ok(value) => self.values.push(value),
                Err(_) => {
                    let problem = format!("row {}: `{field}` is not a number", self.read);
                    return Err(self.damaged(problem));
                }
            }
        }
        let [found, wanted] = [self.values.len(), self.names.len()];
        if found != wanted {
            let problem = format!("row {} has {found} fields, not {wanted}", self.read);
            return Err(self.damaged(problem));
        }
        Ok(Some(&self.values))
    }

    /// Whether there was another whole line.
    fn next_line(&mut self) -> Result<bool, IoError> {
        self.line.clear();
        self.reader
            .read_line(&mut self.line)
            .map_err(IoError::read(&self.path))?;
        Ok(self.line.ends_with('\n'))
    }

    fn damaged(&self, problem: String) -> IoError {
        IoError::Damaged {
            path: self.path.clone(),
            problem,
        }
    }

    /// Passes over the next `count` rows.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn skip(&mut self, count: usize) -> Result<(), IoError> {
        for _ in 0..count {
            if !self.next_line()? {
                break;
            }
            self.read += 1;
        }
        Ok(())
    }

    /// Times of all whole rows \[s\].
    ///
    /// # Errors
    /// A file that cannot be read or is not a history.
    pub fn times(path: &Path) -> Result<Vec<f64>, IoError> {
        let mut rows = Self::open(path)?;
        let mut times = vec![];
        while rows.next_line()? {
            rows.read += 1;
            let field = rows.line.split(',').nth(1).unwrap_or("").trim_end();
            let problem = || format!("row {}: `{field}` is not a time", rows.read);
            times.push(field.parse().map_err(|_| rows.damaged(problem()))?);
        }
        Ok(times)
    }

    /// Number of whole rows in a history.
    ///
    /// # Errors
    /// A file that cannot be read or is not a history.
    pub fn count(path: &Path) -> Result<usize, IoError> {
        let mut rows = Self::open(path)?;
        let mut count = 0;
        while rows.next_line()? {
            count += 1;
        }
        Ok(count)
    }
}
