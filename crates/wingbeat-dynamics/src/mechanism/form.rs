//! Absolute coordinates with multipliers: position, unit quaternion, velocity and angular velocity
//! of every body, 13 numbers each; singular at no attitude.
//!
//! ```text
//! [ M  B^T ] [ v'     ]   [ Q - inertia terms                     ]
//! [ B  0   ] [ lambda ] = [ -bias - 2 alpha rate - beta^2 value   ]
//! ```
//!
//! Velocities are taken in N components, angular velocities in body components, so that M is
//! `[[m I, -R tilde(S)], [tilde(S) R^T, J]]`. Scaled as [`crate::euler::saddle`].

use wingbeat_math::{DMat3, DQuat, DVec3, solve_small, tilde};

use super::link::{LinkKinematics, Row, kinematics};
use super::structure::Mechanism;
use crate::body::kinetic_energy;
use crate::check::check_state;
use crate::link::Link;
use crate::{Baumgarte, BodyAcceleration, BodyMotion, DynamicsError, HingeReaction, Wrench};

/// Numbers per body in the state.
pub const PER_BODY: usize = 13;

/// How the constraints are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stabilization {
    /// Not at all.
    None,
    /// By feedback (seed eq. 29).
    Baumgarte(Baumgarte),
    /// By projection of positions and velocities between steps ([`AbsoluteForm::project`]), along
    /// the directions of least kinetic energy.
    Projection,
}

/// The equations of a [`Mechanism`].
#[derive(Clone, Debug)]
pub struct AbsoluteForm {
    mechanism: Mechanism,
    stabilization: Stabilization,
}

/// Intermediate results, and what was solved for last.
#[derive(Clone, Debug)]
pub struct AbsoluteScratch {
    /// Motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// Accelerations of the bodies.
    pub accelerations: Vec<BodyAcceleration>,
    /// Load of every link on its child at its anchor, efforts included.
    pub reactions: Vec<HingeReaction>,
    /// Largest constraint values: lengths \[m\], angles \[rad\].
    pub violation: [f64; 2],
    links: Vec<LinkKinematics>,
    rows: Vec<(usize, Row)>,
    matrix: Vec<f64>,
    rhs: Vec<f64>,
    scale: Vec<f64>,
    loads: Vec<Wrench>,
}

impl AbsoluteForm {
    /// The equations of `mechanism`.
    pub fn new(mechanism: Mechanism, stabilization: Stabilization) -> Self {
        Self {
            mechanism,
            stabilization,
        }
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    /// How the constraints are kept.
    pub fn stabilization(&self) -> Stabilization {
        self.stabilization
    }

    /// Length of the state.
    pub fn dim(&self) -> usize {
        PER_BODY * self.mechanism.bodies().len()
    }

    /// Room for intermediate results.
    pub fn scratch(&self) -> AbsoluteScratch {
        let (bodies, links) = (self.mechanism.bodies().len(), self.mechanism.links());
        let motions = vec![BodyMotion::REST; bodies];
        let links = link_kinematics(links, 0.0, &motions);
        let mut rows = vec![];
        for (k, l) in links.iter().enumerate() {
            l.rows(|r| rows.push((k, r)));
        }
        let n = 6 * bodies + rows.len();
        AbsoluteScratch {
            accelerations: vec![BodyAcceleration::default(); bodies],
            reactions: vec![HingeReaction::default(); links.len()],
            violation: [0.0; 2],
            matrix: vec![0.0; n * n],
            rhs: vec![0.0; n],
            scale: vec![0.0; n],
            loads: vec![Wrench::default(); bodies],
            motions,
            links,
            rows,
        }
    }

    /// The state of bodies that move like `motions`.
    pub fn pack(&self, motions: &[BodyMotion], y: &mut [f64]) {
        for (m, y) in motions.iter().zip(y.chunks_exact_mut(PER_BODY)) {
            m.p.write_to_slice(&mut y[0..]);
            DQuat::from_mat3(&m.r)
                .normalize()
                .write_to_slice(&mut y[3..]);
            m.v.write_to_slice(&mut y[7..]);
            m.w.write_to_slice(&mut y[10..]);
        }
    }

    /// Motions of the bodies in the state `y`.
    ///
    /// # Errors
    /// The state is not finite.
    pub fn motions(&self, t: f64, y: &[f64], out: &mut [BodyMotion]) -> Result<(), DynamicsError> {
        assert_eq!(y.len(), self.dim(), "13 components for every body");
        check_state(t, y)?;
        for (m, y) in out.iter_mut().zip(y.chunks_exact(PER_BODY)) {
            let v = |i: usize| DVec3::from_slice(&y[i..]);
            *m = BodyMotion {
                p: v(0),
                r: DMat3::from_quat(DQuat::from_slice(&y[3..]).normalize()),
                v: v(7),
                w: v(10),
            };
        }
        Ok(())
    }

    /// Accelerations and reactions in the state `y` under `loads` (weight not included) into `s`.
    ///
    /// # Errors
    /// The state is not finite; the equations are singular.
    pub fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        s: &mut AbsoluteScratch,
    ) -> Result<(), DynamicsError> {
        self.motions(t, y, &mut s.motions)?;
        self.find_rows(t, s);
        s.loads.copy_from_slice(loads);
        self.put_efforts(t, s);
        self.put_bodies(s);
        let b = match self.stabilization {
            Stabilization::Baumgarte(b) => b,
            _ => Baumgarte::OFF,
        };
        let first = 6 * s.motions.len();
        for (k, (_, r)) in s.rows.iter().enumerate() {
            s.rhs[first + k] = -r.bias - 2.0 * b.alpha * r.rate - b.beta * b.beta * r.value;
        }
        self.put_constraints(s);
        self.eliminate(t, s)?;
        self.read(t, s);
        Ok(())
    }

