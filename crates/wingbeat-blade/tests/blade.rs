//! Blade elements against closed forms, balances and symmetries.

use std::f64::consts::PI;

use wingbeat_blade::*;
use wingbeat_math::{
    BodyAcceleration, BodyMotion, DMat3, DVec3, MovingRotation, Wrench, r1, r2, r3,
};

#[path = "bent/mod.rs"]
mod bent;
#[path = "mirror/mod.rs"]
mod mirror;
#[path = "unsteady/mod.rs"]
mod unsteady;
#[path = "wind/mod.rs"]
mod wind;

const RHO: f64 = 1.2;

fn wing(settings: BladeSettings, count: usize, side: f64) -> BladeWing {
    let strips = Strip::rectangle(count, [0.1, 1.1], 0.3, 0.075, side);
    BladeWing::new(strips, settings).unwrap()
}

/// A motion without rotation of the frame against N.
fn motion(velocity: DVec3, rate: DVec3) -> BodyMotion {
    BodyMotion {
        r: DMat3::IDENTITY,
        v: velocity,
        w: rate,
        ..BodyMotion::REST
    }
}

/// Some motions of all kinds: (velocity, rate), small integers spread over both signs.
fn motions() -> impl Iterator<Item = BodyMotion> {
    (0..60).map(|k: i32| {
        let n = |m: i32| f64::from((k * m + m) % 13 - 6) * 0.4;
        BodyMotion {
            r: r2(n(3)) * r3(n(5)) * r1(n(7)),
            v: DVec3::new(n(2), n(9), n(4)),
            w: DVec3::new(n(6), n(8), n(11)),
            ..BodyMotion::REST
        }
    })
}

fn only_translation(law: Translation) -> BladeSettings {
    BladeSettings {
        translation: law,
        rotation: Rotation::None,
        added_mass: AddedMassModel::None,
        ..BladeSettings::insect(RHO)
    }
}

/// The square of speeds below 1e-162 m/s is no number: what is left of the loads goes with the speed itself.
#[test]
fn limit_air_whose_speed_has_no_square_exerts_no_force() {
    let laws = SETS.iter().map(|set| set.law);
    let centres = [
        CentreOfPressure::Cosine,
        CentreOfPressure::Fixed(0.3),
        CentreOfPressure::Chen2016,
    ];
    for (translation, centre_of_pressure) in laws.flat_map(|l| centres.map(|c| (l, c))) {
        let wing = BladeSettings {
            translation,
            centre_of_pressure,
            ..BladeSettings::insect(RHO)
        };
        let wing = self::wing(wing, 3, 1.0);
        for speed in (-210..-155).map(|k| 10_f64.powi(k)) {
            let v = speed * DVec3::new(0.6, 0.0, -0.8);
            for rate in [0.0, 1.0] {
                // A tenth of a kilogram of air goes along: with rate 1/s the loads are less than the speed in N and N m.
                let load = wing.velocity_load(&motion(v, rate * DVec3::Y));
                let largest = load.force.abs().max(load.moment.abs()).max_element();
                let still = wing.velocity_load(&motion(DVec3::ZERO, rate * DVec3::Y));
                let still = still.force.abs().max(still.moment.abs()).max_element();
                assert!(
                    load.force.is_finite() && load.moment.is_finite(),
                    "{speed:e}"
                );
                assert!(largest <= still + speed, "{speed:e} {rate}: {load:?}");
            }
        }
    }
}

