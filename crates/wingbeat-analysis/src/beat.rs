//! One wingbeat of free flight in air without memory, as a map of the state.
//!
//! State: the 13 numbers of the momentum form (mass centre, quaternion, linear momentum, angular
//! momentum about the mass centre, all N components). As the wings' motion is prescribed and
//! periodic, everything that depends on time alone - placements, composite inertia, relative
//! momentum and their derivatives - is tabulated once for the grid of half steps; a step of the
//! classical Runge-Kutta method then costs four evaluations of the strips. Added mass stands on
//! the left-hand side, solved exactly:
//!
//! ```text
//! (diag(m, I) + sum J^T A J) (a_c, alpha) = loads - gyroscopic terms - sum J^T A s0
//! ```
//!
//! with `s = J (a_c, alpha) + s0` the rates (normal velocity, w1, w2) of a wing frame and A its
//! symmetric 3 x 3 added-mass matrix.

use std::sync::Arc;

use wingbeat_blade::{BladeWing, BodyDrag, FrameAcceleration, FrameMotion};
use wingbeat_dynamics::inverse::inertia_wrench;
use wingbeat_dynamics::posture::Posture;
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, System};
use wingbeat_flight::{AirModel, BladeSide, FlightSetup, natural_units, system};
use wingbeat_math::{DMat3, DQuat, DVec3, MovingRotation, RotationLaw};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::{Animal, Start, Wing, WingMotion};

use crate::AnalysisError;

/// The state of the momentum form.
pub type State = [f64; 13];

/// What depends on time alone.
#[derive(Clone, Debug)]
pub(crate) struct Instant {
    pub(crate) c: DVec3,
    pub(crate) c_dot: DVec3,
    c_ddot: DVec3,
    pub(crate) inertia: DMat3,
    inverse: DMat3,
    inertia_dot: DMat3,
    h: DVec3,
    h_dot: DVec3,
    pub(crate) wings: Vec<Placed>,
}

/// A wing relative to the root at an instant; vectors in root components unless said.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    pub(crate) rotation: DMat3,
    /// Angular velocity and acceleration relative to the root, wing components.
    pub(crate) rate: DVec3,
    pub(crate) turn: DVec3,
    pub(crate) d: DVec3,
    pub(crate) d_dot: DVec3,
    pub(crate) d_ddot: DVec3,
}

/// Free flight over one wingbeat in equal steps.
#[derive(Clone, Debug)]
pub struct Beat {
    pub(crate) mass: f64,
    pub(crate) gravity: DVec3,
    /// Instants at all half steps, both ends included.
    table: Vec<Instant>,
    pub(crate) wings: Vec<BladeWing>,
    /// Added mass of each wing: (F3, M1, M2) = -A (rates of normal velocity, w1, w2).
    added: Vec<DMat3>,
    has_added: bool,
    pub(crate) drag: Option<(BodyDrag, f64)>,
    pub(crate) stream_wings: DVec3,
    pub(crate) stream_body: DVec3,
    steps: usize,
    period: f64,
    wing_length: f64,
}

impl Beat {
    /// The wingbeat of a setup, its wings beating steadily from the first instant, in `steps`
    /// equal steps. Start state, mode and time grid of the setup do not matter.
    ///
    /// # Errors
    /// A vortex lattice (its wake is a memory), applied loads, wings that do not beat or beat at
    /// different frequencies; what dynamics and strips refuse.
    pub fn new(setup: &FlightSetup, steps: usize) -> Result<Self, AnalysisError> {
        Self::with_bodies(setup, steps, |wing| Arc::new(steady(&wing.motion)))
    }

