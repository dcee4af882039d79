//! The air that wings on free joints carry along, and that of all wings of a light flyer, as part of the
//! inertia of the bodies.
//!
//! The loads of a lattice hold the rate of the circulation as a difference over steps, and in it the added mass
//! of a wing: `-A D q`, q the velocity of the wing's origin and its angular velocity in wing components, D the
//! difference. Where a wing weighs less than the air that goes with it, passes that bring bodies and air to
//! agree lead away from each other, and a method that weighs rates of several steps lets velocities alternate
//! from step to step. So the rate itself takes the place of the difference; it is unknown and joins the inertia
//! of the bodies ([`AddedMass`]):
//!
//! ```text
//! L = L_lattice + A D q - A q'        q' = (R^T a - w x v, alpha)
//! ```
//!
//! Velocities are those through the undisturbed air at the wing's origin, as the lattice's are. What the wind
//! beside the stream changes from step to step stays in `L_lattice`: it is no motion of the wing, and jumps of
//! gusts have no rate to take its place. So a uniform wind is a stream.
//!
//! Where one half of the air is computed, the loads of a wing hold the rates of its image: of both D q the mean
//! is taken out, or what parts the two wings by rounding would feed itself.
//!
//! The two differ by the error of D, of second order in the step whatever A is. That A is the lattice's own, from
//! its influence matrix, leaves next to nothing of the difference.

pub(crate) mod light;

use wingbeat_dynamics::{AddedMass, BodyAcceleration, BodyMotion, System, Wrench};
use wingbeat_math::DVec3;

use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::{Air, AirScratch, Instant, WingInertia};
use wingbeat_air::Wind;

/// Wings that hang on free joints, or all of a flyer that is light as a whole.
#[derive(Clone, Debug, Default)]
pub struct CarriedAir {
    wings: Vec<usize>,
    /// Where one half of the air is computed: pairs of places in `wings` that are mirror images of each other.
    pairs: Vec<[usize; 2]>,
    /// Velocity of the undisturbed air without wind, N components \[m/s\].
    stream: DVec3,
    /// What is added to it.
    wind: Wind,
}

/// What is remembered of such a wing.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct CarriedState {
    /// Velocities of its origin through the undisturbed air \[m/s\] in the last two accepted steps, newest
    /// first, wing components.
    linear: [DVec3; 2],
    /// Angular velocities \[rad/s\] in these steps, wing components.
    angular: [DVec3; 2],
    /// Wind beside the stream at its origin \[m/s\] in these steps, N components.
    wind: [DVec3; 2],
}

/// What the air answered in this step.
#[derive(Debug, Default)]
pub struct CarriedScratch {
    at: Option<f64>,
    answers: Vec<Option<(AddedMass, [f64; 3])>>,
    /// Wind beside the stream at the wings' origins [m/s], N components.
    winds: Vec<DVec3>,
    /// What the loads of the wings hold of it as differences over steps.
    held: Vec<Wrench>,
}

impl CarriedScratch {
    /// The next instant is another one, whatever its time.
    pub fn forget(&mut self) {
        self.at = None;
    }

    /// The added masses.
    pub fn masses(&self) -> impl Iterator<Item = AddedMass> + '_ {
        self.answers.iter().flatten().map(|(mass, _)| *mass)
    }
}

impl CarriedAir {
    /// All wings, the first `wings` bodies after the root: of a flyer that is light as a whole.
    pub fn of_all(wings: usize) -> Self {
        Self {
            wings: (0..wings).collect(),
            ..Self::default()
        }
    }

    /// The first `wings` bodies after the root of `system` that a free joint carries.
    pub fn new(system: &System, wings: usize) -> Self {
        let mut free = vec![false; system.bodies().len()];
        for _ in 0..free.len() {
            for (hinge, offsets) in system.hinges().iter().zip(system.offsets()) {
                let before = hinge.parent.is_some_and(|p| free[p]);
                free[hinge.child] |= offsets.speeds > 0 || before;
            }
        }
        Self {
            wings: (0..wings).filter(|w| free[w + 1]).collect(),
            ..Self::default()
        }
    }

    /// The same in air of which one half is computed, for wings of which these `pairs` are mirror images of each other.
    pub fn mirrored(self, pairs: &[[usize; 2]]) -> Self {
        let place = |w: usize| self.wings.iter().position(|of| *of == w);
        let pairs = pairs.iter();
        let pairs = pairs.filter_map(|[a, b]| Some([place(*a)?, place(*b)?]));
        Self {
            pairs: pairs.collect(),
            ..self
        }
    }

