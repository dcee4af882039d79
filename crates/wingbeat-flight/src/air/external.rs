//! Another program's air.
//!
//! Bodies ask for loads in trial motions, as often as the corrector needs; a step that converged
//! is accepted once, with the motion asked for last. Steps are numbered; the starting values of
//! a multistep method replay the first three steps, so a partner with a memory must be able to
//! go back to the state it had when an earlier step was accepted.

use std::fmt;
use std::sync::{Mutex, MutexGuard};

use wingbeat_dynamics::{System, Wrench};

use crate::error::FlightError;
use crate::interface::memory::AirMemory;
use crate::interface::{Air, AirScratch, Announcement, ExternalAir, ExternalSession, Instant};
use crate::setup::FlightSetup;

/// The session of a flight, shared by its stages, with the step asked for last.
pub struct Session(Mutex<(Box<dyn ExternalSession>, usize)>);

impl fmt::Debug for Session {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Session")
    }
}

impl Session {
    /// The session of a flight of `setup` with `program`, whose bodies are `system`.
    ///
    /// # Errors
    /// What keeps the partner from answering.
    pub fn open(
        program: &dyn ExternalAir,
        system: &System,
        setup: &FlightSetup,
    ) -> Result<Self, FlightError> {
        let joints = system.hinges().iter().chain(system.loops());
        let joints = joints.map(|l| (l.name.clone(), l.parent.unwrap_or(0), l.child));
        let session = program.open(&Announcement {
            bodies: system.bodies().iter().map(|b| b.name.clone()).collect(),
            joints: joints.collect(),
            step: setup.time.step,
        });
        let session = session.map_err(FlightError::External)?;
        Ok(Self(Mutex::new((session, 0))))
    }

    fn lock(&self) -> MutexGuard<'_, (Box<dyn ExternalSession>, usize)> {
        self.0.lock().expect("no evaluation panicked")
    }
}

impl Air for Session {
    fn loads(
        &self,
        at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        let mut guard = self.lock();
        let (session, asked) = &mut *guard;
        *asked = (at.time / at.step).round() as usize;
        session
            .loads(*asked, at.time, at.motions, out)
            .map_err(FlightError::External)?;
        let finite = |w: &Wrench| w.force.is_finite() && w.moment.is_finite();
        match out.iter().position(|w| !finite(w)) {
            None => Ok(()),
            Some(k) => {
                let problem = format!("step {asked}: the load on body {k} is not finite");
                Err(FlightError::External(problem))
            }
        }
    }

    fn has_memory(&self) -> bool {
        true
    }

    fn accept(&self, _memory: &mut Option<AirMemory>, _s: &AirScratch) -> Result<(), FlightError> {
        let mut guard = self.lock();
        let (session, asked) = &mut *guard;
        session.accept(*asked).map_err(FlightError::External)
    }
}
