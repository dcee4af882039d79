//! Closed forms and identities.

mod common;
mod mixed;

use common::*;
use std::f64::consts::PI;
use wingbeat_math::{DMat3, DQuat, DVec3, MassProperties, outer};
use wingbeat_structure::*;

/// Largest difference.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let gaps = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    gaps.fold(0.0, f64::max)
}

#[test]
fn exact_cantilever_under_a_tip_moment_is_a_circle_with_any_number_of_elements() {
    // Curvature M / EI; with three elements and more the circle closes, each turning by less than half a turn.
    for (elements, turns) in [
        (1, 0.45),
        (2, 0.9),
        (3, 1.0),
        (4, 1.0),
        (10, 1.0),
        (40, 1.0),
    ] {
        let section = BeamSection::rectangle([1e9, 4e8], 1000.0, [0.02, 0.01]);
        let body = straight(elements, 1.0, &section).clamp(0).build().unwrap();
        let ei = section.stiffness[4][4];
        let k = 2.0 * PI * turns;
        let moment = load(elements, DVec3::ZERO, DVec3::Y * (-k * ei), false);
        let settings = StaticSettings {
            steps: 8,
            ..Default::default()
        };
        let at = equilibrium(
            &body,
            body.rest(),
            &FrameMotion::REST,
            &moment[..],
            &settings,
        );
        let at = at.unwrap();
        for i in 0..=elements {
            let s = i as f64 / elements as f64;
            let place = DVec3::new((k * s).sin() / k, 0.0, (1.0 - (k * s).cos()) / k);
            let gap = (at.position[i] - place).length();
            assert!(gap < 1e-13, "{elements} {i}: {gap:.1e}"); // some hundred roundings
        }
        let turned = at.rotation[elements].angle_between(DQuat::from_rotation_y(-k));
        assert!(turned < 1e-7); // the root of a rounding: the angle is an arc cosine
    }
}

#[test]
fn invariant_rigid_motion_strains_nothing() {
    let (rest, beams) = crooked();
    let turn = DQuat::from_scaled_axis(DVec3::new(1.9, -0.7, 2.1));
    let shift = DVec3::new(3.0, -2.0, 1.0);
    let moved = Configuration {
        position: rest.position.iter().map(|x| turn * *x + shift).collect(),
        rotation: rest.rotation.iter().map(|r| turn * *r).collect(),
    };
    for beam in &beams {
        let (strain, _) = beam.strain(&moved);
        assert!(strain.iter().all(|e| e.abs() < 1e-14), "{strain:?}"); // places of size 3 over lengths of 1
        // And forces of a deformed beam turn with it.
        let deformed = shaken(&rest, 0.2);
        let seen = Configuration {
            position: deformed
                .position
                .iter()
                .map(|x| turn * *x + shift)
                .collect(),
            rotation: deformed.rotation.iter().map(|r| turn * *r).collect(),
        };
        assert!(apart(&beam.strain(&deformed).1, &beam.strain(&seen).1) < 1e-11); // 900 N times roundings
    }
}

/// Derivatives by central differences of step d: error d^2 and roundings over d.
fn differences(beam: &Beam, at: &Configuration, k: usize) -> (f64, Vec<f64>) {
    let d = 1e-5;
    let mut sides = [1.0, -1.0].map(|sign| {
        let mut change = vec![0.0; NODE * at.len()];
        change[k] = sign * d;
        let mut moved = at.clone();
        moved.moved(&change);
        let mut out = ElementForces::default();
        let energy = beam.internal(&moved, false, &mut out);
        (energy, out.force)
    });
    let minus = sides[1].1.clone();
    let force = &mut sides[0].1;
    let slope = force.iter_mut().zip(minus);
    let slope = slope.map(|(p, m)| (*p - m) / (2.0 * d)).collect();
    ((sides[0].0 - sides[1].0) / (2.0 * d), slope)
}

#[test]
fn agrees_damping_tangent_of_beams_with_differences() {
    let (rest, beams) = crooked();
    let at = shaken(&rest, 0.4);
    for beam in &beams {
        let error = damping_tangent_error(beam, &at);
        // Central differences: h^2 = 1e-10 times third derivatives.
        assert!(error < 1e-8, "{error:e}");
    }
}

