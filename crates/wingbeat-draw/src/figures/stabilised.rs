//! The figure of a flight under feedback.

use wingbeat_math::DVec3;

use super::{Chart, Panel, Series};

/// What is seen at the start of a wingbeat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeatRow {
    /// Number of the beat.
    pub beat: usize,
    /// Mass centre from the start, level frame: forward, right, down [m].
    pub position: DVec3,
    /// Roll, pitch, heading from the trimmed flight \[rad\].
    pub tilt: DVec3,
    /// Relative change of the stroke amplitude, first and last wing \[1\].
    pub amplitude: [f64; 2],
    /// Change of the mean stroke angle of the last wing \[rad\].
    pub offset: f64,
}

/// Tilt, place in wing lengths (`length` [m]) and commands over the wingbeats as SVG.
pub fn stabilised(name: &str, length: f64, rows: &[BeatRow]) -> String {
    let chart = Chart {
        title: format!("{name}: disturbed and flown under feedback"),
        x_label: "wingbeats".into(),
        x: rows.iter().map(|r| r.beat as f64).collect(),
        shaded: vec![],
        panels: panels(length, rows),
    };
    chart.to_svg()
}

fn panels(length: f64, rows: &[BeatRow]) -> Vec<Panel> {
    let series = |label: &str, value: &dyn Fn(&BeatRow) -> f64| Series {
        label: label.into(),
        values: rows.iter().map(value).collect(),
        measured: false,
    };
    let panel = |label: &str, series: Vec<Series>| Panel {
        label: label.into(),
        series,
        ..Panel::default()
    };
    vec![
        panel(
            "tilt [deg]",
            vec![
                series("roll", &|r| r.tilt.x.to_degrees()),
                series("pitch", &|r| r.tilt.y.to_degrees()),
                series("heading", &|r| r.tilt.z.to_degrees()),
            ],
        ),
        panel(
            "place [wing lengths]",
            vec![
                series("forward", &|r| r.position.x / length),
                series("right", &|r| r.position.y / length),
                series("up", &|r| -r.position.z / length),
            ],
        ),
        panel(
            "commands",
            vec![
                series("amplitude left [%]", &|r| 100.0 * r.amplitude[0]),
                series("amplitude right [%]", &|r| 100.0 * r.amplitude[1]),
                series("mean stroke [deg]", &|r| r.offset.to_degrees()),
            ],
        ),
    ]
}
