//! What a user does with the page: time, keys, films, two flights beside each other.

use serde_json::json;

use crate::browser::Browser;
use crate::support::{Scratch, flown, wingbeat};
use crate::{CASE, content, started};

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
    // Slow machines draw late.
    let mut frame = 0;
    for _ in 0..50 {
        browser.value("new Promise((r) => setTimeout(r, 200))");
        frame = browser.state("frame").parse::<usize>().unwrap();
        if frame >= 10 {
            break;
        }
    }
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

/// An arrow key in one of two flights: the time it tells then, and the number of the act.
fn stepped(browser: &mut Browser, flight: usize) -> [f64; 2] {
    browser.value(&format!("seen.length = 0, frames[{flight}].focus()"));
    browser.press("ArrowRight", "ArrowRight", 39);
    browser.wait(&format!("seen.some(([k]) => k === {flight})"));
    // The other has heard it, too.
    browser.value("new Promise((r) => setTimeout(r, 500))");
    let told = browser.value(&format!("seen.findLast(([k]) => k === {flight})"));
    [1, 2].map(|k| told[k].as_f64().unwrap())
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
    // Both are of one case: their directories tell them apart. The theme is what the link says, or the browser.
    let names = "[document.title, document.documentElement.dataset.theme, ...frames.map((f) => f.src.split('#')[1])]";
    let told = browser.value(names);
    let title = told[0].as_str().unwrap();
    assert!(
        title.starts_with("a: ") && title.contains(" and b: "),
        "{title}"
    );
    assert!(
        told[2]
            .as_str()
            .unwrap()
            .contains(&format!("theme={}", told[1].as_str().unwrap()))
    );
    browser.open(&scratch.0.join("pair.html"), "theme=light&frame=3");
    let told = browser.value(names);
    assert_eq!(told[1], "light");
    assert_eq!(
        (&told[2], &told[3]),
        (&json!("theme=light&frame=3&narrow=1"), &told[2])
    );
    // Frames made from blobs have no origin: what they tell is all that is seen of them.
    browser.value("window.seen = []; window.addEventListener('message', ({ source, data }) => seen.push([frames.findIndex((f) => f.contentWindow === source), data.shown.x, data.act]))");
    let [x, act] = stepped(&mut browser, 1);
    let [y, next_act] = stepped(&mut browser, 0);
    let step = y - x;
    assert!(
        step > 0.0 && step < 0.05 && next_act > act,
        "the first goes on from where the second was: {x} {y}, {act} {next_act}"
    );
    let [z, last_act] = stepped(&mut browser, 1);
    assert!((z - y - step).abs() < 0.1 * step, "{x} {y} {z}");
    // What was told before an act of the reader and comes after it is left aside, also soon after loading.
    for late in [0.0, 0.5, last_act - 0.5] {
        browser.value(&format!("frames[1].contentWindow.postMessage({{ shown: {{ x: 0, arm: null }}, act: {late} }}, '*'), new Promise((r) => setTimeout(r, 300))"));
    }
    let [on, _] = stepped(&mut browser, 1);
    assert!((on - z - step).abs() < 0.1 * step, "{z} was undone: {on}");
    // One that only shows what it is told says nothing when it is drawn anew.
    browser.value("frames[1].focus(), new Promise((r) => setTimeout(r, 500))");
    browser.value(
        "seen.length = 0, frames[0].style.height = '70%', new Promise((r) => setTimeout(r, 500))",
    );
    let echoes = browser.value("seen.filter(([k]) => k === 0).length");
    assert_eq!(echoes, json!(0));
    assert!(browser.complaints.is_empty(), "{:?}", browser.complaints);
}
