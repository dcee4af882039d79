//! Prescribed motions that no animal has, and of which no vortex lattice says what the air does.

use wingbeat_model::{
    BodyPart, Crossing, FlownCrossings, are_joined, coincident, crossing_depth, crossings, inside,
};

use super::said::names;
use crate::setup::FlightSetup;

/// Depth ([`crossing_depth`]) over the mean chord up to which wings that pass through each other graze \[1\].
const GRAZE: f64 = 0.03;

/// Wings that pass through each other in their prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossingWings {
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
            let chords = c.wings.map(|w| self.animal.wings[w].report().mean_chord);
            let depth = crossing_depth(&self.animal, c.wings, is_joined) / chords[0].min(chords[1]);
            CrossingWings {
                said: format!(
                    "{}, by up to {:.1} % of a mean chord: {}",
                    self.crossing(&c, "beat"),
                    100.0 * depth,
                    self.apart(&c, is_joined)
                ),
                is_graze: depth <= GRAZE,
            }
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
        let all = 0..self.animal.wings.len();
        let known: Vec<usize> = all
            .filter(|&w| self.prescribed_in_body(w, 0.0).is_some())
            .collect();
        let carried = |w: usize, t: f64| {
            let on_joint = self.has_own_joint(w).then(|| self.prescribed_in_body(w, t));
            on_joint.flatten().map(|moving| (moving.p, moving.r))
        };
        let found = coincident(&self.animal, &known, carried);
        found.into_iter().map(say).collect()
    }

    /// What to do about wings that pass through each other.
    fn apart(&self, found: &Crossing, is_joined: bool) -> String {
        let remedy = "move their hinges apart (hinge_m), sweep them (theta) or change their phase";
        let may_be_joined = self.air.lattice().is_some() && self.may_be_joined(found.wings);
        match (is_joined, may_be_joined) {
            (true, _) => "feather less at the joined roots (twist the wing instead), change their phase, or do not join them".to_owned(),
            (false, true) => format!("join them at their roots (joined = true of the wing), {remedy}"),
            (false, false) => remedy.to_owned(),
        }
    }

    /// Which wings pass through each other in their prescribed motion; those with joints of their own are left out.
    pub fn prescribed_crossings(&self) -> Vec<Crossing> {
        crossings(&self.animal, &self.prescribed_wings(), &self.joined_pairs())
    }

    /// Counts how often wings pass through each other as they are flown, where that is not known beforehand:
    /// under feedback, with wings on joints of their own, or with elastic ones.
    pub fn flown_crossings(&self) -> Option<FlownCrossings> {
        let wings = self.animal.wings.len();
        let has_joints = self.prescribed_wings().len() < wings;
        let is_open = self.feedback.is_some() || has_joints || self.animal.is_elastic();
        let tips = self.air.lattice().map_or(&[][..], |air| &air.joined_tips);
        (is_open && wings > 1)
            .then(|| FlownCrossings::new(&self.animal, &self.joined_pairs(), tips))
    }

    /// Says which wings passed through each other as they were flown, and what to do about it.
    pub fn say_flown_crossing(&self, found: &Crossing) -> String {
        format!(
            "{}: {}",
            self.crossing(found, "flight"),
            self.kept_apart(found)
        )
    }

    /// What to do about wings that passed through each other in flight: about their strokes where these do so without
    /// commands and with joints at rest, else about their joints, else about the commands.
    fn kept_apart(&self, found: &Crossing) -> String {
        let joined = self.joined_pairs();
        let has_joints = found.wings.iter().any(|&w| self.has_own_joint(w));
        if !crossings(&self.animal, &found.wings, &joined).is_empty() {
            return self.apart(found, are_joined(&joined, found.wings));
        }
        if self.feedback.is_none() && !has_joints {
            return "loads bend them so far: make them stiffer (structure), move the hinges apart (hinge_m), or let them beat less far towards each other".to_owned();
        }
        let limits = "limit the commands (control.amplitude_limit, control.angle_limit_deg)";
        match (has_joints, self.feedback.is_some()) {
            (true, true) => format!(
                "stop or stiffen their joints, move the hinges apart (hinge_m), or {limits}"
            ),
            (true, false) => {
                "stop or stiffen their joints, or move the hinges apart (hinge_m)".to_owned()
            }
            (false, _) => format!("{limits}, or move the hinges apart (hinge_m)"),
        }
    }

    fn crossing(&self, found: &Crossing, time: &str) -> String {
        let [a, b] = found.wings.map(|w| &self.animal.wings[w].name);
        let part = (100.0 * found.part).max(1.0);
        format!("wings `{a}` and `{b}` pass through each other in {part:.0} % of the {time}")
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
