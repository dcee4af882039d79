//! Averages, free flight and linear problems of the second program ([`super::quasi_steady`]).

use super::quasi_steady::*;

/// Samples of a beat: periodic integrands, so that equal weights converge faster than any power.
const SAMPLES: usize = 400;
/// Steps of the classical Runge-Kutta method over a beat.
const STEPS: usize = 200;

const STILL: Vector = [0.0; 3];

/// State of free flight: attitude (body to inertial), velocity of the origin and angular velocity, body components.
#[derive(Clone, Copy)]
pub struct State {
    pub attitude: Matrix,
    pub v: Vector,
    pub w: Vector,
}

/// Means over a beat.
pub struct Means {
    /// Mean mass centre, body components \[m\].
    pub centre: Vector,
    /// Mean inertia about it, body components [kg m2].
    pub inertia: Matrix,
    pub mass: f64,
    /// Aerodynamic power while the body is held \[W\].
    pub power: f64,
}

impl Flyer {
    fn phases() -> impl Iterator<Item = f64> {
        (0..SAMPLES).map(|k| k as f64 / SAMPLES as f64)
    }

    pub fn means(&self) -> Means {
        let held = Motion {
            v: STILL,
            w: STILL,
            a: STILL,
            w_rate: STILL,
        };
        let whole = |x: f64| {
            let wings = (0..self.wings.len()).map(|k| self.wing(k, x, &held, STILL).mass);
            wings.fold(self.body, |sum, wing| sum.plus(&wing))
        };
        let mass = whole(0.0).mass;
        let part = 1.0 / SAMPLES as f64;
        let first = Self::phases().fold(STILL, |sum, x| add(sum, whole(x).first));
        let centre = times(part / mass, first);
        let mut inertia = [STILL; 3];
        let mut power = 0.0;
        for x in Self::phases() {
            let about_centre = whole(x).moved(times(-1.0, centre)).inertia;
            inertia = [0, 1, 2].map(|i| add(inertia[i], times(part, about_centre[i])));
            let wings = (0..self.wings.len()).map(|k| self.wing(k, x, &held, STILL).power);
            power += part * wings.sum::<f64>();
        }
        Means {
            centre,
            inertia,
            mass,
            power,
        }
    }

    /// Mean force and moment about the mean mass centre, axes of a frame that `level` turns to the body's, while the
    /// centre moves with `velocity` and the body turns with `rate` in that frame, both steady.
    pub fn mean_load(
        &self,
        centre: Vector,
        level: &Matrix,
        velocity: Vector,
        rate: Vector,
    ) -> [f64; 6] {
        self.changing_load(centre, level, [velocity, rate], [STILL; 2])
    }

    /// The same while velocity and rate change.
    fn changing_load(
        &self,
        centre: Vector,
        level: &Matrix,
        [velocity, rate]: [Vector; 2],
        rates: [Vector; 2],
    ) -> [f64; 6] {
        let w = turn(level, rate);
        let v = add(turn(level, velocity), times(-1.0, cross(w, centre)));
        let [v_rate, w_rate] = rates.map(|x| turn(level, x));
        let changing = add(v_rate, times(-1.0, cross(w_rate, centre)));
        let body = Motion {
            v,
            w,
            a: add(cross(w, v), changing),
            w_rate,
        };
        let mut sum = [0.0; 6];
        for x in Self::phases() {
            for k in 0..self.wings.len() {
                let air = self.wing(k, x, &body, STILL).air;
                let lever = times(-1.0, cross(centre, air.force));
                let load = [air.force, add(air.moment, lever)];
                let load = load.map(|l| turn(&transposed(level), l));
                (0..6).for_each(|i| sum[i] += load[i / 3][i % 3] / SAMPLES as f64);
            }
        }
        sum
    }

