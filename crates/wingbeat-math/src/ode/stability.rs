//! How much of a motion that dies out by itself is left from step to step.
//!
//! Of `y' = lambda y` in equal steps h each method leaves powers of the roots of a polynomial whose
//! coefficients depend on `z = lambda h` alone [Hairer & Wanner, Solving ODEs II, sec. V.1]: the largest root
//! is the growth a step.
//!
//! ```text
//! hamming      r^4 = 112/121 ((9 + 6 z) r^3 - 3 z r^2 - r) / (8 - 3 z) + 9/121 (1 + 4 z/3 (2 r^3 - r^2 + 2 r))
//! bdf          (25 - 12 z) r^4 = 48 r^3 - 36 r^2 + 16 r - 3
//! adams        r^4 = r^3 + z/24 (9 P(r) + 19 r^3 - 5 r^2 + r),  P = r^3 + z/24 (55 r^3 - 59 r^2 + 37 r - 9)
//! runge_kutta  r   = 1 + z + z^2/2 + z^3/6 + z^4/24
//! ```
//!
//! Correctors are repeated until they agree, but for that of Adams, which is evaluated once.

use faer::c64;

/// A method of equal steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EqualSteps {
    /// [`super::Hamming`].
    Hamming,
    /// [`super::Bdf`] of order four.
    Bdf,
    /// [`super::AdamsBashforthMoulton`].
    Adams,
    /// [`super::Rk4`].
    RungeKutta,
}

impl EqualSteps {
    /// Largest growth in a step of h \[s\] of a vibration `y'' + damping y' + stiffness y = 0` \[1\], its
    /// `damping` \[1/s\] and `stiffness` \[1/s^2\] over the inertia. What is more than 1 grows.
    pub fn growth(self, [damping, stiffness]: [f64; 2], h: f64) -> f64 {
        let (half, square) = (0.5 * damping * h, stiffness * h * h);
        let under = half * half - square;
        let roots = match under >= 0.0 {
            // Of two real roots the sum of equal signs is exact, and the other is their product over it.
            true => {
                let far = -half - under.sqrt();
                let near = if far == 0.0 { 0.0 } else { square / far };
                [c64::new(far, 0.0), c64::new(near, 0.0)]
            }
            false => [1.0, -1.0].map(|sign| c64::new(-half, sign * (-under).sqrt())),
        };
        crate::numbers::extremes::largest(roots.map(|z| self.root(z)))
    }

    /// Size of the largest root at `z` \[1\].
    fn root(self, z: c64) -> f64 {
        let real = |x: f64| c64::new(x, 0.0);
        let [one, zero] = [real(1.0), real(0.0)];
        match self {
            Self::RungeKutta => {
                let inner = one + z * real(0.25);
                let inner = one + z * inner * real(1.0 / 3.0);
                (one + z * (one + z * inner * real(0.5))).norm()
            }
            Self::Bdf => {
                let lead = real(25.0) - real(12.0) * z;
                largest_root([48.0, -36.0, 16.0, -3.0].map(|a| real(a) * lead.inv()))
            }
            Self::Adams => {
                let part = z * real(1.0 / 24.0);
                let predicted = [55.0, -59.0, 37.0, -9.0].map(|a| part * real(a));
                let predicted = [one + predicted[0], predicted[1], predicted[2], predicted[3]];
                let known = [19.0, -5.0, 1.0, 0.0].map(real);
                let whole = [one, zero, zero, zero];
                largest_root(std::array::from_fn(|k| {
                    whole[k] + part * (real(9.0) * predicted[k] + known[k])
                }))
            }
            Self::Hamming => {
                let lead = (real(8.0) - real(3.0) * z).inv() * real(112.0 / 121.0);
                let corrected = [real(9.0) + real(6.0) * z, -(real(3.0) * z), -one, zero];
                let ahead = z * real(4.0 / 3.0 * 9.0 / 121.0);
                let predicted = [
                    real(2.0) * ahead,
                    -ahead,
                    real(2.0) * ahead,
                    real(9.0 / 121.0),
                ];
                largest_root(std::array::from_fn(|k| lead * corrected[k] + predicted[k]))
            }
        }
    }
}

/// Passes after which the roots do not change any more.
const PASSES: usize = 200;