    /// A wingbeat in which the motion of every wing goes over smoothly from one adjustment to
    /// another. Frequencies stay.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn between(
        setup: &FlightSetup,
        steps: usize,
        from: &[Adjustment],
        to: &[Adjustment],
    ) -> Result<Self, AnalysisError> {
        let period = common_period(&setup.animal)?;
        let index = |wing: &Wing| {
            let found = setup.animal.wings.iter().position(|w| w.name == wing.name);
            found.expect("a wing of this animal")
        };
        Self::with_bodies(setup, steps, |wing| {
            let motion = |a: &Adjustment| steady(&wing.motion.adjusted(wing.side, a));
            let k = index(wing);
            Arc::new(Passage {
                from: motion(&from[k]),
                to: motion(&to[k]),
                period,
            })
        })
    }

    fn with_bodies(
        setup: &FlightSetup,
        steps: usize,
        law: impl Fn(&Wing) -> Arc<dyn RotationLaw>,
    ) -> Result<Self, AnalysisError> {
        let period = common_period(&setup.animal)?;
        if !setup.loads.is_empty() {
            return Err(AnalysisError::not_covered(
                "the setup has applied loads",
                "remove them",
            ));
        }
        let bodies = bodies(setup, law)?;
        let mut beat = Self::without_air(setup, &bodies, steps, period);
        match &setup.air {
            AirModel::None => {}
            AirModel::BladeElement(_) if deforms(setup) => {
                return Err(AnalysisError::not_covered(
                    "the fast model of a beat knows no deforming wings",
                    "leave out [wing.NAME.deformation], or use air.model = \"vortex_lattice\" for trim",
                ));
            }
            AirModel::BladeElement(options) => {
                beat.stream_body = options.blade.free_stream;
                beat.stream_wings = options.blade.free_stream + options.induced;
                beat.drag = options.body_drag.map(|d| (d, options.blade.density));
                let mut still = *options;
                (still.blade.free_stream, still.induced) = (DVec3::ZERO, DVec3::ZERO);
                let side = BladeSide::new(&setup.animal, &still)
                    .map_err(wingbeat_flight::FlightError::from)?;
                beat.wings = side.wings;
                beat.added = beat.wings.iter().map(added_matrix).collect();
                beat.has_added = beat.added.iter().any(|a| *a != DMat3::ZERO);
            }
            AirModel::VortexLattice(_) | AirModel::External(_) => {
                return Err(AnalysisError::not_covered(
                    "this air has a memory (a wake)",
                    "use air.model = \"blade_element\"",
                ));
            }
            AirModel::Derivatives(_) => {
                return Err(AnalysisError::not_covered(
                    "stability derivatives know no wingbeat",
                    "use air.model = \"blade_element\"; `wingbeat stability` takes tables as they are",
                ));
            }
        }
        Ok(beat)
    }

    fn without_air(setup: &FlightSetup, bodies: &System, steps: usize, period: f64) -> Self {
        let mut posture = Posture::new(bodies);
        let at = |k: usize| k as f64 * period / (2 * steps) as f64;
        let table = (0..=2 * steps).map(|k| instant(bodies, &mut posture, at(k)));
        let tips = setup.animal.wings.iter().flat_map(|w| &w.mesh.nodes);
        Self {
            mass: bodies.total_mass(),
            gravity: setup.gravity,
            table: table.collect(),
            wings: vec![],
            added: vec![],
            has_added: false,
            drag: None,
            stream_wings: DVec3::ZERO,
            stream_body: DVec3::ZERO,
            steps,
            period,
            wing_length: tips.fold(0.0, |m, r| m.max(r.length())),
        }
    }

    /// The instants of one period, the end left out.
    pub(crate) fn cycle(&self) -> &[Instant] {
        &self.table[..2 * self.steps]
    }

    /// Period T of the wingbeat [s].
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Total mass m [kg].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Acceleration of gravity, N components [m/s2].
    pub fn gravity(&self) -> DVec3 {
        self.gravity
    }

    /// Wing length R, hinge to the farthest node [m].
    pub fn wing_length(&self) -> f64 {
        self.wing_length
    }

    /// Steps per wingbeat.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Mass centre at the start of the beat, root components [m].
    pub fn mass_centre(&self) -> DVec3 {
        self.table[0].c
    }

    /// The state at the start of a beat in which the mass centre is at `centre` [m] with
    /// `velocity` [m/s] (N components), the root has the attitude `rotation` (root to N) and the
    /// angular velocity `rate` [rad/s] (root components).
    pub fn state(&self, centre: DVec3, rotation: DMat3, velocity: DVec3, rate: DVec3) -> State {
        let at = &self.table[0];
        let h = rotation * (at.inertia * rate + at.h);
        let mut y = [0.0; 13];
        centre.write_to_slice(&mut y);
        DQuat::from_mat3(&rotation)
            .normalize()
            .write_to_slice(&mut y[3..]);
        (self.mass * velocity).write_to_slice(&mut y[7..]);
        h.write_to_slice(&mut y[10..]);
        y
    }

    /// Motion of the root (origin of its frame) in the state `y` at the start of a beat.
    pub fn root(&self, y: &State) -> BodyMotion {
        let at = &self.table[0];
        let (r, w) = self.attitude(at, y);
        let v = r.transpose() * (DVec3::from_slice(&y[7..]) / self.mass) - w.cross(at.c) - at.c_dot;
        BodyMotion {
            p: DVec3::from_slice(y) - r * at.c,
            r,
            v: r * v,
            w,
        }
    }

    /// The state one wingbeat later.
    pub fn advance(&self, y: &State) -> State {
        let mut y = *y;
        for step in 0..self.steps {
            self.step(step, &mut y);
        }
        let q = DQuat::from_slice(&y[3..7]).normalize();
        q.write_to_slice(&mut y[3..]);
        y
    }

    /// One step of the classical Runge-Kutta method, from step number `step` of the beat.
    pub fn step(&self, step: usize, y: &mut State) {
        let h = self.period / self.steps as f64;
        let at = |half: usize| &self.table[2 * step + half];
        let moved =
            |y: &State, k: &State, f: f64| -> State { std::array::from_fn(|i| y[i] + f * k[i]) };
        let k1 = self.rates_at(at(0), y);
        let k2 = self.rates_at(at(1), &moved(y, &k1, 0.5 * h));
        let k3 = self.rates_at(at(1), &moved(y, &k2, 0.5 * h));
        let k4 = self.rates_at(at(2), &moved(y, &k3, h));
        for i in 0..13 {
            y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        }
    }

    /// Rates of the state at half step number `half` of the beat.
    pub fn rates(&self, half: usize, y: &State) -> State {
        self.rates_at(&self.table[half % (2 * self.steps)], y)
    }

    /// Attitude and angular velocity of the root.
    fn attitude(&self, at: &Instant, y: &State) -> (DMat3, DVec3) {
        let r = DMat3::from_quat(DQuat::from_slice(&y[3..7]).normalize());
        let w = at.inverse * (r.transpose() * DVec3::from_slice(&y[10..]) - at.h);
        (r, w)
    }

    fn rates_at(&self, at: &Instant, y: &State) -> State {
        let (r, w) = self.attitude(at, y);
        let momentum = DVec3::from_slice(&y[7..]);
        let v = r.transpose() * (momentum / self.mass) - w.cross(at.c) - at.c_dot;
        let (force, moment) = self.loads(at, r, v, w);
        let q = DQuat::from_slice(&y[3..7]) * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5;
        let mut dy = [0.0; 13];
        (momentum / self.mass).write_to_slice(&mut dy);
        q.write_to_slice(&mut dy[3..]);
        (r * force).write_to_slice(&mut dy[7..]);
        (r * moment).write_to_slice(&mut dy[10..]);
        dy
    }

    /// Force and moment about the mass centre, weight included, root components; `v` is the
    /// velocity of the root's origin in root components.
    fn loads(&self, at: &Instant, r: DMat3, v: DVec3, w: DVec3) -> (DVec3, DVec3) {
        let to_root = r.transpose();
        let mut force = self.mass * (to_root * self.gravity);
        let mut moment = DVec3::ZERO;
        if let Some((drag, density)) = &self.drag {
            let f = drag.force(*density, v - to_root * self.stream_body);
            force += f;
            moment -= at.c.cross(f);
        }
        let stream = to_root * self.stream_wings;
        for (wing, p) in self.wings.iter().zip(&at.wings) {
            let load = wing.velocity_load(&p.frame(v - stream, w));
            let f = p.rotation * load.force;
            force += f;
            moment += p.rotation * load.moment + (p.d - at.c).cross(f);
        }
        if self.has_added {
            return self.with_added_mass(at, v - stream, w, force, moment);
        }
        (force, moment)
    }

    /// The same with the load of the added mass.
    fn with_added_mass(
        &self,
        at: &Instant,
        v: DVec3,
        w: DVec3,
        force: DVec3,
        moment: DVec3,
    ) -> (DVec3, DVec3) {
        let spin = at.inertia * w + at.h;
        let gyro = at.inertia_dot * w + at.h_dot + w.cross(spin);
        let bias = |x: DVec3, x_dot: DVec3, x_ddot: DVec3| {
            w.cross(w.cross(x)) + 2.0 * w.cross(x_dot) + x_ddot
        };
        let bias_c = bias(at.c, at.c_dot, at.c_ddot);
        let mut matrix = [[0.0; 6]; 6];
        for i in 0..3 {
            matrix[i][i] = self.mass;
            for j in 0..3 {
                matrix[3 + i][3 + j] = at.inertia.col(j)[i];
            }
        }
        let m = moment - gyro;
        let mut x = [force.x, force.y, force.z, m.x, m.y, m.z];
        for (p, a) in at.wings.iter().zip(&self.added) {
            let arm = p.d - at.c;
            let frame = p.frame(v, w);
            let air = p.rotation.transpose() * frame.velocity;
            let hinge = bias(p.d, p.d_dot, p.d_ddot) - bias_c;
            let seen = p.rotation.transpose() * w;
            let turn = p.turn - p.rate.cross(seen);
            let normal = p.rotation.z_axis.dot(hinge) - frame.rate.cross(air).z;
            let load = *a * DVec3::new(normal, turn.x, turn.y);
            let jacobian = p.jacobian(arm);
            for i in 0..6 {
                x[i] -= jacobian[i].dot(load);
                let row = *a * jacobian[i]; // A is symmetric
                for j in 0..6 {
                    matrix[i][j] += row.dot(jacobian[j]);
                }
            }
        }
        solve_symmetric(&mut matrix, &mut x);
        let turn = DVec3::new(x[3], x[4], x[5]);
        (
            self.mass * DVec3::new(x[0], x[1], x[2]),
            at.inertia * turn + gyro,
        )
    }
}

