//! Wings that loads bend, against wings that do not and wings whose twist is prescribed.

use super::{RHO, motions};
use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench, r1, r2};

const ROWS: usize = 3;
const COLS: usize = 7;

/// A swept, tapered mesh with its strips and sections.
struct Bent {
    nodes: Vec<DVec3>,
    wing: BladeWing,
    sections: Vec<MeshSection>,
}

fn bent(added_mass: AddedMassModel, side: f64) -> Bent {
    turned(added_mass, side, DMat3::IDENTITY)
}

/// The same with its mesh turned about the hinge.
fn turned(added_mass: AddedMassModel, side: f64, turn: DMat3) -> Bent {
    let y = |j: usize| 0.1 + 0.2 * j as f64;
    let lead = |y: f64| 0.075 - 0.03 * y * y;
    let chord = |y: f64| 0.3 - 0.1 * y;
    let node = |k: usize| {
        let (i, y) = (k / (COLS + 1), y(k % (COLS + 1)));
        turn * DVec3::new(lead(y) - chord(y) * i as f64 / ROWS as f64, side * y, 0.0)
    };
    let nodes: Vec<DVec3> = (0..(ROWS + 1) * (COLS + 1)).map(node).collect();
    let strip = |j: usize| {
        let mean = |of: &dyn Fn(f64) -> f64| 0.5 * (of(y(j)) + of(y(j + 1)));
        Strip {
            y: side * mean(&|y| y),
            x_leading: mean(&lead),
            chord: mean(&chord),
            width: y(j + 1) - y(j),
        }
    };
    let column = |j: usize| -> Vec<usize> { (0..=ROWS).map(|i| i * (COLS + 1) + j).collect() };
    let sections = (0..COLS).map(|j| MeshSection::new(&nodes, &column(j), &column(j + 1)));
    let settings = BladeSettings {
        added_mass,
        ..BladeSettings::insect(RHO)
    };
    Bent {
        sections: sections.collect(),
        wing: BladeWing::new((0..COLS).map(strip).collect(), settings).unwrap(),
        nodes,
    }
}

/// A mesh whose lines of nodes are not along the chord, with the strips of the flat wing.
fn skewed(added_mass: AddedMassModel, side: f64) -> Bent {
    let node = |k: usize| {
        let (i, j) = (k / (COLS + 1), (k % (COLS + 1)) as f64);
        let s = i as f64 / ROWS as f64;
        let aslant = (0.15 - 0.04 * j) * s;
        DVec3::new(
            0.075 - 0.05 * j - (0.3 - 0.02 * j) * s,
            side * (0.1 + 0.2 * j + aslant),
            0.0,
        )
    };
    let nodes: Vec<DVec3> = (0..(ROWS + 1) * (COLS + 1)).map(node).collect();
    let line = |i: usize, j: usize| [0, 1].map(|k| nodes[i * (COLS + 1) + j + k]);
    let strip = |j: usize| Strip::between(line(0, j), line(ROWS, j), side).strip;
    let column = |j: usize| -> Vec<usize> { (0..=ROWS).map(|i| i * (COLS + 1) + j).collect() };
    let sections = (0..COLS).map(|j| MeshSection::new(&nodes, &column(j), &column(j + 1)));
    let settings = BladeSettings {
        added_mass,
        ..BladeSettings::insect(RHO)
    };
    Bent {
        sections: sections.collect(),
        wing: BladeWing::new((0..COLS).map(strip).collect(), settings).unwrap(),
        nodes,
    }
}

const LAWS: [AddedMassModel; 4] = [
    AddedMassModel::None,
    AddedMassModel::Impulse,
    AddedMassModel::Normal,
    AddedMassModel::Section,
];

impl Bent {
    /// Forces on the nodes that lie at `r` and move like `v` and `a`.
    fn forces(&self, r: &[DVec3], v: &[DVec3], a: &[DVec3]) -> Vec<DVec3> {
        let moving = NodesInMotion {
            position: r,
            velocity: v,
            acceleration: a,
        };
        let states: Vec<SectionState> = (self.sections.iter())
            .map(|s| s.state(&self.wing, &moving, &Calm, DMat3::IDENTITY))
            .collect();
        let mut out = vec![DVec3::ZERO; r.len()];
        self.wing
            .bent_forces(&self.sections, &states, None, &mut out);
        out
    }
}

/// Force and moment about the hinge.
fn sum(r: &[DVec3], forces: &[DVec3]) -> Wrench {
    Wrench {
        force: forces.iter().sum(),
        moment: r.iter().zip(forces).map(|(r, f)| r.cross(*f)).sum(),
    }
}

fn assert_same(a: &Wrench, b: &Wrench, size: f64) {
    let apart = (a.force - b.force).length() + (a.moment - b.moment).length();
    assert!(apart < 1e-12 * size, "{apart:e} of {size}: {a:?} {b:?}");
}

