//! A campaign: its file read and checked, its points with their cases and hashes.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use wingbeat_analysis::estimate;
use wingbeat_case::{CaseError, Document, IoError, LoadedCase, nearest};
use wingbeat_flight::FlightSetup;

use crate::axes::Reader;
use crate::blocks::points_of_block;
use crate::checks;
use crate::evaluate;
use crate::named::{self, Contents};
use crate::number::{self, Number, Source};
use crate::plan::Plan;
use crate::raw::TrimOptions;
use crate::raw::{FRAMES_EVERY, FileKind, HISTORY_EVERY, RawCampaign, Task};
use crate::trimming::{self, TRIM};

/// Values of an axis that are tried before anything is flown.
const TRIED: usize = 20;

/// What to do where the file of a campaign cannot be read.
const REMEDY: &str = "docs/campaigns.md has campaigns to start from";

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
    /// What is in the files that values name.
    contents: Contents,
}

/// A sentence without its numbers.
fn wording(sentence: &str) -> String {
    let is_letter = |c: &char| !c.is_ascii_digit() && !".+-".contains(*c);
    sentence.chars().filter(is_letter).collect()
}

impl Campaign {
    /// Reads the file of a campaign and checks it, as far as that goes without flying.
    ///
    /// # Errors
    /// The first thing in it that cannot be done, with its line.
    pub fn read(path: &Path) -> Result<Self, IoError> {
        Self::of(path, Document::read(path, REMEDY)?)
    }

    fn of(path: &Path, document: Document) -> Result<Self, IoError> {
        let mut campaign = Self::without_numbers(path, document)?;
        campaign.numbers = campaign.kept()?;
        campaign.check_beats()?;
        campaign.digest = campaign.digest_of();
        let folder = campaign.case_folder();
        campaign.contents = named::contents(&campaign.plan, &campaign.base, &folder);
        campaign.block =
            points_of_block(&campaign.raw, &campaign.base.setup, campaign.plan.points());
        Ok(campaign)
    }

