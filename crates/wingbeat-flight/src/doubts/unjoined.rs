//! Wings whose roots meet, or tip and root, or that stand on a plane of images, and are not joined there: the lattice has a
//! gap there, through which air passes. Roots that lie on each other and that no key joins it closes by itself.

use wingbeat_air::EdgeKind;
use wingbeat_model::{Spacing, are_joined, mirror_name, pairs, roots_meet};

use crate::air::{EdgeOnPlane, ON_PLANE, check_joined, check_joined_tip, tip_gap};
use crate::setup::{AirOptions, FlightSetup, MotionMode};

/// How near roots are that meet, and those that lie on each other, whose filaments cancel, over their chords \[1\].
const NEAR: f64 = 0.1;
const SAME: f64 = 1e-6;

impl FlightSetup {
    /// Says which wings of a lattice have roots that meet ([`roots_meet`]) and neither are joined nor shed there, with a
    /// gap between their outermost filaments, and what to do about it. Left out are those that are joined to others,
    /// both of them, and wings with joints of their own, whose motion is not known beforehand.
    pub fn unjoined_roots(&self) -> Vec<String> {
        let air = match self.air.lattice() {
            Some(air) if !air.lattice.shedding.root => air,
            _ => return vec![],
        };
        let pairs = pairs(self.prescribed_wings().into_iter());
        let goes_on = self.goes_on(air);
        let carried = self.carried_pairs(air).into_iter();
        let carried: Vec<usize> = carried.flat_map(|pair| pair.wings).collect();
        let is_joined =
            |w: usize| carried.contains(&w) || air.joined.iter().any(|pair| pair.contains(&w));
        let goes_on = |w: usize| is_joined(w) || goes_on(w, EdgeKind::Root);
        let ends = |pair: [usize; 2]| !pair.into_iter().all(goes_on);
        let apart = pairs.filter(|pair| !are_joined(&air.joined, *pair) && ends(*pair));
        let wings = &self.animal.wings;
        let closed = self.coincident_roots(air).concat();
        let reach = |w: usize| {
            let is_cosine = wings[w].mesh.columns == Spacing::Cosine;
            is_cosine || air.lattice.inset == 0.0 || closed.contains(&w)
        };
        let closes =
            |pair: [usize; 2]| pair.into_iter().all(reach) && roots_meet(&self.animal, pair, SAME);
        let found = apart.filter(|&pair| roots_meet(&self.animal, pair, NEAR) && !closes(pair));
        found.map(|pair| self.say_unjoined(pair)).collect()
    }

    /// Pairs of wings of a lattice whose roots lie on each other all along ([`roots_meet`]), do not shed, and which no key
    /// joins, as of two wings on the same side: rings of both reach to the root there, so that no air passes. Wings with
    /// joints of their own are left out.
    pub(crate) fn coincident_roots(&self, air: &AirOptions) -> Vec<[usize; 2]> {
        if air.lattice.shedding.root {
            return vec![];
        }
        let lie =
            |&pair: &[usize; 2]| !self.may_be_joined(pair) && roots_meet(&self.animal, pair, SAME);
        let all = pairs(self.prescribed_wings().into_iter());
        all.filter(lie).collect()
    }

    /// Says which wings of a lattice have a tip at which the root of another begins, and are not joined there: of a wing
    /// and the one that it carries, where all angles are zero, and of two wings on the body as their motions begin.
    pub fn unjoined_tips(&self) -> Vec<String> {
        let air = match self.air.lattice() {
            Some(air) if !air.lattice.shedding.root => air,
            _ => return vec![],
        };
        let wings = &self.animal.wings;
        let carrier = |w: usize| {
            let own = self.joints.iter().find(|j| j.child == w + 1);
            own.map(|joint| joint.parent.unwrap_or(0))
        };
        let reach = |w: usize| wings[w].mesh.columns == Spacing::Cosine || air.lattice.inset == 0.0;
        let goes_on = self.goes_on(air);
        let meets = |&[a, b]: &[usize; 2]| {
            let gap = match (carrier(a), carrier(b)) {
                (_, Some(by)) if by == a + 1 => tip_gap(&self.animal, [a, b], false),
                (None, None) => tip_gap(&self.animal, [a, b], true),
                _ => return false,
            };
            let closes = [a, b].into_iter().all(reach) && gap <= SAME;
            let ends = !goes_on(a, EdgeKind::Tip) || !goes_on(b, EdgeKind::Root);
            gap <= NEAR && !closes && ends && !air.joined_tips.contains(&[a, b])
        };
        let others = |a: usize| (0..wings.len()).map(move |b| [a, b]);
        let all = (0..wings.len()).flat_map(others).filter(|[a, b]| a != b);
        let say = |[a, b]: [usize; 2]| self.say_unjoined_tip([a, b], carrier(b) == Some(a + 1));
        all.filter(meets).map(say).collect()
    }

