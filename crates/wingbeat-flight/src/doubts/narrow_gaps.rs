//! Surfaces of a lattice that face each other across gaps narrower than half of their panels: wings that clap, wings over
//! a ground, over each other or over the body.

use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::{Faced, NarrowGap, NarrowGaps, Narrowest, inside, instants_of_gaps};

use super::said::{grouped, names};
use crate::setup::{FlightSetup, MotionMode};

/// Panels along the chord from which on more of them are no remedy.
const MANY: f64 = 100.0;

/// Width of gaps over the length of the panels below which surfaces touch \[1\].
const TOUCHING: f64 = 1e-6;

/// Looks at a flight over a ground, at most.
const LOOKS: usize = 200;

impl FlightSetup {
    /// Says which wings of a lattice face other surfaces across gaps narrower than half of their panels are long along the
    /// chord, over so much of their area that their forces are wrong, in their prescribed motion ([`NarrowGaps`]), and what
    /// to do about it.
    /// Left out are wings on joints that leave anything free, grounds below free bodies, parts of segments, and wings that
    /// pass through each other.
    pub fn surfaces_in_narrow_gaps(&self) -> Vec<String> {
        let tether = match &self.mode {
            MotionMode::Tethered(motion) => Some(motion),
            MotionMode::Free(_) => None,
        };
        let Some(mut gaps) = self.narrow_gaps(tether.is_some()) else {
            return vec![];
        };
        let over_ground = tether.filter(|_| gaps.has_planes());
        let times: Vec<f64> = match over_ground {
            Some(_) => {
                let (looks, step) = self.time.looks(LOOKS);
                (0..=looks).map(|k| k as f64 * step).collect()
            }
            None => instants_of_gaps(&self.animal).collect(),
        };
        let bodies = self.animal.wings.len() + self.animal.segments.len();
        for t in times {
            let root = over_ground.map(|motion| motion.at(t).motion);
            let (p, r) = root.map_or((DVec3::ZERO, DMat3::IDENTITY), |root| (root.p, root.r));
            let placed = |body: usize| {
                let in_root = self.prescribed_body(body, t)?;
                Some((p + r * in_root.p, r * in_root.r))
            };
            let poses: Vec<_> = (0..=bodies).map(placed).collect();
            gaps.see(&poses, std::iter::empty(), |m| m.impulsive().phase_at(t)[0]);
        }
        self.say_narrow_gaps(&gaps, "beat")
    }

    /// Looks for the same as wings are flown, where that is not known beforehand: as [`Self::flown_crossings`], and over a
    /// ground by a free body.
    pub fn flown_gaps(&self) -> Option<NarrowGaps> {
        let gaps = self.narrow_gaps(true)?;
        let over_ground = gaps.has_planes() && matches!(self.mode, MotionMode::Free(_));
        (self.moves_otherwise_in_flight() || over_ground).then_some(gaps)
    }

    /// None in other air than a lattice, and where there is nothing that wings may face.
    fn narrow_gaps(&self, with_planes: bool) -> Option<NarrowGaps> {
        let air = self.air.lattice()?;
        let planes = air.lattice.images.iter().filter(|_| with_planes);
        let planes = planes.map(|p| [p.point, p.normal.normalize()]).collect();
        let gaps = NarrowGaps::new(&self.animal, air.body_surfaces, planes);
        (!gaps.is_empty()).then_some(gaps)
    }

