//! The flight page: bounded in size, true to the frames, and at work in a real browser.

use std::fs;
use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

#[path = "../support/browser.rs"]
mod browser;
mod controls;
mod drawn;
#[path = "../support/mod.rs"]
mod support;

use browser::Browser;
use serde_json::json;
use support::{Scratch, contents, flown, required, wingbeat};
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

/// Where [`CASE`] was flown, once; what a test changes is its own copy.
static RUN: LazyLock<PathBuf> = LazyLock::new(|| {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join("page");
    let _ = fs::remove_dir_all(&dir);
    fs::create_dir_all(&dir).unwrap();
    flown(&dir, &CASE);
    dir.join("run")
});

/// A copy of [`RUN`], as `run`.
fn copied(dir: &Path) {
    for (path, bytes) in contents(&RUN) {
        let copy = dir.join("run").join(path.strip_prefix(&*RUN).unwrap());
        fs::create_dir_all(copy.parent().unwrap()).unwrap();
        fs::write(copy, bytes).unwrap();
    }
}

/// Wing tips as the page says, picture axes \[m\].
fn tips(browser: &mut Browser) -> Vec<Vec<f64>> {
    let numbers = |tip: &str| tip.split(' ').map(|x| x.parse().unwrap()).collect();
    browser.state("tip").split(" | ").map(numbers).collect()
}

/// A browser, or a word that there is none.
fn started(folder: &Path, flags: &[&str]) -> Option<Browser> {
    let browser = Browser::start(folder, flags);
    if browser.is_none() {
        required("no browser (chromium, google-chrome) was found");
    }
    browser
}

/// What a browser is for.
#[derive(Clone, Copy)]
enum Use {
    /// The page of [`RUN`], drawn as users see it. It stays open from test to test, each in its turn: where no graphics
    /// card compiles and runs them, the programs of the scene take longer than all the rest.
    Run,
    /// Other pages, drawn as users see them.
    Scene,
    /// What does not depend on how the scene is drawn, without WebGL.
    Flat,
}

/// Browsers that wait for a next test, for each use: to start one takes longer than most tests do.
static IDLE: Mutex<[Vec<Browser>; 3]> = Mutex::new([vec![], vec![], vec![]]);

/// A browser for one test; after a test that fails there is no next.
struct Lent {
    browser: Option<Browser>,
    of: Use,
    _turn: Option<MutexGuard<'static, ()>>,
}

fn lent(of: Use) -> Option<Lent> {
    static STARTED: AtomicUsize = AtomicUsize::new(0);
    static TURN: Mutex<()> = Mutex::new(());
    let has_turns = matches!(of, Use::Run);
    let turn = has_turns.then(|| TURN.lock().unwrap_or_else(PoisonError::into_inner));
    let idle = IDLE.lock().unwrap()[of as usize].pop();
    idle.or_else(|| {
        let number = STARTED.fetch_add(1, Ordering::Relaxed);
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("browser-{number}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let flags: &[&str] = match of {
            Use::Flat => &["--disable-3d-apis", "--disable-gpu"],
            Use::Run | Use::Scene => &["--disable-gpu-compositing"],
        };
        started(&folder, flags)
    })
    .map(|browser| Lent {
        browser: Some(browser),
        of,
        _turn: turn,
    })
}

/// All that a link may choose; it stands after what a test chooses itself, which goes before it.
const USUAL: &str = "frame=0&theme=dark&view=quarter&wake=vortices,smoke&colour=stroke&force=total&speed=0.5&age=1.1&level=1&pressure=0";

/// A browser in which the page of [`RUN`] stands still, as this link says; the rest is as usual, whatever the test
/// before has chosen.
fn lent_run(link: &str) -> Option<Lent> {
    let mut browser = lent(Use::Run)?;
    let link = format!("{link}&{USUAL}");
    let page = RUN.join("flight.html");
    if browser.value("location.pathname") == json!(page) {
        // What no link chooses. A link that is the same is none that changes: each has a number of its own.
        browser.value("setPlaying(false), state.loop || byId('on-loop').click(), byId('values-box').open = false, document.activeElement.blur()");
        browser.value(&format!(
            "new Promise((done) => {{ addEventListener('hashchange', () => setTimeout(done), {{ once: true }}); location.hash = '{link}&test=' + performance.now(); }})"
        ));
    } else {
        browser.open(&page, &link);
    }
    browser.wait("drawn === frameNow() && !wanted && pixelRatio === Math.min(devicePixelRatio, 2)");
    Some(browser)
}

