//! Strips of wings that are not flat, against flat wings whose frames are turned.

use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench, r1, r2, r3};

const RHO: f64 = 1.2;
const LAWS: [AddedMassModel; 4] = [
    AddedMassModel::None,
    AddedMassModel::Impulse,
    AddedMassModel::Normal,
    AddedMassModel::Section,
];

fn settings(added_mass: AddedMassModel) -> BladeSettings {
    BladeSettings {
        added_mass,
        ..BladeSettings::insect(RHO)
    }
}

/// Some motions of all kinds.
fn motions() -> impl Iterator<Item = (BodyMotion, BodyAcceleration)> {
    (0..40).map(|k: i32| {
        let n = |m: i32| f64::from((k * m + m) % 13 - 6) * 0.4;
        let motion = BodyMotion {
            r: r2(n(3)) * r3(n(5)) * r1(n(7)),
            v: DVec3::new(n(2), n(9), n(4)),
            w: DVec3::new(n(6), n(8), n(11)),
            ..BodyMotion::REST
        };
        let acc = BodyAcceleration {
            linear: DVec3::new(n(5), n(4), n(10)),
            angular: DVec3::new(n(7), n(3), n(2)),
        };
        (motion, acc)
    })
}

/// Wind that differs from place to place.
fn wind(r: DVec3) -> DVec3 {
    DVec3::new(0.3 - r.y, 0.2 + r.x, 0.5 * r.y - 0.1 * r.z)
}

fn assert_same(a: &Wrench, b: &Wrench) {
    let apart = (a.force - b.force).length() + (a.moment - b.moment).length();
    let size = b.force.length() + b.moment.length();
    assert!(apart <= 1e-12 * size.max(1e-3), "{a:?} {b:?}");
}

/// Strips of a swept, tapered wing of one `side` whose mesh is turned by `turn` about the hinge.
fn placed(turn: DMat3, side: f64) -> Vec<PlacedStrip> {
    let y = |j: usize| 0.1 + 0.2 * j as f64;
    let node = |x: f64, y: f64| turn * DVec3::new(x, side * y, 0.0);
    let lead = |j: usize| node(0.075 - 0.03 * y(j), y(j));
    let trail = |j: usize| node(-0.225 + 0.05 * y(j), y(j));
    let strip = |j: usize| {
        let ends = |of: &dyn Fn(usize) -> DVec3| [of(j), of(j + 1)];
        Strip::between(ends(&lead), ends(&trail), side)
    };
    (0..5).map(strip).collect()
}

fn wing(placed: &[PlacedStrip], law: AddedMassModel) -> BladeWing {
    BladeWing::new(placed.iter().map(|p| p.strip).collect(), settings(law)).unwrap()
}

/// Incidence, dihedral and both.
fn turns() -> [DMat3; 4] {
    [
        r2(0.4),
        r1(0.5),
        r1(-0.3) * r2(0.2),
        r3(0.2) * r1(0.4) * r2(-0.7),
    ]
}

#[test]
fn invariant_a_mesh_turned_about_the_hinge_is_a_frame_turned_about_it() {
    for (law, side) in LAWS.iter().flat_map(|l| [(*l, 1.0), (*l, -1.0)]) {
        let flat = wing(&placed(DMat3::IDENTITY, side), law);
        for q in turns() {
            let strips = placed(q, side);
            let turned = wing(&strips, law);
            let section = |k: usize| SectionMotion::fixed(&strips[k]);
            for (m, acc) in motions() {
                let own = BodyMotion {
                    r: m.r * q,
                    v: m.v,
                    w: q.transpose() * m.w,
                    ..BodyMotion::REST
                };
                let own_acc = BodyAcceleration {
                    linear: acc.linear,
                    angular: q.transpose() * acc.angular,
                };
                let local = |r: DVec3| q.transpose() * wind(q * r);
                let back = |load: Wrench| Wrench {
                    force: q * load.force,
                    moment: q * load.moment,
                };
                let expected = back(flat.velocity_load_in(&own, local));
                let load = turned.deforming_velocity_load(&m, section, wind, None);
                assert_same(&load.load, &expected);
                let windy = turned.deforming_acceleration_load(&m, &acc, section, wind);
                let expected = flat.acceleration_load_in(&own, &own_acc, local);
                assert_same(&windy.load, &back(expected));
                let calmly = turned.deforming_velocity_load(&m, section, Calm, None);
                assert_same(&calmly.load, &back(flat.velocity_load(&own)));
                let mass = turned.deforming_acceleration_load(&m, &acc, section, Calm);
                assert_same(&mass.load, &back(flat.acceleration_load(&own, &own_acc)));
                assert_eq!([calmly.power, mass.power].map(f64::abs), [0.0; 2]);
            }
        }
    }
}

