//! The fast sum: near sources one by one, far ones cell by cell, with a checked error.

mod check;
mod settings;
mod soft;

pub use settings::{FastSettings, Method, Report, Tally};
pub use soft::MESH_TOLERANCE;

use crate::cores::CoreModel;
use crate::direct::lanes::{add_clusters, add_patches_with_vorticity};
use crate::direct::moments;
use crate::direct::packed::Packed;
use crate::direct::single::{CLUSTER, SINGLE, Single};
use crate::direct::sum::{sum_all, sum_both, sum_packed};
use crate::fast::check::{Check, SAMPLES};
use crate::fast::soft::Soft;
use crate::instruction_set::InstructionSet;
use crate::sources::{Network, Points};
use crate::tree::cells::Cells;
use crate::tree::groups::Groups;
use fearless_simd::Level;
use glam::DVec3;

/// Edges and targets from which the tree may be the faster one. Its check alone costs as much as some
/// hundred targets.
const AUTO_EDGES: usize = 4000;
const AUTO_TARGETS: usize = 1000;

/// Edges and targets from which single precision gains more than its check costs.
const SINGLE_EDGES: usize = 500;
const SINGLE_TARGETS: usize = 100;

/// Targets up to which, at a tolerance below [`MESH_TOLERANCE`], sums keep the last digits all the same: usually those
/// on surfaces, on which bodies and air come to agree.
const DOUBLE_TARGETS: usize = 500;

/// What a far cell may leave out, in parts of the tolerance. Many cells add up, with either sign:
/// fewer may leave out more, as the inverse root of their number.
fn share(leaves: usize) -> f64 {
    0.6 * (3000.0 / leaves as f64).sqrt().max(1.0)
}

/// The first attempt is this much laxer than estimates say it should be.
const LAX: f64 = 10.0;

/// Cost of summing an edge in a leaf, and of evaluating an expansion, in tenths of the cost of an
/// edge in the direct sum, which looks at fewer nodes per edge; measured.
const NEAR: u64 = 15;
const FAR: u64 = 160;

/// How many times single precision is as fast.
const SINGLE_GAIN: u64 = 2;

/// Attempts at the tolerance before the direct sum takes over.
const ATTEMPTS: usize = 6;

/// A sum that is direct for small sets, in single precision for larger ones, and a tree where that spares
/// something; the error of both is measured at every call.
///
/// It is a deterministic function of sources, targets and settings: same bits for any number
/// of threads and any instructions. A tree's cost is about N log N, all memory linear, and nothing is
/// allocated after the first call of a size.
///
/// ```
/// use wingbeat_vortex::{CoreModel, FastSettings, FastSum, Network, Points};
/// use wingbeat_vortex::DVec3;
/// let model = CoreModel::Vatistas { radius: 0.1 };
/// let mut ring = Network::default();
/// (0..4).for_each(|k| ring.nodes.push(DVec3::new((k & 1) as f64, (k >> 1) as f64, 0.0)));
/// [(0, 1), (1, 3), (3, 2), (2, 0)].map(|(a, b)| ring.push_edge(a, b, 1.0, model.core(1.0, 0.0)));
/// let mut sum = FastSum::new(FastSettings::new(model));
/// sum.load_network(&ring);
/// let mut v = Points::zeros(1);
/// let report = sum.add_velocity(&Points::from_iter([DVec3::new(0.5, 0.5, 0.0)]), &mut v);
/// assert!(v.z[0] > 0.0 && report.error_rms == 0.0);
/// ```
#[derive(Clone, Debug)]
pub struct FastSum {
    settings: FastSettings,
    level: Level,
    /// The sources in the order given, for the direct sums.
    packed: Packed,
    single: Single,
    has_single: bool,
    /// Velocities and vorticities in single precision, before they are checked.
    velocity: Points,
    vorticity: Points,
    /// The sources, of which the tree is made when a sum first asks for it.
    network: Network,
    cells: Cells,
    has_tree: bool,
    is_grown: bool,
    groups: Groups,
    /// What serves wide algebraic cores.
    soft: Soft,
    tally: Tally,
}

