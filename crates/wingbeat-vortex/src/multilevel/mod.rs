//! The sum over wide filaments of algebraic cores: Gaussians on meshes, each mesh as coarse as its Gaussian is wide.
//!
//! The kernel `1 / D^3`, `D^2 = r^2 + q + e` with half the squared core radii q of the target and e of the
//! source, is a sum of Gaussians ([`gaussians`]), of which some ten hold over any range of D that a wake has:
//!
//! `1 / D^3 = sum w exp(-t e) . exp(-t r^2) . exp(-t q)`.
//!
//! To each of them the cores of source and target are mere factors, whatever they are and however much they
//! differ from filament to filament: that is what cells of place and softening ([`crate::interpolation`])
//! cannot offer. So each Gaussian has a mesh ([`mesh`]), as in the multilevel summation of molecular dynamics
//! [Skeel, Tezcan & Hardy 2002, J. Comput. Chem. 23:673]: filaments spread their strengths, times `w exp(-t
//! e)`, over its nodes by cubic splines ([`spline`]), at as many Gauss points as `t l^2` asks for; the mesh is
//! convolved with the Gaussian axis by axis ([`convolution`]); and splines read velocity and vorticity at the
//! targets, times `exp(-t q)`. The meshes of wide Gaussians are coarse, so all of them together have hardly
//! more nodes than the finest.
//!
//! The finest one is made for the least D of two places of which one is wide. Pairs of narrow filaments with
//! narrow targets are summed one by one, in single precision: sources spread to two sets of meshes, of which
//! narrow targets read that of the wide ones. What is wide is chosen by what the sum costs ([`plan`]). In a
//! wake that grows, narrow filaments are those shed last, and their number stays: cost and memory are those of
//! sources, targets and nodes.
//!
//! Same bits for any number of threads and any instructions: each node and each target adds up in a fixed order.

mod convolution;
mod gaussians;
mod mesh;
mod plan;
mod spline;
#[cfg(test)]
mod tests;

use crate::cores::{CoreModel, INV_4PI};
use crate::direct::moments;
use crate::direct::packed::Packed;
use crate::direct::single::{CLUSTER, Single};
use crate::direct::sum::sum_both;
use crate::quadrature::gauss_legendre;
use crate::sources::{Network, Points};
use crate::work::Work;
use fearless_simd::{Level, dispatch};
use glam::DVec3;
use mesh::{Mesh, Source, Spreading};
use plan::{FINENESS, Plan, fineness, spacing};
use rayon::prelude::*;
use spline::Stencil;

/// Targets of a task.
const TASK: usize = 256;

/// Spacings of the finest mesh by which a box grows where targets are outside that of the sources.
const QUANTUM: f64 = 8.0;

/// How much larger than that of the sources the meshes of a box with all targets may be.
const GROWTH: f64 = 4.0;

/// Where meshes are, and for which distances.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Domain {
    low: [f64; 3],
    high: [f64; 3],
    /// Number of Gaussians.
    count: usize,
}

/// Sources on meshes, and what targets hear of them.
#[derive(Clone, Debug)]
pub(crate) struct Multilevel {
    level: Level,
    model: CoreModel,
    stencils: [Stencil; FINENESS.len()],
    /// Gauss-Legendre abscissas and weights on (0, 1), of one point, two and so on.
    quadrature: Vec<Vec<(f64, f64)>>,
    plan: Option<Plan>,
    /// Corners of the box of all sources \[m\], and the largest softening \[m2\].
    box_of_sources: [[f64; 3]; 2],
    widest: f64,
    wide: Vec<Source>,
    narrow: Vec<Source>,
    softenings: Vec<f64>,
    packed: Packed,
    single: Single,
    meshes: Vec<Mesh>,
    /// What the meshes hold.
    domain: Option<Domain>,
    near: Near,
    sums: Vec<[f64; 6]>,
}

/// Narrow targets and what narrow sources do there.
#[derive(Clone, Debug, Default)]
struct Near {
    index: Vec<u32>,
    targets: Points,
    velocity: Points,
    vorticity: Points,
}

