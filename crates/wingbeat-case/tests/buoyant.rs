//! Buoyancy of closed bodies (`air.buoyancy`), and what is said where it is missing.

use std::path::Path;

use crate::common;
use wingbeat_analysis::{LinearModel, Plane, floquet, linear_model, table_model, trim};
use wingbeat_analysis::{SteadyFlight, Trim, TrimProblem};
use wingbeat_case::{LoadedCase, derivative_case, trimmed_case};
use wingbeat_flight::{DoubtKind, Record, Simulation};
use wingbeat_math::DVec3;

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
    // Roundings within the tolerance of the corrector: 9e-9 rad/s measured.
    assert!(last.root_angular_velocity.length() < 5e-8);
    2.0 * (records[0].mass_centre.z - last.mass_centre.z) / last.time.powi(2)
}

/// A light ball rises with the acceleration `(rho V - m) g / (m + rho V / 2)` without turning, and falls without buoyancy
/// by `-m g` in place of that force: their ratio is that of the forces, whatever added mass panels have.
#[test]
fn limit_a_light_ball_rises_against_its_added_mass() {
    for density in [0.8, 0.5, 0.1, 0.02] {
        let [rises, falls] = [true, false].map(|buoyancy| rise(density, buoyancy));
        // Added mass of 0.5 to 25 times the ball's own.
        let expected = (1.0 - density) / (density + 0.5) * GRAVITY;
        let off = rises / expected - 1.0;
        let ratio = rises / falls * density / (density - 1.0) - 1.0;
        println!("{density}: {rises} of {expected}, {off:e}; ratio {ratio:e}");
        // 16 by 16 panels lie within the ball and have less added mass: 2 to 6 % measured.
        assert!(off.abs() < 0.15, "{density}: {rises} of {expected}");
        // To the tolerance of the corrector: 4e-9 measured with 0.02 of the weight.
        assert!(ratio.abs() < 4e-8, "{density}: {ratio:e}");
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
        open.contains("air.buoyancy") && open.contains("allowed: beside a closed part"),
        "{open}"
    );
    assert!(
        open.contains("try: give the body its shape ([body.part.NAME]"),
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

/// Small hawkmoth wings on which a balloon bears up three tenths of the weight, with `more` set besides.
fn moth(more: &[&str]) -> LoadedCase {
    let balloon = [
        "body.part.balloon.length_m=0.1",
        "body.part.balloon.diameter_m=0.1",
        "body.part.balloon.centre_m=[0,0,-0.06]",
        "air.buoyancy=true",
    ];
    common::preset("hawkmoth-blade", &[&balloon[..], more].concat())
}

/// Hover of the moth, and its averaged model.
fn hover(case: &LoadedCase) -> (Trim, LinearModel) {
    let pitch = case.setup.angles_at_release().x;
    let found = trim(&case.setup, &TrimProblem::straight(DVec3::ZERO, pitch)).unwrap();
    assert!(found.solution.converged);
    let model = linear_model(&found.beat, &found.state).unwrap();
    (found, model)
}

/// Buoyancy above the mass centre rights the body: the averaged model has the oscillation of the wingbeat (Floquet), and
/// so has the table of derivatives that is made of it, whose case carries the load.
#[test]
fn agrees_averaged_modes_of_a_flyer_on_a_balloon_with_those_of_its_wingbeat() {
    let case = moth(&[]);
    let (found, averaged) = hover(&case);
    let exact = floquet(&found.beat, &found.state).unwrap();
    let table = derivative_case(&case, &SteadyFlight::of(&found).unwrap(), &averaged);
    let table = LoadedCase::from_text("table", &table, Path::new(""), &[]).unwrap();
    let table = table_model(&table.setup).unwrap();
    let find = |set: &wingbeat_analysis::ModeSet| {
        ["stable phugoid", "stable short period"].map(|name| {
            let mode = set.find(Plane::Longitudinal, name).unwrap();
            [mode.growth, mode.frequency]
        })
    };
    let [all, mean, written] = [&exact, &averaged.modes, &table.modes].map(find);
    for ((exact, mean), written) in all.iter().zip(mean).zip(written) {
        let size = exact[0].hypot(exact[1]);
        let apart = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) / size;
        println!("{exact:?} {mean:?} {written:?}");
        // What moves within a beat: 0.019 and 0.035 measured; without the load 3 and 1.
        assert!(apart(*exact, mean) < 0.1, "{exact:?} {mean:?}");
        // All digits are written: roundings, 7e-13 measured.
        assert!(apart(mean, written) < 5e-12, "{mean:?} {written:?}");
    }
    // 0.05 of the weight measured, without the load 0.34.
    assert!(averaged.imbalance[0] < 0.1, "{:?}", averaged.imbalance);
}

/// The work of buoyancy is its force times the way of the centre of the volume, and the balance of energy holds.
#[test]
fn balances_the_work_of_buoyancy() {
    let records = flown(&ball(0.5, "buoyancy = true").unwrap());
    let [first, last] = [&records[0], &records[records.len() - 1]];
    let force = 1000.0 * std::f64::consts::PI / 6.0 * 1e-3 * GRAVITY;
    let risen = first.mass_centre.z - last.mass_centre.z; // the ball does not turn
    let off = last.applied_work / (force * risen) - 1.0;
    let left = last.energy_residual / last.applied_work;
    println!("{off:e} {left:e}");
    // A constant force: roundings. The balance: 2e-4, of the first steps, of first order.
    assert!(off.abs() < 4e-15 && left.abs() < 2e-3, "{off:e} {left:e}");
}

/// A flight that goes on from a saved state is that which was not interrupted, to the bit.
#[test]
fn exact_a_buoyant_flight_resumes_bit_for_bit() {
    let case = ball(0.1, "buoyancy = true").unwrap();
    let whole = flown(&case);
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    (0..20).for_each(|_| drop(flight.step().unwrap().clone()));
    let mut resumed = Simulation::resume(case.setup, flight.state().clone()).unwrap();
    while !resumed.finished() {
        resumed.step().unwrap();
    }
    let [last, again] = [&whole[whole.len() - 1], resumed.record()];
    assert_eq!(last.mass_centre, again.mass_centre);
    assert_eq!(last.applied_work.to_bits(), again.applied_work.to_bits());
}

/// Over a beat of the trimmed flight the air carries what buoyancy leaves of the weight.
#[test]
fn balances_lift_and_buoyancy_of_a_trimmed_flyer() {
    let case = moth(&[]);
    let text = trimmed_case(&case, &hover(&case).0).unwrap();
    let beat = ["time.beats=1".to_owned()];
    let hovering = LoadedCase::from_text("hover", &text, Path::new(""), &beat).unwrap();
    let records = flown(&hovering);
    let lift = |r: &Record| -r.air.iter().map(|w| w.force.z).sum::<f64>();
    let mean = records[1..].iter().map(lift).sum::<f64>() / (records.len() - 1) as f64;
    let weight = case.setup.animal.mass() * GRAVITY;
    let borne = case.setup.lift_of_loads() / weight;
    let off = mean / weight + borne - 1.0;
    println!("{borne} {off:e}");
    // Means of 100 steps in place of the integral over the beat, in which the air turns to the other edge at once at
    // reversal: 1.3e-4 measured.
    assert!(borne > 0.2 && off.abs() < 1e-3, "{borne} {off:e}");
}

/// A regulator that is laid out for the trimmed flight holds it: without buoyancy in its layout the moth rose 222 mm.
#[test]
fn behaves_a_regulator_that_holds_the_trim_knows_of_buoyancy() {
    let set = [
        "body.part.balloon.centre_m=[0,0,0]",
        "control={controller=\"regulator\", hold=\"trim\"}",
        "time.beats=60",
    ];
    let records = flown(&moth(&set));
    let [first, last] = [&records[0], &records[records.len() - 1]];
    let moved = last.mass_centre.distance(first.mass_centre);
    // The start of the case is not the trimmed one; after 60 beats 8e-6 m are left.
    assert!(moved < 8e-5, "{moved:e}");
}
