//! Outlines of wings, digitised from pictures.

use std::path::Path;

use csv::StringRecord;
use wingbeat_model::planform::{Landmarks, Planform};

use super::csv_file::{CsvFile, words_of};
use super::read::twice;
use crate::error::Fault;
use crate::raw::OutlineCase;

/// Units of length in the names of columns, and their size \[m\].
const UNITS: [(&str, f64); 6] = [
    ("m", 1.0),
    ("cm", 1e-2),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("\u{b5}m", 1e-6),
    ("\u{3bc}m", 1e-6),
];

/// Reads the file of the outline at `path`, if it names one: both edges take its place.
pub(super) fn read(path: &str, outline: &mut OutlineCase, base: &Path) -> Result<(), Fault> {
    let Some(name) = outline.file.take() else {
        return Ok(());
    };
    let key = format!("{path}.file");
    if outline.leading_m.is_some() || outline.trailing_m.is_some() {
        return Err(twice(
            key,
            "the outline",
            "file, or leading_m with trailing_m",
        ));
    }
    let csv = CsvFile {
        file: base.join(&name),
        key,
    };
    let (points, named) = points(&csv, outline)?;
    let marks = landmarks(path, outline, named)?;
    let placed = marks.place(&points);
    let points = placed.map_err(|e| landmark_fault(path, &e.to_string()))?;
    let bad = |e| {
        let mut fault = csv.bad(&format!("{e}"));
        fault.allowed = "points once around the wing, from the hinge outwards".into();
        fault.remedy = "correct the file, or file_hinge and file_tip".into();
        fault
    };
    let planform = Planform::from_polygon(&points, outline.least_chord).map_err(bad)?;
    planform.edges().map_err(bad)?;
    if let Planform::Outline {
        leading, trailing, ..
    } = planform
    {
        let lists = [leading, trailing].map(|edge| edge.into_iter().map(Into::into).collect());
        let [leading, trailing] = lists.map(Some);
        *outline = OutlineCase {
            leading_m: leading,
            trailing_m: trailing,
            least_chord: outline.least_chord,
            ..OutlineCase::default()
        };
    }
    Ok(())
}

/// The points of the file, and the unit \[m\] that the names of its columns say.
fn points(csv: &CsvFile, outline: &OutlineCase) -> Result<(Vec<[f64; 2]>, Option<f64>), Fault> {
    let names = [&outline.x_column, &outline.y_column].map(|c| c.as_deref());
    let choose = |header: &StringRecord| {
        let [x, y] = named_axes(header).unwrap_or([0, 1]);
        Ok([
            csv.column(header, ("x_column", names[0]), x)?,
            csv.column(header, ("y_column", names[1]), y)?,
        ])
    };
    let found = csv.columns(choose)?;
    if let Some(&line) = found.gaps.first() {
        return Err(csv.empty(line, &found.names));
    }
    let [x, y] = found.names.each_ref().map(|name| unit(name));
    if x != y {
        let [x, y] = found.names;
        return Err(csv.bad(&format!("its columns `{x}` and `{y}` are not in one unit")));
    }
    Ok((found.rows, x))
}

/// The only columns called x and y, whatever their unit and wherever they stand.
fn named_axes(header: &StringRecord) -> Option<[usize; 2]> {
    let first = |name: &str| words_of(name).into_iter().next().unwrap_or_default();
    let only = |axis: &str| {
        let mut found = (0..header.len()).filter(|&k| first(&header[k]) == axis);
        found.next().filter(|_| found.next().is_none())
    };
    Some([only("x")?, only("y")?])
}

/// The unit of length \[m\] that the name of a column says.
fn unit(column: &str) -> Option<f64> {
    let words = words_of(column);
    let mut known = UNITS
        .iter()
        .filter(|(name, _)| words.iter().any(|w| w == name));
    known.next().map(|(_, size)| *size)
}

/// Where the wing lies in the file; `named` is the unit \[m\] that its columns say.
fn landmarks(path: &str, outline: &OutlineCase, named: Option<f64>) -> Result<Landmarks, Fault> {
    let hinge = outline.file_hinge.unwrap_or_default();
    let marks = Landmarks {
        hinge,
        tip: outline.file_tip.unwrap_or([hinge[0] + 1.0, hinge[1]]),
        leading_edge: outline.file_leading_edge,
        unit: 1.0,
    };
    let [unit, length] = [outline.file_unit_m, outline.file_length_m];
    match (unit, length, named) {
        (None, None, None) => Err(Fault::new(
            format!("{path}.file"),
            "the unit of its numbers is not known",
            "a unit in the names of its columns, as x_mm and y_mm, or file_unit_m, or file_length_m with file_tip",
            "add `file_length_m`, the distance from hinge to tip, and `file_tip`, where the tip lies in the file",
        )),
        (Some(_), _, Some(_)) => Err(twice(
            format!("{path}.file_unit_m"),
            "the unit",
            "file_unit_m or a unit in the names of the columns",
        )),
        (_, Some(_), Some(_)) if outline.file_tip.is_some() => Err(twice(
            format!("{path}.file_length_m"),
            "the unit",
            "file_length_m or a unit in the names of the columns",
        )),
        (_, Some(length), _) => Ok(marks.scaled_to(length)),
        (unit, None, named) => Ok(Landmarks {
            unit: unit.or(named).unwrap_or(1.0),
            ..marks
        }),
    }
}

fn landmark_fault(path: &str, problem: &str) -> Fault {
    Fault::new(
        path,
        problem,
        "file_hinge, file_tip and file_leading_edge are three points in the numbers of the file",
        "read them off the picture again",
    )
}
