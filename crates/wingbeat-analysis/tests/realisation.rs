//! Modes of linear systems from their free responses.

use wingbeat_analysis::flutter::*;

/// Growth, angular frequency and phases at three outputs.
const MODES: [(f64, f64, [f64; 3]); 3] = [
    (-0.3, 5.0, [0.0, 0.4, 1.3]),
    (0.05, 11.0, [1.0, 0.2, 2.0]),
    (-2.0, 17.0, [0.5, 0.1, 0.9]),
];

fn response(step: f64, count: usize) -> Vec<Vec<f64>> {
    let at = |k: usize| {
        let t = k as f64 * step;
        let output = |i: usize| {
            let of =
                |(s, w, phase): &(f64, f64, [f64; 3])| (s * t).exp() * (w * t + phase[i]).cos();
            MODES.iter().map(of).sum::<f64>() + 0.1 * (-t).exp()
        };
        (0..3).map(output).collect()
    };
    (0..count).map(at).collect()
}

#[test]
fn exact_sum_of_vibrations_and_a_decay_is_taken_apart() {
    let found = realise(&response(0.06, 60), 0.06).unwrap();
    assert_eq!(found.order, 7);
    // Rounding of decompositions whose smallest singular value is 1e-3 of the largest: some 1e-12 over the step.
    let vibrations: Vec<_> = found
        .vibrations
        .iter()
        .filter(|v| v.frequency > 1e-6)
        .collect();
    assert_eq!(vibrations.len(), 3);
    for (v, (growth, frequency, _)) in vibrations.iter().zip(MODES) {
        assert!((v.growth - growth).abs() < 1e-10, "{v:?}");
        assert!((v.frequency - frequency).abs() < 1e-10, "{v:?}");
        let damping = -growth / growth.hypot(frequency);
        assert!((v.damping() - damping).abs() < 1e-10, "{v:?}");
    }
    let decay = &found.vibrations[0];
    assert!(
        (decay.growth + 1.0).abs() < 1e-9 && decay.frequency.abs() < 1e-9,
        "{decay:?}"
    );
    assert!(found.residual < 1e-12, "{}", found.residual);
}

#[test]
fn exact_share_of_a_vibration_is_its_own_root_mean_square() {
    // Two of whole periods, orthogonal: squares of amplitudes 3 and 4 add up to that of 5.
    let sample = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / 64.0;
        vec![3.0 * (2.0 * t).cos() + 4.0 * (5.0 * t).sin()]
    };
    let samples: Vec<_> = (0..64).map(sample).collect();
    let found = realise(&samples, 1.0).unwrap();
    let shares: Vec<f64> = found.vibrations.iter().map(|v| v.share).collect();
    assert_eq!(shares.len(), 2);
    assert!(
        (shares[0] - 0.6).abs() < 1e-9 && (shares[1] - 0.8).abs() < 1e-9,
        "{shares:?}"
    );
}

#[test]
fn refuses_responses_that_say_nothing() {
    for samples in [
        vec![vec![0.0]; 10],
        vec![vec![1.0]; 3],
        vec![vec![f64::NAN]; 10],
    ] {
        let told = realise(&samples, 0.1).unwrap_err().to_string();
        assert!(
            told.contains("4 samples or more, finite and not zero"),
            "{told}"
        );
    }
}
