//! How far loads moved the tips of elastic wings.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{ElasticRecord, FlightSetup, Record};
use wingbeat_model::{Bending, Members, Wing};

use super::verdict::Warnings;

/// Largest over a flight, of one elastic wing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Bent {
    /// Displacement of the tip over the larger of length and chord \[1\].
    displaced: f64,
    /// Distance of the tip from the root over that at rest, of wings that are held at the root alone; 0 of
    /// others \[1\].
    stretched: f64,
    /// Displacement of the tip from rest \[m\].
    tip: f64,
    /// Twist of the tip from rest \[rad\].
    twist: f64,
    /// Elastic energy \[J\].
    strain_energy: f64,
}

/// How far loads bent an elastic wing: the largest of a flight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BentWing {
    /// Name of the wing.
    pub wing: String,
    /// Displacement of the middle of its tip from rest \[m\].
    pub tip_displacement_m: f64,
    /// The same over the larger of its length and its chord \[1\].
    pub tip_displacement_relative: f64,
    /// Twist of its tip from rest, either way \[deg\].
    pub tip_twist_deg: f64,
    /// Elastic energy \[J\].
    pub strain_energy_joule: f64,
}

/// The elastic wings of a flight in which these were largest.
pub(super) fn wings(setup: &FlightSetup, all: &[Bent]) -> Vec<BentWing> {
    let of = |(wing, bent): (&Wing, &Bent)| BentWing {
        wing: wing.name.clone(),
        tip_displacement_m: bent.tip,
        tip_displacement_relative: bent.displaced,
        tip_twist_deg: bent.twist.to_degrees(),
        strain_energy_joule: bent.strain_energy,
    };
    elastic(setup).zip(all).map(of).collect()
}

/// Displacement over length that no wing comes back from by itself: its tip is turned by 60 degrees or more \[1\].
const FAR: f64 = 1.0;

/// Distance of tip from root over that at rest that no material bears \[1\].
const TORN: f64 = 1.1;

impl Bent {
    /// With what `wing` is at this step.
    fn take(&mut self, wing: &Wing, now: &ElasticRecord) {
        let tip = now.tip;
        self.tip = self.tip.max(tip.length());
        self.twist = self.twist.max(now.twist.abs());
        self.strain_energy = self.strain_energy.max(now.strain_energy);
        let mesh = &wing.mesh;
        let chord = |col: usize| [0, mesh.rows].map(|row| mesh.nodes[mesh.node(row, col)]);
        let [root, end] = [0, mesh.cols].map(chord);
        let wide = [root, end].map(|[a, b]| a.distance(b));
        let [root, end] = [root, end].map(|[a, b]| a.midpoint(b));
        let length = end.distance(root);
        let size = length.max(wide[0]).max(wide[1]);
        self.displaced = self.displaced.max(tip.length() / size);
        if is_held_at_the_root_alone(wing) {
            self.stretched = self.stretched.max((end + tip).distance(root) / length);
        }
    }

    /// Takes the next step of a flight, of all elastic wings.
    pub(super) fn take_all(all: &mut Vec<Self>, r: &Record, setup: &FlightSetup) {
        all.resize(r.elastic.len(), Self::default());
        for ((bent, wing), e) in all.iter_mut().zip(elastic(setup)).zip(&r.elastic) {
            bent.take(wing, e);
        }
    }
}

fn elastic(setup: &FlightSetup) -> impl Iterator<Item = &Wing> {
    (setup.animal.wings.iter()).filter(|w| w.structure.is_some())
}

/// The shape of an elastic wing as a record has it.
pub(super) fn bending(wing: &Wing, now: &ElasticRecord) -> Bending {
    let is_held = match wing.structure.as_ref().map(|s| &s.members) {
        Some(Members::Shell(s)) => s.clamps_root || s.clamps_perimeter,
        _ => true,
    };
    Bending {
        sections: now.sections.map(|s| [s.deflection, s.twist, s.camber]),
        tip: now.tip.truncate(),
        is_held,
    }
}

fn is_held_at_the_root_alone(wing: &Wing) -> bool {
    match wing.structure.as_ref().map(|s| &s.members) {
        Some(Members::Shell(s)) => {
            let elsewhere = s.clamps_leading_edge || s.clamps_perimeter || s.rigid_fraction > 0.0;
            s.clamps_root && !elsewhere && s.veins.iter().all(|v| !v.is_clamped)
        }
        _ => true,
    }
}

/// Wings that were torn or bent double.
pub(super) fn warnings(setup: &FlightSetup, all: &[Bent], list: &mut Warnings) {
    let remedy = "Look at the units of its structure, at its mass and at the loads (`wingbeat check` helps).";
    for (wing, bent) in elastic(setup).zip(all) {
        let name = &wing.name;
        let Bent {
            displaced,
            stretched,
            ..
        } = bent;
        if *stretched > TORN {
            list.fault(format!(
                "The wing `{name}` was torn: its tip was {stretched:.2} times as far from its root as at rest. {remedy}"
            ));
        } else if *displaced > FAR {
            list.limit(format!(
                "The wing `{name}` was bent double: its tip was displaced by {displaced:.2} times its length. {remedy}"
            ));
        }
    }
}
