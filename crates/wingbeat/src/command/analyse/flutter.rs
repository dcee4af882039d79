//! `wingbeat flutter`.

mod table;

use std::f64::consts::TAU;
use std::sync::atomic::Ordering;

use clap::Args;
use serde_json::{Value, json};
use wingbeat::analysis::flutter::{
    Condition, ElasticRig, FlutterSettings, Onset, Steep, Vibration, by_wing, condition, crossings,
    growing, likely, steep,
};
use wingbeat::case::LoadedCase;

use self::table::{head, notes, tell};
use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::{Failure, INTERRUPTED};
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::output::terminal::tell as announce;
use crate::command::progress::watch::watched;
use crate::command::signals::stop_flag_after;

/// Arguments of `wingbeat flutter`.
#[derive(Args)]
#[command(
    mut_arg("case", |a| a.help("Case file or preset with elastic wings held in a stream; - is the standard input")),
    mut_arg("set", |a| a.help("Set a key of the case, e.g. air.density_kg_m3=1; KEY= takes it away (may be repeated)")),
)]
pub(crate) struct FlutterArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Speeds of the stream, m/s: from, to and their number, or one speed, whose modes are shown.
    #[arg(long, value_name = "FROM:TO:N", value_parser = options::speeds, allow_hyphen_values = true)]
    speeds: options::Speeds,
    /// Modes of the deformed wing that are disturbed.
    #[arg(long, value_name = "N", default_value_t = FlutterSettings::default().modes,
          value_parser = options::count::<1, 20>)]
    modes: usize,
    /// Amplitude of the disturbance over the length of the wing; made smaller where the response to it is not linear.
    #[arg(long, value_name = "SHARE", default_value_t = FlutterSettings::default().disturbance,
          value_parser = options::share)]
    disturbance: f64,
    /// Length of the response in periods of the first mode.
    #[arg(long, value_name = "PERIODS", default_value_t = FlutterSettings::default().periods,
          value_parser = options::positive)]
    periods: f64,
    /// Disturb wings that are mirror images against each other: one side up, the other down.
    #[arg(long)]
    antisymmetric: bool,
    #[command(flatten)]
    report: ReportArgs,
}

/// The whole command.
pub(crate) fn run(args: &FlutterArgs) -> Result<(), Failure> {
    let settings = FlutterSettings {
        modes: args.modes,
        disturbance: args.disturbance,
        periods: args.periods,
        antisymmetric: args.antisymmetric,
        ..FlutterSettings::default()
    };
    args.report.deliver([], |report, []| {
        let case = args.case.load()?;
        let mut found: Vec<Condition> = vec![];
        let asked = args.speeds.values().collect::<Vec<f64>>();
        report.value("asked_speeds_m_s", asked.clone());
        report.value("complete", false);
        if case.setup.air.keeps_wake() && ElasticRig::covers(&case.setup) {
            announce!(
                "{}: steady states and responses in a wake; a speed takes minutes on fine meshes",
                case.name
            );
        }
        let stop = stop_flag_after("this speed is finished");
        for (done, &speed) in asked.iter().enumerate() {
            if stop.load(Ordering::Relaxed) {
                conclude_all(report, &case, &found, false);
                report.value("missing_speeds_m_s", &asked[done..]);
                announce!(
                    "interrupted: {} of {} speeds were not tried",
                    asked.len() - done,
                    asked.len()
                );
                return Err(Failure::Told(INTERRUPTED));
            }
            let next = match watched("flutter", || condition(&case.setup, speed, &settings)) {
                Ok(next) => next,
                Err(error) => {
                    conclude_all(report, &case, &found, false);
                    report.value("missing_speeds_m_s", &asked[done..]);
                    report.value("error", error.to_string());
                    return Err(error.into());
                }
            };
            if found.is_empty() {
                head(report, &case.name, next.len() > 1);
            }
            let name = |c: &Condition| case.setup.animal.wings[c.steady.wing].name.as_str();
            for c in &next {
                tell(report, c, (next.len() > 1).then(|| name(c)));
            }
            found.extend(next);
            if !report.is_said_at_once() {
                announce!("{}: {} of {} speeds", case.name, done + 1, asked.len());
            }
            let all = found.iter().map(|c| values(c, name(c)));
            report.value("speeds", all.collect::<Vec<_>>());
        }
        conclude_all(report, &case, &found, true);
        report.value("complete", true);
        Ok(())
    })
}

