//! Wings of robots whose pitch is left to an elastic hinge: strokes as measured, pitch predicted.

use std::path::Path;

use crate::lab::hinged::{Air, Flown};
use crate::lab::series::{Table, harmonic, interpolate, rms};
use crate::{Case, Comparison, Part, Row, VerifyError};
use wingbeat_math::solve_small;

pub(super) const CASES: &[Case] = &[Case {
    name: "robobee-sdab",
    about: "Robots of the RoboBee kind on fixed mounts: strokes driven as measured, pitch left to the hinge of the authors' model; \
            blade elements with their coefficients and centre of pressure, the added mass and rotation of the insects. \
            Pitch at mid stroke of five wings, pitch over a beat of a sixth.",
    part: Part::Experiments,
    quick: false,
    run: robobees,
}];

/// Steps a beat.
const STEPS: usize = 200;

const SOURCE: &str = "avikde/robobee3d: bee2, drawerbee (5 October 2020), sdab1";
const TRACKED: &str =
    "avikde/robobee3d: Bee1 at 165 Hz and 180 V, points on the wing tracked frame by frame";
const BAND: &str = "band for one setting of all wings; nothing is fitted";
const PROJECTED: &str = "raw angles as those of a vein seen along the stroke axis, which is 45.45 deg from the leading edge in the plane of the wing";
const AS_PITCH: &str = "read so, pitch rises from 35 to 42 deg as strokes grow from 25 to 44 deg";

/// A measured half stroke.
struct Mark {
    wing: String,
    /// [Hz].
    frequency: f64,
    /// Half of the stroke from end to end [deg].
    amplitude: f64,
    /// As measured [deg].
    raw: f64,
    /// Angle of the vein that was looked at, in the plane of the wing [deg].
    vein: f64,
}

impl Mark {
    /// Pitch whose vein is seen at the raw angle [deg].
    fn pitch(&self) -> f64 {
        let [raw, vein] = [self.raw, self.vein].map(|a| a.to_radians().tan());
        (raw / vein).asin().to_degrees()
    }
}

/// The first vein of wing 1a in the plane of the wing, and the second [deg].
const VEINS: [f64; 2] = [45.45, 45.8];

fn marks() -> Vec<Mark> {
    let table = Table::new(include_str!("../../data/robobee_stroke_and_raw_pitch.csv"));
    let words: Vec<String> = table
        .words("bee")
        .zip(table.words("wing"))
        .map(|(bee, wing)| format!("{bee}, wing {wing}"))
        .collect();
    let [frequency, left, right] =
        ["frequency_hz", "stroke_left_deg", "stroke_right_deg"].map(|n| table.numbers(n));
    let raw = ["raw_left_to_right_deg", "raw_right_to_left_deg"].map(|n| table.numbers(n));
    let both = |k: usize| [(k, 0), (k, 1)];
    let mark = |(k, way): (usize, usize)| Mark {
        wing: words[k].clone(),
        frequency: frequency[k],
        amplitude: 0.5 * (left[k] + right[k]),
        raw: raw[way][k],
        vein: VEINS[0],
    };
    let mut marks: Vec<Mark> = (0..words.len()).flat_map(both).map(mark).collect();
    let table = Table::new(include_str!("../../data/robobee_sdab1_veins.csv"));
    let [frequency, stroke] = ["frequency_hz", "stroke_deg"].map(|n| table.numbers(n));
    let raw = ["vein_1_deg", "vein_2_deg"].map(|n| table.numbers(n));
    let seen = |&(k, way): &(usize, usize)| raw[way][k] > 0.0;
    let mark = |(k, way): (usize, usize)| Mark {
        wing: "sdab1".into(),
        frequency: frequency[k],
        amplitude: 0.5 * stroke[k],
        raw: raw[way][k],
        vein: VEINS[way],
    };
    marks.extend((0..stroke.len()).flat_map(both).filter(seen).map(mark));
    marks
}

/// A wing of the RoboBee that strokes like `phi` at `frequency` [Hz].
fn wing(
    air: Air,
    frequency: f64,
    phi: &str,
    steps: usize,
    beats: usize,
) -> Result<Flown, VerifyError> {
    let text = include_str!("../../data/robobee_wing.toml");
    let set = [
        format!("motion.frequency_hz={frequency}"),
        format!("wing.right.motion.phi.fourier={phi}"),
        format!("time.steps_per_beat={steps}"),
        format!("time.beats={beats}"),
    ];
    Flown::new(
        "robobee-wing",
        &[text, air.robobee()].concat(),
        Path::new(""),
        &set,
    )
}

