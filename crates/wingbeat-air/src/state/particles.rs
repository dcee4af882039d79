//! The vortex particles of one wake sheet.

use crate::images::Mirror;
use crate::settings::ParticleSettings;
use wingbeat_math::DVec3;
use wingbeat_vortex::{Blob, Points};

/// The particles of one wake sheet, oldest first.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Particles {
    /// Positions [m], N components.
    pub position: Points,
    /// Strengths alpha [m3/s], N components.
    pub strength: Points,
    /// Sizes of the strengths when the particles were made [m3/s].
    pub first_size: Vec<f64>,
    /// Time at which the row they were left the edge [s].
    pub shed_time: Vec<f64>,
    /// Velocity with which the first ones came here [m/s], N components; newer ones have no past.
    pub velocity: Points,
    /// Rate with which their strengths changed [m3/s2], N components; as many.
    pub rate: Points,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.shed_time.len()
    }

    /// True when there is none.
    pub fn is_empty(&self) -> bool {
        self.shed_time.is_empty()
    }

    /// Impulse per density [m4/s], N: half the sum of `x cross alpha`.
    pub fn impulse(&self) -> DVec3 {
        let pairs = self.position.iter().zip(self.strength.iter());
        pairs.map(|(x, a)| 0.5 * x.cross(a)).sum()
    }

    /// Whether all arrays fit each other.
    pub(crate) fn is_sound(&self) -> bool {
        let past = self.velocity.len();
        let vectors = [&self.position, &self.strength, &self.velocity, &self.rate];
        vectors.into_iter().all(is_whole)
            && self.position.len() == self.len()
            && self.strength.len() == self.len()
            && self.first_size.len() == self.len()
            && past == self.rate.len()
            && past <= self.len()
    }

    /// Particle `i` at time `t` [s].
    pub(crate) fn at(&self, i: usize, settings: &ParticleSettings, t: f64) -> Blob {
        Blob {
            position: self.position.get(i),
            strength: self.strength.get(i),
            core: settings.core(t - self.shed_time[i]),
        }
    }

    /// Appends a particle of this position [m], strength [m3/s], both N, and time of shedding [s].
    pub fn push(&mut self, position: DVec3, strength: DVec3, shed: f64) {
        self.position.push(position);
        self.strength.push(strength);
        self.first_size.push(strength.length());
        self.shed_time.push(shed);
    }

    /// Makes these the mirror images of `source`: vorticity is an axial vector.
    pub(crate) fn reflect(&mut self, source: &Self, mirror: Mirror) {
        let reflect = |from: &Points, to: &mut Points, f: &dyn Fn(DVec3) -> DVec3| {
            to.clear();
            from.iter().for_each(|x| to.push(f(x)));
        };
        reflect(&source.position, &mut self.position, &|x| mirror.point(x));
        reflect(&source.velocity, &mut self.velocity, &|v| mirror.vector(v));
        reflect(&source.strength, &mut self.strength, &|a| -mirror.vector(a));
        reflect(&source.rate, &mut self.rate, &|a| -mirror.vector(a));
        self.first_size.clone_from(&source.first_size);
        self.shed_time.clone_from(&source.shed_time);
    }

    /// Drops particles for which `keep` is false of position [m], N, and time of shedding [s]; returns how many.
    pub(crate) fn retain(&mut self, keep: impl Fn(DVec3, f64) -> bool) -> u64 {
        let before = self.len();
        let (mut kept, mut past) = (0, 0);
        for i in 0..before {
            if !keep(self.position.get(i), self.shed_time[i]) {
                continue;
            }
            self.position.set(kept, self.position.get(i));
            self.strength.set(kept, self.strength.get(i));
            self.first_size[kept] = self.first_size[i];
            self.shed_time[kept] = self.shed_time[i];
            kept += 1;
            if i < self.velocity.len() {
                self.velocity.set(past, self.velocity.get(i));
                self.rate.set(past, self.rate.get(i));
                past += 1;
            }
        }
        self.position.truncate(kept);
        self.strength.truncate(kept);
        self.velocity.truncate(past);
        self.rate.truncate(past);
        self.first_size.truncate(kept);
        self.shed_time.truncate(kept);
        (before - kept) as u64
    }
}

/// Whether there are as many components of each kind, perhaps after reading a file.
pub(crate) fn is_whole(points: &Points) -> bool {
    points.y.len() == points.len() && points.z.len() == points.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The newest particles, whose velocities are not known yet, and older ones, of which every third goes.
    #[test]
    fn exact_particles_that_stay_keep_all_they_have() {
        let mut all = Particles::default();
        for k in 0..10 {
            let shed = f64::from(k);
            all.push(shed * DVec3::X, shed * DVec3::Y, shed);
            if k < 7 {
                all.velocity.push(shed * DVec3::Z);
                all.rate.push(-shed * DVec3::Z);
            }
        }
        let mut expected = Particles::default();
        for shed in [1.0, 2.0, 4.0, 5.0, 7.0, 8.0] {
            expected.push(shed * DVec3::X, shed * DVec3::Y, shed);
            if shed < 7.0 {
                expected.velocity.push(shed * DVec3::Z);
                expected.rate.push(-shed * DVec3::Z);
            }
        }
        let goes = |x: DVec3, shed: f64| x.x % 3.0 == 0.0 && shed == x.x;
        assert_eq!(all.retain(|x, shed| !goes(x, shed)), 4);
        assert_eq!(all, expected);
        assert_eq!(all.retain(|_, _| true), 0);
        assert_eq!(all, expected);
        assert!(all.is_sound());
    }
}
