//! The flight page: one HTML file that holds the flight, the program that shows it, and three.js.
//!
//! The chapter in order: [`plan`] says which frames are shown and what is thinned; [`pack`] turns
//! frames into 16-bit numbers; `data` gathers everything the page knows; the assets show it.
//!
//! Memory is bounded by the size of the page, not by the length of the flight.

mod data;
pub mod pack;
pub mod plan;

use std::path::PathBuf;

use wingbeat_case::IoError;
use wingbeat_results::{Outcome, ResultDir};

/// Name of the page in a result directory.
pub const FILE: &str = "flight.html";
/// Size of a page unless told otherwise \[bytes\].
pub const DEFAULT_BYTES: usize = 20_000_000;

const TEMPLATE: &str = include_str!("../../assets/page.html");
const SCRIPT: &str = include_str!("../../assets/page.js");
const THREE: &str = include_str!("../../assets/three.bundle.min.js");

/// Writes the page of a result directory whose run ended so, no larger than `most_bytes` (but never without its
/// program and plots).
///
/// # Errors
/// A result that cannot be read or a page that cannot be written.
pub fn write(dir: &ResultDir, outcome: &Outcome, most_bytes: usize) -> Result<PathBuf, IoError> {
    let fixed = TEMPLATE.len() + SCRIPT.len() + THREE.len();
    let (title, data) = data::gather(dir, outcome, most_bytes.saturating_sub(fixed))?;
    let page = fill(&[
        ("title", &escaped(&title)),
        ("three", THREE),
        ("data", &data),
        ("script", SCRIPT),
    ]);
    dir.write(FILE, page.as_bytes())?;
    Ok(dir.join(FILE))
}

/// The template with its places filled, each once and in order.
fn fill(parts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = TEMPLATE;
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

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('"', "&quot;")
}
