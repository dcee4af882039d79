//! The fast sum of algebraic cores by interpolation between cells.

use crate::cores::CoreModel;
use crate::fast::check::{Check, SAMPLES};
use crate::fast::{FastSettings, FastSum, Method, Report};
use crate::interpolation::{Fineness, Interpolation, Work};
use crate::sources::Points;
use fearless_simd::Level;
use glam::DVec3;

/// Edges from which the cells may gain more than they cost; measured.
pub(super) const AUTO_EDGES: usize = 25_000;

/// The tolerance from which they serve. Below it, single precision takes less time than a finer interpolation.
const TOLERANCE: f64 = 1e-3;

/// What sums of leaves cost in pairs of the sum in single precision, which finds more nodes in sight, in tenths.
const NEAR: u64 = 16;

/// The same of a point of a grid on a grid, and at a target; measured.
const FAR: u64 = 42;
const READ: u64 = 19;

/// How large cells may be at the first and at the second attempt.
const PARTS: [f64; 2] = [1.0, 0.7];

/// The cells, for cores and tolerances that they serve.
pub(super) fn interpolation(settings: &FastSettings, level: Level) -> Option<Interpolation> {
    let is_soft = matches!(settings.model, CoreModel::Algebraic { .. });
    let may_be = matches!(settings.method, Method::Auto | Method::Tree);
    (is_soft && may_be && settings.tolerance >= TOLERANCE).then(|| {
        let fineness = Fineness::for_tolerance(settings.tolerance);
        Interpolation::new(settings.model, level, fineness)
    })
}

impl FastSum {
    /// Adds velocities, and vorticities if they are wanted; or adds nothing and says how many attempts were made
    /// before the sum in single precision was the cheaper one, or the error above the tolerance at all of them.
    pub(super) fn add_soft(
        &mut self,
        check: &Check,
        targets: &Points,
        velocity: &mut Points,
        vorticity: Option<&mut Points>,
    ) -> Result<Report, usize> {
        let soft = self.soft.as_mut().expect("cells are made");
        soft.aim(targets);
        let size = [self.packed.edges.len(), targets.len()];
        for (made, part) in PARTS.into_iter().enumerate() {
            let work = soft.pair(part);
            if self.settings.method == Method::Auto && !pays(work, soft.points(), size) {
                return Err(made); // a stricter one costs more still
            }
            let sums = soft.evaluate();
            let [error_rms, error_max] = error(check, sums);
            let is_finite = sums.iter().flatten().all(|v| v.is_finite());
            if is_finite && error_rms <= self.settings.tolerance {
                add_part(sums, 0, velocity);
                if let Some(vorticity) = vorticity {
                    add_part(sums, 3, vorticity);
                }
                return Ok(Report {
                    method: Method::Tree,
                    error_rms,
                    error_max,
                    samples: check.count,
                    attempts: made + 1,
                    far: work.far,
                    near: work.near,
                });
            }
        }
        Err(PARTS.len())
    }
}

/// Root mean square and largest error of velocities and vorticities.
fn error(check: &Check, sums: &[[f64; 6]]) -> [f64; 2] {
    let mut sampled = [[DVec3::ZERO; SAMPLES]; 2];
    for (k, &i) in check.index[..check.count].iter().enumerate() {
        let [u, v, w, x, y, z] = sums[i];
        (sampled[0][k], sampled[1][k]) = (DVec3::new(u, v, w), DVec3::new(x, y, z));
    }
    let [velocities, vorticities] = sampled.each_ref().map(|v| &v[..check.count]);
    check.error_of_both(velocities, vorticities)
}

/// Whether cells are cheaper than the sum in single precision.
fn pays(work: Work, points: usize, [edges, targets]: [usize; 2]) -> bool {
    let [points, edges, targets] = [points, edges, targets].map(|n| n as u64);
    NEAR * work.near / 10 + points * (FAR * work.far + READ * targets) < edges * targets
}

/// Adds three of the six numbers at each target.
fn add_part(sums: &[[f64; 6]], first: usize, out: &mut Points) {
    for (i, sum) in sums.iter().enumerate() {
        out.set(i, out.get(i) + DVec3::from_slice(&sum[first..]));
    }
}
