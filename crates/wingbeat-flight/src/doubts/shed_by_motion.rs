//! What the prescribed motion tells of shedding: leading edges that shed more vorticity of one sign than of the
//! other, tips of attached wings.
//!
//! While the flow has left a leading edge, vorticity leaves it at a rate that goes with the square of the speed
//! past the section and with the suction beyond what the edge holds. Strokes that are alike back and forth shed
//! as much of either sign; those of forward flight, or in a stream, do not. What is left over joins the
//! circulation of wing and wake in every beat. Where the root holds, lattice and wakes are not closed there,
//! and it changes the lift (docs/separated-flow.md, "Wings whose strokes are unlike").
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | u | `speed` | velocity of stream and motion past the section, in its plane, at the quarter chord | m/s |
//! | A0 | `suction` | suction parameter of the undisturbed flow: normal velocity at mid chord over \|u\| | 1 |
//! | H | `held` | suction parameter that the edge holds | 1 |
//!
//! By the same velocities wings whose flow stays attached are known, and whether their tips shed nevertheless.
//!
//! What is left out: the velocities that wakes make, and that the body of a free flight does not go on as it starts.

use std::f64::consts::PI;

use super::air_past::strips;
use super::said::names;
use crate::setup::{FlightSetup, LOOKS, MotionMode};
use wingbeat_air::{AirSettings, EdgeKind, LeadingEdge};
use wingbeat_math::DVec3;
use wingbeat_model::Wing;

/// Instants of a beat that are looked at.
const INSTANTS: usize = 100;

/// Suction parameter below which flow stays attached where leading edges shed nothing: what they hold by default.
const ATTACHED: f64 = 0.15;

/// Part that is left over of one sign from which on it is said. Hovering presets have 0 to 0.02; strokes of
/// four dragonflies, whose lift changes by 10 to 40 % in ten beats or with free roots, have 0.21 to 0.90 in one
/// pair at least.
const ONE_SIDED: f64 = 0.1;

/// Way of the fastest strip through the air in a step over the mean chord above which the lift of wings that go on one
/// way hangs on the step \[1\]. Two wings at 40 deg: aspect ratio 6.3, 0.4 and 0.2 chords a step, 6 % apart; 15.8, 1.0,
/// 0.7, 0.5 and 0.35 chords, 53, 19, 6 and 0 % more than the last.
const LONG_STEP: f64 = 0.6;

impl FlightSetup {
    /// Says which wings that do not beat shed vorticity of one sign from their leading edges in steps that are long
    /// beside their chords, and which step would do.
    pub fn long_steps_one_way(&self) -> Option<String> {
        let air = self.air.lattice()?;
        if !air.lattice.leading_edges_shed() {
            return None;
        }
        let goes_on = |(w, wing): &(usize, &Wing)| {
            let beats = wing.motion.frequency != 0.0;
            !beats && !self.has_own_joint(*w) && self.one_sided_part(*w) > ONE_SIDED
        };
        let wings = self.animal.wings.iter().enumerate().filter(goes_on);
        let found: Vec<(&str, f64)> = wings
            .map(|(_, wing)| (wing.name.as_str(), self.way_in_a_step(wing)))
            .filter(|(_, way)| *way > LONG_STEP)
            .collect();
        let most = found.iter().map(|(_, way)| *way).reduce(f64::max)?;
        Some(format!(
            "wings ({}) go on one way with vorticity from their leading edges, and the fastest strip goes {most:.2} mean chords in a step: the lift hangs on the step, by half of it at 1.0 chords and an aspect ratio of 16; take time.step_s = {:.2e} or less (0.5 chords)",
            names(found.iter().map(|(name, _)| *name), ", "),
            self.time.step * 0.5 / most
        ))
    }

    /// Most that a strip of a wing that does not beat goes through the air in a step over the mean chord \[1\].
    fn way_in_a_step(&self, wing: &Wing) -> f64 {
        let motion = wing.motion.impulsive();
        let duration = self.round(motion.frequency);
        let speeds = (0..INSTANTS).flat_map(|k| {
            let past = self.air_past(wing, &motion, k as f64 / INSTANTS as f64 * duration);
            sections(wing, past).map(|s| s.speed)
        });
        let report = wing.report();
        speeds.fold(0.0, f64::max) * self.time.step / report.mean_chord
    }

