//! The history: every number of a record has its column, rows are read back bit for bit, those of other builds are
//! refused, thinned ones say the same of wingbeats.

use std::fs;
use std::path::{Path, PathBuf};

use wingbeat_case::{IoError, LoadedCase};
use wingbeat_flight::{Record, Simulation};
use wingbeat_results::columns::Columns;
use wingbeat_results::history::HistoryWriter;
use wingbeat_results::poses::Poses;
use wingbeat_results::quantity::Fold;
use wingbeat_results::{Outcome, Records, ResultDir, RunWriter, Summary, rows::Rows};

use crate::flights::flown_into;

/// A folder of its own, removed at the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let name = format!("wingbeat-history-{name}-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn case(name: &str, set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    LoadedCase::find(name, &set).unwrap()
}

/// The records of a flight, its start among them.
fn records(case: &LoadedCase) -> Vec<Record> {
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    let mut list = vec![flight.record().clone()];
    while !flight.finished() {
        list.push(flight.step().unwrap().clone());
    }
    list
}

fn written(case: &LoadedCase, records: &[Record], path: &Path) {
    let mut writer = HistoryWriter::create(path, &case.setup).unwrap();
    for record in records {
        writer.take(record).unwrap();
        writer.flush().unwrap();
    }
}

fn read(path: &Path, case: &LoadedCase) -> Vec<Record> {
    let mut records = Records::open(path, &case.setup).unwrap();
    let mut list = vec![];
    while let Some(record) = records.next_record().unwrap() {
        list.push(record.clone());
    }
    list
}

/// Numbers in a record. Taken apart without `..`: a field that is added cannot be forgotten.
fn numbers(record: &Record) -> usize {
    let Record {
        step: _,
        time: _,
        wing_angles,
        commands,
        looks,
        reference,
        attitude_departure,
        coordinates,
        rates,
        root_quaternion,
        root_angular_velocity: _,
        mass_centre: _,
        accelerations,
        multipliers,
        hinges,
        loops,
        joints,
        deformation_power,
        elastic,
        air,
        applied,
        tether: _,
        kinetic_energy: _,
        potential_energy: _,
        hinge_work: _,
        air_work: _,
        deformation_work: _,
        applied_work: _,
        dissipated: _,
        energy_residual: _,
        momentum: _,
        angular_momentum: _,
        momentum_residual: _,
        angular_momentum_residual: _,
        violation_position: _,
        violation_orientation: _,
        euler_regularity: _,
        corrector_passes: _,
        corrector_residual: _,
        vortex_impulse: _,
        air_impulse: _,
        inviscid_impulse: _,
        impulse_account: _,
        impulse_residual: _,
        wake_rings: _,
        wake_particles: _,
        regularised: _,
        limited: _,
        leading_rings: _,
        net_flux_residual: _,
        passive_power: _,
        passive_work: _,
        positive_work: _,
        dynamic_impulse: _,
        momentum_residual_of_works: _,
    } = record;
    let lists = coordinates.len() + rates.len() + multipliers.len() + deformation_power.len();
    // Tip (3), twist, four sections (3), elastic energy and its power, that of the air, passes of each; what
    // all have dissipated.
    let elastic = 20 * elastic.len() + usize::from(!elastic.is_empty());
    let steered = looks.len() * commands.len().min(1);
    let aims = 8 * reference.len() + attitude_departure.len();
    let feedback = 8 * commands.len() + steered + aims;
    let vectors = 3 * wing_angles.len() + feedback + 6 * accelerations.len();
    let passive = 2 * joints.len().min(1); // power and work of springs, dampers and stops
    let reactions = 7 * (hinges.len() + loops.len()) + 2 * joints.len() + passive;
    let loads = 6 * (air.len() + applied.len() + 1);
    let (scalars, own_vectors) = (22, 16);
    lists
        + elastic
        + vectors
        + reactions
        + loads
        + root_quaternion.len()
        + scalars
        + 3 * own_vectors
}

const FLIGHTS: [(&str, &[&str]); 6] = [
    (
        "fruit-fly-abdomen-spring",
        &["time.beats=0.1", "air.model=\"none\""],
    ),
    (
        "robobee",
        &["time.beats=0.1", "air.model=\"blade_element\""],
    ),
    ("bird-cruise", &["time.beats=0.1"]),
    (
        "flapping-rectangles",
        &[
            "time.beats=0.1",
            "wing.right.mass_kg=0.1",
            "wing.right.structure.beam.flap_newton_m2=[1e3,1e3]",
            "wing.right.structure.beam.torsion_newton_m2=[1e3,1e3]",
        ],
    ),
    ("fruit-fly-blade", &["time.beats=0.1"]),
    (
        "fruit-fly-controlled",
        &[
            "time.beats=3",
            "air.model=\"blade_element\"",
            "control.hold=trim",
            "control.waypoint=[{time_s=0.01,position_m=[0,0,1e-3],heading_deg=20}]",
        ],
    ),
];

