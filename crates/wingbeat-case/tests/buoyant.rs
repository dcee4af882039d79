//! Buoyancy of closed bodies (`air.buoyancy`), and what is said where it is missing.

use std::path::Path;

use crate::common;
use wingbeat_case::LoadedCase;
use wingbeat_flight::{DoubtKind, Record, Simulation};

const GRAVITY: f64 = 9.81;

/// A ball in water, at rest, of this density over that of water; `more` under `[air]`.
fn ball(density: f64, more: &str) -> Result<LoadedCase, String> {
    let text = format!(
        "format = 1\n[time]\nstep_s = 0.002\nsteps = 40\n[flight]\nmode = \"free\"\n[dynamics]\nintegrator = \"bdf\"\n\
         [body.part.ball]\nlength_m = 0.1\ndiameter_m = 0.1\ncentre_m = [0.02, 0, 0.01]\ndensity_kg_m3 = {}\nstations = 16\n\
         meridians = 16\n[output]\nframes_every = 0\n[air]\ndensity_kg_m3 = 1000\n{more}",
        1000.0 * density
    );
    LoadedCase::from_text("ball", &text, Path::new(""), &[]).map_err(|e| e.to_string())
}

fn flown(case: &LoadedCase) -> Vec<Record> {
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut records = vec![flight.record().clone()];
    while !flight.finished() {
        flight.step().unwrap();
        records.push(flight.record().clone());
    }
    records
}

/// What weighs as much as the fluid that it displaces stays where it is [Archimedes]: to the rounding of its weight.
#[test]
fn exact_a_neutral_ball_stays() {
    let records = flown(&ball(1.0, "buoyancy = true").unwrap());
    let last = records.last().unwrap();
    let fallen = 0.5 * GRAVITY * last.time.powi(2);
    let moved = last.mass_centre.distance(records[0].mass_centre);
    assert!(moved < 1e-12 * fallen, "{moved:e} of {fallen:e}");
}

/// Acceleration upwards of a ball over a flight from rest \[m/s2\].
fn rise(density: f64, buoyancy: bool) -> f64 {
    let records = flown(&ball(density, &format!("buoyancy = {buoyancy}")).unwrap());
    let last = records.last().unwrap();
    assert!(last.root_angular_velocity.length() < 1e-9);
    2.0 * (records[0].mass_centre.z - last.mass_centre.z) / last.time.powi(2)
}

/// A light ball rises with the acceleration `(rho V - m) g / (m + rho V / 2)` without turning, and falls without buoyancy
/// by `-m g` in place of that force: their ratio is that of the forces, whatever added mass panels have.
#[test]
fn limit_a_light_ball_rises_against_its_added_mass() {
    for density in [0.8, 0.5] {
        let [rises, falls] = [true, false].map(|buoyancy| rise(density, buoyancy));
        let expected = (1.0 - density) / (density + 0.5) * GRAVITY;
        let off = rises / expected - 1.0;
        let ratio = rises / falls * density / (density - 1.0) - 1.0;
        println!("{density}: {rises} of {expected}, {off:e}; ratio {ratio:e}");
        // 16 by 16 panels lie within the ball and have less added mass: 5 % measured with half of the weight.
        assert!(off.abs() < 0.15, "{density}: {rises} of {expected}");
        // To the tolerance of the corrector: 1e-8 measured with 0.8 of the weight.
        assert!(ratio.abs() < 1e-7, "{density}: {ratio:e}");
    }
}

