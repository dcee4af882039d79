//! Numbers and names on the command line, each with the range it may have.

use std::ffi::OsStr;
use std::path::PathBuf;

use clap::builder::{PathBufValueParser, PossibleValue, TypedValueParser};
use clap::{Arg, Args, Command};
use wingbeat::analysis::SPEED_OF_SOUND;
use wingbeat::case::presets::PRESETS;
use wingbeat::case::{IoError, LoadedCase};

/// A finite number for which `allowed` holds; `range` says so in words.
fn number(text: &str, allowed: impl Fn(f64) -> bool, range: &str) -> Result<f64, String> {
    let Ok(value) = text.trim().parse::<f64>() else {
        return Err(format!("give {range}; a number alone, without a unit"));
    };
    match value.is_finite() && allowed(value) {
        true => Ok(value),
        false => Err(format!("give {range}")),
    }
}

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f64, String> {
    number(text, |_| true, "a finite number")
}

/// A finite number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0, "a finite number above 0")
}

/// A speed with sign [m/s].
pub(crate) fn speed(text: &str) -> Result<f64, String> {
    let range = "a speed in m/s below that of sound (-340 to 340): the air is incompressible";
    number(text, |x| x.abs() < SPEED_OF_SOUND, range)
}

/// An angle from -180 to 180 \[deg\].
pub(crate) fn degrees(text: &str) -> Result<f64, String> {
    number(
        text,
        |x| x.abs() <= 180.0,
        "an angle from -180 to 180 degrees",
    )
}

/// A part of a whole, above 0 and up to 1.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0 && x <= 1.0, "a share above 0 and up to 1")
}

/// A residual below which something counts as zero.
pub(crate) fn tolerance(text: &str) -> Result<f64, String> {
    let range = "a residual from 1e-9 to 0.1";
    number(text, |x| (1e-9..=0.1).contains(&x), range)
}

/// A number with its unit, e.g. `100mg`; in SI units.
fn quantity(
    text: &str,
    units: &[(&str, f64)],
    allowed: impl Fn(f64) -> bool,
    range: &str,
) -> Result<f64, String> {
    let text = text.trim();
    let split = text.len() - text.chars().rev().take_while(|c| c.is_alphabetic()).count();
    let (value, unit) = text.split_at_checked(split).unwrap_or((text, ""));
    let scale = units.iter().find(|u| u.0 == unit).map(|u| u.1);
    let value = scale.and_then(|scale| Some(scale * value.trim().parse::<f64>().ok()?));
    let value = value.filter(|x| x.is_finite() && allowed(*x));
    value.ok_or_else(|| format!("give {range}"))
}

/// The mass of an insect [kg].
pub(crate) fn mass(text: &str) -> Result<f64, String> {
    let units = [("ug", 1e-9), ("mg", 1e-6), ("g", 1e-3), ("kg", 1.0)];
    let range = "a mass with its unit (ug, mg, g, kg) from 20ug to 50g, e.g. 100mg";
    quantity(text, &units, |x| (2e-8..=5e-2).contains(&x), range)
}

/// Units of lengths \[m\].
const LENGTHS: [(&str, f64); 4] = [("um", 1e-6), ("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)];

/// The wing length of an insect [m].
pub(crate) fn wing_length(text: &str) -> Result<f64, String> {
    let range = "a length with its unit (um, mm, cm, m) from 0.3mm to 20cm, e.g. 9.7mm";
    quantity(text, &LENGTHS, |x| (3e-4..=0.2).contains(&x), range)
}

/// The mean chord of its wings [m].
pub(crate) fn chord(text: &str) -> Result<f64, String> {
    let range = "a length with its unit (um, mm, cm, m) from 30um to 20cm, e.g. 3mm";
    quantity(text, &LENGTHS, |x| (3e-5..=0.2).contains(&x), range)
}

/// A wingbeat frequency [Hz].
pub(crate) fn frequency(text: &str) -> Result<f64, String> {
    let range = "a frequency in Hz from 1 to 1200, e.g. 230 or 230Hz";
    quantity(
        text,
        &[("", 1.0), ("Hz", 1.0)],
        |x| (1.0..=1200.0).contains(&x),
        range,
    )
}

/// Megabytes of a page.
pub(crate) fn megabytes(text: &str) -> Result<f64, String> {
    number(
        text,
        |x| x > 0.0 && x <= 1e4,
        "a size above 0 and up to 10000 MB",
    )
}

/// A whole number from `LEAST` to `MOST`.
pub(crate) fn count<const LEAST: usize, const MOST: usize>(text: &str) -> Result<usize, String> {
    let value = text.trim().parse().ok();
    let value = value.filter(|n| (LEAST..=MOST).contains(n));
    value.ok_or_else(|| format!("give a whole number from {LEAST} to {MOST}"))
}

/// The seed of random numbers.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    let value = text.trim().parse();
    value.map_err(|_| format!("give a whole number from 0 to {}", u64::MAX))
}

/// One of the `known` names.
pub(crate) fn choose<T: Copy>(name: &str, known: &[(&'static str, T)]) -> Result<T, String> {
    let found = known.iter().find(|k| k.0 == name);
    found.map(|k| k.1).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|k| k.0).collect();
        let all = names.join(", ");
        match wingbeat::case::nearest(name, &names) {
            Some(near) => format!("did you mean `{near}`? Choose from {all}"),
            None => format!("choose from {all}"),
        }
    })
}

