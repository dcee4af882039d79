//! The chord of a wing through a beat, with the force of the air: seen along the wing, which is
//! unrolled from its cylinder about the normal of the stroke plane. The dot is the leading edge.

use wingbeat_flight::FlightSetup;
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::Wing;

use crate::figures::axes::grid::one_scale;
use crate::figures::axes::plot::{self, Area, Axes, Plot};
use crate::figures::axes::ticks;
use crate::figures::axes::units::prefix;
use crate::figures::drawing::font;
use crate::figures::drawing::style::Look;
use crate::figures::drawing::{Anchor, COLOURS, Drawing, INK, Stroke};
use crate::figures::over_time::part::TimeWindow;
use crate::figures::over_time::strokes::{goes_down, reference_number, reference_wing, stroke};
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;
use wingbeat_results::poses::Poses;
use wingbeat_results::summary::down;

/// Chords drawn per half stroke.
const CHORDS: usize = 11;
/// Where along the wing the chord is taken.
const STATION: f64 = 0.6;

/// One chord: forward and up \[m\]; force forward and up \[N\].
#[derive(Clone, Copy, Debug)]
struct Chord {
    leading: [f64; 2],
    trailing: [f64; 2],
    force: [f64; 2],
    /// As [`level`].
    level: f64,
}

/// The figure of the last whole beat of this part; none for wings that do not flap.
pub(crate) fn lollipop(
    setup: &FlightSetup,
    history: &History,
    part: &TimeWindow,
    look: &Look,
) -> Option<Drawing> {
    let poses = Poses::new(&setup.animal, history.names())?;
    let (beat, when) = part.beat()?;
    let [down, up] = half_strokes(setup, history, beat)?;
    let chords = [down, up].map(|rows| {
        let chord = |k: &usize| chord(setup, history, &poses, *k);
        rows.iter().map(chord).collect::<Vec<Chord>>()
    });
    let when = when + &part.thinning();
    Some(draw(setup, &chords, &when, look))
}

/// Rows of downstroke and upstroke between these times \[wingbeats\], thinned.
fn half_strokes(
    setup: &FlightSetup,
    history: &History,
    [from, to]: [f64; 2],
) -> Option<[Vec<usize>; 2]> {
    let period = setup.time.period?;
    let time = history.column("time_s");
    let inside = |k: &usize| (from - 1e-6..=to + 1e-6).contains(&(time[*k] / period));
    let down = goes_down(&stroke(setup, history));
    let rows = |wanted: bool| {
        let all = (0..time.len() - 1).filter(inside);
        let all: Vec<usize> = all.filter(|k| down.get(*k) == Some(&wanted)).collect();
        let stride = all.len().div_ceil(CHORDS).max(1);
        all.into_iter().step_by(stride).collect::<Vec<usize>>()
    };
    let half_strokes = [rows(true), rows(false)];
    half_strokes
        .iter()
        .any(|h| h.len() > 1)
        .then_some(half_strokes)
}

/// The chord of the wing of reference in a row.
fn chord(setup: &FlightSetup, history: &History, poses: &Poses, k: usize) -> Chord {
    let names = history.names().iter();
    let row: Vec<f64> = names.map(|name| history.column(name)[k]).collect();
    let number = reference_number(setup).map_or(0, |w| w + 1);
    let wing = &setup.animal.wings[number - 1];
    let stroke =
        poses.pose(&row, 0).1 * DMat3::from_rotation_y(setup.stroke_plane_pitch(number - 1));
    let turned_to = stroke.transpose() * poses.pose(&row, number).1;
    let section = ChordOnPlane::of(wing, &poses.shape(&row, number - 1), turned_to);
    let name = &column_stems(&setup.animal)[number];
    let force = |c: usize| history.column(&format!("air_{name}_force_n{c}_newton"));
    let force = [1, 2, 3].map(|c| force(c).get(k).copied().unwrap_or(0.0));
    let force = section.flat(stroke.transpose() * DVec3::from_array(force));
    let level = level(stroke, down(setup));
    Chord {
        leading: turned(section.leading, level),
        trailing: turned(section.trailing, level),
        force: turned(force, level),
        level,
    }
}

/// The chord in the stroke plane, forward and upward of it, unrolled \[m\].
#[derive(Clone, Copy, Debug)]
struct ChordOnPlane {
    leading: [f64; 2],
    trailing: [f64; 2],
    /// Directions in the axes of the stroke plane (normal, right, forward).
    forward: DVec3,
    upward: DVec3,
}

