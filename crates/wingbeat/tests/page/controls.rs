//! What a user does with the page: time, keys, films, two flights beside each other.

use serde_json::json;

use crate::browser::Browser;
use crate::support::{Scratch, flown, wingbeat};
use crate::{RUN, Use, content, lent, lent_run};

#[test]
fn behaves_time_can_be_chosen_while_it_plays() {
    let Some(mut browser) = lent_run("wake=") else {
        return;
    };
    let set = "(id, v) => { const e = document.getElementById(id); e.value = v; e.dispatchEvent(new Event('input', { bubbles: true })); }";
    browser.value(&format!("({set})('speed', -6)"));
    browser.value("document.getElementById('play').click()");
    browser.wait("state.playing && state.at > 0");
    browser.value(&format!("({set})('time', 10)"));
    // Slow machines draw late.
    browser.wait("byId('state').dataset.frame >= 10");
    let frame = browser.state("frame").parse::<usize>().unwrap();
    assert!((10..=12).contains(&frame), "it jumped to {frame}");
    assert_eq!(
        browser.value("document.getElementById('time').value"),
        json!(frame.to_string())
    );
    content(&mut browser);
}

#[test]
fn behaves_keys_belong_to_the_control_that_has_the_focus() {
    let Some(mut browser) = lent_run("") else {
        return;
    };
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
    // Other keys than those of a focused button, slider or list are the page's, capital letters, too.
    let shown = "[state.theme, state.view, frameNow(), state.colour].join()";
    browser.value("state.theme = 'light', dress(), seek(4), byId('on-loop').focus()");
    browser.press("T", "KeyT", 84);
    browser.press("2", "Digit2", 50);
    browser.press("ArrowRight", "ArrowRight", 39);
    assert_eq!(browser.value(shown), json!("dark,side,5,stroke"));
    browser.wait("slider.value === '5'"); // as drawn
    browser.value("byId('time').focus()");
    browser.press("t", "KeyT", 84);
    browser.press("ArrowRight", "ArrowRight", 39);
    assert_eq!(browser.value(shown), json!("light,side,6,stroke"));
    browser.value("byId('colour').focus()");
    browser.press("a", "KeyA", 65); // the list goes to `age`
    browser.press("3", "Digit3", 51);
    assert_eq!(browser.value(shown), json!("light,front,6,age"));
    browser.wait("document.getElementById('state').dataset.frame === '6'");
    // With the focus on the scene, arrows turn it and time stands.
    let frame = browser.state("frame");
    browser.value("document.getElementById('gl').focus()");
    let before = browser.value("camera.position.toArray()");
    browser.press("ArrowRight", "ArrowRight", 39);
    assert_ne!(browser.value("camera.position.toArray()"), before);
    assert_eq!(browser.state("frame"), frame);
    content(&mut browser);
}

