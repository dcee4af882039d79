//! The figure of a sweep of trims: power, stroke and attitude against speed.

use super::{Chart, Panel};

/// A trimmed flight of the sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedRow {
    /// Mean speed forward [m/s].
    pub forward: f64,
    /// Power against the air, of actuators with perfect elastic storage, and with none, per mass of the animal [W/kg].
    pub power: [f64; 3],
    /// Stroke angle from end to end \[rad\].
    pub stroke_amplitude: f64,
    /// Relative change of what drives joints, in place of strokes where no wing flaps by itself \[1\].
    pub drive: Option<f64>,
    /// Wingbeats per second \[Hz\].
    pub frequency: f64,
    /// Pitch of the body \[rad\].
    pub body_pitch: f64,
    /// Whether wings pass through each other: no animal flies so.
    pub wings_cross: bool,
}

/// The figure as SVG: speeds at which wings pass through each other are shaded, and the title has the one at which no
/// trim was found (`lost` [m/s]), beyond which there is none.
pub fn swept(name: &str, rows: &[SpeedRow], lost: Option<f64>) -> String {
    let each = |value: &dyn Fn(&SpeedRow) -> f64| rows.iter().map(value).collect();
    let shaded = crossing(rows);
    let grey = match shaded.is_empty() {
        true => "",
        false => " (grey: wings pass through each other)",
    };
    let none = lost.map(|v| format!(", none at {v:.3} m/s"));
    let chart = Chart {
        title: format!(
            "{name}: trimmed flight against speed{}",
            none.unwrap_or_default()
        ),
        x_label: format!("speed forward [m/s]{grey}"),
        x: rows.iter().map(|r| r.forward).collect(),
        shaded,
        panels: vec![
            Panel::new(
                "power [W/kg]",
                vec![
                    ("against the air", each(&|r| r.power[0])),
                    ("actuators, perfect elastic storage", each(&|r| r.power[1])),
                    ("actuators, no elastic storage", each(&|r| r.power[2])),
                ],
            ),
            match rows.iter().any(|r| r.drive.is_some()) {
                true => Panel::new(
                    "drive [%]",
                    vec![("change", each(&|r| 100.0 * r.drive.unwrap_or(0.0)))],
                ),
                false => Panel::new(
                    "stroke [deg]",
                    vec![("end to end", each(&|r| r.stroke_amplitude.to_degrees()))],
                ),
            },
            Panel::new(
                "frequency [Hz]",
                vec![("wingbeats", each(&|r| r.frequency))],
            ),
            Panel::new(
                "pitch [deg]",
                vec![("body", each(&|r| r.body_pitch.to_degrees()))],
            ),
        ],
    };
    chart.to_svg()
}

/// Where wings pass through each other: from halfway to the speed before to halfway to the next [m/s].
fn crossing(rows: &[SpeedRow]) -> Vec<[f64; 2]> {
    let speed = |k: usize| rows[k.min(rows.len() - 1)].forward;
    let around = |k: usize| {
        let here = speed(k);
        [k.saturating_sub(1), k + 1].map(|j| 0.5 * (here + speed(j)))
    };
    let crossing = (0..rows.len()).filter(|&k| rows[k].wings_cross);
    crossing.map(around).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_speeds_at_which_wings_cross_are_shaded_halfway_to_their_neighbours() {
        let rows = |crosses: [bool; 3]| {
            [0.0, 0.2, 0.6]
                .into_iter()
                .zip(crosses)
                .map(|(forward, wings_cross)| SpeedRow {
                    forward,
                    power: [1.0; 3],
                    stroke_amplitude: 2.0,
                    drive: None,
                    frequency: 200.0,
                    body_pitch: 0.5,
                    wings_cross,
                })
        };
        let rows = |crosses| rows(crosses).collect::<Vec<_>>();
        assert_eq!(
            crossing(&rows([false, true, true])),
            [[0.1, 0.4], [0.4, 0.6]]
        );
        assert_eq!(crossing(&rows([true, false, false])), [[0.0, 0.1]]);
        let says = |crosses, lost| swept("a fly", &rows(crosses), lost);
        let sound = says([false; 3], None);
        assert!(!sound.contains("grey") && !sound.contains("none at"));
        let limited = says([false, false, true], Some(0.8));
        assert!(limited.contains("grey: wings pass through each other"));
        assert!(limited.contains("none at 0.800 m/s"), "{limited}");
    }
}
