//! Stops of joints that are reached: how often, and how far they give way.

use serde::{Deserialize, Serialize};
use wingbeat_dynamics::{ElementLaw, JointType, Mechanism};

use super::said::{grouped, names};
use crate::bodies::system_of;
use crate::interface::record::Record;
use crate::setup::FlightSetup;

/// How far a stop gives way at least that stops little \[rad\]: 5 deg. That of a hinge is meant to give way by one or two.
const SOFT: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// A stop, and what was seen of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Stop {
    joint: String,
    /// Number of the coordinate among those of all joints ([`Record::joints`]).
    place: usize,
    slides: bool,
    /// Ends of the free range [rad or m].
    range: [f64; 2],
    /// Steps beyond either end.
    steps: usize,
    /// How far beyond at most [rad or m].
    depth: f64,
}

/// Gathered step by step: stops that were reached.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct StruckStops {
    /// Those of the flight, from its first step on.
    all: Option<Vec<Stop>>,
    steps: usize,
}

impl StruckStops {
    /// Takes the next step of a flight of `setup`.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        self.steps += 1;
        for stop in self.all.get_or_insert_with(|| stops_of(setup)) {
            let Some([q, _]) = r.joints.get(stop.place) else {
                continue;
            };
            let depth = (stop.range[0] - q).max(q - stop.range[1]);
            if depth > 0.0 {
                stop.steps += 1;
                stop.depth = stop.depth.max(depth);
            }
        }
    }

    /// Says which stops were reached, how often and how far beyond, and what to do where they are soft; those of which
    /// the same is said together.
    pub fn found(&self) -> Vec<String> {
        let reached = self.all.iter().flatten().filter(|s| s.steps > 0);
        let told = reached.map(|s| (s.told(self.steps), &s.joint[..]));
        let say = |(text, joints): (String, Vec<&str>)| {
            let joint = if joints.len() == 1 { "joint" } else { "joints" };
            format!("{joint} {} {text}", names(joints, " and "))
        };
        grouped(told).into_iter().map(say).collect()
    }
}

impl Stop {
    /// What is said of it after so many steps of the flight, without its name.
    fn told(&self, steps: usize) -> String {
        let (unit, size) = match self.slides {
            true => ("mm", 1e3),
            false => ("deg", 1f64.to_degrees()),
        };
        let [from, to, depth] = [self.range[0], self.range[1], self.depth].map(|x| size * x);
        let part = (100.0 * self.steps as f64 / steps as f64).max(1.0);
        let remedy = match !self.slides && self.depth > SOFT {
            true => {
                "; so soft a stop stops little: a stiffer one (stop.stiffness_newton_m_per_rad) gives way by a degree or two"
            }
            false => "",
        };
        format!(
            "went beyond the stop from {from:.1} to {to:.1} {unit} in {part:.0} % of the flight, by up to {depth:.1} {unit}{remedy}"
        )
    }
}

/// The stops of all joints.
fn stops_of(setup: &FlightSetup) -> Vec<Stop> {
    let Ok(system) = system_of(setup) else {
        return vec![];
    };
    let mechanism = Mechanism::of(&system);
    let mut all = vec![];
    let mut first = 0;
    for joint in mechanism.joints() {
        for element in &joint.model.elements {
            if let ElementLaw::Stop { lower, upper, .. } = element.law {
                all.push(Stop {
                    joint: joint.name.clone(),
                    place: first + element.direction,
                    slides: matches!(joint.model.kind, JointType::Prismatic { .. }),
                    range: [lower, upper],
                    steps: 0,
                    depth: 0.0,
                });
            }
        }
        first += joint.model.kind.directions();
    }
    all
}
