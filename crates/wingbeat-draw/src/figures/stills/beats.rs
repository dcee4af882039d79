//! Force and power wingbeat by wingbeat, with their means.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::figures::axes::grid::grid;
use crate::figures::axes::plot::{self, Band, Curve, Plot};
use crate::figures::axes::units::{
    FORCE_FLOOR, POWER_FLOOR, force_times_speed, force_unit, prefix, scaled,
};
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{COLOURS, Drawing};
use crate::figures::over_time::shades::Shades;
use crate::figures::over_time::strokes::{downstrokes, stroke, strokes};
use wingbeat_results::History;
use wingbeat_results::summary::{
    BeatMeans, air_force, down, driving_power, driving_power_name, left_out,
};

/// What is drawn.
struct Quantity {
    /// Name of the axis.
    label: String,
    /// Over time.
    values: Vec<f64>,
    /// Number and mean of every beat.
    means: Vec<[f64; 2]>,
    /// Extent below which differences are rounding.
    least: f64,
}

/// The figure of these whole wingbeats; none without any. `note` says which part of the flight it is.
pub(crate) fn beats(
    setup: &FlightSetup,
    history: &History,
    (beats, note): (&[BeatMeans], &str),
    look: &Look,
) -> Option<Drawing> {
    let period = setup.time.period?;
    if beats.is_empty() {
        return None;
    }
    let time = history.column("time_s");
    let x: Vec<f64> = time.iter().map(|t| t / period).collect();
    let quantities = quantities(setup, history, beats);
    if quantities.is_empty() {
        return None;
    }
    let mut plots: Vec<Plot> = quantities
        .iter()
        .map(|q| over_phase(setup, history, &x, q, look))
        .collect();
    let words = match plots[0].shaded.is_empty() {
        true => String::new(),
        false => Shades::new(&strokes(setup, history), &x).words(setup, false),
    };
    plots.extend(quantities.iter().map(|q| over_beats(q, look)));
    let title = format!(
        "{}: wingbeat by wingbeat, with means{words}{note}",
        setup.name
    );
    let (columns, height) = (quantities.len(), 1.15 * look.panel);
    Some(grid(&plots, columns, height, &title, look).0)
}

fn quantities(setup: &FlightSetup, history: &History, beats: &[BeatMeans]) -> Vec<Quantity> {
    let mut list = vec![];
    let mean = |f: &dyn Fn(&BeatMeans) -> f64| {
        let means = beats.iter().map(|b| [b.beat as f64, f(b)]);
        means.collect::<Vec<[f64; 2]>>()
    };
    if setup.air.is_some() {
        let up = air_force(history, -down(setup));
        let along = [DVec3::X, DVec3::Y].map(|n| air_force(history, n));
        let sizes = along.iter().chain([&up]).flatten().map(|f| f.abs());
        let floor = FORCE_FLOOR * sizes.fold(0.0, f64::max);
        let (unit, factor) = force_unit(setup, up.iter().chain([&floor]));
        let label = match &unit[..] {
            "weight" => "force upward / weight".to_owned(),
            _ => format!("force upward [{unit}]"),
        };
        let means = mean(&|b| b.mean.lift_newton * factor);
        list.push(Quantity {
            label,
            values: scaled(&up, factor),
            means,
            least: floor * factor,
        });
    }
    if let Some(name) = driving_power_name(setup, history) {
        let power = driving_power(history);
        let whole = force_times_speed(setup, history);
        let floor = POWER_FLOOR * whole.into_iter().fold(0.0, f64::max);
        let most = power.iter().copied().chain([floor]);
        let (scale, prefix) = prefix(&most.collect::<Vec<f64>>());
        list.push(Quantity {
            label: format!("{name} [{prefix}W]"),
            values: scaled(&power, 1.0 / scale),
            means: mean(&|b| b.mean.power_watt / scale),
            least: floor / scale,
        });
    }
    list
}

