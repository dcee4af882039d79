//! What the words of a file say of each other, before its points and its case are looked at; the case that it varies.

use std::path::Path;

use wingbeat_case::{CaseError, Document, IoError, LoadedCase, nearest};

use crate::plan::Plan;
use crate::plan::cases::{overrides, set_of};
use crate::plan::places::Places;
use crate::plan::raw::{FileKind, RawCampaign, Task};

/// Ways to vary a parameter.
const WAYS: [&str; 8] = [
    "list",
    "range",
    "log_range",
    "latin_hypercube",
    "sobol",
    "uniform",
    "log_uniform",
    "normal",
];

/// Times per point at most [s].
const LONGEST: f64 = 1e9;

/// What an enum of tables cannot say clearly: one way to vary each.
///
/// # Errors
/// The first parameter that does not vary in one way.
pub fn shape(document: &Document) -> Result<(), IoError> {
    let Some(toml::Value::Table(parameters)) = document.table().get("parameter") else {
        return Ok(());
    };
    for (key, value) in parameters {
        let place = format!("parameter.{key}");
        let wrong = |place: &str, problem: String, remedy: &str| {
            let allowed = format!("one of {}", WAYS.join(", "));
            Err(document.fault(place, problem, allowed, remedy).into())
        };
        let Some(table) = value.as_table() else {
            let remedy = "for a fixed value use [set]; else `list = [...]`";
            return wrong(&place, "this says no way to vary".to_owned(), remedy);
        };
        let names: Vec<&str> = table.keys().map(String::as_str).collect();
        match names[..] {
            [way] if WAYS.contains(&way) => {}
            [way] => {
                let near = nearest(way, &WAYS).map(|n| format!("did you mean `{n}`?"));
                let quotes =
                    "a key with dots stands in quotes: [parameter.\"motion.frequency_hz\"]";
                let remedy = near.unwrap_or_else(|| quotes.to_owned());
                return wrong(
                    &format!("{place}.{way}"),
                    format!("unknown key `{way}`"),
                    &remedy,
                );
            }
            [] => {
                let remedy = "add `list = [...]`, for instance";
                return wrong(&place, "nothing says how this varies".to_owned(), remedy);
            }
            _ => {
                let ends = |n: &&str| ["from", "to", "count"].contains(n);
                let remedy = match names.iter().all(ends) {
                    true => "write `range = { from = ..., to = ..., count = ... }`",
                    false => "keep one of them",
                };
                let problem = format!("this varies in {} ways: {}", names.len(), names.join(", "));
                return wrong(&place, problem, remedy);
            }
        }
    }
    Ok(())
}

/// The words of a file.
pub struct Words<'a> {
    /// The file.
    pub document: &'a Document,
    /// What it says.
    pub raw: &'a RawCampaign,
}

