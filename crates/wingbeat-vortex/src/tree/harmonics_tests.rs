//! Evidence for the expansions.

use crate::cores::CoreModel;
use crate::direct::reference::segment_velocity;
use crate::sources::Network;
use crate::tree::harmonics::{Coefficient, Harmonics};
use fearless_simd::{Level, dispatch, prelude::*};
use glam::DVec3;

const BARE: CoreModel = CoreModel::Scully { radius: 0.0 };

/// Fifty segments that do not close, within a radius of 1 of the origin.
fn tangle() -> Network {
    let mut net = Network::default();
    let angle = |i: usize, k: f64| (k * i as f64 + k).sin();
    for i in 0..51 {
        net.nodes
            .push(0.57 * DVec3::new(angle(i, 1.3), angle(i, 2.1), angle(i, 0.7)));
    }
    (0..50).for_each(|i| net.push_edge(i, i + 1, angle(i, 5.0), 0.0));
    net
}

fn expand(h: &Harmonics, net: &Network, centre: DVec3) -> Vec<Coefficient> {
    let mut c = vec![[0.0; 6]; h.len()];
    let edges = || 0..net.len() as u32;
    dispatch!(Level::new(), simd => h.expand(simd, net, edges(), centre, &mut c));
    c
}

fn velocity<const P: usize>(h: &Harmonics, c: &[Coefficient], r: DVec3) -> DVec3 {
    #[inline(always)]
    fn one<S: Simd, const P: usize>(
        simd: S,
        h: &Harmonics,
        c: &[Coefficient],
        r: [f64; 3],
    ) -> [f64; 3] {
        h.velocity::<S, P>(simd, r.map(|r| S::f64s::splat(simd, r)), c)
            .map(|v| v.as_slice()[0])
    }
    let mut finished = c.to_vec();
    h.finish(&mut finished);
    dispatch!(Level::new(), simd => one::<_, P>(simd, h, &finished, r.to_array())).into()
}

fn direct(net: &Network, p: DVec3) -> DVec3 {
    let one = |e: usize| {
        let (a, b) = net.ends(e);
        segment_velocity(BARE, p, a, b, net.gamma[e], 0.0)
    };
    (0..net.len()).map(one).sum()
}

/// Root mean square error over directions at distance d.
fn error<const P: usize>(net: &Network, d: f64) -> f64 {
    let h = Harmonics::new(P);
    let c = expand(&h, net, DVec3::ZERO);
    let square = |i: usize| {
        let t = i as f64;
        let p = DVec3::new((2.4 * t).sin(), (1.1 * t).cos(), (0.9 * t + 1.0).sin()).normalize() * d;
        velocity::<P>(&h, &c, p).distance_squared(direct(net, p))
    };
    ((0..40).map(square).sum::<f64>() / 40.0).sqrt()
}

#[test]
fn order_of_the_expansion_is_its_first_part_left_out() {
    let net = tangle();
    // Part n falls as D^-(n + 1); left out from n = P + 1 on. Between 6 and 12 radii the parts after
    // the first still weigh some tenths of an order.
    let slope = |near: f64, far: f64| (near / far).log2();
    assert!((slope(error::<4>(&net, 6.0), error::<4>(&net, 12.0)) - 6.0).abs() < 0.4);
    assert!((slope(error::<6>(&net, 6.0), error::<6>(&net, 12.0)) - 8.0).abs() < 0.4);
    assert!((slope(error::<8>(&net, 6.0), error::<8>(&net, 12.0)) - 10.0).abs() < 0.4);
}

#[test]
fn exact_shifted_expansion_is_the_one_about_the_new_centre() {
    let (net, d) = (tangle(), DVec3::new(0.4, -0.9, 0.3));
    for order in [2, 4, 6, 10, 12] {
        let h = Harmonics::new(order);
        let (old, new) = (expand(&h, &net, DVec3::ZERO), expand(&h, &net, -d));
        let mut shifted = vec![[0.0; 6]; h.len()];
        h.shift(&old, d, &mut shifted);
        let size = new.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
        for (s, n) in shifted.iter().flatten().zip(new.iter().flatten()) {
            // Sums of some hundred terms in double precision.
            assert!((s - n).abs() < 1e-13 * size, "{order}: {s} {n}");
        }
    }
}

#[test]
fn exact_far_field_of_a_small_ring_is_its_dipole() {
    // A square of side 1e-3: on its axis v = 2 S/(4 pi z^3).
    let mut net = Network::default();
    let nodes = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(x, y)| 5e-4 * DVec3::new(x, y, 0.0));
    nodes.iter().for_each(|p| net.nodes.push(*p));
    (0..4).for_each(|i| net.push_edge(i, (i + 1) % 4, 1.0, 0.0));
    let h = Harmonics::new(4);
    let v = velocity::<4>(&h, &expand(&h, &net, DVec3::ZERO), DVec3::Z);
    let expected = 2.0 * 1e-6 / (4.0 * std::f64::consts::PI);
    // The next part is (side / z)^2 = 1e-6 of it.
    assert!(
        (v.z / expected - 1.0).abs() < 2e-6 && v.x.abs() < 1e-12 * v.z,
        "{v} {expected}"
    );
}

#[test]
fn limit_strength_is_the_mean_square_of_a_part() {
    // Part 1 of a short straight element q is q x r / r^3, mean square 2/3 q^2 on the sphere.
    let mut net = Network::default();
    [-1e-3, 1e-3]
        .iter()
        .for_each(|z| net.nodes.push(*z * DVec3::Z));
    net.push_edge(0, 1, 4.0 * std::f64::consts::PI / 2e-3, 0.0);
    let h = Harmonics::new(4);
    let strength = h.strength(1, &expand(&h, &net, DVec3::ZERO));
    assert!(
        (strength - (2.0f64 / 3.0).sqrt()).abs() < 1e-12,
        "{strength}"
    );
}
