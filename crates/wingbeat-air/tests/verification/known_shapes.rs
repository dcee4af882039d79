//! Circulations from what is known of surfaces at rest, by iteration, against those from the whole matrix and its
//! factors: two methods, one answer.

use crate::common::{Run, fly, rectangle, sphere};
use wingbeat_air::{
    AirSettings, Lattice, LeadingEdge, MirrorPairs, NodeMotion, Plane, SheddingKinds, Surface,
};
use wingbeat_math::{DVec3, r1, r2};

const STREAM: DVec3 = DVec3::new(2.0, 0.0, 0.0);
const ROWS: usize = 12;
const COLUMNS: usize = 16;
const STEPS: usize = 4;

fn wing(side: f64) -> Vec<DVec3> {
    rectangle(ROWS, COLUMNS, DVec3::X, side * 2.0 * DVec3::Y)
}

fn body() -> Vec<DVec3> {
    sphere(5).0.into_iter().map(|x| 0.3 * x).collect()
}

/// Flapping wings, which bend by `bend` of their span, and a body between and below them.
fn motion(t: f64, bend: f64) -> NodeMotion {
    let mut motion = NodeMotion::default();
    let (angle, rate) = (0.5 * (3.0 * t).cos(), -1.5 * (3.0 * t).sin());
    for side in [1.0, -1.0] {
        let turn = r1(side * angle) * r2(0.1);
        for x in wing(side) {
            let bent = x + bend * (5.0 * t).sin() * x.y.powi(2) * DVec3::Z;
            let bending = 5.0 * bend * (5.0 * t).cos() * x.y.powi(2) * DVec3::Z;
            let x = turn * bent + side * 0.1 * DVec3::Y;
            motion.position.push(x);
            let v = turn * bending + side * rate * DVec3::X.cross(x);
            motion.velocity.push(v);
        }
    }
    let below = body().into_iter().map(|x| x - 1.2 * DVec3::Z);
    motion.position.extend(below);
    motion.velocity.resize(motion.position.len(), DVec3::ZERO);
    motion
}

/// With these shapes at rest, if any.
fn lattice(settings: AirSettings, rest: Option<[Vec<DVec3>; 3]>) -> Lattice {
    let right = Surface::grid("right", ROWS, COLUMNS);
    let mut left = Surface::grid("left", ROWS, COLUMNS);
    left.panels.iter_mut().for_each(|c| c.swap(1, 3));
    let (nodes, quads) = sphere(5);
    let body = Surface::closed("body", nodes.len(), quads);
    let mut surfaces = vec![right, left, body];
    if let Some(rest) = rest {
        let with = |(surface, rest): (Surface, _)| surface.with_rest(rest);
        surfaces = surfaces.into_iter().zip(rest).map(with).collect();
    }
    Lattice::new(surfaces, settings).unwrap()
}

fn rest() -> Option<[Vec<DVec3>; 3]> {
    Some([wing(1.0), wing(-1.0), body()])
}

fn settings() -> AirSettings {
    AirSettings {
        shedding: SheddingKinds {
            trailing: true,
            tip: true,
            leading: true,
            root: false,
        },
        leading: LeadingEdge::AngleOfAttack { threshold: 0.2 },
        ..AirSettings::accurate(1.2, STREAM).with_cut_off_for(0.1)
    }
}

fn run(lattice: &Lattice, bend: f64) -> Run {
    fly(lattice, |t| motion(t, bend), 0.1, STEPS, |_, _, _, _| {}).unwrap()
}

/// Residuals of some 1e-13 and deviations of a shape from that at rest of some 1e-16, over conditions of some hundred
/// and steps of a free wake close to its filaments.
const AGREE: f64 = 1e-9;

fn assert_agree(a: &Run, b: &Run) {
    let scale = a.loads.force.iter().map(|f| f.length()).fold(0.0, f64::max);
    for (a, b) in a.loads.force.iter().zip(&b.loads.force) {
        assert!(a.distance(*b) < AGREE * scale, "{a} {b}");
    }
    let residuals = [a, b].map(|run| run.loads.surfaces[2].net_flux_residual);
    assert!((residuals[0] - residuals[1]).abs() < AGREE);
    assert!(b.loads.normal_velocity_residual < 1e-11); // of speeds of order 3
}

