//! Loads on one wing from the motion of its frame.

use std::f64::consts::PI;

use wingbeat_math::{DMat3, DVec3};

use crate::coefficients::Translation;
use crate::error::BladeError;
use crate::settings::{AddedMass, BladeSettings, CentreOfPressure, Rotation};
use crate::strip::Strip;

/// How the frame of a wing moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameMotion {
    /// Rotation: wing components to N components.
    pub rotation: DMat3,
    /// Velocity of the frame origin (the hinge), N components [m/s].
    pub velocity: DVec3,
    /// Angular velocity, wing components [rad/s].
    pub rate: DVec3,
}

/// How it accelerates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameAcceleration {
    /// Acceleration of the frame origin, N components [m/s2].
    pub linear: DVec3,
    /// Angular acceleration, wing components [rad/s2].
    pub angular: DVec3,
}

/// Force and moment about the hinge, wing components.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Force \[N\].
    pub force: DVec3,
    /// Moment about the origin of the wing frame [N m].
    pub moment: DVec3,
}

/// A wing made of strips.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeWing {
    strips: Vec<Strip>,
    settings: BladeSettings,
    added: AddedMoments,
}

/// Sums over the strips of the added mass m = rho pi/4 c^2 dr and its place (x, y) at mid chord,
/// and of the added moment of inertia.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct AddedMoments {
    m: f64,
    mx: f64,
    my: f64,
    mxx: f64,
    mxy: f64,
    myy: f64,
    inertia: f64,
}

impl AddedMoments {
    fn of(strips: &[Strip], settings: &BladeSettings) -> Self {
        let mut a = Self::default();
        if settings.added_mass == AddedMass::None {
            return a;
        }
        for s in strips {
            let (x, y) = (s.x_mid(), s.y);
            let m = 0.25 * PI * settings.density * s.chord * s.chord * s.width;
            a.m += m;
            a.mx += m * x;
            a.my += m * y;
            a.mxx += m * x * x;
            a.mxy += m * x * y;
            a.myy += m * y * y;
            if settings.added_mass == AddedMass::Section {
                a.inertia += PI / 128.0 * settings.density * s.chord.powi(4) * s.width;
            }
        }
        a
    }
}

impl AddedMoments {
    /// Centre of the added mass, wing components [m]; the hinge where there is none.
    fn centre(&self) -> DVec3 {
        match self.m > 0.0 {
            true => DVec3::new(self.mx / self.m, self.my / self.m, 0.0),
            false => DVec3::ZERO,
        }
    }
}

/// No wind beside the free stream.
pub fn calm(_point: DVec3) -> DVec3 {
    DVec3::ZERO
}

impl BladeWing {
    /// A wing of these strips.
    ///
    /// # Errors
    /// A strip without chord or width; a setting out of range.
    pub fn new(strips: Vec<Strip>, settings: BladeSettings) -> Result<Self, BladeError> {
        settings.check()?;
        strips
            .iter()
            .enumerate()
            .try_for_each(|(k, s)| s.check(k))?;
        let added = AddedMoments::of(&strips, &settings);
        Ok(Self {
            strips,
            settings,
            added,
        })
    }

    /// The strips, root to tip.
    pub fn strips(&self) -> &[Strip] {
        &self.strips
    }

    /// The model.
    pub fn settings(&self) -> &BladeSettings {
        &self.settings
    }

    /// Whether it carries air along.
    pub fn has_added_mass(&self) -> bool {
        self.settings.added_mass != AddedMass::None
    }

    /// Everything that depends on velocities alone: translation, rotation, viscous moment, and
    /// the part of the added mass that is no acceleration.
    pub fn velocity_load(&self, motion: &FrameMotion) -> Load {
        self.velocity_load_in(motion, calm)
    }

    /// As [`Self::velocity_load`], `wind` being added to the free stream: a velocity [m/s] at a
    /// point [m] of the wing frame, wing components.
    pub fn velocity_load_in(&self, motion: &FrameMotion, wind: impl Fn(DVec3) -> DVec3) -> Load {
        let v = self.velocity_through_air(motion);
        let mut sum = Load::default();
        for strip in &self.strips {
            let through = v - wind(DVec3::new(0.0, strip.y, 0.0));
            self.add_strip(strip, through, motion.rate, &mut sum);
        }
        if self.settings.added_mass == AddedMass::Section {
            let through = v - wind(self.added.centre());
            self.add_chordwise_added_mass(through, motion.rate, &mut sum);
        }
        sum
    }

    /// The added mass: linear in the rates of the velocity components in the wing frame.
    pub fn acceleration_load(&self, motion: &FrameMotion, acc: &FrameAcceleration) -> Load {
        self.acceleration_load_in(motion, acc, calm)
    }

    /// As [`Self::acceleration_load`] in `wind` as for [`Self::velocity_load_in`]: of it the added
    /// mass sees the velocity at its own centre.
    pub fn acceleration_load_in(
        &self,
        motion: &FrameMotion,
        acc: &FrameAcceleration,
        wind: impl Fn(DVec3) -> DVec3,
    ) -> Load {
        let v = self.velocity_through_air(motion) - wind(self.added.centre());
        // Rate of the components in the turning frame.
        let rate = motion.rotation.transpose() * acc.linear - motion.rate.cross(v);
        let (a, turn) = (&self.added, acc.angular);
        // Normal velocity of the point (x, y): v3 + w1 y - w2 x.
        let force = -(a.m * rate.z + a.my * turn.x - a.mx * turn.y);
        let about_1 = -(a.my * rate.z + a.myy * turn.x - a.mxy * turn.y);
        let about_2 = a.mx * rate.z + a.mxy * turn.x - a.mxx * turn.y;
        Load {
            force: DVec3::new(0.0, 0.0, force),
            moment: DVec3::new(about_1, about_2 - a.inertia * turn.y, 0.0),
        }
    }

