//! A fruit fly with smooth, asymmetric wing motions, and small helpers.
#![allow(dead_code, unused_imports)] // every test binary uses its own part

pub mod mechanism;
pub mod saddle;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use wingbeat_dynamics::{
    Body, BodyMotion, DynamicsError, Formulation, Joint, JointType, NaturalUnits, Solution, System,
    Workspace, Wrench,
};
use wingbeat_math::ode::Rk4;
use wingbeat_math::{
    DMat3, DVec3, EulerSequence, MassProperties, MovingRotation, RotationLaw, r1, r2, r3,
};

/// Wing length [m].
pub const LENGTH: f64 = 2.4e-3;
/// Period of a wingbeat [s].
pub const BEAT: f64 = 1.0 / 200.0;
/// Body mass [kg].
pub const BODY_MASS: f64 = 1.0e-6;
/// Mass of one wing [kg], 0.4 % of the body.
pub const WING_MASS: f64 = 4.0e-9;
/// Gravity [m/s2], N components.
pub const GRAVITY: DVec3 = DVec3::new(0.0, 0.0, 9.81);

pub const UNITS: NaturalUnits = NaturalUnits {
    length: LENGTH,
    time: BEAT,
};

/// Harmonic `mean + amplitude cos(2 pi t / BEAT + phase)`.
#[derive(Clone, Copy, Debug)]
pub struct Harmonic {
    pub mean: f64,
    pub amplitude: f64,
    pub phase: f64,
}

impl Harmonic {
    pub fn at(&self, t: f64) -> [f64; 3] {
        let w = TAU / BEAT;
        let (s, c) = (w * t + self.phase).sin_cos();
        let a = self.amplitude;
        [self.mean + a * c, -a * w * s, -a * w * w * c]
    }
}

/// Coordinates of order one that move as polynomials: q, q', q'' at time t, different for
/// different `seed`s.
pub fn motion(seed: f64, t: f64) -> [[f64; 6]; 3] {
    let c = |i: usize, k: f64| 0.4 * (seed + 1.7 * i as f64 + 2.3 * k).sin();
    let q = std::array::from_fn(|i| c(i, 0.0) + c(i, 1.0) * t + c(i, 2.0) * t * t);
    let qd = std::array::from_fn(|i| c(i, 1.0) + 2.0 * c(i, 2.0) * t);
    let qdd = std::array::from_fn(|i| 2.0 * c(i, 2.0));
    [q, qd, qdd]
}

/// A flapping law: stroke plane horizontal at zero attitude, then the angles 1-3-2.
#[derive(Clone, Copy, Debug)]
pub struct Flapping {
    pub angles: [Harmonic; 3],
}

impl RotationLaw for Flapping {
    fn at(&self, t: f64) -> MovingRotation {
        let [phi, theta, psi] = self.angles.map(|a| a.at(t));
        MovingRotation::fixed(r2(FRAC_PI_2))
            .then(&MovingRotation::about(0, phi))
            .then(&MovingRotation::about(2, theta))
            .then(&MovingRotation::about(1, psi))
    }
}

impl Flapping {
    pub fn new(phi: [f64; 3], theta: [f64; 3], psi: [f64; 3]) -> Self {
        let h = |[mean, amplitude, phase]: [f64; 3]| Harmonic {
            mean: mean.to_radians(),
            amplitude: amplitude.to_radians(),
            phase,
        };
        Self {
            angles: [h(phi), h(theta), h(psi)],
        }
    }

    /// The right wing of the asymmetric fly.
    pub fn right() -> Self {
        Self::new([5.0, 55.0, 0.0], [2.0, 6.0, 0.7], [-90.0, 40.0, 1.4])
    }

    /// The left wing of the asymmetric fly.
    pub fn left() -> Self {
        Self::new([-3.0, -48.0, 0.2], [-1.0, -9.0, 0.3], [-90.0, 35.0, 1.7])
    }

    /// A stroke that leaves room to the singularity of the wings' Euler angles.
    pub fn gentle() -> Self {
        Self::new([5.0, 45.0, 0.0], [2.0, 6.0, 0.7], [-90.0, 40.0, 1.4])
    }

    /// The same wing on the other side: phi and theta change sign, psi does not.
    pub fn mirrored(&self) -> Self {
        let [phi, theta, psi] = self.angles;
        let other = |h: Harmonic| Harmonic {
            mean: -h.mean,
            amplitude: -h.amplitude,
            ..h
        };
        Self {
            angles: [other(phi), other(theta), psi],
        }
    }
}

