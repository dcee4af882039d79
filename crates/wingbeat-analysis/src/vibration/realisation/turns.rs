//! How many whole turns a motion makes between two samples.
//!
//! A motion of the eigenvalue `z = r exp(i a)` from sample to sample, `n` steps apart, has from step to step one of
//! the eigenvalues `r^(1/n) exp(i (a + 2 pi m) / n)`, `m` the whole turns that the samples do not show. Its amplitudes
//! `c(q)` in the rows `q` steps before the samples, by least squares with the same `z`, go by powers of that one:
//! `c(q) = c(0) r^(-q/n) exp(-i (a + 2 pi m) q / n)`. The part of all `c(q)` that does so is 1 for the true `m` and 0 for
//! others. Where two motions have one `z`, each has a part.

use std::f64::consts::TAU;

use faer::c64;

use super::basis::Basis;
use super::samples::Sampled;

/// Part of the squares of amplitudes by which turns are known \[1\].
const KNOWN: f64 = 0.75;

/// Whole turns between samples of each of the motions that go by `values`, below zero where the motion appears to
/// turn back; none where they are not known.
pub(super) fn between(response: &Sampled, basis: &Basis, values: &[[f64; 2]]) -> Vec<Option<f64>> {
    let rows = 0..response.every;
    let found: Vec<_> = rows
        .map(|q| basis.amplitudes(&response.before(q)))
        .collect();
    let of = |(mode, z): (usize, &[f64; 2])| {
        let amplitudes: Vec<&[c64]> = found.iter().map(|c| &*c[mode]).collect();
        turns(*z, &amplitudes)
    };
    values.iter().enumerate().map(of).collect()
}

/// Those of the motion that goes by `z` and has these amplitudes `0, 1, ...` steps before the samples.
fn turns(z: [f64; 2], amplitudes: &[&[c64]]) -> Option<f64> {
    let every = amplitudes.len() as i64;
    // What does not turn in the samples does not turn back either: real numbers stay real.
    let all = match z[1] > 0.0 {
        true => -(every / 2)..=(every - 1) / 2,
        false => 0..=0,
    };
    let parts = all.map(|m| (m as f64, part(z, m as f64, amplitudes)));
    let best = parts.max_by(|p, q| p.1.total_cmp(&q.1))?;
    (best.1 >= KNOWN).then_some(best.0)
}

/// Part of the squares of amplitudes that goes by so many whole turns.
fn part(z: [f64; 2], turns: f64, amplitudes: &[&[c64]]) -> f64 {
    let every = amplitudes.len() as f64;
    let decay = z[0].hypot(z[1]).powf(-1.0 / every);
    let angle = (z[1].atan2(z[0]) + TAU * turns) / every;
    let mut along = vec![c64::new(0.0, 0.0); amplitudes[0].len()];
    let (mut weight, mut squares) = (0.0, 0.0);
    for (q, amplitudes) in amplitudes.iter().enumerate() {
        let (size, turned) = (decay.powi(q as i32), angle * q as f64);
        let back = c64::new(size * turned.cos(), size * turned.sin());
        weight += size * size;
        for (sum, c) in along.iter_mut().zip(*amplitudes) {
            *sum += back * c;
            squares += c.re * c.re + c.im * c.im;
        }
    }
    let product: f64 = along.iter().map(|s| s.re * s.re + s.im * s.im).sum();
    product / (weight * squares)
}
