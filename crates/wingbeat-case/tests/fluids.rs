//! The viscosity of the fluid: by its density, as given, and where it acts.

use crate::common::found;
use wingbeat_air::{Friction, viscosity_of_density};
use wingbeat_analysis::estimate;
use wingbeat_case::{LoadedCase, case_of};
use wingbeat_flight::{AirModel, DoubtKind};

fn reynolds(name: &str, set: &[&str]) -> f64 {
    let estimate = estimate(&found(name, set).unwrap().setup);
    estimate.wings[0].reynolds.unwrap()
}

/// Viscosities of friction and of the cores of the wake [m2/s].
fn of_lattice(set: &[&str]) -> [Option<f64>; 2] {
    let set = [&["air.model=vortex_lattice"], set].concat();
    let case = found("fruit-fly-blade", &set).unwrap();
    let AirModel::VortexLattice(air) = &case.setup.air else {
        panic!("a lattice");
    };
    let friction = match air.lattice.section_drag.map(|d| d.friction) {
        Some(Friction::Blasius { viscosity }) => Some(viscosity),
        _ => None,
    };
    [friction, air.lattice.wake_core.viscosity()]
}

/// The dynamic viscosity of a gas hardly depends on its pressure: Reynolds numbers go with the density.
#[test]
fn exact_reynolds_numbers_of_thin_gases_go_with_their_density() {
    let air = reynolds("fruit-fly-blade", &[]);
    for density in [0.05, 0.29, 0.41, 0.909, 3.5] {
        let set = format!("air.density_kg_m3={density}");
        let ratio = reynolds("fruit-fly-blade", &[&set]) / air;
        assert!((ratio / (density / 1.225) - 1.0).abs() < 1e-12, "{density}"); // roundings
        let nu = viscosity_of_density(density);
        assert_eq!(of_lattice(&[&set]), [Some(nu), Some(nu)]);
    }
    assert_eq!(of_lattice(&[]), [Some(1.5e-5), Some(1.5e-5)]);
    let heliox = ["air.density_kg_m3=0.41", "air.viscosity_m2_s=4.8e-5"];
    let ratio = reynolds("fruit-fly-blade", &heliox) / air;
    assert!((ratio - 1.5e-5 / 4.8e-5).abs() < 1e-12, "{ratio}");
    assert_eq!(of_lattice(&heliox), [Some(4.8e-5), Some(4.8e-5)]);
}

#[test]
fn behaves_one_viscosity_serves_friction_and_wakes() {
    let scully = [
        "air.bound_core.scully.radius_m=1e-5",
        "air.wake_core.scully.radius_m=5e-5",
        "air.viscosity_m2_s=2e-5",
    ];
    assert_eq!(of_lattice(&scully), [Some(2e-5), None]);
    assert_eq!(of_lattice(&scully[..2]), [None, None]);
    let none = "air.section_drag.friction=none";
    assert_eq!(
        of_lattice(&["air.viscosity_m2_s=2e-5", none]),
        [None, Some(2e-5)]
    );
    // A resolved case flies the same again.
    let first = found(
        "fruit-fly-hover",
        &[
            "air.wake_core={algebraic={radius_chords=0.07}}",
            "air.viscosity_m2_s=2e-5",
        ],
    )
    .unwrap();
    let text = first.resolved();
    let base = std::path::Path::new(".");
    let again = LoadedCase::from_text("again", &text, base, &[]).unwrap();
    assert_eq!(again.setup.air.viscosity(), Some(2e-5));
}

#[test]
fn refuses_a_viscosity_that_is_given_twice_or_acts_on_nothing() {
    let refused = |name: &str, set: &[&str]| found(name, set).unwrap_err();
    let given = "air.viscosity_m2_s=2e-5";
    for other in [
        "air.wake_core.algebraic.viscosity_m2_s=2e-5",
        "air.section_drag.viscosity_m2_s=2e-5",
    ] {
        let said = refused(
            "fruit-fly-blade",
            &["air.model=vortex_lattice", given, other],
        );
        let name = other.split('=').next().unwrap();
        assert!(
            said.contains("given twice") && said.contains(name),
            "{said}"
        );
    }
    let idle = [
        "air.model=vortex_lattice",
        given,
        "air.bound_core.scully.radius_m=1e-5",
        "air.wake_core.scully.radius_m=5e-5",
        "air.section_drag={friction=\"none\", cd0=0.1}",
    ];
    assert!(refused("fruit-fly-blade", &idle).contains("air.viscosity_m2_s"));
    assert!(refused("fruit-fly-blade", &["air.model=none", given]).contains("air.viscosity_m2_s"));
    assert!(refused("fruit-fly-blade", &["air.viscosity_m2_s=0"]).contains("> 0"));
}

/// A viscosity of air at the ground in the case stays where the density is changed, and is named.
#[test]
fn behaves_thin_gases_with_the_viscosity_of_air_are_told() {
    let said = |set: &[&str]| {
        let doubts = found("fruit-fly-hover", set).unwrap().setup.doubts();
        let mut all = doubts
            .into_iter()
            .filter(|d| d.kind == DoubtKind::ViscosityOfAir);
        all.next().map(|d| d.said)
    };
    let stated = "air.wake_core={algebraic={radius_m=5e-5, viscosity_m2_s=1.5e-5}}";
    let heliox = said(&["air.density_kg_m3=0.41", stated]).unwrap();
    assert!(
        heliox.contains("4.5e-5") && heliox.contains("remove the viscosity"),
        "{heliox}"
    );
    assert_eq!(said(&["air.density_kg_m3=1.1", stated]), None);
    let removed = [
        "air.density_kg_m3=0.41",
        "air.wake_core={algebraic={radius_m=5e-5}}",
    ];
    assert_eq!(said(&removed), None);
}

/// An oil may have the kinematic viscosity of air: that which is given as the fluid's is not doubted, nor in
/// the case that is made of the setup.
#[test]
fn behaves_a_viscosity_that_is_given_as_that_of_the_fluid_is_not_doubted() {
    let oil = "air.density_kg_m3=880";
    let core = "air.wake_core={algebraic={radius_m=5e-5, viscosity_m2_s=1.6587e-5}}";
    let given = found("fruit-fly-hover", &[oil, "air.viscosity_m2_s=1.6587e-5"]).unwrap();
    let written = case_of(&given.setup, None).unwrap().setup;
    let of_core = found("fruit-fly-hover", &[oil, core]).unwrap().setup;
    let [given, written, of_core] = [given.setup, written, of_core].map(|setup| {
        let doubts = setup.doubts();
        assert_eq!(setup.air.viscosity(), Some(1.6587e-5));
        doubts.iter().any(|d| d.kind == DoubtKind::ViscosityOfAir)
    });
    assert_eq!([given, written, of_core], [false, false, true]);
}
