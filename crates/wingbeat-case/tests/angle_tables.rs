//! Tables of angles, in the case and in files: columns, units, phases, fits.

use std::fs;
use std::path::Path;

use wingbeat_case::LoadedCase;

use crate::common::refusal;
use crate::idle::ANIMAL;

#[test]
fn refuses_tables_without_a_header() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("no-header.csv");
    fs::write(&file, "# digitised\n0,10\n0.25,3\n0.5,-10\n0.75,3\n1,10\n").unwrap();
    let law = format!("wing.right.motion.phi={{ table = {{ file = {file:?} }} }}");
    let said = refusal("fruit-fly-hover", &[&law]);
    let says = "its first row, `0,10`, consists of numbers, and there is no header line above it";
    assert!(said.contains(says), "{said}");
}

/// A lost frame is no sample: the law is that of the table without its row, whatever stands in its cell.
#[test]
fn exact_rows_without_an_angle_are_left_out() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let loaded = |name: &str, cells: [&str; 2]| {
        let file = folder.join(format!("gaps-{name}.csv"));
        let [third, sixth] = cells;
        let rows = format!(
            "phase,angle_deg\n0,10\n0.125,8\n{third}0.375,-8\n0.5,-10\n{sixth}0.75,3\n1,10\n"
        );
        fs::write(&file, rows).unwrap();
        let law = format!("wing.right.motion.phi={{ table = {{ file = {file:?} }} }}");
        LoadedCase::find("fruit-fly-hover", &[law]).unwrap()
    };
    let without = loaded("none", ["", ""]);
    assert_eq!(without.table_gaps, []);
    for (name, cells) in [
        ("empty", ["0.25,\n", "0.625\u{20},\u{20}\n"]),
        ("nan", ["0.25,NaN\n", "0.625,n/a\n"]),
        ("both", ["nan,nan\n", "0.625,NA\n"]),
    ] {
        let case = loaded(name, cells);
        assert_eq!(
            case.setup.animal.wings, without.setup.animal.wings,
            "{name}"
        );
        let [gaps] = &case.table_gaps[..] else {
            panic!("{:?}", case.table_gaps)
        };
        let told = (gaps.key.as_str(), gaps.left_out, gaps.kept);
        assert_eq!(told, ("wing.right.motion.phi.table", 2, 6));
    }
}

/// A wrong name of a column is said of the key that gives it, with the names that there are.
#[test]
fn refuses_columns_that_are_not_in_the_file_by_the_key_that_names_them() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let angles = folder.join("names.csv");
    fs::write(&angles, "time,R_stroke,R_rot,L_rot\n0,1,2,3\n").unwrap();
    let points = folder.join("axes.csv");
    fs::write(&points, "x_mm,y_mm\n0,0\n2,0\n2,1\n").unwrap();
    let table = "wing.right.motion.psi.table";
    let outline = "wing.right.planform.outline";
    for (own, key, remedy) in [
        (
            "angle_column = \"R_stork\"",
            format!("{table}.angle_column"),
            "did you mean `R_stroke`?",
        ),
        (
            "angle_column = \"rot\"",
            format!("{table}.angle_column"),
            "`R_rot` or `L_rot`?",
        ),
        (
            "phase_column = \"frame\"",
            format!("{table}.phase_column"),
            "name one of its columns",
        ),
        (
            "x_column = \"x\"",
            format!("{outline}.x_column"),
            "did you mean `x_mm`?",
        ),
    ] {
        let (angle, file) = match own.starts_with("x_") {
            true => ("wing.right.planform={ outline", &points),
            false => ("wing.right.motion.psi={ table", &angles),
        };
        let said = refusal(
            "fruit-fly-hover",
            &[&format!("{angle} = {{ file = {file:?}, {own} }} }}")],
        );
        assert!(said.contains(&key) && said.contains(remedy), "{said}");
        assert!(said.contains("has no column"), "{said}");
    }
}

/// The angle of a table is that of its key, whatever the wing is called.
#[test]
fn behaves_tables_of_wings_that_are_named_after_angles() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let file = folder.join("psi.csv");
    fs::write(&file, "phase,psi\n0,1\n0.3,2\n0.6,-1\n1,1\n").unwrap();
    let of = |angle: &str| {
        let (before, after) = ANIMAL.split_once("[wing.right]").unwrap();
        let (wing, air) = after.split_once("[air]").unwrap();
        let wing = wing.replace("wing.right", "wing.phi");
        let text = format!("{before}[wing.phi]\nside = \"right\"{wing}[air]{air}");
        let table = format!("wing.phi.motion.{angle}={{ table = {{ file = {file:?} }} }}");
        let case = LoadedCase::from_text("case", &text, Path::new(""), &[table]);
        case.map(|_| ()).map_err(|e| e.to_string())
    };
    assert_eq!(of("psi"), Ok(()));
    let said = of("theta").unwrap_err();
    assert!(said.contains("this is the table of theta"), "{said}");
}

