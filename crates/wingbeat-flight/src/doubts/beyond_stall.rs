//! Wings that meet the air, in their prescribed motion, beyond the suction that leading edges hold, in a lattice whose
//! leading edges shed nothing.
//!
//! The suction parameter A0 of a section is that of the undisturbed air past it, less what the wing's own trailing
//! vortices take of the incidence: the part `2 / (2 + AR)` at the aspect ratio AR [Prandtl's elliptic wing], none in
//! plane flow. The wake that the section has shed since its motion changed takes another part, `lambda` of
//! [`Unsteady::Jones`], which trailing vortices lessen as they lessen the rest: wings of an aspect ratio of 3 and 6 begin
//! with 0.72 and 0.64 of their lift [Jones 1940], by this with 0.70 and 0.63. Flow that has more suction than the edge holds
//! leaves it, but a vortex forms only while the section goes some chords: excursions over less than half a one, as those of
//! a foil that heaves fast by a small part of its chord, are not meant.

use super::said::names;
use crate::setup::FlightSetup;
use wingbeat_air::{AirSettings, EdgeKind, LeadingEdge, LoadMethod};
use wingbeat_blade::{Indicial, Unsteady};

/// Suction parameter that few edges hold: flat plates and SD7003 0.11 to 0.19, the round noses of NACA 0012 and 63A015 0.25
/// and 0.26 (docs/separated-flow.md, "Which threshold") \[1\].
const STALLS: f64 = 0.25;

/// Way in chords while the suction is larger, from which on a vortex counts: an eighth of the way in which it forms
/// (`air.leading_edge_formation_chords`), half a period of a plunge at a reduced frequency of 3.
const FORMS: f64 = 0.5;

/// Part of the square of the speed past the wing, summed over strips and time, above which it is said: strokes that turn
/// have less for an instant.
const PART: f64 = 0.1;

/// Wingbeats before the one that is looked at, after which the wake is that of all beats but for some per cent.
const BEATS_BEFORE: usize = 3;

impl FlightSetup {
    /// Says which wings meet the air beyond stall in their prescribed motion though the lattice lets nothing
    /// leave their leading edges, those that hang on other wings with the motion of these. Wings on joints that
    /// leave anything free, elastic ones and those that beat while their tips shed
    /// ([`Self::attached_strokes_beyond_stall`]) are left out, and so are forces by Polhamus's analogy.
    pub fn attached_beyond_stall(&self) -> Option<String> {
        let found = self.beyond_stall(|beats, tips_shed| !(beats && tips_shed))?;
        Some(format!(
            "{found}, and attached flow has too much lift, thrust and suction; let leading edges shed (air.shed with \
             \"leading\", docs/separated-flow.md, \"Which choice for which flight\")"
        ))
    }

    /// The same of wings that beat and whose tips shed, as insects are flown attached for trim and modes.
    pub fn attached_strokes_beyond_stall(&self) -> Option<String> {
        let found = self.beyond_stall(|beats, tips_shed| beats && tips_shed)?;
        Some(format!(
            "{found}; attached flow, chosen by air.shed = [\"trailing\", \"tip\"], has neither its vortex nor its stall"
        ))
    }

    /// The same of the wings that are `meant`, by whether they beat and whether tips shed.
    fn beyond_stall(&self, meant: fn(bool, bool) -> bool) -> Option<String> {
        let air = &self.air.lattice()?.lattice;
        if !is_of_attached_flow(air) {
            return None;
        }
        let wings = self.animal.wings.iter().enumerate();
        let known = wings.filter(|(w, wing)| {
            let beats = !wing.is_still() || self.rides_on_wing(*w);
            meant(beats, air.shedding.tip)
                && wing.structure.is_none()
                && self.prescribed_in_body(*w, 0.0).is_some()
        });
        let judged = known.map(|(w, wing)| (&wing.name[..], self.stall(w)));
        let found: Vec<_> = judged.filter(|(_, stall)| stall[0] > PART).collect();
        let [part, most] = [0, 1].map(|k| {
            let values = found.iter().map(|(_, stall)| stall[k]);
            values.fold(0.0, f64::max)
        });
        (!found.is_empty()).then(|| {
            format!(
                "wings ({}) meet the air with up to {:.0} deg of incidence (what their wakes take of it is taken off), for half a chord or more at a time with a suction parameter above {STALLS} (thin edges hold \
                 0.11 to 0.19, that of NACA 0012 0.25), over {:.0} % of the squares of their speeds: the flow leaves the leading edges there",
                names(found.iter().map(|(name, _)| *name), ", "),
                most.min(1.0).asin().to_degrees(),
                100.0 * part
            )
        })
    }

