//! All loads on the bodies at an instant, and what they do: air, applied loads, springs, wings that bend.

use wingbeat_dynamics::Wrench;
use wingbeat_math::DVec3;

use super::{Equations, Memory, Scratch};
use crate::air::Instant;
use crate::equations::quadratures::Quadratures;
use crate::error::FlightError;

impl Equations {
    /// All loads on the bodies in the core's state `y` into `s.total`.
    pub(super) fn loads(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        self.known_loads(t, y, memory, s)?;
        if !self.elastic.is_empty() {
            return self.add_masses(t, y, s);
        }
        if !s.added.is_empty() {
            let (ws, out) = (&mut s.dynamics, &mut s.solution);
            (self.core).add_mass((t, y), &s.added, &mut s.total, ws, out)?;
            for ((air, total), applied) in s.air.iter_mut().zip(&s.total).zip(&s.applied) {
                *air = *total - *applied;
            }
            s.sum_loads();
        }
        Ok(())
    }

    /// All loads but those of the added mass into `s.total`, the added mass into `s.added`.
    pub(super) fn known_loads(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        if self.elastic.is_empty() {
            self.place_nodes(t, y, s)?;
            self.applied_loads(t, s);
            let at = Instant::rigid(t, self.step, &s.motions);
            (self.air).loads(&at, memory.air, &mut s.air_scratch, &mut s.air)?;
            let air = (self.air.as_ref(), memory.air);
            let scratch = (&mut s.air_scratch, &mut s.carried_air);
            (self.carried).take_out(&at, air, memory.carried, scratch, &mut s.air)?;
            for (load, coupling) in s.air.iter_mut().zip(&s.coupling) {
                *load += *coupling;
            }
        } else {
            self.bend(t, y, memory, s)?;
        }
        if s.added_at != Some(t) {
            s.added.clear();
            self.air.added_mass(t, &mut s.air_scratch, &mut s.added);
            s.added.extend(s.carried_air.masses());
            s.added_at = Some(t);
        }
        s.sum_loads();
        Ok(())
    }

    /// Loads of the added masses of the air and of elastic wings, each to its own.
    pub(super) fn add_masses(&self, t: f64, y: &[f64], s: &mut Scratch) -> Result<(), FlightError> {
        let at = Instant {
            accelerations: &s.solution.bodies,
            ..Instant::rigid(t, self.step, &s.motions)
        };
        s.carried.clone_from(&s.added);
        let (loads, carried) = (&mut s.elastic_loads, &mut s.carried);
        self.elastic.add_mass(&at, &s.elastic, loads, carried);
        if s.carried.is_empty() {
            return Ok(());
        }
        s.sum_loads();
        let (ws, out) = (&mut s.dynamics, &mut s.solution);
        (self.core).add_mass((t, y), &s.carried, &mut s.total, ws, out)?;
        for (k, total) in s.total.iter().enumerate() {
            let own = match s.carried[s.added.len()..].iter().any(|a| a.body() == k) {
                true => [&mut s.elastic_loads[k], &mut s.air[k]],
                false => [&mut s.air[k], &mut s.elastic_loads[k]],
            };
            let [to, other] = own;
            *to = *total - *other - s.applied[k];
        }
        s.sum_loads();
        Ok(())
    }

    /// Shapes of the elastic wings and loads of the air that agree, in the core's state `y`.
    pub(super) fn bend(
        &self,
        t: f64,
        y: &[f64],
        memory: Memory<'_>,
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        let n = self.core.dim();
        let known = &mut s.solution.bodies;
        let step = (self.step, self.begins_with_jump());
        (self.elastic).predict(step, memory.wings, &mut s.elastic, known);
        if self.core.takes_shapes() {
            let shapes = self.elastic.shape_masses(&s.elastic);
            s.dynamics.set_shapes(shapes);
        }
        self.core
            .motions(t, &y[..n], &mut s.dynamics, &mut s.motions)?;
        self.applied_loads(t, s);
        // Without a state all accelerations follow from time alone.
        if n == 0 {
            let (ws, out) = (&mut s.dynamics, &mut s.solution);
            self.core.solve(t, &y[..n], &s.total, ws, out)?;
        }
        let at = Instant {
            accelerations: &s.solution.bodies,
            ..Instant::rigid(t, self.step, &s.motions)
        };
        let air = (self.air.as_ref(), memory.air);
        let loads = (&mut s.air_scratch, &mut s.air[..]);
        (self.elastic).couple(&at, air, &mut s.elastic, loads)?;
        (self.elastic).wrenches(&s.motions, &s.elastic, &mut s.elastic_loads);
        Ok(())
    }

