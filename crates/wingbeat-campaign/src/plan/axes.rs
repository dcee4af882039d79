//! From the file to its plan: what varies and how.

use std::collections::BTreeMap;
use std::path::Path;

use wingbeat_case::{CaseError, Document};
use wingbeat_math::to_digits;

use crate::plan::raw::{Ends, Normal, Range, RawCampaign, Variation};
use crate::plan::sample::{MAX_SOBOL, MAX_SOBOL_KEYS, Sampler, cumulative};
use crate::plan::value::Value;
use crate::plan::{Axis, Place, Plan};

/// Points of a campaign at most.
const MAX_POINTS: usize = 100_000_000;
/// Values of a range, rows of a table and samples at most.
const MAX_VALUES: usize = 10_000_000;

type Found<T> = Result<T, Box<CaseError>>;

/// The file that is read, and the folder that its paths are relative to.
pub struct Reader<'a> {
    /// The file.
    pub document: &'a Document,
    /// Its folder.
    pub folder: &'a Path,
}

impl Reader<'_> {
    /// The plan of the file.
    ///
    /// # Errors
    /// What cannot be varied so.
    pub fn plan(&self, raw: &RawCampaign) -> Found<Plan> {
        let (mut axes, mut samplers) = (vec![], vec![]);
        let samples = self.samples(raw)?;
        let seed = self.seed(raw)?;
        for key in self.document.names("parameter") {
            let Some(variation) = raw.parameter.get(&key) else {
                continue;
            };
            let place = Place::Parameter.of_key(&key);
            match self.listed(&place, variation)? {
                Some(values) => axes.push(Axis::of_key(&key, values)),
                None => {
                    let dimension = samplers.iter().filter(|s: &&Sampler| s.is_sobol()).count();
                    self.check_law(&place, variation, samples, dimension)?;
                    samplers.push(Sampler::new(&key, seed, variation, samples, dimension));
                }
            }
        }
        for (k, group) in raw.zip.iter().enumerate() {
            axes.push(self.zipped(k, group)?);
        }
        if let Some(name) = &raw.table {
            axes.push(self.table(name)?);
        }
        self.check_once(raw, &axes, &samplers)?;
        let count = if samplers.is_empty() { 1 } else { samples };
        let plan = Plan::new(axes, samplers, count).filter(|p| p.points() <= MAX_POINTS);
        plan.ok_or_else(|| {
            self.wrong(
                "parameter",
                "there are too many points",
                format!("at most {MAX_POINTS} points"),
                "shorten lists and ranges, or draw samples instead",
            )
        })
    }

    fn wrong(
        &self,
        key: &str,
        problem: impl Into<String>,
        allowed: impl Into<String>,
        remedy: &str,
    ) -> Box<CaseError> {
        Box::new(self.document.fault(key, problem, allowed, remedy))
    }

    /// Samples, given if something is drawn and only then; likewise the seed.
    fn samples(&self, raw: &RawCampaign) -> Found<usize> {
        let draws = raw.parameter.values().any(is_drawn);
        let idle = |key| {
            self.wrong(
                key,
                "this has no effect: no parameter is drawn",
                "beside a parameter with latin_hypercube, sobol, uniform, log_uniform or normal",
                "remove it, or draw a parameter",
            )
        };
        match (raw.samples, draws) {
            (None, false) if raw.seed.is_some() => Err(idle("seed")),
            (Some(_), false) => Err(idle("samples")),
            (None, false) => Ok(1),
            (Some(n), true) if (1..=MAX_VALUES).contains(&n) => Ok(n),
            (Some(_), true) => Err(self.wrong(
                "samples",
                "a number of samples out of range",
                format!("a whole number from 1 to {MAX_VALUES}"),
                "choose a number in this range",
            )),
            (None, true) => {
                let drawn = raw.parameter.iter().find(|(_, v)| is_drawn(v));
                let key = drawn.map_or_else(String::new, |(k, _)| format!("parameter.{k}"));
                Err(self.wrong(
                    &key,
                    "this is drawn, but nothing says how often: `samples` is missing",
                    "samples = N at the top of the file",
                    "add `samples = 100`, for instance",
                ))
            }
        }
    }

    /// The seed; a Sobol sequence has as many as 32 bits hold.
    fn seed(&self, raw: &RawCampaign) -> Found<u64> {
        let seed = raw.seed.unwrap_or(0) as u64;
        let sobol = |v: &Variation| matches!(v, Variation::Sobol(_));
        match u32::try_from(seed).is_ok() || !raw.parameter.values().any(sobol) {
            true => Ok(seed),
            false => Err(self.wrong(
                "seed",
                format!("{seed} is too large a seed for a Sobol sequence"),
                format!(
                    "a whole number from 0 to {}, where sobol is drawn",
                    u32::MAX
                ),
                "choose a seed in this range",
            )),
        }
    }

    /// The values of a parameter that is listed; none of one that is drawn.
    fn listed(&self, place: &str, variation: &Variation) -> Found<Option<Vec<Value>>> {
        match variation {
            Variation::List(list) => self.list(&format!("{place}.list"), list).map(Some),
            Variation::Range(r) => self.range(&format!("{place}.range"), r, false).map(Some),
            Variation::LogRange(r) => self.range(&format!("{place}.log_range"), r, true).map(Some),
            _ => Ok(None),
        }
    }

    fn list(&self, place: &str, list: &[toml::Value]) -> Found<Vec<Value>> {
        if list.is_empty() {
            return Err(self.wrong(
                place,
                "this list is empty",
                "at least one value",
                "give values, or remove the parameter",
            ));
        }
        let of = |(k, value): (usize, &toml::Value)| {
            Value::of(value).ok_or_else(|| {
                self.wrong(
                    &format!("{place}[{k}]"),
                    "a table is no value of a key",
                    "numbers, texts, true or false, lists of them",
                    "vary the keys of the table one by one",
                )
            })
        };
        list.iter().enumerate().map(of).collect()
    }

    fn range(&self, place: &str, range: &Range, logarithmic: bool) -> Found<Vec<Value>> {
        let end = |name: &str, value: &toml::Value| {
            self.end(&format!("{place}.{name}"), value, logarithmic)
        };
        let [from, to] = [end("from", &range.from)?, end("to", &range.to)?];
        if !(2..=MAX_VALUES).contains(&range.count) {
            return Err(self.wrong(
                &format!("{place}.count"),
                match range.count < 2 {
                    true => "a range has both of its ends",
                    false => "these are too many values",
                },
                format!("a whole number from 2 to {MAX_VALUES}"),
                match range.count < 2 {
                    true => "a single value goes into [set]",
                    false => "take fewer, or draw samples instead",
                },
            ));
        }
        if from == to {
            return Err(self.wrong(
                place,
                "the ends of this range are the same",
                "from and to that differ",
                "correct one of them",
            ));
        }
        if let Some(whole) = whole(range).filter(|_| !logarithmic) {
            return Ok(whole);
        }
        let last = range.count - 1;
        let at = |k: usize| match k {
            0 => from,
            k if k == last => to,
            k if logarithmic => from * (to / from).powf(k as f64 / last as f64),
            k => from + (to - from) * k as f64 / last as f64,
        };
        Ok((0..=last)
            .map(|k| Value::Number(to_digits(at(k), 12)))
            .collect())
    }

    /// An end of a range.
    fn end(&self, key: &str, value: &toml::Value, logarithmic: bool) -> Found<f64> {
        let number = Value::of(value).and_then(|v| v.number());
        let number = number.filter(|x| !logarithmic || *x > 0.0);
        let allowed = match logarithmic {
            true => "a number above 0",
            false => "a number",
        };
        number.ok_or_else(|| {
            self.wrong(
                key,
                "this is no end of the range",
                allowed,
                "give a number; other values go into a list",
            )
        })
    }

    fn zipped(&self, k: usize, group: &BTreeMap<String, Vec<toml::Value>>) -> Found<Axis> {
        let mut values: Vec<Vec<Value>> = vec![];
        for (key, list) in group {
            let place = Place::Zip(k).of_key(key);
            values.push(self.list(&place, list)?);
            let wanted = values[0].len();
            if list.len() != wanted {
                return Err(self.wrong(
                    &place,
                    format!(
                        "this list has {} values, others of its group {wanted}",
                        list.len()
                    ),
                    "lists of the same length",
                    "complete it, or vary its key as a parameter of its own",
                ));
            }
        }
        if group.len() < 2 {
            return Err(self.wrong(
                &format!("zip[{k}]"),
                "keys that vary together are two at least",
                "two or more lists of the same length",
                "vary a single key by [parameter.\"KEY\"] list = [...]",
            ));
        }
        Ok(Axis {
            name: group.keys().next().cloned().unwrap_or_default(),
            place: Place::Zip(k),
            keys: group.keys().cloned().collect(),
            values,
        })
    }

    fn table(&self, name: &str) -> Found<Axis> {
        let path = self.folder.join(name);
        let allowed = "a CSV file with the keys in its first line and a row for each point; commas, semicolons or tabs part its columns";
        let bad = |problem: String| self.wrong("table", problem, allowed, "correct the file");
        let text = std::fs::read(&path)
            .map_err(|e| bad(format!("cannot read `{}`: {e}", path.display())))?;
        let mut reader = wingbeat_case::csv_reader(&text);
        let header = reader.headers().map_err(|e| bad(e.to_string()))?;
        let keys: Vec<String> = header.iter().map(str::to_owned).collect();
        let mut values = vec![vec![]; keys.len()];
        for record in reader.records() {
            let record = record.map_err(|e| bad(e.to_string()))?;
            let line = record.position().map_or(0, csv::Position::line);
            for (k, cell) in record.iter().enumerate() {
                let value = Value::of_cell(cell).filter(|_| !cell.is_empty());
                let value = value.ok_or_else(|| {
                    bad(format!(
                        "{name}:{line}: `{cell}` is no value of {}",
                        keys[k]
                    ))
                })?;
                values[k].push(value);
            }
        }
        if values.first().is_none_or(Vec::is_empty) {
            return Err(bad(format!("{name} has no rows below its first line")));
        }
        Ok(Axis {
            name: "row".to_owned(),
            place: Place::Table,
            keys,
            values,
        })
    }

    fn check_law(&self, place: &str, v: &Variation, samples: usize, dimension: usize) -> Found<()> {
        let ends = |name: &str, ends: &Ends| match ends.from < ends.to {
            true => Ok(()),
            false => Err(self.wrong(
                &format!("{place}.{name}"),
                "there is nothing between these ends",
                "from below to",
                "exchange them, or correct one",
            )),
        };
        match v {
            Variation::LatinHypercube(e) => ends("latin_hypercube", e),
            Variation::Uniform(e) => ends("uniform", e),
            Variation::LogUniform(e) if e.from <= 0.0 => Err(self.wrong(
                &format!("{place}.log_uniform.from"),
                "there is no logarithm of this",
                "a number above 0",
                "uniform has no such limit",
            )),
            Variation::LogUniform(e) => ends("log_uniform", e),
            Variation::Sobol(_) if samples > MAX_SOBOL => Err(self.wrong(
                &format!("{place}.sobol"),
                format!("this sequence has {MAX_SOBOL} samples, not {samples}"),
                format!("samples = {MAX_SOBOL} or fewer"),
                "draw fewer, or by latin_hypercube or uniform",
            )),
            Variation::Sobol(_) if dimension >= MAX_SOBOL_KEYS => Err(self.wrong(
                &format!("{place}.sobol"),
                "there are too many keys in this sequence",
                format!("at most {MAX_SOBOL_KEYS} keys"),
                "draw by uniform",
            )),
            Variation::Sobol(e) => ends("sobol", e),
            Variation::Normal(n) => self.check_normal(&format!("{place}.normal"), n),
            Variation::List(_) | Variation::Range(_) | Variation::LogRange(_) => Ok(()),
        }
    }

    fn check_normal(&self, place: &str, n: &Normal) -> Found<()> {
        if n.standard_deviation <= 0.0 {
            return Err(self.wrong(
                &format!("{place}.standard_deviation"),
                "this must be positive",
                "a number above 0",
                "a value that does not scatter goes into [set]",
            ));
        }
        let below = |x: Option<f64>, open: f64| {
            x.map_or(open, |x| cumulative((x - n.mean) / n.standard_deviation))
        };
        if below(n.to, 1.0) - below(n.from, 0.0) < 1e-6 {
            return Err(self.wrong(
                place,
                "these ends leave less than a millionth of the distribution",
                "from below to, around the mean",
                "correct the ends",
            ));
        }
        Ok(())
    }

    /// No key varies twice, and none is set that varies.
    fn check_once(&self, raw: &RawCampaign, axes: &[Axis], samplers: &[Sampler]) -> Found<()> {
        let listed = axes.iter().flat_map(|a| {
            let keys = a.keys.iter();
            keys.map(|key| (key.as_str(), a.place.of_key(key)))
        });
        let drawn = samplers
            .iter()
            .map(|s| (s.key(), Place::Parameter.of_key(s.key())));
        let all: Vec<(&str, String)> = listed.chain(drawn).collect();
        let inside = |a: &str, b: &str| {
            let rest = b.strip_prefix(a);
            rest.is_some_and(|r| r.is_empty() || r.starts_with(['.', '[']))
        };
        for set in raw.set.keys() {
            if let Some((key, place)) = all.iter().find(|(key, _)| inside(key, set)) {
                return Err(self.wrong(
                    &format!("set.{set}"),
                    format!("this has no effect: `{key}` is varied, by {place}"),
                    "keys that do not vary",
                    "remove it from [set], or vary the key no more",
                ));
            }
        }
        for (k, (key, place)) in all.iter().enumerate() {
            let related = |other: &&(&str, String)| inside(key, other.0) || inside(other.0, key);
            if let Some((other, _)) = all[..k].iter().find(related) {
                return Err(self.wrong(
                    place,
                    format!("`{key}` is varied already, by `{other}`"),
                    "each key once",
                    "remove one of the two",
                ));
            }
        }
        Ok(())
    }
}

/// The values of a range of whole numbers that are whole numbers apart.
fn whole(range: &Range) -> Option<Vec<Value>> {
    let (toml::Value::Integer(from), toml::Value::Integer(to)) = (&range.from, &range.to) else {
        return None;
    };
    let last = range.count as i64 - 1;
    let length = to.checked_sub(*from)?;
    let value = |k: i64| Value::Whole(from + k * (length / last));
    (length % last == 0).then(|| (0..=last).map(value).collect())
}

fn is_drawn(v: &Variation) -> bool {
    !matches!(
        v,
        Variation::List(_) | Variation::Range(_) | Variation::LogRange(_)
    )
}