    /// Derivatives of the mean load about hover by u, v, w, p, q, r: central differences of fourth order.
    pub fn derivatives(&self, centre: Vector, level: &Matrix, sizes: [f64; 2]) -> [[f64; 6]; 6] {
        let column = |j: usize| {
            let step = 1e-3 * sizes[j / 3];
            let at = |s: f64| {
                let mut x = [0.0; 6];
                x[j] = s * step;
                self.mean_load(centre, level, [x[0], x[1], x[2]], [x[3], x[4], x[5]])
            };
            slopes(at).map(|d| d / step)
        };
        let columns: Vec<[f64; 6]> = (0..6).map(column).collect();
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
    }

    /// What the mean load about hover is smaller by for unit rates of u, v, w, p, q, r: linear in them.
    pub fn added_mass(&self, centre: Vector, level: &Matrix) -> [[f64; 6]; 6] {
        let load = |rates| self.changing_load(centre, level, [STILL; 2], rates);
        let still = load([STILL; 2]);
        let column = |j: usize| {
            let mut rates = [STILL; 2];
            rates[j / 3][j % 3] = 1.0;
            let moved = load(rates);
            std::array::from_fn::<f64, 6, _>(|i| still[i] - moved[i])
        };
        let columns: [[f64; 6]; 6] = std::array::from_fn(column);
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
    }

