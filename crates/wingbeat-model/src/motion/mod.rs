//! Wing motion: three prescribed angles per wing, `C(t) = R2(eta) R1(phi) R3(theta) R2(psi)`.
//!
//! `eta` is the constant stroke-plane pitch. Angles are laws of the phase x \[wingbeats\]; the
//! phase runs as `x(t) = f tau(t) + x0` with a time warp tau that lets the motion rise from
//! rest. Derivatives are analytic: `q' = q_x x'`, `q'' = q_xx x'^2 + q_x x''`.

pub mod adjust;
pub mod berman_wang;
mod fit;
pub mod fourier;
mod scatter;
pub mod spline;
pub mod split_cycle;
pub mod start;
mod wing_motion;

pub use adjust::Adjustment;
pub use berman_wang::{Oval, SmoothSquare, SmoothTriangle};
pub(crate) use fit::{FourierFit, check_gaps};
pub use fourier::Fourier;
pub use scatter::Scatter;
pub use spline::PeriodicSpline;
pub use split_cycle::SplitCycle;
pub use start::Start;
pub use wing_motion::{AngleLaw, AngleLaws, WingMotion, wing_rotation};
