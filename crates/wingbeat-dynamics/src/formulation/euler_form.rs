//! The seed's form of a [`System`]: six absolute coordinates per body, multipliers, Baumgarte stabilization.
//!
//! State: q, then q', both in the seed's order (eq. 2). For three bodies that is 18 + 18.
//!
//! The constraints hold only as far as integration and stabilization keep them: `alpha = beta =
//! a / h` with a = 0.1 drifts least at 80 steps per beat; constants of a few tens per second do
//! nothing at 200 Hz; a > 2.7 makes Runge-Kutta unstable. A stabilization tied to the step lowers a
//! fourth-order integrator to second order, a fixed one keeps its order.

use wingbeat_math::{BodyAcceleration, BodyMotion, DVec3, Wrench, largest};

use crate::budget::{budget, load_power};
use crate::configuration::Configuration;
use crate::formulation::euler::assembly::{consistent_coordinates, consistent_rates};
use crate::formulation::euler::constraint::HingeKinematics;
use crate::formulation::euler::coordinates::{BodyKinematics, COORDINATES, write};
use crate::formulation::euler::scratch::EulerScratch;
use crate::mechanism::baumgarte::Baumgarte;
use crate::system::check::{check_rotation, check_state};
use crate::{DynamicsError, Formulation, HingeReaction, Solution, System, Violation, Workspace};

/// The seed's form of a [`System`].
#[derive(Clone, Debug)]
pub struct EulerForm {
    system: System,
    baumgarte: Baumgarte,
}

/// What component `k` of a state of so many numbers is.
fn component(k: usize, of: usize) -> &'static str {
    match (2 * k < of, k % COORDINATES < 3) {
        (true, true) => "a position",
        (true, false) => "an Euler angle",
        (false, true) => "a velocity",
        (false, false) => "the rate of an Euler angle",
    }
}

impl EulerForm {
    /// The Euler form of `system` with stabilization `baumgarte`.
    pub fn new(system: System, baumgarte: Baumgarte) -> Self {
        Self { system, baumgarte }
    }

    /// Number of coordinates, six per body.
    pub fn coordinates(&self) -> usize {
        COORDINATES * self.system.bodies().len()
    }

    /// The state with the given motions of all bodies.
    fn pack(&self, motions: &[BodyMotion]) -> Vec<f64> {
        let n = self.coordinates();
        let mut y = vec![0.0; 2 * n];
        for (i, (b, m)) in self.system.bodies().iter().zip(motions).enumerate() {
            let eta = b.sequence.angles(m.r);
            write(&mut y[..n], i, m.p, eta);
            let eta_dot = b.sequence.g(eta).inverse() * m.w;
            write(&mut y[n..], i, m.v, eta_dot);
        }
        y
    }

    /// Kinematics of all bodies, checked.
    fn unfold(&self, t: f64, y: &[f64], ws: &mut Workspace) -> Result<(), DynamicsError> {
        let n = self.coordinates();
        assert_eq!(y.len(), 2 * n, "the Euler form has {} components", 2 * n);
        check_state(t, y, component)?;
        for (i, body) in self.system.bodies().iter().enumerate() {
            let (q, qd) = (&y[COORDINATES * i..n], &y[n + COORDINATES * i..]);
            let k = BodyKinematics::new(body, q, qd);
            k.check(body, t)?;
            ws.euler.bodies[i] = k;
            ws.motions[i] = k.motion;
        }
        Ok(())
    }

    /// Accelerations and multipliers of seed eq. 30 into the scratch.
    fn accelerate(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
    ) -> Result<(), DynamicsError> {
        self.unfold(t, y, ws)?;
        let s = &mut ws.euler;
        for (k, h) in self.system.hinges().iter().enumerate() {
            let (parent, child) = (&s.bodies[h.tree_parent()], &s.bodies[h.child]);
            s.hinges[k] = HingeKinematics::new(h, &h.rotation(t), parent, child);
        }
        s.condensed
            .solve(&self.system, &s.bodies, &s.hinges, loads, self.baumgarte)
            .ok_or(DynamicsError::SingularSaddle { time: t })
    }

