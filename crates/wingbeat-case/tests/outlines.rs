//! Outlines that were digitised from pictures.

use std::path::{Path, PathBuf};

use wingbeat_case::LoadedCase;
use wingbeat_model::WingReport;

/// A fruit fly whose wing is this outline, read from the folder `at`.
fn fly(at: &Path, outline: &str) -> Result<LoadedCase, String> {
    let set = [
        format!("wing.right.planform={{ outline = {{ {outline} }} }}"),
        "wing.right.mesh.spanwise=24".to_owned(),
    ];
    let preset = wingbeat_case::presets::find("fruit-fly-blade")
        .unwrap()
        .text;
    LoadedCase::from_text("fly", preset, at, &set).map_err(|e| e.to_string())
}

/// A folder of these files.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let at = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("outlines-{name}"));
    std::fs::create_dir_all(&at).unwrap();
    for (name, text) in files {
        std::fs::write(at.join(name), text).unwrap();
    }
    at
}

fn report(case: &LoadedCase) -> WingReport {
    case.setup.animal.wings[0].report()
}

/// The wing by its edges \[m\].
const EDGES: &str = "leading_m=[[0, 0.1e-3], [1e-3, 0.3e-3], [2.5e-3, 0]], trailing_m=[[0, -0.1e-3], [1.5e-3, -0.6e-3], [2.5e-3, 0]], least_chord=0.02";

/// The same digitised in millimetres.
const IN_MM: &str =
    "# from a picture\n,x_mm,y_mm\n1,0,0.1\n2,1,0.3\n3,2.5,0\n4,1.5,-0.6\n5,0,-0.1\n";

/// The same in pixels of 5 um that are counted downwards, the hinge at (100, 200), the span along the columns;
/// around the other way.
const IN_PIXELS: &str = "X;Y\n120;200\n220;500\n100;700\n40;400\n80;200\n";

#[test]
fn agrees_outlines_from_files_with_the_same_edges() {
    let at = &folder("same", &[("mm.csv", IN_MM), ("pixels.csv", IN_PIXELS)]);
    let pixels = "file='pixels.csv', file_hinge=[100, 200], file_tip=[100, 700], least_chord=0.02";
    let left = "file_leading_edge=[0, 300]";
    let right = "file_leading_edge=[900, 300]";
    let by_edges = report(&fly(at, EDGES).unwrap());
    let same = [
        "file='mm.csv', least_chord=0.02".to_owned(),
        format!("{pixels}, file_unit_m=5e-6"),
        format!("{pixels}, file_length_m=2.5e-3"),
        format!("{pixels}, file_unit_m=5e-6, x_column='X', {left}"),
    ];
    for outline in same {
        let case = fly(at, &outline).unwrap();
        let r = report(&case);
        let apart = [
            r.area / by_edges.area,
            r.r2_hat / by_edges.r2_hat,
            r.length / by_edges.length,
            r.max_chord / by_edges.max_chord,
        ];
        println!("{outline}: {apart:?}");
        assert!(
            apart.iter().all(|x| (x - 1.0).abs() < 1e-12),
            "{outline}: {apart:?}"
        );
        let centre = |case: &LoadedCase| case.setup.animal.wings[0].mass.centre();
        let gap = (centre(&case) - centre(&fly(at, EDGES).unwrap())).length();
        assert!(gap < 1e-15, "{outline}: {gap}");
        // It stands alone: no file is needed to read it again.
        let text = case.resolved();
        let again = LoadedCase::from_text("again", &text, Path::new("/"), &[]).unwrap();
        assert!(
            again.setup.animal == case.setup.animal && !text.contains("csv"),
            "{text}"
        );
    }
    let turned = fly(at, &format!("{pixels}, file_unit_m=5e-6, {right}")).unwrap();
    let side = |case: &LoadedCase, row| {
        let mesh = &case.setup.animal.wings[0].mesh;
        mesh.nodes[mesh.node(row * mesh.rows, 9)].x
    };
    let [leading, trailing] = [side(&turned, 0), side(&fly(at, EDGES).unwrap(), 1)];
    assert!((leading + trailing).abs() < 1e-15, "{leading} {trailing}");
}

