//! Fourier series fitted to samples by least squares.
//!
//! A series of n harmonics is determined by phases of which no two neighbours are 1 / (2 n) apart or more,
//! wherever they lie \[Groechenig 1992, Math. Comput. 59:181, for one dimension\]; others are refused.

use crate::error::{ModelError, in_row};
use crate::motion::fourier::Fourier;
use std::f64::consts::TAU;
use wingbeat_math::{SingularMatrix, SmallLu};

/// Rows of the matrix that makes the coefficients (mean, cosines, sines in turn) of the values at some phases:
/// least squares.
pub(crate) struct FourierFit(Vec<Vec<f64>>);

impl FourierFit {
    /// For values at these `phases` \[wingbeats\].
    ///
    /// # Errors
    /// Phases that do not determine the harmonics.
    pub fn new(phases: &[f64], harmonics: usize) -> Result<Self, SingularMatrix> {
        let size = 2 * harmonics + 1;
        let basis = |x: f64| -> Vec<f64> {
            let wave = |k: usize| {
                let (s, c) = (TAU * k.div_ceil(2) as f64 * x).sin_cos();
                if k % 2 == 1 { c } else { s }
            };
            (0..size)
                .map(|k| if k == 0 { 1.0 } else { wave(k) })
                .collect()
        };
        let rows: Vec<Vec<f64>> = phases.iter().map(|x| basis(*x)).collect();
        let mut normal = vec![0.0; size * size];
        for row in &rows {
            for (a, b) in (0..size).flat_map(|a| (0..size).map(move |b| (a, b))) {
                normal[a * size + b] += row[a] * row[b];
            }
        }
        let normal = SmallLu::new(normal, size)?;
        let mut columns = rows;
        columns.iter_mut().for_each(|x| normal.solve(x));
        let row = |k: usize| columns.iter().map(|c| c[k]).collect();
        Ok(Self((0..size).map(row).collect()))
    }

    /// The series of values at the phases.
    pub fn series(&self, values: &[f64]) -> Fourier {
        let of = |row: &Vec<f64>| row.iter().zip(values).map(|(w, v)| w * v).sum();
        Fourier {
            mean: of(&self.0[0]),
            cos: self.0[1..].iter().step_by(2).map(of).collect(),
            sin: self.0[2..].iter().step_by(2).map(of).collect(),
        }
    }
}

/// Refuses rising phases, all within a beat, that do not determine a series of so many harmonics; `table` names them.
///
/// # Errors
/// [`ModelError::Table`] names the phase after which the gap is too wide.
pub(crate) fn check_gaps(table: &str, x: &[f64], harmonics: usize) -> Result<(), ModelError> {
    check_gaps_or(table, x, harmonics, "give more phases or fewer harmonics")
}

