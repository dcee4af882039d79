//! The page of a campaign, in a browser.

use serde_json::json;

use crate::browser::Browser;
use crate::support::{Scratch, flown, required};
use crate::write;

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
    let Some(mut browser) = Browser::start(dir, &[]) else {
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
