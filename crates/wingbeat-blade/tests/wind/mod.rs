//! Wings in wind that changes, against wings that move.

use super::{RHO, motions, wing};
use std::f64::consts::{PI, TAU};
use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench, r1, r2, r3};

const LAWS: [AddedMassModel; 4] = [
    AddedMassModel::None,
    AddedMassModel::Impulse,
    AddedMassModel::Normal,
    AddedMassModel::Section,
];

/// Velocity `u + s x` at a point x of N and its rate where the point stands still, on a wing that moves like
/// `m` with its hinge at `p`; of the velocity u has come since the memory of the strips `change`.
#[derive(Clone, Copy)]
struct Field {
    u: DVec3,
    rate: DVec3,
    shear: DMat3,
    change: DVec3,
    m: BodyMotion,
    p: DVec3,
}

impl LocalWind for Field {
    fn velocity(&self, r: DVec3) -> DVec3 {
        let x = self.p + self.m.r * r;
        self.m.r.transpose() * (self.u + self.shear * x)
    }

    fn rate(&self, _: DVec3, through: DVec3) -> DVec3 {
        let v = self.m.r * through;
        self.m.r.transpose() * (self.rate + self.shear * v)
    }

    fn at_once(&self) -> [DVec3; 2] {
        [self.change, self.rate].map(|x| self.m.r.transpose() * x)
    }
}

fn uniform(u: DVec3, rate: DVec3, change: DVec3, m: BodyMotion) -> Field {
    Field {
        u,
        rate,
        shear: DMat3::ZERO,
        change,
        m,
        p: DVec3::ZERO,
    }
}

fn assert_close(a: Wrench, b: Wrench, tolerance: f64) {
    let apart = (a.force - b.force).length() + (a.moment - b.moment).length();
    let size = b.force.length() + b.moment.length();
    assert!(apart <= tolerance * size.max(1e-3), "{a:?} {b:?}");
}

fn plus(a: Wrench, b: Wrench) -> Wrench {
    Wrench {
        force: a.force + b.force,
        moment: a.moment + b.moment,
    }
}

/// Added mass alone.
fn massive(law: AddedMassModel) -> BladeSettings {
    BladeSettings {
        translation: Translation::DoubleAngle {
            lift: 0.0,
            drag_0: 0.0,
            drag_90: 0.0,
        },
        rotation: Rotation::None,
        added_mass: law,
        viscous: None,
        ..BladeSettings::insect(RHO)
    }
}

#[test]
fn exact_plate_at_rest_in_air_that_oscillates_feels_its_added_mass() {
    // Air that swings as A sin(omega t) along the normal: rho pi/4 c^2 A omega cos(omega t) per unit of span,
    // where the air stands still.
    let plate = wing(BladeSettings::insect(RHO), 1, 1.0);
    let rest = BodyMotion {
        r: DMat3::IDENTITY,
        v: DVec3::ZERO,
        w: DVec3::ZERO,
        ..BodyMotion::REST
    };
    let wind = uniform(DVec3::ZERO, 3.0 * TAU * DVec3::Z, DVec3::ZERO, rest);
    let still = BodyAcceleration::default();
    let load = plus(
        plate.velocity_load_in(&rest, wind),
        plate.acceleration_load_in(&rest, &still, wind),
    );
    let exact = PI / 4.0 * RHO * 0.3 * 0.3 * 3.0 * TAU;
    assert!((load.force.z / exact - 1.0).abs() < 1e-14, "{load:?}");
}

#[test]
fn invariant_air_that_accelerates_is_a_wing_that_accelerates_the_other_way() {
    for law in LAWS {
        let settings = BladeSettings {
            added_mass: law,
            ..BladeSettings::insect(RHO)
        };
        let w = wing(settings, 5, -1.0);
        for m in motions() {
            let (u, rate) = (DVec3::new(0.4, -1.1, 0.9), 7.0 * m.v + DVec3::X);
            let acc = BodyAcceleration {
                linear: DVec3::new(1.0, -3.0, 2.0),
                angular: m.w,
            };
            let wind = uniform(u, rate, DVec3::ZERO, m);
            let met = plus(
                w.velocity_load_in(&m, wind),
                w.acceleration_load_in(&m, &acc, wind),
            );
            let moved = BodyMotion { v: m.v - u, ..m };
            let by = BodyAcceleration {
                linear: acc.linear - rate,
                ..acc
            };
            assert_close(met, w.load(&moved, &by), 1e-13);
        }
    }
}

