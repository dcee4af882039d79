//! A measured surface: the places of its points at some phases of the beat.
//!
//! Each point's course over the beat is a Fourier series, fitted by least squares to its places at the given
//! phases; between points the surface is bilinear in the parts of chord and span. So places, velocities and
//! accelerations are analytic, and the surface may do what no twist, camber and bending can: change its area,
//! sweep and fold.
//!
//! Phases that do not determine the series are refused ([`Fourier::fitted`]).

use crate::deformation::lines::{column, span};
use crate::error::{ModelError, finite, in_row};
use crate::mesh::GridMesh;
use crate::motion::{Fourier, FourierFit, WingMotion, check_gaps};
use wingbeat_math::DVec3;

/// Points of a surface at phases of the beat.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingSurface {
    /// Phases of the wing's own beat \[wingbeats\], rising, all within one beat.
    pub phases: Vec<f64>,
    /// Places \[m\] in the wing frame, phase by phase: rows at equal parts of the chord from the leading to the
    /// trailing edge, each with points at equal parts of the span from root to tip. Along axis 2 the distance
    /// outboard of the hinge counts, on wings of either side.
    pub places: Vec<Vec<Vec<DVec3>>>,
    /// Harmonics of the series \[1\].
    pub harmonics: usize,
}

/// Courses of the coordinates of a node over the beat \[m\].
pub(super) type Course = [Fourier; 3];

impl MovingSurface {
    /// The same surface of a wing `s` times as large.
    pub fn scaled(&self, s: f64) -> Self {
        let row = |row: &Vec<DVec3>| row.iter().map(|x| *x * s).collect();
        let at = |rows: &Vec<Vec<DVec3>>| rows.iter().map(row).collect();
        Self {
            places: self.places.iter().map(at).collect(),
            ..self.clone()
        }
    }

    /// Checks every number; `key` names the surface.
    ///
    /// # Errors
    /// Phases that do not rise or span a beat or more, too few for the harmonics, or without a surface each; surfaces
    /// of different or too few points; a number that is not finite; a wing without a beat.
    pub fn check(&self, key: &str, motion: &WingMotion) -> Result<(), ModelError> {
        let phases = format!("{key}.phases");
        self.check_phases(&phases)?;
        self.check_places(&format!("{key}.nodes"))?;
        if FourierFit::new(&self.phases, self.harmonics).is_err() {
            let (value, allowed) = (self.phases.len(), "enough to determine the harmonics");
            crate::error::require_count(&phases, value, false, allowed)?;
        }
        let f = motion.frequency;
        let allowed = "above 0 where a surface varies over the beat";
        crate::error::require(&format!("{key}: frequency"), f, f > 0.0, allowed).map(|_| ())
    }

    fn check_phases(&self, table: &str) -> Result<(), ModelError> {
        let bad = |row, problem: String| Err(in_row(table, row, problem));
        let (n, x) = (self.harmonics, &self.phases);
        let (Some(first), Some(last)) = (x.first(), x.last()) else {
            return bad(0, "no phases".to_owned());
        };
        for (k, phase) in x.iter().enumerate() {
            finite(table, *phase)?;
            if k > 0 && *phase <= x[k - 1] {
                return bad(k, format!("{phase} does not rise (before: {})", x[k - 1]));
            }
        }
        if last - first >= 1.0 {
            return bad(
                x.len() - 1,
                format!("{last} lies a beat or more after {first}: leave the repetition out"),
            );
        }
        if n == 0 {
            return bad(0, "a series without harmonics does not move".to_owned());
        }
        check_gaps(table, x, n)
    }

    fn check_places(&self, table: &str) -> Result<(), ModelError> {
        let bad = |row, problem: String| Err(in_row(table, row, problem));
        if self.places.len() != self.phases.len() {
            let (places, phases) = (self.places.len(), self.phases.len());
            return bad(places, format!("{places} surfaces for {phases} phases"));
        }
        let [rows, cols] = self.points();
        for (k, surface) in self.places.iter().enumerate() {
            if rows < 2 || cols < 2 || surface.len() != rows {
                return bad(
                    k,
                    "at least 2 rows of at least 2 points, at all phases alike".to_owned(),
                );
            }
            for row in surface {
                if row.len() != cols {
                    return bad(k, format!("a row of {} points, not {cols}", row.len()));
                }
                if let Some(x) = row.iter().find(|x| !x.is_finite()) {
                    return bad(k, format!("{x} is not finite"));
                }
            }
        }
        Ok(())
    }

    /// Points along the chord and along the span.
    fn points(&self) -> [usize; 2] {
        let first = self.places.first();
        let row = first.and_then(|rows| rows.first());
        [first.map_or(0, Vec::len), row.map_or(0, Vec::len)]
    }

    /// Courses of the nodes of a mesh, which lie on the surface at the parts of chord and span at which they
    /// lie at rest.
    pub(super) fn courses(&self, mesh: &GridMesh) -> Vec<Course> {
        let fit = FourierFit::new(&self.phases, self.harmonics).expect("a checked surface");
        let [inner, tip] = span(mesh);
        let side = mesh.nodes[mesh.node(0, mesh.cols)].y.signum();
        let mut courses = Vec::with_capacity(mesh.nodes.len());
        for (i, j) in (0..=mesh.rows).flat_map(|i| (0..=mesh.cols).map(move |j| (i, j))) {
            let (r, lead, chord) = column(mesh, j);
            let behind = if chord == 0.0 {
                0.0 // a pointed tip
            } else {
                (lead - mesh.nodes[mesh.node(i, j)].x) / chord
            };
            let at = [behind, (r - inner) / (tip - inner)];
            let places: Vec<DVec3> = (self.places.iter())
                .map(|rows| bilinear(rows, at))
                .collect();
            let component = |k: usize| {
                let sign = if k == 1 { side } else { 1.0 };
                let values: Vec<f64> = places.iter().map(|x| sign * x[k]).collect();
                fit.series(&values)
            };
            courses.push([0, 1, 2].map(component));
        }
        courses
    }
}

/// The point of a surface at these parts of chord and span.
fn bilinear(rows: &[Vec<DVec3>], [s, t]: [f64; 2]) -> DVec3 {
    let cell = |x: f64, points: usize| {
        let x = x.clamp(0.0, 1.0) * (points - 1) as f64;
        let k = (x as usize).min(points - 2);
        (k, x - k as f64)
    };
    let (i, u) = cell(s, rows.len());
    let (j, v) = cell(t, rows[0].len());
    let along = |row: &Vec<DVec3>| row[j].lerp(row[j + 1], v);
    along(&rows[i]).lerp(along(&rows[i + 1]), u)
}