#[test]
fn exact_strips_in_the_plane_of_the_wing_are_measured_along_its_axes() {
    let placed = Strip::between(
        [DVec3::new(0.1, 0.2, 0.0), DVec3::new(0.08, 0.4, 0.0)],
        [DVec3::new(-0.2, 0.2, 0.0), DVec3::new(-0.18, 0.4, 0.0)],
        1.0,
    );
    let strip = Strip {
        y: 0.5 * (0.2 + 0.4),
        x_leading: 0.5 * (0.1 + 0.08),
        chord: 0.5 * (0.1 + 0.08) - 0.5 * (-0.2 - 0.18),
        width: 0.4 - 0.2,
    };
    assert!(placed.is_flat());
    assert_eq!(placed.strip, strip);
}

/// Parts between lines that are not along axis 1: with the area of the part, whichever edge is the longer, and
/// those of a swept strip through its middle, as sections along axis 1 have it.
#[test]
fn exact_strips_between_skewed_lines_have_the_area_of_the_part() {
    for side in [1.0, -1.0] {
        for [l0, l1, t0, t1] in [
            [[0.1, 0.2], [0.08, 0.4], [-0.2, 0.25], [-0.18, 0.42]],
            [[0.1, 0.25], [0.1, 0.42], [-0.2, 0.2], [-0.2, 0.4]],
            [[0.1, 0.2], [0.1, 0.2], [-0.2, 0.2], [-0.2, 0.4]],
        ] {
            let corners = [l0, l1, t1, t0].map(|[x, y]| DVec3::new(x, side * y, 0.0));
            let [a, b, c, d] = corners;
            let area = 0.5 * (c - a).cross(d - b).z.abs();
            let placed = Strip::between([a, b], [d, c], side);
            let (s, middle) = (placed.strip, 0.25 * (a + b + c + d));
            assert!(placed.is_flat());
            // Rounding.
            assert!(
                (s.chord * s.width / area - 1.0).abs() < 1e-14,
                "{s:?} {area}"
            );
            assert!((s.y - middle.y).abs() < 1e-15 && (s.x_mid() - middle.x).abs() < 1e-15);
        }
    }
    // Edges that are swept by 45 degrees, 0.3 apart along axis 1, between lines along axis 1 and at 45 degrees to it.
    let strip = |dy: f64| {
        let edge = |x: f64, dy: f64| [0.2, 0.4].map(|y| DVec3::new(x - (y + dy), y + dy, 0.0));
        Strip::between(edge(0.1, dy), edge(-0.2, -dy), 1.0).strip
    };
    let [along, skewed] = [strip(0.0), strip(0.15)];
    for (a, b) in [
        (along.y, skewed.y),
        (along.x_leading, skewed.x_leading),
        (along.chord, skewed.chord),
        (along.width, skewed.width),
    ] {
        assert!((a - b).abs() < 1e-15, "{along:?} {skewed:?}"); // Rounding.
    }
}

/// A strip that lies on `turn`, and ways between its sides \[m\] with their first two time derivatives: one along
/// the strip, and one that sweeps, rises and grows.
fn ways(turn: DMat3) -> (PlacedStrip, [[DVec3; 3]; 2]) {
    let strip = Strip {
        y: 0.0,
        x_leading: 0.075,
        chord: 0.3,
        width: 0.2,
    };
    let axis = DVec3::ZERO;
    let way = 0.2 * turn.y_axis;
    let lifted = [
        way + DVec3::new(-0.03, 0.01, 0.05),
        DVec3::new(0.1, -0.2, -0.22),
        DVec3::new(0.3, -0.5, 1.2),
    ];
    let placed = PlacedStrip { strip, axis, turn };
    (placed, [[way, DVec3::ZERO, DVec3::ZERO], lifted])
}