#[test]
fn invariant_air_that_swings_everywhere_is_a_motion_of_strips_with_wakes() {
    for theory in [Unsteady::Jones, Unsteady::Peters { states: 6 }] {
        let settings = BladeSettings {
            unsteady: Some(theory),
            free_stream: DVec3::new(-1.5, 0.1, 0.2),
            ..BladeSettings::insect(RHO)
        };
        let w = wing(settings, 4, 1.0);
        let mut memories = [0, 1].map(|_| w.memory().expect("wakes"));
        let (mut trial, mut before) = (vec![], DVec3::ZERO);
        for k in 0..300 {
            let t = 0.02 * f64::from(k);
            let (sin, cos) = (3.0 * t).sin_cos();
            let u = sin * DVec3::new(0.3, 0.2, -0.6);
            let rate = 3.0 * cos * DVec3::new(0.3, 0.2, -0.6);
            let m = BodyMotion {
                r: r1(0.3) * r2(0.5 * (2.0 * t).sin()),
                v: DVec3::new(0.0, 0.0, 0.2 * (5.0 * t).cos()),
                w: DVec3::new(0.0, (2.0 * t).cos(), 0.0),
                ..BodyMotion::REST
            };
            let acc = BodyAcceleration {
                linear: DVec3::new(0.0, 0.0, -(5.0 * t).sin()),
                angular: DVec3::new(0.0, -2.0 * (2.0 * t).sin(), 0.0),
            };
            let wind = uniform(u, rate, u - before, m);
            before = u;
            let moved = BodyMotion { v: m.v - u, ..m };
            let by = BodyAcceleration {
                linear: acc.linear - rate,
                ..acc
            };
            let [a, b] = &mut memories;
            let mut loads = [Wrench::default(); 2];
            let lag = lag(a, t, &mut trial);
            loads[0] = w.lagging_load(&m, wind, Some(lag));
            w.accept(a, &trial, t);
            loads[0] = plus(loads[0], w.acceleration_load_in(&m, &acc, wind));
            let lag = self::lag(b, t, &mut trial);
            loads[1] = w.lagging_load(&moved, Calm, Some(lag));
            w.accept(b, &trial, t);
            loads[1] = plus(loads[1], w.acceleration_load(&moved, &by));
            assert_close(loads[0], loads[1], 1e-11);
        }
    }
}

fn lag<'a>(memory: &'a WingMemory, time: f64, trial: &'a mut Vec<StripTrial>) -> Lag<'a> {
    Lag::Trial {
        memory,
        time,
        trial,
    }
}

/// A wing that turns and flies through air that shears and gathers way: place and rotation at time t.
fn flown(t: f64) -> (DVec3, DMat3) {
    let place = DVec3::new(1.3 * t, 0.4 * t * t, -0.7 * t + t * t * t);
    (place, r2(1.1 * t) * r1(0.4 - 0.9 * t) * r3(0.5 * t * t))
}

const SHEAR: DMat3 = DMat3::from_cols(
    DVec3::new(0.5, -1.0, 2.0),
    DVec3::new(1.5, 0.3, -0.2),
    DVec3::new(-0.6, 0.8, 0.4),
);

fn blowing(t: f64) -> DVec3 {
    DVec3::new(0.2 + t, -2.0 * t * t, (3.0 * t).sin())
}

