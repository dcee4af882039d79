//! The velocity that filaments make at many points: which sum serves which filaments, and what need
//! not be summed again.

use crate::filaments::Filaments;
use crate::images::Mirror;
use crate::settings::AirSettings;
use wingbeat_vortex::{
    BlobSum, CoreModel, FastSettings, FastSum, Method, Network, ParticleSum, Points, Report,
};

/// A Biot-Savart sum over one network, its memory kept from call to call.
#[derive(Clone, Debug, Default)]
pub(crate) struct Summation {
    sum: Option<FastSum>,
    loaded: Network,
    reflected: Points,
    image: Points,
    /// What the last sum did.
    pub report: Option<Report>,
}

impl Summation {
    /// Takes the sources; says whether they differ from those it holds already.
    pub(crate) fn load(&mut self, settings: FastSettings, sources: &Network) -> bool {
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

    /// Adds the velocity of the sources and their images at `targets` to `out`.
    pub(crate) fn add(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        let sum = self.sum.as_mut().expect("sources are loaded");
        self.report = Some(sum.add_velocity(targets, out));
        for mirror in mirrors {
            self.reflected.clear();
            targets
                .iter()
                .for_each(|x| self.reflected.push(mirror.place(x)));
            self.image.reset(targets.len());
            sum.add_velocity(&self.reflected, &mut self.image);
            for i in 0..targets.len() {
                out.set(i, out.get(i) + mirror.vector(self.image.get(i)));
            }
        }
    }
}

/// How filaments of this core are summed: those on and near surfaces one by one.
pub(crate) fn direct(model: CoreModel) -> FastSettings {
    FastSettings {
        method: Method::Direct,
        ..FastSettings::new(model)
    }
}

/// How the free wakes are summed.
pub(crate) fn free(settings: &AirSettings) -> FastSettings {
    FastSettings {
        method: settings.summation,
        tolerance: settings.tolerance,
        ..FastSettings::new(settings.wake_core)
    }
}

/// The sums over all filaments and particles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sums {
    pub bound: Summation,
    pub front: Summation,
    pub wake: Summation,
    pub blobs: BlobSum,
    /// Allowed error of the sum over blobs.
    tolerance: f64,
    pub particles: ParticleSum,
}

impl Sums {
    /// Takes all filaments and particles.
    pub(crate) fn load(&mut self, settings: &AirSettings, filaments: &Filaments) {
        self.bound
            .load(direct(settings.bound_core), &filaments.bound);
        self.front
            .load(direct(settings.wake_core), &filaments.front);
        self.load_free(settings, filaments);
    }

    /// Takes what is frozen within a step: free wakes and particles; says whether they are new.
    pub(crate) fn load_free(&mut self, settings: &AirSettings, filaments: &Filaments) -> bool {
        let is_new = self.wake.load(free(settings), &filaments.wake);
        let (least, bounds) = (settings.least_variance(), filaments.bounds());
        let nodes = filaments.wake.nodes.len();
        let is_new = self.blobs.load(&filaments.blobs, least, bounds, nodes) || is_new;
        self.tolerance = match settings.summation {
            Method::Direct => 0.0,
            _ => settings.tolerance,
        };
        self.particles.load(&filaments.particles) || is_new
    }

    /// Adds the velocity of all filaments, particles and their images at `targets` to `out`.
    pub(crate) fn add(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        self.add_filaments(targets, mirrors, out);
        self.add_particles(targets, mirrors, out);
    }

    /// The same of filaments alone.
    pub(crate) fn add_filaments(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        self.bound.add(targets, mirrors, out);
        self.front.add(targets, mirrors, out);
        self.wake.add(targets, mirrors, out);
        self.add_blobs(targets, mirrors, out);
    }

    fn add_blobs(&mut self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        if self.blobs.is_empty() {
            return;
        }
        with_images(targets, mirrors, out, |targets, out| {
            self.blobs.add_velocity(self.tolerance, targets, out);
        });
    }

    /// The same of particles alone.
    fn add_particles(&self, targets: &Points, mirrors: &[Mirror], out: &mut Points) {
        if self.particles.is_empty() {
            return;
        }
        with_images(targets, mirrors, out, |targets, out| {
            self.particles.add_velocity(targets, out);
        });
    }
}

/// Adds what `add` adds at the targets, and what it adds at their images, reflected.
fn with_images(
    targets: &Points,
    mirrors: &[Mirror],
    out: &mut Points,
    mut add: impl FnMut(&Points, &mut Points),
) {
    add(targets, out);
    for mirror in mirrors {
        let reflected: Points = targets.iter().map(|x| mirror.place(x)).collect();
        let mut image = Points::zeros(targets.len());
        add(&reflected, &mut image);
        for i in 0..targets.len() {
            out.set(i, out.get(i) + mirror.vector(image.get(i)));
        }
    }
}

/// Velocity of the free wakes at points that hardly move while bodies and air come to agree.
#[derive(Clone, Debug, Default)]
pub(crate) struct StillWake {
    points: Points,
    velocity: Points,
}

impl StillWake {
    /// Sets `out` to the velocity of the free wakes of `sums` at `points`. While these are the same
    /// and no point is farther than `near` [m] from where the velocity was last summed, that
    /// velocity is taken.
    pub(crate) fn velocity(
        &mut self,
        sums: &mut Sums,
        is_new: bool,
        points: &Points,
        near: f64,
        mirrors: &[Mirror],
        out: &mut Points,
    ) {
        let kept = !is_new && self.points.len() == points.len();
        let is_near = |(a, b): (wingbeat_math::DVec3, wingbeat_math::DVec3)| a.distance(b) <= near;
        if !(kept && self.points.iter().zip(points.iter()).all(is_near)) {
            self.points.copy_from(points);
            self.velocity.reset(points.len());
            sums.wake.add(points, mirrors, &mut self.velocity);
            sums.add_blobs(points, mirrors, &mut self.velocity);
            sums.add_particles(points, mirrors, &mut self.velocity);
        }
        out.copy_from(&self.velocity);
    }
}
