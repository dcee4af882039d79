//! Feedback: a controller in the loop of the wingbeat.
//!
//! Once per wingbeat the flyer is sensed; the command formed from it acts some beats later (the
//! latency). Over the beat in which it acts the angles of the wings go over smoothly from the old
//! command to the new one, so that wing inertia does its part and nothing jumps.

use std::collections::VecDeque;

use wingbeat_math::{DMat3, DQuat, DVec3};
use wingbeat_model::motion::Adjustment;

use crate::AnalysisError;
use crate::beat::{Beat, State};
use crate::derivatives::control_derivatives;
use crate::level::Level;
use crate::mean::MeanLoad;
use crate::trim::Trim;

/// What a controller sees at the start of a beat.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensed {
    /// Number of the beat.
    pub beat: usize,
    /// Mass centre relative to the start, level frame of the trimmed flight [m].
    pub position: DVec3,
    /// Velocity of the mass centre: mean over the last beat, level frame [m/s].
    pub velocity: DVec3,
    /// Rotation vector roll, pitch, heading from the trimmed attitude \[rad\].
    pub tilt: DVec3,
    /// Mean rate of the tilt over the last beat [rad/s].
    pub rate: DVec3,
}

/// A controller: from what is sensed to one adjustment per wing.
pub trait Controller {
    /// Adjustments of the wings, in the animal's order, on top of the trimmed motion.
    fn command(&mut self, sensed: &Sensed, wings: usize) -> Vec<Adjustment>;
}

/// No feedback.
#[derive(Clone, Copy, Debug, Default)]
pub struct Free;

impl Controller for Free {
    fn command(&mut self, _sensed: &Sensed, wings: usize) -> Vec<Adjustment> {
        vec![Adjustment::default(); wings]
    }
}

/// Proportional-derivative stabiliser of attitude, altitude and place, its gains laid out on the
/// averaged model of the trimmed flight.
///
/// Pitch acts on the mean stroke angle of all wings; roll and heading together on the differences
/// of amplitude and stroke plane between right and left; height on the amplitude. A horizontal
/// error asks for a tilt towards the place wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Stabiliser {
    /// Bandwidth of the attitude [rad/s].
    pub attitude: f64,
    /// Bandwidth of height and place [rad/s]; well below that of the attitude.
    pub place: f64,
    /// Largest tilt asked for \[rad\].
    pub largest_tilt: f64,
    /// Largest adjustment of any kind \[rad, 1\].
    pub largest_adjustment: f64,
    gravity: f64,
    /// Pitch acceleration per stroke offset [1/s2].
    pitch: f64,
    /// Downward acceleration per relative amplitude [m/s2].
    heave: f64,
    /// Inverse of the (roll, heading) accelerations per (amplitude, stroke plane) difference.
    lateral: [[f64; 2]; 2],
    /// Sign of every wing in the differences: +1 right, -1 left.
    sides: Vec<f64>,
}

impl Stabiliser {
    /// Gains for the trimmed flight: attitude to follow at `attitude` rad/s, place at `place`.
    ///
    /// # Errors
    /// Controls that do nothing about an axis.
    pub fn new(trim: &Trim, attitude: f64, place: f64) -> Result<Self, AnalysisError> {
        let r = trim.beat.root(&trim.state).r;
        let list = control_derivatives(&trim.setup, r, DVec3::ZERO, trim.beat.steps())?;
        let level = Level::new(r, trim.beat.gravity());
        let j = level.to_root.transpose() * trim.beat.mean_inertia() * level.to_root;
        let sides: Vec<f64> = trim
            .setup
            .animal
            .wings
            .iter()
            .map(|w| w.side.sign())
            .collect();
        let of = |control: &str, wing: &str| {
            let found = list.iter().find(|d| d.control == control && d.wing == wing);
            found.map_or(MeanLoad::default(), |d| d.derivative)
        };
        // Right up, left down by one half each.
        let difference = |control: &str| {
            let moments = trim.setup.animal.wings.iter().zip(&sides);
            let sum: DVec3 = moments
                .map(|(w, s)| 0.5 * s * of(control, &w.name).moment)
                .sum();
            j.inverse() * sum
        };
        let (a, b) = (difference("stroke_amplitude"), difference("stroke_plane"));
        let det = a.x * b.z - b.x * a.z;
        let pitch = (j.inverse() * of("stroke_offset", "all").moment).y;
        let heave = of("stroke_amplitude", "all").force.z / trim.beat.mass();
        if det == 0.0 || pitch == 0.0 || heave == 0.0 {
            return Err(AnalysisError::not_covered(
                "the strokes do not steer all axes",
                "stabilise an animal with a pair of wings in air",
            ));
        }
        Ok(Self {
            attitude,
            place,
            largest_tilt: 0.2,
            largest_adjustment: 0.15,
            gravity: trim.beat.gravity().length(),
            pitch,
            heave,
            lateral: [[b.z / det, -b.x / det], [-a.z / det, a.x / det]],
            sides,
        })
    }