    /// Mean moment about the mass centre that the masses ask for when the body turns steadily, derivatives by
    /// p, q, r, level axes: what wings exert whose angular momentum is turned. By the forces on every mass, no
    /// angular momentum is summed.
    pub fn gyroscopic(&self, level: &Matrix, rate: f64) -> Matrix {
        let moment = |w: Vector| {
            let body = Motion {
                v: STILL,
                w,
                a: STILL,
                w_rate: STILL,
            };
            let mut sum = STILL;
            for x in Self::phases() {
                let mut need = self.body.inertial_less_weight(&body, STILL);
                let mut whole = self.body;
                for k in 0..self.wings.len() {
                    let wing = self.wing(k, x, &body, STILL);
                    need = add_wrench(need, wing.inertia);
                    whole = whole.plus(&wing.mass);
                }
                let centre = times(1.0 / whole.mass, whole.first);
                let about = add(need.moment, times(-1.0, cross(centre, need.force)));
                sum = add(sum, times(1.0 / SAMPLES as f64, about));
            }
            turn(&transposed(level), sum)
        };
        let column = |j: usize| {
            let at = |s: f64| {
                let mut w = STILL;
                w[j] = s * rate;
                moment(turn(level, w))
            };
            times(1.0 / rate, slopes(at))
        };
        let columns = [0, 1, 2].map(column);
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| columns[j][i]))
    }

    /// Accelerations of the body (inertial, body components) that satisfy Newton's and Euler's laws: these are linear
    /// in them, so that seven evaluations give the six equations.
    fn accelerations(&self, x: f64, state: &State) -> [Vector; 2] {
        let gravity = turn(&transposed(&state.attitude), [0.0, 0.0, self.gravity]);
        let missing = |a: Vector, w_rate: Vector| {
            let body = Motion {
                v: state.v,
                w: state.w,
                a,
                w_rate,
            };
            let mut need = self.body.inertial_less_weight(&body, gravity);
            for k in 0..self.wings.len() {
                let wing = self.wing(k, x, &body, gravity);
                need = less(add_wrench(need, wing.inertia), wing.air);
            }
            [
                need.force[0],
                need.force[1],
                need.force[2],
                need.moment[0],
                need.moment[1],
                need.moment[2],
            ]
        };
        let still = missing(STILL, STILL);
        let unit = |j: usize| {
            let mut e = [STILL; 2];
            e[j / 3][j % 3] = 1.0;
            let moved = missing(e[0], e[1]);
            std::array::from_fn::<f64, 6, _>(|i| moved[i] - still[i])
        };
        let columns: Vec<[f64; 6]> = (0..6).map(unit).collect();
        let matrix = (0..6).map(|i| (0..6).map(|j| columns[j][i]).collect());
        let solution = solve(matrix.collect(), still.iter().map(|x| -x).collect());
        [0, 3].map(|k| [solution[k], solution[k + 1], solution[k + 2]])
    }

    /// Rates of attitude, velocity and angular velocity.
    fn rates(&self, x: f64, s: &State) -> State {
        let [a, w_rate] = self.accelerations(x, s);
        let spin = [
            [0.0, -s.w[2], s.w[1]],
            [s.w[2], 0.0, -s.w[0]],
            [-s.w[1], s.w[0], 0.0],
        ];
        State {
            attitude: product(&s.attitude, &spin),
            v: add(a, times(-1.0, cross(s.w, s.v))),
            w: w_rate,
        }
    }

    /// Mean pitch \[rad\] over the beat from `start`, which pitches and does not roll or yaw.
    pub fn mean_pitch(&self, start: &State) -> f64 {
        let (mut sine, mut cosine) = (0.0, 0.0);
        self.fly(start, |s| {
            let half = 0.5 * s.attitude[0][2].atan2(s.attitude[0][0]);
            sine += half.sin();
            cosine += half.cos();
        });
        2.0 * f64::atan2(sine, cosine)
    }

    /// The state a beat later.
    pub fn beat(&self, start: &State) -> State {
        self.fly(start, |_| ())
    }

    /// The same, seen by `look` before every step.
    fn fly(&self, start: &State, mut look: impl FnMut(&State)) -> State {
        let h = 1.0 / (self.frequency * STEPS as f64);
        let mut y = *start;
        for step in 0..STEPS {
            look(&y);
            let at = |part: f64| (step as f64 + part) / STEPS as f64;
            let k1 = self.rates(at(0.0), &y);
            let k2 = self.rates(at(0.5), &along(&y, 0.5 * h, &k1));
            let k3 = self.rates(at(0.5), &along(&y, 0.5 * h, &k2));
            let k4 = self.rates(at(1.0), &along(&y, h, &k3));
            for (part, k) in [(1.0, k1), (2.0, k2), (2.0, k3), (1.0, k4)] {
                y = along(&y, part * h / 6.0, &k);
            }
        }
        y
    }

    /// Departure of a state from `reference`: velocity, angular velocity, rotation vector.
    pub fn departure(reference: &State, s: &State) -> [f64; 9] {
        let turned = product(&transposed(&reference.attitude), &s.attitude);
        let axis = [
            turned[2][1] - turned[1][2],
            turned[0][2] - turned[2][0],
            turned[1][0] - turned[0][1],
        ];
        let sine = 0.5 * dot(axis, axis).sqrt();
        let factor = if sine == 0.0 {
            0.5
        } else {
            0.5 * sine.asin() / sine
        };
        let d = [0, 1, 2].map(|i| s.v[i] - reference.v[i]);
        let e = [0, 1, 2].map(|i| s.w[i] - reference.w[i]);
        let f = times(factor, axis);
        [d[0], d[1], d[2], e[0], e[1], e[2], f[0], f[1], f[2]]
    }

    /// Derivative of the map of a beat at the periodic orbit through `start`, in units of `sizes` (velocity, rate).
    pub fn monodromy(&self, start: &State, sizes: [f64; 2]) -> Vec<Vec<f64>> {
        let unit = |i: usize| [sizes[0], sizes[1], 1.0][i / 3];
        let column = |j: usize| {
            let step = 1e-4;
            let at = |s: f64| {
                let mut x = [0.0; 9];
                x[j] = s * step * unit(j);
                let moved = State {
                    attitude: product(&start.attitude, &rotation([x[6], x[7], x[8]])),
                    v: add(start.v, [x[0], x[1], x[2]]),
                    w: add(start.w, [x[3], x[4], x[5]]),
                };
                Self::departure(start, &self.beat(&moved))
            };
            let d = slopes(at);
            std::array::from_fn::<f64, 9, _>(|i| d[i] / step / unit(i))
        };
        let columns: Vec<[f64; 9]> = (0..9).map(column).collect();
        (0..9)
            .map(|i| (0..9).map(|j| columns[j][i]).collect())
            .collect()
    }
}

