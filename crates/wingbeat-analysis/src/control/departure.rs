//! What a controller makes of what it sees: the departure from a reference flight, and what it
//! answers, four controls of the strokes.

use std::collections::VecDeque;

use wingbeat_flight::{Aim, FlightSetup, Sensed};
use wingbeat_math::{DMat3, DQuat, DVec3};
use wingbeat_model::Wing;
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::glide::glides;
use crate::beat::level::{Level, Perturbation};
use crate::trim::Trim;

/// Number of controls.
pub const CONTROLS: usize = 4;

/// Relative amplitude of all wings \[1\], mean stroke angle of all wings \[rad\], right-left
/// differences of relative amplitude \[1\] and of stroke plane \[rad\].
pub type Controls = [f64; CONTROLS];

/// A wingbeat or a part of it goes by: the command `u` joins the `commands`, of which the first is in force and the
/// others are under way; actuators go this `share` of the way to the one that is due. What was in force until now.
pub(super) fn pass_on(commands: &mut VecDeque<Controls>, u: Controls, share: f64) -> Controls {
    commands.push_back(u);
    let now = commands.pop_front().unwrap_or(u);
    if share < 1.0 {
        let due = commands[0];
        commands[0] = std::array::from_fn(|c| now[c] + share * (due[c] - now[c]));
    }
    now
}

/// The departure from the reference flight at the start of a wingbeat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Departure {
    /// Number of the look, from the release on ([`Sensed::look`]).
    pub look: usize,
    /// Mass centre relative to where the reference flight would be, level frame [m].
    pub position: DVec3,
    /// Velocity relative to axes that move with the mean velocity of the reference flight, angular velocity and
    /// tilt at this instant, less those of the reference flight.
    pub state: Perturbation,
}

impl Departure {
    /// Of what is seen at the look number `look`, in natural order: place of the mass centre, then the nine numbers of
    /// its state (SI).
    pub(crate) fn from_states(look: usize, x: &[f64]) -> Self {
        Self {
            look,
            position: DVec3::from_slice(x),
            state: Perturbation::from_array(std::array::from_fn(|k| x[3 + k])),
        }
    }

    /// What is left of it less `other`.
    pub fn less(&self, other: &Self) -> Self {
        Self {
            look: self.look,
            position: self.position - other.position,
            state: self.state - other.state,
        }
    }
}

/// The flight that is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    level: Level,
    /// What is seen at the start of a beat of the reference flight, velocity less the mean one.
    state: Perturbation,
    /// Mean velocity, N components [m/s].
    velocity: DVec3,
}

