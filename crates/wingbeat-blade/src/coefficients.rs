//! Translational lift and drag of a flapping wing: forms, and the published sets by name.
//!
//! Every shipped number was read in published material (or in code published with it); the source
//! stands with the set. A user's own numbers go into the same forms.

use std::f64::consts::PI;

use crate::error::BladeError;
use crate::error::require;

/// Lift and drag coefficient of a section as functions of the angle of attack alpha in
/// [0, 90 deg].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Translation {
    /// `C_L = lift sin 2 alpha`, `C_D = drag_0 cos^2 alpha + drag_90 sin^2 alpha`: smooth for
    /// every direction of the air.
    DoubleAngle {
        /// Largest lift coefficient, at 45 deg \[1\].
        lift: f64,
        /// Drag coefficient along the chord, at 0 deg \[1\].
        drag_0: f64,
        /// Drag coefficient across the chord, at 90 deg \[1\].
        drag_90: f64,
    },
    /// `C_L = l0 + l1 sin(l2 alpha + l3)`, `C_D = d0 + d1 cos(d2 alpha + d3)`, angles in radians.
    /// Unless C_L(0) = 0 = C_L(90 deg) the lift jumps where the air meets the chord edge-on or
    /// square.
    Harmonic {
        /// l0, l1, l2, l3.
        lift: [f64; 4],
        /// d0, d1, d2, d3.
        drag: [f64; 4],
    },
    /// `C_N = normal sin alpha`, `C_T = tangential cos^2 2 alpha` up to 45 deg, 0 above: normal
    /// force and force along the chord.
    NormalTangential {
        /// Normal force coefficient at 90 deg \[1\].
        normal: f64,
        /// Tangential force coefficient at 0 deg \[1\].
        tangential: f64,
    },
}

impl Translation {
    /// Lift and drag coefficients at the angle of attack `alpha` [rad].
    ///
    /// ```
    /// use wingbeat_blade::find_set;
    /// let robofly = find_set("dickinson-1999").unwrap().law;
    /// let [lift, _] = robofly.at(45_f64.to_radians());
    /// assert!((lift - 1.804).abs() < 1e-3); // 0.225 + 1.58 sin(2.13 x 45 deg - 7.2 deg)
    /// ```
    pub fn at(&self, alpha: f64) -> [f64; 2] {
        let (s, c) = alpha.sin_cos();
        self.of_direction(s, c)
    }

    /// Lift and drag coefficients from sine and cosine (both >= 0) of the angle of attack.
    pub(crate) fn of_direction(&self, sin: f64, cos: f64) -> [f64; 2] {
        match *self {
            Self::DoubleAngle {
                lift,
                drag_0,
                drag_90,
            } => [
                2.0 * lift * sin * cos,
                drag_0 * cos * cos + drag_90 * sin * sin,
            ],
            Self::Harmonic { lift, drag } => {
                let alpha = sin.atan2(cos);
                let [l0, l1, l2, l3] = lift;
                let [d0, d1, d2, d3] = drag;
                [
                    l0 + l1 * (l2 * alpha + l3).sin(),
                    d0 + d1 * (d2 * alpha + d3).cos(),
                ]
            }
            Self::NormalTangential { normal, tangential } => {
                let double = cos * cos - sin * sin;
                let t = if double > 0.0 {
                    tangential * double * double
                } else {
                    0.0
                };
                let n = normal * sin;
                [n * cos - t * sin, n * sin + t * cos]
            }
        }
    }

    /// Checks that the numbers are finite and drag never feeds energy.
    ///
    /// # Errors
    /// A coefficient that is not finite; a drag coefficient below 0 at some angle of attack.
    pub fn check(&self) -> Result<(), BladeError> {
        for k in 0..=90 {
            let [lift, drag] = self.at(PI / 180.0 * f64::from(k));
            require(
                lift.is_finite(),
                "lift coefficient",
                lift,
                "a finite number",
            )?;
            let ok = drag.is_finite() && drag >= 0.0;
            require(
                ok,
                "drag coefficient",
                drag,
                "a number >= 0 at every angle of attack",
            )?;
        }
        Ok(())
    }
}

