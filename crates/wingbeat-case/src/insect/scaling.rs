//! From an insect that is known to one of another size: what is not given follows from scaling laws.
//!
//! | symbol | name in code | law | source |
//! |---|---|---|---|
//! | R | `wing_length` | `R / R0 = (m / m0)^(1/3)`, and the other way round | isometry from the nearest species: an estimate |
//! | c | `mean_chord` | `c / c0 = R / R0` | the wing keeps its shape |
//! | f | `frequency` | `f = 317 sqrt(m) / S`, m in g, both wings' area S in cm2 | Deakin (2010), fitted to the insects of Byrne, Buchmann & Spangler (1988) |
//!
//! Index 0 is the nearest species. Deakin's constant is taken from a later review, which quotes it.

use super::number::number;
use crate::error::IoError;
use crate::shipped::species::{SPECIES, Species};

/// Deakin's constant in SI units \[Hz m2 / sqrt(kg)\]: 317 for grams and square centimetres.
const DEAKIN: f64 = 317.0 * 31.622_776_601_683_793 * 1e-4;

/// What is given of an insect, SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    /// Mass with wings \[kg\].
    pub mass: Option<f64>,
    /// Length of a wing, hinge to tip \[m\].
    pub wing_length: Option<f64>,
    /// Mean chord \[m\].
    pub mean_chord: Option<f64>,
    /// Wingbeats per second \[Hz\].
    pub frequency: Option<f64>,
}

/// Wing length over that of a species scaled to the same mass, at least and at most.
const PROPORTION: [f64; 2] = [0.4, 2.5];

/// Mean chord over wing length, from the first to the second.
const CHORDS: [f64; 2] = [0.1, 1.0];

/// What five digits of a number round away at most \[1\].
const ROUNDED: f64 = 5e-5;

/// Whether a wing \[m\] is in proportion to a mass \[kg\], by the species nearest to both.
fn is_in_proportion(mass: f64, wing: f64) -> bool {
    let s = Species::nearest(Some(mass), Some(wing));
    let part = wing / (s.wing_length * (mass / s.mass).cbrt());
    (PROPORTION[0]..=PROPORTION[1]).contains(&part)
}

/// The wing \[m\] that two species are equally near to, at a mass \[kg\]; see [`Species::nearest`].
fn border(mass: f64, [a, b]: [&Species; 2]) -> f64 {
    let of_mass = |s: &Species| ((mass / s.mass).ln() / 3.0).powi(2);
    let [x, y] = [a, b].map(|s| s.wing_length.ln());
    (0.5 * (x + y) + 0.5 * (of_mass(a) - of_mass(b)) / (x - y)).exp()
}

/// The shortest and the longest wing of an insect of a mass \[m\]: those in proportion around the wing of the
/// species nearest in mass, scaled to it. They end where the proportion to a species ends, or where another
/// species becomes the nearest; wings in proportion to much smaller or larger species beyond are not among them.
fn allowed_wings(mass: f64) -> [f64; 2] {
    const BESIDE: f64 = 1e-9;
    let scaled = |s: &Species| s.wing_length * (mass / s.mass).cbrt();
    let middle = scaled(Species::nearest(Some(mass), None));
    let ends = SPECIES
        .iter()
        .flat_map(|s| PROPORTION.map(|part| part * scaled(s)));
    let pairs = SPECIES
        .iter()
        .flat_map(|a| SPECIES.iter().map(move |b| [a, b]));
    let pairs = pairs.filter(|[a, b]| a.wing_length != b.wing_length);
    let all = ends.chain(pairs.map(|pair| border(mass, pair)));
    let all = all.flat_map(|wing| [wing * (1.0 - BESIDE), wing * (1.0 + BESIDE)]);
    let (taken, refused): (Vec<f64>, Vec<f64>) =
        all.partition(|wing| is_in_proportion(mass, *wing));
    let [below, above] = refused
        .iter()
        .fold([0.0, f64::INFINITY], |[low, high], &wing| {
            match wing < middle {
                true => [f64::max(low, wing), high],
                false => [low, f64::min(high, wing)],
            }
        });
    let inner = taken
        .into_iter()
        .filter(|wing| (below..above).contains(wing));
    inner.fold([middle, middle], |[least, most], wing| {
        [least.min(wing), most.max(wing)]
    })
}

