//! All points as one table: CSV, Parquet, `NetCDF`; and those that failed. Nothing of it tells when, where, by how many
//! workers or in which order points were flown.

pub(crate) mod netcdf;
pub(crate) mod rows;

use std::io::Write;
use std::ops::Range;
use std::path::PathBuf;

use wingbeat_case::IoError;
use wingbeat_case::keys::described;
use wingbeat_results::directory::remove_left_behind;
use wingbeat_results::export::parquet::{Cell, Cells, ParquetWriter};
use wingbeat_results::file::{Existing, NewFile};
use wingbeat_results::manifest::hexadecimal;
use wingbeat_results::summary::Verdict;

use crate::campaign::Campaign;
use crate::command::command;
use crate::merge::rows::{KeyKind, Row, kinds, rows};
use crate::plan::value::Value;
use crate::store::Store;

/// Files that a merge writes.
pub const FILES: [&str; 4] = ["points.csv", "points.parquet", "points.nc", "failed.csv"];

/// Points that have no result yet.
///
/// # Errors
/// A result that cannot be read.
pub fn missing(campaign: &Campaign, store: &Store) -> Result<usize, IoError> {
    let mut rows = rows(campaign, store);
    rows.try_fold(0, |n, row| Ok(n + usize::from(row?.success.is_none())))
}

/// Writes the points of `range` as a table: number, hash, values of the keys.
///
/// # Errors
/// What cannot be written.
pub fn plan(campaign: &Campaign, range: Range<usize>, out: &mut dyn Write) -> std::io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let keys = campaign.plan().keys().iter().map(String::as_str);
    let header = ["point", "sha256"].into_iter().chain(keys);
    table.write_record(header).map_err(io)?;
    let mut cells: Vec<String> = vec![];
    for i in range {
        cells.clear();
        cells.extend([i.to_string(), hexadecimal(&campaign.hash(i))]);
        cells.extend(campaign.plan().values(i).iter().map(Value::shown));
        table.write_record(&cells).map_err(io)?;
    }
    table.flush()
}

/// What the system said.
fn io(e: csv::Error) -> std::io::Error {
    match e.into_kind() {
        csv::ErrorKind::Io(e) => e,
        other => std::io::Error::other(format!("{other:?}")),
    }
}

/// Writes the tables into the directory of the campaign.
///
/// # Errors
/// A result that cannot be read; a file that cannot be written.
pub fn merge(campaign: &Campaign, store: &Store) -> Result<Vec<PathBuf>, IoError> {
    store.remove_half_written();
    remove_left_behind(store.root(), |name| FILES.contains(&name));
    let rows: Vec<Row> = rows(campaign, store).collect::<Result<_, _>>()?;
    let place = |name: &str| NewFile::claim_own(&store.path(name), Existing::Replaced);
    place(FILES[0])?.write(&points_csv(campaign, &rows)?)?;
    place(FILES[1])?.make(|part| parquet(campaign, &rows, part).map_err(IoError::write(part)))?;
    place(FILES[2])?
        .make(|part| netcdf::write(campaign, &rows, part).map_err(IoError::write(part)))?;
    place(FILES[3])?.write(&failed_csv(campaign, &rows)?)?;
    Ok(FILES.iter().map(|name| store.path(name)).collect())
}

/// Numbers of a point that failed stay empty.
fn points_csv(campaign: &Campaign, rows: &[Row]) -> Result<Vec<u8>, IoError> {
    let mut table = csv::Writer::from_writer(vec![]);
    let keys = campaign.plan().keys().iter().map(String::as_str);
    let numbers = campaign.numbers.iter().map(|n| n.name.as_str());
    let header = ["point"]
        .into_iter()
        .chain(keys)
        .chain(["success", "verdict"])
        .chain(numbers);
    let lost = "memory takes every row";
    table.write_record(header.chain(["reason"])).expect(lost);
    for row in rows {
        let mut cells = vec![row.point.to_string()];
        cells.extend(row.keys.iter().map(Value::shown));
        cells.push(
            row.success
                .map_or_else(String::new, |s| u8::from(s).to_string()),
        );
        cells.push(verdict(row).to_owned());
        let number = |x: &f64| {
            if x.is_finite() {
                format!("{x:?}")
            } else {
                String::new()
            }
        };
        cells.extend(row.numbers.iter().map(number));
        cells.push(reason(row).to_owned());
        table.write_record(&cells).expect(lost);
    }
    Ok(table.into_inner().expect(lost))
}

