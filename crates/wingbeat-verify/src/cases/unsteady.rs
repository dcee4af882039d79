//! Unsteady thin-airfoil theory: a wing of aspect ratio 10^4 and one panel column.

use crate::lab::series::harmonic;
use crate::lab::{extrapolated, fly, forces, rectangle, translating};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::{PI, TAU};
use wingbeat_air::{
    AirError, AirSettings, CoreModel, Gust, GustShape, Lattice, NodeMotion, Surface, Wind,
};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "wagner",
        about: "Lift after a sudden change of angle of attack in plane flow.",
        part: Part::Analytic,
        quick: true,
        run: wagner,
    },
    Case {
        name: "kuessner",
        about: "Lift while a wing in plane flow enters a sharp-edged gust.",
        part: Part::Analytic,
        quick: true,
        run: kuessner,
    },
    Case {
        name: "theodorsen",
        about: "Lift of a wing in plane flow that plunges, or pitches about its mid chord.",
        part: Part::Analytic,
        quick: true,
        run: theodorsen,
    },
];

const SPAN: f64 = 1e4;
const SPAN_NOTE: &str = "aspect ratio 1e4, one column of panels: the finite-aspect correction \
                         2/AR is 2e-4 of the lift";

/// A lattice of chord 1 in a unit stream along x with something added.
fn lattice(rows: usize, wind: Wind) -> Result<Lattice, AirError> {
    let core = CoreModel::Scully { radius: 1e-8 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        wind,
        ..AirSettings::accurate(1.0, DVec3::X)
    };
    Lattice::new(vec![Surface::grid("wing", rows, 1)], settings)
}

fn flat(rows: usize) -> Vec<DVec3> {
    rectangle(rows, 1, DVec3::X, SPAN * DVec3::Y)
}

/// Lift over 2 pi q S w/U after a sudden vertical velocity w, steps of one panel.
fn indicial(rows: usize, chords: f64) -> Result<Vec<f64>, AirError> {
    let w = 1e-3;
    let lattice = lattice(rows, Wind::default())?;
    let motion = |t: f64| {
        let nodes = flat(rows).iter().map(|x| *x - w * t * DVec3::Z).collect();
        translating(nodes, -w * DVec3::Z)
    };
    let dt = 1.0 / rows as f64;
    let steps = (chords / dt) as usize;
    let lift = forces(&lattice, motion, dt, steps)?;
    Ok(lift.iter().map(|f| f.z / (PI * w * SPAN)).collect())
}

/// Wagner's function with s in half chords: Garrick's form, within 2 % of the exact one.
fn garrick(s: f64) -> f64 {
    1.0 - 2.0 / (4.0 + s)
}

/// R. T. Jones's form, within 1 %.
fn jones(s: f64) -> f64 {
    1.0 - 0.165 * (-0.0455 * s).exp() - 0.335 * (-0.3 * s).exp()
}

fn wagner(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let rows = if quick { [8, 16] } else { [16, 32] };
    let runs = [indicial(rows[0], 10.0)?, indicial(rows[1], 10.0)?];
    let at = |chords: f64| {
        let [a, b] = [0, 1].map(|i| runs[i][(chords * rows[i] as f64) as usize]);
        (b, extrapolated(a, b, 1.0))
    };
    let mut out = Vec::new();
    for chords in [1.0, 2.0, 5.0, 10.0] {
        let (fine, limit) = at(chords);
        let s = 2.0 * chords;
        out.push(
            Row::new(
                format!("lift over steady lift after {chords} chords"),
                "1",
                limit,
            )
            .against(
                jones(s),
                "Wagner 1925 in R. T. Jones's form (NACA Rep. 681)",
            )
            .uncertain((limit - fine).abs() + (jones(s) - garrick(s)).abs() / 2.0)
            .within(0.012, "the form itself is good to 1 %"),
        );
    }
    Ok(out)
}

