//! Commands for a shell: what flies a point by itself.

use std::fmt::Write as _;
use std::path::Path;

use wingbeat_case::{shell, shell_path};

use crate::campaign::Campaign;
use crate::plan::raw::Task;
use crate::plan::trimming::TRIM;
use crate::plan::value::Value;

/// The command that flies a point by itself, in the folder in which the campaign is run; where it is trimmed, the trim first, and the flight if one is asked for.
/// What the trim refuses stands there as it is.
pub fn command(campaign: &Campaign, i: usize) -> String {
    let raw = campaign.raw();
    let is_trimmed = raw.tasks.contains(&Task::Trim);
    let verb = if is_trimmed { "trim" } else { "run" };
    let origin = campaign.base().origin();
    let case = match origin.strip_prefix("preset ") == Some(&raw.case) {
        true => &raw.case,
        false => origin,
    };
    let mut text = format!("wingbeat {verb} {}", shell_path(Path::new(case)));
    for set in campaign.overrides(i) {
        let _ = write!(text, " --set {}", shell(&set)); // a string takes everything
    }
    if !is_trimmed {
        return text;
    }
    let of_all = raw.trim.clone().unwrap_or_default();
    let numbers = [
        ("forward", "forward_m_s", of_all.forward_m_s),
        ("climb", "climb_m_s", of_all.climb_m_s),
        ("sideslip", "sideslip_m_s", of_all.sideslip_m_s),
        ("turn-rate", "turn_rate_deg_s", of_all.turn_rate_deg_s),
        (
            "steps",
            "steps_per_beat",
            of_all.steps_per_beat.map(|n| n as f64),
        ),
    ];
    for (option, key, number) in numbers {
        let varied = campaign.plan().value(&format!("{TRIM}{key}"), i);
        if let Some(value) = varied.or(number.map(Value::Number)) {
            let word = value
                .number()
                .map_or_else(|| value.shown(), |x| x.to_string());
            let _ = write!(text, " --{option} {}", shell(&word));
        }
    }
    if let Some(unknowns) = of_all.unknowns {
        let _ = write!(text, " --unknowns {}", unknowns.join(" "));
    }
    let _ = write!(text, " --write trimmed-{i}.toml");
    if raw.tasks.contains(&Task::Run) {
        let _ = write!(text, " && wingbeat run trimmed-{i}.toml");
    }
    text
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Of an axis of 41 values the second is not tried beforehand: its command trims, and is refused as the point was.
    #[test]
    fn behaves_the_command_of_a_refused_trim_is_a_trim() {
        let file =
            std::env::temp_dir().join(format!("wingbeat-command-{}.toml", std::process::id()));
        let speeds: Vec<f64> = (0..41)
            .map(|k| if k == 1 { 400.0 } else { 0.01 * f64::from(k) })
            .collect();
        let text = format!(
            "case = \"fruit-fly-blade\"\ndo = [\"trim\"]\nkeep = [\"trim.residual\"]\n[trim]\nclimb_m_s = -0.5\n[parameter.\"trim.forward_m_s\"]\nlist = {speeds:?}\n"
        );
        fs::write(&file, text).unwrap();
        let campaign = Campaign::read(&file).unwrap();
        fs::remove_file(&file).unwrap();
        assert!(campaign.trim_options(1).is_err());
        let words = [1, 2].map(|i| command(&campaign, i));
        let of = |i: usize, speed: f64| {
            format!(
                "wingbeat trim fruit-fly-blade --forward {speed} --climb -0.5 --write trimmed-{i}.toml"
            )
        };
        assert_eq!(words, [of(1, 400.0), of(2, 0.02)]);
    }
}
