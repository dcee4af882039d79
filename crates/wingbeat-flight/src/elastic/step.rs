//! One elastic wing within a step: Newton's iteration under loads that follow its motion.

use wingbeat_dynamics::AddedMass;
use wingbeat_math::{DVec3, larger};
use wingbeat_structure::{
    FrameMotion, LoadTangent, NODE, Solver, StructureError, Trial, carried_by_frame,
};

use super::tangent::AirTangent;
use super::wing::{ElasticState, ElasticWing, Nodes};
use crate::error::FlightError;
use crate::interface::WingResponse;

/// Forces that are left unbalanced at the end of a step over those at the nodes, without loads over those that
/// hold the wing \[1\].
pub const TOLERANCE: f64 = 1e-10;

/// The same of wings on free joints and of light flyers, whose small moments of inertia turn what is left into
/// accelerations: passes of bodies and air would not see less than that.
pub(super) const FINE_TOLERANCE: f64 = 1e-12;

/// Corrections that are the rounding of places: in stiff wings the forces of such are more than [`TOLERANCE`] \[1\].
pub(super) const ROUNDING: f64 = 1e-14;

/// Corrections that are small [1].
pub(super) const SMALL: f64 = 1e-10;

/// Most of Newton's passes on the elastic body under loads that follow its motion, the residual to reach over that at
/// first, and the ratio of residuals from pass to pass above which factors are renewed \[1\].
const MAX_NEWTON: usize = 20;
const NEWTON: f64 = 1e-4;
/// Residuals beyond this are those of a prediction that stretches what hardly stretches \[1\].
const ROUGH: f64 = 1e-2;
const SLOW: f64 = 0.1;
/// Corrections, and forces over those at first, that Newton's iteration does not come back from \[1\].
const FAR: f64 = 10.0;
const ASTRAY: f64 = 1e3;
/// Parts of what is unbalanced at first that are tried where not all of it can be taken away at once.
const LARGEST_PART: f64 = 0.25;
const SMALLEST_PART: f64 = 1e-3;

/// Of one wing.
#[derive(Debug)]
pub(super) struct WingScratch {
    pub trial: Trial,
    pub solver: Solver,
    pub frame: FrameMotion,
    /// Forces on the nodes of the mesh \[N\], N components; loads on the nodes of the elastic body.
    pub forces: Vec<DVec3>,
    pub loads: Vec<f64>,
    pub residual: Vec<f64>,
    /// Largest residual over the forces at the nodes \[1\], and these.
    pub unbalanced: f64,
    pub scale: f64,
    /// Velocities of the trial that the loads were taken for; loads as the air's answer carries them on; a step.
    pub before: Vec<f64>,
    pub given: Vec<f64>,
    pub step: Vec<f64>,
    /// What is unbalanced at first, how much of that stays so, and the velocities of the last trial that was in
    /// balance.
    first: Vec<f64>,
    kept: Vec<f64>,
    known: Vec<f64>,
    /// Whether the air answers, and whether factors are older than what it said.
    pub answers: bool,
    pub is_stale: bool,
    /// Whether the trial is the motion of the step before carried on.
    pub is_predicted: bool,
    pub response: WingResponse,
    pub tangent: AirTangent,
    /// How the wing answers to accelerations of its frame beside the rigid one: an added mass.
    pub carried: Option<AddedMass>,
}

impl WingScratch {
    /// Room for steps from `s`.
    pub fn new(w: &ElasticWing, s: &ElasticState) -> Self {
        Self {
            trial: Trial::of(&s.structure),
            solver: Solver::new(&w.structure),
            frame: FrameMotion::REST,
            forces: vec![],
            loads: vec![0.0; NODE * w.structure.nodes()],
            residual: vec![],
            unbalanced: 0.0,
            scale: 0.0,
            before: vec![],
            given: vec![],
            step: vec![],
            first: vec![],
            kept: vec![],
            known: vec![],
            answers: false,
            is_stale: true,
            is_predicted: false,
            response: WingResponse::default(),
            tangent: AirTangent::default(),
            carried: None,
        }
    }