#[test]
fn exact_every_number_has_one_column_and_is_read_back_bit_for_bit() {
    let scratch = Scratch::new("bits");
    for (name, set) in FLIGHTS {
        let case = case(name, set);
        let records = records(&case);
        let columns = Columns::of(&case.setup, &records[0]).unwrap();
        assert_eq!(columns.iter().count(), numbers(&records[0]), "{name}");
        let names: std::collections::BTreeSet<String> = columns.names().into_iter().collect();
        assert_eq!(
            names.len(),
            numbers(&records[0]),
            "{name}: names are not distinct"
        );
        let path = scratch.0.join(format!("{name}.csv"));
        written(&case, &records, &path);
        let back = read(&path, &case);
        assert_eq!(back.len(), records.len());
        let bits = |r: &Record| -> Vec<u64> {
            let mut values = vec![];
            columns.values(r, &mut Record::default(), &mut values);
            values.iter().map(|x| x.to_bits()).collect()
        };
        for (a, b) in records.iter().zip(&back) {
            assert_eq!(bits(a), bits(b), "{name}, step {}", a.step);
        }
    }
}

/// Whatever reads types from the first rows sees counts as whole numbers and all else as
/// floating-point numbers, zeros too.
#[test]
fn behaves_counts_look_like_counts_and_numbers_like_numbers() {
    let scratch = Scratch::new("types");
    let case = case("fruit-fly-vacuum", &["time.beats=0.1"]);
    let records = records(&case);
    let path = scratch.0.join("history.csv");
    written(&case, &records, &path);
    let columns = Columns::of(&case.setup, &records[0]).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let mut zeros = 0;
    for line in text.lines().skip(1) {
        for (field, column) in line.split(',').zip(columns.iter()) {
            let is_real = field.contains(['.', 'e', 'N', 'i']);
            assert_eq!(is_real, !column.is_count, "{}: {field}", column.name);
            zeros += usize::from(field == "0.0");
        }
    }
    assert!(zeros > 100, "the test is void");
}

/// Second differences of the recorded places are the recorded accelerations.
#[test]
fn agrees_accelerations_with_second_differences_of_places() {
    let case = case(
        "fruit-fly-blade",
        &["time.beats=0.5", "time.steps_per_beat=400"],
    );
    let records = records(&case);
    let h = case.setup.time.step;
    for body in 0..case.setup.animal.wings.len() + 1 {
        let place = |r: &Record| wingbeat_math::DVec3::from_slice(&r.coordinates[6 * body..]);
        let (mut error, mut largest) = (0.0_f64, 0.0_f64);
        for w in records.windows(3).skip(8) {
            let second = (place(&w[2]) - 2.0 * place(&w[1]) + place(&w[0])) / (h * h);
            error = error.max((second - w[1].accelerations[body].linear).length());
            largest = largest.max(second.length());
        }
        // The difference is of second order: (2 pi n / 400)^2 / 12 of harmonic n, to the eighth.
        assert!(error < 0.02 * largest, "body {body}: {error} of {largest}");
    }
}

/// Readers that know the flight refuse a table with a column under another name, without one, with one more, and with
/// two in each other's place; all say the same.
#[test]
fn refuses_histories_of_other_builds() {
    let scratch = Scratch::new("foreign");
    let case = case("fruit-fly-blade", &["time.beats=0.05"]);
    let path = scratch.0.join("history.csv");
    written(&case, &records(&case), &path);
    let text = fs::read_to_string(&path).unwrap();
    let rows = |of: &dyn Fn(&str) -> String| text.lines().map(of).collect::<String>();
    let without_last = |line: &str| line.rsplit_once(',').unwrap().0.to_owned() + "\n";
    let last = text.lines().next().unwrap().rsplit_once(',').unwrap().1;
    for (changed, found) in [
        (
            text.replacen("hinge_work_joule", "hinge_work_calorie", 1),
            "`hinge_work_joule` is missing",
        ),
        (rows(&without_last), &format!("`{last}` is missing")),
        (rows(&|line| format!("{line},mood\n")), "`mood` is unknown"),
        (
            text.replacen("time_s", "first", 1)
                .replacen("body_x_m", "time_s", 1)
                .replacen("first", "body_x_m", 1),
            "`body_x_m` has another place",
        ),
    ] {
        fs::write(&path, changed).unwrap();
        let problem = Records::open(&path, &case.setup).err().unwrap().to_string();
        for words in [found, "history.csv", "another build", "wingbeat run"] {
            assert!(problem.contains(words), "{words}: {problem}");
        }
        let of_summary = Summary::read(&case, &path, &Outcome::Finished).unwrap_err();
        assert_eq!(of_summary.to_string(), problem);
    }
}

