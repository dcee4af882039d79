//! Every quantity that a history holds, in the order of its columns.

mod balances;
mod feedback;
mod loads;
mod motion;

use self::balances::{ENERGIES, MOMENTA, QUALITY, WAKE};
use self::feedback::{COMMANDS, HELD, LOOKS, REFERENCE};
use self::loads::{
    AIR, APPLIED, CONNECTIONS, COORDINATES, DEFORMATION, DISSIPATION, ELASTIC, HINGES, LOOPS,
    ORIENTATIONS, PASSIVE, TETHER,
};
use self::motion::{ACCELERATIONS, POSES, PRESCRIBED, RATES, ROOT, TIME};
use crate::series::quantity::{Group, HistoryQuantity, Of};

const fn group(of: Of, quantities: &'static [HistoryQuantity]) -> Group {
    Group { of, quantities }
}

/// The columns, group after group.
pub(crate) const GROUPS: &[Group] = &[
    group(Of::Flight, TIME),
    group(Of::Wings, PRESCRIBED),
    group(Of::Bodies, POSES),
    group(Of::Bodies, RATES),
    group(Of::Flight, ROOT),
    group(Of::Bodies, ACCELERATIONS),
    group(Of::Connections, CONNECTIONS),
    group(Of::Orientations, ORIENTATIONS),
    group(Of::Children, HINGES),
    group(Of::Loops, LOOPS),
    group(Of::Coordinates, COORDINATES),
    group(Of::Jointed, PASSIVE),
    group(Of::Deforming, DEFORMATION),
    group(Of::Elastic, ELASTIC),
    group(Of::Bending, DISSIPATION),
    group(Of::Bodies, AIR),
    group(Of::Bodies, APPLIED),
    group(Of::Flight, TETHER),
    group(Of::Flight, ENERGIES),
    group(Of::Flight, MOMENTA),
    group(Of::Flight, QUALITY),
    group(Of::Flight, WAKE),
    group(Of::Commanded, COMMANDS),
    group(Of::Steered, LOOKS),
    group(Of::Following, REFERENCE),
    group(Of::Holding, HELD),
];
