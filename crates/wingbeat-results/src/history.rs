//! history.csv: appended row by row, read back tolerating a cut last row.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_flight::Record;

use super::columns;
use super::manifest::hexadecimal;
use super::rows::Rows;
use wingbeat_case::IoError;

/// Appends one row per record; every row is on disk before the next step begins.
pub struct HistoryWriter {
    path: PathBuf,
    file: File,
    bodies: Vec<String>,
    values: Vec<f64>,
    line: String,
    started: bool,
    bytes: u64,
    hash: Sha256,
}

impl HistoryWriter {
    /// A new history for bodies with these names (see [`columns::body_names`]).
    ///
    /// # Errors
    /// A file that cannot be created.
    pub fn create(path: &Path, bodies: Vec<String>) -> Result<Self, IoError> {
        let mut options = OpenOptions::new();
        let file = options.write(true).create(true).truncate(false).open(path);
        let file = file.map_err(IoError::write(path))?;
        lock(&file, path)?;
        file.set_len(0).map_err(IoError::write(path))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            bodies,
            values: vec![],
            line: String::new(),
            started: false,
            bytes: 0,
            hash: Sha256::new(),
        })
    }

    /// Goes on after the first `bytes` bytes of an existing history; [`Self::cut`] drops what
    /// follows, before anything is appended.
    ///
    /// # Errors
    /// A file that cannot be read and changed, or that another wingbeat is writing.
    pub fn reopen(path: &Path, bodies: Vec<String>, bytes: u64) -> Result<Self, IoError> {
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).open(path);
        let file = file.map_err(IoError::write(path))?;
        lock(&file, path)?;
        let hash = hash_start(&file, bytes).map_err(IoError::read(path))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            bodies,
            values: vec![],
            line: String::new(),
            started: true,
            bytes,
            hash,
        })
    }

    /// Drops what follows the part that is gone on from.
    ///
    /// # Errors
    /// A file that cannot be changed.
    pub fn cut(&mut self) -> Result<(), IoError> {
        let cut = self.file.set_len(self.bytes);
        cut.map_err(IoError::write(&self.path))
    }

    /// Bytes written so far and their SHA-256; the system is asked to put them onto the disk.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn seal(&self) -> Result<(u64, String), IoError> {
        self.file.sync_data().map_err(IoError::write(&self.path))?;
        Ok((self.bytes, hexadecimal(self.hash.clone())))
    }

    /// Appends a record in one write; numbers carry the digits that tell them from all others.
    ///
    /// # Errors
    /// A file that cannot be written, e.g. on a full disk.
    pub fn append(&mut self, record: &Record) -> Result<(), IoError> {
        self.line.clear();
        if !self.started {
            self.line = columns::names(&self.bodies, record).join(",") + "\n";
            self.started = true;
        }
        columns::values(&self.bodies, record, &mut self.values);
        for (k, value) in self.values.iter().enumerate() {
            let comma = if k == 0 { "" } else { "," };
            write_number(&mut self.line, comma, *value);
        }
        self.line.push('\n');
        if let Err(e) = self.file.write_all(self.line.as_bytes()) {
            let _ = self.file.set_len(self.bytes); // a cut row is left out by readers, too
            return Err(IoError::write(&self.path)(e));
        }
        self.bytes += self.line.len() as u64;
        self.hash.update(self.line.as_bytes());
        Ok(())
    }
}

/// One writer at a time; the system lets go of the lock however the program ends.
fn lock(file: &File, path: &Path) -> Result<(), IoError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(IoError::Damaged {
            path: path.to_owned(),
            problem: "another wingbeat is writing it right now; wait for it or end it".to_owned(),
        }),
        _ => Ok(()), // file systems without locks are written to all the same
    }
}

/// Whether some wingbeat is writing this history.
pub(crate) fn is_locked(path: &Path) -> bool {
    let file = File::open(path).map(|f| f.try_lock());
    matches!(file, Ok(Err(TryLockError::WouldBlock)))
}

/// Whether nobody is writing this history; false, too, where the file system has no locks to tell.
pub(crate) fn is_abandoned(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| file.try_lock_shared().is_ok())
}

/// SHA-256 of the first `bytes` bytes, read in pieces.
///
/// # Errors
/// A file that cannot be read or is shorter.
pub(crate) fn hash_start(file: &File, bytes: u64) -> std::io::Result<Sha256> {
    let mut hash = Sha256::new();
    let mut piece = vec![0; 1 << 16];
    let mut part = file.take(bytes);
    let mut left = bytes;
    while left > 0 {
        let n = part.read(&mut piece)?;
        if n == 0 {
            return Err(std::io::ErrorKind::UnexpectedEof.into());
        }
        hash.update(&piece[..n]);
        left -= n as u64;
    }
    Ok(hash)
}

/// Whole numbers plainly, others with the fewest digits that read back bit for bit.
fn write_number(line: &mut String, comma: &str, value: f64) {
    line.push_str(comma);
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value);
    let whole = text.strip_suffix(".0").filter(|_| value.abs() < 1e15);
    line.push_str(match whole {
        Some("-0") | None => text,
        Some(whole) => whole,
    });
}

/// A history read back: columns of numbers by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    names: Vec<String>,
    columns: BTreeMap<String, Vec<f64>>,
}

impl History {
    /// Reads a history; a last row that was cut by a kill is left out.
    ///
    /// # Errors
    /// A file that cannot be read or is not a history.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        Self::every(path, 1)
    }

    /// Reads about `most` rows of a history, evenly spaced, the first and the last among them:
    /// memory does not grow with the run. Returns the spacing, too.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn thinned(path: &Path, most: usize) -> Result<(Self, usize), IoError> {
        let stride = Rows::count(path)?.div_ceil(most.max(1)).max(1);
        Ok((Self::every(path, stride)?, stride))
    }

    /// Every `stride`-th row and the last.
    fn every(path: &Path, stride: usize) -> Result<Self, IoError> {
        let mut rows = Rows::open(path)?;
        let names = rows.names().to_vec();
        let mut columns = vec![vec![]; names.len()];
        let mut last: Vec<f64> = vec![];
        let mut count = 0;
        while let Some(row) = rows.next_row()? {
            if count % stride == 0 {
                push(&mut columns, row);
                last.clear();
            } else {
                last.clear();
                last.extend_from_slice(row);
            }
            count += 1;
        }
        if !last.is_empty() {
            push(&mut columns, &last);
        }
        let columns = names.iter().cloned().zip(columns).collect();
        Ok(Self { names, columns })
    }

    /// Column names in their order.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.column("step_count").len()
    }

    /// A column; empty if there is none of this name.
    pub fn column(&self, name: &str) -> &[f64] {
        self.columns.get(name).map_or(&[], Vec::as_slice)
    }

    /// The sum of the columns whose names satisfy `which`, row by row.
    pub fn sum(&self, which: impl Fn(&str) -> bool) -> Vec<f64> {
        let mut sum = vec![0.0; self.rows()];
        for name in self.names.iter().filter(|n| which(n)) {
            for (total, x) in sum.iter_mut().zip(self.column(name)) {
                *total += x;
            }
        }
        sum
    }
}

fn push(columns: &mut [Vec<f64>], row: &[f64]) {
    for (column, value) in columns.iter_mut().zip(row) {
        column.push(*value);
    }
}