impl ChordOnPlane {
    /// For the rotation of the wing, whose nodes are at `shape`, to the axes of the stroke plane.
    fn of(wing: &Wing, shape: &[DVec3], relative: DMat3) -> Self {
        let side = wing.side.sign();
        let column = (STATION * wing.mesh.cols as f64).round() as usize;
        let node = |i: usize| shape[wing.mesh.node(i, column)];
        let [leading, trailing] = [node(0), node(wing.mesh.rows)];
        let radius = 0.5 * side * (leading.y + trailing.y);
        // Where the span points: azimuth forward, elevation upward.
        let span = relative * DVec3::new(0.0, side, 0.0);
        let azimuth = span.z.atan2(side * span.y);
        let elevation = span.x.clamp(-1.0, 1.0).asin();
        let forward = DVec3::new(0.0, -side * azimuth.sin(), azimuth.cos());
        let upward = side * span.cross(forward);
        let edge = |p: DVec3| {
            let p = relative * DVec3::new(p.x, 0.0, p.z);
            [
                radius * azimuth + p.dot(forward),
                radius * elevation + p.dot(upward),
            ]
        };
        Self {
            leading: edge(leading),
            trailing: edge(trailing),
            forward,
            upward,
        }
    }

    fn flat(&self, v: DVec3) -> [f64; 2] {
        [v.dot(self.forward), v.dot(self.upward)]
    }
}

/// Angle by which the stroke plane's normal leans forward from the vertical.
fn level(stroke: DMat3, down: DVec3) -> f64 {
    let up = stroke.transpose() * -down;
    up.z.atan2(up.x)
}

/// Turns forward and up of the stroke plane so that up is against gravity.
fn turned([x, y]: [f64; 2], level: f64) -> [f64; 2] {
    let (s, c) = level.sin_cos();
    [x * c - y * s, y * c + x * s]
}

/// Lengths and forces on paper.
struct Scales {
    length: f64,
    unit: &'static str,
    /// Metres of arrow per newton.
    arrow: f64,
}

fn draw(setup: &FlightSetup, chords: &[Vec<Chord>; 2], when: &str, look: &Look) -> Drawing {
    let scales = scales(chords);
    let all = || chords.iter().flatten();
    let ends = |c: usize| {
        let all = all().flat_map(move |k| {
            let tip = 0.5 * (k.leading[c] + k.trailing[c]) + scales.arrow * k.force[c];
            [k.leading[c], k.trailing[c], tip]
        });
        plot::range(all.map(|v| v / scales.length))
    };
    let (mut x, mut y) = (ends(0), ends(1));
    let (areas, whole) = frames(&mut x, &mut y, look);
    let mut drawing = Drawing::new([look.width, whole]);
    let wing = reference_wing(setup).map_or(String::new(), |(w, _)| w.replace('_', " "));
    let title = format!(
        "{}: chord of {wing} and force of the air {when}",
        setup.name
    );
    plot::title(&mut drawing, &title, look);
    let leans = all().map(|c| c.level.sin().abs()).fold(0.0, f64::max);
    let (names, along) = words(leans);
    let are_beside = areas[0].top == areas[1].top;
    for (half, (name, area)) in names.iter().zip(areas).enumerate() {
        let along = format!("{along} [{}m]", scales.unit);
        let up = format!("up [{}m]", scales.unit);
        let [x_label, y_label] = match (are_beside, half) {
            (true, _) => [along, format!("{name}, {up}")],
            (false, 1) => [along, up],
            (false, _) => [String::new(), up],
        };
        let plot = Plot {
            x_label,
            y_label,
            x,
            y,
            ..Plot::default()
        };
        let axes = plot.draw(&mut drawing, area, look);
        if !are_beside {
            let middle = [area.left + 0.5 * area.width, area.top - 0.55 * look.font];
            drawing.text(middle, name, look.font, Anchor::Middle);
        }
        for chord in &chords[half] {
            draw_chord(&mut drawing, &axes, chord, &scales, look);
        }
        if are_beside == (half == 1) {
            let room = match are_beside {
                true => area.width - font::width(&plot.y_label, look.font),
                false => 0.5 * (area.width - font::width(name, look.font)),
            };
            key(
                &mut drawing,
                (&axes, room - look.font),
                setup,
                &scales,
                look,
            );
        }
    }
    drawing
}