/// What a link may choose is obeyed while the page is open, too; what it does not name stays.
#[test]
fn behaves_a_changed_link_is_obeyed() {
    let Some(mut browser) = lent(Use::Run) else {
        return;
    };
    let shown = "JSON.stringify([frameNow(), state.view, state.theme, document.documentElement.dataset.theme, byId('colour').value, byId('force').value, +byId('age').value, byId('on-smoke').getAttribute('aria-pressed'), byId('on-vortices').getAttribute('aria-pressed')])";
    browser.open(&RUN.join("flight.html"), "frame=3&theme=dark&wake=vortices");
    let first = json!(r#"[3,"quarter","dark","dark","stroke","total",1.1,"false","true"]"#);
    assert_eq!(browser.value(shown), first);
    browser.value("location.hash = 'frame=7&view=top&theme=light&wake=smoke&colour=age&age=0.5'");
    browser.wait("frameNow() === 7");
    let second = json!(r#"[7,"top","light","light","age","total",0.5,"true","false"]"#);
    assert_eq!(browser.value(shown), second);
    browser.value("location.hash = 'force=each'");
    browser.wait("state.force === 'each'");
    let third = json!(r#"[7,"top","light","light","age","each",0.5,"true","false"]"#);
    assert_eq!(browser.value(shown), third);
    content(&mut browser);
}

/// A print is light, whatever the page is, and as it was afterwards; the scene has a height at any width.
#[test]
fn behaves_prints_are_light() {
    let Some(mut browser) = lent_run("frame=3&theme=dark&wake=smoke") else {
        return;
    };
    // Every pixel of the scene as it is now.
    let scene = "(() => { drawAll(); const g = renderer.getContext(), p = new Uint8Array(4 * canvas.width * canvas.height); g.readPixels(0, 0, canvas.width, canvas.height, g.RGBA, g.UNSIGNED_BYTE, p); return [canvas.width, canvas.height, p.reduce((sum, x) => (31 * sum + x) >>> 0, 0)].join(); })()";
    let before = browser.value(scene);
    browser.value("window.prints = [], window.addEventListener('beforeprint', () => { const c = byId('printed'); prints.push([state.theme, stage.clientHeight, c.width > 0 && c.getContext('2d').getImageData(9, 9, 1, 1).data[0]]); })");
    for landscape in [false, true] {
        browser.print(landscape);
    }
    let prints = browser.value("prints");
    for print in prints.as_array().unwrap() {
        assert_eq!((&print[0], &print[1]), (&json!("light"), &json!(400)));
        // The sky: #ffffff at the top of the light page, #182233 of the dark one.
        assert!(print[2].as_f64().unwrap() > 200.0, "{print}");
    }
    assert_eq!(prints.as_array().unwrap().len(), 2);
    let after = "[state.theme, document.documentElement.className, !!byId('printed')].join()";
    assert_eq!(browser.value(after), json!("dark,,false"));
    assert_eq!(browser.value(scene), before);
    // What bodies and wings mirror is made once for each theme.
    let mirrored = browser.value("[...['light', 'dark', 'light', 'dark'].map((name) => { state.theme = name; dress(); return scene.environment.id; }), rooms.size]");
    assert_eq!((&mirrored[0], &mirrored[1]), (&mirrored[2], &mirrored[3]));
    assert!(mirrored[0] != mirrored[1] && mirrored[4] == 2, "{mirrored}");
    assert_eq!(browser.value(scene), before);
    content(&mut browser);
}

/// Two fingers on a plot zoom it and leave the time; one that taps or moves changes the time.
#[test]
fn behaves_a_pinch_on_a_plot_leaves_the_time() {
    let Some(mut browser) = lent(Use::Flat) else {
        return;
    };
    browser.open(&RUN.join("flight.html"), "frame=3");
    browser.value("window.finger = (kind, id, part) => { const c = plots.list[0].canvas, r = c.getBoundingClientRect(); c.dispatchEvent(new PointerEvent('pointer' + kind, { pointerId: id, pointerType: 'touch', clientX: r.left + part * r.width, clientY: r.top + 9 })); }");
    let time = "[frameNow(), plots.range[1] - plots.range[0] < whole[1] - whole[0]].join()";
    browser.value("finger('down', 1, 0.5), finger('down', 2, 0.6), finger('move', 1, 0.3), finger('move', 2, 0.9), finger('up', 2, 0.9), finger('move', 1, 0.6), finger('up', 1, 0.6)");
    assert_eq!(browser.value(time), json!("3,true"));
    browser.value("byId('zoom-all').click(), finger('down', 1, 0.99), finger('up', 1, 0.99)");
    assert_eq!(browser.value("frameNow() > LAST - 3"), json!(true));
    browser.value("finger('down', 1, 0.99), finger('move', 1, 0.7), finger('move', 1, 0.15), finger('up', 1, 0.15)");
    assert_eq!(browser.value("frameNow() < 3"), json!(true));
    content(&mut browser);
}

#[test]
fn behaves_a_film_of_the_scene_is_recorded() {
    let Some(mut browser) = lent_run("frame=8&wake=smoke&speed=2") else {
        return;
    };
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
    let Some(mut browser) = lent(Use::Flat) else {
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
