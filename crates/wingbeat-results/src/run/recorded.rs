//! A flight and the directory that it is written to: from its start or its last checkpoint, from step to step.

use std::ops::ControlFlow;

use wingbeat_case::{IoError, LoadedCase};
use wingbeat_flight::{FlightError, Simulation};

use crate::common::checkpoint::Header;
use crate::{Manifest, Outcome, ResultDir, RunWriter, Summary};

/// A flight that is written while it is flown; its newest step is written already.
pub struct RecordedFlight {
    flight: Simulation,
    writer: RunWriter,
}

impl RecordedFlight {
    /// Before the first step of `flight`, which is that of `case`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn begin(
        dir: ResultDir,
        case: &LoadedCase,
        flight: Simulation,
        threads: usize,
    ) -> Result<Self, IoError> {
        let mut writer = RunWriter::new(dir, case, threads)?;
        writer.write(flight.record(), || flight.snapshot())?;
        Ok(Self { flight, writer })
    }

    /// At the checkpoint with this header, from whose state `flight` goes on ([`Simulation::resume`]): what was
    /// written later is cut off.
    ///
    /// # Errors
    /// A file that cannot be changed.
    pub fn resume(
        dir: ResultDir,
        case: &LoadedCase,
        flight: Simulation,
        (header, manifest): (&Header, Manifest),
        threads: usize,
    ) -> Result<Self, IoError> {
        let writer = RunWriter::resume(dir, case, header, manifest, threads)?;
        Ok(Self { flight, writer })
    }

    /// The flight.
    pub fn flight(&self) -> &Simulation {
        &self.flight
    }

    /// Frames of earlier steps that are missing or damaged, see [`RunWriter::lost_frames`].
    pub fn lost_frames(&self) -> &[IoError] {
        self.writer.lost_frames()
    }

    /// The directory.
    pub fn dir(&self) -> &ResultDir {
        self.writer.dir()
    }

    /// Makes and writes the steps to the end, or as long as `each` lets it, which sees the flight as it is and
    /// after every step, once that is written. A checkpoint is saved where one is due and where `each` stops
    /// the flight, of air whose memory is in it.
    ///
    /// # Errors
    /// Those of `each`, after which no checkpoint is saved; a step that fails; a file that cannot be written.
    pub fn fly<E: From<FlightError> + From<IoError>>(
        &mut self,
        mut each: impl FnMut(&Simulation) -> Result<ControlFlow<()>, E>,
    ) -> Result<Outcome, E> {
        let Self { flight, writer } = self;
        let written = flight.state().step;
        flight.fly(|flight| {
            if flight.state().step > written {
                writer.write(flight.record(), || flight.snapshot())?;
            }
            let next = each(flight)?;
            if flight.setup().air.is_saved(flight.state().air.as_ref()) {
                match next {
                    ControlFlow::Break(()) => writer.save(flight.state())?,
                    ControlFlow::Continue(()) => writer.save_if_due(flight.state())?,
                }
            }
            Ok::<_, E>(next)
        })?;
        Ok(Outcome::of(flight))
    }

    /// Ends the result, see [`RunWriter::finish`].
    ///
    /// # Errors
    /// As [`RunWriter::finish`].
    pub fn finish(
        mut self,
        outcome: Outcome,
        draw: impl FnOnce(&ResultDir, &LoadedCase, &Summary) -> Result<(), IoError>,
    ) -> Result<Summary, IoError> {
        self.writer.count(self.flight.tally());
        self.writer.finish(outcome, draw)
    }

    /// Ends a result that cannot be written any more, see [`RunWriter::abandon`].
    pub fn abandon(self, why: String) {
        self.writer.abandon(why);
    }
}
