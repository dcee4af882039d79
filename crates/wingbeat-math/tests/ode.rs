//! Orders and restart of the integrators on problems with closed solutions.

use std::convert::Infallible;

use wingbeat_math::ode::{
    Convergence, Hamming, Memoryless, Multistep, Rk4, StepError, block_start,
};

const CONVERGENCE: Convergence = Convergence {
    tolerance: 1e-13,
    max_passes: 60,
    relaxation: 1.0,
};

/// A driven oscillator with the solution y = (sin t, cos t).
fn rates(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = y[1] + 0.3 * (y[0] - t.sin());
    dy[1] = -y[0] * y[0] - y[1] * y[1] - y[0] + 1.0;
}

fn exact(t: f64) -> [f64; 2] {
    [t.sin(), t.cos()]
}

fn error(y: &[f64], t: f64) -> f64 {
    let e = exact(t);
    (y[0] - e[0]).abs().max((y[1] - e[1]).abs())
}

fn started(h: f64) -> Multistep {
    let mut f0 = vec![0.0; 2];
    rates(0.0, &exact(0.0), &mut f0);
    let mut replay = Memoryless {
        t0: 0.0,
        step: h,
        rates: |t, y: &[f64], f: &mut [f64]| {
            rates(t, y, f);
            Ok::<(), Infallible>(())
        },
    };
    block_start(&exact(0.0), &f0, h, CONVERGENCE, &[1.0; 2], &mut replay)
        .expect("a start")
        .0
}

fn fly(past: &mut Multistep, method: &mut Hamming, from: usize, to: usize) {
    for n in from..to {
        let t = (n + 1) as f64 * method.step;
        let f = |y: &[f64], dy: &mut [f64]| {
            rates(t, y, dy);
            Ok::<(), Infallible>(())
        };
        method.advance(past, f).expect("a step");
    }
}

fn hamming_error(steps: usize, convergence: Convergence) -> f64 {
    let h = 2.0 / steps as f64;
    let mut past = started(h);
    let mut method = Hamming::new(h, convergence, vec![1.0; 2]);
    fly(&mut past, &mut method, 3, steps);
    error(past.newest(), 2.0)
}

/// Slopes of the error between 40, 80 and 160 steps.
fn slopes(e: impl Fn(usize) -> f64) -> [f64; 2] {
    let [a, b, c] = [40, 80, 160].map(e);
    [(a / b).log2(), (b / c).log2()]
}

#[test]
fn order_hamming_with_its_starter_is_at_least_four() {
    // The modifiers cancel the leading error term, so the slope lies between 4 and 5.
    for passes in [1, 2, 60] {
        let tolerance = if passes == 60 { 1e-13 } else { 0.0 };
        let convergence = Convergence {
            tolerance,
            max_passes: passes,
            relaxation: 1.0,
        };
        let s = slopes(|n| hamming_error(n, convergence));
        assert!(s[1] > 3.8 && s[1] < 5.5, "passes {passes}: slopes {s:?}");
    }
}

#[test]
fn order_block_start_is_five_locally() {
    let s = slopes(|n| {
        let h = 4.0 / n as f64;
        error(started(h).newest(), 3.0 * h)
    });
    assert!((s[1] - 5.0).abs() < 0.4, "slopes {s:?}");
}

#[test]
fn order_rk4_is_four() {
    let s = slopes(|n| {
        let h = 2.0 / n as f64;
        let (mut y, mut rk) = (exact(0.0), Rk4::new(2));
        for k in 0..n {
            rk.advance(k as f64 * h, h, &mut y, |t, y, dy| {
                rates(t, y, dy);
                Ok::<(), Infallible>(())
            })
            .expect("a step");
        }
        error(&y, 2.0)
    });
    assert!((s[1] - 4.0).abs() < 0.2, "slopes {s:?}");
}

#[test]
fn invariant_restart_from_the_saved_past_goes_on_bit_for_bit() {
    let h = 0.05;
    let method = || Hamming::new(h, CONVERGENCE, vec![1.0; 2]);
    let mut whole = started(h);
    fly(&mut whole, &mut method(), 3, 40);
    let mut part = started(h);
    fly(&mut part, &mut method(), 3, 17);
    let mut saved = part.clone();
    fly(&mut saved, &mut method(), 17, 40);
    assert_eq!(saved, whole);
}

#[test]
fn exact_failure_to_converge_is_an_error_with_its_numbers() {
    let h = 0.05;
    let mut past = started(h);
    let tight = Convergence {
        tolerance: 1e-30,
        max_passes: 7,
        relaxation: 1.0,
    };
    let before = past.clone();
    let stiff = |y: &[f64], dy: &mut [f64]| {
        dy[0] = -1e3 * y[0]; // 3/8 h 1e3 = 19: the plain iteration diverges
        dy[1] = 0.0;
        Ok::<(), Infallible>(())
    };
    match Hamming::new(h, tight, vec![1.0; 2]).advance(&mut past, stiff) {
        Err(StepError::NotConverged(report)) => {
            assert_eq!(report.passes, 7);
            assert!(report.residual > 1.0);
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(past, before, "a failed step leaves the past alone");
}