/// Some acceleration that goes with a motion.
fn acceleration(m: &BodyMotion) -> BodyAcceleration {
    BodyAcceleration {
        linear: 3.0 * m.v.cross(DVec3::new(1.0, -2.0, 0.5)),
        angular: 2.0 * m.w.cross(DVec3::new(0.3, 1.0, -1.0)) + m.w,
    }
}

#[test]
fn exact_nodes_that_move_as_a_rigid_wing_carry_its_loads() {
    let turns = [DMat3::IDENTITY, r2(0.4), r1(0.5), r1(-0.3) * r2(0.2)];
    let wings = LAWS.iter().flat_map(|l| [(*l, 1.0), (*l, -1.0)]);
    for (q, (law, side)) in turns
        .iter()
        .flat_map(|q| wings.clone().map(move |w| (*q, w)))
    {
        carries_rigid_loads(&turned(law, side, q), q);
    }
}

#[test]
fn exact_nodes_in_skewed_lines_that_move_as_a_rigid_wing_carry_its_loads() {
    for (law, side) in LAWS.iter().flat_map(|l| [(*l, 1.0), (*l, -1.0)]) {
        carries_rigid_loads(&skewed(law, side), DMat3::IDENTITY);
    }
}

/// Compares the loads of a wing turned by `q` whose nodes move as a rigid body with those of its strips.
fn carries_rigid_loads(bent: &Bent, q: DMat3) {
    for m in motions() {
        let acc = acceleration(&m);
        let back = m.r.transpose();
        let (v0, a0) = (back * m.v, back * acc.linear);
        let v = |r: &DVec3| v0 + m.w.cross(*r);
        let a = |r: &DVec3| a0 + acc.angular.cross(*r) + m.w.cross(m.w.cross(*r));
        let moving: [Vec<DVec3>; 2] = [
            bent.nodes.iter().map(v).collect(),
            bent.nodes.iter().map(a).collect(),
        ];
        let forces = bent.forces(&bent.nodes, &moving[0], &moving[1]);
        let own = BodyMotion {
            r: m.r * q,
            w: q.transpose() * m.w,
            ..m
        };
        let own_acc = BodyAcceleration {
            angular: q.transpose() * acc.angular,
            ..acc
        };
        let flat = bent.wing.load(&own, &own_acc);
        let rigid = Wrench {
            force: q * flat.force,
            moment: q * flat.moment,
        };
        let size: f64 = forces.iter().map(|f| f.length()).sum();
        assert_same(&sum(&bent.nodes, &forces), &rigid, size);
    }
}

#[test]
fn agrees_with_sections_whose_twist_is_prescribed_in_force_moment_and_power() {
    // All sections twist and move alike on a plane that rises along the span, so that two columns lie in line with
    // the section between them.
    let (tau, moved) = (
        [0.4, 3.0, -7.0],
        [
            DVec3::new(0.01, 0.0, 0.05),
            DVec3::new(0.3, 0.0, -0.8),
            DVec3::new(2.0, 0.0, 5.0),
        ],
    );
    let cases = LAWS.iter().flat_map(|l| [(*l, 1.0), (*l, -1.0)]);
    let slopes = [[0.0; 3], [0.25, -1.1, 6.0]];
    for ((law, side), slope) in cases.flat_map(|c| slopes.map(|s| (c, s))) {
        let bent = bent(law, side);
        let (sin, cos) = f64::sin_cos(tau[0]);
        let rise = |y: f64| slope.map(|s| DVec3::new(0.0, 0.0, s * y));
        let (e1, n) = (DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos));
        let place = |r: &DVec3| moved[0] + DVec3::new(0.0, r.y, 0.0) + rise(r.y)[0] + r.x * e1;
        let speed = |r: &DVec3| moved[1] + rise(r.y)[1] - r.x * tau[1] * n;
        let bend = |r: &DVec3| moved[2] + rise(r.y)[2] - r.x * (tau[2] * n + tau[1] * tau[1] * e1);
        let r: Vec<DVec3> = bent.nodes.iter().map(place).collect();
        let u: Vec<DVec3> = bent.nodes.iter().map(speed).collect();
        let section = |k: usize| {
            let y = bent.wing.strips()[k].y;
            let [rise, rise_rate, rise_acceleration] = rise(y);
            let axis = [
                moved[0] + DVec3::new(0.0, y, 0.0) + rise,
                moved[1] + rise_rate,
                moved[2] + rise_acceleration,
            ];
            let strip = bent.wing.strips()[k];
            let placed = PlacedStrip {
                strip,
                axis: DVec3::ZERO,
                turn: DMat3::IDENTITY,
            };
            let across = [1.0, 0.0, 0.0];
            let across = [0, 1, 2].map(|i| strip.width * DVec3::new(0.0, across[i], slope[i]));
            // Strips of a wing that loads bend keep their area.
            SectionMotion {
                stretch: 1.0,
                ..SectionMotion::turned(&placed, axis, tau, across)
            }
        };
        for m in motions() {
            let acc = acceleration(&m);
            let (back, w) = (m.r.transpose(), m.w);
            let velocity = |(r, u): (&DVec3, &DVec3)| back * m.v + w.cross(*r) + *u;
            let v: Vec<DVec3> = r.iter().zip(&u).map(velocity).collect();
            let a: Vec<DVec3> = (0..r.len())
                .map(|k| {
                    let turning = acc.angular.cross(r[k]) + w.cross(w.cross(r[k]) + 2.0 * u[k]);
                    back * acc.linear + turning + bend(&bent.nodes[k])
                })
                .collect();
            let forces = bent.forces(&r, &v, &a);
            let by_velocity = bent.wing.deforming_velocity_load(&m, section, Calm, None);
            let by_mass = bent
                .wing
                .deforming_acceleration_load(&m, &acc, section, Calm);
            let both = Wrench {
                force: by_velocity.load.force + by_mass.load.force,
                moment: by_velocity.load.moment + by_mass.load.moment,
            };
            let size: f64 = forces.iter().map(|f| f.length()).sum();
            assert_same(&sum(&r, &forces), &both, size);
            let power: f64 = forces.iter().zip(&u).map(|(f, u)| f.dot(*u)).sum();
            let prescribed = -(by_velocity.power + by_mass.power);
            assert!(
                (power - prescribed).abs() < 1e-12 * size,
                "{power} {prescribed}"
            );
        }
    }
}