    /// The forces at the nodes that residuals are measured by \[N\].
    pub fn set_scale(&mut self, w: &ElasticWing) {
        let loads = forces(&self.loads);
        let spin = self.frame.w_dot.length() + self.frame.w.length_squared();
        let carried = self.frame.acceleration.length() + spin * w.structure.size();
        self.scale = loads + w.rigid.mass * carried;
    }

    /// Residual of the trial under the loads `given`; moments count over the size of the wing. A wing under
    /// tension without loads is measured by what holds it.
    pub fn set_residual(&mut self, w: &ElasticWing) {
        let (trial, frame) = (&self.trial, &self.frame);
        let residual = (self.solver).residual(&w.structure, trial, frame, &self.given);
        self.residual.clear();
        self.residual.extend_from_slice(residual);
        let both = self.residual.iter_mut().zip(&self.kept);
        both.for_each(|(r, kept)| *r -= kept);
        let size = w.structure.size();
        let numbers = w.structure.free_numbers().iter();
        let part = |&k: &usize| self.residual[k].abs() / if k % NODE < 3 { 1.0 } else { size };
        let largest = numbers.map(part).fold(0.0, larger);
        let is_loaded = self.scale != 0.0;
        let scale = if is_loaded {
            self.scale
        } else {
            forces(&self.residual)
        };
        self.unbalanced = if largest == 0.0 { 0.0 } else { largest / scale };
    }

    /// The elastic body brought to balance under loads that follow its motion as the air has answered. The
    /// motion that the loads were taken for stays in `before`. Returns the share of what was unbalanced that is
    /// taken away \[1\].
    ///
    /// A predicted motion is where the air was asked, not where balance is sought from: it stretches what
    /// hardly stretches. It is taken away at once or, where Newton's iteration goes astray, part by part.
    pub fn bend(&mut self, w: &ElasticWing) -> Result<f64, FlightError> {
        self.before.clone_from(&self.trial.velocity);
        if std::mem::take(&mut self.is_predicted) {
            self.trial.take_back();
            self.solver.look_ahead_from_start(&self.trial);
            self.follow();
            self.set_residual(w);
        }
        let target = NEWTON * self.unbalanced.min(ROUGH);
        self.kept.clear();
        self.kept.resize(self.residual.len(), 0.0);
        self.first.clone_from(&self.residual);
        self.known.clone_from(&self.trial.velocity);
        match self.newton(w, target)? {
            true => Ok(1.0),
            false => self.bend_by_parts(w, target),
        }
    }

    /// The same from where it began, ever more of what is unbalanced at first taken away: as loads of a static
    /// problem are put on step by step.
    fn bend_by_parts(&mut self, w: &ElasticWing, target: f64) -> Result<f64, FlightError> {
        let (mut done, mut part) = (0.0, LARGEST_PART);
        while done < 1.0 && part >= SMALLEST_PART {
            self.return_to_known(w);
            let next = f64::min(done + part, 1.0);
            self.keep(w, 1.0 - next);
            self.is_stale = true;
            if self.newton(w, target)? {
                self.known.clone_from(&self.trial.velocity);
                done = next;
                part *= 2.0;
            } else {
                part *= 0.25;
            }
        }
        self.return_to_known(w);
        self.keep(w, 0.0);
        Ok(done)
    }

    /// Leaves a share of what was unbalanced at first as it is.
    fn keep(&mut self, w: &ElasticWing, share: f64) {
        let both = self.kept.iter_mut().zip(&self.first);
        both.for_each(|(kept, first)| *kept = share * first);
        self.follow();
        self.set_residual(w);
    }

    /// Takes the trial back to the last one that was in balance with a part, and what is foreseen to its own stresses.
    fn return_to_known(&mut self, w: &ElasticWing) {
        let place = 1.0 / self.trial.weights().velocity;
        let back = |&k: &usize| place * (self.known[k] - self.trial.velocity[k]);
        self.step.clear();
        self.step
            .extend(w.structure.free_numbers().iter().map(back));
        self.trial.add(&w.structure, &self.step);
        self.step.fill(0.0);
        (self.solver).look_ahead(&w.structure, &self.trial, &self.step);
    }

