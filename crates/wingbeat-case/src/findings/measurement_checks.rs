//! Measurements in a case that look like slips: of units, turns, lost frames, the order of points.

use wingbeat_math::{DVec3, median, to_digits};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{Planform, Wing};

use crate::findings::fitted::{DIGITS, FittedTable};
use crate::loaded::LoadedCase;
use crate::raw::{AngleCase, BodyCase, OutlineCase, PlanformCase, SurfaceCase, WingMotionCase};

/// Angles of a table that are all below this could be radians \[deg\].
const HALF_A_TURN: f64 = 3.2;

/// Swings of feathering to either side in radians, 11 to 100 deg, which no wing has in degrees: it would be
/// held still.
const SWINGS: std::ops::Range<f64> = 0.2..1.75;

/// Swings of stroke beside larger angles that could be radians, 34 to 100 deg: wings that feather about an axis
/// held still have smaller ones in degrees, of their bearings.
const STROKES: std::ops::Range<f64> = 0.6..1.75;

/// A sample that stands this far from both neighbours, alone in its value, was hardly measured \[deg\].
const LEAP_DEG: f64 = 10.0;

/// What a fit leaves of one phase of a surface counts beside the others from so many times their root mean
/// square on, and beside the wing from this part of its length on.
const OUTLIER: f64 = 5.0;
const SMALL: f64 = 0.02;

/// Part by which `least_chord` may change the second moment of an outline, and a chord that changes hardly any.
const WIDENED: f64 = 0.05;
const NARROW: f64 = 0.02;

impl LoadedCase {
    /// What of the measurements in the case is to be doubted, in sentences.
    pub fn doubtful_measurements(&self) -> Vec<String> {
        let fits = self.fitted_tables();
        let mut doubts: Vec<String> = fits.iter().filter_map(FittedTable::doubt).collect();
        doubts.extend(shares(&self.raw.body));
        for (name, wing) in &self.raw.wing {
            let tables = wing.motion.as_ref().map(tables).unwrap_or_default();
            let key = |angle: &str| format!("wing.{name}.motion.{angle}.table");
            let zero = |angle: &str| self.zero_of(&key(angle));
            doubts.extend(radians(name, &tables, zero));
            for (angle, rows) in tables {
                let key = key(angle);
                doubts.extend(turn(&key, rows));
                doubts.extend(lost(&key, rows, self.zero_of(&key)));
            }
            if let Some(PlanformCase::Outline(outline)) = &wing.planform {
                doubts.extend(widened(name, outline));
            }
            let surface = wing.deformation.as_ref().and_then(|d| d.surface.as_ref());
            let flown = self.setup.animal.wings.iter().find(|w| w.name == *name);
            if let (Some(surface), Some(wing)) = (surface, flown) {
                let key = format!("wing.{name}.deformation.surface");
                let size = extents(&key, surface, wing, self.raw.animal.scale);
                doubts.extend(size.or_else(|| order(&key, surface, wing)));
                doubts.extend(stray_phase(&key, surface));
            }
        }
        doubts
    }

    /// The angle that 0 in the table at `key` stands for \[deg\].
    fn zero_of(&self, key: &str) -> f64 {
        self.number_at(&format!("{key}.offset_deg")).unwrap_or(0.0)
    }
}

fn tables(motion: &WingMotionCase) -> Vec<(&'static str, &[[f64; 2]])> {
    let angles = motion.angles().filter_map(|(angle, case)| match case {
        AngleCase::Table(table) => Some((angle, table.rows_deg.as_deref()?)),
        _ => None,
    });
    angles.collect()
}

