//! The result that is exported.

use std::path::PathBuf;

use wingbeat_case::{IoError, LoadedCase};

use crate::series::columns::{Column, Columns};
use crate::series::rows::Rows;
use crate::snapshots::poses::Poses;
use crate::{Manifest, ResultDir};

/// A result that is exported.
pub(super) struct Source<'a> {
    pub dir: &'a ResultDir,
    pub case: LoadedCase,
    pub manifest: Manifest,
}

impl Source<'_> {
    pub fn history(&self) -> PathBuf {
        self.dir.join("history.csv")
    }

    pub fn rows(&self) -> Result<Rows, IoError> {
        Rows::open(&self.history())
    }

    /// What the columns of the history hold, in their order there.
    ///
    /// # Errors
    /// A history that cannot be read, or that another build wrote.
    pub fn columns(&self) -> Result<Vec<Column>, IoError> {
        let rows = self.rows()?;
        let all = Columns::in_file(&self.history(), &self.case.setup, rows.names())?;
        Ok(all.iter().cloned().collect())
    }

    /// Rows of the history; none is an error.
    pub fn row_count(&self) -> Result<usize, IoError> {
        match Rows::count(&self.history())? {
            0 => Err(self.damaged("there is no whole row in this history yet")),
            count => Ok(count),
        }
    }

    pub fn poses(&self, names: &[String]) -> Result<Poses, IoError> {
        let poses = Poses::new(&self.case.setup.animal, names);
        poses.ok_or_else(|| self.damaged("this history belongs to another animal than case.toml"))
    }

    pub fn damaged(&self, problem: &str) -> IoError {
        IoError::Damaged {
            path: self.history(),
            problem: problem.to_owned(),
        }
    }
}
