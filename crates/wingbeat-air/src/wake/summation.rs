//! The velocity that filaments and blobs make at many points: which sum serves which sources, and what need
//! not be summed again.

use crate::images::Mirror;
use crate::settings::AirSettings;
use crate::wake::filaments::Filaments;
use wingbeat_math::DVec3;
use wingbeat_vortex::{
    AlgebraicSum, CoreModel, FastSettings, FastSum, GaussianSum, Method, Network, Points, Tally,
};

/// A Biot-Savart sum over one network, its memory kept from call to call.
#[derive(Clone, Debug, Default)]
struct Summation {
    sum: Option<FastSum>,
}

impl Summation {
    /// Takes the sources; says whether they differ from those it holds already.
    fn load(&mut self, settings: FastSettings, sources: &Network) -> bool {
        self.load_unless_near(settings, sources, 0.0)
    }

    /// The same unless they differ in nothing but core radii of nodes, by `near` [m] at most.
    fn load_unless_near(&mut self, settings: FastSettings, sources: &Network, near: f64) -> bool {
        let kept = self.sum.take_if(|sum| *sum.settings() == settings);
        let is_known = kept.as_ref().is_some_and(|sum| sum.holds(sources, near));
        let sum = self
            .sum
            .insert(kept.unwrap_or_else(|| FastSum::new(settings)));
        if !is_known {
            sum.load_network(sources);
        }
        !is_known
    }

    fn tally(&self) -> Tally {
        self.sum.as_ref().map_or(Tally::default(), FastSum::tally)
    }

    fn add(&mut self, targets: &Points, out: &mut Points) {
        let sum = self.sum.as_mut().expect("sources are loaded");
        sum.add_velocity(targets, out);
    }

    fn add_with_vorticity(&mut self, targets: &Points, [velocity, vorticity]: [&mut Points; 2]) {
        let sum = self.sum.as_mut().expect("sources are loaded");
        sum.add_velocity_and_vorticity(targets, velocity, vorticity);
    }
}

/// How filaments of this core are summed: those on and near surfaces one by one.
fn direct(model: CoreModel) -> FastSettings {
    FastSettings {
        method: Method::Direct,
        ..FastSettings::new(model)
    }
}

/// How lattice and near wake act on the wakes where cores are algebraic: in single precision if the wakes may.
fn on_wakes(settings: &AirSettings) -> FastSettings {
    FastSettings {
        method: match settings.summation {
            Method::Direct => Method::Direct,
            Method::Auto | Method::Single | Method::Tree | Method::Mesh => Method::Single,
        },
        ..free(settings)
    }
}

/// How the free wakes are summed.
fn free(settings: &AirSettings) -> FastSettings {
    FastSettings {
        method: settings.summation,
        tolerance: settings.tolerance,
        ..FastSettings::new(settings.wake_core)
    }
}

/// Velocity of sources and of their mirror images.
#[derive(Clone, Debug, Default)]
struct Images {
    reflected: Points,
    velocity: Points,
    vorticity: Points,
}

impl Images {
    /// Adds what `add` adds at the targets, and what it adds at their images, reflected.
    fn add(
        &mut self,
        targets: &Points,
        mirrors: &[Mirror],
        out: &mut Points,
        mut add: impl FnMut(&Points, &mut Points),
    ) {
        add(targets, out);
        for mirror in mirrors {
            self.reflect(targets, mirror);
            self.velocity.reset(targets.len());
            add(&self.reflected, &mut self.velocity);
            for (i, v) in self.velocity.iter().enumerate() {
                out.add(i, mirror.vector(v));
            }
        }
    }

    /// The same of velocity and vorticity.
    fn add_with_vorticity(
        &mut self,
        targets: &Points,
        mirrors: &[Mirror],
        [velocity, vorticity]: [&mut Points; 2],
        sum: &mut Summation,
    ) {
        sum.add_with_vorticity(targets, [velocity, vorticity]);
        for mirror in mirrors {
            self.reflect(targets, mirror);
            self.velocity.reset(targets.len());
            self.vorticity.reset(targets.len());
            let at_images = [&mut self.velocity, &mut self.vorticity];
            sum.add_with_vorticity(&self.reflected, at_images);
            let sums = self.velocity.iter().zip(self.vorticity.iter());
            for (i, (v, w)) in sums.enumerate() {
                velocity.add(i, mirror.vector(v));
                vorticity.add(i, mirror.axial(w));
            }
        }
    }

