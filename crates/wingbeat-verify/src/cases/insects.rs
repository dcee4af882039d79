//! Insects and their robots, in the one setting of [`crate::lab::insect`].

use crate::lab::insect::{
    Choice, DEFAULT, Flown, Insect, MODELS, data, fourier, fruit_fly_wings, middle,
};
use crate::lab::series::{Table, correlation, interpolate, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};
use wingbeat_case::raw::WingMotionCase;
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "hydei-muijres-2014",
        about: "Steady wingbeat of Drosophila hydei replayed on a robot: vertical force of both wings over \
                the weight.",
        part: Part::Experiments,
        quick: false,
        run: hydei,
    },
    Case {
        name: "robofly-timings",
        about: "Robofly with advanced, symmetrical and delayed rotation, with each model of the leading \
                edge: mean lift coefficient over the second and third beat and its sensitivity.",
        part: Part::Experiments,
        quick: false,
        run: robofly,
    },
    Case {
        name: "fruit-fly-sensitivity",
        about: "Tethered hover of the fruit fly without its body: mean lift over the weight with core, \
                step and mesh changed.",
        part: Part::Sensitivity,
        quick: false,
        run: fruit_fly,
    },
];

fn hydei(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let fly = Insect {
        length: 3.333e-3,
        area: 2.66e-6,
        r2_hat: 0.579,
        root: 0.3289e-3,
        frequency: 188.7,
        density: 1.225,
        viscosity: 1.5e-5,
        motion: hydei_motion(),
    };
    let weight = 1.8e-6 * 9.81;
    let table = Table::new(include_str!(
        "../../data/drosophila_hydei_robot_forces_muijres2014.csv"
    ));
    let (t, robot) = (
        table.numbers("t_over_T"),
        table.numbers("F_vertical_over_weight"),
    );
    let robot: Vec<f64> = (0..40)
        .map(|k| interpolate(&t, &robot, k as f64 / 40.0))
        .collect();
    let source = "Muijres et al. 2014 (robot), table in xijunke/aerodynamic_moment_model";
    let mut rows = Vec::new();
    for (name, choice) in MODELS {
        let flown = Flown::of(fly.case(choice))?;
        let lift: Vec<f64> = flown.force.iter().map(|f| -f.z / weight).collect();
        rows.extend((1..3).map(|beat| action_and_reaction(name, &flown, beat)));
        let beats = [1, 2].map(|b| mean(&lift[40 * b..=40 * (b + 1)]));
        let [_, spread] = middle(&beats);
        let last = &lift[60..100]; // the second beat: a smooth start takes half a beat of phase
        let compared = Comparison::over_a_beat("vertical force [weights]", name, last, &robot);
        rows.push(
            Row::new(format!("{name}: mean vertical force"), "weights", beats[1])
                .against(1.022, source)
                .uncertain(spread)
                .because("uncertainty: half the change from the second to the third beat"),
        );
        rows.push(
            Row::new(
                format!("{name}: rms difference over the motion's second beat"),
                "weights",
                compared.rms_error(),
            )
            .because("the robot's own rms about its mean is 0.9 weights")
            .drawn(compared),
        );
        rows.push(Row::new(
            format!("{name}: correlation over the motion's second beat"),
            "1",
            correlation(last, &robot),
        ));
    }
    Ok(rows)
}

/// Vertical force of a beat by the impulse of the vorticity over the inviscid force by the loads.
fn action_and_reaction(name: &str, flown: &Flown, beat: usize) -> Row {
    let over = |impulses: &[DVec3]| impulses[40 * (beat + 1)].z - impulses[40 * beat].z;
    let ratio = -over(&flown.vortex_impulse) / over(&flown.inviscid_impulse);
    let what = format!(
        "{name}: force by impulse over force by loads, beat {}",
        beat + 1
    );
    let (row, one) = (Row::new(what, "1", ratio), "action and reaction");
    match name {
        "leading-edge sheets" => row
            .against(1.0, one)
            .within(0.1, "asked with leading-edge vorticity"),
        "leading-edge particles" => {
            row.because("particles are stretched and limited: no law of impulse is promised")
        }
        _ => row
            .against(1.0, one)
            .within(0.03, "asked in attached flow, suction counted"),
    }
}

/// Stroke and feathering of the steady wingbeat (Muijres et al. 2014), mean and eight harmonics; the
/// stroke angle is positive forward, feathering turns the leading edge into the motion.
fn hydei_motion() -> WingMotionCase {
    WingMotionCase {
        phi: fourier(
            3.9008,
            &[65.0445, 3.5806, 0.1319, 0.7844],
            &[4.2642, -2.9492, 0.3639, 0.2098],
        ),
        psi: fourier(
            4.2936,
            &[
                1.8536, 5.1852, -8.4569, 3.9562, -3.0337, -2.8771, 0.8649, 0.0771,
            ],
            &[
                59.6529, 1.6095, 9.8057, 5.8064, -2.8749, 0.6686, -0.6137, -1.0007,
            ],
        ),
        ..WingMotionCase::default()
    }
}