fn verdict(row: &Row) -> &'static str {
    row.verdict.map_or("", Verdict::word)
}

fn reason(row: &Row) -> &'static str {
    match (&row.failed, row.success) {
        (Some((reason, _)), _) => reason.name(),
        (None, Some(_)) => "",
        (None, None) => "missing",
    }
}

/// Points that failed, with why, their cases and how to fly them.
fn failed_csv(campaign: &Campaign, rows: &[Row]) -> Result<Vec<u8>, IoError> {
    let mut table = csv::Writer::from_writer(vec![]);
    let lost = "memory takes every row";
    let header = [
        "point",
        "sha256",
        "reason",
        "message",
        "command",
        "case_toml",
    ];
    table.write_record(header).expect(lost);
    for row in rows {
        let Some((reason, message)) = &row.failed else {
            continue;
        };
        // A key that cannot be put into the case is the message.
        let text = campaign.case_text(row.point).unwrap_or_default();
        let command = command(campaign, row.point);
        let point = row.point.to_string();
        let cells = [&point, &row.hash, reason.name(), message, &command, &text];
        table.write_record(cells).expect(lost);
    }
    Ok(table.into_inner().expect(lost))
}

fn parquet(campaign: &Campaign, rows: &[Row], path: &std::path::Path) -> std::io::Result<()> {
    let cells = |kind: &KeyKind| match kind {
        KeyKind::Whole => Cells::Counts,
        KeyKind::Number => Cells::Numbers,
        KeyKind::Text => Cells::Texts,
    };
    let kinds = kinds(campaign);
    let mut columns = vec![("point".to_owned(), Cells::Counts)];
    columns.extend(
        campaign
            .plan()
            .keys()
            .iter()
            .cloned()
            .zip(kinds.iter().map(cells)),
    );
    columns.push(("success".to_owned(), Cells::Flags));
    columns.push(("verdict".to_owned(), Cells::Texts));
    columns.extend(
        campaign
            .numbers
            .iter()
            .map(|n| (n.name.clone(), Cells::Numbers)),
    );
    columns.push(("reason".to_owned(), Cells::Texts));
    let mut table = ParquetWriter::create(path, "points", columns)?;
    for row in rows {
        let texts: Vec<String> = row.keys.iter().map(Value::shown).collect();
        let key = |(k, value): (usize, &Value)| match (kinds[k], value) {
            (KeyKind::Text, _) => Cell::Text(texts[k].as_str()),
            (KeyKind::Whole, Value::Whole(n)) => Cell::Count(*n),
            _ => Cell::Number(value.number().unwrap_or(f64::NAN)),
        };
        let keys: Vec<Cell> = row.keys.iter().enumerate().map(key).collect();
        let head = [Cell::Count(row.point as i64)].into_iter().chain(keys);
        let numbers = row.numbers.iter().map(|x| Cell::Number(*x));
        let all = (head.chain([Cell::Flag(row.success), Cell::Text(verdict(row))])).chain(numbers);
        table.cells(all.chain([Cell::Text(reason(row))]))?;
    }
    let [units, meanings] = notes(campaign);
    table.finish(&[
        ("wingbeat_version", env!("CARGO_PKG_VERSION")),
        ("campaign_toml", campaign.text()),
        ("case_toml", campaign.base().text()),
        ("units", &units),
        ("meanings", &meanings),
    ])
}

/// Units and meanings of the columns of keys and numbers by their names, as JSON; texts have no unit.
fn notes(campaign: &Campaign) -> [String; 2] {
    let keys = campaign.plan().keys().iter();
    let keys = keys.filter_map(|key| Some((key.clone(), described(key)?)));
    let kinds = campaign.plan().keys().iter().zip(kinds(campaign));
    let texts = kinds.filter(|(_, kind)| *kind == KeyKind::Text);
    let texts: Vec<&String> = texts.map(|(key, _)| key).collect();
    let numbers = campaign.numbers.iter();
    let numbers = numbers.map(|n| (n.name.clone(), [n.unit.clone(), n.about.clone()]));
    let all: Vec<(String, [String; 2])> = keys.chain(numbers).collect();
    [0, 1].map(|k| {
        let notes = all
            .iter()
            .filter(|(name, _)| k == 1 || !texts.contains(&name))
            .map(|(name, of)| (name.clone(), of[k].clone().into()));
        serde_json::Value::Object(notes.collect()).to_string()
    })
}
