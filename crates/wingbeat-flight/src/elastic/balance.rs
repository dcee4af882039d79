//! What the elastic wings do to the bodies that carry them, their energies and momenta.

use wingbeat_dynamics::{
    AddedMass, BodyMotion, Budget, ShapeMass, Wrench, angular_momentum, kinetic_energy,
    linear_momentum,
};
use wingbeat_math::{DVec3, MassProperties};
use wingbeat_structure::resultant;

use super::coupling::ElasticScratch;
use super::image::{reflected, reflected_mass};
use super::step::WingScratch;
use super::wing::ElasticState;
use super::wings::ElasticWings;
use crate::interface::Instant;
use crate::interface::record::ElasticRecord;

impl ElasticWings {
    /// What the masses of the wings do otherwise than those of rigid ones, at the instant last asked for.
    pub fn shape_masses<'a>(
        &'a self,
        s: &'a ElasticScratch,
    ) -> impl Iterator<Item = ShapeMass> + 'a {
        self.wings.iter().zip(&s.wings).map(|(w, ws)| {
            let now = w.structure.mass_properties(&ws.trial.configuration);
            let (mut momentum, mut angular_momentum) = (DVec3::ZERO, DVec3::ZERO);
            for (mass, motion) in w.bodies(&BodyMotion::REST, ws.nodes()) {
                let of = NodeBudget::of(&mass, &motion);
                momentum += of.momentum;
                angular_momentum += of.angular;
            }
            ShapeMass {
                body: w.wing + 1,
                first_moment: now.first_moment - w.rigid.first_moment,
                inertia: now.inertia - w.rigid.inertia,
                momentum,
                angular_momentum,
            }
        })
    }

    /// Adds to `out` what the elastic wings do to their frames beside the loads of the air and what rigid ones
    /// would do, N components about the origins of the bodies.
    pub fn wrenches(&self, motions: &[BodyMotion], s: &ElasticScratch, out: &mut [Wrench]) {
        out.fill(Wrench::default());
        for (k, (w, ws)) in self.wings.iter().zip(&s.wings).enumerate() {
            let m = &motions[w.wing + 1];
            if let Some(image) = self.image(k) {
                let original = self.wings[image.of].wing + 1;
                out[w.wing + 1] = reflected(&out[original], motions[original].r, m.r);
                continue;
            }
            let at = &ws.trial.configuration;
            let needed = resultant(at, &ws.residual);
            let loads = resultant(at, &ws.loads);
            let rigid = w.rigid_inertia(&ws.frame);
            let [mut force, mut moment] = [0, 1].map(|k| rigid[k] - needed[k] - loads[k]);
            if w.structure.damping().mass > 0.0 {
                // What momentum relative to the frame loses, the frame gains.
                let damped = resultant(at, ws.solver.damping());
                force += damped[0];
                moment += damped[1];
            }
            out[w.wing + 1] = Wrench { force, moment }.turned(m.r);
        }
    }

    /// The wings' answer to accelerations of their frames, beside that of rigid ones, as added masses into
    /// `out`; what they exert under the accelerations that the wings are known to have is taken out of `loads`.
    pub fn add_mass(
        &self,
        at: &Instant<'_>,
        s: &ElasticScratch,
        loads: &mut [Wrench],
        out: &mut Vec<AddedMass>,
    ) {
        for (k, w) in self.wings.iter().enumerate() {
            let known = self.original(k);
            let Some(carried) = s.wings[known].carried else {
                continue;
            };
            let (body, from) = (w.wing + 1, self.wings[known].wing + 1);
            let exerted = carried.wrench(&at.motions[from], &at.accelerations[from]);
            let (exerted, carried) = match self.image(k) {
                Some(_) => (
                    reflected(&exerted, at.motions[from].r, at.motions[body].r),
                    reflected_mass(&carried, body),
                ),
                None => (exerted, carried),
            };
            loads[body] = loads[body] - exerted;
            out.push(carried);
        }
    }

    /// Power of the air on what the wings move relative to their frames \[W\].
    pub fn air_power(&self, s: &ElasticScratch) -> f64 {
        self.originals(s).map(air_power).sum()
    }

    /// Elastic energy of each wing \[J\].
    pub fn strain_energy<'a>(&'a self, s: &'a ElasticScratch) -> impl Iterator<Item = f64> + 'a {
        self.originals(s).map(|ws| ws.solver.strain_energy())
    }

    /// Power that the damping of the wings dissipates \[W\].
    pub fn dissipation(&self, s: &ElasticScratch) -> f64 {
        let of = |ws: &WingScratch| ws.solver.dissipation(&ws.trial);
        self.originals(s).map(of).sum()
    }

    /// Energy that damping has dissipated since the start \[J\], at the instant last asked for.
    pub fn dissipated(&self, states: &[ElasticState], s: &ElasticScratch) -> f64 {
        let of = |(ws, state): (&WingScratch, &ElasticState)| {
            let (now, before) = (ws.solver.dissipation(&ws.trial), &state.structure);
            let step = if s.is_stepping {
                ws.trial.weights().step
            } else {
                0.0
            };
            before.dissipated + 0.5 * step * (before.dissipation + now)
        };
        self.originals(s).zip(states).map(of).sum()
    }

    /// Where the tips are, how they are twisted and what elastic energy the wings hold.
    pub fn records(&self, s: &ElasticScratch, out: &mut Vec<ElasticRecord>) {
        out.clear();
        for ((w, ws), original) in self.wings.iter().zip(&s.wings).zip(self.originals(s)) {
            let place = |n: usize| w.followers[n].position(&ws.trial.configuration);
            let rest = |n: usize| w.followers[n].position(w.structure.rest());
            let [lead, trail] = w.tip;
            let middle = |of: &dyn Fn(usize) -> DVec3| of(lead).midpoint(of(trail));
            let shapes = [&ws.trial.configuration, w.structure.rest()];
            out.push(ElasticRecord {
                tip: middle(&place) - middle(&rest),
                twist: w.stations[3].outer_twist(&w.followers, shapes),
                sections: w
                    .stations
                    .each_ref()
                    .map(|s| s.record(&w.followers, shapes)),
                strain_energy: original.solver.strain_energy(),
                strain_power: original.solver.strain_power(),
                air_power: air_power(original),
                passes: s.most,
            });
        }
    }

    /// Makes the budget of a system of rigid wings that of the elastic ones.
    pub fn correct_budget(
        &self,
        motions: &[BodyMotion],
        s: &ElasticScratch,
        mass: f64,
        b: &mut Budget,
    ) {
        let mut angular = b.angular_momentum + b.centre.cross(b.momentum);
        let mut first = mass * b.centre;
        for ((w, ws), strain) in self.wings.iter().zip(&s.wings).zip(self.strain_energy(s)) {
            let m = &motions[w.wing + 1];
            let rigid = std::iter::once((w.rigid, *m)).map(|x| (-1.0, x));
            let elastic = w.bodies(m, ws.nodes()).map(|x| (1.0, x));
            for (sign, (properties, motion)) in rigid.chain(elastic) {
                let of = NodeBudget::of(&properties, &motion);
                b.kinetic += sign * of.kinetic;
                b.momentum += sign * of.momentum;
                angular += sign * of.angular;
                first += sign * of.first;
                b.potential -= sign * self.gravity.dot(of.first);
            }
            b.potential += strain;
        }
        b.centre = first / mass;
        b.angular_momentum = angular - b.centre.cross(b.momentum);
    }

    /// Of each wing the scratch of the one whose shape it has, its own or its mirror image.
    fn originals<'a>(&'a self, s: &'a ElasticScratch) -> impl Iterator<Item = &'a WingScratch> {
        (0..self.wings.len()).map(|k| &s.wings[self.original(k)])
    }
}

/// Power of the air on what a wing moves relative to its frame \[W\].
fn air_power(ws: &WingScratch) -> f64 {
    let pairs = ws.loads.iter().zip(&ws.trial.velocity);
    pairs.map(|(f, v)| f * v).sum()
}

/// Energy and momenta of one small body, N components, about the origin of N.
struct NodeBudget {
    kinetic: f64,
    momentum: DVec3,
    angular: DVec3,
    /// First moment of mass \[kg m\].
    first: DVec3,
}

impl NodeBudget {
    fn of(mass: &MassProperties, m: &BodyMotion) -> Self {
        Self {
            kinetic: kinetic_energy(mass, m),
            momentum: linear_momentum(mass, m),
            angular: angular_momentum(mass, m),
            first: mass.mass * m.p + m.r * mass.first_moment,
        }
    }
}
