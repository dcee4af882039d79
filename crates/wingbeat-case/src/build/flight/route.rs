//! `[[control.waypoint]]`.

use wingbeat_analysis::control::{Route, Waypoint};
use wingbeat_math::to_digits;

use crate::build::fault::Built;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{Case, ControlCase, ControllerCase};

/// Part of a wingbeat by which times may be rounded.
const ROUNDING: f64 = 1e-6;

/// The route of the case.
pub(crate) fn build(case: &Case, control: &ControlCase) -> Built<Route> {
    let moves = [
        ("control.forward_m_s", control.forward_m_s),
        ("control.climb_m_s", control.climb_m_s),
    ];
    let has_route = !control.waypoint.is_empty();
    if let Some((key, _)) = moves.iter().find(|(_, v)| has_route && *v != 0.0) {
        return Err(Fault::new(
            *key,
            "waypoints lead along a way of their own, from hover to hover",
            "0 with [[control.waypoint]]",
            "set it to 0, or remove the waypoints",
        ));
    }
    let beat = 1.0 / case.motion.frequency_hz.value();
    let mut last = Waypoint::default();
    let mut route = vec![];
    for (k, w) in control.waypoint.iter().enumerate() {
        let next = Waypoint {
            time: w.time_s,
            position: w.position_m.map_or(last.position, vector),
            heading: w.heading_deg.map_or(last.heading, f64::to_radians),
        };
        check(k, control, &last, &next, beat)?;
        route.push(next);
        last = next;
    }
    Ok(Route(route))
}

/// What a way to the waypoint number `k` must be like.
fn check(k: usize, control: &ControlCase, from: &Waypoint, to: &Waypoint, beat: f64) -> Built<()> {
    if to.time - from.time < (1.0 - ROUNDING) * beat {
        return Err(Fault::new(
            format!("control.waypoint[{k}].time_s"),
            "waypoints come one after the other, and a way takes a wingbeat or more",
            format!("a number >= {}", to_digits(from.time + beat, 12)),
            "put them in the order of their times; a way of one wingbeat is a step",
        ));
    }
    let sideways = to.position.x != 0.0 || to.position.y != 0.0;
    if control.controller == ControllerCase::Stabiliser && sideways {
        return Err(Fault::new(
            format!("control.waypoint[{k}].position_m"),
            "the stabiliser holds the altitude and no other place",
            "[0, 0, z] with control.controller = \"stabiliser\"",
            "set the first two to 0, or take control.controller = \"regulator\"",
        ));
    }
    Ok(())
}
