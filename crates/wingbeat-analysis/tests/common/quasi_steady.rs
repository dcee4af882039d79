//! A second program for flapping flight in quasi-steady air, written from the formulas alone.
//!
//! Nothing here calls the crates of this program: it takes the numbers of a case (masses, strips, coefficients of
//! angles) and has its own vectors, rotations, coefficient laws, averages, equations of motion and integration. It
//! is written for reading, not for speed; where the crates sum over a wing first, it adds strip by strip, and where
//! they integrate momenta it solves Newton's and Euler's laws for accelerations.
//!
//! | symbol | name in code | unit | components |
//! |---|---|---|---|
//! | C | `c`: wing to body, `R2(eta) R1(phi) R3(theta) R2(psi)` | | |
//! | V, w | velocity of the body's origin, angular velocity | m/s, rad/s | body |
//! | A, w' | their inertial accelerations | m/s2, rad/s2 | body |
//! | u, w_n, q | velocity of a strip along chord and normal, rate of feathering | m/s, rad/s | wing |
//!
//! Air of a strip (chord c, width dr, feathering axis x0 behind the leading edge): lift and drag
//! `rho/2 c dr U^2` times `C_L = lift sin 2a`, `C_D = drag_0 cos^2 a + drag_90 sin^2 a`; circulation of feathering
//! `pi (3/4 - x0/c) c^2 q` by Kutta and Joukowski [Sane & Dickinson 2002]; centre of pressure `(2 - cos a)/4` of the
//! chord behind the leading edge; added mass `rho pi/4 c^2 dr` at mid chord with the moment of inertia
//! `rho pi/128 c^4 dr`, as the rate of the impulse of the air, Munk's couple about the span left out.

use std::f64::consts::{PI, TAU};

/// Three components.
pub type Vector = [f64; 3];
/// Rows of a 3 x 3 matrix.
pub type Matrix = [Vector; 3];

pub fn add(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] + b[i])
}

pub fn times(s: f64, a: Vector) -> Vector {
    a.map(|x| s * x)
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// M a.
pub fn turn(m: &Matrix, a: Vector) -> Vector {
    m.map(|row| dot(row, a))
}

pub fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

/// A B.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = transposed(b);
    a.map(|row| columns.map(|column| dot(row, column)))
}

/// Active rotation by `angle` about axis 0, 1 or 2.
pub fn about(axis: usize, angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m = [[0.0; 3]; 3];
    m[axis][axis] = 1.0;
    (m[i][i], m[j][j], m[i][j], m[j][i]) = (c, c, -s, s);
    m
}

/// Rotation by a rotation vector (Rodrigues' formula).
pub fn rotation(d: Vector) -> Matrix {
    let angle = dot(d, d).sqrt();
    let one = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    if angle == 0.0 {
        return one;
    }
    let axis = times(1.0 / angle, d);
    let columns = one.map(|e| {
        let along = times(dot(axis, e) * (1.0 - angle.cos()), axis);
        add(
            add(times(angle.cos(), e), along),
            times(angle.sin(), cross(axis, e)),
        )
    });
    transposed(&columns)
}

/// An angle over the phase x of the beat \[rad\].
pub enum Law {
    /// `mean + sum a_k cos 2 pi k x + b_k sin 2 pi k x`.
    Series(f64, Vec<f64>, Vec<f64>),
    /// `mean + amplitude tanh(shape sin(2 pi x + shift)) / tanh(shape)`.
    Square([f64; 4]),
}

impl Law {
    /// Value and derivative by the phase.
    fn at(&self, x: f64) -> [f64; 2] {
        match self {
            Law::Series(mean, cos, sin) => {
                let mut q = [*mean, 0.0];
                for k in 0..cos.len().max(sin.len()) {
                    let w = TAU * (k + 1) as f64;
                    let a = cos.get(k).copied().unwrap_or(0.0);
                    let b = sin.get(k).copied().unwrap_or(0.0);
                    q[0] += a * (w * x).cos() + b * (w * x).sin();
                    q[1] += w * (b * (w * x).cos() - a * (w * x).sin());
                }
                q
            }
            Law::Square([mean, amplitude, shape, shift]) => {
                let (s, c) = (TAU * x + shift).sin_cos();
                let (th, norm) = ((shape * s).tanh(), amplitude / shape.tanh());
                [mean + norm * th, norm * (1.0 - th * th) * shape * c * TAU]
            }
        }
    }
}

/// A strip of a wing; the feathering axis is x = 0 \[m\].
pub struct Strip {
    pub y: f64,
    pub leading: f64,
    pub chord: f64,
    pub width: f64,
}

/// Mass \[kg\], first moment [kg m] and inertia [kg m2] about the origin of a frame.
#[derive(Clone, Copy)]
pub struct Mass {
    pub mass: f64,
    pub first: Vector,
    pub inertia: Matrix,
}

