//! Evidence for the steps of the sum over wide filaments.

use super::convolution::{Convolution, Room};
use super::gaussians::{count, gaussian};
use super::mesh::{Mesh, Source, Spreading};
use super::plan::{FINENESS, Plan, fineness, spacing};
use super::spline::{ORDER, Stencil, weights};
use crate::instruction_set::InstructionSet;
use crate::quadrature::gauss_legendre;
use glam::DVec3;

#[test]
fn exact_gaussians_are_the_kernel_over_any_range() {
    for range in [2.0, 30.0, 1e3, 1e5, 1e7] {
        let (least, all) = (0.7, count(range));
        let mut square = 0.0;
        for i in 0..=400 {
            let x = least * f64::powf(range, f64::from(i) / 400.0);
            let terms = (0..all).map(|k| gaussian(k, all, least));
            let sum: f64 = terms.map(|[t, w]| w * (-t * x).exp()).sum();
            let error: f64 = sum * x.powf(1.5) - 1.0;
            // Largest error of the fit 5.7e-4, with the five digits of its numbers 6e-4.
            assert!(error.abs() < 7e-4, "{range}: {error:e} at {x}");
            square += error * error;
        }
        assert!((square / 401.0_f64).sqrt() < 4e-4, "{range}");
    }
}

/// Their number grows with the logarithm of the range: one for each factor of 2.4.
#[test]
fn limit_of_wide_ranges_takes_few_gaussians() {
    assert_eq!(count(1.0), 9);
    assert!(count(1e6) <= 9 + 12 && count(2.4e6) == count(1e6) + 1);
}

/// Cubic splines reproduce polynomials of the first degree exactly, and add up to one.
#[test]
fn exact_splines_keep_sums_and_first_moments() {
    for f in [0.0, 0.2, 0.5, 0.97_f32] {
        let w = weights(f).map(f64::from);
        let moment: f64 = (0..ORDER).map(|i| (i as f64 - 1.0) * w[i]).sum();
        assert!((w.iter().sum::<f64>() - 1.0).abs() < 2e-7); // roundings
        assert!((moment - f64::from(f)).abs() < 3e-7);
    }
}

/// Spline, stencil and spline against the Gaussian that they stand for, along an axis.
#[test]
fn order_finer_meshes_have_smaller_errors() {
    let errors = FINENESS.map(|(width, reach)| {
        let stencil = Stencil::new(width, reach);
        let (mut even, mut odd) = ([0.0; 2], [0.0; 2]);
        for i in 0..40 {
            for k in 0..400 {
                let (y, x) = (f64::from(i) / 40.0, 12.0 * f64::from(k) / 400.0 - 6.0);
                let (from, to) = (weights(y as f32), x.floor());
                let read = weights((x - to) as f32);
                let mut sums = [0.0; 2];
                for (a, from) in from.iter().enumerate() {
                    for (b, read) in read.iter().enumerate() {
                        let apart = to as i32 + b as i32 - a as i32;
                        let near = (apart.unsigned_abs() as usize).min(reach + 1);
                        if near > reach {
                            continue;
                        }
                        let w = f64::from(from * read);
                        sums[0] += w * f64::from(stencil.even[near]);
                        sums[1] += w * f64::from(apart.signum() as f32 * stencil.odd[near]);
                    }
                }
                let r = x - y;
                let g = (-0.5 * (r / width).powi(2)).exp();
                for (sum, [error, square], exact) in
                    [(sums[0], &mut even, g), (sums[1], &mut odd, r * g)]
                {
                    *error += (sum - exact).powi(2);
                    *square += exact * exact;
                }
            }
        }
        let rms = |[error, square]: [f64; 2]| (error / square).sqrt();
        println!("{width}: {:e} {:e}", rms(even), rms(odd));
        [rms(even), rms(odd)]
    });
    for k in 0..2 {
        assert!(errors[0][k] < 4e-2 && errors[2][k] < 1e-3, "{errors:?}");
        // Splines of order four, so a power of four and more: widths 1.2 to 2.4.
        assert!(errors[2][k] < errors[0][k] / 16.0, "{errors:?}");
    }
}

