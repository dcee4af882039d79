//! Insects and their robots: one setting for all, nothing fitted.
//!
//! The setting: 5 x 10 panels a wing, 40 steps a beat, wakes from all edges but the root, the
//! benchmark's first-order scheme, Lamb-Oseen cores that begin at 0.07 mean chords on the wings and
//! at 0.36 in the wakes (about the distance of wake rows) and spread with the medium's viscosity,
//! wakes kept 0.1 mean chords off the wings. It is that of the fruit-fly presets.

use crate::lab::series::{Table, correlation, interpolate, mean, rms};
use crate::{Case, Part, Row, Trouble};
use std::fmt::Write;
use std::path::Path;
use wingbeat_flight::Simulation;
use wingbeat_io::LoadedCase;
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
                edge: mean lift coefficient over the second and third beat; with sheets also its sensitivity.",
        part: Part::Experiments,
        quick: false,
        run: robofly,
    },
    Case {
        name: "fruit-fly-sensitivity",
        about: "Tethered hover of the fruit fly without its body: mean lift over the weight with core, \
                step, mesh and length of wake changed.",
        part: Part::Sensitivity,
        quick: false,
        run: fruit_fly,
    },
];

/// A pair of wings on a fixed mount.
struct Insect {
    length: f64,
    area: f64,
    r2_hat: f64,
    root: f64,
    frequency: f64,
    density: f64,
    viscosity: f64,
    /// `data = ...` or angles of the right wing, as in a case file.
    motion: String,
}

/// Numerical choices, relative to the setting of all insects.
#[derive(Clone, Copy)]
struct Choice {
    shed: &'static str,
    loads: &'static str,
    core: f64,
    steps: usize,
    mesh: [usize; 2],
    rows: Option<usize>,
    beats: usize,
}

const DEFAULT: Choice = Choice {
    shed: r#"["trailing", "tip", "leading"]"#,
    loads: "pressure",
    core: 1.0,
    steps: 40,
    mesh: [5, 10],
    rows: None,
    beats: 3,
};

impl Insect {
    fn case(&self, with: Choice) -> String {
        let chord = self.area / (self.length - self.root);
        let core = |part: f64| {
            let radius = part * with.core * chord;
            format!(
                "{{ radius_m = {radius:e}, viscosity_m2_s = {:e} }}",
                self.viscosity
            )
        };
        let mut text = format!(
            "format = 1\ngravity_m_s2 = [0, 0, 0]\n\
             [time]\nsteps_per_beat = {}\nbeats = {}\n\
             [flight]\nmode = \"tethered\"\n\
             [air]\ndensity_kg_m3 = {:e}\nbody = false\nmirror = true\nshed = {}\nloads = \"{}\"\n\
             bound_core.lamb_oseen = {}\nwake_core.lamb_oseen = {}\nclearance_m = {:e}\n",
            with.steps,
            with.beats,
            self.density,
            with.shed,
            with.loads,
            core(0.07),
            core(0.36),
            0.1 * chord,
        );
        if let Some(rows) = with.rows {
            let _ = writeln!(text, "max_wake_rows = {rows}");
        }
        let _ = write!(
            text,
            "[output]\nframes_every = 0\nfigures = false\n\
             [body]\nmass_kg = 1.0\ninertia_about_centre_kg_m2 = [1e-2, 1e-2, 1e-2, 0, 0, 0]\n\
             [motion]\nfrequency_hz = {:e}\nstroke_plane_pitch_deg = 90.0\nstart = \"smooth\"\n{}\n\
             [wing.right]\nhinge_m = [0, {:e}, 0]\nmass_kg = 1e-9\n\
             [wing.right.planform.beta]\nlength_m = {:e}\narea_m2 = {:e}\nr2_hat = {:e}\n\
             root_offset_m = {:e}\naxis_fraction = 0.25\n\
             [wing.right.mesh]\nchordwise = {}\nspanwise = {}\n",
            self.frequency,
            self.motion,
            0.2 * self.length,
            self.length,
            self.area,
            self.r2_hat,
            self.root,
            with.mesh[0],
            with.mesh[1],
        );
        text
    }