#[test]
fn agrees_thinned_histories_with_whole_ones() {
    let scratch = Scratch::new("thinned");
    let set = |every: &str| {
        let own = format!("output.history_every={every}");
        let set = [
            "time.beats=2",
            "air.shed=[\"trailing\"]",
            "air.body=false",
            "wing.right.mesh.spanwise=4",
            "wing.right.mesh.chordwise=2",
            "output.frames_every=0",
            &own,
        ];
        case("fruit-fly-hover", &set)
    };
    let (all, few) = (scratch.0.join("all"), scratch.0.join("few"));
    let flown = |case: &LoadedCase, dir: &Path| flown_into(case, ResultDir::create(dir).unwrap());
    let (whole, case) = (flown(&set("1"), &all), set("7"));
    let thinned = flown(&case, &few);
    let [all, few] = [all, few].map(|d| d.join("history.csv"));
    assert_eq!(Rows::count(&all).unwrap(), 81);
    // 0, 7, ..., 77, and the beats at 40 and 80.
    assert_eq!(Rows::count(&few).unwrap(), 14);
    assert_eq!(thinned.beats, whole.beats);
    assert_eq!(thinned.steps, whole.steps);
    assert_eq!(thinned.regularised, whole.regularised);
    assert_eq!(thinned.leading_rings, whole.leading_rings);
    assert_eq!(thinned.euler_regularity, whole.euler_regularity);
    assert_eq!(thinned.corrector_passes_most, whole.corrector_passes_most);
    assert_eq!(thinned.violation_position_m, whole.violation_position_m);
    assert!(
        thinned
            .warnings
            .iter()
            .any(|w| w.contains("every 7th step")),
        "{:?}",
        thinned.warnings
    );
    // Rows are those of the whole history but for sums and extremes.
    let [all, few] = [read(&all, &set("1")), read(&few, &case)];
    for row in &few {
        let same = &all[row.step];
        assert_eq!((row.time, &row.coordinates), (same.time, &same.coordinates));
        assert_eq!((&row.air, row.hinge_work), (&same.air, same.hinge_work));
    }
    let columns = Columns::of(&case.setup, &few[0]).unwrap();
    let folded = |c: &&wingbeat_results::columns::Column| c.fold != Fold::Last;
    assert_eq!(columns.iter().filter(folded).count(), 9);
}

/// Where no frames are written wings are drawn bent as the history says of four sections: nearly where the
/// lattice has them, beams that twist and sheets that camber.
#[test]
fn agrees_bent_wings_of_rows_with_the_lattice() {
    // Measured 0.011 and 0.007: what lies between the sections, and shortening.
    for (name, part) in [("hawkmoth-elastic", 0.05), ("hawkmoth-veins", 0.03)] {
        let set = ["time.beats=0.5", "air.shed=[\"trailing\"]"];
        let case = case(name, &set);
        let mut flight = Simulation::new(case.setup.clone()).unwrap();
        let columns = Columns::of(&case.setup, flight.record()).unwrap();
        let poses = Poses::new(&case.setup.animal, &columns.names()).unwrap();
        let (mut scratch, mut row) = (columns.blank(), vec![]);
        let (mut off, mut bent) = (0.0_f64, 0.0_f64);
        while !flight.finished() {
            let record = flight.step().unwrap().clone();
            columns.values(&record, &mut scratch, &mut row);
            let seen = flight.snapshot();
            for (k, wing) in case.setup.animal.wings.iter().enumerate() {
                let (p, r) = poses.pose(&row, k + 1);
                let drawn = poses.nodes(&row, k).zip(&seen.surfaces[k].nodes);
                for ((a, b), rest) in drawn.zip(&wing.mesh.nodes) {
                    off = off.max(a.distance(*b));
                    bent = bent.max(b.distance(p + r * *rest));
                }
            }
        }
        println!("{name}: {off:e} of {bent:e}");
        assert!(off < part * bent, "{name}: {off:e} of {bent:e}");
    }
}

/// A frame that cannot be read for the page costs the page alone: the flight is at its end, and flying on would
/// not mend it.
#[test]
fn behaves_a_damaged_frame_leaves_a_finished_result() {
    let scratch = Scratch::new("damaged");
    let case = case("fruit-fly-blade", &["time.beats=0.1"]);
    let dir = scratch.0.join("run");
    let mut writer = RunWriter::new(ResultDir::create(&dir).unwrap(), &case, 1).unwrap();
    let mut flight = Simulation::new(case.setup.clone()).unwrap();
    writer.write(flight.record(), || flight.snapshot()).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
        writer.write(flight.record(), || flight.snapshot()).unwrap();
    }
    let damaged = writer.finish(Outcome::Finished, |dir, _, _| {
        Err(IoError::Damaged {
            path: dir.path().to_owned(),
            problem: "a frame".to_owned(),
        })
    });
    assert!(matches!(damaged, Err(IoError::Damaged { .. })));
    assert!(dir.join("summary.json").is_file() && !dir.join("checkpoint.bin").exists());
    let manifest = fs::read_to_string(dir.join("manifest.json")).unwrap();
    assert!(manifest.contains("finished"), "{manifest}");
}