impl Words<'_> {
    fn wrong<T>(
        &self,
        key: &str,
        problem: &str,
        allowed: &str,
        remedy: &str,
    ) -> Result<T, IoError> {
        let fault = self.document.fault(key, problem, allowed, remedy);
        Err(fault.into())
    }

    /// What the words of the file say of each other.
    ///
    /// # Errors
    /// The first that has no effect, or contradicts another.
    pub fn check(&self, name: &str) -> Result<(), IoError> {
        let raw = self.raw;
        if raw.format != 1 {
            return self.wrong(
                "format",
                "this version of the language is not known",
                "1",
                "write format = 1",
            );
        }
        let plain = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
        if name.is_empty() || name.len() > 100 || name.starts_with('.') || !name.chars().all(plain)
        {
            return self.wrong(
                "name",
                "the name becomes the name of a directory",
                "letters, digits, -, _, . and spaces, not beginning with a dot, at most 100 bytes",
                "choose a plain name",
            );
        }
        self.check_tasks()?;
        if raw.trim.is_some() && !raw.tasks.contains(&Task::Trim) {
            return self.wrong(
                "trim",
                "this has no effect: nothing is trimmed",
                "with do = [\"trim\", ...]",
                "add \"trim\" to do, or remove the table",
            );
        }
        if raw.mean_beats == Some(0) {
            return self.wrong(
                "mean_beats",
                "there is no mean over no wingbeat",
                "a whole number >= 1",
                "1, the default, takes the last wingbeat",
            );
        }
        self.check_files()?;
        self.check_budget()
    }

    /// Each task once, and after what it needs.
    fn check_tasks(&self) -> Result<(), IoError> {
        let raw = self.raw;
        if raw.tasks.is_empty() {
            return self.wrong(
                "do",
                "nothing is done",
                "run, trim, stability, power",
                "write do = [\"run\"], or leave it out",
            );
        }
        for (k, task) in raw.tasks.iter().enumerate() {
            let place = format!("do[{k}]");
            if raw.tasks[..k].contains(task) {
                return self.wrong(
                    &place,
                    "this is done twice",
                    "each task once",
                    "remove one of them",
                );
            }
            let needs_trim = matches!(task, Task::Stability | Task::Power);
            if needs_trim && !raw.tasks[..k].contains(&Task::Trim) {
                return self.wrong(
                    &place,
                    "this needs a trimmed flight",
                    "after trim",
                    "put \"trim\" before it",
                );
            }
        }
        Ok(())
    }

    /// Files are of flights, each kind once; what stays of them stays of something.
    fn check_files(&self) -> Result<(), IoError> {
        let raw = self.raw;
        let runs = raw.tasks.contains(&Task::Run);
        if !raw.files.is_empty() && !runs {
            return self.wrong(
                "files",
                "this has no effect: nothing is flown",
                "with do = [..., \"run\"]",
                "add \"run\" to do, or remove it",
            );
        }
        if let Some(k) = (1..raw.files.len()).find(|&k| raw.files[..k].contains(&raw.files[k])) {
            return self.wrong(
                &format!("files[{k}]"),
                "this is named twice",
                "each kind once",
                "remove one of them",
            );
        }
        if raw.retention.every == 0 {
            return self.wrong(
                "retention.every",
                "this must not be zero",
                "a whole number >= 1",
                "1 keeps the files of all points",
            );
        }
        if raw.retention.every > 1 && raw.files.is_empty() {
            return self.wrong(
                "retention.every",
                "this has no effect without files",
                "beside files = [...]",
                "remove it, or keep files",
            );
        }
        if raw.retention.failed && !runs {
            return self.wrong(
                "retention.failed",
                "this has no effect: nothing is flown",
                "with do = [..., \"run\"]",
                "remove it",
            );
        }
        self.check_output()
    }

    /// What is drawn follows from the files that are kept.
    fn check_output(&self) -> Result<(), IoError> {
        let raw = self.raw;
        for (key, kinds) in [
            ("output.page", FileKind::Page),
            ("output.figures", FileKind::Figures),
        ] {
            if raw.set.contains_key(key) {
                let remedy = match kinds {
                    FileKind::Page => "remove it; files = [\"page\"] keeps pages",
                    _ => "remove it; files = [\"figures\"] keeps figures",
                };
                return self.wrong(
                    &format!("set.{key}"),
                    "this has no effect: `files` says what is drawn",
                    "no key output.page or output.figures",
                    remedy,
                );
            }
        }
        Ok(())
    }

    /// Limits that can be kept.
    fn check_budget(&self) -> Result<(), IoError> {
        let raw = self.raw;
        let budget = &raw.budget;
        if !(1..=1000).contains(&budget.attempts) {
            return self.wrong(
                "budget.attempts",
                "a number of attempts out of range",
                "a whole number from 1 to 1000",
                "3 is the default",
            );
        }
        for (key, value) in [
            ("time_per_point_s", budget.time_per_point_s),
            ("disk_mb", budget.disk_mb),
        ] {
            if value.is_some_and(|x| x <= 0.0) {
                return self.wrong(
                    &format!("budget.{key}"),
                    "this must be positive",
                    "a number above 0",
                    "remove it for no limit",
                );
            }
        }
        if budget.time_per_point_s.is_some_and(|x| x > LONGEST) {
            return self.wrong(
                "budget.time_per_point_s",
                "this is longer than any flight takes",
                "a time above 0 s, at most 1e9 s",
                "remove it for no limit",
            );
        }
        Ok(())
    }

    /// The case that is varied, with what is set at all points; with the values of the first point of `plan` as
    /// well where it cannot be flown without them, as one whose chord is removed for an area that varies. Paths
    /// are relative to `folder`.
    ///
    /// # Errors
    /// No such case; a case that cannot be flown.
    pub fn base_case(&self, folder: &Path, plan: &Plan) -> Result<LoadedCase, IoError> {
        let file = folder.join(&self.raw.case);
        let name = match file.is_file() {
            true => file.display().to_string(),
            false => self.raw.case.clone(),
        };
        if name == "-" {
            return self.wrong(
                "case",
                "a campaign cannot read its case from the standard input",
                "a preset or a file",
                "name a file",
            );
        }
        let places = |axes| Places {
            document: self.document,
            raw: self.raw,
            axes,
        };
        let at_first = |alone: CaseError| {
            let found = LoadedCase::find(&name, &overrides(self.raw, plan, 0));
            // What is wrong without the values of a point, too, is no fault of theirs.
            let is_of_value = |e: &CaseError| {
                let varies = e.overridden.as_ref().is_some_and(|key| plan.varies(key));
                varies && (&e.key, &e.problem) != (&alone.key, &alone.problem)
            };
            match found {
                Err(IoError::Case(e)) if is_of_value(&e) => Err(places(&plan.axes).traced(*e)),
                Err(_) => Err(places(&[]).traced(alone)),
                found => found,
            }
        };
        match LoadedCase::find(&name, &set_of(self.raw)) {
            Err(e @ IoError::NoCase { .. }) => self.wrong(
                "case",
                &e.to_string(),
                "a preset, or a file beside this one",
                "correct the name",
            ),
            Err(IoError::Case(e)) => at_first(*e),
            found => found,
        }
    }
}