    /// Whether the circulation of this edge of a wing goes on in its own mirror image in a plane of images.
    fn goes_on(&self, air: &AirOptions) -> impl Fn(usize, EdgeKind) -> bool + use<> {
        let edges = self.edges_on_planes(air);
        move |w, kind| (edges.iter()).any(|e| e.wing == w && e.kind == kind && e.is_joined())
    }

    fn say_unjoined_tip(&self, pair: [usize; 2], is_carried: bool) -> String {
        let [a, b] = pair.map(|w| &self.animal.wings[w].name);
        let remedy = match (is_carried, check_joined_tip(&self.animal, pair)) {
            (true, Ok(())) => "join them (joined = true of the wing that is carried)".to_owned(),
            (true, Err(_)) => "give them one chord there and the same panels along it, with at_m of the joint at the tip, and join them (joined = true of the wing that is carried)".to_owned(),
            (false, _) => format!(
                "let `{a}` carry `{b}` (a joint with parent and child, a weld where it does not move) and join them (joined = true of `{b}`)"
            ),
        };
        format!(
            "the tip of wing `{a}` and the root of wing `{b}` meet and are not joined: the circulation of both ends there, so that lift is low, by a quarter for two halves of a wing of 3 chords in a stream, and drag high; {remedy}"
        )
    }

    /// Says which wings stand on a plane of images (air.ground) and are not joined to their mirror images there, why, and
    /// what to do about it.
    pub fn edges_off_planes(&self) -> Vec<String> {
        let edges = (self.air.lattice()).map(|air| self.edges_on_planes(air));
        let edges = edges.into_iter().flatten();
        edges.filter_map(|e| self.say_off_plane(&e)).collect()
    }

    fn say_off_plane(&self, edge: &EdgeOnPlane) -> Option<String> {
        let [first, most] = edge.off;
        let why = match (edge.is_joined(), first > ON_PLANE, &self.mode) {
            (true, ..) => return None,
            (_, true, _) => format!("lies {first:.1e} of its length off the plane of air.ground"),
            (.., MotionMode::Free(_)) => {
                "lies on the plane of air.ground, where a free body does not stay".to_owned()
            }
            _ => format!(
                "lies on the plane of air.ground at the start and leaves it by {most:.1e} of its length"
            ),
        };
        let name = &self.animal.wings[edge.wing].name;
        Some(format!(
            "the {} of wing `{name}` {why}: it is not joined to its mirror image, and its circulation ends there, so that lift is low, by a seventh in a stream at an aspect ratio (with the image) of 6; for half a model keep the edge on the plane all along (hinge_m, wing.{name}.motion, flight.tether), for a gap that is meant look at the lift on more panels along the span",
            edge.edge()
        ))
    }

    /// Whether a key of a case joins the roots of these wings: they are left and right of each other, and their
    /// roots meet off all planes of images.
    pub(super) fn may_be_joined(&self, pair: [usize; 2]) -> bool {
        let [a, b] = pair.map(|w| &self.animal.wings[w].name);
        let is_free = |w: usize| !self.is_on_plane(w, EdgeKind::Root);
        mirror_name(a).is_some_and(|other| other == **b)
            && pair.into_iter().all(is_free)
            && check_joined(&self.animal, pair).is_ok()
    }

    fn say_unjoined(&self, pair: [usize; 2]) -> String {
        let [a, b] = pair.map(|w| &self.animal.wings[w].name);
        let remedy = match self.may_be_joined(pair) {
            true => "join them (joined = true of the wing), or move the hinges apart (hinge_m)",
            false => {
                "let the roots lie on each other all along, where the lattice closes them by itself (the same hinge_m, chord and panels along it; flapping keeps them there, feathering and deviation part them), or move the hinges apart (hinge_m)"
            }
        };
        format!(
            "the roots of wings `{a}` and `{b}` meet and are not joined: their circulation ends there, so that lift is low, by a seventh in a stream at an aspect ratio of 6, and drag high; {remedy}"
        )
    }
}
