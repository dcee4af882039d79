//! Velocity and stretching at the particles.
//!
//! Particles stretch each other by the exact gradient of their smoothed velocity. Filaments and wind
//! stretch a particle as they would a stick of its direction that reaches half a radius to either
//! side, `alpha' = abs(alpha) (u(x + s/2) - u(x - s/2)) / sigma`: outside their cores their flow has no
//! rotation, so both schemes agree there, and near a surface a blob of vorticity feels the mean
//! gradient over its size rather than that at a point.

use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::settings::ParticleSettings;
use crate::state::AirState;
use crate::wake::summation::Sums;
use wingbeat_vortex::{Blob, Points, Stretching};

/// Velocity and stretching at all particles that are moved (mirror images are reflected later), sheet after sheet.
#[derive(Clone, Debug, Default)]
pub(crate) struct ParticleFlow {
    particles: Vec<Blob>,
    image: Vec<Blob>,
    /// Positions of the particles, then the fore ends of their sticks, then the rear ends.
    points: Points,
    /// Velocity of filaments there [m/s].
    ends: Points,
    /// Without the undisturbed air [m/s].
    pub velocity: Points,
    /// Rate of the strengths, that by the undisturbed air included [m3/s2].
    pub rate: Points,
    /// What one set of images adds.
    added: [Points; 2],
}

impl ParticleFlow {
    /// Takes velocities and rates of the accepted step; `sums` hold all filaments and particles.
    pub(crate) fn take(&mut self, lattice: &Lattice, state: &AirState, sums: &mut Sums) {
        self.particles.clear();
        let Some(settings) = &lattice.settings().particles else {
            return;
        };
        for (k, sheet) in state.sheets.iter().enumerate() {
            if lattice.reflected_sheet(k).is_none() {
                let set = &sheet.particles;
                let all = (0..set.len()).map(|i| set.at(i, settings, state.time));
                self.particles.extend(all);
            }
        }
        self.velocity.reset(self.particles.len());
        self.rate.reset(self.particles.len());
        if self.particles.is_empty() {
            return;
        }
        self.add_filaments(lattice, state.time, sums, settings.stretching);
        self.add_particles(lattice.mirrors(), sums, settings);
    }

    fn add_filaments(&mut self, lattice: &Lattice, t: f64, sums: &mut Sums, scheme: Stretching) {
        let n = self.particles.len();
        let stick = |p: &Blob| 0.5 * p.core.sqrt() * p.strength.normalize_or_zero();
        self.points.clear();
        self.particles
            .iter()
            .for_each(|p| self.points.push(p.position));
        if scheme != Stretching::Omitted {
            for sign in [1.0, -1.0] {
                let end = |p: &Blob| p.position + sign * stick(p);
                self.particles.iter().for_each(|p| self.points.push(end(p)));
            }
        }
        self.ends.reset(self.points.len());
        sums.add_filaments_at_wakes(&self.points, lattice.mirrors(), &mut self.ends);
        for (i, p) in self.particles.iter().enumerate() {
            self.velocity.set(i, self.ends.get(i));
            if scheme != Stretching::Omitted {
                let at = |k: usize| self.ends.get(k) + lattice.stream(self.points.get(k), t);
                let apart = at(i + n) - at(i + 2 * n);
                self.rate
                    .set(i, p.strength.length() / p.core.sqrt() * apart);
            }
        }
    }

    fn add_particles(&mut self, mirrors: &[Mirror], sums: &Sums, settings: &ParticleSettings) {
        let (scheme, sum) = (settings.stretching, sums.particles());
        sum.add_to_blobs(&self.particles, scheme, &mut self.velocity, &mut self.rate);
        for mirror in mirrors {
            let reflected = |p: &Blob| Blob {
                position: mirror.point(p.position),
                strength: mirror.vector(p.strength),
                core: p.core,
            };
            self.image.clear();
            self.image.extend(self.particles.iter().map(reflected));
            let [v, s] = &mut self.added;
            v.reset(self.particles.len());
            s.reset(self.particles.len());
            sum.add_to_blobs(&self.image, scheme, v, s);
            for i in 0..self.particles.len() {
                let (dv, ds) = (mirror.vector(v.get(i)), mirror.vector(s.get(i)));
                self.velocity.add(i, dv);
                self.rate.add(i, ds);
            }
        }
    }
}
