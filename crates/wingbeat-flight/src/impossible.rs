//! Prescribed motions that no animal has, and of which no vortex lattice says what the air does; wings whose roots lie on bodies.

use wingbeat_model::{
    BodyPart, Crossing, FlownCrossings, PairOnPart, crossings, inside, pairs_on_parts,
    roots_on_parts,
};

use crate::air::{check_joined, wing_pairs};
use crate::setup::{AirModel, AirOptions, FlightSetup};

/// Length along the chord of panels of a body beside a root, in chords of the root, above which the lattice has too few to say how the lift
/// parts between wing and body.
const COARSE: f64 = 0.6;

impl FlightSetup {
    /// Says which wings pass through each other in their prescribed motion ([`crossings`]), and what to do about it; wings with
    /// joints of their own, whose motion is not known beforehand, are left out.
    pub fn crossing_wings(&self) -> Vec<String> {
        let joined = self.joined_pairs();
        let remedy = |c: &Crossing| match joined
            .iter()
            .any(|j| c.wings.iter().all(|w| j.contains(w)))
        {
            false => "move their hinges apart (hinge_m), sweep them (theta) or change their phase",
            true => {
                "feather less at the joined roots (twist the wing instead), change their phase, or do not join them"
            }
        };
        let say = |c: Crossing| format!("{}: {}", self.crossing(&c, "beat"), remedy(&c));
        self.prescribed_crossings().into_iter().map(say).collect()
    }

    /// Which wings pass through each other in their prescribed motion; those with joints of their own are left out.
    pub fn prescribed_crossings(&self) -> Vec<Crossing> {
        crossings(&self.animal, &self.prescribed_wings(), &self.joined_pairs())
    }

    /// Counts how often wings pass through each other as they are flown, where that is not known beforehand: under feedback, or
    /// with wings on joints of their own.
    pub fn flown_crossings(&self) -> Option<FlownCrossings> {
        let wings = self.animal.wings.len();
        let is_open = self.feedback.is_some() || self.prescribed_wings().len() < wings;
        (is_open && wings > 1).then(|| FlownCrossings::new(&self.animal, &self.joined_pairs()))
    }

    /// Says which wings passed through each other as they were flown, and what to do about it.
    pub fn say_flown_crossing(&self, found: &Crossing) -> String {
        let remedy = match self.feedback {
            Some(_) => {
                "limit the commands (control.amplitude_limit, control.angle_limit_deg), or move the hinges apart (hinge_m)"
            }
            None => "stop or stiffen the joints, or move the hinges apart (hinge_m)",
        };
        format!("{}: {remedy}", self.crossing(found, "flight"))
    }

    fn crossing(&self, found: &Crossing, time: &str) -> String {
        let [a, b] = found.wings.map(|w| &self.animal.wings[w].name);
        let part = (100.0 * found.part).max(1.0);
        format!("wings `{a}` and `{b}` pass through each other in {part:.0} % of the {time}")
    }

    /// Says which wings are inside which parts of the body in their prescribed motion where the lattice has both as surfaces
    /// ([`inside`]), and what to do about it; wings with joints of their own are left out, and so are parts of segments.
    pub fn wings_inside_parts(&self) -> Vec<String> {
        if !matches!(&self.air, AirModel::VortexLattice(air) if air.body_surfaces) {
            return vec![];
        }
        let found = inside(&self.animal, &self.prescribed_wings());
        let of_part = |(k, part): (usize, &BodyPart)| {
            let here = || found.iter().filter(move |i| i.part == k);
            let most = here().map(|i| i.time).reduce(f64::max)?;
            let names: Vec<String> = here()
                .map(|i| format!("`{}`", self.animal.wings[i.wing].name))
                .collect();
            let (wings, are) = match names.len() {
                1 => ("wing", "is"),
                _ => ("wings", "are"),
            };
            Some(format!(
                "{wings} {} {are} inside the body part `{}` in {:.0} % of the beat: move the hinges out of it (hinge_m), make it \
                 smaller (body.part.{}), or leave bodies out of the air (air.body = false)",
                names.join(" and "),
                part.name,
                (100.0 * most).max(1.0),
                part.name,
            ))
        };
        let parts = self.animal.parts.iter().enumerate();
        parts.filter_map(of_part).collect()
    }

