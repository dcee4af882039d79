//! Blade elements, strip by strip along the span: quasi-steady, or with the wake of plane flow behind every strip.
//!
//! Each strip of a wing is a flat section in the 1-3 plane of the wing frame (axis 1 to the
//! leading edge, axis 3 the normal). From the velocity of the section through the air follow
//! 1. the translational lift and drag, `1/2 rho c U^2 C(alpha)` at the centre of pressure
//!    ([`coefficients`]: published sets by name, or the user's own numbers);
//! 2. the rotational force of a wing that feathers while it sweeps, `rho U Gamma_rot`
//!    [Sane & Dickinson 2002], or [Berman & Wang 2007] with its viscous moment;
//! 3. the added mass, the rate of the momentum `rho pi/4 c^2 w` that the strip gives the air at mid
//!    chord, or other published forms ([`AddedMassModel`]). What is linear in the accelerations is kept
//!    apart: whoever integrates the motion can put it on the left-hand side.
//!
//! With [`Unsteady`] the circulation of a strip lags behind its motion ([`Indicial`], Wagner's function): the
//! downwash of the strip's own wake is taken from the normal velocity that 1 and 2 see, feathering is damped as
//! thin-airfoil theory has it, and the force along the chord is leading-edge suction [Garrick 1936].
//!
//! Optional: drag of the body ([`BodyDrag`]). [`DerivativeTable`] is simpler still: the loads on a whole animal, linear
//! about a reference flight.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | u, w | `u`, `w` | velocity of the section through the air along axis 1 and 3 | m/s |
//! | U | `speed` | `sqrt(u^2 + w^2)` | m/s |
//! | alpha | - | angle of attack, `atan2(abs w, abs u)` in [0, 90 deg] | rad |
//! | q | `w.y` | rate of feathering, angular velocity about axis 2 | rad/s |
//! | c, dr | `chord`, `width` | chord and width of a strip | m |
//! | x0 | `x0` | feathering axis behind the leading edge over the chord | 1 |
//! | Gamma_rot | - | `C_rot c^2 q` | m2/s |
//!
//! A section is taken as symmetric fore and aft: air from the trailing edge (u < 0) gives the mirrored force. The
//! circulation of feathering does so, too ([`Rotation::Circulation`], [`Unsteady`]). With one coefficient and by
//! [`Rotation::SaneDickinson`] it is reckoned from the leading edge whatever edge meets the air, as in the sources, and
//! then feathering in air from behind can take work out of air at rest.
//! Velocities along the span are ignored, as in all the sources, but by the moment of the added momentum.
//! Strips of wings that are not flat have frames of their own ([`PlacedStrip`]). Twist and bending of a wing
//! place and move its strips ([`SectionMotion`] where they are prescribed, [`MeshSection`] where loads bend the
//! wing).
//!
//! What this crate does not know: wakes of other strips, animals, coordinates; of time no more than the age of
//! a strip's wake.

mod bent;
mod body_drag;
pub mod coefficients;
mod deforming;
mod derivatives;
mod error;
mod feathering;
mod indicial;
mod lag;
mod pair;
mod settings;
mod slowed;
mod strip;
mod wind;
mod wing;

pub use bent::{MeshSection, NodesInMotion, SectionAnswer, SectionState};
pub use body_drag::BodyDrag;
pub use coefficients::{NamedSet, SETS, Translation, find_set};
pub use deforming::{DeformingLoad, SectionMotion};
pub use derivatives::{DerivativeTable, ReferenceSizes};
pub use error::BladeError;
pub use indicial::{Indicial, Pole, Unsteady};
pub use lag::{Lag, StripMemory, StripTrial, WingMemory};
pub use settings::{AddedMassModel, BladeSettings, CentreOfPressure, Rotation, ViscousMoment};
pub use strip::{PlacedStrip, Strip};
pub use wind::{Calm, LocalWind};
pub use wing::BladeWing;
