//! What is drawn over time: quantities, the part of the flight, the strokes behind them.

mod bending;
pub(crate) mod kinds;
pub(crate) mod measure;
pub(crate) mod part;
pub(crate) mod shades;
pub(crate) mod strokes;
pub(crate) mod window;
pub(crate) mod wing_angles;
