//! Cores of the wings' own filaments that are wide beside the panels along the chord.
//!
//! A core takes from each filament what it makes at the control points nearest to it, and the circulations grow until
//! no air goes through. Lift of a flat plate in plane flow is high by 0.3, 0.7, 1.1, 1.5 and 2.5 % with algebraic cores of
//! 0.08, 0.16, 0.24, 0.32 and 0.64 panel lengths. Vorticity is dense at the leading edge: with cosine spacing the same
//! goes with the mean length of the two foremost panels, 0.7 and 1.5 % with 0.14 and 0.30 of it.

use super::said::names;
use crate::setup::FlightSetup;
use wingbeat_model::Wing;

/// Core over the length of the foremost panels from which lift is 1 % high \[1\].
const WIDE: f64 = 0.25;

impl FlightSetup {
    /// Radius of the cores of the wings' own filaments over the mean length of the foremost panels, of the wing that has
    /// most \[1\]; none without wings in a lattice, or of cores without a radius.
    pub fn bound_core_width(&self) -> Option<f64> {
        let air = self.air.lattice()?;
        let radius = air.lattice.bound_core.radius()?;
        let widths = self.animal.wings.iter().map(|w| radius / foremost(w));
        widths.reduce(f64::max)
    }

    /// Says which wings have filaments whose cores are so wide beside the panels along the chord that lift is 1 % high
    /// or more; none where none have.
    pub fn wide_bound_core(&self) -> Option<String> {
        let air = self.air.lattice()?;
        let radius = air.lattice.bound_core.radius()?;
        let parts = self.animal.wings.iter().map(|w| (w, radius / foremost(w)));
        let wide: Vec<_> = parts.filter(|(_, part)| *part > WIDE).collect();
        let most = wide.iter().map(|(_, part)| *part).reduce(f64::max)?;
        Some(format!(
            "vortex cores of the wing (air.bound_core, {radius:.1e} m) are {most:.2} lengths of the foremost panels ({}), and from {WIDE} on \
             lift is 1 % high and more, the more so the more panels there are along the chord: give air.bound_core a tenth of \
             that length or less, or take fewer panels (mesh.chordwise)",
            names(wide.iter().map(|(w, _)| &w.name[..]), ", ")
        ))
    }
}

/// Mean length of the two foremost panels of the columns of a wing [m].
fn foremost(wing: &Wing) -> f64 {
    let (mesh, rows) = (&wing.mesh, wing.mesh.rows.min(2));
    let length = |j: usize| mesh.nodes[mesh.node(0, j)].distance(mesh.nodes[mesh.node(rows, j)]);
    let sum: f64 = (0..=mesh.cols).map(length).sum();
    sum / (rows * (mesh.cols + 1)) as f64
}
