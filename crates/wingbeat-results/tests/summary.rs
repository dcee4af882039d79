//! The summary's judgement: alarms where something is wrong, none where nothing is.

use wingbeat_case::LoadedCase;
use wingbeat_case::raw::{AirCase, AirModel, BodyCase, Case, FlightCase, OutputCase, TimeCase};
use wingbeat_flight::Simulation;
use wingbeat_results::{Outcome, ResultDir, RunWriter, Summary};

/// Flies a case to its end and reads the summary of what was written.
fn flown(case: &LoadedCase) -> Summary {
    let folder = format!("wingbeat-summary-{}-{}", case.name, std::process::id());
    let dir = ResultDir::overwrite(&std::env::temp_dir().join(folder)).unwrap();
    let path = dir.path().to_owned();
    let mut writer = RunWriter::new(dir, case, 1).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    loop {
        writer.write(flight.record(), || flight.snapshot()).unwrap();
        if flight.finished() {
            break;
        }
        flight.step().unwrap();
    }
    let summary = writer.finish(Outcome::Finished, |_, _, _| Ok(())).unwrap();
    std::fs::remove_dir_all(path).unwrap();
    summary
}

/// A body alone, without weight, turning at `rate` [deg/s].
fn rigid(name: &str, rate: [f64; 3]) -> LoadedCase {
    let case = Case {
        name: Some(name.to_owned()),
        gravity_m_s2: [0.0; 3],
        time: TimeCase {
            step_s: Some(0.01),
            steps: Some(50),
            ..TimeCase::default()
        },
        flight: FlightCase {
            angular_velocity_deg_s: rate,
            ..FlightCase::default()
        },
        air: AirCase {
            model: AirModel::None,
            ..AirCase::default()
        },
        output: OutputCase {
            frames_every: 0,
            ..OutputCase::default()
        },
        body: BodyCase {
            mass_kg: Some(1.0),
            inertia_about_centre_kg_m2: Some([1.0, 2.0, 2.5, 0.0, 0.0, 0.0]),
            ..BodyCase::default()
        },
        ..Case::default()
    };
    LoadedCase::new(case).unwrap()
}

fn preset(name: &str, set: &[&str]) -> LoadedCase {
    let quiet = ["output.frames_every=0"];
    let set: Vec<String> = set.iter().chain(&quiet).map(|&s| s.to_owned()).collect();
    LoadedCase::find(name, &set).unwrap()
}

fn says(summary: &Summary, words: &str) -> bool {
    summary.warnings.iter().any(|w| w.contains(words))
}

/// The kinetic energy of a free body does not change: its residual is no part of a change, but of the
/// energy itself.
#[test]
fn conserves_energy_of_a_free_rigid_body_without_an_alarm() {
    let summary = flown(&rigid("spinning", [100.0, 20.0, 300.0]));
    println!("{:.1e}", summary.energy_residual_relative);
    // Tolerance 1e-10 a step.
    assert!(summary.energy_residual_relative < 1e-9);
    assert!(!says(&summary, "balance"), "{:?}", summary.warnings);
    let still = flown(&rigid("resting", [0.0; 3]));
    assert_eq!(still.energy_residual_relative, 0.0);
    assert!(!says(&still, "balance"), "{:?}", still.warnings);
}

/// Without weight the momenta of two wings cancel but for roundings, which are measured by what
/// cancels.
#[test]
fn conserves_momentum_without_weight_without_an_alarm() {
    let case = preset(
        "fruit-fly-vacuum",
        &["gravity_m_s2=[0,0,0]", "time.beats=1"],
    );
    let summary = flown(&case);
    println!("{:.1e}", summary.momentum_residual_relative);
    assert!(summary.momentum_residual_relative < 1e-12);
    assert!(!says(&summary, "balance"), "{:?}", summary.warnings);
}

/// The momentum of a tethered animal is prescribed; a residual of its balance is the error of a
/// quadrature that nothing depends on.
#[test]
fn behaves_tethered_flights_are_not_told_that_their_momentum_is_open() {
    let summary = flown(&preset("flapping-rectangles", &["time.beats=1"]));
    assert!(
        summary.momentum_residual_relative > 1e-6,
        "the test is void"
    );
    assert!(
        !says(&summary, "momentum is open"),
        "{:?}",
        summary.warnings
    );
}

/// A gap between two ways to the lift has two causes; the wake is blamed only where the other one is
/// absent.
#[test]
fn behaves_missing_suction_is_not_blamed_on_the_wake() {
    let attached = [
        "air.shed=[\"trailing\",\"tip\"]",
        "air.loads=pressure",
        "air.body=false",
        "time.beats=2",
    ];
    let summary = flown(&preset("fruit-fly-tethered", &attached));
    let beat = summary.beats.last().unwrap();
    println!(
        "{:.3e} {:.3e}",
        beat.lift_newton, beat.lift_by_impulse_newton
    );
    assert!(
        beat.lift_by_impulse_newton > 1.2 * beat.lift_newton,
        "the test is void"
    );
    assert!(says(&summary, "suction of attached leading edges"));
    assert!(!says(&summary, "the wake does not keep its impulse"));
}
