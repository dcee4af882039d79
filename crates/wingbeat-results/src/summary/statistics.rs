//! What a summary needs to know of a history, gathered record by record.

use std::path::Path;

use wingbeat_flight::{FlightSetup, Record};
use wingbeat_math::{DVec3, EulerSequence};
use wingbeat_model::FlownCrossings;

use super::alternation::Alternation;
use super::beats::{BeatMeans, Beats};
use crate::records::Records;
use wingbeat_case::IoError;

/// Ends of the range of a number, and its largest magnitude.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub least: f64,
    pub highest: f64,
    pub most: f64,
}

impl Default for Extent {
    fn default() -> Self {
        Self {
            least: f64::INFINITY,
            highest: f64::NEG_INFINITY,
            most: 0.0,
        }
    }
}

impl Extent {
    fn take(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.highest = self.highest.max(value);
        self.most = self.most.max(value.abs());
    }

    /// From end to end; 0 of nothing.
    pub fn range(&self) -> f64 {
        (self.highest - self.least).max(0.0)
    }
}

/// A whole history.
#[derive(Clone, Debug, Default)]
pub(super) struct Statistics {
    pub rows: usize,
    pub first: Record,
    pub last: Record,
    pub kinetic_energy: Extent,
    pub potential_energy: Extent,
    pub hinge_work: Extent,
    pub air_work: Extent,
    pub deformation_work: Extent,
    pub applied_work: Extent,
    pub energy_residual: Extent,
    pub momentum: Extent,
    pub momentum_residual: Extent,
    pub violation_position: Extent,
    pub violation_orientation: Extent,
    pub euler_regularity: Extent,
    pub corrector_passes: Extent,
    pub net_flux_residual: Extent,
    /// Sums over all steps.
    pub passes_sum: usize,
    pub regularised: usize,
    pub alternation: Alternation,
    /// Means over whole wingbeats.
    pub beats: Vec<BeatMeans>,
    /// Of wings whose motion is not known beforehand.
    pub crossings: Option<FlownCrossings>,
}

impl Statistics {
    /// Reads the history once.
    pub fn read(path: &Path, setup: &FlightSetup) -> Result<Self, IoError> {
        let mut records = Records::open(path, setup)?;
        let (mut s, mut beats) = (Self::new(setup), Beats::new(setup));
        while let Some(record) = records.next_record()? {
            s.take(record, &mut beats, setup.animal.wings.len());
        }
        Ok(s)
    }

    /// Of records in memory.
    pub fn of(records: &[Record], setup: &FlightSetup) -> Self {
        let (mut s, mut beats) = (Self::new(setup), Beats::new(setup));
        for record in records {
            s.take(record, &mut beats, setup.animal.wings.len());
        }
        s
    }

    fn new(setup: &FlightSetup) -> Self {
        Self {
            crossings: setup.flown_crossings(),
            ..Self::default()
        }
    }

    fn take(&mut self, r: &Record, beats: &mut Beats<'_>, wings: usize) {
        self.beats.extend(beats.take(r));
        self.alternation.take(r, wings);
        if let Some(crossings) = &mut self.crossings {
            let of_wings = r.coordinates.chunks_exact(6).skip(1).take(wings);
            let pose = |q: &[f64]| {
                let attitude = EulerSequence::WING_132.rotation(DVec3::from_slice(&q[3..]));
                (DVec3::from_slice(q), attitude)
            };
            crossings.see(&of_wings.map(pose).collect::<Vec<_>>());
        }
        if self.rows == 0 {
            self.first.clone_from(r);
        }
        self.last.clone_from(r);
        self.rows += 1;
        self.kinetic_energy.take(r.kinetic_energy);
        self.potential_energy.take(r.potential_energy);
        self.hinge_work.take(r.hinge_work);
        self.air_work.take(r.air_work);
        self.deformation_work.take(r.deformation_work);
        self.applied_work.take(r.applied_work);
        self.energy_residual.take(r.energy_residual);
        self.momentum.take(r.momentum.length());
        self.momentum_residual.take(r.momentum_residual.length());
        self.violation_position.take(r.violation_position);
        self.violation_orientation.take(r.violation_orientation);
        self.euler_regularity.take(r.euler_regularity);
        self.corrector_passes.take(r.corrector_passes as f64);
        self.net_flux_residual.take(r.net_flux_residual);
        self.passes_sum += r.corrector_passes;
        self.regularised += r.regularised;
    }

    /// From start to end: coordinate `k` of the body.
    pub fn change(&self, k: usize) -> f64 {
        let of = |r: &Record| r.coordinates.get(k).copied().unwrap_or(0.0);
        of(&self.last) - of(&self.first)
    }
}
