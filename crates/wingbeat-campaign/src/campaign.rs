//! A campaign: its file read and checked, its points with their cases and hashes.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_analysis::AnalysisError;
use wingbeat_case::{CaseError, Document, IoError, LoadedCase, nearest};
use wingbeat_flight::FlightSetup;

use crate::axes::Reader;
use crate::number::{self, Number, Of, Source};
use crate::plan::Plan;
use crate::raw::TrimOptions;
use crate::raw::{FileKind, RawCampaign, Task};
use crate::trimming::{self, TRIM};

/// Seconds of a block of points that a worker takes at once.
const BLOCK_S: f64 = 0.5;
/// Points of a block at most.
const MAX_BLOCK: usize = 64;
/// Blocks that a campaign has at least, so that workers end together.
const MIN_BLOCKS: usize = 64;
/// Rough seconds of a step in blade elements, and of a trim or the modes of one.
const STEP_S: f64 = 15e-6;
const ANALYSIS_S: f64 = 0.3;
/// Values of an axis that are tried before anything is flown.
const TRIED: usize = 20;

/// A campaign, read and checked.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// Its name.
    pub name: String,
    /// The file.
    pub path: PathBuf,
    /// As it was written.
    pub raw: RawCampaign,
    /// Its points.
    pub plan: Plan,
    /// The numbers that are kept.
    pub numbers: Vec<Number>,
    /// The case without the values of a point.
    pub base: LoadedCase,
    /// Points of a block, which a worker takes at once.
    pub block: usize,
    document: Document,
    folder: PathBuf,
    /// Of everything but the values of the point.
    digest: Sha256,
}

