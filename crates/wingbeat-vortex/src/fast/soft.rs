//! The fast sum of algebraic cores by interpolation between cells.

use crate::cores::CoreModel;
use crate::fast::check::{Check, SAMPLES};
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
pub(super) fn interpolation(
    model: CoreModel,
    tolerance: f64,
    level: Level,
) -> Option<Interpolation> {
    let is_soft = matches!(model, CoreModel::Algebraic { .. });
    (is_soft && tolerance >= TOLERANCE)
        .then(|| Interpolation::new(model, level, Fineness::for_tolerance(tolerance)))
}

/// A sum that keeps the tolerance.
pub(super) struct Sum<'a> {
    /// Velocity \[m/s\] and vorticity \[1/s\] at each target.
    pub values: &'a [[f64; 6]],
    /// Root mean square and largest error at the sampled targets.
    pub error: [f64; 2],
    pub attempts: usize,
    pub work: Work,
}

/// Sums of so many `edges`, which are loaded; or the attempts made before the sum in single precision was the cheaper one,
/// if that `may_be`, or the error above the tolerance at all of them.
pub(super) fn sum<'a>(
    soft: &'a mut Interpolation,
    check: &Check,
    targets: &Points,
    edges: usize,
    (tolerance, may_be_single): (f64, bool),
) -> Result<Sum<'a>, usize> {
    soft.aim(targets);
    for (made, part) in PARTS.into_iter().enumerate() {
        let work = soft.pair(part);
        if may_be_single && !pays(work, soft.points(), [edges, targets.len()]) {
            return Err(made); // a stricter one costs more still
        }
        soft.evaluate();
        let error = error(check, soft.sums());
        let is_finite = soft.sums().iter().flatten().all(|v| v.is_finite());
        if is_finite && error[0] <= tolerance {
            return Ok(Sum {
                values: soft.sums(),
                error,
                attempts: made + 1,
                work,
            });
        }
    }
    Err(PARTS.len())
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
pub(super) fn add_part(sums: &[[f64; 6]], first: usize, out: &mut Points) {
    for (i, sum) in sums.iter().enumerate() {
        out.set(i, out.get(i) + DVec3::from_slice(&sum[first..]));
    }
}