#[test]
fn exact_revolving_wing_integrates_r2_c() {
    // A rectangular wing revolving at W with angle of attack a: L = 1/2 rho C_L W^2 c int r^2 dr.
    let (a, w) = (0.6_f64, 7.0);
    let rate = DVec3::new(w * a.sin(), 0.0, -w * a.cos()); // u = W y cos a, w = W y sin a
    for set in SETS {
        let load =
            wing(only_translation(set.law), 400, 1.0).velocity_load(&motion(DVec3::ZERO, rate));
        let q = 0.5 * RHO * w * w * 0.3;
        let (r2, r3) = (
            (1.1_f64.powi(3) - 0.1_f64.powi(3)) / 3.0,
            (1.1_f64.powi(4) - 0.1_f64.powi(4)) / 4.0,
        );
        let [cl, cd] = set.law.at(a);
        let drag = -(load.force.x * a.cos() + load.force.z * a.sin());
        let lift = load.force.x * a.sin() - load.force.z * a.cos();
        // The midpoint rule errs by dr^2/12 of the integral of the curvature 2: 2.4e-6 of 0.44.
        assert!((lift / (q * cl * r2) - 1.0).abs() < 3e-6, "{}", set.name);
        assert!((drag / (q * cd * r2) - 1.0).abs() < 3e-6, "{}", set.name);
        // Torque of drag about the hinge, for the power: int r^3.
        let torque = -(load.moment.x * a.sin() - load.moment.z * a.cos());
        assert!((torque / (q * cd * r3) - 1.0).abs() < 1e-5, "{}", set.name);
    }
}

#[test]
fn order_strips_converge_at_second_order() {
    let rate = DVec3::new(3.0, 0.5, -4.0);
    let at = |n| {
        wing(BladeSettings::insect(RHO), n, 1.0)
            .velocity_load(&motion(DVec3::new(0.4, 0.0, 0.3), rate))
            .force
            .z
    };
    let (a, b, c) = (at(10), at(20), at(40));
    let order = ((a - b) / (b - c)).log2();
    assert!((order - 2.0).abs() < 0.05, "order {order}"); // the midpoint rule on a smooth integrand
}

#[test]
fn exact_rotational_force_of_thin_airfoil_theory() {
    // At alpha = 0 feathering at q about x0 gives -rho pi (3/4 - x0) c^2 q u: thin airfoil theory with the normal
    // velocity at 3/4 chord. From behind theory has pi (x0 - 1/4), Sane & Dickinson's law the same as from ahead.
    for rotation in [Rotation::SaneDickinson, Rotation::Circulation] {
        for u in [2.0, -2.0] {
            let settings = BladeSettings {
                rotation,
                added_mass: AddedMassModel::None,
                ..BladeSettings::insect(RHO)
            };
            let strips = Strip::rectangle(3, [0.1, 1.1], 0.3, 0.3 * 0.4, 1.0);
            let load = BladeWing::new(strips, settings)
                .unwrap()
                .velocity_load(&motion(DVec3::new(u, 0.0, 0.0), DVec3::new(0.0, 0.5, 0.0)));
            let from_behind = rotation == Rotation::Circulation && u < 0.0;
            let coefficient = if from_behind { 0.4 - 0.25 } else { 0.75 - 0.4 };
            let exact = -RHO * PI * coefficient * 0.3 * 0.3 * 0.5 * u; // span 1
            assert!((load.force.z / exact - 1.0).abs() < 1e-14, "{rotation:?}"); // no lift at alpha 0
        }
    }
}

#[test]
fn exact_couple_of_feathering_of_thin_airfoil_theory() {
    // A plate that turns at q about any axis in a stream along its chord has the camber of a parabola: the moment about
    // a quarter of the chord is `-pi/16 rho c^3 u q` [Glauert 1926], whatever its circulation, either way round.
    for (axis, u) in [(0.25, 2.0), (0.4, 2.0), (0.6, 2.0), (0.4, -2.0)] {
        let settings = BladeSettings {
            added_mass: AddedMassModel::None,
            centre_of_pressure: CentreOfPressure::Fixed(0.25),
            ..BladeSettings::insect(RHO)
        };
        let strips = Strip::rectangle(3, [0.0, 1.0], 0.3, 0.3 * axis, 1.0);
        let load = BladeWing::new(strips, settings)
            .unwrap()
            .velocity_load(&motion(DVec3::new(u, 0.0, 0.0), DVec3::new(0.0, 0.5, 0.0)));
        let behind_leading_edge = if u > 0.0 { 0.25 } else { 0.75 };
        let quarter = 0.3 * (axis - behind_leading_edge);
        let about_quarter = load.moment.y + quarter * load.force.z;
        let exact = -PI / 16.0 * RHO * 0.3_f64.powi(3) * 0.5 * f64::abs(u);
        assert!((about_quarter / exact - 1.0).abs() < 1e-13, "{axis} {u}");
    }
}

