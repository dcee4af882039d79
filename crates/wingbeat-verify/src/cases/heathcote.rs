//! A foil with a flexible rear that plunges in water, after Heathcote & Gursul.

use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;

use crate::lab::series::{Table, harmonic, interpolate, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "heathcote-gursul",
    about: "A foil of 90 mm, 30 mm of it rigid and 60 mm a thin steel plate, plunges in water at Strouhal numbers \
            from 0.2 to 0.96: amplitude of its pitch, and what bending adds to its thrust.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const CHORD: f64 = 0.09;
const AMPLITUDE: f64 = 0.0175;
const SPEED: f64 = 0.1;
/// Span of the case \[m\].
const SPAN: f64 = 18.0;
/// Flexible plates, thickness over chord.
const PLATES: [&str; 2] = ["0.85e-3", "1.41e-3"];
const RIGID: &str = "4.23e-3";
/// Beats before the means begin, and beats that wakes are kept.
const BEFORE: usize = 3;
const KEPT: f64 = 2.0;

/// How finely and how long a run is made.
#[derive(Clone, Copy)]
struct Mesh {
    rows: usize,
    steps: usize,
    beats: usize,
}

const MESH: Mesh = Mesh {
    rows: 12,
    steps: 60,
    beats: 10,
};

const FINE: Mesh = Mesh {
    rows: 18,
    steps: 90,
    beats: 8,
};

/// Mean over beats, and its standard error.
#[derive(Clone, Copy)]
struct Mean {
    of: f64,
    error: f64,
}

impl Mean {
    const NONE: Self = Self {
        of: f64::NAN,
        error: f64::NAN,
    };

    fn over(beats: &[f64]) -> Self {
        let (n, of) = (beats.len() as f64, mean(beats));
        let square = beats.iter().map(|x| (x - of).powi(2)).sum::<f64>();
        let error = (square / (n - 1.0) / n).sqrt();
        Self { of, error }
    }
}

/// What a foil does in the mean of its beats.
struct Beats {
    /// Amplitude of the first harmonic of the angle of the line from leading to trailing edge \[deg\].
    pitch: Mean,
    /// Mean thrust over `rho U^2 c / 2` per span \[1\].
    thrust: Mean,
    /// The error that ended the flight, if one did.
    ended: Option<String>,
}

/// Young's modulus over 1 - nu^2 \[Pa\]: steel, a thousand times that of the rigid foil, which does not bend.
fn young(part: f64) -> f64 {
    let steel = 2.05e11 / (1.0 - 0.3 * 0.3);
    if part > 2e-3 { 1e3 * steel } else { steel }
}

/// Bars without mass from end to end of every row of nodes behind the rigid third of the chord: they turn alike.
fn bars(rows: usize) -> String {
    let bar = |i: usize| {
        let x = format!("{:?}", i as f64 / rows as f64);
        let stiffness = "bending_newton_m2 = [100.0, 100.0], torsion_newton_m2 = [1e5, 1e5]";
        format!("{{ from = [0.0, {x}], to = [1.0, {x}], radius_m = [0.01, 0.01], {stiffness} }}")
    };
    let all: Vec<String> = (rows / 3 + 1..=rows).map(bar).collect();
    all.join(", ")
}

/// A foil with a plate of the thickness `part` over its chord at a Strouhal number `2 f a / U`.
fn plunge(part: f64, strouhal: f64, mesh: Mesh) -> Result<Beats, VerifyError> {
    let frequency = strouhal * SPEED / (2.0 * AMPLITUDE);
    let thickness = part * CHORD;
    let set = [
        format!("flight.tether.z.frequency_hz={frequency}"),
        format!("time.step_s={}", 1.0 / (frequency * mesh.steps as f64)),
        format!("time.steps={}", mesh.steps * mesh.beats),
        format!("air.max_wake_age_s={}", KEPT / frequency),
        format!("wing.right.mesh.chordwise={}", mesh.rows),
        format!("wing.right.structure.shell.thickness_m=[{thickness},{thickness}]"),
        format!("wing.right.structure.shell.young_pa={}", young(part)),
        format!("wing.right.structure.vein=[{}]", bars(mesh.rows)),
    ];
    let text = include_str!("../../data/heathcote-gursul.toml");
    let case = LoadedCase::from_text("heathcote-gursul", text, Path::new(""), &set)?;
    let mut flight = Simulation::new(case.setup)?;
    let (mut pitch, mut thrust) = (vec![], vec![]);
    while !flight.finished() {
        let record = flight.step()?;
        pitch.push(record.elastic[0].twist.to_degrees());
        thrust.push(record.air_force().x);
    }
    let scale = 0.5 * 1000.0 * SPEED * SPEED * CHORD * SPAN;
    let beat = |k: usize| mesh.steps * k - 1..mesh.steps * (k + 1);
    let amplitude = |k: usize| {
        let [a, b] = harmonic(&pitch[beat(k)], mesh.steps, 1);
        a.hypot(b)
    };
    let of = |value: &dyn Fn(usize) -> f64| {
        Mean::over(&(BEFORE..mesh.beats).map(value).collect::<Vec<f64>>())
    };
    Ok(Beats {
        pitch: of(&amplitude),
        thrust: of(&|k| mean(&thrust[beat(k)]) / scale),
        ended: None,
    })
}

/// Strouhal numbers and values of the measured points of a plate.
fn measured(quantity: &str, plate: &str) -> [Vec<f64>; 2] {
    let table = Table::new(include_str!("../../data/heathcote_gursul2007.csv"));
    let [s, v] = ["strouhal", "value"].map(|k| table.numbers(k));
    let both = (table.words("quantity")).zip(table.words("thickness_over_chord"));
    let of = both.enumerate().filter(|(_, b)| *b == (quantity, plate));
    let keep: Vec<usize> = of.map(|(k, _)| k).collect();
    [s, v].map(|all| keep.iter().map(|&k| all[k]).collect())
}

const SOURCE: &str = "Heathcote & Gursul 2007, AIAA J. 45:1066 (S. Heathcote's thesis, fig. 5.13)";
const THRUST: &str = "Heathcote & Gursul 2007, AIAA J. 45:1066 (S. Heathcote's thesis, fig. 5.6)";
const BAND: &str = "10 %, stated beforehand; uncertainty: standard error over beats, and the change by 18 panels and 90 steps a beat at the middle Strouhal number. At \
                    Strouhal numbers of 0.27 the two plates differ by 2.6 as measured; plates of these thicknesses differ by 4.6 in any air, their bending being small";
const DIFFERENCE: &str = "20 %, stated beforehand; no friction; uncertainty: standard error over beats. The rigid foil is the plate of 4.23e-3, here without bending, measured \
                          values between points by straight lines";

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    for plate in PLATES {
        let [strouhal, pitch] = measured("pitch_amplitude", plate);
        let beats: Vec<Beats> = strouhal.iter().map(|&s| beat(plate, s, MESH)).collect();
        rows.extend(pitch_rows(plate, [&strouhal, &pitch], &beats));
        rows.extend(thrust_rows(plate, &strouhal, &beats));
    }
    Ok(rows)
}

