//! Errors a user meets: in a case (with file, line, key, value, what is allowed, what to try) and
//! around result directories.

use std::ops::Range;
use std::path::{Path, PathBuf};

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// A fault found while a case is turned into a setup, before it is traced to its line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    /// Path of the key, e.g. `wing.right.mass_kg`.
    pub key: String,
    /// What is wrong.
    pub problem: String,
    /// What is allowed.
    pub allowed: String,
    /// What to try.
    pub remedy: String,
}

impl Fault {
    /// A fault at `key`.
    pub fn new(
        key: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            key: key.into(),
            problem: problem.into(),
            allowed: allowed.into(),
            remedy: remedy.into(),
        }
    }

    /// A key that has to be there and is not.
    pub fn missing(
        key: impl Into<String>,
        allowed: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::new(key, "this key is missing", allowed, remedy)
    }
}

/// Something in a case that cannot be flown.
///
/// Its `Display` is the whole report: key, file with line and column, the line itself, what is
/// allowed and what to try.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseError {
    /// The case file (or preset), or the key that was set on top of it when the value came from there.
    pub origin: String,
    /// Line in the file, counted from 1; `None` when the value came from the command line or a
    /// key is missing from the whole file.
    pub line: Option<usize>,
    /// Column of the value, counted from 1.
    pub column: Option<usize>,
    /// Path of the key.
    pub key: String,
    /// The value as it was written, if there is one.
    pub value: Option<String>,
    /// The key that was set on top of the case and caused this: `key`, one around it or one inside it; `None` where the
    /// case itself did.
    pub overridden: Option<String>,
    /// What is wrong.
    pub problem: String,
    /// What is allowed.
    pub allowed: String,
    /// What to try.
    pub remedy: String,
    /// The text of the case and the bytes to underline.
    pub(crate) excerpt: Option<(String, Range<usize>)>,
}

impl std::error::Error for CaseError {}

impl std::fmt::Display for CaseError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let title = self.title();
        let mut group = match &self.excerpt {
            Some((text, span)) => {
                let mark = AnnotationKind::Primary.span(span.clone());
                let snippet = Snippet::source(text.as_str())
                    .path(self.origin.as_str())
                    .annotation(mark);
                Level::ERROR.primary_title(title.as_str()).element(snippet)
            }
            None => Level::ERROR
                .primary_title(title.as_str())
                .element(Level::NOTE.message(format!("in {}", self.origin))),
        };
        if !self.allowed.is_empty() {
            group = group.element(Level::NOTE.message(format!("allowed: {}", self.allowed)));
        }
        if !self.remedy.is_empty() {
            group = group.element(Level::HELP.message(format!("try: {}", self.remedy)));
        }
        f.write_str(&Renderer::plain().render(&[group]))
    }
}

impl CaseError {
    fn title(&self) -> String {
        match (&self.key[..], &self.value) {
            ("", _) => self.problem.clone(),
            (key, Some(value)) => format!("{key} = {value}: {}", self.problem),
            (key, None) => format!("{key}: {}", self.problem),
        }
    }
}

/// Anything that can go wrong between a case file and a result directory.
#[derive(Debug, thiserror::Error)]
pub enum IoError {
    /// The case cannot be flown.
    #[error("{0}")]
    Case(#[from] Box<CaseError>),
    /// Something made in Rust that no key of a case says.
    #[error("no case gives this flight, as it has no keys for its {part}: {problem}; {remedy}")]
    NoKeys {
        /// Which part of the flight.
        part: String,
        /// Why it has no keys.
        problem: String,
        /// What to try.
        remedy: &'static str,
    },
    /// A preset that does not exist.
    #[error(
        "there is no case file and no preset called `{name}`{hint}; `wingbeat presets` lists the presets"
    )]
    NoCase {
        /// What was asked for.
        name: String,
        /// The nearest name, as a clause, or nothing.
        hint: String,
    },
    /// A species that is not known.
    #[error("there is no species called `{name}`{hint}; known are {known}")]
    NoSpecies {
        /// What was asked for.
        name: String,
        /// The nearest name, as a clause, or nothing.
        hint: String,
        /// All names.
        known: String,
    },
    /// An insect that cannot hover, or is not given.
    #[error("{problem}; {remedy}")]
    Insect {
        /// What is wrong.
        problem: String,
        /// What to try.
        remedy: String,
    },
    /// A file or directory that exists already and is not overwritten.
    #[error("`{}` exists already and is left untouched; {remedy}", path.display())]
    Exists {
        /// The path.
        path: PathBuf,
        /// What to do.
        remedy: &'static str,
    },
    /// A name that belongs to a file of a result directory.
    #[error("`{}` is the place of a file of a run and is left untouched; name a file outside the result directory", path.display())]
    Reserved {
        /// The path.
        path: PathBuf,
    },
    /// A file that cannot be read or written.
    #[error("cannot {action} `{}`: {source}; {remedy}", path.display())]
    File {
        /// What was attempted.
        action: &'static str,
        /// The path.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
        /// What to do.
        remedy: &'static str,
    },
    /// A figure that cannot be drawn.
    #[error("`{}` cannot be drawn: {problem}", path.display())]
    Figure {
        /// The file.
        path: PathBuf,
        /// What the drawing library says.
        problem: String,
    },
    /// A run that another process is writing.
    #[error(
        "`{}`: another wingbeat is writing it right now; wait for it or end it",
        path.display()
    )]
    Busy {
        /// Its history.
        path: PathBuf,
    },
    /// A file of a result directory that is damaged or foreign.
    #[error("`{}`: {problem}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
}

impl From<CaseError> for IoError {
    fn from(e: CaseError) -> Self {
        Self::Case(Box::new(e))
    }
}

impl IoError {
    /// A failed write of `path`.
    pub fn write(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::File {
            action: "write",
            path: path.to_owned(),
            source,
            remedy: "choose a directory you may write to, or free some space",
        }
    }

    /// A failed read of `path`.
    pub fn read(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::File {
            action: "read",
            path: path.to_owned(),
            remedy: match source.kind() {
                std::io::ErrorKind::InvalidData => "save it as a text in UTF-8",
                _ => "check the name and the permissions",
            },
            source,
        }
    }
}
