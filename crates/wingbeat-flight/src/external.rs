//! The seam behind which another program's air stands.
//!
//! Bodies ask for loads in trial motions, as often as the corrector needs; a step that converged
//! is accepted once, with the motion asked for last. Steps are numbered; the starting values of
//! a multistep method replay the first three steps, so a partner with a memory must be able to
//! go back to the state it had when an earlier step was accepted.

use std::fmt;
use std::sync::{Arc, Mutex};

use wingbeat_dynamics::{BodyMotion, Wrench};

use crate::error::FlightError;
use crate::setup::{AirModel, FlightSetup};

/// Air computed by someone else.
pub trait ExternalAir: fmt::Debug + Send + Sync {
    /// Begins a flight of bodies with these names (the root first) in steps of `step` [s].
    ///
    /// # Errors
    /// What keeps the partner from answering.
    fn open(&self, bodies: &[String], step: f64) -> Result<Box<dyn ExternalSession>, String>;
}

/// A flight in such air.
pub trait ExternalSession: Send {
    /// Loads about the origins of the bodies, N components, if they move like `motions` at step
    /// number `step`, time `time` [s].
    ///
    /// # Errors
    /// What the partner says.
    fn loads(
        &mut self,
        step: usize,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String>;

    /// The motion asked for last is that of step number `step`.
    ///
    /// # Errors
    /// What the partner says.
    fn accept(&mut self, step: usize) -> Result<(), String>;
}

/// The session of a flight, shared by its stages, with the step asked for last.
#[derive(Clone)]
pub struct Session(Arc<Mutex<(Box<dyn ExternalSession>, usize)>>);

impl fmt::Debug for Session {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Session")
    }
}

impl Session {
    /// The session of a setup with external air.
    ///
    /// # Errors
    /// What keeps the partner from answering.
    pub fn open(setup: &FlightSetup) -> Result<Option<Self>, FlightError> {
        let AirModel::External(air) = &setup.air else {
            return Ok(None);
        };
        let wings = setup.animal.wings.iter().map(|w| w.name.clone());
        let bodies: Vec<String> = std::iter::once("body".to_owned()).chain(wings).collect();
        let session = air.open(&bodies, setup.time.step);
        let session = session.map_err(FlightError::External)?;
        Ok(Some(Self(Arc::new(Mutex::new((session, 0))))))
    }

    /// Loads in the motions at time `t` [s].
    ///
    /// # Errors
    /// What the partner says; loads that are not finite.
    pub fn loads(
        &self,
        t: f64,
        step: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        let mut guard = self.0.lock().expect("no thread panicked");
        let (session, asked) = &mut *guard;
        *asked = (t / step).round() as usize;
        session
            .loads(*asked, t, motions, out)
            .map_err(FlightError::External)?;
        let bad = out
            .iter()
            .position(|w| !w.force.is_finite() || !w.moment.is_finite());
        bad.map_or(Ok(()), |k| {
            let problem = format!("step {asked}: the load on body {k} is not finite");
            Err(FlightError::External(problem))
        })
    }

    /// Accepts the step asked for last.
    ///
    /// # Errors
    /// What the partner says.
    pub fn accept(&self) -> Result<(), FlightError> {
        let mut guard = self.0.lock().expect("no thread panicked");
        let (session, asked) = &mut *guard;
        session.accept(*asked).map_err(FlightError::External)
    }
}