/// Tables whose angles are all small, counted from what their 0 stands for, or one of stroke or feathering
/// beside others that are not.
fn radians(wing: &str, tables: &[(&str, &[[f64; 2]])], zero: impl Fn(&str) -> f64) -> Vec<String> {
    const CONVENTION: &str = "are they radians? Tables are in degrees, and columns of files in radians where their name says so";
    let largest = |(angle, rows): &(&str, &[[f64; 2]])| {
        let from = zero(angle);
        rows.iter()
            .map(|row| (row[1] - from).abs())
            .fold(0.0, f64::max)
    };
    let most = tables.iter().map(largest).fold(0.0, f64::max);
    let has_stroke = tables.iter().any(|t| t.0 == "phi");
    if has_stroke && (SWINGS.start..HALF_A_TURN).contains(&most) {
        return vec![format!(
            "all angles in the tables of wing.{wing}.motion are below {HALF_A_TURN} deg: {CONVENTION} (phi_rad)"
        )];
    }
    let is_doubtful = |table: &&(&str, &[[f64; 2]])| {
        let swings = match table.0 {
            "phi" => STROKES,
            "psi" => SWINGS,
            _ => return false,
        };
        largest(table) < HALF_A_TURN && swings.contains(&swing(table.1))
    };
    let say = |table: &(&str, &[[f64; 2]])| {
        let (angle, swing) = (table.0, swing(table.1));
        format!(
            "wing.{wing}.motion.{angle}.table swings by {swing:.2} deg to either side: {CONVENTION} ({angle}_rad)"
        )
    };
    tables.iter().filter(is_doubtful).map(say).collect()
}

/// Half of the range of the angles of a table \[deg\].
fn swing(rows: &[[f64; 2]]) -> f64 {
    let angles = rows.iter().map(|row| row[1]);
    let range = angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], q| {
        [low.min(q), high.max(q)]
    });
    0.5 * (range[1] - range[0])
}

/// A phase or an angle as it is said: digits beyond are roundings of a convention that was applied.
fn shown(x: f64) -> f64 {
    to_digits(x, DIGITS)
}

/// Neighbours that differ by most of a turn.
fn turn(key: &str, rows: &[[f64; 2]]) -> Option<String> {
    let [a, b] = rows.windows(2).find_map(|w| match w {
        &[a, b] if (b[1] - a[1]).abs() > 180.0 => Some([a, b]),
        _ => None,
    })?;
    Some(format!(
        "{key}: {} and {} deg at phases {} and {} are neighbours: angles were wrapped there; let them go on beyond 180 deg",
        shown(a[1]),
        shown(b[1]),
        shown(a[0]),
        shown(b[0])
    ))
}

/// Rows that held zero, which stands for the angle `zero`, in the midst of other angles, as frames do in which
/// nothing was found.
fn lost(key: &str, rows: &[[f64; 2]], zero: f64) -> Option<String> {
    let mut from = 1;
    while from + 1 < rows.len() {
        let length = rows[from..].iter().take_while(|r| r[1] == zero).count();
        let (before, after) = (rows[from - 1][1], rows.get(from + length));
        if let Some(after) = after.filter(|_| length > 0)
            && (before - zero).abs().min((after[1] - zero).abs()) > LEAP_DEG
            && !(length == 1 && passes(rows, from, zero))
        {
            let [first, last] = [rows[from][0], rows[from + length - 1][0]];
            return Some(format!(
                "{key}: exactly {} from phase {} to {}, between {} and {} deg: lost frames? Leave such rows out",
                shown(zero),
                shown(first),
                shown(last),
                shown(before),
                shown(after[1])
            ));
        }
        from += length.max(1);
    }
    None
}

/// How many times as much as the body its parts may weigh, or as little, before one of both is in another unit.
const SHARES: f64 = 100.0;

/// What is said of parts that weigh much more or less together than the body, among which its mass is shared
/// out.
fn shares(body: &BodyCase) -> Option<String> {
    let total = body.mass_kg?;
    let parts: Option<Vec<f64>> = body.part.values().map(|p| p.mass_kg).collect();
    let parts: f64 = parts?.iter().sum();
    let ratio = parts / total;
    let is_near = (1.0 / SHARES..=SHARES).contains(&ratio);
    (ratio > 0.0 && !is_near).then(|| {
        format!(
            "body.part: the parts weigh {parts:.3e} kg together, {ratio:.1e} times body.mass_kg = {total:.3e} kg; their masses only share out that of the body: are all in kg? Or leave body.mass_kg out"
        )
    })
}

/// Whether a course passes through `zero` in row `k`: the rows beside it lie on either side, or the cubic
/// through two rows on each side comes as near as neighbours need not stand away.
fn passes(rows: &[[f64; 2]], k: usize, zero: f64) -> bool {
    let crosses = (rows[k - 1][1] - zero) * (rows[k + 1][1] - zero) < 0.0;
    let beside = || {
        Some([
            rows.get(k.checked_sub(2)?)?,
            &rows[k - 1],
            &rows[k + 1],
            rows.get(k + 2)?,
        ])
    };
    crosses || beside().is_some_and(|rows4| (cubic(rows4, rows[k][0]) - zero).abs() < LEAP_DEG)
}

