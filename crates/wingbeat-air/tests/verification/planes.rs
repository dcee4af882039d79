//! Planes of symmetry and grounds: what air and which surfaces may be beside them, and two of them at once.

use crate::common::{Run, fly, rectangle, total_force, translating};
use wingbeat_air::{
    AirError, AirSettings, AirState, Gust, GustShape, JoinedEdge, Lattice, LeadingEdge, LoadMethod,
    MirrorPairs, NodeMotion, Plane, SheddingKinds, Surface, VortexStreet, Wind,
};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_vortex::{CoreModel, Method};

fn plane(normal: DVec3, point: DVec3) -> Plane {
    Plane { point, normal }
}

fn gust(amplitude: DVec3, slowness: DVec3) -> Wind {
    let shape = GustShape::OneMinusCosine { duration: 1.0 };
    let gust = Gust {
        amplitude,
        start: 0.0,
        slowness,
        shape,
    };
    Wind {
        gusts: vec![gust],
        ..Wind::default()
    }
}

fn shear(matrix: DMat3) -> Wind {
    Wind {
        shear: Some(matrix),
        ..Wind::default()
    }
}

fn street(axis: DVec3) -> Wind {
    let street = VortexStreet {
        circulation: 0.1,
        spacing: 1.0,
        width: 0.3,
        concentration: 0.9,
        drift: DVec3::X,
        axis,
        point: DVec3::ZERO,
    };
    Wind {
        street: Some(street),
        ..Wind::default()
    }
}

/// Velocity `rate * x[of]` along `along`.
fn rising(along: usize, of: usize) -> DMat3 {
    let mut m = DMat3::ZERO;
    m.col_mut(of)[along] = 3.0;
    m
}

/// Two wings that are each other's image in the plane y = 0.5.
fn mirrored(change: impl Fn(&mut AirSettings)) -> Result<Lattice, AirError> {
    let mut wings = ["right", "left"].map(|name| Surface::grid(name, 2, 2));
    wings[1].panels.iter_mut().for_each(|c| c.reverse());
    let mut settings = AirSettings::accurate(1.2, DVec3::X);
    change(&mut settings);
    let other = |n: usize| (0..2 * n).map(|k| (k + n) % (2 * n)).collect();
    let pairs = MirrorPairs {
        plane: plane(DVec3::Y, 0.5 * DVec3::Y),
        node: other(9),
        panel: other(4),
    };
    Lattice::new(wings.to_vec(), settings)?.with_mirror_symmetry(pairs)
}

