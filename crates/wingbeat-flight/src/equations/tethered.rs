//! Tethered with all joints prescribed: nothing to integrate, the support's reaction is what is asked for.

use wingbeat_dynamics::{
    AddedMass, BodyMotion, DynamicsError, Formulation, Solution, System, Workspace, Wrench,
    tethered, tethered_motions,
};

use crate::setup::prescribed::PrescribedMotion;

/// A root that moves as prescribed, and so all bodies: the state is empty.
#[derive(Debug)]
pub struct TetheredForm {
    /// The bodies.
    pub system: System,
    /// Motion of the root.
    pub motion: PrescribedMotion,
}

impl Formulation for TetheredForm {
    fn system(&self) -> &System {
        &self.system
    }

    fn dim(&self) -> usize {
        0
    }

    fn is_supported(&self) -> bool {
        true
    }

    fn initial(&self, _t: f64, _root: &BodyMotion) -> Result<Vec<f64>, DynamicsError> {
        Ok(vec![])
    }

    fn motions(
        &self,
        t: f64,
        _y: &[f64],
        ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), DynamicsError> {
        let root = self.motion.at(t).motion;
        tethered_motions(&self.system, t, &root, ws, out);
        Ok(())
    }

    fn rates(
        &self,
        _t: f64,
        _y: &[f64],
        _loads: &[Wrench],
        _ws: &mut Workspace,
        _dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        Ok(())
    }

    fn solve(
        &self,
        t: f64,
        _y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        tethered(&self.system, t, &self.motion.at(t), loads, ws, out);
        Ok(())
    }

    /// The accelerations are prescribed: they do not depend on the loads.
    fn add_mass(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        self.solve(t, y, loads, ws, out)?;
        let motions = ws.motions();
        for a in added {
            let (m, acc) = (&motions[a.body()], &out.bodies[a.body()]);
            loads[a.body()] += a.wrench(m, acc);
        }
        Ok(())
    }

    fn rates_with(
        &self,
        _at: (f64, &[f64]),
        _added: &[AddedMass],
        _loads: &mut [Wrench],
        _ws: &mut Workspace,
        _out: &mut Solution,
        _dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        Ok(())
    }

    fn scales(&self) -> Vec<f64> {
        vec![]
    }

    fn normalise(&self, _t: f64, _y: &mut [f64], _ws: &mut Workspace) -> Result<(), DynamicsError> {
        Ok(())
    }
}
