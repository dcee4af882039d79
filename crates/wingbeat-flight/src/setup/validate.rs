//! What a setup must fulfil as a whole; bodies, lattice and motions check their own parts.

use crate::error::FlightError;
use crate::interface::NO_BENDING;
use crate::setup::{
    AirModel, BaumgarteChoice, FlightSetup, FormulationChoice, IntegratorChoice, MotionMode,
    StabilizationChoice, carriers,
};

impl FlightSetup {
    /// Checks the numbers that no other part checks.
    ///
    /// # Errors
    /// [`FlightError::Setup`] names the first key that makes no sense.
    pub fn validate(&self) -> Result<(), FlightError> {
        self.validate_time()?;
        self.validate_corrector()?;
        self.validate_mode()?;
        self.validate_integrator()?;
        let choice = match self.formulation {
            FormulationChoice::Euler(choice)
            | FormulationChoice::Quaternion(StabilizationChoice::Baumgarte(choice)) => Some(choice),
            _ => None,
        };
        if let Some(choice) = choice {
            let (key, values) = match choice {
                BaumgarteChoice::StepTied(a) => ("dynamics.baumgarte", [a, a]),
                BaumgarteChoice::Fixed { alpha, beta } => ("dynamics.baumgarte", [alpha, beta]),
            };
            for v in values {
                check(v.is_finite() && v >= 0.0, key, v, "a finite number >= 0")?;
            }
        }
        let bends = matches!(self.air, AirModel::External(_)) && self.animal.is_elastic();
        check(!bends, "air.model", "external", NO_BENDING)?;
        let last = self.animal.wings.len() + self.animal.segments.len();
        for load in &self.loads {
            let problem = "no such body: 0 is the root, wings follow in their order, then segments";
            check(load.body <= last, "load.body", load.body, problem)?;
        }
        for spring in &self.springs {
            let [a, b] = spring.bodies;
            let problem = "two bodies: 0 is the root, wings follow in their order, then segments";
            let two = a <= last && b <= last && a != b;
            check(two, "spring.between", format!("{a} and {b}"), problem)?;
            for (key, v) in [
                ("spring.stiffness", spring.stiffness),
                ("spring.rest", spring.rest),
                ("spring.damping", spring.damping),
            ] {
                check(v.is_finite() && v >= 0.0, key, v, "a finite number >= 0")?;
            }
        }
        Ok(())
    }

    /// Whether wing `w` moves with another wing, which carries it directly or by segments: its motion is in the axes of
    /// that wing, and what steers strokes and stroke planes of the flyer is not its own a second time.
    pub fn rides_on_wing(&self, w: usize) -> bool {
        self.wing_on_body(w) != w
    }

    /// Whether wing `w` stands still beside wings that beat ([`carriers::is_held`]): a tail, or a surface that is held.
    pub fn is_held_wing(&self, w: usize) -> bool {
        carriers::is_held(&self.animal, &self.joints, w)
    }

    /// Whether what changes all strokes of the flyer (the controls of trim, commands to all wings) acts on wing `w`
    /// ([`carriers::is_adjusted`]).
    pub fn is_adjusted(&self, w: usize) -> bool {
        carriers::is_adjusted(&self.animal, &self.joints, w)
    }

    /// Pitch of the stroke plane of wing `w` in the body \[rad\]: that of the wing on the body on which it rides.
    pub fn stroke_plane_pitch(&self, w: usize) -> f64 {
        let wing = &self.animal.wings[self.wing_on_body(w)];
        wing.motion.stroke_plane_pitch
    }

    /// The innermost of the wings that carry wing `w`; itself where none does.
    fn wing_on_body(&self, w: usize) -> usize {
        carriers::wing_on_body(self.animal.wings.len(), &self.joints, w)
    }

    /// Whether what happens depends on the past beside the motion of rigid bodies: wakes, wings that loads bend.
    pub fn has_memory(&self) -> bool {
        self.air.has_memory() || self.animal.is_elastic()
    }

