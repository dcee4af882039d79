//! All doubts about a setup, each once.

use crate::bodies::doubtful_masses;
use crate::setup::FlightSetup;

/// What is doubted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DoubtKind {
    /// Gusts that the flight never meets.
    LateGusts,
    /// Gusts that the steps do not resolve.
    ShortGusts,
    /// Gusts that press the air together, past bodies.
    PressedAir,
    /// A tether that starts otherwise than the wings.
    StartsApart,
    /// A smooth start that is not over when the flight is.
    LongStart,
    /// Commands or looks of a controller that the flight is too short for.
    LateCommands,
    /// Waypoints that the flight is too short for.
    LateWaypoints,
    /// Blade elements whose force of feathering jumps.
    JumpingRotation,
    /// Blade elements that excite the torsion of elastic wings.
    ExcitedTorsion,
    /// Masses beside lengths, or a gravity, that no animal has.
    Masses,
    /// Wings with the trailing edge ahead, or broadside where they are fastest.
    EdgeAhead,
    /// A body that turns so that still wings have the trailing edge ahead.
    RevolvesBackwards,
    /// Samples of wing angles that scatter, or are wrong.
    ScatteredAngles,
    /// Parts of the beat without samples of wing angles.
    GapsInAngles,
    /// Wings that pass through each other, or lie in each other.
    Crossing,
    /// Wings that pass through each other by little.
    Graze,
    /// Surfaces that face each other across gaps narrower than their panels.
    NarrowGaps,
    /// Wings inside parts of the body.
    InsideParts,
    /// Roots on parts of the body, or a little off them.
    RootsOnBodies,
    /// Roots or tips that meet, or nearly lie on a plane of images, and are not joined.
    UnjoinedEdges,
    /// Leading edges that shed vorticity of one sign.
    OneSidedEdges,
    /// Leading edges that shed one way over long steps.
    LongSteps,
    /// Edges that shed without trailing edges.
    NoTrailingEdges,
    /// Tips of wings whose flow is attached.
    AttachedTips,
    /// Wings far beyond stall whose flow is attached.
    AttachedBeyondStall,
    /// The same of strokes of insects, whose trailing edges and tips shed: as they are flown attached on purpose.
    AttachedStrokes,
    /// A liquid, or a gas of another density, with the viscosity of air at the ground.
    ViscosityOfAir,
    /// Fluid displaced whose weight counts, and is not computed.
    NoBuoyancy,
    /// A body that is light beside the fluid that it displaces.
    LightBody,
    /// Cores of wings that are wide beside the panels.
    WideBoundCore,
    /// Vortex lift of edges that are swept.
    SweptVortexLift,
    /// Sharply swept leading edges that shed on a way of chords.
    SweptShedding,
    /// Cores of wakes of leading edges that widen too little.
    ThinWakeCores,
}

/// A doubt about a setup.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// What is doubted.
    pub kind: DoubtKind,
    /// Why, and what to do about it: a clause without a full stop.
    pub said: String,
}

impl FlightSetup {
    /// All doubts about this setup.
    pub fn doubts(&self) -> Vec<Doubt> {
        use DoubtKind::*;
        let mut list = vec![];
        let mut add = |kind, all: Vec<String>| {
            list.extend(all.into_iter().map(|said| Doubt { kind, said }));
        };
        let one = |said: Option<String>| Vec::from_iter(said);
        add(Masses, doubtful_masses(self));
        for crossing in self.crossing_wings() {
            let kind = if crossing.is_graze { Graze } else { Crossing };
            add(kind, vec![crossing.said]);
        }
        add(Crossing, self.coincident_wings());
        add(Crossing, self.coincident_at_start());
        add(ScatteredAngles, self.scattered_angles());
        add(GapsInAngles, self.gaps_in_angles());
        add(EdgeAhead, self.trailing_edges_ahead());
        add(RevolvesBackwards, one(self.revolves_backwards()));
        add(StartsApart, one(self.starts_apart()));
        add(LongStart, self.starts_that_do_not_end());
        add(LateCommands, one(self.commands_too_late()));
        add(LateCommands, one(self.single_look()));
        add(LateWaypoints, one(self.late_waypoints()));
        add(LateGusts, self.gusts_that_never_arrive());
        add(ShortGusts, self.gusts_between_steps());
        add(PressedAir, self.gusts_that_press_air());
        add(JumpingRotation, one(self.jumping_rotation()));
        add(ExcitedTorsion, one(self.excited_torsion()));
        add(InsideParts, self.wings_inside_parts());
        add(NarrowGaps, self.surfaces_in_narrow_gaps());
        add(RootsOnBodies, self.roots_on_bodies());
        add(UnjoinedEdges, self.unjoined_roots());
        add(UnjoinedEdges, self.unjoined_tips());
        add(UnjoinedEdges, self.edges_off_planes());
        add(SweptVortexLift, one(self.vortex_lift_of_swept_edges()));
        add(SweptShedding, one(self.shedding_of_swept_edges()));
        add(ThinWakeCores, one(self.thin_cores_behind_leading_edges()));
        add(OneSidedEdges, one(self.one_sided_leading_edges()));
        add(LongSteps, one(self.long_steps_one_way()));
        add(NoTrailingEdges, one(self.shed_without_trailing_edges()));
        add(AttachedTips, one(self.tips_of_attached_wings()));
        add(AttachedBeyondStall, one(self.attached_beyond_stall()));
        add(AttachedStrokes, one(self.attached_strokes_beyond_stall()));
        add(ViscosityOfAir, one(self.foreign_viscosity_of_air()));
        add(NoBuoyancy, one(self.without_buoyancy()));
        add(LightBody, one(self.light_beside_fluid()));
        add(WideBoundCore, one(self.wide_bound_core()));
        list
    }
}
