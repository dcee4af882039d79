//! Doubts about the setup: what each makes of the verdict, and under which heading it stands.

use wingbeat_flight::{AirModel, Doubt, DoubtKind, FlightSetup};

use crate::summary::verdict::{Verdict, Warnings};

/// Of wings that pass through each other by their prescribed motion.
const IMPOSSIBLE: &str = "The prescribed motion is impossible: ";

/// Of wings that pass through each other in other air than a lattice.
pub(super) const NOT_FELT: &str = " No animal beats so, and the air of this case does not feel it.";

/// Of surfaces of a lattice that are in one place.
pub(super) const NO_MEANING: &str = " The forces of those instants have no meaning, nor have the means and motions that they are part of.";

/// Of wings in a lattice that pass through each other by little.
pub(super) const GRAZE_EACH_OTHER: &str = "Wings graze each other: ";

/// What follows from it.
/// Plane wings of aspect ratio 7 that flap in a stream with the hinges 0 to 8 mm aside, by 3 to 0 % of a chord through
/// each other and apart: their mean lift goes on smoothly from one to the other, 2 % in all.
pub(super) const GRAZES: &str = " Loads of the panels that graze are wrong at those instants; mean forces of whole wings went on smoothly in trials from wings that graze so to wings just apart.";

/// Where doubts stand among the warnings; they keep the order of [`FlightSetup::doubts`].
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// Before the balances: why these do not close.
    Cause,
    /// With the motion.
    Motion,
    /// With the air.
    Air,
}

/// Says the doubts of a place.
pub(super) fn say(setup: &FlightSetup, doubts: &[Doubt], place: Place, list: &mut Warnings) {
    let is_lattice = matches!(setup.air, AirModel::VortexLattice(_));
    for doubt in doubts {
        let (at, verdict, heading, consequence) = heard(doubt.kind, is_lattice);
        if at != place {
            continue;
        }
        let text = match heading {
            "" => doubt.said.clone(),
            _ => format!("{heading}{}.{consequence}", doubt.said),
        };
        list.add(verdict, text);
    }
}

/// Of a kind of doubt: place, verdict, heading, and what follows from it.
#[rustfmt::skip]
fn heard(kind: DoubtKind, is_lattice: bool) -> (Place, Verdict, &'static str, &'static str) {
    use Place::*;
    use Verdict::{Amber, Green, Red};
    match kind {
        DoubtKind::ScatteredAngles => (Cause, Amber, "Angles that scatter: ", ""),
        DoubtKind::GapsInAngles => (Cause, Amber, "Angles with gaps: ", ""),
        DoubtKind::Crossing if is_lattice => (Motion, Red, IMPOSSIBLE, NO_MEANING),
        DoubtKind::Graze if is_lattice => (Motion, Amber, GRAZE_EACH_OTHER, GRAZES),
        DoubtKind::Crossing | DoubtKind::Graze => (Cause, Amber, IMPOSSIBLE, NOT_FELT),
        DoubtKind::Masses => (Motion, Amber, "", ""),
        DoubtKind::EdgeAhead | DoubtKind::RevolvesBackwards => (Motion, Amber, "Wings that fly backwards: ", ""),
        DoubtKind::StartsApart => (Motion, Amber, "Tether and strokes out of step: ", ""),
        DoubtKind::LongStart => (Motion, Green, "A start that does not end: ", ""),
        DoubtKind::LateCommands => (Motion, Amber, "A controller without effect: ", ""),
        DoubtKind::LateWaypoints => (Motion, Green, "A way that is not flown to its end: ", ""),
        DoubtKind::LateGusts => (Motion, Green, "A gust without effect: ", ""),
        DoubtKind::ShortGusts => (Motion, Amber, "Gusts that the steps do not resolve: ", ""),
        DoubtKind::PressedAir => (Motion, Amber, "Air that is pressed together: ", ""),
        DoubtKind::JumpingRotation => (Motion, Green, "No derivatives of the air are known: ", ""),
        DoubtKind::ExcitedTorsion => (Cause, Amber, "Torsion that the air excites: ", ""),
        DoubtKind::InsideParts => (Air, Red, "A wing and a body cannot both be surfaces of the lattice in one place: ", NO_MEANING),
        DoubtKind::NarrowGaps => (Air, Amber, "Gaps narrower than the panels: ", ""),
        DoubtKind::RootsOnBodies => (Air, Amber, "A wing on a body is a limit of the lattice: ", ""),
        DoubtKind::UnjoinedEdges => (Air, Amber, "A gap is a limit of the lattice: ", ""),
        DoubtKind::SweptVortexLift | DoubtKind::SweptShedding => (Air, Amber, "Outside of what it was made for: ", ""),
        DoubtKind::OneSidedEdges | DoubtKind::LongSteps | DoubtKind::AttachedTips | DoubtKind::AttachedBeyondStall => (Air, Amber, "By the prescribed motion ", ""),
        DoubtKind::NoTrailingEdges => (Air, Amber, "No Kutta condition: ", ""),
        DoubtKind::ThinWakeCores => (Air, Amber, "Wakes that are not resolved: ", ""),
        DoubtKind::AttachedStrokes => (Air, Green, "By the prescribed motion ", ""),
        DoubtKind::ViscosityOfAir => (Air, Amber, "Two fluids: ", ""),
        DoubtKind::NoBuoyancy => (Motion, Amber, "No buoyancy: ", ""),
        DoubtKind::LightBody => (Motion, Green, "A light body: ", ""),
        DoubtKind::WideBoundCore => (Air, Green, "Lift that is high: ", ""),
    }
}
