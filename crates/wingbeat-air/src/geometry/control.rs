//! Control points: where on its ring a panel lets no air through.
//!
//! Along the chord vortices lie at a quarter and control points at three quarters of each panel: then circulation and
//! moment of a flat plate in plane flow are exact on any panels [James 1972, Comput. Methods Appl. Mech. Eng. 1:59].
//! A ring from a quarter of one panel to a quarter of the next has its middle there where both are as long as each
//! other. With panels of lengths d and e, the rings aft by a part s, the point lies
//! `(d / 2) / ((1 - s) d + s e)` along the ring. The slope of the surface there follows from those of two rings in a
//! row.
//!
//! Across columns of cosine spacing the point is that midway in the angle, as in lattices whose spanwise sums are
//! exact for even spacing of the angle [Lan 1974, J. Aircraft 11:518]: then rings reach to the tips. The middles of
//! columns of unequal width make an error of first order, 2 to 5 % of the lift on 8 to 24 columns.
//!
//! Along the chord it is so, too, where neither leading nor trailing edges shed: circulation is then as large
//! at both edges as at those of the span, and on rows of cosine spacing that reach to them the rule of Lobatto
//! and Chebyshev has the added mass of a flat plate in plane flow exact [Theocaris & Ioakimidis 1977, Q. Appl.
//! Math. 35:173]. In the middles of rings inset by a quarter panel it is 13, 8 and 5 % high on 6, 12 and 24
//! rows.
//!
//! Where panels are equal the point is the mean of the corners, the normal along the cross product of the diagonals.

use crate::geometry::corners::{corner_weights, mean_corner, repeated, vector_area};
use crate::geometry::strips::Strip;
use crate::geometry::surface::Surface;
use crate::geometry::topology::Topology;
use crate::settings::AirSettings;
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// Lengths that differ by less, relative to each other, are equal.
const EQUAL: f64 = 1e-9;

/// Control points of all panels.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Controls {
    /// None where the point is the mean of the corners.
    of_panel: Vec<Option<Control>>,
}

/// The control point of a panel that lies elsewhere.
#[derive(Clone, Debug, PartialEq)]
struct Control {
    /// Part of the way along the ring, from the front \[1\].
    along: f64,
    /// Weights of the corners in it \[1\].
    weights: [f64; 4],
    /// Weights of nodes in the tangents at it along chord and span, of which the cross product is along the normal \[1\].
    tangents: [Vec<(usize, f64)>; 2],
}

impl Controls {
    /// Of rings that lie aft by [`AirSettings::ring_shift`]; lengths along the chord are those at rest.
    pub fn new(
        topology: &Topology,
        surfaces: &[Surface],
        strips: &[Strip],
        settings: &AirSettings,
    ) -> Self {
        let mut new = Self {
            of_panel: vec![None; topology.panels.len()],
        };
        let surface = |strip: &Strip| topology.panel_surface[strip.panels[0]];
        for columns in strips.chunk_by(|a, b| surface(a) == surface(b)) {
            let s = surface(&columns[0]);
            let on_surface = (&surfaces[s], topology.first_node[s]);
            let to_the_edges = has_cosine_rows(columns.iter(), on_surface, settings);
            for (j, strip) in columns.iter().enumerate() {
                let across = match has_cosine_columns(&surfaces[s], columns.len(), settings) {
                    true => midway(j, columns.len()),
                    false => 0.5,
                };
                let places = match lengths(strip, on_surface) {
                    None => vec![MIDDLE; strip.panels.len()],
                    Some(d) if to_the_edges => (0..d.len()).map(|k| place_midway(&d, k)).collect(),
                    Some(d) => {
                        let shift = settings.ring_shift();
                        (0..d.len()).map(|k| place(&d, k, shift)).collect()
                    }
                };
                new.add(topology, strip, (&places, across));
            }
        }
        new
    }

    /// Those of a strip, at these places along the rings and this part of the way across.
    fn add(&mut self, topology: &Topology, strip: &Strip, (places, across): (&[[f64; 3]], f64)) {
        for (k, &p) in strip.panels.iter().enumerate() {
            let [along, lean, ratio] = places[k];
            let is_middle = along == 0.5 && across == 0.5;
            if is_middle || repeated(&topology.panels[p]).is_some() {
                continue;
            }
            let sides = [strip.sides[k], strip.sides[k + 1]];
            let parts = [[1.0 - along, along], [1.0 - across, across]];
            let weight = |n: &usize| {
                let row = usize::from(sides[1].contains(n));
                let column = usize::from(sides[row][1] == *n);
                parts[0][row] * parts[1][column]
            };
            let chord = |k: usize, part: f64| {
                let [[a, b], [c, d]] = [strip.sides[k], strip.sides[k + 1]];
                let [one, other] = parts[1].map(|x| x * part);
                [(a, -one), (b, -other), (c, one), (d, other)]
            };
            let mut tangent = chord(k, 1.0 - lean).to_vec();
            if lean != 0.0 {
                tangent.extend(chord(neighbour(k, strip.panels.len()), lean * ratio));
            }
            let span =
                (0..2).flat_map(|r| [(sides[r][0], -parts[0][r]), (sides[r][1], parts[0][r])]);
            let mut tangents = [tangent, span.collect()];
            // As the cross product of the diagonals is.
            if winds_otherwise(&topology.panels[p], sides) {
                tangents[1].iter_mut().for_each(|(_, w)| *w = -*w);
            }
            self.of_panel[p] = Some(Control {
                along,
                weights: topology.panels[p].each_ref().map(weight),
                tangents,
            });
        }
    }

