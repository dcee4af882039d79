//! A history read back as the records that were written, one after the other.

use std::path::Path;

use wingbeat_flight::{FlightSetup, Record};

use crate::series::columns::Columns;
use crate::series::rows::Rows;
use wingbeat_case::IoError;

/// The records of an open history.
pub struct Records {
    rows: Rows,
    columns: Columns,
    record: Record,
}

impl Records {
    /// Opens the history of a flight.
    ///
    /// # Errors
    /// A file that cannot be read or is not a history; other columns than those that this build writes of the flight.
    pub fn open(path: &Path, setup: &FlightSetup) -> Result<Self, IoError> {
        let rows = Rows::open(path)?;
        let columns = Columns::in_file(path, setup, rows.names())?;
        Ok(Self {
            record: columns.blank(),
            rows,
            columns,
        })
    }

    /// The next record; none at the end. A last row that was cut by a kill is left out.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn next_record(&mut self) -> Result<Option<&Record>, IoError> {
        let Some(row) = self.rows.next_row()? else {
            return Ok(None);
        };
        for (k, value) in row.iter().enumerate() {
            self.columns.put(k, *value, &mut self.record);
        }
        Ok(Some(&self.record))
    }

    /// Passes over the next `count` records.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn skip(&mut self, count: usize) -> Result<(), IoError> {
        for _ in 0..count {
            if self.next_record()?.is_none() {
                break;
            }
        }
        Ok(())
    }
}