/// The same; no numbers where the flight ends in an error, which the row then says.
fn beat(plate: &str, strouhal: f64, mesh: Mesh) -> Beats {
    let part = plate.parse().expect("a number");
    plunge(part, strouhal, mesh).unwrap_or_else(|error| Beats {
        pitch: Mean::NONE,
        thrust: Mean::NONE,
        ended: Some(error.to_string()),
    })
}

/// A row that says why it has no number, or whether its band is met whatever beats were flown.
fn told(mut row: Row, beats: &Beats) -> Row {
    if let Some(error) = &beats.ended {
        row.reason = format!("the flight ended: {error}").into();
    }
    row
}

/// What two standard errors leave of the verdict.
fn decided(mut row: Row, error: f64) -> Row {
    let Some(band) = row.tolerance.filter(|_| error.is_finite()) else {
        return row;
    };
    let [off, doubt] = [row.error().abs(), 2.0 * error];
    let verdict = match (off + doubt <= band, off - doubt > band) {
        (true, _) => "met",
        (_, true) => "missed",
        _ => "not decided",
    };
    row.reason = format!(
        "{}; with two standard errors of the mean: {verdict}",
        row.reason
    )
    .into();
    row
}

fn pitch_rows(plate: &str, [strouhal, pitch]: [&[f64]; 2], beats: &[Beats]) -> Vec<Row> {
    let middle = strouhal.len() / 2;
    let change = beat(plate, strouhal[middle], FINE).pitch.of / beats[middle].pitch.of - 1.0;
    let points = || (strouhal.iter().zip(pitch)).zip(beats);
    let comparison = Comparison {
        quantity: "amplitude of the pitch [deg]".into(),
        along: "Strouhal number [1]".into(),
        against: "measured".into(),
        name: format!("b/c {plate}").into(),
        points: points()
            .filter(|(_, b)| b.ended.is_none())
            .map(|((s, p), b)| [*s, *p, b.pitch.of])
            .collect(),
    };
    let row = |((s, p), b): ((&f64, &f64), &Beats)| {
        let name = format!("pitch of the plate b/c {plate} at a Strouhal number of {s:.2}");
        let mesh = if change.is_finite() { change } else { 0.0 };
        let row = Row::new(name, "deg", b.pitch.of)
            .against(*p, SOURCE)
            .uncertain(b.pitch.error.hypot(mesh * b.pitch.of))
            .within_part(0.1, BAND);
        told(decided(row, b.pitch.error), b)
    };
    let mut rows: Vec<Row> = points().map(row).collect();
    if let Some(first) = rows.first_mut() {
        *first = first.clone().drawn(comparison);
    }
    rows
}

/// What bending adds to the thrust, where both are measured.
fn thrust_rows(plate: &str, strouhal: &[f64], beats: &[Beats]) -> Vec<Row> {
    let [[s, bent], [s0, rigid]] = [plate, RIGID].map(|p| measured("thrust_coefficient", p));
    let both = strouhal.iter().zip(beats);
    let inside = both.filter(|(x, _)| s[0] <= **x && **x <= s[s.len() - 1]);
    let row = |(&x, bends): (&f64, &Beats)| {
        let stiff = beat(RIGID, x, MESH);
        let reference = interpolate(&s, &bent, x) - interpolate(&s0, &rigid, x);
        let error = bends.thrust.error.hypot(stiff.thrust.error);
        let name = format!(
            "thrust coefficient of the plate b/c {plate} less that of the rigid foil, Strouhal number {x:.2}"
        );
        let row = Row::new(name, "1", bends.thrust.of - stiff.thrust.of)
            .against(reference, THRUST)
            .uncertain(error)
            .within_part(0.2, DIFFERENCE);
        told(told(decided(row, error), &stiff), bends)
    };
    inside.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_points_of_both_plates_are_read() {
        let [s, p] = measured("pitch_amplitude", PLATES[0]);
        assert!(s.len() == 9 && p.len() == 9 && (s[0] - 0.2682).abs() < 1e-12);
        let [s, t] = measured("thrust_coefficient", RIGID);
        assert!(s.len() == 11 && t.iter().all(|t| (-0.1..10.0).contains(t)));
    }
}
