//! One step of the elastic wings with the air, at given motions and accelerations of the bodies.

use wingbeat_air::AirState;
use wingbeat_dynamics::budget::kinetic_energy;
use wingbeat_dynamics::{AddedMass, Body, BodyAcceleration, BodyMotion, Budget, ShapeMass, Wrench};
use wingbeat_math::{DVec3, EulerSequence, MassProperties};
use wingbeat_structure::{FrameMotion, LoadTangent, NODE, Solver, Trial};

use super::secants::Secants;
use super::tangent::{AirTangent, WingResponse};
use super::wing::{ElasticState, ElasticWing, Nodes};
use super::{ElasticWings, frame_motion, turned};
use crate::error::FlightError;
use crate::interface::{Air, AirScratch, Instant, Shape};
use crate::record::ElasticRecord;

/// Forces that are left unbalanced at the end of a step over those at the nodes \[1\].
pub const TOLERANCE: f64 = 1e-10;

/// Corrections that are the rounding of places: in stiff wings the forces of such are more than [`TOLERANCE`] \[1\].
const ROUNDING: f64 = 1e-14;

/// Most passes.
pub const MAX_PASSES: usize = 40;

/// Passes after which factors are renewed.
const RENEWAL: usize = 8;

/// Of one wing.
#[derive(Debug)]
struct WingScratch {
    trial: Trial,
    solver: Solver,
    frame: FrameMotion,
    /// Forces on the nodes of the mesh \[N\], N components; loads on the nodes of the elastic body.
    forces: Vec<DVec3>,
    loads: Vec<f64>,
    residual: Vec<f64>,
    response: WingResponse,
    tangent: AirTangent,
    /// How the wing answers to accelerations of its frame beside the rigid one: an added mass.
    carried: Option<AddedMass>,
}

impl WingScratch {
    fn nodes(&self) -> Nodes<'_> {
        Nodes {
            at: &self.trial.configuration,
            velocity: &self.trial.velocity,
            acceleration: &self.trial.acceleration,
        }
    }
}

/// Intermediate results of the elastic wings; what it holds belongs to the instant last asked for.
#[derive(Debug, Default)]
pub struct ElasticScratch {
    wings: Vec<WingScratch>,
    /// Shapes of all wings of the animal.
    shapes: Vec<Option<Shape>>,
    secants: Secants,
    change: Vec<f64>,
    /// Whether the next instant is the first of another step.
    is_new: bool,
    /// Whether a step is under way; not at the start.
    is_stepping: bool,
    /// Passes of the last coupling, and what was left unbalanced \[1\].
    passes: usize,
    unbalanced: f64,
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
    pub fn shapes(&self) -> &[Option<Shape>] {
        &self.shapes
    }

    /// Passes of the last coupling, and what it left unbalanced over the forces at the nodes \[1\].
    pub fn convergence(&self) -> (usize, f64) {
        (self.passes, self.unbalanced)
    }
}

/// What shape and loads are to agree at.
pub struct Moment<'a> {
    /// Time \[s\].
    pub time: f64,
    /// Time step \[s\].
    pub step: f64,
    /// Motions of all bodies.
    pub motions: &'a [BodyMotion],
    /// Accelerations of all bodies; of wings in the first pass of a step that of the step before where they are not known.
    pub accelerations: &'a [BodyAcceleration],
}

impl ElasticWings {
    /// Room for steps from `states`.
    pub fn scratch(&self, states: &[ElasticState]) -> ElasticScratch {
        let wing = |(w, s): (&ElasticWing, &ElasticState)| WingScratch {
            trial: Trial::of(&s.structure),
            solver: Solver::new(&w.structure),
            frame: FrameMotion::REST,
            forces: vec![],
            loads: vec![0.0; NODE * w.structure.nodes()],
            residual: vec![],
            response: WingResponse::default(),
            tangent: AirTangent::default(),
            carried: None,
        };
        let mut scratch = ElasticScratch {
            wings: self.wings.iter().zip(states).map(wing).collect(),
            shapes: self.shapes(),
            ..ElasticScratch::default()
        };
        self.place(&mut scratch);
        scratch
    }

