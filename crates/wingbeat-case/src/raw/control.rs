//! `[control]`: feedback in the loop of the flight.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_analysis::SPEED_OF_SOUND;
use wingbeat_analysis::control::{ProcessNoise, Stiffness, Weights};

use super::ExternalCase;

/// Keys of any controller.
const ANY: &str = "control.controller = regulator | stabiliser | external";
/// Keys of controllers that are designed about a trimmed flight.
const DESIGNED: &str = "control.controller = regulator | stabiliser";

/// Feedback: once or several times per wingbeat a controller sees the flyer and commands changes of the
/// strokes. It acts from the release on. `regulator` and `stabiliser` are designed about the trimmed flight of
/// the animal in blade elements when the flight is built; see docs/control.md.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ControlCase {
    /// Which law. `regulator` holds attitude and place, `stabiliser` attitude and altitude, `external` asks a
    /// program.
    ///
    /// Change it to `none` to see the flight without feedback.
    #[default(ControllerCase::Regulator)]
    pub controller: ControllerCase,
    /// Which flight is held: the trimmed one, or the one that begins at the release.
    ///
    /// Change it to `start` where the case is trimmed already, by `wingbeat trim` in its own air.
    #[default(TargetCase::Trim)]
    #[schemars(extend("with" = DESIGNED))]
    pub hold: TargetCase,
    /// Mean velocity to fly with along n1, with `hold` = `start` along the heading at the release.
    ///
    /// Change it for forward flight.
    #[schemars(extend("with" = DESIGNED, "exclusiveMinimum" = -SPEED_OF_SOUND, "exclusiveMaximum" = SPEED_OF_SOUND))]
    pub forward_m_s: f64,
    /// Mean velocity to fly with upwards, along -n3.
    ///
    /// Change it to climb or to sink.
    #[schemars(extend("with" = DESIGNED, "exclusiveMinimum" = -SPEED_OF_SOUND, "exclusiveMaximum" = SPEED_OF_SOUND))]
    pub climb_m_s: f64,
    /// Looks in a wingbeat, at equal times: a number that divides its time steps and leaves four or more between
    /// looks.
    ///
    /// Change it to 2 or 4 for senses and muscles that are faster than the wingbeat.
    #[default = 1]
    #[schemars(range(min = 1), extend("with" = ANY))]
    pub looks_per_beat: usize,
    /// Wingbeats from sensing to acting, whole looks; the regulator counts with them, the stabiliser bears one.
    ///
    /// Change it to see what delay of senses and muscles costs.
    #[schemars(range(min = 0, max = 20), extend("with" = ANY))]
    pub latency_beats: f64,
    /// Time constant of the actuators, a first-order lag behind the commands; the regulator counts with it. 0: none.
    ///
    /// Change it for muscles and motors that take wingbeats to follow.
    #[schemars(range(min = 0, max = 100), extend("with" = ANY))]
    pub lag_beats: f64,
    /// Wingbeats from one look to the next; between them the command is kept. Gains are designed for
    /// a look every wingbeat.
    ///
    /// Change it to see how rarely a flyer may look.
    #[default = 1]
    #[schemars(range(min = 1), extend("with" = ANY))]
    pub every_beats: usize,
    /// Largest change of the relative stroke amplitude, and of its difference between the sides; with `external`
    /// largest relative change of the amplitudes of a wing.
    ///
    /// Change it to what the muscles can do.
    #[default = 0.2]
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "with" = ANY))]
    pub amplitude_limit: f64,
    /// Largest change of the mean stroke angle, and largest difference of the stroke planes; with `external`
    /// largest change of the angles of a wing.
    ///
    /// Change it to what the joints of the wings can do.
    #[default = 12.0]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 90, "with" = ANY))]
    pub angle_limit_deg: f64,
    /// Weights of the regulator.
    #[schemars(extend("with" = "control.controller = regulator"))]
    pub weights: WeightsCase,
    /// Stiffness of the loops of the stabiliser.
    #[schemars(extend("with" = "control.controller = stabiliser"))]
    pub stiffness: StiffnessCase,
    /// The program that is the controller.
    #[schemars(extend("with" = "control.controller = external"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub external: Option<ExternalCase>,
    /// Noise and bias of what is sensed; left out: none.
    #[schemars(extend("with" = ANY))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensors: Option<SensorsCase>,
    /// Kalman filter of what is sensed, for its noise; left out: the regulator takes what is sensed for the truth.
    #[schemars(extend("with" = ["control.controller = regulator", "sensors"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub observer: Option<ObserverCase>,
    /// Where to be, and when: one `[[control.waypoint]]` each, in the order of their times. Left out: at the place of
    /// the release.
    #[schemars(extend("with" = ANY))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub waypoint: Vec<WaypointCase>,
}

/// Noise of the flight: standard deviations of what each wingbeat changes that no command does (gusts, an air other
/// than that of the layout). The filter weighs it against the noise of `[control.sensors]`.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ObserverCase {
    /// Of the velocity, in wing lengths per wingbeat.
    ///
    /// Change it to less for calm air: what is sensed counts less then.
    #[default(ProcessNoise::default().velocity)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub velocity: f64,
    /// Of the angular velocity, in radians per wingbeat.
    ///
    /// Change it to less for calm air: what is sensed counts less then.
    #[default(ProcessNoise::default().rate)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate: f64,
}

