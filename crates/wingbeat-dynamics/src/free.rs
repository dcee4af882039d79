//! Free joint coordinates of a tree, and the equations that give their accelerations.
//!
//! A generalized speed u_j of a hinge moves every body behind the hinge: the origin of body i at
//! `V_ij u_j` and its axes at `omega_j u_j`. With f_j, n_j the momenta of the whole for u_j = 1
//! (n about the mass centre), and the bias d of every body (rate of momentum at zero u' and zero
//! acceleration of the root, less loads and weight), Kane's equations with the root eliminated by
//! the momenta of the whole are
//!
//! ```text
//! sum_k (M_jk - f_j.f_k / m - n_j.I^-1 n_k) u_k' = Q_j - D_j + f_j.F / m + n_j.I^-1 N
//! M_jk = sum_i V_ij.f_ik + omega_j.n_ik      D_j = sum_i V_ij.d_i + omega_j.(moment of d_i)
//! ```
//!
//! F, N the sum of all biases and of their moments about the mass centre. All in root components.

use wingbeat_math::{DMat3, DQuat, DVec3, SingularMatrix, Wrench, rotation_vector, solve_small};

use crate::configuration::Composite;
use crate::system::placement::Placement;
use crate::{JointModel, JointType, System};

/// Rates of a joint's coordinates.
pub(crate) fn coordinate_rates(kind: JointType, q: &[f64], u: &[f64], out: &mut [f64]) {
    if kind == JointType::Spherical {
        let rate = DQuat::from_slice(q) * DQuat::from_xyzw(u[0], u[1], u[2], 0.0) * 0.5;
        rate.write_to_slice(out);
    } else {
        out.copy_from_slice(u);
    }
}

/// Efforts of a joint's elements along its directions at its coordinates and speeds.
fn effort(joint: &JointModel, t: f64, q: &[f64], u: &[f64]) -> [f64; 3] {
    let mut motion = [[0.0; 2]; 3];
    if joint.kind == JointType::Spherical {
        let theta = rotation_vector(DQuat::from_slice(q).normalize());
        (0..3).for_each(|k| motion[k] = [theta[k], u[k]]);
    } else {
        (0..u.len()).for_each(|k| motion[k] = [q[k], u[k]]);
    }
    joint.efforts(t, &motion, |_| true)
}

/// A free direction: velocity of the child's joint point and angular velocity for unit speed, and
/// the joint point; root components.
#[derive(Clone, Copy, Debug, Default)]
struct Direction {
    hinge: usize,
    slide: DVec3,
    spin: DVec3,
    point: DVec3,
}

/// First moment and inertia of a body about its origin, and what it still needs, root components.
#[derive(Clone, Copy, Debug, Default)]
struct BodyTerms {
    first: DVec3,
    inertia: DMat3,
    bias_force: [DVec3; 2],
}

/// Scratch of the joint equations.
#[derive(Clone, Debug)]
pub(crate) struct FreeScratch {
    directions: Vec<Direction>,
    terms: Vec<BodyTerms>,
    /// Momenta of the whole for unit speeds.
    momenta: Vec<[DVec3; 2]>,
    matrix: Vec<f64>,
    scale: Vec<f64>,
    /// Accelerations of the speeds after [`FreeScratch::solve`].
    pub u_dot: Vec<f64>,
}

impl FreeScratch {
    pub(crate) fn new(system: &System) -> Self {
        let n = system.speeds();
        Self {
            directions: vec![Direction::default(); n],
            terms: vec![BodyTerms::default(); system.bodies().len()],
            momenta: vec![[DVec3::ZERO; 2]; n],
            matrix: vec![0.0; n * n],
            scale: vec![0.0; n],
            u_dot: vec![0.0; n],
        }
    }

