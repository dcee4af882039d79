//! What is refused before anything is flown: points that are tried, numbers that none of them has, means over wingbeats
//! that none flies.

use std::collections::HashSet;

use wingbeat_analysis::estimate;
use wingbeat_case::{IoError, LoadedCase, nearest};
use wingbeat_results::summary::starting_beats;

use crate::plan::cases;
use crate::plan::file::CampaignFile;
use crate::plan::number::{self, Number, Source};
use crate::plan::places::Places;
use crate::plan::raw::{FRAMES_EVERY, FileKind, HISTORY_EVERY, Task, TrimOptions};
use crate::plan::trimming::{self, TRIM};
use crate::worker::evaluate;

/// Values of an axis that are tried before anything is flown.
const TRIED: usize = 20;

/// A sentence without its numbers.
fn wording(sentence: &str) -> String {
    let is_letter = |c: &char| !c.is_ascii_digit() && !".+-".contains(*c);
    sentence.chars().filter(is_letter).collect()
}

impl CampaignFile {
    /// Tries the case with the values of every axis, up to twenty of each, and what is drawn first.
    ///
    /// # Errors
    /// The first that cannot be flown; files that would not be there.
    pub fn check(&self) -> Result<(), IoError> {
        trimming::check(&self.document, &self.raw, &self.base.setup)?;
        self.check_options()?;
        self.tried().try_for_each(|i| self.check_point(i))?;
        self.check_frames()
    }

    fn fault(&self, key: &str, problem: String, allowed: &str, remedy: &str) -> IoError {
        self.document.fault(key, problem, allowed, remedy).into()
    }

