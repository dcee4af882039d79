//! Wakes: Kutta condition, total circulation, robustness in hover.

use crate::common::{fly, rectangle, total_force, translating};
use wingbeat_air::{
    AirLoads, AirSettings, AirState, AirWorkspace, CoreModel, EdgeKind, Lattice, NodeMotion,
    Points, SheddingKinds, Surface,
};
use wingbeat_math::{DVec3, r1, r2};

pub(crate) const ALL: SheddingKinds = SheddingKinds {
    trailing: true,
    tip: true,
    leading: true,
    root: false,
};

/// Circulation around the rectangle [x0, x1] x [z0, z1] in the plane y, right-handed about +y, by
/// Simpson's rule.
fn circulation(
    lattice: &Lattice,
    state: &AirState,
    ws: &mut AirWorkspace,
    [x0, x1, z0, z1]: [f64; 4],
    y: f64,
) -> f64 {
    let corner =
        [[x0, z0], [x0, z1], [x1, z1], [x1, z0], [x0, z0]].map(|[x, z]| DVec3::new(x, y, z));
    let n = 400;
    let mut sum = 0.0;
    for side in corner.windows(2) {
        let path = side[1] - side[0];
        let at = |k: usize| side[0] + path * (k as f64 / n as f64);
        let points: Points = (0..=n).map(at).collect();
        let mut v = Points::default();
        lattice.velocity(state, &points, ws, &mut v).unwrap();
        for k in 0..=n {
            let weight = if k == 0 || k == n {
                1.0
            } else {
                2.0 + 2.0 * (k % 2) as f64
            };
            sum += weight / (3.0 * n as f64) * v.get(k).dot(path);
        }
    }
    sum
}

/// A wing at 0.2 rad in a stream, accelerating, so that every wake row has its own circulation.
fn growing(shedding: SheddingKinds) -> (Lattice, impl Fn(f64) -> NodeMotion) {
    let settings = AirSettings {
        shedding,
        ..AirSettings::benchmark(1.2, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 5)], settings).unwrap();
    let flat: Vec<DVec3> = rectangle(4, 5, DVec3::X, 2.5 * DVec3::Y)
        .iter()
        .map(|x| r2(0.2) * *x)
        .collect();
    let motion = move |t: f64| {
        let path = DVec3::new(-0.5 * t * t, 0.0, 0.0);
        translating(
            flat.iter().map(|x| *x + path).collect(),
            DVec3::new(-t, 0.0, 0.0),
        )
    };
    (lattice, motion)
}

/// Kelvin: no circulation about wing and wake together; about the wing alone, the wake cut between
/// the trailing edge and the next row, that of the panel as it was when the ring was shed.
#[test]
fn conserves_total_circulation() {
    let (lattice, motion) = growing(SheddingKinds::TRAILING);
    let mut shed = 0.0;
    let mut last = 0.0;
    let mut run = fly(&lattice, motion, 0.25, 6, |_, state, _, _| {
        (shed, last) = (last, state.gamma[17]); // panel in the middle of the trailing edge
    })
    .unwrap();
    let trailing = run.state.position[4 * 6 + 2].x;
    let (y, ws) = (1.25, &mut run.ws);
    let far = [trailing - 4.0, trailing + 8.0, -4.0, 4.0];
    let total = circulation(&lattice, &run.state, ws, far, y);
    // Simpson's rule on 400 intervals, 4 m from everything.
    assert!(total.abs() < 1e-8 * last, "{total}");
    let sheet = &run.state.sheets[0];
    let next = sheet.node(sheet.rows() - 1, 2).x;
    let wing = [trailing - 4.0, 0.5 * (trailing + next), -4.0, 4.0];
    let about = circulation(&lattice, &run.state, ws, wing, y);
    println!("about the wing {about:.6}, shed {shed:.6}, now {last:.6}");
    // The path crosses the sheet between filaments half a metre apart.
    assert!((about - shed).abs() < 1e-4 * shed);
    assert!(last > 1.02 * shed && shed > 0.0);
}

