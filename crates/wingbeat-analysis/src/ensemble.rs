//! Members of an ensemble: the same flight many times over, from starts that differ by next to nothing.

use std::f64::consts::PI;

use wingbeat_flight::{Feedback, FlightSetup};
use wingbeat_math::DVec3;

/// Velocity by which the streams of members differ, over the speed of the wings.
const DIFFERENCE: f64 = 1e-6;

/// Whether the senses of its controller are noisy, and the members differ by that noise.
pub fn is_noisy(setup: &FlightSetup) -> bool {
    redrawn(setup, 1).is_some()
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
/// (length over period, or that of the stream), each in a direction of its own, all in the plane of symmetry
/// where half is computed; noise of the senses is another. None where the air has no stream.
pub fn member(setup: &FlightSetup, k: usize, count: usize) -> Option<FlightSetup> {
    let mut member = setup.clone();
    let length = member.animal.wing_length();
    let flapping = member.time.period.map_or(0.0, |p| length / p);
    let is_mirrored = member.air.is_mirrored();
    if let Some(feedback) = (k > 0).then(|| redrawn(setup, k)).flatten() {
        member.feedback = Some(feedback);
    }
    let stream = member.air.stream_mut()?;
    if k > 0 {
        let mut along = direction(k, count);
        if is_mirrored {
            along = DVec3::new(along.x, 0.0, along.z)
                .try_normalize()
                .unwrap_or(DVec3::X);
        }
        *stream += DIFFERENCE * flapping.max(stream.length()) * along;
    }
    Some(member)
}

/// Direction `k` of `count` that are spread evenly over the sphere, on a spiral by the golden angle.
fn direction(k: usize, count: usize) -> DVec3 {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - 2.0 * (k as f64 + 0.5) / count as f64;
    let (sine, cosine) = (golden * k as f64).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cosine, r * sine, z)
}
