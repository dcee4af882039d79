//! Constrained multibody dynamics of flapping flight.
