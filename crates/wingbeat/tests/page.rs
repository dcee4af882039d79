//! The flight page: bounded in size, true to the frames, and at work in a real browser.

use std::fs;

#[path = "support/browser.rs"]
mod browser;
mod support;

use browser::Browser;
use serde_json::json;
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

/// Wing tips as the page says, picture axes \[m\].
fn tips(browser: &mut Browser) -> Vec<Vec<f64>> {
    let numbers = |tip: &str| tip.split(' ').map(|x| x.parse().unwrap()).collect();
    browser.state("tip").split(" | ").map(numbers).collect()
}

/// A browser, or a word that there is none.
fn started(scratch: &Scratch, flags: &[&str]) -> Option<Browser> {
    let browser = Browser::start(&scratch.0, flags);
    if browser.is_none() {
        required("no browser (chromium, google-chrome) was found");
    }
    browser
}

fn content(browser: &mut Browser) {
    assert_eq!(browser.state("errors"), "0", "{:?}", browser.complaints);
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
}

#[test]
fn exact_the_page_works_in_a_browser() {
    let scratch = Scratch::new("browser");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    flown(&scratch.0, &CASE);
    let page = scratch.0.join("run/flight.html");
    let steps = frames::steps(&scratch.0.join("run")).unwrap();
    let mut seen: Vec<Vec<Vec<f64>>> = vec![];
    for k in [0, steps.len() - 4] {
        browser.open(&page, &format!("frame={k}"));
        browser.wait(&format!(
            "document.getElementById('state').dataset.frame === '{k}'"
        ));
        content(&mut browser);
        let triangles: usize = browser.state("triangles").parse().unwrap();
        assert!(triangles > 100, "only {triangles} triangles were drawn");
        let frame = Frame::read(&scratch.0.join("run"), steps[k]).unwrap();
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

/// Bodies are posed by matrices, not drawn from the frames: a node of the page is the node of the frame.
#[test]
fn exact_the_page_poses_the_parts_of_an_animal_with_joints() {
    let scratch = Scratch::new("browser-joints");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let args = ["run", "fruit-fly-abdomen", "--quiet", "--out", "run"];
    flown(&scratch.0, &[&args[..], &["--set=time.beats=0.1"]].concat());
    browser.open(&scratch.0.join("run/flight.html"), "frame=2");
    content(&mut browser);
    let frame = Frame::read(&scratch.0.join("run"), 4).unwrap();
    let first = browser.value(
        "flight.solids.map((s) => placed(2, s.body, s.nodes[0]).map((x) => x * flight.length_m))",
    );
    let first = first.as_array().unwrap();
    assert_eq!(first.len(), 3, "thorax, head and abdomen");
    for node in first {
        let node: Vec<f64> = node
            .as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect();
        let miss = |p: &[f64; 3]| (0..3).map(|c| (p[c] - node[c]).abs()).fold(0.0, f64::max);
        let nearest = frame
            .surfaces
            .points
            .iter()
            .map(miss)
            .fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9, "{nearest} m from every node"); // eight digits of millimetres
    }
}

/// The surfaces are where the vorticity of a straight filament of strength g, spread over sigma, has the
/// level: a cylinder of radius sigma sqrt(2 ln(g / (2 pi sigma^2 level))).
#[test]
fn exact_surfaces_of_a_straight_vortex_are_its_cylinder() {
    let scratch = Scratch::new("browser-cylinder");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let args = ["run", "fruit-fly-vacuum", "--quiet", "--out", "run"];
    flown(
        &scratch.0,
        &[&args[..], &["--set=time.beats=0.05"]].concat(),
    );
    browser.open(&scratch.0.join("run/flight.html"), "");
    let radii = browser.value(
        "(() => { const points = [], h = 0.05, sigma = 0.06, g = 3, level = 40, n = 400;
          for (let i = 0; i < n; i++) points.push(-2 + 4 * (i + 0.5) / n, 0.013, -0.007, 4 * g / n, 0, 0, 1, 1);
          const box = { h, sigma, low: [-3, -3, -3], high: [3, 3, 3], most: 160 };
          const [s] = vortices({ points: new Float32Array(points), grid: box, levels: [level], least: [10] }).surfaces;
          const r = []; for (let i = 0; i < s.places.length; i += 3) if (Math.abs(s.places[i]) < 1.5) r.push(Math.hypot(s.places[i + 1] - 0.013, s.places[i + 2] + 0.007));
          return [r.length, Math.min(...r), Math.max(...r), sigma * Math.sqrt(2 * Math.log(g / (2 * Math.PI * sigma * sigma * level)))]; })()",
    );
    let numbers: Vec<f64> = radii
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect();
    let [count, least, most, wanted] = numbers[..] else {
        panic!("{radii}")
    };
    assert!(count > 500.0);
    // Crossings are found by straight lines between nodes h apart, on a Gaussian as wide: a tenth of h.
    assert!(
        (least - wanted).abs() < 5e-3 && (most - wanted).abs() < 5e-3,
        "{least} {most} {wanted}"
    );
}

