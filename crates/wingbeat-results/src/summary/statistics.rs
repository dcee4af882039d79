//! What a summary needs to know of a history, gathered record by record.

use std::path::Path;

use wingbeat_flight::{FlightSetup, Record};
use wingbeat_math::larger;

use super::beats::{BeatMeans, Beats};
use super::each_step::EachStep;
use crate::series::records::Records;
use wingbeat_case::IoError;

/// A whole history.
#[derive(Clone, Debug, Default)]
pub(super) struct Statistics {
    pub first: Record,
    pub last: Record,
    /// Of the rows of the history, or of all steps where these were gathered as they were flown.
    pub each: EachStep,
    /// Sums over all steps.
    pub regularised: usize,
    pub limited: usize,
    pub leading_rings: f64,
    /// Largest residual of a last corrector pass \[1\].
    pub corrector_residual: f64,
    /// Rings of wakes in sum over the rows, and how many rows that are.
    pub wake_rings: usize,
    pub rows: usize,
    /// Means over whole wingbeats.
    pub beats: Vec<BeatMeans>,
    is_begun: bool,
}

impl Statistics {
    /// Reads the history once; takes `each`, of every step, in place of what its rows say.
    pub fn read(path: &Path, setup: &FlightSetup, each: Option<EachStep>) -> Result<Self, IoError> {
        let mut records = Records::open(path, setup)?;
        let (mut s, mut beats) = (Self::new(setup, each.is_none()), Beats::new(setup));
        while let Some(record) = records.next_record()? {
            s.take(record, &mut beats);
            if each.is_none() {
                s.each.take(record, setup);
            }
        }
        s.each = each.unwrap_or(s.each);
        Ok(s)
    }

    /// Of records in memory.
    pub fn of(records: &[Record], setup: &FlightSetup) -> Self {
        let (mut s, mut beats) = (Self::new(setup, true), Beats::new(setup));
        for record in records {
            s.take(record, &mut beats);
            s.each.take(record, setup);
        }
        s
    }

    fn new(setup: &FlightSetup, gathers: bool) -> Self {
        Self {
            each: match gathers {
                true => EachStep::new(setup),
                false => EachStep::default(),
            },
            ..Self::default()
        }
    }

    fn take(&mut self, r: &Record, beats: &mut Beats<'_>) {
        self.beats.extend(beats.take(r));
        if !self.is_begun {
            self.first.clone_from(r);
            self.is_begun = true;
        }
        self.last.clone_from(r);
        self.regularised += r.regularised;
        self.limited += r.limited;
        self.leading_rings += r.leading_rings;
        self.corrector_residual = larger(self.corrector_residual, r.corrector_residual);
        self.wake_rings += r.wake_rings;
        self.rows += 1;
    }

    /// Limited events over what could be limited \[1\], 1 at most: ways of wake nodes, of which there are about
    /// as many as rings, or, where nothing but leading edges without a solution can be, chordwise strips in all
    /// steps. Events are counted on the half that is computed, rings and strips on both.
    pub fn limited_part(&self, setup: &FlightSetup) -> f64 {
        let half = if setup.air.is_mirrored() { 0.5 } else { 1.0 };
        let each = match limits_edges_alone(setup) {
            true => setup
                .animal
                .wings
                .iter()
                .map(|w| w.mesh.cols)
                .sum::<usize>() as f64,
            false => self.wake_rings as f64 / self.rows.max(1) as f64,
        };
        let all = half * each * self.last.step as f64;
        (self.limited as f64 / all.max(1.0)).min(1.0)
    }

    /// From start to end: coordinate `k` of the body.
    pub fn change(&self, k: usize) -> f64 {
        let of = |r: &Record| r.coordinates.get(k).copied().unwrap_or(0.0);
        of(&self.last) - of(&self.first)
    }
}

/// Whether limited events of this flight are leading edges without a solution, and no others.
pub(super) fn limits_edges_alone(setup: &FlightSetup) -> bool {
    let Some(air) = setup.air.lattice() else {
        return false;
    };
    let air = &air.lattice;
    air.solves_suction() && air.max_displacement.is_none() && air.particles.is_none()
}
