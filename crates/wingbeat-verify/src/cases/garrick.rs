//! Lift, thrust and power of a plate in plane flow that plunges or pitches, after Theodorsen and Garrick.

use super::unsteady::theodorsen_function;
use crate::lab::series::{harmonic, mean};
use crate::lab::{fly, rectangle, total_force, total_moment};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::PI;
use wingbeat_air::{AirSettings, CoreModel, Lattice, LoadMethod, NodeMotion, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "garrick",
    about: "Lift, mean thrust and mean power of a plate in plane flow that plunges, or pitches about its leading edge or a \
            quarter of its chord: forces on segments, 40 panels along the chord, steps of one panel or of half a panel, third period.",
    part: Part::Analytic,
    quick: false,
    run,
}];

const SPAN: f64 = 1e4;
const ROWS: usize = 40;

/// A motion: plunge up `h cos wt` [chords], pitch nose up `a cos wt` [rad] about this part of the chord.
#[derive(Clone, Copy)]
struct Motion {
    k: f64,
    plunge: f64,
    pitch: f64,
    axis: f64,
}

/// Amplitude of lift as a complex number, mean thrust, mean power: coefficients over `rho U^2 c / 2` (power
/// also over U).
#[derive(Clone, Copy, Debug)]
struct Forces {
    lift: [f64; 2],
    thrust: f64,
    power: f64,
    /// Mean of the leading edge's suction alone.
    suction: f64,
}

fn times(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn scaled(s: f64, a: [f64; 2]) -> [f64; 2] {
    [s * a[0], s * a[1]]
}

fn sum<const N: usize>(terms: [[f64; 2]; N]) -> [f64; 2] {
    [0, 1].map(|i| terms.iter().map(|t| t[i]).sum())
}

/// Mean of the product of two harmonics.
fn mean_product(a: [f64; 2], b: [f64; 2]) -> f64 {
    0.5 * (a[0] * b[0] + a[1] * b[1])
}

/// Linear theory [Theodorsen 1935, NACA Rep. 496; Garrick 1936, NACA Rep. 567] for density, speed and chord 1.
fn exact(motion: &Motion) -> Forces {
    let (b, w) = (0.5, 2.0 * motion.k);
    let a = (motion.axis - 0.5) / b; // axis behind mid chord, half chords
    let c = theodorsen_function(motion.k);
    let (h, alpha) = ([motion.plunge, 0.0], [motion.pitch, 0.0]);
    let rate = |x| times([0.0, w], x);
    let [up, turn] = [rate(h), rate(alpha)];
    let [up2, turn2] = [rate(up), rate(turn)];
    // Downwash at three quarters of the chord, and what of it makes circulation.
    let q = sum([alpha, scaled(-1.0, up), scaled(b * (0.5 - a), turn)]);
    let cq = times(c, q);
    let apparent = sum([turn, scaled(-1.0, up2), scaled(-b * a, turn2)]);
    let lift = sum([scaled(PI * b * b, apparent), scaled(2.0 * PI * b, cq)]);
    let nose_up = sum([
        scaled(-PI * b * b * b * (0.5 - a), turn),
        scaled(-PI * b.powi(4) * (0.125 + a * a), turn2),
        scaled(-PI * b * b * b * a, up2),
        scaled(2.0 * PI * b * b * (a + 0.5), cq),
    ]);
    let s = scaled(0.5_f64.sqrt(), sum([scaled(2.0, cq), scaled(-b, turn)]));
    let suction = PI * b * mean_product(s, s);
    let scale = 1.0 / b;
    Forces {
        lift: scaled(scale, lift),
        thrust: scale * (suction - mean_product(alpha, lift)),
        power: -scale * (mean_product(lift, up) + mean_product(nose_up, turn)),
        suction: scale * suction,
    }
}

fn lattice(rows: usize) -> Result<Lattice, VerifyError> {
    let core = CoreModel::Scully { radius: 1e-8 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        loads: LoadMethod::Joukowski,
        ..AirSettings::accurate(1.0, DVec3::X)
    };
    Ok(Lattice::new(
        vec![Surface::grid("wing", rows, 1)],
        settings,
    )?)
}

/// The same from the lattice, over the third period, with steps of so many panels.
fn computed(motion: &Motion, rows: usize, step: f64) -> Result<Forces, VerifyError> {
    let (w, period) = (2.0 * motion.k, PI / motion.k);
    let per_period = (period * rows as f64 / step).round() as usize;
    let dt = period / per_period as f64;
    let flat = rectangle(rows, 1, DVec3::X, SPAN * DVec3::Y);
    let pose = |t: f64| {
        let (sin, cos) = (w * t).sin_cos();
        let [z, up] = [motion.plunge * cos, -w * motion.plunge * sin];
        let [angle, turn] = [motion.pitch * cos, -w * motion.pitch * sin];
        [z, up, angle, turn]
    };
    let at = |t: f64| {
        let [z, up, angle, turn] = pose(t);
        let (sin, cos) = angle.sin_cos();
        let arm = |x: &DVec3| (x.x - motion.axis) * DVec3::new(cos, 0.0, -sin);
        let place = |x: &DVec3| arm(x) + DVec3::new(motion.axis, x.y, z);
        NodeMotion {
            position: flat.iter().map(place).collect(),
            velocity: (flat.iter())
                .map(|x| up * DVec3::Z + turn * DVec3::Y.cross(arm(x)))
                .collect(),
        }
    };
    let (mut lift, mut thrust, mut power) = (vec![], vec![], vec![]);
    fly(
        &lattice(rows)?,
        at,
        dt,
        3 * per_period,
        |step, _, loads, _| {
            let force = total_force(loads);
            let [z, up, _, turn] = pose(step as f64 * dt);
            let moment = total_moment(loads) - DVec3::new(motion.axis, 0.0, z).cross(force);
            lift.push(force.z);
            thrust.push(-force.x);
            power.push(-force.z * up - moment.y * turn);
        },
    )?;
    let last = |x: &[f64]| x[2 * per_period..].to_vec();
    let scale = 2.0 / SPAN;
    let [cos, sin] = harmonic(&last(&lift), per_period, 1);
    Ok(Forces {
        lift: [scale * cos, -scale * sin],
        thrust: scale * mean(&last(&thrust)),
        power: scale * mean(&last(&power)),
        suction: f64::NAN,
    })
}

const SOURCE: &str = "Theodorsen 1935, NACA Rep. 496; Garrick 1936, NACA Rep. 567";
const SMALL: &str = "linear theory: amplitudes of 0.01 chords and 0.5 deg; errors of 40 panels, of first order in the panel, grow with the \
                     frequency";
const PARTS: &str = "the parts, suction and what the normal force has of it, nearly cancel in pitch; suction goes as the square of the \
                     circulatory part of the lift, and wants shorter steps than lift";

/// Band of the thrust over its parts [1].
const THRUST: f64 = 0.03;
const NOTHING: &str = "so small beside its parts that no thrust at all would be within the band";

/// What pitch a half degree is [rad].
const PITCH: f64 = PI / 360.0;

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let plunge = |k: f64, plunge: f64| Motion {
        k,
        plunge,
        pitch: 0.0,
        axis: 0.25,
    };
    let pitch = |k: f64, axis: f64| Motion {
        k,
        plunge: 0.0,
        pitch: PITCH,
        axis,
    };
    let motions = [
        ("plunge 0.01 chords", plunge(0.5, 0.01)),
        ("plunge 0.01 chords", plunge(1.0, 0.01)),
        ("plunge 0.01 chords", plunge(2.0, 0.01)),
        ("plunge 0.05 chords", plunge(1.0, 0.05)),
        ("pitch about the leading edge", pitch(1.0, 0.0)),
        ("pitch about the leading edge", pitch(2.0, 0.0)),
        ("pitch about a quarter chord", pitch(1.0, 0.25)),
        ("pitch about a quarter chord", pitch(2.0, 0.25)),
    ];
    let mut rows = Vec::new();
    for (name, motion) in &motions {
        rows.extend(compared(name, motion, 1.0)?);
    }
    for (name, motion) in motions.iter().filter(|(_, m)| m.k == 2.0) {
        rows.extend(compared(
            &format!("{name}, steps of half a panel"),
            motion,
            0.5,
        )?);
    }
    Ok(rows)
}