    /// Motions that have the momenta of the state with the shapes that have just been found.
    pub(super) fn follow_shapes(
        &self,
        t: f64,
        y: &[f64],
        s: &mut Scratch,
    ) -> Result<(), FlightError> {
        if self.core.takes_shapes() && !self.elastic.is_empty() {
            let shapes = self.elastic.shape_masses(&s.elastic);
            s.dynamics.set_shapes(shapes);
            (self.core).motions(t, y, &mut s.dynamics, &mut s.motions)?;
        }
        Ok(())
    }

    /// Wrenches of the applied loads and springs.
    pub(super) fn applied_loads(&self, t: f64, s: &mut Scratch) {
        s.applied.fill(Wrench::default());
        for load in &self.applied {
            s.applied[load.body] += load.wrench(t, &s.motions[load.body]);
        }
        for spring in &self.springs {
            let wrenches = spring.wrenches(spring.bodies.map(|b| &s.motions[b]));
            for (body, wrench) in spring.bodies.into_iter().zip(wrenches) {
                s.applied[body] += wrench;
            }
        }
    }

    /// External force and its moment about the inertial origin, N components, with the mass centre at
    /// `centre` and the load `tether` of a support on the root.
    pub(super) fn external(&self, s: &Scratch, centre: DVec3, tether: &Wrench) -> [DVec3; 2] {
        let system = self.core.system();
        let weight = system.total_mass() * system.gravity();
        let mut force = weight + tether.force;
        let mut moment = centre.cross(weight) + tether.moment + s.motions[0].p.cross(tether.force);
        for (k, (l, m)) in s.total.iter().zip(&s.motions).enumerate() {
            // What elastic wings do to their bodies is no external load.
            let l = s.elastic_loads.get(k).map_or(*l, |_| {
                let mut l = s.air[k];
                l += s.applied[k];
                l
            });
            force += l.force;
            moment += l.moment + m.p.cross(l.force);
        }
        [force, moment]
    }

    /// Makes the budget that of the elastic wings.
    pub(super) fn correct_budget(&self, s: &mut Scratch) {
        if !self.elastic.is_empty() {
            let mass = self.core.system().total_mass();
            let budget = &mut s.solution.budget;
            (self.elastic).correct_budget(&s.motions, &s.elastic, mass, budget);
        }
    }

    /// What deforming the wings takes at the state last evaluated.
    pub(super) fn deformation_power(&self, t: f64, s: &mut Scratch) {
        if s.deformation.is_empty() {
            return;
        }
        let at = Instant {
            shapes: s.elastic.shapes(),
            ..Instant::rigid(t, self.step, &s.motions)
        };
        let accelerations = &s.solution.bodies;
        (self.air).deformation_power(&at, accelerations, &mut s.air_scratch, &mut s.deformation);
    }

    /// What dampers and stops of joints take up at the state last evaluated.
    pub(super) fn dissipation(&self, t: f64, s: &mut Scratch) {
        if self.mechanism.has_elements() {
            (self.mechanism).coordinates(t, &s.motions, &mut s.joints);
            let joints = self.mechanism.passive(t, &s.joints);
            s.dissipation = joints.map(|j| j.dissipation).sum();
        }
    }

    /// Powers and external forces at the state last evaluated.
    pub(super) fn quadrature_rates(&self, s: &Scratch) -> Quadratures {
        let power = |loads: &[Wrench]| -> f64 {
            loads.iter().zip(&s.motions).map(|(l, m)| l.power(m)).sum()
        };
        // What it spends on the energy and the momenta of the root alone is known without a quadrature.
        let mut tether = s.solution.tether;
        tether.force -= s.towed.inertia.force;
        tether.moment -= s.towed.inertia.moment;
        let [impulse, angular_impulse] = self.external(s, s.solution.budget.centre, &tether);
        tether += s.towed.weight;
        let deformation: f64 = s.deformation.iter().sum();
        Quadratures {
            hinge_work: s.solution.hinge_power() - s.relative[1],
            air_work: power(&s.air) - deformation + self.elastic.air_power(&s.elastic),
            applied_work: power(&s.applied) + tether.power(&s.motions[0]),
            impulse,
            angular_impulse,
            deformation_work: deformation,
            dissipated: s.dissipation,
            impulse_of_works: impulse,
        }
    }
}