#[test]
fn exact_added_mass_of_a_plate() {
    // A plate accelerated along its normal: pi/4 rho c^2 per unit span; spun up about mid chord:
    // no force, and the moment pi/128 rho c^4 of the section alone.
    let settings = BladeSettings {
        added_mass: AddedMassModel::Impulse,
        ..BladeSettings::insect(RHO)
    };
    let plate = BladeWing::new(Strip::rectangle(1, [-0.5, 0.5], 0.4, 0.2, 1.0), settings).unwrap();
    let rest = motion(DVec3::ZERO, DVec3::ZERO);
    let lifted = plate.acceleration_load(
        &rest,
        &BodyAcceleration {
            linear: DVec3::new(1.0, 2.0, 3.0),
            angular: DVec3::ZERO,
        },
    );
    let m = PI / 4.0 * RHO * 0.16;
    assert!((lifted.force - DVec3::new(0.0, 0.0, -3.0 * m)).length() < 1e-15);
    let spun = plate.acceleration_load(
        &rest,
        &BodyAcceleration {
            linear: DVec3::ZERO,
            angular: DVec3::new(0.0, 5.0, 0.0),
        },
    );
    let inertia = PI / 128.0 * RHO * 0.4_f64.powi(4);
    assert!(spun.force.length() < 1e-15);
    assert!((spun.moment.y + 5.0 * inertia).abs() < 1e-15);
}

#[test]
fn balances_added_mass_returns_its_energy() {
    // Power of the added-mass load = -dE/dt of the air it moves, in any motion.
    for form in [AddedMassModel::Normal, AddedMassModel::Impulse] {
        returns_its_energy(form);
    }
}

fn returns_its_energy(form: AddedMassModel) {
    let with = |added_mass| BladeSettings {
        added_mass,
        ..BladeSettings::insect(RHO)
    };
    let (without, wing) = (
        wing(with(AddedMassModel::None), 7, 1.0),
        wing(with(form), 7, 1.0),
    );
    for (k, m) in motions().enumerate() {
        let acc = BodyAcceleration {
            linear: DVec3::new(1.0, -2.0, 0.1 * k as f64),
            angular: DVec3::new(-1.5, 0.3, 2.0),
        };
        let v = m.r.transpose() * m.v;
        let power_of = |load: Wrench| load.force.dot(v) + load.moment.dot(m.w);
        let mut power = power_of(wing.load(&m, &acc)) - power_of(without.load(&m, &acc));
        if form == AddedMassModel::Impulse {
            power += munk(&wing, &m) * m.w.y;
        }
        // E is quadratic in the velocity components: its central difference is exact.
        let rate = m.r.transpose() * acc.linear - m.w.cross(v);
        let h = 1e-3;
        let moved = |s: f64| BodyMotion {
            v: m.r * (v + s * h * rate),
            w: m.w + s * h * acc.angular,
            ..m
        };
        let energy = |s: f64| added_energy(&wing, &moved(s));
        let slope = (energy(1.0) - energy(-1.0)) / (2.0 * h);
        // Only round-off of the difference over h remains.
        assert!((power + slope).abs() < 1e-10 * (1.0 + power.abs()));
    }
}

/// Energy of the air that the added mass moves, `sum m w^2/2` of the normal velocities w at mid chord, with
/// `J q^2/2` of the sections' own turning where the added mass has it \[J\].
fn added_energy(wing: &BladeWing, m: &BodyMotion) -> f64 {
    let has_inertia = wing.settings().added_mass == AddedMassModel::Impulse;
    let v = m.r.transpose() * m.v;
    let energy = |s: &Strip| {
        let w = (v + m.w.cross(DVec3::new(s.x_mid(), s.y, 0.0))).z;
        let mass = PI / 4.0 * RHO * s.chord.powi(2) * s.width;
        let inertia = PI / 128.0 * RHO * s.chord.powi(4) * s.width;
        0.5 * mass * w * w
            + if has_inertia {
                0.5 * inertia * m.w.y.powi(2)
            } else {
                0.0
            }
    };
    wing.strips().iter().map(energy).sum()
}

