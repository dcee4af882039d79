//! Anax in forward flight, its four wings in the measured motion, and what their lift hangs on.

use super::dragonflies::{Dragonfly, Pair, Series, WANG_RUSSELL};
use crate::lab::insect::{Choice, Cut, DEFAULT, MODELS, STEP_BEFORE, forces, middle};
use crate::lab::series::mean;
use crate::{Case, Part, Row, VerifyError};
use wingbeat_case::raw;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "dragonfly-azuma-1988",
        about: "Anax parthenope in slow and in faster forward flight: mean vertical force of all wings in the \
                measured motion against weight times load factor.",
        part: Part::Experiments,
        quick: false,
        run: azuma_1988,
    },
    Case {
        name: "dragonfly-choices",
        about: "Four wings with leading-edge vorticity over ten beats: mean lift of beats 3 to 10 with core, step and \
                mesh changed, of both flights of Anax and of the tethered dragonfly; roots are free, suction is held in the \
                solution, wakes are kept for two beats.",
        part: Part::Sensitivity,
        quick: false,
        run: choices,
    },
];

/// Weight of Anax [N].
const WEIGHT: f64 = 0.79e-3 * 9.81;

/// A flight of Anax: wingbeats a second, speed and direction, load factor; fore and hind wings with the inclination
/// of their stroke plane, flap and feathering.
struct Anax(f64, [f64; 2], f64, [(f64, Series, Series); 2]);

const AZUMA_1988: [Anax; 2] = [
    Anax(
        26.5,
        [0.7, -12.0],
        1.1,
        [
            (
                40.0,
                Series(0.0, &[[36.0, 0.0]]),
                Series(10.0, FEATHERING[0]),
            ),
            (
                38.0,
                Series(0.0, &[[26.0, 51.0]]),
                Series(17.0, FEATHERING[1]),
            ),
        ],
    ),
    Anax(
        28.1,
        [1.5, -1.1],
        0.97,
        [
            (
                55.0,
                Series(0.0, &[[25.0, 0.0]]),
                Series(-2.0, FEATHERING[2]),
            ),
            (
                48.0,
                Series(0.0, &[[26.0, 61.0]]),
                Series(-9.0, FEATHERING[3]),
            ),
        ],
    ),
];

const FEATHERING: [&[[f64; 2]]; 4] = [
    &[[54.0, 89.0], [2.0, -88.0], [7.0, 52.0], [1.0, -7.0]],
    &[[38.0, -178.0], [6.0, -112.0], [2.0, -37.0], [1.0, -216.0]],
    &[[54.0, 93.0], [4.0, 135.0], [4.0, -68.0], [5.0, 113.0]],
    &[[30.0, 154.0], [6.0, -69.0], [2.0, -52.0], [2.0, 83.0]],
];

impl Anax {
    /// Areas are those of one wing, as their mean chords, 0.20 and 0.26 of the length, show.
    fn animal(self) -> Dragonfly {
        let Self(frequency, flight, _, [fore, hind]) = self;
        let pair = |name, [length, area, cone]: [f64; 3], (gamma, phi, psi)| Pair {
            name,
            length,
            area,
            gamma,
            cone: Series(cone, &[]),
            phi,
            psi,
        };
        Dragonfly {
            body: 0.075,
            frequency,
            flight,
            pairs: [
                pair("fore", [0.050, 5.0e-4, 8.0], fore),
                pair("hind", [0.0485, 6.0e-4, -2.0], hind),
            ],
        }
    }
}

