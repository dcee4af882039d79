//! Leading edges whose vortices are a law of forces and no free vorticity.

use crate::common::{fly, rectangle, total_force, translating, with_leading_edges};
use wingbeat_air::{
    AirLoads, AirSettings, Lattice, LeadingEdge, LoadMethod, NodeMotion, Surface, VortexLift,
};
use wingbeat_math::{DVec3, r2, r3};

const ROWS: usize = 4;
const COLS: usize = 6;

/// Settings of a wing in a stream of 1 at this angle [rad], with forces on segments.
fn settings(alpha: f64, leading: LeadingEdge) -> AirSettings {
    with_leading_edges(leading, DVec3::new(alpha.cos(), 0.0, alpha.sin()))
}

fn law(threshold: f64, efficiency: f64) -> LeadingEdge {
    LeadingEdge::VortexLift(VortexLift {
        threshold,
        efficiency,
        ..VortexLift::default()
    })
}

fn plate() -> NodeMotion {
    let flat = rectangle(ROWS, COLS, DVec3::X, 4.0 * DVec3::Y);
    translating(flat, DVec3::ZERO)
}

/// Loads of a plate of aspect ratio 4 that the stream has just met, whose vortices have been fed for so many chords.
fn met(settings: AirSettings, fed: f64) -> AirLoads {
    let lattice = Lattice::new(vec![Surface::grid("wing", ROWS, COLS)], settings).unwrap();
    let motion = plate();
    let mut state = lattice.initial_state(&motion);
    state.fed.fill(fed);
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    (lattice.loads(&state, 0.0, 0.0, &motion, &mut ws, &mut loads)).unwrap();
    loads
}

/// Edges that hold all suction and have all of its force are those that do not shed, to the last bit, in unsteady flow.
#[test]
fn limit_edges_that_hold_all_are_attached() {
    let [held, attached] = [law(9.0, 1.0), LeadingEdge::Never].map(|leading| {
        let surface = vec![Surface::grid("wing", ROWS, COLS)];
        let lattice = Lattice::new(surface, settings(0.2, leading)).unwrap();
        let motion = |t: f64| {
            let mut motion = plate();
            let (s, c) = t.sin_cos();
            motion.position.iter_mut().for_each(|x| x.z += 0.3 * s);
            motion.velocity.fill(DVec3::new(0.0, 0.0, 0.3 * c));
            motion
        };
        fly(&lattice, motion, 0.2, 12, |_, _, _, _| {})
            .unwrap()
            .loads
    });
    assert!(total_force(&held).z > 0.1, "the test is void");
    assert_eq!(held.force, attached.force);
    assert_eq!(held.inviscid_force, attached.inviscid_force);
}

/// An edge that holds nothing, whose vortex has been fed for half of its time, has half of what Polhamus's
/// analogy adds, and no force along the plate.
#[test]
fn exact_half_fed_is_half_of_polhamus() {
    let alpha = 0.4;
    let [attached, vortex] = [LeadingEdge::Never, law(1e-9, 0.0)]
        .map(|leading| total_force(&met(settings(alpha, leading), 2.0)));
    let suction = -attached.x;
    assert!(suction > 0.1 * attached.z, "the test is void");
    // Some roundings.
    assert!(vortex.x.abs() < 1e-12, "{vortex}");
    assert!((vortex.z - attached.z - 0.5 * suction).abs() < 1e-12);
    let [polhamus, pressure] = [LoadMethod::Polhamus, LoadMethod::Pressure].map(|loads| {
        let settings = AirSettings {
            loads,
            ..settings(alpha, LeadingEdge::Never)
        };
        total_force(&met(settings, 0.0)).z
    });
    assert!((vortex.z - attached.z - 0.5 * (polhamus - pressure)).abs() < 1e-12);
}

/// No kink in the force against the angle, where edges begin to yield strip by strip and where vortices are lost.
#[test]
fn order_forces_are_differentiable_in_the_angle() {
    // Second differences over h on a grid without gaps: wherever the slope jumps they stay, where it does not
    // they go with h.
    for fed in [2.0, 4.0, 5.0, 7.0] {
        let largest = |n: usize| {
            let h = 0.6 / n as f64;
            let angle = |k: usize| h * (k as f64 + 0.5);
            let at = |k| total_force(&met(settings(angle(k), law(0.15, 0.5)), fed));
            let forces: Vec<DVec3> = (0..n).map(at).collect();
            let kinks = forces
                .windows(3)
                .map(|f| (f[0] - 2.0 * f[1] + f[2]).length() / h);
            kinks.fold(0.0, f64::max)
        };
        let [coarse, fine] = [300, 600].map(largest);
        println!("fed {fed}: {coarse:e} {fine:e}");
        assert!(fine < 0.6 * coarse, "{fed}: {coarse:e} {fine:e}");
    }
}