    /// Part of the way along its ring, from the front, at which the control point of panel `p` lies \[1\].
    pub fn along(&self, p: usize) -> f64 {
        self.of_panel[p].as_ref().map_or(0.5, |c| c.along)
    }

    /// Weights of the `corners` of panel `p` in its control point \[1\].
    pub fn weights(&self, p: usize, corners: &[usize; 4]) -> [f64; 4] {
        match &self.of_panel[p] {
            Some(control) => control.weights,
            None => corner_weights(corners),
        }
    }

    /// Control point of panel `p`, or its velocity, from those of its corners `x`.
    pub fn point(&self, p: usize, corners: &[usize; 4], x: &[DVec3; 4]) -> DVec3 {
        match &self.of_panel[p] {
            Some(control) => (0..4).map(|k| control.weights[k] * x[k]).sum(),
            None => mean_corner(corners, x),
        }
    }

    /// Way from the control point of panel `p` to the middle of its ring, none where both are one; corners at `x`.
    pub fn to_middle(&self, p: usize, x: impl Fn(usize) -> DVec3) -> Option<DVec3> {
        let control = self.of_panel[p].as_ref()?;
        Some((0..4).map(|k| (0.25 - control.weights[k]) * x(k)).sum())
    }

    /// Unit normal at the control point of panel `p` with these corners, all nodes of the rings being at `nodes`;
    /// none without area.
    pub fn normal(&self, p: usize, corners: &[usize; 4], nodes: &[DVec3]) -> Option<DVec3> {
        let [chord, span] = match &self.of_panel[p] {
            None => return vector_area(&corners.map(|n| nodes[n])).try_normalize(),
            Some(control) => tangents(&control.tangents, nodes),
        };
        chord.cross(span).try_normalize()
    }

    /// How the normal velocity at the control point of panel `p` changes with nodes of the rings: (node, by its velocity
    /// \[1\], by its place \[1/s\]). Corners and all nodes of the rings are given, the unit normal there, and the part
    /// `slip` along the surface of its velocity less that of the air [m/s].
    pub fn wash(
        &self,
        p: usize,
        (corners, nodes): (&[usize; 4], &[DVec3]),
        [normal, slip]: [DVec3; 2],
        mut see: impl FnMut(usize, [DVec3; 2]),
    ) {
        let weights = self.weights(p, corners);
        let Some(control) = &self.of_panel[p] else {
            let [a, b, c, d] = corners.map(|n| nodes[n]);
            let (along, across) = (c - a, d - b);
            let tilt = slip / along.cross(across).length();
            let by_ends = [across.cross(tilt), tilt.cross(along)];
            for (k, &n) in corners.iter().enumerate() {
                let sign = if k < 2 { -1.0 } else { 1.0 };
                see(n, [weights[k] * normal, sign * by_ends[k % 2]]);
            }
            return;
        };
        for (&n, weight) in corners.iter().zip(weights) {
            see(n, [weight * normal, DVec3::ZERO]);
        }
        let [chord, span] = tangents(&control.tangents, nodes);
        let tilt = slip / chord.cross(span).length();
        let parts = [span.cross(tilt), tilt.cross(chord)];
        for (list, part) in control.tangents.iter().zip(parts) {
            (list.iter()).for_each(|&(n, weight)| see(n, [DVec3::ZERO, weight * part]));
        }
    }
}

/// What two lists of weighted nodes give.
fn tangents(of: &[Vec<(usize, f64)>; 2], nodes: &[DVec3]) -> [DVec3; 2] {
    of.each_ref()
        .map(|list| list.iter().map(|&(n, weight)| weight * nodes[n]).sum())
}

/// Part along the ring, weight of the next ring's slope, ratio of lengths: those of a point in the middle.
const MIDDLE: [f64; 3] = [0.5, 0.0, 1.0];