/// A wing that beats as prescribed.
pub struct Wing {
    pub hinge: Vector,
    pub mass: Mass,
    pub strips: Vec<Strip>,
    /// Pitch of the stroke plane \[rad\].
    pub plane: f64,
    /// Stroke, deviation, feathering.
    pub angles: [Law; 3],
}

/// Density [kg/m3] and coefficients of the sections.
pub struct Sections {
    pub density: f64,
    pub lift: f64,
    pub drag_0: f64,
    pub drag_90: f64,
}

/// The animal and its air.
pub struct Flyer {
    pub body: Mass,
    pub wings: Vec<Wing>,
    pub frequency: f64,
    pub gravity: f64,
    pub air: Sections,
}

/// A force and the moment about a point.
#[derive(Clone, Copy, Default)]
pub struct Wrench {
    pub force: Vector,
    pub moment: Vector,
}

impl Wrench {
    fn plus(self, s: f64, other: Self) -> Self {
        Self {
            force: add(self.force, times(s, other.force)),
            moment: add(self.moment, times(s, other.moment)),
        }
    }
}

/// Velocity of a frame's origin and angular velocity, and their inertial rates, in its components.
#[derive(Clone, Copy)]
pub struct Motion {
    pub v: Vector,
    pub w: Vector,
    pub a: Vector,
    pub w_rate: Vector,
}

impl Wing {
    /// Orientation, and angular velocity relative to the body (body components) at the phase `x`, beating with
    /// `frequency`.
    fn posture(&self, x: f64, frequency: f64) -> (Matrix, Vector) {
        let [phi, theta, psi] = [0, 1, 2].map(|k| self.angles[k].at(x));
        let [tilt, stroke] = [about(1, self.plane), about(0, phi[0])];
        let [deviation, feathering] = [about(2, theta[0]), about(1, psi[0])];
        let to_body = product(&tilt, &stroke);
        let c = product(&product(&to_body, &deviation), &feathering);
        let span = turn(&deviation, [0.0, psi[1], 0.0]);
        let inner = turn(&stroke, add([0.0, 0.0, theta[1]], span));
        let rate = turn(&tilt, add([phi[1], 0.0, 0.0], inner));
        (c, times(frequency, rate))
    }

    /// Orientation, relative angular velocity and its rate in body components; the rate by fourth-order differences.
    fn moving(&self, x: f64, frequency: f64) -> (Matrix, Vector, Vector) {
        let (c, spin) = self.posture(x, frequency);
        let h = 1e-4;
        let at = |s: f64| self.posture(x + s * h, frequency).1;
        let [near, far] = [1.0, 2.0].map(|s| add(at(s), times(-1.0, at(-s))));
        let slope = add(times(8.0, near), times(-1.0, far));
        (c, spin, times(frequency / (12.0 * h), slope))
    }
}

impl Sections {
    /// Force and moment about the hinge, wing components, of a wing that moves like `m`.
    pub fn wrench(&self, strips: &[Strip], m: &Motion) -> Wrench {
        let mut sum = Wrench::default();
        for strip in strips {
            sum = sum.plus(1.0, self.circulatory(strip, m));
            sum = sum.plus(1.0, self.added_mass(strip, m));
        }
        sum
    }

    /// Lift, drag, the circulation of feathering and its moment.
    fn circulatory(&self, s: &Strip, m: &Motion) -> Wrench {
        let at_axis = add(m.v, cross(m.w, [0.0, s.y, 0.0]));
        let (u, w_n, q) = (at_axis[0], at_axis[2], m.w[1]);
        let speed = u.hypot(w_n);
        if speed == 0.0 {
            return Wrench::default();
        }
        let attack = w_n.abs().atan2(u.abs());
        let lift = self.lift * (2.0 * attack).sin();
        let drag = self.drag_0 * attack.cos().powi(2) + self.drag_90 * attack.sin().powi(2);
        let pressure = 0.5 * self.density * s.chord * s.width * speed;
        // Across the velocity, to the side from which the air does not come.
        let side = -(u * w_n).signum();
        let translation = [
            pressure * (-side * lift * w_n - drag * u),
            pressure * (side * lift * u - drag * w_n),
        ];
        // Thin-airfoil theory, the edge in front being that which meets the air.
        let part = 0.25 + (0.5 - s.leading / s.chord) * u / speed;
        let circulation = PI * part * s.chord * s.chord * q;
        let joukowski = self.density * s.width * circulation;
        let force = [
            translation[0] + joukowski * w_n,
            0.0,
            translation[1] - joukowski * u,
        ];
        let behind = (2.0 - u / speed) / 4.0;
        let arm = [s.leading - s.chord * behind, 0.0, 0.0];
        let couple = -PI / 16.0 * self.density * s.chord.powi(3) * s.width * u.abs() * q;
        // The force along the chord acts in the plane of the wing, on the axis.
        let moment = add(
            add(cross(arm, [0.0, 0.0, force[2]]), [0.0, couple, 0.0]),
            cross([0.0, s.y, 0.0], force),
        );
        Wrench { force, moment }
    }

