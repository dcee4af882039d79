//! How fast a flight goes: the cost of its steps, measured as it is flown.

use std::path::Path;
use std::time::Instant;

use wingbeat::air::Points;
use wingbeat::analysis::cost::{CostModel, WakeGrowth};
use wingbeat::analysis::kept_wake;
use wingbeat::case::OutputSettings;
use wingbeat::flight::{FlightSetup, Record, Simulation};
use wingbeat::results::rows::Rows;

/// Points of a trial sum over the wake.
const TRIAL_POINTS: usize = 2048;
/// Elements of the wake at the first trial; the next comes when it has doubled.
const TRIAL_WAKE: f64 = 200.0;

/// Takes the time of steps and tells that of the steps to come.
pub(crate) struct Pace {
    steps: usize,
    newest: Instant,
    cost: CostModel,
    growth: WakeGrowth,
    /// Elements of the wake at which the next trial is due; none where a trial says nothing.
    next_trial: Option<f64>,
    /// Seconds that summary, figures and page take of the whole history, once they can be told.
    ending: Option<f64>,
}

/// How often the history is read for the summary, for the figures and for the page, and what is done
/// with its rows, in times of one reading (measured on 150,000 rows).
const SUMMARY: f64 = 1.4;
const FIGURES: f64 = 1.9;
const PAGE: f64 = 3.7;
/// Part of the steps after which a reading is tried.
const READ_AFTER: f64 = 0.05;
/// Rows that are read in a trial.
const TRIAL_ROWS: usize = 300;

impl Pace {
    /// For a flight about to make a step.
    pub(crate) fn new(setup: &FlightSetup) -> Self {
        let blobs = blobs(setup);
        Self {
            steps: setup.time.steps,
            newest: Instant::now(),
            cost: CostModel::new(if blobs { 1.5 } else { 2.0 }),
            growth: WakeGrowth::new(kept_steps(setup)),
            next_trial: (!blobs).then_some(TRIAL_WAKE),
            ending: None,
        }
    }

    /// Takes note of the newest step; the next one begins now.
    pub(crate) fn note(&mut self, flight: &Simulation) {
        let (wake, seconds) = (elements(flight.record()), self.newest.elapsed());
        self.cost.step(self.growth.now(), seconds.as_secs_f64());
        self.growth.step(wake);
        if self.next_trial.is_some_and(|due| wake >= due) {
            self.next_trial = Some(2.0 * wake);
            if let Some(seconds) = trial(flight) {
                self.cost.expect(wake, seconds);
            }
        }
        self.newest = Instant::now();
    }

    /// Seconds from step `step` until everything is written.
    pub(crate) fn seconds_left(&self, step: usize) -> f64 {
        self.cost.cost(self.growth.ahead(self.steps - step)) + self.ending.unwrap_or(0.0)
    }

    /// Learns what summary, figures and page will take from the first rows of the history at `path`,
    /// as soon as there are some.
    pub(crate) fn note_history(&mut self, path: &Path, output: &OutputSettings, step: usize) {
        let early = (step as f64) < READ_AFTER * self.steps as f64;
        if early || self.ending.is_some() {
            return;
        }
        let per_row = reading(path).unwrap_or(0.0);
        let rows = self.steps as f64 / output.history_every as f64;
        let readings = SUMMARY
            + if output.figures { FIGURES } else { 0.0 }
            + if output.page { PAGE } else { 0.0 };
        self.ending = Some(readings * rows * per_row);
    }

    /// Elements of the largest wake from step `step` on.
    pub(crate) fn largest_wake(&self, step: usize) -> f64 {
        let ahead = self.growth.ahead(self.steps - step).map(|[n, _]| n);
        ahead.fold(self.growth.now(), f64::max)
    }
}

/// Whether wakes are summed at a cost that grows slower than with their square.
fn blobs(setup: &FlightSetup) -> bool {
    setup.air.lattice().is_some_and(|air| {
        air.lattice.wake_blob_length.is_some() || air.lattice.particles.is_some()
    })
}

/// Steps after which the oldest row of a wake is dropped.
fn kept_steps(setup: &FlightSetup) -> Option<usize> {
    let air = &setup.air.lattice()?.lattice;
    let by_age = air
        .max_age
        .map(|age| (age / setup.time.step).ceil() as usize);
    // A way is gone in a time that is known where nothing beats.
    let still = setup.time.period.is_none();
    let kept = still.then(|| kept_wake(setup)).flatten();
    let by_way = kept.map(|wake| (wake.time / setup.time.step).ceil() as usize);
    air.max_rows.into_iter().chain(by_age).chain(by_way).min()
}

/// Seconds to read a row of a history, measured on its first rows; none without rows.
fn reading(path: &Path) -> Option<f64> {
    let mut rows = Rows::open(path).ok()?;
    let (begun, mut read) = (Instant::now(), 0);
    while read < TRIAL_ROWS && rows.next_row().ok()?.is_some() {
        read += 1;
    }
    (read > 0).then(|| begun.elapsed().as_secs_f64() / read as f64)
}

/// Rings and particles of the wake.
fn elements(record: &Record) -> f64 {
    (record.wake_rings + record.wake_particles) as f64
}

/// Seconds that the velocity of the air at the nodes of its wakes takes, as moving the wakes needs
/// it, measured on a part of them; none without a wake.
fn trial(flight: &Simulation) -> Option<f64> {
    let snapshot = flight.snapshot();
    let nodes: Vec<_> = snapshot.wakes.iter().flat_map(|w| &w.nodes).collect();
    let panels: usize = snapshot.surfaces.iter().map(|s| s.quads.len()).sum();
    let rings: usize = snapshot.wakes.iter().map(|w| w.circulation.len()).sum();
    if nodes.is_empty() {
        return None;
    }
    let points: Points = nodes
        .iter()
        .cycle()
        .take(TRIAL_POINTS)
        .map(|x| **x)
        .collect();
    let start = Instant::now();
    flight.air_velocity(&points).ok()??;
    let per_point = start.elapsed().as_secs_f64() / TRIAL_POINTS as f64;
    let own = rings as f64 / (rings + panels) as f64; // the rest is the wings'
    Some(per_point * own * nodes.len() as f64)
}
