//! Axes with curves: ticks, units, one plot, plots side by side, charts.

pub(crate) mod chart;
pub(crate) mod grid;
pub(crate) mod plot;
pub(crate) mod ticks;
pub(crate) mod units;
