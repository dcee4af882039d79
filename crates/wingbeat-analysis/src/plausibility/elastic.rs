//! What of the structure of a wing is implausible: units, and masses out of place.

use std::f64::consts::PI;

use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::{Members, Wing, WingBeam, WingShell, WingStructure};
use wingbeat_structure::{StructureError, first_frequency};

use super::limit::{Doubts, Limit, rounded};
use super::numbers::WingEstimate;

/// Wings of insects vibrate at two to ten times their wingbeat [Combes & Daniel 2003; Ennos 1988], spars of
/// robots up to a few hundred.
const RATIO: Limit = Limit {
    low: 1.0,
    high: 1000.0,
    hints: [
        "so soft a wing does not follow its root; are moduli in Pa, EI and GJ in N m2, thickness and radii in m?",
        "it will hardly bend; are moduli in Pa, EI and GJ in N m2, thickness and radii in m? A rigid wing has no structure",
    ],
};

/// Wings in a stream that do not beat: those of gliders and tunnels vibrate at 0.005 to 1 times speed over chord.
const IN_STREAM: Limit = Limit {
    low: 1e-3,
    high: 1000.0,
    hints: RATIO.hints,
};

/// Beyond a tenth of the length the wing turns by some ten degrees, and modes about rest are those of another wing.
const WEIGHT: Limit = Limit::at_most(
    0.1,
    "it hangs down before the air bends it, or falls where a flight begins; `wingbeat modes` leaves weight out but for --steady; are moduli in Pa, EI in N m2, masses in kg?",
);

/// Displacement of the tip of an even cantilever by its weight times `omega^2 / g`, omega its first angular frequency:
/// `1.8751^4 / 8` [Blevins, Formulas for natural frequency and mode shape, 1979, table 8-1].
const CANTILEVER: f64 = 1.5453;

/// Stiffness over mass per length and the square of half the chord \[m2/s2\]: modulus over density of a spar as thick as
/// the chord is long, less than of any other. Carbon fibres have 1.3e8, diamond 3.4e8.
const MATTER: Limit = Limit::at_most(
    3.4e8,
    "no matter is so stiff for its weight; are EI and GJ in N m2, masses in kg?",
);

const THICKNESS: Limit = Limit::at_most(0.25, "no sheet; is it in m?");

const OFFSET: Limit = Limit::at_most(2.0, "it lies far outside the wing; is offset_m in m?");

/// Damping that is mostly of strain rates.
const DAMPING: Limit = Limit::at_most(
    1.0,
    "the wing creeps back and does not vibrate; structure.damping_s is twice the damping ratio over the angular frequency",
);

/// Damping that is mostly of momentum.
const MASS_DAMPING: Limit = Limit::at_most(
    1.0,
    "the wing creeps back and does not vibrate; structure.mass_damping_per_s is twice the damping ratio times the angular frequency",
);

/// Tension at rest over modulus times thickness: the strain of a sheet of that modulus. Membranes of wings are of latex,
/// stretched by less than 1; it tears at 5 to 8.
const TENSION: Limit = Limit::at_most(
    2.0,
    "no membrane of a wing is stretched so far; is prestress_newton_per_m in N/m (a stress times the thickness), and are moduli in Pa?",
);

/// Panels of a sheet up to which its first frequency takes less than half a second, the elastic body built again.
const PANELS: usize = 300;

/// First frequency in vacuum \[Hz\] of a wing that is elastic, can be built and is not large; an error where
/// rounding hides it.
type First = Result<Option<f64>, StructureError>;

/// Those of all wings; mirror images share theirs.
pub(super) fn first_frequencies(wings: &[Wing]) -> Vec<First> {
    let mut found: Vec<First> = vec![];
    for (k, wing) in wings.iter().enumerate() {
        let like = (0..k).find(|&j| are_alike(&wings[j], wing));
        found.push(like.map_or_else(|| of_wing(wing), |j| found[j].clone()));
    }
    found
}

fn of_wing(wing: &Wing) -> First {
    let Some(structure) = &wing.structure else {
        return Ok(None);
    };
    let panels = wing.mesh.rows * wing.mesh.cols;
    if matches!(structure.members, Members::Shell(_)) && panels > PANELS {
        return Ok(None);
    }
    let Ok(body) = structure.body(&wing.blank()) else {
        return Ok(None); // the flight says why
    };
    let turns = matches!(structure.members, Members::Beam(_));
    let first = first_frequency(&body.structure, turns);
    first.map(|w| w.map(|w| w / (2.0 * PI)))
}