/// The phase mean of the wingbeats that the summary's means are of, with its spread, and the last wingbeat; of
/// fewer than three of them, the last two. Dotted: the mean of the last.
fn over_phase(
    setup: &FlightSetup,
    history: &History,
    x: &[f64],
    Quantity {
        label,
        values,
        means,
        least,
    }: &Quantity,
    look: &Look,
) -> Plot {
    let beats: Vec<(f64, Vec<[f64; 2]>)> = (means.iter())
        .map(|m| (m[0], beat(x, values, m[0])))
        .filter(|b| b.1.len() > 2)
        .collect();
    let first = left_out(setup) as f64;
    let counts = |b: &&(f64, Vec<[f64; 2]>)| b.0 > first;
    let later: Vec<&(f64, Vec<[f64; 2]>)> = beats.iter().filter(counts).collect();
    let (mut curves, mut bands) = (vec![], vec![]);
    if later.len() > 2 {
        let spread = spread(&later);
        let ends = [later[0].0, later[later.len() - 1].0];
        let name = format!("mean of {} to {}, ± spread", ends[0], ends[1]);
        let mean = spread.iter().map(|[x, m, _]| [*x, *m]).collect();
        curves.push(plot::curve(&name, mean, COLOURS[0], 0, look));
        bands.push(Band {
            points: spread.iter().map(|[x, m, s]| [*x, m - s, m + s]).collect(),
            colour: COLOURS[4],
        });
    }
    curves.extend(last_beats(&beats, later.len() > 2, look));
    let [number, last] = means[means.len() - 1];
    let ends = vec![[0.0, last], [1.0, last]];
    let colour = curves.last().map_or(COLOURS[1], |beat| beat.stroke.colour);
    let mut mean = plot::curve("its mean", ends, colour, 1, look);
    mean.stroke.dash = &[1.5, 1.5];
    let inside = curves.iter().flat_map(|c| &c.points).map(|p| p[1]);
    let edges = bands
        .iter()
        .flat_map(|b| &b.points)
        .flat_map(|p| [p[1], p[2]]);
    let y = plot::at_least(plot::range(inside.chain(edges)), *least);
    curves.push(mean);
    Plot {
        x_label: "time in the wingbeat".to_owned(),
        y_label: label.clone(),
        x: [0.0, 1.0],
        y,
        shaded: shaded(setup, history, x, number - 1.0),
        curves,
        bands,
        ..Plot::default()
    }
}

/// The last wingbeat beside the mean of many, else the last two.
fn last_beats(beats: &[(f64, Vec<[f64; 2]>)], many: bool, look: &Look) -> Vec<Curve> {
    let mut curves = vec![];
    let own = if many { 1 } else { 2 };
    for (n, (number, points)) in beats.iter().rev().take(own).rev().enumerate() {
        let colour = if many { COLOURS[1] } else { COLOURS[[4, 0][n]] };
        curves.push(plot::curve(
            &format!("beat {number}"),
            points.clone(),
            colour,
            if many { 1 } else { n },
            look,
        ));
    }
    curves
}

/// Points of a wingbeat over its phase.
fn beat(x: &[f64], values: &[f64], number: f64) -> Vec<[f64; 2]> {
    let points = x.iter().zip(values).map(|(x, y)| [x - (number - 1.0), *y]);
    let inside = points.filter(|p| (-1e-9..=1.0 + 1e-9).contains(&p[0]));
    inside.collect()
}

/// Phase, mean over the wingbeats and standard deviation about it, at the phases of the last one.
fn spread(beats: &[&(f64, Vec<[f64; 2]>)]) -> Vec<[f64; 3]> {
    let count = beats.len() as f64;
    let phases = beats[beats.len() - 1].1.iter().map(|p| p[0]);
    let one = |x: f64| {
        let values: Vec<f64> = beats.iter().map(|b| at_phase(&b.1, x)).collect();
        let mean = values.iter().sum::<f64>() / count;
        let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0);
        [x, mean, square.sqrt()]
    };
    phases.map(one).collect()
}

/// Value at a phase, straight between the points.
fn at_phase(points: &[[f64; 2]], x: f64) -> f64 {
    wingbeat_math::interpolate(points.len(), |k| points[k].into(), x)
}

/// Downstroke intervals of the beat that begins at `from`.
fn shaded(setup: &FlightSetup, history: &History, x: &[f64], from: f64) -> Vec<[f64; 2]> {
    let parts = downstrokes(&stroke(setup, history), x).into_iter();
    let inside = parts.map(|p| p.map(|x| (x - from).clamp(0.0, 1.0)));
    inside.filter(|p| p[1] > p[0]).collect()
}

