//! Cosine spacing of panels where the rings of the lattice are not made for it.

use wingbeat_model::Spacing;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::{AirModel, Case, SchemeCase};

/// Part of a panel by which rings stay inside where control points follow cosine spacing \[1\].
const QUARTER: f64 = 0.25;

/// Refuses cosine spacing on rings that lie on the edges of the panels, or elsewhere than at their quarters: the
/// middles of unequal rings are no control points. With the rings of the benchmark a flat plate in plane flow on 8,
/// 16 and 32 panels of cosine spacing has 0.90, 0.85 and 0.81 of its lift; columns of cosine spacing have 2 to 5 % too
/// much on 24 to 8 a side.
pub(crate) fn check(case: &Case) -> Built<()> {
    let inset = case.air.ring_inset.value();
    if !matches!(case.air.model, AirModel::VortexLattice) || inset == QUARTER {
        return Ok(());
    }
    for (name, mesh) in case
        .wing
        .iter()
        .filter_map(|(n, w)| Some((n, w.mesh.as_ref()?)))
    {
        let both = [
            ("chordwise", mesh.chordwise_spacing, mesh.chordwise),
            ("spanwise", mesh.spanwise_spacing, mesh.spanwise),
        ];
        // Two panels of cosine spacing are alike.
        let Some((way, ..)) = both
            .iter()
            .find(|(_, s, n)| *s == Spacing::Cosine && *n > 2)
        else {
            continue;
        };
        return Err(Fault::new(
            format!("wing.{name}.mesh.{way}_spacing"),
            format!(
                "\"cosine\" with air.ring_inset = {inset}{}: control points in the middles of unequal rings make an error of the \
                 lift that more panels do not remove",
                match case.air.scheme {
                    SchemeCase::Benchmark => " (air.scheme = \"benchmark\")",
                    SchemeCase::Accurate => "",
                }
            ),
            "\"uniform\"; \"cosine\" with rings a quarter of a panel aft and inside, air.ring_inset = 0.25",
            "take \"uniform\", or air.scheme = \"accurate\" without air.ring_inset",
        ));
    }
    Ok(())
}