/// An angle without its time, and a point of an outline without one of its places, are no lost frames.
#[test]
fn refuses_rows_that_lack_a_phase_or_a_place() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let angles = folder.join("no-phase.csv");
    fs::write(&angles, "phase,angle_deg\n0,10\n,3\n0.5,-10\n0.75,3\n").unwrap();
    let law = format!("wing.right.motion.phi={{ table = {{ file = {angles:?} }} }}");
    let points = folder.join("no-place.csv");
    fs::write(&points, "x_mm,y_mm\n0,0\n2,\n2,1\n0,1\n").unwrap();
    let outline = format!("wing.right.planform={{ outline = {{ file = {points:?} }} }}");
    for set in [law, outline] {
        let said = refusal("fruit-fly-hover", &[&set]);
        assert!(said.contains("line 3: a cell of `"), "{said}");
        assert!(said.contains("leave the row out"), "{said}");
    }
}

#[test]
fn exact_semicolons_and_tabs_part_columns_like_commas() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    let rows = "# digitised, by hand\nphase,angle_deg\n0,10\n0.25,3\n0.5,-10\n0.75,3\n1,10\n";
    // Spreadsheets put a byte order mark before everything, comments too.
    let ways = [
        (",", ""),
        (";", ""),
        ("\t", ""),
        (";", "\u{feff}"),
        ("\t", "\u{feff}"),
    ];
    let [comma, others @ ..] = ways.map(|(sign, mark)| {
        let file = folder.join(format!("columns-{}-{}.csv", sign.as_bytes()[0], mark.len()));
        fs::write(&file, format!("{mark}{}", rows.replace(',', sign))).unwrap();
        let law = format!("wing.right.motion.phi={{ table = {{ file = {file:?} }} }}");
        let case = LoadedCase::find("fruit-fly-hover", &[law]).unwrap();
        case.setup.animal.wings[1].motion.clone()
    });
    for other in others {
        assert_eq!(comma, other);
    }
}

#[test]
fn refuses_phases_in_other_units_by_the_line() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slips");
    fs::create_dir_all(&folder).unwrap();
    for (name, rows, says) in [
        (
            "cents",
            "0,10\n25,3\n50,-10\n75,3\n100,10",
            "line 6: the table spans 100 wingbeats, not 1: phases in per cent",
        ),
        (
            "degrees",
            "0,10\n90,3\n180,-10\n270,3\n360,10",
            "phases in degrees are to be divided by 360",
        ),
        (
            "seconds",
            "0,10\n0.001,3\n0.002,-10\n0.004,3\n0.005,10",
            "times are to be divided by the period",
        ),
        (
            "unsorted",
            "0,10\n0.5,3\n0.3,-10\n0.75,3\n1,10",
            "line 4: phase 0.3 does not increase",
        ),
    ] {
        let file = folder.join(format!("{name}.csv"));
        fs::write(&file, format!("phase,phi\n{rows}\n")).unwrap();
        let law = format!("wing.right.motion.phi={{ table = {{ file = {file:?} }} }}");
        let said = refusal("fruit-fly-hover", &[&law]);
        assert!(said.contains(says) && said.contains("table.file"), "{said}");
    }
}

/// Times in place of phases of angles that harmonics are fitted to: by their span, the name of their column or
/// what the fit leaves.
#[test]
fn refuses_times_in_place_of_phases_with_harmonics() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("times");
    fs::create_dir_all(&folder).unwrap();
    // Two beats of 5 ms.
    let law_at = |column: &str, unit: f64, step: f64| {
        let file = folder.join(format!("{column}.csv"));
        let row = |k: i32| {
            let time = step * f64::from(k);
            let angle = 60.0 * (std::f64::consts::TAU * 200.0 * time).sin();
            format!("{},{angle}\n", time / unit)
        };
        let rows: String = (0..=50).map(row).collect();
        fs::write(&file, format!("{column},phi\n{rows}")).unwrap();
        format!("wing.right.motion.phi={{ table = {{ file = {file:?}, harmonics = 4 }} }}")
    };
    let law = |column: &str, unit: f64| law_at(column, unit, 1e-2 / 49.0);
    let seconds = refusal("fruit-fly-tethered", &[&law("time", 1.0)]);
    assert!(
        seconds.contains("all phases lie within 0.0102 wingbeats; times are to be divided by"),
        "{seconds}"
    );
    let named = refusal("fruit-fly-tethered", &[&law("time_ms", 1e-3)]);
    assert!(
        named.contains("its column `time_ms` says `ms`") && named.contains("give beats_per_unit"),
        "{named}"
    );
    // A whole number of samples in a millisecond.
    let coarse = refusal("fruit-fly-tethered", &[&law_at("time", 1e-3, 2e-4)]);
    assert!(
        coarse.contains("fewer harmonics; times are to be divided"),
        "{coarse}"
    );
    let doubts = |law: String| {
        let case = LoadedCase::find("fruit-fly-tethered", &[law]).unwrap();
        case.doubtful_measurements().join("\n")
    };
    let folded = doubts(law("time", 1e-3));
    assert!(
        folded.contains("10.2041 wingbeats in all, are times, give beats_per_unit"),
        "{folded}"
    );
    assert_eq!(doubts(law("phase", 5e-3)), "");
}

