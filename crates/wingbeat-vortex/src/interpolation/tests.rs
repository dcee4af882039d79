//! Evidence for the steps of the interpolation.

use crate::cores::exp2::exp_minus;
use crate::instruction_set::InstructionSet;
use crate::interpolation::gaussians::{GAUSSIANS, RANGE};
use crate::interpolation::grid::{Frame, Grid, Place, Room, VALUES};
use crate::interpolation::translate::{self, Received};
use glam::DVec3;

const NEAR: Frame = Frame {
    middle: [0.3, -0.2, 0.1, 0.4],
    half: [0.5, 0.4, 0.3, 0.1],
};
const AWAY: Frame = Frame {
    middle: [1.9, 0.7, -0.6, 0.7],
    half: [0.3, 0.5, 0.4, 0.2],
};

/// Places in a box, from -1 to 1 in each direction.
fn inside(frame: &Frame, k: usize) -> Place {
    std::array::from_fn(|d| {
        let part = (1.7 * k as f64 + 2.3 * d as f64 + 0.4 * (k * d) as f64).sin();
        frame.middle[d] + part * frame.half[d]
    })
}

fn kernel(p: Place, y: Place) -> f64 {
    let r2: f64 = (0..3).map(|d| (p[d] - y[d]).powi(2)).sum();
    (r2 + p[3] + y[3]).powf(-1.5)
}

#[test]
fn exact_gaussians_are_the_kernel_within_their_range() {
    for k in 0..=200 {
        let x = RANGE.powf(f64::from(k) / 200.0);
        let sum: f64 = GAUSSIANS.iter().map(|(t, w)| w * (-t * x).exp()).sum();
        // The fit: 4.9e-4 at both ends.
        assert!((sum * x.powf(1.5) - 1.0).abs() < 5.2e-4, "{x}: {sum}");
    }
}

#[test]
fn exact_exponential_to_the_digits_of_single_precision() {
    for k in 0..2000 {
        let x = 0.04 * k as f32;
        let (exact, own) = (f64::from(-x).exp(), f64::from(exp_minus(x)));
        // The argument and the logarithm of e are rounded: 6e-8 of x each.
        let allowed = 3e-7 + 1.2e-7 * f64::from(x);
        assert!((own / exact - 1.0).abs() < allowed, "{x}: {own} {exact}");
    }
    assert!(exp_minus(1e30) < 1e-35 && exp_minus(0.0) == 1.0);
}

/// Chebyshev: each point more divides the error by the same number.
#[test]
fn order_interpolation_converges_as_powers() {
    let error = |points: usize| {
        let grid = Grid::new([points, points]);
        let at = inside(&AWAY, 3);
        let values: Vec<[f64; VALUES]> = (0..grid.len())
            .map(|i| {
                let o = grid.offset(&NEAR, i);
                let soft = grid.root(3, i / points.pow(3)) * NEAR.half[3];
                let [x, y, z, q] = NEAR.middle;
                let value = kernel([x + o.x, y + o.y, z + o.z, q + soft], at);
                [value; VALUES]
            })
            .collect();
        let square = |k: usize| {
            let p = inside(&NEAR, k);
            (grid.read(&NEAR, p, &values)[0] / kernel(p, at) - 1.0).powi(2)
        };
        ((0..50).map(square).sum::<f64>() / 50.0).sqrt()
    };
    let errors = [2, 3, 4, 5, 6].map(error);
    for pair in errors.windows(2) {
        // Half a side over the distance of the singularity, 0.5 / 2: a factor of 1 / (4 + sqrt(15)) at the best.
        assert!(pair[1] < 0.3 * pair[0], "{errors:?}");
    }
    assert!(errors[4] < 1e-4, "{errors:?}");
}

/// Polynomials are kept: from the points of a small box to those of a large one, and back.
#[test]
fn exact_sources_and_values_pass_between_boxes() {
    let grid = Grid::new([4, 3]);
    let large = Frame {
        middle: [0.2, 0.0, 0.0, 0.5],
        half: [1.0, 0.9, 0.8, 0.4],
    };
    let (at, w) = (inside(&NEAR, 5), DVec3::new(1.0, -2.0, 0.5));
    let none = vec![[0.0; 3]; grid.len()];
    let [mut small, mut passed, mut directly] = [none.clone(), none.clone(), none];
    grid.spread(&NEAR, at, w, &mut small);
    grid.spread(&large, at, w, &mut directly);
    grid.gather([&NEAR, &large], &small, &mut Room::default(), &mut passed);
    for (a, b) in passed.iter().flatten().zip(directly.iter().flatten()) {
        assert!((a - b).abs() < 1e-12, "{a} {b}"); // roundings of a hundred terms
    }
    let values: Vec<[f64; VALUES]> = (0..grid.len())
        .map(|i| [(i as f64).sin(); VALUES])
        .collect();
    let mut fine = vec![[0.0; VALUES]; grid.len()];
    grid.refine([&NEAR, &large], &values, &mut Room::default(), &mut fine);
    let [a, b] = [grid.read(&NEAR, at, &fine), grid.read(&large, at, &values)];
    assert!((a[0] - b[0]).abs() < 1e-12, "{a:?} {b:?}");
}

/// From grid to grid by Gaussians, against the kernel between the points.
#[test]
fn agrees_from_grid_to_grid_with_the_kernel() {
    for points in [[4, 3], [5, 3]] {
        let (grid, unit) = (Grid::new(points), 8.0);
        let place = |frame: &Frame, i: usize| {
            let [x, y, z, q] = frame.middle;
            let soft = grid.root(3, i / points[0].pow(3)) * frame.half[3];
            (DVec3::new(x, y, z) + grid.offset(frame, i), q + soft)
        };
        let strength = |i: usize| [0.7, 1.3, 2.1].map(|k| 1.0 + 0.5 * (k * i as f64).sin());
        let strengths: Vec<_> = (0..grid.len()).map(strength).collect();
        let mut packed = vec![[0.0; 8]; grid.len()];
        translate::pack(&grid, &NEAR, &strengths, unit, &mut packed);
        let level = InstructionSet::best();
        let mut received = Received::NONE;
        let frames = [&AWAY, &NEAR];
        assert!(translate::is_in_range(frames));
        translate::add(level, &grid, frames, (&packed, unit), &mut received);
        let (mut error, mut size) = (0.0, 0.0);
        for (i, sums) in received.0[..grid.len()].iter().enumerate() {
            let (p, q) = place(&AWAY, i);
            let mut exact = DVec3::ZERO;
            for (k, w) in strengths.iter().enumerate() {
                let (y, e) = place(&NEAR, k);
                let d2 = (p - y).length_squared() + q + e;
                exact += DVec3::from(*w).cross(p - y) / (d2 * d2.sqrt());
            }
            let [w, m] = [0, 4].map(|c| {
                DVec3::new(
                    f64::from(sums[c]),
                    f64::from(sums[c + 1]),
                    f64::from(sums[c + 2]),
                )
            });
            let u = w.cross(grid.offset(&AWAY, i) * unit) - m;
            error += u.distance_squared(exact);
            size += exact.length_squared();
        }
        // The Gaussians' 3e-4, root mean square; 4.9e-4 at most.
        let relative = f64::sqrt(error / size);
        assert!(relative < 5.2e-4, "{points:?}: {relative:e}");
    }
}
