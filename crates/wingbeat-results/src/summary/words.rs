//! The summary in words.

use std::fmt::Write as _;

use wingbeat_math::larger;

use super::beats::BeatMeans;
use super::bent::BentWing;
use super::estimate::Estimate;
use super::impulse::ImpulseBudget;
use super::last_part::LastPart;
use super::means::ManyBeats;
use super::numbers::Summary;
use crate::Outcome;
use crate::common::fixed::{fixed, signed, signed_or_power};

impl Summary {
    /// For people; the verdict comes first, its word in front.
    pub fn to_text(&self) -> String {
        let mut out = format!("{}: {}", self.verdict.word(), self.verdict_reason);
        let drifts = |m: &ManyBeats| !m.is_steady && m.is_known && !m.changes_within_error();
        // A reason may end with a question.
        out.push_str(if out.ends_with('?') { "" } else { "." });
        if self.means.as_ref().is_some_and(drifts) {
            out.push_str(" The means over its beats are NOT steady.");
        }
        out.push('\n');
        self.headline(&mut out);
        self.beat_table(&mut out);
        self.balances(&mut out);
        out.push_str("\nHow far to trust it\n");
        for warning in &self.warnings {
            out.push_str(&wrapped("  - ", warning));
        }
        out
    }

    fn headline(&self, out: &mut String) {
        let end = match &self.outcome {
            Outcome::Finished => "flew to its end".to_owned(),
            Outcome::Interrupted => {
                "was interrupted; everything up to there is written, and `wingbeat resume` takes it up again"
                    .to_owned()
            }
            Outcome::Unwritten(why) => format!("stopped because {why}"),
            Outcome::Failed(why) => format!("ended early: {why}"),
            Outcome::Running => "is running".to_owned(),
        };
        let _ = writeln!(
            out,
            "{} {end}: {} steps, {}.",
            self.case,
            self.steps,
            match self.time_s {
                t if t < 0.01 => alone(t, "s"),
                t => format!("{t:.4} s"),
            }
        );
        let [x, y, z] = self.displacement_m.map(|d| d * 1e3);
        let [x, y, z] =
            [x, y, if self.has_n3_down() { -z } else { z }].map(|d| signed_or_power(d, 3));
        let _ = match self.has_n3_down() {
            true => writeln!(
                out,
                "The body moved {x} mm forward (n1), {y} mm right (n2), {z} mm up;"
            ),
            false => writeln!(
                out,
                "The body moved {x} mm along n1, {y} mm along n2, {z} mm along n3;"
            ),
        };
        let [pitch, yaw, roll] = self.turn_deg;
        let _ = writeln!(
            out,
            "it turned {} deg in pitch, {} in yaw, {} in roll (Euler 2-3-1).",
            signed_or_power(pitch, 2),
            signed_or_power(yaw, 2),
            signed_or_power(roll, 2)
        );
        if let Some(text) = self.bent() {
            out.push_str(&wrapped("", &text));
        }
    }

    /// How far the elastic wing that was bent most was bent; none where no wing is elastic.
    fn bent(&self) -> Option<String> {
        let size = |w: &&BentWing| w.tip_displacement_relative;
        let most = self
            .elastic_wings
            .iter()
            .max_by(|a, b| size(a).total_cmp(&size(b)))?;
        let of = match self.elastic_wings.len() {
            1 => String::new(),
            count => format!(", most of the {count} elastic wings"),
        };
        Some(format!(
            "Loads displaced the tip of the wing `{}`{of}, by up to {} ({} of its length) and twisted it by up to {} deg.",
            most.wing,
            alone(most.tip_displacement_m, "m"),
            fixed(most.tip_displacement_relative, 3),
            fixed(most.tip_twist_deg, 2)
        ))
    }

    fn beat_table(&self, out: &mut String) {
        let no_air = self.final_lift_newton == 0.0 && self.final_thrust_newton == 0.0;
        if !no_air {
            let _ = writeln!(
                out,
                "At the last instant lift is {} and thrust {}.",
                alone(self.final_lift_newton, "N"),
                alone(self.final_thrust_newton, "N")
            );
        }
        if let Some(text) = self.last_part.as_ref().and_then(last_coefficients) {
            out.push_str(&wrapped("", &text));
        }
        if self.beats.is_empty() {
            return;
        }
        out.push_str("\n beat   lift/weight      lift       forward      power\n");
        let largest = self.largest_of_beats();
        for b in &self.beats {
            let ratio = b
                .mean
                .lift_over_weight
                .map_or("-".to_owned(), |r| fixed(r, 3));
            let _ = writeln!(
                out,
                "{:5}   {ratio:>11}   {}   {}   {}",
                b.beat,
                in_column(b.mean.lift_newton, largest[0], "N"),
                in_column(b.mean.thrust_newton, largest[1], "N"),
                in_column(b.mean.power_watt, largest[2], "W")
            );
        }
        if let Some(means) = &self.means {
            mean_rows(means, largest, out);
        }
        let said = [self.specific_power(), self.coefficients()];
        for text in said.into_iter().flatten() {
            out.push_str(&wrapped("       ", &text));
        }
    }