/// Whether the two are the same or mirror images.
fn are_alike(a: &Wing, b: &Wing) -> bool {
    let [m, n] = [a, b].map(|w| &w.mesh);
    let shape = |w: &Wing| [w.mesh.rows, w.mesh.cols];
    let alike = m.nodes.iter().zip(&n.nodes).all(|(p, q)| {
        p.x.total_cmp(&q.x).is_eq()
            && p.y.abs().total_cmp(&q.y.abs()).is_eq()
            && p.z.total_cmp(&q.z).is_eq()
    });
    let weight = a.mass.mass.total_cmp(&b.mass.mass).is_eq();
    a.structure == b.structure && shape(a) == shape(b) && weight && alike
}

/// Displacement of the tip over the length of an elastic wing \[1\] that `gravity` \[m/s2\] across it would give, were it
/// linear, from the first frequency `omega` \[rad/s\] as an even cantilever has it; of beams that twist more easily than
/// they bend from the stiffness in flap at half of the length. None where that frequency is not known.
pub(crate) fn bent_by_weight(wing: &Wing, omega: Option<f64>, gravity: f64) -> Option<f64> {
    let report = wing.report();
    let omega = match wing.structure.as_ref().map(|s| &s.members)? {
        Members::Beam(beam) => {
            let [bending, twist] = alone(wing, beam, [report.length, report.mean_chord]);
            omega.map(|first| if twist < bending { bending } else { first })
        }
        Members::Shell(_) => omega,
    };
    let of = |omega: f64| CANTILEVER * gravity / (omega * omega * report.length);
    omega.filter(|omega| *omega > 0.0).map(of)
}

/// Angular frequencies \[rad/s\] of bending and twist alone, of an even beam as stiff as this one is at half of its
/// length.
fn alone(wing: &Wing, beam: &WingBeam, [length, chord]: [f64; 2]) -> [f64; 2] {
    let mass = wing.mass.mass;
    let middle = |law: &SpanLaw| law.at(0.5, 0.0);
    let bending = 3.516 * (middle(&beam.flap) / (mass * length.powi(3))).sqrt();
    let inertia = mass * chord * chord / 12.0;
    let twist = 0.5 * PI * (middle(&beam.torsion) / (inertia * length)).sqrt();
    [bending, twist]
}

/// Doubts about what `wing` is made of, in this `gravity` \[m/s2\].
pub(super) fn doubts(wing: &Wing, w: &WingEstimate, gravity: f64, list: &mut Doubts) {
    let Some(structure) = &wing.structure else {
        return;
    };
    let omega = w.first_frequency.map(|f| 2.0 * PI * f);
    let bent = bent_by_weight(wing, omega, gravity);
    let what = "displacement of the tip by weight across the wing, were it linear, over its length";
    list.see(&WEIGHT, what, bent, "");
    let ratio = "first frequency in vacuum over the wingbeat frequency";
    let before = list.0.len();
    let tightens =
        matches!(&structure.members, Members::Shell(shell) if tightens_under_load(shell));
    let mut is_slack = false;
    let mut see = |limit: &Limit, what: &str, x: Option<f64>| match x
        .is_some_and(|x| tightens && x < limit.low)
    {
        true => is_slack = true,
        false => list.see(limit, what, x, ""),
    };
    see(&RATIO, ratio, w.frequency_ratio);
    if w.frequency_ratio.is_none() && w.speed > 0.0 {
        let in_stream = w.first_frequency.map(|f| f * w.report.mean_chord / w.speed);
        let what = "first frequency in vacuum times chord over speed";
        see(&IN_STREAM, what, in_stream);
    }
    if let (Members::Beam(beam), true) = (&structure.members, list.0.len() == before) {
        each_way(wing, beam, w, list);
    }
    if let (Members::Beam(beam), true) = (&structure.members, list.0.len() == before) {
        matter(wing, beam, list);
    }
    if w.hides_frequency {
        list.0.push("its stiffnesses differ by more than numbers of 16 digits hold: steps will find no solution; are EI and GJ in N m2, EA and GA in N, moduli in Pa?".to_owned());
    }
    if !is_slack {
        damping(structure, w, list);
    }
    let chord = w.report.mean_chord;
    match &structure.members {
        Members::Beam(beam) => masses(beam, chord, list),
        Members::Shell(shell) => sizes(shell, chord, list),
    }
}

