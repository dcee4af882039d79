//! A strip of a wing.

use std::f64::consts::PI;

use crate::error::BladeError;

/// A strip of a flat wing across its span, in the wing frame (origin at the hinge, axis 1 to
/// the leading edge, axis 2 along the span, axis 3 normal). The feathering axis is x = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip {
    /// Place along axis 2 \[m\]; negative on a left wing.
    pub y: f64,
    /// Leading edge along axis 1 \[m\].
    pub x_leading: f64,
    /// Chord c \[m\].
    pub chord: f64,
    /// Width along the span dr \[m\].
    pub width: f64,
}

impl Strip {
    /// Middle of the chord along axis 1 \[m\].
    pub fn x_mid(&self) -> f64 {
        self.x_leading - 0.5 * self.chord
    }

    /// Feathering axis behind the leading edge over the chord, x0 \[1\].
    pub fn x0(&self) -> f64 {
        self.x_leading / self.chord
    }

    /// Added mass m = rho pi/4 c^2 dr in air of the density `rho` \[kg\].
    pub(crate) fn added_mass(&self, rho: f64) -> f64 {
        0.25 * PI * rho * self.chord * self.chord * self.width
    }

    /// Added moment of inertia about mid chord, rho pi/128 c^4 dr [kg m2].
    pub(crate) fn added_inertia(&self, rho: f64) -> f64 {
        PI / 128.0 * rho * self.chord.powi(4) * self.width
    }

    /// Strips of equal width of a rectangular wing whose surface runs from `root` to `tip` \[m\]
    /// along `side` (+1 right, -1 left) with the leading edge `x_leading` \[m\] ahead of the axis.
    pub fn rectangle(
        count: usize,
        [root, tip]: [f64; 2],
        chord: f64,
        x_leading: f64,
        side: f64,
    ) -> Vec<Self> {
        let width = (tip - root) / count as f64;
        let strip = |k: usize| Self {
            y: side * (root + (k as f64 + 0.5) * width),
            x_leading,
            chord,
            width,
        };
        (0..count).map(strip).collect()
    }

    pub(crate) fn check(&self, index: usize) -> Result<(), BladeError> {
        let sizes = self.chord > 0.0 && self.width > 0.0;
        let finite = [self.y, self.x_leading, self.chord, self.width]
            .iter()
            .all(|x| x.is_finite());
        if sizes && finite {
            return Ok(());
        }
        Err(BladeError::Strip {
            index,
            span: self.y,
            chord: self.chord,
            width: self.width,
        })
    }
}
