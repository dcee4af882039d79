//! Insects and their robots: one setting for all, nothing fitted.
//!
//! The setting: 5 x 10 panels a wing, 40 steps a beat, wakes from all edges but the root, the
//! accurate scheme, forces on segments, algebraic cores (Lamb-Oseen ones beside blobs and particles) that begin at 0.01 mean chords on the wings (well below a
//! panel) and at 0.07 in the wakes, spread with the medium's viscosity and are as wide in the wakes as
//! filaments are long, wakes kept 0.1 mean chords off the wings; particles begin with 0.36 mean chords
//! (about the distance of wake rows). It is that of the fruit-fly presets. Motions start smoothly
//! over the first beat, after which they lag half a beat.

use std::fmt::Write;
use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

use super::series::mean;
use crate::row::Trouble;

/// A pair of wings on a fixed mount.
pub(crate) struct Insect {
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
pub(crate) struct Choice {
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
pub(crate) enum Cut {
    /// Nowhere.
    Nowhere,
    /// After so many rows.
    Rows(usize),
    /// After so many beats.
    Beats(f64),
    /// So many wing lengths from their edges.
    Lengths(f64),
}

pub(crate) const DEFAULT: Choice = Choice {
    shed: r#"["trailing", "tip", "leading"]"#,
    loads: "joukowski",
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
pub(crate) struct Fluid {
    pub density: f64,
    pub viscosity: f64,
    pub stream: [f64; 3],
    pub chord: f64,
    pub length: f64,
    pub frequency: f64,
}

impl Choice {
    /// A case file as far as the air.
    pub(crate) fn air(&self, fluid: Fluid) -> String {
        let core = |part: f64| {
            let radius = part * self.core * fluid.chord;
            let nu = fluid.viscosity;
            format!("{{ radius_m = {radius:e}, viscosity_m2_s = {nu:e} }}")
        };
        // Blobs and particles want their own kind.
        let kind = match self.blobs.is_some() || self.particles {
            true => "lamb_oseen",
            false => "algebraic",
        };
        let mut text = format!(
            "format = 1\ngravity_m_s2 = [0, 0, 0]\n\
             [time]\nsteps_per_beat = {}\nbeats = {}\n\
             [flight]\nmode = \"tethered\"\n\
             [air]\ndensity_kg_m3 = {:e}\nstream_m_s = {:?}\nbody = false\nmirror = true\nscheme = \"accurate\"\nshed = {}\n\
             loads = \"{}\"\n\
             bound_core.{kind} = {}\nwake_core.{kind} = {}\nwake_overlap = {:e}\nclearance_m = {:e}\n",
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
pub(crate) fn forces(case: &str) -> Result<Vec<DVec3>, Trouble> {
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
    pub fn case(&self, with: Choice) -> String {
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
pub(crate) fn middle(x: &[f64]) -> [f64; 2] {
    let lo = x.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [x.iter().sum::<f64>() / x.len() as f64, 0.5 * (hi - lo)]
}

pub(crate) const MODELS: [(&str, Choice); 5] = [
    ("leading-edge sheets", DEFAULT),
    (
        "leading-edge particles",
        Choice {
            particles: true,
            loads: "pressure",
            ..DEFAULT
        },
    ),
    (
        "attached, pressure",
        Choice {
            shed: r#"["trailing", "tip"]"#,
            loads: "pressure",
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

/// The wings of the fruit-fly presets and the animal's weight [N].
pub(crate) fn fruit_fly_wings() -> (Insect, f64) {
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