/// Each kind of edge sheds with the sign of its panel: the newest rings carry the circulation of
/// the panels at the step they left, and a shedding edge only what has changed since.
#[test]
fn exact_newest_rings_continue_the_panels() {
    let (lattice, motion) = growing(ALL);
    assert_eq!(lattice.sheets().len(), 1); // one unbroken line around leading edge, tip, trailing edge
    assert_eq!(lattice.sheets()[0].kinds[..6].last(), Some(&EdgeKind::Tip));
    let mut run = fly(&lattice, motion, 0.25, 3, |_, _, _, _| {}).unwrap();
    let before = run.state.gamma.clone();
    lattice.convect(&mut run.state, 0.25, &mut run.ws).unwrap();
    let (sheet, root) = (&run.state.sheets[0], &lattice.sheets()[0]);
    let newest = &sheet.gamma[sheet.gamma.len() - sheet.columns..];
    for (c, &ring) in newest.iter().enumerate() {
        assert_eq!(ring, root.signs[c] * before[root.panels[c]]);
    }
    let motion = translating(run.state.position.clone(), DVec3::ZERO);
    let (ws, loads) = (&mut run.ws, &mut run.loads);
    lattice
        .loads(&run.state, 1.0, 0.25, &motion, ws, loads)
        .unwrap();
    for (edge, net) in lattice
        .topology()
        .edges
        .iter()
        .zip(&ws.filaments().bound.gamma)
    {
        if edge.wake.is_some() {
            let change = loads.gamma[edge.plus] - before[edge.plus];
            assert!((net - change).abs() < 1e-15); // one rounding
        }
    }
}

/// What is left after dropping old rows is what was there before, and is made of closed rings: no
/// filament begins or ends.
#[test]
fn exact_truncation_keeps_rings_closed() {
    let (whole, motion) = growing(ALL);
    let settings = AirSettings {
        max_rows: Some(3),
        ..whole.settings().clone()
    };
    let short = Lattice::new(whole.surfaces().to_vec(), settings).unwrap();
    let mut run = fly(&short, motion, 0.25, 6, |_, _, _, _| {}).unwrap();
    assert_eq!(run.state.sheets[0].rows(), 3);
    short.impulse(&run.state, &mut run.ws).unwrap();
    let filaments = run.ws.filaments();
    let (nodes, width) = (
        filaments.wake.nodes.len(),
        filaments.near_wake.nodes.len() / 2,
    );
    let mut sum = vec![0.0; nodes + filaments.bound.nodes.len()];
    let shed = &short.sheets()[0].nodes;
    // The near wake joins the newest free row of the wake to nodes of the lattice.
    let in_near_wake = |n: usize| match n.checked_sub(width) {
        Some(c) => nodes + shed[c],
        None => nodes - width + n,
    };
    let mut flow = |[a, b]: [usize; 2], g: f64| {
        sum[a] -= g;
        sum[b] += g;
    };
    let ends = |[a, b]: [u32; 2]| [a as usize, b as usize];
    let (wake, near_wake, bound) = (&filaments.wake, &filaments.near_wake, &filaments.bound);
    for (&edge, &g) in wake.edges.iter().zip(&wake.gamma) {
        flow(ends(edge), g);
    }
    for (&edge, &g) in near_wake.edges.iter().zip(&near_wake.gamma) {
        flow(ends(edge).map(in_near_wake), g);
    }
    for (&edge, &g) in bound.edges.iter().zip(&bound.gamma) {
        flow(ends(edge).map(|n| nodes + n), g);
    }
    // As much vorticity enters every node as leaves it, but for roundings.
    assert!(sum.iter().all(|s| s.abs() < 1e-14), "{sum:?}");
}

/// Two wings in hover, started at full speed, all edges shedding, through two beats.
fn hover(
    core: CoreModel,
    wake_overlap: f64,
    max_displacement: Option<f64>,
) -> (f64, wingbeat_air::WakeEvents) {
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        wake_overlap,
        shedding: ALL,
        max_rows: Some(60),
        clearance: 0.05,
        max_displacement,
        ..AirSettings::benchmark(1.2, DVec3::ZERO)
    };
    let wings = ["right", "left"].map(|name| Surface::grid(name, 4, 6));
    let lattice = Lattice::new(wings.to_vec(), settings).unwrap();
    let mut largest = 0.0_f64;
    let run = fly(
        &lattice,
        hover_motion,
        0.025,
        80,
        |_, _, loads: &AirLoads, _| {
            largest = largest.max(total_force(loads).length());
        },
    )
    .unwrap();
    (largest, run.state.events)
}

