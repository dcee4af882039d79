//! The flight page: bounded in size, true to the frames, and at work in a real browser.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

mod support;

use support::{Scratch, flown, required, wingbeat};
use wingbeat::results::frames::{self, Frame};

const CASE: [&str; 13] = [
    "run",
    "fruit-fly-tethered",
    "--quiet",
    "--out",
    "run",
    "--set",
    "time.beats=0.75",
    "--set",
    "wing.right.mesh.spanwise=6",
    "--set",
    "wing.right.mesh.chordwise=3",
    "--set=air.shed=[\"trailing\"]",
    "--set=air.particles={after_rows=8,radius_m=2.5e-4}",
];

/// What the page says of itself in the browser.
struct Shown {
    dom: String,
    console: String,
}

impl Shown {
    fn data(&self, name: &str) -> &str {
        let state = self.dom.split("id=\"state\"").nth(1).unwrap();
        let tag = format!("data-{name}=\"");
        state.split(&tag).nth(1).unwrap().split('"').next().unwrap()
    }

    /// Wing tips in picture axes \[m\].
    fn tips(&self) -> Vec<Vec<f64>> {
        let numbers = |tip: &str| tip.split(' ').map(|x| x.parse().unwrap()).collect();
        self.data("tip").split(" | ").map(numbers).collect()
    }
}

fn browser() -> Option<PathBuf> {
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let path = std::env::var_os("PATH")?;
    let places: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let files = names
        .iter()
        .flat_map(|n| places.iter().map(move |p| p.join(n)));
    files.into_iter().find(|f| f.is_file())
}

/// Opens the page at a frame in a browser without a window.
fn open(browser: &Path, page: &Path, frame: usize, profile: &Path) -> Shown {
    let url = format!("file://{}#frame={frame}", page.display());
    let flags = [
        "--headless",
        "--no-sandbox",
        "--disable-quic",
        "--no-first-run",
        "--disable-sync",
        "--disable-background-networking",
        "--disable-component-update",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--window-size=500,400",
        "--virtual-time-budget=3000",
        "--enable-logging=stderr",
        "--dump-dom",
    ];
    let mut command = Command::new(browser);
    command
        .args(flags)
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(url);
    let out = command.output().unwrap();
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    let console = said
        .lines()
        .filter(|l| l.contains(":CONSOLE"))
        .collect::<Vec<_>>()
        .join("\n");
    Shown {
        dom: String::from_utf8_lossy(&out.stdout).into_owned(),
        console,
    }
}

#[test]
fn exact_the_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        required("no browser (chromium, google-chrome) was found");
        return;
    };
    let scratch = Scratch::new("browser");
    flown(&scratch.0, &CASE);
    let page = scratch.0.join("run/flight.html");
    let steps = frames::steps(&scratch.0.join("run")).unwrap();
    let mut seen: Vec<Vec<Vec<f64>>> = vec![];
    for k in [0, steps.len() - 4] {
        let shown = open(&browser, &page, k, &scratch.0.join("profile"));
        assert_eq!(shown.data("errors"), "0", "{}", shown.dom.len());
        assert!(!shown.console.contains("rror"), "{}", shown.console);
        assert_eq!(shown.data("frame"), k.to_string());
        let triangles: usize = shown.data("triangles").parse().unwrap();
        assert!(triangles > 100, "only {triangles} triangles were drawn");
        // The tip is a node of the wing that stands in the frame.
        let frame = Frame::read(&scratch.0.join("run"), steps[k]).unwrap();
        let particles: usize = shown.data("particles").parse().unwrap();
        assert_eq!(particles, frame.particles.len());
        assert!(k == 0 || particles > 0, "no particle is shown");
        let tips = shown.tips();
        assert_eq!(tips.len(), 2);
        for tip in &tips {
            let miss = |p: &[f64; 3]| (0..3).map(|c| (p[c] - tip[c]).abs()).fold(0.0, f64::max);
            let nearest = frame
                .surfaces
                .points
                .iter()
                .map(miss)
                .fold(f64::INFINITY, f64::min);
            // 16 bits of a box below 1 cm, five digits of a millimetre
            assert!(nearest < 2e-7, "the tip is {nearest} m from every node");
        }
        seen.push(tips);
    }
    let travel = |tips: &Vec<Vec<f64>>| {
        let along = |c: usize| (tips[0][c] - seen[0][0][c]).abs();
        (0..3).map(along).fold(0.0, f64::max)
    };
    let moved = seen.iter().map(travel).fold(0.0, f64::max);
    assert!(moved > 5e-4, "the slider moved the tip by {moved} m only"); // a fifth of its length
}

