//! Roots of maps that take flights to evaluate: Newton's method with differences for the slopes and a line search.

use wingbeat_math::solve_small;

use crate::AnalysisError;

/// As many residuals as there are unknowns.
pub(crate) trait Map {
    /// The residuals at the point `x`.
    fn residual(&mut self, x: &[f64]) -> Result<Vec<f64>, AnalysisError>;

    /// Their slopes at `x`, where they are `r`, rows by residual.
    fn slopes(&mut self, x: &[f64], r: &[f64]) -> Result<Vec<f64>, AnalysisError>;

    /// Moves a point to where the search may go.
    fn confine(&self, _x: &mut [f64]) {}
}

/// How a root is sought.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search {
    /// Largest residual that counts as none.
    pub tolerance: f64,
    /// Most steps.
    pub iterations: usize,
    /// Whether slopes are carried on by Broyden's update as long as they help, or taken again for every step.
    pub updates: bool,
    /// No unknown moves by more than this at once.
    pub reach: f64,
    /// By what a step that does not help is shortened, and how often.
    pub shortening: (f64, usize),
}

/// A point and its residuals.
type Point = (Vec<f64>, Vec<f64>);

impl Search {
    /// The root near `x`, or the best point found, and the steps made.
    ///
    /// # Errors
    /// As the map's at the start, and where its slopes are taken.
    pub fn from(
        &self,
        map: &mut impl Map,
        x: Vec<f64>,
    ) -> Result<(Vec<f64>, usize), AnalysisError> {
        self.with_slopes(map, x, &mut None)
    }

    /// The same with slopes that are about those of the map, if any are `kept`; those of the end, where they are carried
    /// on.
    ///
    /// # Errors
    /// As [`Self::from`].
    pub fn with_slopes(
        &self,
        map: &mut impl Map,
        mut x: Vec<f64>,
        kept: &mut Option<Vec<f64>>,
    ) -> Result<(Vec<f64>, usize), AnalysisError> {
        map.confine(&mut x);
        let mut r = map.residual(&x)?;
        let mut steps = 0;
        while steps < self.iterations && largest(&r) > self.tolerance {
            let is_fresh = kept.is_none();
            let mut slopes = match kept.take() {
                Some(slopes) => slopes,
                None => map.slopes(&x, &r)?,
            };
            let Some((x_new, r_new)) = self.step(map, &x, &r, &slopes) else {
                if is_fresh {
                    break;
                }
                continue;
            };
            // A step that hardly helps: the slopes have become old.
            let is_poor = largest(&r_new) > 0.5 * largest(&r) && !is_fresh;
            if self.updates && !is_poor {
                update(&mut slopes, &x, &r, &x_new, &r_new);
                *kept = Some(slopes);
            }
            (x, r) = (x_new, r_new);
            steps += 1;
        }
        Ok((x, steps))
    }

    /// A point on Newton's direction that lowers the sum of squares of the residuals; none if there is none.
    fn step(&self, map: &mut impl Map, x: &[f64], r: &[f64], slopes: &[f64]) -> Option<Point> {
        let mut direction = r.to_vec();
        solve_small(&mut slopes.to_vec(), &mut direction).ok()?;
        let squares = |r: &[f64]| r.iter().map(|x| x * x).sum::<f64>();
        let longest = direction.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let mut length = (self.reach / longest).min(1.0);
        let (factor, trials) = self.shortening;
        for _ in 0..trials {
            let along = x.iter().zip(&direction).map(|(x, d)| x - length * d);
            let mut trial: Vec<f64> = along.collect();
            map.confine(&mut trial);
            if let Ok(found) = map.residual(&trial)
                && squares(&found) < squares(r)
            {
                return Some((trial, found));
            }
            length *= factor;
        }
        None
    }
}

