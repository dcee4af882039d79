//! Leading edges so swept that their vortex is carried along the edge, as those of deltas.

use super::said::names;
use super::shed_by_motion::{held, sections};
use crate::setup::{FlightSetup, LOOKS};
use std::f64::consts::PI;
use wingbeat_air::LeadingEdge;
use wingbeat_model::Wing;

/// Part of a sweep angle that is rounding \[1\].
const ROUNDING: f64 = 1e-9;

/// Sweep of a leading edge from root to tip \[rad\] from which on vortex lift is known to fail: a delta of an
/// aspect ratio of 4 has it.
const SWEPT: f64 = PI / 4.0;

/// Sweep from root to tip \[rad\] from which on the lift of leading edges that shed is known to fail. A delta
/// swept by 76 deg (aspect ratio 1, 8 x 8 panels, six chords after the start) at 10, 20 and 30 deg has 1.26,
/// 0.98 and 0.82 of the lift that Polhamus (1966) has with `suction`, 1.23, 0.90 and 0.65 with
/// `suction_implicit`; one of 63 deg 0.86 and 0.71 of that by his analogy in the same lattice at 20 deg.
const SHARPLY_SWEPT: f64 = PI / 3.0;

/// Way in mean chords on which the edge sheds without a pause, from which on its lift is that of a vortex that
/// stays.
const STAYS: f64 = 3.0;

impl FlightSetup {
    /// Says which wings with vortex lift have leading edges so swept that their vortex is carried along the
    /// edge, which the law does not know (docs/separated-flow-method.md, "Vortex lift without free vorticity").
    pub fn vortex_lift_of_swept_edges(&self) -> Option<String> {
        let air = self.air.lattice()?;
        if !air.lattice.shedding.leading
            || !matches!(air.lattice.leading, LeadingEdge::VortexLift(_))
        {
            return None;
        }
        let wings = self.animal.wings.iter();
        let swept: Vec<_> = wings.filter(|w| is_swept(w, SWEPT)).collect();
        let most = swept.iter().map(|w| sweep(w)).reduce(f64::max)?;
        Some(format!(
            "leading edges are swept by up to {:.0} deg (wings {}), and vortex lift does not know that the vortex of a swept edge is carried \
             along it (a delta of an aspect ratio of 1 has a third of its lift); {POLHAMUS}",
            most.to_degrees(),
            names(swept.iter().map(|w| &w.name[..]), ", "),
        ))
    }

    /// Says which wings that do not beat have sharply swept leading edges that shed on a way of chords
    /// (docs/separated-flow.md, "Do not trust").
    pub fn shedding_of_swept_edges(&self) -> Option<String> {
        let air = self.air.lattice()?;
        if !air.lattice.leading_edges_shed() {
            return None;
        }
        let wings = self.animal.wings.iter().enumerate();
        let swept = wings.filter(|(w, wing)| {
            wing.is_still() && !self.has_own_joint(*w) && is_swept(wing, SHARPLY_SWEPT)
        });
        let threshold = held(&air.lattice).unwrap_or(0.0);
        let shed = swept.filter_map(|(_, wing)| Some((wing, self.sheds_on(wing, threshold)?)));
        let found: Vec<(&Wing, f64)> = shed.collect();
        let most = |of: fn(&(&Wing, f64)) -> f64| found.iter().map(of).reduce(f64::max);
        let (angle, suction) = (most(|f| sweep(f.0))?, most(|f| f.1)?);
        Some(format!(
            "leading edges swept by up to {:.0} deg (wings {}) shed for {STAYS} chords or more, at up to {:.0} deg of incidence: the lift of \
             a sharp delta of aspect ratio 1 came out a quarter high at 10 deg and 18 to 35 % low at 30 deg (the latter by \
             \"suction_implicit\"), right within 10 % at 20 deg; {POLHAMUS}",
            angle.to_degrees(),
            names(found.iter().map(|(w, _)| &w.name[..]), ", "),
            suction.min(1.0).asin().to_degrees(),
        ))
    }

    /// The largest suction parameter that a strip of the wing has while one or another has more than
    /// `threshold` for [`STAYS`] mean chords on end \[1\]; none where that is never so.
    fn sheds_on(&self, wing: &Wing, threshold: f64) -> Option<f64> {
        let motion = wing.motion.impulsive();
        let (count, step) = self.time.looks(LOOKS);
        let chord = wing.report().mean_chord;
        let (mut way, mut here, mut most) = (0.0, 0.0_f64, None);
        for k in 0..count {
            let past = self.air_past(wing, &motion, k as f64 * step);
            let shed = sections(wing, past).filter(|s| s.suction.abs() > threshold);
            let [speed, suction] = shed.fold([0.0_f64; 2], |[speed, suction], s| {
                [speed.max(s.speed), suction.max(s.suction.abs())]
            });
            (way, here) = match speed > 0.0 {
                true => (way + speed * step / chord, here.max(suction)),
                false => (0.0, 0.0),
            };
            if way >= STAYS {
                most = Some(here.max(most.unwrap_or(0.0)));
            }
        }
        most
    }
}

/// What knows that vortex.
const POLHAMUS: &str =
    "take air.loads = \"polhamus\" without shedding from leading edges (air.shed = [\"trailing\"])";

/// Sweep of the leading edge from root to tip [rad].
fn sweep(wing: &Wing) -> f64 {
    let mesh = &wing.mesh;
    let along = mesh.nodes[mesh.node(0, mesh.cols)] - mesh.nodes[mesh.node(0, 0)];
    along.x.abs().atan2(along.y.abs())
}

/// Whether the leading edge is swept by `angle` [rad] or more.
fn is_swept(wing: &Wing, angle: f64) -> bool {
    sweep(wing) >= angle * (1.0 - ROUNDING)
}
