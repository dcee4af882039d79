//! The rigid body that the central body makes with all that is welded to it.

use wingbeat_dynamics::{BodyMotion, Configuration, Joint, Placement};
use wingbeat_flight::{AppliedLoad, FlightSetup, system_of};
use wingbeat_math::{DVec3, MassProperties};

use crate::AnalysisError;

/// Mass and weights of a flyer whose bodies do not move against each other.
pub(crate) struct Welded {
    /// Of the central body and its segments, about the origin of the body frame and in its axes.
    pub mass: MassProperties,
    /// Buoyancy and other constant loads along gravity: of each the point in the body frame \[m\], and the force \[N\],
    /// N components.
    pub weights: Vec<[DVec3; 2]>,
}

/// Parts of a wingbeat at which segments are looked at \[1\]: unevenly spaced, so that no harmonic hides.
const LOOKS: [f64; 6] = [0.0, 0.137, 0.291, 0.433, 0.587, 0.719];

impl Welded {
    /// That of a setup whose wings have no mass.
    ///
    /// # Errors
    /// A joint that leaves a motion free or holds the flyer to the ground; a segment that moves; a load on a wing.
    pub fn of(setup: &FlightSetup) -> Result<Self, AnalysisError> {
        check_joints(&setup.joints)?;
        let animal = &setup.animal;
        let first = 1 + animal.wings.len();
        let on_wing = |l: &&AppliedLoad| (1..first).contains(&l.body);
        if let Some(load) = setup.loads.iter().find(on_wing) {
            let wing = &animal.wings[load.body - 1].name;
            return Err(not_rigid(format!(
                "a load ([[load]]) acts on wing `{wing}`"
            )));
        }
        let at = still(setup)?;
        let mut mass = animal.body;
        for (segment, at) in animal.segments.iter().zip(&at[first..]) {
            mass = mass + segment.mass.moved(at.c, at.d);
        }
        let weight = |load: &AppliedLoad| {
            let at = &at[load.body];
            let force = load.wrench(0.0, &BodyMotion::REST).force;
            [at.d + at.c * load.point, force]
        };
        Ok(Self {
            mass,
            weights: setup.loads.iter().map(weight).collect(),
        })
    }
}

/// Where all bodies are, seen from the central body.
///
/// # Errors
/// Bodies or joints that the dynamics refuse; a segment that moves.
fn still(setup: &FlightSetup) -> Result<Vec<Placement>, AnalysisError> {
    let system = system_of(setup)?;
    let period = setup.time.period.unwrap_or(1.0);
    let [start, later @ ..] = LOOKS.map(|part| {
        let mut at = Configuration::new(&system);
        at.update(&system, part * period);
        at.placements().to_vec()
    });
    let first = 1 + setup.animal.wings.len();
    for (segment, k) in setup.animal.segments.iter().zip(first..) {
        let is_there = |at: &Vec<Placement>| at[k].c == start[k].c && at[k].d == start[k].d;
        if !later.iter().all(is_there) {
            return Err(not_rigid(format!("segment `{}` moves", segment.name)));
        }
    }
    Ok(start)
}

fn check_joints(joints: &[Joint]) -> Result<(), AnalysisError> {
    let is_free = |j: &&Joint| j.model.kind.directions() > 0;
    if let Some(joint) = joints.iter().find(is_free) {
        let what = format!("joint `{}` leaves a motion free", joint.name);
        return Err(not_rigid(what));
    }
    match joints.iter().find(|j| j.parent.is_none()) {
        None => Ok(()),
        Some(joint) => Err(not_rigid(format!(
            "joint `{}` holds the animal to the ground",
            joint.name
        ))),
    }
}

fn not_rigid(what: String) -> AnalysisError {
    AnalysisError::not_covered(
        format!("{what}, and the linear model of a table of derivatives is that of a rigid body"),
        "weld the segments to the body (joint.NAME.kind = \"weld\", without turn or travel), or fly the case with `run`",
    )
}