#[test]
fn behaves_time_can_be_chosen_while_it_plays() {
    let scratch = Scratch::new("browser-seek");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    flown(&scratch.0, &CASE);
    browser.open(&scratch.0.join("run/flight.html"), "wake=");
    let set = "(id, v) => { const e = document.getElementById(id); e.value = v; e.dispatchEvent(new Event('input', { bubbles: true })); }";
    browser.value(&format!("({set})('speed', -6)"));
    browser.value("document.getElementById('play').click()");
    browser.value("new Promise((r) => setTimeout(r, 300))");
    browser.value(&format!("({set})('time', 10)"));
    browser.value("new Promise((r) => setTimeout(r, 800))");
    let frame: usize = browser.state("frame").parse().unwrap();
    assert!((10..=12).contains(&frame), "it jumped to {frame}");
    assert_eq!(
        browser.value("document.getElementById('time').value"),
        json!(frame.to_string())
    );
    content(&mut browser);
}

#[test]
fn behaves_keys_belong_to_the_control_that_has_the_focus() {
    let scratch = Scratch::new("browser-keys");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    flown(&scratch.0, &CASE);
    browser.open(&scratch.0.join("run/flight.html"), "");
    // Closed in a window as narrow as this one.
    browser.value("document.getElementById('display').open = true");
    let playing = "document.getElementById('play').dataset.playing";
    for id in ["on-loop", "on-smoke", "values-box"] {
        browser.value(&format!(
            "(document.querySelector('#{id} > summary') || document.getElementById('{id}')).focus()"
        ));
        browser.press(" ", "Space", 32);
        assert_eq!(
            browser.value(playing),
            json!("false"),
            "Space on {id} plays"
        );
    }
    let pressed = "['on-loop', 'on-smoke'].map((i) => document.getElementById(i).getAttribute('aria-pressed')).join()";
    assert_eq!(browser.value(pressed), json!("false,false"));
    browser.value("document.activeElement.blur()");
    browser.press("ArrowRight", "ArrowRight", 39);
    browser.wait("document.getElementById('state').dataset.frame === '1'");
    browser.press(" ", "Space", 32);
    assert_eq!(browser.value(playing), json!("true"));
    browser.press(" ", "Space", 32);
    // With the focus on the scene, arrows turn it and time stands.
    let frame = browser.state("frame");
    browser.value("document.getElementById('gl').focus()");
    let before = browser.value("camera.position.toArray()");
    browser.press("ArrowRight", "ArrowRight", 39);
    assert_ne!(browser.value("camera.position.toArray()"), before);
    assert_eq!(browser.state("frame"), frame);
    content(&mut browser);
}

#[test]
fn behaves_legends_say_what_is_drawn() {
    let scratch = Scratch::new("browser-legend");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let legend = "document.getElementById('legend').textContent";
    flown(&scratch.0, &CASE);
    browser.open(&scratch.0.join("run/flight.html"), "frame=12");
    let words = browser.value(legend).as_str().unwrap().to_owned();
    assert!(
        words.contains("downstroke") && !words.contains("pressure"),
        "{words}"
    );
    browser.value("document.getElementById('on-pressure').click()");
    let words = browser.value(legend).as_str().unwrap().to_owned();
    assert!(words.contains("pressure jump −"), "{words}");
    // The colours of the wing are those of the legend.
    let colours = "wings[0].mesh.geometry.attributes.color.array.every((c) => c === 1)";
    browser.wait(&format!("!{colours}"));
    browser.value("document.getElementById('on-pressure').click()");
    browser.wait(colours);
    let args = ["run", "fruit-fly-vacuum", "--quiet", "--out", "bare"];
    flown(&scratch.0, &[&args[..], &["--set=time.beats=0.1"]].concat());
    browser.open(&scratch.0.join("bare/flight.html"), "");
    assert_eq!(browser.value(legend), json!(""));
    assert_eq!(browser.value("['wake-controls', 'on-pressure', 'force-box'].every((i) => document.getElementById(i).hidden)"), json!(true));
    content(&mut browser);
}

