//! The page of a campaign: all points of a table, in one HTML file without a network.

use serde_json::Value;

use crate::page::{bare, escaped, fill, inert};

const TEMPLATE: &str = include_str!("../assets/points/points.html");
const STYLE: &str = include_str!("../assets/points/points.css");
const SCRIPT: &str = include_str!("../assets/points/points.js");

/// The page; `data` has the columns and rows of the table.
pub fn page(title: &str, data: &Value) -> String {
    let parts = [
        ("title", &escaped(title)),
        ("style", &bare(STYLE)),
        ("data", &inert(&data.to_string())),
        ("script", &bare(SCRIPT)),
    ];
    fill(TEMPLATE, &parts.map(|(name, text)| (name, text.as_str())))
}