fn deforms(setup: &FlightSetup) -> bool {
    (setup.animal.wings.iter()).any(|w| w.deformation.is_some())
}

impl Placed {
    /// Motion of the wing frame when the root's origin moves with `v` through the air and the
    /// root turns with `w`; "N" is the root here.
    pub(crate) fn frame(&self, v: DVec3, w: DVec3) -> FrameMotion {
        FrameMotion {
            rotation: self.rotation,
            velocity: v + w.cross(self.d) + self.d_dot,
            rate: self.rotation.transpose() * w + self.rate,
        }
    }

    /// Columns of J: derivative of (normal velocity, w1, w2) rates by the six components of
    /// (a_c, alpha); `arm` is the hinge seen from the mass centre.
    fn jacobian(&self, arm: DVec3) -> [DVec3; 6] {
        let n = self.rotation.z_axis;
        let turn = arm.cross(n);
        let (e1, e2) = (self.rotation.x_axis, self.rotation.y_axis);
        [
            DVec3::new(n.x, 0.0, 0.0),
            DVec3::new(n.y, 0.0, 0.0),
            DVec3::new(n.z, 0.0, 0.0),
            DVec3::new(turn.x, e1.x, e2.x),
            DVec3::new(turn.y, e1.y, e2.y),
            DVec3::new(turn.z, e1.z, e2.z),
        ]
    }
}

