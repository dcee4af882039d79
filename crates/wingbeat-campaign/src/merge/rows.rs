//! The points of a campaign with what came of them, one after the other.

use wingbeat_case::IoError;
use wingbeat_results::manifest::hexadecimal;
use wingbeat_results::summary::Verdict;

use crate::campaign::Campaign;
use crate::plan::value::Value;
use crate::store::{PointResult, Reason, Store};

/// A point with what came of it.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its number.
    pub point: usize,
    /// Its hash.
    pub hash: String,
    /// Values of its keys.
    pub keys: Vec<Value>,
    /// Its numbers \[unit of each\]; not a number where there are none.
    pub numbers: Vec<f64>,
    /// Whether it has numbers; none where it was not flown.
    pub success: Option<bool>,
    /// How far its flight can be trusted; none where nothing was flown.
    pub verdict: Option<Verdict>,
    /// Why it has none.
    pub failed: Option<(Reason, String)>,
}

/// The points of a campaign one after the other.
pub fn rows<'a>(
    campaign: &'a Campaign,
    store: &'a Store,
) -> impl Iterator<Item = Result<Row, IoError>> + 'a {
    (0..campaign.plan().points()).map(move |i| {
        let hash = hexadecimal(&campaign.hash(i));
        let found = store.get(&hash)?;
        let count = campaign.numbers.len();
        let numbers = found.as_ref().map(|r| values(r, count));
        Ok(Row {
            point: i,
            hash,
            keys: campaign.plan().values(i),
            numbers: numbers.unwrap_or_else(|| vec![f64::NAN; count]),
            success: found.as_ref().map(|r| r.failed.is_none()),
            verdict: found.as_ref().and_then(|r| r.verdict),
            failed: found.and_then(|r| r.failed),
        })
    })
}

fn values(result: &PointResult, count: usize) -> Vec<f64> {
    let mut values: Vec<f64> = result
        .values
        .iter()
        .map(|x| x.unwrap_or(f64::NAN))
        .collect();
    values.resize(count, f64::NAN);
    values
}

/// What a column of keys is in all points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyKind {
    /// Whole numbers.
    Whole,
    /// Numbers.
    Number,
    /// Texts, lists, truth values.
    Text,
}

/// What the keys of a campaign are.
pub fn kinds(campaign: &Campaign) -> Vec<KeyKind> {
    let listed = campaign.plan().axes.iter().flat_map(|axis| &axis.values);
    let kind = |values: &Vec<Value>| {
        let whole = values.iter().all(|v| matches!(v, Value::Whole(_)));
        let number = values.iter().all(|v| v.number().is_some());
        match (whole, number) {
            (true, _) => KeyKind::Whole,
            (_, true) => KeyKind::Number,
            _ => KeyKind::Text,
        }
    };
    let drawn = campaign.plan().samplers.iter().map(|_| KeyKind::Number);
    listed.map(kind).chain(drawn).collect()
}