    /// Accelerations of all speeds into `u_dot`; `bias_force` holds what every body needs at zero u'
    /// and zero acceleration of the root (N components, about its origin), `r` the root's
    /// rotation.
    pub(crate) fn solve(
        &mut self,
        system: &System,
        (t, q, u): (f64, &[f64], &[f64]),
        (placements, whole, r): (&[Placement], &Composite, DMat3),
        bias_force: &[Wrench],
    ) -> Result<(), SingularMatrix> {
        self.find_directions(system, placements, q);
        self.find_terms(system, placements, r, bias_force);
        let inverse = whole.inertia.inverse();
        let total = self.total_bias(placements, whole.c);
        for j in 0..self.u_dot.len() {
            self.momenta[j] = self.momentum(system, placements, j, whole);
        }
        self.put_efforts(system, t, q, u);
        for j in 0..self.u_dot.len() {
            self.put_row(system, placements, j, whole.mass, inverse);
            let [f, n] = self.momenta[j];
            let drive = self.u_dot[j] - self.work(system, placements, j);
            self.u_dot[j] = drive + f.dot(total[0]) / whole.mass + n.dot(inverse * total[1]);
        }
        self.eliminate()
    }

    fn find_directions(&mut self, system: &System, placements: &[Placement], q: &[f64]) {
        for (hinge, h) in system.hinges().iter().enumerate() {
            let (offsets, child) = (system.offsets()[hinge], &placements[h.child]);
            let point = child.d + child.c * h.anchor_child;
            for k in 0..offsets.speeds {
                let (mut slide, mut spin) = (DVec3::ZERO, DVec3::ZERO);
                match system.hinges()[hinge].model.kind {
                    JointType::Revolute { axis } => spin = axis,
                    JointType::Universal { axes: [a, b] } if k == 0 => {
                        spin = DMat3::from_axis_angle(b, -q[offsets.q + 1]) * a;
                    }
                    JointType::Universal { axes } => spin = axes[1],
                    JointType::Spherical => spin = DVec3::AXES[k],
                    JointType::Prismatic { axis } => slide = axis,
                    JointType::Weld | JointType::PointOnLine { .. } => {}
                }
                self.directions[offsets.u + k] = Direction {
                    hinge,
                    slide: child.c * slide,
                    spin: child.c * spin,
                    point,
                };
            }
        }
    }

    fn find_terms(
        &mut self,
        system: &System,
        placements: &[Placement],
        r: DMat3,
        bias_force: &[Wrench],
    ) {
        let back = r.transpose();
        for (i, (b, at)) in system.bodies().iter().zip(placements).enumerate() {
            self.terms[i] = BodyTerms {
                first: at.c * b.mass.first_moment,
                inertia: at.c * b.mass.inertia * at.c.transpose(),
                bias_force: [back * bias_force[i].force, back * bias_force[i].moment],
            };
        }
    }

    /// Velocity of the origin of a body at `d` for unit speed j.
    fn velocity(&self, j: usize, d: DVec3) -> DVec3 {
        let v = &self.directions[j];
        v.slide + v.spin.cross(d - v.point)
    }

    /// Momentum of body i and its moment about the body's origin for unit speed j.
    fn body_momentum(&self, system: &System, i: usize, j: usize, d: DVec3) -> [DVec3; 2] {
        let (p, v, w) = (&self.terms[i], self.velocity(j, d), self.directions[j].spin);
        let mass = system.bodies()[i].mass.mass;
        [
            mass * v + w.cross(p.first),
            p.inertia * w + p.first.cross(v),
        ]
    }

