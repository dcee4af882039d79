//! What the page draws: bodies, wakes, vortices, and the legends that say so.

use serde_json::json;
use wingbeat::results::frames::Frame;

use crate::support::{Scratch, flown};
use crate::{Use, content, lent, lent_run};

/// Bodies are posed by matrices, not drawn from the frames: a node of the page is the node of the frame.
#[test]
fn exact_the_page_poses_the_parts_of_an_animal_with_joints() {
    let scratch = Scratch::new("browser-joints");
    let Some(mut browser) = lent(Use::Flat) else {
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
    let Some(mut browser) = lent(Use::Flat) else {
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

/// Four wings in two phases: each sheet is coloured by the half-strokes of the wing that shed it.
#[test]
fn exact_wakes_have_the_half_strokes_of_their_wings() {
    let scratch = Scratch::new("browser-four");
    let Some(mut browser) = lent(Use::Flat) else {
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
    // The clock says so in short, and beside or above the buttons of the views.
    let short = browser.value(
        "(() => { const k = flight.frames.findIndex((f, k) => strokesOf(k).length > 1);
          seek(k); drawAll();
          const clock = byId('clock').getBoundingClientRect(), buttons = [...document.querySelectorAll('#views > :not([hidden])')].map((b) => b.getBoundingClientRect());
          if (!buttons.every((b) => b.left >= clock.right || b.top >= clock.bottom)) throw Error('under the buttons');
          return shortStrokes(k).map((w) => w[0]).sort(); })()",
    );
    assert!(
        [
            json!(["fore down", "hind up"]),
            json!(["fore up", "hind down"])
        ]
        .contains(&short),
        "{short}"
    );
    content(&mut browser);
}

/// Where the sheets of joined wings meet, the page draws their common circulation: none of symmetric wings.
#[test]
fn exact_joined_wings_shed_no_root_vortex() {
    let scratch = Scratch::new("browser-joined");
    let Some(mut browser) = lent(Use::Flat) else {
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

/// A flight without any shape (mass and inertia alone): its ellipsoid is drawn and said to be one. Without air there is
/// nothing else to choose.
#[test]
fn behaves_a_body_without_shape_is_drawn_as_its_ellipsoid() {
    let scratch = Scratch::new("browser-ellipsoid");
    let Some(mut browser) = lent(Use::Scene) else {
        return;
    };
    let args = [
        "run",
        "table1-sun-2007",
        "--quiet",
        "--out",
        "run",
        "--set=time.beats=0.1",
        "--set=air.model=none",
    ];
    flown(&scratch.0, &args);
    browser.open(&scratch.0.join("run/flight.html"), "");
    let words = browser.value("document.getElementById('legend').textContent");
    assert_eq!(
        words,
        json!("no shape given: ellipsoid of mass and inertia")
    );
    let triangles: usize = browser.state("triangles").parse().unwrap();
    assert!(triangles > 500, "only {triangles} triangles were drawn");
    assert_eq!(browser.value(NOTHING_TO_CHOOSE), json!(true));
    content(&mut browser);
}

/// Controls of wakes, pressures and forces are not on offer.
const NOTHING_TO_CHOOSE: &str =
    "['wake-controls', 'on-pressure', 'force-box'].every((i) => document.getElementById(i).hidden)";

#[test]
fn behaves_legends_say_what_is_drawn() {
    let scratch = Scratch::new("browser-legend");
    let Some(mut browser) = lent_run("frame=12") else {
        return;
    };
    let legend = "document.getElementById('legend').textContent";
    assert_ne!(browser.value(NOTHING_TO_CHOOSE), json!(true));
    let words = browser.value(legend).as_str().unwrap().to_owned();
    assert!(
        words.contains("downstroke") && !words.contains("pressure"),
        "{words}"
    );
    browser.value("document.getElementById('on-pressure').click()");
    let words = browser.value(legend).as_str().unwrap().to_owned();
    assert!(words.contains("pressure jump −"), "{words}");
    // The ramp ends at what nineteen in twenty frames do not exceed, and says so where some do.
    let beyond =
        browser.value("Math.max(...flight.frames.map((f) => f.pressure)) > flight.most.pressure");
    assert_eq!(
        json!(words.contains("Pa, full colour beyond")),
        beyond,
        "{words}"
    );
    let inside = "flight.frames.forEach((f) => { f.pressure = Math.min(f.pressure, flight.most.pressure); }), drawLegend()";
    browser.value(inside);
    let words = browser.value(legend).as_str().unwrap().to_owned();
    assert!(!words.contains("beyond"), "{words}");
    // The colours of the wing are those of the legend.
    let colours = "wings[0].mesh.geometry.attributes.color.array.every((c) => c === 1)";
    browser.wait(&format!("!{colours}"));
    browser.value("document.getElementById('on-pressure').click()");
    browser.wait(colours);
    content(&mut browser);
    drop(browser);
    // The legend of a flight without air is empty, however it is drawn.
    let Some(mut browser) = lent(Use::Flat) else {
        return;
    };
    let args = ["run", "fruit-fly-vacuum", "--quiet", "--out", "bare"];
    flown(&scratch.0, &[&args[..], &["--set=time.beats=0.1"]].concat());
    browser.open(&scratch.0.join("bare/flight.html"), "");
    assert_eq!(browser.value(legend), json!(""));
    assert_eq!(browser.value(NOTHING_TO_CHOOSE), json!(true));
    content(&mut browser);
}
