//! Functions of unsteady thin-airfoil theory.

use std::f64::consts::PI;

/// Wagner's function by its integral over modified Bessel functions [Wagner 1925; numbers by quadrature].
pub const WAGNER: [(f64, f64); 9] = [
    (0.0, 0.5),
    (0.5, 0.55566),
    (1.0, 0.60061),
    (2.0, 0.66929),
    (4.0, 0.75797),
    (8.0, 0.84913),
    (16.0, 0.92014),
    (32.0, 0.96196),
    (64.0, 0.98228),
];

/// Kuessner's function from Sears' function about the leading edge [von Karman & Sears 1938; numbers by quadrature].
pub const KUESSNER: [(f64, f64); 8] = [
    (0.5, 0.3058),
    (1.0, 0.4167),
    (2.0, 0.5508),
    (4.0, 0.6945),
    (6.0, 0.7731),
    (8.0, 0.8226),
    (16.0, 0.9118),
    (32.0, 0.9599),
];

/// Theodorsen's function `H1 / (H1 + i H0)` of Hankel functions of the second kind, real and imaginary part;
/// for k up to 3.
pub fn theodorsen(k: f64) -> [f64; 2] {
    let [j0, j1, y0, y1] = bessel(k);
    // H = J - i Y; H1 + i H0 = (J1 + Y0) + i (J0 - Y1).
    let (a, b) = (j1 + y0, j0 - y1);
    let size = a * a + b * b;
    [(j1 * a - y1 * b) / size, -(j1 * b + y1 * a) / size]
}

/// J0, J1, Y0, Y1 by their series [Abramowitz & Stegun 9.1.10 to 9.1.13].
fn bessel(x: f64) -> [f64; 4] {
    const EULER: f64 = 0.577_215_664_901_532_9;
    let (q, log) = (0.25 * x * x, (0.5 * x).ln() + EULER);
    let (mut term, mut harmonic) = (1.0, 0.0);
    let [mut j0, mut j1, mut s0, mut s1] = [0.0; 4];
    for m in 0..30_i32 {
        let n = f64::from(m);
        if m > 0 {
            term *= -q / (n * n);
            harmonic += 1.0 / n;
        }
        j0 += term;
        j1 += 0.5 * x * term / (n + 1.0);
        s0 += harmonic * term;
        s1 += 0.5 * x * term / (n + 1.0) * (2.0 * harmonic + 1.0 / (n + 1.0));
    }
    let y0 = 2.0 / PI * (log * j0 - s0);
    let y1 = 2.0 / PI * (log * j1 - 1.0 / x) - s1 / PI;
    [j0, j1, y0, y1]
}