    /// Both together in uniform air, for motions whose accelerations are known.
    pub fn load(&self, motion: &FrameMotion, acc: &FrameAcceleration) -> Load {
        let (a, b) = (
            self.velocity_load(motion),
            self.acceleration_load(motion, acc),
        );
        Load {
            force: a.force + b.force,
            moment: a.moment + b.moment,
        }
    }

    /// Energy [J] of the air that the added mass moves, `sum m w^2/2` (and `J q^2/2`).
    pub fn added_energy(&self, motion: &FrameMotion) -> f64 {
        let v = self.velocity_through_air(motion).z;
        let (w, a) = (motion.rate, &self.added);
        let quadratic = a.m * v * v + a.myy * w.x * w.x + (a.mxx + a.inertia) * w.y * w.y;
        let mixed = a.my * v * w.x - a.mx * v * w.y - a.mxy * w.x * w.y;
        0.5 * quadratic + mixed
    }

    /// Velocity of the hinge through the undisturbed air, wing components.
    pub(crate) fn velocity_through_air(&self, motion: &FrameMotion) -> DVec3 {
        motion.rotation.transpose() * (motion.velocity - self.settings.free_stream)
    }

    /// Translation, rotation and viscous moment of one strip.
    pub(crate) fn add_strip(&self, s: &Strip, v: DVec3, rate: DVec3, sum: &mut Load) {
        // Velocity of the strip's point on the feathering axis, v + rate x (0, y, 0).
        let (u, w) = (v.x - rate.z * s.y, v.z + rate.x * s.y);
        let speed = (u * u + w * w).sqrt();
        let rho = self.settings.density;
        let (mut f1, mut f3) = (0.0, 0.0);
        let mut x_cp = s.x_mid();
        if speed > 0.0 {
            let (cos, sin) = (u / speed, w / speed);
            let [lift, drag] = section_force(&self.settings.translation, sin, cos);
            let pressure = 0.5 * rho * s.chord * s.width * speed * speed;
            // Lift across the velocity and against w; drag against the velocity.
            f1 = pressure * (lift * sin.abs() * cos.signum() - drag * cos);
            f3 = -pressure * (lift * cos.abs() * sin.signum() + drag * sin);
            let [r1, r3] = self.rotation_force(s, u, w, speed, rate.y);
            (f1, f3) = (f1 + r1, f3 + r3);
            x_cp = s.x_leading - s.chord * self.centre_of_pressure(sin, cos);
        }
        let viscous = self.settings.viscous.map_or(0.0, |m| {
            let c4 = s.chord.powi(4) * s.width;
            -PI / 16.0 * rho * c4 * (m.linear + m.quadratic * rate.y.abs()) * rate.y
        });
        sum.force += DVec3::new(f1, 0.0, f3);
        // (x, y, 0) x (f1, 0, f3)
        sum.moment += DVec3::new(s.y * f3, viscous - x_cp * f3, -s.y * f1);
    }

    /// Force along axes 1 and 3 of feathering at the rate `q`: `rho Gamma` across the velocity.
    fn rotation_force(&self, s: &Strip, u: f64, w: f64, speed: f64, q: f64) -> [f64; 2] {
        let coefficient = match self.settings.rotation {
            Rotation::None => return [0.0; 2],
            Rotation::SaneDickinson | Rotation::Circulation => PI * (0.75 - s.x0()),
            Rotation::Coefficient(c) => c,
        };
        let strength = self.settings.density * coefficient * s.chord * s.chord * q * s.width;
        match self.settings.rotation {
            Rotation::SaneDickinson => [0.0, -strength * speed * u.signum()],
            _ => [strength * w, -strength * u],
        }
    }

    /// Centre of pressure behind the leading edge over the chord.
    fn centre_of_pressure(&self, sin: f64, cos: f64) -> f64 {
        let from_edge_met = match self.settings.centre_of_pressure {
            CentreOfPressure::Cosine => return 0.5 - 0.25 * cos,
            CentreOfPressure::Fixed(x) => x,
            CentreOfPressure::Chen2016 => {
                let alpha = sin.abs().atan2(cos.abs());
                0.25 + 0.25 / (1.0 + (5.0 * (1.0 - 4.0 * alpha / PI)).exp())
            }
        };
        if cos < 0.0 {
            1.0 - from_edge_met
        } else {
            from_edge_met
        }
    }

    /// Force `-m q w` along the chord, w at mid chord, with its moment.
    fn add_chordwise_added_mass(&self, v: DVec3, rate: DVec3, sum: &mut Load) {
        let a = &self.added;
        let momentum = a.m * v.z + a.my * rate.x - a.mx * rate.y;
        let moment = a.my * v.z + a.myy * rate.x - a.mxy * rate.y; // sum of y times momentum
        sum.force.x -= rate.y * momentum;
        sum.moment.z += rate.y * moment;
    }
}

/// Lift and drag coefficient of a section in air from the direction (cos, sin), of either sign.
fn section_force(law: &Translation, sin: f64, cos: f64) -> [f64; 2] {
    law.of_direction(sin.abs(), cos.abs())
}
