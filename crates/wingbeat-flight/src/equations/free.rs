//! Free flight in air without memory as `y' = f(t, y)`: the equations of
//! [`Simulation`](crate::Simulation) for those who integrate them themselves, over one wingbeat a
//! million times.
//!
//! State: that of the momentum form ([`MomentumForm`]): mass centre, quaternion, linear momentum, angular momentum
//! about the mass centre (13 numbers, N components), then coordinates and speeds of free joints.

use std::sync::Arc;

use wingbeat_blade::Unsteady;
use wingbeat_dynamics::{
    AddedMass, BodyAcceleration, BodyMotion, ConfigurationTable, Formulation, Mechanism,
    MomentumForm, System, Wrench, driven,
};

use crate::air::{Air, AirScratch, Instant};
use crate::bodies::{WingLaw, system_with};
use crate::carried::CarriedAir;
use crate::equations::{Equations, Memory, Scratch};
use crate::error::FlightError;
use crate::setup::{AirModel, FlightSetup};

/// The right-hand side of free flight.
#[derive(Clone, Debug)]
pub struct FreeFlight {
    equations: Arc<Equations>,
    form: MomentumForm,
}

/// Intermediate results of [`FreeFlight::rates`].
pub struct FreeFlightScratch(Scratch);

impl FreeFlightScratch {
    /// Forgets what it knows of the last evaluation: to be called where laws of the wings have changed in
    /// between, so that the same time means another configuration.
    pub fn forget(&mut self) {
        self.0.forget();
    }
}

impl FreeFlight {
    /// Free flight of `setup` (its mode, formulation and integrator do not matter) with the wings
    /// moving by `law`. All that depends on time alone is known beforehand at the times
    /// 0, `step`, ..., `count step` [s]; with joints that close loops it can be asked at these times only.
    ///
    /// # Errors
    /// Bodies or air that are refused; air with a memory; loops whose motion the laws of joints do not
    /// determine.
    pub fn new(
        setup: &FlightSetup,
        law: &WingLaw<'_>,
        step: f64,
        count: usize,
    ) -> Result<Self, FlightError> {
        let system = driven(system_with(setup, law)?, step, count)?;
        let table = Arc::new(ConfigurationTable::new(&system, step, count));
        Self::of(setup, MomentumForm::new(system).tabulated(table), step)
    }

    /// The same to be asked at any time, nothing known beforehand, in steps of `step` [s]: for laws that change on the
    /// way.
    ///
    /// # Errors
    /// As [`Self::new`]; joints that close loops.
    pub fn at_any_time(
        setup: &FlightSetup,
        law: &WingLaw<'_>,
        step: f64,
    ) -> Result<Self, FlightError> {
        let form = untabulated(setup, law)?;
        Self::of(setup, form, step)
    }

    /// The same `setup` as this flight's, to be asked at any time as [`Self::at_any_time`] has it, with wings
    /// that move by another `law`: both fly in the same air, which is not built again.
    ///
    /// # Errors
    /// As [`Self::at_any_time`].
    pub fn with_law(&self, setup: &FlightSetup, law: &WingLaw<'_>) -> Result<Self, FlightError> {
        let (air, step) = (Arc::clone(&self.equations.air), self.equations.step);
        Ok(Self::in_air(setup, untabulated(setup, law)?, air, step))
    }

    fn of(setup: &FlightSetup, form: MomentumForm, step: f64) -> Result<Self, FlightError> {
        let air = AirModel::build(setup, form.system())?;
        setup.refuse_elastic("a map of one wingbeat (averaged models, control derivatives, feedback that is laid out)")?;
        if air.has_memory() {
            let (key, value) = match setup.air.strip_wakes() {
                Some(Unsteady::Jones) => ("air.blade.unsteady", "jones"),
                Some(Unsteady::Peters { .. }) => ("air.blade.unsteady", "peters"),
                None => ("air.model", setup.air.key_value()),
            };
            return Err(FlightError::setup(
                key,
                value,
                "a map of one wingbeat (averaged models, control derivatives, feedback that is laid out) needs air that depends on the present motion alone: blade_element without air.blade.unsteady",
            ));
        }
        Ok(Self::in_air(setup, form, air, step))
    }

