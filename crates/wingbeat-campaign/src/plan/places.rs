//! Where a key of the case stands in the file of the campaign: faults of the case are traced there.

use wingbeat_case::{CaseError, Document, IoError};

use crate::plan::raw::RawCampaign;
use crate::plan::{Axis, Place};

/// The places of keys.
pub struct Places<'a> {
    /// The file.
    pub document: &'a Document,
    /// What it says.
    pub raw: &'a RawCampaign,
    /// Its axes; none before it has a plan.
    pub axes: &'a [Axis],
}

impl Places<'_> {
    /// Where a key stands that is varied, set or removed; none of others.
    pub fn of(&self, key: &str) -> Option<String> {
        let has = |keys: &[String]| keys.iter().any(|k| k == key);
        if let Some(axis) = self.axes.iter().find(|a| has(&a.keys)) {
            return Some(axis.place.of_key(key));
        }
        if self.raw.set.contains_key(key) {
            return Some(format!("set.{key}"));
        }
        if has(&self.raw.remove) {
            return Some("remove".to_owned());
        }
        let drawn = self.raw.parameter.contains_key(key);
        drawn.then(|| Place::Parameter.of_key(key))
    }

    /// A fault of a value that is put on top of the case, at its line of this file; others as they are.
    pub fn traced(&self, e: CaseError) -> IoError {
        let Some(key) = &e.overridden else {
            return e.into();
        };
        let Some(mut place) = self.of(key) else {
            return e.into();
        };
        let problem = match e.key.is_empty() || e.key == *key {
            true => format!(
                "{} = {}: {}",
                key,
                e.value.clone().unwrap_or_default(),
                e.problem
            ),
            false => format!("{}: {}", e.key, e.problem),
        };
        // An unknown key stands in the heading, a wrong value below it.
        if !e.problem.starts_with("unknown key")
            && let Some(way) = self.way_of(&place, key)
        {
            place = format!("{place}.{way}");
        }
        let fault = self.document.fault(&place, problem, e.allowed, e.remedy);
        fault.into()
    }

    /// How a parameter that stands at `place` is varied: `range`, for instance.
    fn way_of(&self, place: &str, key: &str) -> Option<&String> {
        let parameters = self.document.table().get("parameter")?;
        let ways = parameters.get(place.strip_prefix("parameter.").filter(|k| *k == key)?)?;
        ways.as_table()?.keys().next()
    }
}
