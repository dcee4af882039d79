//! Prescribed motions that no animal has, and of which no vortex lattice says what the air does.

use wingbeat_model::{
    BodyPart, Crossing, FlownCrossings, are_joined, coincident, crossing_depth, crossings,
    in_one_place, inside,
};

use super::said::names;
use crate::bodies::motions_at_start;
use crate::setup::FlightSetup;

/// Depth ([`crossing_depth`]) over the mean chord up to which wings that pass through each other graze \[1\].
const GRAZE: f64 = 0.03;

/// Wings that pass through each other.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossingWings {
    /// The two, among the wings of the animal.
    pub wings: [usize; 2],
    /// Which, for how long, how deep, and what to do about it.
    pub said: String,
    /// Whether they do so by no more than 3 % of a mean chord.
    pub is_graze: bool,
}

impl FlightSetup {
    /// Says which wings pass through each other in their prescribed motion ([`crossings`]), and what to do
    /// about it; wings with joints of their own, whose motion is not known beforehand, are left out.
    pub fn crossing_wings(&self) -> Vec<CrossingWings> {
        let joined = self.joined_pairs();
        let say = |c: Crossing| {
            let is_joined = are_joined(&joined, c.wings);
            let depth = crossing_depth(&self.animal, c.wings, is_joined);
            self.say_crossing(&c, depth, ("beat", self.apart(&c, is_joined)))
        };
        self.prescribed_crossings().into_iter().map(say).collect()
    }

    /// Says which wings lie in each other over most of their area and of the beat in their prescribed motion
    /// ([`coincident`]), those that hang on other wings with the motion of these; wings on joints that leave
    /// anything free are left out.
    pub fn coincident_wings(&self) -> Vec<String> {
        let remedy = |pair: [usize; 2]| match pair.iter().any(|&w| self.has_own_joint(w)) {
            true => "move hinge or joint (hinge_m; at_m of the joint)",
            false => "move their hinges apart (hinge_m)",
        };
        let say = |(pair, part): ([usize; 2], f64)| {
            let [a, b] = pair.map(|w| &self.animal.wings[w].name);
            format!(
                "wings `{a}` and `{b}` lie in each other in {:.0} % of the beat, less than 2 % of a mean chord apart over most of their area: blade elements count the air's force twice, and the lattice's equations are singular or nearly so; remove one of them, or {}",
                100.0 * part,
                remedy(pair)
            )
        };
        self.coincident_pairs().into_iter().map(say).collect()
    }

    /// Says which wings of a lattice start in each other, one of them on a joint that leaves its motion free.
    pub fn coincident_at_start(&self) -> Vec<String> {
        let is_free = |w: usize| self.prescribed_in_body(w, 0.0).is_none();
        if self.air.lattice().is_none() || !(0..self.animal.wings.len()).any(is_free) {
            return vec![];
        }
        let Ok(motions) = motions_at_start(self) else {
            return vec![]; // refused elsewhere
        };
        let poses: Vec<_> = motions.iter().skip(1).map(|m| (m.p, m.r)).collect();
        let mut found = in_one_place(&self.animal, &poses);
        found.retain(|pair| pair.iter().any(|&w| is_free(w)));
        let say = |pair: [usize; 2]| {
            let [a, b] = pair.map(|w| &self.animal.wings[w].name);
            format!(
                "wings `{a}` and `{b}` start in each other, less than 2 % of a mean chord apart over most of their area, where the lattice's equations are singular or nearly so: {}start them apart (start_deg of their joints), mount them at angles of their own (wing.NAME.motion), or move their hinges apart (hinge_m)",
                self.said_of_hinges(pair)
            )
        };
        found.into_iter().map(say).collect()
    }

