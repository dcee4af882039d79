//! Consistent starts: positions by Newton's iteration with line search on automatically chosen
//! dependent coordinates, velocities by one linear solve; and what the joints ask twice.

use wingbeat_math::{BodyMotion, DMat3, DQuat, DVec3, largest};

use super::form::{AbsoluteForm, AbsoluteScratch};
use super::given::Given;
use super::partition::{Dependent, NEARLY_SINGULAR, Partition, RANK_TOLERANCE, partition};
use crate::DynamicsError;
use crate::error::quoted_once;

/// Scaled constraint values allowed at the start.
const TOLERANCE: f64 = 1e-13;
/// Iterations of Newton's method allowed.
const ITERATIONS: usize = 60;
/// A combination of dependent rows whose right-hand sides leave more than this contradicts itself.
const CONTRADICTION: f64 = 1e-8;

impl AbsoluteForm {
    /// The state nearest to `guess` that fulfils all constraints at time `t` \[s\]. Coordinates of
    /// the bodies in `held` stay as they are; of the others, dependent ones are chosen so that
    /// they follow with the least amplification.
    ///
    /// # Errors
    /// [`DynamicsError::NotAssembled`] names the joint that cannot close;
    /// [`DynamicsError::Redundant`] the joints that ask for the same twice, and
    /// [`DynamicsError::Contradiction`] those that ask for different things.
    pub fn initial(
        &self,
        t: f64,
        guess: &[BodyMotion],
        held: &[usize],
    ) -> Result<Vec<f64>, DynamicsError> {
        let mut y = vec![0.0; self.dim()];
        let motions = self.assembled(t, guess, held, false)?;
        // Which coordinates follow from which is a choice: those that joints are given for the start need not.
        let starts = |m: &[BodyMotion]| self.mechanism().check_starts(m).is_ok();
        let kept = match starts(&motions) {
            true => None,
            false => self.assembled(t, guess, held, true).ok(),
        };
        let motions = kept.filter(|m| starts(m)).unwrap_or(motions);
        self.pack(&motions, &mut y);
        Ok(y)
    }

    /// Motions that fulfil all constraints; with `keeps` those, too, that joints are given for the start.
    fn assembled(
        &self,
        t: f64,
        guess: &[BodyMotion],
        held: &[usize],
        keeps: bool,
    ) -> Result<Vec<BodyMotion>, DynamicsError> {
        let mut s = self.scratch();
        s.motions.copy_from_slice(guess);
        let free = self.free_columns(held);
        self.close(t, &mut s, &free, keeps)?;
        self.match_velocities(t, &mut s, &free, keeps)?;
        Ok(s.motions)
    }

    /// Names of joints that nearly ask for the same thing twice where the bodies are like `motions` at
    /// time `t` \[s\]: a loop near a singular position. None if there are none.
    pub fn nearly_redundant(&self, t: f64, motions: &[BodyMotion]) -> Option<String> {
        let mut s = self.scratch();
        s.motions.copy_from_slice(motions);
        self.find_rows(t, &mut s);
        let p = self.eliminated_to(NEARLY_SINGULAR, &s, &self.free_columns(&[]), |_| 0.0);
        p.dependent.first().map(|d| self.names(&s, &d.combination))
    }

    /// Number of coordinates of the bodies that the constraints leave free where they are like `motions` at
    /// time `t` \[s\].
    pub(crate) fn freedoms(&self, t: f64, motions: &[BodyMotion]) -> usize {
        let mut s = self.scratch();
        s.motions.copy_from_slice(motions);
        self.find_rows(t, &mut s);
        let columns = self.free_columns(&[]);
        columns.len() - self.eliminated(&s, &columns, |_| 0.0).pivots.len()
    }

    fn free_columns(&self, held: &[usize]) -> Vec<bool> {
        let n = 6 * self.mechanism().bodies().len();
        (0..n).map(|c| !held.contains(&(c / 6))).collect()
    }