/// A published set of coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedSet {
    /// Name in a case.
    pub name: &'static str,
    /// Where the numbers come from.
    pub source: &'static str,
    /// Reynolds number at which they were measured \[1\], where the source says one.
    pub reynolds: Option<f64>,
    /// The coefficients.
    pub law: Translation,
}

const DEGREE: f64 = PI / 180.0;

/// `C_L = lift sin 2 alpha`, `C_D = mean - swing cos 2 alpha`.
const fn double(lift: f64, mean: f64, swing: f64) -> Translation {
    Translation::DoubleAngle {
        lift,
        drag_0: mean - swing,
        drag_90: mean + swing,
    }
}

/// The shipped sets, all read in published papers or in code published with them.
pub const SETS: &[NamedSet] = &[
    NamedSet {
        name: "dickson-2008",
        source: "Dickson, Straw & Dickinson 2008 as coded in willdickson/fmech: C_L = 3.3207 sin a cos a, C_D = 3.1670 sin^2 a + 0.4123",
        reynolds: None,
        law: Translation::DoubleAngle {
            lift: 0.5 * 3.3207,
            drag_0: 0.4123,
            drag_90: 3.1670 + 0.4123,
        },
    },
    NamedSet {
        name: "dickinson-1999",
        source: "Dickinson, Lehmann & Sane 1999 (Robofly, Re 136): C_L = 0.225 + 1.58 sin(2.13 a - 7.2 deg), C_D = 1.92 - 1.55 cos(2.04 a - 9.82 deg)",
        reynolds: Some(136.0),
        law: Translation::Harmonic {
            lift: [0.225, 1.58, 2.13, -7.2 * DEGREE],
            drag: [1.92, -1.55, 2.04, -9.82 * DEGREE],
        },
    },
    NamedSet {
        name: "berman-wang-fruit-fly",
        source: "Berman & Wang 2007, fruit fly: C_T = 1.833, C_D(0) = 0.21, C_D(90 deg) = 3.35",
        reynolds: None,
        law: Translation::DoubleAngle {
            lift: 1.833,
            drag_0: 0.21,
            drag_90: 3.35,
        },
    },
    NamedSet {
        name: "whitney-wood-2010",
        source: "Whitney & Wood 2010: C_L = 1.8 sin 2a, C_D = (3.4 + 0.4)/2 - (3.4 - 0.4)/2 cos 2a",
        reynolds: None,
        law: double(1.8, 1.9, 1.5),
    },
    NamedSet {
        name: "wang-dragonfly",
        source: "Wang 2004/2005, dragonfly: C_L = 1.2 sin 2a, C_D = 1.4 - cos 2a",
        reynolds: None,
        law: double(1.2, 1.4, 1.0),
    },
    NamedSet {
        name: "byl",
        source: "Byl: C_L = 1.8 sin 2a, C_D = 1.8 (1 - cos 2a)",
        reynolds: None,
        law: double(1.8, 1.8, 1.8),
    },
    NamedSet {
        name: "deng-2006",
        source: "Deng et al. 2006: C_N = 3.4 sin a, C_T = 0.4 cos^2 2a up to 45 deg",
        reynolds: None,
        law: Translation::NormalTangential {
            normal: 3.4,
            tangential: 0.4,
        },
    },
];

/// The shipped set of this name.
///
/// # Errors
/// [`BladeError::UnknownSet`] lists the names.
pub fn find_set(name: &str) -> Result<NamedSet, BladeError> {
    let found = SETS.iter().find(|s| s.name == name);
    found.copied().ok_or_else(|| BladeError::UnknownSet {
        name: name.to_owned(),
        known: SETS.iter().map(|s| s.name).collect::<Vec<_>>().join(", "),
    })
}
