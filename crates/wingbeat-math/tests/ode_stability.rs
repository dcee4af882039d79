//! Where the integrators are stable: on both axes, and under added mass.

use std::convert::Infallible;

use wingbeat_math::ode::{Bdf, Convergence, Hamming, Multistep, StepError};

const CONVERGENCE: Convergence = Convergence {
    tolerance: 1e-13,
    max_passes: 60,
    relaxation: 1.0,
    accelerated_from: None,
};

/// Largest growth factor per step of Hamming's method with `passes` passes on `y' = z y / h`, from
/// a long run: the method is linear, so the ratio of late values is the dominant root.
fn growth(z: [f64; 2], passes: usize) -> f64 {
    let convergence = Convergence {
        tolerance: 0.0,
        max_passes: passes,
        relaxation: 1.0,
        accelerated_from: None,
    };
    let f = |y: &[f64], dy: &mut [f64]| {
        dy[0] = z[0] * y[0] - z[1] * y[1];
        dy[1] = z[1] * y[0] + z[0] * y[1];
        Ok::<(), Infallible>(())
    };
    // A start with a share of every mode; only the dominant one survives.
    let y = [[1.0, 0.0], [-0.4, 0.3], [0.8, -0.5], [-0.9, 0.7]].map(|y| y.to_vec());
    let rates = y.clone().map(|y| {
        let mut dy = vec![0.0; 2];
        f(&y, &mut dy).expect("a linear rate");
        dy
    });
    let mut past = Multistep::from_start(y, rates);
    let mut method = Hamming::new(1.0, convergence, vec![1.0; 2]);
    // Several modes may beat against each other: the largest value of a window counts.
    let (window, early, late) = (200, 2_000, 30_000);
    let (mut first, mut last) = (0.0_f64, 0.0_f64);
    for n in 0..late {
        if method.advance(&mut past, f).is_err() {
            return f64::INFINITY; // overflow
        }
        let size = past.newest()[0].hypot(past.newest()[1]);
        if (early..early + window).contains(&n) {
            first = first.max(size);
        }
        if n >= late - window {
            last = last.max(size);
        }
    }
    (last / first).powf(1.0 / f64::from(late - early - window))
}

#[test]
fn limit_of_hammings_stability_on_both_axes() {
    // |lambda h| at which the dominant root leaves the unit circle, by bisection, against the
    // published limits (two digits).
    let limit = |direction: [f64; 2], passes: usize| {
        let (mut stable, mut unstable) = (0.05, 2.5);
        for _ in 0..12 {
            let z = 0.5 * (stable + unstable);
            let g = growth([z * direction[0], z * direction[1]], passes);
            if g <= 1.0 + 1e-6 {
                stable = z
            } else {
                unstable = z
            }
        }
        stable
    };
    let real = [1, 2, 3].map(|p| limit([-1.0, 0.0], p));
    let imaginary = [1, 2, 3].map(|p| limit([0.0, 1.0], p));
    println!("real axis {real:.3?}, imaginary axis {imaginary:.3?}");
    for (found, known) in real.iter().zip([0.88, 0.72, 1.46]) {
        assert!((found - known).abs() < 0.02, "{real:?}");
    }
    for (found, known) in imaginary.iter().zip([0.28, 0.80, 1.08]) {
        assert!((found - known).abs() < 0.03, "{imaginary:?}"); // growth just beyond is weak
    }
}

/// A step of either method.
enum Implicit {
    Hamming(Hamming),
    Bdf(Bdf),
}

