//! Bad input and wrong order of calls: each an error that names what is wrong.

use crate::common::{rectangle, translating};
use wingbeat_air::{
    AirError, AirLoads, AirSettings, EdgeKind, Lattice, LeadingEdge, SheddingSegment, Surface,
};
use wingbeat_math::DVec3;
use wingbeat_vortex::{CoreModel, Method};

fn wing() -> Surface {
    Surface::grid("wing", 2, 2)
}

fn settings() -> AirSettings {
    AirSettings::benchmark(1.2, DVec3::X)
}

fn error(surface: Surface) -> AirError {
    Lattice::new(vec![surface], settings()).unwrap_err()
}

#[test]
fn exact_topology_errors() {
    assert_eq!(Lattice::new(vec![], settings()), Err(AirError::Empty));
    let mut bad = wing();
    bad.panels[3][1] = 99;
    assert!(matches!(
        error(bad),
        AirError::NodeOutOfRange {
            panel: 3,
            node: 99,
            ..
        }
    ));
    let few = wing().with_rest(vec![DVec3::ZERO; 8]);
    let named = AirError::Rest {
        surface: "wing".to_owned(),
        nodes: 8,
        expected: 9,
    };
    assert_eq!(error(few), named);
    let nowhere = wing().with_rest(vec![DVec3::NAN; 9]);
    assert!(matches!(error(nowhere), AirError::Rest { nodes: 9, .. }));
    let mut bad = wing();
    bad.panels[1].reverse();
    assert!(matches!(error(bad), AirError::Orientation { .. }));
    let mut bad = wing();
    bad.closed = true;
    assert!(matches!(error(bad), AirError::NotClosed { .. }));
    let mut bad = wing();
    bad.shedding[0].swap(0, 1);
    assert!(matches!(error(bad), AirError::BrokenLine { line: 0, .. }));
    let mut bad = wing();
    // The edge between panels 2 and 3 is not free.
    let inner = SheddingSegment {
        from: 4,
        to: 7,
        panel: 2,
        kind: EdgeKind::Trailing,
    };
    bad.shedding = vec![vec![inner]];
    assert!(matches!(error(bad), AirError::Shedding { panel: 2, .. }));
}

#[test]
fn exact_setting_errors_name_the_key() {
    type Spoil = fn(&mut AirSettings);
    let spoil: [(&str, Spoil); 14] = [
        ("density", |s| s.density = -1.0),
        ("free_stream", |s| s.free_stream.y = f64::NAN),
        ("max_displacement", |s| s.max_displacement = Some(0.0)),
        ("wake_overlap", |s| s.wake_overlap = f64::NAN),
        ("overlap_slope", |s| s.overlap_slope = 0.0),
        // The cut-off has no radius to widen.
        ("wake_overlap", |s| s.wake_overlap = 1.0),
        ("wake_blob_length", |s| s.wake_blob_length = Some(f64::NAN)),
        // Blobs as wide as nothing.
        ("wake_blob_length", |s| s.wake_blob_length = Some(1.0)),
        // Meshes are for algebraic cores.
        ("summation", |s| s.summation = Method::Mesh),
        ("clearance", |s| s.clearance = -1.0),
        ("max_rows", |s| s.max_rows = Some(0)),
        // What left the step before would not be known.
        ("max_rows", |s| {
            s.shedding.leading = true;
            s.leading = LeadingEdge::AngleOfAttack { threshold: 0.3 };
            s.max_rows = Some(1);
        }),
        ("bound_core", |s| {
            s.bound_core = CoreModel::CutOff { delta: f64::NAN }
        }),
        ("wake_core", |s| {
            s.wake_core = CoreModel::CutOff { delta: -0.1 }
        }),
    ];
    for (name, spoil) in spoil {
        let mut s = settings();
        spoil(&mut s);
        let e = Lattice::new(vec![wing()], s).unwrap_err();
        assert!(
            matches!(e, AirError::Setting { key, .. } if key == name),
            "{e}"
        );
    }
}