/// A wing's mass: a thin plate, span along axis 2 towards `side` (+1 right, -1 left).
pub fn wing_mass(mass: f64, side: f64) -> MassProperties {
    let (span, chord) = (LENGTH, 0.3 * LENGTH);
    let (i1, i2) = (mass * span * span / 12.0, mass * chord * chord / 12.0);
    let centre = DVec3::new(-0.2 * chord, 0.5 * side * span, 0.0);
    let inertia = DMat3::from_diagonal(DVec3::new(i1, i2, i1 + i2));
    MassProperties::about_centre(mass, centre, inertia)
}

/// The body: an ellipsoid tilted in the body frame, mass centre away from the origin.
pub fn body_mass(centre: DVec3) -> MassProperties {
    let (a, b, c) = (1.25e-3, 0.45e-3, 0.5e-3);
    let d = DVec3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (BODY_MASS / 5.0);
    let tilt = r2(0.8);
    MassProperties::about_centre(
        BODY_MASS,
        centre,
        tilt * DMat3::from_diagonal(d) * tilt.transpose(),
    )
}

pub fn body(name: &str, mass: MassProperties, sequence: EulerSequence) -> Body {
    Body {
        name: name.into(),
        mass,
        sequence,
    }
}

pub fn hinge(name: &str, child: usize, anchor: DVec3, law: impl RotationLaw + 'static) -> Joint {
    Joint {
        law: Some(Arc::new(law)),
        ..Joint::new(name, Some(0), child, JointType::Weld).at(anchor, DVec3::ZERO)
    }
}

/// A three-body fly in the seed's order: body, left wing, right wing.
pub fn fly_with(
    centre: DVec3,
    wing: f64,
    left: impl RotationLaw + 'static,
    right: impl RotationLaw + 'static,
    gravity: DVec3,
) -> System {
    let wings = EulerSequence::WING_132;
    let bodies = vec![
        body("body", body_mass(centre), EulerSequence::BODY_231),
        body("left wing", wing_mass(wing, -1.0), wings),
        body("right wing", wing_mass(wing, 1.0), wings),
    ];
    let at = |side: f64| DVec3::new(0.3e-3, side * 0.4e-3, -0.3e-3);
    let hinges = vec![
        hinge("left hinge", 1, at(-1.0), left),
        hinge("right hinge", 2, at(1.0), right),
    ];
    System::new(bodies, hinges, gravity, UNITS).unwrap()
}

/// Mass centre of the body away from its origin in all three directions.
pub const CENTRE: DVec3 = DVec3::new(-0.15e-3, 0.02e-3, 0.2e-3);

/// The asymmetric fly.
pub fn fly(gravity: DVec3) -> System {
    fly_with(
        CENTRE,
        WING_MASS,
        Flapping::left(),
        Flapping::right(),
        gravity,
    )
}

/// Four bodies: the fly's, wings hung beside their origins, and a flap on the right wing. The
/// flap's hinge is listed first, before that of its parent.
pub fn chain(gravity: DVec3) -> System {
    let base = fly(gravity);
    let mut bodies = base.bodies().to_vec();
    let mut hinges = base.hinges().to_vec();
    let flap = wing_mass(0.3 * WING_MASS, 1.0).moved(r1(0.3), DVec3::new(1e-4, 2e-4, 3e-4));
    bodies.push(body("flap", flap, EulerSequence::WING_132));
    hinges[0].anchor_child = DVec3::new(2e-4, -3e-4, 1e-4);
    hinges[1].anchor_child = DVec3::new(-1e-4, 2e-4, 2e-4);
    let law = Flapping::new([0.0, 20.0, 0.4], [3.0, 15.0, 1.0], [-85.0, 10.0, 2.0]);
    let mut tip = hinge("flap hinge", 3, DVec3::new(0.0, 0.8 * LENGTH, 0.0), law);
    tip.parent = Some(2);
    tip.anchor_child = DVec3::new(-2e-4, 1e-4, 3e-4);
    hinges.insert(0, tip);
    System::new(bodies, hinges, gravity, UNITS).unwrap()
}

/// A root motion without any symmetry, speeds of a flying fly.
pub fn start() -> BodyMotion {
    BodyMotion {
        p: DVec3::new(0.01, -0.02, 0.005),
        r: EulerSequence::BODY_231.rotation(DVec3::new(0.15, 0.1, -0.2)),
        v: DVec3::new(0.2, -0.1, 0.05),
        w: DVec3::new(3.0, -8.0, 5.0),
    }
}

