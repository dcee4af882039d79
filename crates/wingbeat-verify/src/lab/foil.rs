//! The foil of Heathcote & Gursul: a rigid third of a chord of 90 mm, behind it a plate of steel, plunging in water.

use std::path::Path;

use wingbeat_case::{IoError, LoadedCase};

/// Chord \[m\].
pub const CHORD: f64 = 0.09;
/// Span of the section that is flown \[m\].
pub const SPAN: f64 = 18.0;
/// Speed of the stream \[m/s\].
pub const SPEED: f64 = 0.1;
/// Amplitude of the plunge of the experiment \[m\].
pub const HEAVE: f64 = 0.0175;

/// How the foil is built, how it moves and how finely.
#[derive(Clone, Copy, Debug)]
pub struct PlungingFoil {
    /// Thickness of the plate over the chord \[1\].
    pub thickness: f64,
    /// Frequency of the plunge \[Hz\].
    pub frequency: f64,
    /// Amplitude of the plunge \[m\].
    pub heave: f64,
    /// Panels along the chord, a multiple of 3.
    pub rows: usize,
    /// Steps of a beat.
    pub steps: usize,
    /// Beats.
    pub beats: usize,
    /// Beats that wakes are kept \[1\].
    pub kept: f64,
}

impl PlungingFoil {
    /// Its case, changed by `more` keys.
    ///
    /// # Errors
    /// Keys that cannot be flown.
    pub fn case(&self, more: &[String]) -> Result<LoadedCase, IoError> {
        let (f, thickness) = (self.frequency, self.thickness * CHORD);
        let mut set = vec![
            format!("flight.tether.z.frequency_hz={f}"),
            format!("flight.tether.z.cosine_m=[{}]", self.heave),
            format!("time.step_s={}", 1.0 / (f * self.steps as f64)),
            format!("time.steps={}", self.steps * self.beats),
            format!("air.max_wake_age_s={}", self.kept / f),
            format!("wing.right.mesh.chordwise={}", self.rows),
            format!("wing.right.structure.shell.thickness_m=[{thickness},{thickness}]"),
            format!("wing.right.structure.vein=[{}]", bars(self.rows)),
        ];
        set.extend_from_slice(more);
        let text = include_str!("../../data/heathcote-gursul.toml");
        LoadedCase::from_text("heathcote-gursul", text, Path::new(""), &set)
    }
}

/// Bars without mass from end to end of every row of nodes behind the rigid third of the chord: both ends of
/// the one panel along the span bend alike.
fn bars(rows: usize) -> String {
    let bar = |i: usize| {
        let x = format!("{:?}", i as f64 / rows as f64);
        let stiffness = "bending_newton_m2 = [100.0, 100.0], torsion_newton_m2 = [1e5, 1e5]";
        format!("{{ from = [0.0, {x}], to = [1.0, {x}], radius_m = [0.01, 0.01], {stiffness} }}")
    };
    let all: Vec<String> = (rows / 3 + 1..=rows).map(bar).collect();
    all.join(", ")
}