fn kuessner(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let rows = if quick { [8, 16] } else { [16, 32] };
    let mut runs = Vec::new();
    let (w, chords) = (1e-3, 6.0);
    for rows in rows {
        let front = Gust {
            amplitude: w * DVec3::Z,
            start: 0.0,
            slowness: DVec3::X,
            shape: GustShape::Table(vec![(0.0, 0.0), (1e-9, 1.0)]),
        };
        let wind = Wind {
            gusts: vec![front],
            ..Wind::default()
        };
        let lattice = lattice(rows, wind)?;
        let motion = |_| translating(flat(rows), DVec3::ZERO);
        let dt = 1.0 / rows as f64;
        let lift = forces(&lattice, motion, dt, (chords / dt) as usize)?;
        runs.push(
            lift.iter()
                .map(|f| f.z / (PI * w * SPAN))
                .collect::<Vec<_>>(),
        );
    }
    let mut out = Vec::new();
    for chords in [1.0, 2.0, 5.0] {
        let s: f64 = 2.0 * chords;
        // Sears and Sparks's form of Kuessner's function.
        let exact = 1.0 - 0.5 * (-0.13 * s).exp() - 0.5 * (-s).exp();
        let at = |i: usize| runs[i][(chords * rows[i] as f64) as usize];
        let limit = extrapolated(at(0), at(1), 1.0);
        out.push(
            Row::new(
                format!("lift over steady lift {chords} chords into the gust"),
                "1",
                limit,
            )
            .against(exact, "Kuessner 1936 in Sears and Sparks's form")
            .uncertain(limit - at(1))
            .within(0.02, "the form itself is good to 1-2 %"),
        );
    }
    Ok(out)
}

/// Theodorsen's function C(k) as [real, imaginary], from the series of the Bessel functions.
pub(super) fn theodorsen_function(k: f64) -> [f64; 2] {
    let [j0, j1, y0, y1] = bessel(k);
    let (a, b) = (j1 + y0, y1 - j0);
    let d = a * a + b * b;
    [(j1 * a + y1 * b) / d, -(y1 * y0 + j1 * j0) / d]
}

/// J0, J1, Y0, Y1 by their power series, good to roundings for x up to about 5.
fn bessel(x: f64) -> [f64; 4] {
    const EULER: f64 = 0.577_215_664_901_532_9;
    let (q, log) = (0.25 * x * x, (0.5 * x).ln() + EULER);
    let (mut j0, mut j1, mut s0, mut s1) = (0.0, 0.0, 0.0, 0.0);
    let (mut term, mut harmonic) = (1.0, 0.0);
    for m in 0..40 {
        let m1 = m as f64 + 1.0;
        j0 += term;
        j1 += term * 0.5 * x / m1;
        s0 -= term * harmonic;
        s1 += term * 0.5 * x / m1 * (harmonic + harmonic + 1.0 / m1);
        harmonic += 1.0 / m1;
        term *= -q / (m1 * m1);
    }
    let y0 = 2.0 / PI * (log * j0 + s0);
    let y1 = 2.0 / PI * (log * j1) - 2.0 / (PI * x) - s1 / PI;
    [j0, j1, y0, y1]
}

#[derive(Clone, Copy)]
enum Mode {
    Plunge,
    Pitch,
}

/// Exact complex lift over pi q c: amplitude of e^{i omega t} as [real, imaginary] for a plunge h = e^{i w t}
/// half chords down, or pitch alpha = e^{i w t} nose up about mid chord [Bisplinghoff, eq. 5-346..].
fn exact(mode: Mode, k: f64) -> [f64; 2] {
    let [f, g] = theodorsen_function(k);
    // In units of half chord and speed: L = pi rho b U^2 [ h'' + a' ] + 2 pi rho b U^2 C [h' + a + a'/2].
    match mode {
        Mode::Plunge => [-k * k + 2.0 * (-g * k), 2.0 * f * k],
        Mode::Pitch => [2.0 * (f - 0.5 * k * g), k + 2.0 * (g + 0.5 * k * f)],
    }
}

