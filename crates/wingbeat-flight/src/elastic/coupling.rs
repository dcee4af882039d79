//! One step of the elastic wings with the air, at given motions and accelerations of the bodies.

use wingbeat_dynamics::{BodyAcceleration, Wrench};
use wingbeat_math::{Secants, larger};
use wingbeat_structure::{GeneralizedAlpha, NODE};

use super::step::{ROUNDING, SMALL, WingScratch};
use super::wing::{ElasticState, ElasticWing};
use super::wings::{ElasticWings, frame_motion};
use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::{Air, AirScratch, BentShape, Instant};

/// Most passes.
pub const MAX_PASSES: usize = 40;

/// What to try where shape and loads do not agree, and where forces of the air jump.
const REMEDY: &str = "a smaller step (time.steps_per_beat, or time.step_s), more damping (structure.damping_s), or look whether the wing is too soft for its loads, touches itself, or is so stiff in one way (EI, GJ, EA or moduli in other units) that rounding of its shape outweighs its loads: `wingbeat check` doubts that";
const ACROSS_JUMPS: &str = "air.blade.rotation = \"circulation\", or a rotation_coefficient: the force of \"sane_dickinson\" jumps where the air along a chord reverses, and a step of an elastic wing that ends there may have no balance, whatever the step and the damping; else a smaller step (time.steps_per_beat, or time.step_s), more damping (structure.damping_s), or a stiffer wing";

/// Passes after which the air is asked again how it answers to the motion of the wings.
const RENEWAL: usize = 8;

/// Intermediate results of the elastic wings; what it holds belongs to the instant last asked for.
#[derive(Debug, Default)]
pub struct ElasticScratch {
    pub(super) wings: Vec<WingScratch>,
    /// Shapes of all wings of the animal.
    shapes: Vec<Option<BentShape>>,
    secants: Secants,
    change: Vec<f64>,
    /// Whether the next instant is the first of another step.
    is_new: bool,
    /// Whether the air has answered in this step.
    has_answers: bool,
    /// Whether a step is under way; not at the start.
    pub(super) is_stepping: bool,
    /// Passes of the last coupling, the most of a coupling in this step, and what was left unbalanced \[1\].
    pub(super) passes: usize,
    pub(super) most: usize,
    unbalanced: f64,
    /// Share of what was unbalanced that the last correction took away \[1\].
    share: f64,
    /// Size of the last correction: rotation \[rad\], translation over the size of the wing.
    moved: f64,
}

impl ElasticScratch {
    /// The next instant belongs to another step.
    pub fn begin_step(&mut self) {
        self.is_new = true;
        self.is_stepping = true;
    }

    /// Shapes of all wings of the animal; none of the rigid ones.
    pub fn shapes(&self) -> &[Option<BentShape>] {
        &self.shapes
    }

    /// Passes of the last coupling, and what it left unbalanced over the forces at the nodes \[1\].
    pub fn convergence(&self) -> (usize, f64) {
        (self.passes, self.unbalanced)
    }
}

impl ElasticWings {
    /// Room for steps from `states`.
    pub fn scratch(&self, states: &[ElasticState]) -> ElasticScratch {
        let wing = |(w, s): (&ElasticWing, &ElasticState)| WingScratch::new(w, s);
        let mut scratch = ElasticScratch {
            wings: self.wings.iter().zip(states).map(wing).collect(),
            shapes: self.shapes(),
            ..ElasticScratch::default()
        };
        self.place(&mut scratch);
        scratch
    }

    /// Brings shapes and loads to agree at an instant: the loads of the air about the origins of the bodies
    /// stay in `out`.
    ///
    /// # Errors
    /// What the air reports; shapes and loads that do not come to agree.
    pub fn couple(
        &self,
        at: &Instant<'_>,
        around: (&dyn Air, Option<&AirMemory>),
        s: &mut ElasticScratch,
        (air_scratch, out): (&mut AirScratch, &mut [Wrench]),
    ) -> Result<(), FlightError> {
        self.set_frames(at, s);
        for pass in 1..=MAX_PASSES {
            s.passes = pass;
            s.most = s.most.max(pass);
            self.place(s);
            let mut shapes = std::mem::take(&mut s.shapes);
            let instant = Instant {
                shapes: &shapes,
                ..*at
            };
            let passed = self.pass(&instant, around, s, (air_scratch, out));
            std::mem::swap(&mut s.shapes, &mut shapes);
            if passed? {
                return Ok(());
            }
            self.correct(s)?;
            if s.share <= 0.0 {
                break;
            }
        }
        Err(self.failed(at.time, s))
    }