    /// Refuses wings that loads bend.
    ///
    /// # Errors
    /// [`FlightError::Setup`] names the first, and `what` knows none.
    pub(crate) fn refuse_elastic(&self, what: &str) -> Result<(), FlightError> {
        match self.animal.wings.iter().find(|w| w.structure.is_some()) {
            None => Ok(()),
            Some(wing) => Err(FlightError::setup(
                "wing.structure",
                "",
                format!(
                    "{what} knows no wings that loads bend, as `{}` is: leave out [wing.NAME.structure] for it",
                    wing.name
                ),
            )),
        }
    }

    fn validate_integrator(&self) -> Result<(), FlightError> {
        let (key, method) = ("dynamics.integrator", self.integrator.name());
        if let IntegratorChoice::OrderEight { tolerance } = self.integrator {
            let ok = tolerance.is_finite() && tolerance > 0.0;
            let allowed = "a finite number above 0";
            check(ok, "dynamics.tolerance", tolerance, allowed)?;
        }
        let remembers = self.air.keeps_wake() || self.animal.is_elastic();
        let fits = !remembers || self.integrator.carries_wake();
        let problem = match (&self.air, self.air.keeps_wake()) {
            (AirModel::Own(_) | AirModel::External(_), true) => {
                "air that remembers is moved on once per step, and only hamming and bdf carry it along: set this key to one of them"
            }
            (_, true) => {
                "a wake is moved once per step, and only hamming and bdf carry it along: set this key to one of them"
            }
            (_, false) => {
                "elastic wings are moved on once per step, and only hamming and bdf carry them along: set this key to one of them"
            }
        };
        check(fits, key, method, problem)?;
        let projects =
            self.formulation == FormulationChoice::Quaternion(StabilizationChoice::Projection);
        let fits = !projects || self.integrator.is_one_step();
        let past = "projection changes the newest state, multistep methods use older ones too: take a one-step method (runge_kutta, order_eight) or Baumgarte's stabilisation";
        check(fits, key, method, past)
    }

    fn validate_time(&self) -> Result<(), FlightError> {
        let (h, period) = (self.time.step, self.time.period);
        let positive = "a finite number of seconds above 0";
        check(h.is_finite() && h > 0.0, "time.step", h, positive)?;
        if let Some(p) = period {
            check(p.is_finite() && p > 0.0, "time.period", p, positive)?;
        }
        Ok(())
    }

    fn validate_corrector(&self) -> Result<(), FlightError> {
        let c = &self.corrector;
        let (key, problem) = ("corrector.tolerance", "a finite number >= 0");
        check(
            c.tolerance.is_finite() && c.tolerance >= 0.0,
            key,
            c.tolerance,
            problem,
        )?;
        check(
            c.max_passes > 0,
            "corrector.max_passes",
            c.max_passes,
            "at least 1",
        )?;
        let ok = c.relaxation > 0.0 && c.relaxation <= 1.0;
        check(
            ok,
            "corrector.relaxation",
            c.relaxation,
            "above 0, at most 1",
        )
    }

    fn validate_mode(&self) -> Result<(), FlightError> {
        let MotionMode::Free(start) = &self.mode else {
            return Ok(());
        };
        let numbers = [
            start.position,
            start.angles,
            start.velocity,
            start.angular_velocity,
        ];
        let finite = numbers.iter().all(|v| v.is_finite());
        check(
            finite,
            "flight.start",
            format!("{numbers:?}"),
            "finite numbers",
        )?;
        let Some(motion) = &start.held_motion else {
            return Ok(());
        };
        let series = motion.position.iter().chain(&motion.angles);
        let numbers = series.flat_map(|s| {
            let shape = [s.constant, s.rate, s.frequency];
            shape
                .into_iter()
                .chain(s.cosine.clone())
                .chain(s.sine.clone())
        });
        let key = "flight.held_motion";
        check(
            numbers.into_iter().all(f64::is_finite),
            key,
            "a motion with infinite numbers",
            "finite numbers",
        )?;
        let problem = "a hold of one step or more: released at once the root has no such motion";
        check(start.held_steps > 0, key, "held for no step", problem)
    }
}

/// An error that shows the key, its value and what is allowed, unless `ok`.
fn check(
    ok: bool,
    key: &'static str,
    value: impl ToString,
    problem: &str,
) -> Result<(), FlightError> {
    if ok {
        return Ok(());
    }
    Err(FlightError::setup(key, value.to_string(), problem))
}