/// Broyden's update of the slopes by what a step showed [Broyden 1965].
fn update(slopes: &mut [f64], x: &[f64], r: &[f64], x1: &[f64], r1: &[f64]) {
    let s: Vec<f64> = x1.iter().zip(x).map(|(a, b)| a - b).collect();
    let square: f64 = s.iter().map(|a| a * a).sum();
    for (i, row) in slopes.chunks_mut(x.len()).enumerate() {
        let predicted: f64 = row.iter().zip(&s).map(|(j, s)| j * s).sum();
        let gap = r1[i] - r[i] - predicted;
        row.iter_mut()
            .zip(&s)
            .for_each(|(j, s)| *j += gap * s / square);
    }
}

/// The n x n matrix of these columns, rows by residual.
///
/// # Errors
/// That of a column.
pub(crate) fn matrix_of(
    n: usize,
    mut column: impl FnMut(usize) -> Result<Vec<f64>, AnalysisError>,
) -> Result<Vec<f64>, AnalysisError> {
    let mut matrix = vec![0.0; n * n];
    for k in 0..n {
        let column = column(k)?;
        (0..n).for_each(|i| matrix[n * i + k] = column[i]);
    }
    Ok(matrix)
}

/// `x` with its component `k` moved by `s`.
pub(crate) fn moved(x: &[f64], k: usize, s: f64) -> Vec<f64> {
    let mut x = x.to_vec();
    x[k] += s;
    x
}

/// The largest residual; infinite where one is not a number.
pub(crate) fn largest(r: &[f64]) -> f64 {
    r.iter().fold(0.0, |m, x| {
        if x.is_nan() {
            f64::INFINITY
        } else {
            m.max(x.abs())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle of radius 2 and a hyperbola, which counts how often its slopes are asked for; the first
    /// coordinate may be limited, and the largest that was asked for is kept.
    #[derive(Default)]
    struct Curves {
        slopes: usize,
        limit: Option<f64>,
        largest: f64,
    }

    impl Map for Curves {
        fn residual(&mut self, x: &[f64]) -> Result<Vec<f64>, AnalysisError> {
            self.largest = self.largest.max(x[0]);
            Ok(vec![x[0] * x[0] + x[1] * x[1] - 4.0, x[0] * x[1] - 1.0])
        }

        fn slopes(&mut self, x: &[f64], _r: &[f64]) -> Result<Vec<f64>, AnalysisError> {
            self.slopes += 1;
            Ok(vec![2.0 * x[0], 2.0 * x[1], x[1], x[0]])
        }

        fn confine(&self, x: &mut [f64]) {
            x[0] = x[0].min(self.limit.unwrap_or(f64::INFINITY));
        }
    }

    #[test]
    fn exact_both_ways_with_slopes_find_where_a_circle_crosses_a_hyperbola() {
        let search = |updates| Search {
            tolerance: 1e-13,
            iterations: 40,
            updates,
            reach: 0.5,
            shortening: (0.5, 20),
        };
        // x + y = sqrt(4 + 2), x - y = sqrt(4 - 2).
        let exact = 0.5 * (6.0_f64.sqrt() + 2.0_f64.sqrt());
        let slopes = [false, true].map(|updates| {
            let mut map = Curves::default();
            let (x, steps) = search(updates).from(&mut map, vec![4.0, 0.1]).unwrap();
            assert!((x[0] - exact).abs() < 1e-13, "{x:?} in {steps} steps");
            assert!(updates || map.slopes == steps);
            map.slopes
        });
        assert!(slopes[1] < slopes[0], "{slopes:?}");
    }

    /// The search starts and stays inside, and finds the root there; where it lies beyond, it ends at the limit.
    #[test]
    fn exact_a_confined_search_stays_inside() {
        let exact = 0.5 * (6.0_f64.sqrt() + 2.0_f64.sqrt());
        for (limit, found) in [(exact + 0.01, exact), (exact - 0.1, exact - 0.1)] {
            let search = Search {
                tolerance: 1e-13,
                iterations: 40,
                updates: false,
                reach: 0.5,
                shortening: (0.5, 20),
            };
            let mut map = Curves {
                limit: Some(limit),
                ..Curves::default()
            };
            let (x, _) = search.from(&mut map, vec![4.0, 0.1]).unwrap();
            assert!((x[0] - found).abs() < 1e-12, "{x:?}");
            assert!(map.largest <= limit, "{}", map.largest);
        }
    }
}
