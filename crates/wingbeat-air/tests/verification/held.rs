//! Leading edges that may shed but hold everything: the flow is the attached one.

use crate::common::{fly, rectangle, total_force, translating, with_leading_edges};
use crate::implicit_suction::implicit;
use wingbeat_air::{AirSettings, CoreModel, Lattice, LeadingEdge, NodeMotion, Surface, VortexLift};
use wingbeat_math::{DVec3, r2};

/// Far more than what the edges have, and all of the force of their suction.
fn hold_all() -> LeadingEdge {
    LeadingEdge::Suction {
        threshold: 9.0,
        efficiency: 1.0,
    }
}

fn settings(leading: LeadingEdge) -> AirSettings {
    let core = CoreModel::Scully { radius: 1e-7 };
    AirSettings {
        bound_core: core,
        wake_core: core,
        ..with_leading_edges(leading, DVec3::X)
    }
}

/// All forms of the leading edge that read its suction, holding everything.
fn readers() -> [LeadingEdge; 3] {
    let law = LeadingEdge::VortexLift(VortexLift {
        threshold: 9.0,
        ..VortexLift::default()
    });
    [hold_all(), implicit(9.0), law]
}

/// A wing without ends.
fn endless(rows: usize, leading: LeadingEdge, chords: f64) -> (Lattice, Vec<DVec3>) {
    let settings = AirSettings {
        wake_core: CoreModel::Scully { radius: chords },
        ..settings(leading)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, 1)], settings).unwrap();
    (lattice, rectangle(rows, 1, DVec3::X, 1e5 * DVec3::Y))
}

/// A plate in a stream along it whose points go down as one that turns about its mid chord has no suction,
/// whatever the lengths of its panels; the foremost vortex alone would have some, 0.26 of the second mode on
/// two panels and 0.1 on five. Where edges hold what they have beside their wakes (`suction`) a part of it is
/// left on unequal panels, for the boundary condition is moved aft by as much as panels are long.
#[test]
fn exact_suction_parameter_of_a_linear_normal_velocity() {
    const SLOPE: f64 = 1e-3;
    let even = |x: f64| x;
    let cosine = |x: f64| 0.5 * (1.0 - (std::f64::consts::PI * x).cos());
    for (rows, spaced) in [(2, even as fn(f64) -> f64), (5, even), (5, cosine)] {
        for leading in readers() {
            let (lattice, mut position) = endless(rows, leading, 1e-7);
            position.iter_mut().for_each(|x| x.x = spaced(x.x));
            let down = |x: &DVec3| SLOPE * (1.0 - 2.0 * x.x) * DVec3::Z;
            let velocity = position.iter().map(down).collect();
            let motion = NodeMotion { position, velocity };
            let end = fly(&lattice, |_| motion.clone(), 1e4, 150, |_, _, _, _| {}).unwrap();
            let part = end.loads.leading[0] / SLOPE;
            println!("{rows} panels, {leading:?}: {part:.2e}");
            let equal = leading != hold_all() || spaced(0.2) == 0.2;
            // The vortex of the start is 1.5e6 chords away.
            assert!(
                part < if equal { 1e-4 } else { 0.1 },
                "{rows} panels, {leading:?}: {part}"
            );
        }
    }
}

/// A plate that pitches up about its quarter chord, half a chord after it has begun to: five and two per cent
/// off on four and eight panels. The foremost vortex alone has 28 and 11 % too much.
#[test]
fn limit_suction_parameter_of_pitching_plates() {
    const RATE: f64 = 0.6;
    for leading in readers() {
        let parameter = |rows: usize, steps: usize| {
            let (lattice, flat) = endless(rows, leading, 0.05);
            let motion = |t: f64| {
                let t = (t - 0.5).max(0.0);
                let (pitch, rate) = (0.5 * RATE * t * t, RATE * t);
                let turned = |x: &DVec3| r2(pitch) * (*x - 0.25 * DVec3::X);
                let position: Vec<DVec3> = flat.iter().map(turned).collect();
                let velocity = |x: &DVec3| (rate * DVec3::Y).cross(*x);
                let velocity = position.iter().map(velocity).collect();
                NodeMotion { position, velocity }
            };
            let end = fly(&lattice, motion, 1.0 / steps as f64, steps, |_, _, _, _| {});
            end.unwrap().loads.leading[0]
        };
        let fine = parameter(32, 80);
        let [coarse, middle] = [(4, 40), (8, 40)].map(|(n, s)| parameter(n, s) / fine - 1.0);
        println!("{leading:?}: {fine:.5} {coarse:.4} {middle:.4}");
        assert!(coarse.abs() < 0.1 && middle.abs() < 0.03, "{leading:?}");
    }
}

/// The lift coefficient of an arc of the height h over its chord in a stream along the chord is 4 pi h, in
/// thin-airfoil theory and on any number of panels [James 1972]. Where the boundary condition was that of the
/// control points themselves it was `(1 - 1 / (2 n))` of that on n.
#[test]
fn exact_lift_of_parabolic_arcs() {
    const HEIGHT: f64 = 1e-3;
    for rows in [2, 4, 8] {
        for leading in [hold_all(), implicit(9.0), LeadingEdge::Never] {
            let (lattice, mut arc) = endless(rows, leading, 1e-7);
            for x in &mut arc {
                x.z = 4.0 * HEIGHT * x.x * (1.0 - x.x);
            }
            let motion = |_| translating(arc.clone(), DVec3::ZERO);
            let end = fly(&lattice, motion, 1e4, 150, |_, _, _, _| {}).unwrap();
            let exact = 4.0 * std::f64::consts::PI * HEIGHT;
            let ratio = total_force(&end.loads).z / (0.5 * 1e5) / exact;
            println!("{leading:?}, {rows} panels: {ratio:.6}");
            assert!((ratio - 1.0).abs() < 1e-3, "{leading:?}, {rows}: {ratio}");
        }
    }
}

/// Largest difference of the force on a pitching wing from the attached one over the largest force.
fn apart(rows: usize, leading: LeadingEdge) -> f64 {
    const RATE: f64 = 2.0;
    let flat = rectangle(rows, 6, DVec3::X, 4.0 * DVec3::Y);
    let motion = |t: f64| {
        let (pitch, rate) = (0.2 * (RATE * t).sin(), 0.2 * RATE * (RATE * t).cos());
        let turned = |x: &DVec3| r2(pitch) * (*x - 0.5 * DVec3::X);
        let position: Vec<DVec3> = flat.iter().map(turned).collect();
        let velocity = |x: &DVec3| (rate * DVec3::Y).cross(*x);
        let velocity = position.iter().map(velocity).collect();
        NodeMotion { position, velocity }
    };
    let forces = |leading| {
        let surface = Surface::grid("wing", rows, 6);
        let lattice = Lattice::new(vec![surface], settings(leading)).unwrap();
        let mut forces = Vec::new();
        let step = 1.0 / rows as f64;
        fly(&lattice, motion, step, 4 * rows, |_, _, loads, _| {
            forces.push(total_force(loads));
        })
        .unwrap();
        forces
    };
    let [attached, held] = [LeadingEdge::Never, leading].map(forces);
    // At the first step it is not known what the edge holds.
    let both = attached.iter().zip(&held).skip(1);
    let most = attached.iter().map(|f| f.length()).fold(0.0, f64::max);
    both.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / most
}

#[test]
fn limit_pitching_wings_have_the_attached_force() {
    for rows in [4, 8] {
        let apart = apart(rows, hold_all());
        println!("{rows} panels: {apart:.2e}");
        assert!(apart < 0.02, "{rows} panels: {apart}");
    }
}