fn azuma_1988(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    const SOURCE: &str = "Azuma & Watanabe 1988, J. Exp. Biol. 137:221, table 2";
    const BAND: &str = "wing shape and distance of the pairs are estimates, twist is left out, the load \
                        factor follows from the path; uncertainty: half the change from the second to \
                        the third beat";
    let mut rows = Vec::new();
    for (flight, number) in AZUMA_1988.into_iter().zip(1..) {
        let load = flight.2;
        let animal = flight.animal();
        let sheets = [MODELS[0], STEP_BEFORE];
        let models = [MODELS[0], STEP_BEFORE, MODELS[2], MODELS[3], MODELS[5]].map(Some);
        for model in std::iter::once(None).chain(models) {
            let (name, choice) = model.unwrap_or(("blade elements", DEFAULT));
            let case = match model {
                None => animal.in_blades(raw::RotationCase::Circulation),
                Some(_) => animal.case(choice),
            };
            let lift: Vec<f64> = forces(case)?.iter().map(|f| -f.z / WEIGHT).collect();
            let [lift, spread] = middle(&[1, 2].map(|b| mean(&lift[40 * b..=40 * (b + 1)])));
            let quantity = format!("experiment {number}, {name}: mean vertical force");
            let row = Row::new(quantity, "weights", lift).against(load, SOURCE);
            let row = row.uncertain(spread);
            rows.push(
                match model.is_none_or(|m| sheets.iter().any(|s| s.0 == m.0)) {
                    true => row.within_part(0.25, BAND),
                    false => row,
                },
            );
        }
    }
    Ok(rows)
}

/// What is changed: name, and the setting.
fn changes() -> [(&'static str, Choice); 7] {
    let base = Choice {
        beats: 10,
        cut: Cut::Beats(2.0),
        ..DEFAULT
    };
    [
        ("nominal", base),
        ("core x 2", Choice { core: 2.0, ..base }),
        ("core x 0.5", Choice { core: 0.5, ..base }),
        ("step x 2", Choice { steps: 20, ..base }),
        (
            "mesh x 0.5",
            Choice {
                mesh: [3, 5],
                ..base
            },
        ),
        ("step x 0.5", Choice { steps: 80, ..base }),
        (
            "mesh x 2",
            Choice {
                mesh: [10, 20],
                ..base
            },
        ),
    ]
}

/// Mean lift of the beats from the third on, and its standard error.
fn late(animal: &Dragonfly, with: Choice) -> Result<[f64; 2], VerifyError> {
    let lift: Vec<f64> = forces(animal.case(with))?.iter().map(|f| -f.z).collect();
    let beat = |b: usize| mean(&lift[b * with.steps..=(b + 1) * with.steps]);
    let beats: Vec<f64> = (2..with.beats).map(beat).collect();
    let n = beats.len() as f64;
    let middle = beats.iter().sum::<f64>() / n;
    let squares: f64 = beats.iter().map(|b| (b - middle).powi(2)).sum();
    Ok([middle, (squares / (n * (n - 1.0))).sqrt()])
}

fn choices(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    const BAND: &str = "a tenth: choices of the method should not decide; uncertainty: standard error over the beats";
    let [slow, fast] = AZUMA_1988;
    let flights = [
        ("Anax, experiment 1", slow.animal(), WEIGHT),
        ("Anax, experiment 2", fast.animal(), WEIGHT),
        ("tethered dragonfly", WANG_RUSSELL, 0.62e-3 * 9.81),
    ];
    let mut rows = Vec::new();
    for (animal, flight, weight) in flights {
        let [_, others @ ..] = changes();
        let [base, error] = late(&flight, changes()[0].1)?;
        let quantity = format!("{animal}: mean lift, nominal");
        rows.push(Row::new(quantity, "weights", base / weight).uncertain(error / weight));
        for (name, choice) in others {
            let [changed, error] = late(&flight, choice)?;
            let quantity = format!("{animal}: change of mean lift, {name}");
            let row =
                Row::new(quantity, "1", changed / base - 1.0).against(0.0, "the nominal setting");
            rows.push(row.uncertain(error / base).within(0.1, BAND));
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::insect::fruit_fly_wings;
    use wingbeat_case::LoadedCase;

    /// What is said before a flight, and after it, of strokes that are not alike back and forth.
    #[test]
    fn behaves_flights_of_anax_are_told_that_leading_edges_shed_one_sign() {
        let said = |case: raw::Case| {
            let setup = LoadedCase::new(case).unwrap().setup;
            setup.one_sided_leading_edges()
        };
        let four = AZUMA_1988
            .map(Anax::animal)
            .into_iter()
            .chain([WANG_RUSSELL]);
        for animal in four {
            assert!(said(animal.case(STEP_BEFORE.1)).is_some());
            assert_eq!(said(animal.case(DEFAULT)), None);
        }
        let (fly, _) = fruit_fly_wings();
        assert_eq!(said(fly.case(STEP_BEFORE.1)), None);
    }
}
