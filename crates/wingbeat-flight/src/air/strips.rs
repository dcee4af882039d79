//! Strips of the wings' meshes: how they lie, and how prescribed deformations move them.

use wingbeat_blade::{PlacedStrip, SectionMotion, Strip};
use wingbeat_math::DVec3;
use wingbeat_model::deformation::Stations;
use wingbeat_model::{Deformation, Wing, WingMotion};

/// One strip per spanwise panel, between the middles of its sides.
pub fn strips(wing: &Wing) -> Vec<PlacedStrip> {
    let strip = |j: usize| {
        let [leading, trailing] = edges(wing, j);
        Strip::between(leading, trailing, wing.side.sign())
    };
    (0..wing.mesh.cols).map(strip).collect()
}

/// Ends of the leading and of the trailing edge of strip `j` \[m\], wing frame.
fn edges(wing: &Wing, j: usize) -> [[DVec3; 2]; 2] {
    let mesh = &wing.mesh;
    [0, mesh.rows].map(|i| [j, j + 1].map(|j| mesh.nodes[mesh.node(i, j)]))
}

/// Strips of a wing whose shape is prescribed, or that is not flat.
#[derive(Clone, Debug)]
pub(super) struct MovingStrips {
    placed: Vec<PlacedStrip>,
    deformed: Option<Deformed>,
}

/// How a deformation moves strips in the phase of the beat.
#[derive(Clone, Debug)]
struct Deformed {
    stations: Stations,
    motion: WingMotion,
    /// Distance of the feathering axis ahead of the twist axis, strip by strip \[m\].
    ahead: Vec<f64>,
    /// The sides of the strips, one more than there are strips.
    sides: Stations,
    /// Mid chord of the sides \[m\], and its distance ahead of the twist axis \[m\].
    middles: Vec<(DVec3, f64)>,
}

impl Deformed {
    fn new(wing: &Wing, deformation: &Deformation, placed: &[PlacedStrip]) -> Self {
        let tip = wing.report().length;
        let mesh = &wing.mesh;
        let r: Vec<f64> = placed.iter().map(|s| s.strip.y.abs() / tip).collect();
        let ahead = |(j, s): (usize, &PlacedStrip)| {
            let [lead, trail] = edges(wing, j).map(|[a, b]| 0.5 * (a.x + b.x));
            deformation.axis_fraction * (lead - trail) - lead + s.axis.x
        };
        let middle = |j: usize| {
            let [lead, trail] = [0, mesh.rows].map(|i| mesh.nodes[mesh.node(i, j)]);
            let ahead = (deformation.axis_fraction - 0.5) * (lead.x - trail.x);
            (0.5 * (lead + trail), ahead)
        };
        let middles: Vec<(DVec3, f64)> = (0..=mesh.cols).map(middle).collect();
        let sides: Vec<f64> = middles.iter().map(|(x, _)| x.y.abs() / tip).collect();
        Self {
            stations: Stations::new(deformation, &r, wing.root()),
            motion: wing.motion.clone(),
            ahead: placed.iter().enumerate().map(ahead).collect(),
            sides: Stations::new(deformation, &sides, wing.root()),
            middles,
        }
    }

    /// The way between the middles of the sides of strip `k` \[m\], outwards, with its first two time derivatives.
    fn across(&self, k: usize, phase: [f64; 3]) -> [DVec3; 3] {
        let [inner, outer] = [k, k + 1].map(|j| {
            let (rest, ahead) = self.middles[j];
            let [d, v, a] = (self.sides.at(j, phase)).displacement(ahead, rest.z, 0.0);
            [rest + d, v, a]
        });
        [0, 1, 2].map(|i| outer[i] - inner[i])
    }
}

impl MovingStrips {
    /// Those of `wing`; none of a flat one whose shape is not prescribed.
    pub fn new(wing: &Wing) -> Option<Self> {
        let placed = strips(wing);
        let deformation = wing.deformation.as_ref();
        let moves = deformation.is_some() || !placed.iter().all(PlacedStrip::is_flat);
        moves.then(|| Self {
            deformed: deformation.map(|d| Deformed::new(wing, d, &placed)),
            placed,
        })
    }

    /// Whether their shape is prescribed.
    pub fn is_deformed(&self) -> bool {
        self.deformed.is_some()
    }

    /// All strips at time `t` \[s\].
    pub fn sections(&self, t: f64) -> impl Iterator<Item = SectionMotion> {
        let phase = (self.deformed.as_ref()).map_or([0.0; 3], |d| d.motion.phase_at(t));
        (0..self.placed.len()).map(move |k| self.section(k, phase))
    }

    /// Strip `k` in the phase `[x, x', x'']` of the beat.
    fn section(&self, k: usize, phase: [f64; 3]) -> SectionMotion {
        let placed = &self.placed[k];
        let Some(deformed) = &self.deformed else {
            return SectionMotion::fixed(placed);
        };
        let s = deformed.stations.at(k, phase);
        let [d, v, a] = s.displacement(deformed.ahead[k], placed.axis.z, 0.0);
        let axis = [placed.axis + d, v, a];
        SectionMotion::turned(placed, axis, s.twist, deformed.across(k, phase))
    }
}
