//! Vibrations of elastic wings: their modes at rest ([`wing_modes`]), and when the air makes them grow ([`flutter`]),
//! seen in samples of a flight ([`realisation`]).

pub mod flutter;
pub(crate) mod moving;
pub(crate) mod realisation;
pub(crate) mod wing_modes;
