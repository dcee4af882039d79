//! Interface quasi-Newton with least squares: corrections from what former passes have shown [Degroote, Bathe &
//! Vierendeels 2009, Comput. Struct. 87:793].
//!
//! A pass takes the unknowns z to a correction f(z), zero at the solution. What is sought is the combination of former
//! differences of f that takes f away; the unknowns go along with theirs: `dz = f - (dZ + dF) c`, c from
//! `min |f - dF c|`. Differences of the last steps may be among them, after those of the present one.

/// What two passes have shown: the difference of their corrections, and its sum with that of the unknowns.
pub type Shown = [Vec<f64>; 2];

/// Columns that depend on each other to so many digits are left out, unless asked otherwise.
const DEPENDENT: f64 = 1e-8;

/// Differences of former passes of one step, newest last.
///
/// Here `z <- z + f(z)` with `f = 1 - 3 z`, which by itself leads away, ends at the root in the second pass:
///
/// ```
/// use wingbeat_math::Secants;
/// let (mut z, mut secants) = ([0.0], Secants::default());
/// for _ in 0..2 {
///     let mut change = [1.0 - 3.0 * z[0]];
///     secants.accelerate(&mut change);
///     z[0] += change[0];
/// }
/// assert!((z[0] - 1.0 / 3.0_f64).abs() < 1e-15);
/// ```
#[derive(Clone, Debug)]
pub struct Secants {
    /// Part of a column below which what others leave of it is rounding \[1\].
    dependent: f64,
    /// Correction of the pass before, and the change that was made.
    before: Vec<f64>,
    change: Vec<f64>,
    /// Differences of corrections and sums of both differences.
    corrections: Vec<Vec<f64>>,
    sums: Vec<Vec<f64>>,
    /// Spare columns.
    spare: Vec<Vec<f64>>,
    /// Orthonormal combinations of the corrections, and the same of the sums.
    basis: Vec<Vec<f64>>,
    along: Vec<Vec<f64>>,
    has_past: bool,
}

impl Default for Secants {
    fn default() -> Self {
        Self::leaving_out(DEPENDENT)
    }
}

impl Secants {
    /// No passes yet; columns of which others leave less than the part `dependent` \[1\] are left out: what
    /// they are multiplied by raises the rounding in them by as much.
    pub fn leaving_out(dependent: f64) -> Self {
        Self {
            dependent,
            before: vec![],
            change: vec![],
            corrections: vec![],
            sums: vec![],
            spare: vec![],
            basis: vec![],
            along: vec![],
            has_past: false,
        }
    }

    /// Forgets all passes: another step.
    pub fn clear(&mut self) {
        self.spare.append(&mut self.corrections);
        self.spare.append(&mut self.sums);
        self.has_past = false;
    }

    /// Another step, in which what `shown` holds of former ones counts after its own passes.
    pub fn begin(&mut self, shown: &[Shown]) {
        self.clear();
        for [correction, sum] in shown {
            for (from, to) in [(correction, 0), (sum, 1)] {
                let mut column = self.column();
                column.extend_from_slice(from);
                [&mut self.corrections, &mut self.sums][to].push(column);
            }
        }
    }

    /// Leaves in `shown` what the newest passes have shown, `most` of them at most: those whose corrections
    /// differ by at least the part `telling` \[1\] of the largest difference.
    pub fn keep(&mut self, telling: f64, most: usize, shown: &mut Vec<Shown>) {
        self.keep_none(shown);
        let least =
            telling * crate::numbers::extremes::largest(self.corrections.iter().map(|d| norm(d)));
        for k in (0..self.corrections.len()).rev() {
            if shown.len() < most && norm(&self.corrections[k]) > least {
                let [mut correction, mut sum] = [self.column(), self.column()];
                correction.extend_from_slice(&self.corrections[k]);
                sum.extend_from_slice(&self.sums[k]);
                shown.push([correction, sum]);
            }
        }
        shown.reverse();
    }

    /// Leaves nothing in `shown`.
    pub fn keep_none(&mut self, shown: &mut Vec<Shown>) {
        self.spare.extend(shown.drain(..).flatten());
    }