impl Mass {
    fn inertial_less_weight(&self, m: &Motion, gravity: Vector) -> Wrench {
        less(self.inertial(m), self.weight(gravity))
    }
}

fn add_wrench(a: Wrench, b: Wrench) -> Wrench {
    Wrench {
        force: add(a.force, b.force),
        moment: add(a.moment, b.moment),
    }
}

fn less(a: Wrench, b: Wrench) -> Wrench {
    Wrench {
        force: add(a.force, times(-1.0, b.force)),
        moment: add(a.moment, times(-1.0, b.moment)),
    }
}

/// y + h k.
fn along(y: &State, h: f64, k: &State) -> State {
    State {
        attitude: [0, 1, 2].map(|i| add(y.attitude[i], times(h, k.attitude[i]))),
        v: add(y.v, times(h, k.v)),
        w: add(y.w, times(h, k.w)),
    }
}

/// Derivative at 0 by fourth-order central differences with step one.
fn slopes<const N: usize>(f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(&f);
    std::array::from_fn(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / 12.0)
}

/// Solution of `matrix x = right` by elimination with row exchanges.
pub fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        let p = (k..n).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs()));
        let p = p.expect("not empty");
        matrix.swap(k, p);
        right.swap(k, p);
        for i in k + 1..n {
            let f = matrix[i][k] / matrix[k][k];
            let row = matrix[k].clone();
            (k..n).for_each(|j| matrix[i][j] -= f * row[j]);
            right[i] -= f * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    right
}

/// Eigenvalues as the roots of the characteristic polynomial: Faddeev and Le Verrier's recurrence, then all roots
/// together by Weierstrass's iteration.
pub fn eigenvalues(a: &[Vec<f64>]) -> Vec<[f64; 2]> {
    let n = a.len();
    let mut polynomial = vec![1.0];
    let mut m = vec![vec![0.0; n]; n];
    for k in 1..=n {
        (0..n).for_each(|i| m[i][i] += polynomial[k - 1]);
        let entry = |i: usize, j: usize| (0..n).map(|l| a[i][l] * m[l][j]).sum::<f64>();
        m = (0..n)
            .map(|i| (0..n).map(|j| entry(i, j)).collect())
            .collect();
        let trace: f64 = (0..n).map(|i| m[i][i]).sum();
        polynomial.push(-trace / k as f64);
    }
    roots(&polynomial)
}

fn complex_product(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Roots of a polynomial whose leading coefficient, the first, is one.
fn roots(polynomial: &[f64]) -> Vec<[f64; 2]> {
    let n = polynomial.len() - 1;
    let bound = (1..=n).map(|k| polynomial[k].abs().powf(1.0 / k as f64));
    let size = bound.fold(0.0, f64::max);
    let angle = |k: usize| 0.4 + std::f64::consts::TAU * k as f64 / n as f64;
    let mut z: Vec<[f64; 2]> = (0..n)
        .map(|k| [size * angle(k).cos(), size * angle(k).sin()])
        .collect();
    for _ in 0..2000 {
        for i in 0..n {
            let value = polynomial.iter().fold([0.0; 2], |sum, c| {
                let p = complex_product(sum, z[i]);
                [p[0] + c, p[1]]
            });
            let others = (0..n).filter(|j| *j != i).fold([1.0, 0.0], |sum, j| {
                complex_product(sum, [z[i][0] - z[j][0], z[i][1] - z[j][1]])
            });
            let square = others[0] * others[0] + others[1] * others[1];
            let step = complex_product(value, [others[0] / square, -others[1] / square]);
            z[i] = [z[i][0] - step[0], z[i][1] - step[1]];
        }
    }
    z
}
