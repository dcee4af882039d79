//! Leading edges that are swept, and meshes whose columns are not normal to them.

use crate::common::{fly, rectangle, total_force, translating};
use crate::implicit_suction::implicit;
use wingbeat_air::{
    AirLoads, AirSettings, CoreModel, Lattice, LeadingEdge, LoadMethod, SheddingKinds, Surface,
    VortexLift,
};
use wingbeat_math::DVec3;

const ALPHA: f64 = 0.3;
/// Far more than what the edges have.
const ALL: f64 = 9.0;

/// Loads of a plate of one column without ends in a stream of 1 along x, in the end; directions of the columns and of the edges.
fn plane_flow(rows: usize, chord: DVec3, edge: DVec3, leading: LeadingEdge) -> AirLoads {
    let core = CoreModel::Scully { radius: 1e-7 };
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            ..SheddingKinds::TRAILING
        },
        loads: LoadMethod::Joukowski,
        leading,
        bound_core: core,
        wake_core: core,
        ..AirSettings::accurate(1.0, DVec3::new(ALPHA.cos(), 0.0, ALPHA.sin()))
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, 1)], settings).unwrap();
    let flat = rectangle(rows, 1, chord, 1e5 * edge);
    let motion = |_| translating(flat.clone(), DVec3::ZERO);
    (fly(&lattice, motion, 1e4, 150, |_, _, _, _| {}).unwrap()).loads
}

/// Direction of columns and of edges.
fn plates() -> [(&'static str, DVec3, DVec3); 3] {
    let turned = |angle: f64| DVec3::new(angle.sin(), angle.cos(), 0.0);
    [
        ("straight", DVec3::X, DVec3::Y),
        ("swept by 40 deg", DVec3::X, turned(0.7)),
        ("sheared mesh", DVec3::new(1.0, 1.5, 0.0), DVec3::Y),
    ]
}

/// What flows along an endless edge makes no suction: the parameter is the sine of the angle in the plane normal to the edge. As close
/// as that of the straight plate, 0.6 % on eight panels.
#[test]
fn exact_simple_sweep_suction_parameter_of_endless_plates() {
    let law = LeadingEdge::VortexLift(VortexLift {
        threshold: ALL,
        ..VortexLift::default()
    });
    let held = LeadingEdge::Suction {
        threshold: ALL,
        efficiency: 0.0,
    };
    for (name, chord, edge) in plates() {
        let (along, across) = (ALPHA.cos() * edge.y, ALPHA.sin());
        let exact = across / along.hypot(across);
        for leading in [law, held, implicit(ALL)] {
            let loads = plane_flow(8, chord, edge, leading);
            let error = loads.leading[0] / exact - 1.0;
            println!("{name}: {error:.5}");
            assert!(error.abs() < 0.01, "{name}, {leading:?}: {error}");
        }
    }
}

/// Thin edges have none of the force of their suction: what is left of the force is normal to the plate, however its columns lie.
/// To round-off.
#[test]
fn exact_lost_suction_leaves_a_force_normal_to_endless_plates() {
    let thin = LeadingEdge::Suction {
        threshold: ALL,
        efficiency: 0.0,
    };
    for (name, chord, edge) in plates() {
        let force = total_force(&plane_flow(8, chord, edge, thin));
        let aft = edge.cross(DVec3::Z);
        let along = force.dot(aft) / force.z;

        assert!(along.abs() < 1e-14, "{name}: {along}");
    }
}

/// So it is on a flat wing with ends, swept and tapered, all of whose strips pull forward; with round edges it is not.
#[test]
fn exact_lost_suction_leaves_a_force_normal_to_flat_wings() {
    let along = |efficiency: f64| {
        let settings = AirSettings {
            shedding: SheddingKinds {
                leading: true,
                tip: true,
                ..SheddingKinds::TRAILING
            },
            loads: LoadMethod::Joukowski,
            leading: LeadingEdge::Suction {
                threshold: 0.1,
                efficiency,
            },
            ..AirSettings::accurate(1.0, DVec3::new(ALPHA.cos(), 0.0, ALPHA.sin()))
        };
        let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], settings).unwrap();
        let tapered = |x: DVec3| DVec3::new(0.8 * x.y + x.x * (1.0 - 0.2 * x.y), x.y, 0.0);
        let flat = rectangle(4, 6, DVec3::X, 3.0 * DVec3::Y);
        let motion = translating(flat.into_iter().map(tapered).collect(), DVec3::ZERO);
        let run = fly(&lattice, |_| motion.clone(), 0.25, 8, |_, _, _, _| {}).unwrap();
        let force = total_force(&run.loads);
        force.truncate().length() / force.z
    };
    let [thin, round] = [0.0, 1.0].map(along);
    println!("{thin:.1e} {round:.3}");
    assert!(thin < 1e-14 && round > 0.02, "{thin} {round}");
}
