//! Which elastic wings are mirror images of each other.
//!
//! What is not deformed looks the same however it hangs on the body: hinges, joints and the stream count as well.

use wingbeat_dynamics::{Joint, JointType};
use wingbeat_flight::setup::carriers::chain;
use wingbeat_flight::{FlightSetup, FlightState};
use wingbeat_math::{
    DMat3, DVec3, EulerSequence, RotationLaw, mirrored, mirrored_axial, rotation_vector,
};
use wingbeat_structure::NODE;

use super::disturbance::SIGNS;
use super::steady::{ElasticRig, SAME, SteadyWing};

/// Of each elastic wing in the steady state the wing before it that it is the mirror image of, if there is one: as it
/// hangs on the body and stands in the stream, deformed and damped as it is and on joints with the same springs, dampers
/// and stops.
pub(crate) fn images(
    rig: &ElasticRig,
    state: &FlightState,
    steady: &[SteadyWing],
) -> Vec<Option<usize>> {
    let shapes = |k: usize| {
        let structure = rig.wing(k).structure();
        let (at, rest) = (&state.wings[k].structure.configuration, structure.rest());
        let size = structure.size();
        let node = move |n: usize| {
            let turn = rotation_vector(at.rotation[n] * rest.rotation[n].inverse());
            [(at.position[n] / size).to_array(), turn.to_array()].concat()
        };
        (0..at.len()).flat_map(node)
    };
    let side = |k: usize| rig.setup.animal.wings[rig.wing(k).wing()].side;
    let damping = |k: usize| rig.wing(k).structure().damping();
    let is_even = streams_in_symmetry(&rig.setup);
    let is_image = |k: usize, other: usize| {
        let nodes = |k: usize| state.wings[k].structure.configuration.len();
        let sizes = [k, other].map(|k| rig.wing(k).structure().size());
        let wings = [k, other].map(|k| rig.wing(k).wing());
        let mut numbers = shapes(k).zip(shapes(other)).enumerate();
        let mut frequencies = steady[k].vacuum.iter().zip(&steady[other].vacuum);
        side(k) != side(other)
            && damping(k) == damping(other)
            && nodes(k) == nodes(other)
            && (sizes[0] - sizes[1]).abs() < SAME * sizes[0]
            && is_even
            && hang_as_images(&rig.setup, wings, SAME * sizes[0])
            && numbers.all(|(n, (x, y))| (x - SIGNS[n % NODE] * y).abs() < SAME)
            && frequencies.all(|(v, w)| (v - w).abs() < SAME * v)
    };
    let mut found: Vec<Option<usize>> = vec![];
    for k in 0..rig.count() {
        let own = (0..k).find(|&other| found[other].is_none() && is_image(k, other));
        found.push(own);
    }
    found
}

/// Whether the stream has no part across the plane of symmetry of the body.
fn streams_in_symmetry(setup: &FlightSetup) -> bool {
    let stream = setup.air.stream().unwrap_or(DVec3::ZERO);
    let root = EulerSequence::BODY_231.rotation(setup.angles_at_release());
    stream.dot(root.y_axis).abs() <= SAME * stream.length()
}

/// Whether meshes, hinges and joints of two wings are mirror images of each other, places within `near` \[m\].
fn hang_as_images(setup: &FlightSetup, wings: [usize; 2], near: f64) -> bool {
    let are_near = |x: DVec3, y: DVec3| mirrored(x).distance(y) < near;
    let [a, b] = wings.map(|w| &setup.animal.wings[w]);
    if !a.mesh.is_image_of(&b.mesh, near) {
        return false;
    }
    let [links, others] = wings.map(|w| chain(&setup.joints, w + 1));
    if links.is_empty() && others.is_empty() {
        let turned = [a, b].map(|w| w.motion.impulsive().at(0.0).c);
        return are_near(a.hinge_b, b.hinge_b) && are_turned_as_images(turned);
    }
    let are_images = |(j, k): (&&Joint, &&Joint)| {
        let (own, other) = (&j.model, &k.model);
        let [way, there] = [own, other].map(|m| {
            let travel = m.travel.as_ref();
            travel.map_or(DVec3::ZERO, |law| law.at(0.0)[0])
        });
        own.elements == other.elements
            && are_near(j.anchor_parent + way, k.anchor_parent + there)
            && are_near(j.anchor_child, k.anchor_child)
            && allow_images(&own.kind, &other.kind)
            && are_turned_as_images([j, k].map(|joint| prescribed(setup, joint)))
    };
    links.len() == others.len() && links.iter().zip(&others).all(are_images)
}

/// What a joint prescribes of the attitude of its child at the start, that of a wing by its angles.
fn prescribed(setup: &FlightSetup, joint: &Joint) -> DMat3 {
    let wing = setup.animal.wings.get(joint.child.wrapping_sub(1));
    match (&joint.law, wing) {
        (None, Some(wing)) => wing.motion.impulsive().at(0.0).c,
        _ => joint.rotation(0.0).c,
    }
}

/// Whether two rotations are mirror images of each other.
fn are_turned_as_images([a, b]: [DMat3; 2]) -> bool {
    let apart = |x: DVec3| mirrored(a * mirrored(x)).distance(b * x);
    DVec3::AXES.into_iter().all(|x| apart(x) < SAME)
}

/// Whether two joints leave motions free that are mirror images of each other where their coordinates are the same.
fn allow_images(a: &JointType, b: &JointType) -> bool {
    let slides = |j: &JointType| {
        matches!(
            j,
            JointType::Prismatic { .. } | JointType::PointOnLine { .. }
        )
    };
    let image = |x: DVec3| {
        if slides(a) {
            mirrored(x)
        } else {
            mirrored_axial(x)
        }
    };
    let mut axes = a.axes().iter().zip(b.axes());
    std::mem::discriminant(a) == std::mem::discriminant(b)
        && axes.all(|(x, y)| image(*x).distance(*y) < SAME)
}