    /// Part of the squares of the speeds that wing `w` has beyond stall, and its largest suction parameter there \[1\].
    fn stall(&self, w: usize) -> [f64; 2] {
        let remains = self.remains_of_incidence(w);
        let cols = self.animal.wings[w].mesh.cols;
        let (mut ways, mut wakes) = (vec![0.0; cols], vec![Wake::default(); cols]);
        let wagner = Unsteady::Jones.indicial();
        let [mut all, mut beyond, mut most] = [0.0, 0.0, 0.0_f64];
        self.visit_sections(w, BEATS_BEFORE, |section, step| {
            let (way, wake) = (&mut ways[section.column], &mut wakes[section.column]);
            let gone = section.speed * step.duration / section.chord;
            wake.take(&wagner, section.downwash[1], 2.0 * gone);
            let downwash = section.downwash[0] - remains * wake.lambda();
            let suction = remains * (downwash / section.speed).abs();
            *way = match suction > STALLS {
                true => *way + gone,
                false => 0.0,
            };
            if step.is_before {
                return;
            }
            let counts = section.speed * section.speed * section.area;
            all += counts;
            if *way >= FORMS {
                beyond += counts;
                most = most.max(suction);
            }
        });
        match all > 0.0 {
            true => [beyond / all, most],
            false => [0.0; 2],
        }
    }

    /// What trailing vortices leave of the incidence of wing `w`, joined to others, to its mirror image in a
    /// plane of images, or to nothing \[1\].
    fn remains_of_incidence(&self, w: usize) -> f64 {
        let Some(air) = self.air.lattice() else {
            return 1.0;
        };
        if air.lattice.plane_wakes {
            return 1.0;
        }
        let surface = one_surface(w, &air.joined_tips);
        let is_joined = (air.joined.iter().flatten()).any(|w| surface.contains(w));
        let is_half = (surface.iter()).any(|&w| {
            [EdgeKind::Root, EdgeKind::Tip]
                .iter()
                .any(|&kind| self.is_on_plane(w, kind))
        });
        let sides = if is_joined || is_half { 2.0 } else { 1.0 };
        let reports = surface.iter().map(|&w| self.animal.wings[w].report());
        let [length, area] = reports.fold([0.0; 2], |[length, area], r| {
            [length + r.length, area + r.length * r.mean_chord]
        });
        let chord = match surface[..] {
            [only] => self.animal.wings[only].report().mean_chord,
            _ => area / length,
        };
        let aspect = sides * length / chord;
        aspect / (aspect + 2.0)
    }
}

/// Wing `w` and those that are joined to it by tips and roots, `[inner, outer]`.
fn one_surface(w: usize, joined_tips: &[[usize; 2]]) -> Vec<usize> {
    let mut surface = vec![w];
    let mut next = 0;
    while let Some(&here) = surface.get(next) {
        for pair in joined_tips.iter().filter(|pair| pair.contains(&here)) {
            let new = pair.iter().find(|w| !surface.contains(w)).copied();
            surface.extend(new);
        }
        next += 1;
    }
    surface
}

/// Whether nothing leaves leading edges, and forces are those of attached flow.
fn is_of_attached_flow(air: &AirSettings) -> bool {
    let is_held = !air.shedding.leading || air.leading == LeadingEdge::Never;
    air.shedding.trailing && is_held && air.loads != LoadMethod::Polhamus
}

/// What the wake of a section induces on it.
#[derive(Clone, Debug, Default)]
struct Wake {
    /// The downwash at three quarters of the chord that it knows of, if any [m/s].
    known: Option<f64>,
    /// What is left of each part of the indicial function, two exponentials [m/s].
    parts: [f64; 2],
}

impl Wake {
    /// Sheds what the change to this `downwash` [m/s] asks for, and leaves the section by so many half chords; what it is at
    /// first began at once.
    fn take(&mut self, wagner: &Indicial, downwash: f64, half_chords: f64) {
        let change = downwash - self.known.replace(downwash).unwrap_or(0.0);
        for (part, pole) in self.parts.iter_mut().zip(wagner.poles()) {
            let half = (-0.5 * pole.rate.re * half_chords).exp();
            *part = (*part * half + pole.weight.re * change) * half;
        }
    }

    /// The downwash that it induces [m/s].
    fn lambda(&self) -> f64 {
        self.parts.iter().sum()
    }
}
