//! Dragonflies with four wings, in the setting of all insects.
//!
//! Angles of the source: gamma, inclination of the stroke plane to the horizontal; phi, positive up;
//! psi, chord normal to the stroke plane at zero, leading edge up positive; a cone angle to the fore.
//! Here: stroke-plane pitch 90 deg - gamma, flap -phi, deviation - cone, feathering psi.

use crate::lab::insect::{Choice, DEFAULT, Fluid, MODELS, STEP_BEFORE, forces, middle};
use crate::lab::series::{Table, correlation, interpolate, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};
use wingbeat_case::raw;
use wingbeat_case::raw::{
    AngleCase, BetaCase, FourierCase, PlanformCase, WingCase, WingMotionCase,
};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "dragonfly-azuma-1985",
        about: "Sympetrum frequens climbing at 60 deg with 0.54 m/s: vertical force of all wings that Azuma \
                and others computed from the measured motion by the local circulation method.",
        part: Part::Experiments,
        quick: false,
        run: azuma,
    },
    Case {
        name: "dragonfly-wang-russell-2007",
        about: "A tethered dragonfly: vertical force of all wings that Wang & Russell computed by \
                Navier-Stokes equations in plane flow from the measured motion.",
        part: Part::Experiments,
        quick: false,
        run: wang_russell,
    },
];

/// Largest chord of the wings over their mean chord. So far apart are the hinges of the pairs: "about a wing's
/// width" [Z. J. Wang, Physics Today 61(9), 2008]; flat wings nearer than a mean chord pass through each other
/// in these motions.
const WIDEST: f64 = 1.25;