/// The added-mass matrix of a wing, read off its loads under unit accelerations.
fn added_matrix(wing: &BladeWing) -> DMat3 {
    let rest = FrameMotion {
        rotation: DMat3::IDENTITY,
        velocity: DVec3::ZERO,
        rate: DVec3::ZERO,
    };
    let column = |linear: DVec3, angular: DVec3| {
        let load = wing.acceleration_load(&rest, &FrameAcceleration { linear, angular });
        -DVec3::new(load.force.z, load.moment.x, load.moment.y)
    };
    DMat3::from_cols(
        column(DVec3::Z, DVec3::ZERO),
        column(DVec3::ZERO, DVec3::X),
        column(DVec3::ZERO, DVec3::Y),
    )
}

/// Everything that depends on time alone. The rates of inertia and relative momentum are read off
/// the exact rate of angular momentum of the turning system, which is affine in them.
fn instant(bodies: &System, posture: &mut Posture, t: f64) -> Instant {
    posture.update(bodies, t);
    let whole = posture.composite(bodies);
    let rate = |w: DVec3| {
        let (force, moment) = momentum_rate(bodies, posture, whole.c, w);
        let spin = whole.inertia * w + whole.h;
        (force, moment - w.cross(spin))
    };
    let (still_force, h_dot) = rate(DVec3::ZERO);
    let column = |axis: DVec3| rate(axis).1 - h_dot;
    let (motions, acc) = turning(bodies, posture, DVec3::ZERO);
    let placed = motions.iter().zip(&acc).skip(1).map(|(m, a)| Placed {
        rotation: m.r,
        rate: m.w,
        turn: a.angular,
        d: m.p,
        d_dot: m.v,
        d_ddot: a.linear,
    });
    Instant {
        c: whole.c,
        c_dot: whole.c_dot,
        c_ddot: still_force / whole.mass,
        inertia: whole.inertia,
        inverse: whole.inertia.inverse(),
        inertia_dot: DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z)),
        h: whole.h,
        h_dot,
        wings: placed.collect(),
    }
}

/// Rates of linear momentum and of angular momentum about the mass centre `c` when the root
/// stands at the origin and turns steadily with `w`.
fn momentum_rate(bodies: &System, posture: &Posture, c: DVec3, w: DVec3) -> (DVec3, DVec3) {
    let (motions, acc) = turning(bodies, posture, w);
    let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
    for ((b, m), a) in bodies.bodies().iter().zip(&motions).zip(&acc) {
        let wrench = inertia_wrench(b, m, a);
        force += wrench.force;
        moment += wrench.moment + (m.p - c).cross(wrench.force);
    }
    (force, moment)
}

