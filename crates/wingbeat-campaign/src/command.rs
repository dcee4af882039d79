//! Commands for a shell: what flies a point by itself.

use std::fmt::Write as _;

use crate::campaign::Campaign;
use crate::plan::raw::Task;

/// The command that flies a point by itself; where it is trimmed, the trim first, and the flight if one is asked for.
pub fn command(campaign: &Campaign, i: usize) -> String {
    let trim = campaign.trim_options(i).ok().flatten();
    let verb = if trim.is_some() { "trim" } else { "run" };
    let case = &campaign.raw().case;
    let here = if case.starts_with('-') { "./" } else { "" }; // no option
    let mut text = format!("wingbeat {verb} {}", shell(&format!("{here}{case}")));
    for set in campaign.overrides(i) {
        let _ = write!(text, " --set {}", shell(&set)); // a string takes everything
    }
    let Some(trim) = trim else { return text };
    let numbers = [
        ("forward", trim.forward_m_s),
        ("climb", trim.climb_m_s),
        ("sideslip", trim.sideslip_m_s),
        ("turn-rate", trim.turn_rate_deg_s),
        ("steps", trim.steps_per_beat.map(|n| n as f64)),
    ];
    for (option, number) in numbers {
        if let Some(x) = number {
            let _ = write!(text, " --{option} {x}");
        }
    }
    if let Some(unknowns) = trim.unknowns {
        let _ = write!(text, " --unknowns {}", unknowns.join(" "));
    }
    text.push_str(" --write trimmed.toml");
    if campaign.raw().tasks.contains(&Task::Run) {
        text.push_str(" && wingbeat run trimmed.toml");
    }
    text
}

/// A word of a command line.
pub fn shell(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=+,:@%".contains(c);
    match !word.is_empty() && word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}
