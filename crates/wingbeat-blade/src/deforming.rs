//! Wings that are deformed, or not flat: every strip a rigid section that lies, moves and turns in the wing frame.
//!
//! The loads are those of the flat wing, with the velocity of the section's own point on the feathering axis
//! and the angular velocity of the section itself, `Omega = w + s`, in its own axes; `q = Omega . e2`.
//! A section turns by the twist about axis 2 of the wing frame and then about its own chord, until its span goes
//! along the way between the middles of its sides, which bending lifts: `s = tau' e_2 + theta' e1`. As the wing
//! keeps its places along axis 2, the section is the wider for it; what its added mass gains by growing is left out
//! (second order in the slope). Camber is left to the coefficients.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | e1, e2, n | `axes()` | directions of chord (forward), span and normal of a section, wing components | 1 |
//! | tau | `twist` | turn of a section about axis 2 of the wing frame | rad |
//! | theta | `tilt` | turn of a section about its chord | rad |
//! | s | `spin` | angular velocity of a section in the wing frame, wing components | rad/s |
//! | w | `motion.w` | angular velocity of the wing frame, wing components | rad/s |

use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec2, DVec3, Wrench};

use crate::lag::{Lag, StripWind};
use crate::pair::{PairMotion, StripPair};
use crate::settings::AddedMassModel;
use crate::slowed::slowed_forces;
use crate::strip::{PlacedStrip, Strip};
use crate::wind::LocalWind;
use crate::wing::BladeWing;

/// How a section lies and moves in the wing frame, wing components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionMotion {
    /// The point that is on the feathering axis of the flat wing: place [m], velocity [m/s],
    /// acceleration [m/s2].
    pub axis: [DVec3; 3],
    /// Directions of chord (forward), span and normal \[1\].
    pub turn: DMat3,
    /// Angular velocity \[rad/s\] and its rate \[rad/s2\].
    pub spin: [DVec3; 2],
    /// Its width over that of the strip \[1\].
    pub stretch: f64,
}

impl SectionMotion {
    /// A section of a rigid wing.
    pub fn fixed(placed: &PlacedStrip) -> Self {
        Self {
            axis: [placed.axis, DVec3::ZERO, DVec3::ZERO],
            turn: placed.turn,
            spin: [DVec3::ZERO; 2],
            stretch: 1.0,
        }
    }

    /// A section that is turned from rest by `twist` \[rad\] about axis 2 of the wing frame, and then about its
    /// chord, so that its span goes along the way `across` from its inner to its outer side \[m\]; both with their
    /// first two time derivatives.
    pub fn turned(
        placed: &PlacedStrip,
        axis: [DVec3; 3],
        twist: [f64; 3],
        across: [DVec3; 3],
    ) -> Self {
        let ([tau, t1, t2], rest) = (twist, placed.turn);
        let (sin, cos) = tau.sin_cos();
        let by_twist = |e: DVec3| DVec3::new(cos * e.x + sin * e.z, e.y, cos * e.z - sin * e.x);
        let [e1, g2, g3] = [rest.x_axis, rest.y_axis, rest.z_axis].map(by_twist);
        // Parts of the way along directions that turn by the twist, over the width at rest, with their derivatives.
        let width = placed.strip.width.copysign(across[0].dot(g2));
        let along = |g: DVec3| {
            let (turn, again) = (about_2(g), about_2(about_2(g)));
            let g = [g, t1 * turn, t2 * turn + t1 * t1 * again];
            product(across, g).map(|x| x / width)
        };
        let (run, rise) = (along(g2), along(g3));
        let [tilt, tilt_rate, tilt_acceleration] = angle(rise, run);
        let (sin, cos) = tilt.sin_cos();
        let spin = [
            t1 * DVec3::Y + tilt_rate * e1,
            t2 * DVec3::Y + tilt_acceleration * e1 + tilt_rate * t1 * about_2(e1),
        ];
        Self {
            axis,
            turn: DMat3::from_cols(e1, cos * g2 + sin * g3, cos * g3 - sin * g2),
            spin,
            stretch: rise[0].hypot(run[0]),
        }
    }

    /// Directions of chord (forward), span and normal.
    fn axes(&self) -> [DVec3; 3] {
        [self.turn.x_axis, self.turn.y_axis, self.turn.z_axis]
    }

    /// Place, velocity, acceleration of the point `x` ahead of the axis.
    fn point(&self, x: f64) -> [DVec3; 3] {
        let ([p, p1, p2], [spin, spin_rate]) = (self.axis, self.spin);
        let e1 = self.turn.x_axis;
        let turning = spin.cross(e1);
        [
            p + x * e1,
            p1 + x * turning,
            p2 + x * (spin_rate.cross(e1) + spin.cross(turning)),
        ]
    }

    /// Angular velocity of the section, wing components, in a frame that turns with `rate`.
    fn turning(&self, rate: DVec3) -> DVec3 {
        rate + self.spin[0]
    }
}

/// `e_2 x e`.
fn about_2(e: DVec3) -> DVec3 {
    DVec3::new(e.z, 0.0, -e.x)
}

