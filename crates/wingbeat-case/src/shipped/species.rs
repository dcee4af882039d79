//! Insects that hover on one pair of wings, or on two that move as one, each number with its source.

use crate::error::IoError;
use crate::text::nearest::nearest;

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
    /// Where each comes from.
    pub sources: Sources,
}

/// Where the numbers of a species come from; "estimated" where no print was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sources {
    /// Of the mass.
    pub mass: &'static str,
    /// Of the wing length.
    pub wing_length: &'static str,
    /// Of the mean chord.
    pub mean_chord: &'static str,
    /// Of the second moment of the wing area.
    pub r2_hat: &'static str,
    /// Of the frequency.
    pub frequency: &'static str,
    /// Of the stroke.
    pub stroke: &'static str,
    /// Of the mass of a wing.
    pub wing_share: &'static str,
    /// Of the length of the body.
    pub body_length: &'static str,
}

/// The set that Sun and co-workers took from Ellington, as far as no print was found.
const REMEMBERED: &str =
    "estimated: after Ellington (1984) as Sun & Du (2003) quote him, not checked against print";
const OF_FLY: &str = "Dickson, Straw & Dickinson (2008), as coded in their Grand Unified Fly";
const OF_HYDEI: &str = "Muijres et al. (2014), as in published model code";
const OF_HONEYBEE: &str = "Vance et al. (2014), hover in air: 226.8 +- 12.8 Hz, 86.7 +- 7.9 deg";
const OF_BUMBLEBEE: &str =
    "published bumblebee case of FLUSI: the specimen of Dudley & Ellington (1990)";
const OF_HAWKMOTH: &str = "published model code that cites Sun (2014) and Kim et al. (2015)";
const OUTLINE_OF_BOMBUS: &str = "outline of a Bombus wing pair, from a museum image";
const AS_THE_FLY: &str = "estimated: in the proportion of Drosophila melanogaster";

/// The species in the order of their mass; masses are those with wings. The parts of the fruit fly are those of
/// the preset `fruit-fly-blade`.
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
        sources: Sources {
            mass: OF_FLY,
            wing_length: OF_FLY,
            mean_chord: OF_FLY,
            r2_hat: "outline of a wing digitised by J. Gruber",
            frequency: "nominal; Dickson, Straw & Dickinson (2008) have beats of 4 to 6 ms",
            stroke: "Fry, Sayaman & Dickinson (2005)",
            wing_share: OF_FLY,
            body_length: OF_FLY,
        },
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
        sources: Sources {
            mass: OF_HYDEI,
            wing_length: OF_HYDEI,
            mean_chord: OF_HYDEI,
            r2_hat: OF_HYDEI,
            frequency: OF_HYDEI,
            stroke: OF_HYDEI,
            wing_share: AS_THE_FLY,
            body_length: AS_THE_FLY,
        },
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
    Species {
        sources: Sources {
            frequency: OF_HONEYBEE,
            stroke: OF_HONEYBEE,
            ..ESTIMATES
        },
        ..of_ellington(
            "honeybee",
            "Apis mellifera",
            [101.9, 9.8, 3.08],
            226.8,
            86.7,
            12.5,
        )
    },
    Species {
        sources: Sources {
            mass: OF_BUMBLEBEE,
            wing_length: OF_BUMBLEBEE,
            r2_hat: OUTLINE_OF_BOMBUS,
            frequency: "Sun & Xiong (2005): a wingbeat of 6.4 ms",
            ..ESTIMATES
        },
        ..of_ellington(
            "bumblebee",
            "Bombus",
            [175.0, 13.2, 4.02],
            156.25,
            116.0,
            18.6,
        )
    },
    Species {
        r2_hat: 0.505,
        wing_share: 0.029,
        sources: Sources {
            mass: OF_HAWKMOTH,
            wing_length: OF_HAWKMOTH,
            mean_chord: OF_HAWKMOTH,
            r2_hat: "outline of Kim et al. (2015), figure 1",
            frequency: OF_HAWKMOTH,
            stroke: OF_HAWKMOTH,
            wing_share: "estimated",
            body_length: "estimated",
        },
        ..of_ellington(
            "hawkmoth",
            "Manduca sexta",
            [1620.0, 51.9, 18.26],
            26.1,
            106.0,
            46.0,
        )
    },
];

/// What nothing in print was found for; the outline is that of a bumblebee's wing.
const ESTIMATES: Sources = Sources {
    mass: REMEMBERED,
    wing_length: REMEMBERED,
    mean_chord: REMEMBERED,
    r2_hat: "estimated: outline of a bumblebee's wing",
    frequency: REMEMBERED,
    stroke: REMEMBERED,
    wing_share: "estimated: half a percent of the mass each, spread evenly; power without elastic storage hangs on it",
    body_length: "estimated",
};

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
        sources: ESTIMATES,
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
