//! Mean speed of the tips of wings: way of a beat times frequency, however often they go to and fro in it.

use crate::common;
use wingbeat_analysis::{WingEstimate, estimate};
use wingbeat_math::RotationLaw;

/// A fly on a tether in blade elements, whose wings only sweep.
fn wing(phi: &str, more: &[&str]) -> WingEstimate {
    let phi = format!("wing.right.motion={{ phi.fourier = {phi} }}");
    let set = [
        &[
            "flight={ mode = \"tethered\" }",
            "motion={ frequency_hz = 200 }",
            &phi,
        ],
        more,
    ]
    .concat();
    let setup = common::preset("fruit-fly-blade", &set).setup;
    estimate(&setup).wings.remove(1)
}

/// Three strokes in a beat of a third of the frequency are the strokes of the whole one: speed, Reynolds number and
/// so what is doubted of them. Before, only the widest stroke of a beat counted.
#[test]
fn invariant_tip_speed_whatever_is_called_a_beat() {
    let one = wing("{ mean_deg = 5, cosine_deg = [60] }", &[]);
    let wanted = 4.0 * 60f64.to_radians() * one.report.length * 200.0;
    let error = one.tip_speed / wanted - 1.0;
    println!("chords: {error:e}");
    assert!(error.abs() < 1e-6, "{error:e}"); // chords instead of arcs
    for (count, bound) in [(3, 1e-5), (20, 3e-4)] {
        let zeros = "0, ".repeat(count - 1);
        let frequency = format!("motion.frequency_hz={:?}", 200.0 / count as f64);
        let phi = format!("{{ mean_deg = 5, cosine_deg = [{zeros}60] }}");
        let steps = format!("time.steps_per_beat={}", 100 * count);
        let many = wing(&phi, &[&frequency, &steps]);
        let error = many.tip_speed / one.tip_speed - 1.0;
        println!("{count} strokes: {error:e}");
        assert!(error.abs() < bound, "{count}: {error:e}");
        let [a, b] = [&one, &many].map(|w| w.reynolds.unwrap());
        assert!((b / a - 1.0).abs() < bound, "{count}: {a} {b}");
    }
}

/// The mean of the speed of the end of the span over a beat, by the angular velocity of the wing.
#[test]
fn agrees_tip_speed_with_the_mean_of_the_speed() {
    for name in ["fruit-fly-blade", "hawkmoth-elastic"] {
        let setup = common::preset(name, &[]).setup;
        let (wing, found) = (&setup.animal.wings[1], &estimate(&setup).wings[1]);
        let motion = wing.motion.impulsive();
        let period = 1.0 / motion.frequency;
        let tip = wing.length() * wingbeat_math::DVec3::Y;
        let n = 20_000;
        let speed = |k: u32| {
            let moving = motion.at(f64::from(k) / f64::from(n) * period);
            (moving.c * moving.w.cross(tip)).length()
        };
        let mean = (0..n).map(speed).sum::<f64>() / f64::from(n);
        let error = found.tip_speed / mean - 1.0;
        println!("{name}: {} m/s, off by {error:e}", found.tip_speed);
        assert!(error.abs() < 1e-5, "{name}: {error:e}");
    }
}
