//! Trim and stability by flights of hold and release.

use crate::common;

use common::*;
use wingbeat_air::{AirSettings, CoreModel};
use wingbeat_analysis::wake::*;
use wingbeat_analysis::*;
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3};

/// The growth and frequency of the longitudinal modes.
fn longitudinal(set: &ModeSet) -> Vec<[f64; 2]> {
    let modes = set.plane(Plane::Longitudinal);
    modes.map(|m| [m.growth, m.frequency]).collect()
}

#[test]
fn agrees_trim_and_modes_by_flights_with_the_beat_map_where_air_forgets() {
    // Air without memory does not care about the hold: two integrators, two Newton methods, two
    // ways to the monodromy, one answer. 60 steps a beat, both of fourth order.
    let mut setup = fly();
    setup.time.step = 0.005 / 60.0;
    for wing in &mut setup.animal.wings {
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    let problem = hover(60);
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let flown = trim_with_wake(&setup, &problem, &settings).unwrap();
    assert!(flown.solution.converged, "{:?}", flown.solution.residual);
    let mapped = trim(&setup, &problem).unwrap();
    let gap = (flown.solution.adjustment.stroke_amplitude
        - mapped.solution.adjustment.stroke_amplitude)
        .abs();
    assert!(gap < 1e-4, "{gap}"); // truncation at 60 steps
    assert!((flown.solution.body_pitch - mapped.solution.body_pitch).abs() < 1e-3);
    let exact = longitudinal(&floquet(&mapped.beat, &mapped.state).unwrap());
    for memory in [WakeMemory::Given, WakeMemory::Carried] {
        let found = longitudinal(&wake_floquet(&flown, memory).unwrap());
        assert_eq!(found.len(), exact.len());
        for (a, b) in found.iter().zip(&exact) {
            let gap = (a[0] - b[0]).hypot(a[1] - b[1]);
            assert!(gap < 5e-3 * b[0].hypot(b[1]), "{memory:?}: {a:?} {b:?}");
        }
    }
}

/// The fly in a vortex lattice of 3 x 4 panels a wing with cores of a seventh of the chord.
fn in_lattice(steps: usize) -> FlightSetup {
    let mut setup = fly();
    let options = wingbeat_model::species::FlyOptions {
        wing_rows: 3,
        wing_cols: 4,
        ..Default::default()
    };
    setup.animal = wingbeat_model::species::drosophila_melanogaster(&options).unwrap();
    setup.animal.parts.clear();
    let mut lattice = AirSettings::benchmark(RHO, DVec3::ZERO);
    lattice.loads = wingbeat_air::LoadMethod::Polhamus;
    lattice.bound_core = CoreModel::LambOseen {
        radius: 1e-4,
        viscosity: 1.5e-5,
    };
    lattice.wake_core = lattice.bound_core;
    setup.air = AirModel::VortexLattice(AirOptions {
        lattice,
        body_surfaces: false,
        mirror: true,
        joined: vec![],
        joined_tips: vec![],
        has_own_viscosity: false,
    });
    setup.time.step = 0.005 / steps as f64;
    setup
}

#[test]
fn balances_hover_trims_in_the_vortex_lattice() {
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let found = trim_with_wake(&in_lattice(20), &hover(20), &settings).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    // Flown once more: released, it is after a wingbeat where and as it was.
    let mut flight = Simulation::new(found.setup.clone()).unwrap();
    let mut released = None;
    while !flight.finished() {
        flight.step().unwrap();
        if flight.state().step == 20 {
            released = Some(flight.record().clone());
        }
    }
    let (a, b) = (released.unwrap(), flight.record());
    assert!((b.mass_centre - a.mass_centre).length() < 1e-5 * 2.5e-3);
    assert!((b.momentum - a.momentum).length() < 1e-5 * 9.81 * 0.005 * 0.94e-6);
    assert!(b.wake_rings > 0);
}

/// Hover with vortex lift is as smooth as attached hover: it trims to the same tolerance.
#[test]
fn balances_hover_trims_with_vortex_lift() {
    let mut setup = in_lattice(20);
    let AirModel::VortexLattice(options) = &mut setup.air else {
        unreachable!("it is a lattice");
    };
    options.lattice.loads = wingbeat_air::LoadMethod::Joukowski;
    options.lattice.shedding.leading = true;
    options.lattice.leading = wingbeat_air::LeadingEdge::VortexLift(Default::default());
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let found = trim_with_wake(&setup, &hover(20), &settings).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution.residual);
}

