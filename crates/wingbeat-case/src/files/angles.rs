//! Tables of angles.

use std::path::Path;

use csv::StringRecord;
use wingbeat_model::ModelError;
use wingbeat_model::motion::{Fourier, PeriodicSpline};

use super::csv_file::{CsvFile, words_of};
use super::read::twice;
use crate::error::Fault;
use crate::raw::{ANGLES, TableCase};

/// Puts the rows of the table at `path` into this program's convention, those of its file if it names one; how many
/// rows of the file have no angle.
pub(super) fn read(path: &str, table: &mut TableCase, base: &Path) -> Result<usize, Fault> {
    let convention = Convention::take(path, table)?;
    let Some(name) = table.file.take() else {
        let rows = table.rows_deg.iter_mut().flatten();
        rows.for_each(|row| *row = convention.apply(*row));
        return Ok(0);
    };
    let key = format!("{path}.file");
    if table.rows_deg.is_some() {
        return Err(twice(key, "the table", "file or rows_deg"));
    }
    let csv = CsvFile {
        file: base.join(&name),
        key,
    };
    let columns = [&table.phase_column, &table.angle_column];
    let names = columns.map(|c| c.as_deref());
    let (rows, gaps) = rows(&csv, names, &convention, table.harmonics)?;
    table.rows_deg = Some(rows);
    (table.phase_column, table.angle_column) = (None, None);
    Ok(gaps)
}

/// How a table counts phases and angles.
struct Convention {
    /// Wingbeats in one unit of its first column; none of phases.
    beats_per_unit: Option<f64>,
    factor: f64,
    /// Of the angle that it calls 0 \[deg\].
    offset: f64,
}

impl Convention {
    /// That of the table at `path`, whose rows are in this program's from then on.
    fn take(path: &str, table: &mut TableCase) -> Result<Self, Fault> {
        let convention = Self {
            beats_per_unit: table.beats_per_unit.take(),
            factor: table.factor.take().unwrap_or(1.0),
            offset: table.offset_deg.take().unwrap_or(0.0),
        };
        match convention.factor == 0.0 {
            false => Ok(convention),
            true => Err(Fault::new(
                format!("{path}.factor"),
                "this makes all angles the same",
                "a finite number other than 0",
                "1 where angles count as here, -1 where they count the other way",
            )),
        }
    }

    fn apply(&self, [x, angle]: [f64; 2]) -> [f64; 2] {
        let x = self.beats_per_unit.map_or(x, |beats| beats * x);
        [x, self.factor * angle + self.offset]
    }
}

/// Phase \[1\] and angle \[deg\] of each row that has an angle, from these columns, or the first two; how many rows
/// have none.
fn rows(
    csv: &CsvFile,
    names: [Option<&str>; 2],
    convention: &Convention,
    harmonics: Option<usize>,
) -> Result<(Vec<[f64; 2]>, usize), Fault> {
    let choose = |header: &StringRecord| {
        let columns = [
            csv.column(header, ("phase_column", names[0]), 0)?,
            csv.column(header, ("angle_column", names[1]), 1)?,
        ];
        if names[1].is_none() {
            check_angle(csv, header)?;
        }
        Ok(columns)
    };
    let table = csv.columns(choose)?;
    if convention.beats_per_unit.is_none() {
        check_phase(csv, &table.names[0])?;
    }
    let unit = degrees(&table.names[1]);
    let to_degrees = unit.map_err(|problem| csv.bad(&problem))?;
    if to_degrees != 1.0 {
        check_radians(csv, &table.names[1], &table.rows)?;
    }
    let converted = |&[x, angle]: &[f64; 2]| convention.apply([x, to_degrees * angle]);
    let rows: Vec<_> = table.rows.iter().map(converted).collect();
    check(csv, &rows, &table.lines, harmonics).map_err(|fault| {
        let mut fault = match convention.beats_per_unit {
            Some(beats) => timed(fault, &rows, beats, &table.names[0]),
            None => fault,
        };
        if let Some(line) = table.gaps.first() {
            let count = table.gaps.len();
            fault.problem += &format!(
                "; rows without an angle are left out ({count}, the first in line {line})"
            );
        }
        fault
    })?;
    Ok((rows, table.gaps.len()))
}

/// The fault of a table of times, with how many wingbeats it has and what a unit of its column asks for.
fn timed(mut fault: Fault, rows: &[[f64; 2]], beats: f64, column: &str) -> Fault {
    let span = rows[rows.len() - 1][0] - rows[0][0];
    fault.problem +=
        &format!(". With beats_per_unit = {beats} the table goes on for {span:.1} wingbeats");
    let words = words_of(column);
    let has = |names: &[&str]| words.iter().any(|w| names.contains(&w.as_str()));
    let unit = match () {
        () if has(&["ms", "millisecond", "milliseconds"]) => {
            "in ms the frequency in kHz, 0.2 for 200 Hz"
        }
        () if has(&["us"]) => "in us the frequency in MHz, 0.0002 for 200 Hz",
        () if has(&["frame", "frames"]) => "the frequency over that of the frames",
        () => "the frequency in Hz for seconds, in kHz for ms",
    };
    fault.remedy = format!(
        "where that is more or less than was measured, correct beats_per_unit, the wingbeats in one unit of `{column}`: {unit}"
    );
    fault
}