/// A scalar product with its first two derivatives.
fn product([a, a1, a2]: [DVec3; 3], [b, b1, b2]: [DVec3; 3]) -> [f64; 3] {
    [
        a.dot(b),
        a1.dot(b) + a.dot(b1),
        a2.dot(b) + 2.0 * a1.dot(b1) + a.dot(b2),
    ]
}

/// The angle \[rad\] whose tangent is `rise` over `run`, with its first two derivatives.
fn angle([a, a1, a2]: [f64; 3], [b, b1, b2]: [f64; 3]) -> [f64; 3] {
    let size = a * a + b * b;
    let rate = (a1 * b - a * b1) / size;
    let growth = 2.0 * (a * a1 + b * b1) / size;
    [a.atan2(b), rate, (a2 * b - a * b2) / size - rate * growth]
}

/// Loads on a wing, and what deforming it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DeformingLoad {
    /// Force and moment about the hinge, wing components.
    pub load: Wrench,
    /// Power needed to deform the wing against this load [W].
    pub power: f64,
}

impl DeformingLoad {
    /// Adds `force` at the axis of a section and the `couple`, wing components, of the width of the strip.
    fn add(&mut self, section: &SectionMotion, force: DVec3, couple: DVec3) {
        let [p, p1, _] = section.axis;
        let [force, couple] = [force, couple].map(|x| section.stretch * x);
        self.load.force += force;
        self.load.moment += couple + p.cross(force);
        self.power -= force.dot(p1) + couple.dot(section.spin[0]);
    }
}

/// Velocity of the air relative to a point and the rate of its components in the turning frame.
struct Through {
    hinge: DVec3,
    hinge_rate: DVec3,
    w: DVec3,
    turn: DVec3,
}

impl BladeWing {
    /// As [`BladeWing::lagging_load`], strip `k` lying and moving like `section(k)`.
    pub fn deforming_velocity_load(
        &self,
        motion: &BodyMotion,
        section: impl Fn(usize) -> SectionMotion,
        wind: impl LocalWind,
        mut lag: Option<Lag<'_>>,
    ) -> DeformingLoad {
        let v = self.velocity_through_air(motion);
        let last = self.strips().len().saturating_sub(1);
        // Velocities along chord and normal and rate of feathering of a section.
        let moves = |k: usize| {
            let s = section(k.min(last));
            let ([e1, e2, n], [p, p1, _]) = (s.axes(), s.axis);
            let here = v - wind.velocity(p) + motion.w.cross(p) + p1;
            [here.dot(e1), here.dot(n), s.turning(motion.w).dot(e2)]
        };
        let pair_moves = |k: usize, _: &StripPair| {
            let (a, b) = (moves(2 * k), moves(2 * k + 1));
            let [u, w, q] = [0, 1, 2].map(|i| DVec2::new(a[i], b[i]));
            PairMotion { u, w, q }
        };
        let gust = |k: usize, front: f64| {
            let (s, strip) = (section(k), &self.strips()[k]);
            let [e1, _, n] = s.axes();
            let ahead = 0.5 * strip.chord * front;
            let at = |x: f64| motion.r * wind.velocity(s.axis[0] + x * e1);
            StripWind {
                at_axis: wind.velocity(s.axis[0]).dot(n),
                at_front: at(strip.x_mid() + ahead),
                at_rear: at(strip.x_mid() - ahead),
                at_once: motion.r * wind.at_once()[0],
                normal: motion.r * n,
            }
        };
        let mut slowed = self.slowed(lag.as_mut(), &gust);
        let mut sum = DeformingLoad::default();
        let (pairs, settings) = (self.pairs(), self.settings());
        slowed_forces(pairs, settings, slowed.as_mut(), pair_moves, |k, _, f| {
            for lane in 0..2.min(self.strips().len() - 2 * k) {
                let s = section(2 * k + lane);
                let [e1, e2, n] = s.axes();
                let force = f.along[lane] * e1 + f.normal[lane] * n;
                sum.add(&s, force, f.about[lane] * e2);
            }
        });
        self.add_turning(motion, section, |p| v - wind.velocity(p), &mut sum);
        sum
    }

    /// The part of the added mass that follows from velocities alone; `through(p)` is the velocity
    /// of the hinge through the air that is at `p`.
    fn add_turning(
        &self,
        motion: &BodyMotion,
        section: impl Fn(usize) -> SectionMotion,
        through: impl Fn(DVec3) -> DVec3,
        sum: &mut DeformingLoad,
    ) {
        let add = match self.added_by_velocities() {
            AddedMassModel::None | AddedMassModel::Normal => return,
            AddedMassModel::Section => Self::add_chordwise,
            AddedMassModel::Impulse => Self::add_turning_strip,
        };
        for (k, strip) in self.strips().iter().enumerate() {
            let s = section(k);
            let middle = s.point(strip.x_mid())[0];
            add(self, strip, &s, motion, through(middle), sum);
        }
    }