#[test]
fn agrees_beam_force_and_tangent_with_differences() {
    let (rest, beams) = crooked();
    // Small turns use the series, large ones the closed form.
    for size in [0.0, 0.01, 0.4, 1.2] {
        let at = shaken(&rest, size);
        let mut out = ElementForces::default();
        beams[0].internal(&at, true, &mut out);
        let scale = out.tangent.iter().fold(0.0_f64, |a, k| a.max(k.abs()));
        for k in 0..12 {
            let (force, column) = differences(&beams[0], &at, k);
            let gap = (force - out.force[k]).abs();
            assert!(
                gap < 1e-8 * scale,
                "force {size} {k}: {gap:.1e} of {scale:.1e}"
            );
            let tangent: Vec<f64> = (0..12).map(|i| out.tangent[12 * i + k]).collect();
            let gap = apart(&column, &tangent);
            assert!(
                gap < 1e-8 * scale,
                "tangent {size} {k}: {gap:.1e} of {scale:.1e}"
            );
        }
    }
}

#[test]
fn order_foreseen_stresses_of_a_beam_differ_by_squares_of_the_increment() {
    // Strains linear in the increment: the tangent with their stresses is the tangent where nothing moves, and
    // differs by the square of what does.
    let (rest, beams) = crooked();
    let before = shaken(&rest, 0.4);
    let gap = |size: f64| {
        let turn = |k: usize| size * (1.0 + k as f64).sin();
        let mut numbers = vec![0.0; NODE * rest.len()];
        for (k, x) in numbers.iter_mut().enumerate() {
            *x = turn(k) * if k % NODE < 3 { beams[0].length() } else { 1.0 };
        }
        let mut at = before.clone();
        at.moved(&numbers);
        let [mut now, mut ahead] = [ElementForces::default(), ElementForces::default()];
        beams[0].internal(&at, true, &mut now);
        let own: Vec<f64> = (beams[0].nodes().iter())
            .flat_map(|n| numbers[NODE * n..NODE * (n + 1)].iter().copied())
            .collect();
        beams[0].tangent_ahead(&at, &before, &own, &mut ahead);
        let scale = now.tangent.iter().fold(0.0_f64, |a, k| a.max(k.abs()));
        apart(&now.tangent, &ahead.tangent) / scale
    };
    assert!(gap(0.0) < 1e-15);
    let ratio = gap(2e-3) / gap(1e-3);
    assert!((3.9..4.1).contains(&ratio), "{ratio}");
}

#[test]
fn exact_small_deflections_under_loads_at_nodes() {
    // Timoshenko's cantilever under a tip force: L^3 / 3 EI + L / GA, whatever the number of elements.
    let section = BeamSection::new(&Stiffness {
        axial: 1e4,
        shear: [50.0, 80.0],
        torsion: 0.7,
        bending: [2.0, 3.0],
    });
    let length = 1.3;
    for elements in [1, 2, 5] {
        let mass = MassProperties::about_centre(1.0, DVec3::ZERO, DMat3::IDENTITY);
        let mut body = straight(elements, length, &section).clamp(0);
        for n in 1..=elements {
            body = body.mass(n, mass);
        }
        let body = body.build().unwrap();
        let small = 1e-7;
        let force = load(
            elements,
            DVec3::new(0.0, 0.3, 1.0) * small,
            DVec3::X * small,
            false,
        );
        let rest = body.rest();
        let at = equilibrium(
            &body,
            rest,
            &FrameMotion::REST,
            &force[..],
            &Default::default(),
        );
        let at = at.unwrap();
        let bent = |ei: f64, ga: f64| length.powi(3) / (3.0 * ei) + length / ga;
        let tip = (at.position[elements] - rest.position[elements]) / small;
        assert!((tip.z - bent(2.0, 80.0)).abs() < 1e-7, "{tip}"); // the load's size
        assert!((tip.y - 0.3 * bent(3.0, 50.0)).abs() < 1e-7, "{tip}");
        let twist = at.rotation[elements].to_scaled_axis().x / small;
        assert!((twist - length / 0.7).abs() < 1e-6, "{twist}");
    }
}

