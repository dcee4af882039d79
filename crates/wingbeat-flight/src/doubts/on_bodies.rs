//! Wings whose roots lie on bodies: which of them the lattice carries through, and what it does not say of the others.

use wingbeat_model::{BodyPart, PairOnPart, inside, roots_beside_parts, roots_on_parts};

use super::said::names;
use crate::setup::{AirOptions, FlightSetup};

/// Length along the chord of panels of a body beside a root, in chords of the root, above which the lattice has
/// too few to say how the lift parts between wing and body.
const COARSE: f64 = 0.6;

/// Distance of the roots from the middle of a part, over half their distance, above which their lift hangs on
/// its panels.
const OFF_MIDDLE: f64 = 0.25;

impl FlightSetup {
    /// Says which wings have their roots on which parts of the body where the lattice has both as surfaces
    /// ([`roots_on_parts`]), and either it does not carry their circulation through the part
    /// ([`Self::carried_pairs`]), so that the lift is low, or what lies in its way
    /// (docs/wings-on-bodies.md, "Wings on a body"). Wings inside parts are left out.
    pub fn roots_on_bodies(&self) -> Vec<String> {
        let Some(air) = self.air.lattice().filter(|air| air.body_surfaces) else {
            return vec![];
        };
        let mut wings: Vec<usize> = (0..self.animal.wings.len()).collect();
        let within = inside(&self.animal, &wings);
        wings.retain(|w| within.iter().all(|i| i.wing != *w));
        let mut found = roots_on_parts(&self.animal, &wings);
        let carried = self.carried_pairs(air);
        found.retain(|r| carried.iter().all(|p| !p.wings.contains(&r.wing)));
        let remedy = "it goes on through one part of the central body, a quarter of a chord wide or more, between two wings that are mirror \
                      images of each other, panels too, and have no joints of their own: make them so, or leave the body out of the air \
                      (air.body = false) and, if there is one pair, carry the wings on to its middle and join them there (joined = true)";
        let of_part = |(k, part): (usize, &BodyPart)| {
            let here = found.iter().filter(|r| r.part == k);
            let wings: Vec<&str> = here.map(|r| &self.animal.wings[r.wing].name[..]).collect();
            let (roots, lie) = match wings.len() {
                0 => return None,
                1 => ("root of wing", "lies"),
                _ => ("roots of wings", "lie"),
            };
            Some(format!(
                "the {roots} {} {lie} on the body part `{}`, and the circulation ends there: in a stream the lift comes out a quarter to a \
                 third low, and the drag is not to be trusted; {remedy} (docs/wings-on-bodies.md, \"Wings on a body\")",
                names(wings, " and "),
                part.name,
            ))
        };
        let parts = self.animal.parts.iter().enumerate();
        let doubts = carried.iter().filter_map(|pair| self.doubt_of(pair, air));
        let gaps = self.gaps_beside_parts(&wings);
        parts
            .filter_map(of_part)
            .chain(doubts)
            .chain(gaps)
            .collect()
    }

    /// Says which of these `wings` stand off which parts of the body by a little ([`roots_beside_parts`]).
    fn gaps_beside_parts(&self, wings: &[usize]) -> Vec<String> {
        let beside = roots_beside_parts(&self.animal, wings);
        let of_part = |(k, part): (usize, &BodyPart)| {
            let here = beside.iter().filter(|r| r.part == k);
            let names = names(here.map(|r| &self.animal.wings[r.wing].name[..]), ", ");
            (!names.is_empty()).then(|| {
                format!(
                    "roots off the body part `{}` by a tenth to a quarter of their chord (wing {}): air passes between them, and the lift is up to \
                     two fifths less than on the body; move them onto the part (hinge_m), or farther off if there is such a gap (docs/wings-on-bodies.md, \
                     \"Wings on a body\")",
                    part.name,
                    names
                )
            })
        };
        let parts = self.animal.parts.iter().enumerate();
        parts.filter_map(of_part).collect()
    }

    /// What lies in the way of the circulation of a pair through a part.
    fn doubt_of(&self, pair: &PairOnPart, air: &AirOptions) -> Option<String> {
        let [a, b] = pair.wings.map(|w| &self.animal.wings[w].name);
        let part = &self.animal.parts[pair.part].name;
        let doubt = if pair.panel_chords > COARSE {
            format!(
                "panels of the body part `{part}` are {:.1} chords long beside the roots of the wings `{a}` and `{b}`: the lift of the body comes \
                 out up to half off; give it {:.1} times as many stations (body.part.{part}.stations), so that they are half a chord",
                pair.panel_chords,
                2.0 * pair.panel_chords
            )
        } else if pair.off_middle > OFF_MIDDLE {
            format!(
                "the roots of the wings `{a}` and `{b}` lie high or low on the body part `{part}`, {:.1} of its half width off its middle: their \
                 lift is a tenth up or down as they meet its panels, and the drag is not to be trusted; move them towards its middle (hinge_m), or \
                 compare bodies of more panels",
                pair.off_middle
            )
        } else if self.ends_within(pair, air) {
            format!(
                "the wake of the wings `{a}` and `{b}` ends, or turns to particles, within a length of the body part `{part}` behind them, which \
                 shakes the force on it from step to step: keep rings for longer (air.max_wake_rows, max_wake_age_s, max_wake_distance_m, \
                 particles.after_rows)"
            )
        } else {
            return None;
        };
        Some(format!(
            "{doubt} (docs/wings-on-bodies.md, \"Wings on a body\")"
        ))
    }

    /// Whether the wake of a pair that moves like the root at the start may end as rings within the length of the part.
    fn ends_within(&self, pair: &PairOnPart, air: &AirOptions) -> bool {
        let lattice = &air.lattice;
        let particles = lattice.particles.as_ref();
        if particles.is_some_and(|p| p.leading_at_once) {
            return true;
        }
        let speed = (lattice.free_stream - self.root_at_start().v).length();
        let rows = [lattice.max_rows, particles.and_then(|p| p.after)];
        let ages = rows.map(|rows| rows.map(|rows| rows as f64 * self.time.step));
        let ways = (ages.into_iter().chain([lattice.max_age])).map(|age| age.map(|t| speed * t));
        let mut ways = ways.chain([lattice.max_distance]).flatten();
        ways.any(|way| way < pair.part_length)
    }
}
