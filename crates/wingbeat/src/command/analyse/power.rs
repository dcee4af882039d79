//! `wingbeat power`.

use clap::Args;
use serde_json::{Map, json};
use wingbeat::analysis::{Glide, Power, PowerQuantity, power_of_trim, power_with_wake};
use wingbeat::results::summary::prefix;

use super::trimming::{Trimming, trimmed, trimmed_with_wake};
use crate::command::options;
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, line};
use crate::command::progress::watch::watched;

/// Part of the aerodynamic power from which on the inertial one is said to be as good as the mass of the wings.
const INERTIAL: f64 = 0.25;

/// Arguments of `wingbeat power`.
#[derive(Args)]
pub(crate) struct PowerArgs {
    #[command(flatten)]
    trimming: Trimming,
    /// Actuators, flight muscle or motors, as a part of the mass of the whole flyer.
    #[arg(long, value_name = "SHARE", default_value_t = 0.3, value_parser = options::share)]
    muscle: f64,
}

/// The whole command.
pub(crate) fn run(args: &PowerArgs) -> Result<(), Failure> {
    let trimming = &args.trimming;
    trimming.report.deliver([], |report, []| {
        let found = if trimming.load()?.setup.has_memory() {
            let (_, trim) = trimmed_with_wake(trimming, report)?;
            if let Some(glide) = trim.glide() {
                tell_glide(report, &glide);
            }
            watched("power", || power_with_wake(&trim))?
        } else {
            let (_, trim) = trimmed(trimming, report)?;
            if let Some(glide) = trim.glide()? {
                tell_glide(report, &glide);
            }
            watched("power", || power_of_trim(&trim))?
        };
        tell(report, &found, args.muscle);
        Ok(())
    })
}

/// The power of what glides.
fn tell_glide(report: &mut Report, glide: &Glide) {
    let (scale, prefix) = prefix(glide.power.abs());
    line!(
        report,
        "  nothing beats, and height pays: weight times sink rate, {:.3} {}W",
        glide.power / scale,
        prefix.trim()
    );
    report.value("height_lost_watt", glide.power);
}

fn tell(report: &mut Report, p: &Power, muscle: f64) {
    line!(
        report,
        "\nMean mechanical power over the free wingbeat that was trimmed:"
    );
    let is_shown = |q: &PowerQuantity| q.name != "damping" || p.damping > 0.0;
    let rows = Power::QUANTITIES.into_iter().filter(is_shown);
    let rows: Vec<_> = rows.map(|q| (q.label, q.name, (q.of)(p))).collect();
    let largest = rows.iter().fold(0.0_f64, |m, row| m.max(row.2.abs()));
    let (scale, prefix) = prefix(largest);
    line!(
        report,
        "  {:<44}{:>10}{:>12}{:>14}",
        "",
        format!("{}W", prefix.trim()),
        "W/kg total",
        "W/kg actuator"
    );
    let mut values = Map::new();
    for (name, key, x) in rows {
        let (body, muscle) = (p.body_specific(x), p.muscle_specific(x, muscle));
        line!(
            report,
            "  {name:<44}{:>10.3}{body:>12.2}{muscle:>14.2}",
            x / scale
        );
        let value = json!({ "watt": x, "watt_per_kg_body": body, "watt_per_kg_muscle": muscle });
        values.insert(key.to_owned(), value);
    }
    line!(
        report,
        "  actuators (muscles, motors) counted as {muscle} of the mass of the whole flyer (--muscle)"
    );
    if p.inertial_positive > INERTIAL * p.aerodynamic {
        line!(
            report,
            "  the inertial part goes with the wings' mass and how it is spread along them: where these are\n  estimates (all cases of `wingbeat new`), so is the power without elastic storage"
        );
    }
    report.value("power", values);
    report.value("muscle_share", muscle);
}
