//! Prescribed deformation of a wing: twist, camber and spanwise bending as laws along the span
//! times Fourier series in time.
//!
//! In the wing frame, at the distance r from the hinge, chord c, twist axis at the part `a` of the
//! chord behind the leading edge (x = x_a):
//!
//! 1. camber lifts the mean line by `h(r, t) c g(s)` towards -axis 3, `g` a mean line of height 1
//!    and s the part of the chord behind the leading edge;
//! 2. twist turns the section by `tau(r, t)` about the parallel to axis 2 through x_a, in the sense
//!    of the feathering angle psi: positive raises the leading edge towards -axis 3;
//! 3. bending moves the section by `w(r, t)` towards -axis 3. It stays parallel to itself and at its
//!    place along axis 2, so the surface is stretched at second order of the slope dw/dr.
//!
//! Towards -axis 3 is up for a wing at zero angles. Time enters through the phase of the wing's own
//! beat, so a smooth start of the motion is one of the deformation too. Positions, velocities and
//! accelerations are analytic. Both wings of a mirrored pair have the same laws.
//!
//! The mass of the wing does not follow: for its inertia the wing stays the rigid body it was.

mod law;
mod shape;

pub use law::{Section, SpanLaw, Term};
pub use shape::{DeformingMesh, Stations};

use crate::animal::Wing;
use crate::error::{ModelError, finite, require};
use crate::motion::WingMotion;

/// Twist, camber and bending of a wing; each is the sum of its terms.
#[derive(Clone, Debug, PartialEq)]
pub struct Deformation {
    /// Place of the twist axis behind the leading edge over the chord.
    pub axis_fraction: f64,
    /// Place of the highest point of the mean line behind the leading edge over the chord, between
    /// 0 and 1; at 1/2 the line is a parabola, elsewhere the two parabolas of the NACA four-digit
    /// series [Abbott & von Doenhoff 1959, sec. 6.4].
    pub camber_peak: f64,
    /// Twist tau \[rad\].
    pub twist: Vec<Term>,
    /// Height of the mean line over the local chord h \[1\].
    pub camber: Vec<Term>,
    /// Displacement w towards -axis 3 \[m\].
    pub bending: Vec<Term>,
}

impl Default for Deformation {
    /// None, twist about the quarter chord, highest camber at mid chord.
    fn default() -> Self {
        Self {
            axis_fraction: 0.25,
            camber_peak: 0.5,
            twist: vec![],
            camber: vec![],
            bending: vec![],
        }
    }
}

impl Deformation {
    /// All terms with their names: twist, camber, bending.
    pub fn terms(&self) -> impl Iterator<Item = (String, &Term)> {
        named("twist", &self.twist)
            .chain(named("camber", &self.camber))
            .chain(named("bending", &self.bending))
    }

    /// For a wing `s` times as large: bending is a length, twist and camber are not.
    pub fn scaled(&self, s: f64) -> Self {
        let bending = self.bending.iter().map(|t| Term {
            span: t.span.scaled(s),
            time: t.time.clone(),
        });
        Self {
            bending: bending.collect(),
            ..self.clone()
        }
    }

    /// Checks every number; `root` is the least distance from the hinge over the wing length.
    ///
    /// # Errors
    /// A number that is not allowed, a table that is unsorted or does not cover the span, a term
    /// that varies over a beat that `motion` does not have; `name` names the wing.
    pub fn check(&self, name: &str, root: f64, motion: &WingMotion) -> Result<(), ModelError> {
        let key = |k: &str| format!("{name}.deformation.{k}");
        let (a, peak) = (self.axis_fraction, self.camber_peak);
        finite(&key("axis_fraction"), a)?;
        let inside = peak > 0.0 && peak < 1.0;
        require(&key("camber_peak"), peak, inside, "above 0 and below 1")?;
        for (term, law) in self.terms() {
            let key = key(&term);
            law.span.check(&key, root)?;
            law.time.check(&format!("{key}.fourier"))?;
            let f = motion.frequency;
            let beats = f > 0.0 || law.is_steady();
            let allowed = "above 0 where a deformation varies over the beat";
            require(&format!("{key}: frequency"), f, beats, allowed)?;
        }
        Ok(())
    }
}

fn named<'a>(name: &'static str, terms: &'a [Term]) -> impl Iterator<Item = (String, &'a Term)> {
    let of = move |(k, term)| (format!("{name}[{k}]"), term);
    terms.iter().enumerate().map(of)
}

impl Wing {
    /// The same wing with a prescribed deformation.
    ///
    /// # Errors
    /// As [`Deformation::check`]; a panel that loses its area at rest is found by the air.
    pub fn deformed_by(self, deformation: Deformation) -> Result<Self, ModelError> {
        deformation.check(&self.name, self.root(), &self.motion)?;
        Ok(Self {
            deformation: Some(deformation),
            ..self
        })
    }

    /// Least distance of the surface from the hinge along the span over the largest.
    pub fn root(&self) -> f64 {
        let [root, tip] = shape::span(&self.mesh);
        root / tip
    }
}