    /// Time derivative of the state.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        s: &mut AbsoluteScratch,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.solve(t, y, loads, s)?;
        let bodies = y.chunks_exact(PER_BODY).zip(dy.chunks_exact_mut(PER_BODY));
        for (a, (y, dy)) in s.accelerations.iter().zip(bodies) {
            let (q, w) = (DQuat::from_slice(&y[3..]), DVec3::from_slice(&y[10..]));
            dy[0..3].copy_from_slice(&y[7..10]);
            let turn = q * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5;
            turn.write_to_slice(&mut dy[3..]);
            a.linear.write_to_slice(&mut dy[7..]);
            a.angular.write_to_slice(&mut dy[10..]);
        }
        Ok(())
    }

    /// Quaternions to unit length and, if asked for, positions and velocities onto the
    /// constraints: three steps of Newton in the metric of the masses.
    ///
    /// # Errors
    /// The equations are singular.
    pub fn project(
        &self,
        t: f64,
        y: &mut [f64],
        s: &mut AbsoluteScratch,
    ) -> Result<(), DynamicsError> {
        self.motions(t, y, &mut s.motions)?;
        if self.stabilization == Stabilization::Projection {
            for _ in 0..NEWTON_STEPS {
                self.correct(t, s, |r| r.value)?;
                for i in 0..s.motions.len() {
                    let [x, turn] = step(&s.rhs, i);
                    let m = &mut s.motions[i];
                    m.p += x;
                    m.r *= DMat3::from_quat(DQuat::from_scaled_axis(turn));
                }
            }
            self.correct(t, s, |r| r.rate)?;
            for i in 0..s.motions.len() {
                let [v, w] = step(&s.rhs, i);
                s.motions[i].v += v;
                s.motions[i].w += w;
            }
        }
        self.pack(&s.motions, y);
        Ok(())
    }

    /// The change of least kinetic energy that takes `what` to zero, into `s.rhs`.
    fn correct(
        &self,
        t: f64,
        s: &mut AbsoluteScratch,
        what: impl Fn(&Row) -> f64,
    ) -> Result<(), DynamicsError> {
        self.find_rows(t, s);
        self.put_bodies(s);
        let first = 6 * s.motions.len();
        s.rhs[..first].fill(0.0);
        for (k, (_, r)) in s.rows.iter().enumerate() {
            s.rhs[first + k] = -what(r);
        }
        self.put_constraints(s);
        self.eliminate(t, s)
    }

    /// Constraints of all links for the motions in `s`.
    pub(crate) fn find_rows(&self, t: f64, s: &mut AbsoluteScratch) {
        s.rows.clear();
        s.violation = [0.0; 2];
        for (k, link) in self.mechanism.links().iter().enumerate() {
            s.links[k] = kinematics(link, t, &s.motions);
            s.links[k].rows(|r| s.rows.push((k, r)));
        }
        for (_, r) in &s.rows {
            let worst = &mut s.violation[usize::from(!r.is_length)];
            *worst = worst.max(r.value.abs());
        }
    }

    /// Constraints and the links they belong to, as last found.
    pub(crate) fn rows(s: &AbsoluteScratch) -> &[(usize, Row)] {
        &s.rows
    }

    /// Links as last found.
    pub(crate) fn links(s: &AbsoluteScratch) -> &[LinkKinematics] {
        &s.links
    }

    /// Adds the efforts of springs, dampers, stops and actuators to the loads.
    fn put_efforts(&self, t: f64, s: &mut AbsoluteScratch) {
        for (link, l) in self.mechanism.links().iter().zip(&s.links) {
            let [force, moment] = effort(link, l, t);
            if link.joint.elements.is_empty() {
                continue;
            }
            let child = &s.motions[link.child];
            let (anchor, moment) = (child.r * link.anchor_child, child.r * moment);
            s.loads[link.child] += Wrench {
                force,
                moment: moment + anchor.cross(force),
            };
            if let Some(p) = link.parent {
                let arm = child.p + anchor - s.motions[p].p;
                s.loads[p] += Wrench {
                    force: -force,
                    moment: -moment - arm.cross(force),
                };
            }
        }
    }

    /// Mass matrix and forces of all bodies; clears the matrix.
    fn put_bodies(&self, s: &mut AbsoluteScratch) {
        s.matrix.fill(0.0);
        let (n, gravity) = (s.rhs.len(), self.mechanism.gravity());
        let length = self.mechanism.units().length;
        let total: f64 = self.mechanism.bodies().iter().map(|b| b.mass.mass).sum();
        for (i, body) in self.mechanism.bodies().iter().enumerate() {
            let (m, load) = (&s.motions[i], &s.loads[i]);
            let (mass, first, j) = (body.mass.mass, body.mass.first_moment, body.mass.inertia);
            let lever = -(m.r * tilde(first));
            let at = 6 * i;
            let diagonal = DMat3::from_diagonal(DVec3::splat(mass));
            put(&mut s.matrix, n, at, at, diagonal);
            put(&mut s.matrix, n, at, at + 3, lever);
            put(&mut s.matrix, n, at + 3, at, lever.transpose());
            put(&mut s.matrix, n, at + 3, at + 3, j);
            let spun = m.r * m.w.cross(m.w.cross(first));
            let back = m.r.transpose();
            let force = load.force + mass * gravity - spun;
            let moment = back * load.moment + first.cross(back * gravity) - m.w.cross(j * m.w);
            force.write_to_slice(&mut s.rhs[at..]);
            moment.write_to_slice(&mut s.rhs[at + 3..]);
            let floor = 1e-6 * total;
            let spin = (j.x_axis.x + j.y_axis.y + j.z_axis.z) / 3.0;
            s.scale[at..at + 3].fill(1.0 / mass.max(floor).sqrt());
            s.scale[at + 3..at + 6].fill(1.0 / spin.max(floor * length * length).sqrt());
        }
    }

    /// Jacobian of all constraints, and scales of the multipliers.
    fn put_constraints(&self, s: &mut AbsoluteScratch) {
        let (n, first) = (s.rhs.len(), 6 * s.motions.len());
        for (k, (link, r)) in s.rows.iter().enumerate() {
            let link = &self.mechanism.links()[*link];
            let (at, mut size) = (first + k, 0.0);
            let ends = [(link.parent, &r.parent), (Some(link.child), &r.child)];
            for (body, factors) in ends {
                let Some(body) = body else { continue };
                for (part, v) in factors.iter().enumerate() {
                    for c in 0..3 {
                        let col = 6 * body + 3 * part + c;
                        s.matrix[at * n + col] += v[c];
                        s.matrix[col * n + at] += v[c];
                        size += (v[c] * s.scale[col]).powi(2);
                    }
                }
            }
            s.scale[at] = 1.0 / size.sqrt();
        }
    }

    /// Scales, solves, scales back.
    fn eliminate(&self, t: f64, s: &mut AbsoluteScratch) -> Result<(), DynamicsError> {
        let n = s.rhs.len();
        for (i, row) in s.matrix.chunks_exact_mut(n).enumerate() {
            let si = s.scale[i];
            row.iter_mut()
                .zip(&s.scale)
                .for_each(|(x, sj)| *x *= si * sj);
            s.rhs[i] *= si;
        }
        solve_small(&mut s.matrix, &mut s.rhs).map_err(|e| self.singular(t, e.column, s))?;
        s.rhs.iter_mut().zip(&s.scale).for_each(|(x, s)| *x *= s);
        Ok(())
    }

    /// What a vanishing pivot means.
    fn singular(&self, time: f64, column: usize, s: &AbsoluteScratch) -> DynamicsError {
        let first = 6 * s.motions.len();
        let what = match column.checked_sub(first) {
            Some(k) => format!("joint `{}`", self.mechanism.links()[s.rows[k].0].name),
            None => format!("body `{}`", self.mechanism.bodies()[column / 6].name),
        };
        DynamicsError::SingularMechanism { time, what }
    }

    /// Accelerations and reactions from the solution.
    fn read(&self, t: f64, s: &mut AbsoluteScratch) {
        for i in 0..s.motions.len() {
            let [linear, angular] = step(&s.rhs, i);
            s.accelerations[i] = BodyAcceleration { linear, angular };
        }
        for (k, link) in self.mechanism.links().iter().enumerate() {
            let [force, moment] = effort(link, &s.links[k], t);
            s.reactions[k] = HingeReaction {
                force,
                moment,
                power: 0.0,
            };
        }
        let first = 6 * s.motions.len();
        for (k, (link, r)) in s.rows.iter().enumerate() {
            let (l, at) = (&self.mechanism.links()[*link], s.rhs[first + k]);
            let back = s.motions[l.child].r.transpose();
            let out = &mut s.reactions[*link];
            let force = -at * r.child[0];
            out.force += force;
            out.moment += -at * r.child[1] - l.anchor_child.cross(back * force);
        }
        for (out, l) in s.reactions.iter_mut().zip(&s.links) {
            out.power = l.power(out.force, out.moment);
        }
    }

    /// Kinetic energy, potential energy in the field of gravity, energy stored in springs \[J\].
    pub fn energies(&self, t: f64, motions: &[BodyMotion]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (b, m) in self.mechanism.bodies().iter().zip(motions) {
            sum[0] += kinetic_energy(b, m);
            let moment = b.mass.mass * m.p + m.r * b.mass.first_moment;
            sum[1] -= self.mechanism.gravity().dot(moment);
        }
        for link in self.mechanism.links() {
            let q = kinematics(link, t, motions).coordinates();
            let stored = |e: &crate::Element| e.law.stored(q[e.direction][0]);
            sum[2] += link.joint.elements.iter().map(stored).sum::<f64>();
        }
        sum
    }

    /// Natural sizes of the components of the state.
    pub fn scales(&self) -> Vec<f64> {
        let u = self.mechanism.units();
        let mut one = vec![u.length; 3];
        one.extend([1.0; 4]);
        one.extend([u.length / u.time; 3]);
        one.extend([1.0 / u.time; 3]);
        one.repeat(self.mechanism.bodies().len())
    }
}