/// Motions and accelerations of all bodies when the root stands at the origin and turns steadily
/// with `w`.
fn turning(
    bodies: &System,
    posture: &Posture,
    w: DVec3,
) -> (Vec<BodyMotion>, Vec<BodyAcceleration>) {
    let root = BodyMotion {
        w,
        ..BodyMotion::REST
    };
    let count = bodies.bodies().len();
    let mut motions = vec![BodyMotion::REST; count];
    let mut acc = vec![BodyAcceleration::default(); count];
    posture.motions(&root, &mut motions);
    posture.accelerations(&root, &BodyAcceleration::default(), &mut acc);
    (motions, acc)
}

/// The multibody system of the setup with these laws of its wings.
fn bodies(
    setup: &FlightSetup,
    law: impl Fn(&Wing) -> Arc<dyn RotationLaw>,
) -> Result<System, AnalysisError> {
    let plain = system(&setup.animal, setup.gravity, natural_units(setup))?;
    let mut hinges = plain.hinges().to_vec();
    for (hinge, wing) in hinges.iter_mut().zip(&setup.animal.wings) {
        hinge.law = law(wing);
    }
    let bodies = plain.bodies().to_vec();
    Ok(System::new(
        bodies,
        hinges,
        setup.gravity,
        natural_units(setup),
    )?)
}

/// The motion without its start: at full rate from the first instant.
fn steady(motion: &WingMotion) -> WingMotion {
    WingMotion {
        start: Start::Impulsive,
        ..motion.clone()
    }
}

/// A wing that goes over from one motion to another within a beat: angles and stroke plane
/// blended by the smoothstep of degree seven.
#[derive(Debug)]
struct Passage {
    from: WingMotion,
    to: WingMotion,
    period: f64,
}

impl RotationLaw for Passage {
    fn at(&self, t: f64) -> MovingRotation {
        let z = (t / self.period).clamp(0.0, 1.0);
        let y = z * (1.0 - z);
        let s = [
            z.powi(4) * (35.0 + z * (-84.0 + z * (70.0 - 20.0 * z))),
            140.0 * y * y * y / self.period,
            420.0 * y * y * (1.0 - 2.0 * z) / (self.period * self.period),
        ];
        let blend = |a: [f64; 3], b: [f64; 3]| {
            let d: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
            [
                a[0] + s[0] * d[0],
                a[1] + s[0] * d[1] + s[1] * d[0],
                a[2] + s[0] * d[2] + 2.0 * s[1] * d[1] + s[2] * d[0],
            ]
        };
        let plane = |m: &WingMotion| [m.stroke_plane_pitch, 0.0, 0.0];
        let (a, b) = (self.from.angles(t), self.to.angles(t));
        let [phi, theta, psi] = std::array::from_fn(|k| blend(a[k], b[k]));
        MovingRotation::about(1, blend(plane(&self.from), plane(&self.to)))
            .then(&MovingRotation::about(0, phi))
            .then(&MovingRotation::about(2, theta))
            .then(&MovingRotation::about(1, psi))
    }
}

/// The common period of all wings [s].
fn common_period(animal: &Animal) -> Result<f64, AnalysisError> {
    let first = animal.wings.first().map_or(0.0, |w| w.motion.frequency);
    if first <= 0.0 {
        return Err(AnalysisError::not_covered(
            "no wing beats",
            "give a wingbeat frequency",
        ));
    }
    if animal.wings.iter().any(|w| w.motion.frequency != first) {
        return Err(AnalysisError::not_covered(
            "the wings beat at different frequencies",
            "analyse wings of one frequency",
        ));
    }
    Ok(1.0 / first)
}

/// Solves `A x = b` for a symmetric positive definite A by `L D L^T`, without pivoting.
fn solve_symmetric(a: &mut [[f64; 6]; 6], x: &mut [f64; 6]) {
    for k in 0..6 {
        let inverse = 1.0 / a[k][k];
        for i in k + 1..6 {
            let factor = a[i][k] * inverse;
            for j in i..6 {
                a[j][i] -= factor * a[j][k];
            }
            x[i] -= factor * x[k];
        }
        // Column k of L replaces that of A after all updates that need it.
        for i in k + 1..6 {
            a[k][i] = a[i][k] * inverse;
        }
    }
    for k in (0..6).rev() {
        x[k] /= a[k][k];
        for i in k + 1..6 {
            x[k] -= a[k][i] * x[i];
        }
    }
}
