//! Surfaces joined along an edge: one lifting surface in two halves.

use crate::common::{Run, fly, rectangle, total_force};
use crate::separated::{core_of, held};
use wingbeat_air::{
    AirError, AirLoads, AirSettings, CoreModel, JoinedEdge, Lattice, LeadingEdge, LoadMethod,
    MirrorPairs, NodeMotion, Plane, SheddingKinds, Surface,
};
use wingbeat_math::{DVec3, r2};

const ROWS: usize = 3;
const COLS: usize = 4;
const ALL: SheddingKinds = SheddingKinds {
    trailing: true,
    tip: true,
    leading: true,
    root: false,
};

pub(crate) fn settings(shedding: SheddingKinds, loads: LoadMethod) -> AirSettings {
    AirSettings {
        shedding,
        loads,
        ..AirSettings::accurate(1.2, DVec3::new(2.0, 0.0, 0.3))
    }
}

/// The same where action is reaction: cores as wide as filaments are long, wakes that keep their impulse.
fn symmetric(shedding: SheddingKinds, loads: LoadMethod) -> AirSettings {
    AirSettings {
        wake_overlap: 1.0,
        bound_core: core_of(0.02)[0],
        wake_core: core_of(0.1)[0],
        ..settings(shedding, loads)
    }
}

/// The same with cores so small that those of the newest rows differ from node to node.
fn sharp(shedding: SheddingKinds) -> AirSettings {
    AirSettings {
        wake_core: CoreModel::Algebraic {
            radius: 0.005,
            viscosity: 0.0,
        },
        ..symmetric(shedding, LoadMethod::Joukowski)
    }
}

/// The same, wakes kept off the wing.
fn clear_of(settings: AirSettings) -> AirSettings {
    AirSettings {
        clearance: 0.05,
        ..settings
    }
}

/// Leading edges that hold some suction, in a stream from the side: strips on either side of the roots move aft
/// by unlike parts of a panel.
fn holding(leading: LeadingEdge) -> AirSettings {
    let without_tips = SheddingKinds { tip: false, ..ALL };
    AirSettings {
        leading,
        free_stream: DVec3::new(2.0, 0.6, 0.3),
        ..settings(without_tips, LoadMethod::Joukowski)
    }
}

/// Places over the span from -2 to 2 as a wing with a flapping, twisting, V-shaped motion has them.
fn moved(x: DVec3, t: f64, amplitude: f64) -> [DVec3; 2] {
    let at = |t: f64| {
        let (flap, twist) = (
            amplitude * (3.0 * t).cos(),
            0.3 * amplitude * (3.0 * t).sin(),
        );
        let arm = r2(0.1 + twist * x.y.abs()) * DVec3::new(x.x, 0.0, 0.0);
        // Both halves rise together; the plane of symmetry keeps its nodes.
        arm + DVec3::new(0.0, x.y * flap.cos(), x.y.abs() * flap.sin())
    };
    let h = 1e-4; // the same differences for one wing and two halves
    [at(t), (at(t + h) - at(t - h)) / (2.0 * h)]
}

pub(crate) fn motion(places: &[DVec3], t: f64, amplitude: f64) -> NodeMotion {
    let mut motion = NodeMotion::default();
    for x in places {
        let [p, v] = moved(*x, t, amplitude);
        motion.position.push(p);
        motion.velocity.push(v);
    }
    motion
}

/// Right and left half, root to tip.
pub(crate) fn halves() -> Vec<DVec3> {
    let half = |side: f64| rectangle(ROWS, COLS, DVec3::X, side * 2.0 * DVec3::Y);
    [half(1.0), half(-1.0)].concat()
}

/// One wing from right to left tip.
fn whole() -> Vec<DVec3> {
    let places = rectangle(ROWS, 2 * COLS, DVec3::X, -4.0 * DVec3::Y);
    places.into_iter().map(|x| x + 2.0 * DVec3::Y).collect()
}

/// The halves' normals point the same way: the right one's panels run the other way round, and begin at
/// the corner where those of the whole wing begin (a warped panel has its area along one diagonal).
fn surfaces() -> [Surface; 2] {
    let mut right = Surface::grid("right", ROWS, COLS);
    for c in &mut right.panels {
        *c = [c[3], c[2], c[1], c[0]];
    }
    [right, Surface::grid("left", ROWS, COLS)]
}

