//! `air.buoyancy`: the weight of the fluid that closed parts displace.

use wingbeat_flight::{AirModel, AppliedLoad};
use wingbeat_math::DVec3;
use wingbeat_model::Animal;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::Case;

const KEY: &str = "air.buoyancy";

/// Buoyancy [Archimedes] of the central body and of each segment whose parts enclose a volume V: the force `-rho V g`
/// at the centre of the volume, in inertial axes, as the load that it is.
pub(crate) fn loads(case: &Case, air: &AirModel, animal: &Animal) -> Built<Vec<AppliedLoad>> {
    if !case.air.buoyancy {
        return Ok(vec![]);
    }
    let Some(density) = air.density() else {
        return Err(lacking(
            "in air of no density",
            "beside air that has a density",
            "set air.model = \"vortex_lattice\" or \"blade_element\"",
        ));
    };
    let gravity = DVec3::from(case.gravity_m_s2);
    if gravity == DVec3::ZERO {
        return Err(lacking(
            "without gravity",
            "with gravity_m_s2 that is not 0",
            "give gravity_m_s2",
        ));
    }
    let solids = animal.solids();
    if solids.is_empty() {
        return Err(lacking(
            "where neither the body nor a segment has a closed part, which displaces fluid",
            "beside a closed part of the body or of a segment",
            "give the body its shape ([body.part.NAME], [segment.NAME.part.NAME])",
        ));
    }
    let load =
        |(body, volume, centre)| AppliedLoad::constant(body, centre, -density * volume * gravity);
    Ok(solids.into_iter().map(load).collect())
}

/// Buoyancy that has no effect, what it needs, and how that is given.
fn lacking(why: &str, needs: &str, give: &str) -> Fault {
    let remedy = format!("{give}, or remove this");
    Fault::new(KEY, format!("this has no effect {why}"), needs, remedy)
}