    /// Largest size of lift \[N\], thrust \[N\] and power \[W\] over the beats: its prefix is that of the column.
    fn largest_of_beats(&self) -> [f64; 3] {
        self.beats.iter().fold([0.0; 3], |largest, b| {
            let of_beat = [b.mean.lift_newton, b.mean.thrust_newton, b.mean.power_watt];
            std::array::from_fn(|k| larger(largest[k], of_beat[k].abs()))
        })
    }

    /// Power over the mass, of the mean or of the last beat; none where nothing is driven.
    fn specific_power(&self) -> Option<String> {
        let last = self.beats.last()?;
        let of_last = |b: &BeatMeans| [b.mean.power_watt, b.mean.positive_power_watt];
        let (powers, of) = match &self.means {
            Some(m) => (
                [
                    m.estimate.power_watt.mean,
                    m.estimate.positive_power_watt.mean,
                ],
                "the mean".to_owned(),
            ),
            None => (of_last(last), format!("beat {}", last.beat)),
        };
        let [all, positive] = powers.map(|p| alone(p / self.mass_kg, "W/kg"));
        (powers[1] > 0.0).then(|| {
            format!(
                "Power of {of} over the mass: {all}; of actuators that get nothing back when they brake (its positive part, joint by joint): {positive}."
            )
        })
    }

    /// Mean coefficients, of the mean or of the last beat; none where no wing moves through air of a known density.
    fn coefficients(&self) -> Option<String> {
        let last = self.beats.last()?;
        let [lift, thrust] = match &self.means {
            Some(m) => {
                [m.estimate.lift_coefficient?, m.estimate.thrust_coefficient?].map(|c| c.mean)
            }
            None => [last.mean.lift_coefficient?, last.mean.thrust_coefficient?],
        };
        Some(format!(
            "{OVER_PRESSURE}: coefficients {} and {}.",
            fixed(lift, 3),
            fixed(thrust, 3)
        ))
    }

    fn balances(&self, out: &mut String) {
        out.push_str("\nBalances (largest over the run)\n");
        let _ = writeln!(
            out,
            "  energy residual over energy turned over   {:.1e}",
            self.energy_residual_relative
        );
        let _ = writeln!(
            out,
            "  momentum residual over impulse            {:.1e}",
            self.momentum_residual_relative
        );
        let _ = writeln!(
            out,
            "  constraint violation                      {:.1e} m, {:.1e} (orientation)",
            self.violation_position_m, self.violation_orientation
        );
        let _ = writeln!(
            out,
            "  corrector passes                          {:.1} mean, {} most",
            self.corrector_passes_mean, self.corrector_passes_most
        );
        let _ = writeln!(
            out,
            "  wake rings at the end                     {}",
            self.wake_rings
        );
        let _ = writeln!(
            out,
            "  regularised events                        {}",
            self.regularised
        );
        if let Some(budget) = &self.impulse_budget {
            impulse_rows(budget, out);
        }
    }
}

/// What coefficients are, as the beginning of a sentence that gives them.
const OVER_PRESSURE: &str = "Lift and force forward over the mean of 1/2 rho U^2 on the wings, U the speed of the feathering axes through the undisturbed air";

/// Coefficients over the last part of a flight without wingbeats; none where no wing moves through air of a
/// known density.
fn last_coefficients(part: &LastPart) -> Option<String> {
    let [lift, thrust] = [part.mean.lift_coefficient?, part.mean.thrust_coefficient?];
    let changes = [
        part.change_of_lift,
        part.change_of_thrust,
        part.change_of_side_force,
    ];
    Some(format!(
        "{OVER_PRESSURE}: coefficients {} and {} on average from {} to {}; from the first half of this time to the second, {}.",
        fixed(lift, 4),
        fixed(thrust, 4),
        alone(part.from_s, "s"),
        alone(part.to_s, "s"),
        changes_in_words(changes, 2)
    ))
}

