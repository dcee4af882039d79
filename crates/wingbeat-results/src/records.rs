//! A history read back as the records that were written, one after the other.

use std::path::Path;

use wingbeat_dynamics::{Mechanism, Passive};
use wingbeat_flight::record::Integral;
use wingbeat_flight::{AirModel, FlightSetup, Record, system_of};
use wingbeat_math::DVec3;

use crate::columns::{Column, Columns};
use crate::rows::Rows;
use wingbeat_case::IoError;

/// The records of an open history.
pub struct Records {
    rows: Rows,
    columns: Columns,
    /// Where each column stands in a row; none where an older result lacks it.
    places: Vec<Option<usize>>,
    record: Record,
    /// Counted again where an older result lacks it.
    air_impulse: Option<Integral<DVec3>>,
    /// What the two after it are counted by.
    mechanism: Mechanism,
    /// Counted again where an older result lacks it.
    passive: Option<PassiveWork>,
    /// Likewise.
    positive: Option<Integral<f64>>,
    /// Where an older result of a lattice does not tell the inviscid force from the whole one.
    takes_whole_for_inviscid: bool,
}

impl Records {
    /// Opens the history of a flight. Numbers that results of older versions lack are not numbers (NaN), but
    /// the impulse of the air, the work of springs, dampers and stops and the positive work of what drives the
    /// joints, which are counted from the rows, and the impulse of the inviscid force, which is taken for that of
    /// the whole.
    ///
    /// # Errors
    /// A file that cannot be read or is not a history; a column that is missing or belongs to
    /// another flight.
    pub fn open(path: &Path, setup: &FlightSetup) -> Result<Self, IoError> {
        let rows = Rows::open(path)?;
        let columns = Columns::in_file(path, setup, rows.names())?;
        let damaged = |problem: String| IoError::Damaged {
            path: path.to_owned(),
            problem,
        };
        let names = rows.names();
        let at = |name: &str| names.iter().position(|n| n == name);
        let place = |c: &Column| at(&c.name).or_else(|| at(c.former.as_deref()?));
        let places: Vec<Option<usize>> = columns.iter().map(place).collect();
        let missing = columns.iter().zip(&places);
        if let Some((c, _)) = missing.into_iter().find(|(c, p)| p.is_none() && !c.is_new) {
            return Err(damaged(format!(
                "the column `{}` ({}) is missing: this history belongs to another animal than case.toml, or was changed",
                c.name, c.about
            )));
        }
        if let Some(name) = names.iter().find(|n| columns.find(n).is_none()) {
            return Err(damaged(format!(
                "the column `{name}` is none of this flight: this history belongs to another animal than case.toml, or a newer wingbeat wrote it"
            )));
        }
        let mut record = columns.blank();
        for (k, place) in places.iter().enumerate() {
            if place.is_none() {
                columns.put(k, f64::NAN, &mut record);
            }
        }
        let counts = record.air_impulse.x.is_nan();
        let lacks_inviscid = record.inviscid_impulse.x.is_nan();
        if lacks_inviscid {
            record.inviscid_impulse = DVec3::ZERO; // as without a lattice
        }
        let (lacks_passive, lacks_positive) =
            (record.passive_work.is_nan(), record.positive_work.is_nan());
        let system = system_of(setup);
        let system = system.map_err(|e| damaged(format!("the joints do not fit together: {e}")))?;
        let is_lattice = matches!(setup.air, AirModel::VortexLattice(_));
        Ok(Self {
            rows,
            columns,
            places,
            record,
            air_impulse: counts.then(Integral::default),
            mechanism: Mechanism::of(&system),
            passive: lacks_passive.then(PassiveWork::default),
            positive: lacks_positive.then(Integral::default),
            takes_whole_for_inviscid: lacks_inviscid && is_lattice,
        })
    }

    /// The next record; none at the end. A last row that was cut by a kill is left out.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn next_record(&mut self) -> Result<Option<&Record>, IoError> {
        let Some(row) = self.rows.next_row()? else {
            return Ok(None);
        };
        for (k, place) in self.places.iter().enumerate() {
            if let Some(at) = place {
                self.columns.put(k, row[*at], &mut self.record);
            }
        }
        if let Some(impulse) = &mut self.air_impulse {
            self.record.air_impulse = impulse.count(self.record.time, self.record.air_force());
        }
        let mechanism = &self.mechanism;
        if let Some(work) = &mut self.passive {
            (self.record).put_passive(mechanism, |time, now| work.count(time, now));
        }
        if let Some(work) = &mut self.positive {
            let powers = self.record.driving_powers(mechanism);
            let positive = powers.map(|p| p.max(0.0)).sum();
            self.record.positive_work = work.count(self.record.time, positive);
        }
        if self.takes_whole_for_inviscid {
            self.record.inviscid_impulse = self.record.air_impulse;
        }
        Ok(Some(&self.record))
    }

    /// Passes over the next `count` records.
    ///
    /// # Errors
    /// A row that is damaged.
    pub fn skip(&mut self, count: usize) -> Result<(), IoError> {
        for _ in 0..count {
            if self.next_record()?.is_none() {
                break;
            }
        }
        Ok(())
    }
}

/// The work of springs, dampers and stops where a history does not have it, counted step by step: what is stored
/// by its difference, what is dissipated by the trapezoidal rule.
#[derive(Clone, Copy, Debug, Default)]
struct PassiveWork {
    /// Time \[s\], energy stored \[J\], power dissipated \[W\].
    last: Option<[f64; 3]>,
    sum: f64,
}

impl PassiveWork {
    /// Counts on to `time` [s], where all joints together do `now`; returns the work up to there [J]. The first
    /// call sets the start.
    fn count(&mut self, time: f64, now: &Passive) -> f64 {
        if let Some([before, stored, dissipation]) = self.last {
            let dissipated = 0.5 * (time - before) * (dissipation + now.dissipation);
            self.sum += stored - now.stored - dissipated;
        }
        self.last = Some([time, now.stored, now.dissipation]);
        self.sum
    }
}