/// Munk's couple about the span, `sum m w u`, which the centre of pressure has in it.
fn munk(wing: &BladeWing, m: &BodyMotion) -> f64 {
    let v = m.r.transpose() * m.v;
    let couple = |s: &Strip| {
        let at_mid = v + m.w.cross(DVec3::new(s.x_mid(), s.y, 0.0));
        PI / 4.0 * RHO * s.chord * s.chord * s.width * at_mid.z * at_mid.x
    };
    wing.strips().iter().map(couple).sum()
}

/// A wing on a moving hinge at the phase x of its beat: where the hinge is, motion, acceleration.
fn beating(x: f64) -> (DVec3, BodyMotion, BodyAcceleration) {
    let wave = |k: f64, a: f64, shift: f64| {
        let (s, c) = (2.0 * PI * k * x + shift).sin_cos();
        [a * s, 2.0 * PI * k * a * c, -4.0 * PI * PI * k * k * a * s]
    };
    let turned = MovingRotation::about(1, [0.4, 0.0, 0.0])
        .then(&MovingRotation::about(0, wave(1.0, 1.1, 0.3)))
        .then(&MovingRotation::about(2, wave(2.0, 0.2, 0.9)))
        .then(&MovingRotation::about(1, wave(1.0, 0.8, 1.7)));
    let place = [
        wave(1.0, 0.3, 0.2),
        wave(2.0, 0.1, 0.5),
        wave(1.0, 0.2, 1.0),
    ];
    let at = |k: usize| DVec3::new(place[0][k], place[1][k], place[2][k]);
    let motion = BodyMotion {
        r: turned.c,
        v: at(1),
        w: turned.w,
        ..BodyMotion::REST
    };
    let acc = BodyAcceleration {
        linear: at(2),
        angular: turned.w_dot,
    };
    (at(0), motion, acc)
}

#[test]
fn balances_added_mass_by_impulse_has_no_mean_load_over_a_beat() {
    // Force and moment about a fixed point are rates of a momentum that is periodic, the moment with
    // Munk's couple, which the centre of pressure has. The equidistant
    // sum over a smooth periodic function converges faster than any power; 200 points reach round-off.
    let with = |added_mass| {
        wing(
            BladeSettings {
                added_mass,
                ..BladeSettings::insect(RHO)
            },
            9,
            -1.0,
        )
    };
    let without = with(AddedMassModel::None);
    let mean = |form: AddedMassModel| {
        let (wing, mut sums, mut size) = (with(form), [DVec3::ZERO; 2], [0.0_f64; 2]);
        for k in 0..200 {
            let (p, m, acc) = beating(f64::from(k) / 200.0);
            let (a, b) = (wing.load(&m, &acc), without.load(&m, &acc));
            let force = m.r * (a.force - b.force);
            let couple = DVec3::Y * munk(&wing, &m);
            let moment = m.r * (a.moment - b.moment + couple) + p.cross(force);
            for (i, load) in [force, moment].into_iter().enumerate() {
                sums[i] += load / 200.0;
                size[i] = size[i].max(load.length());
            }
        }
        [0, 1].map(|i| sums[i].length() / size[i])
    };
    let [force, moment] = mean(AddedMassModel::Impulse);
    println!("means over largest: force {force:.1e}, moment {moment:.1e}");
    assert!(force < 1e-15 && moment < 1e-15); // roundings of 200 terms
    // The form that looks at the normal alone does push: that is what the impulse is for.
    assert!(mean(AddedMassModel::Normal)[0] > 1e-2);
}

#[test]
fn balances_translation_only_takes_energy() {
    // Lift does no work, drag takes 1/2 rho U^3 c C_D: power is never positive, whatever the set.
    for set in SETS {
        let settings = only_translation(set.law);
        let wing = wing(settings, 5, 1.0);
        for m in motions() {
            let load = wing.velocity_load(&m);
            let v = m.r.transpose() * m.v;
            // Moment about the span is left out: the model's force is placed at the centre of
            // pressure but felt at the axis velocity.
            let rate = DVec3::new(m.w.x, 0.0, m.w.z);
            let power = load.force.dot(v) + load.moment.dot(rate);
            assert!(power <= 1e-12, "{}: {power}", set.name);
        }
    }
}

