//! First steps of a body on which loads act from the start.

use wingbeat_structure::*;

mod common;
use common::straight;

/// The force \[N\] that pushes the tip, which bends the beam by a few hundred-thousandths of its length.
const FORCE: f64 = 1e-4;

/// One step of `step` \[s\] under `loads`.
fn advance(
    body: &Structure,
    method: &GeneralizedAlpha,
    step: f64,
    loads: &[f64],
    state: &mut State,
) {
    let (mut solver, mut trial) = (Solver::new(body), Trial::of(state));
    method.predict(body, state, step, &mut trial);
    for _ in 0..4 {
        let residual = solver.residual(body, &trial, &FrameMotion::REST, loads);
        let free = body.free_numbers().iter();
        let mut change: Vec<f64> = free.map(|&k| -residual[k]).collect();
        let none = LoadTangent::default();
        solver
            .factor(body, &trial, &FrameMotion::REST, &none)
            .unwrap();
        solver.solve(&mut change);
        trial.add(body, &change);
    }
    solver.residual(body, &trial, &FrameMotion::REST, loads);
    solver.accept(&trial, state);
}

/// The tip of a beam that a force pushes from the start, against the sum of its modes, in steps of `step` \[s\]: root
/// mean square of the differences over that of the sum \[1\].
fn off(body: &Structure, all: &[Mode], rho: f64, step: f64) -> f64 {
    let tip = NODE * (body.nodes() - 1) + 2;
    let mut loads = vec![0.0; NODE * body.nodes()];
    loads[tip] = FORCE;
    let mut state = State::at_rest(body.rest().clone());
    let (mut gap, mut size) = (0.0, 0.0);
    for k in 1..=(2.0 / step).round() as usize {
        let method = match state.is_fresh() {
            true => GeneralizedAlpha::first(),
            false => GeneralizedAlpha::new(rho).unwrap(),
        };
        advance(body, &method, step, &loads, &mut state);
        let t = step * k as f64;
        let mode = |m: &Mode| {
            let way = FORCE * m.shape[tip] * m.shape[tip];
            way / m.square * (1.0 - (m.frequency() * t).cos())
        };
        let exact: f64 = all.iter().map(mode).sum();
        let moved = state.configuration.position[body.nodes() - 1].z;
        gap += (moved - exact) * (moved - exact);
        size += exact * exact;
    }
    (gap / size).sqrt()
}

#[test]
fn order_of_a_beam_under_a_force_from_the_start() {
    let stiffness = Stiffness {
        axial: 1e3,
        shear: [1e3; 2],
        torsion: 1.0,
        bending: [1.0, 1.0],
    };
    let section = BeamSection::new(&stiffness).with_mass(1.0, [0.0; 2], [1e-2; 2]);
    let body = straight(3, 1.0, &section).clamp(0).build().unwrap();
    let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
    for rho in [1.0, 0.8, 0.3] {
        let [coarse, fine] = [0.01, 0.005].map(|h| off(&body, &all, rho, h));
        println!("{rho}: {coarse:.3e} {fine:.3e}");
        // 1.7e-3 to 3.1e-3 and 4.3e-4 to 9.5e-4; a quarter with half the step, less where vibrations of the step's
        // length are damped. A load that comes late by half a step leaves half.
        assert!(coarse < 4e-3 && fine < 1.2e-3, "{rho}: {coarse:e} {fine:e}");
        assert!((3.0..4.5).contains(&(coarse / fine)), "{rho}");
    }
}