impl Size {
    /// Refuses wings that no hovering insect of this mass has.
    fn check_proportion(&self) -> Result<(), IoError> {
        let (Some(mass), Some(wing)) = (self.mass, self.wing_length) else {
            return Ok(());
        };
        let [least, most] = allowed_wings(mass);
        if (least..=most).contains(&wing) {
            return Ok(());
        }
        // Ends that are rounded are still allowed.
        let [least, most] = [least * (1.0 + ROUNDED), most * (1.0 - ROUNDED)];
        let [mass, wing, least, most] =
            [1e6 * mass, 1e3 * wing, 1e3 * least, 1e3 * most].map(number);
        Err(IoError::Insect {
            problem: format!("--wing {wing}mm is out of proportion to --mass {mass}mg"),
            remedy: format!(
                "give a wing from {least} to {most} mm, or leave one of the two out: it follows from the other"
            ),
        })
    }

    /// The command that makes the case.
    fn command(&self) -> String {
        let part = |name: &str, value: Option<f64>, scale: f64, unit: &str| {
            value.map_or(String::new(), |x| {
                let x = number(scale * x);
                format!(" --{name} {}{unit}", x.trim_end_matches(".0"))
            })
        };
        [
            "wingbeat new".to_owned(),
            match self.mass {
                Some(mass) if mass >= GRAM => part("mass", self.mass, 1e3, "g"),
                mass => part("mass", mass, 1e6, "mg"),
            },
            part("wing", self.wing_length, 1e3, "mm"),
            part("chord", self.mean_chord, 1e3, "mm"),
            part("frequency", self.frequency, 1.0, ""),
        ]
        .concat()
    }
}

/// A gram \[kg\].
const GRAM: f64 = 1e-3;

/// A mass \[kg\] in milligrams, or in grams from one on.
fn in_words(mass: f64) -> String {
    let (scaled, unit) = match mass < GRAM {
        true => (1e6 * mass, "mg"),
        false => (1e3 * mass, "g"),
    };
    format!("{} {unit}", number(scaled))
}

/// A number and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sourced {
    pub value: f64,
    pub source: String,
}

impl Sourced {
    pub(super) fn new(value: f64, source: impl Into<String>) -> Self {
        let source = source.into();
        Self { value, source }
    }

    fn given_or(given: Option<f64>, law: impl FnOnce() -> Self) -> Self {
        given.map_or_else(law, |value| Self::new(value, "given"))
    }
}

/// An insect with all its numbers, SI units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Insect {
    pub name: String,
    /// What it is, in words.
    pub title: String,
    /// The command that makes it.
    pub made_by: String,
    pub mass: Sourced,
    pub wing_length: Sourced,
    pub mean_chord: Sourced,
    pub frequency: Sourced,
    /// Stroke from end to end that the source has \[deg\].
    pub stroke: Option<Sourced>,
    pub r2_hat: Sourced,
    pub wing_mass: Sourced,
    pub body_length: Sourced,
}

impl Insect {
    /// A species as it is.
    pub(super) fn of_species(s: &Species) -> Self {
        let by = &s.sources;
        Self {
            name: s.name.to_owned(),
            title: format!("{} ({})", s.name, s.latin),
            made_by: format!("wingbeat new --species {}", s.name),
            mass: Sourced::new(s.mass, by.mass),
            wing_length: Sourced::new(s.wing_length, by.wing_length),
            mean_chord: Sourced::new(s.mean_chord, by.mean_chord),
            frequency: Sourced::new(s.frequency, by.frequency),
            stroke: Some(Sourced::new(s.stroke, by.stroke)),
            r2_hat: Sourced::new(s.r2_hat, by.r2_hat),
            wing_mass: Sourced::new(s.wing_share * s.mass, by.wing_share),
            body_length: Sourced::new(s.body_length, by.body_length),
        }
    }

