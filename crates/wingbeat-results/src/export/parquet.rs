//! A table as Apache Parquet: uncompressed columns of doubles, whole numbers, booleans and texts, in groups of rows.
//!
//! Numbers of fields are those of `parquet.thrift` (Apache Parquet format 2.x), written in
//! Thrift's compact protocol.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Rows that are gathered before they are written: the memory the writer takes.
const GROUP: usize = 4096;
const MAGIC: &[u8] = b"PAR1";
const BOOLEAN: i64 = 0;
const INT64: i64 = 2;
const DOUBLE: i64 = 5;
const BYTE_ARRAY: i64 = 6;
const UTF8: i64 = 0;
const REQUIRED: i64 = 0;
const OPTIONAL: i64 = 1;
const PLAIN: i64 = 0;
const RLE: i64 = 3;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Numbers.
    Numbers,
    /// Whole numbers.
    Counts,
    /// True or false, or neither.
    Flags,
    /// Texts.
    Texts,
}

impl Cells {
    /// The type in the format.
    fn kind(self) -> i64 {
        match self {
            Self::Numbers => DOUBLE,
            Self::Counts => INT64,
            Self::Flags => BOOLEAN,
            Self::Texts => BYTE_ARRAY,
        }
    }

    /// Whether each row has a value.
    fn repetition(self) -> i64 {
        match self {
            Self::Flags => OPTIONAL,
            Self::Numbers | Self::Counts | Self::Texts => REQUIRED,
        }
    }
}

/// A cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// A number; a whole one for a column of these.
    Number(f64),
    /// A whole number, kept to its last digit.
    Count(i64),
    /// True or false, or neither.
    Flag(Option<bool>),
    /// A text.
    Text(&'a str),
}

/// A table being written.
pub struct ParquetWriter {
    file: BufWriter<File>,
    at: u64,
    /// Name of the table.
    name: String,
    names: Vec<String>,
    cells: Vec<Cells>,
    /// Rows gathered so far, and the bytes of each column; of booleans one a row.
    rows: usize,
    columns: Vec<Vec<u8>>,
    groups: Vec<Group>,
}

/// A group of rows that is written: its rows and where its columns begin, and their lengths.
struct Group {
    rows: usize,
    pages: Vec<[u64; 2]>,
}