/// (outline, what the error says)
const WRONG: &[(&str, &[&str])] = &[
    ("file='none.csv'", &["outline.file", "cannot read"]),
    (
        "file='pixels.csv'",
        &[
            "outline.file",
            "unit of its numbers is not known",
            "file_length_m",
        ],
    ),
    (
        "file='mm.csv', file_unit_m=1e-3",
        &["outline.file_unit_m", "given twice"],
    ),
    (
        "file='mm.csv', file_length_m=1e-3",
        &["file_length_m", "no effect without file_tip"],
    ),
    (
        "file='mm.csv', file_length_m=1e-3, file_tip=[1, 1]",
        &["outline.file_length_m", "given twice"],
    ),
    (
        "file='pixels.csv', file_unit_m=1e-6, file_length_m=1e-3, file_tip=[1, 1]",
        &["file_length_m", "file_unit_m"],
    ),
    ("file='mm.csv', file_tip=[0, 0]", &["outline", "same point"]),
    (
        "file='mm.csv', file_leading_edge=[1, 0]",
        &["outline", "on the line"],
    ),
    (
        "file='mm.csv', file_hinge=[1, 0]",
        &["outline.file", "behind the hinge"],
    ),
    (
        "file='mm.csv', x_column='z'",
        &["outline.x_column", "no column `z`", "x_mm"],
    ),
    ("file='mixed.csv'", &["outline.file", "not in one unit"]),
    (
        "file='letters.csv'",
        &["outline.file", "line 3", "not a finite number"],
    ),
    (
        "file='mm.csv', leading_m=[[0, 0], [1, 0]]",
        &["outline", "file"],
    ),
    (
        "leading_m=[[0, 0], [1, 0]]",
        &["outline", "an edge is missing"],
    ),
    (
        "file_hinge=[0, 0]",
        &["file_hinge", "no effect without file"],
    ),
];

#[test]
fn behaves_wrong_outlines_are_refused_by_key() {
    let files = [
        ("mm.csv", IN_MM),
        ("pixels.csv", IN_PIXELS),
        ("mixed.csv", "x_mm,y_m\n0,0\n1,1\n2,0\n"),
        ("letters.csv", "x_mm,y_mm\n0,0\n1,one\n2,0\n"),
    ];
    let at = folder("wrong", &files);
    for (outline, wanted) in WRONG {
        let said = fly(&at, outline).map(|_| ()).unwrap_err();
        assert!(wanted.iter().all(|w| said.contains(w)), "{outline}: {said}");
    }
}

#[test]
fn behaves_outlines_that_are_flown_wider_than_they_are_drawn_are_named() {
    let here = Path::new("");
    let pointed = "leading_m=[[0, 0.2e-3], [2.5e-3, 0]], trailing_m=[[0, -0.6e-3], [2.5e-3, 0]]";
    let [said] = &fly(here, pointed).unwrap().doubtful_measurements()[..] else {
        panic!("a triangle")
    };
    assert!(
        said.contains("4.0 % more area and 21.0 % more second moment"),
        "{said}"
    );
    let kept = format!("{pointed}, least_chord=0.02");
    assert_eq!(fly(here, &kept).unwrap().doubtful_measurements(), [""; 0]);
}

/// Ends of two edges that differ in the last digit of a number.
#[test]
fn agrees_outlines_whose_ends_differ_by_rounding() {
    let edges = |end: &str| {
        format!(
            "leading_m=[[1e-4, 2e-4], [{end}, 2e-4]], trailing_m=[[1e-4, -5e-4], [2.5e-3, -5e-4]]"
        )
    };
    let at = Path::new("");
    let [exact, rounded] =
        ["2.5e-3", "2.4999999999999996e-3"].map(|end| report(&fly(at, &edges(end)).unwrap()));
    assert!((rounded.area / exact.area - 1.0).abs() < 1e-14);
    assert!(
        fly(at, &edges("2.4999e-3"))
            .expect_err("shorter")
            .contains("same part of the span")
    );
}
