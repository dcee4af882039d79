//! The bodies as seen from the root: a function of time and of the free joint coordinates.

use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, MovingRotation, tilde, trace};

use crate::cycle::Cycle;
use crate::system::check::check_rotation;
use crate::system::placement::Placement;
use crate::system::placement::carry;
use crate::system::shape::ShapeMass;
use crate::{DynamicsError, System};

/// Mass properties of the whole system and the momentum of its parts relative to the root.
#[derive(Clone, Copy, Debug, Default)]
pub struct Composite {
    /// Total mass m \[kg\].
    pub mass: f64,
    /// Mass centre c \[m\], root components.
    pub c: DVec3,
    /// Velocity of the mass centre as seen from the root, root components [m/s].
    pub c_dot: DVec3,
    /// Inertia about the mass centre [kg m2], root components.
    pub inertia: DMat3,
    /// Angular momentum about the mass centre of the motion seen from the root, root components [kg m2/s].
    pub h: DVec3,
}

/// What a [`Composite`] changes at, free joints moving at the speeds they have.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CompositeRates {
    /// Acceleration of the mass centre as seen from the root, root components [m/s2].
    pub c_ddot: DVec3,
    /// Rate of the inertia about the mass centre [kg m2/s].
    pub inertia: DMat3,
    /// Rate of the relative angular momentum, root components [kg m2/s2].
    pub h: DVec3,
}

/// Placements of all bodies at one time.
#[derive(Clone, Debug)]
pub struct Configuration {
    placements: Vec<Placement>,
}

impl Configuration {
    /// Room for the placements of `system`.
    pub fn new(system: &System) -> Self {
        Self {
            placements: vec![Placement::ROOT; system.bodies().len()],
        }
    }

    /// Evaluates the hinge laws at time `t` \[s\]; free joints are held at their start.
    pub fn update(&mut self, system: &System, t: f64) {
        if system.coordinates() == 0 {
            self.update_free(system, t, (&[], &[]));
        } else {
            let (q, u) = system.start();
            self.update_free(system, t, (&q, &u));
        }
    }

    /// Evaluates the hinge laws at time `t` \[s\] for the free coordinates and speeds `free`.
    pub fn update_free(&mut self, system: &System, t: f64, free: (&[f64], &[f64])) {
        self.place(system, t, free, |k| system.hinges()[k].rotation(t));
    }

    /// As [`Self::update_free`], hinge `k` turned by `law(k)`.
    fn place(
        &mut self,
        system: &System,
        t: f64,
        free: (&[f64], &[f64]),
        law: impl Fn(usize) -> MovingRotation,
    ) {
        for &k in system.outward() {
            let (h, joint, offsets) = (
                &system.hinges()[k],
                &system.hinges()[k].model,
                &system.offsets()[k],
            );
            let mut travel = [h.anchor_parent, DVec3::ZERO, DVec3::ZERO];
            if let Some(law) = &joint.travel {
                let moved = law.at(t);
                (0..3).for_each(|i| travel[i] += moved[i]);
            }
            let frame = self.placements[h.tree_parent()]
                .slid(travel)
                .turned(&law(k));
            let (q, u) = (&free.0[offsets.q..], &free.1[offsets.u..]);
            let (q, u) = (&q[..offsets.coordinates], &u[..offsets.speeds]);
            let child = carry(joint.kind, frame, q, u, None);
            self.placements[h.child] = child.shifted(-h.anchor_child);
        }
    }

    /// Placement of every body, to change.
    pub(crate) fn placements_mut(&mut self) -> &mut [Placement] {
        &mut self.placements
    }

    /// Placement of every body.
    pub fn placements(&self) -> &[Placement] {
        &self.placements
    }

    /// Motion of every body when the root moves like `root`.
    pub fn motions(&self, root: &BodyMotion, out: &mut [BodyMotion]) {
        for (m, at) in out.iter_mut().zip(&self.placements) {
            *m = BodyMotion {
                p: root.p + root.r * at.d,
                r: root.r * at.c,
                v: root.v + root.r * (root.w.cross(at.d) + at.d_dot),
                w: at.c.transpose() * root.w + at.w,
            };
        }
    }

