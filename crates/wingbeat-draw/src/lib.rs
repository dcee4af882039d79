//! What a result looks like: [`figures`] for papers and the screen, the animation, and the flight
//! [`page`] that opens in a browser.
//!
//! What it does not know: physics, how results are written.
#![warn(missing_docs)]

pub mod figures;
mod markup;
pub mod page;
pub mod points;

use wingbeat_case::{IoError, LoadedCase};
use wingbeat_results::{ResultDir, Summary};

/// Draws what the case asks for of a run that has just ended: figures and the flight page.
///
/// # Errors
/// A history that cannot be read or a file that cannot be written.
pub fn draw_run(dir: &ResultDir, case: &LoadedCase, summary: &Summary) -> Result<(), IoError> {
    if case.output.figures {
        figures::draw_all(dir, case, summary)?;
    }
    if case.output.page {
        page::write(dir, &summary.outcome, page::DEFAULT_BYTES)?;
    }
    Ok(())
}