/// Pitch at mid stroke [deg], mean of both half strokes.
fn mid_stroke(air: Air, mark: &Mark, steps: usize, beats: usize) -> Result<f64, VerifyError> {
    let phi = format!("{{cosine_deg=[{}]}}", mark.amplitude);
    let flown = wing(air, mark.frequency, &phi, steps, beats)?;
    let pitch = flown.last_beat();
    Ok(0.5 * (pitch[steps / 4] - pitch[3 * steps / 4]).abs())
}

fn robobees(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let marks = marks();
    let mut computed: Vec<f64> = vec![];
    for (k, mark) in marks.iter().enumerate() {
        let known = (marks[..k].iter())
            .position(|m| m.amplitude == mark.amplitude && m.frequency == mark.frequency);
        computed.push(match known {
            Some(k) => computed[k],
            None => mid_stroke(Air::Blade, mark, STEPS, 8)?,
        });
    }
    let middle = &marks[0];
    let finer = mid_stroke(Air::Blade, middle, 2 * STEPS, 8)?;
    let later = mid_stroke(Air::Blade, middle, STEPS, 12)?;
    let own = (finer - computed[0]).abs().max((later - computed[0]).abs());
    let mut rows = vec![over_all(&marks, &computed).uncertain(own)];
    rows.extend(by_wing(&marks, &computed));
    rows.push(of_strokes(&marks, &computed));
    rows.push(as_pitch(&marks, &computed));
    rows.push(scatter(&marks));
    rows.push(best_curve(&marks)?);
    rows.push(tracked()?);
    rows.extend(lattice()?);
    Ok(rows)
}

/// Errors of the marks that `wanted` names.
fn errors(
    marks: &[Mark],
    computed: &[f64],
    wanted: impl Fn(&Mark) -> bool,
    measured: impl Fn(&Mark) -> f64,
) -> Vec<f64> {
    let both = marks.iter().zip(computed);
    both.filter(|(m, _)| wanted(m))
        .map(|(m, c)| c - measured(m))
        .collect()
}

fn over_all(marks: &[Mark], computed: &[f64]) -> Row {
    let mut points: Vec<[f64; 3]> = (marks.iter().zip(computed))
        .map(|(m, c)| [m.pitch(), m.pitch(), *c])
        .collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let drawn = Comparison {
        quantity: "pitch at mid stroke [deg]".into(),
        along: "measured [deg]".into(),
        against: "measured, five wings".into(),
        name: "blade elements".into(),
        points,
    };
    let quantity = format!(
        "pitch at mid stroke, {} half strokes: rms error",
        marks.len()
    );
    Row::new(quantity, "deg", drawn.rms_error())
        .against(0.0, SOURCE)
        .within(4.0, BAND)
        .drawn(drawn)
}

fn by_wing(marks: &[Mark], computed: &[f64]) -> Vec<Row> {
    let mut names: Vec<&str> = marks.iter().map(|m| m.wing.as_str()).collect();
    names.dedup();
    names.sort_unstable();
    names.dedup();
    let mut rows = vec![];
    for name in names {
        let apart = errors(marks, computed, |m| m.wing == name, Mark::pitch);
        let quantity = format!("{name}, {} half strokes: rms error", apart.len());
        let row = Row::new(quantity, "deg", rms(&apart)).against(0.0, SOURCE);
        rows.push(row.because(PROJECTED));
        let mean = apart.iter().sum::<f64>() / apart.len() as f64;
        let row = Row::new(format!("{name}: mean error"), "deg", mean).against(0.0, SOURCE);
        rows.push(row);
    }
    rows
}

/// Errors of the mean pitch of both half strokes.
fn of_strokes(marks: &[Mark], computed: &[f64]) -> Row {
    let strokes = marks.chunks_exact(2).zip(computed.chunks_exact(2));
    let error = |(m, c): (&[Mark], &[f64])| c[0] - 0.5 * (m[0].pitch() + m[1].pitch());
    let apart: Vec<f64> = strokes.map(error).collect();
    let quantity = format!(
        "mean pitch of both half strokes, {} strokes: rms error",
        apart.len()
    );
    Row::new(quantity, "deg", rms(&apart))
        .against(0.0, SOURCE)
        .because(PROJECTED)
}

fn as_pitch(marks: &[Mark], computed: &[f64]) -> Row {
    let apart = errors(marks, computed, |_| true, |m| m.raw);
    Row::new(
        "all, raw angles read as the pitch: rms error",
        "deg",
        rms(&apart),
    )
    .against(0.0, SOURCE)
    .because(AS_PITCH)
}

