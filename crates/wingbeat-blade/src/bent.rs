//! Wings that loads bend: every strip a section through the nodes of two columns of the wing's mesh.
//!
//! Three weighted sums of the nodes say how a section lies: its place `p = sum a r`, its chord `d = sum b r`
//! (forward, of length one at rest, and along the chord of the strip also where lines of nodes are not), and what lies
//! between its two sides, `s = sum g r`. Chord, normal and span of the section follow, with their velocities and accelerations; the loads are those of the flat wing in
//! these axes, and go back to the nodes by the same weights: force, moment and power are the same on both
//! sides. Of what a section does beside moving as a flat one, camber, they know nothing.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | e1, e2, n | `e` | directions of chord (forward), span and normal of a section, wing components | 1 |
//! | x | `x` | place along the chord, ahead of the feathering axis | m |
//! | Omega | `turn` | angular velocity of a section, its own components; `Omega_2 = q` | rad/s |

use wingbeat_math::{DMat3, DVec2, DVec3};

use crate::lag::{Lag, StripWind};
use crate::pair::{PairMotion, StripPair};
use crate::settings::AddedMassModel;
use crate::slowed::{front, slowed_forces};
use crate::strip::{PlacedStrip, Strip};
use crate::wind::LocalWind;
use crate::wing::BladeWing;

/// How much a node shares in the place, the chord \[1/m\] and the sides of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
struct NodeWeight {
    node: usize,
    place: f64,
    chord: f64,
    span: f64,
}

/// How far lines of nodes go across the chord over how far they go along it, where that is rounding \[1\].
const ALONG: f64 = 1e-9;

/// A section of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshSection {
    shares: Vec<NodeWeight>,
    /// Place at rest along the chord ahead of the feathering axis, and those of the leading and the trailing
    /// edge \[m\].
    x: f64,
    edges: [f64; 2],
    /// 1 where columns go along axis 2, -1 where against it.
    side: f64,
}

/// Motion of the nodes of a mesh through air without wind, wing components.
#[derive(Clone, Copy, Debug)]
pub struct NodesInMotion<'a> {
    /// Places \[m\].
    pub position: &'a [DVec3],
    /// Velocities through the air \[m/s\].
    pub velocity: &'a [DVec3],
    /// Accelerations \[m/s2\].
    pub acceleration: &'a [DVec3],
}

/// How a section lies and moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionState {
    e: [DVec3; 3],
    /// Length of d \[1\], and components of s along e1 and e2 \[m\].
    d: f64,
    s: [f64; 2],
    /// Place along the chord that velocity and acceleration belong to.
    x: f64,
    v: DVec3,
    a: DVec3,
    /// What the wind at mid chord has more than at the feathering axis.
    beyond: DVec3,
    /// Rates of d.
    chord_rate: DVec3,
    chord_acceleration: DVec3,
    turn: DVec3,
    /// Rate of Omega_2.
    q_rate: f64,
    wind: StripWind,
}

/// What acts on a section, by the sums that say how it lies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Gathered {
    place: DVec3,
    chord: DVec3,
    span: DVec3,
}

