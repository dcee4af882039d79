//! Numbers gathered column by column and written in blocks, so that files with one run of numbers
//! per column are written with the memory of a block.

/// Rows of a block.
const BLOCK: usize = 512;

/// A block of rows, column by column.
pub(super) struct Block<T> {
    columns: Vec<Vec<T>>,
    first: usize,
}

impl<T> Block<T> {
    pub fn new(columns: usize) -> Self {
        Self {
            columns: (0..columns).map(|_| vec![]).collect(),
            first: 0,
        }
    }

    /// Takes a row; a full block is handed to `write`: column, first row, numbers.
    pub fn row<E>(
        &mut self,
        row: impl IntoIterator<Item = T>,
        write: impl FnMut(usize, usize, &[T]) -> Result<(), E>,
    ) -> Result<(), E> {
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        match self.columns.first() {
            Some(first) if first.len() >= BLOCK => self.flush(write),
            _ => Ok(()),
        }
    }

    /// Hands over what is left.
    pub fn flush<E>(
        &mut self,
        mut write: impl FnMut(usize, usize, &[T]) -> Result<(), E>,
    ) -> Result<(), E> {
        let rows = self.columns.first().map_or(0, Vec::len);
        for (k, column) in self.columns.iter_mut().enumerate() {
            write(k, self.first, column)?;
            column.clear();
        }
        self.first += rows;
        Ok(())
    }
}
