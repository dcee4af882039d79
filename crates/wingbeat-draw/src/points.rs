//! The page of a campaign: all points of a table, in one HTML file without a network.

use serde_json::Value;

use crate::markup::escaped;
use crate::page::{bare, fill, inert};

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

#[cfg(test)]
mod tests {
    use super::*;

    /// The six digits of the first colour after `mark` in `text`, which may be short for two alike each.
    fn colour(text: &str, mark: &str) -> [f64; 3] {
        let (_, rest) = text.split_once(mark).unwrap();
        let (_, rest) = rest.split_once('#').unwrap();
        let digits: String = rest.chars().take_while(char::is_ascii_hexdigit).collect();
        let wide = digits.len() / 3;
        [0, 1, 2].map(|c| {
            let part = digits[c * wide..(c + 1) * wide].repeat(2 / wide);
            f64::from(u8::from_str_radix(&part, 16).unwrap()) / 255.0
        })
    }

    /// Contrast of two colours [WCAG 2.1, relative luminance].
    fn contrast(colours: [[f64; 3]; 2]) -> f64 {
        let linear = |v: f64| match v <= 0.03928 {
            true => v / 12.92,
            false => ((v + 0.055) / 1.055).powf(2.4),
        };
        let [a, b] = colours
            .map(|[r, g, b]| 0.05 + 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b));
        a.max(b) / a.min(b)
    }

    #[test]
    fn behaves_the_lowest_colour_stands_out_from_the_panel() {
        for (ramp, panel) in [
            ("RAMPS = { dark:", ":root { --back"),
            ("\"#fff0b8\"], light:", "[data-theme=light] { --back"),
        ] {
            let (_, rest) = STYLE.split_once(panel).unwrap();
            let found = contrast([colour(SCRIPT, ramp), colour(rest, "--panel:")]);
            assert!(found > 2.7, "{ramp} {found}");
        }
    }
}
