//! The angles of a wing, and the rotation that they make.

use crate::error::{ModelError, finite, require};
use crate::motion::berman_wang::{Oval, SmoothSquare, SmoothTriangle};
use crate::motion::fourier::Fourier;
use crate::motion::spline::PeriodicSpline;
use crate::motion::split_cycle::SplitCycle;
use crate::motion::start::Start;
use std::f64::consts::TAU;
use wingbeat_math::{MovingRotation, RotationLaw};

/// An angle as a function of the phase x \[wingbeats\], period 1 \[rad\].
#[derive(Clone, Debug, PartialEq)]
pub enum AngleLaw {
    /// The same angle at all times \[rad\].
    Constant(f64),
    /// Fourier series.
    Fourier(Fourier),
    /// Berman & Wang's stroke angle, between sine and triangle.
    SmoothTriangle(SmoothTriangle),
    /// Berman & Wang's feathering angle, between sine and square wave.
    SmoothSquare(SmoothSquare),
    /// Berman & Wang's deviation angle, N oscillations per beat.
    Oval(Oval),
    /// Half strokes of unequal length.
    SplitCycle(SplitCycle),
    /// Table of samples, periodic cubic spline.
    Table(PeriodicSpline),
}

impl AngleLaw {
    /// Value and first two derivatives with respect to the phase `x` \[rad per wingbeat^k\].
    pub fn at(&self, x: f64) -> [f64; 3] {
        self.at_turn(x, (TAU * x).sin_cos())
    }

    /// As [`Self::at`], sine and cosine of 2 pi x being known.
    fn at_turn(&self, x: f64, turn: (f64, f64)) -> [f64; 3] {
        match self {
            AngleLaw::Constant(q) => [*q, 0.0, 0.0],
            AngleLaw::Fourier(law) => law.at_turn(turn),
            AngleLaw::SmoothTriangle(law) => law.at(x),
            AngleLaw::SmoothSquare(law) => law.at(x),
            AngleLaw::Oval(law) => law.at(x),
            AngleLaw::SplitCycle(law) => law.at(x),
            AngleLaw::Table(law) => law.at(x),
        }
    }

    /// The law `factor * q(x)`.
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        match &mut scaled {
            AngleLaw::Constant(q) => *q *= factor,
            AngleLaw::Fourier(law) => *law = law.scaled(factor),
            AngleLaw::Table(law) => *law = law.scaled(factor),
            AngleLaw::SmoothTriangle(SmoothTriangle {
                amplitude, mean, ..
            })
            | AngleLaw::SmoothSquare(SmoothSquare {
                amplitude, mean, ..
            })
            | AngleLaw::Oval(Oval {
                amplitude, mean, ..
            })
            | AngleLaw::SplitCycle(SplitCycle {
                amplitude, mean, ..
            }) => {
                *amplitude *= factor;
                *mean *= factor;
            }
        }
        scaled
    }

    fn check(&self, key: &str) -> Result<(), ModelError> {
        match self {
            AngleLaw::Constant(q) => finite(key, *q).map(|_| ()),
            AngleLaw::Fourier(law) => law.check(key),
            AngleLaw::SmoothTriangle(law) => law.check(key),
            AngleLaw::SmoothSquare(law) => law.check(key),
            AngleLaw::Oval(law) => law.check(key),
            AngleLaw::SplitCycle(law) => law.check(key),
            AngleLaw::Table(_) => Ok(()), // checked when it was made
        }
    }
}

/// The three angles of one wing in the 1-3-2 convention of this program.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleLaws {
    /// Flap (stroke) angle about axis 1; right wing: positive forward, towards ventral.
    pub phi: AngleLaw,
    /// Deviation about axis 3.
    pub theta: AngleLaw,
    /// Feathering about axis 2; 0: chord along the normal of the stroke plane, leading edge
    /// up in hover; positive turns the leading edge backward.
    pub psi: AngleLaw,
}

impl AngleLaws {
    /// Whether none of them varies.
    pub fn are_constant(&self) -> bool {
        [&self.phi, &self.theta, &self.psi]
            .into_iter()
            .all(AngleLaw::is_constant)
    }

    /// The laws of the other wing by mirror symmetry: `phi -> -phi`, `theta -> -theta`, `psi`
    /// as it is.
    pub fn mirrored(&self) -> Self {
        Self {
            phi: self.phi.scaled(-1.0),
            theta: self.theta.scaled(-1.0),
            psi: self.psi.clone(),
        }
    }
}