/// Degrees in the unit that the name of a column says, as `psi_rad` or `psi [deg]`; degrees where it says none.
fn degrees(column: &str) -> Result<f64, String> {
    let words = words_of(column);
    let any = |names: &[&str]| words.iter().any(|w| names.contains(&w.as_str()));
    let radians = any(&["rad", "rads", "radian", "radians"]);
    if let Some(unit) = words.iter().find(|w| OTHER_UNITS.contains(&w.as_str())) {
        return Err(format!(
            "the name of the column `{column}` says `{unit}`, and angles are read in degrees (`deg`) or radians (`rad`): convert them, or name the column without a unit and give what makes degrees of them as factor"
        ));
    }
    match (radians, any(&["deg", "degs", "degree", "degrees"])) {
        (true, true) => Err(format!(
            "the name of the column `{column}` says both radians and degrees"
        )),
        (true, false) => Ok(1f64.to_degrees()),
        (false, _) => Ok(1.0),
    }
}

/// Refuses angles of a column that says radians which range over more than a whole turn: they are degrees.
fn check_radians(csv: &CsvFile, column: &str, rows: &[[f64; 2]]) -> Result<(), Fault> {
    // Angles that were wrapped range over a whole turn, and some are rounded.
    const TURN: f64 = 1.01 * std::f64::consts::TAU;
    let angles = || rows.iter().map(|row| row[1]);
    let (least, most) = (
        angles().fold(f64::INFINITY, f64::min),
        angles().fold(f64::NEG_INFINITY, f64::max),
    );
    if most - least <= TURN {
        return Ok(());
    }
    let mut fault = csv.bad(&format!(
        "the name of the column `{column}` says radians, and it holds {least} to {most}, more than a whole turn"
    ));
    fault.remedy = format!(
        "name the column after degrees where its angles are (`{}`), or correct the rows",
        in_degrees(column)
    );
    Err(fault)
}

/// The name of a column that says radians with degrees in their place, in the same letters: `Phi_Deg` for
/// `Phi_Rad`.
fn in_degrees(column: &str) -> String {
    let piece = |piece: &str| {
        let word = piece.trim_end_matches(|c: char| !c.is_alphanumeric());
        let degrees = match word.to_lowercase().as_str() {
            "rad" => "deg",
            "rads" => "degs",
            "radian" => "degree",
            "radians" => "degrees",
            _ => return piece.to_owned(),
        };
        let degrees = match word {
            _ if word == word.to_uppercase() => degrees.to_uppercase(),
            _ if word.starts_with(char::is_uppercase) => degrees.replacen('d', "D", 1),
            _ => degrees.to_owned(),
        };
        degrees + &piece[word.len()..]
    };
    let pieces = column.split_inclusive(|c: char| !c.is_alphanumeric());
    pieces.map(piece).collect()
}

/// Words in the name of a column that say a unit of angles which is not read.
const OTHER_UNITS: [&str; 18] = [
    "mrad",
    "urad",
    "milliradian",
    "milliradians",
    "mdeg",
    "arcmin",
    "arcsec",
    "gon",
    "grad",
    "grads",
    "gradian",
    "gradians",
    "turn",
    "turns",
    "rev",
    "revs",
    "percent",
    "pct",
];

/// Words in the name of a column that say a unit of time, or count frames.
const TIMES: [&str; 11] = [
    "s",
    "ms",
    "us",
    "sec",
    "secs",
    "second",
    "seconds",
    "millisecond",
    "milliseconds",
    "frame",
    "frames",
];

/// Refuses phases whose column says that they are times.
fn check_phase(csv: &CsvFile, column: &str) -> Result<(), Fault> {
    let words = words_of(column);
    let Some(unit) = words.iter().find(|w| TIMES.contains(&w.as_str())) else {
        return Ok(());
    };
    let mut fault = csv.bad(&format!(
        "its column `{column}` says `{unit}`, and phases are in wingbeats"
    ));
    fault.remedy =
        "give beats_per_unit, the wingbeats in one unit of it: the frequency in Hz for seconds; or phases, in a column named `phase`".to_owned();
    Err(fault)
}

/// Refuses a second column that is named after another angle than the key's.
fn check_angle(csv: &CsvFile, header: &StringRecord) -> Result<(), Fault> {
    let name = header.get(1).unwrap_or_default();
    let table = csv.key.strip_suffix(".table.file").unwrap_or(&csv.key);
    let angle = table.rsplit('.').next();
    let own = ANGLES.iter().find(|a| angle == Some(**a));
    let named = ANGLES.iter().find(|a| name.starts_with(**a));
    match (own, named) {
        (Some(own), Some(named)) if own != named => {
            let problem = format!("its second column is `{name}`, and this is the table of {own}");
            let mut fault = csv.bad(&problem);
            fault.remedy = format!("name the column of {own}: angle_column = \"...\"");
            Err(fault)
        }
        _ => Ok(()),
    }
}

/// Rows, at these lines of the file, that are no motion are refused here, where their lines are known.
fn check(
    csv: &CsvFile,
    rows: &[[f64; 2]],
    lines: &[u64],
    harmonics: Option<usize>,
) -> Result<(), Fault> {
    let pairs: Vec<(f64, f64)> = rows.iter().map(|&[x, q]| (x, q)).collect();
    let motion = match harmonics {
        None => PeriodicSpline::new("", &pairs).map(|_| ()),
        Some(n) => Fourier::fitted("", &pairs, n).map(|_| ()),
    };
    if let Err(ModelError::Table { row, problem, .. }) = motion {
        let line = row.checked_sub(1).and_then(|k| lines.get(k)).copied();
        let line = line.unwrap_or_default();
        return Err(csv.bad(&format!("line {line}: {problem}")));
    }
    Ok(())
}