impl MeshSection {
    /// Through the nodes `inner` and `outer` of two columns, each from the leading to the trailing edge, of the
    /// mesh `rest` \[m\], wing frame.
    pub fn new(rest: &[DVec3], inner: &[usize], outer: &[usize]) -> Self {
        let rows: Vec<[usize; 2]> = inner.iter().zip(outer).map(|(a, b)| [*a, *b]).collect();
        let last = rows.len() - 1;
        let side = (rest[outer[0]].y - rest[inner[0]].y).signum();
        let edge = |i: usize| rows[i].map(|n| rest[n]);
        let placed = Strip::between(edge(0), edge(last), side);
        let e1 = placed.turn.x_axis;
        let x: Vec<f64> = rows
            .iter()
            .map(|[a, b]| 0.5 * (e1.dot(rest[*a]) + e1.dot(rest[*b])))
            .collect();
        // Of even pressure along the chord each row carries half of the panels beside it.
        let weight = |i: usize| (x[i.saturating_sub(1)] - x[(i + 1).min(last)]) / 2.0;
        let total = x[0] - x[last];
        let mean: f64 = (0..=last).map(|i| weight(i) * x[i]).sum::<f64>() / total;
        let spread: f64 = (0..=last)
            .map(|i| weight(i) * (x[i] - mean).powi(2))
            .sum::<f64>();
        let mut shares = vec![];
        for (i, nodes) in rows.iter().enumerate() {
            let (w, chord) = (weight(i), weight(i) * (x[i] - mean) / spread);
            for (node, sign) in nodes.iter().zip([-1.0, 1.0]) {
                shares.push(NodeWeight {
                    node: *node,
                    place: 0.5 * w / total,
                    chord: 0.5 * chord,
                    span: sign * w / total,
                });
            }
        }
        Self {
            shares,
            x: mean,
            edges: [x[0], x[last]],
            side,
        }
        .along_chord(rest, &placed)
    }

    /// The same with its chord and its edges those of the strip, which lies so at rest: where the lines of nodes are not
    /// along the chord, what they are across it is the way between the sides.
    fn along_chord(mut self, rest: &[DVec3], placed: &PlacedStrip) -> Self {
        let [e1, e2, _] = [0, 1, 2].map(|k| placed.turn.col(k));
        let [_, d, s] = self.sums(rest);
        let across = d.dot(e2) / s.dot(e2);
        if (across * s.length()).abs() < ALONG {
            return self;
        }
        let length = (d - across * s).dot(e1);
        for share in &mut self.shares {
            share.chord = (share.chord - across * share.span) / length;
        }
        let strip = &placed.strip;
        self.edges = [strip.x_leading, strip.x_leading - strip.chord];
        self
    }

    /// The three sums of `of`.
    fn sums(&self, of: &[DVec3]) -> [DVec3; 3] {
        self.shares.iter().fold([DVec3::ZERO; 3], |sum, s| {
            let r = of[s.node];
            [
                sum[0] + s.place * r,
                sum[1] + s.chord * r,
                sum[2] + s.span * r,
            ]
        })
    }

    /// How it lies and moves as a strip of the `wing` where its nodes move like `nodes` in the `wind`;
    /// `rotation` takes wing components to N components.
    pub fn state(
        &self,
        wing: &BladeWing,
        nodes: &NodesInMotion<'_>,
        wind: &impl LocalWind,
        rotation: DMat3,
    ) -> SectionState {
        let [p, chord, s] = self.sums(nodes.position);
        let [v, chord_rate, s_rate] = self.sums(nodes.velocity);
        let [a, chord_acceleration, _] = self.sums(nodes.acceleration);
        let d = chord.length();
        let e1 = chord / d;
        let e2 = self.side * (s - s.dot(e1) * e1).normalize();
        let n = e1.cross(e2);
        let s = [s.dot(e1), s.dot(e2)];
        // A line d that turns: d' = Omega x d; s' n = Omega_1 s_2 - Omega_2 s_1.
        let q = -chord_rate.dot(n) / d;
        let about_1 = (s_rate.dot(n) + q * s[0]) / s[1];
        let normal_rate = q * e1 - about_1 * e2;
        let [leading, trailing] = self.edges;
        let middle = 0.5 * (leading + trailing);
        let back = middle - self.x;
        let blows = wing.wind_rate(wind, p + back * chord, v + back * chord_rate);
        let at_once = rotation * wind.at_once()[0];
        let wind = |x: f64| wind.velocity(p + (x - self.x) * chord);
        let here = wind(0.0);
        let at_axis = v - here - self.x * chord_rate;
        let ahead = front(at_axis.dot(e1), at_axis.dot(n));
        let [at_front, at_rear] = [ahead, -ahead]
            .map(|side| wind(0.5 * (leading + trailing + (leading - trailing) * side)));
        let falls = chord_acceleration.dot(n) + chord_rate.dot(normal_rate);
        SectionState {
            e: [e1, e2, n],
            d,
            s,
            x: self.x,
            v: v - here,
            a: a - blows,
            beyond: wind(middle) - here,
            chord_rate,
            turn: DVec3::new(about_1, q, chord_rate.dot(e2) / d),
            chord_acceleration,
            q_rate: (chord_rate.dot(n) * chord_rate.dot(e1) / d - falls) / d,
            wind: StripWind {
                at_axis: here.dot(n),
                at_front: rotation * at_front,
                at_rear: rotation * at_rear,
                at_once,
                normal: rotation * n,
            },
        }
    }