fn values(c: &Condition, wing: &str) -> Value {
    let mode = |(m, u): (&Vibration, &f64)| {
        json!({
            "frequency_hz": m.frequency / TAU,
            "growth_per_s": m.growth,
            "growth_uncertainty_per_s": u,
            "damping_ratio": m.damping(),
            "share": m.share,
        })
    };
    let untold = |v: &Vibration| {
        json!({
            "appears_at_hz": v.frequency / TAU,
            "growth_per_s": v.growth,
            "share": v.share,
        })
    };
    json!({
        "wing": wing,
        "speed_m_s": c.speed,
        "tip_m": c.steady.tip.to_array(),
        "tip_turn_rad": c.steady.turn.to_array(),
        "tip_by_weight_m": c.steady.by_weight.map(|[tip, _]| tip.to_array()),
        "drift": c.steady.drift,
        "vacuum_hz": c.steady.vacuum.iter().map(|w| w / TAU).collect::<Vec<_>>(),
        "modes": c.modes.iter().zip(&c.uncertainty).map(mode).collect::<Vec<_>>(),
        "unknown_frequencies": c.untold.iter().map(untold).collect::<Vec<_>>(),
        "divergence_growth_per_s": c.divergence.map(|(motion, _)| motion.growth),
        "divergence_growth_uncertainty_per_s": c.divergence.map(|(_, uncertainty)| uncertainty),
        "order": c.response.order,
        "residual": c.response.residual,
        "nonlinearity": c.nonlinearity,
        "disturbance": c.disturbance,
        "response_s": c.length,
        "slow_joint": c.slow_joint.as_ref().map(|(joint, period)| json!({ "joint": joint, "period_s": period })),
    })
}

/// From which of the speeds on the wing diverges, if it does.
fn divergence(conditions: &[Condition]) -> Option<String> {
    let first = conditions.iter().position(Condition::diverges)?;
    let at = &conditions[first];
    let growth = at.divergence.map_or(f64::NAN, |(motion, _)| motion.growth);
    // Growth that is not known well enough may be positive already.
    let mut before = conditions[..first].iter().rev();
    let begins = match before.find(|c| c.divergence.is_none()) {
        Some(before) => format!("begins between {:.3} and {:.3} m/s", before.speed, at.speed),
        None => "begins below these speeds; try lower --speeds".to_owned(),
    };
    Some(format!(
        "Static divergence {begins}: at {:.3} m/s a motion grows at {growth:.3} per s and does not vibrate. A steady state found beyond is \
         one to which the wing has diverged, if it is not symmetric.",
        at.speed
    ))
}

/// That these `speeds` [m/s] are not to be relied on, and which onsets lie between speeds one of which is among them.
fn doubtful(speeds: &[f64], found: &[Onset]) -> Option<String> {
    let list = |of: &[f64]| {
        let numbers: Vec<String> = of.iter().map(|v| format!("{v:.3}")).collect();
        numbers.join(", ")
    };
    let beside = |c: &&Onset| {
        let [low, high] = c.between;
        speeds.iter().any(|v| (low..=high).contains(v))
    };
    let onsets: Vec<f64> = found.iter().filter(beside).map(|c| c.speed).collect();
    let hence = match (found.is_empty(), onsets.is_empty()) {
        (true, _) => String::new(),
        (false, true) => "; what begins and ends above lies between other speeds".to_owned(),
        (false, false) => format!(", and with them what is found at {} m/s", list(&onsets)),
    };
    (!speeds.is_empty()).then(|| {
        format!(
            "Not to be relied on at {} m/s: see the notes above{hence}.",
            list(speeds)
        )
    })
}