    /// Brings shapes and loads to agree at an instant: the loads of the air about the origins of the bodies stay in `out`.
    ///
    /// # Errors
    /// What the air reports; shapes and loads that do not come to agree.
    pub fn couple(
        &self,
        at: &Moment<'_>,
        around: (&dyn Air, Option<&AirState>),
        s: &mut ElasticScratch,
        (air_scratch, out): (&mut AirScratch, &mut [Wrench]),
    ) -> Result<(), FlightError> {
        self.set_frames(at, s);
        for pass in 1..=MAX_PASSES {
            s.passes = pass;
            self.place(s);
            let mut shapes = std::mem::take(&mut s.shapes);
            let instant = Instant {
                time: at.time,
                step: at.step,
                motions: at.motions,
                shapes: &shapes,
            };
            let passed = self.pass(&instant, around, s, (air_scratch, out));
            std::mem::swap(&mut s.shapes, &mut shapes);
            if passed? {
                return Ok(());
            }
            self.correct(s);
        }
        Err(self.failed(at.time, s))
    }

    /// Loads and residuals of a trial, and the tangents where they are due; true if shapes and loads agree.
    fn pass(
        &self,
        at: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirState>),
        s: &mut ElasticScratch,
        (air_scratch, out): (&mut AirScratch, &mut [Wrench]),
    ) -> Result<bool, FlightError> {
        air.place(at, air_scratch)?;
        air.loads(at, memory, air_scratch, out)?;
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            air.nodal_forces(w.wing, at, air_scratch, &mut ws.forces)?;
            let m = &at.motions[w.wing + 1];
            w.gather(m, &ws.trial.configuration, &ws.forces, &mut ws.loads);
            let (trial, frame) = (&ws.trial, &ws.frame);
            let residual = (ws.solver).residual(&w.structure, trial, frame, &ws.loads);
            ws.residual.clear();
            ws.residual.extend_from_slice(residual);
        }
        s.unbalanced = self.unbalanced(s);
        let is_exact = s.passes > 1 && s.moved <= ROUNDING;
        if s.unbalanced <= TOLERANCE || is_exact || !s.is_stepping {
            return Ok(true);
        }
        if !s.unbalanced.is_finite() {
            return Err(self.failed(at.time, s));
        }
        if s.passes % RENEWAL == 1 {
            self.factor(at, (air, memory), s, air_scratch)?;
        }
        Ok(false)
    }

    fn failed(&self, time: f64, s: &ElasticScratch) -> FlightError {
        FlightError::ElasticNotConverged {
            time,
            wings: self.wings.iter().map(|w| w.name.clone()).collect(),
            passes: s.passes,
            unbalanced: s.unbalanced,
            tolerance: TOLERANCE,
        }
    }

    /// Before the first instant of a step of `step` \[s\]: what the shapes will be if nothing new happens. Accelerations of the
    /// wings are those of the step before.
    pub fn predict(
        &self,
        step: f64,
        states: &[ElasticState],
        s: &mut ElasticScratch,
        accelerations: &mut [BodyAcceleration],
    ) {
        if !std::mem::take(&mut s.is_new) {
            return;
        }
        for ((w, ws), state) in self.wings.iter().zip(&mut s.wings).zip(states) {
            let (structure, own) = (&w.structure, &state.structure);
            w.method.predict(structure, own, step, &mut ws.trial);
            accelerations[w.wing + 1] = state.acceleration();
        }
    }

    fn set_frames(&self, at: &Moment<'_>, s: &mut ElasticScratch) {
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            let (m, a) = (&at.motions[w.wing + 1], &at.accelerations[w.wing + 1]);
            ws.frame = frame_motion(m, a, self.gravity);
        }
        s.secants.clear();
    }

    /// What the masses of the wings do otherwise than those of rigid ones, at the instant last asked for.
    pub fn shape_masses<'a>(
        &'a self,
        s: &'a ElasticScratch,
    ) -> impl Iterator<Item = ShapeMass> + 'a {
        self.wings.iter().zip(&s.wings).map(|(w, ws)| {
            let now = w.structure.mass_properties(&ws.trial.configuration);
            let (mut momentum, mut angular_momentum) = (DVec3::ZERO, DVec3::ZERO);
            for (mass, motion) in w.bodies(&BodyMotion::REST, ws.nodes()) {
                let of = Parts::of(mass, &motion);
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

    fn place(&self, s: &mut ElasticScratch) {
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            if let Some(shape) = &mut s.shapes[w.wing] {
                w.shape(ws.nodes(), shape);
            }
        }
    }

    /// Largest residual over the forces at the nodes, moments over them times the size of the wing.
    fn unbalanced(&self, s: &ElasticScratch) -> f64 {
        let of = |(w, ws): (&ElasticWing, &WingScratch)| {
            let force = |six: &[f64]| DVec3::from_slice(six).length();
            let loads: f64 = ws.loads.chunks_exact(NODE).map(force).sum();
            let weight = w.rigid.mass * ws.frame.acceleration.length();
            let spin = ws.frame.w_dot.length() + ws.frame.w.length_squared();
            let carried = w.rigid.mass * spin * w.structure.size();
            let scale = loads + weight + carried;
            let mut largest = 0.0_f64;
            for &k in w.structure.free_numbers() {
                let arm = if k % NODE < 3 {
                    1.0
                } else {
                    w.structure.size()
                };
                let rest = ws.residual[k].abs() / arm;
                if !(rest <= largest) {
                    largest = rest;
                }
            }
            if largest == 0.0 { 0.0 } else { largest / scale }
        };
        let all = self.wings.iter().zip(&s.wings).map(of);
        all.fold(0.0, |m, x| if x <= m { m } else { x })
    }

    /// Factorises the tangents, with the air's answer on their left-hand side.
    fn factor(
        &self,
        instant: &Instant<'_>,
        (air, memory): (&dyn Air, Option<&AirState>),
        s: &mut ElasticScratch,
        air_scratch: &AirScratch,
    ) -> Result<(), FlightError> {
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            let m = &instant.motions[w.wing + 1];
            let answers =
                air.wing_response(w.wing, instant, memory, air_scratch, &mut ws.response)?;
            let mut loads = LoadTangent::default();
            if answers {
                let (followers, at) = (&w.followers, &ws.trial.configuration);
                ws.tangent.set(&ws.response, m.r, followers, at);
                loads.position = Some(&ws.tangent.position);
                loads.velocity = Some(&ws.tangent.velocity);
            }
            let (structure, trial, frame) = (&w.structure, &ws.trial, &ws.frame);
            ws.solver.factor(structure, trial, frame, &loads)?;
            let response = ws.solver.frame_response(structure, trial, frame, &loads);
            ws.carried = Some(w.carried(&response));
        }
        Ok(())
    }

    /// Newton's corrections of all wings, accelerated together; translations over the sizes of the wings.
    fn correct(&self, s: &mut ElasticScratch) {
        let length = |w: &ElasticWing, k: usize| {
            if k % NODE < 3 {
                w.structure.size()
            } else {
                1.0
            }
        };
        let mut from;
        s.change.clear();
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            from = s.change.len();
            let free = w.structure.free_numbers();
            s.change.extend(free.iter().map(|&k| -ws.residual[k]));
            ws.solver.solve(&mut s.change[from..]);
            let numbers = s.change[from..].iter_mut().zip(free);
            numbers.for_each(|(x, &k)| *x /= length(w, k));
        }
        s.secants.accelerate(&mut s.change);
        (s.moved, from) = (0.0, 0);
        for (w, ws) in self.wings.iter().zip(&mut s.wings) {
            let free = w.structure.free_numbers();
            let change = &mut s.change[from..from + free.len()];
            from += free.len();
            let numbers = change.iter_mut().zip(free);
            numbers.for_each(|(x, &k)| *x *= length(w, k));
            s.moved = s.moved.max(ws.trial.add(&w.structure, change));
        }
    }

    /// Adds to `out` what the elastic wings do to their frames beside the loads of the air and what rigid ones would do, N
    /// components about the origins of the bodies.
    pub fn wrenches(&self, motions: &[BodyMotion], s: &ElasticScratch, out: &mut [Wrench]) {
        out.fill(Wrench::default());
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            let m = &motions[w.wing + 1];
            let at = &ws.trial.configuration;
            let needed = w.resultant(at, &ws.residual);
            let loads = w.resultant(at, &ws.loads);
            let rigid = w.rigid_inertia(&ws.frame);
            let both = [0, 1].map(|k| rigid[k] - needed[k] - loads[k]);
            out[w.wing + 1] = turned(m, both);
        }
    }

    /// The wings' answer to accelerations of their frames, beside that of rigid ones, as added masses into `out`; what they
    /// exert under the accelerations that the wings are known to have is taken out of `loads`.
    pub fn add_mass(
        &self,
        at: &Moment<'_>,
        s: &ElasticScratch,
        loads: &mut [Wrench],
        out: &mut Vec<AddedMass>,
    ) {
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            let Some(carried) = ws.carried else { continue };
            let body = w.wing + 1;
            let exerted = carried.wrench(&at.motions[body], &at.accelerations[body]);
            loads[body] = loads[body] - exerted;
            out.push(carried);
        }
    }

    /// Power of the air on what the wings move relative to their frames \[W\].
    pub fn air_power(&self, s: &ElasticScratch) -> f64 {
        let of = |ws: &WingScratch| -> f64 {
            let pairs = ws.loads.iter().zip(&ws.trial.velocity);
            pairs.map(|(f, v)| f * v).sum()
        };
        s.wings.iter().map(of).sum()
    }

    /// Elastic energy of each wing \[J\].
    pub fn strain_energy<'a>(&self, s: &'a ElasticScratch) -> impl Iterator<Item = f64> + 'a {
        s.wings.iter().map(|ws| ws.solver.strain_energy())
    }

    /// Power that the damping of the wings dissipates \[W\].
    pub fn dissipation(&self, s: &ElasticScratch) -> f64 {
        let of = |ws: &WingScratch| ws.solver.dissipation(&ws.trial);
        s.wings.iter().map(of).sum()
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
        s.wings.iter().zip(states).map(of).sum()
    }

    /// Where the tips are, how they are twisted and what elastic energy the wings hold.
    pub fn records(&self, s: &ElasticScratch, out: &mut Vec<ElasticRecord>) {
        out.clear();
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            let place = |n: usize| w.followers[n].position(&ws.trial.configuration);
            let rest = |n: usize| w.followers[n].position(w.structure.rest());
            let [lead, trail] = w.tip;
            let middle = |of: &dyn Fn(usize) -> DVec3| of(lead).midpoint(of(trail));
            let pitch = |of: &dyn Fn(usize) -> DVec3| {
                let chord = of(lead) - of(trail);
                (-chord.z).atan2(chord.x)
            };
            out.push(ElasticRecord {
                wing: w.wing,
                tip: middle(&place) - middle(&rest),
                twist: pitch(&place) - pitch(&rest),
                strain_energy: ws.solver.strain_energy(),
                passes: s.passes,
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
        for (w, ws) in self.wings.iter().zip(&s.wings) {
            let m = &motions[w.wing + 1];
            let rigid = std::iter::once((&w.rigid, *m)).map(|x| (-1.0, x));
            let elastic = w.bodies(m, ws.nodes()).map(|x| (1.0, x));
            for (sign, (properties, motion)) in rigid.chain(elastic) {
                let of = Parts::of(properties, &motion);
                b.kinetic += sign * of.kinetic;
                b.momentum += sign * of.momentum;
                angular += sign * of.angular;
                first += sign * of.first;
                b.potential -= sign * self.gravity.dot(of.first);
            }
            b.potential += ws.solver.strain_energy();
        }
        b.centre = first / mass;
        b.angular_momentum = angular - b.centre.cross(b.momentum);
    }

    /// Accepts the instant last asked for, the bodies accelerating as they do.
    pub fn accept(
        &self,
        accelerations: &[BodyAcceleration],
        s: &ElasticScratch,
        states: &mut [ElasticState],
    ) {
        for ((w, ws), state) in self.wings.iter().zip(&s.wings).zip(states) {
            if s.is_stepping {
                ws.solver.accept(&ws.trial, &mut state.structure);
            }
            let a = &accelerations[w.wing + 1];
            state.frame = [a.linear, a.angular];
        }
    }
}

/// Energy and momenta of one small body, N components, about the origin of N.
struct Parts {
    kinetic: f64,
    momentum: DVec3,
    angular: DVec3,
    /// First moment of mass \[kg m\].
    first: DVec3,
}

impl Parts {
    fn of(mass: &MassProperties, m: &BodyMotion) -> Self {
        let body = Body {
            name: String::new(),
            mass: *mass,
            sequence: EulerSequence::WING_132,
        };
        let momentum = mass.mass * m.v + m.r * m.w.cross(mass.first_moment);
        let spin = mass.first_moment.cross(m.r.transpose() * m.v) + mass.inertia * m.w;
        Self {
            kinetic: kinetic_energy(&body, m),
            momentum,
            angular: m.p.cross(momentum) + m.r * spin,
            first: mass.mass * m.p + m.r * mass.first_moment,
        }
    }
}
