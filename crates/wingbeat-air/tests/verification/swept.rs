//! Leading edges that are swept, and meshes whose columns are not normal to them.

use crate::common::{fly, rectangle, translating, with_leading_edges};
use crate::implicit_suction::implicit;
use wingbeat_air::{
    AirLoads, AirSettings, CoreModel, Lattice, LeadingEdge, LoadMethod, SheddingKinds, Surface,
    VortexLift,
};
use wingbeat_math::DVec3;

const ALPHA: f64 = 0.3;
/// Far more than what the edges have.
const ALL: f64 = 9.0;

/// Loads of a plate of one column without ends in a stream of 1 along x, in the end; directions of the columns
/// and of the edges.
fn plane_flow(rows: usize, chord: DVec3, edge: DVec3, leading: LeadingEdge) -> AirLoads {
    let core = CoreModel::Scully { radius: 1e-7 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        ..with_leading_edges(leading, DVec3::new(ALPHA.cos(), 0.0, ALPHA.sin()))
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

/// What flows along an endless edge makes no suction: the parameter is the sine of the angle in the plane
/// normal to the edge.
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
    for leading in [law, held, implicit(ALL)] {
        let errors = plates().map(|(name, chord, edge)| {
            let (along, across) = (ALPHA.cos() * edge.y, ALPHA.sin());
            let exact = across / along.hypot(across);
            let loads = plane_flow(8, chord, edge, leading);
            println!("{name}: {:.6}", loads.leading[0] / exact - 1.0);
            loads.leading[0] / exact - 1.0
        });
        // Ends 1e5 chords away, and the vortex of the start 1.5e6.
        assert!(
            errors.iter().all(|e| e.abs() < 1e-4),
            "{leading:?}: {errors:?}"
        );
    }
}

/// What thin edges feel is normal to the plate, panel by panel, to round-off: on endless plates, and on a flat
/// wing with ends, swept and tapered. On round edges it is not.
#[test]
fn exact_thin_edges_leave_forces_normal_to_flat_wings() {
    for leading in [thin, vortex_lift, implicit_thin] {
        for (name, chord, edge) in plates() {
            let [force, _] = along(&plane_flow(8, chord, edge, leading(0.0)));
            assert!(force < 1e-13, "{name}, {:?}: {force}", leading(0.0));
        }
        let [sharp, round] = [0.0, 1.0].map(|e| along(&tapered(leading(e))));
        println!("{sharp:?} {round:?}");
        assert!(sharp.iter().all(|x| *x < 1e-13), "{sharp:?}");
        assert!(round.iter().all(|x| *x > 2e-3), "{round:?}");
    }
}

/// Largest force along a panel, and couple about its normal (chords are 1), over the largest normal force.
fn along(loads: &AirLoads) -> [f64; 2] {
    let largest = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0, f64::max);
    let most = largest(&mut loads.force.iter().map(|f| f.z.abs()));
    let force = largest(&mut loads.force.iter().map(|f| f.truncate().length()));
    let couple = largest(&mut loads.couple.iter().map(|m| m.z.abs()));
    [force / most, couple / most]
}

fn thin(efficiency: f64) -> LeadingEdge {
    LeadingEdge::Suction {
        threshold: 0.1,
        efficiency,
    }
}

fn implicit_thin(efficiency: f64) -> LeadingEdge {
    LeadingEdge::SuctionImplicit {
        threshold: 0.1,
        efficiency,
    }
}

fn vortex_lift(efficiency: f64) -> LeadingEdge {
    LeadingEdge::VortexLift(VortexLift {
        threshold: 0.1,
        efficiency,
        ..VortexLift::default()
    })
}

/// Loads of a swept and tapered wing two chords after a sudden start.
fn tapered(leading: LeadingEdge) -> AirLoads {
    let settings = AirSettings {
        shedding: SheddingKinds {
            leading: true,
            tip: true,
            ..SheddingKinds::TRAILING
        },
        loads: LoadMethod::Joukowski,
        leading,
        ..AirSettings::accurate(1.0, DVec3::new(ALPHA.cos(), 0.0, ALPHA.sin()))
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 4, 6)], settings).unwrap();
    let tapered = |x: DVec3| DVec3::new(0.8 * x.y + x.x * (1.0 - 0.2 * x.y), x.y, 0.0);
    let flat = rectangle(4, 6, DVec3::X, 3.0 * DVec3::Y);
    let motion = translating(flat.into_iter().map(tapered).collect(), DVec3::ZERO);
    (fly(&lattice, |_| motion.clone(), 0.25, 8, |_, _, _, _| {}).unwrap()).loads
}