/// The cubic through four rows at the phase `x`, by Lagrange's polynomials.
fn cubic(rows: [&[f64; 2]; 4], x: f64) -> f64 {
    let part = |j: usize| {
        let others = (0..4).filter(|i| *i != j);
        others.fold(rows[j][1], |p, i| {
            p * (x - rows[i][0]) / (rows[j][0] - rows[i][0])
        })
    };
    (0..4).map(part).sum()
}

/// A measured surface may be longer or wider than the wing at rest by this factor, or smaller.
const APART: f64 = 2.0;

/// What lengths in other units are of the same in metres.
const UNITS: [(f64, &str); 4] = [
    (1e3, ": are they in millimetres? Points are in metres"),
    (1e2, ": are they in centimetres? Points are in metres"),
    (1e6, ": are they in micrometres? Points are in metres"),
    (1e-3, ": were they divided by 1000 once too often?"),
];

/// A surface much larger or smaller than the wing at rest, or far from its hinge: of other units, or from
/// another origin. Its points are for an animal of this `scale`.
fn extents(key: &str, surface: &SurfaceCase, wing: &Wing, scale: f64) -> Option<String> {
    let sizes = surface.nodes_m.iter().map(|rows| size(rows));
    let sizes: Vec<[f64; 3]> = sizes.collect::<Option<_>>()?;
    let middle = |k: usize| scale * median(sizes.iter().map(|s| s[k]).collect()).unwrap_or(0.0);
    let mesh = &wing.mesh;
    let row = |i| (0..=mesh.cols).map(move |j| mesh.nodes[mesh.node(i, j)].to_array());
    let at_rest: Vec<Vec<[f64; 3]>> = (0..=mesh.rows).map(|i| row(i).collect()).collect();
    let [length, chord, _] = size(&at_rest)?;
    let reach = mesh.nodes.iter().fold(0.0_f64, |m, x| m.max(x.length()));
    for (k, what, own) in [(0, "from root to tip", length), (1, "in chord", chord)] {
        let (measured, ratio) = (middle(k), middle(k) / own);
        if !(1.0 / APART..=APART).contains(&ratio) {
            let near = |u: &&(f64, &str)| (1.0 / APART..=APART).contains(&(ratio / u.0));
            let unit = UNITS.iter().find(near);
            let unit = unit.map_or(": check their unit, which is metres", |u| u.1);
            return Some(format!(
                "{key}.nodes_m: the points measure {measured:.3e} m {what}, and the wing at rest {own:.3e} m{unit}"
            ));
        }
    }
    let away = middle(2);
    (away > reach).then(|| {
        format!(
            "{key}.nodes_m: the root is {away:.3e} m from the hinge, and the wing reaches {reach:.3e} m from it: points are counted from the hinge"
        )
    })
}

/// Length and largest chord of a surface, and the least distance of its root from the hinge \[m\].
fn size(rows: &[Vec<[f64; 3]>]) -> Option<[f64; 3]> {
    let at = |x: &[f64; 3]| DVec3::from_array(*x);
    let (leading, trailing) = (rows.first()?, rows.last()?);
    let mut of = [0.0, 0.0, f64::INFINITY];
    for row in rows {
        let (root, tip) = (at(row.first()?), at(row.last()?));
        of[0] = f64::max(of[0], (tip - root).length());
        of[2] = f64::min(of[2], root.length());
    }
    for (a, b) in leading.iter().zip(trailing) {
        of[1] = f64::max(of[1], (at(a) - at(b)).length());
    }
    Some(of)
}