#[test]
fn refuses_to_compute_one_half_in_air_that_is_not_its_own_mirror_image() {
    type Change = (&'static str, fn(&mut AirSettings));
    let refused: [Change; 9] = [
        ("stream", |s| s.free_stream.y = 1e-3),
        ("gust", |s| {
            s.wind = gust(DVec3::new(1.0, 0.1, 0.0), DVec3::ZERO)
        }),
        ("front", |s| s.wind = gust(DVec3::X, 0.1 * DVec3::Y)),
        ("shear", |s| s.wind = shear(rising(0, 1))),
        ("shear", |s| s.wind = shear(rising(1, 0))),
        // Along the normal, but not at rest in the plane y = 0.5.
        ("shear", |s| s.wind = shear(rising(1, 1) - rising(0, 0))),
        ("street", |s| s.wind = street(DVec3::Z)),
        ("ground", |s| {
            s.images = vec![plane(DVec3::new(0.0, 0.3, 1.0), -DVec3::Z)]
        }),
        ("ground", |s| {
            s.images = vec![plane(DVec3::Y, 9.0 * DVec3::Y)]
        }),
    ];
    for (k, (part, change)) in refused.iter().enumerate() {
        match mirrored(change) {
            Err(AirError::AsymmetricAir { what }) => assert!(what.contains(part), "{k} {what}"),
            other => panic!("{k} {part}: {:?}", other.map(|_| ())),
        }
    }
    let flown: [fn(&mut AirSettings); 6] = [
        |s| s.free_stream = DVec3::new(1.0, 0.0, 2.0),
        |s| s.wind = gust(DVec3::new(1.0, 0.0, 0.3), 0.1 * DVec3::Z),
        |s| s.wind = shear(rising(0, 2)),
        |s| s.wind = street(DVec3::Y),
        |s| s.images = vec![plane(-2.0 * DVec3::Z, -DVec3::Z)],
        // Two walls whose images in y = 0.5 are each other.
        |s| {
            let walls = [DVec3::new(0.0, 1.0, 1.0), DVec3::new(0.0, -1.0, 1.0)];
            s.images = walls.map(|n| plane(n, DVec3::new(0.0, 0.5, -9.0))).to_vec();
        },
    ];
    for (k, change) in flown.iter().enumerate() {
        assert!(mirrored(change).is_ok(), "{k}");
    }
}

#[test]
fn refuses_air_that_goes_through_a_ground() {
    let beside = |wind: Wind, images: Vec<Plane>| {
        let settings = AirSettings {
            wind,
            images,
            ..AirSettings::accurate(1.2, DVec3::X)
        };
        Lattice::new(vec![Surface::grid("wing", 2, 2)], settings)
    };
    let ground = || vec![plane(-DVec3::Z, 2.0 * DVec3::Z)];
    let through = [
        ("gust", gust(DVec3::new(1.0, 0.0, 0.1), DVec3::ZERO)),
        ("shear", shear(rising(2, 0))),
        // Nothing at z = 0, but something at the ground.
        ("shear", shear(rising(2, 2) - rising(0, 0))),
        ("vortex street", street(DVec3::Y)),
    ];
    for (part, wind) in through {
        match beside(wind, ground()) {
            Err(AirError::WindThroughPlane { part: named }) => assert_eq!(named, part),
            other => panic!("{part}: {:?}", other.map(|_| ())),
        }
    }
    let across_stream = vec![plane(DVec3::X, -2.0 * DVec3::X)];
    let through = beside(Wind::default(), across_stream).err();
    assert_eq!(through, Some(AirError::WindThroughPlane { part: "stream" }));
    let along = [
        gust(DVec3::new(1.0, 2.0, 0.0), DVec3::Z),
        shear(rising(0, 2)),
        street(DVec3::Z),
    ];
    for wind in along {
        assert!(beside(wind, ground()).is_ok());
    }
    let at_rest = vec![plane(DVec3::Z, DVec3::ZERO)];
    assert!(beside(shear(rising(2, 2) - rising(0, 0)), at_rest).is_ok());
}

#[test]
fn refuses_surfaces_on_both_sides_of_a_ground() {
    let settings = AirSettings {
        images: vec![plane(DVec3::Z, DVec3::ZERO)],
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let surfaces = ["fore", "hind"].map(|name| Surface::grid(name, 2, 2));
    let lattice = Lattice::new(surfaces.to_vec(), settings).unwrap();
    let flight = |drop: f64| {
        let flat = rectangle(2, 2, DVec3::X, DVec3::Y);
        let mut nodes: Vec<DVec3> = flat.iter().map(|x| *x + DVec3::Z).collect();
        // The last node of the second wing comes down to `drop`.
        nodes.extend(
            flat.iter()
                .map(|x| *x + (1.0 + (drop - 1.0) * x.x * x.y) * DVec3::Z),
        );
        let still = translating(nodes, DVec3::ZERO);
        fly(&lattice, |_| still.clone(), 0.1, 0, |_, _, _, _| {}).map(|_| ())
    };
    assert_eq!(flight(0.0), Ok(())); // it touches
    let error = flight(-0.25).unwrap_err();
    let named = AirError::ThroughPlane {
        step: 0,
        surface: "hind".to_owned(),
        node: 8,
        depth: 0.25,
    };
    assert_eq!(error, named);
}

#[test]
fn refuses_a_trailing_edge_joined_to_a_leading_edge() {
    let surfaces = ["wing", "flap"].map(|name| Surface::grid(name, 2, 2));
    let hinge = JoinedEdge {
        surfaces: [0, 1],
        nodes: (0..3).map(|j| [6 + j, j]).collect(),
    };
    let settings = AirSettings::accurate(1.2, DVec3::X);
    let error = Lattice::joined(surfaces.to_vec(), &[hinge], settings).unwrap_err();
    assert!(matches!(error, AirError::JoinedEdge { edge: 0, .. }));
}

/// A wing that plunges towards the corner of two walls, itself and the images that are flown with it; panels of
/// one reflection run the other way round.
fn in_a_corner(images: &[[f64; 2]], planes: Vec<Plane>) -> Run {
    let algebraic = |radius| CoreModel::Algebraic {
        radius,
        viscosity: 1e-3,
    };
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            root: true,
            ..SheddingKinds::TRAILING
        },
        bound_core: algebraic(0.05),
        wake_core: algebraic(0.1),
        wake_overlap: 1.0,
        loads: LoadMethod::Joukowski,
        leading: LeadingEdge::Always,
        images: planes,
        summation: Method::Direct,
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let sides = || std::iter::once(&[1.0, 1.0]).chain(images);
    let surface = |[y, z]: &[f64; 2]| {
        let mut wing = Surface::grid("wing", 3, 4);
        if y * z < 0.0 {
            wing.panels.iter_mut().for_each(|c| c.reverse());
        }
        wing
    };
    let lattice = Lattice::new(sides().map(surface).collect(), settings).unwrap();
    let flat = rectangle(3, 4, DVec3::new(0.9, 0.0, -0.3), 1.5 * DVec3::Y);
    let motion = |t: f64| {
        let at = DVec3::new(0.0, 0.3, 0.8 - 0.4 * t);
        let mut motion = NodeMotion::default();
        for [y, z] in sides() {
            let image = |x: DVec3| x * DVec3::new(1.0, *y, *z);
            motion.position.extend(flat.iter().map(|x| image(*x + at)));
            let velocity = vec![image(-0.4 * DVec3::Z); flat.len()];
            motion.velocity.extend(velocity);
        }
        motion
    };
    fly(&lattice, motion, 0.1, 8, |_, _, _, _| {}).unwrap()
}

#[test]
fn agrees_two_planes_with_four_wings_flown_together() {
    let walls = [DVec3::Y, DVec3::Z].map(|n| plane(n, DVec3::ZERO)).to_vec();
    let images = in_a_corner(&[], walls);
    let four = in_a_corner(&[[-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]], vec![]);
    let [one, first] = [&images, &four].map(|run| run.loads.surfaces[0].force);
    // Roundings, amplified by eight steps of a free wake (1e-13 measured); with the vorticity of the third
    // image reversed 3e-5.
    assert!(
        one.distance(first) < 1e-12 * one.length(),
        "{:e}",
        one.distance(first) / one.length()
    );
}

/// Wings that beat close above a ground and shed from all edges, their wakes free: steps of 0.05 s.
fn beating_above(
    ground: Plane,
    turn: DMat3,
    mut see: impl FnMut(&AirState),
) -> Result<Run, AirError> {
    let core = |radius| CoreModel::Algebraic {
        radius,
        viscosity: 0.0,
    };
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            tip: true,
            root: true,
            ..SheddingKinds::TRAILING
        },
        bound_core: core(0.05),
        wake_core: core(0.1),
        loads: LoadMethod::Joukowski,
        leading: LeadingEdge::Always,
        images: vec![ground],
        summation: Method::Direct,
        ..AirSettings::accurate(1.2, DVec3::ZERO)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 3, 4)], settings).unwrap();
    let flat = rectangle(3, 4, DVec3::X, 2.0 * DVec3::Y);
    let motion = |t: f64| {
        let (sine, cosine) = (2.0 * t).sin_cos();
        let at = DVec3::new(0.0, 0.0, 0.25 + 0.2 * cosine);
        let positions = flat.iter().map(|x| turn * (*x + at)).collect();
        translating(positions, turn * DVec3::new(0.0, 0.0, -0.4 * sine))
    };
    fly(&lattice, motion, 0.05, 60, |_, state, _, _| see(state))
}