/// Angles that drift are for harmonics, too.
#[test]
fn refuses_tables_that_do_not_close_with_harmonics_as_remedy() {
    let law =
        "wing.right.motion.phi={ table = { rows_deg = [[0, 10], [0.3, 3], [0.6, -10], [1, 14]] } }";
    let said = refusal("fruit-fly-tethered", &[law]);
    let problem = said.lines().find(|l| l.contains("not periodic")).unwrap();
    assert!(problem.contains("fitted by `harmonics`"), "{said}");
}

#[test]
fn exact_angles_of_a_file_are_in_the_unit_that_their_column_says() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("units");
    fs::create_dir_all(&folder).unwrap();
    let load = |column: &str, size: f64| {
        let file = folder.join(format!("{}.csv", column.replace([' ', '[', ']'], "-")));
        let row = |k: i32| format!("{},{}\n", 0.25 * f64::from(k), size * f64::from(k % 4));
        let rows: String = (0..=4).map(row).collect();
        fs::write(&file, format!("phase,{column}\n{rows}")).unwrap();
        let law = format!("wing.right.motion.psi={{ table = {{ file = {file:?} }} }}");
        LoadedCase::find("fruit-fly-hover", &[law]).map_err(|e| e.to_string())
    };
    let angle = |column: &str, size: f64| {
        let case = load(column, size).unwrap();
        case.setup.animal.wings[1].motion.angles.psi.at(0.25)[0]
    };
    let expected = angle("psi", 20.0);
    assert!((expected - 20f64.to_radians()).abs() < 1e-12, "{expected}");
    for (column, size) in [
        ("psi_deg", 20.0),
        ("psi [degrees]", 20.0),
        ("gradient", 20.0),
        ("psi_rad", 20f64.to_radians()),
        ("psi [rad]", 20f64.to_radians()),
    ] {
        let found = angle(column, size);
        assert!((found - expected).abs() < 1e-12, "{column}: {found}");
    }
    let said = load("psi_rad_deg", 20.0).unwrap_err();
    assert!(said.contains("both radians and degrees"), "{said}");
    let said = load("psi_rad", 20.0).unwrap_err();
    assert!(
        said.contains("it holds 0 to 60, more than a whole turn") && said.contains("`psi_deg`"),
        "{said}"
    );
    for (column, right) in [
        ("psi_radians", "psi_degrees"),
        ("Psi_Rad", "Psi_Deg"),
        ("PSI [RAD]", "PSI [DEG]"),
        ("gradual psi (rad)", "gradual psi (deg)"),
    ] {
        let said = load(column, 20.0).unwrap_err();
        assert!(said.contains(&format!("(`{right}`)")), "{column}: {said}");
    }
}

/// Signs of angles on a tethered animal: both wings, or a left one with the signs of a right one; and samples
/// that scatter.
#[test]
fn behaves_signs_and_noise_of_measured_angles_are_doubted_on_tethers_too() {
    let doubts = |set: &[String]| {
        let case = LoadedCase::find("fruit-fly-tethered", set).unwrap();
        wingbeat_analysis::estimate(&case.setup).doubts.join("\n")
    };
    let wing = |side: &str, [phi, theta, psi]: [f64; 3]| {
        let motion = [
            format!("phi={{fourier={{cosine_deg=[{phi}]}}}}"),
            format!("theta={{fourier={{cosine_deg=[0.0, {theta}]}}}}"),
            format!("psi={{fourier={{sine_deg=[{psi}]}}}}"),
        ];
        motion.map(|m| format!("wing.{side}.motion.{m}"))
    };
    let both = |left: [f64; 3], right: [f64; 3]| {
        let air = ["motion.data=", "air.mirror=false", "air.body=false"].map(str::to_owned);
        doubts(&[&air[..], &wing("left", left), &wing("right", right)].concat())
    };
    let right = [-70.0, 5.0, -45.0];
    let down = "it pushes the body down: look at the signs and phases";
    let sound = both([70.0, -5.0, -45.0], right);
    assert!(
        !sound.contains("against each other") && !sound.contains(down),
        "{sound}"
    );
    for (left, right, says) in [
        ([70.0, -5.0, 45.0], [-70.0, 5.0, 45.0], down),
        ([70.0, -5.0, 45.0], right, "feather against each other"),
        ([70.0, 5.0, -45.0], right, "deviate against each other"),
    ] {
        let said = both(left, right);
        assert!(said.contains(says), "{says}: {said}");
    }
}