    /// Accelerations of every body when the root moves like `root` and accelerates like `acc`
    /// (transport, Coriolis and relative part).
    pub fn accelerations(
        &self,
        root: &BodyMotion,
        acc: &BodyAcceleration,
        out: &mut [BodyAcceleration],
    ) {
        let w = root.w;
        for (o, at) in out.iter_mut().zip(&self.placements) {
            let back = at.c.transpose();
            *o = BodyAcceleration {
                linear: acc.linear
                    + root.r
                        * (acc.angular.cross(at.d)
                            + w.cross(w.cross(at.d))
                            + 2.0 * w.cross(at.d_dot)
                            + at.d_ddot),
                angular: back * acc.angular - at.w.cross(back * w) + at.w_dot,
            };
        }
    }

    /// Mass properties of the whole and momentum relative to the root.
    pub fn composite(&self, system: &System) -> Composite {
        self.composite_of(system, &[])
    }

    /// The same with bodies that have changed their shapes.
    pub(crate) fn composite_of(&self, system: &System, shapes: &[ShapeMass]) -> Composite {
        let (mut mass, mut s, mut s_dot) = (0.0, DVec3::ZERO, DVec3::ZERO);
        let (mut inertia, mut h) = (DMat3::ZERO, DVec3::ZERO);
        for (b, at) in system.bodies().iter().zip(&self.placements) {
            let (m, j) = (b.mass.mass, at.c * b.mass.inertia * at.c.transpose());
            let (first, spin) = (at.c * b.mass.first_moment, at.c * at.w);
            let spun = spin.cross(first);
            mass += m;
            s += first + m * at.d;
            s_dot += m * at.d_dot + spun;
            inertia += j + steiner(m, first, at.d);
            h += (first + m * at.d).cross(at.d_dot) + at.d.cross(spun) + j * spin;
        }
        for x in shapes {
            let at = &self.placements[x.body];
            let j = at.c * x.inertia * at.c.transpose();
            let (first, spin) = (at.c * x.first_moment, at.c * at.w);
            let flow = spin.cross(first) + at.c * x.momentum;
            s += first;
            s_dot += flow;
            inertia += j + steiner(0.0, first, at.d);
            h += first.cross(at.d_dot) + at.d.cross(flow) + j * spin + at.c * x.angular_momentum;
        }
        let (c, c_dot) = (s / mass, s_dot / mass);
        let about_centre = inertia - steiner(mass, DVec3::ZERO, c);
        // What is left of a point mass is round-off.
        let is_point = trace(about_centre) < 1e-14 * trace(inertia);
        Composite {
            mass,
            c,
            c_dot,
            inertia: if is_point { DMat3::ZERO } else { about_centre },
            h: h - mass * c.cross(c_dot),
        }
    }

    /// Rates of the mass properties `whole` of this configuration.
    pub(crate) fn composite_rates(&self, system: &System, whole: &Composite) -> CompositeRates {
        let (mut s_ddot, mut inertia, mut h) = (DVec3::ZERO, DMat3::ZERO, DVec3::ZERO);
        for (b, at) in system.bodies().iter().zip(&self.placements) {
            let (m, j) = (b.mass.mass, at.c * b.mass.inertia * at.c.transpose());
            let (first, w, w_dot) = (at.c * b.mass.first_moment, at.c * at.w, at.c * at.w_dot);
            let spun = w.cross(first);
            let turned = w_dot.cross(first) + w.cross(spun);
            s_ddot += m * at.d_ddot + turned;
            let turn = tilde(w) * j;
            inertia += turn + turn.transpose();
            inertia += symmetric(spun, at.d) + symmetric(first + m * at.d, at.d_dot);
            h += (first + m * at.d).cross(at.d_ddot) + at.d.cross(turned);
            h += j * w_dot + w.cross(j * w);
        }
        let c_ddot = s_ddot / whole.mass;
        CompositeRates {
            c_ddot,
            inertia: inertia - symmetric(whole.mass * whole.c, whole.c_dot),
            h: h - whole.mass * whole.c.cross(c_ddot),
        }
    }

    /// Checks that every hinge law gives a rotation at time `t`.
    ///
    /// # Errors
    /// [`DynamicsError::NotARotation`] names the first hinge that does not.
    pub fn check(system: &System, t: f64) -> Result<(), DynamicsError> {
        system.hinges().iter().try_for_each(|h| {
            check_rotation(h.rotation(t).c, t, || {
                format!("the law of hinge `{}`", h.name)
            })
        })
    }
}

