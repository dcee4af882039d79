//! Cardinal B-splines of order six: what carries sources to a mesh and its values to targets.

/// Order of the splines, and the nodes that each reaches.
pub(crate) const ORDER: usize = 6;

/// A spline is the sum over k of `REFINE[k]` times the spline of half its width at 2 i + k - 3, if it stands at i.
pub(crate) const REFINE: [f32; ORDER + 1] = [
    1.0 / 32.0,
    6.0 / 32.0,
    15.0 / 32.0,
    20.0 / 32.0,
    15.0 / 32.0,
    6.0 / 32.0,
    1.0 / 32.0,
];

/// The spline of order 12 at 0 to 5: what two of order six give together, one spreading, one gathering. In
/// parts of 11!.
const TWICE: [f64; ORDER] = [
    15_724_248.0,
    9_738_114.0,
    2_203_488.0,
    152_637.0,
    2_036.0,
    1.0,
];

/// Values at u of the splines at floor(u) - 2 to floor(u) + 3, for `f` = u - floor(u).
pub(crate) fn weights(f: f64) -> [f32; ORDER] {
    // With M_n(x) the spline on [0, n], M_n(f + j) for all j, from n = 2 on.
    let mut m = [0.0; ORDER];
    (m[0], m[1]) = (f, 1.0 - f);
    for n in 3..=ORDER {
        let inverse = 1.0 / (n - 1) as f64;
        for j in (0..n).rev() {
            let x = f + j as f64;
            let below = if j > 0 {
                (n as f64 - x) * m[j - 1]
            } else {
                0.0
            };
            m[j] = (x * m[j] + below) * inverse;
        }
    }
    std::array::from_fn(|k| m[ORDER - 1 - k] as f32)
}

/// What spreading and gathering do together to a wave of this phase \[rad\] from node to node.
pub(crate) fn transfer(phase: f64) -> f64 {
    const FACTORIAL: f64 = 39_916_800.0;
    let sum: f64 = (1..ORDER)
        .map(|j| TWICE[j] * (j as f64 * phase).cos())
        .sum();
    (TWICE[0] + 2.0 * sum) / FACTORIAL
}

#[cfg(test)]
mod tests {
    use super::*;

    /// B-splines add up to one and reproduce straight lines; rounding of single precision.
    #[test]
    fn exact_partition_of_unity_and_first_moment() {
        for f in [0.0, 0.1, 0.5, 0.93] {
            let w = weights(f).map(f64::from);
            let moment: f64 = w
                .iter()
                .enumerate()
                .map(|(k, w)| (k as f64 - 2.0) * w)
                .sum();
            assert!((w.iter().sum::<f64>() - 1.0).abs() < 2e-7);
            assert!((moment - f).abs() < 4e-7);
        }
    }

    /// The relation of two scales, term by term, at some places between nodes.
    #[test]
    fn exact_refinement() {
        let spline = |x: f64| {
            let u = x.floor();
            let k = 2.0 - u; // the spline at node 0 as seen from floor(u)
            if (0.0..6.0).contains(&k) {
                f64::from(weights(x - u)[k as usize])
            } else {
                0.0
            }
        };
        for x in [-2.7, -1.2, 0.0, 0.3, 1.9] {
            let fine = (0..7).map(|k| f64::from(REFINE[k]) * spline(2.0 * x - (k as f64 - 3.0)));
            assert!((fine.sum::<f64>() - spline(x)).abs() < 2e-7, "{x}");
        }
    }

    /// The spline of twice the order at whole numbers is the convolution of two: their sums over nodes agree with
    /// the integral, here by the mean over many offsets.
    #[test]
    fn agrees_transfer_with_the_mean_of_spreading_and_gathering() {
        let phase = 0.9_f64;
        let count = 400;
        let mean = (0..count).map(|i| {
            let f = (f64::from(i) + 0.5) / f64::from(count);
            let w = weights(f).map(f64::from);
            let at = |k: usize| (k as f64 - 2.0 - f) * phase;
            let (c, s): (f64, f64) = (0..6).fold((0.0, 0.0), |(c, s), k| {
                (c + w[k] * at(k).cos(), s + w[k] * at(k).sin())
            });
            c * c + s * s
        });
        let mean = mean.sum::<f64>() / f64::from(count);
        assert!((mean - transfer(phase)).abs() < 1e-6);
    }
}
