//! Gauss-Legendre quadrature.

/// Abscissas and weights of n points on (0, 1): roots of the Legendre polynomial by Newton.
pub(crate) fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut old, mut new) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (old, new) = (new, ((2.0 * k - 1.0) * x * new - (k - 1.0) * old) / k);
        }
        (new, n as f64 * (x * new - old) / (x * x - 1.0))
    };
    let root = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        (0..20).for_each(|_| x -= legendre(x).0 / legendre(x).1);
        x
    };
    let weight = |x: f64| 1.0 / ((1.0 - x * x) * legendre(x).1.powi(2));
    (0..n)
        .map(root)
        .map(|x| (0.5 * (1.0 - x), weight(x)))
        .collect()
}