fn robofly(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for timing in ["advanced", "symmetrical", "delayed"] {
        let robot = Insect {
            length: 0.25,
            area: 0.0167,
            r2_hat: 0.63382,
            root: 0.06173,
            frequency: 0.17,
            density: 880.0,
            viscosity: 1.15e-4,
            motion: data(&format!("robofly-{timing}")),
        };
        // Mean stroke rate 2 Phi f at the radius of the second moment, stroke of 160 deg.
        let speed = 2.0 * 160_f64.to_radians() * robot.frequency * robot.r2_hat * robot.length;
        let q = 0.5 * robot.density * speed * speed * 2.0 * robot.area;
        for (name, choice) in MODELS {
            rows.push(robofly_row(&robot, q, format!("{timing}, {name}"), choice)?);
        }
    }
    Ok(rows)
}

/// Mean lift coefficient, and as its uncertainty half of what beats, core, step and mesh span.
fn robofly_row(robot: &Insect, q: f64, name: String, base: Choice) -> Result<Row, VerifyError> {
    let beats = robot.lifts(base)?;
    let [lift, _] = middle(&beats);
    let mut all = beats;
    let changes = [
        Choice { core: 2.0, ..base },
        Choice { core: 0.5, ..base },
        Choice { steps: 28, ..base },
        Choice {
            mesh: [4, 7],
            ..base
        },
    ];
    // Particles are summed one by one: their beats alone.
    for choice in changes.into_iter().filter(|_| !base.particles) {
        all.extend(robot.lifts(choice)?);
    }
    let [_, spread] = middle(&all);
    Ok(
        Row::new(format!("{name}: mean lift coefficient"), "1", lift / q)
            .uncertain(spread / q)
            .because(
                "over the mean speed at the radius of gyration; uncertainty: half the span over \
                 the second and third beat, core x 2 and x 0.5, 28 steps, 4 x 7 panels (particles: \
                 the beats alone)",
            ),
    )
}

fn fruit_fly(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let (fly, weight) = fruit_fly_wings();
    let mut rows = Vec::new();
    for (model, base, part) in [
        ("leading-edge sheets", DEFAULT, None),
        (
            "no leading-edge sheets",
            Choice {
                beats: 5,
                ..MODELS[2].1
            },
            Some(0.03),
        ),
    ] {
        let [lift, spread] = middle(&fly.lifts(base)?);
        rows.push(
            Row::new(
                format!("{model}: mean lift, default"),
                "weights",
                lift / weight,
            )
            .uncertain(spread / weight)
            .because("mean from the second beat on; uncertainty: half of what the beats span"),
        );
        for (name, choice) in changes(base) {
            let [changed, spread] = middle(&fly.lifts(choice)?);
            let row = Row::new(
                format!("{model}: change of mean lift, {name}"),
                "1",
                changed / lift - 1.0,
            )
            .uncertain(spread / lift);
            rows.push(match part {
                Some(part) => row
                    .against(0.0, "our own default")
                    .within(part, "what is asked without leading-edge sheets"),
                None => row.because(
                    "with leading-edge sheets histories are chaotic: a spread, not an error",
                ),
            });
        }
    }
    Ok(rows)
}

/// Numerical choices beside `base`, one changed at a time.
fn changes(base: Choice) -> [(&'static str, Choice); 10] {
    [
        ("core x 2", Choice { core: 2.0, ..base }),
        ("core x 0.5", Choice { core: 0.5, ..base }),
        (
            "overlap x 2",
            Choice {
                overlap: 2.0,
                ..base
            },
        ),
        (
            "overlap x 0.5",
            Choice {
                overlap: 0.5,
                ..base
            },
        ),
        (
            "blobs from 2 chords",
            Choice {
                blobs: Some(2.0),
                ..base
            },
        ),
        (
            "blobs from 1 chord",
            Choice {
                blobs: Some(1.0),
                ..base
            },
        ),
        ("step x 0.5", Choice { steps: 80, ..base }),
        ("step x 2", Choice { steps: 20, ..base }),
        (
            "mesh x 2",
            Choice {
                mesh: [10, 20],
                ..base
            },
        ),
        (
            "mesh x 0.5",
            Choice {
                mesh: [3, 5],
                ..base
            },
        ),
    ]
}