impl Multilevel {
    /// No sources yet.
    pub fn new(model: CoreModel, level: Level) -> Self {
        Self {
            level,
            model,
            stencils: FINENESS.map(|(width, reach)| Stencil::new(width, reach)),
            quadrature: (1..=mesh::MOST_POINTS).map(gauss_legendre).collect(),
            plan: None,
            box_of_sources: [[0.0; 3]; 2],
            widest: 0.0,
            wide: vec![],
            narrow: vec![],
            softenings: vec![],
            packed: Packed::default(),
            single: Single::default(),
            meshes: vec![],
            domain: None,
            near: Near::default(),
            sums: vec![],
        }
    }

    /// Replaces the sources; returns what a sum costs for each target, in pairs of filament and target, if it
    /// can be made.
    pub fn load(&mut self, network: &Network) -> Option<f64> {
        self.domain = None;
        self.take(network);
        let [low, high] = self.box_of_sources;
        let sides = std::array::from_fn(|d| high[d] - low[d]);
        self.softenings.clear();
        self.softenings.extend(self.wide.iter().map(Source::least));
        self.softenings.sort_unstable_by(f64::total_cmp);
        self.plan = Plan::cheapest(&self.softenings, sides);
        let plan = self.plan?;
        let is_narrow = |source: &Source| source.least() < plan.least;
        self.narrow.clear();
        self.narrow
            .extend(self.wide.iter().filter(|s| is_narrow(s)));
        self.wide.retain(|source| !is_narrow(source));
        self.pack(network);
        Some(plan.cost)
    }

