//! A [`System`] in absolute coordinates with multipliers: [`AbsoluteForm`] behind the interface of the
//! formulations, with prescribed and free joints, singular at no attitude.

use std::sync::Arc;

use wingbeat_math::{BodyMotion, RotationLaw, Wrench};

use crate::budget::{budget, load_power};
use crate::configuration::Configuration;
use crate::formulation::inverse::multipliers;
use crate::mechanism::Mechanism;
use crate::mechanism::form::component;
use crate::mechanism::form::{AbsoluteForm, AbsoluteScratch, Stabilization};
use crate::system::check::{check_rotation, check_state};
use crate::system::joint::Joint;
use crate::system::mirror::MirrorSymmetry;
use crate::{
    DynamicsError, Formulation, JointType, Solution, System, TravelLaw, Violation, Workspace,
};

/// The quaternion form of a [`System`].
#[derive(Clone, Debug)]
pub struct QuaternionForm {
    system: System,
    form: AbsoluteForm,
}

impl QuaternionForm {
    /// The quaternion form of `system`.
    pub fn new(system: System, stabilization: Stabilization) -> Self {
        let form = AbsoluteForm::new(Mechanism::of(&system), stabilization);
        Self { system, form }
    }

    /// The same with the root on a support that turns it by `law` against N and moves its origin
    /// along `path`; [`Solution::tether`] is what the support does to the root.
    pub fn supported(self, law: Arc<dyn RotationLaw>, path: Arc<dyn TravelLaw>) -> Self {
        let mut joint = Joint {
            law: Some(law),
            ..Joint::new("support of the root", None, 0, JointType::Weld)
        };
        joint.model.travel = Some(path);
        let mechanism = Mechanism::of(&self.system).with_joint(joint);
        Self {
            form: AbsoluteForm::new(mechanism, self.form.stabilization()),
            ..self
        }
    }

    /// Reactions of hinges, loops and support.
    fn read_reactions(&self, s: &AbsoluteScratch, out: &mut Solution) {
        let hinges = out.hinges.len();
        let (tree, rest) = s.reactions.split_at(hinges);
        let (loops, support) = rest.split_at(out.loops.len());
        out.hinges.copy_from_slice(tree);
        out.loops.copy_from_slice(loops);
        out.tether = support.first().map_or(Wrench::default(), |r| Wrench {
            force: r.force,
            moment: s.motions[0].r * r.moment,
        });
    }
}

/// The scratch that [`QuaternionForm::workspace`] put there.
fn scratch(ws: &mut Workspace) -> &mut AbsoluteScratch {
    ws.absolute
        .as_mut()
        .expect("a workspace made by the quaternion form itself")
}

impl Formulation for QuaternionForm {
    fn system(&self) -> &System {
        &self.system
    }

    fn dim(&self) -> usize {
        self.form.dim()
    }

    fn is_supported(&self) -> bool {
        let joints = self.system.hinges().len() + self.system.loops().len();
        self.form.mechanism().joints().len() > joints
    }

    fn workspace(&self) -> Workspace {
        Workspace {
            absolute: Some(self.form.scratch()),
            ..Workspace::new(&self.system)
        }
    }

    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        check_rotation(root.r, t, || "the root's attitude".into())?;
        Configuration::check(&self.system, t)?;
        let mut configuration = Configuration::new(&self.system);
        configuration.update(&self.system, t);
        let mut motions = vec![BodyMotion::REST; self.system.bodies().len()];
        configuration.motions(root, &mut motions);
        if self.system.loops().is_empty() {
            return self.initial_from(t, &motions);
        }
        self.form.initial(t, &motions, &[0])
    }

    fn initial_from(&self, t: f64, motions: &[BodyMotion]) -> Result<Vec<f64>, DynamicsError> {
        let mut y = vec![0.0; self.dim()];
        self.form.pack(motions, &mut y);
        check_state(t, &y, component)?;
        Ok(y)
    }

    fn motions(
        &self,
        t: f64,
        y: &[f64],
        _ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), DynamicsError> {
        self.form.motions(t, y, out)
    }

    fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.form.rates(t, y, loads, scratch(ws), dy)
    }

    fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        let s = scratch(ws);
        self.form.solve(t, y, loads, s)?;
        out.bodies.copy_from_slice(&s.accelerations);
        self.read_reactions(s, out);
        multipliers(&out.hinges, &mut out.multipliers);
        out.violation = Violation {
            position: s.violation[0],
            orientation: s.violation[1],
        };
        out.budget = budget(&self.system, &s.motions);
        out.load_power = load_power(loads, &s.motions);
        Ok(())
    }

    fn symmetrise(&self, mirror: &MirrorSymmetry, y: &[f64], dy: &mut [f64]) {
        self.form.symmetrise(mirror, y, dy);
    }

    fn scales(&self) -> Vec<f64> {
        self.form.scales()
    }

    fn normalise(&self, t: f64, y: &mut [f64], ws: &mut Workspace) -> Result<(), DynamicsError> {
        self.form.project(t, y, scratch(ws))
    }
}