/// A surface whose points run the other way than those of the wing at rest.
fn order(key: &str, surface: &SurfaceCase, wing: &Wing) -> Option<String> {
    let mut span = 0.0;
    let mut aside = 0.0;
    let mut chord = 0.0;
    for rows in &surface.nodes_m {
        let (leading, trailing) = (rows.first()?, rows.last()?);
        for row in rows {
            span += row.last()?[1] - row.first()?[1];
            aside += row.iter().map(|x| x[1]).sum::<f64>();
        }
        let along = leading.iter().zip(trailing).map(|(a, b)| a[0] - b[0]);
        chord += along.sum::<f64>();
    }
    let mesh = &wing.mesh;
    let ends = |j| mesh.nodes[mesh.node(0, j)].x - mesh.nodes[mesh.node(mesh.rows, j)].x;
    let at_rest: f64 = (0..=mesh.cols).map(ends).sum();
    let problem = if aside < 0.0 {
        "its points lie inboard of the hinge: distances along axis 2 are positive outboard, on wings of either side"
    } else if span < 0.0 {
        "its rows run from the tip to the root: points go from root to tip"
    } else if chord * at_rest < 0.0 {
        "its first row is at the trailing edge: rows go from the leading to the trailing edge"
    } else {
        return None;
    };
    Some(format!("{key}: {problem}"))
}

/// An outline that is much narrower somewhere than the wing that is flown.
fn widened(wing: &str, outline: &OutlineCase) -> Option<String> {
    let [as_flown, narrow] = [outline.least_chord, f64::MIN_POSITIVE].map(|l| moments(outline, l));
    let (as_flown, narrow) = (as_flown?, narrow?);
    let [area, second] = [0, 2].map(|k| as_flown[k] / narrow[k] - 1.0);
    (second > WIDENED && outline.least_chord > NARROW).then(|| {
        format!(
            "wing.{wing}.planform.outline: least_chord = {} widens it where it is narrow: the wing that is flown has {:.1} % more area and {:.1} % more second moment about the hinge; least_chord = {NARROW} keeps it",
            outline.least_chord,
            100.0 * area,
            100.0 * second
        )
    })
}

/// Moments of the area of an outline about the hinge, of order 0, 1 and 2, its chord `least` of the largest at least.
fn moments(outline: &OutlineCase, least: f64) -> Option<[f64; 3]> {
    const STRIPS: usize = 2000;
    let edges = Planform::outline(
        outline.leading_m.as_deref()?,
        outline.trailing_m.as_deref()?,
        least,
    )
    .edges()
    .ok()?;
    let width = (edges.tip - edges.root) / STRIPS as f64;
    let mut moments = [0.0; 3];
    for k in 0..STRIPS {
        let r = edges.root + (k as f64 + 0.5) * width;
        let [leading, trailing] = edges.at(r);
        let area = (leading - trailing) * width;
        for (power, moment) in (0..).zip(&mut moments) {
            *moment += area * r.powi(power);
        }
    }
    Some(moments)
}

/// The phase of a surface that the series of its points pass by.
fn stray_phase(key: &str, surface: &SurfaceCase) -> Option<String> {
    let squares = squares_left(surface)?;
    let (worst, most) = (squares.iter().copied().enumerate()).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let others = (squares.iter().sum::<f64>() - most) / (squares.len() - 1) as f64;
    let points = surface.nodes_m.iter().flatten().flatten();
    let length = points.map(|x| x[1].abs()).fold(0.0, f64::max);
    let is_stray = most.sqrt() > OUTLIER * others.sqrt() || others.sqrt() > SMALL * length;
    (is_stray && most.sqrt() > SMALL * length).then(|| {
        format!(
            "{key}: {} harmonics leave {:.3e} m (rms) of the points at phase {}, and {:.3e} m of those at the others: take out phases that are no measurements, or fit more harmonics",
            surface.harmonics,
            most.sqrt(),
            shown(surface.phases[worst]),
            others.sqrt()
        )
    })
}

/// Mean square of what is left of all points at each phase [m2].
fn squares_left(surface: &SurfaceCase) -> Option<Vec<f64>> {
    let mut squares = vec![0.0; surface.phases.len()];
    let first = surface.nodes_m.first()?;
    let count = first.iter().map(Vec::len).sum::<usize>() as f64;
    for (i, row) in first.iter().enumerate() {
        for (j, k) in (0..row.len()).flat_map(|j| (0..3).map(move |k| (j, k))) {
            let values = surface.nodes_m.iter().map(|rows| rows[i][j][k]);
            let samples: Vec<(f64, f64)> = surface.phases.iter().copied().zip(values).collect();
            let (_, left) = Fourier::fitted("", &samples, surface.harmonics).ok()?;
            for (square, x) in squares.iter_mut().zip(left) {
                *square += x * x / count;
            }
        }
    }
    Some(squares)
}
