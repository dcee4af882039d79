//! `wingbeat stabilise`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use wingbeat::analysis::control::{ControlledFlight, Controller, Free, Sampled};
use wingbeat::analysis::regulator::{Regulator, Weights};
use wingbeat::analysis::stabiliser::{ProportionalDerivative, Stiffness};
use wingbeat::analysis::{AnalysisError, Trim};
use wingbeat::case::write_new;
use wingbeat::draw::figures::stabilised::{BeatRow, stabilised};
use wingbeat::math::DVec3;

use super::{Trimming, Trouble, exit, trimmed, watched};
use crate::watch::Watch;

/// What `wingbeat stabilise` is told.
#[derive(Args)]
pub(crate) struct StabiliseArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Wingbeats to fly.
    #[arg(long, default_value_t = 100)]
    beats: usize,
    /// Disturbance of roll, pitch and heading at the start, degrees.
    #[arg(long, num_args = 3, value_names = ["ROLL", "PITCH", "HEADING"],
          default_values_t = [0.0, 10.0, 0.0], allow_negative_numbers = true)]
    tilt: Vec<f64>,
    /// Wingbeats between sensing and acting.
    #[arg(long, default_value_t = 2)]
    latency: usize,
    /// Wingbeats from one look to the next.
    #[arg(long, default_value_t = 1)]
    sample: usize,
    /// Which feedback.
    #[arg(long, value_enum, default_value_t = Feedback::Regulator)]
    controller: Feedback,
    /// Draw the flight as SVG; never over an existing file.
    #[arg(long, value_name = "FILE")]
    figure: Option<PathBuf>,
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

/// The whole command: beat by beat as CSV on the standard output.
pub(crate) fn run(args: &StabiliseArgs) -> ExitCode {
    exit(fly(args))
}

fn fly(args: &StabiliseArgs) -> Result<(), Trouble> {
    let (case, trim) = trimmed(&args.trimming)?;
    let controller = watched("feedback", || controller(args, &trim))?;
    let mut controller = Sampled::new(controller, args.sample);
    let tilt = DVec3::from_slice(&args.tilt).map(f64::to_radians);
    let mut flight = ControlledFlight::new(&trim, tilt, DVec3::ZERO, args.latency)?;
    let mut rows = vec![row(&flight)];
    let mut lost = None;
    let watch = Watch::of("flying under feedback", args.beats as u64);
    for _ in 0..args.beats {
        match flight.beat(&mut controller) {
            Ok(_) => rows.push(row(&flight)),
            Err(e) => {
                lost = Some(e);
                break;
            }
        }
        watch.part(|| {});
    }
    drop(watch);
    print(&rows);
    if let Some(path) = &args.figure {
        let svg = stabilised(&case.name, trim.beat.wing_length(), &rows);
        write_new(path, &svg)?;
    }
    lost.map_or(Ok(()), |e| Err(e.into()))
}

fn controller(args: &StabiliseArgs, trim: &Trim) -> Result<Box<dyn Controller>, AnalysisError> {
    Ok(match args.controller {
        Feedback::Free => Box::new(Free),
        Feedback::Pd => Box::new(ProportionalDerivative::new(trim, &Stiffness::default())?),
        Feedback::Regulator => Box::new(Regulator::new(trim, &Weights::default(), args.latency)?),
    })
}

/// What is seen at this beat.
fn row(flight: &ControlledFlight) -> BeatRow {
    let (s, acting) = (flight.sensed(), flight.acting());
    let (first, last) = (&acting[0], &acting[acting.len() - 1]);
    BeatRow {
        beat: s.beat,
        position: s.position,
        tilt: s.departure.tilt,
        amplitude: [first.stroke_amplitude, last.stroke_amplitude],
        offset: last.stroke_offset,
    }
}

fn print(rows: &[BeatRow]) {
    println!(
        "\nbeat,forward_mm,right_mm,down_mm,roll_deg,pitch_deg,heading_deg,stroke_amplitude_left,stroke_amplitude_right,stroke_offset_deg"
    );
    for r in rows {
        let (x, a) = (r.position * 1e3, r.tilt.map(f64::to_degrees));
        println!(
            "{},{:.5},{:.5},{:.5},{:.4},{:.4},{:.4},{:.5},{:.5},{:.4}",
            r.beat,
            x.x,
            x.y,
            x.z,
            a.x,
            a.y,
            a.z,
            r.amplitude[0],
            r.amplitude[1],
            r.offset.to_degrees()
        );
    }
}