    /// The numbers that the campaign of a file may keep, whatever it keeps.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn possible_numbers(path: &Path) -> Result<Vec<Number>, IoError> {
        let campaign = Self::without_numbers(path, Document::read(path, REMEDY)?)?;
        let mut all = campaign.possible()?;
        number::join(&mut all, campaign.possible_at_points());
        Ok(all)
    }

    fn without_numbers(path: &Path, document: Document) -> Result<Self, IoError> {
        checks::shape(&document)?;
        let raw: RawCampaign = document.decode()?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let stem = path.file_stem().and_then(|s| s.to_str());
        let name = raw.name.clone();
        let name = name.unwrap_or_else(|| stem.unwrap_or("campaign").to_owned());
        checks::words(&document, &raw, &name)?;
        let reader = Reader {
            document: &document,
            folder: &folder,
        };
        let plan = reader.plan(&raw)?;
        let base = checks::base_case(&document, &raw, &folder)?;
        let campaign = Self {
            name,
            path: path.to_owned(),
            numbers: vec![],
            block: 1,
            digest: Sha256::new(),
            contents: Contents::new(),
            folder,
            raw,
            plan,
            base,
            document,
        };
        campaign.check_points()?;
        campaign.check_frames()?;
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
        checks::set_of(&self.raw)
            .into_iter()
            .chain(of_case)
            .collect()
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

    /// SHA-256 of what is done at point `i`: version, case, tasks, numbers that are kept, values of the point and what is in
    /// the files that they name, and in those that commands of other programs name. Which files of it are kept is no part.
    pub fn hash(&self, i: usize) -> [u8; 32] {
        let mut hash = self.digest.clone();
        for line in self.plan.overrides(i) {
            hash.update(&line);
            hash.update(b"\n");
            if let Some(content) = self.contents.get(&line) {
                hash.update(content);
            }
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
            self.mean_beats(),
            &raw.set,
        );
        hash.update(format!("{tasks:?}\n"));
        named::of_programs(&self.base)
            .iter()
            .for_each(|program| hash.update(program));
        if self.numbers.iter().any(|n| n.source.is_extreme()) {
            hash.update("extremes of the last wingbeats\n"); // they were those of the whole flight once
        }
        hash
    }

    /// SHA-256 of the whole plan, which blocks of points belong to: which points there are and in which order, and what is
    /// kept of them.
    pub fn plan_hash(&self) -> [u8; 32] {
        let raw = &self.raw;
        let mut hash = self.digest.clone();
        let varied = (&raw.parameter, &raw.zip, self.plan.samples, raw.seed);
        // The keys as they follow each other in the file: points are counted in this order.
        let keys = (self.plan.keys(), self.block);
        let files = (&raw.files, raw.retention.every, raw.retention.failed);
        hash.update(format!("{varied:?} {keys:?} {files:?}\n"));
        if let Some(axis) = self.plan.axes.iter().find(|a| a.place == "table") {
            hash.update(format!("{axis:?}"));
        }
        self.contents.values().for_each(|c| hash.update(c));
        hash.finalize().into()
    }

    /// Whether point `i` has a result directory of its own while it is flown: it keeps files, or its air has wakes in space
    /// and takes long.
    pub fn has_directory(&self, i: usize, setup: &FlightSetup) -> bool {
        let runs = self.raw.tasks.contains(&Task::Run);
        runs && (self.keeps_files(i) || setup.air.keeps_wake())
    }

    /// Whether files of point `i` are kept.
    pub fn keeps_files(&self, i: usize) -> bool {
        !self.raw.files.is_empty() && i.is_multiple_of(self.raw.retention.every)
    }

    /// The numbers that this case may keep.
    fn possible(&self) -> Result<Vec<Number>, IoError> {
        number::registry(&self.base.setup).map_err(|e| {
            self.fault(
                "case",
                e.to_string(),
                "a case that can be flown",
                "correct the case",
            )
        })
    }

    /// The numbers that points may keep which are tried: a varied key may bring columns that the case does not have.
    fn possible_at_points(&self) -> Vec<Number> {
        let mut all = vec![];
        for i in self.tried() {
            let case = self.case_with(&self.overrides(i)).ok();
            let more = case.and_then(|case| number::registry(&case.setup).ok());
            number::join(&mut all, more.unwrap_or_default());
        }
        all
    }

    /// The numbers that are kept.
    fn kept(&self) -> Result<Vec<Number>, IoError> {
        if self.raw.keep.is_empty() {
            return Err(self.fault(
                "keep",
                "no number is kept".to_owned(),
                "at least one name",
                "keep = [\"lift_over_weight\", \"power_watt\"], for instance; `wingbeat campaign numbers FILE` lists all",
            ));
        }
        let mut all = self.possible()?;
        let has = |all: &[Number], name: &String| all.iter().any(|n| n.name == *name);
        if !self.raw.keep.iter().all(|name| has(&all, name)) {
            number::join(&mut all, self.possible_at_points());
        }
        let mut kept: Vec<Number> = vec![];
        for (k, name) in self.raw.keep.iter().enumerate() {
            let place = format!("keep[{k}]");
            let number = number::find(&all, name).map_err(|remedy| {
                let problem = format!("there is no number called `{name}`");
                self.fault(&place, problem, "a column of the history, lift_over_weight, power_watt, efficiency, error.*, summary.*, trim.*, stability.*, power.*", &remedy)
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
        if matches!(number.source, Source::Error(_)) && self.raw.mean_beats < Some(3) {
            let problem = format!("`{}` needs a mean over several wingbeats", number.name);
            let remedy = "set mean_beats = 3, or more";
            return Err(self.fault(place, problem, "with mean_beats of 3 or more", remedy));
        }
        self.check_steps(place, number)
    }

    /// Means and extremes of columns need every step in the history of every point.
    fn check_steps(&self, place: &str, number: &Number) -> Result<(), IoError> {
        let thinned = |case: &LoadedCase| case.output.history_every > 1;
        if !number.source.needs_every_step() {
            return Ok(());
        }
        let mut tried = self
            .tried()
            .filter_map(|i| self.case_with(&self.overrides(i)).ok());
        let (whose, remedy) = match self.varies(HISTORY_EVERY) {
            true if tried.any(|case| thinned(&case)) => (
                "some points",
                format!("vary {HISTORY_EVERY} no more, or keep `end.` of the column"),
            ),
            false if thinned(&self.base) => (
                "this case",
                format!("add `\"{HISTORY_EVERY}\" = 1` to [set]"),
            ),
            _ => return Ok(()),
        };
        let problem = format!(
            "the history of {whose} leaves steps out, which means and extremes of its columns need"
        );
        Err(self.fault(place, problem, "with output.history_every = 1", &remedy))
    }

    /// Tries the case with the values of every axis, up to twenty of each, and what is drawn first.
    fn check_points(&self) -> Result<(), IoError> {
        trimming::check(&self.document, &self.raw, &self.base.setup)?;
        self.check_options()?;
        self.tried().try_for_each(|i| self.check_point(i))
    }

    /// The points that are tried before anything is flown: the values of every axis, up to twenty of each and the last,
    /// beside the first ones of the others.
    fn tried(&self) -> impl Iterator<Item = usize> {
        let mut block = self.plan.samples;
        let mut points = vec![];
        for axis in self.plan.axes.iter().rev() {
            let stride = (axis.len() / TRIED).max(1);
            let places = (0..axis.len()).step_by(stride).chain([axis.len() - 1]);
            points.extend(places.map(|at| at * block));
            block *= axis.len();
        }
        points.push(0);
        points.into_iter()
    }

    /// What an estimate finds doubtful of the case and of the points that are tried, each said once.
    pub fn doubts(&self) -> Vec<String> {
        let mut found = estimate(&self.base.setup).doubts;
        let points = self.tried().map(|i| self.case_with(&self.overrides(i)));
        let doubts = points
            .flatten()
            .flat_map(|case| estimate(&case.setup).doubts);
        for doubt in doubts {
            if found.iter().all(|known| wording(known) != wording(&doubt)) {
                found.push(doubt);
            }
        }
        found
    }

    /// Wingbeats that means are taken over.
    pub fn mean_beats(&self) -> usize {
        self.raw.mean_beats.unwrap_or(1)
    }

    /// An error if no point that is tried has as many whole wingbeats as means are taken over, and none that is not would
    /// have more.
    fn check_beats(&self) -> Result<(), IoError> {
        let wanted = self.mean_beats();
        let (mut most, mut asked) = (0, false);
        for i in self.tried() {
            let Ok(case) = self.case_with(&self.overrides(i)) else {
                continue;
            };
            if !evaluate::needs_beats(&self.numbers, &case.setup) {
                return Ok(());
            }
            let each = case.setup.time.steps_per_beat();
            most = most.max(each.map_or(0, |each| case.setup.time.steps / each));
            asked = true;
            if most >= wanted {
                return Ok(());
            }
        }
        let all_tried = self.plan.points() <= self.tried().count();
        let timed = |key: &String| key.starts_with("time.") || key == "motion.frequency_hz";
        if !asked || (!all_tried && self.plan.keys().iter().any(timed)) {
            return Ok(());
        }
        let place = match self.raw.mean_beats {
            Some(_) => "mean_beats",
            None => "keep",
        };
        Err(self.fault(
            place,
            format!("means over {wanted} wingbeats, and flights of {most} whole ones"),
            &format!("a whole number from 1 to {}", most.max(1)),
            "fly longer (`\"time.beats\"` in [set]), take means over fewer, or keep what is no mean (`end.`, `summary.`)",
        ))
    }

    /// Frames that are kept are written.
    fn check_frames(&self) -> Result<(), IoError> {
        let kept = self.raw.files.contains(&FileKind::Frames);
        if !kept || self.base.output.frames_every > 0 || self.varies(FRAMES_EVERY) {
            return Ok(());
        }
        Err(self.fault(
            "files",
            format!("no frames are there to be kept: {FRAMES_EVERY} is 0"),
            "frames of a case that writes them",
            "in a lattice write `\"output.frames_every\" = 10` in [set], for instance: every tenth step; air without wakes has no frames",
        ))
    }

    /// Whether a key varies from point to point.
    pub(crate) fn varies(&self, key: &str) -> bool {
        self.plan.keys().iter().any(|k| k == key)
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
        let mut place = self.place_of(&key);
        // An unknown key stands in the heading, a wrong value below it.
        if !e.problem.starts_with("unknown key")
            && let Some(way) = self.way_of(&place, &key)
        {
            place = format!("{place}.{way}");
        }
        self.fault(&place, problem, &e.allowed, &e.remedy)
    }

    /// How a parameter that stands at `place` is varied: `range`, for instance.
    fn way_of(&self, place: &str, key: &str) -> Option<&String> {
        let parameters = self.document.table().get("parameter")?;
        let ways = parameters.get(place.strip_prefix("parameter.").filter(|k| *k == key)?)?;
        ways.as_table()?.keys().next()
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
