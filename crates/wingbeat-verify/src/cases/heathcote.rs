//! A foil with a flexible rear that plunges in water, after Heathcote & Gursul.

use std::borrow::Cow;

use wingbeat_flight::Simulation;

use crate::lab::foil::{CHORD, HEAVE, PlungingFoil, SPAN, SPEED};
use crate::lab::series::{Table, harmonic, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[Case {
    name: "heathcote-gursul",
    about: "A foil of 90 mm, 30 mm of it rigid and 60 mm a thin steel plate, plunges in water at Strouhal numbers \
            from 0.1 to 0.96: amplitude of its pitch, and what bending adds to its thrust, attached flow; thrust of the \
            stiffest foil also with leading-edge vorticity.",
    part: Part::Experiments,
    quick: false,
    run,
}];

/// Flexible plates, thickness over chord, and the one that hardly bends.
const PLATES: [&str; 2] = ["0.85e-3", "1.41e-3"];
const STIFF: &str = "4.23e-3";
/// Beats before the means begin, and beats that wakes are kept.
const BEFORE: usize = 3;
const KEPT: f64 = 3.0;

/// Panels along the chord, steps of a beat, beats.
type Mesh = [usize; 3];
const MESH: Mesh = [24, 60, 7];
const FINE: Mesh = [36, 90, 5];

/// What becomes of the leading edge: nothing leaves it, or what exceeds the suction that round ones hold in the
/// other experiments of the report, by the step before, with the cores of that and wakes kept 0.1 chords off the foil.
#[derive(Clone, Copy, PartialEq)]
enum Edge {
    Attached,
    Sheds,
}

impl Edge {
    fn name(self) -> &'static str {
        match self {
            Self::Attached => "attached",
            Self::Sheds => "leading-edge vorticity",
        }
    }

    fn keys(self) -> Vec<String> {
        let keys: &[&str] = match self {
            Self::Attached => &[],
            Self::Sheds => &[
                "air.shed=[\"trailing\",\"leading\"]",
                "air.leading_edge=suction",
                "air.leading_edge_threshold=0.18",
                "air.leading_edge_suction_efficiency=1.0",
                "air.wake_core={cut_off={length_m=1.8e-3}}",
                "air.clearance_m=0.009",
            ],
        };
        keys.iter().map(|k| (*k).to_owned()).collect()
    }
}

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

