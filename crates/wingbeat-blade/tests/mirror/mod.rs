//! A section flown backwards is the mirror image, fore and aft, of one with the axis at 1 - x0 flown forwards.

use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench};

const AXES: [f64; 6] = [-0.2, 0.0, 0.25, 0.4, 0.5, 1.0];

/// All laws with wakes; without, those but for `SaneDickinson`, whose source knows one edge alone.
fn laws() -> Vec<BladeSettings> {
    let insect = BladeSettings::insect(1.2);
    let mut all = vec![];
    for rotation in [
        Rotation::None,
        Rotation::Circulation,
        Rotation::Coefficient(1.3),
    ] {
        for centre_of_pressure in [
            CentreOfPressure::Cosine,
            CentreOfPressure::Chen2016,
            CentreOfPressure::Fixed(0.25),
        ] {
            all.push(BladeSettings {
                rotation,
                centre_of_pressure,
                ..insect
            });
        }
    }
    for unsteady in [Unsteady::Jones, Unsteady::Peters { states: 4 }] {
        for rotation in [
            Rotation::None,
            Rotation::SaneDickinson,
            Rotation::Circulation,
            Rotation::Coefficient(1.3),
        ] {
            all.push(BladeSettings {
                rotation,
                unsteady: Some(unsteady),
                ..insect
            });
        }
    }
    let models = [
        AddedMassModel::None,
        AddedMassModel::Impulse,
        AddedMassModel::Normal,
        AddedMassModel::Section,
    ];
    let each = |s: BladeSettings| models.map(|added_mass| BladeSettings { added_mass, ..s });
    all.into_iter().flat_map(each).collect()
}

/// A vector, and an axial one, as the mirror of axis 1 shows them.
fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, v.y, v.z)
}
fn mirrored_axial(w: DVec3) -> DVec3 {
    -mirrored(w)
}

/// Loads of a wing with the axis at `x0` over a flight through all angles of attack, in the mirror or not.
fn flown(settings: BladeSettings, x0: f64, mirror: bool) -> Vec<Wrench> {
    let strips = Strip::rectangle(3, [0.1, 1.1], 0.3, 0.3 * x0, 1.0);
    let wing = BladeWing::new(strips, settings).unwrap();
    let mut memory = wing.memory();
    let mut trial = vec![];
    let [polar, axial] = match mirror {
        true => [mirrored, mirrored_axial],
        false => [|v: DVec3| v, |w: DVec3| w],
    };
    let load = |k: u32| {
        let t = 0.1 * f64::from(k);
        let n = |m: f64| (m * t + m).sin();
        let m = BodyMotion {
            r: DMat3::IDENTITY,
            v: polar(DVec3::new(2.0 * n(1.0), n(0.7), 1.5 * n(1.3))),
            w: axial(DVec3::new(n(1.7), 3.0 * n(2.1), n(0.9))),
            ..BodyMotion::REST
        };
        let acceleration = BodyAcceleration {
            linear: polar(DVec3::new(n(2.3), n(1.9), n(3.1))),
            angular: axial(DVec3::new(n(1.1), n(2.9), n(0.3))),
        };
        let lag = memory.as_ref().map(|memory| Lag::Trial {
            memory,
            time: t,
            trial: &mut trial,
        });
        let mut load = wing.lagging_load(&m, Calm, lag);
        if let Some(memory) = &mut memory {
            wing.accept(memory, &trial, t);
        }
        load += wing.acceleration_load(&m, &acceleration);
        load
    };
    (0..80).map(load).collect()
}

#[test]
fn invariant_section_flown_backwards_is_the_mirror_image() {
    for settings in laws() {
        for x0 in AXES {
            let forwards = flown(settings, x0, false);
            let backwards = flown(settings, 1.0 - x0, true);
            for (a, b) in forwards.iter().zip(&backwards) {
                let size = a.force.length() + a.moment.length();
                let apart = (mirrored(a.force) - b.force).length()
                    + (mirrored_axial(a.moment) - b.moment).length();
                assert!(
                    apart < 1e-12 * size.max(1.0),
                    "{settings:?} {x0}: {a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn exact_force_of_feathering_does_not_hang_on_the_axis_it_is_referred_to() {
    // Thin-airfoil coefficients, edge-on to first order: a section that turns about one point of its chord is the
    // section that turns about another and moves as that point does, whichever edge meets the air.
    let settings = BladeSettings {
        translation: Translation::DoubleAngle {
            lift: std::f64::consts::PI,
            drag_0: 0.0,
            drag_90: 0.0,
        },
        added_mass: AddedMassModel::None,
        ..BladeSettings::insect(1.2)
    };
    let q = 1e-5;
    let force = |x0: f64, u: f64| {
        let strips = Strip::rectangle(1, [0.0, 1.0], 0.3, 0.3 * x0, 1.0);
        let m = BodyMotion {
            r: DMat3::IDENTITY,
            // The middle of the chord moves straight on.
            v: DVec3::new(u, 0.0, q * 0.3 * (x0 - 0.5)),
            w: DVec3::new(0.0, q, 0.0),
            ..BodyMotion::REST
        };
        BladeWing::new(strips, settings)
            .unwrap()
            .velocity_load(&m)
            .force
            .z
    };
    for u in [2.0, -2.0] {
        // The circulation of a plate that turns about its middle: `pi/4 c^2 q` [Glauert 1926].
        let exact = -1.2 * std::f64::consts::PI / 4.0 * 0.3 * 0.3 * q * u;
        for x0 in AXES {
            // What is left is of second order in the angle of attack, 1e-6.
            assert!((force(x0, u) / exact - 1.0).abs() < 1e-9, "{x0} {u}");
        }
    }
}
