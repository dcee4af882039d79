//! `[air.derivatives]`; programs that are asked: `[air.external]`, `[control.external]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Stability derivatives of the whole animal in axes fixed in the body: forward, right, down at
/// the reference attitude; moments about the mass centre of the body. Matrices have rows X, Y, Z
/// (or L, M, N) and columns u, v, w (or p, q, r).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DerivativesCase {
    /// Pitch of the body in the reference flight: the angle about b2 from the table's axes to
    /// the body's.
    ///
    /// Change it to the body angle of the flight that was linearised.
    pub body_pitch_deg: f64,
    /// Roll of the body in the reference flight, after the pitch: the angle about the body's b1.
    ///
    /// Change it to that of a flight with sideslip that was linearised.
    pub body_roll_deg: f64,
    /// Velocity in the reference flight, axes of the table.
    ///
    /// Change it to that of the flight that was linearised.
    #[schemars(inner(range(min = -10_000, max = 10_000)))]
    pub velocity_m_s: [f64; 3],
    /// Force in the reference flight; left out: it carries the weight.
    ///
    /// Change it where the reference flight is not in balance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_newton: Option<[f64; 3]>,
    /// Moment in the reference flight.
    ///
    /// Change it where the reference flight is not in balance.
    pub moment_newton_m: [f64; 3],
    /// Force by velocity; left out: none.
    ///
    /// Change it to what was measured or computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_by_velocity_newton_s_m: Option<[[f64; 3]; 3]>,
    /// Force by angular velocity; left out: none.
    ///
    /// Change it to what was measured or computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_by_rate_newton_s: Option<[[f64; 3]; 3]>,
    /// Moment by velocity; left out: none.
    ///
    /// Change it to what was measured or computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_by_velocity_newton_s: Option<[[f64; 3]; 3]>,
    /// Moment by angular velocity; left out: none.
    ///
    /// Change it to what was measured or computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moment_by_rate_newton_m_s: Option<[[f64; 3]; 3]>,
    /// Added mass of the air: force, reversed, by the rate of the velocity through the air, symmetric; left out: none.
    ///
    /// Change it to what was computed; light wings in air carry as much of it as they weigh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added_mass_kg: Option<[[f64; 3]; 3]>,
    /// The same by the rate of the angular velocity; transposed: moment by the rate of the velocity.
    ///
    /// Change it to what was computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added_mass_by_turning_kg_m: Option<[[f64; 3]; 3]>,
    /// Added inertia: moment, reversed, by the rate of the angular velocity, symmetric; left out: none.
    ///
    /// Change it to what was computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added_inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// Dimensionless derivatives instead of the four matrices.
    ///
    /// Change it for tables of papers.
    #[schemars(extend("or" = [
        "force_by_velocity_newton_s_m",
        "force_by_rate_newton_s",
        "moment_by_velocity_newton_s",
        "moment_by_rate_newton_m_s"
    ]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dimensionless: Option<DimensionlessCase>,
}

/// Dimensionless derivatives: forces over `rho U^2 S / 2`, moments over that times c, velocities
/// over U, angular velocities times the period of the wingbeat (Sun & Xiong 2005).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DimensionlessCase {
    /// Reference speed U.
    ///
    /// Change it to that of the table.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 340))]
    pub speed_m_s: f64,
    /// Area S of all wings.
    ///
    /// Change it to that of the table.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub area_m2: f64,
    /// Mean chord c.
    ///
    /// Change it to that of the table.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub chord_m: f64,
    /// Period of the wingbeat.
    ///
    /// Change it to that of the table.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub period_s: f64,
    /// Force by velocity.
    ///
    /// Change it to what was measured or computed.
    #[serde(default)]
    pub force_by_velocity: [[f64; 3]; 3],
    /// Force by angular velocity.
    ///
    /// Change it to what was measured or computed.
    #[serde(default)]
    pub force_by_rate: [[f64; 3]; 3],
    /// Moment by velocity.
    ///
    /// Change it to what was measured or computed.
    #[serde(default)]
    pub moment_by_velocity: [[f64; 3]; 3],
    /// Moment by angular velocity.
    ///
    /// Change it to what was measured or computed.
    #[serde(default)]
    pub moment_by_rate: [[f64; 3]; 3],
}

/// A program that is started for the flight and asked over its standard input and output for the loads
/// (docs/external-air.md) or for the commands of a controller (docs/control.md).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExternalCase {
    /// The program and its arguments. It runs with your rights.
    ///
    /// Change it to a solver or a controller of your own.
    #[schemars(length(min = 1))]
    pub command: Vec<String>,
    /// Longest wait for an answer.
    ///
    /// Change it for programs that think long.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(default = "ten_minutes")]
    pub timeout_s: f64,
}

fn ten_minutes() -> f64 {
    600.0
}