/// A place and a heading, and when to be there. From one waypoint to the next, and from the release to the first, the
/// reference goes over smoothly, at rest at either end; its velocity is fed forward. The last one is held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WaypointCase {
    /// Time since the release, at least a wingbeat later than the waypoint before: over one wingbeat it is a step.
    ///
    /// Change it for a faster or slower way.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub time_s: f64,
    /// Place of the mass centre from that at the release, inertial axes. Left out: that of the waypoint before.
    /// `stabiliser` holds no place but the altitude.
    ///
    /// Change it to go somewhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_m: Option<[f64; 3]>,
    /// Heading to the right of the one that is held without waypoints; of `external` from n1. Left out: that of the
    /// waypoint before.
    ///
    /// Change it to turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading_deg: Option<f64>,
}

/// Laws of control.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ControllerCase {
    /// Discrete linear-quadratic regulator on the map of a wingbeat, latency included.
    Regulator,
    /// Proportional-derivative loops of pitch, roll, heading and altitude.
    Stabiliser,
    /// A program of any language, asked for the commands of every wing (docs/control.md).
    External,
    /// No feedback.
    None,
}

/// Which flight is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TargetCase {
    /// The trimmed flight in blade elements: its attitude, heading along n1; what trim adds to stroke
    /// amplitude and mean stroke angle is commanded too.
    Trim,
    /// Attitude and velocity of a look as they are seen at the release, strokes as the case has them; the mean
    /// velocity is that of `forward_m_s` and `climb_m_s`.
    Start,
}

/// Departures and commands that weigh alike: smaller ones are held more tightly.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WeightsCase {
    /// Position, in wing lengths.
    ///
    /// Change it to less to hold the place more tightly.
    #[default(Weights::default().position)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub position: f64,
    /// Velocity, in wing lengths per wingbeat.
    ///
    /// Change it to less for a slower return.
    #[default(Weights::default().velocity)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub velocity: f64,
    /// Tilt and heading, in radians.
    ///
    /// Change it to less to hold the attitude more tightly.
    #[default(Weights::default().tilt)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tilt: f64,
    /// Angular velocity, in radians per wingbeat.
    ///
    /// Change it to less for more damping.
    #[default(Weights::default().rate)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate: f64,
    /// Commands: relative amplitudes and radians.
    ///
    /// Change it to less for stronger commands.
    #[default(Weights::default().command)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub command: f64,
    /// Sums over the wingbeats of position (wing lengths) and heading (radians): integral action;
    /// left out: none.
    ///
    /// Change it to 2 where a load or an air other than blade elements pulls the flyer away.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sum: Option<f64>,
}

/// Natural frequencies of the loops, each alone and without latency.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StiffnessCase {
    /// Of pitch, in radians per wingbeat.
    ///
    /// Change it to less for longer latencies.
    #[default(Stiffness::default().pitch)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub pitch: f64,
    /// Of roll and heading, in radians per wingbeat.
    ///
    /// Change it with care: the lateral divergence wants stiff loops.
    #[default(Stiffness::default().lateral)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub lateral: f64,
    /// Of altitude, in radians per wingbeat.
    ///
    /// Change it to hold the altitude more tightly.
    #[default(Stiffness::default().altitude)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub altitude: f64,
    /// Rate at which drift is braked, per wingbeat.
    ///
    /// Change it to 0 to let the flyer drift.
    #[default(Stiffness::default().drift)]
    #[schemars(range(min = 0))]
    pub drift: f64,
    /// Damping ratio of all loops.
    ///
    /// Change it to less for a quicker, less steady return.
    #[default(Stiffness::default().damping)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub damping: f64,
    /// Rate at which departures of all loops are summed, per wingbeat: integral action,
    /// proportional-integral-derivative loops. 0: none.
    ///
    /// Change it to 0.02 where a load or an air other than blade elements pulls the flyer away.
    #[default(Stiffness::default().integral)]
    #[schemars(range(min = 0))]
    pub integral: f64,
}

/// Noise (standard deviation of every component, drawn again at each look) and bias of what is sensed. The
/// same seed gives the same noise, to the bit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SensorsCase {
    /// Which noise.
    ///
    /// Change it for another flight of the same kind.
    pub seed: u64,
    /// Noise of the place.
    ///
    /// Change it to that of the sensors.
    #[schemars(range(min = 0))]
    pub position_noise_m: f64,
    /// Noise of the velocity.
    ///
    /// Change it to that of the sensors.
    #[schemars(range(min = 0))]
    pub velocity_noise_m_s: f64,
    /// Noise of the attitude.
    ///
    /// Change it to that of the sensors.
    #[schemars(range(min = 0))]
    pub tilt_noise_deg: f64,
    /// Noise of the angular velocity.
    ///
    /// Change it to that of the sensors.
    #[schemars(range(min = 0))]
    pub rate_noise_deg_s: f64,
    /// Bias of the velocity, inertial axes. With `hold` = `start` it changes next to nothing, as the other biases:
    /// the flight that is held is what the first look sees.
    ///
    /// Change it to that of the sensors.
    pub velocity_bias_m_s: [f64; 3],
    /// Bias of the attitude, a rotation about the body axes.
    ///
    /// Change it to that of the sensors.
    pub tilt_bias_deg: [f64; 3],
    /// Bias of the angular velocity, body axes.
    ///
    /// Change it to that of the sensors.
    pub rate_bias_deg_s: [f64; 3],
}
