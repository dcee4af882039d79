//! Surfaces that face each other across gaps narrower than their panels.
//!
//! Two plates at the distance h that move apart by V have the velocity u = 2 V x / h between them, and on each a vortex
//! sheet of the strength u. A lattice has it as vortices at the distance p, whose normal velocity at the control points
//! half way between them is
//!
//! `u h / (2 x) tanh(pi h / p)`
//!
//! so that its sheets are stronger by 1 / tanh(pi h / p), and with them the force of the air that the gap takes in or
//! gives off: by 10 % at h = p / 2, by a factor of 2 at h = p / 6. Wings over a ground have their images at twice the
//! height. Where the vortices of both do not lie opposite each other forces come out too small as well as too large.
//!
//! How much of it is felt hangs on how much of the wing has such gaps. Of wedges that open along chord or span to the
//! width W p forces of the first step are right to 5 % with W = 1.1 and 30 % too large with W = 1, on 4 to 16 panels; of
//! plates that overlap by a part s of the chord they are right with h = s p and half as large again with h = s p / 2. So
//! gaps count that are narrower than r p over the part r of the area, with any r up to 1/2.

use crate::animal::{Animal, Wing};
use crate::contact::bent::Bending;
use crate::contact::crossing::{instants, pairs};
use crate::contact::flown_sheets::FlownSheets;
use crate::contact::sheet::{EDGE, LINES, Pose, Sheet, bounds, lines};
use crate::motion::WingMotion;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// Gap over the length of the panels along the chord below which it is narrow \[1\].
const NARROW: f64 = 0.5;

/// Part of the area of a wing that has gaps narrower than a ratio to its panels, over that ratio, from which on they
/// count \[1\]: where the vortices of both surfaces lie opposite each other, and of wings where they do not.
const COUNTS: [f64; 2] = [0.9, 0.5];

/// The least part that counts \[1\].
const SOME: f64 = 0.08;

/// Places along the chord of a quadrilateral between lines of nodes at which gaps are looked at \[1\].
const PLACES: [f64; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

/// Cosine of the angle between surfaces up to which they face each other \[1\].
const FACING: f64 = 0.5;

/// What a wing faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faced {
    /// Another wing.
    Wing(usize),
    /// The image of a wing, itself or another one, in a plane.
    Image(usize),
    /// A part of the central body or of a segment, counted on from one to the next.
    Part(usize),
}

/// A wing that faced another surface across gaps that are narrow beside its panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NarrowGap {
    /// The wing.
    pub wing: usize,
    /// What it faced.
    pub faced: Faced,
    /// Whether the panels of both lie opposite each other: of mirror images.
    pub is_aligned: bool,
    /// In which part of the instants \[1\].
    pub time: f64,
    /// When the gaps were narrowest over the panels.
    pub at: Narrowest,
}

/// Narrow gaps at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Narrowest {
    /// Part of the area of the wing over which they were narrow \[1\].
    pub share: f64,
    /// Their mean there \[m\].
    pub gap: f64,
    /// Mean length of the panels of the wing along the chord there \[m\].
    pub panel: f64,
}

impl Narrowest {
    /// By what factor forces come out too large that open and close the gap \[1\].
    pub fn excess(&self) -> f64 {
        1.0 / (PI * self.gap / self.panel).tanh()
    }
}

/// Looks for narrow gaps of the wings of an animal.
#[derive(Clone, Debug)]
pub struct NarrowGaps {
    wings: FlownSheets,
    /// Panels along the chord between lines of nodes of the sheets.
    panels: Vec<Vec<usize>>,
    /// Bodies of the parts, and their triangles in components of these \[m\].
    parts: Vec<(usize, Vec<[DVec3; 3]>)>,
    /// A point of each plane of images \[m\] and its unit normal.
    planes: Vec<[DVec3; 2]>,
    /// Each wing with what it may face, and whether the panels of both lie opposite each other.
    pairs: Vec<(usize, Faced, bool)>,
    seen: SeenGaps,
}

/// What was seen of the wings of an animal.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SeenGaps {
    /// Instants that were looked at.
    instants: usize,
    /// Of each pair: instants of narrow gaps, and the narrowest.
    pairs: Vec<(usize, Option<Narrowest>)>,
}