/// What follows for each wing, of all speeds or of those before one that failed.
fn conclude_all(report: &mut Report, case: &LoadedCase, found: &[Condition], is_complete: bool) {
    let wings = by_wing(found);
    let (mut onsets, mut rises) = (vec![], vec![]);
    for of_wing in &wings {
        let wing = &case.setup.animal.wings[of_wing[0].steady.wing].name;
        if wings.len() > 1 {
            line!(report, "\nThe wing `{wing}`:");
        }
        conclude(report, of_wing, &crossings(of_wing), is_complete);
        onsets.extend(onset_values(of_wing, wing));
        let steep = steep(of_wing);
        if let Some(text) = rise(&steep) {
            line!(report, "\n{text}");
        }
        rises.extend(steep.iter().map(|s| rise_value(s, wing)));
    }
    if !found.is_empty() {
        report.value("flutter", onsets);
        report.value("steep_deflections", rises);
    }
}

/// That a steady deflection grows as about static divergence, though no motion need grow.
fn rise(steep: &[Steep]) -> Option<String> {
    let (first, last) = (steep.first()?, steep.last()?);
    let (low, high) = (first.between[0], last.between[1]);
    // The line through the lowest speeds: deflections are smallest there.
    let at = match steep.iter().find_map(|s| s.divergence) {
        Some(speed) => {
            format!("about {speed:.2} m/s, of Southwell's line through q over deflection")
        }
        None => "lower speeds, whose deflections are small, tell where".to_owned(),
    };
    Some(format!(
        "The steady deflection grows much faster than the dynamic pressure: at the tip, but for that by weight, from {:.3e} m at {low:.3} m/s to {:.3e} m at {high:.3} m/s, where the pressure grows {:.2} times. \
         Wings with incidence pass static divergence in this way, bending far without a motion that grows ({at}).",
        first.tip[0],
        last.tip[1],
        (high / low).powi(2)
    ))
}

fn rise_value(steep: &Steep, wing: &str) -> Value {
    json!({
        "wing": wing,
        "between_m_s": steep.between,
        "tip_m": steep.tip,
        "divergence_m_s": steep.divergence,
    })
}

/// Onsets and ends, certain or likely.
fn onset_values(conditions: &[Condition], wing: &str) -> Vec<Value> {
    let value = |(c, certain): (Onset, bool)| {
        json!({
            "wing": wing,
            "certain": certain,
            "begins": c.begins,
            "speed_m_s": c.speed,
            "frequency_hz": c.frequency / TAU,
            "between_m_s": c.between,
        })
    };
    let certain = crossings(conditions).into_iter().map(|c| (c, true));
    let likely = likely(conditions).into_iter().map(|c| (c, false));
    certain.chain(likely).map(value).collect()
}

fn conclude(report: &mut Report, conditions: &[Condition], found: &[Onset], is_complete: bool) {
    match conditions {
        [c] => line!(report, "\n{}", alone(c)),
        _ => between(report, conditions, found, is_complete),
    }
    let noted = conditions.iter().filter(|c| !notes(c).is_empty());
    let speeds: Vec<f64> = noted.map(|c| c.speed).collect();
    if let Some(text) = doubtful(&speeds, found) {
        line!(report, "\n{text}");
    }
    if let Some(text) = neutral(conditions) {
        line!(report, "\n{text}");
    }
}

/// What follows of one speed.
fn alone(c: &Condition) -> String {
    let grow = (0..c.modes.len()).filter(|k| c.grows(*k) == Some(true));
    let mut grow: Vec<String> = grow
        .map(|k| format!("the mode of {:.3} Hz grows", c.modes[k].frequency / TAU))
        .collect();
    if c.diverges() {
        grow.push("a motion grows that does not vibrate (static divergence)".into());
    }
    let what = match grow.is_empty() {
        true => "no growth is positive, beyond what is known of it".into(),
        false => grow.join(", "),
    };
    format!(
        "At {:.3} m/s {what}. Where flutter begins takes two speeds or more: --speeds FROM:TO:N.",
        c.speed
    )
}

/// Speeds this far apart, over the onset between them, tell it coarsely \[1\]: growth over speed is no straight line.
const WIDE: f64 = 0.1;