    /// Loads and residuals of a trial, and the tangents where they are due; true if shapes and loads agree.
    fn pass(
        &self,
        at: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirMemory>),
        s: &mut ElasticScratch,
        (air_scratch, out): (&mut AirScratch, &mut [Wrench]),
    ) -> Result<bool, FlightError> {
        air.place(at, air_scratch)?;
        air.loads(at, memory, air_scratch, out)?;
        for (w, ws) in self.computed(&mut s.wings) {
            air.nodal_forces(w.wing, at, air_scratch, &mut ws.forces)?;
            let m = &at.motions[w.wing + 1];
            w.gather(m, &ws.trial.configuration, &ws.forces, &mut ws.loads);
            ws.given.clone_from(&ws.loads);
            ws.set_scale(w);
            ws.set_residual(w);
        }
        let before = s.unbalanced;
        let all = self.computed(&mut s.wings).map(|(_, ws)| ws.unbalanced);
        s.unbalanced = all.fold(0.0, larger);
        // Where corrections are small and help no more, what is left is the rounding of stiff forces.
        let helps = s.unbalanced < 0.5 * before;
        let is_whole = s.passes > 1 && s.share >= 1.0;
        let is_exact = is_whole && (s.moved <= ROUNDING || (s.moved <= SMALL && !helps));
        if !s.is_stepping && air.follows_accelerations() {
            self.take_answers(at, (air, memory), s, air_scratch)?;
            let all = self.computed(&mut s.wings);
            all.for_each(|(w, ws)| ws.carried = ws.carried_air(w));
        }
        if s.unbalanced <= self.tolerance() || is_exact || !s.is_stepping {
            return Ok(true);
        }
        if !s.unbalanced.is_finite() {
            return Err(self.failed(at.time, s));
        }
        // Answers at once, without a wake between, hardly change while bodies and wings are brought to agree;
        // on free joints passes need to know them well.
        let is_known = s.has_answers && air.follows_accelerations() && !self.on_joints;
        let is_known = is_known && s.passes == 1;
        if s.passes % RENEWAL == 1 && !is_known {
            self.take_answers(at, (air, memory), s, air_scratch)?;
        }
        Ok(false)
    }

    fn failed(&self, time: f64, s: &ElasticScratch) -> FlightError {
        FlightError::ElasticNotConverged {
            time,
            wings: self.wings.iter().map(|w| w.name.clone()).collect(),
            passes: s.passes,
            unbalanced: s.unbalanced,
            tolerance: self.tolerance(),
            remedy: match self.air_jumps {
                true => ACROSS_JUMPS,
                false => REMEDY,
            },
        }
    }

    /// Before the first instant of a step of `step` \[s\]: what the shapes will be if nothing new happens.
    /// Accelerations of the wings are those of the step before. Whether `jumps`: where the motion begins, accelerations
    /// of the nodes are not known.
    pub fn predict(
        &self,
        (step, jumps): (f64, bool),
        states: &[ElasticState],
        s: &mut ElasticScratch,
        accelerations: &mut [BodyAcceleration],
    ) {
        if !std::mem::take(&mut s.is_new) {
            return;
        }
        s.most = 0;
        s.has_answers = false;
        for ((w, ws), state) in self.wings.iter().zip(&mut s.wings).zip(states) {
            let (structure, own) = (&w.structure, &state.structure);
            let method = match own.is_fresh() {
                // As the joints that carry it start.
                true if self.on_joints => GeneralizedAlpha::euler(),
                true if jumps => GeneralizedAlpha::first(),
                _ => w.method,
            };
            method.predict(structure, own, step, &mut ws.trial);
            ws.is_predicted = true;
            ws.carried = None;
            accelerations[w.wing + 1] = state.acceleration();
        }
        self.reflect(s);
    }

    fn set_frames(&self, at: &Instant<'_>, s: &mut ElasticScratch) {
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            let (m, a) = (&at.motions[w.wing + 1], &at.accelerations[w.wing + 1]);
            ws.frame = frame_motion(m, a, self.gravity);
        }
        s.secants.clear();
    }

    /// The wings whose shape is computed.
    fn computed<'a>(
        &'a self,
        all: &'a mut [WingScratch],
    ) -> impl Iterator<Item = (&'a ElasticWing, &'a mut WingScratch)> {
        let both = self.wings.iter().zip(all).enumerate();
        both.filter(|(k, _)| self.image(*k).is_none())
            .map(|(_, both)| both)
    }

    /// Makes the trials of wings whose shape is not computed those of their mirror images.
    fn reflect(&self, s: &mut ElasticScratch) {
        for k in 0..self.wings.len() {
            let Some(image) = self.image(k) else { continue };
            let (before, rest) = s.wings.split_at_mut(k);
            let (from, to) = (&before[image.of].trial, &mut rest[0].trial);
            image.configuration(&from.configuration, &mut to.configuration);
            image.numbers(&from.velocity, &mut to.velocity);
            image.numbers(&from.acceleration, &mut to.acceleration);
        }
    }

    fn place(&self, s: &mut ElasticScratch) {
        self.reflect(s);
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            if let Some(shape) = &mut s.shapes[w.wing] {
                w.shape(ws.nodes(), shape);
            }
        }
    }

    /// What the air answers to the motion of the wings; factors are renewed, too.
    fn take_answers(
        &self,
        instant: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirMemory>),
        s: &mut ElasticScratch,
        air_scratch: &mut AirScratch,
    ) -> Result<(), FlightError> {
        for (w, ws) in self.computed(&mut s.wings) {
            let m = &instant.motions[w.wing + 1];
            ws.answers =
                air.wing_response(w.wing, instant, memory, air_scratch, &mut ws.response)?;
            if ws.answers {
                let (followers, at) = (&w.followers, &ws.trial.configuration);
                ws.tangent.set(&ws.response, m.r, followers, at);
            }
            ws.is_stale = true;
        }
        s.has_answers = true;
        Ok(())
    }

    /// New trials: what the elastic bodies do under loads that follow them as the air has answered, and what
    /// secants of former passes make of that, all wings together; translations over the sizes of the wings.
    fn correct(&self, s: &mut ElasticScratch) -> Result<(), FlightError> {
        s.change.clear();
        s.share = 1.0;
        for (w, ws) in self.computed(&mut s.wings) {
            s.share = s.share.min(ws.bend(w)?);
            let scale = w.structure.size() * ws.trial.weights().velocity;
            let turn = ws.trial.weights().velocity;
            for &k in w.structure.free_numbers() {
                let size = if k % NODE < 3 { scale } else { turn };
                let moved = ws.trial.velocity[k] - ws.before[k];
                s.change.push(moved / size);
            }
        }
        s.secants.accelerate(&mut s.change);
        let mut from = 0;
        s.moved = 0.0;
        for (w, ws) in self.computed(&mut s.wings) {
            let free = w.structure.free_numbers();
            let wanted = &s.change[from..from + free.len()];
            from += free.len();
            ws.step.clear();
            for (&k, x) in free.iter().zip(wanted) {
                let length = if k % NODE < 3 {
                    w.structure.size()
                } else {
                    1.0
                };
                let made = (ws.trial.velocity[k] - ws.before[k]) / ws.trial.weights().velocity;
                ws.step.push(length * x - made);
                s.moved = larger(s.moved, x.abs());
            }
            (ws.solver).look_ahead(&w.structure, &ws.trial, &ws.step);
            ws.trial.add(&w.structure, &ws.step);
        }
        Ok(())
    }

    /// Accepts the instant last asked for, the bodies accelerating as they do.
    pub fn accept(
        &self,
        accelerations: &[BodyAcceleration],
        s: &ElasticScratch,
        states: &mut [ElasticState],
    ) {
        for (k, (w, ws)) in self.wings.iter().zip(&s.wings).enumerate() {
            if s.is_stepping {
                let (before, rest) = states.split_at_mut(k);
                let own = &mut rest[0].structure;
                match self.image(k) {
                    Some(image) => image.state(&before[image.of].structure, own),
                    None => ws.solver.accept(&ws.trial, own),
                }
            }
            let a = &accelerations[w.wing + 1];
            states[k].frame = [a.linear, a.angular];
        }
    }
}
