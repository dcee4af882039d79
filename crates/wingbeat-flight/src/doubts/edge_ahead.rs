//! Wings whose prescribed motion moves them with the trailing edge ahead, or broadside.
//!
//! The air past a section, weighted by its dynamic pressure, goes from the leading to the trailing edge in both
//! strokes of every wing that flies, hovering or not: the mean of the cosine of the angle of attack is above 0.
//! In hover angles in another convention (a rotation angle counted from the stroke plane, a sign) turn it round
//! in one of the strokes, and the lift, which a plate has both ways round, hardly tells. Feathering that is a
//! quarter of a beat off, or the angle of another column, turns the wing while it is fastest: it stands
//! broadside there in both strokes, though it feathers far.

use std::ops::AddAssign;

use wingbeat_math::DVec3;
use wingbeat_model::Wing;

use super::air_past::strips;
use super::said::{grouped, names};
use crate::setup::FlightSetup;

/// Instants of a beat that are looked at.
const INSTANTS: usize = 100;

/// Mean cosine of the angle of attack below which the trailing edge is ahead \[1\]: plates that stroke
/// broadside have 0.
const BACKWARDS: f64 = -0.2;

/// Mean cosine of the angle of attack below which a stroke is broadside \[1\]: within some 70 to 110 deg.
const BROADSIDE: f64 = 0.35;

/// Half of the range of the feathering angle from which on a wing that strokes broadside was meant to feather
/// \[rad\].
const FEATHERS: f64 = 25.0 * std::f64::consts::PI / 180.0;

/// Part of the dynamic pressure of a beat that a stroke has at least to count \[1\].
const COUNTS: f64 = 0.05;

/// Speed of the feathering axis over that of mid chord below which only rounding moves the axis \[1\].
const AT_REST: f64 = 1e-9;

/// A half of a beat.
#[derive(Clone, Copy, Debug, Default)]
struct Stroke {
    /// Sum over strips and instants of speed squared times width.
    pressure: f64,
    /// The same times the cosine of the angle of attack.
    along: f64,
    /// Greatest part of one instant in `pressure`, and the feathering angle then \[rad\].
    most: f64,
    psi: f64,
}

/// A beat of a wing.
struct Beat {
    /// Its down- and upstroke.
    strokes: [Stroke; 2],
    /// Half of the range of the feathering angle \[rad\].
    feathers: f64,
}

/// What is doubted of a wing, and what to look at.
#[derive(PartialEq)]
struct EdgeDoubt {
    what: String,
    remedy: &'static str,
}

impl Beat {
    /// Which strokes move the trailing edge ahead.
    fn turned_round(&self) -> Option<EdgeDoubt> {
        const REMEDY: &str = "in the convention of this program psi is below 0 in the downstroke and above 0 in the upstroke of a \
             hovering animal; a rotation angle counted from the stroke plane, 0 to 180 deg, becomes psi by factor = -1 and offset_deg = 90 \
             in its table, or by offset_deg = -90. A stroke counted the other way makes the same: where phi grows backward in your data, leave psi, and \
             give the table of phi factor = -1 (ANGLES.md)";
        let all: f64 = self.strokes.iter().map(|s| s.pressure).sum();
        let both = ["downstroke", "upstroke"].into_iter().zip(&self.strokes);
        let wrong =
            both.filter(|(_, s)| s.pressure > COUNTS * all && s.along < BACKWARDS * s.pressure);
        let said: Vec<String> = wrong
            .map(|(name, s)| {
                format!(
                    "{name} (psi = {:.0} deg at its fastest)",
                    s.psi.to_degrees()
                )
            })
            .collect();
        (!said.is_empty()).then(|| EdgeDoubt {
            what: format!(
                "the trailing edge is ahead in the {}",
                said.join(" and the ")
            ),
            remedy: REMEDY,
        })
    }

