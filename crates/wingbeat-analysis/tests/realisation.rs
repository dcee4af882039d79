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

#[test]
fn exact_vibrations_faster_than_half_the_sampling_rate_keep_their_frequencies() {
    // 8 steps of 0.06 s from sample to sample: 11 and 17 rad/s appear at 2.09 and 3.91.
    let steps = response(0.06, 240);
    let found = realise_sampled(&Sampled {
        steps: &steps,
        step: 0.06,
        every: 8,
    });
    let found = found.unwrap();
    assert!(found.untold.is_empty(), "{found:?}");
    let vibrations = found.vibrations.iter().filter(|v| v.frequency > 1e-6);
    let vibrations: Vec<_> = vibrations.collect();
    assert_eq!(vibrations.len(), 3, "{found:?}");
    // Rounding, as of samples without steps between.
    for (v, (growth, frequency, _)) in vibrations.iter().zip(MODES) {
        assert!((v.growth - growth).abs() < 1e-10, "{v:?}");
        assert!((v.frequency - frequency).abs() < 1e-10, "{v:?}");
    }
}

#[test]
fn exact_two_vibrations_that_look_alike_in_the_samples_are_not_told_as_one() {
    // Samples 0.5 s apart: 2 and 2 + 4 pi rad/s have the same, those 0.45 s apart have not.
    let at = |k: usize| {
        let t = k as f64 * 0.05;
        let pair = [(2.0, 1.0), (2.0 + 2.0 * std::f64::consts::TAU, 0.8)];
        let sum = |phase: f64| {
            pair.map(|(w, a)| a * (w * t + a * phase).cos())
                .iter()
                .sum()
        };
        vec![sum(0.0), sum(1.0)]
    };
    let steps: Vec<_> = (1..=300).map(at).collect();
    let found = |every: usize| {
        realise_sampled(&Sampled {
            steps: &steps,
            step: 0.05,
            every,
        })
        .unwrap()
    };
    let alike = found(10);
    assert!(alike.vibrations.is_empty(), "{alike:?}");
    assert!((alike.untold[0].frequency - 2.0).abs() < 1e-9);
    let apart = found(9);
    assert!(apart.untold.is_empty(), "{apart:?}");
    let frequencies: Vec<f64> = apart.vibrations.iter().map(|v| v.frequency).collect();
    assert_eq!(frequencies.len(), 2);
    assert!((frequencies[0] - 2.0).abs() < 1e-9, "{frequencies:?}");
    assert!(
        (frequencies[1] - 14.566_370_614_359_172).abs() < 1e-9,
        "{frequencies:?}"
    );
}
