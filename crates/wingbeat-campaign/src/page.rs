//! The page that shows all points of a campaign.

use std::path::PathBuf;

use serde_json::{Value as Json, json};
use wingbeat_case::IoError;
use wingbeat_draw::points;
use wingbeat_results::file::{Existing, NewFile};
use wingbeat_results::summary::Verdict;

use crate::campaign::Campaign;
use crate::command::command;
use crate::merge::rows::{Row, rows};
use crate::plan::value::Value;
use crate::store::Store;

/// Name of the page in the directory of the campaign.
pub const FILE: &str = "campaign.html";

/// Points of a page at most; of larger campaigns each so many-th is shown.
pub const MAX_POINTS: usize = 20_000;

/// Writes the page of a campaign, finished or not.
///
/// # Errors
/// A result that cannot be read; a page that cannot be written.
pub fn write(campaign: &Campaign, store: &Store) -> Result<PathBuf, IoError> {
    let stride = campaign.plan().points().div_ceil(MAX_POINTS);
    let shown: Vec<Row> = rows(campaign, store)
        .step_by(stride)
        .collect::<Result<_, _>>()?;
    let path = store.path(FILE);
    let page = points::page(campaign.name(), &data(campaign, store, &shown, stride));
    NewFile::claim_own(&path, Existing::Replaced)?.write(page.as_bytes())?;
    Ok(path)
}

/// What the page knows.
fn data(campaign: &Campaign, store: &Store, shown: &[Row], stride: usize) -> Json {
    let keys = campaign
        .plan()
        .keys()
        .iter()
        .map(|key| json!({ "name": key, "kind": "key", "about": "varied" }));
    let numbers = campaign
        .numbers
        .iter()
        .map(|n| json!({ "name": n.name, "kind": "number", "unit": n.unit, "about": n.about }));
    let verdict = shown.iter().any(|row| row.verdict.is_some()).then(|| {
        let names = [Verdict::Red, Verdict::Amber, Verdict::Green].map(Verdict::word);
        json!({ "name": "verdict", "kind": "verdict", "names": names, "about": "how far the flight can be trusted" })
    });
    let of_verdict = |row: &Row| {
        verdict
            .is_some()
            .then(|| json!(row.verdict.map(Verdict::word)))
    };
    let columns: Vec<Json> = keys.chain(numbers).chain(verdict.clone()).collect();
    let value = |v: &Value| v.number().map_or_else(|| json!(v.shown()), |x| json!(x));
    let number = |x: &f64| if x.is_finite() { json!(x) } else { Json::Null };
    let points: Vec<Json> = shown
        .iter()
        .map(|row| {
            let cells: Vec<Json> = row.keys.iter().map(value).chain(row.numbers.iter().map(number)).chain(of_verdict(row)).collect();
            let page = format!("files/{}/flight.html", row.hash);
            let kept = store.path(&page).is_file();
            json!({
                "point": row.point,
                "cells": cells,
                "failed": row.failed.as_ref().map(|(reason, words)| format!("{}: {words}", reason.name())),
                "flown": row.success.is_some(),
                "command": command(campaign, row.point),
                "page": kept.then_some(page),
            })
        })
        .collect();
    json!({
        "name": campaign.name(),
        "description": campaign.raw().description,
        "case": campaign.base().origin(),
        "tasks": campaign.raw().tasks.iter().map(|t| t.name()).collect::<Vec<_>>(),
        "version": env!("CARGO_PKG_VERSION"),
        "points": campaign.plan().points(),
        "stride": stride,
        "columns": columns,
        "rows": points,
    })
}