    fn reflect(&mut self, targets: &Points, mirror: &Mirror) {
        self.reflected.clear();
        let images = targets.iter().map(|x| mirror.point(x));
        images.for_each(|x| self.reflected.push(x));
        self.reflected.core.clone_from(&targets.core);
    }
}

/// The sums over all filaments, blobs and particles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sums {
    bound: Summation,
    near_wake: Summation,
    /// Lattice and near wake as one network, for what moves wakes of algebraic cores.
    joined: Network,
    attached: Summation,
    is_joined: bool,
    wake: Summation,
    blobs: GaussianSum,
    /// Allowed error of the sum over blobs.
    tolerance: f64,
    particles: AlgebraicSum,
    images: Images,
    /// How often what is frozen within a step was new.
    generation: u64,
}

impl Sums {
    /// Takes all filaments, blobs and particles.
    pub(crate) fn load(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.load_attached(settings, filaments);
        self.load_free(settings, filaments, 0.0);
    }

    /// Takes all of them to move wakes, which do not ask for the last digits.
    pub(crate) fn load_for_wakes(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.is_joined = settings.is_symmetric();
        if !self.is_joined {
            return self.load(settings, filaments);
        }
        self.joined.clear();
        self.joined.append(&filaments.bound);
        self.joined.append(&filaments.near_wake);
        self.attached.load(on_wakes(settings), &self.joined);
        self.load_free(settings, filaments, 0.0);
    }

    /// Takes what moves with the surfaces: lattice and near wake.
    pub(crate) fn load_attached(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.bound
            .load(direct(settings.bound_core), &filaments.bound);
        self.near_wake
            .load(direct(settings.wake_core), &filaments.near_wake);
    }

    /// Takes what is frozen within a step: free wakes and particles. Cores that are as wide as a part of the
    /// way to the edge change a little as bodies and air come to agree: by no more than `near` [m] they are
    /// taken for the same.
    pub(crate) fn load_free(&mut self, settings: &AirSettings, filaments: &Filaments, near: f64) {
        let (how, wake) = (free(settings), &filaments.wake);
        let is_new = self.wake.load_unless_near(how, wake, near);
        let min = settings.min_variance();
        let bounds = match filaments.blobs.is_empty() {
            true => [DVec3::ZERO; 2], // nobody asks for them
            false => filaments.bounds(),
        };
        let nodes = filaments.wake.nodes.len();
        let is_new = self.blobs.load(&filaments.blobs, min, bounds, nodes) || is_new;
        self.tolerance = match settings.summation {
            Method::Direct => 0.0,
            _ => settings.tolerance,
        };
        let is_new = self.particles.load(&filaments.particles) || is_new;
        self.generation += u64::from(is_new);
    }

    /// Sums that were checked so far.
    pub(crate) fn tally(&self) -> Tally {
        let mut all = self.blobs.tally();
        for sum in [&self.bound, &self.near_wake, &self.attached, &self.wake] {
            all += sum.tally();
        }
        all
    }

    /// The particles.
    pub(crate) fn particles(&self) -> &AlgebraicSum {
        &self.particles
    }

    /// Adds the velocity of all sources and their images at `targets` to `out`.
    pub(crate) fn add(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        self.add_filaments(targets, mirrors, out);
        self.add_particles(targets, mirrors, out);
    }

    /// The same in the wakes, which all sources were taken for.
    pub(crate) fn add_at_wakes(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        self.add_filaments_at_wakes(targets, mirrors, out);
        self.add_particles(targets, mirrors, out);
    }