/// Steps of Newton's iteration in a projection: a step's drift is small, two reach round-off.
const NEWTON_STEPS: usize = 2;

/// Force (N components) and moment (child components) of all elements on the child at its anchor.
fn effort(link: &Link, l: &LinkKinematics, t: f64) -> [DVec3; 2] {
    let mut sum = [DVec3::ZERO; 2];
    if link.joint.elements.is_empty() {
        return sum;
    }
    let q = l.coordinates();
    for e in &link.joint.elements {
        let [value, rate] = q[e.direction];
        let (size, d) = (e.law.effort(t, value, rate), l.direction(e.direction));
        (0..2).for_each(|k| sum[k] += size * d[k]);
    }
    sum
}

/// The six numbers of body `i`.
fn step(x: &[f64], i: usize) -> [DVec3; 2] {
    [0, 3].map(|part| DVec3::from_slice(&x[6 * i + part..]))
}

fn put(matrix: &mut [f64], n: usize, row: usize, col: usize, block: DMat3) {
    for i in 0..3 {
        let at = (row + i) * n + col;
        block.row(i).write_to_slice(&mut matrix[at..at + 3]);
    }
}

fn link_kinematics(links: &[Link], t: f64, motions: &[BodyMotion]) -> Vec<LinkKinematics> {
    links.iter().map(|l| kinematics(l, t, motions)).collect()
}
