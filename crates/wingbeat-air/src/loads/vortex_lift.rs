//! What becomes of the forces of strips whose leading edges have vortex lift, see [`VortexLift`].

use crate::geometry::{NodeMotion, Strip, section};
use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use crate::settings::{ForceFactors, Passage, VortexLift};
use crate::solve::LeadingSection;
use wingbeat_math::DVec3;

/// A strip at one instant.
pub(crate) struct Yielding {
    pub parts: ForceFactors,
    /// Chords for which its vortex has been fed \[1\].
    pub fed: f64,
    /// Suction parameter, positive where the leading panel lifts along its normal \[1\].
    pub parameter: f64,
}

/// What strip `strip` makes of its forces, `dt` [s] after its vortex had been fed for `before` chords.
pub(crate) fn yielding(
    (lattice, law): (&Lattice, &VortexLift),
    strip: &Strip,
    motion: &NodeMotion,
    (before, dt): (f64, f64),
    out: &AirLoads,
) -> Yielding {
    let [parameter, speed] = suction_parameter(lattice, strip, &motion.position, out);
    let (aft, c) = section(strip, &motion.position);
    let passage = Passage {
        chords: speed / c,
        turning: turning(strip, motion, aft),
    };
    let fed = law.fed(before, parameter, passage, dt);
    Yielding {
        parts: law.parts(parameter, fed),
        fed,
        parameter,
    }
}

/// Suction parameter of a strip, positive where the leading panel lifts along its normal \[1\], and speed at
/// its quarter chord [m/s].
pub(crate) fn suction_parameter(
    lattice: &Lattice,
    strip: &Strip,
    position: &[DVec3],
    out: &AirLoads,
) -> [f64; 2] {
    let section = LeadingSection::of((lattice, &out.panels, out.time), strip, position);
    let net = section.counted(foremost(strip, &out.gamma), 1.0);
    [section.parameter(net), section.speed]
}

/// Circulations of the two foremost vortices of a strip where no wake is at its edge [m2/s].
pub(crate) fn foremost(strip: &Strip, gamma: &[f64]) -> [f64; 2] {
    let first = gamma[strip.panels[0]];
    let second = strip.panels.get(1).map_or(0.0, |&p| gamma[p] - first);
    [first, second]
}

/// Rate at which the section of a strip turns about axes across its span [rad/s]: how the velocity of its
/// quarter chord changes along the span, pitching apart.
fn turning(strip: &Strip, motion: &NodeMotion, aft: DVec3) -> f64 {
    let sides = sides(strip, motion);
    let across = |list: &[DVec3]| {
        let at = |[f, r]: [usize; 2]| list[f].lerp(list[r], 0.25);
        at(sides[1]) - at(sides[0])
    };
    let along = |list: &[DVec3]| {
        let [a, b] = sides.map(|[f, r]| list[r] - list[f]);
        a.midpoint(b)
    };
    let (way, column) = (across(&motion.position), along(&motion.position));
    let part = way.dot(aft) / column.dot(aft);
    let span = way - part * column;
    let turned = across(&motion.velocity) - part * along(&motion.velocity);
    turned.reject_from(span).length() / span.length()
}

/// Front and rear node on either side of a strip.
fn sides(strip: &Strip, motion: &NodeMotion) -> [[usize; 2]; 2] {
    let ([a, b], [c, d]) = (strip.front(), strip.rear());
    let x = &motion.position;
    match (x[b] - x[a]).dot(x[d] - x[c]) > 0.0 {
        true => [[a, c], [b, d]],
        false => [[a, d], [b, c]],
    }
}