    /// Acceleration asked for by an error and its rate: critically damped.
    fn asked(bandwidth: f64, error: f64, rate: f64) -> f64 {
        -bandwidth * bandwidth * error - 2.0 * bandwidth * rate
    }
}

impl Controller for Stabiliser {
    fn command(&mut self, s: &Sensed, wings: usize) -> Vec<Adjustment> {
        let limit = |x: f64, m: f64| x.clamp(-m, m);
        let ask = |e: DVec3, r: DVec3, b: f64| {
            DVec3::from_array(std::array::from_fn(|i| Self::asked(b, e[i], r[i])))
        };
        let motion = ask(s.position, s.velocity, self.place);
        // Pitching up (positive) accelerates backward, rolling right to the right.
        let tilt = [motion.y / self.gravity, -motion.x / self.gravity]
            .map(|x| limit(x, self.largest_tilt));
        let turn = ask(
            s.tilt - DVec3::new(tilt[0], tilt[1], 0.0),
            s.rate,
            self.attitude,
        );
        let [[a, b], [c, d]] = self.lateral;
        let m = self.largest_adjustment;
        let amplitude = limit(a * turn.x + b * turn.z, m);
        let plane = limit(c * turn.x + d * turn.z, m);
        let lift = limit(motion.z / self.heave, m);
        let offset = limit(turn.y / self.pitch, m);
        let wing = |k: usize| Adjustment {
            stroke_amplitude: lift + 0.5 * self.sides[k] * amplitude,
            stroke_offset: offset,
            stroke_plane: 0.5 * self.sides[k] * plane,
            ..Adjustment::default()
        };
        (0..wings).map(wing).collect()
    }
}

/// A flight under control, beat by beat.
pub struct ControlledFlight<'a> {
    trim: &'a Trim,
    level: Level,
    steps: usize,
    /// Commands under way: the latency.
    queue: VecDeque<Vec<Adjustment>>,
    acting: Vec<Adjustment>,
    state: State,
    sensed: Sensed,
}

impl<'a> ControlledFlight<'a> {
    /// From the trimmed flight disturbed by the rotation vector `tilt` \[rad\] (roll, pitch, heading)
    /// and the velocity `velocity` [m/s] (level frame); commands act `latency` beats after they
    /// were sensed.
    pub fn new(trim: &'a Trim, tilt: DVec3, velocity: DVec3, latency: usize) -> Self {
        let root = trim.beat.root(&trim.state);
        let level = Level::new(root.r, trim.beat.gravity());
        let turned = level.to_n * DMat3::from_quat(DQuat::from_scaled_axis(tilt));
        let v = DVec3::from_slice(&trim.state[7..]) / trim.beat.mass();
        let r = turned * level.to_root.transpose();
        let state = trim.beat.state(
            DVec3::ZERO,
            r,
            turned * level.to_n.transpose() * v + level.to_n * velocity,
            root.w,
        );
        let none = vec![Adjustment::default(); trim.setup.animal.wings.len()];
        Self {
            level,
            steps: trim.beat.steps(),
            queue: VecDeque::from(vec![none.clone(); latency]),
            acting: none,
            sensed: Sensed {
                tilt,
                ..Sensed::default()
            },
            state,
            trim,
        }
    }

    /// What was sensed last.
    pub fn sensed(&self) -> &Sensed {
        &self.sensed
    }

    /// The commands in force.
    pub fn acting(&self) -> &[Adjustment] {
        &self.acting
    }

    /// One wingbeat.
    ///
    /// # Errors
    /// Numbers that are not finite: the flyer is lost.
    pub fn beat(&mut self, controller: &mut dyn Controller) -> Result<&Sensed, AnalysisError> {
        let command = controller.command(&self.sensed, self.acting.len());
        self.queue.push_back(command);
        let next = self.queue.pop_front().expect("one was just pushed");
        let beat = Beat::between(&self.trim.setup, self.steps, &self.acting, &next)?;
        self.state = beat.advance(&self.state);
        self.acting = next;
        self.sense(beat.period())
    }

    fn sense(&mut self, period: f64) -> Result<&Sensed, AnalysisError> {
        if self.state.iter().any(|x| !x.is_finite()) {
            return Err(AnalysisError::Numbers(format!(
                "beat {}: the flyer is lost",
                self.sensed.beat + 1
            )));
        }
        let to_level = self.level.to_n.transpose();
        let r = DMat3::from_quat(DQuat::from_slice(&self.state[3..7]).normalize());
        let tilt = DQuat::from_mat3(&(to_level * r * self.level.to_root)).to_scaled_axis();
        let position = to_level * DVec3::from_slice(&self.state);
        self.sensed = Sensed {
            beat: self.sensed.beat + 1,
            position,
            velocity: (position - self.sensed.position) / period,
            tilt,
            rate: (tilt - self.sensed.tilt) / period,
        };
        Ok(&self.sensed)
    }
}
