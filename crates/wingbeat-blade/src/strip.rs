//! A strip of a wing.

use std::f64::consts::PI;

use wingbeat_math::{DMat3, DVec3};

use crate::error::BladeError;

/// A strip of a flat wing across its span, in the wing frame (origin at the hinge, axis 1 to the leading edge,
/// axis 2 along the span, axis 3 normal). The feathering axis is x = 0. Of a wing that is not flat each strip
/// has a frame of its own ([`PlacedStrip`]).
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

/// Height above the plane of axes 1 and 2 over the chord that is rounding \[1\].
const FLAT: f64 = 1e-9;

/// A strip and the frame that its chord lies in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedStrip {
    /// The strip; `x` counts along its own chord.
    pub strip: Strip,
    /// Its point on the feathering axis: where the plane through the hinge across its chord meets it \[m\],
    /// wing components.
    pub axis: DVec3,
    /// Directions of chord (forward), span and normal, wing components.
    pub turn: DMat3,
}

impl PlacedStrip {
    /// Whether it lies in the plane of axes 1 and 2, its chord along axis 1.
    pub fn is_flat(&self) -> bool {
        self.turn == DMat3::IDENTITY && self.axis.z == 0.0
    }
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

    /// The part of a surface between two lines along its chord: their ends at the leading and at the trailing
    /// edge \[m\], wing frame, root first; `side` +1 right, -1 left.
    ///
    /// In the plane of axes 1 and 2 chord and width are along these axes: through the middle of the part, with its area.
    /// Elsewhere the chord is the line between the middles of both edges, and the width is across it.
    pub fn between(leading: [DVec3; 2], trailing: [DVec3; 2], side: f64) -> PlacedStrip {
        let [lead, trail] = [leading, trailing].map(|[a, b]| 0.5 * (a + b));
        let chord = (lead - trail).length();
        let along = 0.5 * ((leading[1] - leading[0]) + (trailing[1] - trailing[0]));
        let heights = leading.iter().chain(&trailing).map(|x| x.z.abs());
        if heights.fold(0.0, f64::max) <= FLAT * chord {
            // Where the lines are not along axis 1, the edges go on at the mean sweep to the middle of the part.
            let y = 0.5 * (lead.y + trail.y);
            let beside = 0.5 * (trail.y - lead.y) * along.x / along.y;
            let x_leading = lead.x + beside;
            return PlacedStrip {
                strip: Self {
                    y,
                    x_leading,
                    chord: x_leading - (trail.x - beside),
                    width: along.y.abs(),
                },
                axis: DVec3::new(0.0, y, 0.0),
                turn: DMat3::IDENTITY,
            };
        }
        let e1 = (lead - trail) / chord;
        let across = along - along.dot(e1) * e1;
        let e2 = side * across.normalize_or_zero();
        let x_leading = e1.dot(lead);
        PlacedStrip {
            strip: Self {
                y: lead.y,
                x_leading,
                chord,
                width: across.length(),
            },
            axis: lead - x_leading * e1,
            turn: DMat3::from_cols(e1, e2, e1.cross(e2)),
        }
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
