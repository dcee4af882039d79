//! Size of the whole case: what many small parts add up to is refused before anything is built.

use super::Built;
use super::body::resolution;
use super::wing::twin_name;
use crate::error::Fault;
use crate::raw::{AirModel, Case, PartCase, WingCase};

/// Panels of all surfaces at most.
const MOST_PANELS: usize = 1_000_000;
/// Panels of a vortex lattice at most: every panel acts on every other, which takes 8 bytes for
/// each pair, 3.2 GB here.
const MOST_IN_LATTICE: usize = 20_000;
/// Bodies that move at most: their equations are solved as one dense system.
const MOST_BODIES: usize = 200;

/// The limits of the whole case.
pub(super) fn check(case: &Case) -> Built<()> {
    let wings: usize = case
        .wing
        .iter()
        .map(|(name, wing)| panels_of_wing(case, name, wing))
        .sum();
    let parts: usize = case.body.part.values().map(panels_of_part).sum();
    let lattice = case.air.model == AirModel::VortexLattice;
    let seen = wings + if case.air.body { parts } else { 0 };
    if lattice && seen > MOST_IN_LATTICE {
        return Err(Fault::new(
            "air.model",
            format!(
                "{seen} panels in one vortex lattice: every panel acts on every other, which takes {:.1} GB",
                8e-9 * (seen as f64).powi(2)
            ),
            format!(
                "at most {MOST_IN_LATTICE} panels of all wings and, with air.body, of the body"
            ),
            "use coarser meshes, leave the body out with air.body = false, or take air.model = \"blade_element\"",
        ));
    }
    if wings + parts > MOST_PANELS {
        return Err(Fault::new(
            if parts > wings { "body.part" } else { "wing" },
            format!("{} panels in all", wings + parts),
            format!("at most {MOST_PANELS} panels of wings and body"),
            "use coarser meshes or fewer parts",
        ));
    }
    let bodies = 1 + 2 * case.wing.len() + case.segment.len();
    if bodies > MOST_BODIES {
        let segments = case.segment.len() > 2 * case.wing.len();
        return Err(Fault::new(
            if segments { "segment" } else { "wing" },
            format!("some {bodies} bodies that move"),
            format!("at most {MOST_BODIES}: the body, its wings and its segments"),
            "weld bodies that do not move against each other into one",
        ));
    }
    Ok(())
}

fn panels_of_wing(case: &Case, name: &str, wing: &WingCase) -> usize {
    let twin = twin_name(name);
    let twin = twin.as_ref().and_then(|n| case.wing.get(n));
    let mesh = wing
        .mesh
        .clone()
        .or_else(|| twin.and_then(|w| w.mesh.clone()));
    let mesh = mesh.unwrap_or_default();
    let mirrored = twin.is_none() && wing.mirror.unwrap_or(true);
    let images = if mirrored { 2 } else { 1 };
    images
        * mesh
            .chordwise
            .saturating_mul(mesh.spanwise)
            .min(MOST_PANELS)
}

fn panels_of_part(part: &PartCase) -> usize {
    match &part.quads {
        Some(quads) => quads.len(),
        None => {
            let [stations, meridians] = resolution(part);
            stations.saturating_mul(meridians).min(MOST_PANELS)
        }
    }
}
