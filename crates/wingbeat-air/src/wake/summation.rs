//! The velocity that filaments and blobs make at many points: which sum serves which sources, and what need
//! not be summed again.

use crate::images::Mirror;
use crate::settings::AirSettings;
use crate::wake::filaments::Filaments;
use wingbeat_math::DVec3;
use wingbeat_vortex::{
    AlgebraicSum, CoreModel, FastSettings, FastSum, GaussianSum, Method, Network, Points,
};

/// A Biot-Savart sum over one network, its memory kept from call to call.
#[derive(Clone, Debug, Default)]
struct Summation {
    sum: Option<FastSum>,
    loaded: Network,
}

impl Summation {
    /// Takes the sources; says whether they differ from those it holds already.
    fn load(&mut self, settings: FastSettings, sources: &Network) -> bool {
        let kept = self.sum.take_if(|sum| *sum.settings() == settings);
        let is_known = kept.is_some() && self.loaded == *sources;
        let sum = self
            .sum
            .insert(kept.unwrap_or_else(|| FastSum::new(settings)));
        if !is_known {
            sum.load_network(sources);
            self.loaded.copy_from(sources);
        }
        !is_known
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
                out.set(i, out.get(i) + mirror.vector(v));
            }
        }
    }

    /// The same of velocity and vorticity, whose mirror image has the opposite sign.
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
                velocity.set(i, velocity.get(i) + mirror.vector(v));
                vorticity.set(i, vorticity.get(i) - mirror.vector(w));
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
    wake: Summation,
    blobs: GaussianSum,
    /// Allowed error of the sum over blobs.
    tolerance: f64,
    particles: AlgebraicSum,
    images: Images,
}

impl Sums {
    /// Takes all filaments, blobs and particles.
    pub(crate) fn load(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.load_attached(settings, filaments);
        self.load_free(settings, filaments);
    }

    /// Takes what moves with the surfaces: lattice and near wake.
    pub(crate) fn load_attached(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.bound
            .load(direct(settings.bound_core), &filaments.bound);
        self.near_wake
            .load(direct(settings.wake_core), &filaments.near_wake);
    }

    /// Takes what is frozen within a step: free wakes and particles; says whether they are new.
    pub(crate) fn load_free(&mut self, settings: &AirSettings, filaments: &Filaments) -> bool {
        let is_new = self.wake.load(free(settings), &filaments.wake);
        let (min, bounds) = (settings.min_variance(), filaments.bounds());
        let nodes = filaments.wake.nodes.len();
        let is_new = self.blobs.load(&filaments.blobs, min, bounds, nodes) || is_new;
        self.tolerance = match settings.summation {
            Method::Direct => 0.0,
            _ => settings.tolerance,
        };
        self.particles.load(&filaments.particles) || is_new
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

    /// The same, and the vorticity of [`FastSum::add_velocity_and_vorticity`] of all filaments of algebraic cores.
    pub(crate) fn add_with_vorticity(
        &mut self,
        targets: &Points,
        mirrors: &[Mirror],
        [velocity, vorticity]: [&mut Points; 2],
    ) {
        let Self {
            bound,
            near_wake,
            wake,
            images,
            ..
        } = self;
        for sum in [bound, near_wake, wake] {
            images.add_with_vorticity(targets, mirrors, [velocity, vorticity], sum);
        }
        self.add_particles(targets, mirrors, velocity);
    }

    /// The same of all but particles.
    pub(crate) fn add_filaments(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
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
}

impl WakeVelocityCache {
    /// Sets `out` to the velocity of the free wakes of `sums` at `points`. Unless the wakes are new, or a point is
    /// farther than `near` [m] from where the velocity was last summed, that velocity is taken.
    pub(crate) fn velocity(
        &mut self,
        (sums, is_new): (&mut Sums, bool),
        points: &Points,
        near: f64,
        mirrors: &[Mirror],
        out: &mut Points,
    ) {
        let kept = !is_new && self.points.len() == points.len();
        let is_near = |(a, b): (DVec3, DVec3)| a.distance(b) <= near;
        if !(kept && self.points.iter().zip(points.iter()).all(is_near)) {
            self.points.copy_from(points);
            self.velocity.reset(points.len());
            sums.add_free(points, mirrors, &mut self.velocity);
        }
        out.copy_from(&self.velocity);
    }
}