/// A section with dihedral and incidence that moves, is turned about axis 2 of the wing frame and follows the
/// way between its sides, is a flat strip in a frame that moves and turns so; the power is that of its load on this
/// motion.
#[test]
fn agrees_twist_of_a_section_with_dihedral_with_a_frame_that_turns() {
    let twist = [0.3, 1.7, -4.0];
    let axis = [
        DVec3::new(0.02, 0.6, -0.1),
        DVec3::new(0.3, -0.2, 0.7),
        DVec3::new(1.0, 2.0, -3.0),
    ];
    let turned = turns().into_iter().flat_map(|q| {
        let (placed, ways) = ways(q);
        ways.map(|way| {
            let section = SectionMotion::turned(&placed, axis, twist, way);
            (placed.strip, section)
        })
    });
    for (law, (strip, s)) in turned.flat_map(|s| LAWS.map(|l| (l, s))) {
        let wing = BladeWing::new(vec![strip], settings(law)).unwrap();
        let section = |_: usize| s;
        let (q, [p, p1, p2], [spin, spin_rate]) = (s.turn, axis, s.spin);
        for (m, acc) in motions() {
            let (r, w) = (m.r, m.w);
            let turning = acc.angular.cross(p) + w.cross(w.cross(p) + 2.0 * p1) + p2;
            let own = BodyMotion {
                r: r * q,
                v: m.v + r * (w.cross(p) + p1),
                w: q.transpose() * (w + spin),
                ..BodyMotion::REST
            };
            let own_acc = BodyAcceleration {
                linear: acc.linear + r * turning,
                angular: q.transpose() * (acc.angular + spin_rate + w.cross(spin)),
            };
            let check = |got: DeformingLoad, flat: Wrench| {
                let [force, moment] = [flat.force, flat.moment].map(|x| s.stretch * (q * x));
                let expected = Wrench {
                    force,
                    moment: moment + p.cross(force),
                };
                assert_same(&got.load, &expected);
                let power = -(force.dot(p1) + moment.dot(spin));
                let size = force.length() + moment.length();
                assert!((got.power - power).abs() <= 1e-12 * size.max(1e-3));
            };
            let still = wing.deforming_velocity_load(&m, section, Calm, None);
            check(still, wing.velocity_load(&own));
            let mass = wing.deforming_acceleration_load(&m, &acc, section, Calm);
            check(mass, wing.acceleration_load(&own, &own_acc));
        }
    }
}

/// Axes of a section, differenced in time, turn by its angular velocity, and that changes by its rate; the span is
/// the way between the sides but for its part along the chord.
#[test]
fn agrees_spin_of_a_section_with_differences_of_its_axes() {
    let (twist, h) = ([0.3, 1.7, -4.0], 1e-5);
    let cases = turns().into_iter().flat_map(|q| {
        let (placed, ways) = ways(q);
        ways.map(|w| (placed, w))
    });
    for (placed, [w, w1, w2]) in cases {
        let at = |t: f64| {
            let across = [w + t * (w1 + 0.5 * t * w2), w1 + t * w2, w2];
            let [q, q1, q2] = twist;
            let twist = [q + t * (q1 + 0.5 * t * q2), q1 + t * q2, q2];
            SectionMotion::turned(&placed, [DVec3::ZERO; 3], twist, across)
        };
        let (before, now, after) = (at(-h), at(0.0), at(h));
        for k in 0..3 {
            let rate = (after.turn.col(k) - before.turn.col(k)) / (2.0 * h);
            // h^2 / 6 of third derivatives of some 100 1/s3, and roundings over h.
            assert!((rate - now.spin[0].cross(now.turn.col(k))).length() < 1e-8);
        }
        let rate = (after.spin[0] - before.spin[0]) / (2.0 * h);
        assert!(
            (rate - now.spin[1]).length() < 1e-7,
            "{rate} {:?}",
            now.spin[1]
        );
        let across = w.reject_from(now.turn.x_axis);
        let width = now.stretch * placed.strip.width;
        assert!((across - width * now.turn.y_axis).length() < 1e-15);
    }
}