impl ParquetWriter {
    /// A table of this name with these columns.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn create(path: &Path, name: &str, columns: Vec<(String, Cells)>) -> std::io::Result<Self> {
        let mut file = BufWriter::new(File::create(path)?);
        file.write_all(MAGIC)?;
        let (names, cells): (Vec<String>, Vec<Cells>) = columns.into_iter().unzip();
        Ok(Self {
            file,
            at: MAGIC.len() as u64,
            name: name.to_owned(),
            columns: vec![vec![]; names.len()],
            names,
            cells,
            rows: 0,
            groups: vec![],
        })
    }

    /// Adds a row of numbers.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn row(&mut self, row: &[f64]) -> std::io::Result<()> {
        self.cells(row.iter().map(|x| Cell::Number(*x)))
    }

    /// Adds a row.
    ///
    /// # Errors
    /// A row that has not one cell for each column, of its kind; a file that cannot be written.
    pub fn cells<'a>(&mut self, row: impl IntoIterator<Item = Cell<'a>>) -> std::io::Result<()> {
        let mut row = row.into_iter();
        for (column, cells) in self.columns.iter_mut().zip(&self.cells) {
            match (cells, row.next()) {
                (Cells::Numbers, Some(Cell::Number(x))) => column.extend(x.to_le_bytes()),
                (Cells::Counts, Some(Cell::Count(n))) => column.extend(n.to_le_bytes()),
                (Cells::Counts, Some(Cell::Number(x))) => column.extend((x as i64).to_le_bytes()),
                (Cells::Flags, Some(Cell::Flag(flag))) => {
                    column.push(flag.map_or(NEITHER, u8::from));
                }
                (Cells::Texts, Some(Cell::Text(text))) => {
                    column.extend((text.len() as u32).to_le_bytes());
                    column.extend(text.as_bytes());
                }
                _ => {
                    return Err(std::io::Error::other(
                        "a row without a cell of its kind for each column",
                    ));
                }
            }
        }
        if row.next().is_some() {
            return Err(std::io::Error::other("a row longer than its table"));
        }
        self.rows += 1;
        if self.rows >= GROUP {
            self.flush()
        } else {
            Ok(())
        }
    }

    /// Writes the gathered rows as a group, each column as one page.
    fn flush(&mut self) -> std::io::Result<()> {
        let rows = std::mem::take(&mut self.rows);
        if rows == 0 {
            return Ok(());
        }
        let mut pages = vec![];
        for (data, cells) in self.columns.iter_mut().zip(&self.cells) {
            if *cells == Cells::Flags {
                *data = flags(data);
            }
            let head = page_header(rows, data.len());
            self.file.write_all(&head)?;
            self.file.write_all(data)?;
            let length = (head.len() + data.len()) as u64;
            pages.push([self.at, length]);
            self.at += length;
            data.clear();
        }
        self.groups.push(Group { rows, pages });
        Ok(())
    }

    /// Ends the table; `notes` are kept beside it.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(mut self, notes: &[(&str, &str)]) -> std::io::Result<()> {
        self.flush()?;
        let footer = self.footer(notes);
        self.file.write_all(&footer)?;
        self.file.write_all(&(footer.len() as u32).to_le_bytes())?;
        self.file.write_all(MAGIC)?;
        self.file.into_inner()?.sync_data()
    }

    /// FileMetaData.
    fn footer(&self, notes: &[(&str, &str)]) -> Vec<u8> {
        let mut t = Thrift::default();
        t.integer(1, 2);
        t.list(2, 12, self.names.len() + 1);
        t.element(|t| {
            t.text(4, &self.name);
            t.integer(5, self.names.len() as i64);
        });
        for (name, cells) in self.names.iter().zip(&self.cells) {
            t.element(|t| {
                t.integer(1, cells.kind());
                t.integer(3, cells.repetition());
                t.text(4, name);
                if *cells == Cells::Texts {
                    t.integer(6, UTF8);
                }
            });
        }
        t.long(3, self.groups.iter().map(|g| g.rows as i64).sum());
        t.list(4, 12, self.groups.len());
        for group in &self.groups {
            t.element(|t| self.group(t, group));
        }
        t.list(5, 12, notes.len());
        for (key, value) in notes {
            t.element(|t| {
                t.text(1, key);
                t.text(2, value);
            });
        }
        t.text(6, concat!("wingbeat version ", env!("CARGO_PKG_VERSION")));
        t.stop();
        t.bytes
    }

    /// RowGroup with its ColumnChunks and ColumnMetaData.
    fn group(&self, t: &mut Thrift, group: &Group) {
        t.list(1, 12, self.names.len());
        let pages = self.cells.iter().zip(&group.pages);
        for (name, (cells, [at, length])) in self.names.iter().zip(pages) {
            t.element(|t| {
                t.long(2, *at as i64);
                t.structure(3, |t| {
                    t.integer(1, cells.kind());
                    t.list(2, 5, 2);
                    t.zigzag(PLAIN);
                    t.zigzag(RLE);
                    t.list(3, 8, 1);
                    t.bare(name);
                    t.integer(4, 0); // uncompressed
                    t.long(5, group.rows as i64);
                    t.long(6, *length as i64);
                    t.long(7, *length as i64);
                    t.long(9, *at as i64);
                });
            });
        }
        t.long(2, group.pages.iter().map(|p| p[1] as i64).sum());
        t.long(3, group.rows as i64);
    }
}

/// A boolean that is neither true nor false, among those gathered.
const NEITHER: u8 = 2;