/// Bending and twist alone, of an even beam as stiff as this one is at half of its length: where one is soft
/// the first frequency hides the other.
fn each_way(wing: &Wing, beam: &WingBeam, w: &WingEstimate, list: &mut Doubts) {
    let Some(beat) = w.first_frequency.zip(w.frequency_ratio).map(|(f, r)| f / r) else {
        return;
    };
    let [bending, twist] = alone(wing, beam, [w.report.length, w.report.mean_chord]);
    for (what, omega) in [("flap", bending), ("torsion", twist)] {
        let what = format!(
            "frequency that structure.beam.{what}_newton_m2 alone gives over the wingbeat frequency"
        );
        let high = omega / (2.0 * PI * beat);
        list.see(&Limit { low: 0.0, ..RATIO }, &what, high, "");
    }
}

/// Whether there is matter for these stiffnesses, at half of the length.
fn matter(wing: &Wing, beam: &WingBeam, list: &mut Doubts) {
    let report = wing.report();
    let massive = wing.mass.mass / report.length * (0.5 * report.mean_chord).powi(2);
    for (what, law) in [("flap", &beam.flap), ("torsion", &beam.torsion)] {
        let what = format!(
            "structure.beam.{what}_newton_m2 over mass per length and half the chord squared"
        );
        list.see(&MATTER, &what, law.at(0.5, 0.0) / massive, " m2/s2");
    }
}

/// Damping ratio of the first mode.
fn damping(structure: &WingStructure, w: &WingEstimate, list: &mut Doubts) {
    let Some(omega) = w.first_frequency.map(|f| 2.0 * PI * f).filter(|w| *w > 0.0) else {
        return;
    };
    let d = structure.damping;
    let parts = [0.5 * d.strain_rate * omega, 0.5 * d.mass / omega];
    let limit = match parts[1] > parts[0] {
        true => MASS_DAMPING,
        false => DAMPING,
    };
    let what = "damping ratio of the first mode";
    list.see(&limit, what, parts[0] + parts[1], "");
}

/// Whether a sheet is held all round without tension: loads stretch it and make it stiff, however little it resists
/// bending, from which its first frequency at rest is.
fn tightens_under_load(shell: &WingShell) -> bool {
    let regions = shell.regions.iter().filter_map(|g| g.prestress);
    let mut tensions = regions.chain([shell.prestress]).flatten();
    shell.clamps_perimeter && tensions.all(|n| n <= 0.0)
}

fn masses(beam: &WingBeam, chord: f64, list: &mut Doubts) {
    for (k, mass) in beam.masses.iter().enumerate() {
        let what = format!("offset of the lumped mass structure.beam.mass[{k}]");
        list.see(&OFFSET, &what, mass.offset.length() / chord, " mean chords");
    }
}

fn sizes(shell: &WingShell, chord: f64, list: &mut Doubts) {
    let largest = match &shell.thickness {
        SpanLaw::Linear { root, tip } => root.max(*tip),
        SpanLaw::Table(rows) => rows.iter().map(|row| row.1).fold(0.0, f64::max),
    };
    let unit = " mean chords";
    list.see(
        &THICKNESS,
        "structure.shell.thickness",
        largest / chord,
        unit,
    );
    let stiff = shell
        .young
        .map(|young| shell.stretching.unwrap_or(young) * largest);
    let strain = (shell.prestress.iter().zip(stiff)).map(|(n, k)| n / k);
    let what = "structure.shell.prestress over modulus times thickness";
    list.see(&TENSION, what, strain.fold(0.0, f64::max), "");
    for (k, region) in shell.regions.iter().enumerate() {
        let what = format!("structure.region[{k}].thickness_m");
        list.see(&THICKNESS, &what, region.thickness.map(|h| h / chord), unit);
    }
    for (k, vein) in shell.veins.iter().enumerate() {
        let wide = 2.0 * vein.radius[0].max(vein.radius[1]) / chord;
        if wide > THICKNESS.high {
            list.0.push(format!(
                "structure.vein[{k}].radius_m: {} mean chords from side to side, no vein; is it in m?",
                rounded(wide)
            ));
        }
    }
}
