//! The numbers of an estimate.

use wingbeat_math::DVec3;
use wingbeat_model::motion::wing_rotation;
use wingbeat_model::{DeformingMesh, Wing, WingReport};

/// What is expected of one wing.
#[derive(Clone, Debug, PartialEq)]
pub struct WingEstimate {
    /// Sizes of the wing.
    pub report: WingReport,
    /// Stroke angle from end to end \[rad\]; 0 for a wing that does not flap.
    pub stroke_amplitude: f64,
    /// Mean speed of the tip over a beat, relative to the body, by the angles of the wing and its surface if that was
    /// measured; of a wing that joints or other wings move, by their motion if that is faster [m/s].
    pub tip_speed: f64,
    /// Whether joints that leave anything free move it, as it rides on another wing or has no stroke of its own:
    /// its motion is not known beforehand, and speeds are those of its own stroke.
    pub hangs_free: bool,
    /// The largest of tip speed, flight speed and the speed at which a tether moves the tip [m/s].
    pub speed: f64,
    /// Reynolds number of the mean chord; none where the viscosity or the motion is not known \[1\].
    pub reynolds: Option<f64>,
    /// Reduced frequency of the mean chord; none where nothing flaps or moves \[1\].
    pub reduced_frequency: Option<f64>,
    /// First frequency in vacuum, the hinge held \[Hz\]; none of rigid wings and of structures too large to say
    /// it at once.
    pub first_frequency: Option<f64>,
    /// Whether stiffnesses differ by more than rounding, which hides it.
    pub hides_frequency: bool,
    /// It over the wingbeat frequency \[1\].
    pub frequency_ratio: Option<f64>,
}

/// What is expected of a flight.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Mass \[kg\].
    pub mass: f64,
    /// Wingbeats per second \[Hz\]; none for motions without a period.
    pub frequency: Option<f64>,
    /// Speed through the undisturbed air at the start [m/s].
    pub flight_speed: f64,
    /// Weight over the area of all wings [N/m2]; none without weight or wings.
    pub wing_loading: Option<f64>,
    /// Moments of inertia of the central body about its mass centre, body axes [kg m2].
    pub inertia: DVec3,
    /// Kinematic viscosity [m2/s]: that of the case, or of a gas of its density.
    pub viscosity: Option<f64>,
    /// The wings, in the animal's order.
    pub wings: Vec<WingEstimate>,
    /// Mean lift over weight in the attitude and at the velocity of the start, by blade elements; none without
    /// weight, air or wingbeats \[1\].
    pub lift_over_weight: Option<f64>,
    /// Why the lift is left out, where the blade elements could not be flown.
    pub lift_left_out: Option<String>,
    /// What is implausible, in whole sentences; empty where nothing is.
    pub doubts: Vec<String>,
}

/// What moves a wing beside its own stroke.
pub(super) struct Moved {
    /// Fastest speed through the undisturbed air at which a tether moves its tip, strokes left out [m/s].
    pub by_tether: f64,
    pub by_joints: ByJoints,
}

/// How joints move a wing relative to the body.
pub(super) enum ByJoints {
    /// Not at all, or what they leave free is small beside its own stroke, as at a passive hinge.
    No,
    /// They leave nothing free: mean speed of its tip relative to the body [m/s].
    Prescribed(f64),
    /// One leaves something free.
    Free,
}

impl Estimate {
    pub(super) fn wing(&self, wing: &Wing, report: WingReport, moved: &Moved) -> WingEstimate {
        let stroke_amplitude = stroke_amplitude(wing);
        let f = wing.motion.frequency;
        let own = f * path_of_tip(wing);
        let (tip_speed, hangs_free) = match moved.by_joints {
            ByJoints::No => (own, false),
            ByJoints::Prescribed(speed) => (own.max(speed), false),
            ByJoints::Free => (own, true),
        };
        let speed = tip_speed.max(self.flight_speed).max(moved.by_tether);
        let flaps = tip_speed > 0.0 && !hangs_free;
        let viscosity = self.viscosity.filter(|_| !hangs_free);
        WingEstimate {
            stroke_amplitude,
            tip_speed,
            hangs_free,
            speed,
            reynolds: viscosity.map(|nu| speed * report.mean_chord / nu),
            reduced_frequency: flaps.then(|| std::f64::consts::PI * f * report.mean_chord / speed),
            report,
            first_frequency: None,
            hides_frequency: false,
            frequency_ratio: None,
        }
    }
}

/// Phases at which a beat is looked at.
pub(super) const SAMPLES: usize = 200;

/// Chords in which the way of a tip in a beat is measured: a sine of 60 deg to either side is short by 4e-7 of it, one
/// that is passed twenty times in a beat by 2e-4.
const CHORDS: usize = 2000;

/// Way of the tip in a beat in the axes of the stroke plane \[m\]: of the end of the span, on axis 2, which feathering
/// does not move, of a measured surface of the tip of its leading edge.
fn path_of_tip(wing: &Wing) -> f64 {
    let shape = (wing.deformation.as_ref()).filter(|d| d.surface.is_some());
    let shape = shape.map(|d| DeformingMesh::new(&wing.mesh, d));
    let (node, length) = (wing.mesh.node(0, wing.mesh.cols), wing.length());
    let angles = &wing.motion.angles;
    let at = |k: usize| {
        let x = k as f64 / CHORDS as f64;
        let tip = (shape.as_ref()).map_or(length * DVec3::Y, |mesh| mesh.places(x)[node]);
        let laws = [&angles.phi, &angles.theta, &angles.psi];
        wing_rotation([0.0; 3], laws.map(|law| law.at(x))).c * tip
    };
    let places: Vec<DVec3> = (0..=CHORDS).map(at).collect();
    places.windows(2).map(|p| p[0].distance(p[1])).sum()
}

/// Largest less smallest stroke angle of a beat \[rad\].
pub fn stroke_amplitude(wing: &Wing) -> f64 {
    let phi = |k: usize| wing.motion.angles.phi.at(k as f64 / SAMPLES as f64)[0];
    let ends = (0..SAMPLES)
        .map(phi)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], x| {
            [lo.min(x), hi.max(x)]
        });
    ends[1] - ends[0]
}
