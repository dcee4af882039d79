//! Size of the case: a surface of too many panels, and what many small parts add up to, are refused
//! before anything is built.

use wingbeat_model::mirror_name;

use crate::build::animal::body::resolution;
use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::{AirModel, Case, PartCase, PlanformCase, WingCase, WingMeshCase};

/// Panels of a wing or of a part of the body at most.
const MAX_ON_A_SURFACE: usize = 10_000;
/// Panels of all surfaces at most.
const MAX_PANELS: usize = 1_000_000;
/// Panels of a vortex lattice at most: every panel acts on every other, which takes 8 bytes for
/// each pair, 3.2 GB here.
const MAX_IN_LATTICE: usize = 20_000;
/// Bodies that move at most: their equations are solved as one dense system.
const MAX_BODIES: usize = 200;

/// The limits of the whole case.
pub(crate) fn check(case: &Case) -> Built<()> {
    let wings = case.wing.iter();
    let wings = wings.map(|(name, wing)| panels_of_wing(case, name, wing));
    let wings = wings.sum::<Built<usize>>()?;
    let parts = case.body.part.iter();
    let parts = parts.map(|(name, part)| panels_of_part(name, part));
    let parts = parts.sum::<Built<usize>>()?;
    let lattice = case.air.model == AirModel::VortexLattice;
    let seen = wings + if case.air.body { parts } else { 0 };
    if lattice && seen > MAX_IN_LATTICE {
        return Err(Fault::new(
            "air.model",
            format!(
                "{seen} panels in one vortex lattice: every panel acts on every other, which takes {:.1} GB",
                8e-9 * (seen as f64).powi(2)
            ),
            format!("at most {MAX_IN_LATTICE} panels of all wings and, with air.body, of the body"),
            "use coarser meshes, leave the body out with air.body = false, or take air.model = \"blade_element\"",
        ));
    }
    if wings + parts > MAX_PANELS {
        return Err(Fault::new(
            if parts > wings { "body.part" } else { "wing" },
            format!("{} panels in all", wings + parts),
            format!("at most {MAX_PANELS} panels of wings and body"),
            "use coarser meshes or fewer parts",
        ));
    }
    let bodies = 1 + 2 * case.wing.len() + case.segment.len();
    if bodies > MAX_BODIES {
        let segments = case.segment.len() > 2 * case.wing.len();
        return Err(Fault::new(
            if segments { "segment" } else { "wing" },
            format!("some {bodies} bodies that move"),
            format!("at most {MAX_BODIES}: the body, its wings and its segments"),
            "weld bodies that do not move against each other into one",
        ));
    }
    Ok(())
}

fn panels_of_wing(case: &Case, name: &str, wing: &WingCase) -> Built<usize> {
    let counterpart = mirror_name(name);
    let counterpart = counterpart
        .as_ref()
        .and_then(|n| Some((n, case.wing.get(n)?)));
    let own = wing.mesh.as_ref().map(|mesh| (name, mesh));
    let of_counterpart =
        || counterpart.and_then(|(name, wing)| Some((name.as_str(), wing.mesh.as_ref()?)));
    let (named, mesh) = match own.or_else(of_counterpart) {
        Some((named, mesh)) => (named, mesh.clone()),
        None => (name, WingMeshCase::default()),
    };
    let keys = ["chordwise", "spanwise"].map(|key| format!("wing.{named}.mesh.{key}"));
    let given = [Some(wing), counterpart.map(|(_, wing)| wing)];
    let given = given
        .into_iter()
        .flatten()
        .find_map(|w| w.planform.as_ref());
    let (keys, mesh) = match given {
        Some(PlanformCase::NodesM(rows)) => {
            let count = [rows.len(), rows.first().map_or(0, Vec::len)];
            let key = format!("wing.{name}.planform.nodes_m");
            ([key.clone(), key], count.map(|n| n.saturating_sub(1)))
        }
        _ => (keys, [mesh.chordwise, mesh.spanwise]),
    };
    let mirrored = counterpart.is_none() && wing.mirror.unwrap_or(true);
    let images = if mirrored { 2 } else { 1 };
    Ok(images * panels(keys, mesh)?)
}

fn panels_of_part(name: &str, part: &PartCase) -> Built<usize> {
    if let Some(quads) = &part.quads {
        return Ok(quads.len());
    }
    let keys = ["stations", "meridians"].map(|key| format!("body.part.{name}.{key}"));
    panels(keys, resolution(part))
}

/// Panels of a surface, rows times columns at `keys`.
fn panels(keys: [String; 2], [rows, cols]: [usize; 2]) -> Built<usize> {
    let count = rows.checked_mul(cols).filter(|n| *n <= MAX_ON_A_SURFACE);
    count.ok_or_else(|| {
        let [of_rows, of_cols] = keys;
        Fault::new(
            if cols > rows { of_cols } else { of_rows },
            "this makes too many panels: every panel acts on every other, memory grows with their square",
            format!("at most {MAX_ON_A_SURFACE} panels on a surface"),
            "a few hundred panels resolve a wing",
        )
    })
}