    /// Bodies that speed j moves.
    fn moved<'a>(&self, system: &'a System, j: usize) -> impl Iterator<Item = usize> + use<'a> {
        let behind = system.behind(self.directions[j].hinge);
        (0..behind.len()).filter(move |&i| behind[i])
    }

    /// Momentum of the whole and its moment about the mass centre for unit speed j.
    fn momentum(
        &self,
        system: &System,
        placements: &[Placement],
        j: usize,
        whole: &Composite,
    ) -> [DVec3; 2] {
        let mut sum = [DVec3::ZERO; 2];
        for i in self.moved(system, j) {
            let d = placements[i].d;
            let [f, n] = self.body_momentum(system, i, j, d);
            sum[0] += f;
            sum[1] += n + (d - whole.c).cross(f);
        }
        sum
    }

    fn total_bias(&self, placements: &[Placement], c: DVec3) -> [DVec3; 2] {
        let mut sum = [DVec3::ZERO; 2];
        for (p, at) in self.terms.iter().zip(placements) {
            let [f, n] = p.bias_force;
            sum[0] += f;
            sum[1] += n + (at.d - c).cross(f);
        }
        sum
    }

    /// D_j.
    fn work(&self, system: &System, placements: &[Placement], j: usize) -> f64 {
        let one = |i: usize| {
            let [f, n] = self.terms[i].bias_force;
            self.velocity(j, placements[i].d).dot(f) + self.directions[j].spin.dot(n)
        };
        self.moved(system, j).map(one).sum()
    }

    /// Q_j, the efforts of the elements of all joints, into `u_dot`.
    fn put_efforts(&mut self, system: &System, t: f64, q: &[f64], u: &[f64]) {
        for (hinge, offsets) in system.hinges().iter().zip(system.offsets()) {
            let (joint, speeds) = (&hinge.model, offsets.u..offsets.u + offsets.speeds);
            let efforts = match joint.elements.is_empty() {
                true => [0.0; 3],
                false => effort(joint, t, &q[offsets.q..], &u[speeds.clone()]),
            };
            self.u_dot[speeds.clone()].copy_from_slice(&efforts[..speeds.len()]);
        }
    }

    /// Row j of the matrix.
    fn put_row(
        &mut self,
        system: &System,
        placements: &[Placement],
        j: usize,
        mass: f64,
        inverse: DMat3,
    ) {
        let (n, [fj, nj]) = (self.u_dot.len(), self.momenta[j]);
        for k in 0..n {
            let [fk, nk] = self.momenta[k];
            let mut sum = -fj.dot(fk) / mass - nj.dot(inverse * nk);
            let other = system.behind(self.directions[k].hinge);
            for i in self.moved(system, j).filter(|&i| other[i]) {
                let d = placements[i].d;
                let [f, m] = self.body_momentum(system, i, k, d);
                sum += self.velocity(j, d).dot(f) + self.directions[j].spin.dot(m);
            }
            self.matrix[j * n + k] = sum;
        }
    }

    /// Scales by the diagonal, solves.
    fn eliminate(&mut self) -> Result<(), SingularMatrix> {
        let n = self.u_dot.len();
        for j in 0..n {
            let d = self.matrix[j * n + j];
            if d <= 0.0 {
                return Err(SingularMatrix { column: j });
            }
            self.scale[j] = 1.0 / d.sqrt();
        }
        for j in 0..n {
            for k in 0..n {
                self.matrix[j * n + k] *= self.scale[j] * self.scale[k];
            }
            self.u_dot[j] *= self.scale[j];
        }
        solve_small(&mut self.matrix, &mut self.u_dot)?;
        (self.u_dot.iter_mut().zip(&self.scale)).for_each(|(x, s)| *x *= s);
        Ok(())
    }

    /// Adds the accelerations of the speeds to those of the placements.
    pub(crate) fn accelerate(&self, system: &System, placements: &mut [Placement]) {
        for (j, u_dot) in self.u_dot.iter().enumerate() {
            for i in self.moved(system, j) {
                let at = &mut placements[i];
                at.d_ddot += self.velocity(j, at.d) * *u_dot;
                at.w_dot += at.c.transpose() * self.directions[j].spin * *u_dot;
            }
        }
    }

    /// Name of the hinge of speed `j`.
    pub(crate) fn hinge<'a>(&self, system: &'a System, j: usize) -> &'a str {
        &system.hinges()[self.directions[j].hinge].name
    }
}