/// All directions of a mesh, by the sum over pairs of nodes.
#[test]
fn agrees_convolution_with_the_sum_over_nodes() {
    let size = [8, 5, 7];
    for (width, reach) in FINENESS {
        let stencil = Stencil::new(width, reach);
        let all: usize = size.iter().product();
        let wave = |k: usize, f: f64| (f * k as f64).sin() as f32;
        let strengths: Vec<_> = (0..all)
            .map(|k| [wave(k, 1.3), wave(k, 2.1), wave(k, 0.7), 0.0])
            .collect();
        let convolution = Convolution {
            size,
            strengths: &strengths,
            stencil: &stencil,
        };
        let level = InstructionSet::best();
        let place = |k: usize| [k % size[0], k / size[0] % size[1], k / (size[0] * size[1])];
        let plane = size[0] * size[1];
        let mut room = Room::default();
        for z in 0..size[2] {
            let mut out = vec![[0.0; 8]; plane];
            convolution.plane(level, z, &mut room, &mut out);
            for (i, out) in out.iter().enumerate() {
                let to = place(z * plane + i);
                let (mut w, mut u) = (DVec3::ZERO, DVec3::ZERO);
                for (k, s) in strengths.iter().enumerate() {
                    let from = place(k);
                    let apart = [0, 1, 2].map(|d| to[d] as i32 - from[d] as i32);
                    let tap = |d: usize, of: &[f32]| {
                        let near = apart[d].unsigned_abs() as usize;
                        if near > reach {
                            0.0
                        } else {
                            f64::from(of[near])
                        }
                    };
                    let even = [0, 1, 2].map(|d| tap(d, &stencil.even));
                    let odd =
                        [0, 1, 2].map(|d| f64::from(apart[d].signum()) * tap(d, &stencil.odd));
                    let r = DVec3::new(
                        odd[0] * even[1] * even[2],
                        even[0] * odd[1] * even[2],
                        even[0] * even[1] * odd[2],
                    );
                    let s = DVec3::new(f64::from(s[0]), f64::from(s[1]), f64::from(s[2]));
                    w += even.iter().product::<f64>() * s;
                    u += s.cross(r);
                }
                let [wx, wy, wz, _, ux, uy, uz, _] = out.map(f64::from);
                let error = w.distance(DVec3::new(wx, wy, wz)) + u.distance(DVec3::new(ux, uy, uz));
                assert!(error < 5e-6, "{width} {to:?}: {error:e}"); // roundings of single precision
            }
        }
    }
}

/// One filament on one mesh, against the integral of the Gaussian along it.
#[test]
fn exact_filament_on_the_mesh_of_a_gaussian() {
    let source = Source {
        from: [0.4, 0.7, 0.9],
        along: [0.5, -0.3, 0.2],
        softening: [0.2, 0.1],
        strength: [0.5, -0.3, 0.2],
        index: 0,
    };
    let level = InstructionSet::best();
    let quadrature: Vec<_> = (1..=super::mesh::MOST_POINTS).map(gauss_legendre).collect();
    let fine = gauss_legendre(20);
    for k in 0..3 {
        let t = 4.0 / 0.25 / 2.4_f64.powi(k as i32);
        let (width, reach) = FINENESS[fineness(k)];
        let mut mesh = Mesh::new(Stencil::new(width, reach));
        mesh.fit([t, 1.0], spacing(k, t), [1.5; 3]);
        let how = Spreading {
            origin: [0.0; 3],
            quadrature: &quadrature,
        };
        mesh.sum(level, [&[source], &[]], how);
        let (mut error, mut square) = ([0.0; 2], [0.0; 2]);
        for i in 0..200 {
            let x = [1.3, 2.1, 0.7].map(|f| 0.75 + 0.7 * (f * f64::from(i)).sin());
            let soft = 0.05;
            let mut exact = [DVec3::ZERO; 2];
            for (s, part) in &fine {
                let at = DVec3::from(source.from) + *s * DVec3::from(source.along);
                let r = DVec3::from(x) - at;
                let e = source.softening[0] + s * source.softening[1];
                let g = part * (-t * (r.length_squared() + e + soft)).exp();
                let w = g * DVec3::from(source.strength);
                exact[0] += w.cross(r);
                exact[1] += w;
            }
            let simd_read = |simd_level| fearless_simd::dispatch!(simd_level, simd => mesh.read(simd, (x, soft), true));
            let [a, b, c, d, e, f] = simd_read(level);
            let both = [DVec3::new(a, b, c), DVec3::new(d, e, f)];
            for q in 0..2 {
                error[q] += both[q].distance_squared(exact[q]);
                square[q] += exact[q].length_squared();
            }
        }
        let rms = [0, 1].map(|q| (error[q] / square[q]).sqrt());
        println!("{k}: {rms:?}");
        // That of the splines at this fineness; the first mesh is coarser.
        let most = [3e-2, 5e-3, 1e-3][k];
        assert!(rms.iter().all(|e| *e < most), "{k}: {rms:?}");
    }
}

/// What is wide follows from what it costs: nothing is narrow among equal cores as wide as their wake;
/// filaments too thin for any mesh are left to other sums.
#[test]
fn limit_of_wide_and_of_thin_cores() {
    let all = vec![0.5; 20_000];
    let plan = Plan::cheapest(&all, [2.0; 3]).unwrap();
    assert!(plan.least == 0.5 && plan.cost < 0.5 * 20_000.0, "{plan:?}");
    assert!(Plan::cheapest(&[0.0; 1000], [2.0; 3]).is_none());
    assert!(Plan::cheapest(&[1e-12; 1000], [2.0; 3]).is_none());
    assert!(Plan::cheapest(&[], [f64::NEG_INFINITY; 3]).is_none());
}
