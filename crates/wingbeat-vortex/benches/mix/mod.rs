//! The instructions of the cut-off's kernel with all operands in registers: what bounds its rate.

use fearless_simd::{Simd, prelude::*};

/// New nodes looked at while the edges of as many before them are summed, as the kernel does.
const AHEAD: usize = 2;

/// `edges` evaluations at eight targets each, on a sheet: one new node for two edges.
#[inline(always)]
pub fn mix<S: Simd>(simd: S, start: f64, edges: usize) -> f64 {
    let zero = S::f64s::splat(simd, 0.0);
    let mut p = [S::f64s::splat(simd, start); 3];
    let mut sum = [zero; 3];
    let mut old = [[p[0], p[1], p[2], p[0] + 1.0]; 2];
    let mut nodes = [old[0]; AHEAD];
    for _ in 0..edges * 8 / S::f64s::LEN / (2 * AHEAD) {
        let mut next = nodes;
        for node in &mut next {
            p = [p[0] + 1e-6, p[1] + 2e-6, p[2] - 1e-6];
            let (x, y, z) = (p[0] - 0.7, p[1] - 0.6, p[2] - 0.5);
            *node = [x, y, z, (x * x + y * y + z * z).sqrt()];
        }
        for new in nodes {
            for [x1, y1, z1, n1] in old {
                let [x2, y2, z2, n2] = new;
                let c = [y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2];
                let t = n1 + n2;
                let den = n1 * n2 * (t * t - 0.3) + 1e-4;
                let k = den.simd_gt(zero).select(t * 0.08 / den, zero);
                for i in 0..3 {
                    sum[i] += c[i] * k;
                }
            }
            old = [old[1], new];
        }
        nodes = next;
    }
    (sum[0] + sum[1] + sum[2]).as_slice()[0]
}
