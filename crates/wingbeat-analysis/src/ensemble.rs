//! Members of an ensemble: the same flight many times over, from starts that differ by next to nothing.

use std::f64::consts::PI;

use wingbeat_flight::{Feedback, FlightSetup};
use wingbeat_math::DVec3;

/// Velocity by which the streams of members differ, over the speed of the wings.
const DIFFERENCE: f64 = 1e-6;

/// Whether the senses of its controller are noisy, and the members differ by that noise: not where no command acts.
pub fn is_noisy(setup: &FlightSetup) -> bool {
    let is_held = setup.mode.is_held_throughout(setup.time.steps);
    let acts = !is_held && setup.commands_too_late().is_none();
    acts && redrawn(setup, 1).is_some()
}

/// The feedback with the noise of member `k`; none without noise.
fn redrawn(setup: &FlightSetup, k: usize) -> Option<Feedback> {
    let feedback = setup.feedback.as_ref()?;
    let controller = feedback.controller.redrawn(k as u64)?;
    Some(Feedback {
        controller,
        ..feedback.clone()
    })
}

/// Member `k` of `count`: the first as it is, in the others the air moves by a millionth of the wings' speed
/// (length over period, or that of the stream), each in a direction of its own, all along planes that no air
/// goes through: a ground, the plane of symmetry where half is computed; noise of the senses is another. None
/// where the air has no stream.
pub fn member(setup: &FlightSetup, k: usize, count: usize) -> Option<FlightSetup> {
    let mut member = setup.clone();
    let length = member.animal.wing_length();
    let flapping = member.time.period.map_or(0.0, |p| length / p);
    let normals = normals(setup);
    if let Some(feedback) = (k > 0).then(|| redrawn(setup, k)).flatten() {
        member.feedback = Some(feedback);
    }
    let stream = member.air.stream_mut()?;
    if k > 0 {
        let along = along(direction(k, count), &normals);
        *stream += DIFFERENCE * flapping.max(stream.length()) * along;
    }
    Some(member)
}

/// Normals of the planes that no air goes through, at right angles or parallel, N components.
fn normals(setup: &FlightSetup) -> Vec<DVec3> {
    let Some(options) = setup.air.lattice() else {
        return vec![];
    };
    let images = options.lattice.images.iter().map(|p| p.normal);
    let across = options.mirror.then(|| setup.root_at_start().r.y_axis);
    images.chain(across).collect()
}

/// The direction of what `of` has along all planes with these `normals`; of an axis instead, where that is
/// next to nothing.
fn along(of: DVec3, normals: &[DVec3]) -> DVec3 {
    let rest = |d: DVec3| normals.iter().fold(d, |d, n| d.reject_from(*n));
    let mut directions = [of, DVec3::X, DVec3::Y, DVec3::Z].into_iter();
    let found = directions.find(|d| rest(*d).length() > 1e-3);
    // Twice: the rounding of the first time is rejected, too.
    found.map_or(DVec3::ZERO, |d| rest(rest(d)).normalize_or_zero())
}

/// Direction `k` of `count` that are spread evenly over the sphere, on a spiral by the golden angle.
fn direction(k: usize, count: usize) -> DVec3 {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - 2.0 * (k as f64 + 0.5) / count as f64;
    let (sine, cosine) = (golden * k as f64).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cosine, r * sine, z)
}
