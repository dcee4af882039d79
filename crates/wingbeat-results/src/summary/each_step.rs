//! What a summary needs to know of every step, whichever of them a thinned history holds: balances, impulses that
//! part, passes of the corrector, forces that turn back, wings that pass through each other or face surfaces
//! across narrow gaps, departures under feedback, where the last part of a flight without wingbeats begins.

use serde::{Deserialize, Serialize};
use wingbeat_flight::{FlightSetup, Record, StruckStops, TurnedOver};
use wingbeat_math::{DVec3, EulerSequence};
use wingbeat_model::{FlownCounts, FlownCrossings, NarrowGaps, SeenGaps, WingMotion};

use super::alternation::Alternation;
use super::bent::{self, Bent};
use super::driven::DrivenWork;
use super::extent::Extent;
use super::held::Departures;
use super::impulse::Parting;
use super::in_play::InPlay;
use super::last_part::Bounds;
use super::momentum_balance::MomentumBalance;

/// Gathered from all steps of a flight, one after the other.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct EachStep {
    pub(super) steps: usize,
    /// Energies and their residual.
    pub(super) in_play: InPlay,
    /// Momenta and their residual.
    pub(super) momentum: MomentumBalance,
    /// Whether joints leave something free.
    pub(super) has_free_joints: bool,
    pub(super) driven: DrivenWork,
    /// Chords of the wings.
    pub(super) turned: TurnedOver,
    /// Stops of joints.
    pub(super) stops: StruckStops,
    pub(super) violation_position: Extent,
    pub(super) violation_orientation: Extent,
    pub(super) euler_regularity: Extent,
    pub(super) corrector_passes: Extent,
    pub(super) net_flux_residual: Extent,
    /// Impulses of vorticity and force.
    pub(super) parting: Parting,
    /// Sum over all steps.
    pub(super) passes_sum: usize,
    pub(super) alternation: Alternation,
    /// Elastic wings.
    pub(super) bent: Vec<Bent>,
    /// Under feedback.
    pub(super) departures: Option<Departures>,
    /// Of wings whose motion is not known beforehand.
    #[serde(skip)]
    pub(super) crossings: Option<FlownCrossings>,
    #[serde(skip)]
    pub(super) gaps: Option<NarrowGaps>,
    /// What these had counted when this was saved.
    counts: (FlownCounts, SeenGaps),
    /// Where the last part of a flight without wingbeats begins.
    pub(super) bounds: Bounds,
}

impl EachStep {
    /// Of a flight of `setup`, before its start.
    pub fn new(setup: &FlightSetup) -> Self {
        Self {
            crossings: setup.flown_crossings(),
            gaps: setup.flown_gaps(),
            departures: Departures::of(setup),
            ..Self::default()
        }
    }

    /// Everything that was gathered, as bytes.
    pub fn saved(&self) -> Vec<u8> {
        let counts = self.crossings.as_ref().map(|c| c.counts().clone());
        let seen = self.gaps.as_ref().map(|g| g.seen().clone());
        let whole = Self {
            counts: (counts.unwrap_or_default(), seen.unwrap_or_default()),
            ..self.clone()
        };
        postcard::to_allocvec(&whole).expect("numbers are plain data")
    }

    /// Goes on from [`Self::saved`]; none from other bytes.
    pub fn restored(setup: &FlightSetup, bytes: &[u8]) -> Option<Self> {
        let mut s: Self = postcard::from_bytes(bytes).ok()?;
        s.crossings = setup.flown_crossings();
        s.gaps = setup.flown_gaps();
        let (counts, seen) = std::mem::take(&mut s.counts);
        if let Some(crossings) = &mut s.crossings {
            crossings.count_on(counts);
        }
        if let Some(gaps) = &mut s.gaps {
            gaps.go_on(seen);
        }
        Some(s)
    }

    /// Takes the next step.
    pub fn take(&mut self, r: &Record, setup: &FlightSetup) {
        self.steps += 1;
        self.motion(r, setup);
        self.in_play.take(r, setup);
        self.momentum.take(r, setup);
        self.has_free_joints |= !r.joints.is_empty();
        self.driven.take(r);
        if self.has_free_joints {
            self.turned.take(r, setup);
            self.stops.take(r, setup);
        }
        self.violation_position.take(r.violation_position);
        self.violation_orientation.take(r.violation_orientation);
        self.euler_regularity.take(r.euler_regularity);
        self.corrector_passes.take(r.corrector_passes as f64);
        self.net_flux_residual.take(r.net_flux_residual);
        self.parting.take(r, setup);
        self.passes_sum += r.corrector_passes;
        self.bounds.take(r, setup);
    }

    /// Forces and places of the wings, and the way of the flyer.
    fn motion(&mut self, r: &Record, setup: &FlightSetup) {
        let wings = setup.animal.wings.len();
        self.alternation.take(r, wings);
        Bent::take_all(&mut self.bent, r, setup);
        if let Some(departures) = &mut self.departures {
            departures.take(r, setup);
        }
        let bent = || {
            let elastic = setup.animal.wings.iter().filter(|w| w.structure.is_some());
            elastic.zip(&r.elastic).map(|(w, e)| bent::bending(w, e))
        };
        let poses = || {
            let bodies = r.coordinates.chunks_exact(6).enumerate();
            bodies.map(|(body, q)| {
                let sequence = match (1..=wings).contains(&body) {
                    true => EulerSequence::WING_132,
                    false => EulerSequence::BODY_231,
                };
                let attitude = sequence.rotation(DVec3::from_slice(&q[3..]));
                (DVec3::from_slice(q), attitude)
            })
        };
        let phase = |motion: &WingMotion| motion.phase_at(r.time)[0];
        if let Some(crossings) = &mut self.crossings {
            let of_wings: Vec<_> = poses().skip(1).take(wings).collect();
            crossings.see(&of_wings, bent(), phase);
        }
        if let Some(gaps) = &mut self.gaps {
            gaps.see(&poses().map(Some).collect::<Vec<_>>(), bent(), phase);
        }
    }
}
