//! Insects that hover on one pair of wings, or on two that move as one, each with its source.

use crate::decode::nearest;
use crate::error::IoError;

/// What is known of an insect; SI units and degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Species {
    /// Name on the command line.
    pub name: &'static str,
    /// Scientific name, as far as the source has it.
    pub latin: &'static str,
    /// Mass with wings \[kg\].
    pub mass: f64,
    /// Length of a wing, hinge to tip \[m\].
    pub wing_length: f64,
    /// Mean chord \[m\].
    pub mean_chord: f64,
    /// Second moment of the wing area about the hinge, its root over the wing length \[1\].
    pub r2_hat: f64,
    /// Wingbeats per second \[Hz\].
    pub frequency: f64,
    /// Stroke from end to end \[deg\].
    pub stroke: f64,
    /// Mass of a wing over the whole \[1\].
    pub wing_share: f64,
    /// Length of the body \[m\].
    pub body_length: f64,
    /// Where mass, wing length, chord, frequency and stroke come from.
    pub source: &'static str,
    /// Where `r2_hat`, `wing_share` and `body_length` come from.
    pub rest: &'static str,
}

/// The set that Sun and co-workers took from Ellington.
const ELLINGTON: &str =
    "Ellington (1984) as quoted by Sun & Du (2003); from memory, not checked against print";

/// Where wing mass and body length are estimates and the outline is that of a bumblebee.
const ESTIMATES: &str = "estimates: outline of a bumblebee's wing, wings of half a percent of the mass each, body length";

/// The species in the order of their mass; masses are those with wings. The parts of the fruit fly are those of the preset `fruit-fly-blade`.
pub const SPECIES: [Species; 9] = [
    Species {
        name: "fruit-fly",
        latin: "Drosophila melanogaster",
        mass: 0.9422e-6,
        wing_length: 2.5e-3,
        mean_chord: 0.699e-3,
        r2_hat: 0.58592,
        frequency: 200.0,
        stroke: 143.0,
        wing_share: 0.005_678,
        body_length: 2.5e-3,
        source: "Dickson, Straw & Dickinson (2008); frequency nominal; stroke Fry, Sayaman & Dickinson (2005)",
        rest: "Dickson, Straw & Dickinson (2008); outline from a digitised wing",
    },
    Species {
        name: "drosophila-hydei",
        latin: "Drosophila hydei",
        mass: 1.8e-6,
        wing_length: 3.333e-3,
        mean_chord: 0.8854e-3,
        r2_hat: 0.579,
        frequency: 188.7,
        stroke: 132.0,
        wing_share: 0.005_678,
        body_length: 3.1e-3,
        source: "Muijres et al. (2014), as in the published data of the robot",
        rest: "outline Muijres et al. (2014); wing mass and body in the proportion of Drosophila melanogaster",
    },
    of_ellington("crane-fly", "Tipula", [11.4, 12.7, 2.38], 45.5, 123.0, 15.0),
    of_ellington("hoverfly", "Syrphidae", [27.3, 9.3, 2.2], 160.0, 90.0, 10.0),
    of_ellington(
        "ladybird",
        "Coccinella",
        [34.4, 11.2, 3.23],
        54.0,
        177.0,
        7.0,
    ),
    of_ellington(
        "drone-fly",
        "Eristalis",
        [68.4, 11.4, 3.19],
        157.0,
        109.0,
        13.0,
    ),
    of_ellington(
        "honeybee",
        "Apis mellifera",
        [101.9, 9.8, 3.08],
        197.0,
        131.0,
        12.5,
    ),
    of_ellington(
        "bumblebee",
        "Bombus",
        [175.0, 13.2, 4.02],
        155.0,
        116.0,
        18.6,
    ),
    Species {
        r2_hat: 0.505,
        wing_share: 0.029,
        rest: "outline Kim et al. (2015); wing mass from memory; body length: estimate",
        ..of_ellington(
            "hawkmoth",
            "Manduca sexta",
            [1648.0, 51.9, 18.26],
            26.1,
            121.0,
            46.0,
        )
    },
];

/// From Ellington's set: mass \[mg\], wing length and mean chord \[mm\], frequency \[Hz\], stroke
/// \[deg\]; body length \[mm\] estimated.
const fn of_ellington(
    name: &'static str,
    latin: &'static str,
    sizes: [f64; 3],
    frequency: f64,
    stroke: f64,
    body_length: f64,
) -> Species {
    Species {
        name,
        latin,
        mass: 1e-6 * sizes[0],
        wing_length: 1e-3 * sizes[1],
        mean_chord: 1e-3 * sizes[2],
        r2_hat: 0.577,
        frequency,
        stroke,
        wing_share: 0.005,
        body_length: 1e-3 * body_length,
        source: ELLINGTON,
        rest: ESTIMATES,
    }
}

impl Species {
    /// A species by name.
    ///
    /// # Errors
    /// [`IoError::NoSpecies`] with the nearest name.
    pub fn find(name: &str) -> Result<&'static Self, IoError> {
        let found = SPECIES.iter().find(|s| s.name == name);
        found.ok_or_else(|| {
            let names = SPECIES.map(|s| s.name);
            let hint = nearest(name, &names).map(|n| format!(", did you mean `{n}`?"));
            IoError::NoSpecies {
                name: name.to_owned(),
                hint: hint.unwrap_or_default(),
                known: names.join(", "),
            }
        })
    }

    /// The species nearest in size: by the ratios of what is given of mass \[kg\] and wing length
    /// \[m\], a length counting as its cube.
    pub fn nearest(mass: Option<f64>, wing_length: Option<f64>) -> &'static Self {
        let far = |s: &Self| {
            let by_mass = mass.map_or(0.0, |m| (m / s.mass).ln());
            let by_length = wing_length.map_or(0.0, |r| 3.0 * (r / s.wing_length).ln());
            by_mass.hypot(by_length)
        };
        let nearest = SPECIES.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.expect("there are species")
    }
}
