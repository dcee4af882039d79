//! The Kalman filter of the regulator, and the loop that is closed over both.

use crate::common::{self, matrix, sizes};

use wingbeat_analysis::Perturbation;
use wingbeat_analysis::control::{
    CONTROLS, Channels, Controls, Departure, Held, Kalman, Law, Observer, ProcessNoise, Reference,
    Regulator, STATES, Sensors, SteeredBeats, Steering, Weights, kalman, states,
};
use wingbeat_math::DVec3;

const LATENCY: usize = 1;
/// Commands in force and under way.
const COMMANDED: usize = CONTROLS * (LATENCY + 1);

/// Noise of the sensors of a small camera and gyroscope.
fn noise() -> Channels<f64> {
    Channels {
        position: 2e-4,
        velocity: 0.02,
        tilt: 0.03,
        rate: 5.0,
    }
}

/// `P = a^2 P r / (P + r) + w` of one state, solved as a quadratic.
#[test]
fn exact_filter_of_one_state() {
    for [a, w, r] in [[1.3_f64, 0.2, 0.7], [0.5, 1.0, 1e-3], [1.0, 1e-4, 1.0]] {
        let Kalman { gain, covariance } = kalman(&[&[a]], &[w], &[r]).expect("a filter").remove(0);
        let half = 0.5 * (w + r * (a * a - 1.0));
        let p = half + (half * half + w * r).sqrt();
        // The iteration stops at changes of 1e-12; it contracts by 0.99 at the slowest.
        assert!((covariance[0] / p - 1.0).abs() < 1e-9, "{covariance:?} {p}");
        assert!((gain[0] - p / (p + r)).abs() < 1e-9);
    }
}

/// Weights that no iteration can balance are named, not the strokes.
#[test]
fn refuses_weights_far_from_the_usual_by_name() {
    let trim = common::hovering(40);
    let usual = Weights::default();
    for (name, weights) in [
        (
            "command = 1e-6",
            Weights {
                command: 1e-6,
                ..usual
            },
        ),
        (
            "tilt = 1e-9",
            Weights {
                tilt: 1e-9,
                ..usual
            },
        ),
        (
            "command = 1e300",
            Weights {
                command: 1e300,
                ..usual
            },
        ),
        (
            "command = 1e-300",
            Weights {
                command: 1e-300,
                ..usual
            },
        ),
    ] {
        let found = Regulator::new(&trim, &weights, LATENCY);
        let said = found.map(|_| name).unwrap_err().to_string();
        assert!(said.contains(name) && !said.contains("stabilise"), "{said}");
    }
    let light = Weights {
        command: 5e-3,
        ..usual
    };
    assert!(Regulator::new(&trim, &light, LATENCY).is_ok());
}

/// The covariance of the fly's filter fulfils Riccati's equation.
#[test]
fn balances_covariance_of_the_fly() {
    let trim = common::hovering(40);
    let regulator = Regulator::new(&trim, &Weights::default(), LATENCY).expect("gains");
    let m = &regulator.plants()[0].m;
    let sizes = sizes(&trim);
    let square = |x: f64| x * x;
    let w: Vec<f64> = (0..STATES)
        .map(|k| square([0.0, 0.01, 0.01, 0.0][k / 3] * sizes[k]))
        .collect();
    let n = noise();
    let r: Vec<f64> = (0..STATES)
        .map(|k| square([n.position, n.velocity, n.rate, n.tilt][k / 3]))
        .collect();
    let Kalman { gain, covariance } = kalman(&[m], &w, &r).expect("a filter").remove(0);
    let at = |x: &[f64], i: usize, j: usize| x[i * STATES + j];
    let times = |x: &[f64], y: &[f64]| -> Vec<f64> {
        let entry = |k: usize| {
            (0..STATES)
                .map(|l| at(x, k / STATES, l) * at(y, l, k % STATES))
                .sum()
        };
        (0..STATES * STATES).map(entry).collect()
    };
    let lp = times(&gain, &covariance);
    let after: Vec<f64> = covariance.iter().zip(&lp).map(|(p, lp)| p - lp).collect();
    let ahead = times(m, &after);
    for i in 0..STATES {
        for j in 0..STATES {
            let moved: f64 = (0..STATES).map(|l| at(&ahead, i, l) * at(m, j, l)).sum();
            let expect = moved + if i == j { w[i] } else { 0.0 };
            let size = (at(&covariance, i, i) * at(&covariance, j, j)).sqrt();
            let residual = (expect - at(&covariance, i, j)).abs() / size;
            assert!(residual < 1e-10, "{i}, {j}: {residual:e}");
        }
    }
}

/// The departure of these states.
fn departure(x: &[f64]) -> Departure {
    Departure {
        look: 0,
        position: DVec3::from_slice(x),
        state: Perturbation::from_array(std::array::from_fn(|k| x[3 + k])),
    }
}