fn joined_edge() -> JoinedEdge {
    JoinedEdge {
        surfaces: [0, 1],
        nodes: (0..=ROWS).map(|i| [i * (COLS + 1); 2]).collect(),
    }
}

pub(crate) fn pair(settings: AirSettings) -> Lattice {
    Lattice::joined(surfaces().to_vec(), &[joined_edge()], settings).unwrap()
}

fn run(lattice: &Lattice, places: &[DVec3], amplitude: f64) -> Run {
    let steps = if amplitude == 0.0 { 12 } else { 10 };
    fly(
        lattice,
        |t| motion(places, t, amplitude),
        0.1,
        steps,
        |_, _, _, _| {},
    )
    .unwrap()
}

/// Number of the panel of the whole wing that panel `p` of the pair is.
fn counterpart(p: usize) -> usize {
    let (side, p) = (p / (ROWS * COLS), p % (ROWS * COLS));
    let (i, j) = (p / COLS, p % COLS);
    i * 2 * COLS + if side == 0 { COLS - 1 - j } else { COLS + j }
}

#[test]
fn exact_joined_pair_is_one_wing_of_twice_the_span() {
    let trailing = SheddingKinds::TRAILING;
    let with_tips = SheddingKinds {
        tip: true,
        ..trailing
    };
    for (settings, amplitude) in [
        (settings(trailing, LoadMethod::Pressure), 0.0),
        (settings(trailing, LoadMethod::Joukowski), 0.5),
        (settings(with_tips, LoadMethod::Polhamus), 0.5),
        (settings(ALL, LoadMethod::Pressure), 0.5),
        (symmetric(with_tips, LoadMethod::Joukowski), 0.5),
        (symmetric(ALL, LoadMethod::Joukowski), 0.5),
        (sharp(with_tips), 0.5),
        (sharp(ALL), 0.5),
        (holding(held(0.15, 0.0)), 0.5),
    ] {
        let (shedding, loads) = (settings.shedding, settings.loads);
        let kinds = SheddingKinds {
            root: shedding.tip,
            ..shedding
        };
        let one = Surface::grid("whole", ROWS, 2 * COLS);
        // The root of the whole wing is its other tip.
        let lattice = Lattice::new(
            vec![one],
            AirSettings {
                shedding: kinds,
                ..settings.clone()
            },
        );
        let a = run(&lattice.unwrap(), &whole(), amplitude);
        let b = run(&pair(settings), &halves(), amplitude);
        let scale = total_force(&a.loads).length();
        let mut worst = 0.0_f64;
        for p in 0..2 * ROWS * COLS {
            let difference = b.loads.force[p] - a.loads.force[counterpart(p)];
            worst = worst.max(difference.length() / scale);
        }
        println!("{loads:?}, {shedding:?}: {worst:.1e} of the force");
        // Roundings of another order of elimination, amplified by a free wake.
        assert!(worst < 1e-9);
        // None where rings are in their place; the same where strips have been moved aft.
        let [one, pair] = [&a, &b].map(|run| run.loads.normal_velocity_residual);
        assert!((pair - one).abs() < 1e-12);
    }
}

/// The right half of the pair, its root on a plane of images, as a wing stands on the wall of a wind tunnel.
fn half(settings: AirSettings) -> Lattice {
    half_at(DVec3::ZERO, settings)
}

/// The same with the wall through this point \[m\].
fn half_at(point: DVec3, settings: AirSettings) -> Lattice {
    let [right, _] = surfaces();
    let wall = Plane {
        point,
        normal: DVec3::Y,
    };
    let settings = AirSettings {
        images: vec![wall],
        ..settings
    };
    let root = JoinedEdge::on_plane(0, (0..=ROWS).map(|i| i * (COLS + 1)));
    Lattice::joined(vec![right], &[root], settings).unwrap()
}

