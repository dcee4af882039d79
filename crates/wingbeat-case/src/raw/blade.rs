//! `[air.blade]`: the blade-element model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_blade::{AddedMassModel, CentreOfPressure};

/// Blade elements: quasi-steady or with a wake for each strip, one strip per spanwise panel.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BladeCase {
    /// Published set of translational coefficients by name: `dickson-2008`, `dickinson-1999`, `berman-wang-fruit-fly`,
    /// `whitney-wood-2010`, `wang-dragonfly`, `byl`, `deng-2006`.
    ///
    /// Change it to the set that was measured nearest to your Reynolds number and aspect ratio.
    #[default("dickson-2008".to_owned())]
    #[schemars(extend("with" = "no own"))]
    pub coefficients: String,
    /// Coefficients of your own instead: `C_L = lift sin 2a`,
    /// `C_D = drag_0 cos^2 a + drag_90 sin^2 a`.
    ///
    /// Change it where you have measured a wing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub own: Option<OwnCoefficients>,
    /// Force of feathering while sweeping.
    ///
    /// Change it to reproduce a published model.
    #[default(RotationCase::Circulation)]
    pub rotation: RotationCase,
    /// Coefficient C of the circulation `C c^2 q` of feathering for all strips, without a moment against feathering;
    /// left out: by thin-airfoil theory.
    ///
    /// Change it to reproduce a published model.
    #[schemars(extend("with" = "rotation = circulation"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_coefficient: Option<f64>,
    /// Added mass, of the motion of the wings through the air: the rate at which the wind changes at a moving
    /// strip is in it (with `unsteady` that of gusts without a front; Kuessner's function has the rest). A jump
    /// of a gust's table has no rate.
    ///
    /// Change it to reproduce a published model.
    #[default(AddedMassModel::Impulse)]
    pub added_mass: AddedMassModel,
    /// Where the force acts.
    ///
    /// Change it to reproduce a published model.
    #[default(CentreOfPressure::Cosine)]
    pub centre_of_pressure: CentreOfPressure,
    /// Viscous moment against feathering (Berman & Wang); left out: none.
    ///
    /// Change it for wings that feather passively.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscous: Option<ViscousCase>,
    /// How the circulation of a strip lags behind its motion, for the wake that it leaves.
    ///
    /// Change it for wings that vibrate or meet gusts, in a stream or in forward flight; in hover wings meet
    /// their wakes again, of which this knows nothing.
    #[default(UnsteadyCase::None)]
    pub unsteady: UnsteadyCase,
    /// States of the wake of each strip.
    ///
    /// Change it to fewer for speed: 6 have Theodorsen's function within 1.7 % instead of 1.1 %.
    #[default(8)]
    #[schemars(range(min = 2, max = 8), extend("with" = "unsteady = peters"))]
    pub states: usize,
    /// Drag of the body; left out: none.
    ///
    /// Change it for forward flight.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body_drag: Option<BodyDragCase>,
    /// Induced flow at the wings, inertial axes; zero for coefficients measured on flapping
    /// wings.
    ///
    /// Change it with coefficients of wings in steady flow.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub induced_m_s: [f64; 3],
}

/// Coefficients of your own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OwnCoefficients {
    /// Lift coefficient at 45 degrees.
    ///
    /// Change it to what was measured.
    pub lift: f64,
    /// Drag coefficient at 0 degrees.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub drag_0: f64,
    /// Drag coefficient at 90 degrees.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub drag_90: f64,
}

/// Force of feathering while sweeping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RotationCase {
    /// Left out.
    None,
    /// Circulation of feathering by thin-airfoil theory for whichever edge meets the air, with its moment against
    /// feathering, as `unsteady` laws always have both. It is continuous for every motion.
    Circulation,
    /// A force normal to the wing (Sane & Dickinson 2002). It jumps where the air along a chord reverses while it
    /// meets the wing broadside: flights are as good as their steps, derivatives and modes of flight are none. It has
    /// no moment against feathering, so without `unsteady` it makes the torsion of elastic wings grow.
    SaneDickinson,
}

/// How the circulation of a strip lags behind its motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UnsteadyCase {
    /// Not at all: quasi-steady.
    None,
    /// Wagner's function as two exponentials (R. T. Jones 1940).
    Jones,
    /// States of induced flow (Peters, Karunamoorthy & Cao 1995).
    Peters,
}

/// Viscous moment `-(pi/16) rho c^4 (linear + quadratic |q|) q` per span.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousCase {
    /// Linear part (mu1 times the wingbeat frequency).
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub linear_hz: f64,
    /// Quadratic part (mu2).
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub quadratic: f64,
}

/// Drag of the body along and across its axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyDragCase {
    /// Reference area, before `animal.scale`, by whose square it grows.
    ///
    /// Change it to the frontal area of the body.
    #[schemars(range(min = 0))]
    pub area_m2: f64,
    /// Coefficient along the body.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub along: f64,
    /// Coefficient across it.
    ///
    /// Change it to what was measured.
    #[schemars(range(min = 0))]
    pub across: f64,
    /// Where it acts, in the body frame in which hinges are given, before `animal.scale`: it follows the
    /// velocity of this point and turns the body by its lever. Left out: the centre of the volume of the body's
    /// parts, without parts the mass centre of the body.
    ///
    /// Change it to where the drag was found to act.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centre_m: Option<[f64; 3]>,
}
