//! The discrete Riccati equation of the regulator.

use wingbeat_math::solve_small;

use crate::AnalysisError;
use crate::departure::CONTROLS;

/// The gain of the discrete regulator: Riccati's difference equation, run until it stands.
pub(super) fn riccati(
    a: &[f64],
    b: &[f64],
    q: &[f64],
    r: &[f64; CONTROLS],
    n: usize,
) -> Result<Vec<f64>, AnalysisError> {
    let mut p = vec![0.0; n * n];
    (0..n).for_each(|i| p[i * n + i] = q[i]);
    let mut gain = vec![0.0; CONTROLS * n];
    for pass in 0..5000 {
        let pa = product(&p, a, n, n, n);
        let pb = product(&p, b, n, n, CONTROLS);
        let mut s = transposed_product(b, &pb, n, CONTROLS, CONTROLS);
        (0..CONTROLS).for_each(|i| s[i * CONTROLS + i] += r[i]);
        let bpa = transposed_product(b, &pa, n, CONTROLS, n);
        let next = solve_columns(&s, &bpa, CONTROLS, n)?;
        let mut closed = a.to_vec();
        let bk = product(b, &next, n, CONTROLS, n);
        closed.iter_mut().zip(&bk).for_each(|(x, y)| *x -= y);
        let mut new = transposed_product(a, &product(&p, &closed, n, n, n), n, n, n);
        (0..n).for_each(|i| new[i * n + i] += q[i]);
        let change = next
            .iter()
            .zip(&gain)
            .fold(0.0_f64, |m, (x, y)| m.max((x - y).abs()));
        let size = next.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for i in 0..n {
            for j in 0..n {
                p[i * n + j] = 0.5 * (new[i * n + j] + new[j * n + i]);
            }
        }
        gain = next;
        // A command needs as many passes as there are beats under way before it costs anything.
        if pass > n && change <= 1e-9 * size {
            return Ok(gain);
        }
    }
    Err(AnalysisError::Numbers(
        "Riccati's iteration did not converge: the strokes cannot stabilise this flight".into(),
    ))
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
    let mut out = vec![0.0; m * n];
    for j in 0..n {
        let mut column: Vec<f64> = (0..m).map(|i| y[i * n + j]).collect();
        solve_small(&mut s.to_vec(), &mut column)
            .map_err(|e| AnalysisError::Numbers(format!("Riccati's iteration: {e}")))?;
        (0..m).for_each(|i| out[i * n + j] = column[i]);
    }
    Ok(out)
}