impl Campaign {
    /// Reads the file of a campaign and checks it, as far as that goes without flying.
    ///
    /// # Errors
    /// The first thing in it that cannot be done, with its line.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        let remedy = "docs/campaigns.md has campaigns to start from";
        Self::of(path, Document::read(path, remedy)?)
    }

    fn of(path: &Path, document: Document) -> Result<Self, IoError> {
        check_shape(&document)?;
        let raw: RawCampaign = document.decode()?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let stem = path.file_stem().and_then(|s| s.to_str());
        let name = raw.name.clone();
        let name = name.unwrap_or_else(|| stem.unwrap_or("campaign").to_owned());
        check_words(&document, &raw, &name)?;
        let reader = Reader {
            document: &document,
            folder: &folder,
        };
        let plan = reader.plan(&raw)?;
        let base = base_case(&document, &raw, &folder)?;
        let mut campaign = Self {
            name,
            path: path.to_owned(),
            numbers: vec![],
            block: 1,
            digest: Sha256::new(),
            folder,
            raw,
            plan,
            base,
            document,
        };
        campaign.check_points()?;
        campaign.numbers = campaign.kept()?;
        campaign.digest = campaign.digest_of();
        campaign.block = campaign.points_of_block();
        Ok(campaign)
    }

    /// What is wrong at a key of the file.
    pub(crate) fn fault(&self, key: &str, problem: String, allowed: &str, remedy: &str) -> IoError {
        self.document.fault(key, problem, allowed, remedy).into()
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        self.document.text()
    }

    /// What is put on top of the case at point `i`, without the options of the trim.
    pub fn overrides(&self, i: usize) -> Vec<String> {
        let of_point = self.plan.overrides(i).into_iter();
        let of_case = of_point.filter(|o| !o.starts_with(TRIM));
        set_of(&self.raw).into_iter().chain(of_case).collect()
    }

    /// The case of point `i`, with `more` put on top.
    ///
    /// # Errors
    /// A case that cannot be flown.
    pub fn case(&self, i: usize, more: &[String]) -> Result<LoadedCase, IoError> {
        self.case_with(&[&self.overrides(i)[..], more].concat())
    }

    fn case_with(&self, overrides: &[String]) -> Result<LoadedCase, IoError> {
        let (origin, text) = (self.base.origin(), self.base.text());
        LoadedCase::from_text(origin, text, &self.case_folder(), overrides)
    }

    /// The text of the case of point `i`.
    ///
    /// # Errors
    /// A key that cannot be put into it.
    pub fn case_text(&self, i: usize) -> Result<String, IoError> {
        wingbeat_case::overridden(self.base.origin(), self.base.text(), &self.overrides(i))
    }

    /// The folder that paths in the case are relative to.
    fn case_folder(&self) -> PathBuf {
        let file = self.folder.join(&self.raw.case);
        match file.is_file() {
            true => file.parent().map(Path::to_owned).unwrap_or_default(),
            false => PathBuf::new(),
        }
    }

    /// SHA-256 of what is done at point `i`: version, case, tasks, numbers that are kept, values of the point.
    pub fn hash(&self, i: usize) -> [u8; 32] {
        let mut hash = self.digest.clone();
        for line in self.plan.overrides(i) {
            hash.update(line);
            hash.update(b"\n");
        }
        hash.finalize().into()
    }

    /// What all points have in common.
    fn digest_of(&self) -> Sha256 {
        let raw = &self.raw;
        let mut hash =
            Sha256::new_with_prefix(concat!("wingbeat ", env!("CARGO_PKG_VERSION"), "\n"));
        let case = Sha256::digest(self.base.resolved());
        hash.update(case);
        hash.update(Sha256::digest(self.base.text()));
        let tasks = (
            &raw.tasks,
            &raw.trim,
            &raw.keep,
            raw.mean_beats.unwrap_or(1),
        );
        let files = (&raw.files, &raw.retention, &raw.set);
        hash.update(format!("{tasks:?} {files:?}\n"));
        hash
    }

    /// SHA-256 of the whole plan, which blocks of points belong to.
    pub fn plan_hash(&self) -> [u8; 32] {
        let mut hash = self.digest.clone();
        let varied = (
            &self.raw.parameter,
            &self.raw.zip,
            self.plan.samples,
            self.raw.seed,
        );
        hash.update(format!("{varied:?} {}\n", self.block));
        if let Some(axis) = self.plan.axes.iter().find(|a| a.place == "table") {
            hash.update(format!("{axis:?}"));
        }
        hash.finalize().into()
    }

    /// Whether point `i` has a result directory of its own while it is flown: it keeps files, or its air has a memory
    /// and takes long.
    pub fn has_directory(&self, i: usize, setup: &FlightSetup) -> bool {
        let runs = self.raw.tasks.contains(&Task::Run);
        runs && (self.keeps_files(i) || setup.air.has_memory())
    }

    /// Whether files of point `i` are kept.
    pub fn keeps_files(&self, i: usize) -> bool {
        !self.raw.files.is_empty() && i.is_multiple_of(self.raw.retention.every)
    }

    /// Points that a worker takes at once: half a second of them, by a rough estimate that is the same everywhere.
    fn points_of_block(&self) -> usize {
        let raw = &self.raw;
        let flies_long = self.base.setup.air.has_memory() || !raw.files.is_empty();
        if flies_long && raw.tasks.contains(&Task::Run) {
            return 1;
        }
        let of = |task: &Task| match task {
            Task::Run => self.base.setup.time.steps as f64 * STEP_S,
            Task::Trim | Task::Stability => ANALYSIS_S,
            Task::Power => 0.0,
        };
        let cost: f64 = raw.tasks.iter().map(of).sum();
        let by_time = (BLOCK_S / cost.max(1e-9)) as usize;
        by_time
            .clamp(1, MAX_BLOCK)
            .min((self.plan.points() / MIN_BLOCKS).max(1))
    }

    /// The registry of numbers of this case.
    ///
    /// # Errors
    /// Joints that cannot be assembled.
    pub fn registry(&self) -> Result<Vec<Number>, AnalysisError> {
        number::registry(&self.base.setup)
    }

    /// The numbers that are kept.
    fn kept(&self) -> Result<Vec<Number>, IoError> {
        let all = self.registry().map_err(|e| {
            self.fault(
                "case",
                e.to_string(),
                "a case that can be flown",
                "correct the case",
            )
        })?;
        let mut kept: Vec<Number> = vec![];
        for (k, name) in self.raw.keep.iter().enumerate() {
            let place = format!("keep[{k}]");
            let number = number::find(&all, name).map_err(|remedy| {
                let problem = format!("there is no number called `{name}`");
                self.fault(&place, problem, "a column of the history, lift_over_weight, power_watt, efficiency, summary.*, trim.*, stability.*, power.*", &remedy)
            })?;
            if kept.iter().any(|n| n.name == number.name) {
                let problem = format!("`{name}` is kept twice");
                return Err(self.fault(&place, problem, "each number once", "remove one"));
            }
            self.check_number(&place, &number)?;
            kept.push(number);
        }
        let means = kept.iter().any(|n| n.source.is_mean());
        if self.raw.mean_beats.is_some() && !means {
            let problem = "this has no effect: no mean over wingbeats is kept".to_owned();
            return Err(self.fault("mean_beats", problem, "beside a mean in keep", "remove it"));
        }
        Ok(kept)
    }

    fn check_number(&self, place: &str, number: &Number) -> Result<(), IoError> {
        let task = number.source.task();
        if !self.raw.tasks.contains(&task) {
            let problem = format!(
                "`{}` is a number of `{}`, which is not done",
                number.name,
                task.name()
            );
            let remedy = format!("add \"{}\" to do, or remove the number", task.name());
            return Err(self.fault(place, problem, "numbers of what is done", &remedy));
        }
        let thinned = self.base.output.history_every > 1;
        if thinned
            && matches!(
                number.source,
                Source::Column(Of::Mean | Of::Min | Of::Max, _)
            )
        {
            let problem = "the history of this case leaves steps out, which means and extremes of its columns need".to_owned();
            return Err(self.fault(
                place,
                problem,
                "with output.history_every = 1",
                "add `\"output.history_every\" = 1` to [set]",
            ));
        }
        Ok(())
    }

    /// Tries the case with the values of every axis, up to twenty of each, and what is drawn first.
    fn check_points(&self) -> Result<(), IoError> {
        trimming::check(&self.document, &self.raw, &self.base.setup)?;
        self.check_options()?;
        let mut block = 1;
        for axis in self.plan.axes.iter().rev() {
            let stride = (axis.len() / TRIED).max(1);
            for at in (0..axis.len()).step_by(stride).chain([axis.len() - 1]) {
                self.check_point(at * block * self.plan.samples)?;
            }
            block *= axis.len();
        }
        self.check_point(0)
    }

    fn check_point(&self, i: usize) -> Result<(), IoError> {
        self.trim_options(i)?;
        let overrides = self.overrides(i);
        match self.case_with(&overrides) {
            Ok(_) => Ok(()),
            Err(IoError::Case(e)) => Err(self.traced(*e, &overrides)),
            Err(e) => Err(e),
        }
    }

    /// What is asked of the trim at point `i`; nothing where nothing is trimmed.
    ///
    /// # Errors
    /// A value that cannot be used.
    pub fn trim_options(&self, i: usize) -> Result<Option<TrimOptions>, IoError> {
        if !self.raw.tasks.contains(&Task::Trim) {
            return Ok(None);
        }
        let found = trimming::options(&self.raw, &self.plan, i);
        found.map(Some).map_err(|bad| {
            let place = match self.plan.keys().contains(&bad.key) {
                true => self.place_of(&bad.key),
                false => bad.key,
            };
            self.fault(&place, bad.problem, bad.allowed, bad.remedy)
        })
    }

    /// A fault of a value that a point puts on top of the case, traced to the line of this file.
    fn traced(&self, e: CaseError, overrides: &[String]) -> IoError {
        let by = overrides
            .iter()
            .find(|o| e.origin.starts_with(&format!("{o} (set on top of")));
        let key = by
            .and_then(|o| o.split_once('='))
            .map(|(key, _)| key.to_owned());
        let Some(key) = key else { return e.into() };
        let problem = match e.key.is_empty() || e.key == key {
            true => format!(
                "{} = {}: {}",
                key,
                e.value.clone().unwrap_or_default(),
                e.problem
            ),
            false => format!("{}: {}", e.key, e.problem),
        };
        self.fault(&self.place_of(&key), problem, &e.allowed, &e.remedy)
    }

    /// Where a varied or set key stands in the file.
    pub(crate) fn place_of(&self, key: &str) -> String {
        let axis = self
            .plan
            .axes
            .iter()
            .find(|a| a.keys.iter().any(|k| k == key));
        match axis {
            Some(axis) if axis.place == "table" => axis.place.clone(),
            Some(axis) if axis.place.starts_with("zip") => format!("{}.{key}", axis.place),
            None if self.raw.set.contains_key(key) => format!("set.{key}"),
            _ => format!("parameter.{key}"),
        }
    }

    /// Options of the trim that vary are options of a trim.
    fn check_options(&self) -> Result<(), IoError> {
        let set = self.raw.set.keys().find(|k| k.starts_with(TRIM));
        if let Some(key) = set {
            let problem = "this is an option of the trim, no key of the case".to_owned();
            return Err(self.fault(
                &format!("set.{key}"),
                problem,
                "keys of the case",
                "put it into [trim]",
            ));
        }
        for key in self.plan.keys().iter().filter(|k| k.starts_with(TRIM)) {
            let place = self.place_of(key);
            let name = &key[TRIM.len()..];
            if !self.raw.tasks.contains(&Task::Trim) {
                let problem = "this has no effect: nothing is trimmed".to_owned();
                return Err(self.fault(
                    &place,
                    problem,
                    "with do = [\"trim\", ...]",
                    "add \"trim\" to do, or remove it",
                ));
            }
            if !trimming::OPTIONS.contains(&name) {
                let problem = format!("unknown option `{name}` of the trim");
                let near =
                    nearest(name, &trimming::OPTIONS).map(|n| format!("did you mean `trim.{n}`?"));
                let remedy = near.unwrap_or_else(|| "use one of these".to_owned());
                return Err(self.fault(&place, problem, &trimming::OPTIONS.join(", "), &remedy));
            }
        }
        Ok(())
    }
}