    /// Newton's iteration for the positions.
    fn close(
        &self,
        t: f64,
        s: &mut AbsoluteScratch,
        free: &[bool],
        keeps: bool,
    ) -> Result<(), DynamicsError> {
        self.find_rows(t, s);
        let mut size = self.residual(s).0;
        for iteration in 0..=ITERATIONS {
            if size <= TOLERANCE * (1.0 + self.far(s)) {
                return self.check_branches(t, s);
            }
            let given = self.given(t, &s.motions, 0, keeps);
            let p = self.eliminated_with(given, s, free, |r| -r.value);
            let start = s.motions.clone();
            let mut factor = 1.0;
            let better = loop {
                self.shift(s, &start, &p.step, factor);
                self.find_rows(t, s);
                let now = self.residual(s).0;
                if now < size || now <= TOLERANCE {
                    break Some(now);
                }
                factor *= 0.5;
                if factor < 1e-4 {
                    break None;
                }
            };
            match better {
                Some(now) if iteration < ITERATIONS => size = now,
                _ => return Err(self.not_closed(t, s, free, iteration)),
            }
        }
        unreachable!("the last iteration returns")
    }

    /// Distance of the farthest body from the origin in natural lengths: its round-off counts.
    fn far(&self, s: &AbsoluteScratch) -> f64 {
        let length = self.mechanism().units().length;
        largest(s.motions.iter().flat_map(|m| m.p.abs().to_array())) / length
    }

    fn shift(&self, s: &mut AbsoluteScratch, start: &[BodyMotion], step: &[f64], factor: f64) {
        let length = self.mechanism().units().length;
        for (i, (m, from)) in s.motions.iter_mut().zip(start).enumerate() {
            let part = |k: usize| factor * DVec3::from_slice(&step[6 * i + k..]);
            m.p = from.p + length * part(0);
            m.r = from.r * DMat3::from_quat(DQuat::from_scaled_axis(part(3)));
        }
    }

    /// Largest scaled constraint value and the index of its joint.
    fn residual(&self, s: &AbsoluteScratch) -> (f64, usize) {
        let length = self.mechanism().units().length;
        let mut worst = (0.0, 0);
        for (joint, r) in Self::rows(s) {
            let size = r.value.abs() / if r.is_length { length } else { 1.0 };
            if size.is_nan() || size > worst.0 {
                worst = (size, *joint);
            }
        }
        worst
    }

    /// Elimination of the scaled constraints for the right-hand side `what`.
    fn eliminated(
        &self,
        s: &AbsoluteScratch,
        free: &[bool],
        what: impl Fn(&super::joint::Row) -> f64,
    ) -> Partition {
        self.eliminated_to(RANK_TOLERANCE, s, free, what)
    }

    /// The same beside what joints are given for the start.
    fn eliminated_with(
        &self,
        given: Given,
        s: &AbsoluteScratch,
        free: &[bool],
        what: impl Fn(&super::joint::Row) -> f64,
    ) -> Partition {
        let (mut a, mut b) = self.scaled(s, free.len(), what);
        a.extend(given.0);
        b.extend(given.1);
        partition(a, b, free, RANK_TOLERANCE)
    }

    /// The same with pivots below `zero` taken for zero.
    fn eliminated_to(
        &self,
        zero: f64,
        s: &AbsoluteScratch,
        free: &[bool],
        what: impl Fn(&super::joint::Row) -> f64,
    ) -> Partition {
        let (a, b) = self.scaled(s, free.len(), what);
        partition(a, b, free, zero)
    }

    /// Rows of the scaled constraints in `n` columns, and their right-hand sides.
    fn scaled(
        &self,
        s: &AbsoluteScratch,
        n: usize,
        what: impl Fn(&super::joint::Row) -> f64,
    ) -> (Vec<Vec<f64>>, Vec<f64>) {
        let length = self.mechanism().units().length;
        let (mut a, mut b) = (vec![], vec![]);
        for (joint, r) in Self::rows(s) {
            let joint = &self.mechanism().joints()[*joint];
            let unit = if r.is_length { 1.0 / length } else { 1.0 };
            let mut row = vec![0.0; n];
            for (body, f) in [(joint.parent, &r.parent), (Some(joint.child), &r.child)] {
                for (c, x) in body.into_iter().flat_map(|b| {
                    let columns = (0..6).map(move |c| 6 * b + c);
                    columns.zip(f[0].to_array().into_iter().chain(f[1].to_array()))
                }) {
                    let column = if c % 6 < 3 { length } else { 1.0 };
                    row[c] += x * unit * column;
                }
            }
            a.push(row);
            b.push(what(r) * unit);
        }
        (a, b)
    }