/// The same from the lattice, over the third period, with steps of so many panels.
fn computed(mode: Mode, k: f64, rows: usize, step: f64) -> Result<[f64; 2], AirError> {
    let period = PI / k; // in chords
    let per_period = (period * rows as f64 / step).round() as usize;
    let dt = period / per_period as f64;
    let (w, a) = (TAU / period, 1e-4);
    let lattice = lattice(rows, Wind::default())?;
    let motion = |t: f64| {
        let (s, c) = (w * t).sin_cos();
        let flat = flat(rows);
        match mode {
            Mode::Plunge => {
                // h in half chords, positive down.
                let shift = -0.5 * a * c * DVec3::Z;
                let nodes = flat.iter().map(|x| *x + shift).collect();
                translating(nodes, 0.5 * a * w * s * DVec3::Z)
            }
            Mode::Pitch => NodeMotion {
                position: flat
                    .iter()
                    .map(|x| *x - a * c * (x.x - 0.5) * DVec3::Z)
                    .collect(),
                velocity: flat
                    .iter()
                    .map(|x| a * w * s * (x.x - 0.5) * DVec3::Z)
                    .collect(),
            },
        }
    };
    let mut lift = Vec::new();
    fly(&lattice, motion, dt, 3 * per_period, |_, _, loads, _| {
        lift.push(crate::lab::total_force(loads).z);
    })?;
    let [c, s] = harmonic(&lift[2 * per_period..], per_period, 1);
    let scale = 0.5 * PI * a * SPAN; // pi q c
    // cos and sin amplitudes are the real part and minus the imaginary part.
    Ok([c / scale, -s / scale])
}

fn theodorsen(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let ks: &[f64] = if quick {
        &[0.5, 1.0, 2.0]
    } else {
        &[0.1, 0.2, 0.5, 1.0, 2.0]
    };
    let mut rows = Vec::new();
    for (name, mode) in [("plunge", Mode::Plunge), ("pitch", Mode::Pitch)] {
        for &k in ks {
            let fine = if quick || k < 0.3 { 16 } else { 32 };
            let [a, b] = [
                computed(mode, k, fine / 2, 1.0)?,
                computed(mode, k, fine, 1.0)?,
            ];
            let off = |x| off(mode, k, x);
            let limit = [0, 1].map(|i| extrapolated(a[i], b[i], 1.0));
            rows.push(
                Row::new(
                    format!("{name}, k = {k}: error of the complex lift, {fine} panels"),
                    "1",
                    off(b),
                )
                .against(0.0, "Theodorsen 1935, NACA Rep. 496")
                .uncertain((off(limit) - off(b)).abs())
                .within(0.6 * k.max(0.5) / fine as f64 + 0.005, SPAN_NOTE),
            );
        }
    }
    for step in [0.25, 0.5, 2.0, 4.0] {
        let (mode, k, panels) = (Mode::Plunge, 1.0, 16_u8);
        rows.push(
            Row::new(
                format!("plunge, k = {k}, {panels} panels, steps of {step} panels: the same"),
                "1",
                off(mode, k, computed(mode, k, panels.into(), step)?),
            )
            .against(0.0, "Theodorsen 1935, NACA Rep. 496")
            .within(
                0.6 * k / f64::from(panels) + 0.005 + (2.0 * k * step / f64::from(panels)).powi(2) / 3.0,
                "as with steps of one panel, and the error (omega dt)^2 / 3 of the rate of circulation",
            ),
        );
    }
    Ok(rows)
}

/// Error of a complex lift over the size of the exact one.
fn off(mode: Mode, k: f64, lift: [f64; 2]) -> f64 {
    let want = exact(mode, k);
    (lift[0] - want[0]).hypot(lift[1] - want[1]) / want[0].hypot(want[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_theodorsen_function() {
        // Bisplinghoff, Ashley, Halfman, table 5-1.
        for (k, f, g) in [
            (0.1, 0.8319, -0.1723),
            (0.5, 0.5979, -0.1507),
            (1.0, 0.5394, -0.1003),
        ] {
            let [a, b] = theodorsen_function(k);
            assert!((a - f).abs() < 1e-4 && (b - g).abs() < 1e-4, "{k} {a} {b}");
        }
    }
}