#[test]
fn exact_the_page_of_an_animal_with_joints_works_in_a_browser() {
    let Some(browser) = browser() else {
        required("no browser (chromium, google-chrome) was found");
        return;
    };
    let scratch = Scratch::new("browser-joints");
    let args = ["run", "fruit-fly-abdomen", "--quiet", "--out", "run"];
    flown(&scratch.0, &[&args[..], &["--set=time.beats=0.1"]].concat());
    let page = scratch.0.join("run/flight.html");
    let shown = open(&browser, &page, 2, &scratch.0.join("profile"));
    assert_eq!(shown.data("errors"), "0", "{}", shown.dom.len());
    assert!(!shown.console.contains("rror"), "{}", shown.console);
    assert_eq!((shown.data("frame"), shown.tips().len()), ("2", 2));
    // Wings, thorax, head and abdomen: two triangles a panel, and a wake.
    let frame = Frame::read(&scratch.0.join("run"), 4).unwrap();
    let triangles: usize = shown.data("triangles").parse().unwrap();
    assert!(triangles > 2 * frame.surfaces.quads.len());
}

#[test]
fn exact_the_page_is_whole_and_stays_within_its_size() {
    let scratch = Scratch::new("page");
    flown(&scratch.0, &CASE);
    let page = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(
        !page.contains("src=\"") && !page.contains("<link"),
        "the page needs other files"
    );
    assert!(page.contains("Shown here: 16 of 16 frames that were written; plots with every step"));
    let bare = wingbeat(&scratch.0, &["view", "run", "--no-open", "--size", "0.625"]);
    assert!(bare.status.success());
    let small = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(
        small.len() < 625_000 && small.len() < page.len(),
        "{} of {}",
        small.len(),
        page.len()
    );
    assert!(small.contains("without their oldest wake rows") || small.contains(" of 16 frames"));
}

#[test]
fn exact_a_flight_without_a_lattice_is_drawn_from_its_history() {
    let scratch = Scratch::new("bare");
    let args = [
        "run",
        "fruit-fly-vacuum",
        "--quiet",
        "--out",
        "run",
        "--set",
        "time.beats=0.1",
    ];
    flown(&scratch.0, &args);
    let page = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(page.contains("steps, drawn from the history (no wakes)"));
}

#[test]
fn refuses_damaged_and_missing_frames() {
    let scratch = Scratch::new("frames-damaged");
    flown(&scratch.0, &CASE);
    let refused = |reason: &str| {
        let out = wingbeat(&scratch.0, &["view", "run", "--no-open"]);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{said}");
        assert!(said.contains(reason), "{said}\ndoes not say: {reason}");
    };
    let path = scratch.0.join("run/frames/wakes_000004.vtp");
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    refused("wakes_000004.vtp`: this frame is cut");
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] = b'!';
    fs::write(&path, &flipped).unwrap();
    refused("wakes_000004.vtp`: this frame is damaged");
    fs::remove_file(&path).unwrap();
    refused("this frame is missing");
    let out = wingbeat(&scratch.0, &["view", "."]);
    assert!(String::from_utf8_lossy(&out.stderr).contains("not a result directory of wingbeat"));
}
