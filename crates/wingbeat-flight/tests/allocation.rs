//! Steps allocate nothing once a flight is under way: in blade elements, with and without feedback, and in the
//! lattice, of rigid wings, of those that change their shape and of those that bend.

mod common;

use std::sync::Arc;

use allocation_counter::measure;
use common::Fly;
use wingbeat_blade::{BladeSettings, Unsteady};
use wingbeat_dynamics::{ElementLaw, Joint, JointModel, JointType};
use wingbeat_flight::*;
use wingbeat_math::DVec3;
use wingbeat_model::deformation::{SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::structure::Damping;
use wingbeat_model::{
    AngleLaw, Coupling, Deformation, Members, WingBeam, WingShell, WingStructure,
};

fn blade() -> FlightSetup {
    let mut setup = Fly::default().setup(40, 4.0);
    setup.air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings::insect(1.2),
        ..BladeOptions::insect(1.2)
    });
    setup
}

/// Nothing is allocated in so many `steps` that follow on the first, of the flight `what`; its last record.
fn allocates_nothing(setup: FlightSetup, [first, steps]: [usize; 2], what: &str) -> Record {
    let mut flight = Simulation::new(setup).expect("the little fly");
    let mut copy = Record::default();
    let mut step = || copy.clone_from(flight.step().expect("a step"));
    (0..first).for_each(|_| step());
    let measured = measure(|| (0..steps).for_each(|_| step()));
    assert_eq!(measured.count_total, 0, "{what}");
    copy
}

#[test]
fn exact_no_allocation_in_steps_in_blade_elements() {
    let wakes = Some(Unsteady::Peters { states: 8 });
    for (integrator, unsteady) in [
        IntegratorChoice::Hamming,
        IntegratorChoice::Bdf,
        IntegratorChoice::Adams,
        IntegratorChoice::RungeKutta,
        IntegratorChoice::OrderEight { tolerance: 1e-9 },
    ]
    .into_iter()
    .flat_map(|i| [(i, None), (i, wakes)])
    {
        let mut setup = FlightSetup {
            integrator,
            ..blade()
        };
        if let AirModel::BladeElement(air) = &mut setup.air {
            air.blade.unsteady = unsteady;
        }
        allocates_nothing(setup, [5, 40], &format!("{integrator:?} {unsteady:?}"));
    }
}

/// The same flight with wings that feather passively at their hinges, and carry air along.
fn on_hinges(setup: FlightSetup, formulation: FormulationChoice) -> FlightSetup {
    let spring = ElementLaw::Spring {
        stiffness: 7e-9,
        rest: 0.0,
    };
    let damper = ElementLaw::Damper { coefficient: 2e-12 };
    let axis = JointType::Revolute { axis: DVec3::Y };
    let mut setup = FlightSetup {
        formulation,
        ..setup
    };
    for (k, wing) in setup.animal.wings.iter_mut().enumerate() {
        wing.motion.angles.psi = AngleLaw::Constant(-1.2);
        setup.joints.push(Joint {
            model: JointModel::new(axis)
                .with(0, spring.clone())
                .with(0, damper.clone()),
            ..Joint::new(&wing.name, Some(0), k + 1, JointType::Weld).at(wing.hinge_b, DVec3::ZERO)
        });
    }
    setup
}

#[test]
fn exact_no_allocation_in_steps_of_wings_on_passive_hinges() {
    for formulation in [
        FormulationChoice::Momentum,
        FormulationChoice::Quaternion(StabilizationChoice::Projection),
    ] {
        // Room of multistep methods grows with the most passes that a step has needed, which rises all along here.
        let setup = FlightSetup {
            integrator: IntegratorChoice::RungeKutta,
            ..on_hinges(blade(), formulation)
        };
        let last = allocates_nothing(setup, [5, 40], &format!("{formulation:?}"));
        assert!(last.joints.iter().all(|[q, _]| q.abs() > 1e-3));
    }
    let in_wakes = on_hinges(lattice(false), FormulationChoice::Momentum);
    let last = finds_rest(in_wakes, "hinges in the lattice");
    assert!(last.joints.iter().all(|[q, _]| q.abs() > 1e-3));
}

/// A controller answers with a new list at every look, and its wings get new motions; between looks nothing is
/// allocated.
#[test]
fn exact_no_allocation_between_looks() {
    #[derive(Clone, Debug)]
    struct Still;
    impl Controller for Still {
        fn command(
            &mut self,
            _: &Sensed,
        ) -> Result<Vec<wingbeat_model::motion::Adjustment>, String> {
            Ok(vec![Default::default(); 2])
        }
    }
    let setup = FlightSetup {
        feedback: Some(Feedback {
            controller: Arc::new(Still),
            interval: 40,
            latency: 1,
            lag: 0.0,
        }),
        ..blade()
    };
    allocates_nothing(setup, [45, 30], "between looks");
}