    /// Newton's iteration until what is unbalanced, but for what is kept, is less than `target`: false where it
    /// goes astray.
    fn newton(&mut self, w: &ElasticWing, target: f64) -> Result<bool, FlightError> {
        let (at_first, mut last) = (self.unbalanced, f64::INFINITY);
        for _ in 0..MAX_NEWTON {
            if self.is_stale || self.unbalanced > (SLOW * last).min(ROUGH) {
                match self.factor(w) {
                    Err(StructureError::Singular { .. }) => return Ok(false),
                    factored => factored?,
                }
            }
            last = self.unbalanced;
            self.step.clear();
            let free = w.structure.free_numbers();
            self.step.extend(free.iter().map(|&k| -self.residual[k]));
            self.solver.solve(&mut self.step);
            (self.solver).look_ahead(&w.structure, &self.trial, &self.step);
            let moved = self.trial.add(&w.structure, &self.step);
            self.follow();
            self.set_residual(w);
            let is_rounding = moved <= ROUNDING || moved <= SMALL && self.unbalanced > 0.5 * last;
            if self.unbalanced <= target || is_rounding {
                return Ok(true);
            }
            let is_lost = moved > FAR || self.unbalanced > ASTRAY * at_first.max(1.0);
            if is_lost || !(moved + self.unbalanced).is_finite() {
                return Ok(false);
            }
        }
        Ok(self.unbalanced <= ROUGH.min(at_first))
    }

    /// Loads as the air's answer carries them on from the motion they were taken for.
    fn follow(&mut self) {
        self.given.clone_from(&self.loads);
        if !self.answers {
            return;
        }
        let (n, place) = (self.given.len(), 1.0 / self.trial.weights().velocity);
        let both = self.trial.velocity.iter().zip(&self.before);
        self.step.clear();
        self.step.extend(both.map(|(a, b)| a - b));
        let rows = self
            .tangent
            .velocity
            .chunks_exact(n)
            .zip(self.tangent.position.chunks_exact(n));
        for (load, (by_velocity, by_place)) in self.given.iter_mut().zip(rows) {
            let terms = self.step.iter().zip(by_velocity.iter().zip(by_place));
            *load += terms.map(|(d, (v, p))| d * (v + place * p)).sum::<f64>();
        }
        let at_once = place * self.trial.weights().acceleration;
        let rows = self.tangent.acceleration.chunks_exact(n);
        for (load, row) in self.given.iter_mut().zip(rows) {
            let terms = self.step.iter().zip(row);
            *load += at_once * terms.map(|(d, a)| d * a).sum::<f64>();
        }
    }

    /// Factorises the tangent, with the air's answer on its left-hand side.
    fn factor(&mut self, w: &ElasticWing) -> Result<(), StructureError> {
        let loads = match self.answers {
            true => self.tangent.loads(),
            false => LoadTangent::default(),
        };
        let (structure, trial, frame) = (&w.structure, &self.trial, &self.frame);
        match self.unbalanced > ROUGH {
            true => (self.solver).factor_ahead(structure, trial, frame, &loads)?,
            false => self.solver.factor(structure, trial, frame, &loads)?,
        }
        if std::mem::take(&mut self.is_stale) {
            let response = self.solver.frame_response(structure, trial, frame, &loads);
            self.carried = Some(w.carried(&response));
        }
        Ok(())
    }

    /// What the air alone, the shape of the wing kept, answers to accelerations of its frame.
    pub fn carried_air(&self, w: &ElasticWing) -> Option<AddedMass> {
        let felt = self.answers && !self.tangent.acceleration.is_empty();
        let at = &self.trial.configuration;
        felt.then(|| w.carried_air(&carried_by_frame(at, &self.tangent.acceleration)))
    }

    pub fn nodes(&self) -> Nodes<'_> {
        Nodes {
            at: &self.trial.configuration,
            velocity: &self.trial.velocity,
            acceleration: &self.trial.acceleration,
        }
    }
}

/// Sum of the forces at the nodes \[N\].
fn forces(all: &[f64]) -> f64 {
    let force = |six: &[f64]| DVec3::from_slice(six).length();
    all.chunks_exact(NODE).map(force).sum()
}