#[test]
fn behaves_without_webgl_the_flight_is_drawn_flat_and_says_so() {
    let scratch = Scratch::new("browser-flat");
    let Some(mut browser) = started(&scratch, &["--disable-3d-apis"]) else {
        return;
    };
    flown(&scratch.0, &CASE);
    browser.open(&scratch.0.join("run/flight.html"), "frame=3");
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
    assert_eq!(browser.state("errors"), "0");
}

#[test]
fn behaves_a_film_of_the_scene_is_recorded() {
    let scratch = Scratch::new("browser-film");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    flown(&scratch.0, &CASE);
    browser.open(
        &scratch.0.join("run/flight.html"),
        "frame=8&wake=smoke&speed=2",
    );
    browser.value("save = (blob) => { window.saved = [blob.type, blob.size]; }");
    browser.value("document.getElementById('record').click()");
    browser.wait("!!window.saved");
    let saved = browser.value("window.saved");
    assert_eq!(saved[0], "video/webm");
    assert!(saved[1].as_u64().unwrap() > 5_000, "{saved}");
    browser.value("window.saved = null; document.getElementById('picture').click()");
    browser.wait("!!window.saved");
    assert_eq!(browser.value("window.saved[0]"), json!("image/png"));
    content(&mut browser);
}

#[test]
fn behaves_any_description_is_shown() {
    let scratch = Scratch::new("browser-words");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let words = "<!--<script>alert(1)</script> & \"quotes\" -->";
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
    content(&mut browser);
}

/// Four wings in two phases: each sheet is coloured by the half-strokes of the wing that shed it.
#[test]
fn exact_wakes_have_the_half_strokes_of_their_wings() {
    let scratch = Scratch::new("browser-four");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let args = ["run", "dragonfly", "--quiet", "--out", "run"];
    let meshes = ["fore-right", "hind-right"].map(|w| {
        [("spanwise", 4), ("chordwise", 2)]
            .map(|(along, n)| format!("--set=wing.{w}.mesh.{along}={n}"))
    });
    let meshes: Vec<&str> = meshes.iter().flatten().map(String::as_str).collect();
    flown(
        &scratch.0,
        &[&args[..], &meshes, &["--set=time.beats=0.9"]].concat(),
    );
    browser.open(&scratch.0.join("run/flight.html"), "");
    assert_eq!(browser.value("flight.wings.length"), json!(4));
    let shedding = browser.value("flight.shedding.map((w) => flight.wings[w].name).sort()");
    assert_eq!(
        shedding,
        json!(["fore-left", "fore-right", "hind-left", "hind-right"])
    );
    // In every frame the clock says of each pair what its prescribed stroke angle does.
    let differ = browser.value(
        "flight.frames.slice(0, -1).map((f, k) => {
          const down = Object.fromEntries(flight.wings.map((w) => {
            const chart = flight.charts.find((c) => c.name === 'angles'), panel = chart.panels.find((p) => p.label === `wing ${w.name.replace('-', ' ')} [deg]`);
            const phi = panel.series[0].values, sign = w.left ? -1 : 1;
            return [w.name, sign * (phi[f.step + 1] - phi[f.step]) > 0];
          }));
          if (flight.wings.some((w, i) => (downOf(f.step, i) === 1) !== down[w.name])) throw Error(`step ${f.step}`);
          const word = (d) => (d ? 'downstroke' : 'upstroke'), [fore, hind] = [down['fore-right'], down['hind-right']];
          const wanted = fore === hind ? word(fore) : `fore ${word(fore)}, hind ${word(hind)}`;
          if (strokeOf(k) !== wanted && strokeOf(k) !== wanted.split(', ').reverse().join(', ')) throw Error(`${strokeOf(k)}, not ${wanted}`);
          return fore !== hind;
        }).filter((d) => d).length",
    );
    assert!(differ.as_u64().unwrap() > 0, "{differ} frames");
    content(&mut browser);
}