/// A wing that revolves steadily keeps its vortices at its radii in chords: turning takes along what is fed.
#[test]
fn exact_what_is_fed_in_revolution() {
    let benchmark = AirSettings::benchmark(1.0, DVec3::ZERO);
    let settings = AirSettings {
        inset: 0.0, // control points in the middle of the strips
        free_stream: DVec3::ZERO,
        rate: benchmark.rate,
        ..settings(0.0, law(0.02, 0.0))
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", ROWS, COLS)], settings).unwrap();
    let flat = rectangle(ROWS, COLS, DVec3::X, 3.0 * DVec3::Y);
    let (chord, rate, dt, last) = (1.0, 2.0, 0.02, 40);
    let motion = |t: f64| {
        let turn = r3(rate * t) * r2(0.7);
        let at = |x: &DVec3| turn * (*x + DVec3::Y);
        let position: Vec<DVec3> = flat.iter().map(at).collect();
        let velocity = position.iter().map(|x| rate * DVec3::Z.cross(*x)).collect();
        NodeMotion { position, velocity }
    };
    let run = fly(&lattice, motion, dt, last, |_, _, _, _| {}).unwrap();
    let turned = rate * dt * last as f64;
    for (k, fed) in run.state.fed.iter().enumerate() {
        let radius = 1.0 + 3.0 * (k as f64 + 0.5) / COLS as f64;
        let exact = radius / chord * (1.0 - (-turned).exp());
        assert!((fed - exact).abs() < 1e-12 * exact, "{k}: {fed} {exact}"); // roundings of 40 steps
    }
}

/// Where a plate stands still in still air with circulation left, nothing flows past its edge and no suction is
/// left to be turned.
#[test]
fn behaves_a_plate_that_stops_in_still_air_has_finite_forces() {
    let settings = AirSettings {
        free_stream: DVec3::ZERO,
        ..settings(0.0, law(0.15, 0.0))
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", ROWS, COLS)], settings).unwrap();
    let flat = rectangle(ROWS, COLS, DVec3::X, 3.0 * DVec3::Y);
    let motion = |t: f64| {
        let way = DVec3::new(-1.0, 0.0, -0.5);
        let shift = t.min(1.0) * way;
        let velocity = if t < 1.0 { way } else { DVec3::ZERO };
        translating(flat.iter().map(|x| *x + shift).collect(), velocity)
    };
    let mut last = (0.0, 1.0);
    fly(&lattice, motion, 0.125, 16, |_, _, loads, _| {
        last = (loads.gamma[0], loads.leading[0]);
        assert!(total_force(loads).is_finite());
    })
    .unwrap();
    assert!(last.0 != 0.0 && last.1 == 0.0, "{last:?}");
}

/// The state says all: a copy of it goes on bit for bit with a new workspace.
#[test]
fn invariant_a_copied_state_goes_on_bit_for_bit() {
    let surface = vec![Surface::grid("wing", ROWS, COLS)];
    let lattice = Lattice::new(surface, settings(0.5, law(0.15, 0.0))).unwrap();
    let motion = plate();
    let mut run = fly(&lattice, |_| motion.clone(), 0.3, 8, |_, _, _, _| {}).unwrap();
    let (mut copy, mut ws) = (run.state.clone(), lattice.workspace());
    let mut loads = AirLoads::default();
    for k in 9..16 {
        let t = 0.3 * f64::from(k);
        for (state, ws, loads) in [
            (&mut run.state, &mut run.ws, &mut run.loads),
            (&mut copy, &mut ws, &mut loads),
        ] {
            lattice.convect(state, 0.3, ws).unwrap();
            lattice.loads(state, t, 0.3, &motion, ws, loads).unwrap();
            lattice.accept(state, &motion, loads).unwrap();
        }
        assert_eq!(run.loads.force, loads.force);
    }
    assert!(run.state.fed.iter().all(|fed| *fed > 3.0), "lost by then");
    assert_eq!(run.state, copy);
}