impl FastSum {
    /// No sources yet. Instructions this processor lacks are replaced by the best it has.
    pub fn new(settings: FastSettings) -> Self {
        let level = settings.instructions.level();
        let level = level.unwrap_or_else(InstructionSet::best);
        let is_single = settings.tolerance >= SINGLE;
        let cells = Cells::new(settings.model, level, order(settings.tolerance), is_single);
        Self {
            settings,
            level,
            packed: Packed::default(),
            single: Single::default(),
            has_single: false,
            velocity: Points::default(),
            vorticity: Points::default(),
            network: Network::default(),
            cells,
            has_tree: false,
            is_grown: false,
            groups: Groups::default(),
            soft: Soft::new(&settings, level),
            tally: Tally::default(),
        }
    }

    /// The settings.
    pub fn settings(&self) -> &FastSettings {
        &self.settings
    }

    /// Sums that were checked since it was made.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Whether it holds these sources, but for core radii of nodes that differ by no more than `near` \[m\].
    pub fn holds(&self, network: &Network, near: f64) -> bool {
        self.network.is_near(network, near)
    }

    /// Replaces the sources.
    pub fn load_network(&mut self, network: &Network) {
        self.network.clone_from(network);
        self.is_grown = false;
        let FastSettings {
            method,
            model,
            tolerance,
            ..
        } = self.settings;
        let has_cells = |least: usize| match method {
            Method::Auto => network.len() >= least,
            Method::Direct | Method::Single | Method::Mesh => false,
            Method::Tree => !network.is_empty(),
        };
        self.soft.load(method, network);
        self.has_tree = !self.soft.serves() && has_cells(AUTO_EDGES);
        let may_be_single = match method {
            Method::Auto | Method::Single | Method::Mesh => true,
            // The expansions know no vorticities, which such cores are asked for.
            Method::Tree => matches!(model, CoreModel::Algebraic { .. }),
            Method::Direct => false,
        };
        self.has_single = may_be_single && network.len() >= SINGLE_EDGES && tolerance >= SINGLE;
        match self.has_tree || self.soft.is_loaded() || self.has_single {
            true => self.packed.load_network(model, network),
            false => self.packed.load_moving(model, network),
        }
        if self.has_single {
            let patches = self.packed.patches.len();
            let clusters = (0..patches).step_by(CLUSTER);
            let clusters = clusters.map(|first| first..patches.min(first + CLUSTER));
            self.single.load(model, &self.packed, clusters);
        }
    }

    /// Whether expansions and meshes cost more than they gain at so few targets.
    fn is_few(&self, targets: &Points) -> bool {
        let method = self.settings.method;
        matches!(method, Method::Auto | Method::Mesh) && targets.len() < AUTO_TARGETS
    }

    /// Whether so many targets are summed in single precision.
    fn is_single(&self, targets: usize) -> bool {
        let is_rough = self.settings.tolerance >= MESH_TOLERANCE;
        let least = if is_rough {
            SINGLE_TARGETS
        } else {
            DOUBLE_TARGETS
        };
        self.has_single && targets >= least
    }

    /// Adds to `out` \[m/s\] the velocity of all sources at the `targets` \[m\].
    pub fn add_velocity(&mut self, targets: &Points, out: &mut Points) -> Report {
        assert_eq!(targets.len(), out.len(), "as many velocities as targets");
        let few = self.is_few(targets);
        let has_tree = self.has_tree && !few;
        let has_soft = self.soft.is_loaded() && !few;
        let has_single = self.is_single(targets.len());
        if targets.is_empty() || !(has_tree || has_soft || has_single) {
            return self.add_direct(targets, out, 0);
        }
        let check = Check::new(self.sources(), targets);
        self.tally.checked += 1;
        let mut attempts = 0;
        if has_soft {
            match self.add_soft(&check, targets, (out, None)) {
                Ok(report) => return report,
                Err(made) => attempts = made,
            }
        }
        if has_tree {
            if !self.is_grown {
                self.cells.load(&self.network);
                self.is_grown = true;
            }
            self.groups.load(targets);
            match self.find_allowed(&check) {
                Ok((allowed, made, error)) => {
                    if let Some(report) = self.add_tree(&check, allowed, made, error, out) {
                        return report;
                    }
                    self.tally.discarded += 1;
                    attempts = made;
                }
                Err(made) => attempts = made,
            }
        }
        if has_single {
            return self.add_single(&check, targets, attempts, out);
        }
        self.add_direct(targets, out, attempts)
    }