    /// Force of the air on both wings [N], N, step by step.
    fn forces(&self, with: Choice) -> Result<Vec<DVec3>, Trouble> {
        let case = LoadedCase::from_text("insect", &self.case(with), Path::new(""), &[])?;
        let mut flight = Simulation::new(case.setup)?;
        let force = |f: &Simulation| f.record().air[1..].iter().map(|a| a.force).sum();
        let mut forces = vec![force(&flight)];
        while !flight.finished() {
            flight.step()?;
            forces.push(force(&flight));
        }
        Ok(forces)
    }

    /// Mean upward force of each beat from the second on [N].
    fn lifts(&self, with: Choice) -> Result<Vec<f64>, Trouble> {
        let lift: Vec<f64> = self.forces(with)?.iter().map(|f| -f.z).collect();
        let beat = |b: usize| mean(&lift[b * with.steps..=(b + 1) * with.steps]);
        Ok((1..with.beats).map(beat).collect())
    }
}

/// Middle and half-width of what the numbers span.
fn middle(x: &[f64]) -> [f64; 2] {
    let lo = x.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [x.iter().sum::<f64>() / x.len() as f64, 0.5 * (hi - lo)]
}

const MODELS: [(&str, Choice); 4] = [
    ("leading-edge sheets", DEFAULT),
    (
        "attached, pressure",
        Choice {
            shed: r#"["trailing", "tip"]"#,
            ..DEFAULT
        },
    ),
    (
        "attached, Polhamus",
        Choice {
            shed: r#"["trailing", "tip"]"#,
            loads: "polhamus",
            ..DEFAULT
        },
    ),
    (
        "attached, Joukowski",
        Choice {
            shed: r#"["trailing", "tip"]"#,
            loads: "joukowski",
            ..DEFAULT
        },
    ),
];

fn hydei(_quick: bool) -> Result<Vec<Row>, Trouble> {
    let fly = Insect {
        length: 3.333e-3,
        area: 2.66e-6,
        r2_hat: 0.579,
        root: 0.3289e-3,
        frequency: 188.7,
        density: 1.225,
        viscosity: 1.5e-5,
        motion: HYDEI.to_owned(),
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
        let lift: Vec<f64> = fly.forces(choice)?.iter().map(|f| -f.z / weight).collect();
        let beats = [1, 2].map(|b| mean(&lift[40 * b..=40 * (b + 1)]));
        let [_, spread] = middle(&beats);
        let last = &lift[80..120];
        let apart: Vec<f64> = last.iter().zip(&robot).map(|(a, b)| a - b).collect();
        rows.push(
            Row::new(format!("{name}: mean vertical force"), "weights", beats[1])
                .against(1.022, source)
                .uncertain(spread)
                .because("uncertainty: half the change from the second to the third beat"),
        );
        rows.push(
            Row::new(
                format!("{name}: rms difference over the third beat"),
                "weights",
                rms(&apart),
            )
            .because("the robot's own rms about its mean is 0.9 weights"),
        );
        rows.push(Row::new(
            format!("{name}: correlation over the third beat"),
            "1",
            correlation(last, &robot),
        ));
    }
    Ok(rows)
}

/// Stroke and feathering of the steady wingbeat (Muijres et al. 2014), mean and eight harmonics; the
/// stroke angle is positive forward, feathering turns the leading edge into the motion.
const HYDEI: &str = "
[wing.right.motion.phi.fourier]
mean_deg = 3.9008
cosine_deg = [65.0445, 3.5806, 0.1319, 0.7844]
sine_deg = [4.2642, -2.9492, 0.3639, 0.2098]
[wing.right.motion.psi.fourier]
mean_deg = 4.2936
cosine_deg = [1.8536, 5.1852, -8.4569, 3.9562, -3.0337, -2.8771, 0.8649, 0.0771]
sine_deg = [59.6529, 1.6095, 9.8057, 5.8064, -2.8749, 0.6686, -0.6137, -1.0007]";