impl NarrowGaps {
    /// Between wings, to the parts of body and segments if these are surfaces of the air, too, and to the images in
    /// `planes`, of each of which here are a point \[m\] and the unit normal.
    pub fn new(animal: &Animal, has_parts: bool, planes: Vec<[DVec3; 2]>) -> Self {
        let count = animal.wings.len();
        let between = pairs(0..count).flat_map(|[a, b]| [(a, Faced::Wing(b)), (b, Faced::Wing(a))]);
        let images = (0..count).flat_map(|a| (0..count).map(move |b| (a, Faced::Image(b))));
        let images = images.filter(|_| !planes.is_empty());
        let own = animal.parts.iter().map(|p| (0, p));
        let segments = (count + 1..).zip(&animal.segments);
        let others = segments.flat_map(|(body, s)| s.parts.iter().map(move |p| (body, p)));
        let parts = own.chain(others).filter(|_| has_parts);
        let parts: Vec<(usize, Vec<[DVec3; 3]>)> =
            parts.map(|(body, p)| (body, p.mesh.triangles())).collect();
        let on_parts = (0..count).flat_map(|a| (0..parts.len()).map(move |k| (a, Faced::Part(k))));
        let wings = &animal.wings;
        let is_aligned = |a: usize, faced: Faced| match faced {
            Faced::Wing(b) => wings[a].mesh == wings[b].mesh.mirrored(),
            Faced::Image(b) => a == b,
            Faced::Part(_) => false,
        };
        let all = between.chain(images).chain(on_parts);
        let pairs: Vec<_> = all
            .map(|(a, faced)| (a, faced, is_aligned(a, faced)))
            .collect();
        let between_lines = |wing: &Wing| {
            let rows = lines(wing.mesh.rows, LINES[0]);
            rows.windows(2).map(|w| w[1] - w[0]).collect()
        };
        Self {
            wings: FlownSheets::new(animal),
            panels: animal.wings.iter().map(between_lines).collect(),
            parts,
            planes,
            seen: SeenGaps {
                instants: 0,
                pairs: vec![(0, None); pairs.len()],
            },
            pairs,
        }
    }

    /// Whether there is nothing that a wing may face.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Whether there are images.
    pub fn has_planes(&self) -> bool {
        !self.planes.is_empty()
    }

    /// Looks at an instant: places \[m\] and attitudes of the central body, the wings and the segments in the frame of the
    /// planes, none of those that are left out, and how the elastic wings are bent, in their order; `phase` of the beat of a
    /// wing of some motion \[wingbeats\].
    pub fn see(
        &mut self,
        poses: &[Option<Pose>],
        bent: impl Iterator<Item = Bending>,
        phase: impl Fn(&WingMotion) -> f64,
    ) {
        self.seen.instants += 1;
        let nodes = self
            .wings
            .placed(poses.iter().skip(1).copied(), bent, phase);
        let cells: Vec<Cells> = (0..nodes.len()).map(|w| self.cells(w, &nodes)).collect();
        let faced = |of: Faced| -> Vec<Vec<[DVec3; 3]>> {
            match of {
                Faced::Wing(w) => vec![self.triangles(w, &nodes, |x| x)],
                Faced::Image(w) => {
                    let image = |&[point, normal]: &[DVec3; 2]| {
                        self.triangles(w, &nodes, |x| x - 2.0 * (x - point).dot(normal) * normal)
                    };
                    self.planes.iter().map(image).collect()
                }
                Faced::Part(k) => {
                    let (body, triangles) = &self.parts[k];
                    let placed = |(p, r): Pose| {
                        let place = |t: &[DVec3; 3]| t.map(|x| p + r * x);
                        triangles.iter().map(place).collect()
                    };
                    Vec::from_iter(poses[*body].map(placed))
                }
            }
        };
        let narrowest = |&(wing, of, is_aligned): &(usize, Faced, bool)| {
            let counts = match (of, is_aligned) {
                (Faced::Part(_), _) | (_, true) => COUNTS[0],
                _ => COUNTS[1],
            };
            let gaps = |t: Vec<[DVec3; 3]>| cells[wing].narrow_to(&t, counts);
            let found = faced(of).into_iter().filter_map(gaps);
            found.min_by(|a, b| a.ratio().total_cmp(&b.ratio()))
        };
        let found: Vec<Option<Narrowest>> = self.pairs.iter().map(narrowest).collect();
        for (now, (met, narrowest)) in found.into_iter().zip(&mut self.seen.pairs) {
            let Some(now) = now else {
                continue;
            };
            *met += 1;
            if narrowest.is_none_or(|n| now.ratio() < n.ratio()) {
                *narrowest = Some(now);
            }
        }
    }

    /// What was seen so far.
    pub fn seen(&self) -> &SeenGaps {
        &self.seen
    }

    /// Goes on from [`Self::seen`] of the same wings.
    pub fn go_on(&mut self, seen: SeenGaps) {
        if seen.pairs.len() == self.pairs.len() {
            self.seen = seen;
        }
    }

    /// Which wings faced what across narrow gaps.
    pub fn found(&self) -> Vec<NarrowGap> {
        let pairs = self.pairs.iter().zip(&self.seen.pairs);
        let gap =
            |(&(wing, faced, is_aligned), &(met, at)): (&(usize, Faced, bool), &(usize, _))| {
                let at: Option<Narrowest> = at;
                Some(NarrowGap {
                    wing,
                    faced,
                    is_aligned,
                    time: met as f64 / self.seen.instants as f64,
                    at: at?,
                })
            };
        pairs.filter_map(gap).collect()
    }

    fn cells(&self, wing: usize, nodes: &[Option<Vec<DVec3>>]) -> Cells {
        match &nodes[wing] {
            Some(nodes) => Cells::new(&self.wings.sheets[wing], &self.panels[wing], nodes),
            None => Cells::default(),
        }
    }