/// Where the sheets of joined wings meet, the page draws their common circulation: none of symmetric wings.
#[test]
fn exact_joined_wings_shed_no_root_vortex() {
    let scratch = Scratch::new("browser-joined");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let args = [
        "run",
        "bird-cruise",
        "--quiet",
        "--out",
        "run",
        "--set=time.beats=0.5",
    ];
    let mesh = [
        "--set=wing.right.mesh.spanwise=5",
        "--set=wing.right.mesh.chordwise=2",
    ];
    flown(&scratch.0, &[&args[..], &mesh].concat());
    browser.open(&scratch.0.join("run/flight.html"), "");
    let most = browser.value(
        "(() => { const frame = unpack(LAST), P = frame.wake; let all = 0, root = 0, count = 0;
          eachFilament(frame, flight.frames[LAST].step, 1e9, (a, b, g) => {
            all = Math.max(all, Math.abs(g));
            if (Math.abs(P[a + 1]) < 1e-4 && Math.abs(P[b + 1]) < 1e-4) { root = Math.max(root, Math.abs(g)); count++; }
          });
          return [all, root, count]; })()",
    );
    let [all, root, count] = [0, 1, 2].map(|k| most[k].as_f64().unwrap());
    let rows = browser
        .value("flight.frames[LAST].rows[0]")
        .as_f64()
        .unwrap();
    assert_eq!(count, rows, "one line, drawn once");
    // 16 bits of each circulation
    assert!(all > 0.01 && root < 1e-4 * all, "{root} of {all} m2/s");
    content(&mut browser);
}

/// A flight without any shape (mass and inertia alone): its ellipsoid is drawn and said to be one.
#[test]
fn behaves_a_body_without_shape_is_drawn_as_its_ellipsoid() {
    let scratch = Scratch::new("browser-ellipsoid");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    let args = [
        "run",
        "table1-sun-2007",
        "--quiet",
        "--out",
        "run",
        "--set=time.beats=0.5",
    ];
    flown(&scratch.0, &args);
    browser.open(&scratch.0.join("run/flight.html"), "");
    let words = browser.value("document.getElementById('legend').textContent");
    assert!(
        words
            .as_str()
            .unwrap()
            .contains("ellipsoid of mass and inertia"),
        "{words}"
    );
    let triangles: usize = browser.state("triangles").parse().unwrap();
    assert!(triangles > 500, "only {triangles} triangles were drawn");
    content(&mut browser);
}

/// Two flights in one page: what one is made to show, the other shows.
#[test]
fn behaves_two_flights_keep_step() {
    let scratch = Scratch::new("browser-pair");
    let Some(mut browser) = started(&scratch, &[]) else {
        return;
    };
    for out in ["a", "b"] {
        let args = [
            "run",
            "fruit-fly-vacuum",
            "--quiet",
            "--out",
            out,
            "--set=time.beats=0.2",
        ];
        flown(&scratch.0, &args);
    }
    let compare = ["compare", "a", "b", "--page", "pair.html"];
    flown(&scratch.0, &compare);
    let again = wingbeat(&scratch.0, &compare);
    assert_eq!(
        again.status.code(),
        Some(2),
        "an existing page was replaced"
    );
    browser.open(&scratch.0.join("pair.html"), "");
    // Frames made from blobs have no origin: what they tell is all that is seen of them.
    browser.value("window.seen = []; window.addEventListener('message', ({ source, data }) => seen.push([frames.findIndex((f) => f.contentWindow === source), data.shown.x]))");
    // What the second is told it shows, and says so when it is drawn anew (here: for another size).
    let kept = browser.value(
        "new Promise((kept) => { const t = setInterval(() => {
          frames[1].contentWindow.postMessage({ shown: { x: 0.15, arm: null } }, '*');
          frames[1].style.height = 80 + 10 * Math.random() + '%';
          if (seen.some(([k, x]) => k === 1 && Math.abs(x - 0.15) < 0.02)) { clearInterval(t); kept(true); }
        }, 300); })",
    );
    assert_eq!(kept, json!(true));
    // And the page around has told the first.
    browser.wait("seen.length = 0, frames[0].style.height = 80 + 10 * Math.random() + '%', new Promise((r) => setTimeout(() => r(seen.some(([k, x]) => k === 0 && Math.abs(x - 0.15) < 0.02)), 400))");
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
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
    let viewed = |size: &str| {
        let out = wingbeat(&scratch.0, &["view", "run", "--no-open", "--size", size]);
        assert!(out.status.success());
        let small = fs::read_to_string(scratch.0.join("run/flight.html")).unwrap();
        (small, String::from_utf8(out.stdout).unwrap())
    };
    let (small, said) = viewed("0.7");
    assert!(
        small.len() < 700_000 && small.len() < page.len(),
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
