//! The discrete Riccati equation of the regulator.

use wingbeat_math::{SmallLu, larger};

use crate::AnalysisError;
use crate::control::departure::CONTROLS;

/// A linear map of `n` numbers and the effect of a new command on them.
pub(super) struct Step {
    pub a: Vec<f64>,
    pub b: Vec<f64>,
}

/// The gains of the discrete regulator of a period of `steps`: Riccati's difference equation, run backwards through the
/// periods until it stands.
pub(super) fn riccati(
    steps: &[Step],
    q: &[f64],
    r: &[f64; CONTROLS],
    n: usize,
) -> Result<Vec<Vec<f64>>, AnalysisError> {
    let mut p = vec![0.0; n * n];
    (0..n).for_each(|i| p[i * n + i] = q[i]);
    let mut gains = vec![vec![0.0; CONTROLS * n]; steps.len()];
    for pass in 0..5000 {
        let mut stands = true;
        for (step, gain) in steps.iter().zip(&mut gains).rev() {
            let next = before(step, &mut p, q, r, n)?;
            let change = next
                .iter()
                .zip(&*gain)
                .fold(0.0_f64, |m, (x, y)| larger(m, (x - y).abs()));
            let size = next.iter().fold(0.0_f64, |m, x| larger(m, x.abs()));
            stands &= change <= 1e-9 * size;
            *gain = next;
        }
        // A command needs as many passes as there are beats under way before it costs anything.
        if pass > n && stands {
            return Ok(gains);
        }
    }
    Err(AnalysisError::Numbers(
        "Riccati's iteration did not converge".into(),
    ))
}

/// The gain of a step whose end costs `p`, which becomes the cost of its start.
fn before(
    Step { a, b }: &Step,
    p: &mut [f64],
    q: &[f64],
    r: &[f64; CONTROLS],
    n: usize,
) -> Result<Vec<f64>, AnalysisError> {
    let pa = product(p, a, n, n, n);
    let pb = product(p, b, n, n, CONTROLS);
    let mut s = transposed_product(b, &pb, n, CONTROLS, CONTROLS);
    (0..CONTROLS).for_each(|i| s[i * CONTROLS + i] += r[i]);
    let bpa = transposed_product(b, &pa, n, CONTROLS, n);
    let gain = solve_columns(&s, &bpa, CONTROLS, n)?;
    let mut closed = a.clone();
    let bk = product(b, &gain, n, CONTROLS, n);
    closed.iter_mut().zip(&bk).for_each(|(x, y)| *x -= y);
    let mut new = transposed_product(a, &product(p, &closed, n, n, n), n, n, n);
    (0..n).for_each(|i| new[i * n + i] += q[i]);
    for i in 0..n {
        for j in 0..n {
            p[i * n + j] = 0.5 * (new[i * n + j] + new[j * n + i]);
        }
    }
    Ok(gain)
}

/// `X Y`, X of shape n x m, Y of shape m x l.
pub(super) fn product(x: &[f64], y: &[f64], n: usize, m: usize, l: usize) -> Vec<f64> {
    let mut out = vec![0.0; n * l];
    for i in 0..n {
        for k in 0..m {
            let f = x[i * m + k];
            for j in 0..l {
                out[i * l + j] += f * y[k * l + j];
            }
        }
    }
    out
}

/// `X^T Y`, X of shape m x n, Y of shape m x l.
fn transposed_product(x: &[f64], y: &[f64], m: usize, n: usize, l: usize) -> Vec<f64> {
    let mut out = vec![0.0; n * l];
    for k in 0..m {
        for i in 0..n {
            let f = x[k * n + i];
            for j in 0..l {
                out[i * l + j] += f * y[k * l + j];
            }
        }
    }
    out
}

/// `S^-1 Y` column by column, S of shape m x m, Y of shape m x n.
pub(super) fn solve_columns(
    s: &[f64],
    y: &[f64],
    m: usize,
    n: usize,
) -> Result<Vec<f64>, AnalysisError> {
    let factors = SmallLu::new(s.to_vec(), m)
        .map_err(|e| AnalysisError::Numbers(format!("Riccati's iteration: {e}")))?;
    let (mut out, mut column) = (vec![0.0; m * n], vec![0.0; m]);
    for j in 0..n {
        (0..m).for_each(|i| column[i] = y[i * n + j]);
        factors.solve(&mut column);
        (0..m).for_each(|i| out[i * n + j] = column[i]);
    }
    Ok(out)
}