    /// What is doubted. A wing that feathers far and has about the same angle at its fastest both ways feathers
    /// while its stroke turns back, whatever its mean angle; angles of another convention differ most then.
    fn doubt(&self) -> Option<EdgeDoubt> {
        let feathers = self.feathers > FEATHERS;
        let [down, up] = self.strokes;
        let is_broadside =
            |pressure: f64, along: f64| pressure > 0.0 && along.abs() < BROADSIDE * pressure;
        let is_same = (down.psi - up.psi).abs() < self.feathers;
        if feathers && is_same && is_broadside(down.pressure + up.pressure, down.along + up.along) {
            return Some(self.broadside());
        }
        let both = || [down, up].iter().all(|s| is_broadside(s.pressure, s.along));
        (self.turned_round()).or_else(|| (feathers && both()).then(|| self.broadside()))
    }

    /// What is said of a wing that feathers far, and yet strokes broadside both ways, or in their mean.
    fn broadside(&self) -> EdgeDoubt {
        // Without the sign of a zero.
        let psi = self.strokes.map(|s| s.psi.to_degrees().round() + 0.0);
        EdgeDoubt {
            what: format!(
                "the wing stands broadside to its way where it is fastest, psi = {:.0} deg in the downstroke and {:.0} deg in the upstroke, though it feathers by {:.0} deg to either side",
                psi[0],
                psi[1],
                self.feathers.to_degrees()
            ),
            remedy: "is the feathering a quarter of a beat off, or another column? Look at the phase of motion.psi, or at its angle_column (ANGLES.md)",
        }
    }
}

impl AddAssign<(f64, f64, f64)> for Stroke {
    /// Adds pressure and its part along the chord of an instant with this feathering angle.
    fn add_assign(&mut self, (pressure, along, psi): (f64, f64, f64)) {
        self.pressure += pressure;
        self.along += along;
        if pressure > self.most {
            (self.most, self.psi) = (pressure, psi);
        }
    }
}

impl FlightSetup {
    /// Says which wings move with the trailing edge ahead in one of their strokes, and what angles do so, or
    /// feather and yet stroke broadside. Wings that do not beat, have joints of their own, or revolve backwards with the body
    /// are left out.
    pub fn trailing_edges_ahead(&self) -> Vec<String> {
        let wings = self.animal.wings.iter().enumerate();
        let beating =
            wings.filter(|(w, wing)| !self.has_own_joint(*w) && wing.motion.frequency > 0.0);
        let beating = beating.filter(|(_, wing)| !self.goes_back_as_body_turns(wing));
        let doubts = beating.filter_map(|(_, w)| Some((self.beat(w).doubt()?, &w.name[..])));
        let say = |(doubt, wings): (EdgeDoubt, Vec<&str>)| {
            let wings = names(wings, ", ");
            format!("{} (wings {wings}): {}", doubt.what, doubt.remedy)
        };
        grouped(doubts).into_iter().map(say).collect()
    }

    /// Down- and upstroke of a wing in its prescribed motion; the body goes on as it starts. The speed of a
    /// strip is that of the feathering axis: feathering itself moves broad chords faster than a stroke does,
    /// broadside.
    fn beat(&self, wing: &Wing) -> Beat {
        let motion = wing.motion.impulsive();
        let mut strokes = [Stroke::default(); 2];
        let mut feathering = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..INSTANTS {
            let t = k as f64 / INSTANTS as f64 / motion.frequency;
            let [[_, rate, _], _, [psi, ..]] = motion.angles(t);
            feathering = [feathering[0].min(psi), feathering[1].max(psi)];
            let goes_up = wing.side.sign() * rate < 0.0;
            let past = self.air_past(wing, &motion, t);
            let (mut pressure, mut along) = (0.0, 0.0);
            for [front, rear, across] in strips(wing) {
                let (mid, aft) = (front.midpoint(rear), (rear - front).normalize_or_zero());
                let speed = past(DVec3::Y * mid.y);
                if speed.length() < AT_REST * past(mid).length() {
                    continue;
                }
                let width = across.reject_from(aft).length();
                pressure += width * speed.length_squared();
                along += width * speed.length() * speed.dot(aft);
            }
            strokes[usize::from(goes_up)] += (pressure, along, psi);
        }
        Beat {
            strokes,
            feathers: 0.5 * (feathering[1] - feathering[0]),
        }
    }
}