#[test]
fn balances_sideslip_trims_in_the_vortex_lattice() {
    // Both sides are computed, whatever the mirror of the case; flown, the free beat goes aside as asked.
    let mut problem = hover(20);
    problem.velocity.y = 0.1;
    problem.unknowns.extend([
        Unknown::BodyRoll,
        Unknown::StrokeAmplitudeDifference,
        Unknown::StrokePlaneDifference,
    ]);
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let found = trim_with_wake(&in_lattice(20), &problem, &settings).unwrap();
    assert!(
        found.solution.converged && found.solution.residual.len() == 12,
        "{:?}",
        found.solution.residual
    );
    assert!(
        found.solution.body_roll > 0.01,
        "against the drag: {}",
        found.solution.body_roll
    );
    let mut flight = Simulation::new(found.setup.clone()).unwrap();
    let mut centres = vec![];
    while !flight.finished() {
        flight.step().unwrap();
        centres.push(flight.record().mass_centre);
    }
    let way = centres[39] - centres[19];
    assert!(
        (way - DVec3::new(0.0, 0.1 * 0.005, 0.0)).length() < 1e-5 * 2.5e-3,
        "{way}"
    );
    problem.turn_rate = 1.0;
    let said = trim_with_wake(&in_lattice(20), &problem, &settings).unwrap_err();
    assert!(said.to_string().contains("steady turn"), "{said}");
}

#[test]
fn agrees_power_of_a_free_wingbeat_with_that_of_a_carried_body_where_air_forgets() {
    // One beat of the same orbit, released and carried: the body's own small motion within the beat (a degree,
    // a hundredth of a wing length) is what they may differ by.
    let mut setup = fly();
    for wing in &mut setup.animal.wings {
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        ..WakeSettings::default()
    };
    let flown = trim_with_wake(&setup, &hover(100), &settings).unwrap();
    let free = power_with_wake(&flown).unwrap();
    let carried = power(&trim(&setup, &hover(100)).unwrap().tethered().unwrap()).unwrap();
    assert!((free.aerodynamic / carried.aerodynamic - 1.0).abs() < 0.05);
    assert!((free.no_storage / carried.no_storage - 1.0).abs() < 0.05);
    assert_eq!(free.mass, carried.mass);
}

/// What a trim of this setup in the lattice says.
fn refused(setup: &FlightSetup) -> String {
    let found = trim_with_wake(setup, &hover(20), &WakeSettings::default());
    found.unwrap_err().to_string()
}

#[test]
fn refuses_a_lattice_whose_wingbeats_are_not_alike() {
    let with = |change: &dyn Fn(&mut AirSettings)| {
        let mut setup = in_lattice(20);
        let AirModel::VortexLattice(air) = &mut setup.air else {
            unreachable!("it is a lattice");
        };
        change(&mut air.lattice);
        setup
    };
    let shear = with(&|air| air.wind.shear = Some(DMat3::from_diagonal(DVec3::X)));
    let ground = with(&|air| {
        air.images = vec![wingbeat_air::Plane {
            point: DVec3::new(0.0, 0.0, 3e-3),
            normal: -DVec3::Z,
        }];
    });
    for setup in [shear, ground] {
        let said = refused(&setup);
        assert!(said.contains("air changes with time or place"), "{said}");
    }
    let mut loaded = in_lattice(20);
    loaded.loads = vec![AppliedLoad {
        body: 0,
        frame: LoadFrame::Inertial,
        point: DVec3::ZERO,
        force: Default::default(),
        couple: Default::default(),
    }];
    let said = refused(&loaded);
    assert!(said.contains("applied loads ([[load]])"), "{said}");
}

#[test]
fn refuses_to_trim_wings_that_do_not_beat_in_the_lattice() {
    let mut setup = in_lattice(20);
    setup.time.period = None;
    let said = refused(&setup);
    assert!(said.contains("no wing beats"), "{said}");
}

#[test]
fn refuses_speeds_as_unknowns_where_a_wake_grows_while_the_body_is_held() {
    let mut problem = hover(20);
    problem.unknowns[2] = Unknown::Climb;
    let found = trim_with_wake(&in_lattice(20), &problem, &WakeSettings::default());
    let said = found.unwrap_err().to_string();
    assert!(said.contains("`climb` is no unknown"), "{said}");
}

/// Without a wake the map of a wingbeat is smooth: over changes of 0.001 its curvature is some 1e-6.
#[test]
fn limit_the_roughness_of_a_smooth_map_is_its_curvature() {
    let settings = WakeSettings {
        held_beats: 1,
        tolerance: 1e-6,
        iterations: 1,
    };
    let found = trim_with_wake(&fly(), &hover(100), &settings).unwrap();
    assert!(!found.solution.converged);
    let rough = found.roughness.unwrap();
    assert!(rough > 0.0 && rough < 2e-5, "{rough:e}");
    let settings = WakeSettings {
        iterations: 40,
        ..settings
    };
    let found = trim_with_wake(&fly(), &hover(100), &settings).unwrap();
    assert!(found.solution.converged && found.roughness.is_none());
}