    /// Says which wings have their roots on which parts of the body where the lattice has both as surfaces ([`roots_on_parts`]), and either
    /// it does not carry their circulation through the part ([`Self::carried_pairs`]), so that the lift is low, or the panels of the part are too
    /// long for that (docs/wings.md, "Wings on a body"). Wings inside parts and those with joints of their own are left out.
    pub fn roots_on_bodies(&self) -> Vec<String> {
        let air = match &self.air {
            AirModel::VortexLattice(air) if air.body_surfaces => air,
            _ => return vec![],
        };
        let mut wings = self.prescribed_wings();
        let within = inside(&self.animal, &wings);
        wings.retain(|w| within.iter().all(|i| i.wing != *w));
        let found = roots_on_parts(&self.animal, &wings);
        let carried = self.carried_pairs(air);
        let remedy = match air.lattice.shedding.root {
            true => {
                "let the roots shed nothing, so that their circulation goes on through the body (air.shed without \"root\")"
            }
            false => {
                "give both sides mirror images of one wing (mirror), so that its circulation goes on through the body, or carry the wings on to \
                 the middle of the body and join them there (joined = true), without the body in the air (air.body = false)"
            }
        };
        let of_part = |(k, part): (usize, &BodyPart)| {
            let is_carried = |w: usize| carried.iter().any(|p| p.wings.contains(&w));
            let here = found.iter().filter(|r| r.part == k && !is_carried(r.wing));
            let names: Vec<String> = here
                .map(|r| format!("`{}`", self.animal.wings[r.wing].name))
                .collect();
            let (roots, lie) = match names.len() {
                0 => return None,
                1 => ("root of wing", "lies"),
                _ => ("roots of wings", "lie"),
            };
            Some(format!(
                "the {roots} {} {lie} on the body part `{}`: in the lattice air passes between them, so that in a stream the lift comes \
                 out a quarter to a third low, and the drag is not to be trusted; {remedy} (docs/wings.md, \"Wings on a body\")",
                names.join(" and "),
                part.name,
            ))
        };
        let parts = self.animal.parts.iter().enumerate();
        let coarse = carried.iter().filter(|p| p.panel_chords > COARSE);
        let coarse = coarse.map(|pair| self.coarse_beside(pair));
        parts.filter_map(of_part).chain(coarse).collect()
    }

    fn coarse_beside(&self, pair: &PairOnPart) -> String {
        let [a, b] = pair.wings.map(|w| &self.animal.wings[w].name);
        let (part, chords) = (&self.animal.parts[pair.part].name, pair.panel_chords);
        format!(
            "panels of the body part `{part}` are {chords:.1} chords long beside the roots of the wings `{a}` and `{b}`: the lift of the body comes out \
             up to half off, and that of wings that sit high or low on it, too; give it {:.1} times as many stations \
             (body.part.{part}.stations), so that they are half a chord (docs/wings.md, \"Wings on a body\")",
            2.0 * chords
        )
    }

    /// Pairs of wings, each the mirror image of the other, whose circulation the lattice carries through the part of the body on which
    /// both roots lie ([`pairs_on_parts`]): where bodies are surfaces of `air` and roots shed nothing; not those that are joined or inside
    /// parts, nor those with joints of their own.
    pub fn carried_pairs(&self, air: &AirOptions) -> Vec<PairOnPart> {
        if !air.body_surfaces || air.lattice.shedding.root {
            return vec![];
        }
        let mut pairs = wing_pairs(&self.animal);
        let prescribed = self.prescribed_wings();
        let is_joined = |w: &usize| air.joined.iter().flatten().any(|j| j == w);
        pairs.retain(|pair| (pair.iter()).all(|w| prescribed.contains(w) && !is_joined(w)));
        let mut found = pairs_on_parts(&self.animal, &pairs);
        let wings: Vec<usize> = found.iter().flat_map(|p| p.wings).collect();
        let within = inside(&self.animal, &wings);
        found.retain(|p| within.iter().all(|i| !p.wings.contains(&i.wing)));
        found
    }

    /// Wings without joints of their own.
    fn prescribed_wings(&self) -> Vec<usize> {
        let has_joint = |w: usize| self.joints.iter().any(|j| j.child == w + 1);
        let all = 0..self.animal.wings.len();
        all.filter(|&w| !has_joint(w)).collect()
    }

    /// Pairs of wings that are joined at their roots; where no air joins them, those that could be.
    fn joined_pairs(&self) -> Vec<[usize; 2]> {
        match &self.air {
            AirModel::VortexLattice(air) => air.joined.clone(),
            _ => {
                let mut pairs = wing_pairs(&self.animal);
                pairs.retain(|&pair| check_joined(&self.animal, pair).is_ok());
                pairs
            }
        }
    }
}