/// The prescribed motion of one wing relative to the body.
#[derive(Clone, Debug, PartialEq)]
pub struct WingMotion {
    /// Angle laws of this wing (a left wing holds its own, mirrored signs).
    pub angles: AngleLaws,
    /// Wingbeat frequency f \[Hz\].
    pub frequency: f64,
    /// Phase x0 at t = 0 \[wingbeats\].
    pub phase: f64,
    /// Stroke-plane pitch eta \[rad\]: rotation about b2 that carries b1 to the normal of the
    /// stroke plane. In hover with a horizontal stroke plane, body pitch + eta = 90 deg.
    pub stroke_plane_pitch: f64,
    /// How the motion starts.
    pub start: Start,
}

impl WingMotion {
    /// A wing held still at the angles phi, theta, psi \[rad\] in a stroke plane of pitch `eta`.
    pub fn fixed(eta: f64, angles: [f64; 3]) -> Self {
        let [phi, theta, psi] = angles.map(AngleLaw::Constant);
        Self {
            angles: AngleLaws { phi, theta, psi },
            frequency: 0.0,
            phase: 0.0,
            stroke_plane_pitch: eta,
            start: Start::Impulsive,
        }
    }

    /// The motion of the other wing by mirror symmetry in the 1-3 plane.
    pub fn mirrored(&self) -> Self {
        Self {
            angles: self.angles.mirrored(),
            ..self.clone()
        }
    }

    /// The motion without its start: at full rate from the first instant, from the same phase on.
    pub fn impulsive(&self) -> Self {
        Self {
            start: Start::Impulsive,
            ..self.clone()
        }
    }

    /// The motion as it is once it has risen, at full rate at all times: by what the start delays it, its phase
    /// lags that of [`Self::impulsive`]. Delays of whole wingbeats change nothing.
    pub fn risen(&self) -> Self {
        let lag = self.frequency * self.start.delay();
        Self {
            phase: self.phase - (lag - lag.round()),
            ..self.impulsive()
        }
    }

    /// Phase and its first two time derivatives [wingbeats, 1/s, 1/s2] at `t` \[s\].
    pub fn phase_at(&self, t: f64) -> [f64; 3] {
        let [tau, rate, accel] = self.start.warp(t);
        let f = self.frequency;
        [f * tau + self.phase, f * rate, f * accel]
    }

    /// Angles phi, theta, psi, each `[value, rate, acceleration]` \[rad, rad/s, rad/s2\].
    pub fn angles(&self, t: f64) -> [[f64; 3]; 3] {
        let [x, x1, x2] = self.phase_at(t);
        let x = x - x.floor(); // laws have period 1; a small argument keeps digits
        let turn = (TAU * x).sin_cos();
        let AngleLaws { phi, theta, psi } = &self.angles;
        [phi, theta, psi].map(|law| {
            let [q, q1, q2] = law.at_turn(x, turn);
            [q, q1 * x1, q2 * x1 * x1 + q1 * x2]
        })
    }

    /// Checks every number.
    ///
    /// # Errors
    /// [`ModelError::Value`] naming the first number that is not allowed; `name` names the wing.
    pub fn check(&self, name: &str) -> Result<(), ModelError> {
        let key = |k: &str| format!("{name}.motion.{k}");
        let f = self.frequency;
        require(&key("frequency"), f, f >= 0.0, "a finite number >= 0")?;
        finite(&key("phase"), self.phase)?;
        finite(&key("stroke_plane_pitch"), self.stroke_plane_pitch)?;
        self.start.check(&key("start"))?;
        self.angles.phi.check(&key("phi"))?;
        self.angles.theta.check(&key("theta"))?;
        self.angles.psi.check(&key("psi"))
    }
}

impl RotationLaw for WingMotion {
    fn at(&self, t: f64) -> MovingRotation {
        wing_rotation([self.stroke_plane_pitch, 0.0, 0.0], self.angles(t))
    }

    fn cycle(&self) -> Option<[f64; 2]> {
        let from = match self.start {
            Start::Impulsive => 0.0,
            Start::Smooth { duration } => duration,
        };
        Some(match self.frequency > 0.0 {
            true => [from, 1.0 / self.frequency],
            false => [0.0; 2],
        })
    }
}

/// C = R2(eta) R1(phi) R3(theta) R2(psi) of the pitch `plane` of the stroke plane and of the angles
/// phi, theta, psi, each `[value, rate, acceleration]` \[rad, rad/s, rad/s2\].
pub fn wing_rotation(plane: [f64; 3], [phi, theta, psi]: [[f64; 3]; 3]) -> MovingRotation {
    MovingRotation::about(1, plane)
        .then(&MovingRotation::about(0, phi))
        .then(&MovingRotation::about(2, theta))
        .then(&MovingRotation::about(1, psi))
}
