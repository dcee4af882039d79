//! `wingbeat velocity`: the velocity of the air at points, on a line or on a plane, from a run.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use wingbeat::air::Points;
use wingbeat::case::IoError;
use wingbeat::flight::Simulation;
use wingbeat::math::DVec3;
use wingbeat::results::{ResultDir, saver};

use crate::refuse;

/// What `wingbeat velocity` is told. Places are in inertial axes (n3 down), in metres.
#[derive(Args)]
pub(crate) struct VelocityArgs {
    /// Result directory of a run; its checkpoint is taken (a finished run has one with
    /// output.keep_checkpoint = true).
    dir: PathBuf,
    /// A point x,y,z (may be repeated).
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    point: Vec<DVec3>,
    /// Points on the line from the first to the second `--corner`, this many.
    #[arg(long, value_name = "N", conflicts_with = "plane")]
    line: Option<usize>,
    /// Points on the parallelogram with the first `--corner` between the second and third one,
    /// this many along either side: MxN.
    #[arg(long, value_name = "MxN", value_parser = counts)]
    plane: Option<[usize; 2]>,
    /// A corner x,y,z: two for a line, three for a plane.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    corner: Vec<DVec3>,
    /// CSV file to write; default the terminal.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

fn place(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|w| w.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if (x + y + z).is_finite() => Ok(DVec3::new(x, y, z)),
        _ => Err("give three finite numbers in metres, e.g. 0.001,0,-0.002".to_owned()),
    }
}

fn counts(text: &str) -> Result<[usize; 2], String> {
    let numbers: Option<Vec<usize>> = text.split('x').map(|w| w.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[m, n]) if m > 1 && n > 1 => Ok([m, n]),
        _ => Err("give two whole numbers above 1, e.g. 40x30".to_owned()),
    }
}

/// All places that are asked for, or what is missing.
fn places(args: &VelocityArgs) -> Result<Points, String> {
    let mut places: Vec<DVec3> = args.point.clone();
    let part = |k: usize, n: usize| k as f64 / (n - 1) as f64;
    match (args.line, args.plane, args.corner.as_slice()) {
        (None, None, []) => {}
        (Some(n), None, &[a, b]) if n > 1 => places.extend((0..n).map(|k| a.lerp(b, part(k, n)))),
        (None, Some([m, n]), &[a, b, c]) => {
            let at = |i: usize, j: usize| a + part(i, m) * (b - a) + part(j, n) * (c - a);
            places.extend((0..m).flat_map(|i| (0..n).map(move |j| at(i, j))));
        }
        _ => {
            return Err(
                "give --line N (above 1) with two corners, or --plane MxN with three".to_owned(),
            );
        }
    }
    match places.is_empty() {
        true => Err("give --point, --line or --plane".to_owned()),
        false => Ok(places.into_iter().collect()),
    }
}

/// The whole command.
pub(crate) fn run(args: &VelocityArgs) -> ExitCode {
    let places = match places(args) {
        Ok(places) => places,
        Err(problem) => {
            eprintln!("error: {problem}");
            return ExitCode::from(2);
        }
    };
    let table = match table(args, &places) {
        Ok(table) => table,
        Err(e) => return refuse(&e),
    };
    match &args.out {
        None => print!("{table}"),
        Some(file) => {
            if let Err(e) = std::fs::write(file, table) {
                eprintln!(
                    "error: {}: {e}; name a file that can be written",
                    file.display()
                );
                return ExitCode::from(2);
            }
        }
    }
    ExitCode::SUCCESS
}

fn table(args: &VelocityArgs, places: &Points) -> Result<String, IoError> {
    let dir = ResultDir::open(&args.dir)?;
    let saved = saver::read(dir.path())?;
    let case = dir.case()?;
    let damaged = |problem: String| IoError::Damaged {
        path: dir.join("checkpoint.bin"),
        problem,
    };
    let Some((_, state)) = saved.checkpoint else {
        return Err(damaged(
            "there is none; run the case with --set output.keep_checkpoint=true".to_owned(),
        ));
    };
    let flight = Simulation::resume(case.setup.clone(), state)
        .map_err(|e| damaged(format!("the flight cannot go on from it: {e}")))?;
    let velocity = flight
        .air_velocity(places)
        .ok_or_else(|| damaged("the run has no vortex lattice".to_owned()))?;
    eprintln!("velocity at t = {:e} s", flight.newest_time());
    let mut text = String::from("x_m,y_m,z_m,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s\n");
    for (x, v) in places.iter().zip(velocity.iter()) {
        let cells = [x.x, x.y, x.z, v.x, v.y, v.z].map(|c| format!("{c:e}"));
        let _ = writeln!(text, "{}", cells.join(","));
    }
    Ok(text)
}
