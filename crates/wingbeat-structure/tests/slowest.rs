//! The slowest modes of a large body, found without the others.

mod plate;

use std::cell::Cell;

use plate::lattice;
use wingbeat_math::DVec3;
use wingbeat_structure::{
    FrameMotion, Lamina, Mode, Structure, StructureBuilder, modes, slowest_modes,
};

/// A plate of `n x n` panels, askew by `skew`, clamped along one side or along all.
fn plate(n: usize, skew: f64, all: bool) -> Structure {
    let mesh = lattice(n, n, |a, b| DVec3::new(a, b + skew * a, 0.0));
    let lamina = Lamina::isotropic(70e9, 0.3, 3e-3, 2700.0);
    let rest = mesh.rest.clone();
    let mut body = StructureBuilder::new(rest.clone());
    for shell in mesh.shells(|_| lamina.section().ok()).unwrap() {
        body = body.element(shell);
    }
    for (k, x) in rest.position.iter().enumerate() {
        let across = x.y - skew * x.x;
        let edge = |x: f64| !(1e-9..=1.0 - 1e-9).contains(&x);
        if x.x < 1e-9 || all && (edge(x.x) || edge(across)) {
            body = body.clamp(k);
        }
    }
    body.build().unwrap()
}

/// As many modes as all of them begin with, with their frequencies and shapes: of a plate askew, and of a square one
/// clamped all around, of whose modes pairs have one frequency.
#[test]
fn agrees_the_slowest_modes_of_large_plates_with_all_of_them() {
    for (skew, clamped) in [(0.5, false), (0.0, true)] {
        let body = plate(12, skew, clamped);
        assert!(body.unknowns() > 600, "{}", body.unknowns());
        let (at, asked) = (body.rest(), Cell::new(0));
        let enough = |m: &[Mode]| {
            asked.set(asked.get() + 1);
            m.len() >= 50
        };
        let all = modes(&body, at, &FrameMotion::REST, None).unwrap();
        let few = slowest_modes(&body, at, (&FrameMotion::REST, None), &enough).unwrap();
        assert!(few.modes.len() >= 50 && few.modes.len() < all.len() / 2);
        assert_eq!(asked.get(), 2, "first 40, then 80");
        let fastest = all.last().unwrap().frequency();
        assert!(few.fastest <= fastest && few.fastest > 0.3 * fastest);
        for (k, (a, b)) in few.modes.iter().zip(&all).enumerate() {
            let error = a.square / b.square - 1.0;
            // Squares of the slowest are known to some 1e-16 times (omega / omega_1)^2 and the condition.
            assert!(error.abs() < 1e-8, "{skew}, mode {k}: {error:e}");
            let alone = |j: usize| {
                all.get(j)
                    .is_none_or(|o| (o.square / b.square - 1.0).abs() > 1e-4)
            };
            if alone(k + 1) && (k == 0 || alone(k - 1)) {
                let size = |m: &Mode| m.shape.iter().map(|x| x * x).sum::<f64>();
                let product: f64 = a.shape.iter().zip(&b.shape).map(|(a, b)| a * b).sum();
                let off = 1.0 - product * product / (size(a) * size(b));
                assert!(off.abs() < 1e-8, "{skew}, mode {k}: {off:e}");
            }
        }
    }
}
