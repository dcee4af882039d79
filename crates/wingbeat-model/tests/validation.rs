//! Comparison with published figures.

use std::f64::consts::FRAC_PI_2;
use wingbeat_math::DVec3;
use wingbeat_model::kinematics::{self, PublishedMotion, Timing};
use wingbeat_model::species::{FlyOptions, drosophila_melanogaster};

fn angles(m: &PublishedMotion, x: f64) -> [f64; 2] {
    [&m.right.phi, &m.right.psi].map(|law| law.at(x)[0].to_degrees())
}

/// dmel_dickson (willdickson/fmech): lengths and masses of the shipped fly; inertia of the body
/// about its mass centre from their STL mesh at 1 mg/mm3: across 0.4008 and 0.4077, along
/// 0.0755 mg mm2.
#[test]
fn published_fruit_fly_sizes_masses_and_body_inertia() {
    let fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    assert!((fly.body_length() - 2.5e-3).abs() < 1e-15);
    assert!((fly.body.mass - 0.9315e-6).abs() < 1e-18);
    assert!(fly.body.centre().length() < 1e-15); // the origin is the mass centre
    let j = fly.body.inertia_about_centre();
    let mg_mm2 = 1e-12;
    let off = |computed: f64, measured: f64| (computed / (measured * mg_mm2) - 1.0).abs();
    // Three round ellipsoids in line against a scanned, bent body of one density.
    let across = [off(j.y_axis.y, 0.4077), off(j.z_axis.z, 0.4008)];
    assert!(across[0] < 0.15 && across[1] < 0.15, "{across:?}");
    let along = off(j.x_axis.x, 0.0755); // slimmer
    assert!(along < 0.25, "{along}");
    // Near the density of water; the thorax carries the six legs' mass as well.
    let fine = FlyOptions {
        stations: [24; 3],
        meridians: [32; 3],
        ..Default::default()
    };
    for part in &drosophila_melanogaster(&fine).unwrap().parts {
        let density = part.mass.mass / wingbeat_model::mesh::integrate::volume(&part.mesh);
        assert!(
            (800.0..1500.0).contains(&density),
            "{}: {density}",
            part.name
        );
    }
}

/// Wing: dmel_dickson gives 2.5 mm, 0.699 mm, 5.35 ug and inertias about the wing's mass centre
/// 2.162e-3, 1.82e-3 and 0.341e-3 mg mm2: about normal, chord and span for a flat plate.
#[test]
fn published_fruit_fly_wing_size_and_inertia() {
    let fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    let wing = &fly.wings[1];
    let r = wing.report();
    assert!((r.length - 2.5e-3).abs() < 1e-15);
    // 10 span panels of the default mesh cut the curved outline: 2 %.
    assert!(
        (r.mean_chord / 0.699e-3 - 1.0).abs() < 0.02,
        "{}",
        r.mean_chord
    );
    assert!((r.r2_hat / 0.58592 - 1.0).abs() < 0.01, "{}", r.r2_hat);
    // Largest chords in print: 0.7 mm (Beatus) to 1.126 mm (NeuroMechFly).
    assert!((0.7e-3..1.126e-3).contains(&r.max_chord), "{}", r.max_chord);
    assert!((wing.mass.mass - 5.35e-9).abs() < 1e-20);
    let j = wing.mass.inertia_about_centre();
    let found = [
        j.z_axis.z / 2.162e-15,
        j.x_axis.x / 1.82e-15,
        j.y_axis.y / 0.341e-15,
    ];
    // A flat plate of constant areal density; real wings are heavier at root and veins: 15 %.
    assert!(found.iter().all(|r| (r - 1.0).abs() < 0.15), "{found:?}");
}

/// Fry, Sayaman & Dickinson 2005, fig. 1: the beat starts at the dorsal reversal, amplitude
/// about 140 deg, stroke centred dorsally; at mid stroke the feathering is 45 to 60 deg.
#[test]
fn published_fry_stroke_amplitude_and_feathering() {
    let fry = kinematics::fry_hover();
    let at = |i: i32| angles(&fry, f64::from(i) / 1000.0)[0];
    let (lo, hi) = (0..1000).fold((0.0_f64, 0.0_f64), |(l, h), i| (l.min(at(i)), h.max(at(i))));
    assert!((hi - lo - 143.0).abs() < 1.0, "{lo} {hi}");
    assert!(at(0) < lo + 1.0); // right wing far back: dorsal
    assert!((-16.0..-8.0).contains(&(0.5 * (lo + hi)))); // centre shifted dorsally
    let (down, up) = (angles(&fry, 0.25)[1], angles(&fry, 0.75)[1]);
    assert!((-70.0..-30.0).contains(&down), "{down}"); // leading edge forward in the downstroke
    assert!((30.0..70.0).contains(&up), "{up}");
}

/// Robofly: stroke 160 deg, angle of attack 40 deg at mid stroke, i.e. feathering 50 deg; the
/// Fourier series of Dickinson et al. 1999 and the independent benchmark tables describe the
/// same stroke.
#[test]
fn published_robofly_stroke_and_attack_agree_between_series_and_tables() {
    for timing in [Timing::Advanced, Timing::Symmetrical, Timing::Delayed] {
        let series =
            kinematics::robofly_dickinson1999(timing, 160f64.to_radians(), 40f64.to_radians());
        let table = kinematics::robofly_table(timing).unwrap();
        let mut worst = [0.0_f64; 2];
        for i in 0..100 {
            let x = f64::from(i) / 100.0;
            let (s, t) = (angles(&series, x), angles(&table, x));
            for k in 0..2 {
                worst[k] = worst[k].max((s[k] - t[k]).abs());
            }
        }
        // Different digitisations and smoothings of the same experiment: found 0.5 and 5.7 deg.
        assert!(worst[0] < 1.0 && worst[1] < 7.0, "{timing:?}: {worst:?}");
        assert!((angles(&table, 0.0)[0] + 80.0).abs() < 0.01);
        assert!((angles(&table, 0.5)[0] - 80.0).abs() < 0.01);
        let mid = angles(&series, 0.25)[1];
        assert!((mid + 50.0).abs() < 4.0, "{timing:?}: {mid}");
    }
}

/// The four hover optima of FWUAV: body pitch and stroke-plane pitch add up to a stroke plane
/// within 35 deg of horizontal, as hover wants (the bumblebee leans most, 33 deg).
#[test]
fn published_fwuav_hover_has_a_nearly_horizontal_stroke_plane() {
    use kinematics::FwuavInsect::{Bumblebee, FruitFly, Hawkmoth, Monarch};
    for insect in [Monarch, Hawkmoth, Bumblebee, FruitFly] {
        let (motion, body_pitch) = kinematics::fwuav_hover(insect);
        let tilt = body_pitch + motion.stroke_plane_pitch.unwrap() - FRAC_PI_2;
        let normal = wingbeat_math::r2(FRAC_PI_2 + tilt) * DVec3::X;
        assert!(
            normal.z < -35f64.to_radians().cos(),
            "{insect:?}: {}",
            tilt.to_degrees()
        );
    }
}