/// Keys of `[set]` as overrides, and what of the output is not kept.
fn set_of(raw: &RawCampaign) -> Vec<String> {
    raw.set
        .iter()
        .map(|(key, value)| format!("{key}={value}"))
        .collect()
}

/// What an enum of tables cannot say clearly: one kind of variation each.
fn check_shape(document: &Document) -> Result<(), IoError> {
    let Some(toml::Value::Table(parameters)) = document.table().get("parameter") else {
        return Ok(());
    };
    for (key, value) in parameters {
        let place = format!("parameter.{key}");
        let kinds =
            "one of list, range, log_range, latin_hypercube, sobol, uniform, log_uniform, normal";
        let wrong = |problem: String, remedy: &str| {
            Err(document.fault(&place, problem, kinds, remedy).into())
        };
        match value {
            toml::Value::Table(table) if table.len() == 1 => {}
            toml::Value::Table(table) if table.is_empty() => {
                return wrong(
                    "nothing says how this varies".to_owned(),
                    "add `list = [...]`, for instance",
                );
            }
            toml::Value::Table(table) => {
                let names: Vec<&str> = table.keys().map(String::as_str).collect();
                let remedy = match names.iter().all(|n| ["from", "to", "count"].contains(n)) {
                    true => "write `range = { from = ..., to = ..., count = ... }`",
                    false => {
                        "keep one of them; a key with dots stands in quotes: [parameter.\"motion.frequency_hz\"]"
                    }
                };
                return wrong(
                    format!("this varies in {} ways: {}", names.len(), names.join(", ")),
                    remedy,
                );
            }
            _ => {
                return wrong(
                    "this says no way to vary".to_owned(),
                    "for a fixed value use [set]; else `list = [...]`",
                );
            }
        }
    }
    Ok(())
}