    /// Says which wings shed vorticity of one sign from their leading edges in their prescribed motion
    /// ([`Self::one_sided_part`]) where roots or tips hold, or where leading edges shed by the suction of the step
    /// before, and what to do about it. Wings with joints of their own, whose motion is not known beforehand,
    /// are left out; edges that are joined to others or to their mirror images, and roots whose circulation
    /// goes on through a body, do not hold, and plane flow has neither roots nor tips.
    pub fn one_sided_leading_edges(&self) -> Option<String> {
        let air = self.air.lattice()?;
        let shedding = air.lattice.shedding;
        if !air.lattice.leading_edges_shed() {
            return None;
        }
        let carried = self.carried_pairs(air);
        let through = carried.iter().map(|p| &p.wings);
        let pairs: Vec<&[usize; 2]> = air.joined.iter().chain(through).collect();
        let is_joined = |w: usize| {
            pairs.iter().any(|pair| pair.contains(&w))
                || air.joined_tips.iter().any(|[_, outer]| *outer == w)
                || self.is_on_plane(w, EdgeKind::Root)
        };
        let is_tip_joined = |w: usize| {
            air.joined_tips.iter().any(|[inner, _]| *inner == w)
                || self.is_on_plane(w, EdgeKind::Tip)
        };
        let is_late = matches!(air.lattice.leading, LeadingEdge::Suction { .. });
        let has_sides = !air.lattice.plane_wakes;
        let root_holds = |w: usize| has_sides && !shedding.root && !is_joined(w);
        let tip_holds = |w: usize| has_sides && !shedding.tip && !is_tip_joined(w);
        let holds = |w: usize| tip_holds(w) || root_holds(w);
        let wings = 0..self.animal.wings.len();
        let known = wings.filter(|&w| !self.has_own_joint(w) && (is_late || holds(w)));
        let parts = known.map(|w| (w, self.one_sided_part(w)));
        let found: Vec<_> = parts.filter(|(_, part)| *part > ONE_SIDED).collect();
        let most = found.iter().map(|(_, part)| *part).reduce(f64::max)?;
        let name = |(w, _): &(usize, f64)| &self.animal.wings[*w].name[..];
        let beats = self.animal.wings[found[0].0].motion.frequency > 0.0;
        let [what, when] = match beats {
            true => ["strokes are unlike back and forth", "in every beat"],
            false => ["wings go more one way than the other", "over the flight"],
        };
        let [roots_hold, tips_hold] = [
            found.iter().any(|(w, _)| root_holds(*w)),
            found.iter().any(|(w, _)| tip_holds(*w)),
        ];
        let [why, remedy] = match (roots_hold, tips_hold) {
            (true, false) => [
                "as roots hold, the lift drifts with it",
                "let roots shed (air.shed with \"root\", air.leading_edge = \"suction_implicit\")",
            ],
            (false, true) => [
                "as tips hold, the lift drifts with it",
                "let tips shed (air.shed with \"tip\", air.leading_edge = \"suction_implicit\")",
            ],
            (true, true) => [
                "as roots and tips hold, the lift drifts with it",
                "let both shed (air.shed with \"root\" and \"tip\", air.leading_edge = \"suction_implicit\")",
            ],
            (false, false) => [
                "as edges shed by the suction of the step before, the lift hangs on the step",
                "take air.leading_edge = \"suction_implicit\"",
            ],
        };
        Some(format!(
            "{what}: of the vorticity that leading edges shed (wings {}), up to {:.0} % is left over of one sign {when}, and {why}: {remedy}",
            names(found.iter().map(name), ", "),
            100.0 * most
        ))
    }

    /// Says that some edges shed and trailing edges do not, and what to do about it: wings have next to no lift in a steady
    /// stream then, as nothing gives them the circulation that lets the flow leave there smoothly.
    pub fn shed_without_trailing_edges(&self) -> Option<String> {
        let shedding = self.air.lattice()?.lattice.shedding;
        let is_meant = !self.animal.wings.is_empty() && shedding.any() && !shedding.trailing;
        is_meant.then(|| {
            "air.shed names edges but not \"trailing\": flow does not leave trailing edges smoothly, circulation about the wings \
             does not build up, and their lift in a steady stream is next to nothing; add \"trailing\" (docs/lattice-settings.md, \
             \"Edges that shed\")"
                .to_owned()
        })
    }

    /// Says which wings meet the air at such small angles throughout their prescribed motion that the flow
    /// stays attached, while their tips shed: wakes that go along the tip, with the cores of wakes, in place of
    /// the sharp edge there (docs/lattice-settings.md, "Edges that shed"). Wings with joints of their own are left out,
    /// and those without lift, whose trailing edges shed nothing.
    pub fn tips_of_attached_wings(&self) -> Option<String> {
        let air = self.air.lattice()?;
        let shedding = air.lattice.shedding;
        if !(shedding.tip && shedding.trailing) {
            return None;
        }
        let held = held(&air.lattice)?;
        let wings = self.animal.wings.iter().enumerate();
        let attached = wings.filter(|(w, wing)| !self.has_own_joint(*w) && self.holds(wing, held));
        let names = names(attached.map(|(_, wing)| &wing.name[..]), ", ");
        (!names.is_empty()).then(|| {
            format!(
                "wings ({names}) meet the air with no more than {held:.3} of suction ({:.0} deg of incidence), where flow stays attached, and \
                 their tips shed nevertheless: the lift comes out high, by a quarter at an aspect ratio of 2, a tenth at 4, a twentieth \
                 at 8; take air.shed = [\"trailing\"] (docs/lattice-settings.md, \"Edges that shed\")",
                held.asin().to_degrees()
            )
        })
    }

