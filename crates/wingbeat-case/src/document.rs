//! A file of another language than that of cases, written and refused in the same way: TOML whose faults are
//! found with their line.

use std::path::Path;

use serde::de::DeserializeOwned;
use toml::Value;

use crate::decode;
use crate::error::{CaseError, Fault, IoError};
use crate::files;
use crate::text::source::{CaseSource, START};

/// Values longer than this are not shown beside their key \[bytes\].
const LONGEST_VALUE: usize = 60;

/// A TOML file and where each of its keys stands.
///
/// ```
/// use wingbeat_case::Document;
/// let file = Document::new("study.toml", "seed = 1\nsample = 5\n", "")?;
/// #[derive(serde::Deserialize, Debug)]
/// #[serde(deny_unknown_fields)]
/// struct Study { seed: u64, samples: u64 }
/// let error = file.decode::<Study>().expect_err("a slip").to_string();
/// assert!(error.contains("study.toml:2:1") && error.contains("did you mean `samples`?"));
/// # Ok::<(), wingbeat_case::IoError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Document {
    source: CaseSource,
}

impl Document {
    /// Of a text; `origin` names it in messages, `remedy` says what to try where it is not TOML.
    ///
    /// # Errors
    /// Broken TOML; a number that is not finite.
    pub fn new(origin: &str, text: &str, remedy: &str) -> Result<Self, IoError> {
        let source = CaseSource::new(origin, text, &[]).map_err(|mut e| {
            if e.key.is_empty() && e.remedy == START {
                remedy.clone_into(&mut e.remedy);
            }
            e
        })?;
        Ok(Self { source })
    }

    /// Of a file.
    ///
    /// # Errors
    /// A file that cannot be read; as [`Self::new`].
    pub fn read(path: &Path, remedy: &str) -> Result<Self, IoError> {
        Self::new(&path.display().to_string(), &files::text_of(path)?, remedy)
    }

    /// Decodes it.
    ///
    /// # Errors
    /// Unknown keys, missing keys, wrong types, each with its line.
    pub fn decode<T: DeserializeOwned>(&self) -> Result<T, IoError> {
        decode::decode(&self.source).map_err(|e| self.with_value(*e).into())
    }

    /// What is wrong at a key, with its line.
    pub fn fault(
        &self,
        key: &str,
        problem: impl Into<String>,
        allowed: impl Into<String>,
        remedy: impl Into<String>,
    ) -> CaseError {
        let fault = Fault::new(key, problem, allowed, remedy);
        self.with_value(self.source.locate(fault))
    }

    /// The value as it was written, also at keys with dots in their names.
    fn with_value(&self, mut error: CaseError) -> CaseError {
        if error.value.is_none() {
            let written = self.source.written(&error.key);
            // Not the heading of a table, which stands for what is below it.
            let is_value = |v: &&str| format!("value = {v}").parse::<toml::Table>().is_ok();
            let short = |v: &&str| !v.contains('\n') && v.len() <= LONGEST_VALUE;
            let written = written.filter(short).filter(is_value);
            error.value = written.map(str::to_owned);
        }
        error
    }

    /// The names in the table at the top that is called `name`, in the order of the file.
    pub fn names(&self, name: &str) -> Vec<String> {
        match self.source.table.get(name) {
            Some(Value::Table(table)) => table.keys().cloned().collect(),
            _ => vec![],
        }
    }

    /// All of it.
    pub fn table(&self) -> &toml::Table {
        &self.source.table
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// What it is called in messages.
    pub fn origin(&self) -> &str {
        &self.source.name
    }
}

/// The text of a case with `overrides` (`KEY=VALUE`) put into it, not checked as a case.
///
/// # Errors
/// Broken TOML or a broken override.
pub fn overridden(origin: &str, text: &str, overrides: &[String]) -> Result<String, IoError> {
    let source = CaseSource::new(origin, text, overrides)?;
    Ok(toml::to_string(&source.table).expect("a table is TOML"))
}
