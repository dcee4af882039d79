//! A flight that was flown: its records, means over wingbeats, summary.

use std::path::Path;

use wingbeat_case::IoError;
use wingbeat_flight::{FlightError, FlightSetup, Record, joint_coordinates};
use wingbeat_results::columns::Columns;
use wingbeat_results::history::HistoryWriter;
use wingbeat_results::summary::{BeatMeans, Beats};
use wingbeat_results::{History, Outcome, Records, ResultDir, Summary};

use super::error::Error;

/// A flight that was flown.
///
/// ```
/// let run = wingbeat::Flight::preset("fruit-fly-blade")?.beats(0.1).fly()?;
/// assert_eq!(run.records.len(), 1 + run.setup.time.steps); // the start first
/// assert_eq!(run.records[0].time, 0.0); // s
/// assert!(run.beats().is_empty()); // no whole wingbeat
/// # Ok::<(), wingbeat::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Run {
    /// What was flown.
    pub setup: FlightSetup,
    /// One record per step, the start first.
    pub records: Vec<Record>,
    /// How it ended.
    pub outcome: Outcome,
}

/// Means over one wingbeat, those of `history.csv`, summary and figures.
///
/// ```
/// let run = wingbeat::Flight::preset("fruit-fly-blade")?.beats(1.0).fly()?;
/// let beat = run.beats()[0];
/// assert_eq!(beat.beat, 1);
/// let specific = beat.power_watt / run.setup.animal.mass(); // W/kg
/// assert!(specific > 1.0 && specific < 1000.0);
/// # Ok::<(), wingbeat::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beat {
    /// Number of the beat, from 1.
    pub beat: usize,
    /// Force of the air against gravity over the weight [1]; not a number without gravity.
    pub lift_over_weight: f64,
    /// Force of the air along n1 (forward) [N].
    pub thrust_newton: f64,
    /// Power of all actuators and of prescribed deformation [W].
    pub power_watt: f64,
    /// The positive part of it, joint by joint [W]: what actuators give that get nothing back.
    pub positive_power_watt: f64,
    /// Lift over the mean dynamic pressure on the wings [1]; not a number in a vacuum.
    pub lift_coefficient: f64,
    /// The same of the force along n1 [1].
    pub thrust_coefficient: f64,
}

impl From<&BeatMeans> for Beat {
    fn from(BeatMeans { beat, mean }: &BeatMeans) -> Self {
        Self {
            beat: *beat,
            lift_over_weight: mean.lift_over_weight.unwrap_or(f64::NAN),
            thrust_newton: mean.thrust_newton,
            power_watt: mean.power_watt,
            positive_power_watt: mean.positive_power_watt,
            lift_coefficient: mean.lift_coefficient.unwrap_or(f64::NAN),
            thrust_coefficient: mean.thrust_coefficient.unwrap_or(f64::NAN),
        }
    }
}

impl Run {
    /// Reads back a result directory, finished or not: a record for each row of its history.
    ///
    /// ```
    /// use wingbeat::{Flight, Run};
    /// let dir = std::env::temp_dir().join(format!("wingbeat-read-{}", std::process::id()));
    /// let flown = Flight::preset_with("fruit-fly-blade", &["time.beats=0.1"])?.fly_to(&dir)?;
    /// assert_eq!(Run::read(&dir)?.records, flown.records); // bit for bit
    /// # std::fs::remove_dir_all(&dir).expect("it was just written");
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// A directory that holds no run, or files in it that are damaged.
    pub fn read(dir: impl AsRef<Path>) -> Result<Self, Error> {
        let dir = ResultDir::read(dir.as_ref())?;
        let setup = dir.case()?.setup;
        let mut rows = Records::open(&dir.join("history.csv"), &setup)?;
        let mut records = vec![];
        while let Some(record) = rows.next_record()? {
            records.push(record.clone());
        }
        Ok(Self {
            setup,
            records,
            outcome: dir.manifest()?.outcome,
        })
    }

    /// The columns of its history: names, units, frames, meanings.
    ///
    /// # Errors
    /// Joints that cannot be assembled.
    pub fn columns(&self) -> Result<Columns, Error> {
        let blank = Record::default();
        let first = self.records.first().unwrap_or(&blank);
        Ok(Columns::of(&self.setup, first).map_err(FlightError::from)?)
    }