/// The mean of every beat.
fn over_beats(quantity: &Quantity, look: &Look) -> Plot {
    let points = quantity.means.clone();
    let ends = [points[0][0] - 0.5, points[points.len() - 1][0] + 0.5];
    let values = points.iter().map(|p| p[1]);
    let y = plot::at_least(plot::range(values.chain([0.0])), quantity.least);
    let curve = plot::curve("", points, COLOURS[1], 0, look);
    Plot {
        x_label: "number of the wingbeat".to_owned(),
        y_label: format!("mean {}", quantity.label),
        x: ends,
        counts: true,
        y,
        curves: vec![Curve {
            dotted: true,
            ..curve
        }],
        ..Plot::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Style;
    use crate::figures::drawing::{Anchor, Mark};
    use wingbeat_case::LoadedCase;
    use wingbeat_flight::Record;
    use wingbeat_results::columns::Columns;
    use wingbeat_results::{Outcome, Summary};

    /// Of many wingbeats those that the summary counts, of few the last two; no two lines with one dash on paper.
    #[test]
    fn exact_beats_are_those_of_the_summary_and_lines_differ() {
        let setup = LoadedCase::find("fruit-fly-blade", &[]).unwrap().setup;
        let columns = Columns::new(&setup, false).unwrap();
        let look = Style::Paper.look();
        for (count, labels) in [
            (6, &["mean of 3 to 6, ± spread", "beat 6", "its mean"]),
            (3, &["beat 2", "beat 3", "its mean"]),
        ] {
            let x: Vec<f64> = (0..=20 * count).map(|k| k as f64 / 20.0).collect();
            let history = History::of(&columns, &vec![columns.blank(); x.len()]);
            let means = (1..=count).map(|k| [k as f64, 0.0]).collect();
            let quantity = Quantity {
                label: "power [W]".to_owned(),
                values: vec![0.0; x.len()],
                means,
                least: 0.0,
            };
            let plot = over_phase(&setup, &history, &x, &quantity, &look);
            let found: Vec<&str> = plot.curves.iter().map(|c| &c.label[..]).collect();
            assert_eq!(found, labels);
            for (k, a) in plot.curves.iter().enumerate() {
                let others = &plot.curves[k + 1..];
                assert!(others.iter().all(|b| b.stroke.dash != a.stroke.dash));
            }
            let [.., beat, mean] = &plot.curves[..] else {
                panic!("two curves or more");
            };
            assert_eq!(beat.stroke.colour, mean.stroke.colour);
        }
    }

    /// Beats have whole numbers, few or many.
    #[test]
    fn exact_ticks_at_wingbeats_are_whole() {
        let look = Style::Screen.look();
        for count in [1, 2, 3, 7, 40] {
            let means = (1..=count).map(|k| [f64::from(k), 1.0]).collect();
            let quantity = Quantity {
                label: "power [W]".to_owned(),
                values: vec![],
                means,
                least: 0.0,
            };
            let drawing = grid(&[over_beats(&quantity, &look)], 1, 100.0, "", &look).0;
            let along = drawing.marks.iter().filter_map(|m| match m {
                Mark::Text { text, anchor, .. } if *anchor == Anchor::Middle => Some(text),
                _ => None,
            });
            let numbers: Vec<&String> = along.filter(|t| t.parse::<f64>().is_ok()).collect();
            assert!(!numbers.is_empty(), "{count}");
            assert!(
                numbers.iter().all(|t| t.parse::<i32>().is_ok()),
                "{numbers:?}"
            );
        }
    }

    /// The title says what is shaded, and of which wing where wings beat apart.
    #[test]
    fn exact_the_title_says_whose_downstrokes_are_shaded() {
        let titled = |case: &str, lead: f64| {
            let setup = LoadedCase::find(case, &[]).unwrap().setup;
            let columns = Columns::new(&setup, false).unwrap();
            let steps = setup.time.steps_per_beat().expect("beats");
            let record = |k: usize| {
                let mut record = columns.blank();
                (record.step, record.time) = (k, k as f64 * setup.time.step);
                for (angles, wing) in record.wing_angles.iter_mut().zip(&setup.animal.wings) {
                    let lead = if wing.name.contains("fore") {
                        lead
                    } else {
                        0.0
                    };
                    let x = std::f64::consts::TAU * (k as f64 / steps as f64 + lead);
                    angles[0] = wing.side.sign() * x.sin();
                }
                record
            };
            let records: Vec<Record> = (0..=2 * steps).map(record).collect();
            let history = History::of(&columns, &records);
            let summary = Summary::of(&setup, &records, &Outcome::Finished);
            let look = Style::Screen.look();
            let drawn = beats(&setup, &history, (&summary.beats, ", note"), &look);
            drawn.expect("a figure").title
        };
        let one = titled("fruit-fly-blade", 0.0);
        assert!(one.ends_with("(downstroke shaded), note"), "{one}");
        let two = titled("dragonfly", 0.25);
        assert!(
            two.contains("(downstroke of wing hind right shaded)"),
            "{two}"
        );
    }

    /// Three beats of a ramp, one higher, one lower than the middle one by 1: spread 1 at every phase.
    #[test]
    fn exact_mean_and_spread_over_the_phase() {
        let x: Vec<f64> = (0..=40).map(|k| f64::from(k) * 0.1).collect();
        let values: Vec<f64> = x.iter().map(|x| x % 1.0 + (x + 1e-9).floor()).collect();
        let all: Vec<(f64, Vec<[f64; 2]>)> = [2.0, 3.0, 4.0]
            .map(|n| (n, beat(&x, &values, n)[..10].to_vec()))
            .to_vec();
        let spread = spread(&all.iter().collect::<Vec<_>>());
        assert_eq!(spread.len(), 10);
        for (k, [phase, mean, deviation]) in spread.into_iter().enumerate() {
            assert!((phase - 0.1 * k as f64).abs() < 1e-9);
            assert!(
                (mean - phase - 2.0).abs() < 1e-6 && (deviation - 1.0).abs() < 1e-9,
                "{mean}"
            );
        }
    }
}
