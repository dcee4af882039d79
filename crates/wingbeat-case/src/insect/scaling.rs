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
use crate::species::Species;

/// Deakin's constant in SI units \[Hz m2 / sqrt(kg)\]: 317 for grams and square centimetres.
const DEAKIN: f64 = 317.0 * 31.622_776_601_683_793 * 1e-4;

/// What is given of an insect, SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Size {
    /// Mass with wings \[kg\].
    pub mass: Option<f64>,
    /// Length of a wing, hinge to tip \[m\].
    pub wing_length: Option<f64>,
    /// Wingbeats per second \[Hz\].
    pub frequency: Option<f64>,
}

/// Wing length over that of a species scaled to the same mass, at least and at most.
const PROPORTION: [f64; 2] = [0.4, 2.5];

impl Size {
    /// Refuses wings that no hovering insect of this mass has.
    fn check_proportion(&self, s: &Species) -> Result<(), IoError> {
        let (Some(mass), Some(wing)) = (self.mass, self.wing_length) else {
            return Ok(());
        };
        let scaled = s.wing_length * (mass / s.mass).cbrt();
        let [least, most] = PROPORTION.map(|part| part * scaled);
        if (least..=most).contains(&wing) {
            return Ok(());
        }
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
            part("mass", self.mass, 1e6, "mg"),
            part("wing", self.wing_length, 1e3, "mm"),
            part("frequency", self.frequency, 1.0, ""),
        ]
        .concat()
    }
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
                problem: "a frequency alone gives no size".to_owned(),
                remedy: "give the mass or the wing length beside it, or both".to_owned(),
            });
        }
        let s = Species::nearest(size.mass, size.wing_length);
        size.check_proportion(s)?;
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
        let chord = s.mean_chord * wing_length.value / r0;
        let frequency = Sourced::given_or(size.frequency, || {
            let area = 2.0 * chord * wing_length.value;
            let law = "Deakin (2010), as a later review quotes it: 317 sqrt(mass in g) / area of both wings in cm2";
            Sourced::new(DEAKIN * mass.value.sqrt() / area, law)
        });
        let proportional =
            |value| Sourced::new(value, format!("estimated: proportions of the {}", s.name));
        Ok(Self {
            name: "insect".to_owned(),
            title: format!("insect of {} mg", number(1e6 * mass.value)),
            made_by: size.command(),
            wing_mass: proportional(s.wing_share * mass.value),
            body_length: proportional(s.body_length * (mass.value / m0).cbrt()),
            mean_chord: Sourced::new(chord, format!("estimated: wing shape of the {}", s.name)),
            r2_hat: proportional(s.r2_hat),
            stroke: None,
            mass,
            wing_length,
            frequency,
        })
    }
}
