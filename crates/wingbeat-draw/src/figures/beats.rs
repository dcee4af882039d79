//! Force and power wingbeat by wingbeat, with their means.

use wingbeat_flight::FlightSetup;

use super::drawing::{COLOURS, Colour, Drawing};
use super::grid::grid;
use super::kinds::{downstrokes, force_unit, prefix, scaled};
use super::plot::{self, Curve, Plot};
use super::style::Look;
use wingbeat_results::summary::{BeatMeans, air_force, down, hinge_power};
use wingbeat_results::{History, Summary};

/// More beats than this are not told apart by their shade.
const MOST_CURVES: usize = 6;

/// What is drawn: name of the axis, over time, per beat.
type Quantity = (String, Vec<f64>, Vec<f64>);

/// The figure; none without a whole wingbeat.
pub(super) fn beats(
    setup: &FlightSetup,
    history: &History,
    summary: &Summary,
    look: &Look,
) -> Option<Drawing> {
    let period = setup.time.period?;
    if summary.beats.is_empty() {
        return None;
    }
    let time = history.column("time_s");
    let x: Vec<f64> = time.iter().map(|t| t / period).collect();
    let quantities = quantities(setup, history, &summary.beats);
    let mut plots: Vec<Plot> = quantities
        .iter()
        .map(|q| over_phase(setup, history, &x, q, look))
        .collect();
    plots.extend(quantities.iter().map(|q| over_beats(q, look)));
    let title = format!("{}: wingbeat by wingbeat, with means", setup.name);
    let (columns, height) = (quantities.len(), 1.15 * look.panel);
    Some(grid(&plots, columns, height, &title, look).0)
}

fn quantities(setup: &FlightSetup, history: &History, beats: &[BeatMeans]) -> Vec<Quantity> {
    let mut list = vec![];
    let mean = |f: &dyn Fn(&BeatMeans) -> f64| beats.iter().map(f).collect::<Vec<f64>>();
    if setup.air.is_some() {
        let up = air_force(history, -down(setup));
        let (unit, factor) = force_unit(setup, &up);
        let label = match &unit[..] {
            "weight" => "force upward / weight".to_owned(),
            _ => format!("force upward [{unit}]"),
        };
        let means = mean(&|b| b.lift_newton * factor);
        list.push((label, scaled(&up, factor), means));
    }
    let power = hinge_power(history);
    let (scale, prefix) = prefix(&power);
    let means = mean(&|b| b.power_watt / scale);
    let label = format!("power of the hinges [{prefix}W]");
    list.push((label, scaled(&power, 1.0 / scale), means));
    list
}

/// The last beats above each other, from light to dark; dashed: the mean of the last.
fn over_phase(
    setup: &FlightSetup,
    history: &History,
    x: &[f64],
    (label, values, means): &Quantity,
    look: &Look,
) -> Plot {
    let shown = means.len().min(MOST_CURVES);
    let mut curves = vec![];
    for n in 0..shown {
        let beat = means.len() - shown + n;
        let from = beat as f64;
        let age = 0.75 * (1.0 - (n + 1) as f64 / shown as f64);
        let colour = COLOURS[0].toward(Colour(255, 255, 255), age);
        let name = match n {
            _ if n + 1 == shown => format!("beat {}", beat + 1),
            0 => format!("{}", beat + 1),
            _ => String::new(),
        };
        let points = x.iter().zip(values).map(|(x, y)| [x - from, *y]);
        let points = points.filter(|p| (-1e-9..=1.0 + 1e-9).contains(&p[0]));
        curves.push(plot::curve(&name, points.collect(), colour, 0, look));
    }
    let last = means[means.len() - 1];
    let ends = vec![[0.0, last], [1.0, last]];
    let mut mean = plot::curve("mean", ends, COLOURS[1], 1, look);
    mean.stroke.dash = &[5.0, 2.0];
    let y = plot::range(curves.iter().flat_map(|c| &c.points).map(|p| p[1]));
    curves.push(mean);
    Plot {
        x_label: "time in the wingbeat".to_owned(),
        y_label: label.clone(),
        x: [0.0, 1.0],
        y,
        shaded: shaded(setup, history, x, (means.len() - 1) as f64),
        curves,
        ..Plot::default()
    }
}

/// Downstroke intervals of the beat that begins at `from`.
fn shaded(setup: &FlightSetup, history: &History, x: &[f64], from: f64) -> Vec<[f64; 2]> {
    let parts = downstrokes(setup, history, x).into_iter();
    let inside = parts.map(|p| p.map(|x| (x - from).clamp(0.0, 1.0)));
    inside.filter(|p| p[1] > p[0]).collect()
}

/// The mean of every beat.
fn over_beats((label, _, means): &Quantity, look: &Look) -> Plot {
    let points = means.iter().enumerate().map(|(k, m)| [k as f64 + 1.0, *m]);
    let points: Vec<[f64; 2]> = points.collect();
    let values = points.iter().map(|p| p[1]);
    let y = plot::range(values.chain([0.0]));
    let curve = plot::curve("", points, COLOURS[1], 0, look);
    Plot {
        x_label: "number of the wingbeat".to_owned(),
        y_label: format!("mean {label}"),
        x: [0.5, means.len() as f64 + 0.5],
        y,
        curves: vec![Curve {
            dotted: true,
            ..curve
        }],
        ..Plot::default()
    }
}