/// Applied loads that depend on time and on the bodies' motion: a driven force of the order of
/// the weight on each wing half-way along, and a damping moment on the body.
pub fn applied(t: f64, motions: &[BodyMotion], out: &mut [Wrench]) {
    let weight = BODY_MASS * GRAVITY.z;
    let phase = TAU * t / BEAT;
    out.fill(Wrench::default());
    out[0].moment = motions[0].r * motions[0].w * -1e-11;
    for (i, side) in [(1, -1.0), (2, 1.0)] {
        let force = motions[i].r * DVec3::Z * (0.5 * weight * (2.0 * phase + side).sin());
        out[i] = Wrench::at(
            force,
            motions[i].r * DVec3::new(0.0, side * 0.6 * LENGTH, 0.0),
        );
    }
}

/// Loads as a function of time and motions.
pub type Loads = fn(f64, &[BodyMotion], &mut [Wrench]);

/// No loads.
pub fn none(_: f64, _: &[BodyMotion], _: &mut [Wrench]) {}

/// A formulation under loads, as a right-hand side with the hinge work as an extra component.
pub struct Flight<'a> {
    pub form: &'a dyn Formulation,
    pub loads: Loads,
    pub ws: Workspace,
    pub motions: Vec<BodyMotion>,
    pub wrenches: Vec<Wrench>,
    pub solution: Solution,
}

impl<'a> Flight<'a> {
    pub fn new(form: &'a dyn Formulation, loads: Loads) -> Self {
        let n = form.system().bodies().len();
        Self {
            form,
            loads,
            ws: form.workspace(),
            motions: vec![BodyMotion::REST; n],
            wrenches: vec![Wrench::default(); n],
            solution: Solution::new(form.system()),
        }
    }

    fn load(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        self.form.motions(t, y, &mut self.ws, &mut self.motions)?;
        (self.loads)(t, &self.motions, &mut self.wrenches);
        Ok(())
    }

    pub fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), DynamicsError> {
        self.load(t, y)?;
        self.form.rates(t, y, &self.wrenches, &mut self.ws, dy)
    }

    pub fn solve(&mut self, t: f64, y: &[f64]) -> Result<&Solution, DynamicsError> {
        self.load(t, y)?;
        let out = &mut self.solution;
        self.form.solve(t, y, &self.wrenches, &mut self.ws, out)?;
        Ok(&self.solution)
    }

    pub fn motions(&mut self, t: f64, y: &[f64]) -> &[BodyMotion] {
        self.load(t, y).unwrap();
        &self.motions
    }

    /// Runge-Kutta from time 0; calls `each` after every step with (step, t, y).
    pub fn fly(
        &mut self,
        h: f64,
        steps: usize,
        y: &mut [f64],
        mut each: impl FnMut(&mut Self, usize, f64, &[f64]),
    ) -> Result<(), DynamicsError> {
        let mut rk4 = Rk4::new(y.len());
        for n in 0..steps {
            rk4.advance(n as f64 * h, h, y, |t, y, dy| self.rates(t, y, dy))?;
            each(self, n + 1, (n + 1) as f64 * h, y);
        }
        Ok(())
    }
}

/// Root motion at the end of `steps` Runge-Kutta steps of length `h` from `start`.
pub fn end_of_flight(
    form: &dyn Formulation,
    loads: Loads,
    start: &BodyMotion,
    h: f64,
    steps: usize,
) -> BodyMotion {
    let mut flight = Flight::new(form, loads);
    let mut y = form.initial(0.0, start).unwrap();
    flight.fly(h, steps, &mut y, |_, _, _, _| {}).unwrap();
    flight.motions(steps as f64 * h, &y)[0]
}

/// Difference of two motions: position relative to the wing length and angle [rad].
pub fn distance(a: &BodyMotion, b: &BodyMotion) -> (f64, f64) {
    let turn = a.r.transpose() * b.r;
    let angle = wingbeat_math::untilde(turn).length();
    ((a.p - b.p).length() / LENGTH, angle)
}

/// Orders of convergence of errors at steps halved each time.
pub fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

/// Largest entry of a matrix.
pub fn size(m: DMat3) -> f64 {
    m.to_cols_array().iter().fold(0.0, |a, x| a.max(x.abs()))
}

/// Fourth-order central difference of a function of one variable, any linear type.
pub fn derivative<T>(f: impl Fn(f64) -> T, h: f64) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let near = (f(h) - f(-h)) * (8.0 / (12.0 * h));
    let far = (f(2.0 * h) - f(-2.0 * h)) * (1.0 / (12.0 * h));
    near - far
}
