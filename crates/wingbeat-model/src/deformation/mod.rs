//! Prescribed deformation of a wing: twist, camber and spanwise bending as laws along the span
//! times Fourier series in time.
//!
//! In the wing frame, at the distance r from the hinge, chord c, twist axis at the part `a` of the
//! chord behind the leading edge (x = x_a):
//!
//! 1. camber lifts the mean line by `h(r, t) c g(s)` towards -axis 3, `g` a mean line of height 1
//!    and s the part of the chord behind the leading edge;
//! 2. twist turns the section by `tau(r, t)` about the parallel to axis 2 through x_a, in the sense
//!    of the feathering angle psi: positive raises the leading edge towards -axis 3;
//! 3. bending moves the section by `w(r, t)` towards -axis 3. It stays parallel to itself and at its
//!    place along axis 2, so the surface is stretched at second order of the slope dw/dr.
//!
//! These axes are those of the wing frame, whatever incidence and dihedral the mesh has; `c` and `s` are
//! measured along axis 1.
//!
//! Towards -axis 3 is up for a wing at zero angles. Time enters through the phase of the wing's own
//! beat, so a smooth start of the motion is one of the deformation too. Positions, velocities and
//! accelerations are analytic. Both wings of a mirrored pair have the same laws.
//!
//! Or the places of the surface's points are given at phases of the beat ([`MovingSurface`]): what was measured.
//!
//! The mass of the wing does not follow: for its inertia the wing stays the rigid body it was.

mod law;
mod lines;
mod prescribed;
mod shape;
mod surface;

pub use law::{SectionDeformation, SpanLaw, Term};
pub(crate) use lines::{behind, chord_line, column, is_flat, span, strip_axes};
pub use prescribed::Deformation;
pub use shape::{DeformingMesh, Stations};
pub use surface::MovingSurface;
