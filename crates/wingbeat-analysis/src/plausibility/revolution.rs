//! Wings that go round: rotors, propellers, revolving wings, seeds that spin.

use std::f64::consts::TAU;

use wingbeat_dynamics::{BodyMotion, ElementLaw, Joint, JointType};
use wingbeat_flight::setup::carriers::chain;
use wingbeat_flight::{FlightSetup, MotionMode, PrescribedMotion};
use wingbeat_math::{DVec3, DriftingFourier, RotationLaw};
use wingbeat_model::Wing;

/// Turns of which the wake is kept from which on what is left out is felt little in air at rest. Two blades of
/// aspect ratio 4 at 10 deg (thrust coefficient 0.007) have 27, 16, 11, 7, 4 and 2 % more thrust with 1, 1.5,
/// 2, 4, 6 and 8 turns kept; at 5 deg their wake is slower.
const TURNS: f64 = 8.0;

/// Way through the air while a row is kept, over that from the axis to the tip, from which on it is felt
/// little. The same blades in a climb at a tenth of their tip speed have 13, 8, 5, 3.5 and 1.8 % more thrust
/// with 0.3, 0.6, 0.9, 1.3 and 1.9 radii kept, at a fifth 7, 4, 2.4 and 1.4 % with 0.3, 0.6, 1.3 and 1.9; in an
/// edgewise stream of a fifth 15 and 7 % more with 0.3 and 0.6, 1 and 2 % less with 1.3 and 1.9.
const RADII: f64 = 1.5;

/// What was measured of short wakes.
const IN_TURNS: &str = "thrust of blades that go round came out 27, 11, 7 and 4 % high with 1, 2, 4 and 6 turns in hover, 8, 4 and 2 % with 1, 2 and 3 turns in a climb at a tenth of the tip speed";

/// A wing that goes round an axis no farther from its nearest node than it is long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Revolution {
    /// Rate about the axis [rad/s].
    rate: f64,
    /// Way from the axis to its farthest node \[m\].
    pub radius: f64,
}

impl Revolution {
    /// That of wing `w` as it begins, of the root or on a joint that is free to turn, the faster of them; none
    /// where it turns less than once in the flight. A wing that circles farther away leaves its wake behind.
    pub fn of(setup: &FlightSetup, w: usize) -> Option<Self> {
        let joints = chain(&setup.joints, w + 1);
        let on_joints = (0..joints.len()).filter_map(|k| on_joint(setup, w, &joints[..=k]));
        let all = on_joints.chain(with_root(setup, w, &joints));
        let flown = setup.time.steps as f64 * setup.time.step;
        let goes_round = all.filter(|r| r.rate * flown >= TAU);
        goes_round.max_by(|a, b| a.rate.total_cmp(&b.rate))
    }

    /// Time of a turn \[s\].
    pub fn period(&self) -> f64 {
        TAU / self.rate
    }

    /// Speed of the farthest node about the axis [m/s].
    pub fn tip_speed(&self) -> f64 {
        self.rate * self.radius
    }

    /// By what factor a wake of which rows are kept for `time` \[s\] is too short where the wing passes the air
    /// with `speed` [m/s], and what was measured of such wakes; none where what is left out is felt little.
    pub fn felt(&self, time: f64, speed: f64) -> Option<(f64, &'static str)> {
        let turns = TURNS * self.period() / time;
        let radii = RADII * self.radius / (speed * time);
        let times = turns.min(radii);
        (times > 1.0).then_some((times, IN_TURNS))
    }

    /// Of a wing of which these are the ways of nodes from the axis \[m\].
    fn new(rate: f64, wing: &Wing, ways: impl Iterator<Item = f64> + Clone) -> Option<Self> {
        let nearest = ways.clone().fold(f64::INFINITY, f64::min);
        let radius = ways.fold(0.0, f64::max);
        (rate > 0.0 && nearest <= wing.report().length).then_some(Self { rate, radius })
    }
}

/// Of wing `w` on the last of these joints, counted from its own.
fn on_joint(setup: &FlightSetup, w: usize, joints: &[&Joint]) -> Option<Revolution> {
    let (joint, outward) = joints.split_last()?;
    let JointType::Revolute { axis } = joint.model.kind else {
        return None;
    };
    let holds = |law: &ElementLaw| {
        let is_held = matches!(law, ElementLaw::Spring { .. } | ElementLaw::Follow { .. });
        is_held || matches!(law, ElementLaw::Stop { .. })
    };
    let rate = *joint.model.rates.first()?;
    if joint.model.elements.iter().any(|e| holds(&e.law)) {
        return None;
    }
    let wing = &setup.animal.wings[w];
    let nodes = wing.mesh.nodes.iter().map(|x| carried(wing, *x, outward));
    let ways = nodes.map(|x| (x - joint.anchor_child).reject_from(axis).length());
    Revolution::new(rate.abs(), wing, ways)
}

/// Of wing `w`, which hangs on these joints, with the root.
fn with_root(setup: &FlightSetup, w: usize, joints: &[&Joint]) -> Option<Revolution> {
    let (root, drift) = match &setup.mode {
        MotionMode::Tethered(motion) => steady(motion)?,
        MotionMode::Free(_) => (setup.root_at_start(), DVec3::ZERO),
    };
    let axis = (root.r * root.w).try_normalize()?;
    let rate = root.w.length();
    // Where the axis passes, from the origin of the root.
    let to_axis = axis.cross(root.v - drift) / rate;
    let wing = &setup.animal.wings[w];
    let in_root = |x: &DVec3| match joints {
        [] => wing.hinge_b + wing.motion.impulsive().at(0.0).c * *x,
        joints => carried(wing, *x, joints),
    };
    let nodes = wing.mesh.nodes.iter().map(in_root);
    let ways = nodes.map(|x| (root.r * x - to_axis).reject_from(axis).length());
    Revolution::new(rate, wing, ways)
}

/// The root of a tether at the start with its steady rates of turning, and its steady velocity [m/s]; none that
/// does not turn steadily.
fn steady(motion: &PrescribedMotion) -> Option<(BodyMotion, DVec3)> {
    let turns = |q: &DriftingFourier| q.rate != 0.0;
    motion.angles.iter().any(turns).then_some(())?;
    let mut turning = motion.impulsive();
    for angle in &mut turning.angles {
        angle.cosine.clear();
        angle.sine.clear();
    }
    let drift = DVec3::from_array(motion.position.each_ref().map(|x| x.rate));
    Some((turning.at(0.0).motion, drift))
}

/// Place of a node of a wing at `x` in the frame that carries the last of these joints, counted from its own,
/// at zero coordinates, at the start \[m\].
fn carried(wing: &Wing, x: DVec3, joints: &[&Joint]) -> DVec3 {
    let own = wing.motion.impulsive();
    let outward = joints.iter().enumerate();
    outward.fold(x, |x, (k, joint)| {
        let c = match (k, &joint.law) {
            (0, None) => own.at(0.0).c,
            _ => joint.rotation(0.0).c,
        };
        joint.anchor_parent + c * (x - joint.anchor_child)
    })
}
