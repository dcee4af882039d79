//! Flutter of Goland's wing by frequencies: the first bending and the first torsion mode of the beam in strips
//! of plane flow with Theodorsen's function.

#[allow(dead_code, reason = "shared with the tests of strips")]
#[path = "../../../wingbeat-blade/tests/unsteady/functions.rs"]
mod functions;

pub use functions::theodorsen;
use std::f64::consts::PI;

pub type Complex = [f64; 2];

pub fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

pub fn sum(terms: &[Complex]) -> Complex {
    terms
        .iter()
        .fold([0.0; 2], |s, t| [s[0] + t[0], s[1] + t[1]])
}

pub fn scaled(k: f64, a: Complex) -> Complex {
    [k * a[0], k * a[1]]
}

const SPAN: f64 = 6.096;
const HALF: f64 = 0.9144;
/// Flexure axis behind mid chord, in half chords; mass axis behind the flexure axis \[m\].
const A: f64 = -0.34;
const OFFSET: f64 = 0.18288;
const RHO: f64 = 1.225;
const MASS: f64 = 35.71;
const INERTIA: f64 = 8.643;
const EI: f64 = 9.77e6;
const GJ: f64 = 0.987e6;
const ROOT: f64 = 1.875_104_068_711_961;

/// Shapes of bending and torsion at the part `x` of the span.
fn shapes(x: f64) -> [f64; 2] {
    let s = (ROOT.cosh() + ROOT.cos()) / (ROOT.sinh() + ROOT.sin());
    let z = ROOT * x;
    [
        z.cosh() - z.cos() - s * (z.sinh() - z.sin()),
        (0.5 * PI * x).sin(),
    ]
}

/// Integral over the span of the product of two shapes, by Simpson's rule.
fn product(i: usize, j: usize) -> f64 {
    const N: usize = 200;
    let term = |k: usize| {
        let weight = match k {
            0 | N => 1.0,
            _ if k % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let w = shapes(k as f64 / N as f64);
        weight * w[i] * w[j]
    };
    (0..=N).map(term).sum::<f64>() * SPAN / (3 * N) as f64
}

/// Determinant of the equations of harmonic motion at this speed and frequency, scaled.
fn determinant([speed, w]: [f64; 2], [ww, wt, tt]: [f64; 3]) -> Complex {
    let (s, b) = ([0.0, w], HALF);
    let (square, c) = ([-w * w, 0.0], theodorsen(w * b / speed));
    let apparent = PI * RHO * b * b;
    let lagging = |x: Complex| scaled(2.0 * PI * RHO * speed * b, times(c, x));
    // Downwash at three quarters of the chord of a plunge, of a turn.
    let turn = sum(&[[speed, 0.0], scaled(b * (0.5 - A), s)]);
    let lift = [
        sum(&[scaled(apparent, square), lagging(s)]),
        sum(&[
            scaled(apparent * speed, s),
            scaled(-apparent * b * A, square),
            lagging(turn),
        ]),
    ];
    let moment = [
        sum(&[
            scaled(apparent * b * A, square),
            scaled(b * (A + 0.5), lagging(s)),
        ]),
        sum(&[
            scaled(-apparent * speed * b * (0.5 - A), s),
            scaled(-apparent * b * b * (0.125 + A * A), square),
            scaled(b * (A + 0.5), lagging(turn)),
        ]),
    ];
    let stiff = [
        EI * (ROOT / SPAN).powi(4) * ww,
        GJ * (0.5 * PI / SPAN).powi(2) * tt,
    ];
    let entry = |k: f64, m: f64, air: Complex| sum(&[[k, 0.0], scaled(m, square), air]);
    let d = [
        entry(stiff[0], MASS * ww, scaled(ww, lift[0])),
        entry(0.0, MASS * OFFSET * wt, scaled(wt, lift[1])),
        entry(0.0, MASS * OFFSET * wt, scaled(-wt, moment[0])),
        entry(stiff[1], INERTIA * tt, scaled(-tt, moment[1])),
    ];
    let both = sum(&[times(d[0], d[3]), scaled(-1.0, times(d[1], d[2]))]);
    scaled(1.0 / (stiff[0] * stiff[1]), both)
}

/// Speed \[m/s\] and angular frequency \[rad/s\] of flutter, by Newton's method.
pub fn goland() -> [f64; 2] {
    let integrals = [product(0, 0), product(0, 1), product(1, 1)];
    let mut x = [135.0, 70.0];
    for _ in 0..30 {
        let at = |k: usize, by: f64| {
            let mut y = x;
            y[k] += by;
            determinant(y, integrals)
        };
        let f = determinant(x, integrals);
        let slope = [0, 1].map(|k| {
            let [a, b] = [at(k, 1e-4), at(k, -1e-4)];
            [(a[0] - b[0]) / 2e-4, (a[1] - b[1]) / 2e-4]
        });
        let size = slope[0][0] * slope[1][1] - slope[1][0] * slope[0][1];
        x[0] -= (f[0] * slope[1][1] - f[1] * slope[1][0]) / size;
        x[1] -= (f[1] * slope[0][0] - f[0] * slope[0][1]) / size;
    }
    x
}
