//! `wingbeat stabilise`.

use std::process::ExitCode;

use clap::Args;
use wingbeat::analysis::control::{ControlledFlight, Controller, Free};
use wingbeat::analysis::regulator::{Regulator, Weights};
use wingbeat::math::DVec3;

use super::{Trimming, Trouble, exit, trimmed};

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
    /// Fly without feedback.
    #[arg(long)]
    free: bool,
}

/// The whole command: beat by beat as CSV on the standard output.
pub(crate) fn run(args: &StabiliseArgs) -> ExitCode {
    exit(fly(args))
}

fn fly(args: &StabiliseArgs) -> Result<(), Trouble> {
    let (_, trim) = trimmed(&args.trimming)?;
    let tilt = DVec3::from_slice(&args.tilt).map(f64::to_radians);
    let mut free = Free;
    let mut regulator;
    let controller: &mut dyn Controller = if args.free {
        &mut free
    } else {
        regulator = Regulator::new(&trim, &Weights::default(), args.latency)?;
        &mut regulator
    };
    let mut flight = ControlledFlight::new(&trim, tilt, DVec3::ZERO, args.latency);
    println!(
        "\nbeat,forward_mm,right_mm,down_mm,roll_deg,pitch_deg,heading_deg,stroke_amplitude_left,stroke_amplitude_right,stroke_offset_deg"
    );
    for _ in 0..args.beats {
        let s = *flight.beat(controller)?;
        let (x, a) = (s.position * 1e3, s.departure.tilt.map(f64::to_degrees));
        let wing = |k: usize| flight.acting()[k];
        let last = flight.acting().len() - 1;
        println!(
            "{},{:.5},{:.5},{:.5},{:.4},{:.4},{:.4},{:.5},{:.5},{:.4}",
            s.beat,
            x.x,
            x.y,
            x.z,
            a.x,
            a.y,
            a.z,
            wing(0).stroke_amplitude,
            wing(last).stroke_amplitude,
            wing(last).stroke_offset.to_degrees()
        );
    }
    Ok(())
}