    /// All sources as if they were wide, their box, and the largest softening.
    fn take(&mut self, network: &Network) {
        let moving = (0..network.len()).filter(|&e| network.gamma[e] != 0.0);
        self.wide.clear();
        self.wide.extend(moving.map(|e| source(network, e)));
        let [low, high] = &mut self.box_of_sources;
        (*low, *high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        self.widest = 0.0;
        for source in &self.wide {
            for d in 0..3 {
                let ends = [source.from[d], source.from[d] + source.along[d]];
                low[d] = low[d].min(ends[0]).min(ends[1]);
                high[d] = high[d].max(ends[0]).max(ends[1]);
            }
            self.widest = self.widest.max(source.most());
        }
    }

    /// The narrow sources for the sum one by one.
    fn pack(&mut self, network: &Network) {
        self.packed.clear(network.nodes.len());
        let narrow = self.narrow.iter().map(|source| source.index);
        self.packed.load_group(self.model, network, narrow);
        let patches = self.packed.patches.len();
        let clusters = (0..patches).step_by(CLUSTER);
        let clusters = clusters.map(|first| first..patches.min(first + CLUSTER));
        self.single.load(self.model, &self.packed, clusters);
    }

    /// Velocity \[m/s\] and vorticity \[1/s\] at all targets; None if these are too far off for meshes.
    pub fn sum(&mut self, targets: &Points) -> Option<(&[[f64; 6]], Work)> {
        let plan = self.plan?;
        let domain = self.domain_with(plan, targets)?;
        if self.domain != Some(domain) {
            self.fill(plan, domain);
        }
        self.sums.clear();
        self.sums.resize(targets.len(), [0.0; 6]);
        let far = self.read(plan, targets);
        let near = self.sum_near(plan, targets);
        Some((&self.sums, Work { far, near }))
    }

    /// The domain of sources and targets: that of the sources, enlarged in steps.
    fn domain_with(&self, plan: Plan, targets: &Points) -> Option<Domain> {
        let [low, high] = self.box_of_sources;
        let axes = [&targets.x, &targets.y, &targets.z];
        let step = QUANTUM * spacing(0, gaussians::gaussian(0, usize::MAX, plan.least)[0]);
        let out = |most: f64| step * (most.max(0.0) / step).ceil();
        let beyond =
            |far: &dyn Fn(&f64) -> f64, d: usize| out(axes[d].iter().map(far).fold(0.0, f64::max));
        let low = std::array::from_fn(|d| low[d] - beyond(&|x| low[d] - x, d));
        let high = std::array::from_fn(|d| high[d] + beyond(&|x| x - high[d], d));
        // In a wake that of the sources: all its targets have the same meshes.
        let soft = targets.core.iter().map(|core| 0.5 * core);
        let softest = soft.fold(self.widest, f64::max);
        let sides: [f64; 3] = std::array::from_fn(|d| high[d] - low[d]);
        let square: f64 = sides.iter().map(|side| side * side).sum();
        let most = square + self.widest + softest;
        let [from, to] = self.box_of_sources;
        let own = std::array::from_fn(|d| to[d] - from[d]);
        let own = plan::nodes(own, plan.least, most);
        let allowed = (GROWTH * own).min(plan::MOST_NODES.max(own));
        let is_sound = (most / plan.least).is_finite();
        let fits = is_sound && plan::nodes(sides, plan.least, most) <= allowed;
        let count = gaussians::count(most / plan.least);
        fits.then_some(Domain { low, high, count })
    }

    /// Sums on the meshes of a domain.
    fn fill(&mut self, plan: Plan, domain: Domain) {
        let Domain { low, high, count } = domain;
        self.domain = Some(domain);
        let first = self.stencils[0];
        if self.meshes.len() < count {
            self.meshes.resize_with(count, || Mesh::new(first));
        }
        let sides = std::array::from_fn(|d| high[d] - low[d]);
        let (level, sources) = (self.level, [&self.wide[..], &self.narrow]);
        let stencils = &self.stencils;
        let how = Spreading {
            origin: low,
            quadrature: &self.quadrature,
        };
        let meshes = self.meshes[..count].par_iter_mut().enumerate();
        meshes.for_each(|(k, mesh)| {
            let gaussian = gaussians::gaussian(k, count, plan.least);
            mesh.stencil = stencils[fineness(k)];
            mesh.fit(gaussian, spacing(k, gaussian[0]), sides);
            mesh.sum(level, sources, how);
        });
    }

    /// Adds what all targets read of the meshes; returns how often they did.
    fn read(&mut self, plan: Plan, targets: &Points) -> u64 {
        let Some(Domain { low, count, .. }) = self.domain else {
            return 0;
        };
        let (meshes, level, origin) = (&self.meshes[..count], self.level, DVec3::from(low));
        let sums = self.sums.par_chunks_mut(TASK).enumerate();
        let work = sums.map(|(task, sums)| {
            let mut count = 0;
            dispatch!(level, simd => {
                for mesh in meshes {
                    for (k, sum) in sums.iter_mut().enumerate() {
                        let i = TASK * task + k;
                        let soft = targets.softening(i);
                        let is_narrow = soft < plan.least;
                        let least = if is_narrow { soft + plan.least } else { soft };
                        if !mesh.is_heard(least) {
                            continue;
                        }
                        count += 1;
                        let x = (targets.get(i) - origin).to_array();
                        let more = mesh.read(simd, (x, soft), is_narrow);
                        sum.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
                    }
                }
            });
            count
        });
        work.sum()
    }

    /// Adds what narrow sources do at narrow targets; returns the number of pairs.
    fn sum_near(&mut self, plan: Plan, targets: &Points) -> u64 {
        if self.narrow.is_empty() {
            return 0;
        }
        let near = &mut self.near;
        near.index.clear();
        near.targets.clear();
        for i in (0..targets.len()).filter(|&i| targets.softening(i) < plan.least) {
            near.index.push(i as u32);
            let core = targets.core.get(i).copied().unwrap_or(0.0);
            near.targets.push_with_core(targets.get(i), core);
        }
        near.velocity.reset(near.index.len());
        near.vorticity.reset(near.index.len());
        let (level, single) = (self.level, &self.single);
        let both = [&mut near.velocity, &mut near.vorticity];
        sum_both(self.narrow.len(), &near.targets, both, |targets, sums| {
            moments::add_clusters(level, single, 0..single.clusters.len(), targets, sums);
        });
        for (k, &i) in near.index.iter().enumerate() {
            let (u, w) = (near.velocity.get(k), near.vorticity.get(k));
            let more = [u.x, u.y, u.z, w.x, w.y, w.z];
            let sum = &mut self.sums[i as usize];
            sum.iter_mut()
                .zip(more)
                .for_each(|(sum, more)| *sum += more);
        }
        (self.narrow.len() * near.index.len()) as u64
    }
}

/// Filament number e.
fn source(network: &Network, e: usize) -> Source {
    let (from, to) = network.ends(e);
    let soft = |end: usize| 0.5 * network.core_at(e, network.edges[e][end] as usize);
    let along = to - from;
    Source {
        from: from.to_array(),
        along: along.to_array(),
        softening: [soft(0), soft(1) - soft(0)],
        strength: (INV_4PI * network.gamma[e] * along).to_array(),
        index: e as u32,
    }
}