fn robofly(_quick: bool) -> Result<Vec<Row>, Trouble> {
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
            motion: format!("data = \"robofly-{timing}\""),
        };
        // Mean stroke rate 2 Phi f at the radius of the second moment, stroke of 160 deg.
        let speed = 2.0 * 160_f64.to_radians() * robot.frequency * robot.r2_hat * robot.length;
        let q = 0.5 * robot.density * speed * speed * 2.0 * robot.area;
        for (name, choice) in MODELS {
            let [lift, spread] = middle(&robot.lifts(choice)?);
            rows.push(
                Row::new(format!("{timing}, {name}: mean lift coefficient"), "1", lift / q)
                    .uncertain(spread / q)
                    .because("over the mean speed at the radius of gyration; uncertainty: half the change from the second to the third beat"),
            );
        }
        let changes = [
            (
                "core x 2",
                Choice {
                    core: 2.0,
                    ..DEFAULT
                },
            ),
            (
                "core x 0.5",
                Choice {
                    core: 0.5,
                    ..DEFAULT
                },
            ),
            (
                "80 steps",
                Choice {
                    steps: 80,
                    ..DEFAULT
                },
            ),
            (
                "8 x 16 panels",
                Choice {
                    mesh: [8, 16],
                    ..DEFAULT
                },
            ),
        ];
        // One timing stands for all.
        let changes = changes.into_iter().filter(|_| timing == "symmetrical");
        for (name, choice) in changes {
            let [lift, spread] = middle(&robot.lifts(choice)?);
            rows.push(
                Row::new(
                    format!("{timing}, leading-edge sheets, {name}: mean lift coefficient"),
                    "1",
                    lift / q,
                )
                .uncertain(spread / q),
            );
        }
    }
    Ok(rows)
}

fn fruit_fly(_quick: bool) -> Result<Vec<Row>, Trouble> {
    let fly = Insect {
        length: 2.5e-3,
        area: 0.699e-3 * 2.5e-3,
        r2_hat: 0.58592,
        root: 0.125e-3,
        frequency: 200.0,
        density: 1.225,
        viscosity: 1.5e-5,
        motion: "data = \"fry-hover\"".to_owned(),
    };
    let weight = (0.9315e-6 + 2.0 * 5.35e-9) * 9.81;
    let mut rows = Vec::new();
    for (model, base, part) in [
        ("leading-edge sheets", DEFAULT, None),
        ("no leading-edge sheets", MODELS[1].1, Some(0.03)),
    ] {
        let [lift, spread] = middle(&fly.lifts(base)?);
        rows.push(
            Row::new(
                format!("{model}: mean lift, default"),
                "weights",
                lift / weight,
            )
            .uncertain(spread / weight)
            .because("uncertainty: half the change from the second to the third beat"),
        );
        let changes = [
            ("core x 2", Choice { core: 2.0, ..base }),
            ("core x 0.5", Choice { core: 0.5, ..base }),
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
            (
                "wake of one beat",
                Choice {
                    rows: Some(40),
                    ..base
                },
            ),
        ];
        for (name, choice) in changes {
            let [changed, spread] = middle(&fly.lifts(choice)?);
            let row = Row::new(
                format!("{model}: change of mean lift, {name}"),
                "1",
                changed / lift - 1.0,
            )
            .uncertain(spread / lift);
            rows.push(match part {
                Some(part) if name != "wake of one beat" => row
                    .against(0.0, "our own default")
                    .within(part, "what is asked without leading-edge sheets"),
                _ => row.because(
                    "with leading-edge sheets histories are chaotic: a spread, not an error",
                ),
            });
        }
    }
    Ok(rows)
}