/// Two wings of 4 x 6 panels that beat once a second.
fn hover_motion(t: f64) -> NodeMotion {
    let w = std::f64::consts::TAU;
    let (stroke, rate) = (1.0 * (w * t).sin(), w * (w * t).cos());
    let mut motion = NodeMotion::default();
    for side in [1.0, -1.0] {
        let turn = r1(side * stroke) * r2(0.8 * (w * t).cos());
        for x in rectangle(4, 6, DVec3::X, side * 3.0 * DVec3::Y) {
            let x = turn * (x - 0.25 * DVec3::X) + side * 0.2 * DVec3::Y;
            motion.position.push(x);
            // Feathering turns about the wing's own span axis.
            let feather = -0.8 * w * (w * t).sin() * (r1(side * stroke) * DVec3::Y);
            let arm = x - side * 0.2 * DVec3::Y;
            let v = (side * rate * DVec3::X + feather).cross(arm);
            motion.velocity.push(v);
        }
    }
    motion
}

#[test]
fn limit_impulsive_hover_stays_bounded() {
    let (largest, events) = hover(CoreModel::Vatistas { radius: 0.15 }, 0.0, Some(0.5));
    // Scale of the force: density x (tip speed)^2 x area, with tip speed 2 pi x 3.2.
    let scale = 1.2 * (std::f64::consts::TAU * 3.2_f64).powi(2) * 6.0;
    println!(
        "hover: largest force {:.3} of scale, {events:?}",
        largest / scale
    );
    assert!(largest < 3.0 * scale);
    assert!(events.near_surface > 0); // wings cut through their own wakes, and it is counted
}

/// Cores of a twentieth of the wake's spacing: without overlap nearby filaments fling each other
/// away, with it the same hover stays as quiet as with wide cores.
#[test]
fn limit_overlapping_cores_keep_hover_bounded_without_a_displacement_limit() {
    let core = CoreModel::Vatistas { radius: 0.01 };
    let [bare, overlapping] = [0.0, 1.0].map(|overlap| hover(core, overlap, None).0);
    let scale = 1.2 * (std::f64::consts::TAU * 3.2_f64).powi(2) * 6.0;
    println!(
        "hover: largest force {:.3} bare, {:.3} overlapping, of scale",
        bare / scale,
        overlapping / scale
    );
    assert!(overlapping < 3.0 * scale);
    assert!(overlapping < bare);
}

#[test]
fn exact_displacement_limit_counts_what_it_shortens() {
    let core = CoreModel::Vatistas { radius: 0.15 };
    let (_, free) = hover(core, 0.0, None);
    let (_, tight) = hover(core, 0.0, Some(0.02));
    assert_eq!(free.limited, 0);
    assert!(tight.limited > 0);
}

/// A filament and the blob it becomes are the same to first order far off, and have the same impulse.
#[test]
fn exact_blobs_keep_the_impulse_and_the_far_field() {
    let (lattice, motion) = growing(ALL);
    let with = |length: Option<f64>| {
        let core = CoreModel::LambOseen {
            radius: 0.1,
            viscosity: 0.0,
        };
        let settings = AirSettings {
            bound_core: core,
            wake_core: core,
            wake_overlap: 1.0,
            wake_blob_length: length,
            ..lattice.settings().clone()
        };
        Lattice::new(lattice.surfaces().to_vec(), settings).unwrap()
    };
    let whole = with(None);
    let run = fly(&whole, motion, 0.25, 6, |_, _, _, _| {}).unwrap();
    let far = Points::from_iter([DVec3::new(40.0, 30.0, -20.0), DVec3::new(-9.0, 60.0, 15.0)]);
    let of = |lattice: &Lattice| {
        let (mut ws, mut v) = (lattice.workspace(), Points::zeros(2));
        let impulse = lattice.impulse(&run.state, &mut ws).unwrap();
        let [filaments, blobs] = [ws.filaments().wake.len(), ws.filaments().blobs.len()];
        lattice.velocity(&run.state, &far, &mut ws, &mut v).unwrap();
        (impulse, v, [filaments, blobs])
    };
    let (impulse, velocity, [all, none]) = of(&whole);
    // All of them blobs; all filaments still, the longest in part blobs.
    for (length, is_mixed) in [(0.01, false), (0.5, true)] {
        let (same, alike, [filaments, blobs]) = of(&with(Some(length)));
        assert!(none == 0 && blobs > 0 && filaments == if is_mixed { all } else { 0 });
        assert!((same - impulse).length() < 1e-14 * impulse.length());
        for (a, b) in alike.iter().zip(velocity.iter()) {
            // The quadrupoles differ: the filaments' length over the distance, squared.
            assert!((a - b).length() < 2e-4 * b.length(), "{a} {b}");
        }
    }
}