#[test]
fn exact_half_on_a_plane_of_images_is_half_of_the_joined_pair() {
    let trailing = SheddingKinds::TRAILING;
    let with_tips = SheddingKinds {
        tip: true,
        ..trailing
    };
    let one_column = |lattice: &Lattice| lattice.topology().plane_columns.len();
    for (settings, amplitude) in [
        (settings(trailing, LoadMethod::Pressure), 0.0),
        (settings(trailing, LoadMethod::Joukowski), 0.5),
        (settings(with_tips, LoadMethod::Polhamus), 0.5),
        (settings(ALL, LoadMethod::Pressure), 0.5),
        (symmetric(with_tips, LoadMethod::Joukowski), 0.5),
        (symmetric(ALL, LoadMethod::Joukowski), 0.5),
        (sharp(with_tips), 0.5),
        (sharp(ALL), 0.5),
        // Wakes that the wing keeps off, at the root with the side across the plane.
        (clear_of(sharp(ALL)), 0.5),
    ] {
        let (shedding, loads) = (settings.shedding, settings.loads);
        // Where all other edges shed, what left the leading edge and the trailing edge lies on the plane.
        let on_plane = half(settings.clone());
        assert_eq!(one_column(&on_plane), if shedding.leading { 2 } else { 1 });
        let places = halves();
        let a = run(&pair(settings), &places, amplitude);
        let b = run(&on_plane, &places[..places.len() / 2], amplitude);
        let scale = total_force(&a.loads).length();
        let difference = |p: usize| (b.loads.force[p] - a.loads.force[p]).length();
        let worst = (0..ROWS * COLS).map(difference).fold(0.0, f64::max) / scale;
        println!("{loads:?}, {shedding:?}: {worst:.1e} of the force");
        // Roundings of another order of elimination, amplified by a free wake.
        assert!(worst < 1.5e-12);
        let [pair, half] = [&a, &b].map(|run| run.loads.normal_velocity_residual);
        assert!((pair - half).abs() < 1e-12);
    }
}

/// Filaments of half a model end on the wall: along it their impulse and its account are half of those of the pair, whose
/// rings are closed, wherever the wall is.
#[test]
fn exact_impulse_of_half_a_model_along_its_wall_is_half_of_the_pair_s() {
    let all_around = AirSettings {
        max_rows: Some(4),
        ..symmetric(ALL, LoadMethod::Joukowski)
    };
    let trailing = settings(SheddingKinds::TRAILING, LoadMethod::Joukowski);
    let places = halves();
    for (settings, amplitude) in [(trailing, 0.0), (all_around, 0.5)] {
        let whole = run(&pair(settings.clone()), &places, amplitude).loads;
        for wall in [DVec3::ZERO, 10.0 * DVec3::Y] {
            let beside = |t: f64| {
                let mut motion = motion(&places[..places.len() / 2], t, amplitude);
                motion.position.iter_mut().for_each(|x| *x += wall);
                motion
            };
            let steps = if amplitude == 0.0 { 12 } else { 10 };
            let lattice = half_at(wall, settings.clone());
            let half = fly(&lattice, beside, 0.1, steps, |_, _, _, _| {}).unwrap();
            let parts = |loads: &AirLoads| {
                let account = loads.account;
                [loads.impulse, account.created, account.moved, account.cut].map(|i| i.with_y(0.0))
            };
            let [whole, half] = [&whole, &half.loads].map(parts);
            let apart = whole.iter().zip(half).map(|(w, h)| w.distance(2.0 * h));
            let worst = apart.fold(0.0, f64::max) / whole[0].length();
            println!("wall at {wall}: {worst:.1e} of {whole:?}");
            assert_eq!(whole[3] != DVec3::ZERO, amplitude != 0.0);
            // 1e-15: roundings, of places ten metres off too.
            assert!(worst < 1e-14, "{wall}: {worst:e}");
        }
    }
}

#[test]
fn refuses_an_edge_on_a_plane_that_there_is_not_or_that_it_leaves() {
    let root = || JoinedEdge::on_plane(0, (0..=ROWS).map(|i| i * (COLS + 1)));
    let trailing = settings(SheddingKinds::TRAILING, LoadMethod::Pressure);
    let [right, _] = surfaces();
    let without = Lattice::joined(vec![right], &[root()], trailing.clone());
    assert!(matches!(without, Err(AirError::JoinedEdge { edge: 0, .. })));
    let places: Vec<DVec3> = halves()[..(ROWS + 1) * (COLS + 1)].to_vec();
    let leaving = |t: f64| {
        let mut motion = motion(&places, 0.0, 0.0);
        motion.position.iter_mut().for_each(|x| x.y += t);
        motion
    };
    let flown = fly(&half(trailing), leaving, 0.1, 2, |_, _, _, _| {});
    assert!(matches!(
        flown,
        Err(AirError::OffPlane {
            step: 1,
            node: 0,
            ..
        })
    ));
}

