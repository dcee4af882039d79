//! history.csv: appended row by row, read back tolerating a cut last row.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

use sha2::{Digest, Sha256};
use wingbeat_flight::{FlightSetup, Record};

use crate::common::checkpoint::Header;
use crate::common::manifest::hexadecimal;
use crate::series::columns::Columns;
use crate::series::rows::Rows;
use wingbeat_case::IoError;

/// Appends rows, a record after the other; every row is on disk before the next step begins.
pub struct HistoryWriter {
    path: PathBuf,
    file: File,
    setup: FlightSetup,
    /// None before the first record.
    columns: Option<Columns>,
    /// The newest record.
    newest: Record,
    /// The next row as the steps since the last one make it, but for columns that hold their own
    /// step, which follow from the newest record; empty right after a row.
    pending: Vec<f64>,
    line: String,
    bytes: u64,
    hash: Sha256,
}

impl HistoryWriter {
    /// A new history of the flight of `setup`.
    ///
    /// # Errors
    /// A file that cannot be created.
    pub fn create(path: &Path, setup: &FlightSetup) -> Result<Self, IoError> {
        let mut options = OpenOptions::new();
        let file = options.write(true).create(true).truncate(false).open(path);
        let file = file.map_err(IoError::write(path))?;
        lock(&file, path)?;
        file.set_len(0).map_err(IoError::write(path))?;
        Ok(Self::on(file, path, setup, Sha256::new()))
    }

    fn on(file: File, path: &Path, setup: &FlightSetup, hash: Sha256) -> Self {
        Self {
            path: path.to_owned(),
            file,
            setup: setup.clone(),
            columns: None,
            newest: Record::default(),
            pending: vec![],
            line: String::new(),
            bytes: 0,
            hash,
        }
    }

    /// Goes on after the part of an existing history that a checkpoint was made beside;
    /// [`Self::cut`] drops what follows, before anything is appended.
    ///
    /// # Errors
    /// A file that cannot be read and changed, or that another wingbeat is writing; one that another build wrote.
    pub fn reopen(path: &Path, setup: &FlightSetup, header: &Header) -> Result<Self, IoError> {
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).open(path);
        let file = file.map_err(IoError::write(path))?;
        lock(&file, path)?;
        Columns::in_file(path, setup, Rows::open(path)?.names())?;
        let hash = hash_start(&file, header.history_bytes).map_err(IoError::read(path))?;
        Ok(Self {
            bytes: header.history_bytes,
            pending: header.pending.iter().map(|b| f64::from_bits(*b)).collect(),
            ..Self::on(file, path, setup, hash)
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
        Ok((self.bytes, hexadecimal(&self.hash.clone().finalize())))
    }

    /// The bits of the row that is not written yet; none right after a row.
    pub fn pending(&mut self) -> Vec<u64> {
        self.complete();
        self.pending.iter().map(|x| x.to_bits()).collect()
    }

    /// Makes the next row whole.
    fn complete(&mut self) {
        if let Some(columns) = self.columns.as_ref().filter(|_| !self.pending.is_empty()) {
            columns.hold(&mut self.newest, &mut self.pending);
        }
    }

    /// Takes a record into the next row, which [`Self::flush`] writes.
    ///
    /// # Errors
    /// A file that cannot be written, e.g. on a full disk; joints that do not fit together.
    pub fn take(&mut self, record: &Record) -> Result<(), IoError> {
        let columns = match self.columns.take() {
            Some(columns) => columns,
            None => self.begin(record)?,
        };
        self.newest.clone_from(record);
        let is_first = self.pending.is_empty();
        self.pending.resize(columns.iter().len(), 0.0);
        columns.fold(&mut self.newest, is_first, &mut self.pending);
        self.columns = Some(columns);
        Ok(())
    }

    /// The columns; a new file begins with their names.
    fn begin(&mut self, record: &Record) -> Result<Columns, IoError> {
        let columns = Columns::of(&self.setup, record).map_err(|e| IoError::Damaged {
            path: self.path.clone(),
            problem: format!("the joints of the flight do not fit together: {e}"),
        })?;
        if self.bytes == 0 {
            self.line = columns.names().join(",") + "\n";
            self.write_line()?;
        }
        Ok(columns)
    }

    /// Writes the row that is not written yet, if there is one.
    ///
    /// # Errors
    /// A file that cannot be written, e.g. on a full disk.
    pub fn flush(&mut self) -> Result<(), IoError> {
        self.complete();
        let Some(columns) = self.columns.as_ref().filter(|_| !self.pending.is_empty()) else {
            return Ok(());
        };
        self.line.clear();
        for (k, (value, column)) in self.pending.iter().zip(columns.iter()).enumerate() {
            self.line.push_str(if k == 0 { "" } else { "," });
            write_number(&mut self.line, *value, column.is_count);
        }
        self.line.push('\n');
        self.pending.clear();
        self.write_line()
    }

    fn write_line(&mut self) -> Result<(), IoError> {
        if let Err(e) = self.file.write_all(self.line.as_bytes()) {
            let _ = self.file.set_len(self.bytes); // a cut row is left out by readers, too
            return Err(IoError::write(&self.path)(e));
        }
        self.bytes += self.line.len() as u64;
        self.hash.update(self.line.as_bytes());
        Ok(())
    }
}

/// How often a lock is asked for, and how long is waited in between.
const LOCK_TRIES: usize = 20;
const LOCK_WAIT: Duration = Duration::from_millis(10);

/// One writer at a time; the system lets go of the lock however the program ends.
fn lock(file: &File, path: &Path) -> Result<(), IoError> {
    match stays_locked(file) {
        true => Err(IoError::Busy {
            path: path.to_owned(),
        }),
        false => Ok(()),
    }
}

/// Whether another program has the lock and keeps it: one that is just being started may hold a copy for an
/// instant. File systems without locks are written to all the same.
fn stays_locked(file: &File) -> bool {
    for _ in 0..LOCK_TRIES {
        if !matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return false;
        }
        std::thread::sleep(LOCK_WAIT);
    }
    true
}