/// Mean and harmonics (amplitude, phase) [deg]: mean + sum A cos(2 pi k t + phase).
pub(super) struct Series(pub f64, pub &'static [[f64; 2]]);

pub(super) struct Pair {
    pub name: &'static str,
    pub length: f64,
    pub area: f64,
    pub gamma: f64,
    pub cone: Series,
    pub phi: Series,
    pub psi: Series,
}

pub(super) struct Dragonfly {
    pub body: f64,
    pub frequency: f64,
    /// Flight speed [m/s] and direction above the horizontal [deg].
    pub flight: [f64; 2],
    pub pairs: [Pair; 2],
}

impl Series {
    /// `sign` times the series as cosines and sines.
    fn times(&self, sign: f64) -> AngleCase {
        let amplitude = |f: fn(f64) -> f64, s: f64| -> Vec<f64> {
            let of = |h: &[f64; 2]| sign * s * h[0] * f(h[1].to_radians());
            self.1.iter().map(of).collect()
        };
        AngleCase::Fourier(FourierCase {
            mean_deg: sign * self.0,
            cosine_deg: amplitude(f64::cos, 1.0),
            sine_deg: amplitude(f64::sin, -1.0),
        })
    }
}

impl Dragonfly {
    pub fn case(&self, with: Choice) -> raw::Case {
        let [fore, hind] = &self.pairs;
        let (s, c) = self.flight[1].to_radians().sin_cos();
        let mut case = with.case(Fluid {
            density: 1.225,
            viscosity: 1.5e-5,
            // The air comes against the flight; n3 is down.
            stream: [-self.flight[0] * c, 0.0, self.flight[0] * s],
            chord: 0.5 * (fore.area / fore.length + hind.area / hind.length),
            frequency: self.frequency,
        });
        let apart = WIDEST * hind.area / hind.length;
        for (pair, place) in [(fore, 0.5), (hind, -0.5)] {
            let name = format!("{}-right", pair.name);
            let hinge = [place * apart, 0.06 * self.body, 0.0];
            case.wing.insert(name, pair.right(hinge, with));
        }
        case
    }
}

impl Dragonfly {
    /// The same wings in blade elements.
    pub fn in_blades(&self, rotation: raw::RotationCase) -> raw::Case {
        let mut case = self.case(DEFAULT);
        case.air = raw::AirCase {
            model: raw::AirModel::BladeElement,
            stream_m_s: case.air.stream_m_s,
            blade: raw::BladeCase {
                rotation,
                ..raw::BladeCase::default()
            },
            ..raw::AirCase::default()
        };
        case
    }
}

impl Pair {
    fn right(&self, hinge: [f64; 3], with: Choice) -> WingCase {
        let planform = BetaCase {
            length_m: self.length,
            mean_chord_m: Some(self.area / self.length),
            r2_hat: 0.55,
            least_chord: 0.3,
            ..BetaCase::default()
        };
        WingCase {
            hinge_m: Some(hinge),
            mass_kg: Some(1e-9),
            planform: Some(PlanformCase::Beta(planform)),
            mesh: Some(with.mesh()),
            motion: Some(WingMotionCase {
                stroke_plane_pitch_deg: Some(90.0 - self.gamma),
                phi: Some(self.phi.times(-1.0)),
                theta: Some(self.cone.times(-1.0)),
                psi: Some(self.psi.times(1.0)),
                ..WingMotionCase::default()
            }),
            ..WingCase::default()
        }
    }
}

/// Blade elements, with the force of feathering while sweeping and without: what computations leave out that
/// know the angles of attack alone.
const BLADES: [(&str, raw::RotationCase); 2] = [
    ("blade elements", raw::RotationCase::Circulation),
    ("blade elements without feathering", raw::RotationCase::None),
];

/// Rows for the vertical force over the motion's second beat [`unit` newton] against `theirs`, at
/// fortieths of a beat.
fn compare(
    animal: &Dragonfly,
    theirs: &[f64],
    [unit, source, note]: [&'static str; 3],
    newton: f64,
) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for (name, choice) in [MODELS[0], STEP_BEFORE, MODELS[2], MODELS[3], MODELS[5]] {
        let lift = forces(animal.case(choice))?;
        let lift: Vec<f64> = lift.iter().map(|f| -f.z / newton).collect();
        let beats = [1, 2].map(|b| mean(&lift[40 * b..=40 * (b + 1)]));
        let [_, spread] = middle(&beats);
        let second = &lift[60..100]; // the smooth start takes half a beat of phase
        let quantity = format!("vertical force [{unit}]");
        let compared = Comparison::over_a_beat(quantity, name, second, theirs);
        let their_mean = theirs.iter().sum::<f64>() / 40.0;
        rows.push(
            Row::new(format!("{name}: mean vertical force"), unit, beats[1])
                .against(their_mean, source)
                .uncertain(spread)
                .because(note),
        );
        rows.push(
            Row::new(
                format!("{name}: rms difference over the motion's second beat"),
                unit,
                compared.rms_error(),
            )
            .drawn(compared),
        );
        rows.push(Row::new(
            format!("{name}: correlation over the motion's second beat"),
            "1",
            correlation(second, theirs),
        ));
    }
    let their_mean = theirs.iter().sum::<f64>() / 40.0;
    for (name, rotation) in BLADES {
        let lift = forces(animal.in_blades(rotation))?;
        let lift: Vec<f64> = lift[80..=120].iter().map(|f| -f.z / newton).collect();
        let row = Row::new(format!("{name}: mean vertical force"), unit, mean(&lift));
        rows.push(row.against(their_mean, source));
    }
    Ok(rows)
}

fn azuma(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let animal = Dragonfly {
        body: 0.04,
        frequency: 41.5,
        flight: [0.54, 60.0],
        pairs: [
            Pair {
                name: "fore",
                length: 0.0335,
                area: 2.21e-4,
                gamma: 37.0,
                cone: Series(8.0, &[]),
                phi: Series(3.0, &[[43.0, 0.0]]),
                psi: Series(8.0, &[[-77.0, -49.0], [-3.0, 67.0], [-8.0, 29.0]]),
            },
            Pair {
                name: "hind",
                length: 0.0325,
                area: 2.72e-4,
                gamma: 40.0,
                cone: Series(-2.0, &[]),
                phi: Series(-2.0, &[[47.0, 77.0]]),
                psi: Series(3.0, &[[-65.0, 18.0], [8.0, 74.0], [8.0, 28.0]]),
            },
        ],
    };
    let table = Table::new(include_str!("../../data/dragonfly_azuma1985_forces.csv"));
    let t = table.numbers("t");
    let [fore, hind] = ["Fz_fore", "Fz_hind"].map(|name| table.numbers(name));
    let both: Vec<f64> = fore.iter().zip(&hind).map(|(a, b)| a + b).collect();
    let theirs: Vec<f64> = (0..40)
        .map(|k| interpolate(&t, &both, k as f64 / 40.0))
        .collect();
    let words = [
        "mN",
        "Azuma et al. 1985, table in jpecquet/dragonfly-flight-control; its mean is the weight of 0.26 g, \
         2.55 mN",
        "wing shape, distance of the pairs and body are estimates; uncertainty: half the change from the \
         second to the third beat",
    ];
    compare(&animal, &theirs, words, 1e-3)
}

/// Wings and motion of Wang & Russell 2007.
pub(super) const WANG_RUSSELL: Dragonfly = Dragonfly {
    body: 0.051,
    frequency: 33.4,
    flight: [0.0, 0.0],
    pairs: [
        Pair {
            name: "fore",
            length: 0.046,
            area: 3.8e-4,
            gamma: 53.0,
            cone: Series(
                10.0,
                &[
                    [0.997, 146.0],
                    [1.077, 33.0],
                    [1.611, -103.8],
                    [0.968, 116.8],
                    [0.042, -33.3],
                ],
            ),
            phi: Series(0.282, &[[40.453, -69.006], [4.372, -90.413]]),
            psi: Series(
                33.645,
                &[
                    [43.276, 13.484],
                    [1.061, -96.766],
                    [9.051, -166.51],
                    [2.067, -23.795],
                ],
            ),
        },
        Pair {
            name: "hind",
            length: 0.043,
            area: 4.4e-4,
            gamma: 44.0,
            cone: Series(
                -5.0,
                &[
                    [0.484, 41.0],
                    [0.368, -43.6],
                    [1.164, -130.4],
                    [1.218, -92.1],
                    [0.326, 144.6],
                ],
            ),
            phi: Series(2.414, &[[45.019, -46.817], [6.604, -51.487]]),
            psi: Series(
                23.935,
                &[
                    [44.018, 34.582],
                    [13.653, 22.773],
                    [4.771, -73.0],
                    [1.768, -143.739],
                ],
            ),
        },
    ],
};

fn wang_russell(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let table = Table::new(include_str!(
        "../../data/dragonfly_wang_russell2007_vertical_force.csv"
    ));
    let (t, force) = (table.numbers("t"), table.numbers("Fz"));
    // Mean of the four beats after the first.
    let theirs: Vec<f64> = (0..40)
        .map(|k| {
            let at = |b: usize| interpolate(&t, &force, b as f64 + k as f64 / 40.0);
            (1..5).map(at).sum::<f64>() / 4.0
        })
        .collect();
    let words = [
        "weights",
        "Wang & Russell 2007, digitised in jpecquet/dragonfly-flight-control; mean of four beats",
        "theirs is plane flow, normalised as the source has it, taken as the weight of 0.62 g; wing shape, \
         distance of the pairs and body are estimates; uncertainty: half the change from the second to the \
         third beat",
    ];
    compare(&WANG_RUSSELL, &theirs, words, 0.62e-3 * 9.81)
}