    /// The same in air of this velocity, N components [m/s], to which this wind is added.
    pub fn in_air(self, stream: DVec3, wind: Wind) -> Self {
        Self {
            stream,
            wind,
            ..self
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.wings.is_empty()
    }

    /// Before the first step.
    pub fn initial(&self) -> Vec<CarriedState> {
        vec![CarriedState::default(); self.wings.len()]
    }

    /// Takes the added masses of the wings out of `loads`, N components, which the air said last. What the
    /// wings carry along stays as at the first instant of the step.
    ///
    /// # Errors
    /// What the air reports.
    pub fn take_out(
        &self,
        at: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirMemory>),
        states: &[CarriedState],
        (scratch, s): (&mut AirScratch, &mut CarriedScratch),
        loads: &mut [Wrench],
    ) -> Result<(), FlightError> {
        if s.at != Some(at.time) {
            s.answers.clear();
            for &w in &self.wings {
                let answer = air.wing_inertia(w, at, memory, scratch)?;
                let added = |a: WingInertia| (AddedMass::new(w + 1, a.mass), a.rate_weights);
                s.answers.push(answer.map(added));
            }
            s.at = Some(at.time);
        }
        let origins = self.wings.iter().map(|w| at.motions[w + 1].p);
        s.winds.clear();
        s.winds.extend(origins.map(|p| self.wind.at(p, at.time)));
        s.held.clear();
        for ((answer, state), wind) in s.answers.iter().zip(states).zip(&s.winds) {
            let held = answer.as_ref().map(|(mass, weights)| {
                let m = &at.motions[mass.body()];
                mass.wrench(m, &state.rate(m, [self.stream, *wind], *weights))
            });
            s.held.push(held.unwrap_or_default());
        }
        for &[a, b] in &self.pairs {
            let image = s.held[b].reflected(at.motions[0].r.y_axis);
            let mean = Wrench {
                force: 0.5 * (s.held[a].force + image.force),
                moment: 0.5 * (s.held[a].moment + image.moment),
            };
            (s.held[a], s.held[b]) = (mean, mean.reflected(at.motions[0].r.y_axis));
        }
        for (w, held) in self.wings.iter().zip(&s.held) {
            loads[w + 1] = loads[w + 1] - *held;
        }
        Ok(())
    }

    /// What the loads of the wings lack at the first instant beside their own added masses, at these accelerations: what
    /// other surfaces do to these masses, and what of them is not symmetric. Added to `out`, N components; false where
    /// loads lack nothing, or the air has nothing of the kind.
    ///
    /// # Errors
    /// What the air reports.
    pub fn coupling_at_start(
        &self,
        at: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirMemory>),
        (scratch, s): (&AirScratch, &CarriedScratch),
        out: &mut [Wrench],
    ) -> Result<bool, FlightError> {
        if self.is_empty() {
            return Ok(false);
        }
        let changes: Vec<_> = (at.motions.iter().zip(at.accelerations))
            .map(|(m, a)| self.change(m, a, at.time))
            .collect();
        let pushed = at.motions.iter().zip(&changes).map(|(m, a)| BodyMotion {
            v: m.v + at.step * a.linear,
            w: m.w + at.step * a.angular,
            ..*m
        });
        let pushed: Vec<_> = pushed.collect();
        let is_lacking = air.rate_loads_at_start(&self.wings, at, &pushed, memory, scratch, out)?;
        for (mass, _) in s.answers.iter().flatten().filter(|_| is_lacking) {
            let k = mass.body();
            out[k] = out[k] - mass.wrench(&at.motions[k], &changes[k]);
        }
        Ok(is_lacking)
    }

    /// The rate of the velocities of a body through the undisturbed air in body components, that of its origin turned to
    /// N.
    fn change(&self, m: &BodyMotion, a: &BodyAcceleration, time: f64) -> BodyAcceleration {
        let through = m.v - (self.stream + self.wind.at(m.p, time));
        BodyAcceleration {
            linear: a.linear - (m.r * m.w).cross(through),
            angular: a.angular,
        }
    }

    /// Accepts bodies that move like `motions`, for which `s` was asked last.
    pub fn accept(&self, motions: &[BodyMotion], s: &CarriedScratch, states: &mut [CarriedState]) {
        for ((state, w), &wind) in states.iter_mut().zip(&self.wings).zip(&s.winds) {
            let m = &motions[w + 1];
            let through = m.v - (self.stream + wind);
            state.linear = [m.r.transpose() * through, state.linear[0]];
            state.angular = [m.w, state.angular[0]];
            state.wind = [wind, state.wind[0]];
        }
    }
}

impl CarriedState {
    /// The difference over steps of the velocities of a wing that moves like `m` in this stream and wind, as an
    /// acceleration.
    fn rate(
        &self,
        m: &BodyMotion,
        [stream, wind]: [DVec3; 2],
        [now, before, earlier]: [f64; 3],
    ) -> BodyAcceleration {
        let v = m.r.transpose() * (m.v - (stream + wind));
        let difference =
            |x: DVec3, past: &[DVec3; 2]| now * x + before * past[0] + earlier * past[1];
        // The weights add up to 0.
        let blows = before * (self.wind[0] - wind) + earlier * (self.wind[1] - wind);
        BodyAcceleration {
            linear: m.r * (difference(v, &self.linear) + m.w.cross(v)) + blows,
            angular: difference(m.w, &self.angular),
        }
    }
}