/// What the words of the file say of each other.
fn check_words(document: &Document, raw: &RawCampaign, name: &str) -> Result<(), IoError> {
    let wrong = |key: &str, problem: &str, allowed: &str, remedy: &str| {
        Err(document.fault(key, problem, allowed, remedy).into())
    };
    if raw.format != 1 {
        return wrong(
            "format",
            "this version of the language is not known",
            "1",
            "write format = 1",
        );
    }
    let plain = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
    if name.is_empty() || name.len() > 100 || name.starts_with('.') || !name.chars().all(plain) {
        return wrong(
            "name",
            "the name becomes the name of a directory",
            "letters, digits, -, _, . and spaces, not beginning with a dot, at most 100 bytes",
            "choose a plain name",
        );
    }
    if raw.tasks.is_empty() {
        return wrong(
            "do",
            "nothing is done",
            "run, trim, stability, power",
            "write do = [\"run\"], or leave it out",
        );
    }
    for (k, task) in raw.tasks.iter().enumerate() {
        let place = format!("do[{k}]");
        if raw.tasks[..k].contains(task) {
            return wrong(
                &place,
                "this is done twice",
                "each task once",
                "remove one of them",
            );
        }
        let needs_trim = matches!(task, Task::Stability | Task::Power);
        if needs_trim && !raw.tasks[..k].contains(&Task::Trim) {
            return wrong(
                &place,
                "this needs a trimmed flight",
                "after trim",
                "put \"trim\" before it",
            );
        }
    }
    if raw.keep.is_empty() {
        return wrong(
            "keep",
            "no number is kept",
            "at least one name",
            "keep = [\"lift_over_weight\", \"power_watt\"], for instance",
        );
    }
    if raw.trim.is_some() && !raw.tasks.contains(&Task::Trim) {
        return wrong(
            "trim",
            "this has no effect: nothing is trimmed",
            "with do = [\"trim\", ...]",
            "add \"trim\" to do, or remove the table",
        );
    }
    check_files(document, raw)?;
    check_budget(document, raw)
}