impl Reference {
    /// The trimmed flight.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn trimmed(trim: &Trim) -> Result<Self, AnalysisError> {
        let level = Level::of(&trim.beat, &trim.state);
        let velocity = trim.mean_velocity()?;
        let seen = Perturbation::of(&trim.beat, &level, &trim.state);
        Ok(Self {
            state: seen.relative_to(&level, velocity),
            level,
            velocity,
        })
    }

    /// The flight that begins as `sensed` shows, under `gravity` [m/s2], and goes on with the mean
    /// velocity `velocity` [m/s], both N components.
    pub fn begun(sensed: &Sensed, gravity: DVec3, velocity: DVec3) -> Self {
        let level = Level::new(sensed.root.r, gravity);
        let own = sensed.velocity - velocity;
        Self {
            state: Perturbation::seen(&level, sensed.root.r, own, sensed.root.w),
            level,
            velocity,
        }
    }

    /// What `sensed` departs by from the reference flight, whose mass centre was at `origin` [m],
    /// N components, at the release.
    pub fn departure(&self, sensed: &Sensed, origin: DVec3) -> Departure {
        self.departure_on(&Aim::default(), sensed, origin)
    }

    /// The same from the reference flight brought to `aim`, which is relative to it.
    pub fn departure_on(&self, aim: &Aim, sensed: &Sensed, origin: DVec3) -> Departure {
        let level = self.level.turned(aim.heading);
        let (root, own) = (&sensed.root, sensed.velocity - self.velocity);
        let seen = Perturbation::seen(&level, root.r, own, root.w);
        let mut state = self.state;
        state.velocity += level.to_n.transpose() * aim.velocity;
        state.rate.z += aim.heading_rate;
        let way = sensed.centre - origin - sensed.time * self.velocity - aim.position;
        Departure {
            look: sensed.look,
            position: level.to_n.transpose() * way,
            state: seen - state,
        }
    }

    /// Attitude R_NB of the root in the reference flight brought to `aim`, where it is `orbit` off its start of a
    /// beat: the one without a departure in tilt.
    pub fn attitude(&self, aim: &Aim, orbit: &Departure) -> DMat3 {
        let level = self.level.turned(aim.heading);
        let tilt = DQuat::from_scaled_axis(self.state.tilt + orbit.state.tilt);
        level.to_n * DMat3::from_quat(tilt) * level.to_root.transpose()
    }

    /// Where the flyer is to be at `time` [s], whose mass centre was at `origin` [m] at the release, if it is brought
    /// to `aim`, which is relative to the reference flight.
    pub fn aim(&self, aim: &Aim, time: f64, origin: DVec3) -> Aim {
        Aim {
            position: origin + time * self.velocity + aim.position,
            velocity: self.velocity + aim.velocity,
            heading: self.level.heading() + aim.heading,
            heading_rate: aim.heading_rate,
        }
    }

    /// As plain numbers.
    pub fn to_vec(self) -> Vec<f64> {
        let frames = [self.level.to_n, self.level.to_root].map(|m| m.to_cols_array());
        let (state, velocity) = (self.state.to_array(), self.velocity.to_array());
        [&frames.concat()[..], &state, &velocity].concat()
    }

    /// From plain numbers; none where they are not as many as [`Self::to_vec`] gives.
    pub fn from_slice(numbers: &[f64]) -> Option<Self> {
        let numbers: &[f64; 30] = numbers.try_into().ok()?;
        let frame = |k: usize| DMat3::from_cols_slice(&numbers[k..k + 9]);
        Some(Self {
            level: Level {
                to_n: frame(0),
                to_root: frame(9),
            },
            state: Perturbation::from_array(std::array::from_fn(|i| numbers[18 + i])),
            velocity: DVec3::from_slice(&numbers[27..]),
        })
    }
}

/// Largest commands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Of relative amplitude and its difference \[1\].
    pub amplitude: f64,
    /// Of mean stroke angle and difference of stroke planes \[rad\].
    pub angle: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            amplitude: 0.2,
            angle: 0.2,
        }
    }
}

impl Limits {
    /// The largest size of each control.
    pub fn sizes(&self) -> Controls {
        [self.amplitude, self.angle, self.amplitude, self.angle]
    }

    /// The controls within the limits.
    pub fn applied(&self, u: Controls) -> Controls {
        let most = self.sizes();
        std::array::from_fn(|i| u[i].clamp(-most[i], most[i]))
    }

    /// Whether any control is at its limit.
    pub fn reached(&self, u: &Controls) -> bool {
        u.iter().zip(self.sizes()).any(|(u, most)| u.abs() >= most)
    }
}

/// An error if nothing beats: feedback commands strokes.
pub(crate) fn check_beats(trim: &Trim) -> Result<(), AnalysisError> {
    match glides(&trim.setup) {
        false => Ok(()),
        true => Err(AnalysisError::not_covered(
            "feedback steers by the strokes, and no wing beats here",
            "see the modes of the glide (`wingbeat stability`), or fly it without feedback",
        )),
    }
}

/// Side of every wing, right +1, left -1; none of a wing that is not steered ([`FlightSetup::is_adjusted`]).
pub fn sides(setup: &FlightSetup) -> Vec<Option<f64>> {
    let wings = setup.animal.wings.iter().enumerate();
    let side = |(w, wing): (usize, &Wing)| setup.is_adjusted(w).then(|| wing.side.sign());
    wings.map(side).collect()
}

/// The controls as adjustments of wings on these [`sides`]; wings without one are not adjusted.
pub fn adjustments(u: &Controls, sides: &[Option<f64>]) -> Vec<Adjustment> {
    let on_side = |s: f64| Adjustment {
        stroke_amplitude: u[0] + 0.5 * s * u[2],
        stroke_offset: u[1],
        stroke_plane: 0.5 * s * u[3],
        ..Adjustment::default()
    };
    let wing = |side: &Option<f64>| side.map_or(Adjustment::default(), on_side);
    sides.iter().map(wing).collect()
}
