//! What backward differences make of undamped vibrations, fast ones beside the step too.

use std::convert::Infallible;

use wingbeat_math::ode::{Bdf, Convergence, Multistep};

const CONVERGENCE: Convergence = Convergence {
    tolerance: 1e-11,
    max_passes: 60,
    relaxation: 1.0,
    accelerated_from: Some(1),
};

/// Growth per step of an undamped vibration of the angular frequency `w` per step.
fn growth_of_a_vibration(mut method: Bdf, w: f64) -> f64 {
    let at = |k: i32| [(w * f64::from(k)).cos(), -w * (w * f64::from(k)).sin()];
    let rates = |y: &[f64], dy: &mut [f64]| {
        (dy[0], dy[1]) = (y[1], -w * w * y[0]);
        Ok::<(), Infallible>(())
    };
    let mut past = Multistep::from_start(
        std::array::from_fn(|k| at(k as i32).to_vec()),
        std::array::from_fn(|k| {
            let mut dy = vec![0.0; 2];
            rates(&at(k as i32), &mut dy).expect("rates");
            dy
        }),
    );
    let size = |past: &Multistep| past.newest()[0].hypot(past.newest()[1] / w);
    method.scales = vec![1.0, w];
    let mut grown = 0.0;
    for step in 0..80 {
        method.advance(&mut past, rates).expect("a step");
        let now = size(&past);
        // Linear: of one size again, far above what passes leave.
        let all = past.y.iter_mut().chain(&mut past.f).flatten();
        all.for_each(|x| *x /= now);
        grown += if step < 40 { 0.0 } else { now.ln() };
    }
    (grown / 40.0).exp()
}

/// Roots of the characteristic polynomial of `y' = i w y`: of order four 1.0137 and 1.1056 at 0.6 and 1. That of
/// order two damps all vibrations, the fastest as is asked.
#[test]
fn exact_growth_of_vibrations_by_bdf() {
    let method = Bdf::new(1.0, CONVERGENCE, vec![1.0; 2]);
    for (w, grows) in [(0.6, 1.0137418242), (1.0, 1.1055681762)] {
        let found = growth_of_a_vibration(method.clone(), w);
        // What passes leave; the other roots are gone after 40 steps.
        assert!((found - grows).abs() < 3e-10, "{w}: {found}");
    }
    for w in [0.1_f64, 0.3, 0.6, 1.0, 2.0, 10.0] {
        // (4 - 3 i w) z^2 - (6 - i w) z + 2 = 0: z (4 - 3 i w) = 3 - i w / 2 +- sqrt(1 - w^2 / 4 + 3 i w).
        let (re, size) = (1.0 - 0.25 * w * w, (1.0 - 0.25 * w * w).hypot(3.0 * w));
        let (p, q) = ((0.5 * (size + re)).sqrt(), (0.5 * (size - re)).sqrt());
        let root = |sign: f64| (3.0 + sign * p).hypot(sign * q - 0.5 * w) / 4.0_f64.hypot(3.0 * w);
        let expected = root(1.0).max(root(-1.0));
        let found = growth_of_a_vibration(method.clone().order_two(0.0), w);
        println!("{w}: {found} {expected}");
        assert!(
            (found - expected).abs() < 3e-10 && found < 1.0,
            "{w}: {found} {expected}"
        );
        let light = growth_of_a_vibration(method.clone().order_two(0.8), w);
        assert!(light < 1.0 && light > found, "{w}: {light}");
    }
    for rho in [0.0, 0.1, 0.5, 0.8] {
        let found = growth_of_a_vibration(method.clone().order_two(rho), 1e3);
        let expected = rho.max((1.0_f64 - 3.0 * rho).abs() / (3.0 - rho));
        println!("{rho}: {found} {expected}");
        // Of an infinitely fast vibration; 1.5e-4 is found at this one.
        assert!((found / expected - 1.0).abs() < 1e-3, "{rho}: {found}");
    }
}
