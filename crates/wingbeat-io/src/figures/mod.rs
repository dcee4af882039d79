//! Figures of a run, drawn from its history: SVG, units on axes, colours that colour-blind
//! readers can tell apart (Okabe & Ito 2008).

mod chart;
mod kinds;
pub mod stabilised;

use wingbeat_flight::FlightSetup;

use crate::case::LoadedCase;
use crate::error::IoError;
use crate::result::{History, ResultDir};
pub use chart::{Chart, Panel, Series};

/// More rows of a history than this do not make a figure better.
pub(crate) const MOST_ROWS: usize = 4000;

/// Draws every figure that makes sense for the case into `figures/`.
///
/// # Errors
/// A file that cannot be written or a figure that cannot be drawn.
pub fn draw_all(dir: &ResultDir, case: &LoadedCase, history: &History) -> Result<(), IoError> {
    dir.folder("figures")?;
    for (name, chart) in kinds::all(&case.setup, history) {
        let path = dir.join(&format!("figures/{name}.svg"));
        let svg = chart
            .to_svg()
            .map_err(|problem| IoError::Figure { path, problem })?;
        dir.write(&format!("figures/{name}.svg"), svg.as_bytes())?;
    }
    Ok(())
}

/// The charts of a run.
pub(crate) fn charts(setup: &FlightSetup, history: &History) -> Vec<Chart> {
    kinds::all(setup, history)
        .into_iter()
        .map(|c| c.1)
        .collect()
}

/// Time axis: wingbeats where there are any, else seconds.
pub(crate) fn time_axis(setup: &FlightSetup, history: &History) -> (String, Vec<f64>) {
    let time = history.column("time_s");
    match setup.time.period {
        Some(period) => (
            "wingbeats".to_owned(),
            time.iter().map(|t| t / period).collect(),
        ),
        None => ("time [s]".to_owned(), time.to_vec()),
    }
}
