//! What `wingbeat check` says beforehand: the numbers of the flight, what is implausible about them,
//! and what flying it will cost, from a few steps on trial.

use std::fmt::{self, Display, Formatter};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use wingbeat::analysis::{Estimate, WingEstimate};
use wingbeat::flight::{AirModel, FlightError, FlightSetup, Simulation};
use wingbeat::results::fixed::fixed;

use crate::command::output::report::{Report, entry};
use crate::command::progress::pace::Pace;

/// Unknown circulations beyond which the trial is left out: their matrix takes some seconds and
/// 0.1 GB, and eight times the one and four times the other with every doubling.
pub(crate) const MAX_UNKNOWNS: usize = 4000;
/// Time for steps on trial.
const TRIAL: Duration = Duration::from_millis(1500);

/// Circulations that are solved for at every step.
pub(crate) fn unknowns(setup: &FlightSetup) -> usize {
    match &setup.air {
        AirModel::VortexLattice(air) if air.mirror => setup.panels().div_ceil(2),
        _ => setup.panels(),
    }
}

/// Wings that stand still beside those that beat: what changes the strokes of the flyer leaves them as they are.
pub(crate) fn tell_held(report: &mut Report, setup: &FlightSetup) {
    let wings = &setup.animal.wings;
    let held = (0..wings.len()).filter(|&w| setup.is_held_wing(w) && !setup.rides_on_wing(w));
    let held: Vec<&str> = held.map(|w| &wings[w].name[..]).collect();
    if !held.is_empty() {
        entry!(
            report,
            "held",
            "`{}`: constant angles beside wings that beat; motion.adjust and feedback leave them as they are, and trim but for tail_incidence",
            held.join("`, `")
        );
    }
    report.value("held_wings", held);
}

/// What of the weight constant loads carry.
pub(crate) fn tell_borne(report: &mut Report, setup: &FlightSetup) {
    let weight = setup.animal.mass() * setup.gravity.length();
    let borne = (weight > 0.0).then(|| setup.lift_of_loads() / weight);
    if let Some(borne) = borne.filter(|b| b.abs() >= 0.005) {
        entry!(
            report,
            "borne",
            "{borne:.2} weights: constant loads (buoyancy, [[load]]), beside the lift of the air"
        );
    }
    report.value("loads_over_weight", borne);
}

/// The numbers of a flight, a line each.
pub(crate) fn tell(report: &mut Report, e: &Estimate) {
    for w in &e.wings {
        entry!(report, "motion", "`{}`: {}", w.report.name, motion(w));
    }
    for (w, f) in (e.wings.iter()).filter_map(|w| Some((w, w.first_frequency?))) {
        let beats = w
            .frequency_ratio
            .map(|r| format!(", {} times that of the wingbeat", three(r)));
        entry!(
            report,
            "bending",
            "`{}`: first frequency in vacuum, hinge held, {} Hz{}",
            w.report.name,
            three(f),
            beats.unwrap_or_default()
        );
    }
    report.value("wings", e.wings.iter().map(wing).collect::<Vec<Value>>());
    let speed = e.flight_speed;
    if let Some(f) = e.frequency {
        entry!(report, "beat", "{f:.4} Hz, flight speed {speed:.3} m/s");
    }
    report.value("frequency_hz", e.frequency);
    report.value("flight_speed_m_s", speed);
    if let Some(loading) = e.wing_loading {
        entry!(report, "loading", "{loading:.3} N per m2 of wing");
    }
    report.value("wing_loading_newton_m2", e.wing_loading);
    let [x, y, z] = e.inertia.to_array();
    entry!(
        report,
        "inertia",
        "of the body about its mass centre: roll {x:.3e}, pitch {y:.3e}, yaw {z:.3e} kg m2"
    );
    report.value("inertia_roll_pitch_yaw_kg_m2", json!([x, y, z]));
    lift(report, e);
}

/// Three digits.
fn three(x: f64) -> String {
    match (1e-2..1e5).contains(&x) {
        true => fixed(x, (2 - x.log10().floor() as i32).max(0) as usize),
        false => format!("{x:.2e}"),
    }
}

/// A whole number; a small one with three digits.
fn whole(x: f64) -> String {
    match x < 10.0 {
        true => three(x),
        false => format!("{x:.0}"),
    }
}

/// How a wing moves, as far as it does.
fn motion(w: &WingEstimate) -> String {
    if w.hangs_free {
        return "on a free joint, its motion not known beforehand".to_owned();
    }
    let mut parts = vec![];
    if w.tip_speed > 0.0 {
        if w.stroke_amplitude > 0.0 {
            parts.push(format!("stroke {:.1} deg", w.stroke_amplitude.to_degrees()));
        }
        parts.push(format!("mean tip speed {:.3} m/s", w.tip_speed));
    }
    // Without motion it is zero, without viscosity no number.
    let reynolds = w.reynolds.filter(|re| re.is_finite() && *re > 0.0);
    parts.extend(reynolds.map(|re| format!("Reynolds number {}", whole(re))));
    let frequency = |k| format!("reduced frequency {k:.3}");
    parts.extend(w.reduced_frequency.map(frequency));
    match parts.is_empty() {
        true => "at rest on the body".to_owned(),
        false => parts.join(", "),
    }
}