#[test]
fn exact_lumped_mass_has_the_moments_of_the_beam() {
    let section = coupled();
    let rest = line(3, 1.2);
    let mut masses = vec![MassProperties::ZERO; 4];
    for i in 0..3 {
        let beam = Beam::straight(&rest, [i, i + 1], DVec3::Y, &section).unwrap();
        beam.add_mass(&rest, &mut masses);
    }
    let lumped = masses.iter().zip(&rest.position);
    let lumped = lumped.map(|(m, x)| m.moved(DMat3::IDENTITY, *x));
    let whole = lumped.fold(MassProperties::ZERO, |a, b| a + b);
    // The same by the rule of Gauss of three points, exact for squares.
    let slice = |along: f64, weight: f64| {
        let part = section.mass.scaled(weight * 1.2);
        part.moved(DMat3::IDENTITY, DVec3::X * (1.2 * along))
    };
    let off = 0.5 * 0.6_f64.sqrt();
    let exact =
        slice(0.5 - off, 5.0 / 18.0) + slice(0.5, 8.0 / 18.0) + slice(0.5 + off, 5.0 / 18.0);
    assert!((whole.mass - exact.mass).abs() < 1e-15); // roundings
    assert!((whole.first_moment - exact.first_moment).length() < 1e-15);
    let gap = (whole.inertia - exact.inertia).to_cols_array();
    assert!(gap.iter().all(|e| e.abs() < 1e-15), "{gap:?}");
    masses.iter().for_each(|m| m.validate().unwrap());
}

/// Iterations end on it: no correction is mistaken for a small one.
#[test]
fn behaves_corrections_under_loads_that_are_not_numbers_are_not_numbers_either() {
    let body = straight(2, 1.0, &slender()).clamp(0).build().unwrap();
    let method = GeneralizedAlpha::new(0.9).unwrap();
    let state = State::at_rest(body.rest().clone());
    for k in 0..6 {
        // One number of the tip: a force, then a moment.
        let mut loads = vec![0.0; NODE * body.nodes()];
        loads[12 + k] = f64::NAN;
        let (mut trial, mut solver) = (Trial::of(&state), Solver::new(&body));
        method.predict(&body, &state, 1e-3, &mut trial);
        let residual = solver.residual(&body, &trial, &FrameMotion::REST, &loads);
        let free = body.free_numbers().iter();
        let mut change: Vec<f64> = free.map(|&k| -residual[k]).collect();
        let none = LoadTangent::default();
        solver
            .factor(&body, &trial, &FrameMotion::REST, &none)
            .unwrap();
        solver.solve(&mut change);
        assert!(trial.add(&body, &change).is_nan(), "number {k}");
    }
}

#[test]
fn exact_bodies_have_as_many_modes_as_motions_with_mass() {
    // Ten thin rods on a beam without mass, none along an axis: what turns each about itself has no mass.
    let section = BeamSection {
        mass: MassProperties::ZERO,
        ..slender()
    };
    let along = DVec3::new(1.0, 2.0, 3.0).normalize();
    let thin = DMat3::IDENTITY - outer(along);
    let rod = MassProperties::about_centre(0.1, DVec3::ZERO, thin * 1e-3);
    let body = (1..=10).fold(straight(10, 1.0, &section).clamp(0), |b, n| b.mass(n, rod));
    let body = body.build().unwrap();
    let found = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
    assert_eq!(found.len(), 50, "{:?}", found.last().map(|m| m.square));
}

/// A cantilever of unit length and mass whose stiffnesses are 1 and `other`.
fn two_ways(other: f64) -> Structure {
    let stiffness = Stiffness {
        axial: 1e4,
        shear: [1e4; 2],
        torsion: 1.0,
        bending: [1.0, other],
    };
    let section = BeamSection::new(&stiffness).with_mass(1.0, [0.0; 2], [1e-4; 2]);
    straight(8, 1.0, &section).clamp(0).build().unwrap()
}

#[test]
fn agrees_first_frequency_is_that_of_the_modes() {
    for other in [1.0, 1.1, 3.0] {
        let body = two_ways(other);
        let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        let quick = first_frequency(&body, true).unwrap().unwrap();
        let gap = quick / all[0].frequency() - 1.0;
        println!("{other}: {gap:e}");
        // What is left of a change of 1e-8 of the square that falls by 1.2 a pass.
        assert!(gap.abs() < 3e-8, "{other}: {gap:e}");
    }
}

/// Where two vibrations are too close to be told apart the frequency is that of their mixture, between the two.
#[test]
fn agrees_first_frequency_lies_between_two_that_are_close() {
    for other in [1.0 + 1e-6, 1.001, 1.01, 1.03] {
        let body = two_ways(other);
        let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        let quick = first_frequency(&body, true).unwrap().unwrap();
        let [low, high] = [0, 1].map(|k| quick / all[k].frequency() - 1.0);
        println!("{other}: {low:e} {high:e}");
        // What is left of a change of 1e-8 of the square where it converges.
        assert!(low > -1e-8 && high < 1e-8, "{other}: {low:e} {high:e}");
        assert!(low < 2e-3, "{other}: {low:e}"); // half the distance of the squares, times what is mixed in
    }
}
