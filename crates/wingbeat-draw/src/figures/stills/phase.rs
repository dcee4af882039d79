//! Phase planes: quantities against their rates.

use wingbeat_flight::FlightSetup;

use crate::figures::axes::grid::grid;
use crate::figures::axes::plot::{self, Plot};
use crate::figures::axes::units::{prefix, scaled};
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{COLOURS, Drawing};
use crate::figures::over_time::kinds::from_start;
use crate::figures::over_time::strokes::{reference_number, reference_wing};
use crate::figures::over_time::wing_angles::wing_angles;
use wingbeat_results::History;

/// Least extent of the axes of angles of wings \[deg\]: some are held, and differ by rounding.
const MIN_ANGLE: f64 = 1.0;

/// Two quantities over time, with their names.
struct Plane {
    x: (String, Vec<f64>),
    y: (String, Vec<f64>),
    /// Least extent of its axes.
    least: f64,
}

/// The figure; none where nothing moves. `note` says which part of the flight it is.
pub(crate) fn phase(
    setup: &FlightSetup,
    history: &History,
    note: &str,
    look: &Look,
) -> Option<Drawing> {
    let mut planes = body(setup, history);
    planes.extend(wing(setup, history));
    if planes.is_empty() {
        return None;
    }
    let starts = starts(setup, history);
    let plots: Vec<Plot> = planes.iter().map(|p| plot(p, look)).collect();
    let columns = match plots.len() {
        1 => 1,
        2 | 4 => 2,
        _ => 3,
    };
    let title = format!(
        "{}: phase planes (dots: starts of wingbeats){note}",
        setup.name
    );
    let (mut drawing, axes) = grid(&plots, columns, 1.05 * look.panel, &title, look);
    for (axes, plane) in axes.iter().zip(&planes) {
        for &k in &starts {
            let at = axes.at([plane.x.1[k], plane.y.1[k]]);
            drawing.dot(at, 1.5 * look.line, COLOURS[1]);
        }
    }
    Some(drawing)
}

/// Rows nearest to the starts of wingbeats.
fn starts(setup: &FlightSetup, history: &History) -> Vec<usize> {
    let Some(period) = setup.time.period else {
        return vec![0];
    };
    let beat = |t: f64| (t / period + 1e-6).floor();
    let time = history.column("time_s");
    let first = |k: &usize| *k == 0 || beat(time[*k]) > beat(time[*k - 1]);
    (0..time.len()).filter(first).collect()
}

fn plot(plane: &Plane, look: &Look) -> Plot {
    let points = plane.x.1.iter().zip(&plane.y.1).map(|(x, y)| [*x, *y]);
    let mut curve = plot::curve("", points.collect(), COLOURS[0], 0, look);
    curve.stroke.width *= 0.7;
    Plot {
        x_label: plane.x.0.clone(),
        y_label: plane.y.0.clone(),
        x: plot::at_least(plot::range(plane.x.1.iter().copied()), plane.least),
        y: plot::at_least(plot::range(plane.y.1.iter().copied()), plane.least),
        curves: vec![curve],
        ..Plot::default()
    }
}

/// Coordinates of the body that move, against their rates.
fn body(setup: &FlightSetup, history: &History) -> Vec<Plane> {
    let size = setup.animal.body_length().max(1e-6);
    let places = [
        ("forward", "x", 1.0),
        ("right", "y", 1.0),
        ("up", "z", -1.0),
    ];
    let places = places
        .into_iter()
        .filter_map(|(name, column, sign)| place(history, name, column, sign, size));
    let angles = [("pitch", "phi"), ("yaw", "theta"), ("roll", "psi")];
    let angles = angles
        .into_iter()
        .filter_map(|(name, column)| angle(history, name, column));
    places.chain(angles).collect()
}

/// Way along an axis against its rate, if it is not next to nothing of the `size` of the body [m].
fn place(history: &History, name: &str, column: &str, sign: f64, size: f64) -> Option<Plane> {
    let x = from_start(history.column(&format!("body_{column}_m")));
    let way = x.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let rate = history.column(&format!("body_{column}_rate_m_per_s"));
    let [(scale, unit), (rate_scale, rate_unit)] = [prefix(&x), prefix(rate)];
    let plane = || Plane {
        x: (format!("{name} [{unit}m]"), scaled(&x, sign / scale)),
        y: (
            format!("rate [{rate_unit}m/s]"),
            scaled(rate, sign / rate_scale),
        ),
        least: 0.0,
    };
    (way > 1e-6 * size).then(plane)
}

/// An angle against its rate, if it changes.
fn angle(history: &History, name: &str, column: &str) -> Option<Plane> {
    let degrees = |c: &str| scaled(history.column(c), 1f64.to_degrees());
    let angle = degrees(&format!("body_{column}_rad"));
    let ends = angle
        .iter()
        .fold([f64::MAX, f64::MIN], |[a, b], v| [a.min(*v), b.max(*v)]);
    let rate = degrees(&format!("body_{column}_rate_rad_per_s"));
    (ends[1] - ends[0] > 1e-4).then(|| Plane {
        x: (format!("{name} [deg]"), angle),
        y: ("rate [deg/s]".to_owned(), rate),
        least: 0.0,
    })
}

/// Stroke angle of the reference wing against its rate, and against its feathering angle.
fn wing(setup: &FlightSetup, history: &History) -> Vec<Plane> {
    let (Some((wing, _)), Some(number)) = (reference_wing(setup), reference_number(setup)) else {
        return vec![];
    };
    let found = wing_angles(setup, history, number);
    let prescribed = if found.joint.is_empty() {
        ""
    } else {
        "prescribed "
    };
    let feathering = format!("{prescribed}feathering ψ");
    let [phi, _, psi] = found.angles;
    let name = wing.replace('_', " ");
    let degrees = |values: &[f64]| scaled(values, 1f64.to_degrees());
    let plane = |(label, values): (String, Vec<f64>)| Plane {
        x: (format!("{name}: stroke φ [deg]"), degrees(&phi)),
        y: (format!("{label} [deg]"), degrees(&values)),
        least: MIN_ANGLE,
    };
    let all = std::iter::once((feathering, psi)).chain(found.joint);
    all.map(plane).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;
    use wingbeat_results::columns::Columns;

    /// The feathering of a wing that only bends is held.
    #[test]
    fn exact_axes_of_held_angles_do_not_show_rounding() {
        let setup = LoadedCase::find("bird-cruise", &[]).unwrap().setup;
        let columns = Columns::new(&setup, true).unwrap();
        let records = [0.0, 1e-17].map(|noise| {
            let mut record = columns.blank();
            record.wing_angles.iter_mut().for_each(|a| a[2] = noise);
            record
        });
        let history = History::of(&columns, &records);
        let planes = wing(&setup, &history);
        let look = crate::figures::Style::Screen.look();
        let [low, high] = plot(&planes[0], &look).y;
        assert!((high - low - MIN_ANGLE).abs() < 1e-9, "{low} {high}");
    }
}