    /// Velocities that fulfil the constraints, and the check for what is asked twice.
    fn match_velocities(
        &self,
        t: f64,
        s: &mut AbsoluteScratch,
        free: &[bool],
        keeps: bool,
    ) -> Result<(), DynamicsError> {
        let given = self.given(t, &s.motions, 1, keeps);
        let p = self.eliminated_with(given, s, free, |r| -r.rate);
        self.refuse_contradiction(t, s, &p)?;
        self.refuse_redundance(t, s)?;
        let length = self.mechanism().units().length;
        for (i, m) in s.motions.iter_mut().enumerate() {
            let part = |k: usize| DVec3::from_slice(&p.step[6 * i + k..]);
            m.v += length * part(0);
            m.w += part(3);
        }
        Ok(())
    }

    /// Rows that follow from others must agree with them.
    fn refuse_contradiction(
        &self,
        time: f64,
        s: &AbsoluteScratch,
        p: &Partition,
    ) -> Result<(), DynamicsError> {
        let unit = self.mechanism().units().time;
        let size = |d: &Dependent| d.residual.abs() * unit;
        let clash = p.dependent.iter().find(|d| size(d) > CONTRADICTION);
        clash.map_or(Ok(()), |d| {
            Err(DynamicsError::Contradiction {
                time,
                joints: self.names(s, &d.combination),
                residual: size(d),
            })
        })
    }

    /// Rows that follow from others leave their multipliers open, whatever is held.
    fn refuse_redundance(&self, time: f64, s: &AbsoluteScratch) -> Result<(), DynamicsError> {
        let p = self.eliminated(s, &self.free_columns(&[]), |r| -r.rate);
        self.refuse_contradiction(time, s, &p)?;
        p.dependent.first().map_or(Ok(()), |d| {
            let joints = self.names(s, &d.combination);
            Err(DynamicsError::Redundant { time, joints })
        })
    }

    /// Names of the joints with a share in a combination of rows.
    fn names(&self, s: &AbsoluteScratch, combination: &[f64]) -> String {
        let rows = combination.iter().zip(Self::rows(s));
        let shared = rows.filter(|(c, _)| c.abs() > 1e-6);
        quoted_once(shared.map(|(_, (joint, _))| &*self.mechanism().joints()[*joint].name))
    }

    /// Why the positions cannot be matched: joints that contradict each other, or the worst one.
    fn not_closed(
        &self,
        time: f64,
        s: &AbsoluteScratch,
        free: &[bool],
        iterations: usize,
    ) -> DynamicsError {
        let p = self.eliminated(s, free, |r| -r.value);
        let clash = p
            .dependent
            .iter()
            .find(|d| d.residual.abs() > CONTRADICTION);
        if let Some(d) = clash {
            return DynamicsError::Contradiction {
                time,
                joints: self.names(s, &d.combination),
                residual: d.residual,
            };
        }
        let (residual, joint) = self.residual(s);
        DynamicsError::NotAssembled {
            time,
            joint: self.mechanism().joints()[joint].name.clone(),
            residual,
            iterations,
        }
    }

    fn check_branches(&self, time: f64, s: &AbsoluteScratch) -> Result<(), DynamicsError> {
        let joints = self.mechanism().joints().iter();
        for (joint, l) in joints.zip(Self::joints(s)) {
            if l.is_reversed() {
                return Err(DynamicsError::NotAssembled {
                    time,
                    joint: format!("{} (its axes point against each other)", joint.name),
                    residual: 2.0,
                    iterations: 0,
                });
            }
        }
        Ok(())
    }
}