    /// An insect of a size.
    ///
    /// # Errors
    /// Neither mass nor wing length.
    pub(super) fn of_size(size: &Size) -> Result<Self, IoError> {
        if size.mass.is_none() && size.wing_length.is_none() {
            return Err(IoError::Insect {
                problem: "a frequency or a chord alone gives no size".to_owned(),
                remedy: "give the mass or the wing length beside it, or both".to_owned(),
            });
        }
        size.check_proportion()?;
        let s = Species::nearest(size.mass, size.wing_length);
        let isometry =
            |exponent: &str| format!("estimated: isometry from the {} ({exponent})", s.name);
        let [m0, r0] = [s.mass, s.wing_length];
        let mass = Sourced::given_or(size.mass, || {
            let r = size.wing_length.unwrap_or(r0);
            Sourced::new(m0 * (r / r0).powi(3), isometry("mass as wing length cubed"))
        });
        let wing_length = Sourced::given_or(size.wing_length, || {
            let r = r0 * (mass.value / m0).cbrt();
            Sourced::new(r, isometry("wing length as cube root of mass"))
        });
        let mean_chord = Sourced::given_or(size.mean_chord, || {
            let source = format!("estimated: wing shape of the {}", s.name);
            Sourced::new(s.mean_chord * wing_length.value / r0, source)
        });
        let (chord, length) = (mean_chord.value, wing_length.value);
        if !(CHORDS[0]..=CHORDS[1]).contains(&(chord / length)) {
            let [from, to] = CHORDS.map(|part| number(1e3 * part * length));
            return Err(IoError::Insect {
                problem: format!(
                    "--chord {}mm is out of proportion to wings of {} mm",
                    number(1e3 * chord),
                    number(1e3 * length)
                ),
                remedy: format!("give a mean chord from {from} to {to} mm, or leave it out"),
            });
        }
        let frequency = Sourced::given_or(size.frequency, || {
            let area = 2.0 * chord * wing_length.value;
            let law = "Deakin (2010), as a later review quotes it: 317 sqrt(mass in g) / area of both wings in cm2";
            Sourced::new(DEAKIN * mass.value.sqrt() / area, law)
        });
        let proportional =
            |value| Sourced::new(value, format!("estimated: proportions of the {}", s.name));
        Ok(Self {
            name: "insect".to_owned(),
            title: format!(
                "flyer of {}, in the proportions of an insect",
                in_words(mass.value)
            ),
            made_by: size.command(),
            wing_mass: proportional(s.wing_share * mass.value),
            body_length: proportional(s.body_length * (mass.value / m0).cbrt()),
            mean_chord,
            r2_hat: proportional(s.r2_hat),
            stroke: None,
            mass,
            wing_length,
            frequency,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of any mass there is one range of wings, whichever species the wing is near to: all in it are in
    /// proportion, its ends as the refusal says them are allowed, and just beyond wings are out of proportion.
    #[test]
    fn exact_the_range_of_wings_that_a_refusal_says_is_what_is_allowed() {
        let size = |mass, wing| Size {
            mass: Some(mass),
            wing_length: Some(wing),
            ..Size::default()
        };
        for k in 0..50 {
            let mass = 2e-8 * (50e-3 / 2e-8_f64).powf(f64::from(k) / 49.0); // 20 ug to 50 g
            let said = size(mass, 1.0).check_proportion().unwrap_err().to_string();
            let (_, range) = said.split_once("a wing from ").unwrap();
            let (range, _) = range.split_once(" mm").unwrap();
            let (least, most) = range.split_once(" to ").unwrap();
            let [least, most] = [least, most].map(|x| 1e-3 * x.parse::<f64>().unwrap());
            for part in 0..=100 {
                let wing = least * (most / least).powf(f64::from(part) / 100.0);
                let found = size(mass, wing).check_proportion();
                assert!(found.is_ok(), "{mass} {wing}: {found:?}");
            }
            for wing in [0.999 * least, 1.001 * most] {
                let said_there = size(mass, wing).check_proportion().unwrap_err();
                let said_there = said_there.to_string();
                assert!(said_there.contains(range), "{said_there}: {range}");
                assert!(!is_in_proportion(mass, wing), "{mass} {wing}");
            }
            for part in 0..=100 {
                let wing = least * (most / least).powf(f64::from(part) / 100.0);
                assert!(is_in_proportion(mass, wing), "{mass} {wing}");
            }
        }
    }
}