/// Parser of one of the `known` names, which shells complete.
#[derive(Clone, Copy)]
pub(crate) struct Choice<T: 'static>(pub(crate) &'static [(&'static str, T)]);

impl<T: Copy + Send + Sync + 'static> TypedValueParser for Choice<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let known = self.0;
        let parser = move |name: &str| choose(name, known);
        parser.parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = self.0.iter().map(|k| PossibleValue::new(k.0));
        Some(Box::new(names))
    }
}

/// Parser of a case: the path of a file or the name of a preset, which shells complete.
#[derive(Clone, Copy)]
pub(crate) struct CaseName;

impl TypedValueParser for CaseName {
    type Value = PathBuf;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<PathBuf, clap::Error> {
        PathBufValueParser::new().parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = PRESETS.iter().map(|p| PossibleValue::new(p.name));
        Some(Box::new(names))
    }
}

/// The case of a command, and what it changes of the case.
#[derive(Args)]
pub(crate) struct CaseArgs {
    /// Case file or preset; - is the standard input.
    #[arg(value_parser = CaseName, hide_possible_values = true)]
    case: PathBuf,
    /// Set a key of the case, e.g. time.beats=3; KEY= takes it away (may be repeated).
    #[arg(long = "set", value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl CaseArgs {
    /// The case, checked.
    pub(crate) fn load(&self) -> Result<LoadedCase, IoError> {
        LoadedCase::find(&self.case, &self.set)
    }
}

/// Threads at most.
pub(crate) const MAX_THREADS: usize = 1024;

/// How a flight is computed and shown.
#[derive(Args)]
pub(crate) struct RunOptions {
    /// Threads to use; default all. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = count::<1, MAX_THREADS>)]
    pub(crate) threads: Option<usize>,
    /// No progress and no summary on the terminal.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Progress and summary as JSON, one object per line.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) json: bool,
}

impl RunOptions {
    /// Whether nothing is said in words.
    pub(crate) fn silent(&self) -> bool {
        self.quiet || self.json
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_numbers_out_of_range() {
        for text in ["nan", "inf", "-inf", "1e999", "", "x", "340", "-340"] {
            assert!(speed(text).is_err(), "{text}");
        }
        for text in ["nan", "0", "-1", "inf", "10001", "1e308", "-0"] {
            assert!(megabytes(text).is_err(), "{text}");
        }
        for text in ["0", "-0.1", "1.0001", "nan"] {
            assert!(share(text).is_err(), "{text}");
        }
        for text in ["0", "-1", "11", "1.5", "18446744073709551616", "0x4", ""] {
            assert!(count::<1, 10>(text).is_err(), "{text}");
        }
        assert_eq!(
            (speed("-0.4"), share("1"), degrees("-180")),
            (Ok(-0.4), Ok(1.0), Ok(-180.0))
        );
        assert_eq!(count::<1, 10>("10"), Ok(10));
    }

    #[test]
    fn refuses_sizes_without_unit_or_out_of_range() {
        for text in [
            "100", "mg", "", "100 lb", "-1mg", "nanmg", "infmg", "1e9mg", "100Mg", "1mgé",
        ] {
            assert!(mass(text).is_err(), "{text}");
        }
        for text in ["9.7", "0mm", "1m", "9.7mg", "1e-400m"] {
            assert!(wing_length(text).is_err(), "{text}");
        }
        for text in ["0", "-5", "1e4", "230rpm", "Hz"] {
            assert!(frequency(text).is_err(), "{text}");
        }
        let close = |x: Result<f64, String>, y: f64| (x.unwrap() / y - 1.0).abs() < 1e-15;
        assert!(close(mass("100mg"), 1e-4) && close(mass("0.1 g"), 1e-4));
        assert!(close(wing_length("9.7mm"), 9.7e-3) && close(wing_length("0.97cm"), 9.7e-3));
        assert_eq!(
            (frequency("230"), frequency("230Hz")),
            (Ok(230.0), Ok(230.0))
        );
    }
}

/// Speeds at equal distances [m/s].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Speeds {
    ends: [f64; 2],
    count: usize,
}

impl Speeds {
    /// They themselves.
    pub(crate) fn values(self) -> impl Iterator<Item = f64> {
        let [from, to] = self.ends;
        let last = self.count.saturating_sub(1).max(1) as f64;
        (0..self.count).map(move |k| from + (to - from) * k as f64 / last)
    }
}

/// `FROM:TO:N`, from lower to higher, or one speed: `V`, `V:V:1`.
pub(crate) fn speeds(text: &str) -> Result<Speeds, String> {
    let wrong = || {
        "give FROM:TO:N, two speeds above 0 and below 340 m/s in rising order and their number, 2 to 1000, or one speed alone"
            .to_owned()
    };
    let parts: Vec<&str> = text.split(':').collect();
    let (from, to, count) = match parts[..] {
        [from, to, count] => (from, to, count.trim().parse().map_err(|_| wrong())?),
        [one] => (one, one, 1),
        _ => return Err(wrong()),
    };
    let ends = [speed(from)?, speed(to)?];
    let is_right = match count {
        1 => ends[0] == ends[1],
        _ => ends[0] < ends[1] && (2..=1000).contains(&count),
    };
    match ends[0] > 0.0 && is_right {
        true => Ok(Speeds { ends, count }),
        false => Err(wrong()),
    }
}