    /// Says which gaps were narrow, in parts of the `time`.
    pub fn say_narrow_gaps(&self, gaps: &NarrowGaps, time: &str) -> Vec<String> {
        let mut found = gaps.found();
        if found.is_empty() {
            return vec![];
        }
        let impossible = self.impossible_faces();
        found.retain(|gap| !impossible.contains(&(gap.wing, gap.faced)));
        // Of two wings that face each other one.
        let is_second = |gap: &NarrowGap| match gap.faced {
            Faced::Wing(w) | Faced::Image(w) if w < gap.wing => {
                let back = |g: &NarrowGap| g.wing == w && faced_wing(g) == Some(gap.wing);
                found.iter().any(back)
            }
            _ => false,
        };
        let once = found.iter().filter(|gap| !is_second(gap));
        let said = once.map(|gap| {
            (
                self.say_gap(gap, time),
                &self.animal.wings[gap.wing].name[..],
            )
        });
        let say = |([faced, figures], wings): ([String; 2], Vec<&str>)| {
            let (what, face, whose) = match wings.len() {
                1 => ("wing", "faces", "its"),
                _ => ("wings", "face", "each their"),
            };
            let faced = match faced.starts_with("own") {
                true => format!("{whose} {faced}"),
                false => faced,
            };
            let wings = names(wings, " and ");
            format!("{what} {wings} {face} {faced} across {figures}")
        };
        grouped(said).into_iter().map(say).collect()
    }

    /// Wings and what they pass through, lie in or are inside of by their prescribed motion, of which that is said.
    fn impossible_faces(&self) -> Vec<(usize, Faced)> {
        let doubted = self.doubted_pairs().into_iter();
        let deep = doubted.filter(|(_, is_graze)| !is_graze);
        let wings = deep.flat_map(|([a, b], _)| [(a, Faced::Wing(b)), (b, Faced::Wing(a))]);
        let within = inside(&self.animal, &self.prescribed_wings()).into_iter();
        wings
            .chain(within.map(|i| (i.wing, Faced::Part(i.part))))
            .collect()
    }

    /// What a wing faces, and across which gap.
    fn say_gap(&self, gap: &NarrowGap, time: &str) -> [String; 2] {
        let wings = &self.animal.wings;
        let own = self.animal.parts.iter();
        let mut parts = own.chain(self.animal.segments.iter().flat_map(|s| &s.parts));
        let faced = match gap.faced {
            Faced::Wing(w) => format!("wing `{}`", wings[w].name),
            Faced::Image(w) if w == gap.wing => "own mirror image in air.ground".to_owned(),
            Faced::Image(w) => {
                format!("the mirror image of wing `{}` in air.ground", wings[w].name)
            }
            Faced::Part(k) => {
                let part = parts.nth(k).map_or("", |part| &part.name);
                format!("the body part `{part}`")
            }
        };
        let Narrowest {
            share,
            gap: width,
            panel,
        } = gap.at;
        let excess = match (gap.is_aligned, gap.at.excess()) {
            (true, x) if x < 2.0 => format!("too large, in this one by up to {:.0} %", 100.0 * (x - 1.0)),
            (true, x) if x < 1.0 / TOUCHING => format!("too large, in this one up to {x:.1} times"),
            (true, _) => "without meaning, as these surfaces touch".to_owned(),
            (false, _) => {
                "wrong either way, as panels do not lie opposite each other, in narrow ones by more than they are".to_owned()
            }
        };
        let panels = (wings[gap.wing].mesh.rows as f64 * panel / width).ceil();
        let remedy = match panels <= MANY {
            true => format!(
                "give {panels:.0} panels along the chord (mesh.chordwise), so that they are as short as the gap, or keep the surfaces farther apart"
            ),
            false => {
                "keep the surfaces farther apart, and trust no force at those instants".to_owned()
            }
        };
        let gaps = match width < TOUCHING * panel {
            true => "gaps of no width".to_owned(),
            false => format!("gaps of {width:.2e} m"),
        };
        let figures = format!(
            "{gaps} where panels are {panel:.2e} m long along the chord, over {:.0} % of the area at the narrowest, in {:.0} % of the {time}: forces that open or close such gaps come out {excess}; {remedy} (docs/separated-flow-evidence.md, \"Gaps narrower than a panel\")",
            100.0 * share,
            (100.0 * gap.time).max(1.0),
        );
        [faced, figures]
    }
}

/// The wing that is faced, or whose image is.
fn faced_wing(gap: &NarrowGap) -> Option<usize> {
    match gap.faced {
        Faced::Wing(w) | Faced::Image(w) => Some(w),
        Faced::Part(_) => None,
    }
}