/// How far the pitch of one half stroke is from the mean of both.
fn scatter(marks: &[Mark]) -> Row {
    let of_stroke = |m: &[Mark]| 0.5 * (m[0].pitch() - m[1].pitch());
    let apart: Vec<f64> = marks.chunks_exact(2).map(of_stroke).collect();
    let quantity = "measured: rms of half the difference between the two half strokes";
    Row::new(quantity, "deg", rms(&apart)).because("a wing without a mean pitch has none")
}

/// What the best curve through all measured points leaves: a cubic of the amplitude and its product with the frequency,
/// six numbers fitted to them.
fn best_curve(marks: &[Mark]) -> Result<Row, VerifyError> {
    let terms = |m: &Mark| {
        let [a, f] = [(m.amplitude - 33.0) / 10.0, (m.frequency - 170.0) / 5.0];
        [1.0, a, a * a, a * a * a, f, f * a]
    };
    let (mut normal, mut fitted) = ([0.0; 36], [0.0; 6]);
    for mark in marks {
        let x = terms(mark);
        for i in 0..6 {
            fitted[i] += x[i] * mark.pitch();
            for j in 0..6 {
                normal[6 * i + j] += x[i] * x[j];
            }
        }
    }
    solve_small(&mut normal, &mut fitted)?;
    let apart = |m: &Mark| -> f64 { terms(m).iter().zip(fitted).map(|(x, c)| x * c).sum() };
    let apart: Vec<f64> = marks.iter().map(|m| apart(m) - m.pitch()).collect();
    let quantity = "measured: rms about the best cubic of stroke amplitude, with frequency";
    Ok(Row::new(quantity, "deg", rms(&apart)).because("six numbers fitted to the measured points"))
}

/// The wing that was tracked: its own stroke, three harmonics of it.
fn tracked() -> Result<Row, VerifyError> {
    const FREQUENCY: f64 = 165.0;
    const POINTS: usize = 40;
    let table = Table::new(include_str!("../../data/robobee_bee1_tracked.csv"));
    let [time, stroke, pitch] = ["time_s", "stroke_deg", "pitch_deg"].map(|n| table.numbers(n));
    let at = |k: usize| k as f64 / (POINTS as f64 * FREQUENCY);
    let sampled = |of: &[f64]| -> Vec<f64> {
        (0..=POINTS)
            .map(|k| interpolate(&time, of, at(k)))
            .collect()
    };
    let (stroke, pitch) = (sampled(&stroke), sampled(&pitch));
    let parts = [1, 2, 3].map(|k| harmonic(&stroke, POINTS, k));
    let list = |i: usize| parts.map(|p| p[i].to_string()).join(",");
    let phi = format!("{{cosine_deg=[{}],sine_deg=[{}]}}", list(0), list(1));
    let flown = wing(Air::Blade, FREQUENCY, &phi, STEPS, 8)?.last_beat();
    let own: Vec<f64> = flown.iter().step_by(STEPS / POINTS).copied().collect();
    // A smooth start leaves the motion half a beat behind.
    let own: Vec<f64> = (0..POINTS)
        .map(|k| own[(k + POINTS / 2) % POINTS])
        .collect();
    let sign = if own.iter().zip(&pitch).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
        -1.0
    } else {
        1.0
    };
    let own: Vec<f64> = own.iter().map(|x| sign * x).collect();
    let drawn = Comparison::over_a_beat("pitch [deg]", "blade elements", &own, &pitch[..POINTS]);
    let row = Row::new(
        "Bee1, pitch over a beat: rms error",
        "deg",
        drawn.rms_error(),
    );
    Ok(row
        .against(0.0, TRACKED)
        .because("the largest is 48 deg")
        .drawn(drawn))
}

/// The same hinge in the lattice.
fn lattice() -> Result<Vec<Row>, VerifyError> {
    let mut rows = vec![];
    for (frequency, amplitude) in [(170.0, 28.0), (175.0, 40.0)] {
        let mark = Mark {
            wing: String::new(),
            frequency,
            amplitude,
            raw: 0.0,
            vein: VEINS[0],
        };
        let blade = mid_stroke(Air::Blade, &mark, STEPS, 8)?;
        let [second, third] = [2, 3].map(|beats| mid_stroke(Air::Lattice, &mark, 80, beats));
        let (second, third) = (second?, third?);
        let quantity =
            format!("stroke amplitude {amplitude} deg, {frequency} Hz: pitch in the lattice");
        let row = Row::new(quantity, "deg", third).against(blade, "blade elements");
        rows.push(
            row.uncertain(third - second)
                .because("uncertainty: from the second beat to the third"),
        );
    }
    Ok(rows)
}