/// How far wakes go beyond a ground [m], and how many of their nodes lie on it.
fn beyond(ground: &Plane, state: &AirState) -> (f64, usize) {
    let sheets = state.sheets.iter().map(|s| &s.nodes);
    let nodes = sheets.flat_map(|x| (0..x.len()).map(|i| x.get(i)));
    let heights: Vec<f64> = nodes.map(|x| ground.height(x)).collect();
    let most = heights.iter().fold(0.0, |m: f64, h| m.max(-h));
    let on = heights.iter().filter(|h| h.abs() < 1e-12).count();
    (most, on)
}

#[test]
fn invariant_wakes_stay_on_their_side_of_a_ground() {
    let ground = plane(DVec3::Z, DVec3::ZERO);
    let (mut most, mut on) = (0.0_f64, 0);
    beating_above(ground, DMat3::IDENTITY, |state| {
        let (depth, count) = beyond(&ground, state);
        (most, on) = (most.max(depth), on.max(count));
    })
    .unwrap();
    println!("beyond {most:e} m, {on} nodes on the ground");
    // A foot is as good as its rounding.
    assert!(on > 0 && most < 1e-15, "{on} {most:e}");
}

/// A ground turned with all that is above it: there feet on it are rounded.
#[test]
fn invariant_wakes_on_a_ground_turn_with_it() {
    let ground = plane(DVec3::Z, DVec3::ZERO);
    let turn = DMat3::from_rotation_y(0.5) * DMat3::from_rotation_x(0.3);
    let turned = plane(turn * DVec3::Z, DVec3::ZERO);
    let (mut most, mut on) = (0.0_f64, 0);
    let one = beating_above(ground, DMat3::IDENTITY, |_| {}).unwrap();
    let other = beating_above(turned, turn, |state| {
        let (depth, count) = beyond(&turned, state);
        (most, on) = (most.max(depth), on.max(count));
    });
    let other = other.unwrap();
    let force = turn * total_force(&one.loads);
    let apart = force.distance(total_force(&other.loads)) / force.length();
    println!("beyond {most:e} m, {on} nodes on the ground, forces apart {apart:e}");
    assert!(on > 0 && most < 1e-15, "{on} {most:e}");
    // Roundings, which free wakes amplify.
    assert!(apart < 1e-11, "{apart:e}");
}

/// A wing that comes down through a ground between two steps has all of its nodes on one side of it again.
#[test]
fn refuses_to_go_through_a_ground_between_two_steps() {
    let settings = AirSettings {
        images: vec![plane(DVec3::Z, DVec3::ZERO)],
        ..AirSettings::accurate(1.2, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 2, 2)], settings).unwrap();
    let flat = rectangle(2, 2, DVec3::X, DVec3::Y);
    for side in [1.0, -1.0] {
        let sinking = |t: f64| {
            let at = side * (0.25 - t) * DVec3::Z;
            translating(flat.iter().map(|x| *x + at).collect(), -side * DVec3::Z)
        };
        let error = fly(&lattice, sinking, 0.1, 5, |_, _, _, _| {}).map(|_| ());
        let Err(AirError::ThroughPlane { step, depth, .. }) = error else {
            panic!("{error:?}");
        };
        assert!(step == 3 && (depth - 0.05).abs() < 1e-15, "{step} {depth}"); // rounding
    }
}