#[test]
fn invariant_mirror_gives_the_mirrored_load() {
    let flip = DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0));
    for settings in [
        BladeSettings::insect(RHO),
        BladeSettings::berman_wang(RHO, 3.0),
    ] {
        let (right, left) = (wing(settings, 6, 1.0), wing(settings, 6, -1.0));
        for m in motions() {
            let acc = BodyAcceleration {
                linear: DVec3::new(0.3, -1.0, 2.0),
                angular: DVec3::new(1.0, 2.0, -0.7),
            };
            let mirrored = BodyMotion {
                r: flip * m.r * flip,
                v: flip * m.v,
                w: -(flip * m.w), // an axial vector
                ..BodyMotion::REST
            };
            let mirrored_acc = BodyAcceleration {
                linear: flip * acc.linear,
                angular: -(flip * acc.angular),
            };
            let (a, b) = (right.load(&m, &acc), left.load(&mirrored, &mirrored_acc));
            let scale = 1.0 + a.force.length() + a.moment.length();
            assert!((flip * a.force - b.force).length() < 1e-13 * scale);
            assert!((-(flip * a.moment) - b.moment).length() < 1e-13 * scale);
        }
    }
}

#[test]
fn invariant_galilean_and_rotated_frames() {
    let stream = DVec3::new(0.3, -0.7, 1.1);
    let still = wing(BladeSettings::berman_wang(RHO, 3.0), 4, 1.0);
    let windy = wing(
        BladeSettings {
            free_stream: stream,
            ..BladeSettings::berman_wang(RHO, 3.0)
        },
        4,
        1.0,
    );
    let turn = r3(0.4) * r1(-1.2);
    for m in motions() {
        let a = still.velocity_load(&m);
        let b = windy.velocity_load(&BodyMotion {
            v: m.v + stream,
            ..m
        });
        let c = still.velocity_load(&BodyMotion {
            r: turn * m.r,
            v: turn * m.v,
            ..m
        });
        for other in [b, c] {
            // Roundings of rotating and shifting velocities of order 3.
            assert!((a.force - other.force).length() < 1e-12 * (1.0 + a.force.length()));
            assert!((a.moment - other.moment).length() < 1e-12 * (1.0 + a.moment.length()));
        }
    }
}

#[test]
fn limit_still_wing_in_still_air_feels_nothing() {
    let load = wing(BladeSettings::insect(RHO), 4, 1.0).load(
        &motion(DVec3::ZERO, DVec3::ZERO),
        &BodyAcceleration::default(),
    );
    assert_eq!(load, Wrench::default());
}

#[test]
fn published_coefficients_at_tabulated_angles() {
    let at = |name: &str, degrees: f64| find_set(name).unwrap().law.at(degrees.to_radians());
    let close = |a: f64, b: f64| (a - b).abs() < 5e-4; // three decimals worked out by hand
    assert!(close(at("dickinson-1999", 45.0)[1], 1.704)); // 1.92 - 1.55 cos(81.98 deg)
    assert!(close(at("dickson-2008", 45.0)[0], 1.660)); // 3.3207 / 2
    assert!(close(at("dickson-2008", 90.0)[1], 3.579));
    assert!(close(at("whitney-wood-2010", 0.0)[1], 0.4));
    assert!(close(at("wang-dragonfly", 45.0)[1], 1.4));
    assert!(close(at("deng-2006", 90.0)[1], 3.4));
    assert!(close(at("byl", 30.0)[0], 1.559)); // 1.8 sin 60 deg
}

#[test]
fn exact_refusals_name_what_is_wrong() {
    let bad = BladeSettings {
        density: -1.0,
        ..BladeSettings::insect(RHO)
    };
    let strips = Strip::rectangle(2, [0.0, 1.0], 0.1, 0.0, 1.0);
    let e = BladeWing::new(strips, bad).unwrap_err();
    assert!(matches!(e, BladeError::Value { key: "density", .. }));
    let flat = Strip::rectangle(2, [0.0, 1.0], 0.0, 0.0, 1.0);
    let e = BladeWing::new(flat, BladeSettings::insect(RHO)).unwrap_err();
    assert!(matches!(e, BladeError::Strip { index: 0, .. }));
    let e = find_set("dickinson").unwrap_err().to_string();
    assert!(e.contains("dickinson-1999"), "{e}");
}