/// Where the two half strokes are drawn in one scale, and the height of the whole: below each other, or beside
/// each other where that makes them larger.
fn frames(x: &mut [f64; 2], y: &mut [f64; 2], look: &Look) -> ([Area; 2], f64) {
    let left = 5.0 * look.font;
    let right = 1.6 * look.font;
    let most = 1.5 * look.panel;
    let width = |columns: f64| look.width / columns - left - right;
    let scale = |columns: f64| {
        let [across, upward] = [x[1] - x[0], y[1] - y[0]];
        f64::min(width(columns) / across, columns * most / upward)
    };
    let are_beside = scale(2.0) > scale(1.0);
    let columns = if are_beside { 2.0 } else { 1.0 };
    let width = width(columns);
    let height = one_scale(x, y, width, [0.5 * look.panel, columns * most]);
    let above = look.row() + 0.6 * look.font;
    let step = match are_beside {
        true => [look.width / columns, 0.0],
        false => [0.0, height + 0.5 * look.font + above],
    };
    let area = |half: f64| Area {
        left: left + half * step[0],
        top: look.head() + above + half * step[1],
        width,
        height,
    };
    let areas = [area(0.0), area(1.0)];
    (areas, areas[1].top + height + 3.1 * look.font)
}

/// Names of the half strokes and of the axis along, by how far the normal of the stroke plane leans from the
/// vertical (its sine): strokes that are level go along this axis, steep ones across it.
fn words(leans: f64) -> ([&'static str; 2], &'static str) {
    const STEEP: f64 = std::f64::consts::FRAC_1_SQRT_2;
    match leans < STEEP {
        true => (["downstroke →", "← upstroke"], "along the stroke, forward"),
        false => (["downstroke", "upstroke"], "across the stroke, forward"),
    }
}

/// The longest arrow is as long as two chords.
fn scales(chords: &[Vec<Chord>; 2]) -> Scales {
    let all = || chords.iter().flatten();
    let gap = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let longest = |f: &dyn Fn(&Chord) -> f64| all().map(f).fold(0.0, f64::max);
    let chord = longest(&|c| gap(c.leading, c.trailing));
    let force = longest(&|c| gap(c.force, [0.0; 2]));
    let way = longest(&|c| gap(c.leading, [0.0; 2]));
    let (length, unit) = prefix(&[way]);
    let arrow = if force > 0.0 {
        2.0 * chord / force
    } else {
        0.0
    };
    Scales {
        length,
        unit,
        arrow,
    }
}

fn draw_chord(to: &mut Drawing, axes: &Axes, chord: &Chord, scales: &Scales, look: &Look) {
    let at = |p: [f64; 2]| axes.at(p.map(|v| v / scales.length));
    let [leading, trailing] = [at(chord.leading), at(chord.trailing)];
    to.line(vec![leading, trailing], Stroke::solid(INK, 1.3 * look.line));
    to.dot(leading, 1.8 * look.line, INK);
    let middle = [0, 1].map(|c| 0.5 * (chord.leading[c] + chord.trailing[c]));
    let tip = [0, 1].map(|c| middle[c] + scales.arrow * chord.force[c]);
    let stroke = Stroke::solid(COLOURS[1], look.line);
    to.arrow(at(middle), at(tip), stroke);
}

/// Lengths of the arrow of known force, the first that has room \[heights of letters\].
const KEYS: [f64; 5] = [6.0, 4.0, 2.5, 1.5, 1.0];

/// An arrow of known force above the frame, on the right, in so much `room` \[points\].
fn key(
    to: &mut Drawing,
    (axes, room): (&Axes, f64),
    setup: &FlightSetup,
    scales: &Scales,
    look: &Look,
) {
    if scales.arrow == 0.0 {
        return;
    }
    let weight = setup.animal.mass() * setup.gravity.length();
    let points = axes.at([1.0, 0.0])[0] - axes.at([0.0, 0.0])[0];
    let per_newton = points * scales.arrow / scales.length;
    let gap = 0.6 * look.font;
    let known = |most: f64| {
        let (force, text) = known_force(most * look.font / per_newton, weight);
        let width = font::width(&text, look.font);
        (force * per_newton, text, width)
    };
    let fits = |(length, _, width): &(f64, String, f64)| length + gap + width <= room;
    let found = KEYS.map(known).into_iter().find(fits);
    let (length, text, width) = found.unwrap_or_else(|| known(KEYS[KEYS.len() - 1]));
    let y = axes.area.top - 0.55 * look.font;
    let right = axes.area.left + axes.area.width;
    to.text([right, y], &text, look.font, Anchor::End);
    let end = right - width - gap;
    let start = end - length;
    let middle = y - 0.35 * look.font;
    let stroke = Stroke::solid(COLOURS[1], look.line);
    to.arrow([start, middle], [end, middle], stroke);
}

/// The largest force of one digit that is not above `most` \[N\], and its words: in weights, where there is one.
fn known_force(most: f64, weight: f64) -> (f64, String) {
    let unit = if weight > 0.0 { weight } else { 1.0 };
    let power = 10f64.powf((most / unit).log10().floor());
    let nice = [5.0, 2.0, 1.0].map(|m| m * power);
    let nice = nice.into_iter().find(|n| n * unit <= most).unwrap_or(power);
    let text = match weight > 0.0 {
        true => format!("{} × weight", ticks::short(nice)),
        false => {
            let (scale, prefix) = prefix(&[nice]);
            format!("{} {prefix}N", ticks::short(nice / scale))
        }
    };
    (nice * unit, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_case::LoadedCase;
    use wingbeat_math::RotationLaw;

    /// Stroke, deviation and feathering angle are seen as they are: place along and upward of the
    /// stroke plane, and tilt of the chord from the vertical; alike for both wings.
    #[test]
    fn exact_chords_stand_at_the_prescribed_angles() {
        let case = LoadedCase::find("fruit-fly-blade", &[]).unwrap();
        for (wing, t) in [(0, 1e-3), (1, 1e-3), (1, 3.2e-3), (1, 1.1e-2)] {
            let wing = &case.setup.animal.wings[wing];
            let side = wing.side.sign();
            let [phi, theta, psi] = wing.motion.angles(t).map(|a| a[0]);
            let eta = DMat3::from_rotation_y(wing.motion.stroke_plane_pitch);
            let relative = eta.transpose() * wing.motion.at(t).c;
            let section = ChordOnPlane::of(wing, &wing.mesh.nodes, relative);
            let chord = [0, 1].map(|c| section.leading[c] - section.trailing[c]);
            let length = chord[0].hypot(chord[1]);
            assert!((chord[0] + length * psi.sin()).abs() < 1e-12);
            assert!((chord[1] - length * psi.cos()).abs() < 1e-12);
            let column = (STATION * wing.mesh.cols as f64).round() as usize;
            let radius = wing.mesh.nodes[wing.mesh.node(0, column)].y.abs();
            // The hinge axis lies at a quarter of the chord.
            let at = [0, 1].map(|c| 0.75 * section.leading[c] + 0.25 * section.trailing[c]);
            assert!((at[0] - radius * side * phi).abs() < 1e-9, "{at:?}");
            assert!((at[1] + radius * side * theta).abs() < 1e-9, "{at:?}");
        }
    }

    /// Level strokes stand below each other, as long as the page is wide, steep ones side by side.
    #[test]
    fn exact_half_strokes_stand_where_they_are_larger() {
        let look = crate::figures::drawing::style::Style::Screen.look();
        let drawn = |mut x: [f64; 2], mut y: [f64; 2]| {
            let ([a, b], _) = frames(&mut x, &mut y, &look);
            (a.top == b.top, a.width / (x[1] - x[0]))
        };
        let (beside, level) = drawn([-3.0, 2.0], [-0.6, 1.8]);
        assert!(!beside && level > 0.7 * look.width / 5.0, "{level}");
        let (beside, steep) = drawn([-0.6, 1.8], [-3.0, 2.0]);
        assert!(beside && steep > 0.4 * look.width / 5.0, "{steep}");
    }

    #[test]
    fn exact_known_forces_are_round() {
        assert_eq!(known_force(7.3e-3, 1e-3), (5e-3, "5 × weight".to_owned()));
        assert_eq!(known_force(2.1e-4, 1e-3).1, "0.2 × weight");
        assert_eq!(known_force(3e10, 1e-3).1, "2·10¹³ × weight");
        assert_eq!(known_force(1.5e-6, 0.0), (1e-6, "1 µN".to_owned()));
    }

    #[test]
    fn exact_up_is_against_gravity() {
        // A stroke plane leaning forward by 30 deg: what points along its normal leans forward.
        let stroke = DMat3::from_rotation_y(60f64.to_radians());
        let level = level(stroke, DVec3::Z);
        let normal = turned([0.0, 1.0], level);
        let n = stroke * DVec3::X; // N: forward, right, down
        assert!((normal[0] - n.x).abs() < 1e-12 && (normal[1] + n.z).abs() < 1e-12);
        assert!(words(level.sin().abs()).1.starts_with("along"));
        // A stroke up and down: forward is along the normal of its plane.
        let level = super::level(DMat3::IDENTITY, DVec3::Z);
        let forward = turned([0.0, 1.0], level);
        assert!((forward[0] - 1.0).abs() < 1e-12 && forward[1].abs() < 1e-12);
        assert!(words(level.sin().abs()).1.starts_with("across"));
    }
}