/// A wingbeat of the linear flight under `regulator`: states, then what the regulator remembers.
fn closed(regulator: &Regulator, z: &[f64]) -> Vec<f64> {
    let mut regulator = regulator.clone();
    let (x, memory) = z.split_at(STATES);
    regulator.restore(memory).expect("its memory");
    let d = regulator.estimated(&departure(x));
    let u = regulator.controls(&d);
    let now: Controls = memory[..CONTROLS].try_into().expect("the command in force");
    regulator.remember(&d, u, 1);
    let memory = regulator.memory();
    let next: Controls = memory[..CONTROLS].try_into().expect("the next command");
    let x: &[f64; STATES] = x.try_into().expect("all states");
    [&regulator.plants()[0].advance(x, &now, &next)[..], &memory].concat()
}

/// Separation: the eigenvalues of the loop closed over the filter are those of regulator and filter, so its
/// characteristic polynomial is the product of theirs.
#[test]
fn exact_eigenvalues_of_the_loop_are_those_of_regulator_and_filter() {
    let trim = common::hovering(40);
    let plain = Regulator::new(&trim, &Weights::default(), LATENCY).expect("gains");
    let observed = plain.clone();
    let observed = observed.observed(&trim, &ProcessNoise::default(), &noise());
    let observed = observed.expect("a filter");
    let sizes = sizes(&trim);
    let all = [&sizes[..], &[1.0; COMMANDED], &sizes].concat();
    let (n, m) = (STATES + COMMANDED, 2 * STATES + COMMANDED);
    let whole = matrix(&all, |z| closed(&observed, z));
    let regulated = matrix(&all[..n], |z| closed(&plain, z));
    // Errors of what is expected: e' = M (1 - L) e.
    let filter = Observer::new(
        plain.plants(),
        &trim.beat,
        &ProcessNoise::default(),
        &noise(),
    );
    let filter = filter.expect("a filter");
    let errors = matrix(&sizes, |e| {
        let left: [f64; STATES] = std::array::from_fn(|i| {
            e[i] - (0..STATES)
                .map(|j| filter.gains()[0][i * STATES + j] * e[j])
                .sum::<f64>()
        });
        let none = [0.0; CONTROLS];
        plain.plants()[0].advance(&left, &none, &none)
    });
    let polynomial = |a: &[f64], n: usize, z: f64| {
        let mut a: Vec<f64> = a.iter().map(|x| -x).collect();
        (0..n).for_each(|i| a[i * n + i] += z);
        common::determinant(&a, n)
    };
    for k in 0..=m {
        let z = -2.0 + 4.0 * k as f64 / m as f64 + 0.01;
        let product = polynomial(&regulated, n, z) * polynomial(&errors, STATES, z);
        let of_loop = polynomial(&whole, m, z);
        // Determinants of 32 rows with entries up to hundreds.
        assert!(
            (of_loop / product - 1.0).abs() < 1e-6,
            "{z}: {of_loop:e} {product:e}"
        );
    }
}

/// Seen through noise, the flyer with an observer strays less: a root mean square over the second half of 300 beats.
#[test]
fn balances_a_noisy_flight_holds_its_place_better_with_an_observer() {
    let trim = common::hovering(40);
    let plain = Regulator::new(&trim, &Weights::default(), LATENCY).expect("gains");
    let observed = plain.clone();
    let observed = observed.observed(&trim, &ProcessNoise::default(), &noise());
    let strayed = [plain, observed.expect("a filter")].map(|regulator| {
        let held = Held::Known(Reference::trimmed(&trim).expect("a reference"));
        let mut steering = Steering::new(Law::Regulator(regulator), held, &trim.setup);
        steering.sensors = Some(Sensors {
            seed: 5,
            noise: noise(),
            ..Sensors::default()
        });
        let flight = SteeredBeats::new(&trim, trim.state.clone(), Some(steering), LATENCY);
        let mut flight = flight.expect("a flight");
        // The place is counted from the first look, whose noise shifts it.
        let mut places = vec![];
        for k in 0..300 {
            flight.beat().expect("it is held");
            if k >= 150 {
                places.push(states(&flight.departure()));
            }
        }
        let n = places.len() as f64;
        let deviation = |axes: std::ops::Range<usize>| {
            let square = |k: usize| {
                let mean = places.iter().map(|x| x[k]).sum::<f64>() / n;
                places.iter().map(|x| (x[k] - mean).powi(2)).sum::<f64>() / n
            };
            axes.map(square).sum::<f64>().sqrt()
        };
        [
            deviation(0..3) / trim.beat.wing_length(),
            deviation(9..12).to_degrees(),
        ]
    });
    println!(
        "place [R] and tilt [deg]: {:?} without, {:?} with an observer",
        strayed[0], strayed[1]
    );
    assert!(strayed[1][0] < 0.7 * strayed[0][0], "{strayed:?}");
    assert!(strayed[1][1] < strayed[0][1], "{strayed:?}");
}
