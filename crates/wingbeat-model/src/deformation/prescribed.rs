//! Which laws a wing has.

use crate::deformation::law::Term;
use crate::deformation::surface::MovingSurface;
use crate::error::{ModelError, finite, require};
use crate::motion::WingMotion;

/// Twist, camber and bending of a wing, each the sum of its terms; or its surface as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Deformation {
    /// Place of the twist axis behind the leading edge over the chord \[1\].
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
    /// The surface itself at phases of the beat, without any of the terms.
    pub surface: Option<MovingSurface>,
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
            surface: None,
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

    /// Whether the shape is the same at all times.
    pub fn is_steady(&self) -> bool {
        self.surface.is_none() && self.terms().all(|(_, term)| term.is_steady())
    }

    /// For a wing `s` times as large: bending and places are lengths, twist and camber are not.
    pub fn scaled(&self, s: f64) -> Self {
        let bending = self.bending.iter().map(|t| Term {
            span: t.span.scaled(s),
            time: t.time.clone(),
        });
        Self {
            bending: bending.collect(),
            surface: self.surface.as_ref().map(|x| x.scaled(s)),
            ..self.clone()
        }
    }

    /// Checks every number; `root` is the least distance from the hinge over the wing length.
    ///
    /// # Errors
    /// A number that is not allowed, a table that is unsorted or does not cover the span, a term
    /// that varies over a beat that `motion` does not have, a surface beside terms or one that
    /// [`MovingSurface::check`] refuses; `name` names the wing.
    pub fn check(&self, name: &str, root: f64, motion: &WingMotion) -> Result<(), ModelError> {
        let key = |k: &str| format!("{name}.deformation.{k}");
        let (a, peak) = (self.axis_fraction, self.camber_peak);
        finite(&key("axis_fraction"), a)?;
        let inside = peak > 0.0 && peak < 1.0;
        require(&key("camber_peak"), peak, inside, "above 0 and below 1")?;
        if let Some(surface) = &self.surface {
            surface.check(&key("surface"), motion)?;
            let terms = self.terms().count();
            let (key, allowed) = (key("terms"), "0 beside a surface, which is the whole shape");
            if terms > 0 {
                return Err(ModelError::Count {
                    key,
                    value: terms,
                    allowed,
                });
            }
        }
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
