//! What a blade-element model consists of.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wingbeat_math::{DVec2, DVec3};

use crate::coefficients::{Translation, find_set};
use crate::error::{BladeError, require};
use crate::indicial::Unsteady;

/// The blade-element model of a wing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeSettings {
    /// Density of the air rho [kg/m3].
    pub density: f64,
    /// Velocity of the undisturbed air, an induced flow included, N components [m/s].
    pub free_stream: DVec3,
    /// Translational lift and drag.
    pub translation: Translation,
    /// Where they act.
    pub centre_of_pressure: CentreOfPressure,
    /// Force of feathering while sweeping.
    pub rotation: Rotation,
    /// Added mass.
    pub added_mass: AddedMassModel,
    /// Viscous moment against feathering.
    pub viscous: Option<ViscousMoment>,
    /// How the circulation lags behind the motion; none: quasi-steady.
    pub unsteady: Option<Unsteady>,
}

/// Place of the translational and rotational force along the chord.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CentreOfPressure {
    /// At this part of the chord behind the edge that meets the air: `centre_of_pressure.fixed = 0.25`, say.
    Fixed(#[schemars(range(min = 0, max = 1))] f64),
    /// From 1/4 of the chord edge-on to 1/2 square to the air, `(2 - cos alpha)/4` behind the
    /// leading edge; a smooth interpolation of this program between the two theories.
    Cosine,
    /// `0.25 + 0.25/(1 + exp(5 (1 - 4 alpha/pi)))` [Chen 2016 as coded in avikde/robobee3d].
    Chen2016,
}

/// The force of a wing that feathers while it sweeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotation {
    /// Left out.
    None,
    /// `rho U C_rot c^2 q dr` **normal to the wing**, `C_rot = pi (0.75 - x0)`
    /// [Sane & Dickinson 2002]. U is the speed with the sign of u, so the force jumps where u
    /// changes sign while w does not vanish.
    SaneDickinson,
    /// Thin-airfoil theory for whichever edge meets the air, continuous for every motion: the force `rho Gamma` across the
    /// velocity (Kutta & Joukowski) with `C_rot = pi (1/4 + (1/2 - x0) cos alpha)`, the cosine negative where the air
    /// comes from behind, and the moment against feathering, `-(pi/16) rho c^3 abs(u) q dr` [Theodorsen 1935]. Every
    /// [`Unsteady`] law has both.
    Circulation,
    /// The force `rho Gamma` alone, with one coefficient for all strips, `Gamma = coefficient c^2 q`:
    /// `C_R/2` in [Berman & Wang 2007] (its C_R = pi is not checked against the paper).
    Coefficient(f64),
}

/// The added mass `m = rho pi/4 c^2 dr` of a strip; v is the normal velocity of mid chord.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AddedMassModel {
    /// Left out.
    None,
    /// The rate of the momentum `m v` along the normal that the strip gives the air,
    /// and of its angular momentum with the added moment of inertia `rho pi/128 c^4 dr` of the
    /// section (Kirchhoff's equations): no mean force over a periodic motion. Munk's couple `m v u`
    /// is left to the centre of pressure, which it moves from mid chord to a quarter in thin-airfoil theory.
    Impulse,
    /// `-m` times the rate of v, along the normal
    /// [Sane & Dickinson 2001]. It stores energy `m v^2/2` and dissipates none, but a wing that turns
    /// feels a mean force of it.
    Normal,
    /// The same in plane motion only, that of a section: with the force `-m q v` along the chord and the added moment
    /// of inertia `rho pi/128 c^4 dr` (Kirchhoff's equations of a plate, as in [Berman & Wang 2007]).
    Section,
}

/// Viscous moment `-(pi/16) rho c^4 (linear + quadratic abs q) q dr` against feathering
/// [Berman & Wang 2007: linear = mu1 f, quadratic = mu2; mu1 = mu2 = 0.2, form and numbers
/// not checked against the paper].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViscousMoment {
    /// mu1 f [1/s].
    pub linear: f64,
    /// mu2 \[1\].
    pub quadratic: f64,
}