/// Growth per step of what alternates from step to step in `y' = -mu D y / h` of step h = 1, D the
/// backward difference of order `order`: a mass that carries `mu` times itself of air.
fn growth_under_added_mass(mut method: Implicit, mu: f64, order: usize) -> f64 {
    let mut past = Multistep::from_start(
        [1.0, -1.0, 1.0, -1.0].map(|y| vec![y]),
        std::array::from_fn(|_| vec![0.0]),
    );
    let mut size = |steps: usize| {
        let mut largest = 0.0_f64;
        for _ in 0..steps {
            let (y2, y3) = (past.y[2][0], past.y[3][0]);
            let f = |y: &[f64], dy: &mut [f64]| {
                dy[0] = match order {
                    1 => -mu * (y[0] - y3),
                    _ => -mu * (1.5 * y[0] - 2.0 * y3 + 0.5 * y2),
                };
                Ok::<(), Infallible>(())
            };
            let done = match &mut method {
                Implicit::Hamming(m) => m.advance(&mut past, f),
                Implicit::Bdf(m) => m.advance(&mut past, f),
            };
            done.expect("a step");
            largest = largest.max((past.newest()[0] - y3).abs());
        }
        largest
    };
    let (early, _, late) = (size(10), size(40), size(10));
    (late / early).powf(1.0 / 50.0)
}

/// Plain passes diverge from mu = 25 / 18; those that least squares speed up agree at once, in later steps by
/// what the first have shown.
#[test]
fn limit_accelerated_passes_agree_whatever_the_added_mass() {
    let convergence = Convergence {
        tolerance: 1e-12,
        accelerated_from: Some(1),
        ..CONVERGENCE
    };
    for mu in [0.1, 2.0, 10.0, 250.0] {
        let mut passes = vec![];
        let mut past = Multistep::from_start(
            [1.0, -1.0, 1.0, -1.0].map(|y| vec![y]),
            std::array::from_fn(|_| vec![0.0]),
        );
        let mut method = Bdf::new(1.0, convergence, vec![1.0]);
        for _ in 0..20 {
            let (y2, y3) = (past.y[2][0], past.y[3][0]);
            let f = |y: &[f64], dy: &mut [f64]| {
                dy[0] = -mu * (1.5 * y[0] - 2.0 * y3 + 0.5 * y2);
                Ok::<(), Infallible>(())
            };
            passes.push(method.advance(&mut past, f).expect("a step").passes);
        }
        println!("mu = {mu}: {passes:?} passes");
        assert!(
            passes[0] <= 4 && passes[1..].iter().all(|p| *p <= 3),
            "{mu}: {passes:?}"
        );
    }
    let mut past = Multistep::from_start(
        [1.0, -1.0, 1.0, -1.0].map(|y| vec![y]),
        std::array::from_fn(|_| vec![0.0]),
    );
    let plain = Bdf::new(1.0, CONVERGENCE, vec![1.0]).advance(&mut past, |y, dy| {
        dy[0] = -2.0 * 1.5 * y[0];
        Ok::<(), Infallible>(())
    });
    assert!(
        matches!(plain, Err(StepError::NotConverged(_))),
        "{plain:?}"
    );
}

#[test]
fn limit_of_stability_under_added_mass() {
    // Passes that converge for all added masses here, to a few roundings of the largest value.
    let convergence = Convergence {
        tolerance: 1e-12,
        max_passes: 3000,
        relaxation: 0.1,
        accelerated_from: None,
    };
    let hamming = |mu, order| {
        let method = Hamming::new(1.0, convergence, vec![1.0]);
        growth_under_added_mass(Implicit::Hamming(method), mu, order)
    };
    // Roots of the characteristic polynomials: 0.3587 and 0.7010.
    for (order, limit) in [(2, 0.3587), (1, 0.7010)] {
        let [below, above] = [0.99, 1.01].map(|part| hamming(part * limit, order));
        println!("Hamming, order {order}: growth {below:.3} below, {above:.3} above");
        assert!(below < 1.0 && above > 1.0);
        for mu in [0.1, 0.5, 1.0, 2.0, 10.0] {
            let method = Bdf::new(1.0, convergence, vec![1.0]);
            let growth = growth_under_added_mass(Implicit::Bdf(method), mu, order);
            assert!(growth < 1.0, "BDF, order {order}, {mu}: {growth}");
        }
    }
}