    /// Adds what acts on the section to the forces on the nodes.
    fn scatter(&self, load: &Gathered, out: &mut [DVec3]) {
        for s in &self.shares {
            out[s.node] += s.place * load.place + s.chord * load.chord + s.span * load.span;
        }
    }
}

impl SectionState {
    /// Velocity through the air of the point `x`.
    fn velocity(&self, x: f64) -> DVec3 {
        self.v + (x - self.x) * self.chord_rate
    }

    /// Velocities along chord and normal of the point on the feathering axis, and rate of feathering.
    fn moves(&self) -> [f64; 3] {
        let v = self.velocity(0.0);
        [v.dot(self.e[0]), v.dot(self.e[2]), self.turn.y]
    }

    /// Rate of the normal: `Omega x n`.
    fn normal_rate(&self) -> DVec3 {
        self.turn.y * self.e[0] - self.turn.x * self.e[1]
    }

    /// Velocity of mid chord, the point `x`, through the air that is there.
    fn at_middle(&self, x: f64) -> DVec3 {
        self.velocity(x) - self.beyond
    }

    /// Rate of the normal velocity of mid chord, the point `x`.
    fn normal_velocity_rate(&self, x: f64) -> f64 {
        let acceleration = self.a + (x - self.x) * self.chord_acceleration;
        acceleration.dot(self.e[2]) + self.at_middle(x).dot(self.normal_rate())
    }
}

impl Gathered {
    /// Adds a force at the point `x` of a section.
    fn add_force(&mut self, s: &SectionState, x: f64, force: DVec3) {
        self.place += force;
        self.chord += (x - s.x) * force;
    }

    /// Adds a couple, components of the section.
    fn add_couple(&mut self, s: &SectionState, c: DVec3) {
        let ([_, e2, n], [s1, s2]) = (s.e, s.s);
        self.chord += (c.z * e2 - (c.y + c.x * s1 / s2) * n) / s.d;
        self.span += c.x / s2 * n;
    }
}

/// How the forces on the nodes of a bent wing answer to the motion of its sections.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionAnswer {
    /// Three ways to move a section: its point on the feathering axis along chord and normal, and feathering.
    /// Of each, node by node: how the velocity of the node shares in it, and its place; wing components \[1,
    /// 1/s, 1/m\].
    pub ways: [Vec<(usize, [DVec3; 2])>; 3],
    /// Derivatives of the forces along these ways by the velocities along them, by rows \[N s/m, N s, N m s\].
    pub velocity: [[f64; 3]; 3],
    /// The same by the accelerations \[kg, kg m, kg m2\].
    pub acceleration: [[f64; 3]; 3],
}