    /// The same, and the vorticity of [`FastSum::add_velocity_and_vorticity`] of all filaments, where cores are
    /// algebraic.
    pub(crate) fn add_with_vorticity(
        &mut self,
        targets: &Points,
        mirrors: &[Mirror],
        [velocity, vorticity]: [&mut Points; 2],
    ) {
        let (images, attached, wake) = (&mut self.images, &mut self.attached, &mut self.wake);
        for sum in [attached, wake] {
            images.add_with_vorticity(targets, mirrors, [velocity, vorticity], sum);
        }
        self.add_particles(targets, mirrors, velocity);
    }

    /// [`Self::add_at_wakes`] of all but particles.
    pub(crate) fn add_filaments_at_wakes(
        &mut self,
        targets: &Points,
        mirrors: &[Mirror],
        out: &mut Points,
    ) {
        if !self.is_joined {
            return self.add_filaments(targets, mirrors, out);
        }
        let (images, attached, wake) = (&mut self.images, &mut self.attached, &mut self.wake);
        for sum in [attached, wake] {
            images.add(targets, mirrors, out, |x, v| sum.add(x, v));
        }
        self.add_blobs(targets, mirrors, out);
    }

    /// [`Self::add`] of all but particles.
    fn add_filaments(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        let Self {
            bound,
            near_wake,
            wake,
            images,
            ..
        } = self;
        for sum in [bound, near_wake, wake] {
            images.add(targets, mirrors, out, |x, v| sum.add(x, v));
        }
        self.add_blobs(targets, mirrors, out);
    }

    /// The same of lattice and near wake, these first.
    pub(crate) fn add_attached(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        let Self {
            bound,
            near_wake,
            images,
            ..
        } = self;
        for sum in [near_wake, bound] {
            images.add(targets, mirrors, out, |x, v| sum.add(x, v));
        }
    }

    /// The same of free wakes, blobs and particles.
    fn add_free(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        let (images, sum) = (&mut self.images, &mut self.wake);
        images.add(targets, mirrors, out, |x, v| sum.add(x, v));
        self.add_blobs(targets, mirrors, out);
        self.add_particles(targets, mirrors, out);
    }

    fn add_blobs(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        if self.blobs.is_empty() {
            return;
        }
        let (images, blobs, tolerance) = (&mut self.images, &mut self.blobs, self.tolerance);
        images.add(targets, mirrors, out, |x, v| {
            blobs.add_velocity(tolerance, x, v);
        });
    }

    fn add_particles(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        if self.particles.is_empty() {
            return;
        }
        let (images, particles) = (&mut self.images, &self.particles);
        images.add(targets, mirrors, out, |x, v| particles.add_velocity(x, v));
    }
}

/// Velocity of the free wakes at points that hardly move while bodies and air come to agree.
#[derive(Clone, Debug, Default)]
pub(crate) struct WakeVelocityCache {
    points: Points,
    velocity: Points,
    generation: u64,
    mirrors: Vec<Mirror>,
}

/// How far a point of a surface may go, in panel sizes, before the wakes are summed for it again: what
/// this leaves out is a tenth of what the default tree does.
pub(crate) const NEAR: f64 = 1e-5;

impl WakeVelocityCache {
    /// Sets `out` to the velocity of the free wakes of `sums` at `points`. Unless the wakes are new, or a point is
    /// farther than `near` [m] from where the velocity was last summed, that velocity is taken.
    pub(crate) fn velocity(
        &mut self,
        sums: &mut Sums,
        points: &Points,
        near: f64,
        mirrors: &[Mirror],
        out: &mut Points,
    ) {
        let kept = self.generation == sums.generation
            && self.mirrors == mirrors
            && self.points.len() == points.len()
            && self.points.has_cores_near(points, near);
        let is_near = |(a, b): (DVec3, DVec3)| a.distance(b) <= near;
        if !(kept && self.points.iter().zip(points.iter()).all(is_near)) {
            self.generation = sums.generation;
            self.mirrors.clear();
            self.mirrors.extend_from_slice(mirrors);
            self.points.clone_from(points);
            self.velocity.reset(points.len());
            sums.add_free(points, mirrors, &mut self.velocity);
        }
        out.clone_from(&self.velocity);
    }
}