/// Onsets and ends between speeds.
fn between(report: &mut Report, conditions: &[Condition], found: &[Onset], is_complete: bool) {
    for c in found {
        let what = if c.begins { "begins" } else { "ends" };
        line!(
            report,
            "\nFlutter {what} at {:.3} m/s with {:.3} Hz, between {:.3} and {:.3} m/s.",
            c.speed,
            c.frequency / TAU,
            c.between[0],
            c.between[1]
        );
        if c.between[1] - c.between[0] > WIDE * c.speed {
            line!(
                report,
                "Growth was taken as a straight line between these two; --speeds {}:{}:5 looks closer.",
                c.between[0],
                c.between[1]
            );
        }
    }
    let likely = likely(conditions);
    for c in &likely {
        line!(
            report,
            "\nFlutter begins at about {:.3} m/s with {:.3} Hz: at {:.3} m/s growth is neutral within what is known (+-), at {:.3} m/s it is positive. Lower --speeds make it certain.",
            c.speed,
            c.frequency / TAU,
            c.between[0],
            c.between[1]
        );
    }
    let through = growing(conditions);
    for [first, last] in &through {
        line!(
            report,
            "\nGrowth is positive at all these speeds: the mode of {:.3} Hz at the first of them, {:.3} Hz at the last. Flutter begins below; try lower --speeds.",
            first.frequency / TAU,
            last.frequency / TAU
        );
    }
    if let Some(text) = divergence(conditions) {
        line!(report, "\n{text}");
    }
    if found.is_empty() && likely.is_empty() && through.is_empty() {
        line!(report, "\n{}", unchanged(conditions, is_complete));
    }
}

/// That growth that is not known well enough counts for nothing, where there is such growth.
fn neutral(conditions: &[Condition]) -> Option<String> {
    let modes = |c: &Condition| (0..c.modes.len()).any(|k| c.grows(k).is_none());
    let motion = |c: &Condition| c.divergence.is_some() && !c.diverges();
    let of = match (conditions.iter().any(modes), conditions.iter().any(motion)) {
        (false, false) => return None,
        (true, false) => "Modes",
        (false, true) => "Motions that do not vibrate (none in the column Hz)",
        (true, true) => "Modes, and motions that do not vibrate (none in the column Hz),",
    };
    Some(format!(
        "{of} whose growth is smaller than what is not known of it (+-) are neutral within what is known: they count for no onset."
    ))
}

/// What is said where no growth changes its sign and none is positive throughout, at all speeds that were asked
/// for or only at those of `conditions`.
fn unchanged(conditions: &[Condition], is_complete: bool) -> String {
    let at = match is_complete {
        true => "at any of these speeds".to_owned(),
        false => {
            let last = conditions.last().map_or(f64::NAN, |c| c.speed);
            format!(
                "up to {last:.3} m/s; nothing is known of the speeds beyond, which were not reached"
            )
        }
    };
    let grows = |c: &&Condition| (0..c.modes.len()).any(|k| c.grows(k) == Some(true));
    let speeds = conditions.iter().filter(grows);
    let speeds: Vec<String> = speeds.map(|c| format!("{:.3}", c.speed)).collect();
    match speeds.is_empty() {
        true if conditions.iter().any(Condition::diverges) => {
            format!("No vibration grows, beyond what is known of it, {at}.")
        }
        true => format!("No growth is positive, beyond what is known of it, {at}."),
        false => format!(
            "Growth is positive at {} m/s, but its mode cannot be followed to other speeds: try --speeds that lie closer together.",
            speeds.join(", ")
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn behaves_an_onset_is_doubted_if_one_of_the_speeds_about_it_is() {
        let onset = |between: [f64; 2]| Onset {
            begins: true,
            speed: between[0].midpoint(between[1]),
            frequency: 1.0,
            between,
        };
        let found = [onset([30.0, 34.0])];
        assert_eq!(doubtful(&[], &found), None);
        let said = |speed: f64| doubtful(&[speed], &found).expect("a doubt");
        assert!(
            said(40.0).contains("at 40.000 m/s")
                && said(40.0).contains("lies between other speeds")
        );
        // 32 m/s, at which the mode is neutral, was passed over.
        for speed in [30.0, 32.0, 34.0] {
            assert!(
                said(speed).contains("with them what is found at 32.000 m/s"),
                "{speed}"
            );
        }
        assert!(
            !doubtful(&[40.0], &[])
                .expect("a doubt")
                .contains("other speeds")
        );
    }
}