    /// Says of two wings that their hinges are in one place, if they are; those on other bodies than the central one are
    /// left out.
    fn said_of_hinges(&self, pair: [usize; 2]) -> &'static str {
        let wings = pair.map(|w| &self.animal.wings[w]);
        let chords = wings.map(|w| w.report().mean_chord);
        let on_body = |w: usize| {
            let own = self.joints.iter().find(|j| j.child == w + 1);
            own.is_none_or(|joint| joint.parent.unwrap_or(0) == 0)
        };
        let apart = wings[0].hinge_b.distance(wings[1].hinge_b);
        match pair.into_iter().all(on_body) && apart < 0.02 * chords[0].min(chords[1]) {
            true => "their hinges are in one place, so ",
            false => "",
        }
    }

    /// Pairs of wings that lie in each other, and over which part of the beat \[1\].
    fn coincident_pairs(&self) -> Vec<([usize; 2], f64)> {
        let all = 0..self.animal.wings.len();
        let known: Vec<usize> = all
            .filter(|&w| self.prescribed_in_body(w, 0.0).is_some())
            .collect();
        let carried = |w: usize, t: f64| {
            let on_joint = self.has_own_joint(w).then(|| self.prescribed_in_body(w, t));
            on_joint.flatten().map(|moving| (moving.p, moving.r))
        };
        coincident(&self.animal, &known, carried)
    }

    /// Pairs of wings that pass through each other or lie in each other in their prescribed motion, and whether they only
    /// graze.
    pub fn doubted_pairs(&self) -> Vec<([usize; 2], bool)> {
        let crossing = self.crossing_wings().into_iter();
        let crossing = crossing.map(|c| (c.wings, c.is_graze));
        let lying = self.coincident_pairs().into_iter();
        crossing
            .chain(lying.map(|(pair, _)| (pair, false)))
            .collect()
    }

    /// What to do about wings that pass through each other.
    fn apart(&self, found: &Crossing, is_joined: bool) -> String {
        let remedy = "move their hinges apart (hinge_m), sweep them (theta) or change their phase";
        let may_be_joined = self.air.lattice().is_some() && self.may_be_joined(found.wings);
        match (is_joined, may_be_joined) {
            (true, _) => "feather less at the joined roots (twist the wing instead), change their phase, or do not join them".to_owned(),
            (false, true) => format!("join them at their roots (joined = true of the wing), {remedy}"),
            (false, false) => format!("{}{remedy}", self.said_of_hinges(found.wings)),
        }
    }

    /// Which wings pass through each other in their prescribed motion; those with joints of their own are left out.
    pub fn prescribed_crossings(&self) -> Vec<Crossing> {
        crossings(&self.animal, &self.prescribed_wings(), &self.joined_pairs())
    }

    /// Counts how often wings pass through each other as they are flown, where that is not known beforehand:
    /// under feedback, with wings on joints of their own, or with elastic ones.
    pub fn flown_crossings(&self) -> Option<FlownCrossings> {
        let tips = self.air.lattice().map_or(&[][..], |air| &air.joined_tips);
        (self.moves_otherwise_in_flight() && self.animal.wings.len() > 1)
            .then(|| FlownCrossings::new(&self.animal, &self.joined_pairs(), tips))
    }

    /// Whether wings move otherwise in flight than their prescribed motion alone says.
    pub(super) fn moves_otherwise_in_flight(&self) -> bool {
        let has_joints = self.prescribed_wings().len() < self.animal.wings.len();
        self.feedback.is_some() || has_joints || self.animal.is_elastic()
    }

    /// Says which wings passed through each other as they were flown, by up to `depth` \[m\], and what to do about it.
    pub fn say_flown_crossing(&self, found: &Crossing, depth: f64) -> CrossingWings {
        self.say_crossing(found, depth, ("flight", self.kept_apart(found, depth)))
    }

    /// What to do about wings that passed through each other in flight, by up to `depth` \[m\]: about their strokes where
    /// these do so at least half as far without commands, with joints and loads at rest, else about what bends or moves
    /// them.
    fn kept_apart(&self, found: &Crossing, depth: f64) -> String {
        let joined = self.joined_pairs();
        let has_joints = found.wings.iter().any(|&w| self.has_own_joint(w));
        let is_joined = are_joined(&joined, found.wings);
        if crossing_depth(&self.animal, found.wings, is_joined) > 0.5 * depth {
            return self.apart(found, is_joined);
        }
        if self.feedback.is_none() && !has_joints {
            return "loads bend them so far: make them stiffer (structure), move the hinges apart (hinge_m), or let them beat less far towards each other".to_owned();
        }
        let limits = "limit the commands (control.amplitude_limit, control.angle_limit_deg)";
        match (has_joints, self.feedback.is_some()) {
            (true, true) => format!(
                "stop or stiffen their joints, move the hinges apart (hinge_m), or {limits}"
            ),
            (true, false) => format!(
                "{}stop or stiffen their joints, mount them at angles of their own (wing.NAME.motion), or move the hinges apart (hinge_m)",
                self.said_of_hinges(found.wings)
            ),
            (false, _) => format!("{limits}, or move the hinges apart (hinge_m)"),
        }
    }

    fn say_crossing(
        &self,
        found: &Crossing,
        depth: f64,
        (time, remedy): (&str, String),
    ) -> CrossingWings {
        let wings = found.wings.map(|w| &self.animal.wings[w]);
        let [a, b] = wings.map(|w| &w.name);
        let chords = wings.map(|w| w.report().mean_chord);
        let depth = depth / chords[0].min(chords[1]);
        let part = (100.0 * found.part).max(1.0);
        CrossingWings {
            wings: found.wings,
            said: format!(
                "wings `{a}` and `{b}` pass through each other in {part:.0} % of the {time}, by up to {:.1} % of a mean chord: {remedy}",
                100.0 * depth
            ),
            is_graze: depth <= GRAZE,
        }
    }

    /// Says which wings are inside which parts of the body in their prescribed motion where the lattice has
    /// both as surfaces ([`inside`]), and what to do about it; wings with joints of their own are left out, and
    /// so are parts of segments.
    pub fn wings_inside_parts(&self) -> Vec<String> {
        if !self.air.lattice().is_some_and(|air| air.body_surfaces) {
            return vec![];
        }
        let found = inside(&self.animal, &self.prescribed_wings());
        let of_part = |(k, part): (usize, &BodyPart)| {
            let here = || found.iter().filter(move |i| i.part == k);
            let most = here().map(|i| i.time).reduce(f64::max)?;
            let inside: Vec<&str> = here()
                .map(|i| &self.animal.wings[i.wing].name[..])
                .collect();
            let (wings, are) = match inside.len() {
                1 => ("wing", "is"),
                _ => ("wings", "are"),
            };
            Some(format!(
                "{wings} {} {are} inside the body part `{}` in {:.0} % of the beat: move the hinges out of it (hinge_m), make it \
                 smaller (body.part.{}), or leave bodies out of the air (air.body = false)",
                names(inside, " and "),
                part.name,
                (100.0 * most).max(1.0),
                part.name,
            ))
        };
        let parts = self.animal.parts.iter().enumerate();
        parts.filter_map(of_part).collect()
    }
}