/// The same with this advice.
fn check_gaps_or(table: &str, x: &[f64], harmonics: usize, advice: &str) -> Result<(), ModelError> {
    let first = x.first().copied().unwrap_or(0.0);
    let gap = |k: usize| x.get(k + 1).unwrap_or(&(first + 1.0)) - x[k];
    let widest = (0..x.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
    let widest = widest.unwrap_or(0);
    let limit = 0.5 / harmonics as f64;
    match x.is_empty() || gap(widest) < limit {
        true => Ok(()),
        false => Err(in_row(
            table,
            widest,
            format!(
                "the next phase is {:.4} wingbeats later, and {harmonics} harmonics need less than {limit:.4}: {advice}",
                gap(widest)
            ),
        )),
    }
}

/// Phases that lie closer together are times rather than samples of a beat \[wingbeats\].
const HALF_A_BEAT: f64 = 0.5;

/// The same for phases of any beats, which are rising.
fn check_folded_gaps(table: &str, x: &[f64], harmonics: usize) -> Result<(), ModelError> {
    let in_beat = |k: usize| (x[k] - x[0]).rem_euclid(1.0);
    let mut order: Vec<usize> = (0..x.len()).collect();
    order.sort_by(|&a, &b| in_beat(a).total_cmp(&in_beat(b)));
    let sorted: Vec<f64> = order.iter().map(|&k| in_beat(k)).collect();
    let span = x.last().unwrap_or(&x[0]) - x[0];
    let times = "times are to be divided by the period of a wingbeat";
    let advice = match span {
        s if s < HALF_A_BEAT => format!("all phases lie within {span:.4} wingbeats; {times}"),
        s if s > 1.0 => format!("give more phases or fewer harmonics; {times}"),
        _ => "give more phases or fewer harmonics".to_owned(),
    };
    check_gaps_or(table, &sorted, harmonics, &advice).map_err(|e| match e {
        ModelError::Table { row, problem, .. } => in_row(table, order[row - 1], problem),
        other => other,
    })
}

fn check_not_falling(name: &str, rows: &[(f64, f64)]) -> Result<(), ModelError> {
    for (k, (x, q)) in rows.iter().enumerate() {
        if !x.is_finite() || !q.is_finite() {
            return Err(in_row(name, k, "not a finite number".to_owned()));
        }
        if k > 0 && *x < rows[k - 1].0 {
            let problem = format!("phase {x} is below the one before, {}", rows[k - 1].0);
            return Err(in_row(name, k, problem));
        }
    }
    Ok(())
}

impl Fourier {
    /// The series of `harmonics` harmonics that is nearest to the rows `(phase \[wingbeats\], angle \[rad\])`
    /// by least squares, and what is left of each row \[rad\]. Rows of several beats are folded into one, and
    /// phases may repeat. Of one beat a last row a beat after the first is left out.
    ///
    /// # Errors
    /// [`ModelError::Table`] names the row: no harmonics, fewer than four rows, a number that is not finite,
    /// phases that fall, or are too far apart for so many harmonics.
    pub fn fitted(
        name: &str,
        rows: &[(f64, f64)],
        harmonics: usize,
    ) -> Result<(Self, Vec<f64>), ModelError> {
        check_not_falling(name, rows)?;
        let bad = |row: usize, problem: String| Err(in_row(name, row, problem));
        if harmonics == 0 || rows.len() < 4 {
            return bad(
                rows.len().saturating_sub(1),
                "a fit needs at least 4 rows and 1 harmonic".to_owned(),
            );
        }
        let (last, span) = (rows.len() - 1, rows[rows.len() - 1].0 - rows[0].0);
        let repeats = (span - 1.0).abs() <= 1e-9;
        let rows = &rows[..rows.len() - usize::from(repeats)];
        let (phases, values): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        check_folded_gaps(name, &phases, harmonics)?;
        let Ok(fit) = FourierFit::new(&phases, harmonics) else {
            return bad(
                last,
                format!("the phases do not determine {harmonics} harmonics"),
            );
        };
        let series = fit.series(&values);
        let left = |(x, q): &(f64, f64)| q - series.at(*x)[0];
        let left = rows.iter().map(left).collect();
        Ok((series, left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rms(left: &[f64]) -> f64 {
        wingbeat_math::root_mean_square(left.iter().copied())
    }

    /// A series of three harmonics at uneven phases comes back to roundings; one harmonic more than it needs
    /// changes nothing, one less leaves the root mean square of what it lacks where phases are even.
    #[test]
    fn exact_series_come_back_from_their_samples() {
        let series = Fourier {
            mean: 0.1,
            cos: vec![1.2, 0.0, 0.05],
            sin: vec![0.3, -0.1, 0.0],
        };
        let sample = |x: f64| (x, series.at(x)[0]);
        let uneven = |k: usize| (k as f64 + 0.3 * (k as f64).sin()) / 40.0;
        let rows: Vec<_> = (0..40).map(|k| sample(uneven(k))).collect();
        for harmonics in [3, 4] {
            let (found, left) = Fourier::fitted("q", &rows, harmonics).expect("a fit");
            assert!(rms(&left) < 1e-13);
            for x in [0.05, 0.4, 0.77] {
                let (a, b) = (found.at(x), series.at(x));
                assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-10)); // the second derivative is 40 times a value
            }
        }
        let even: Vec<_> = (0..=40).map(|k| sample(k as f64 / 40.0)).collect();
        let (_, left) = Fourier::fitted("q", &even, 2).expect("a fit");
        let left = rms(&left);
        assert!((left - 0.05 / 2f64.sqrt()).abs() < 1e-13, "{left}");
    }

    #[test]
    fn refuses_samples_that_do_not_determine_the_series() {
        let rows: Vec<_> = (0..=20).map(|k| (k as f64 / 20.0, 0.0)).collect();
        assert!(Fourier::fitted("q", &rows, 9).is_ok());
        for (rows, harmonics, words) in [
            (&rows[..], 10, "give more phases or fewer harmonics"),
            (&rows[..], 0, "1 harmonic"),
            (&rows[..3], 1, "at least 4 rows"),
            (&rows[..10], 1, "the next phase is 0.5500 wingbeats later"),
        ] {
            let problem = Fourier::fitted("q", rows, harmonics).expect_err("too little");
            assert!(problem.to_string().contains(words), "{problem}");
        }
    }
}
