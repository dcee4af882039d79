//! Loads of one instant.

use crate::geometry::Panels;
use crate::state::{ImpulseAccount, InnerFlow};
use wingbeat_math::DVec3;

/// What the air does to one surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceLoads {
    /// Force of the air [N], N components.
    pub force: DVec3,
    /// Moment of the air about the origin of N [N m], N components.
    pub moment: DVec3,
    /// Net-flux residual: uniform normal velocity that the rings of a closed surface cannot make [m/s].
    pub net_flux_residual: f64,
}

/// Loads of one instant, panel by panel, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AirLoads {
    /// Time [s].
    pub time: f64,
    /// Time since the last accepted step [s]; without meaning at step 0.
    pub dt: f64,
    /// Geometry of the panels; forces act at the control points, with the couples besides.
    pub panels: Panels,
    /// Circulation of the rings, the jump of the potential along the normal [m2/s].
    pub gamma: Vec<f64>,
    /// Its rate of change on the moving panel [m2/s2].
    pub gamma_rate: Vec<f64>,
    /// Velocity of the air at the control points, the mean of the two sides [m/s].
    pub velocity: Vec<DVec3>,
    /// Jump of the tangential velocity along the normal [m/s].
    pub velocity_jump: Vec<DVec3>,
    /// Pressure behind the panel less pressure before it, the normal pointing forward [Pa]:
    /// positive pushes along the normal. On a closed surface ambient less outer pressure, which has the force of
    /// the panels; so far as a constant goes, which makes no force, by the dynamic pressure of the air past the centroid.
    pub pressure_jump: Vec<f64>,
    /// Force of the air on the panel [N]: as [`crate::LoadMethod`] has it; on a closed surface
    /// pressure jump x area x normal, but for the constant that makes no force.
    pub force: Vec<DVec3>,
    /// Moment of the air on the panel about its control point [N m]: forces act where the vorticity lies that feels
    /// them. Zero on closed surfaces.
    pub couple: Vec<DVec3>,
    /// What the separation criterion compares with its threshold, for each leading-edge strip
    /// (angle [rad], suction parameter [1]; zero for the criteria that need none).
    pub leading: Vec<f64>,
    /// Circulation that the leading edge of each strip holds before flow leaves it, 0 where all leaves [m2/s].
    pub hold: Vec<f64>,
    /// Circulation that leaves the leading edge of each strip within the step, where that is part of the
    /// solution, counted as that of panels [m2/s].
    pub leaving: Vec<f64>,
    /// Chords for which the leading-edge vortex of each strip has been fed, less what was lost \[1\]:
    /// [`crate::VortexLift`].
    pub fed: Vec<f64>,
    /// Strips that shed with a bounded effect on their own suction, or what they have too much for want of a
    /// solution that holds the suction of all.
    pub unfound: u64,
    /// Resultants of the surfaces.
    pub surfaces: Vec<SurfaceLoads>,
    /// Flow of the fictitious fluid inside each surface.
    pub inner: Vec<InnerFlow>,
    /// Force on all surfaces of the inviscid air alone [N], N, with the suction of the edges that do not shed,
    /// whatever the forces of the panels make of it: without friction and profile drag, and without Polhamus's
    /// normal force. It is what the impulse is to be compared with.
    pub inviscid_force: DVec3,
    /// Impulse of all vorticity, that of dropped wakes included, less the momentum of the fictitious
    /// fluid [kg m/s], N components. In air that is at rest or in uniform motion far away, without images, its
    /// rate of decrease is the inviscid force on all surfaces together: a method independent of pressures and segments
    /// [Saffman 1992, Vortex Dynamics, ch. 3].
    pub impulse: DVec3,
    /// Where that came from and went: its `created` and `moved` and `converted` together.
    pub account: ImpulseAccount,
    /// The part of what is attached, lattice and newest rows, less the momentum of the fictitious fluid [kg m/s], N
    /// components.
    pub attached_impulse: DVec3,
    /// Largest normal velocity through a control point, the net-flux residual apart [m/s].
    pub normal_velocity_residual: f64,
}