fn check_files(document: &Document, raw: &RawCampaign) -> Result<(), IoError> {
    let wrong = |key: &str, problem: &str, allowed: &str, remedy: &str| {
        Err(document.fault(key, problem, allowed, remedy).into())
    };
    let runs = raw.tasks.contains(&Task::Run);
    if !raw.files.is_empty() && !runs {
        return wrong(
            "files",
            "this has no effect: nothing is flown",
            "with do = [..., \"run\"]",
            "add \"run\" to do, or remove it",
        );
    }
    if let Some(k) = (1..raw.files.len()).find(|&k| raw.files[..k].contains(&raw.files[k])) {
        return wrong(
            &format!("files[{k}]"),
            "this is named twice",
            "each kind once",
            "remove one of them",
        );
    }
    if raw.retention.every == 0 {
        return wrong(
            "retention.every",
            "this must not be zero",
            "a whole number >= 1",
            "1 keeps the files of all points",
        );
    }
    if raw.retention.every > 1 && raw.files.is_empty() {
        return wrong(
            "retention.every",
            "this has no effect without files",
            "beside files = [...]",
            "remove it, or keep files",
        );
    }
    if raw.retention.failed && !runs {
        return wrong(
            "retention.failed",
            "this has no effect: nothing is flown",
            "with do = [..., \"run\"]",
            "remove it",
        );
    }
    for (key, kinds) in [
        ("output.page", FileKind::Page),
        ("output.figures", FileKind::Figures),
    ] {
        if raw.set.contains_key(key) {
            let remedy = match kinds {
                FileKind::Page => "remove it; files = [\"page\"] keeps pages",
                _ => "remove it; files = [\"figures\"] keeps figures",
            };
            return wrong(
                &format!("set.{key}"),
                "this has no effect: `files` says what is drawn",
                "no key output.page or output.figures",
                remedy,
            );
        }
    }
    Ok(())
}

fn check_budget(document: &Document, raw: &RawCampaign) -> Result<(), IoError> {
    let budget = &raw.budget;
    if !(1..=1000).contains(&budget.attempts) {
        return Err(document
            .fault(
                "budget.attempts",
                "a number of attempts out of range",
                "a whole number from 1 to 1000",
                "3 is the default",
            )
            .into());
    }
    for (key, value) in [
        ("time_per_point_s", budget.time_per_point_s),
        ("disk_mb", budget.disk_mb),
    ] {
        if value.is_some_and(|x| x <= 0.0) {
            let key = format!("budget.{key}");
            return Err(document
                .fault(
                    &key,
                    "this must be positive",
                    "a number above 0",
                    "remove it for no limit",
                )
                .into());
        }
    }
    Ok(())
}

/// The case that is varied, with what is set at all points.
fn base_case(document: &Document, raw: &RawCampaign, folder: &Path) -> Result<LoadedCase, IoError> {
    let set = set_of(raw);
    let file = folder.join(&raw.case);
    let name = match file.is_file() {
        true => file.display().to_string(),
        false => raw.case.clone(),
    };
    if name == "-" {
        return Err(document
            .fault(
                "case",
                "a campaign cannot read its case from the standard input",
                "a preset or a file",
                "name a file",
            )
            .into());
    }
    match LoadedCase::find(&name, &set) {
        Err(e @ IoError::NoCase { .. }) => Err(document
            .fault(
                "case",
                e.to_string(),
                "a preset, or a file beside this one",
                "correct the name",
            )
            .into()),
        Err(IoError::Case(e)) => {
            let by = set
                .iter()
                .find(|o| e.origin.starts_with(&format!("{o} (set")));
            match by.and_then(|o| o.split_once('=')) {
                Some((key, _)) => Err(document
                    .fault(
                        &format!("set.{key}"),
                        format!("{}: {}", e.key, e.problem),
                        e.allowed.clone(),
                        e.remedy.clone(),
                    )
                    .into()),
                None => Err(IoError::Case(e)),
            }
        }
        found => found,
    }
}