impl BladeWing {
    /// Adds to `out` the forces on the nodes \[N\], wing components, of a wing whose `sections` are in these
    /// `states`: all of [`Self::lagging_load`] and [`Self::acceleration_load`].
    pub fn bent_forces(
        &self,
        sections: &[MeshSection],
        states: &[SectionState],
        mut lag: Option<Lag<'_>>,
        out: &mut [DVec3],
    ) {
        let gust = |k: usize, _: f64| states[k].wind;
        let mut slowed = self.slowed(lag.as_mut(), &gust);
        slowed_forces(
            self.pairs(),
            self.settings(),
            slowed.as_mut(),
            pairs_of(states, [0.0; 3]),
            |k, _, f| {
                for lane in 0..2.min(states.len() - 2 * k) {
                    let (section, s) = (&sections[2 * k + lane], &states[2 * k + lane]);
                    let mut load = Gathered::default();
                    load.add_force(s, 0.0, f.along[lane] * s.e[0] + f.normal[lane] * s.e[2]);
                    load.add_couple(s, DVec3::new(0.0, f.about[lane], 0.0));
                    section.scatter(&load, out);
                }
            },
        );
        if self.has_added_mass() {
            let strips = self.strips().iter().zip(states).zip(sections);
            strips.for_each(|((strip, s), section)| {
                section.scatter(&self.added_load(strip, s), out);
            });
        }
    }

    /// What the added mass of a strip does, as for the flat wing: momentum `m w n` at mid chord, angular
    /// momentum `J q` about the span, and their rates but for Munk's couple.
    fn added_load(&self, strip: &Strip, s: &SectionState) -> Gathered {
        let (law, rho, x) = (
            self.settings().added_mass,
            self.settings().density,
            strip.x_mid(),
        );
        let (mass, v) = (strip.added_mass(rho), s.at_middle(x));
        let impulse = mass * v.dot(s.e[2]);
        let inertia = match law.is_kirchhoff() {
            true => strip.added_inertia(rho),
            false => 0.0,
        };
        let mut force = -mass * s.normal_velocity_rate(x) * s.e[2];
        let mut couple = DVec3::new(0.0, -inertia * s.q_rate, 0.0);
        match self.added_by_velocities() {
            AddedMassModel::None | AddedMassModel::Normal => {}
            AddedMassModel::Section => force -= impulse * s.turn.y * s.e[0],
            AddedMassModel::Impulse => {
                force -= impulse * self.normal_rate_felt(s);
                couple.x -= impulse * v.dot(s.e[1]);
                couple -= inertia * s.turn.y * s.turn.cross(DVec3::Y);
            }
        }
        let mut load = Gathered::default();
        load.add_force(s, x, force);
        load.add_couple(s, couple);
        load
    }

    /// Rate of the normal of a section, without its part along the chord where the strip's suction has that.
    fn normal_rate_felt(&self, s: &SectionState) -> DVec3 {
        match self.has_suction() {
            true => -s.turn.x * s.e[1],
            false => s.normal_rate(),
        }
    }

    /// How the forces on the nodes answer to motions of the sections, section by section into `out`, their
    /// wakes lagging as `lag` says; terms of second order in the rates of turning are left out.
    pub fn bent_answers(
        &self,
        sections: &[MeshSection],
        states: &[SectionState],
        mut lag: Option<Lag<'_>>,
        out: &mut Vec<SectionAnswer>,
    ) {
        out.resize_with(states.len(), SectionAnswer::default);
        self.set_velocity_answers(states, lag.as_mut(), out);
        let all = self.strips().iter().zip(sections).zip(states);
        for (((strip, section), s), answer) in all.zip(out) {
            set_ways(section, s, &mut answer.ways);
            answer.acceleration = [[0.0; 3]; 3];
            if self.has_added_mass() {
                self.add_mass_answer(strip, s, answer);
            }
        }
    }

