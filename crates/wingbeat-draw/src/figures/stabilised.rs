//! The figure of a flight under feedback.

use wingbeat_math::DVec3;

use super::{Chart, Panel};

/// What is seen at the start of a wingbeat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeatRow {
    /// Number of the beat.
    pub beat: usize,
    /// Mass centre from the start, level frame: forward, right, down [m].
    pub position: DVec3,
    /// Roll, pitch, heading from the trimmed flight \[rad\].
    pub tilt: DVec3,
    /// Relative change of the stroke amplitude, left and right \[1\].
    pub amplitude: [f64; 2],
    /// Change of the mean stroke angle \[rad\].
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
    let each = |value: &dyn Fn(&BeatRow) -> f64| rows.iter().map(value).collect();
    vec![
        Panel::new(
            "tilt [deg]",
            vec![
                ("roll", each(&|r| r.tilt.x.to_degrees())),
                ("pitch", each(&|r| r.tilt.y.to_degrees())),
                ("heading", each(&|r| r.tilt.z.to_degrees())),
            ],
        ),
        Panel::new(
            "place [wing lengths]",
            vec![
                ("forward", each(&|r| r.position.x / length)),
                ("right", each(&|r| r.position.y / length)),
                ("up", each(&|r| -r.position.z / length)),
            ],
        ),
        Panel::new(
            "commands",
            vec![
                ("amplitude left [%]", each(&|r| 100.0 * r.amplitude[0])),
                ("amplitude right [%]", each(&|r| 100.0 * r.amplitude[1])),
                ("mean stroke [deg]", each(&|r| r.offset.to_degrees())),
            ],
        ),
    ]
}
