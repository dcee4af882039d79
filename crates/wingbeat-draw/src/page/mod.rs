//! The flight page: one HTML file that holds the flight, the program that shows it, and three.js.
//!
//! The chapter in order: [`plan`] says which frames are shown and what is thinned; [`pack`] turns
//! frames into 16-bit numbers; `solid` gives bodies a shape; `scene` reads the frames, `data` gathers
//! everything the page knows; the assets, one file for each thing the page does, show it.
//!
//! Memory is bounded by the size of the page, not by the length of the flight.

mod data;
pub(crate) use data::inert;
pub mod pack;
pub mod plan;
mod scene;
mod solid;

use std::path::PathBuf;

use wingbeat_case::IoError;
use wingbeat_results::{Outcome, ResultDir};

use crate::markup::escaped;

/// Name of the page in a result directory.
pub const FILE: &str = "flight.html";
/// Size of a page unless told otherwise \[bytes\].
pub const DEFAULT_BYTES: usize = 20_000_000;

const TEMPLATE: &str = include_str!("../../assets/page/page.html");
const STYLE: &str = include_str!("../../assets/page/page.css");
const THREE: &str = include_str!("../../assets/three.bundle.min.js");
/// Surfaces of vorticity: run by the page and by its worker.
const VORTICES: &str = include_str!("../../assets/page/vortices.js");
const WORKER: &str = include_str!("../../assets/page/worker.js");
/// The program of the page, each part using those before it.
const SCRIPT: &str = concat!(
    include_str!("../../assets/page/flight.js"),
    include_str!("../../assets/page/words.js"),
    include_str!("../../assets/page/theme.js"),
    include_str!("../../assets/page/state.js"),
    include_str!("../../assets/page/stage.js"),
    include_str!("../../assets/page/animal.js"),
    include_str!("../../assets/page/wake.js"),
    include_str!("../../assets/page/scenery.js"),
    include_str!("../../assets/page/flat.js"),
    include_str!("../../assets/page/plots.js"),
    include_str!("../../assets/page/timebar.js"),
    include_str!("../../assets/page/record.js"),
    include_str!("../../assets/page/main.js"),
);

/// The page around two flights.
const PAIR: &str = include_str!("../../assets/page/pair.html");
/// Stands for the data while the rest of the page is put together.
const GAP: char = '\0';

/// Writes the page of a result directory whose run ended so, no larger than `most_bytes` (but never
/// without its program and plots).
///
/// # Errors
/// A result that cannot be read or a page that cannot be written.
pub fn write(dir: &ResultDir, outcome: &Outcome, most_bytes: usize) -> Result<PathBuf, IoError> {
    let page = text(dir, outcome, most_bytes)?;
    dir.write(FILE, page.as_bytes())?;
    Ok(dir.join(FILE))
}

/// The page of a result directory that was written after its run ended, if it has one.
pub fn finished(dir: &ResultDir) -> Option<PathBuf> {
    let written = |name: &str| std::fs::metadata(dir.join(name)).ok()?.modified().ok();
    let is_newer = written(FILE)? >= written("history.csv")?;
    let page = dir.join(FILE);
    (is_newer && page.is_file()).then_some(page)
}

/// The page of a result directory as [`write`] writes it.
///
/// # Errors
/// A result that cannot be read.
pub fn text(dir: &ResultDir, outcome: &Outcome, most_bytes: usize) -> Result<String, IoError> {
    let name = dir.case()?.name;
    let data = data::gather(
        (dir, &name),
        outcome,
        most_bytes.saturating_sub(program_bytes()),
    )?;
    let [before, after] = program(&name);
    Ok([before, data, after].concat())
}

/// Two flights beside each other as one page of at most `most_bytes`, which keeps their times and
/// views together. Flights of one name are told apart by their directories.
///
/// # Errors
/// A result that cannot be read.
pub fn pair(dirs: [&ResultDir; 2], most_bytes: usize) -> Result<String, IoError> {
    let room = most_bytes.saturating_sub(program_bytes()) / 2;
    let [a, b] = told_apart(dirs)?;
    let data = |dir: &ResultDir, name: &str| {
        let outcome = dir.manifest()?.outcome;
        data::gather((dir, name), &outcome, room)
    };
    let [first, second] = [data(dirs[0], &a)?, data(dirs[1], &b)?];
    let title = format!("{a} and {b}");
    let json = |parts: [String; 2]| data::inert(&serde_json::json!(parts).to_string());
    Ok(fill(
        PAIR,
        &[
            ("title", &escaped(&title)),
            ("heading", &escaped(&title)),
            ("page", &json(program(&title))),
            ("data", &json([first, second])),
        ],
    ))
}

/// The names of two flights, with their directories where they are alike.
fn told_apart(dirs: [&ResultDir; 2]) -> Result<[String; 2], IoError> {
    let names = [dirs[0].case()?.name, dirs[1].case()?.name];
    if names[0] != names[1] {
        return Ok(names);
    }
    Ok(dirs.map(|dir| format!("{}: {}", dir.path().display(), names[0])))
}

/// Size of everything but the data.
fn program_bytes() -> usize {
    program("").iter().map(String::len).sum()
}

/// The page before and after its data.
fn program(title: &str) -> [String; 2] {
    let [style, vortices, worker, script] = [STYLE, VORTICES, WORKER, SCRIPT].map(bare);
    let page = fill(
        TEMPLATE,
        &[
            ("title", &escaped(title)),
            ("style", &style),
            ("three", THREE),
            ("data", &GAP.to_string()),
            ("vortices", &vortices),
            ("worker", &worker),
            ("script", &script),
        ],
    );
    let (before, after) = page.split_once(GAP).expect("the gap was put there");
    [before, after].map(str::to_owned)
}

/// A program without indentation and lines of comment: every page carries it.
pub(crate) fn bare(program: &str) -> String {
    let lines = program.lines().map(str::trim_start);
    let lines = lines.filter(|l| !l.is_empty() && !l.starts_with("//"));
    lines.flat_map(|l| [l, "\n"]).collect()
}

/// A template with its places filled, each once and in order.
pub(crate) fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    for (name, text) in parts {
        let place = format!("{{{{{name}}}}}");
        let (before, after) = rest.split_once(&place).expect("the template has the place");
        page.push_str(before);
        page.push_str(text);
        rest = after;
    }
    page.push_str(rest);
    page
}
