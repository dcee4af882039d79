//! The page of a campaign, in a browser.

use serde_json::json;

use crate::browser::Browser;
use crate::support::{Scratch, flown, required};
use crate::write;

/// The page draws in two dimensions only: the browser need not do in software what it would leave to a graphics card.
const WITHOUT_GPU: &[&str] = &["--disable-gpu"];

const TEXT: &str = r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "power_watt"]
files = ["page"]
[set]
"time.steps_per_beat" = 40
[retention]
every = 3
[parameter."time.beats"]
list = [0.5, 1, 1.5]
[parameter."motion.frequency_hz"]
list = [190, 200, 210]
"#;

#[test]
fn exact_the_page_shows_all_points_in_a_browser() {
    let scratch = Scratch::new("campaign-page");
    let dir = &scratch.0;
    let Some(mut browser) = Browser::start(dir, WITHOUT_GPU) else {
        required("no browser (chromium, google-chrome) was found");
        return;
    };
    write(dir, TEXT);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    flown(
        dir,
        &["campaign", "view", "c.toml", "--out", "r", "--no-open"],
    );
    browser.open(&dir.join("r/campaign.html"), "");
    browser.wait("document.getElementById('state').dataset.ready === 'yes'");
    assert_eq!(
        (browser.state("spots"), browser.state("rows")),
        ("9".into(), "9".into())
    );
    assert!(
        browser
            .value("document.getElementById('count').textContent")
            .as_str()
            .unwrap()
            .contains("3 failed")
    );
    // Each flown point has its verdict, in the order of trust and beside the count.
    let judged = browser.value("(() => { const c = columns.find((c) => c.kind === 'verdict'); return [c.names, rows.map((r) => r.cells[c.k])]; })()");
    let of = |word: &str| {
        let all = judged[1].as_array().unwrap();
        all.iter().filter(|v| **v == json!(word)).count()
    };
    let [red, amber, green] = ["red", "amber", "green"].map(of);
    assert_eq!(red + amber + green, 6, "three failed: {judged}");
    let counted = browser.value("document.getElementById('count').textContent");
    let says = |n: usize, word: &str| counted.as_str().unwrap().contains(&format!(", {n} {word}"));
    assert!(
        says(red, "red") == (red > 0) && says(amber, "amber") == (amber > 0),
        "{counted} {judged}"
    );
    // A click on a spot chooses its point; one whose page is kept opens it.
    browser.value("window.open = (page) => { window.opened = page; }");
    let click = |k: usize| {
        format!(
            "(() => {{ const box = document.getElementById('map').getBoundingClientRect(), s = spots.find((s) => s[2].point === {k}); document.getElementById('map').dispatchEvent(new MouseEvent('click', {{ clientX: box.left + s[0], clientY: box.top + s[1] }})); }})()"
        )
    };
    browser.value(&click(4));
    assert_eq!(
        (browser.state("point"), browser.state("opened")),
        ("4".into(), String::new())
    );
    let command = browser.value("document.getElementById('command').textContent");
    let wanted = "wingbeat run fruit-fly-blade --set time.steps_per_beat=40 --set time.beats=1 --set motion.frequency_hz=200";
    assert_eq!(command, json!(wanted));
    browser.value(&click(6));
    let page = browser.value("window.opened");
    assert!(
        dir.join("r").join(page.as_str().unwrap()).is_file(),
        "{page}"
    );
    assert_table_sorts(&mut browser);
    // Other axes and the light theme draw without complaint.
    browser.value("(() => { const s = document.getElementById('across'); s.value = 3; s.onchange(); document.getElementById('theme').click(); })()");
    assert_eq!(
        browser.state("spots"),
        "6",
        "three have no power to stand at"
    );
    assert_eq!(browser.state("errors"), "0");
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
}