impl Deref for Lent {
    type Target = Browser;

    fn deref(&self) -> &Browser {
        self.browser.as_ref().unwrap()
    }
}

impl DerefMut for Lent {
    fn deref_mut(&mut self) -> &mut Browser {
        self.browser.as_mut().unwrap()
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            IDLE.lock().unwrap()[self.of as usize].extend(self.browser.take());
        }
    }
}

fn content(browser: &mut Browser) {
    assert_eq!(browser.state("errors"), "0", "{:?}", browser.complaints);
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
}

#[test]
fn exact_the_page_works_in_a_browser() {
    let Some(mut browser) = lent_run("") else {
        return;
    };
    let steps = frames::steps(&RUN).unwrap();
    let mut seen: Vec<Vec<Vec<f64>>> = vec![];
    for k in [0, steps.len() - 4] {
        browser.value(&format!("location.hash = 'frame={k}'"));
        browser.wait(&format!(
            "document.getElementById('state').dataset.frame === '{k}'"
        ));
        content(&mut browser);
        let triangles: usize = browser.state("triangles").parse().unwrap();
        assert!(triangles > 100, "only {triangles} triangles were drawn");
        let frame = Frame::read(&RUN, steps[k]).unwrap();
        let particles: usize = browser.state("particles").parse().unwrap();
        assert_eq!(particles, frame.particles.len());
        assert!(k == 0 || particles > 0, "no particle is shown");
        if k > 0 {
            browser.wait("+document.getElementById('state').dataset.surface > 100");
        }
        // The tip is a node of the wing that stands in the frame.
        let tips = tips(&mut browser);
        assert_eq!(tips.len(), 2);
        for tip in &tips {
            let miss = |p: &[f64; 3]| (0..3).map(|c| (p[c] - tip[c]).abs()).fold(0.0, f64::max);
            let nearest = frame
                .surfaces
                .points
                .iter()
                .map(miss)
                .fold(f64::INFINITY, f64::min);
            // 16 bits of a box below 1 cm
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
fn behaves_without_webgl_the_flight_is_drawn_flat_and_says_so() {
    let Some(mut browser) = lent(Use::Flat) else {
        return;
    };
    browser.open(&RUN.join("flight.html"), "frame=3");
    let note = "document.getElementById('note').textContent";
    for k in [3, 9] {
        browser.value(&format!("seek({k})"));
        browser.wait(&format!(
            "document.getElementById('state').dataset.frame === '{k}'"
        ));
        let said = browser.value(note);
        assert!(said.as_str().unwrap().contains("no WebGL"), "{said}");
    }
    // There is a picture: colours that the ramp of the sky has not, and it moves.
    let pixels = "new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)";
    let drawn = browser.value(&format!(
        "(() => {{ const now = {pixels}, sky = new Set(now.filter((_, i) => i % canvas.width === 0));
          const own = new Set(now.filter((c) => !sky.has(c))).size;
          seek(3); drawAll(); const before = {pixels};
          return [sky.size, own, now.filter((c, i) => c !== before[i]).length / now.length]; }})()"
    ));
    println!("{drawn}");
    let [own, moved] = [1, 2].map(|k| drawn[k].as_f64().unwrap());
    assert!(own > 500.0, "{own} colours beside the sky's");
    assert!(moved > 0.01, "{moved} of the picture moved");
    // Controls of what is not drawn so are not on offer, and the force of each wing has its arrow.
    let offered = browser.value("['filaments', 'vortices', 'smoke', 'pressure', 'trail', 'follow'].filter((n) => !byId('on-' + n).hidden).join() + byId('level-box').hidden");
    assert_eq!(offered, json!("filamentstrue"));
    let arrows = browser.value("['none', 'total', 'each'].map((f) => { state.force = f; return Math.max(...flight.frames.map((_, k) => forceArrows(k).length)); }).join()");
    assert_eq!(arrows, json!("0,1,2"));
    assert_eq!(browser.state("errors"), "0");
}

