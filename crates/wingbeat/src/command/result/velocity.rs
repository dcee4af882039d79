//! `wingbeat velocity`: the velocity of the air at points, on a line or on a plane, from a run.

use std::path::PathBuf;

use clap::Args;
use indicatif::ProgressBar;
use serde_json::{Value, json};
use wingbeat::Error;
use wingbeat::air::Points;
use wingbeat::case::IoError;
use wingbeat::flight::{AirModel, Simulation};
use wingbeat::math::DVec3;
use wingbeat::results::{ResultDir, saver};

use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::output::terminal::tell;

/// Points at most.
const MAX_POINTS: usize = 1_000_000;
/// Points that are computed at once: a second or so in a long wake.
const BLOCK: usize = 4096;
/// Nothing is farther from the origin [m]; squares and cubes of it are still numbers.
const FARTHEST: f64 = 1e9;

/// Arguments of `wingbeat velocity`. Places are in inertial axes (n3 down), in metres.
#[derive(Args)]
pub(crate) struct VelocityArgs {
    /// Result directory of a run; its checkpoint is taken (a finished run has one with
    /// output.keep_checkpoint = true).
    dir: PathBuf,
    /// A point x,y,z (may be repeated).
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    point: Vec<DVec3>,
    /// Points on the line from the first to the second `--corner`, this many.
    #[arg(long, value_name = "N", conflicts_with = "plane",
          value_parser = options::count::<2, MAX_POINTS>)]
    line: Option<usize>,
    /// Points on the parallelogram with the first `--corner` between the second and third one,
    /// this many along either side: MxN.
    #[arg(long, value_name = "MxN", value_parser = counts, allow_hyphen_values = true)]
    plane: Option<[usize; 2]>,
    /// A corner x,y,z: two for a line, three for a plane.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    corner: Vec<DVec3>,
    #[command(flatten)]
    report: ReportArgs,
}

fn place(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|w| w.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|c| c.abs() <= FARTHEST) => Ok(DVec3::new(x, y, z)),
        _ => Err(format!(
            "give three numbers in metres from -{FARTHEST:e} to {FARTHEST:e}, e.g. 0.001,0,-0.002"
        )),
    }
}

fn counts(text: &str) -> Result<[usize; 2], String> {
    let numbers: Option<Vec<usize>> = text.split('x').map(|w| w.parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[m, n]) if m > 1 && n > 1 && m.saturating_mul(n) <= MAX_POINTS => Ok([m, n]),
        _ => Err(format!(
            "give two whole numbers above 1, at most {MAX_POINTS} points in all, e.g. 40x30"
        )),
    }
}

/// All places that are asked for, or what is missing.
fn places(args: &VelocityArgs) -> Result<Vec<DVec3>, Failure> {
    let mut places: Vec<DVec3> = args.point.clone();
    let part = |k: usize, n: usize| k as f64 / (n - 1) as f64;
    match (args.line, args.plane, args.corner.as_slice()) {
        (None, None, []) => {}
        (Some(n), None, &[a, b]) => places.extend((0..n).map(|k| a.lerp(b, part(k, n)))),
        (None, Some([m, n]), &[a, b, c]) => {
            let at = |i: usize, j: usize| a + part(i, m) * (b - a) + part(j, n) * (c - a);
            places.extend((0..m).flat_map(|i| (0..n).map(move |j| at(i, j))));
        }
        _ => {
            let problem = "give --line N with two corners, or --plane MxN with three";
            return Err(Failure::Option(problem.to_owned()));
        }
    }
    match places.is_empty() {
        true => Err(Failure::Option(
            "give --point, --line or --plane".to_owned(),
        )),
        false => Ok(places),
    }
}

/// The whole command.
pub(crate) fn run(args: &VelocityArgs) -> Result<(), Failure> {
    let places = places(args)?;
    args.report.deliver([], |report, []| {
        let flight = flight(args)?;
        let field = Field {
            velocities: velocities(&flight, &places)?,
            in_air: flight.is_in_air(&places),
            places,
        };
        field.tell(report, flight.newest_time());
        Ok(())
    })
}

/// The flight as its checkpoint has it.
fn flight(args: &VelocityArgs) -> Result<Simulation, IoError> {
    let dir = ResultDir::open(&args.dir)?;
    let saved = saver::read(dir.path())?;
    let case = dir.case()?;
    let damaged = |problem: String| IoError::Damaged {
        path: dir.join("checkpoint.bin"),
        problem,
    };
    if !matches!(case.setup.air, AirModel::VortexLattice(_)) {
        return Err(IoError::Damaged {
            path: dir.path().to_owned(),
            problem: "the run has no vortex lattice, so it has no field of velocities".to_owned(),
        });
    }
    let Some((_, state)) = saved.checkpoint else {
        let problem = "there is none; run the case with --set output.keep_checkpoint=true";
        return Err(damaged(problem.to_owned()));
    };
    Simulation::resume(case.unasked(), state)
        .map_err(|e| damaged(format!("the flight cannot go on from it: {e}")))
}

/// Velocities at the places, block by block under a bar.
fn velocities(flight: &Simulation, places: &[DVec3]) -> Result<Vec<DVec3>, Failure> {
    let bar = match places.len() > BLOCK {
        true => ProgressBar::new(places.len() as u64),
        false => ProgressBar::hidden(),
    };
    let mut all = Vec::with_capacity(places.len());
    for block in places.chunks(BLOCK) {
        let points: Points = block.iter().copied().collect();
        let sampled = flight.air_velocity(&points).map_err(Error::from)?;
        all.extend(sampled.iter().flat_map(|v| v.iter()));
        bar.set_position(all.len() as u64);
    }
    bar.finish_and_clear();
    let bad = all.iter().position(|v| !v.is_finite());
    match bad.or((all.len() < places.len()).then_some(all.len())) {
        Some(k) => Err(Failure::Option(format!(
            "the velocity at {} is not a number; ask for another point",
            places[k]
        ))),
        None => Ok(all),
    }
}

/// What is asked for, place by place.
struct Field {
    places: Vec<DVec3>,
    velocities: Vec<DVec3>,
    in_air: Vec<bool>,
}

impl Field {
    fn tell(&self, report: &mut Report, time: f64) {
        tell!("velocity at t = {time:e} s");
        let outside = self.in_air.iter().filter(|is| !**is).count();
        if outside > 0 {
            tell!(
                "warning: {outside} of {} points lie in a body part or beyond the ground (in_air = 0): what is said there is no velocity of any air",
                self.places.len()
            );
        }
        line!(
            report,
            "x_m,y_m,z_m,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,in_air"
        );
        let mut points: Vec<Value> = vec![];
        let both = self.places.iter().zip(&self.velocities);
        for ((x, v), is_in_air) in both.zip(&self.in_air) {
            let cells = [x.x, x.y, x.z, v.x, v.y, v.z].map(|c| format!("{:e}", c + 0.0)); // no -0
            line!(report, "{},{}", cells.join(","), u8::from(*is_in_air));
            points.push(json!({
                "position_m": x.to_array(),
                "velocity_m_s": v.to_array(),
                "in_air": is_in_air,
            }));
        }
        report.value("time_s", time);
        report.value("points", points);
    }
}