    /// Derivatives of force along chord and normal and moment at the feathering axis by the three velocities there.
    fn set_velocity_answers(
        &self,
        states: &[SectionState],
        lag: Option<&mut Lag<'_>>,
        out: &mut [SectionAnswer],
    ) {
        let gust = |k: usize, _: f64| states[k].wind;
        let mut slowed = self.slowed(lag, &gust);
        out.iter_mut().for_each(|a| a.velocity = [[0.0; 3]; 3]);
        for way in 0..3 {
            for sign in [1.0, -1.0] {
                let mut changed = [0.0; 3];
                changed[way] = sign * SMALL;
                let motion = pairs_of(states, changed);
                let (pairs, settings) = (self.pairs(), self.settings());
                slowed_forces(pairs, settings, slowed.as_mut(), motion, |k, _, f| {
                    for lane in 0..2.min(states.len() - 2 * k) {
                        let j = 2 * k + lane;
                        let step = 2.0 * SMALL * states[j].sizes()[way];
                        let loads = [f.along[lane], f.normal[lane], f.about[lane]];
                        for (row, load) in out[j].velocity.iter_mut().zip(loads) {
                            row[way] += sign * load / step;
                        }
                    }
                });
            }
        }
    }

    /// Adds the added mass of a strip: `-m (w' n)` at mid chord, in which `w' = .. + u q`, and `-J q'`.
    fn add_mass_answer(&self, strip: &Strip, s: &SectionState, to: &mut SectionAnswer) {
        let (rho, x) = (self.settings().density, strip.x_mid() * s.d);
        let mass = strip.added_mass(rho);
        let inertia = match self.settings().added_mass.is_kirchhoff() {
            true => strip.added_inertia(rho),
            false => 0.0,
        };
        let [u, _, q] = s.moves();
        let by_rate = [0.0, 1.0, -x];
        let by_velocity = [q, 0.0, u];
        for (row, lever) in [(1, 1.0), (2, -x)] {
            for way in 0..3 {
                to.acceleration[row][way] -= mass * lever * by_rate[way];
                to.velocity[row][way] -= mass * lever * by_velocity[way];
            }
        }
        to.acceleration[2][2] -= inertia;
    }
}

/// Steps of differences over the sizes of velocities \[1\]: half of the digits.
const SMALL: f64 = 1e-6;

impl SectionState {
    /// Sizes of velocities along the three ways; never zero.
    fn sizes(&self) -> [f64; 3] {
        let speed = self.velocity(0.0).length().max(1e-3);
        [speed, speed, speed / self.s[1].abs()]
    }
}

/// The motion of pairs of sections, changed by parts of the sizes of their velocities.
fn pairs_of(
    states: &[SectionState],
    changed: [f64; 3],
) -> impl Fn(usize, &StripPair) -> PairMotion + '_ {
    let last = states.len().saturating_sub(1);
    let is_changed = changed != [0.0; 3];
    move |k, _| {
        let moves = |k: usize| {
            let s = &states[k.min(last)];
            let mut moves = s.moves();
            if is_changed {
                let parts = changed.iter().zip(s.sizes());
                moves
                    .iter_mut()
                    .zip(parts)
                    .for_each(|(m, (c, size))| *m += c * size);
            }
            moves
        };
        let (a, b): ([f64; 3], [f64; 3]) = (moves(2 * k), moves(2 * k + 1));
        let [u, w, q] = [0, 1, 2].map(|i| DVec2::new(a[i], b[i]));
        PairMotion { u, w, q }
    }
}

/// Fills the three ways to move a section, by its nodes.
fn set_ways(section: &MeshSection, s: &SectionState, out: &mut [Vec<(usize, [DVec3; 2])>; 3]) {
    let ([e1, _, n], [u, w, _]) = (s.e, s.moves());
    out.iter_mut().for_each(Vec::clear);
    for share in &section.shares {
        let (here, chord) = (share.place - s.x * share.chord, share.chord / s.d);
        // A chord that sinks by its change along n turns chord and normal.
        let by = [
            [here * e1, w * chord * n],
            [here * n, -u * chord * n],
            [-chord * n, DVec3::ZERO],
        ];
        (out.iter_mut().zip(by)).for_each(|(way, by)| way.push((share.node, by)));
    }
}