/// The page of a column of booleans: for every row by a bit whether there is one (levels of definition: their length,
/// then one run of bits), then by a bit whether it is true, of those there are.
fn flags(rows: &[u8]) -> Vec<u8> {
    let there: Vec<bool> = rows.iter().map(|f| *f != NEITHER).collect();
    let values = rows.iter().filter(|f| **f != NEITHER);
    let values: Vec<bool> = values.map(|f| *f == 1).collect();
    let mut run = Thrift::default();
    run.whole((rows.len().div_ceil(8) as u64) << 1 | 1);
    run.bytes.extend(bits(&there));
    let length = (run.bytes.len() as u32).to_le_bytes();
    [&length[..], &run.bytes, &bits(&values)].concat()
}

/// Eight a byte, the first in its lowest bit.
fn bits(all: &[bool]) -> Vec<u8> {
    let byte = |eight: &[bool]| (0..).zip(eight).map(|(k, b)| u8::from(*b) << k).sum();
    all.chunks(8).map(byte).collect()
}

/// PageHeader with its DataPageHeader.
fn page_header(rows: usize, bytes: usize) -> Vec<u8> {
    let mut t = Thrift::default();
    t.integer(1, 0);
    t.integer(2, bytes as i64);
    t.integer(3, bytes as i64);
    t.structure(5, |t| {
        t.integer(1, rows as i64);
        t.integer(2, PLAIN);
        t.integer(3, RLE);
        t.integer(4, RLE);
    });
    t.stop();
    t.bytes
}

/// Thrift's compact protocol, as far as it is needed.
#[derive(Default)]
struct Thrift {
    bytes: Vec<u8>,
    last: u8,
}

impl Thrift {
    /// Head of a field of some type; fields come in rising order.
    fn field(&mut self, id: u8, kind: u8) {
        self.bytes.push((id - self.last) << 4 | kind);
        self.last = id;
    }

    fn integer(&mut self, id: u8, value: i64) {
        self.field(id, 5);
        self.zigzag(value);
    }

    fn long(&mut self, id: u8, value: i64) {
        self.field(id, 6);
        self.zigzag(value);
    }

    fn text(&mut self, id: u8, text: &str) {
        self.field(id, 8);
        self.bare(text);
    }

    fn bare(&mut self, text: &str) {
        self.whole(text.len() as u64);
        self.bytes.extend(text.as_bytes());
    }

    fn list(&mut self, id: u8, kind: u8, count: usize) {
        self.field(id, 9);
        if count < 15 {
            self.bytes.push((count as u8) << 4 | kind);
        } else {
            self.bytes.push(0xf0 | kind);
            self.whole(count as u64);
        }
    }

    fn structure(&mut self, id: u8, fill: impl FnOnce(&mut Self)) {
        self.field(id, 12);
        self.element(fill);
    }

    /// A structure in a list.
    fn element(&mut self, fill: impl FnOnce(&mut Self)) {
        let last = std::mem::take(&mut self.last);
        fill(self);
        self.stop();
        self.last = last;
    }

    fn stop(&mut self) {
        self.bytes.push(0);
    }

    fn zigzag(&mut self, value: i64) {
        self.whole(((value << 1) ^ (value >> 63)) as u64);
    }

    fn whole(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_whole_numbers_beyond_those_of_doubles_are_kept_and_rows_that_do_not_fit_refused() {
        let path = std::env::temp_dir().join(format!("wingbeat-{}.parquet", std::process::id()));
        let columns = vec![("seed".to_owned(), Cells::Counts)];
        let mut table = ParquetWriter::create(&path, "points", columns).unwrap();
        let seed = (1_i64 << 53) + 1;
        table.cells([Cell::Count(seed)]).unwrap();
        assert!(table.cells([]).is_err());
        assert_eq!(table.columns[0], seed.to_le_bytes());
        assert!(table.cells([Cell::Count(1), Cell::Count(2)]).is_err());
        std::fs::remove_file(&path).unwrap();
    }

    #[test]
    fn behaves_booleans_are_bits_and_neither_is_left_out() {
        let mut rows = vec![1; 9];
        rows[2] = NEITHER;
        rows[4] = 0;
        let run = [2 << 1 | 1, 0b1111_1011, 0b1];
        let found = flags(&rows);
        assert_eq!(found, [&[3, 0, 0, 0][..], &run, &[0b1111_0111]].concat());
    }
}