/// Wings of 1 kHz that are beams, and such of sheets.
fn members() -> [Members; 2] {
    let beam = WingBeam {
        axis_fraction: 0.3,
        elements: 4,
        stations: None,
        flap: SpanLaw::constant(3e-10),
        lag: None,
        torsion: SpanLaw::constant(1e-10),
        axial: None,
        shear: None,
        coupling: Coupling::default(),
        mass: None,
        mass_fraction: 0.5,
        inertia: None,
        masses: vec![],
    };
    let sheet = WingShell {
        young: [3e9; 2],
        shear: None,
        stretching: None,
        thickness: SpanLaw::constant(1e-5),
        ..WingShell::combes_daniel([common::SPAN, 1.7e-6, 6e-9], 0.3)
    };
    [Members::Beam(beam), Members::Shell(sheet)]
}

/// The same flight with wings of these members.
fn bending(mut setup: FlightSetup, members: &Members) -> FlightSetup {
    for wing in &mut setup.animal.wings {
        wing.structure = Some(WingStructure {
            members: members.clone(),
            damping: Damping {
                strain_rate: 1e-5,
                mass: 1.0,
            },
            spectral_radius: 0.9,
        });
    }
    setup
}

#[test]
fn exact_no_allocation_in_steps_of_wings_that_bend() {
    let wakes = Some(Unsteady::Peters { states: 8 });
    for (members, unsteady) in members()
        .into_iter()
        .flat_map(|m| [(m.clone(), None), (m, wakes)])
    {
        let mut setup = bending(blade(), &members);
        if let AirModel::BladeElement(air) = &mut setup.air {
            air.blade.unsteady = unsteady;
        }
        // Room grows with the most passes that a step has needed: a beat with its start.
        let last = allocates_nothing(setup, [50, 20], &format!("{members:?} {unsteady:?}"));
        let mut tips = last.elastic.iter().map(|e| e.tip.length());
        assert!(tips.all(|tip| tip > 1e-3 * common::SPAN));
    }
}

/// Twist, camber and bending over the beat.
fn waving(mut setup: FlightSetup) -> FlightSetup {
    let term = |tip: f64| Term {
        span: SpanLaw::Linear { root: 0.0, tip },
        time: Fourier {
            mean: 0.5,
            cos: vec![0.2],
            sin: vec![1.0],
        },
    };
    let deformation = Deformation {
        twist: vec![term(0.3)],
        camber: vec![term(0.06)],
        bending: vec![term(2e-4)],
        ..Deformation::default()
    };
    for wing in &mut setup.animal.wings {
        *wing = wing.clone().deformed_by(deformation.clone()).unwrap();
    }
    setup
}

#[test]
fn exact_no_allocation_in_steps_of_wings_that_change_their_shape_in_blade_elements() {
    let last = allocates_nothing(waving(blade()), [5, 40], "waving");
    assert!(last.deformation_power.iter().any(|p| *p != 0.0));
}

/// In the lattice, with wakes of a size that stays.
fn lattice(mirror: bool) -> FlightSetup {
    let mut setup = Fly::default().setup(40, 4.0);
    if let AirModel::VortexLattice(air) = &mut setup.air {
        air.lattice.max_rows = Some(12);
        air.mirror = mirror;
    }
    setup
}

/// Room grows with the most passes that a step has needed: there are 20 steps in a row in which nothing is allocated in
/// the flight `what`; its last record. What rayon keeps to hand work to other threads is not counted.
fn finds_rest(setup: FlightSetup, what: &str) -> Record {
    let fly = || {
        let mut flight = Simulation::new(setup).expect("the little fly");
        let mut copy = Record::default();
        let mut step = || copy.clone_from(flight.step().expect("a step"));
        (0..30).for_each(|_| step());
        let mut counts = (0..6).map(|_| measure(|| (0..20).for_each(|_| step())).count_total);
        assert!(counts.any(|count| count == 0), "{what}");
        copy
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.unwrap().install(fly)
}

#[test]
fn exact_no_allocation_in_steps_in_the_lattice() {
    for mirror in [false, true] {
        finds_rest(lattice(mirror), &format!("mirror {mirror}"));
        let last = finds_rest(waving(lattice(mirror)), &format!("waving, mirror {mirror}"));
        assert!(last.deformation_power.iter().any(|p| *p != 0.0));
    }
}

#[test]
fn exact_no_allocation_in_steps_of_wings_that_bend_in_the_lattice() {
    for (members, mirror) in members().iter().flat_map(|m| [(m, false), (m, true)]) {
        let what = format!("{members:?}, mirror {mirror}");
        let last = finds_rest(bending(lattice(mirror), members), &what);
        let mut tips = last.elastic.iter().map(|e| e.tip.length());
        assert!(tips.all(|tip| tip > 1e-3 * common::SPAN));
    }
}