    /// Of a wing with these nodes, moved.
    fn triangles(
        &self,
        wing: usize,
        nodes: &[Option<Vec<DVec3>>],
        moved: impl Fn(DVec3) -> DVec3,
    ) -> Vec<[DVec3; 3]> {
        let Some(nodes) = &nodes[wing] else {
            return vec![];
        };
        let nodes: Vec<DVec3> = nodes.iter().map(|x| moved(*x)).collect();
        let sheet = &self.wings.sheets[wing];
        sheet.triangles().map(|t| t.map(|n| nodes[n])).collect()
    }
}

/// Times at which narrow gaps of all wings in their prescribed motion are looked at \[s\]: those of
/// [`crate::crossings`], of the wings with the highest and the lowest frequency.
pub fn instants_of_gaps(animal: &Animal) -> impl Iterator<Item = f64> {
    let by = |a: &&Wing, b: &&Wing| a.motion.frequency.total_cmp(&b.motion.frequency);
    let ends = [
        animal.wings.iter().min_by(by),
        animal.wings.iter().max_by(by),
    ];
    let [a, b] = ends;
    a.zip(b).into_iter().flat_map(|(a, b)| instants([a, b]))
}

/// Places of a wing at which gaps are looked at.
#[derive(Default)]
struct Cells {
    all: Vec<Cell>,
    /// Corners of the box around the nodes \[m\].
    bounds: [DVec3; 2],
    /// Area of all \[m2\].
    area: f64,
}

struct Cell {
    middle: DVec3,
    normal: DVec3,
    area: f64,
    /// Length of its panels along the chord \[m\].
    panel: f64,
}

impl Narrowest {
    fn ratio(&self) -> f64 {
        self.gap / self.panel
    }
}

impl Cells {
    fn new(sheet: &Sheet, panels: &[usize], nodes: &[DVec3]) -> Self {
        let columns = sheet.columns;
        let cells = |n: usize| {
            let [a, b, c, d] = [n, n + 1, n + columns + 1, n + columns].map(|k| nodes[k]);
            let across = (c - a).cross(d - b);
            let [front, rear] = [a.midpoint(b), c.midpoint(d)];
            PLACES.map(|part| Cell {
                middle: front.lerp(rear, part),
                normal: across.normalize_or_zero(),
                area: 0.5 * across.length() / PLACES.len() as f64,
                panel: front.distance(rear) / panels[n / columns] as f64,
            })
        };
        let corners = (0..(sheet.rows - 1) * columns).filter(|n| n % columns + 1 < columns);
        let all: Vec<Cell> = corners.flat_map(cells).collect();
        Self {
            area: all.iter().map(|c| c.area).sum(),
            bounds: bounds(nodes),
            all,
        }
    }

    /// The narrow gaps to a surface of these triangles, if there are as many as `counts` says.
    fn narrow_to(&self, triangles: &[[DVec3; 3]], counts: f64) -> Option<Narrowest> {
        let reach = NARROW * self.all.iter().map(|c| c.panel).fold(0.0, f64::max);
        let [low, high] = [self.bounds[0] - reach, self.bounds[1] + reach];
        let is_near = |t: &&[DVec3; 3]| {
            let [a, b] = bounds(&t[..]);
            a.cmple(high).all() && b.cmpge(low).all()
        };
        let near: Vec<&[DVec3; 3]> = triangles.iter().filter(is_near).collect();
        let gap = |cell: &Cell| {
            let gaps = near.iter().filter_map(|t| cell.gap_to(t));
            gaps.fold(f64::INFINITY, f64::min)
        };
        let gaps = self.all.iter().map(|cell| (cell, gap(cell)));
        let mut gaps: Vec<(&Cell, f64)> = gaps.filter(|(c, g)| *g < NARROW * c.panel).collect();
        gaps.sort_by(|(a, g), (b, h)| (g / a.panel).total_cmp(&(h / b.panel)));
        let (mut area, mut narrow) = ([0.0; 3], None);
        for (cell, gap) in gaps {
            let more = [1.0, gap, cell.panel].map(|x| cell.area * x);
            area = [0, 1, 2].map(|k| area[k] + more[k]);
            let share = area[0] / self.area;
            if share >= SOME && share >= counts * gap / cell.panel {
                let [gap, panel] = [area[1] / area[0], area[2] / area[0]];
                narrow = Some(Narrowest { share, gap, panel });
            }
        }
        narrow
    }
}

impl Cell {
    /// Distance along the normal to a triangle that faces it \[m\]; none of one beside it.
    fn gap_to(&self, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
        let across = (*b - *a).cross(*c - *a);
        let along = self.normal.dot(across);
        if along.abs() < FACING * across.length() {
            return None;
        }
        let gap = (*a - self.middle).dot(across) / along;
        let foot = self.middle + gap * self.normal;
        let inside = |[u, v]: [DVec3; 2]| {
            (v - u).cross(foot - u).dot(across) >= -EDGE * across.length_squared()
        };
        ([[*a, *b], [*b, *c], [*c, *a]].into_iter().all(inside)).then_some(gap.abs())
    }
}

#[cfg(test)]
mod tests;
