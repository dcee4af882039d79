//! What an analysis has to say: words for people or one JSON object, on the standard output or in
//! a file.

use std::fmt::{Arguments, Write};
use std::path::PathBuf;

use clap::Args;
use serde_json::{Map, Value};
use wingbeat::case::IoError;
use wingbeat::results::file::NewFile;

use crate::command::failure::Failure;
use crate::command::terminal;

/// Heading of these options in the help.
const HEADING: &str = "Report";

/// Where a report goes and in which form.
#[derive(Args)]
pub(crate) struct ReportArgs {
    /// As one JSON object; units in the names.
    #[arg(long, help_heading = HEADING)]
    json: bool,
    /// Write the report to a file instead of the terminal.
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    out: Option<PathBuf>,
    /// Replace files that exist already.
    #[arg(long, help_heading = HEADING)]
    overwrite: bool,
}

/// A report in the making.
pub(crate) struct Report {
    json: bool,
    file: Option<NewFile>,
    text: String,
    values: Map<String, Value>,
}

/// A paragraph or line of a report, as `println!`.
macro_rules! line {
    ($report:expr, $($text:tt)*) => {
        $report.words(format_args!("{}\n", format_args!($($text)*)))
    };
}

pub(crate) use line;

impl ReportArgs {
    /// Runs an analysis and delivers what it reported, also where it failed midway. `others` are
    /// further files it writes: all are claimed before the work begins.
    pub(crate) fn deliver<const N: usize>(
        &self,
        others: [&Option<PathBuf>; N],
        analysis: impl FnOnce(&mut Report, [Option<NewFile>; N]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let named = self.out.is_some() || others.iter().any(|f| f.is_some());
        if self.overwrite && !named {
            let problem = "--overwrite replaces nothing: no file is named to write";
            return Err(Failure::Option(problem.to_owned()));
        }
        let claim = |path: &Option<PathBuf>| -> Result<Option<NewFile>, IoError> {
            let claimed = path.as_ref().map(|p| NewFile::claim(p, self.overwrite));
            claimed.transpose()
        };
        let mut files = [const { None }; N];
        for (file, path) in files.iter_mut().zip(others) {
            *file = claim(path)?;
        }
        let mut report = Report {
            json: self.json,
            file: claim(&self.out)?,
            text: String::new(),
            values: Map::new(),
        };
        let outcome = analysis(&mut report, files);
        report.finish()?;
        outcome
    }
}

impl Report {
    /// Words for people; on the terminal they are said at once.
    pub(crate) fn words(&mut self, words: Arguments<'_>) {
        match (self.json, &self.file) {
            (true, _) => {}
            (false, None) => terminal::output(words),
            (false, Some(_)) => {
                let _ = self.text.write_fmt(words); // a string takes everything
            }
        }
    }

    /// A value for programs.
    pub(crate) fn value(&mut self, name: &str, value: impl Into<Value>) {
        self.values.insert(name.to_owned(), value.into());
    }

    fn finish(mut self) -> Result<(), IoError> {
        if self.json && !self.values.is_empty() {
            self.text = format!("{}\n", Value::Object(self.values));
        }
        match self.file {
            Some(file) if !self.text.is_empty() => file.write(self.text.as_bytes()),
            Some(_) => Ok(()),
            None => {
                terminal::output(format_args!("{}", self.text));
                Ok(())
            }
        }
    }
}