    /// As [`Self::add_velocity`], of algebraic cores ([`CoreModel::Algebraic`]); and adds to
    /// `vorticity` \[1/s\] the sum of `Gamma / (4 pi)` times the integral along the filaments of `dl` over the cube of
    /// the softened distance. Where squared core radii change along a filament, closed filaments act on each other with
    /// no force in sum if a piece with a change `d(sigma^2)` is given `-Gamma d(sigma^2) / 4` times this beside
    /// `Gamma u x dl`.
    pub fn add_velocity_and_vorticity(
        &mut self,
        targets: &Points,
        velocity: &mut Points,
        vorticity: &mut Points,
    ) {
        assert!(
            matches!(self.settings.model, CoreModel::Algebraic { .. }),
            "algebraic cores"
        );
        let has_soft = self.soft.is_loaded() && !self.is_few(targets) && !targets.is_empty();
        let has_single = self.is_single(targets.len());
        let needs_check = has_soft || has_single;
        self.tally.checked += u64::from(needs_check);
        let check = needs_check.then(|| Check::with_vorticity(self.sources(), targets));
        if let Some(check) = check.as_ref().filter(|_| has_soft) {
            let sum = self.add_soft(check, targets, (&mut *velocity, Some(&mut *vorticity)));
            if sum.is_ok() {
                return;
            }
        }
        let (packed, single) = (&self.packed, &self.single);
        let (edges, level) = (packed.edges.len(), self.level);
        if let Some(check) = check.filter(|_| has_single) {
            self.velocity.reset(targets.len());
            self.vorticity.reset(targets.len());
            let out = [&mut self.velocity, &mut self.vorticity];
            sum_both(edges, targets, out, |targets, sums| {
                let all = 0..single.clusters.len();
                moments::add_clusters(level, single, all, targets, sums);
            });
            if self.error_of_single(&check).is_some() {
                add_to(velocity, &self.velocity);
                add_to(vorticity, &self.vorticity);
                return;
            }
            self.tally.discarded += 1;
        }
        let all = || std::iter::once(0..packed.patches.len());
        sum_both(edges, targets, [velocity, vorticity], |targets, sums| {
            add_patches_with_vorticity(level, packed, all(), targets, sums);
        });
    }

    /// What the sums are checked against.
    fn sources(&self) -> (Level, CoreModel, &Packed) {
        (self.level, self.settings.model, &self.packed)
    }

    /// By cells or meshes of algebraic cores, or nothing and the attempts made.
    fn add_soft(
        &mut self,
        check: &Check,
        targets: &Points,
        out: (&mut Points, Option<&mut Points>),
    ) -> Result<Report, usize> {
        let sources = (&self.network, self.packed.edges.len());
        let made = (self.soft).add(check, targets, (&self.settings, sources), out);
        let in_vain = made
            .as_ref()
            .map_or_else(|made| *made, |report| report.attempts - 1);
        self.tally.discarded += in_vain as u64;
        made
    }

    /// Error in single precision at the sampled targets, root mean square and largest, of the velocities and, where the
    /// check has them, the vorticities; None if it is above the tolerance.
    fn error_of_single(&self, check: &Check) -> Option<[f64; 2]> {
        let sampled = |sums: &Points| check.index.map(|i| sums.get(i));
        let is_finite = |sums: &Points| sums.iter().all(|v| v.is_finite());
        let velocity = sampled(&self.velocity);
        let velocity = &velocity[..check.count];
        let (error, are_finite) = match check.has_vorticity() {
            true => {
                let vorticity = sampled(&self.vorticity);
                let error = check.error_of_both(velocity, &vorticity[..check.count]);
                (
                    error,
                    is_finite(&self.velocity) && is_finite(&self.vorticity),
                )
            }
            false => (check.error(velocity), is_finite(&self.velocity)),
        };
        (are_finite && error[0] <= self.settings.tolerance).then_some(error)
    }