impl CentreOfPressure {
    /// Place behind the leading edge over the chord where the air comes edge-on from ahead \[1\].
    pub fn edge_on(self) -> f64 {
        self.behind_leading_edge(DVec2::ZERO, DVec2::ONE).x
    }

    /// Places behind the leading edge over the chord by sine and cosine of the angles of attack \[1\], of two strips.
    #[inline]
    pub(crate) fn behind_leading_edge(self, sin: DVec2, cos: DVec2) -> DVec2 {
        let from_edge_met = match self {
            Self::Cosine => return 0.5 - 0.25 * cos,
            Self::Fixed(x) => DVec2::splat(x),
            Self::Chen2016 => {
                let of = |k: usize| {
                    let alpha = sin[k].abs().atan2(cos[k].abs());
                    0.25 + 0.25 / (1.0 + (5.0 * (1.0 - 4.0 * alpha / PI)).exp())
                };
                DVec2::new(of(0), of(1))
            }
        };
        // Air from behind meets the trailing edge.
        let part = |k: usize| match cos[k] < 0.0 {
            true => 1.0 - from_edge_met[k],
            false => from_edge_met[k],
        };
        DVec2::new(part(0), part(1))
    }
}

impl AddedMassModel {
    /// Whether it is that of Kirchhoff's equations: with the section's added moment of inertia and the force `-m q v`
    /// along the chord.
    pub(crate) fn is_kirchhoff(self) -> bool {
        matches!(self, Self::Impulse | Self::Section)
    }
}

impl BladeSettings {
    /// Whether feathering is damped by `-(pi/16) rho c^3 abs(u) q dr`, as in thin-airfoil theory.
    pub fn damps_feathering(&self) -> bool {
        self.unsteady.is_some() || self.rotation == Rotation::Circulation
    }

    /// The default for small insects in still air: coefficients `dickson-2008`, circulation and
    /// moment of feathering, added mass by impulse, `Cosine` centre of pressure.
    pub fn insect(density: f64) -> Self {
        Self {
            density,
            free_stream: DVec3::ZERO,
            translation: find_set("dickson-2008").expect("a shipped set").law,
            centre_of_pressure: CentreOfPressure::Cosine,
            rotation: Rotation::Circulation,
            added_mass: AddedMassModel::Impulse,
            viscous: None,
            unsteady: None,
        }
    }

    /// Berman & Wang's model of the fruit fly at the wingbeat frequency `frequency` [Hz]:
    /// coefficients as read; `C_R = pi`, `mu1 = mu2 = 0.2` and the form of the viscous moment are not
    /// checked against the paper.
    pub fn berman_wang(density: f64, frequency: f64) -> Self {
        Self {
            translation: find_set("berman-wang-fruit-fly")
                .expect("a shipped set")
                .law,
            rotation: Rotation::Coefficient(0.5 * PI),
            added_mass: AddedMassModel::Section,
            viscous: Some(ViscousMoment {
                linear: 0.2 * frequency,
                quadratic: 0.2,
            }),
            ..Self::insect(density)
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`BladeError::Value`] names the first that is not allowed.
    pub fn check(&self) -> Result<(), BladeError> {
        let at_least_0 = |x: f64| x.is_finite() && x >= 0.0;
        let rho = self.density;
        require(at_least_0(rho), "density", rho, "a finite number >= 0")?;
        let stream = self.free_stream.length();
        require(
            stream.is_finite(),
            "free_stream",
            stream,
            "a finite velocity",
        )?;
        if let CentreOfPressure::Fixed(x) = self.centre_of_pressure {
            require(
                (0.0..=1.0).contains(&x),
                "centre_of_pressure",
                x,
                "a part of the chord, 0 to 1,",
            )?;
        }
        if let Rotation::Coefficient(c) = self.rotation {
            require(c.is_finite(), "rotation", c, "a finite number")?;
        }
        if let Some(v) = self.viscous {
            require(
                at_least_0(v.linear),
                "viscous.linear",
                v.linear,
                "a finite number >= 0",
            )?;
            require(
                at_least_0(v.quadratic),
                "viscous.quadratic",
                v.quadratic,
                "a finite number >= 0",
            )?;
        }
        self.unsteady.map_or(Ok(()), Unsteady::check)?;
        self.translation.check()
    }
}