    /// Minus the rate of the impulse `m w_n n` at mid chord and of its moment about the hinge.
    fn added_mass(&self, s: &Strip, m: &Motion) -> Wrench {
        let mass = 0.25 * PI * self.density * s.chord * s.chord * s.width;
        let inertia = PI / 128.0 * self.density * s.chord.powi(4) * s.width;
        let normal = [0.0, 0.0, 1.0];
        let arm = [s.leading - 0.5 * s.chord, s.y, 0.0];
        let v = add(m.v, cross(m.w, arm));
        let spun = cross(m.w, cross(m.w, arm));
        let a = add(add(m.a, cross(m.w_rate, arm)), spun);
        let momentum = mass * v[2];
        // Rate of the normal component: acceleration, and the normal that turns.
        let rate = mass * (dot(a, normal) + dot(v, cross(m.w, normal)));
        let impulse = times(momentum, normal);
        let force = add(times(rate, normal), cross(m.w, impulse));
        let about_span = inertia * m.w[1];
        let angular = add(cross(arm, impulse), [0.0, about_span, 0.0]);
        let spin_rate = m.w_rate[1];
        let own = add(
            cross(arm, times(rate, normal)),
            [0.0, inertia * spin_rate, 0.0],
        );
        let mut turning = add(cross(m.w, angular), cross(m.v, impulse));
        turning[1] = 0.0;
        Wrench {
            force: times(-1.0, force),
            moment: times(-1.0, add(own, turning)),
        }
    }
}

impl Mass {
    /// Force and moment about the origin that make it move like `m`.
    pub fn inertial(&self, m: &Motion) -> Wrench {
        let spun = cross(m.w, cross(m.w, self.first));
        let linear = add(
            times(self.mass, m.a),
            add(cross(m.w_rate, self.first), spun),
        );
        let angular = add(
            turn(&self.inertia, m.w_rate),
            cross(m.w, turn(&self.inertia, m.w)),
        );
        Wrench {
            force: linear,
            moment: add(angular, cross(self.first, m.a)),
        }
    }

    /// Weight under `g` and its moment about the origin.
    pub fn weight(&self, g: Vector) -> Wrench {
        Wrench {
            force: times(self.mass, g),
            moment: cross(self.first, g),
        }
    }
}

/// What a wing adds, body components about the body's origin.
pub struct OfWing {
    /// Air.
    pub air: Wrench,
    /// Inertia less weight.
    pub inertia: Wrench,
    /// Power that turns the wing against the air \[W\].
    pub power: f64,
    /// The wing's mass in the body's frame.
    pub mass: Mass,
}

impl Flyer {
    /// What wing `k` adds at the phase `x` while the body moves like `body` under `gravity` (body components).
    pub fn wing(&self, k: usize, x: f64, body: &Motion, gravity: Vector) -> OfWing {
        let wing = &self.wings[k];
        let (c, spin, spin_rate) = wing.moving(x, self.frequency);
        let back = transposed(&c);
        let arm = wing.hinge;
        let hinge = add(body.v, cross(body.w, arm));
        let spun = cross(body.w, cross(body.w, arm));
        let hinge_rate = add(add(body.a, cross(body.w_rate, arm)), spun);
        let turning = add(add(body.w_rate, spin_rate), cross(body.w, spin));
        let motion = Motion {
            v: turn(&back, hinge),
            w: turn(&back, add(body.w, spin)),
            a: turn(&back, hinge_rate),
            w_rate: turn(&back, turning),
        };
        let air = self.air.wrench(&wing.strips, &motion);
        let weight = wing.mass.weight(turn(&back, gravity));
        let inertia = wing.mass.inertial(&motion).plus(-1.0, weight);
        let to_body = |load: Wrench| {
            let force = turn(&c, load.force);
            Wrench {
                force,
                moment: add(turn(&c, load.moment), cross(arm, force)),
            }
        };
        OfWing {
            power: -dot(air.moment, turn(&back, spin)),
            air: to_body(air),
            inertia: to_body(inertia),
            mass: wing.mass.turned(&c).moved(arm),
        }
    }
}

impl Mass {
    fn turned(&self, c: &Matrix) -> Self {
        Self {
            mass: self.mass,
            first: turn(c, self.first),
            inertia: product(&product(c, &self.inertia), &transposed(c)),
        }
    }

    /// About a point from which the origin is at `r` (parallel axes).
    pub fn moved(&self, r: Vector) -> Self {
        let (m, s) = (self.mass, self.first);
        let trace = 2.0 * dot(s, r) + m * dot(r, r);
        let entry = |i: usize, j: usize| {
            let diagonal = if i == j { trace } else { 0.0 };
            self.inertia[i][j] + diagonal - s[i] * r[j] - r[i] * s[j] - m * r[i] * r[j]
        };
        Self {
            mass: m,
            first: add(s, times(m, r)),
            inertia: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
        }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first: add(self.first, other.first),
            inertia: [0, 1, 2].map(|i| add(self.inertia[i], other.inertia[i])),
        }
    }
}