#[test]
fn exact_step_errors() {
    let lattice = Lattice::new(vec![wing()], settings()).unwrap();
    let good = translating(rectangle(2, 2, DVec3::X, DVec3::Y), DVec3::Z);
    let mut state = lattice.initial_state(&good);
    let (mut ws, mut out) = (lattice.workspace(), AirLoads::default());
    let mut loads = |state: &_, dt, motion: &_| {
        lattice
            .loads(state, 0.0, dt, motion, &mut ws, &mut out)
            .map(|()| out.clone())
    };
    let mut bad = good.clone();
    bad.position[5].x = f64::NAN;
    assert!(matches!(
        loads(&state, 1.0, &bad),
        Err(AirError::SurfaceNotFinite { node: 5, .. })
    ));
    bad = good.clone();
    bad.position = (0..9).map(|k| k as f64 * DVec3::X).collect();
    assert!(matches!(
        loads(&state, 1.0, &bad),
        Err(AirError::FlatPanel { panel: 0, .. })
    ));
    bad = good.clone();
    bad.position[8] = bad.position[7];
    assert!(matches!(
        loads(&state, 1.0, &bad),
        Err(AirError::NoLength { panel: 3, from, to, .. }) if from.min(to) == 7 && from.max(to) == 8
    ));
    bad = good.clone();
    bad.position.swap(7, 8);
    assert!(matches!(
        loads(&state, 1.0, &bad),
        Err(AirError::Crossed { panel: 2 | 3, .. })
    ));
    bad.velocity.pop();
    assert!(matches!(
        loads(&state, 1.0, &bad),
        Err(AirError::MotionSize {
            got: 8,
            expected: 9
        })
    ));
    let accepted = loads(&state, 1.0, &good).unwrap();
    assert!(
        lattice
            .convect(&mut state, 1.0, &mut lattice.workspace())
            .is_err()
    );
    lattice.accept(&mut state, &good, &accepted).unwrap();
    assert!(matches!(
        loads(&state, 1.0, &good),
        Err(AirError::Order { step: 1, .. })
    ));
    let order = lattice.accept(&mut state, &good, &accepted);
    assert!(matches!(order, Err(AirError::Order { .. })));
    let mut scratch = lattice.workspace();
    assert!(matches!(
        lattice.convect(&mut state, 0.0, &mut scratch),
        Err(AirError::TimeStep { .. })
    ));
    lattice.convect(&mut state, 1.0, &mut scratch).unwrap();
    assert!(matches!(
        loads(&state, -1.0, &good),
        Err(AirError::TimeStep { .. })
    ));
    for hold in [f64::NAN, -1.0] {
        let mut odd = state.clone();
        assert!(!odd.hold.is_empty());
        odd.hold.fill(hold);
        assert!(matches!(
            loads(&odd, 1.0, &good),
            Err(AirError::StateMismatch { .. })
        ));
    }
    state.sheets.clear();
    assert!(matches!(
        loads(&state, 1.0, &good),
        Err(AirError::StateMismatch { .. })
    ));
}

/// Two surfaces on the same place cannot share one no-penetration condition.
#[test]
fn exact_coinciding_surfaces_are_singular() {
    let lattice = Lattice::new(vec![wing(), wing()], settings()).unwrap();
    let mut nodes = rectangle(2, 2, DVec3::X, DVec3::Y);
    nodes.extend(nodes.clone());
    let motion = translating(nodes, DVec3::Z);
    let state = lattice.initial_state(&motion);
    let (mut ws, mut out) = (lattice.workspace(), AirLoads::default());
    let result = lattice.loads(&state, 0.0, 1.0, &motion, &mut ws, &mut out);
    assert!(
        matches!(result, Err(AirError::Singular { step: 0, .. })),
        "{result:?}"
    );
}
