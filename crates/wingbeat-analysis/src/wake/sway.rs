//! The motion of the body over a beat of a periodic orbit, as a Fourier series.

use std::f64::consts::TAU;

use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::PrescribedMotion;
use wingbeat_math::{DVec3, DriftingFourier, EulerSequence};
use wingbeat_model::Start;

/// Amplitude over the largest one of place or attitude from which on the highest harmonics are left out.
const NONE: f64 = 1e-9;

/// The motion through `roots`, which are even in time, both ends of a beat of `frequency` \[Hz\] among them:
/// places with their mean velocity, attitudes without what they have changed by. It has all harmonics that so many
/// roots tell apart: elastic wings that ring shake the body many times a beat.
pub(super) fn sway(roots: &[BodyMotion], frequency: f64) -> PrescribedMotion {
    let angles = |root: &BodyMotion| EulerSequence::BODY_231.angles(root.r);
    let mut position = series(roots, |root| root.p, frequency);
    let mut angles = series(roots, angles, frequency);
    for (all, drifts) in [(&mut position, true), (&mut angles, false)] {
        let sizes = all.iter().flat_map(|s| s.cosine.iter().chain(&s.sine));
        let largest = sizes.fold(0.0_f64, |m, a| m.max(a.abs()));
        for s in all.iter_mut() {
            s.rate = if drifts { s.rate } else { 0.0 };
            for list in [&mut s.cosine, &mut s.sine] {
                let felt = list.iter().rposition(|a| a.abs() > NONE * largest);
                list.truncate(felt.map_or(0, |k| k + 1));
            }
        }
    }
    PrescribedMotion {
        position,
        angles,
        start: Start::Impulsive,
    }
}

/// The series of three coordinates.
fn series(
    roots: &[BodyMotion],
    of: impl Fn(&BodyMotion) -> DVec3,
    frequency: f64,
) -> [DriftingFourier; 3] {
    let steps = roots.len() - 1;
    let first = of(&roots[0]);
    let drift = (of(&roots[steps]) - first) / steps as f64;
    let swings: Vec<DVec3> = (0..steps)
        .map(|k| of(&roots[k]) - first - k as f64 * drift)
        .collect();
    let mean = first + swings.iter().sum::<DVec3>() / steps as f64;
    let coefficients = |k: usize| {
        let mut sums = [DVec3::ZERO; 2];
        for (j, x) in swings.iter().enumerate() {
            let (sin, cos) = (TAU * (k * j) as f64 / steps as f64).sin_cos();
            sums[0] += cos * *x;
            sums[1] += sin * *x;
        }
        sums.map(|s| s * 2.0 / steps as f64)
    };
    let all: Vec<[DVec3; 2]> = (1..=(steps - 1) / 2).map(coefficients).collect();
    std::array::from_fn(|i| DriftingFourier {
        constant: mean[i],
        rate: drift[i] * steps as f64 * frequency,
        frequency,
        cosine: all.iter().map(|c| c[0][i]).collect(),
        sine: all.iter().map(|c| c[1][i]).collect(),
    })
}