/// Size of the largest root of `r^4 = a[0] r^3 + a[1] r^2 + a[2] r + a[3]` [Durand 1960; Kerner 1966].
fn largest_root(a: [c64; 4]) -> f64 {
    let residual = |r: c64| {
        let known = (a.iter()).fold(c64::new(0.0, 0.0), |sum, coefficient| {
            sum * r + *coefficient
        });
        r * r * r * r - known
    };
    let bound = 1.0 + crate::numbers::extremes::largest(a.map(c64::norm));
    let mut roots: [c64; 4] = std::array::from_fn(|k| {
        let angle = 0.4 + 1.6 * k as f64;
        c64::new(bound * angle.cos(), bound * angle.sin())
    });
    for _ in 0..PASSES {
        for k in 0..4 {
            let others = (0..4).filter(|j| *j != k);
            let apart = others.fold(c64::new(1.0, 0.0), |p, j| p * (roots[k] - roots[j]));
            if apart.norm() > 0.0 {
                roots[k] = roots[k] - residual(roots[k]) * apart.inv();
            }
        }
    }
    crate::numbers::extremes::largest(roots.map(c64::norm))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ode::{AdamsBashforthMoulton, Bdf, Convergence, Hamming, Multistep, Rk4};

    const ALL: [EqualSteps; 4] = [
        EqualSteps::Hamming,
        EqualSteps::Bdf,
        EqualSteps::Adams,
        EqualSteps::RungeKutta,
    ];

    #[test]
    fn exact_a_vibration_at_the_limit_of_runge_kutta_keeps_its_size() {
        // |1 + z + z^2/2 + z^3/6 + z^4/24| = 1 on the imaginary axis at 2 sqrt 2.
        let growth = EqualSteps::RungeKutta.growth([0.0, 8.0], 1.0);
        assert!((growth - 1.0).abs() < 1e-14, "{growth}"); // rounding
    }

    #[test]
    fn exact_hamming_alternates_from_the_root_of_its_polynomial_on() {
        // r = -1 in the polynomial above: 180 z^2 - 1152 z - 1792 = 0.
        let limit = (2_617_344.0_f64.sqrt() - 1152.0) / 360.0;
        let at = |share: f64| EqualSteps::Hamming.growth([share * limit, 0.0], 1.0);
        assert!((at(1.0) - 1.0).abs() < 1e-12, "{}", at(1.0)); // rounding of a root
        assert!(at(1.001) > 1.0 && at(0.999) < 1.0 + 1e-12);
    }

    #[test]
    fn agrees_with_steps_of_the_methods_themselves() {
        for method in ALL {
            for both in [[0.0, 0.36], [0.0, 1.0], [0.3, 1.5], [3.2, 0.2], [1.0, 6.0]] {
                let [known, flown] = [method.growth(both, 1.0), flown(method, both)];
                // A vibration comes back to a size that differs by a factor of up to 3: over 4000 steps 3e-4.
                let error = (known / flown - 1.0).abs();
                assert!(error < 1e-3, "{method:?} {both:?}: {known} and {flown}");
            }
        }
    }

    /// Growth a step of `y'' + damping y' + stiffness y = 0` in steps of 1 s, after 1000 of them over 4000.
    fn flown(method: EqualSteps, [damping, stiffness]: [f64; 2]) -> f64 {
        let rates = |y: &[f64], dy: &mut [f64]| -> Result<(), ()> {
            (dy[0], dy[1]) = (y[1], -damping * y[1] - stiffness * y[0]);
            Ok(())
        };
        let convergence = Convergence {
            tolerance: 1e-13,
            max_passes: 1000,
            relaxation: 1.0,
            accelerated_from: Some(1),
        };
        let (y, mut f) = (vec![0.3, 1.0], vec![0.0; 2]);
        rates(&y, &mut f).expect("rates");
        let mut past = Multistep::from_start(
            std::array::from_fn(|_| y.clone()),
            std::array::from_fn(|_| f.clone()),
        );
        let mut hamming = Hamming::new(1.0, convergence, vec![1.0; 2]);
        let mut bdf = Bdf::new(1.0, convergence, vec![1.0; 2]);
        let (mut adams, mut one) = (AdamsBashforthMoulton::new(1.0, 2), Rk4::new(2));
        let mut growth = 0.0;
        for step in 0..5000 {
            match method {
                EqualSteps::Hamming => drop(hamming.advance(&mut past, rates).expect("converges")),
                EqualSteps::Bdf => drop(bdf.advance(&mut past, rates).expect("converges")),
                EqualSteps::Adams => adams.advance(&mut past, rates).expect("rates"),
                EqualSteps::RungeKutta => {
                    let (mut y, mut f) = (past.newest().to_vec(), vec![0.0; 2]);
                    one.advance(0.0, 1.0, &mut y, |_, y, dy| rates(y, dy))
                        .expect("rates");
                    rates(&y, &mut f).expect("rates");
                    past.push(&y, &f);
                }
            }
            let size = past.y.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
            if step >= 1000 {
                growth += size.ln() / 4000.0;
            }
            // The equation is linear: all sizes are brought back to 1.
            let all = past.y.iter_mut().chain(&mut past.f);
            let all = all.chain([&mut past.predicted_minus_corrected]);
            all.flatten().for_each(|x| *x /= size);
            past.shown.clear();
        }
        growth.exp()
    }
}