/// What depends on time alone, at equal steps from time zero: rotations of the hinge laws and,
/// where no joint is free, the configuration. Evaluations at these times read it off.
#[derive(Clone, Debug)]
pub struct ConfigurationTable {
    step: f64,
    entries: Vec<Entry>,
    cycle: Option<Cycle>,
}

#[derive(Clone, Debug)]
struct Entry {
    laws: Vec<MovingRotation>,
    configuration: Configuration,
    whole: (Composite, CompositeRates),
}

impl ConfigurationTable {
    /// The laws of `system` at the times 0, `step`, ..., `count step` \[s\].
    pub fn new(system: &System, step: f64, count: usize) -> Self {
        let (q, u) = system.start();
        let entry = |k: usize| {
            let t = k as f64 * step;
            let laws: Vec<MovingRotation> = system.hinges().iter().map(|h| h.rotation(t)).collect();
            let mut configuration = Configuration::new(system);
            configuration.place(system, t, (&q, &u), |k| laws[k]);
            Entry {
                whole: configuration.whole(system),
                laws,
                configuration,
            }
        };
        let entries = (0..=count).map(entry).collect();
        Self {
            step,
            entries,
            cycle: None,
        }
    }

    /// The laws of `system` at all multiples of `step` \[s\]: they go through `cycle` in such steps
    /// ([`System::cycle`]).
    pub fn repeating(system: &System, step: f64, cycle: Cycle) -> Self {
        Self {
            cycle: Some(cycle),
            ..Self::new(system, step, cycle.last())
        }
    }

    /// Configuration and whole at step number `k`, free joints at their start.
    pub fn configuration(&self, k: usize) -> (&Configuration, &Composite) {
        let entry = &self.entries[k];
        (&entry.configuration, &entry.whole.0)
    }

    /// The entry of time `t`, to the last bits of a sum of steps.
    fn at(&self, t: f64) -> Option<&Entry> {
        let k = (t / self.step).round();
        let same = (t - k * self.step).abs() <= 8.0 * f64::EPSILON * t.abs().max(self.step);
        let entry = self
            .cycle
            .map_or(k as usize, |cycle| cycle.fold(k as usize));
        self.entries.get(entry).filter(|_| same && k >= 0.0)
    }
}

impl Configuration {
    /// The configuration at time `t` \[s\] and its whole; `table` spares the laws where it has them.
    pub(crate) fn lay(
        &mut self,
        system: &System,
        t: f64,
        free: (&[f64], &[f64]),
        table: Option<&ConfigurationTable>,
    ) -> (Composite, CompositeRates) {
        match table.and_then(|table| table.at(t)) {
            Some(known) if system.coordinates() == 0 => {
                self.placements
                    .copy_from_slice(&known.configuration.placements);
                return known.whole;
            }
            Some(known) => self.place(system, t, free, |k| known.laws[k]),
            None => self.update_free(system, t, free),
        }
        self.whole(system)
    }

    /// Mass properties of the whole, and their rates where no joint is free: who has free joints
    /// asks for accelerations one by one.
    fn whole(&self, system: &System) -> (Composite, CompositeRates) {
        let whole = self.composite(system);
        let rates = match system.coordinates() {
            0 => self.composite_rates(system, &whole),
            _ => CompositeRates::default(),
        };
        (whole, rates)
    }
}

/// `2 s.d I - s d^T - d s^T`.
fn symmetric(s: DVec3, d: DVec3) -> DMat3 {
    let trace = 2.0 * s.dot(d);
    let col = |k: usize| trace * DVec3::AXES[k] - s * d[k] - d * s[k];
    DMat3::from_cols(col(0), col(1), col(2))
}

/// Change of the inertia about the origin when a body of mass `m` \[kg\] and first moment `s`
/// [kg m] moves by `d` \[m\]: `(2 s.d + m d.d) I - s d^T - d s^T - m d d^T`.
fn steiner(m: f64, s: DVec3, d: DVec3) -> DMat3 {
    let e = s + m * d;
    let trace = s.dot(d) + d.dot(e);
    // Column k of s d^T + d e^T, symmetric because s d^T + d s^T is.
    let col = |k: usize| trace * DVec3::AXES[k] - s * d[k] - d * e[k];
    DMat3::from_cols(col(0), col(1), col(2))
}