/// A foil with a plate of the thickness `part` over its chord at a Strouhal number `2 f a / U`.
fn plunge(part: f64, strouhal: f64, edge: Edge, mesh: Mesh) -> Result<Beats, VerifyError> {
    let [rows, steps, beats] = mesh;
    let foil = PlungingFoil {
        thickness: part,
        frequency: strouhal * SPEED / (2.0 * HEAVE),
        heave: HEAVE,
        rows,
        steps,
        beats,
        kept: KEPT,
    };
    let mut flight = Simulation::new(foil.case(&edge.keys())?.setup)?;
    let (mut pitch, mut thrust) = (vec![], vec![]);
    while !flight.finished() {
        let record = flight.step()?;
        pitch.push(record.elastic[0].twist.to_degrees());
        thrust.push(record.air_force().x);
    }
    let scale = 0.5 * 1000.0 * SPEED * SPEED * CHORD * SPAN;
    let beat = |k: usize| steps * k - 1..steps * (k + 1);
    let amplitude = |k: usize| {
        let [a, b] = harmonic(&pitch[beat(k)], steps, 1);
        a.hypot(b)
    };
    let of = |value: &dyn Fn(usize) -> f64| {
        Mean::over(&(BEFORE..beats).map(value).collect::<Vec<f64>>())
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
const BAND: &str = "10 %, stated beforehand (attached flow was chosen by the thrust of the stiffest plate, after flights of all plates had been seen); uncertainty: standard error over beats, and the change by 36 panels and 90 steps a beat at the middle Strouhal number. At \
                    Strouhal numbers of 0.27 the two plates differ by 2.6 as measured; plates of these thicknesses differ by 4.6 in any air, their bending being small";
const DIFFERENCE: &str = "20 %, stated beforehand (attached flow and the points, those next to measured thrusts, were chosen afterwards); no friction; uncertainty: standard error over beats, and the change of the thrust by 36 panels and 90 steps a beat. The \
                          stiffest foil is flown as the plate of 4.23e-3 that it is; between points straight lines over the square of the Strouhal number, \
                          both measured and computed";
const STIFF_REASON: &str = "no friction: the measured drag at a Strouhal number of 0.1 is 0.08, where attached theory has a thrust of 0.08";

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let [s, thrust] = measured("thrust_coefficient", STIFF);
    let mut rows = vec![];
    let mut stiff = vec![];
    for edge in [Edge::Sheds, Edge::Attached] {
        stiff = s.iter().map(|&s| beat(STIFF, s, edge, MESH)).collect();
        rows.extend(stiff_rows(edge, [&s, &thrust], &stiff));
    }
    for plate in PLATES {
        let [strouhal, pitch] = measured("pitch_amplitude", plate);
        let fly = |&s: &f64| beat(plate, s, Edge::Attached, MESH);
        let beats: Vec<Beats> = strouhal.iter().map(fly).collect();
        let middle = strouhal.len() / 2;
        let fine = beat(plate, strouhal[middle], Edge::Attached, FINE);
        let change = |of: fn(&Beats) -> Mean| {
            let change = of(&fine).of / of(&beats[middle]).of - 1.0;
            if change.is_finite() { change } else { 1.0 } // a flight that ends early decides nothing
        };
        rows.extend(pitch_rows(
            plate,
            [&strouhal, &pitch],
            &beats,
            change(|b| b.pitch),
        ));
        let flown = (strouhal.as_slice(), beats.as_slice());
        rows.extend(thrust_rows(
            plate,
            flown,
            (&s, &stiff),
            change(|b| b.thrust),
        ));
    }
    Ok(rows)
}

/// The same; no numbers where the flight ends in an error, which the row then says.
fn beat(plate: &str, strouhal: f64, edge: Edge, mesh: Mesh) -> Beats {
    let part = plate.parse().expect("a number");
    plunge(part, strouhal, edge, mesh).unwrap_or_else(|error| Beats {
        pitch: Mean::NONE,
        thrust: Mean::NONE,
        ended: Some(error.to_string()),
    })
}

/// Value at `x` of a table with rising abscissae by straight lines over their square, as thrust goes; the outer
/// ones go on beyond the ends.
fn over_squares(s: &[f64], values: &[f64], x: f64) -> f64 {
    let from = s.iter().rposition(|a| *a <= x).unwrap_or(0);
    let k = from.min(s.len() - 2);
    let part = (x * x - s[k] * s[k]) / (s[k + 1] * s[k + 1] - s[k] * s[k]);
    values[k] + part * (values[k + 1] - values[k])
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

/// Values of flights beside measured ones, but for those that ended in an error.
fn compared(
    quantity: &'static str,
    name: impl Into<Cow<'static, str>>,
    [strouhal, reference]: [&[f64]; 2],
    computed: impl Iterator<Item = f64>,
) -> Comparison {
    let points = strouhal.iter().zip(reference).zip(computed);
    Comparison {
        quantity: quantity.into(),
        along: "Strouhal number [1]".into(),
        against: "measured".into(),
        name: name.into(),
        points: points
            .map(|((s, r), c)| [*s, *r, c])
            .filter(|p| p[2].is_finite())
            .collect(),
    }
}

/// What the leading edge makes of the thrust where next to nothing bends.
fn stiff_rows(edge: Edge, measured: [&[f64]; 2], beats: &[Beats]) -> Vec<Row> {
    let row = |((s, t), b): ((&f64, &f64), &Beats)| {
        let name = edge.name();
        let name =
            format!("{name}: thrust coefficient of the plate b/c {STIFF}, Strouhal number {s:.2}");
        let row = Row::new(name, "1", b.thrust.of).against(*t, THRUST);
        told(row.uncertain(b.thrust.error).because(STIFF_REASON), b)
    };
    let computed = beats.iter().map(|b| b.thrust.of);
    let name = format!("b/c {STIFF}, {}", edge.name());
    let comparison = compared("thrust coefficient [1]", name, measured, computed);
    let points = measured[0].iter().zip(measured[1]).zip(beats);
    drawn(points.map(row).collect(), comparison)
}

/// The comparison with the first of the rows.
fn drawn(mut rows: Vec<Row>, comparison: Comparison) -> Vec<Row> {
    if let Some(first) = rows.first_mut() {
        *first = first.clone().drawn(comparison);
    }
    rows
}

fn pitch_rows(plate: &str, measured: [&[f64]; 2], beats: &[Beats], change: f64) -> Vec<Row> {
    let row = |((s, p), b): ((&f64, &f64), &Beats)| {
        let name = format!("pitch of the plate b/c {plate} at a Strouhal number of {s:.2}");
        let row = Row::new(name, "deg", b.pitch.of)
            .against(*p, SOURCE)
            .uncertain(b.pitch.error.hypot(change * b.pitch.of))
            .within_part(0.1, BAND);
        told(decided(row, b.pitch.error), b)
    };
    let computed = beats.iter().map(|b| b.pitch.of);
    let name = format!("b/c {plate}");
    let comparison = compared("amplitude of the pitch [deg]", name, measured, computed);
    let points = measured[0].iter().zip(measured[1]).zip(beats);
    drawn(points.map(row).collect(), comparison)
}

/// Strouhal numbers nearer than this to a measured one are taken to be measured \[1\].
const NEAR: f64 = 0.01;

/// What bending adds to the thrust, where it is measured.
fn thrust_rows(
    plate: &str,
    (strouhal, beats): (&[f64], &[Beats]),
    (stiff_at, stiff): (&[f64], &[Beats]),
    change: f64,
) -> Vec<Row> {
    let [[s, bent], [s0, rigid]] = [plate, STIFF].map(|p| measured("thrust_coefficient", p));
    let least: Vec<f64> = stiff.iter().map(|b| b.thrust.of).collect();
    let is_measured = |x: f64| {
        let within = x > s0[0] - NEAR && x < s0[s0.len() - 1] + NEAR;
        within && s.iter().any(|s| (s - x).abs() < NEAR)
    };
    let row = |(&x, b): (&f64, &Beats)| {
        let added = |bent: f64, least: &[f64]| bent - over_squares(stiff_at, least, x);
        let reference = added(over_squares(&s, &bent, x), &rigid);
        let computed = added(b.thrust.of, &least);
        let error = b.thrust.error.hypot(change * b.thrust.of);
        let name = format!(
            "thrust coefficient of the plate b/c {plate} less that of b/c {STIFF}, Strouhal number {x:.2}"
        );
        let row = Row::new(name, "1", computed)
            .against(reference, THRUST)
            .uncertain(error)
            .within_part(0.2, DIFFERENCE);
        told(decided(row, b.thrust.error), b)
    };
    let both = strouhal.iter().zip(beats);
    both.filter(|(x, _)| is_measured(**x)).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_points_of_both_plates_are_read() {
        let [s, p] = measured("pitch_amplitude", PLATES[0]);
        assert!(s.len() == 9 && p.len() == 9 && (s[0] - 0.2682).abs() < 1e-12);
        let [s, t] = measured("thrust_coefficient", STIFF);
        assert!(s.len() == 11 && t.iter().all(|t| (-0.1..10.0).contains(t)));
    }

    #[test]
    fn exact_lines_over_squares_carry_a_parabola() {
        let s = [0.1, 0.2, 0.4];
        let v = s.map(|s| 3.0 * s * s - 1.0);
        for x in [0.09, 0.1, 0.15, 0.3, 0.41] {
            assert!((over_squares(&s, &v, x) - (3.0 * x * x - 1.0)).abs() < 1e-14);
        }
    }
}