/// The ring from whose slope and that of ring `k` the slope at the control point follows.
fn neighbour(k: usize, count: usize) -> usize {
    match k + 1 < count {
        true => k + 1,
        false => k - 1,
    }
}

/// Part of the way along ring `k` at which its control point lies, weight of the slope of its neighbour in that of
/// the surface there, and length of the ring over that of the neighbour \[1\]; panels have the lengths `d`.
fn place(d: &[f64], k: usize, shift: f64) -> [f64; 3] {
    let last = d[d.len() - 1];
    let length = |k: usize| d.get(k).copied().unwrap_or(last);
    let ring = |k: usize| (1.0 - shift) * length(k) + shift * length(k + 1);
    let along = 0.5 * length(k) / ring(k);
    if (along - 0.5).abs() < EQUAL || d.len() < 2 {
        return MIDDLE;
    }
    // The slope of a ring is the mean of those of two panels by the parts of their lengths in it, each at its middle.
    let front = |k: usize| (0..k).map(length).sum::<f64>();
    let middle = |k: usize| front(k) + 0.5 * length(k);
    let slope_at = |k: usize| {
        let parts = [(1.0 - shift) * length(k), shift * length(k + 1)];
        (parts[0] * middle(k) + parts[1] * middle(k + 1)) / ring(k)
    };
    let n = neighbour(k, d.len());
    let point = middle(k) + shift * length(k);
    let lean = (point - slope_at(k)) / (slope_at(n) - slope_at(k));
    [along, lean, ring(k) / ring(n)]
}

/// The same where control points are midway in the angle along the chord and rings on the edges of panels.
fn place_midway(d: &[f64], k: usize) -> [f64; 3] {
    let (n, along) = (neighbour(k, d.len()), midway(k, d.len()));
    let apart = if n > k { 0.5 } else { -0.5 } * (d[k] + d[n]);
    [along, (along - 0.5) * d[k] / apart, d[k] / d[n]]
}

/// Whether rings reach to the leading and trailing edges, which shed nothing: where all strips of a surface
/// have more than two rows, of cosine spacing.
pub(super) fn has_cosine_rows<'a>(
    mut strips: impl Iterator<Item = &'a Strip>,
    on_surface: (&Surface, usize),
    settings: &AirSettings,
) -> bool {
    let sheds = settings.shedding.trailing || settings.shedding.leading;
    let is_cosine = |d: Vec<f64>| {
        let (n, all) = (d.len(), d.iter().sum::<f64>());
        let edge = |k: usize| 0.5 * (1.0 - (PI * k as f64 / n as f64).cos());
        let is_here = |k: usize| (d[k] / all - (edge(k + 1) - edge(k))).abs() < EQUAL;
        n > 2 && (0..n).all(is_here)
    };
    settings.inset > 0.0
        && !sheds
        && strips.all(|strip| lengths(strip, on_surface).is_some_and(is_cosine))
}

/// Lengths of the panels of a strip along its chord at rest [m]; none if they are not known. With the surface
/// goes the number of its first node.
fn lengths(strip: &Strip, (surface, first_node): (&Surface, usize)) -> Option<Vec<f64>> {
    let rest = surface.rest.as_ref()?;
    let middle = |&[a, b]: &[usize; 2]| rest[a - first_node].midpoint(rest[b - first_node]);
    let places: Vec<DVec3> = strip.sides.iter().map(middle).collect();
    let chord = (places[places.len() - 1] - places[0]).try_normalize()?;
    let lengths: Vec<f64> = (places.windows(2).map(|w| (w[1] - w[0]).dot(chord))).collect();
    lengths.iter().all(|d| *d > 0.0).then_some(lengths)
}

/// Whether control points lie midway in the angle across the columns of a surface, of which there are `count`: up to
/// two of cosine spacing are of even width.
pub(super) fn has_cosine_columns(surface: &Surface, count: usize, settings: &AirSettings) -> bool {
    surface.cosine_columns && settings.inset > 0.0 && count > 2
}

/// Part of the way across column `j` of `n` at which it is halfway in the angle \[1\]: edges lie at
/// `(1 - cos (pi j / n)) / 2`.
fn midway(j: usize, n: usize) -> f64 {
    let at = |j: f64| (PI * j / n as f64).cos();
    let [from, here, to] = [0.0, 0.5, 1.0].map(|part| at(j as f64 + part));
    (from - here) / (from - to)
}

/// Whether the cross product of the tangents, from front to rear and from the first side to the other, is against
/// that of the diagonals.
fn winds_otherwise(corners: &[usize; 4], [front, rear]: [[usize; 2]; 2]) -> bool {
    let k = corners
        .iter()
        .position(|&c| c == front[0])
        .expect("a corner");
    corners[(k + 1) % 4] != rear[0]
}
