//! A [`System`] in absolute coordinates with multipliers: [`AbsoluteForm`] behind the seam of the
//! formulations, with prescribed and free joints, singular at no attitude.

use crate::budget::{budget, load_power};
use crate::inverse::multipliers;
use crate::mechanism::Mechanism;
use crate::mechanism::form::{AbsoluteForm, AbsoluteScratch, Stabilization};
use crate::posture::Posture;
use crate::system::check_rotation;
use crate::workspace::check_finite;
use crate::{
    BodyMotion, DynamicsError, Formulation, Solution, System, Violation, Workspace, Wrench,
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

    fn workspace(&self) -> Workspace {
        Workspace {
            absolute: Some(self.form.scratch()),
            ..Workspace::new(&self.system)
        }
    }

    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        check_rotation(root.r, t, || "the root's attitude".into())?;
        Posture::check(&self.system, t)?;
        let mut posture = Posture::new(&self.system);
        posture.update(&self.system, t);
        let mut motions = vec![BodyMotion::REST; self.system.bodies().len()];
        posture.motions(root, &mut motions);
        let mut y = vec![0.0; self.dim()];
        self.form.pack(&motions, &mut y);
        check_finite(t, &y)?;
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
        out.hinges.copy_from_slice(&s.reactions);
        out.tether = Wrench::default();
        multipliers(&out.hinges, &mut out.multipliers);
        out.violation = Violation {
            position: s.violation[0],
            orientation: s.violation[1],
        };
        out.budget = budget(&self.system, &s.motions);
        out.load_power = load_power(loads, &s.motions);
        Ok(())
    }

    fn scales(&self) -> Vec<f64> {
        self.form.scales()
    }

    fn normalise(&self, t: f64, y: &mut [f64], ws: &mut Workspace) -> Result<(), DynamicsError> {
        self.form.project(t, y, scratch(ws))
    }
}