    /// As [`BladeWing::acceleration_load`], strip `k` lying and moving like `section(k)`; its own
    /// accelerations and the rate of the wind at mid chord are included.
    pub fn deforming_acceleration_load(
        &self,
        motion: &BodyMotion,
        acc: &BodyAcceleration,
        section: impl Fn(usize) -> SectionMotion,
        wind: impl LocalWind,
    ) -> DeformingLoad {
        let mut sum = DeformingLoad::default();
        if self.settings().added_mass == AddedMassModel::None {
            return sum;
        }
        let hinge = self.velocity_through_air(motion);
        let linear = motion.r.transpose() * acc.linear;
        for (k, strip) in self.strips().iter().enumerate() {
            let s = section(k);
            let ([_, e2, n], x) = (s.axes(), strip.x_mid());
            let [p, p1, p2] = s.point(x);
            let moved = hinge + motion.w.cross(p) + p1;
            let blows = self.wind_rate(&wind, p, moved);
            let hinge = hinge - wind.velocity(p);
            let through = Through {
                hinge,
                hinge_rate: linear - motion.w.cross(hinge) - blows,
                w: motion.w,
                turn: acc.angular,
            };
            let v = through.hinge + through.w.cross(p) + p1;
            let v_rate = through.hinge_rate + through.turn.cross(p) + through.w.cross(p1) + p2;
            // Rate of v . n; the section turns the normal.
            let [spin, spin_rate] = s.spin;
            let rate = v_rate.dot(n) + v.dot(spin.cross(n));
            let force = -strip.added_mass(self.settings().density) * rate;
            let inertia = match self.settings().added_mass.is_kirchhoff() {
                true => strip.added_inertia(self.settings().density),
                false => 0.0,
            };
            // Rate of Omega . e2, likewise.
            let carried = s.turning(through.w).dot(spin.cross(e2));
            let turn = (through.turn + spin_rate).dot(e2) + carried;
            sum.add(&s, force * n, (-x * force - inertia * turn) * e2);
        }
        sum
    }

    /// As [`Self::acceleration_load`] in `wind`, of which each strip sees velocity and rate at its mid chord.
    pub fn acceleration_load_in(
        &self,
        motion: &BodyMotion,
        acc: &BodyAcceleration,
        wind: impl LocalWind,
    ) -> Wrench {
        match wind.is_calm() {
            true => self.acceleration_load(motion, acc),
            false => {
                self.deforming_acceleration_load(motion, acc, |k| self.flat(k), wind)
                    .load
            }
        }
    }

    /// The part of the added mass of a flat wing that follows from velocities alone, strip by strip in the wind
    /// at each: `through(p)` is the velocity of the hinge through the air that is at `p`, wing components.
    pub(crate) fn turning_load_in(
        &self,
        motion: &BodyMotion,
        through: impl Fn(DVec3) -> DVec3,
    ) -> Wrench {
        let mut sum = DeformingLoad::default();
        self.add_turning(motion, |k| self.flat(k), through, &mut sum);
        sum.load
    }

    /// Strip `k` of the flat wing.
    fn flat(&self, k: usize) -> SectionMotion {
        let strip = self.strips()[k];
        SectionMotion::fixed(&PlacedStrip {
            strip,
            axis: DVec3::new(0.0, strip.y, 0.0),
            turn: DMat3::IDENTITY,
        })
    }

    /// Force `-m q w` along the chord at mid chord.
    fn add_chordwise(
        &self,
        strip: &Strip,
        s: &SectionMotion,
        motion: &BodyMotion,
        v: DVec3,
        sum: &mut DeformingLoad,
    ) {
        let ([e1, e2, n], [p, p1, _]) = (s.axes(), s.point(strip.x_mid()));
        let normal = (v + motion.w.cross(p) + p1).dot(n);
        let q = s.turning(motion.w).dot(e2);
        let mass = strip.added_mass(self.settings().density);
        sum.add(s, -mass * q * normal * e1, DVec3::ZERO);
    }

    /// What changes the impulse `m w n` of the air at mid chord, and the angular momentum `J q` about
    /// the span, while w and q stay: force `-m w n'`, couple `-v x m w n - J q (w x e2)`, but for its part
    /// about the span (as for a wing that is not deformed).
    fn add_turning_strip(
        &self,
        strip: &Strip,
        s: &SectionMotion,
        motion: &BodyMotion,
        v: DVec3,
        sum: &mut DeformingLoad,
    ) {
        let ([e1, e2, n], [p, p1, _]) = (s.axes(), s.point(strip.x_mid()));
        let (w, rho) = (motion.w, self.settings().density);
        let (here, turning) = (v + w.cross(p) + p1, s.turning(w));
        let impulse = strip.added_mass(rho) * here.dot(n);
        let mut normal_rate = turning.cross(n);
        if self.has_suction() {
            normal_rate -= turning.dot(e2) * e1;
        }
        let force = -impulse * normal_rate;
        let spin = strip.added_inertia(rho) * turning.dot(e2);
        let munk = here.cross(n);
        let couple = -impulse * (munk - munk.dot(e2) * e2) - spin * turning.cross(e2);
        let moment = couple + (p - s.axis[0]).cross(force);
        sum.add(s, force, moment);
    }
}