    fn in_air(setup: &FlightSetup, form: MomentumForm, air: Arc<dyn Air>, step: f64) -> Self {
        let equations = Equations {
            mechanism: Mechanism::of(form.system()),
            core: Box::new(form.clone()),
            air,
            pressure: Arc::default(), // no records are made of it
            elastic: Arc::default(),
            carried: CarriedAir::default(),
            applied: setup.loads.clone(),
            springs: setup.springs.clone(),
            step,
            mirror: None,
            accelerated_from: None,
            is_tethered: false,
        };
        Self {
            equations: Arc::new(equations),
            form,
        }
    }

    /// The bodies.
    pub fn system(&self) -> &System {
        self.form.system()
    }

    /// The momentum form that is integrated.
    pub fn form(&self) -> &MomentumForm {
        &self.form
    }

    /// The air.
    pub fn air(&self) -> &dyn Air {
        self.equations.air.as_ref()
    }

    /// Length of the state.
    pub fn dim(&self) -> usize {
        self.form.dim()
    }

    /// Room for intermediate results.
    pub fn scratch(&self) -> FreeFlightScratch {
        FreeFlightScratch(Scratch::new(&self.equations))
    }

    /// Rates of the state `y` at time `t` [s].
    ///
    /// # Errors
    /// States that are not finite or singular.
    pub fn rates(
        &self,
        t: f64,
        y: &[f64],
        s: &mut FreeFlightScratch,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        self.equations.rates(t, y, Memory::default(), &mut s.0, dy)
    }

    /// Motion of the root in the state `y` at time `t` [s]: as [`Self::motions`], with room that is there already.
    ///
    /// # Errors
    /// States that are not finite or singular.
    pub fn root(
        &self,
        t: f64,
        y: &[f64],
        s: &mut FreeFlightScratch,
    ) -> Result<BodyMotion, FlightError> {
        self.equations.root(t, y, &mut s.0)
    }

    /// Motions of all bodies in the state `y` at time `t` [s].
    ///
    /// # Errors
    /// States that are not finite or singular.
    pub fn motions(&self, t: f64, y: &[f64]) -> Result<Vec<BodyMotion>, FlightError> {
        let mut out = vec![BodyMotion::REST; self.system().bodies().len()];
        (self.form).motions(t, y, &mut self.form.workspace(), &mut out)?;
        Ok(out)
    }

    /// Loads of the air on bodies whose motions and accelerations are known, about their origins,
    /// N components.
    ///
    /// # Errors
    /// What the air reports.
    pub fn air_loads(
        &self,
        t: f64,
        motions: &[BodyMotion],
        accelerations: &[BodyAcceleration],
        s: &mut AirScratch,
    ) -> Result<Vec<Wrench>, FlightError> {
        let at = Instant::rigid(t, self.equations.step, motions);
        let (mut loads, mut added) = (vec![Wrench::default(); motions.len()], vec![]);
        self.air().place(&at, s)?;
        self.air().loads(&at, None, s, &mut loads)?;
        self.air().added_mass(t, s, &mut added);
        let carried = |a: &AddedMass| a.wrench(&motions[a.body()], &accelerations[a.body()]);
        added.iter().for_each(|a| loads[a.body()] += carried(a));
        Ok(loads)
    }
}

/// The momentum form of `setup` with nothing known beforehand.
fn untabulated(setup: &FlightSetup, law: &WingLaw<'_>) -> Result<MomentumForm, FlightError> {
    let system = system_with(setup, law)?;
    match system.loops().first() {
        None => Ok(MomentumForm::new(system)),
        Some(joint) => Err(FlightError::setup(
            "joint",
            "",
            format!(
                "`{}` closes a loop, which is solved for motions that are known beforehand only: leave it out",
                joint.name
            ),
        )),
    }
}
