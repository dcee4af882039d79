//! `wingbeat stabilise`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use rayon::prelude::*;
use serde_json::{Value, json};
use wingbeat::analysis::control::{
    Held, Law, ProportionalDerivative, Reference, Regulator, SteeredBeats, Steering, Stiffness,
    Weights, disturbed, sides,
};
use wingbeat::analysis::episode::{Recovery, Tumbles};
use wingbeat::analysis::{AnalysisError, Perturbation, Trim};
use wingbeat::draw::figures::stabilised::{BeatRow, stabilised};
use wingbeat::flight::Controller;
use wingbeat::math::DVec3;
use wingbeat::results::fixed::fixed;

use super::trimming::{Trimming, trimmed, unused};
use super::tumbling;
use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, line};
use crate::command::output::target::Target;
use crate::command::progress::watch::{Watch, watched};

/// Wingbeats of a flight at most.
const MAX_BEATS: usize = 100_000;
/// Wingbeats between sensing and acting at most: the regulator remembers them all.
const MAX_LATENCY: usize = 20;
/// Tumbles at most.
const MAX_TUMBLES: usize = 10_000_000;
/// Wingbeats between sensing and acting unless told otherwise.
const DEFAULT_LATENCY: usize = 2;

/// Angle from the attitude of the trimmed flight within which a flyer is back \[deg\].
const BACK_DEG: f64 = 1.0;

/// Arguments of `wingbeat stabilise`.
#[derive(Args)]
pub(crate) struct StabiliseArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Wingbeats to fly.
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = options::count::<1, MAX_BEATS>)]
    beats: usize,
    /// Disturbance of roll, pitch and heading at the start, degrees: a turn about the mass centre that leaves the
    /// flight its velocity.
    #[arg(long, num_args = 3, value_names = ["ROLL", "PITCH", "HEADING"],
          default_values_t = [0.0, 10.0, 0.0], allow_negative_numbers = true,
          value_parser = options::degrees)]
    tilt: Vec<f64>,
    /// Wingbeats between sensing and acting [default: 2].
    #[arg(long, value_name = "BEATS", value_parser = options::count::<0, MAX_LATENCY>)]
    latency: Option<usize>,
    /// Wingbeats from one look to the next [default: 1].
    #[arg(long, value_name = "BEATS", value_parser = options::count::<1, MAX_BEATS>)]
    sample: Option<usize>,
    /// Which feedback.
    #[arg(long, value_enum, default_value_t = Feedback::Regulator)]
    controller: Feedback,
    /// Draw the flight as SVG; - is the standard output.
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
    /// Instead: so many flights out of random tumbles, and how many recover within --beats.
    #[arg(long, value_name = "N", value_parser = options::count::<1, MAX_TUMBLES>,
          conflicts_with_all = ["tilt", "sample", "figure"])]
    tumbles: Option<usize>,
    /// The first tumble's seed; the next ones count on [default: 1].
    #[arg(long, value_name = "SEED", requires = "tumbles", value_parser = options::seed)]
    seed: Option<u64>,
}

/// Which feedback.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Feedback {
    /// Discrete linear-quadratic regulator: holds attitude and place.
    Regulator,
    /// Proportional-derivative loops: pitch, roll, heading and altitude; for latencies up to 1.
    Pd,
    /// None.
    Free,
}

/// The whole command: how the flight went in sentences, then beat by beat as CSV.
pub(crate) fn run(args: &StabiliseArgs) -> Result<(), Failure> {
    let free = args.controller == Feedback::Free;
    for (option, given) in [("latency", args.latency), ("sample", args.sample)] {
        if free && given.is_some() {
            return Err(unused(option, "without feedback nothing is sensed"));
        }
    }
    args.trimming.without_turn("a flight that feedback holds")?;
    let report = &args.trimming.report;
    report.deliver([&args.figure], |report, [figure]| match args.tumbles {
        Some(count) => tumble(args, report, count),
        None => fly(args, report, figure),
    })
}

fn fly(args: &StabiliseArgs, report: &mut Report, figure: Option<Target>) -> Result<(), Failure> {
    let (case, trim) = trimmed(&args.trimming, report)?;
    let by = Perturbation {
        tilt: DVec3::from_slice(&args.tilt).map(f64::to_radians),
        ..Perturbation::default()
    };
    let latency = args.latency.unwrap_or(DEFAULT_LATENCY);
    let controller = watched("feedback", || controller(args, &trim, latency))?;
    let start = disturbed(&trim, &by);
    let mut flight = SteeredBeats::new(&trim, start, controller, latency)?;
    let steered = sides(&trim.setup);
    let mut rows = vec![row(&flight, &steered)];
    let (mut lost, mut limited) = (None, 0);
    let watch = Watch::of("flying under feedback", args.beats as u64);
    for _ in 0..args.beats {
        match flight.beat() {
            Ok(()) => {
                rows.push(row(&flight, &steered));
                limited += usize::from(flight.controller().is_some_and(|c| c.is_limited()));
            }
            Err(e) => {
                lost = Some(e);
                break;
            }
        }
        watch.part(|| {});
    }
    drop(watch);
    let length = trim.beat.wing_length();
    say(report, &rows, length, (args.controller, limited));
    if let Some(e) = &lost {
        line!(report, "  {e}");
    }
    tell(report, &rows);
    if let Some(file) = figure {
        file.write(&stabilised(&case.name, length, &rows))?;
        report.drew(&file);
    }
    lost.map_or(Ok(()), |e| Err(e.into()))
}