/// Parts of segments have theirs, at their own centres.
#[test]
fn exact_loads_of_body_and_segments_are_the_weights_of_what_they_displace() {
    let text = "format = 1\ngravity_m_s2 = [0, 3, 4]\n[time]\nstep_s = 0.002\nsteps = 4\n[air]\nmodel = \"vortex_lattice\"\n\
         density_kg_m3 = 1000\nbuoyancy = true\n[dynamics]\nintegrator = \"bdf\"\n[body.part.head]\nlength_m = 0.1\n\
         diameter_m = 0.1\ncentre_m = [0.1, 0, 0]\nmass_kg = 0.4\n[body.part.tail]\nlength_m = 0.1\ndiameter_m = 0.05\n\
         centre_m = [-0.1, 0, 0]\nmass_kg = 0.1\n[segment.rear]\nparts = [\"tail\"]\n[joint.waist]\nchild = \"rear\"\n\
         at_m = [-0.04, 0, 0]\n";
    let case = LoadedCase::from_text("two", text, Path::new(""), &[]).unwrap();
    let loads = &case.setup.loads;
    assert_eq!(loads.iter().map(|l| l.body).collect::<Vec<_>>(), [0, 1]);
    for (load, (volume, centre)) in loads.iter().zip([(1.0 / 6.0, 0.1), (1.0 / 24.0, -0.06)]) {
        let weight = 5.0 * 1000.0 * volume * std::f64::consts::PI * 1e-3;
        let force = load.force.each_ref().map(|f| f.constant);
        // Of round solids, not of their panels: roundings.
        assert!(
            (force[1] / (-0.6 * weight) - 1.0).abs() < 1e-9,
            "{force:?} {weight}"
        );
        assert!((force[2] / force[1] - 4.0 / 3.0).abs() < 1e-12 && force[0] == 0.0);
        assert!((load.point.x - centre).abs() < 1e-9, "{:?}", load.point);
    }
}

/// Without gravity, in no fluid, and of nothing closed there is none.
#[test]
fn refuses_buoyancy_that_can_be_none() {
    let refused = |text: &str, set: &[&str]| {
        let found = common::load(text, set);
        found.map(|_| ()).unwrap_err()
    };
    let text = ball(1.0, "buoyancy = true").unwrap().resolved();
    let still = refused(&text, &["gravity_m_s2=[0, 0, 0]"]);
    assert!(
        still.contains("air.buoyancy") && still.contains("without gravity"),
        "{still}"
    );
    let open = "format = 1\n[time]\nstep_s = 0.01\nsteps = 2\n[air]\nmodel = \"blade_element\"\nbuoyancy = true\n\
         blade.body_drag = { area_m2 = 3e-4, along = 0.4, across = 1, centre_m = [0, 0, 0] }\n[body]\nmass_kg = 1\n\
         inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]\n";
    let open = refused(open, &[]);
    assert!(
        open.contains("air.buoyancy") && open.contains("closed part"),
        "{open}"
    );
    let vacuum = "format = 1\n[time]\nstep_s = 0.01\nsteps = 2\n[air]\nmodel = \"none\"\nbuoyancy = true\n\
         [body.part.ball]\nlength_m = 0.1\ndiameter_m = 0.1\nmass_kg = 1\n";
    let vacuum = refused(vacuum, &[]);
    assert!(vacuum.contains("air.buoyancy"), "{vacuum}");
}

/// A body that the fluid bears up by more than a few hundredths of its weight is doubted without the key, of insects in
/// air none. One that is light beside the fluid is told to take `bdf`, with which it flies. Without wings there are no
/// wakes whose cores could spread.
#[test]
fn behaves_bodies_in_water_are_doubted_without_buoyancy() {
    let has =
        |case: &LoadedCase, kind: DoubtKind| case.setup.doubts().iter().any(|d| d.kind == kind);
    let without = ball(1.0, "").unwrap();
    assert!(has(&without, DoubtKind::NoBuoyancy));
    assert!(!has(&without, DoubtKind::ViscosityOfAir) && !has(&without, DoubtKind::LightBody));
    assert!(!has(
        &ball(1.0, "buoyancy = true").unwrap(),
        DoubtKind::NoBuoyancy
    ));
    assert!(!has(&ball(40.0, "").unwrap(), DoubtKind::NoBuoyancy));
    let hamming = without.resolved().replace("\"bdf\"", "\"hamming\"");
    let hamming = LoadedCase::from_text("ball", &hamming, Path::new(""), &[]).unwrap();
    assert!(has(&hamming, DoubtKind::LightBody));
    let fly = LoadedCase::find("fruit-fly-hover", &[]).unwrap();
    assert!(!has(&fly, DoubtKind::NoBuoyancy) && !has(&fly, DoubtKind::LightBody));
}
