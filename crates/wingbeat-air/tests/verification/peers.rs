//! A flapping case run by two other programs (see the data files).

use crate::common::{fly, rectangle, total_force};
use wingbeat_air::{AirSettings, CoreModel, Lattice, NodeMotion, Surface};
use wingbeat_math::{DVec3, r1};

const PERIOD: f64 = 0.25;

/// Wings flapping about the lines through their root leading edges along x (aft), y right, z up.
fn motion(rows: usize, cols: usize, t: f64) -> NodeMotion {
    let (w, amplitude) = (std::f64::consts::TAU / PERIOD, 25_f64.to_radians());
    let (angle, rate) = (amplitude * (w * t).cos(), -amplitude * w * (w * t).sin());
    let mut motion = NodeMotion::default();
    for side in [1.0, -1.0] {
        for x in rectangle(rows, cols, 0.1 * DVec3::X, side * 0.4 * DVec3::Y) {
            let arm = r1(side * angle) * x;
            motion.position.push(arm + side * 0.01 * DVec3::Y);
            motion.velocity.push(side * rate * DVec3::X.cross(arm));
        }
    }
    motion
}

/// A column of a table by its name.
pub fn column(text: &str, name: &str) -> Vec<f64> {
    let mut lines = text.lines().skip(1);
    let header = lines.next().expect("a header");
    let k = header.split(',').position(|w| w == name).expect(name);
    lines
        .map(|l| {
            l.split(',')
                .nth(k)
                .and_then(|w| w.parse().ok())
                .expect(name)
        })
        .collect()
}

/// Mean over the second beat by the trapezoidal rule.
fn beat_mean(lift: &[f64], per_beat: usize) -> f64 {
    let beat = &lift[per_beat..=2 * per_beat];
    let ends = 0.5 * (beat[0] + beat[per_beat]);
    (ends + beat[1..per_beat].iter().sum::<f64>()) / per_beat as f64
}

/// Their loads hold the suction at the leading edge, ours are pressure times normal; suction acts
/// along x, for the wings flap about x: forces along z are to be compared.
#[test]
fn agrees_flapping_lift_with_two_other_programs() {
    let (s, c) = 5_f64.to_radians().sin_cos();
    let core = CoreModel::Scully { radius: 0.003 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        ..AirSettings::benchmark(1.225, 4.0 * DVec3::new(c, 0.0, s))
    };
    let (rows, cols, per_beat) = (8, 20, 40);
    let wings = ["right", "left"].map(|name| Surface::grid(name, rows, cols));
    let lattice = Lattice::new(wings.to_vec(), settings).unwrap();
    let dt = PERIOD / per_beat as f64;
    let mut ours = Vec::new();
    // Panels of the left wing have their normals down, forces do not care.
    fly(
        &lattice,
        |t| motion(rows, cols, t),
        dt,
        2 * per_beat,
        |_, _, loads, _| {
            let f = total_force(loads);
            ours.push(f.z * c - f.x * s);
        },
    )
    .unwrap();
    let ours_mean = beat_mean(&ours, per_beat);
    for (name, text) in [
        (
            "PteraSoftware",
            include_str!("../../../wingbeat-verify/data/flap_rect_pterasoftware.csv"),
        ),
        (
            "Imperial",
            include_str!("../../../wingbeat-verify/data/flap_rect_imperial_uvlm.csv"),
        ),
    ] {
        let (lift, drag) = (column(text, "lift_N"), column(text, "drag_N"));
        let theirs: Vec<f64> = lift.iter().zip(drag).map(|(l, d)| l * c + d * s).collect();
        let mean = beat_mean(&theirs, per_beat);
        let size = theirs[per_beat..]
            .iter()
            .fold(0.0_f64, |m, l| m.max(l.abs()));
        let beat = per_beat..=2 * per_beat;
        let worst = beat
            .map(|k| (ours[k] - theirs[k]).abs())
            .fold(0.0, f64::max)
            / size;
        println!(
            "{name}: mean {mean:.4} N, ours {ours_mean:.4} N; worst difference {worst:.3} of {size:.3} N"
        );
        // Quarter-chord rings against rings on the edges, other cores.
        assert!(worst < 0.1 && (ours_mean / mean - 1.0).abs() < 0.03);
    }
}
