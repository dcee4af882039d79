//! Orders and restart of the integrators on problems with closed solutions.

use std::convert::Infallible;
use std::ops::Range;

use wingbeat_math::ode::{
    AdamsBashforthMoulton, AdaptiveError, Asked, Bdf, Convergence, Dop853, Hamming, Memoryless,
    Multistep, Replay, Rk4, StepError, Tolerance, block_start,
};

const CONVERGENCE: Convergence = Convergence {
    tolerance: 1e-13,
    max_passes: 60,
    relaxation: 1.0,
    accelerated_from: None,
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
            accelerated_from: None,
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
fn order_quadrature_that_rides_along_is_as_accurate_as_the_state() {
    // y' = cos t with the quadrature z' = y: z = 1 - cos t. In corrector passes the rate of z is asked
    // for by nobody; what stands there must not matter.
    let slope = slopes(|steps| {
        let h = 2.0 / steps as f64;
        let start = [0, 1, 2, 3].map(|k| f64::from(k) * h);
        let mut past = Multistep::from_start(
            start.map(|t| vec![t.sin(), 1.0 - t.cos()]),
            start.map(|t| vec![t.cos(), t.sin()]),
        );
        let mut method =
            Hamming::new(h, CONVERGENCE, vec![1.0, f64::INFINITY]).followed_by(vec![1]);
        for n in 4..=steps {
            let t = n as f64 * h;
            let rates = |asked, y: &[f64], dy: &mut [f64]| {
                dy[0] = t.cos();
                dy[1] = match asked {
                    Asked::Accepted => y[0],
                    Asked::Pass => 1e9,
                };
                Ok::<(), Infallible>(())
            };
            method.advance_asking(&mut past, rates).expect("a step");
        }
        (past.newest()[1] - (1.0 - 2.0_f64.cos())).abs()
    });
    // The modifiers cancel the leading error term.
    assert!(slope.iter().all(|s| (3.8..5.5).contains(s)), "{slope:?}");
}

#[test]
fn exact_failure_to_converge_is_an_error_with_its_numbers() {
    let h = 0.05;
    let mut past = started(h);
    let tight = Convergence {
        tolerance: 1e-30,
        max_passes: 7,
        relaxation: 1.0,
        accelerated_from: None,
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

#[test]
fn order_adams_bashforth_moulton_is_four() {
    let s = slopes(|n| {
        let h = 2.0 / n as f64;
        let (mut past, mut abm) = (started(h), AdamsBashforthMoulton::new(h, 2));
        for k in 3..n {
            let t = (k + 1) as f64 * h;
            abm.advance(&mut past, |y, dy| {
                rates(t, y, dy);
                Ok::<(), Infallible>(())
            })
            .expect("a step");
        }
        error(past.newest(), 2.0)
    });
    assert!((s[1] - 4.0).abs() < 0.3, "slopes {s:?}");
}

fn dop853(tolerance: f64) -> Dop853 {
    let tolerance = Tolerance {
        relative: tolerance,
        absolute: tolerance,
        max_steps: 1000,
    };
    Dop853::new(tolerance, vec![1.0; 2])
}

fn smooth(t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Infallible> {
    rates(t, y, dy);
    Ok(())
}

#[test]
fn order_dop853_is_eight() {
    let e = [4, 8, 16].map(|n| {
        // A tolerance of the size of the solution accepts every step; one that is too long is cut to the interval.
        let (mut y, h, mut method) = (exact(0.0), 4.0 / n as f64, dop853(1.0).starting_with(2.0));
        for k in 0..n {
            let ends = (k as f64 * h, (k + 1) as f64 * h);
            let report = method.integrate(ends, &mut y, smooth).expect("a step");
            assert_eq!([report.accepted, report.rejected], [1, 0]);
        }
        error(&y, 4.0)
    });
    let s = [(e[0] / e[1]).log2(), (e[1] / e[2]).log2()];
    println!("dop853: errors {e:?}, slopes {s:?}");
    // The leading error term is small here: the slope is above eight until the steps are short.
    assert!(s[0] > 7.5 && s[1] > 7.5 && s[1] < 9.5, "slopes {s:?}");
}

#[test]
fn exact_adaptive_steps_keep_to_the_tolerance() {
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let mut y = exact(0.0);
        let report = dop853(tolerance)
            .integrate((0.0, 10.0), &mut y, smooth)
            .expect("a smooth problem");
        let end = error(&y, 10.0);
        println!("tolerance {tolerance:.0e}: {report:?}, end {end:.1e}");
        // The errors of 17 to 60 steps, each grown by up to e^3 (the term 0.3 y).
        assert!(end < 300.0 * tolerance);
    }
}

#[test]
fn exact_adaptive_steps_stop_at_a_pole_and_at_the_limit_of_steps() {
    let pole = |_: f64, y: &[f64], dy: &mut [f64]| {
        (dy[0], dy[1]) = (y[0] * y[0], 0.0); // y = 1 / (1 - t)
        Ok::<(), Infallible>(())
    };
    let end = dop853(1e-9).integrate((0.0, 2.0), &mut [1.0, 0.0], pole);
    match end {
        Err(AdaptiveError::StepTooSmall { time, .. } | AdaptiveError::TooManySteps { time }) => {
            assert!((time - 1.0).abs() < 1e-3);
        }
        other => panic!("{other:?}"),
    }
}

/// `y' = -sqrt(y)` from 1 has the solution `(1 - t/2)^2`, which never falls below zero; trial states
/// of long steps do, and there the right-hand side has no value.
#[test]
fn exact_order_eight_shortens_steps_whose_trial_states_have_no_rate() {
    let root = |_: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = -y[0].sqrt();
        if y[0] < 0.0 {
            Err("below zero")
        } else {
            Ok(())
        }
    };
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: 1e-10,
        max_steps: 1000,
    };
    let method = || Dop853::new(tolerance, vec![1.0]).starting_with(1.0);
    let (mut y, end) = ([1.0], 1.9);
    let report = method().integrate((0.0, end), &mut y, root);
    let error = (y[0] - (1.0 - 0.5 * end).powi(2)).abs();
    println!("{report:?}, error {error:.1e}");
    assert!(report.is_ok_and(|r| r.rejected > 0) && error < 1e-9);
    // Beyond the end of the solution there is nothing; the error is the right-hand side's own.
    let beyond = |t: f64, _: &[f64], dy: &mut [f64]| {
        dy[0] = 1.0;
        if t > 1.0 { Err("too late") } else { Ok(()) }
    };
    let failed = method().integrate((0.0, 2.0), &mut [0.0], beyond);
    assert_eq!(failed, Err(AdaptiveError::Rates("too late")));
}

#[test]
fn order_bdf_is_four_or_two() {
    order_of_bdf("four", |method| method, 3.9..4.3);
    order_of_bdf("two", |method| method.order_two(0.8), 1.9..2.2);
}

fn order_of_bdf(name: &str, of: fn(Bdf) -> Bdf, expected: Range<f64>) {
    let error = |steps: usize| {
        let h = 2.0 / steps as f64;
        let mut past = started(h);
        let mut method = of(Bdf::new(h, CONVERGENCE, vec![1.0; 2]));
        for n in 3..steps {
            let t = (n + 1) as f64 * h;
            let f = |y: &[f64], dy: &mut [f64]| {
                rates(t, y, dy);
                Ok::<(), Infallible>(())
            };
            method.advance(&mut past, f).expect("a step");
        }
        self::error(past.newest(), 2.0)
    };
    let s = slopes(error);
    println!("BDF of order {name}: {s:.2?}");
    assert!(s.iter().all(|s| expected.contains(s)), "{s:?}");
}

/// A history that answers to every sweep: rates of 1 and 1 + jump by turns.
struct Jumping {
    sweeps: u32,
    jump: f64,
}

impl Replay for Jumping {
    type Error = Infallible;

    fn enter(&mut self, k: usize) -> Result<(), Infallible> {
        self.sweeps += u32::from(k == 1);
        Ok(())
    }

    fn rates(&mut self, _: usize, _: &[f64], f: &mut [f64]) -> Result<(), Infallible> {
        f[0] = 1.0 + self.jump * f64::from(self.sweeps % 2);
        Ok(())
    }

    fn leave(&mut self, _: usize) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Starting steps that jump from sweep to sweep say by how much: of constant rates the third state by the step times the
/// jump times 3. What is no number is an error.
#[test]
fn exact_residual_of_a_start_that_does_not_converge() {
    let h = 0.01;
    let start = |jump: f64| {
        let mut replay = Jumping { sweeps: 0, jump };
        block_start(&[0.0], &[1.0], h, CONVERGENCE, &[1.0], &mut replay)
    };
    let report = start(1e-3).unwrap().1;
    // The rate at the start, 1, is in all formulas, with 3/8 of a step in the last.
    let expected = 1e-3 * h * (3.0 - 3.0 / 8.0);
    assert!(
        (report.residual / expected - 1.0).abs() < 1e-9,
        "{report:?} {expected:e}"
    );
    assert!(start(0.0).unwrap().1.residual <= CONVERGENCE.tolerance);
    let never = start(f64::NAN);
    assert!(
        matches!(never, Err(StepError::NotConverged(_))),
        "{never:?}"
    );
}