/// Changes of lift and of the force along n1 and n2, over the mean force, with so many decimals of a per cent; the last
/// where it shows.
fn changes_in_words([lift, thrust, side]: [f64; 3], decimals: usize) -> String {
    let [of_lift, of_thrust, of_side] = [lift, thrust, side].map(|x| signed(100.0 * x, decimals));
    let both =
        format!("lift changes by {of_lift} % of the force, the force forward by {of_thrust} %");
    match (100.0 * side).abs() * 10_f64.powi(decimals as i32) < 0.5 {
        true => both,
        false => format!("{both}, that to the right by {of_side} %"),
    }
}

/// What became of the impulse that surfaces gave to the air.
fn impulse_rows(budget: &ImpulseBudget, out: &mut String) {
    // The one that the verdict judges; that from start to end where none is judged.
    let (residual, value) = match (budget.is_beside_ground, budget.largest_relative) {
        (true, Some(largest)) => ("impulse residual along ground, in play", largest),
        (false, Some(largest)) => ("impulse residual over impulse in play", largest),
        (true, None) => (
            "impulse residual along the ground",
            budget.residual_relative,
        ),
        (false, None) => (
            "impulse residual over that of the air",
            budget.residual_relative,
        ),
    };
    let _ = writeln!(out, "  {residual:<42}{value:.1e}");
    out.push_str("  impulse of the vorticity along gravity\n");
    let mut row = |what: &str, impulse: f64| {
        let _ = writeln!(out, "    {what:<40}{}", engineering(impulse, "N s"));
    };
    row("given by surfaces", budget.created_newton_s);
    row("gained by wakes as they moved", budget.moved_newton_s);
    row("of what was dropped", budget.cut_newton_s);
    row("taken by contact with surfaces", budget.absorbed_newton_s);
}

/// Beats of which a standard error is no longer rough.
const ENOUGH: usize = 6;

/// Means over many wingbeats, below the table of all.
fn mean_rows(means: &ManyBeats, largest: [f64; 3], out: &mut String) {
    let mut row = |name: &str, of: fn(&Estimate) -> f64| {
        let ratio = means.estimate.lift_over_weight;
        let ratio = ratio.map_or("-".to_owned(), |r| fixed(of(&r), 3));
        let _ = writeln!(
            out,
            "{name}   {ratio:>11}   {}   {}   {}",
            in_column(of(&means.estimate.lift_newton), largest[0], "N"),
            in_column(of(&means.estimate.thrust_newton), largest[1], "N"),
            in_column(of(&means.estimate.power_watt), largest[2], "W")
        );
    };
    row(" mean", |e| e.mean);
    let has_errors = means.estimate.lift_newton.standard_error.is_some();
    if has_errors {
        row("   +-", |e| e.standard_error.unwrap_or(0.0));
    }
    let [first, last] = means.beats;
    let count = last + 1 - first;
    let few = match count < ENOUGH {
        true => " (rough, of so few beats)",
        false => "",
    };
    let text = format!(
        "Mean and standard error of the {count} beats {first} to {last}{few}, {}.",
        verdict(means)
    );
    out.push_str(&wrapped("       ", &text));
}

/// Whether beats are steady, as the end of a sentence about them.
fn verdict(means: &ManyBeats) -> String {
    let changes = [
        means.change_of_lift,
        means.change_of_thrust,
        means.change_of_side_force,
    ];
    let verdict = match (means.is_steady, means.is_known) {
        (true, _) => "which are steady",
        (false, true) if means.changes_within_error() => {
            "which still drift, by no more than this error"
        }
        (false, true) => "which are NOT steady",
        (false, false) => "too few or too scattered to tell whether they are steady",
    };
    format!(
        "{verdict}: from the first half of them to the second, {}",
        changes_in_words(changes, 1)
    )
}

/// The same of the beats of several flights.
pub(super) fn steadiness(means: &ManyBeats) -> String {
    let [first, last] = means.beats;
    format!(
        "together they have the beats {first} to {last}, {}",
        verdict(means)
    )
}