/// A table in which a sample of 200 is wrong by a whole turn; the harmonics of a fit, what it leaves, and fits
/// that the samples do not determine.
#[test]
fn behaves_tables_of_angles_can_be_fitted() {
    let stroke = |k: usize| 70.0 * (std::f64::consts::TAU * k as f64 / 200.0).cos();
    let row = |k: usize| {
        let wrong = if k == 30 { 360.0 } else { 0.0 };
        format!("[{}, {}]", k as f64 / 200.0, stroke(k) + wrong)
    };
    let rows = (0..=200).map(row).collect::<Vec<_>>().join(", ");
    let law = |more: &str| format!("wing.right.motion.phi={{table={{rows_deg=[{rows}]{more}}}}}");
    let case = LoadedCase::find("fruit-fly-tethered", &[law("")]).unwrap();
    assert!(case.fitted_tables().is_empty());
    let doubts = wingbeat_analysis::estimate(&case.setup).doubts.join("\n");
    assert!(
        doubts.contains("the samples of motion.phi scatter by some"),
        "{doubts}"
    );
    let case = LoadedCase::find("fruit-fly-tethered", &[law(", harmonics=3")]).unwrap();
    let [fit] = &case.fitted_tables()[..] else {
        panic!("one table is fitted")
    };
    assert_eq!(
        (&fit.key[..], fit.samples),
        ("wing.right.motion.phi.table", 200)
    );
    // All of the 360 deg but the share of 7 coefficients of 200: 360 sqrt((1 - 7 / 200) / 200).
    assert!(
        (fit.residual_deg - 25.0).abs() < 0.1,
        "{}",
        fit.residual_deg
    );
    let doubt = fit.doubt().expect("a doubt");
    assert!(
        doubt
            .contains("at phase 0.15, is 360.0 deg off the 3 harmonics of the others, which leave 0.0 deg (rms) of these: take out"),
        "{doubt}"
    );
    // Scatter of a degree is what measured angles have.
    let noisy = |k: usize| {
        let scatter = 1.4 * (1.0 + 7.1 * k as f64 * k as f64).sin(); // no harmonic of the beat
        format!("[{}, {}]", k as f64 / 200.0, stroke(k) + scatter)
    };
    let rows = (0..200).map(noisy).collect::<Vec<_>>().join(", ");
    let noisy_rows = |more: &str| {
        let law = format!("wing.right.motion.phi={{table={{rows_deg=[{rows}]{more}}}}}");
        LoadedCase::find("fruit-fly-tethered", &[law]).unwrap()
    };
    let noisy = noisy_rows(", harmonics=3");
    assert_eq!(noisy.fitted_tables()[0].doubt(), None);
    // As many harmonics as the samples allow follow that scatter.
    let all = noisy_rows(", harmonics=80");
    let doubt = all.fitted_tables()[0].doubt().expect("a doubt");
    assert!(
        doubt.contains("of 80 harmonics those beyond number 1 are noise"),
        "{doubt}"
    );
    assert!(all.doubtful_measurements().contains(&doubt));
    let flown = LoadedCase::from_text(
        "again.toml",
        &case.resolved(),
        std::path::Path::new(""),
        &[],
    );
    assert_eq!(flown.unwrap().setup.animal, case.setup.animal);
    let said = refusal("fruit-fly-tethered", &[&law(", harmonics=100")]);
    assert!(
        said.contains("give more phases or fewer harmonics"),
        "{said}"
    );
    assert!(said.contains("motion.phi.table.rows_deg"), "{said}");
}

/// Lift of next to nothing is neither too little of it nor a push down.
#[test]
fn behaves_lift_of_nothing_is_named() {
    let case = LoadedCase::find("fruit-fly-blade", &["air.density_kg_m3=1e-12".to_owned()]);
    let doubts = wingbeat_analysis::estimate(&case.unwrap().setup).doubts;
    let said = doubts.join("\n");
    assert!(
        said.contains("it carries nothing: look at stroke"),
        "{said}"
    );
    assert!(!said.contains("it will fall"), "{said}");
}
