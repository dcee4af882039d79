//! Figures that are no chart over time: beats, chords with forces, paths, phase planes, wakes.

pub(crate) mod beats;
pub(crate) mod dots;
pub(crate) mod lollipop;
pub(crate) mod path;
pub(crate) mod phase;
pub(crate) mod wake;