impl Estimate {
    /// Its mean and its error, if it has one, in the prefix that suits the larger of them: `4.8065 +- 0.0021 W`.
    pub fn in_words(&self, unit: &str) -> String {
        const DIGITS: usize = 4;
        let error = self.standard_error;
        let (scale, prefix) = prefix(self.mean.abs().max(error.unwrap_or(0.0)));
        let number = |x: f64| fixed(x / scale, DIGITS);
        let error = error.map_or(String::new(), |e| format!(" +- {}", number(e)));
        format!("{}{error} {}{unit}", number(self.mean), prefix.trim())
    }
}

/// A number with a prefix that leaves one to three digits before the point.
fn engineering(x: f64, unit: &str) -> String {
    if x.abs() >= 1e6 {
        return format!("{x:8.2e}  {unit}");
    }
    let x = if x.abs() < 1e-12 { 0.0 } else { x };
    let (scale, prefix) = prefix(x);
    format!("{:>8} {prefix}{unit}", fixed(x / scale, 3))
}

/// The same with the prefix of the `largest` number of its column.
fn in_column(x: f64, largest: f64, unit: &str) -> String {
    if x.abs() >= 1e6 || !(1e-12..1e6).contains(&largest) {
        return engineering(x, unit);
    }
    let (scale, prefix) = prefix(largest);
    format!("{:>8} {prefix}{unit}", fixed(x / scale, 3))
}

/// The same in a sentence, where nothing stands below it.
fn alone(x: f64, unit: &str) -> String {
    engineering(x, unit).trim().replace("  ", " ")
}

/// The factor and the letter of the prefix for this magnitude, which leaves one to three digits before the
/// point; a blank where there is none.
pub fn prefix(x: f64) -> (f64, &'static str) {
    const PREFIXES: [(f64, &str); 6] = [
        (1e3, "k"),
        (1.0, " "),
        (1e-3, "m"),
        (1e-6, "u"),
        (1e-9, "n"),
        (1e-12, "p"),
    ];
    let fits = |p: &&(f64, &str)| x.abs() >= p.0;
    PREFIXES.iter().find(fits).copied().unwrap_or((1.0, " "))
}

/// Text broken at 92 columns, continued under the first word.
fn wrapped(bullet: &str, text: &str) -> String {
    let lines = broken(text, bullet.chars().count(), 92);
    format!("{bullet}{lines}\n")
}

/// Text that begins in column `indent`, broken before the word that would end beyond `width` columns (characters) and
/// continued in the column where it begins; a word that is too long by itself stands alone.
pub fn broken(text: &str, indent: usize, width: usize) -> String {
    let mut out = String::new();
    let mut column = indent;
    for word in text.split(' ') {
        let length = word.chars().count();
        if column > indent && column + length > width {
            out.truncate(out.trim_end().len());
            let _ = write!(out, "\n{:indent$}", ""); // a string takes everything
            column = indent;
        }
        out.push_str(word);
        out.push(' ');
        column += length + 1;
    }
    out.truncate(out.trim_end().len());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_prefixes_and_line_breaks() {
        assert_eq!(engineering(9.24e-6, "N").trim(), "9.240 uN");
        assert_eq!(engineering(0.0, "W").trim(), "0.000  W");
        assert_eq!(alone(0.0, "W"), "0.000 W");
        assert_eq!(engineering(-2.5e60, "N").trim(), "-2.50e60  N");
        assert_eq!(in_column(-4.36e-7, 1.2e-5, "N").trim(), "-0.436 uN");
        assert_eq!(in_column(0.0, 1.2e-5, "N").trim(), "0.000 uN");
        assert_eq!(in_column(3e-17, 0.0, "N").trim(), "0.000  N");
        let estimate = |mean, standard_error| Estimate {
            mean,
            standard_error,
        };
        assert_eq!(estimate(4.80653, None).in_words("W"), "4.8065 W");
        let fly = estimate(9.24e-6, Some(2.5e-8)).in_words("N");
        assert_eq!(fly, "9.2400 +- 0.0250 uN");
        let none = estimate(1e-9, Some(2e-6)).in_words("N");
        assert_eq!(none, "0.0010 +- 2.0000 uN");
        let text = wrapped("  - ", &"word ".repeat(30));
        assert!(
            text.lines().count() == 2 && text.lines().all(|l| l.len() <= 92 && !l.ends_with(' '))
        );
        // Letters of two bytes are as wide as others.
        let [ascii, wide] = ["fluegel ", "flügeln "].map(|word| wrapped("  - ", &word.repeat(30)));
        assert_eq!(ascii.replace("fluegel", "flügeln"), wide);
        assert_eq!(broken("abc defghij kl", 2, 8), "abc\n  defghij\n  kl");
    }
}