#[test]
fn exact_no_vortex_leaves_the_joined_roots() {
    let settings = settings(SheddingKinds::TRAILING, LoadMethod::Pressure);
    let places = halves();
    let lift = |lattice: &Lattice| {
        let run = run(lattice, &places, 0.0);
        let root = run.loads.gamma[0] - run.loads.gamma[ROWS * COLS];
        (total_force(&run.loads).z, root, run)
    };
    let (joined, difference, run) = lift(&pair(settings.clone()));
    // The filament on the joined edge has the difference of the circulations on either side: none by symmetry.
    assert!(difference.abs() < 1e-12 * run.loads.gamma[0].abs());
    let two = Lattice::new(surfaces().to_vec(), settings).unwrap();
    let (parted, _, _) = lift(&two);
    println!("lift joined {joined:.4}, two wings with their roots together {parted:.4}");
    assert!(joined > 1.02 * parted); // each of the two loses the lift at its root
    // Tied wake nodes stay one to the bit.
    let [right, left] = [0, 1].map(|k| &run.state.sheets[k]);
    for r in 0..right.rows() {
        assert_eq!(right.node(r, COLS), left.node(r, COLS));
    }
}

#[test]
fn agrees_half_of_a_joined_pair_with_both_halves() {
    let places = halves();
    let count = |n: usize| (0..2 * n).map(|k| (k + n) % (2 * n)).collect::<Vec<_>>();
    let pairs = MirrorPairs {
        plane: Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        },
        node: count((ROWS + 1) * (COLS + 1)),
        panel: count(ROWS * COLS),
    };
    for settings in [settings, symmetric].map(|of| of(ALL, LoadMethod::Joukowski)) {
        let both = pair(settings);
        let half = both.clone().with_mirror_symmetry(pairs.clone()).unwrap();
        let [both, half] = [both, half].map(|lattice| run(&lattice, &places, 0.5));
        let scale = total_force(&both.loads).length();
        let forces = both.loads.force.iter().zip(&half.loads.force);
        let worst = forces.fold(0.0_f64, |most, (a, b)| most.max(a.distance(*b) / scale));
        println!("{worst:.1e} of the force");
        assert!(worst < 1e-9); // roundings in a free wake
        assert_eq!(
            half.loads.gamma[..ROWS * COLS],
            half.loads.gamma[ROWS * COLS..]
        );
        let middle = half.state.sheets[0].node(0, half.state.sheets[0].columns);
        assert_eq!(middle.y, 0.0);
    }
}

#[test]
fn refuses_joined_edges_that_do_not_fit() {
    let settings = settings(SheddingKinds::TRAILING, LoadMethod::Pressure);
    let join = |surfaces: Vec<Surface>, edge: JoinedEdge| {
        let error = Lattice::joined(surfaces, &[edge], settings.clone());
        error.unwrap_err().to_string()
    };
    let good = || surfaces().to_vec();
    let with = |change: &dyn Fn(&mut JoinedEdge)| {
        let mut edge = joined_edge();
        change(&mut edge);
        join(good(), edge)
    };
    assert!(with(&|s| s.surfaces[1] = 7).contains("no such surface"));
    assert!(with(&|s| s.surfaces[1] = 0).contains("no plane of images"));
    assert!(with(&|s| s.nodes[2][1] = 99).contains("node does not exist"));
    assert!(with(&|s| s.nodes.truncate(1)).contains("two pairs"));
    assert!(with(&|s| s.nodes.swap(0, 1)).contains("no edge"));
    let mut other_way = good();
    other_way[0] = Surface::grid("right", ROWS, COLS);
    let error = join(other_way, joined_edge());
    assert!(
        error.contains("left") && error.contains("same way"),
        "{error}"
    );

    let lattice = pair(settings.clone());
    let mut apart = motion(&halves(), 0.0, 0.0);
    apart.position[COLS + 1].z += 1e-3;
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    let state = lattice.initial_state(&apart);
    let error = lattice.loads(&state, 0.0, 0.1, &apart, &mut ws, &mut loads);
    let error = error.unwrap_err();
    assert!(matches!(error, AirError::JoinOpen { .. }));
    let text = error.to_string();
    assert!(
        text.contains("node 5 of surface right") && text.contains("left"),
        "{text}"
    );
}
