//! Gusts that a flight never meets.

use wingbeat_air::{Gust, GustShape};
use wingbeat_dynamics::{Joint, JointType};
use wingbeat_math::{DVec3, largest};
use wingbeat_model::BodyPart;

use crate::setup::carriers::chain;
use crate::setup::{FlightSetup, LOOKS, MotionMode, PrescribedMotion};

impl FlightSetup {
    /// Says which gusts of the wind no point of body and wings meets: they begin there only after the end of the flight,
    /// or are over before it begins. A tether takes the animal with it; one that flies freely is where its velocity at
    /// the release takes it, or anywhere as far from there as it could have fallen since.
    pub fn gusts_that_never_arrive(&self) -> Vec<String> {
        let Some(wind) = self.air.wind().filter(|wind| !wind.gusts.is_empty()) else {
            return vec![];
        };
        let end = self.time.steps as f64 * self.time.step;
        let (motion, reach) = (self.supported(), self.reach());
        let instants = || self.time.instants(LOOKS).chain([end]);
        // Least and largest own time of the gust at the animal during the flight [s].
        let own = |g: &Gust| {
            let at = |t: f64| {
                let (place, off) = self.place(&motion, t);
                let tau = t - g.start - g.slowness.dot(place);
                let spread = match g.slowness == DVec3::ZERO {
                    true => 0.0,
                    false => g.slowness.length() * (reach + off),
                };
                [tau - spread, tau + spread]
            };
            let wider = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.min(c), b.max(d)];
            let all = instants().map(at);
            all.fold([f64::INFINITY, f64::NEG_INFINITY], wider)
        };
        let say = |(k, g): (usize, &Gust)| {
            let ([least, most], first) = (own(g), first(&g.shape));
            if most <= first {
                let later = first - most;
                return Some(format!(
                    "air.gust[{k}] begins {later:.3} s after the end of the flight, which lasts {end:.3} s, and has no effect: let it begin earlier (start_s), or fly longer"
                ));
            }
            let over = last(&g.shape)?;
            (least >= over).then(|| {
                format!(
                    "air.gust[{k}] is over before the flight begins, and has no effect: let it begin later (start_s)"
                )
            })
        };
        wind.gusts.iter().enumerate().filter_map(say).collect()
    }

    /// Motion of the root on its tether, or before its release.
    fn supported(&self) -> PrescribedMotion {
        match &self.mode {
            MotionMode::Tethered(motion) => motion.clone(),
            MotionMode::Free(start) => start.hold(),
        }
    }

    /// Where the root is at time `t` [s], N components, and how far from there it may be [m], by its motion on the
    /// support.
    fn place(&self, supported: &PrescribedMotion, t: f64) -> (DVec3, f64) {
        let release = match &self.mode {
            MotionMode::Tethered(_) => f64::INFINITY,
            MotionMode::Free(start) => start.held_steps as f64 * self.time.step,
        };
        let root = supported.at(t.min(release)).motion;
        let flown = (t - release).max(0.0);
        let fall = 0.5 * self.gravity.length() * flown * flown;
        (root.p + flown * root.v, fall)
    }

    /// How far from the origin of the root any point of body and wings can be, however the joints stand \[m\]; without
    /// bound where a joint lets a body slide.
    fn reach(&self) -> f64 {
        let farthest = |nodes: &[DVec3]| largest(nodes.iter().map(|x| x.length()));
        let of_parts = |parts: &[BodyPart]| largest(parts.iter().map(|p| farthest(&p.mesh.nodes)));
        let animal = &self.animal;
        let wings = animal.wings.iter().map(|w| farthest(&w.mesh.nodes));
        let segments = animal.segments.iter().map(|s| of_parts(&s.parts));
        let bodies = [of_parts(&animal.parts)].into_iter();
        let bodies = bodies.chain(wings).chain(segments).enumerate();
        largest(bodies.map(|(body, size)| self.way_to(body) + size))
    }

    /// Length of the way from the origin of the root over joints and hinges to that of body number `body` \[m\].
    fn way_to(&self, body: usize) -> f64 {
        let joints = chain(&self.joints, body);
        let link = |joint: &&Joint| {
            use JointType::{PointOnLine, Prismatic};
            let kind = joint.model.kind;
            let slides = matches!(kind, Prismatic { .. } | PointOnLine { .. });
            match slides || joint.model.travel.is_some() {
                true => f64::INFINITY,
                false => joint.anchor_parent.length() + joint.anchor_child.length(),
            }
        };
        // The first of them may hang on a wing that beats by its own angles.
        let first = joints.last().map_or(Some(body), |joint| joint.parent);
        let wing = first.and_then(|body| self.animal.wings.get(body.checked_sub(1)?));
        wing.map_or(0.0, |w| w.hinge_b.length()) + joints.iter().map(link).sum::<f64>()
    }
}

/// The gust's own time from which it blows no more [s]; none of one that blows on.
fn last(shape: &GustShape) -> Option<f64> {
    match shape {
        GustShape::OneMinusCosine { duration } => Some(*duration),
        GustShape::Table(rows) => rows.last().filter(|row| row.1 == 0.0).map(|row| row.0),
        GustShape::Turbulence(_) => None,
    }
}

/// The gust's own time from which it blows [s].
fn first(shape: &GustShape) -> f64 {
    match shape {
        GustShape::Table(rows) => rows.first().map_or(0.0, |row| row.0),
        GustShape::OneMinusCosine { .. } | GustShape::Turbulence(_) => 0.0,
    }
}