/// Motion and acceleration by differences, and the wind then.
fn at(t: f64) -> (BodyMotion, BodyAcceleration, Field) {
    let h = 1e-4;
    let rate_at = |t: f64| {
        let (a, b) = (flown(t - h).1, flown(t + h).1);
        let w = flown(t).1.transpose() * ((b - a) * (0.5 / h));
        DVec3::new(w.y_axis.z, w.z_axis.x, w.x_axis.y)
    };
    let [a, b, c] = [t - h, t, t + h].map(|t| flown(t).0);
    let m = BodyMotion {
        r: flown(t).1,
        v: (c - a) / (2.0 * h),
        w: rate_at(t),
        ..BodyMotion::REST
    };
    let acc = BodyAcceleration {
        linear: (a - 2.0 * b + c) / (h * h),
        angular: (rate_at(t + h) - rate_at(t - h)) / (2.0 * h),
    };
    let wind = Field {
        u: blowing(t),
        rate: (blowing(t + h) - blowing(t - h)) / (2.0 * h),
        shear: SHEAR,
        change: DVec3::ZERO,
        m,
        p: b,
    };
    (m, acc, wind)
}

#[test]
fn agrees_force_in_a_changing_wind_with_the_rate_of_the_airs_impulse() {
    // By the law of the impulse the force is the rate at which the momentum m (w n) that strips have given to
    // the air at their mid chords falls.
    let w = wing(massive(AddedMassModel::Impulse), 4, 1.0);
    let impulse = |t: f64| {
        let (m, _, wind) = at(t);
        let n = m.r.z_axis;
        let strip = |s: &Strip| {
            let r = DVec3::new(s.x_mid(), s.y, 0.0);
            let v = m.v - w.settings().free_stream + m.r * m.w.cross(r);
            let through = v - m.r * wind.velocity(r);
            PI / 4.0 * RHO * s.chord * s.chord * s.width * through.dot(n) * n
        };
        w.strips().iter().map(strip).sum::<DVec3>()
    };
    let h = 1e-3;
    for k in 0..8 {
        let t = 0.1 + 0.11 * f64::from(k);
        let (m, acc, wind) = at(t);
        let load = plus(
            w.velocity_load_in(&m, wind),
            w.acceleration_load_in(&m, &acc, wind),
        );
        let force = m.r * load.force;
        let rate = (impulse(t + h) - impulse(t - h)) / (2.0 * h);
        // Differences of second order, h^2 = 1e-6 of rates of some 10 1/s.
        assert!(
            (force + rate).length() < 1e-4 * rate.length(),
            "{t}: {force} {rate}"
        );
    }
}

#[test]
fn agrees_nodes_of_a_bent_wing_in_a_changing_wind_with_the_flat_wing() {
    // A rectangular mesh of one panel along the chord: its place is mid chord.
    let (rows, cols) = (1, 4);
    let node = |k: usize| {
        let (i, j) = (k / (cols + 1), k % (cols + 1));
        DVec3::new(0.075 - 0.3 * i as f64, 0.1 + 0.25 * j as f64, 0.0)
    };
    let nodes: Vec<DVec3> = (0..(rows + 1) * (cols + 1)).map(node).collect();
    let column = |j: usize| [j, cols + 1 + j];
    let sections: Vec<MeshSection> = (0..cols)
        .map(|j| MeshSection::new(&nodes, &column(j), &column(j + 1)))
        .collect();
    for law in LAWS {
        let w = wing(massive(law), cols, 1.0);
        let (m, acc, wind) = at(0.4);
        let back = m.r.transpose();
        let v = |r: &DVec3| back * m.v + m.w.cross(*r);
        let a = |r: &DVec3| back * acc.linear + acc.angular.cross(*r) + m.w.cross(m.w.cross(*r));
        let (velocity, acceleration): (Vec<_>, Vec<_>) = nodes.iter().map(|r| (v(r), a(r))).unzip();
        let moving = NodesInMotion {
            position: &nodes,
            velocity: &velocity,
            acceleration: &acceleration,
        };
        let state = |s: &MeshSection| s.state(&w, &moving, &wind, m.r);
        let states: Vec<SectionState> = sections.iter().map(state).collect();
        let mut forces = vec![DVec3::ZERO; nodes.len()];
        w.bent_forces(&sections, &states, None, &mut forces);
        let bent = Wrench {
            force: forces.iter().sum(),
            moment: nodes.iter().zip(&forces).map(|(r, f)| r.cross(*f)).sum(),
        };
        let flat = plus(
            w.velocity_load_in(&m, wind),
            w.acceleration_load_in(&m, &acc, wind),
        );
        assert_close(bent, flat, 1e-12);
    }
}