/// Long names and long numbers, in a window as narrow as a phone too: what is written stands within its canvas
/// and apart from the rest, and names that differ are written differently.
#[test]
fn exact_names_and_numbers_are_readable_on_the_page() {
    let scratch = Scratch::new("campaign-names");
    let dir = &scratch.0;
    let Some(mut browser) = Browser::start(dir, WITHOUT_GPU) else {
        required("no browser (chromium, google-chrome) was found");
        return;
    };
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "thrust_newton", "power_watt"]
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[parameter."motion.frequency_hz"]
list = [190, 200]
[parameter."motion.data"]
list = ["robofly-table-symmetrical", "robofly-table-advanced", "robofly-sane-symmetrical"]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    let view = ["campaign", "view", "c.toml", "--out", "r", "--no-open"];
    flown(dir, &view);
    browser.open(&dir.join("r/campaign.html"), "");
    browser.wait("document.getElementById('state').dataset.ready === 'yes'");
    let long = "columns[2].range = [-0.0010607, 0.0012345]";
    browser.value(long);
    // Boxes of all words on a canvas, in its own pixels, as [words, left, top, right, bottom].
    let boxes = "(id, draw) => {
      const list = [], write = CanvasRenderingContext2D.prototype.fillText, box = document.getElementById(id), ratio = devicePixelRatio || 1;
      CanvasRenderingContext2D.prototype.fillText = function (words, x, y) {
        const wide = this.measureText(words).width, from = { left: 0, center: 0.5, right: 1, start: 0 }[this.textAlign] * wide, m = this.getTransform();
        const at = (u, v) => [(m.a * u + m.c * v + m.e) / ratio, (m.b * u + m.d * v + m.f) / ratio];
        const [a, b] = [at(x - from, y - 8), at(x - from + wide, y + 1)];
        list.push([words, Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[0], b[0]), Math.max(a[1], b[1])]);
      };
      draw();
      CanvasRenderingContext2D.prototype.fillText = write;
      const faults = list.filter(([, l, t, r, b]) => l < 0 || t < 0 || r > box.clientWidth || b > box.clientHeight).map(([w]) => 'cut: ' + w);
      list.forEach((p, i) => list.slice(i + 1).forEach((q) => { if (p[1] < q[3] && q[1] < p[3] && p[2] < q[4] && q[2] < p[4]) faults.push(`${p[0]} on ${q[0]}`); }));
      return [list.map(([w]) => w), faults];
    }";
    for width in [320, 380, 700, 1200] {
        browser.value(&format!(
            "(() => {{ for (const card of document.querySelectorAll('.card')) card.style.width = '{width}px'; }})()"
        ));
        for [across, up] in [[0, 1], [1, 0], [2, 1]] {
            let set = format!("shown.across = {across}, shown.up = {up}");
            browser.value(&set);
            let drawn = [("map", "drawMap"), ("lines", "drawLines")]
                .map(|(id, draw)| browser.value(&format!("({boxes})('{id}', {draw})")));
            for on in &drawn {
                assert_eq!(on[1], json!([]), "{width} {across} {up}: {on}");
            }
            let all = drawn[0][0].as_array().unwrap();
            let names = all.iter().filter_map(serde_json::Value::as_str);
            let mut names: Vec<&str> = names.filter(|w| w.starts_with("rob")).collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), 3, "{width}: {names:?}");
            let ends = drawn[1][0].as_array().unwrap();
            assert!(ends.contains(&json!("-0.0010607")), "{width}: {ends:?}");
        }
    }
    // Names that nothing tells apart when they are cut are counted.
    let room = "(() => { const pen = document.getElementById('map').getContext('2d'), same = 'm'.repeat(40); return shortened(pen, [`${same}a${same}`, `${same}b${same}`], 60); })()";
    let cut = browser.value(room);
    assert!(
        cut[0].as_str().unwrap().starts_with("1: ") && cut[0] != cut[1],
        "{cut}"
    );
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
}

/// The table: sorted by power, falling with a second click.
fn assert_table_sorts(browser: &mut Browser) {
    let sort = "document.querySelectorAll('#table th button')[4].click()";
    let order = |browser: &mut Browser| {
        browser.value("[...document.querySelectorAll('#table tbody tr')].map((r) => r.cells[4].textContent === '–' ? null : +r.cells[4].textContent)")
    };
    browser.value(sort);
    let rising = order(browser);
    browser.value(sort);
    let falling = order(browser);
    let list = |v: &serde_json::Value| {
        v.as_array()
            .unwrap()
            .iter()
            .filter_map(serde_json::Value::as_f64)
            .collect::<Vec<_>>()
    };
    let [up, mut down] = [list(&rising), list(&falling)];
    assert_eq!(up.len(), 6, "three points failed and have no number");
    assert!(up.windows(2).all(|w| w[0] <= w[1]), "{up:?}");
    down.reverse();
    assert_eq!(up, down);
}