#[test]
fn behaves_any_description_is_shown() {
    let scratch = Scratch::new("browser-words");
    let Some(mut browser) = lent(Use::Flat) else {
        return;
    };
    let words = &format!(
        "<!--<script>alert(1)</script> & \"quotes\" -->{}",
        " and so on".repeat(40)
    );
    let args = [
        "run",
        "fruit-fly-vacuum",
        "--quiet",
        "--out",
        "run",
        "--set=time.beats=0.05",
    ];
    flown(
        &scratch.0,
        &[&args[..], &["--set", &format!("description='{words}'")]].concat(),
    );
    browser.open(&scratch.0.join("run/flight.html"), "");
    let about = browser.value("document.getElementById('about').textContent");
    assert!(about.as_str().unwrap().starts_with(words), "{about}");
    // However long it is, the verdict and how the flight ended stand before it, whole.
    let seen = browser.value("['verdict', 'outcome'].map((id) => { const e = document.getElementById(id), box = e.getBoundingClientRect(); return box.left >= 0 && box.right <= innerWidth && e.scrollWidth <= e.clientWidth + 1 ? e.textContent : ''; })");
    let level = browser.value("flight.summary.split(':')[0]");
    assert_eq!(seen, json!([level, "flown to its end"]));
    // On a narrow screen the title is broken after hyphens, and within words only where one is wider than the screen.
    let lines = browser.value(
        "['fruit-fly-hover', 'robofly-table-symmetrical', 'w'.repeat(60)].map((name) => {
      const title = document.getElementById('name'), range = document.createRange();
      document.body.style.width = '320px';
      title.textContent = name;
      const lines = name.split(/(?<=-)/).map((word, k, all) => {
        const from = all.slice(0, k).join('').length;
        range.setStart(title.firstChild, from); range.setEnd(title.firstChild, from + word.length);
        return new Set([...range.getClientRects()].map((r) => r.top)).size;
      });
      return [Math.max(...lines), title.getBoundingClientRect().right <= 320];
    })",
    );
    assert_eq!(lines, json!([[1, true], [1, true], [3, true]]));
    content(&mut browser);
}

#[test]
fn exact_the_page_is_whole_and_stays_within_its_size() {
    let scratch = Scratch::new("page");
    copied(&scratch.0);
    let page = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(
        !page.contains("src=\"") && !page.contains("<link"),
        "the page needs other files"
    );
    assert!(page.contains("Shown here: 16 of 16 frames that were written; plots with every step"));
    assert!(page.contains("of the frame. history.csv and frames/ hold everything\""));
    let viewed = |size: &str| {
        let out = wingbeat(&scratch.0, &["view", "run", "--no-open", "--size", size]);
        assert!(out.status.success());
        let small = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
        (small, String::from_utf8(out.stdout).unwrap())
    };
    let (small, said) = viewed("0.75");
    assert!(
        small.len() < 750_000 && small.len() < page.len(),
        "{} of {}",
        small.len(),
        page.len()
    );
    assert!(!said.contains("larger than"), "{said}");
    // Program and plots are not left out, but that the page is larger for them is said.
    let (bare, said) = viewed("0.1");
    assert!(bare.len() < small.len());
    let size = format!(
        "{:.3} MB, larger than the 0.1 MB asked for",
        bare.len() as f64 / 1e6
    );
    assert!(said.contains(&size), "{said}");
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
    assert!(page.contains("of the frame. history.csv holds everything\""));
}

/// Flights of one step have a page and figures, too.
#[test]
fn exact_a_flight_of_one_step_is_drawn() {
    let scratch = Scratch::new("one-step");
    let args = ["run", "fruit-fly-blade", "--quiet", "--out", "run"];
    let step = ["--set", "time.beats=", "--set", "time.steps=1"];
    flown(&scratch.0, &[&args[..], &step].concat());
    let page = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
    assert!(page.contains("Shown here: 2 of 2 steps"));
    for figure in ["angles", "forces", "trajectory", "balances"] {
        let path = scratch.0.join(format!("run/figures/{figure}.svg"));
        let drawing = fs::read_to_string(path).unwrap();
        assert!(drawing.contains("<path") && !drawing.contains("NaN"));
    }
}

#[test]
fn refuses_damaged_and_missing_frames() {
    let scratch = Scratch::new("frames-damaged");
    copied(&scratch.0);
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