/// Mean lift at the start, or why it is not known.
fn lift(report: &mut Report, e: &Estimate) {
    if let Some(lift) = e.lift_over_weight {
        entry!(
            report,
            "lift",
            "{lift:.2} weights: mean of a beat, estimated by blade elements with the body as it starts"
        );
    }
    if let Some(why) = &e.lift_left_out {
        entry!(
            report,
            "lift",
            "left out, no blade elements on trial: {why}"
        );
    }
    report.value("lift_over_weight", e.lift_over_weight);
}

/// What is known of a wing.
fn wing(w: &WingEstimate) -> Value {
    json!({
        "name": w.report.name,
        "length_m": w.report.length,
        "area_m2": w.report.area,
        "mean_chord_m": w.report.mean_chord,
        "r2_hat": w.report.r2_hat,
        "mass_kg": w.report.mass,
        "stroke_deg": w.stroke_amplitude.to_degrees(),
        "tip_speed_m_s": w.tip_speed,
        "reynolds_number": w.reynolds,
        "reduced_frequency": w.reduced_frequency,
        "first_frequency_hz": w.first_frequency,
        "first_frequency_over_wingbeat": w.frequency_ratio,
    })
}

/// What a flight will cost.
pub(crate) enum Cost {
    /// By some steps on trial.
    Tried {
        /// Time of the whole flight [s].
        time: f64,
        /// Threads that compute.
        threads: usize,
        /// Steps on trial.
        steps: usize,
        /// Wake rings and particles at the end.
        wake: f64,
    },
    /// Not known: a check starts no other program.
    External,
    /// Not known: so many unknown circulations take long.
    Unknowns(usize),
}

impl Cost {
    /// In numbers, units in the names; why there are none.
    pub fn value(&self) -> Value {
        match self {
            Self::Tried {
                time,
                threads,
                steps,
                wake,
            } => json!({
                "time_s": time,
                "threads": threads,
                "trial_steps": steps,
                "wake_elements_at_end": wake.round(),
            }),
            Self::External => json!({ "not_tried": self.to_string() }),
            Self::Unknowns(n) => json!({
                "not_tried": self.to_string(),
                "unknowns": n,
                "matrix_byte": matrix_bytes(*n),
            }),
        }
    }
}

impl Display for Cost {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tried {
                time: seconds,
                threads,
                steps,
                wake,
            } => {
                let time = time(*seconds);
                write!(
                    f,
                    "{time} on {threads} threads, from {steps} steps on trial"
                )?;
                match *wake {
                    0.0 => Ok(()),
                    wake => write!(f, ", {wake:.0} wake rings and particles at the end"),
                }
            }
            Self::External => f.write_str("not tried: a check does not start the external program"),
            Self::Unknowns(n) => write!(
                f,
                "not tried: {n} unknown circulations take long and {:.1} GB to solve for; `wingbeat check --trial` does",
                1e-9 * matrix_bytes(*n)
            ),
        }
    }
}

/// Memory of the matrix of so many unknown circulations [bytes].
fn matrix_bytes(unknowns: usize) -> f64 {
    8.0 * (unknowns as f64).powi(2)
}

/// Seconds that the whole flight will take and the largest wake, from some steps on trial.
///
/// # Errors
/// A step that fails.
pub(crate) fn cost(flight: &mut Simulation) -> Result<Cost, FlightError> {
    let mut pace = Pace::new(flight.setup());
    let begun = Instant::now();
    while !flight.finished() && begun.elapsed() < TRIAL {
        flight.step()?;
        pace.note(flight);
    }
    let steps = flight.state().step;
    let seconds = begun.elapsed().as_secs_f64() + pace.seconds_left(steps);
    Ok(Cost::Tried {
        time: seconds,
        threads: rayon::current_num_threads(),
        steps,
        wake: pace.largest_wake(steps),
    })
}

/// A year \[s\].
const YEAR: f64 = 365.25 * 86400.0;

/// About how long a time is, as people say it.
fn time(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "about a second".to_owned(),
        s if s < 100.0 => format!("about {s:.0} s"),
        s if s < 100.0 * 60.0 => format!("about {:.0} min", s / 60.0),
        s if s < 100.0 * 3600.0 => format!("about {:.0} h", s / 3600.0),
        s if s < 1000.0 * 86400.0 => format!("about {:.0} days", s / 86400.0),
        s if s < 1000.0 * YEAR => format!("about {:.0} years", s / YEAR),
        _ => "more than a thousand years".to_owned(),
    }
}
