//! A measured surface: the places of its points at some phases of the beat.
//!
//! Each point's course over the beat is a Fourier series, fitted by least squares to its places at the given phases; between
//! points the surface is bilinear in the parts of chord and span. So places, velocities and accelerations are analytic,
//! and the surface may do what no twist, camber and bending can: change its area, sweep and fold.
//!
//! A series of n harmonics is determined by phases of which no two neighbours are 1 / (2 n) apart or more,
//! wherever they lie \[Groechenig 1992, Math. Comput. 59:181, for one dimension\]; others are refused.

use crate::deformation::lines::{column, span};
use crate::error::{ModelError, finite, in_row};
use crate::mesh::GridMesh;
use crate::motion::{Fourier, WingMotion};
use std::f64::consts::TAU;
use wingbeat_math::{DVec3, SingularMatrix, solve_small};

/// Points of a surface at phases of the beat.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingSurface {
    /// Phases of the wing's own beat \[wingbeats\], rising, all within one beat.
    pub phases: Vec<f64>,
    /// Places \[m\] in the wing frame, phase by phase: rows at equal parts of the chord from the leading to the trailing
    /// edge, each with points at equal parts of the span from root to tip. Along axis 2 the distance outboard of the hinge
    /// counts, on wings of either side.
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
        if self.fit().is_err() {
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
        let gap = |k: usize| x.get(k + 1).unwrap_or(&(first + 1.0)) - x[k];
        let widest = (0..x.len()).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
        let widest = widest.unwrap_or(0);
        let limit = 0.5 / n as f64;
        match gap(widest) < limit {
            true => Ok(()),
            false => bad(
                widest,
                format!(
                    "the next phase is {:.4} wingbeats later, and {n} harmonics need less than {limit:.4}: give more phases or fewer harmonics",
                    gap(widest)
                ),
            ),
        }
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

    /// Courses of the nodes of a mesh, which lie on the surface at the parts of chord and span at which they lie at rest.
    pub(super) fn courses(&self, mesh: &GridMesh) -> Vec<Course> {
        let fit = self.fit().expect("a checked surface");
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
                series(&fit, &values)
            };
            courses.push([0, 1, 2].map(component));
        }
        courses
    }

    /// Rows of the matrix that makes the coefficients (mean, cosines, sines in turn) of the values at the phases: least squares.
    fn fit(&self) -> Result<Vec<Vec<f64>>, SingularMatrix> {
        let size = 2 * self.harmonics + 1;
        let basis = |x: f64| -> Vec<f64> {
            let wave = |k: usize| {
                let (s, c) = (TAU * k.div_ceil(2) as f64 * x).sin_cos();
                if k % 2 == 1 { c } else { s }
            };
            (0..size)
                .map(|k| if k == 0 { 1.0 } else { wave(k) })
                .collect()
        };
        let rows: Vec<Vec<f64>> = self.phases.iter().map(|x| basis(*x)).collect();
        let mut normal = vec![0.0; size * size];
        for row in &rows {
            for (a, b) in (0..size).flat_map(|a| (0..size).map(move |b| (a, b))) {
                normal[a * size + b] += row[a] * row[b];
            }
        }
        let column = |row: &Vec<f64>| {
            let mut x = row.clone();
            solve_small(&mut normal.clone(), &mut x).map(|()| x)
        };
        let columns = rows
            .iter()
            .map(column)
            .collect::<Result<Vec<Vec<f64>>, _>>()?;
        let row = |k: usize| columns.iter().map(|c| c[k]).collect();
        Ok((0..size).map(row).collect())
    }
}

/// The series of values at the phases.
fn series(fit: &[Vec<f64>], values: &[f64]) -> Fourier {
    let of = |row: &Vec<f64>| row.iter().zip(values).map(|(w, v)| w * v).sum();
    Fourier {
        mean: of(&fit[0]),
        cos: fit[1..].iter().step_by(2).map(of).collect(),
        sin: fit[2..].iter().step_by(2).map(of).collect(),
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