    /// By the tree; None, and nothing added, if single precision was too small for the near field.
    fn add_tree(
        &mut self,
        check: &Check,
        allowed: f64,
        attempts: usize,
        [error_rms, error_max]: [f64; 2],
        out: &mut Points,
    ) -> Option<Report> {
        let work = self.groups.evaluate(&self.cells, allowed);
        self.groups.is_finite().then(|| {
            self.groups.add_to(out);
            Report {
                method: Method::Tree,
                error_rms,
                error_max,
                samples: check.count,
                attempts,
                far: work.far,
                near: work.near,
            }
        })
    }

    /// In single precision, or in double if the error at the sampled targets is above the tolerance.
    fn add_single(
        &mut self,
        check: &Check,
        targets: &Points,
        attempts: usize,
        out: &mut Points,
    ) -> Report {
        let (level, model, single) = (self.level, self.settings.model, &self.single);
        self.velocity.reset(targets.len());
        sum_all(
            self.packed.edges.len(),
            targets,
            &mut self.velocity,
            |targets, sum| {
                add_clusters(level, model, single, 0..single.clusters.len(), targets, sum);
            },
        );
        let Some([error_rms, error_max]) = self.error_of_single(check) else {
            self.tally.discarded += 1;
            return self.add_direct(targets, out, attempts + 1);
        };
        add_to(out, &self.velocity);
        Report {
            method: Method::Single,
            error_rms,
            error_max,
            samples: check.count,
            attempts: attempts + 1,
            far: 0,
            near: (self.packed.edges.len() * targets.len()) as u64,
        }
    }

    /// What a far cell may leave out \[m/s\] so that the error at the sampled targets keeps the
    /// tolerance, the attempts it took, and that error (root mean square, largest): begins too lax, for
    /// a lax attempt costs little. Instead the attempts made if the tolerance cannot be kept, or not
    /// cheaper than by the direct sum.
    fn find_allowed(&mut self, check: &Check) -> Result<(f64, usize, [f64; 2]), usize> {
        let tolerance = self.settings.tolerance;
        let mut share = LAX * share(self.cells.leaf_patches.len());
        let gain = if self.has_single { SINGLE_GAIN } else { 1 };
        let mut velocity = [DVec3::ZERO; SAMPLES];
        for attempt in 1..=ATTEMPTS {
            let allowed = share * tolerance * check.scale;
            let (samples, velocity) = (&check.index[..check.count], &mut velocity[..check.count]);
            let work = (self.groups).sample(&self.cells, allowed, samples, velocity);
            let pairs = (self.packed.edges.len() * check.count) as u64;
            if self.settings.method == Method::Auto
                && NEAR * work.near + gain * FAR * work.far > 10 * pairs
            {
                return Err(attempt); // a stricter one costs more still
            }
            let error = check.error(velocity);
            if error[0] <= tolerance {
                return Ok((allowed, attempt, error));
            }
            share *= (0.5 * tolerance / error[0]).max(1e-3);
        }
        Err(ATTEMPTS)
    }

    fn add_direct(&self, targets: &Points, out: &mut Points, attempts: usize) -> Report {
        let packed = &self.packed;
        sum_packed(self.level, self.settings.model, packed, targets, out);
        Report {
            method: Method::Direct,
            error_rms: 0.0,
            error_max: 0.0,
            samples: 0,
            attempts,
            far: 0,
            near: (packed.edges.len() * targets.len()) as u64,
        }
    }
}

fn add_to(out: &mut Points, more: &Points) {
    for (i, v) in more.iter().enumerate() {
        out.add(i, v);
    }
}

/// Order of the expansions that is cheapest at this tolerance.
fn order(tolerance: f64) -> usize {
    match tolerance {
        t if t >= 2e-3 => 4,
        t if t >= 2e-5 => 6,
        t if t >= 2e-7 => 8,
        t if t >= 2e-9 => 10,
        _ => 12,
    }
}