    /// Its history as `history.csv` has it.
    ///
    /// ```
    /// let run = wingbeat::Flight::preset("fruit-fly-blade")?.beats(0.1).fly()?;
    /// let history = run.history()?;
    /// assert_eq!(history.column("mass_centre_n3_m")[5], run.records[5].mass_centre.z);
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Self::columns`].
    pub fn history(&self) -> Result<History, Error> {
        Ok(History::of(&self.columns()?, &self.records))
    }

    /// Means over every whole wingbeat.
    pub fn beats(&self) -> Vec<Beat> {
        let mut beats = Beats::new(&self.setup);
        let means = self.records.iter().filter_map(|r| beats.take(r));
        means.map(|m| Beat::from(&m)).collect()
    }

    /// Coordinate along free direction `direction` (from 0) of the joint `name`, record by record
    /// [rad or m]; none where there is no such direction.
    ///
    /// ```
    /// let run = wingbeat::Flight::preset("fruit-fly-abdomen-spring")?
    ///     .air(wingbeat::flight::AirModel::None)
    ///     .beats(0.1)
    ///     .fly()?;
    /// let angle = run.joint("waist", 0).expect("a free direction"); // rad
    /// assert_eq!(angle.len(), run.records.len());
    /// assert!(run.joint("knee", 0).is_none());
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    pub fn joint(&self, name: &str, direction: usize) -> Option<Vec<f64>> {
        let all = joint_coordinates(&self.setup).ok()?;
        let at = all
            .iter()
            .position(|c| c.joint == name && c.direction == direction)?;
        let of = |r: &Record| r.joints.get(at).map(|[coordinate, _rate]| *coordinate);
        self.records.iter().map(of).collect()
    }

    /// What happened, in words ([`Summary::to_text`]) and numbers, and how far to trust it.
    ///
    /// ```
    /// let run = wingbeat::Flight::preset("fruit-fly-blade")?.beats(1.0).fly()?;
    /// let summary = run.summary();
    /// assert_eq!(summary.beats.len(), 1);
    /// assert!(summary.energy_residual_relative < 1e-3);
    /// assert!(summary.to_text().contains("flew to its end"));
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    pub fn summary(&self) -> Summary {
        Summary::of(&self.setup, &self.records, &self.outcome)
    }

    /// Writes `history.csv`, `summary.txt` and `summary.json` (see docs/results.md) into the new
    /// folder `dir`. [`crate::Flight::fly_to`] writes case, manifest, frames, figures and page, too.
    ///
    /// ```
    /// use wingbeat::{Flight, results::History};
    /// let dir = std::env::temp_dir().join(format!("wingbeat-write-{}", std::process::id()));
    /// let run = Flight::preset("fruit-fly-blade")?.beats(0.1).fly()?;
    /// run.write(&dir)?;
    /// let history = History::read(&dir.join("history.csv"))?;
    /// assert_eq!(history.rows(), run.records.len());
    /// assert!(run.write(&dir).is_err()); // nothing is overwritten
    /// # std::fs::remove_dir_all(&dir).expect("it was just written");
    /// # Ok::<(), wingbeat::Error>(())
    /// ```
    ///
    /// # Errors
    /// The folder exists already or cannot be written.
    pub fn write(&self, dir: impl AsRef<Path>) -> Result<(), Error> {
        let dir = new_dir(dir.as_ref())?;
        let mut history = HistoryWriter::create(&dir.join("history.csv"), &self.setup)?;
        for record in &self.records {
            history.take(record)?;
            history.flush()?;
        }
        let summary = self.summary();
        dir.write("summary.txt", summary.to_text().as_bytes())?;
        dir.write("summary.json", summary.to_json().as_bytes())?;
        Ok(())
    }
}

/// A new directory, its parents with it.
pub(crate) fn new_dir(path: &Path) -> Result<ResultDir, IoError> {
    if path.exists() {
        return Err(IoError::Exists {
            path: path.to_owned(),
            remedy: "choose another directory, or remove this one first",
        });
    }
    ResultDir::create(path)
}