    /// Accelerations of bodies and reactions of hinges from the solved equations.
    fn read_solved(&self, s: &EulerScratch, out: &mut Solution) {
        for (i, k) in s.bodies.iter().enumerate() {
            let a = &s.condensed.accelerations()[COORDINATES * i..];
            out.bodies[i] = BodyAcceleration {
                linear: DVec3::from_slice(a),
                angular: k.g * DVec3::from_slice(&a[3..]) + k.g_dot * k.eta_dot,
            };
        }
        let lambda = s.condensed.multipliers();
        let (connection, orientation) = lambda.split_at(3 * s.hinges.len());
        for (k, h) in s.hinges.iter().enumerate() {
            let moment = h.reaction_moment(DVec3::from_slice(&orientation[3 * k..]));
            out.hinges[k] = HingeReaction {
                force: h.reaction_force(DVec3::from_slice(&connection[3 * k..])),
                moment,
                power: moment.dot(h.prescribed_rate()),
            };
        }
        out.multipliers.copy_from_slice(lambda);
        out.violation = violation(&s.hinges);
    }
}

/// Largest constraint of each kind.
fn violation(hinges: &[HingeKinematics]) -> Violation {
    let size = |of: fn(&HingeKinematics) -> DVec3| {
        largest(hinges.iter().flat_map(|h| of(h).abs().to_array()))
    };
    Violation {
        position: size(HingeKinematics::connection),
        orientation: size(HingeKinematics::orientation),
    }
}

impl Formulation for EulerForm {
    fn system(&self) -> &System {
        &self.system
    }

    fn dim(&self) -> usize {
        2 * self.coordinates()
    }

    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        self.system.refuse_loops("Euler")?;
        if let Some(hinge) = self.system.first_free_hinge() {
            return Err(DynamicsError::NotInEulerForm {
                hinge: hinge.into(),
            });
        }
        check_rotation(root.r, t, || "the root's attitude".into())?;
        Configuration::check(&self.system, t)?;
        let mut ws = self.workspace();
        ws.configuration.update(&self.system, t);
        ws.configuration.motions(root, &mut ws.motions);
        let mut y = self.pack(&ws.motions);
        check_state(t, &y, component)?;
        let (q, qd) = y.split_at_mut(self.coordinates());
        consistent_coordinates(&self.system, t, q)?;
        consistent_rates(&self.system, t, q, qd)?;
        self.unfold(t, &y, &mut ws)?;
        Ok(y)
    }

    fn motions(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), DynamicsError> {
        self.unfold(t, y, ws)?;
        out.copy_from_slice(&ws.motions);
        Ok(())
    }

    fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.accelerate(t, y, loads, ws)?;
        let n = self.coordinates();
        dy[..n].copy_from_slice(&y[n..]);
        dy[n..].copy_from_slice(ws.euler.condensed.accelerations());
        Ok(())
    }

    fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        self.accelerate(t, y, loads, ws)?;
        self.read_solved(&ws.euler, out);
        out.tether = Wrench::default();
        out.budget = budget(&self.system, &ws.motions);
        out.load_power = load_power(loads, &ws.motions);
        Ok(())
    }

    fn scales(&self) -> Vec<f64> {
        let u = self.system.units();
        let coordinate = |i: usize| if i % COORDINATES < 3 { u.length } else { 1.0 };
        let n = self.coordinates();
        let rates = (0..n).map(|i| coordinate(i) / u.time);
        (0..n).map(coordinate).chain(rates).collect()
    }

    /// Nothing: coordinates without norms, and constraints that the stabilization keeps.
    fn normalise(&self, _t: f64, _y: &mut [f64], _: &mut Workspace) -> Result<(), DynamicsError> {
        Ok(())
    }
}