/// Whether some wingbeat is writing this history.
pub fn is_locked(path: &Path) -> bool {
    File::open(path).is_ok_and(|file| stays_locked(&file))
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

/// Counts as whole numbers; others as floating-point numbers, which a reader of the first rows must
/// not take for counts, with the fewest digits that read back bit for bit.
fn write_number(line: &mut String, value: f64, is_count: bool) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value);
    let whole = text.strip_suffix(".0").filter(|_| is_count);
    line.push_str(whole.unwrap_or(text));
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
        Self::next(&mut Rows::open(path)?, usize::MAX)
    }

    /// Reads some rows of a history.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn of_rows(path: &Path, rows: Range<usize>) -> Result<Self, IoError> {
        let mut source = Rows::open(path)?;
        source.skip(rows.start)?;
        Self::next(&mut source, rows.len())
    }

    /// The next rows of an open history, at most `most`.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn next(rows: &mut Rows, most: usize) -> Result<Self, IoError> {
        let names = rows.names().to_vec();
        let mut columns = vec![vec![]; names.len()];
        let mut count = 0;
        while count < most {
            let Some(row) = rows.next_row()? else { break };
            for (column, value) in columns.iter_mut().zip(row) {
                column.push(*value);
            }
            count += 1;
        }
        let columns = names.iter().cloned().zip(columns).collect();
        Ok(Self { names, columns })
    }

    /// The history of records in memory, a row of each.
    pub fn of(columns: &Columns, records: &[Record]) -> Self {
        let mut lists = vec![Vec::with_capacity(records.len()); columns.iter().len()];
        let (mut scratch, mut values) = (Record::default(), vec![]);
        for record in records {
            columns.values(record, &mut scratch, &mut values);
            let row = lists.iter_mut().zip(&values);
            row.for_each(|(list, value)| list.push(*value));
        }
        let names = columns.names();
        let columns = names.iter().cloned().zip(lists).collect();
        Self { names, columns }
    }

    /// Its columns by name.
    pub fn into_columns(self) -> BTreeMap<String, Vec<f64>> {
        self.columns
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
