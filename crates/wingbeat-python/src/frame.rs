//! Surfaces and wakes of one instant.

use pyo3::prelude::*;
use wingbeat::case::OutputSettings;
use wingbeat::flight::{Simulation, Snapshot};
use wingbeat::results::frames::{self, Mesh};
use wingbeat::results::particles::Cloud;
use wingbeat::results::vtp::PolyData;

use crate::arrays::{array, vectors};

/// Surfaces and wakes of one instant, N components.
#[pyclass(frozen, module = "wingbeat._core")]
pub struct Frame {
    frame: frames::Frame,
    time: f64,
}

impl Frame {
    /// A frame that was read, of the time `time` [s].
    pub fn of(frame: frames::Frame, time: f64) -> Self {
        Self { frame, time }
    }
}

impl From<&Snapshot> for Frame {
    fn from(snapshot: &Snapshot) -> Self {
        let mesh = |data: PolyData| Mesh {
            points: data.points.iter().map(|p| turned(&p.to_array())).collect(),
            quads: data.quads,
            cells: (data.cells.into_iter())
                .map(|(name, values)| (name.to_owned(), values))
                .collect(),
        };
        let frame = frames::Frame {
            step: snapshot.step,
            surfaces: mesh(PolyData::surfaces(snapshot)),
            wakes: mesh(PolyData::wakes(snapshot)),
            particles: Cloud::of(snapshot),
        };
        Self::of(frame, snapshot.time)
    }
}

/// Whether a frame is due at this step, as in a result directory.
pub fn is_framed(output: &OutputSettings, flight: &Simulation) -> bool {
    let (every, step) = (output.frames_every, flight.state().step);
    every > 0 && (step.is_multiple_of(every) || flight.finished())
}

/// From picture axes to N, and back: half a turn about n1.
fn turned(p: &[f64; 3]) -> [f64; 3] {
    [p[0], -p[1], -p[2]]
}

/// Nodes of a sheet, shape (rows + 1, columns + 1, 3), its circulations and those that it shares with
/// particles, shape (rows, columns).
type Sheet<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>);

#[pymethods]
impl Frame {
    /// Step of the flight.
    #[getter]
    fn step(&self) -> usize {
        self.frame.step
    }

    /// Time [s].
    #[getter]
    fn time_s(&self) -> f64 {
        self.time
    }

    /// Nodes of the surfaces, shape (nodes, 3) [m].
    #[getter]
    fn nodes_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let points = &self.frame.surfaces.points;
        vectors(py, points.iter().map(turned), &[points.len()])
    }

    /// Corners of the panels of the surfaces, shape (panels, 4): rows of `nodes_m`.
    #[getter]
    fn panels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let quads = &self.frame.surfaces.quads;
        let corners: Vec<i64> = quads.iter().flatten().map(|&n| n as i64).collect();
        array(py, corners, &[quads.len(), 4])
    }

    /// A number for each panel of the surfaces: `circulation_m2_per_s`, `pressure_jump_pascal`, `surface`.
    fn panel_values<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let values = self.frame.surfaces.cell(name).to_vec();
        let count = values.len();
        array(py, values, &[count])
    }

    /// The wake sheets, newest row first: nodes [m], circulations of rings [m2/s], and those of rings that
    /// have become particles in the filaments that they share with rings [m2/s].
    fn sheets<'py>(&self, py: Python<'py>) -> PyResult<Vec<Sheet<'py>>> {
        let wakes = &self.frame.wakes;
        let gamma = wakes.cell("circulation_m2_per_s");
        let shared = wakes.cell("shared_circulation_m2_per_s"); // of flights with particles
        let sheet = |s: &frames::Sheet| {
            let (rows, cols) = (s.rows(), s.cols);
            let nodes = (rows + 1) * (cols + 1);
            let points = wakes.points[s.first_node..s.first_node + nodes].iter();
            let cells = s.first_cell..s.first_cell + s.rings;
            let kept = shared.get(cells.clone()).map(<[f64]>::to_vec);
            let kept = kept.unwrap_or_else(|| vec![0.0; s.rings]);
            Ok((
                vectors(py, points.map(turned), &[rows + 1, cols + 1])?,
                array(py, gamma[cells].to_vec(), &[rows, cols])?,
                array(py, kept, &[rows, cols])?,
            ))
        };
        wakes.sheets().iter().map(sheet).collect()
    }

    /// Vortex particles: places, shape (particles, 3) [m]; vorticity times volume, (particles, 3) [m3/s]; radii
    /// [m].
    #[allow(clippy::type_complexity)]
    fn particles<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let cloud = &self.frame.particles;
        let count = [cloud.len()];
        Ok((
            vectors(py, cloud.points.iter().map(turned), &count)?,
            vectors(py, cloud.strength.iter().map(turned), &count)?,
            array(py, cloud.radius.clone(), &count)?,
        ))
    }
}
