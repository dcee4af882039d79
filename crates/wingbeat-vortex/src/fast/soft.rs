//! The fast sums of algebraic cores: by interpolation between cells, and by Gaussians on meshes.

use crate::cores::CoreModel;
use crate::fast::check::{Check, SAMPLES};
use crate::fast::settings::{FastSettings, Method, Report};
use crate::interpolation::{Fineness, Interpolation};
use crate::multilevel::Multilevel;
use crate::sources::{Network, Points};
use crate::work::Work;
use fearless_simd::Level;
use glam::DVec3;

/// Edges from which the cells may gain more than they cost; measured.
const AUTO_EDGES: usize = 25_000;

/// Edges from which meshes may gain more than their check costs; measured.
const MESH_EDGES: usize = 8_000;

/// The tolerance from which [`Method::Mesh`] serves, and [`Method::Tree`] of algebraic cores. Below it, single
/// precision takes less time than a finer interpolation.
pub const MESH_TOLERANCE: f64 = 1e-3;

/// What sums of leaves cost in pairs of the sum in single precision, which finds more nodes in sight, in tenths.
const NEAR: u64 = 16;

/// The same of a point of a grid on a grid, and at a target; measured.
const FAR: u64 = 42;
const READ: u64 = 19;

/// How large cells may be at the first and at the second attempt.
const PARTS: [f64; 2] = [1.0, 0.7];

/// Meshes that cost less than this part of single precision are taken without counting what cells would cost.
const CHEAP: f64 = 0.7;

/// Cells and meshes of algebraic cores.
#[derive(Clone, Debug)]
pub(super) struct Soft {
    cells: Option<Interpolation>,
    /// Whether cells may gain something, and whether they have the sources already.
    has_cells: bool,
    is_grown: bool,
    meshes: Option<Multilevel>,
    /// What meshes cost for each target, in pairs of filament and target, where they are loaded.
    mesh_cost: Option<f64>,
}

impl Soft {
    /// For cores, tolerances and methods that they serve; else nothing.
    pub fn new(settings: &FastSettings, level: Level) -> Self {
        let (model, tolerance) = (settings.model, settings.tolerance);
        let serves = matches!(model, CoreModel::Algebraic { .. }) && tolerance >= MESH_TOLERANCE;
        let may_be = |method| serves && [Method::Auto, method].contains(&settings.method);
        let cells = || Interpolation::new(model, level, Fineness::for_tolerance(tolerance));
        Self {
            cells: may_be(Method::Tree).then(cells),
            has_cells: false,
            is_grown: false,
            meshes: may_be(Method::Mesh).then(|| Multilevel::new(model, level)),
            mesh_cost: None,
        }
    }

    /// Whether it serves cores and tolerance.
    pub fn serves(&self) -> bool {
        self.cells.is_some() || self.meshes.is_some()
    }

    /// Whether anything is loaded.
    pub fn is_loaded(&self) -> bool {
        self.has_cells || self.mesh_cost.is_some()
    }

    /// Replaces the sources where that may gain something.
    pub fn load(&mut self, method: Method, network: &Network) {
        let edges = network.len();
        let is_large = |least: usize| match method {
            Method::Auto => edges >= least,
            _ => edges > 0,
        };
        let meshes = self.meshes.as_mut().filter(|_| is_large(MESH_EDGES));
        self.mesh_cost = meshes.and_then(|meshes| meshes.load(network));
        if method == Method::Auto {
            self.mesh_cost = self.mesh_cost.filter(|cost| *cost < edges as f64);
        }
        let is_cheap = self
            .mesh_cost
            .is_some_and(|cost| cost < CHEAP * edges as f64);
        self.has_cells = self.cells.is_some() && is_large(AUTO_EDGES) && !is_cheap;
        self.is_grown = false;
    }

    /// Adds velocities, and vorticities if they are wanted, of the network that was loaded last, of so many packed
    /// `edges`; or adds nothing and says how many attempts were made in vain.
    pub fn add(
        &mut self,
        check: &Check,
        targets: &Points,
        (settings, (network, edges)): (&FastSettings, (&Network, usize)),
        (velocity, vorticity): (&mut Points, Option<&mut Points>),
    ) -> Result<Report, usize> {
        let (tolerance, mut attempts) = (settings.tolerance, 0);
        let mut found = None;
        if let Some(cells) = self.cells.as_mut().filter(|_| self.has_cells) {
            if !self.is_grown {
                cells.load(network);
                self.is_grown = true;
            }
            let others = self.mesh_cost.map_or(edges, |cost| cost as usize);
            let dearest = (settings.method == Method::Auto).then_some(others);
            match sum(cells, check, targets, (tolerance, dearest)) {
                Ok(sum) => found = Some((Method::Tree, sum)),
                Err(made) => attempts = made,
            }
        }
        let has_meshes = found.is_none() && self.mesh_cost.is_some();
        if let Some(meshes) = self.meshes.as_mut().filter(|_| has_meshes) {
            match mesh_sum(meshes, check, targets, tolerance) {
                Ok(sum) => found = Some((Method::Mesh, sum)),
                Err(made) => attempts += made,
            }
        }
        let (method, sum) = found.ok_or(attempts)?;
        add_part(sum.values, 0, velocity);
        if let Some(vorticity) = vorticity {
            add_part(sum.values, 3, vorticity);
        }
        Ok(Report {
            method,
            error_rms: sum.error[0],
            error_max: sum.error[1],
            samples: check.count,
            attempts: attempts + sum.attempts,
            far: sum.work.far,
            near: sum.work.near,
        })
    }
}

/// A sum that keeps the tolerance.
struct Sum<'a> {
    /// Velocity \[m/s\] and vorticity \[1/s\] at each target.
    values: &'a [[f64; 6]],
    /// Root mean square and largest error at the sampled targets.
    error: [f64; 2],
    attempts: usize,
    work: Work,
}

/// Sums by cells; or the attempts made before another sum was the cheaper one, which takes `dearest` pairs a target
/// if there is one, or the error above the tolerance at all of them.
fn sum<'a>(
    soft: &'a mut Interpolation,
    check: &Check,
    targets: &Points,
    (tolerance, dearest): (f64, Option<usize>),
) -> Result<Sum<'a>, usize> {
    soft.aim(targets);
    for (made, part) in PARTS.into_iter().enumerate() {
        let work = soft.pair(part);
        let cost = cost(work, soft.points(), targets.len());
        if dearest.is_some_and(|pairs| cost >= pairs as u64 * targets.len() as u64) {
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

/// Sums by meshes; or the attempts made: none where they do not serve these targets, one with an error above the
/// tolerance.
fn mesh_sum<'a>(
    meshes: &'a mut Multilevel,
    check: &Check,
    targets: &Points,
    tolerance: f64,
) -> Result<Sum<'a>, usize> {
    let (values, work) = meshes.sum(targets).ok_or(0_usize)?;
    let error = error(check, values);
    let is_finite = values.iter().flatten().all(|v| v.is_finite());
    let sum = Sum {
        values,
        error,
        attempts: 1,
        work,
    };
    (is_finite && error[0] <= tolerance).then_some(sum).ok_or(1)
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

/// What cells cost, in pairs of the sum in single precision.
fn cost(Work { far, near }: Work, points: usize, targets: usize) -> u64 {
    NEAR * near / 10 + points as u64 * (FAR * far + READ * targets as u64)
}

/// Adds three of the six numbers at each target.
fn add_part(sums: &[[f64; 6]], first: usize, out: &mut Points) {
    for (i, sum) in sums.iter().enumerate() {
        out.add(i, DVec3::from_slice(&sum[first..]));
    }
}
