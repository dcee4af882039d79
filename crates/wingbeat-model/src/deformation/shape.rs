//! From the laws to places, velocities and accelerations of points in the wing frame.

use crate::deformation::law::{SectionDeformation, Term, over_time};
use crate::deformation::lines::{column, span};
use crate::deformation::prescribed::Deformation;
use crate::deformation::surface::Course;
use crate::mesh::GridMesh;
use wingbeat_math::DVec3;

/// Sections at given places along the span, their shares of every term known.
#[derive(Clone, Debug, PartialEq)]
pub struct Stations {
    /// Terms of twist, camber, bending.
    terms: [Vec<Term>; 3],
    /// Values along the span, station by station, in the order of the terms.
    weights: [Vec<f64>; 3],
}

impl Stations {
    /// At the relative distances `r` = r/R; the surface begins at `root` = r/R.
    pub fn new(deformation: &Deformation, r: &[f64], root: f64) -> Self {
        let terms = [
            &deformation.twist,
            &deformation.camber,
            &deformation.bending,
        ];
        let weights = terms.map(|terms| {
            let of = |&r: &f64| terms.iter().map(move |t| t.span.at(r, root));
            r.iter().flat_map(of).collect()
        });
        Self {
            terms: terms.map(Clone::clone),
            weights,
        }
    }

    /// Section number `station` at the phase `[x, x', x'']` of the beat [wingbeats, s].
    pub fn at(&self, station: usize, phase: [f64; 3]) -> SectionDeformation {
        let sum = |k: usize| {
            let terms = &self.terms[k];
            let weights = &self.weights[k][station * terms.len()..];
            let mut q = [0.0; 3];
            for (term, w) in terms.iter().zip(weights) {
                let f = term.over_time(phase);
                (0..3).for_each(|i| q[i] += w * f[i]);
            }
            q
        };
        SectionDeformation {
            twist: sum(0),
            camber: sum(1),
            bending: sum(2),
        }
    }
}

/// The mesh of a wing as its deformation moves it.
#[derive(Clone, Debug, PartialEq)]
pub struct DeformingMesh(How);

/// What moves the nodes.
#[derive(Clone, Debug, PartialEq)]
enum How {
    /// Laws along the span and over the beat.
    Laws {
        stations: Stations,
        rows: usize,
        nodes: Vec<Node>,
    },
    /// Each its own course, in the order of the mesh.
    Courses(Vec<Course>),
}

/// A node at rest, column by column.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    index: usize,
    rest: DVec3,
    /// Distance ahead of the twist axis \[m\].
    ahead: f64,
    /// Chord times the mean line of height 1 \[m\].
    line: f64,
}

impl DeformingMesh {
    /// Every line of nodes along the chord of `mesh` is a section.
    pub fn new(mesh: &GridMesh, deformation: &Deformation) -> Self {
        if let Some(surface) = &deformation.surface {
            return Self(How::Courses(surface.courses(mesh)));
        }
        let [inner, tip] = span(mesh);
        let columns = 0..=mesh.cols;
        let r = columns.clone().map(|j| column(mesh, j).0 / tip);
        let r: Vec<f64> = r.collect();
        let node = |(j, i): (usize, usize)| {
            let (_, lead, chord) = column(mesh, j);
            let index = mesh.node(i, j);
            let rest = mesh.nodes[index];
            let behind = if chord == 0.0 {
                0.0
            } else {
                (lead - rest.x) / chord
            };
            Node {
                index,
                rest,
                ahead: rest.x - (lead - deformation.axis_fraction * chord),
                line: chord * mean_line(behind, deformation.camber_peak),
            }
        };
        let places = columns.flat_map(|j| (0..=mesh.rows).map(move |i| (j, i)));
        Self(How::Laws {
            stations: Stations::new(deformation, &r, inner / tip),
            rows: mesh.rows,
            nodes: places.map(node).collect(),
        })
    }

    /// Shows place \[m\], velocity \[m/s\] and acceleration \[m/s2\] of every node relative to the wing
    /// frame, wing components, at the phase `[x, x', x'']` of the beat.
    pub fn visit(&self, phase: [f64; 3], mut see: impl FnMut(usize, [DVec3; 3])) {
        match &self.0 {
            How::Laws {
                stations,
                rows,
                nodes,
            } => {
                for (j, nodes) in nodes.chunks(rows + 1).enumerate() {
                    let section = stations.at(j, phase);
                    for n in nodes {
                        let [d, v, a] = section.displacement(n.ahead, n.rest.z, n.line);
                        see(n.index, [n.rest + d, v, a]);
                    }
                }
            }
            How::Courses(nodes) => {
                for (n, course) in nodes.iter().enumerate() {
                    let [x, y, z] = course.each_ref().map(|q| over_time(q, phase));
                    see(n, [0, 1, 2].map(|k| DVec3::new(x[k], y[k], z[k])));
                }
            }
        }
    }

    /// Places of the nodes \[m\] at the phase `x`, wing components.
    pub fn places(&self, x: f64) -> Vec<DVec3> {
        let nodes = match &self.0 {
            How::Laws { nodes, .. } => nodes.len(),
            How::Courses(nodes) => nodes.len(),
        };
        let mut places = vec![DVec3::ZERO; nodes];
        self.visit([x, 0.0, 0.0], |n, [p, _, _]| places[n] = p);
        places
    }
}

impl SectionDeformation {
    /// Displacement from rest \[m\], velocity and acceleration of the point that lies at rest
    /// `ahead` \[m\] of the twist axis at the `height` \[m\] along axis 3, where the mean line of
    /// height 1 is `line` \[m\]; wing components.
    pub fn displacement(&self, ahead: f64, height: f64, line: f64) -> [DVec3; 3] {
        let ([tau, t1, t2], [h, h1, h2], [w, w1, w2]) = (self.twist, self.camber, self.bending);
        let (sin, cos) = tau.sin_cos();
        let half = (0.5 * tau).sin();
        let less = 2.0 * half * half; // 1 - cos
        // Height of the point in the section, with derivatives.
        let (z, z1, z2) = (height - h * line, -h1 * line, -h2 * line);
        // (cos ahead + sin z, -sin ahead + cos z) and what turning it by a quarter gives.
        let (x, y) = (cos * ahead + sin * z, cos * z - sin * ahead);
        [
            DVec3::new(
                sin * z - less * ahead,
                0.0,
                -h * line - (sin * ahead + less * z) - w,
            ),
            DVec3::new(t1 * y + sin * z1, 0.0, cos * z1 - t1 * x - w1),
            DVec3::new(
                t2 * y - t1 * t1 * x + 2.0 * t1 * cos * z1 + sin * z2,
                0.0,
                cos * z2 - 2.0 * t1 * sin * z1 - t1 * t1 * y - t2 * x - w2,
            ),
        ]
    }
}

/// Mean line of height 1 with its top at `peak`, at the part `s` of the chord.
fn mean_line(s: f64, peak: f64) -> f64 {
    if s < peak {
        s * (2.0 * peak - s) / (peak * peak)
    } else {
        (1.0 - s) * (1.0 + s - 2.0 * peak) / ((1.0 - peak) * (1.0 - peak))
    }
}
