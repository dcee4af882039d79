//! The figure of a sweep of trims: power, stroke and attitude against speed.

use super::{Chart, Panel, Series};

/// A trimmed flight of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedRow {
    /// Mean speed forward [m/s].
    pub forward: f64,
    /// Power against the air, of muscles with perfect elastic storage, and with none, per mass of the animal [W/kg].
    pub power: [f64; 3],
    /// Stroke angle from end to end \[rad\].
    pub stroke_amplitude: f64,
    /// Wingbeats per second \[Hz\].
    pub frequency: f64,
    /// Pitch of the body \[rad\].
    pub body_pitch: f64,
}

/// The figure as SVG.
pub fn swept(name: &str, rows: &[SpeedRow]) -> String {
    let series = |label: &str, value: &dyn Fn(&SpeedRow) -> f64| Series {
        label: label.into(),
        values: rows.iter().map(value).collect(),
        measured: false,
    };
    let panel = |label: &str, series: Vec<Series>| Panel {
        label: label.into(),
        series,
        ..Panel::default()
    };
    let chart = Chart {
        title: format!("{name}: trimmed flight against speed"),
        x_label: "speed forward [m/s]".into(),
        x: rows.iter().map(|r| r.forward).collect(),
        shaded: vec![],
        panels: vec![
            panel(
                "power [W/kg]",
                vec![
                    series("against the air", &|r| r.power[0]),
                    series("muscles, perfect elastic storage", &|r| r.power[1]),
                    series("muscles, no elastic storage", &|r| r.power[2]),
                ],
            ),
            panel(
                "stroke [deg]",
                vec![series("end to end", &|r| r.stroke_amplitude.to_degrees())],
            ),
            panel(
                "frequency [Hz]",
                vec![series("wingbeats", &|r| r.frequency)],
            ),
            panel(
                "pitch [deg]",
                vec![series("body", &|r| r.body_pitch.to_degrees())],
            ),
        ],
    };
    chart.to_svg()
}