    /// Whether the wing meets air, and no strip of it ever with more suction than `held`.
    fn holds(&self, wing: &Wing, held: f64) -> bool {
        let motion = wing.motion.impulsive();
        // A root that moves may take longer than a beat.
        let (count, step) = match (&self.mode, motion.frequency > 0.0) {
            (MotionMode::Free(_), true) => (INSTANTS, 1.0 / (motion.frequency * INSTANTS as f64)),
            _ => self.time.looks(LOOKS),
        };
        let sections = (0..count).flat_map(|k| {
            let past = self.air_past(wing, &motion, k as f64 * step);
            sections(wing, past)
        });
        let mut moving = sections.filter(|s| s.speed > 0.0).peekable();
        moving.peek().is_some() && moving.all(|s| s.suction.abs() <= held)
    }

    /// Part of the vorticity that the leading edge of wing `w` sheds in a beat of its prescribed motion, or in
    /// a period of its tether or all of the flight where the wing does not beat, that is left over of one sign
    /// \[1\]: none in strokes that are alike back and forth, 1 if all has one sign; 0 in other models of the
    /// air than lattices. The body goes on with the velocity and the attitude with which it starts.
    pub fn one_sided_part(&self, w: usize) -> f64 {
        let wing = &self.animal.wings[w];
        let Some(air) = self.air.lattice() else {
            return 0.0;
        };
        let motion = wing.motion.impulsive();
        let duration = self.round(motion.frequency);
        let (mut net, mut gross) = (0.0, 0.0);
        for k in 0..INSTANTS {
            let t = k as f64 / INSTANTS as f64 * duration;
            let past = self.air_past(wing, &motion, t);
            for rate in shed_rates(&air.lattice, wing, past) {
                net += rate;
                gross += rate.abs();
            }
        }
        if gross > 0.0 {
            f64::abs(net) / gross
        } else {
            0.0
        }
    }

    /// What a wing of this beat [Hz] goes through again and again, or all of the flight [s].
    pub(super) fn round(&self, beat: f64) -> f64 {
        let whole = self.time.steps as f64 * self.time.step;
        let of_root = match &self.mode {
            MotionMode::Tethered(motion) => motion.period(),
            MotionMode::Free(_) => None,
        };
        match beat > 0.0 {
            true => 1.0 / beat,
            false => of_root.unwrap_or(whole),
        }
    }
}

/// Suction parameter up to which flow stays attached \[1\]; none where edges shed at any.
pub(super) fn held(lattice: &AirSettings) -> Option<f64> {
    match lattice.leading {
        _ if !lattice.shedding.leading => Some(ATTACHED),
        LeadingEdge::Always => None,
        LeadingEdge::AngleOfAttack { threshold } => Some(threshold.min(0.5 * PI).sin()),
        LeadingEdge::Never => Some(ATTACHED),
        _ => lattice.leading.suction().map(|[held, _]| held.min(1.0)),
    }
}

/// How a chordwise strip meets the air.
pub(super) struct Section {
    /// |u| [m/s].
    pub speed: f64,
    /// A0 \[1\].
    pub suction: f64,
    /// Across the strip [m].
    width: f64,
}

/// The strips of a wing, `past` the air past its places [m/s].
pub(super) fn sections(
    wing: &Wing,
    past: impl Fn(DVec3) -> DVec3,
) -> impl Iterator<Item = Section> {
    strips(wing).map(move |[front, rear, across]| {
        let aft = (rear - front).normalize_or_zero();
        let quarter = past(front.lerp(rear, 0.25));
        let speed = quarter.dot(aft).hypot(quarter.z);
        Section {
            speed,
            suction: past(front.midpoint(rear)).z / speed.max(f64::MIN_POSITIVE),
            width: across.reject_from(aft).length(),
        }
    })
}

/// What leaves the leading edge in unit time but for a factor without a unit, strip by strip [m3/s2].
fn shed_rates(
    lattice: &AirSettings,
    wing: &Wing,
    past: impl Fn(DVec3) -> DVec3,
) -> impl Iterator<Item = f64> {
    let held = held(lattice).unwrap_or(0.0);
    // Beyond an angle all leaves, and not only what is beyond.
    let kept = match lattice.leading {
        LeadingEdge::AngleOfAttack { .. } => 0.0,
        _ => held,
    };
    sections(wing, past).map(move |s| {
        let size = s.suction.abs();
        let leaves = if size > held { size - kept } else { 0.0 };
        s.speed * s.speed * leaves.copysign(s.suction) * s.width
    })
}