#[test]
fn agrees_with_factors_for_rigid_and_for_bending_wings() {
    for bend in [0.0, 0.1] {
        let [a, b] = [None, rest()].map(|rest| run(&lattice(settings(), rest), bend));
        assert_agree(&a, &b);
        assert!(a.loads != b.loads, "the other method was not used");
    }
}

#[test]
fn agrees_with_factors_over_the_ground_and_without_a_matched_row() {
    let settings = AirSettings {
        images: vec![Plane {
            point: -2.0 * DVec3::Z,
            normal: DVec3::Z,
        }],
        inset: 0.0,
        ..AirSettings::benchmark(1.2, STREAM).with_cut_off_for(0.1)
    };
    let [a, b] = [None, rest()].map(|rest| run(&lattice(settings.clone(), rest), 0.0));
    assert_agree(&a, &b);
    assert!(a.loads != b.loads, "the other method was not used");
}

#[test]
fn agrees_with_factors_where_one_half_is_computed() {
    let start = motion(0.0, 0.0);
    let half = |rest| {
        let lattice = lattice(settings(), rest);
        let flip = |x: DVec3| DVec3::new(x.x, -x.y, x.z);
        let twin = |x: &DVec3| {
            let is_image = |y: &DVec3| y.distance(flip(*x)) < 1e-9;
            start.position.iter().position(is_image).unwrap()
        };
        let node: Vec<usize> = start.position.iter().map(twin).collect();
        let sorted = |mut corners: [usize; 4]| {
            corners.sort_unstable();
            corners
        };
        let panels = &lattice.topology().panels;
        let panel = |corners: &[usize; 4]| {
            let image = sorted(corners.map(|n| node[n]));
            panels.iter().position(|c| sorted(*c) == image).unwrap()
        };
        let panel = panels.iter().map(panel).collect();
        let plane = Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        };
        lattice
            .with_mirror_symmetry(MirrorPairs { plane, node, panel })
            .unwrap()
    };
    let [a, b] = [None, rest()].map(|rest| run(&half(rest), 0.1));
    assert_agree(&a, &b);
    assert!(a.loads != b.loads, "the other method was not used");
}

/// A shape that has nothing to do with the surface costs time, and nothing else.
#[test]
fn limit_wrong_shapes_do_no_harm() {
    let wrong = rest().map(|[right, left, _]| {
        let crumple = |(k, x): (usize, DVec3)| x + 0.3 * (k as f64 * DVec3::Z).map(f64::sin);
        [right, left].map(|wing| wing.into_iter().enumerate().map(crumple).collect())
    });
    let wrong = wrong.map(|[right, left]: [Vec<DVec3>; 2]| [right, left, body()]);
    let [a, b] = [None, wrong].map(|rest| run(&lattice(settings(), rest), 0.0));
    assert_agree(&a, &b);
    assert!(a.loads != b.loads, "the other method was not used");
}

#[test]
fn invariant_bits_for_any_number_of_threads_and_after_trials() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        (pool.unwrap()).install(|| run(&lattice(settings(), rest()), 0.0))
    };
    let [one, three] = [1, 3].map(with);
    assert_eq!(one.loads, three.loads);
    let lattice = lattice(settings(), rest());
    let mut state = one.state.clone();
    lattice
        .convect(&mut state, 0.1, &mut lattice.workspace())
        .unwrap();
    let t = 0.1 * (STEPS + 1) as f64;
    let last = |trials: &[f64]| {
        let (mut ws, mut loads) = (lattice.workspace(), Default::default());
        for trial in trials {
            let now = motion(*trial, 0.0);
            (lattice.loads(&state, t, 0.1, &now, &mut ws, &mut loads)).unwrap();
        }
        loads
    };
    let expected = last(&[t]);
    assert_eq!(expected, last(&[t + 0.02, t]));
    // After a trial less than 1e-5 of a panel away the velocity of the wakes is that of the trial.
    let near = last(&[t + 1e-8, t]);
    let scale = (expected.force.iter()).fold(0.0, |max: f64, f| max.max(f.length()));
    let pairs = near.force.iter().zip(&expected.force);
    let error = pairs.fold(0.0, |max: f64, (a, b)| max.max(a.distance(*b)));
    // 3e-6: what the velocity changes by over that way, near edges of the wakes.
    assert!(0.0 < error && error < 1e-5 * scale, "{:e}", error / scale);
}