#[test]
fn agrees_answers_of_sections_with_differences_of_their_forces() {
    // Bent and twisted, moving; each node in turn a little faster, accelerating a little more.
    let bent = bent(AddedMassModel::Impulse, 1.0);
    let r: Vec<DVec3> = (bent.nodes.iter())
        .map(|r| *r + DVec3::new(0.0, 0.0, 0.1 * r.y * r.y + 0.2 * r.x * r.y))
        .collect();
    let v: Vec<DVec3> = r
        .iter()
        .map(|r| DVec3::new(2.0, 0.0, -1.0 + 0.5 * r.x))
        .collect();
    let a = vec![DVec3::ZERO; r.len()];
    let moving = NodesInMotion {
        position: &r,
        velocity: &v,
        acceleration: &a,
    };
    let states: Vec<_> = bent
        .sections
        .iter()
        .map(|s| s.state(&bent.wing, &moving, &Calm, DMat3::IDENTITY))
        .collect();
    let mut answers = vec![];
    (bent.wing).bent_answers(&bent.sections, &states, None, &mut answers);
    let predicted = |of: &dyn Fn(&SectionAnswer) -> [[f64; 3]; 3], change: &[DVec3]| {
        let mut out = vec![DVec3::ZERO; r.len()];
        for answer in &answers {
            let moved = [0, 1, 2].map(|way| {
                let nodes = answer.ways[way].iter();
                nodes.map(|(n, by)| by[0].dot(change[*n])).sum::<f64>()
            });
            for (row, way) in of(answer).iter().zip(&answer.ways) {
                let force: f64 = row.iter().zip(moved).map(|(d, x)| d * x).sum();
                way.iter().for_each(|(n, by)| out[*n] += force * by[0]);
            }
        }
        out
    };
    // Motions of flat sections: each along chord, normal and feathering.
    let flat = |r: &DVec3| DVec3::new(0.3, 0.0, 0.7 - 0.4 * r.x);
    let change: Vec<DVec3> = r.iter().map(flat).collect();
    let base = bent.forces(&r, &v, &a);
    let moved = |x: &[DVec3], s: f64| -> Vec<DVec3> {
        x.iter().zip(&change).map(|(x, c)| *x + s * *c).collect()
    };
    let apart = |found: &[DVec3], expected: &[DVec3]| {
        let size: f64 = expected.iter().map(|f| f.length()).sum();
        let apart: f64 = found
            .iter()
            .zip(expected)
            .map(|(a, b)| (*a - *b).length())
            .sum();
        apart / size
    };
    let step = 1e-6;
    let by_velocity: Vec<DVec3> = {
        let [plus, minus] = [step, -step].map(|s| bent.forces(&r, &moved(&v, s), &a));
        plus.iter()
            .zip(minus)
            .map(|(p, m)| (*p - m) / (2.0 * step))
            .collect()
    };
    let off = apart(&predicted(&|a| a.velocity, &change), &by_velocity);
    // Terms of second order in rates of turning are left out.
    assert!(off < 0.1, "{off}");
    let by_acceleration: Vec<DVec3> = {
        let plus = bent.forces(&r, &v, &moved(&a, 1.0));
        plus.iter().zip(&base).map(|(p, b)| *p - *b).collect()
    };
    let off = apart(&predicted(&|a| a.acceleration, &change), &by_acceleration);
    assert!(off < 1e-10, "{off}"); // linear in accelerations
}