/// The feedback asked for.
fn controller(
    args: &StabiliseArgs,
    trim: &Trim,
    latency: usize,
) -> Result<Option<Steering>, AnalysisError> {
    let Some(law) = law(args, trim, latency)? else {
        return Ok(None);
    };
    let held = Held::Known(Reference::trimmed(trim)?);
    let mut steering = Steering::new(law, held, &trim.setup);
    steering.every = args.sample.unwrap_or(1);
    Ok(Some(steering))
}

/// The law of the feedback asked for.
fn law(args: &StabiliseArgs, trim: &Trim, latency: usize) -> Result<Option<Law>, AnalysisError> {
    Ok(match args.controller {
        Feedback::Free => None,
        Feedback::Pd => {
            let loops = ProportionalDerivative::new(trim, &Stiffness::default())?;
            Some(Law::Stabiliser(loops))
        }
        Feedback::Regulator => {
            let regulator = Regulator::new(trim, &Weights::default(), latency)?;
            Some(Law::Regulator(regulator))
        }
    })
}

/// Flights out of random tumbles, over all threads.
fn tumble(args: &StabiliseArgs, report: &mut Report, count: usize) -> Result<(), Failure> {
    let (_, trim) = trimmed(&args.trimming, report)?;
    let latency = args.latency.unwrap_or(DEFAULT_LATENCY);
    let law = watched("feedback", || law(args, &trim, latency))?;
    let tumbles = Tumbles::new(&trim, law, latency, args.beats)?;
    let first = args.seed.unwrap_or(1);
    let watch = Watch::of("flying out of tumbles", count as u64);
    let flown = (0..count as u64).into_par_iter().map(|k| {
        let recovery = tumbles.recovery(first.wrapping_add(k));
        watch.part(|| {});
        recovery
    });
    let recoveries: Result<Vec<Recovery>, AnalysisError> = flown.collect();
    drop(watch);
    tumbling::tell(report, &trim, first, &recoveries?);
    Ok(())
}

/// What is seen at this beat; the commands are those of the first wing of each side that is `steered`.
fn row(flight: &SteeredBeats, steered: &[Option<f64>]) -> BeatRow {
    let (d, acting) = (flight.departure(), flight.acting());
    let first = |side: f64| steered.iter().position(|s| *s == Some(side));
    let wings = [-1.0, 1.0].map(first);
    let offset = wings[1].or(wings[0]).map(|w| acting[w].stroke_offset);
    BeatRow {
        beat: flight.beats(),
        position: d.position,
        tilt: d.state.tilt,
        amplitude: wings.map(|w| w.map_or(0.0, |w| acting[w].stroke_amplitude)),
        offset: offset.unwrap_or(0.0),
    }
}

/// How the flight went, in sentences; `limited` beats had a command at a limit.
fn say(report: &mut Report, rows: &[BeatRow], length: f64, (feedback, limited): (Feedback, usize)) {
    let turn = |r: &BeatRow| r.tilt.length().to_degrees();
    let away = |r: &BeatRow| r.position.length() / length;
    let most = |of: &dyn Fn(&BeatRow) -> f64| rows.iter().map(of).fold(0.0, f64::max);
    let last = &rows[rows.len() - 1];
    line!(
        report,
        "\ndisturbed by {:.2} deg, {} wingbeats {}: at most {:.2} deg from its attitude and {:.2} wing lengths from its place, in the end {:.2} deg and {:.2} wing lengths",
        turn(&rows[0]),
        last.beat,
        match feedback {
            Feedback::Free => "without feedback",
            Feedback::Regulator | Feedback::Pd => "under feedback",
        },
        most(&turn),
        most(&away),
        turn(last),
        away(last)
    );
    let back = match rows.iter().rposition(|r| turn(r) >= BACK_DEG) {
        None => Some(0),
        Some(k) => rows.get(k + 1).map(|r| r.beat),
    };
    match back {
        Some(beats) => line!(
            report,
            "  within {BACK_DEG} deg of its attitude from beat {beats} on"
        ),
        None => line!(
            report,
            "  not within {BACK_DEG} deg of its attitude in the end"
        ),
    }
    report.value("within_a_degree_from_beat", back);
    if feedback != Feedback::Free {
        let part = limited as f64 / last.beat.max(1) as f64;
        line!(
            report,
            "  commands at their limits in {:.0} % of the wingbeats",
            100.0 * part
        );
        report.value("limited_part", part);
    }
}

fn tell(report: &mut Report, rows: &[BeatRow]) {
    line!(
        report,
        "\nbeat,forward_mm,right_mm,down_mm,roll_deg,pitch_deg,heading_deg,stroke_amplitude_left,stroke_amplitude_right,stroke_offset_deg"
    );
    for r in rows {
        let cells = [
            r.position.to_array().map(|x| fixed(1e3 * x, 5)),
            r.tilt.to_array().map(|x| fixed(x.to_degrees(), 4)),
            [
                fixed(r.amplitude[0], 5),
                fixed(r.amplitude[1], 5),
                fixed(r.offset.to_degrees(), 4),
            ],
        ];
        line!(report, "{},{}", r.beat, cells.concat().join(","));
    }
    let values: Vec<Value> = rows.iter().map(value).collect();
    report.value("beats", values);
}

fn value(r: &BeatRow) -> Value {
    json!({
        "beat": r.beat,
        "position_forward_right_down_m": r.position.to_array(),
        "tilt_roll_pitch_heading_rad": r.tilt.to_array(),
        "stroke_amplitude_change_left_right": r.amplitude,
        "stroke_offset_rad": r.offset,
    })
}