    /// The change of the unknowns for the correction `f`, in its place. The norm of least squares takes the
    /// numbers as they are: they are to be of one size.
    pub fn accelerate(&mut self, f: &mut [f64]) {
        self.remember(f);
        self.combine(f);
        self.change.clear();
        self.change.extend_from_slice(f);
    }

    /// The unknowns are changed by the correction `f` as it is: a pass to learn from.
    pub fn watch(&mut self, f: &[f64]) {
        self.remember(f);
        self.change.clear();
        self.change.extend_from_slice(f);
    }

    fn remember(&mut self, f: &[f64]) {
        if self.has_past {
            let (mut d, mut s) = (self.column(), self.column());
            d.extend(f.iter().zip(&self.before).map(|(a, b)| a - b));
            s.extend(d.iter().zip(&self.change).map(|(a, b)| a + b));
            self.corrections.push(d);
            self.sums.push(s);
        }
        self.before.clear();
        self.before.extend_from_slice(f);
        self.has_past = true;
    }

    fn column(&mut self) -> Vec<f64> {
        let mut column = self.spare.pop().unwrap_or_default();
        column.clear();
        column
    }

    /// Least squares by Gram and Schmidt, newest columns first: whatever is done to a column is done to its sum, too.
    fn combine(&mut self, f: &mut [f64]) {
        self.spare.append(&mut self.basis);
        self.spare.append(&mut self.along);
        for k in (0..self.corrections.len()).rev() {
            let (mut d, mut s) = (self.column(), self.column());
            d.extend_from_slice(&self.corrections[k]);
            s.extend_from_slice(&self.sums[k]);
            let size = norm(&d);
            for _ in 0..2 {
                for (q, sum) in self.basis.iter().zip(&self.along) {
                    let part = dot(q, &d);
                    add(&mut d, -part, q);
                    add(&mut s, -part, sum);
                }
            }
            let rest = norm(&d);
            if rest <= self.dependent * size || size == 0.0 {
                self.spare.extend([d, s]);
                continue;
            }
            d.iter_mut().for_each(|x| *x /= rest);
            s.iter_mut().for_each(|x| *x /= rest);
            self.basis.push(d);
            self.along.push(s);
        }
        for (q, sum) in self.basis.iter().zip(&self.along) {
            add(f, -dot(q, &self.before), sum);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn add(to: &mut [f64], part: f64, of: &[f64]) {
    to.iter_mut().zip(of).for_each(|(a, b)| *a += part * b);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `z <- z + f(z)` with `f = b - A z`, A badly scaled and not near 1, diverges by itself; n + 1 passes solve it.
    #[test]
    fn exact_linear_fixed_points_after_as_many_passes_as_unknowns() {
        let a = [[3.0, 0.4, 0.0], [-0.7, 5.0, 0.2], [0.1, 0.3, 9.0]];
        let b = [1.0, -2.0, 0.5];
        let mut z = [0.0; 3];
        let mut secants = Secants::default();
        let correction = |z: &[f64; 3]| -> [f64; 3] {
            std::array::from_fn(|i| b[i] - (0..3).map(|j| a[i][j] * z[j]).sum::<f64>())
        };
        for _ in 0..4 {
            let mut f = correction(&z);
            secants.accelerate(&mut f);
            (0..3).for_each(|i| z[i] += f[i]);
        }
        assert!(norm(&correction(&z)) < 1e-12); // rounding of numbers of order 10
        // What these passes have shown solves the next step, of other numbers b, at once.
        let mut shown = vec![];
        secants.keep(1e-12, 3, &mut shown);
        assert_eq!(shown.len(), 3);
        secants.begin(&shown);
        let mut f: [f64; 3] = std::array::from_fn(|i| correction(&z)[i] + [0.3, -0.2, 1.0][i]);
        let other = f;
        secants.accelerate(&mut f);
        let left = |i: usize| other[i] - (0..3).map(|j| a[i][j] * f[j]).sum::<f64>();
        assert!(norm(&[left(0), left(1), left(2)]) < 1e-11); // the columns are independent to two digits
    }
}