/// Lift, thrust and power of one motion beside linear theory, with the change from half as many panels.
fn compared(name: &str, motion: &Motion, step: f64) -> Result<[Row; 3], VerifyError> {
    let want = exact(motion);
    let parts = want.suction + (want.suction - want.thrust).abs();
    let size = want.lift[0].hypot(want.lift[1]);
    let off = |f: &Forces| (f.lift[0] - want.lift[0]).hypot(f.lift[1] - want.lift[1]) / size;
    let both = [
        computed(motion, ROWS / 2, step)?,
        computed(motion, ROWS, step)?,
    ];
    let row = |what: &str, of: &dyn Fn(&Forces) -> f64, want: f64| {
        let [coarse, fine] = [0, 1].map(|i| of(&both[i]));
        Row::new(format!("{name}, k = {}: {what}", motion.k), "1", fine)
            .against(want, SOURCE)
            .uncertain(fine - coarse)
    };
    let thrust = want.thrust / parts;
    let of_thrust = row("thrust over its parts", &|f| f.thrust / parts, thrust);
    Ok([
        row("error of the complex lift over its size", &off, 0.0).within(0.01, SMALL),
        match thrust.abs() > 2.0 * THRUST {
            true => of_thrust.within(THRUST, PARTS),
            false => of_thrust.because(NOTHING),
        },
        row("power over the exact power", &|f| f.power / want.power, 1.0).within(0.03, SMALL),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table of the same theory, computed by others in other terms.
    #[test]
    fn published_thrust_and_power_of_linear_theory() {
        let degrees = 5.0_f64.to_radians();
        for (k, plunge, pitch, axis, thrust, power, lift) in [
            (0.5, 0.1, 0.0, 0.25, 0.01194562, 0.01878472, 0.38083886),
            (2.0, 0.1, 0.0, 0.25, 0.13393284, 0.25783921, 2.69643787),
            (0.3, 0.0, degrees, 0.0, -0.00343901, 0.00204526, 0.41170360),
            (1.0, 0.0, degrees, 0.25, 0.00055552, 0.01196230, 0.55752706),
            (2.0, 0.0, degrees, 0.75, -0.00313702, 0.00276048, 0.97731450),
        ] {
            let motion = Motion {
                k,
                plunge,
                pitch,
                axis,
            };
            let found = exact(&motion);
            // Eight decimals.
            assert!((found.thrust - thrust).abs() < 2e-8, "{k} {axis} {found:?}");
            assert!((found.power - power).abs() < 2e-8, "{k} {axis} {found:?}");
            let size = found.lift[0].hypot(found.lift[1]);
            assert!((size - lift).abs() < 2e-8, "{k} {axis} {found:?}");
        }
    }
}
