//! What an analysis has to say: words for people or one JSON object, on the standard output or in
//! a file.

use std::fmt::{Arguments, Write};
use std::path::PathBuf;

use clap::Args;
use serde_json::{Map, Value};
use wingbeat::case::{IoError, shell_path};
use wingbeat::results::Summary;
use wingbeat::results::file::Existing;

use crate::command::output::failure::Failure;
use crate::command::output::target::{self, Target};
use crate::command::output::terminal;

/// Heading of these options in the help.
const HEADING: &str = "Report";

/// Where a report goes and in which form.
#[derive(Args)]
pub(crate) struct ReportArgs {
    /// As one JSON object; units in the names.
    #[arg(long, help_heading = HEADING)]
    json: bool,
    /// Write the report to a file instead of the terminal; - is the standard output.
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    out: Option<PathBuf>,
    /// Replace files that exist already.
    #[arg(long, help_heading = HEADING)]
    overwrite: bool,
}

/// A report in the making.
pub(crate) struct Report {
    json: bool,
    place: Place,
    text: String,
    values: Map<String, Value>,
}

/// Where a report goes.
enum Place {
    /// The standard output, word by word.
    Output,
    /// The standard error: the standard output is taken by another text of the command.
    Error,
    /// A file, at the end.
    File(Target),
}

/// A paragraph or line of a report, as `println!`.
macro_rules! line {
    ($report:expr, $($text:tt)*) => {
        $report.words(format_args!("{}\n", format_args!($($text)*)))
    };
}

/// A line of a report that begins with what it is of, in a column of its own.
macro_rules! entry {
    ($report:expr, $of:literal, $($text:tt)*) => {
        $crate::command::output::report::line!($report, "{:<10}{}", $of, format_args!($($text)*))
    };
}

pub(crate) use {entry, line};

impl ReportArgs {
    /// Runs an analysis and delivers what it reported, also where it failed midway. `others` are
    /// further files it writes: all are claimed before the work begins.
    pub(crate) fn deliver<const N: usize>(
        &self,
        others: [&Option<PathBuf>; N],
        analysis: impl FnOnce(&mut Report, [Option<Target>; N]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let place = self.place(&others)?;
        let existing = Existing::kept_unless(self.overwrite);
        let claim = |path: &PathBuf| Target::claim(path, existing);
        let mut files = [const { None }; N];
        for (file, path) in files.iter_mut().zip(others) {
            *file = path.as_ref().map(claim).transpose()?;
        }
        let mut report = Report {
            json: self.json,
            place,
            text: String::new(),
            values: Map::new(),
        };
        let outcome = analysis(&mut report, files);
        report.finish()?;
        outcome
    }

    /// Where the report goes beside the `others`: what is named `-` has the standard output for itself.
    fn place(&self, others: &[&Option<PathBuf>]) -> Result<Place, Failure> {
        let refused = |problem: &str| Err(Failure::Option(problem.to_owned()));
        let is_output = |path: &&PathBuf| Target::is_output(path);
        let named: Vec<&PathBuf> = others
            .iter()
            .copied()
            .chain([&self.out])
            .flatten()
            .collect();
        if self.overwrite && named.iter().all(is_output) {
            return refused("--overwrite replaces nothing: no file is named to write");
        }
        let files = named.iter().filter(|p| !is_output(p));
        let files: Vec<PathBuf> = files.map(|p| target::place_of(p)).collect();
        if (1..files.len()).any(|k| files[..k].contains(&files[k])) {
            return refused("two texts cannot share a file; name one for each");
        }
        let taken = others.iter().copied().flatten().filter(is_output).count();
        let reports_there = self.out.as_ref().map_or(self.json, |p| is_output(&p));
        if taken + usize::from(reports_there) > 1 {
            return refused(
                "two texts cannot share the standard output; name files for all but one of them, the report with --out FILE",
            );
        }
        match &self.out {
            Some(path) if !is_output(&path) => {
                let existing = Existing::kept_unless(self.overwrite);
                Ok(Place::File(Target::claim(path, existing)?))
            }
            None if taken > 0 => Ok(Place::Error),
            _ => Ok(Place::Output),
        }
    }
}

impl Report {
    /// Words for people; on the terminal they are said at once.
    pub(crate) fn words(&mut self, words: Arguments<'_>) {
        match (self.json, &self.place) {
            (true, _) => {}
            (false, Place::Output) => terminal::words(words),
            (false, Place::Error) => terminal::errors(words),
            (false, Place::File(_)) => {
                let _ = self.text.write_fmt(words); // a string takes everything
            }
        }
    }

    /// Whether words are said as they come, and not in one piece at the end.
    pub(crate) fn is_said_at_once(&self) -> bool {
        !self.json && !matches!(self.place, Place::File(_))
    }

    /// A value for programs.
    pub(crate) fn value(&mut self, name: &str, value: impl Into<Value>) {
        self.values.insert(name.to_owned(), value.into());
    }

    /// A summary, its verdict in colour where it is said on a terminal that shows colours.
    pub(crate) fn summary(&mut self, summary: &Summary) {
        let text = match self.place {
            Place::Output => terminal::judged(summary),
            Place::Error | Place::File(_) => summary.to_text(),
        };
        self.words(format_args!("{text}"));
    }

    /// Says that a case was written, where it went to a file.
    pub(crate) fn wrote(&mut self, case: &Target) {
        if let Some(path) = case.path() {
            let command = format!("wingbeat run {}", shell_path(path));
            line!(self, "\nwrote {}; fly it with `{command}`", path.display());
        }
    }

    /// Says that a figure was written, where it went to a file.
    pub(crate) fn drew(&mut self, figure: &Target) {
        if let Some(path) = figure.path() {
            line!(self, "\nwrote {}", path.display());
        }
    }

    fn finish(mut self) -> Result<(), IoError> {
        if self.json && !self.values.is_empty() {
            self.text = format!("{}\n", Value::Object(self.values));
        }
        match self.place {
            _ if self.text.is_empty() => Ok(()),
            Place::File(file) => file.write(&self.text),
            Place::Output | Place::Error => {
                terminal::output(format_args!("{}", self.text));
                Ok(())
            }
        }
    }
}
