//! Insects and their robots: one setting for all, nothing fitted.
//!
//! The setting: 5 x 10 panels a wing, 40 steps a beat, wakes from all edges but the root, the
//! accurate scheme, Lamb-Oseen cores that begin at 0.01 mean chords on the wings (well below a
//! panel) and at 0.07 in the wakes, spread with the medium's viscosity and are as wide in the wakes as
//! filaments are long, wakes kept 0.1 mean chords off the wings; particles begin with 0.36 mean chords
//! (about the distance of wake rows). It is that of the fruit-fly presets. Motions start smoothly
//! over the first beat, after which they lag half a beat.

use crate::lab::series::{Table, correlation, interpolate, mean, rms};
use crate::{Case, Part, Row, Trouble};
use std::fmt::Write;
use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
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

/// A pair of wings on a fixed mount.
pub(super) struct Insect {
    pub length: f64,
    pub area: f64,
    pub r2_hat: f64,
    pub root: f64,
    pub frequency: f64,
    pub density: f64,
    pub viscosity: f64,
    /// `data = ...` or angles of the right wing, as in a case file.
    pub motion: String,
}

/// Numerical choices, relative to the setting of all insects.
#[derive(Clone, Copy)]
pub(super) struct Choice {
    pub shed: &'static str,
    pub loads: &'static str,
    pub core: f64,
    pub overlap: f64,
    /// Length, in chords, from which wake filaments become blobs.
    pub blobs: Option<f64>,
    pub steps: usize,
    pub mesh: [usize; 2],
    pub cut: Cut,
    pub particles: bool,
    pub beats: usize,
}

/// Where wakes end.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Cut {
    /// Nowhere.
    Nowhere,
    /// After so many rows.
    Rows(usize),
    /// After so many beats.
    Beats(f64),
    /// So many wing lengths from their edges.
    Lengths(f64),
}

pub(super) const DEFAULT: Choice = Choice {
    shed: r#"["trailing", "tip", "leading"]"#,
    loads: "pressure",
    core: 1.0,
    overlap: 1.0,
    blobs: None,
    steps: 40,
    mesh: [5, 10],
    cut: Cut::Nowhere,
    particles: false,
    beats: 3,
};

/// What the air of a case needs to know.
pub(super) struct Fluid {
    pub density: f64,
    pub viscosity: f64,
    pub stream: [f64; 3],
    pub chord: f64,
    pub length: f64,
    pub frequency: f64,
}

impl Choice {
    /// A case file as far as the air.
    pub(super) fn air(&self, fluid: Fluid) -> String {
        let core = |part: f64| {
            let radius = part * self.core * fluid.chord;
            let nu = fluid.viscosity;
            format!("{{ radius_m = {radius:e}, viscosity_m2_s = {nu:e} }}")
        };
        let mut text = format!(
            "format = 1\ngravity_m_s2 = [0, 0, 0]\n\
             [time]\nsteps_per_beat = {}\nbeats = {}\n\
             [flight]\nmode = \"tethered\"\n\
             [air]\ndensity_kg_m3 = {:e}\nstream_m_s = {:?}\nbody = false\nmirror = true\nscheme = \"accurate\"\nshed = {}\n\
             loads = \"{}\"\n\
             bound_core.lamb_oseen = {}\nwake_core.lamb_oseen = {}\nwake_overlap = {:e}\nclearance_m = {:e}\n",
            self.steps,
            self.beats,
            fluid.density,
            fluid.stream,
            self.shed,
            self.loads,
            core(0.01),
            core(0.07),
            self.overlap,
            0.1 * fluid.chord,
        );
        if let Some(chords) = self.blobs {
            let length = chords * fluid.chord;
            let _ = writeln!(text, "wake_blob_length_m = {length:e}");
        }
        let _ = match self.cut {
            Cut::Nowhere => Ok(()),
            Cut::Rows(rows) => writeln!(text, "max_wake_rows = {rows}"),
            Cut::Beats(n) => writeln!(text, "max_wake_age_s = {:e}", n / fluid.frequency),
            Cut::Lengths(n) => writeln!(text, "max_wake_distance_m = {:e}", n * fluid.length),
        };
        if self.particles {
            let radius = 0.36 * self.core * fluid.chord;
            let _ = writeln!(
                text,
                "particles = {{ leading_edge = true, radius_m = {radius:e} }}"
            );
        }
        text
    }
}

/// Force of the air on all wings [N], N, step by step, of a case without a body in the air.
pub(super) fn forces(case: &str) -> Result<Vec<DVec3>, Trouble> {
    let case = LoadedCase::from_text("insect", case, Path::new(""), &[])?;
    let mut flight = Simulation::new(case.setup)?;
    let force = |f: &Simulation| f.record().air[1..].iter().map(|a| a.force).sum();
    let mut forces = vec![force(&flight)];
    while !flight.finished() {
        flight.step()?;
        forces.push(force(&flight));
    }
    Ok(forces)
}

impl Insect {
    fn case(&self, with: Choice) -> String {
        let mut text = with.air(Fluid {
            density: self.density,
            viscosity: self.viscosity,
            stream: [0.0; 3],
            chord: self.area / (self.length - self.root),
            length: self.length,
            frequency: self.frequency,
        });
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

    /// Mean upward force of each beat from the second on [N].
    pub fn lifts(&self, with: Choice) -> Result<Vec<f64>, Trouble> {
        let lift: Vec<f64> = forces(&self.case(with))?.iter().map(|f| -f.z).collect();
        let beat = |b: usize| mean(&lift[b * with.steps..=(b + 1) * with.steps]);
        Ok((1..with.beats).map(beat).collect())
    }
}

/// Middle and half-width of what the numbers span.
pub(super) fn middle(x: &[f64]) -> [f64; 2] {
    let lo = x.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [x.iter().sum::<f64>() / x.len() as f64, 0.5 * (hi - lo)]
}

pub(super) const MODELS: [(&str, Choice); 5] = [
    ("leading-edge sheets", DEFAULT),
    (
        "leading-edge particles",
        Choice {
            particles: true,
            ..DEFAULT
        },
    ),
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
        let lift = forces(&fly.case(choice))?;
        let lift: Vec<f64> = lift.iter().map(|f| -f.z / weight).collect();
        let beats = [1, 2].map(|b| mean(&lift[40 * b..=40 * (b + 1)]));
        let [_, spread] = middle(&beats);
        let last = &lift[60..100]; // the second beat: a smooth start takes half a beat of phase
        let apart: Vec<f64> = last.iter().zip(&robot).map(|(a, b)| a - b).collect();
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
                rms(&apart),
            )
            .because("the robot's own rms about its mean is 0.9 weights"),
        );
        rows.push(Row::new(
            format!("{name}: correlation over the motion's second beat"),
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
            rows.push(robofly_row(&robot, q, format!("{timing}, {name}"), choice)?);
        }
    }
    Ok(rows)
}

/// Mean lift coefficient, and as its uncertainty half of what beats, core, step and mesh span.
fn robofly_row(robot: &Insect, q: f64, name: String, base: Choice) -> Result<Row, Trouble> {
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

/// The wings of the fruit-fly presets and the animal's weight [N].
pub(super) fn fruit_fly_wings() -> (Insect, f64) {
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
    (fly, (0.9315e-6 + 2.0 * 5.35e-9) * 9.81)
}

fn fruit_fly(_quick: bool) -> Result<Vec<Row>, Trouble> {
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
        let changes = [
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