    fn places(&self) -> Places<'_> {
        Places {
            document: &self.document,
            raw: &self.raw,
            axes: &self.plan.axes,
        }
    }

    /// The points that are tried before anything is flown: the values of every axis, up to twenty of each and the last,
    /// beside the first ones of the others. Each stands once.
    fn tried(&self) -> impl Iterator<Item = usize> + use<> {
        let mut block = self.plan.samples;
        let mut points = vec![];
        for axis in self.plan.axes.iter().rev() {
            let stride = axis.len().div_ceil(TRIED).max(1);
            let places = (0..axis.len()).step_by(stride).chain([axis.len() - 1]);
            points.extend(places.map(|at| at * block));
            block *= axis.len();
        }
        points.push(0);
        let mut known = HashSet::new();
        points.into_iter().filter(move |&i| known.insert(i))
    }

    fn case(&self, i: usize) -> Result<LoadedCase, IoError> {
        let overrides = cases::overrides(&self.raw, &self.plan, i);
        cases::with(&self.base, &self.case_folder, &overrides)
    }

    /// Their cases, those left out that cannot be flown.
    fn cases(&self) -> impl Iterator<Item = LoadedCase> {
        self.tried().filter_map(|i| self.case(i).ok())
    }

    /// What an estimate finds doubtful of the case and of the points that are tried, each said once.
    pub fn doubts(&self) -> Vec<String> {
        let mut found = estimate(&self.base.setup).doubts;
        let doubts = self.cases().flat_map(|case| estimate(&case.setup).doubts);
        for doubt in doubts {
            if found.iter().all(|known| wording(known) != wording(&doubt)) {
                found.push(doubt);
            }
        }
        found
    }

    fn check_point(&self, i: usize) -> Result<(), IoError> {
        self.trim_options(i)?;
        match self.case(i) {
            Ok(_) => Ok(()),
            Err(IoError::Case(_)) if self.is_combination(i) => Ok(()),
            Err(IoError::Case(e)) => Err(self.places().traced(*e)),
            Err(e) => Err(e),
        }
    }

    /// Whether the case takes the values of every axis at point `i` by themselves, and what is drawn: what it then
    /// refuses is their combination.
    fn is_combination(&self, i: usize) -> bool {
        let all = self.plan.overrides(i);
        let drawn = self.plan.samplers.len();
        let sizes = self.plan.axes.iter().map(|a| a.keys.len());
        let mut rest = all.as_slice();
        let groups = sizes.chain([drawn]).map(|size| {
            let (group, left) = rest.split_at(size);
            rest = left;
            group
        });
        let groups: Vec<&[String]> = groups.filter(|g| !g.is_empty()).collect();
        let is_taken = |group: &&[String]| {
            let of_case = group.iter().filter(|o| !o.starts_with(TRIM)).cloned();
            let overrides: Vec<String> = cases::set_of(&self.raw)
                .into_iter()
                .chain(of_case)
                .collect();
            cases::with(&self.base, &self.case_folder, &overrides).is_ok()
        };
        groups.len() > 1 && groups.iter().all(is_taken)
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
            let place = self.places().of(&bad.key).unwrap_or(bad.key);
            self.fault(&place, bad.problem, &bad.allowed, bad.remedy)
        })
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
        let keys = self.plan.keys().iter();
        keys.filter(|k| k.starts_with(TRIM))
            .try_for_each(|key| self.check_option(key))
    }

    fn check_option(&self, key: &str) -> Result<(), IoError> {
        let place = self.places().of(key).unwrap_or(key.to_owned());
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
        Ok(())
    }

    /// Frames that are kept are written.
    fn check_frames(&self) -> Result<(), IoError> {
        let kept = self.raw.files.contains(&FileKind::Frames);
        if !kept || self.base.output.frames_every > 0 || self.plan.varies(FRAMES_EVERY) {
            return Ok(());
        }
        Err(self.fault(
            "files",
            format!("no frames are there to be kept: {FRAMES_EVERY} is 0"),
            "frames of a case that writes them",
            "in a lattice write `\"output.frames_every\" = 10` in [set], for instance: every tenth step; air without wakes has no frames",
        ))
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
        for case in self.cases() {
            number::join(&mut all, number::registry(&case.setup).unwrap_or_default());
        }
        all
    }

    /// All numbers that may be kept.
    ///
    /// # Errors
    /// A case that cannot be flown.
    pub fn all_possible(&self) -> Result<Vec<Number>, IoError> {
        let mut all = self.possible()?;
        number::join(&mut all, self.possible_at_points());
        Ok(all)
    }

    /// The numbers that are kept.
    ///
    /// # Errors
    /// None; one that there is not, or not of these flights; `mean_beats` that has no effect, or is more than
    /// any point flies.
    pub fn kept(&self) -> Result<Vec<Number>, IoError> {
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
                self.fault(&place, problem, "a column of the history, or max., min. or end. before one, lift_over_weight, power_watt, efficiency, error.*, summary.*, trim.*, stability.*, power.*", &remedy)
            })?;
            if kept.iter().any(|n| n.name == number.name) {
                let problem = format!("`{name}` is kept twice");
                return Err(self.fault(&place, problem, "each number once", "remove one"));
            }
            self.check_number(&place, &number)?;
            kept.push(number);
        }
        self.check_beats(&kept)?;
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
        let (whose, remedy) = match self.plan.varies(HISTORY_EVERY) {
            true if self.cases().any(|case| thinned(&case)) => (
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

    /// An error if means are asked for and none is kept, or no point that is tried has as many whole wingbeats
    /// beyond its start as they are taken over, and none that is not would have more.
    fn check_beats(&self, numbers: &[Number]) -> Result<(), IoError> {
        if self.raw.mean_beats.is_some() && !numbers.iter().any(|n| n.source.is_mean()) {
            let problem = "this has no effect: no mean over wingbeats is kept".to_owned();
            return Err(self.fault("mean_beats", problem, "beside a mean in keep", "remove it"));
        }
        let wanted = self.raw.mean_beats();
        let (mut most, mut longest, mut asked) = (0, 0, false);
        for case in self.cases() {
            if !evaluate::needs_beats(numbers, &case.setup) {
                return Ok(());
            }
            let each = case.setup.time.steps_per_beat();
            let whole = each.map_or(0, |each| case.setup.time.steps / each);
            longest = longest.max(whole);
            most = most.max(whole.saturating_sub(starting_beats(&case.setup)));
            asked = true;
            if most >= wanted {
                return Ok(());
            }
        }
        let all_tried = self.plan.points() <= self.tried().count();
        let timed = |key: &String| key.starts_with("time.") || key == "motion.frequency_hz";
        let differ = self.plan.varies_starts() || self.plan.keys().iter().any(timed);
        if !asked || (!all_tried && differ) {
            return Ok(());
        }
        let place = match self.raw.mean_beats {
            Some(_) => "mean_beats",
            None => "keep",
        };
        let beyond = match most < longest {
            true => {
                ", of which means leave out those that a smooth start or a hold reach into (motion.start_beats, flight.held_beats, flight.tether.start_s)"
            }
            false => "",
        };
        let allowed = match (most, longest) {
            (0, 0) => "flights of a whole wingbeat or more".to_owned(),
            (0, _) => "flights of a whole wingbeat or more beyond their start".to_owned(),
            _ => format!("a whole number from 1 to {most}"),
        };
        Err(self.fault(
            place,
            format!("means over {wanted} wingbeats, and flights of {longest} whole ones{beyond}"),
            &allowed,
            "fly longer (`\"time.beats\"` in [set]), take means over fewer, or keep what is no mean (`end.`, `summary.`)",
        ))
    }
}
