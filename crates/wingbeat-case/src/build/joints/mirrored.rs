//! Joints of wings on one side that the wings on the other side have in mirror image.

use wingbeat_model::{Animal, mirror_name};

use crate::build::fault::Built;
use crate::build::names::body_names;
use crate::error::Fault;
use crate::raw::{
    AdjustCase, AirModel, Case, ElementCase, JointCase, JointKind, SeriesCase, TravelCase,
};

/// All joints that a case does not give and that are there as mirror images of others, by their names.
pub(crate) fn images(case: &Case, animal: &Animal) -> Built<Vec<(String, JointCase)>> {
    let image =
        |(name, joint): (&String, &JointCase)| mirrored(case, animal, name, joint).transpose();
    case.joint.iter().filter_map(image).collect()
}

/// The joint of a right wing for a left wing that has none, and the other way round, unless that wing is not to
/// be mirrored: points and displacements are mirrored, axes of rotation too, so that equal angles are mirror
/// images. A spherical joint has no axes: the first and third component of its rotation vector change sign. Both
/// hang on one body of the middle or each on that of its side; a body of one side without its counterpart is refused.
pub(crate) fn mirrored(
    case: &Case,
    animal: &Animal,
    name: &str,
    joint: &JointCase,
) -> Built<Option<(String, JointCase)>> {
    let is_wing = |n: &str| animal.wings.iter().any(|w| w.name == n);
    let counterpart = mirror_name(&joint.child).filter(|t| is_wing(t) && is_wing(&joint.child));
    let Some(counterpart) = counterpart else {
        return Ok(None);
    };
    let alone = case.wing.get(&joint.child).and_then(|w| w.mirror) == Some(false);
    if alone || case.joint.values().any(|j| j.child == counterpart) {
        return Ok(None);
    }
    let turning = |x: [f64; 3]| wingbeat_math::mirrored_axial(x.into()).into();
    let slides = matches!(joint.kind, JointKind::Prismatic | JointKind::PointOnLine);
    let parent = match joint.parent.as_deref() {
        Some(p) => Some(counterpart_of(
            animal,
            name,
            [p, &joint.child, &counterpart],
        )?),
        None => None,
    };
    let mut image = JointCase {
        parent,
        child: counterpart.clone(),
        at_m: joint.at_m.map(point),
        at_child_m: joint.at_child_m.map(point),
        axis: joint
            .axis
            .map(|a| if slides { point(a) } else { turning(a) }),
        axes: joint.axes.map(|axes| axes.map(turning)),
        travel: joint.travel.as_ref().map(travel),
        ..joint.clone()
    };
    if joint.kind == JointKind::Spherical {
        reverse_turns(&mut image);
    }
    let name = mirror_name(name).unwrap_or_else(|| format!("{name}-{counterpart}"));
    Ok(Some((name, image)))
}

/// The body that the wing `counterpart` hangs on where `child` hangs on `parent` by the joint `name`.
fn counterpart_of(
    animal: &Animal,
    name: &str,
    [parent, child, counterpart]: [&str; 3],
) -> Built<String> {
    let Some(other) = mirror_name(parent) else {
        return Ok(parent.to_owned());
    };
    if body_names(animal).contains(&other.as_str()) {
        return Ok(other);
    }
    Err(Fault::new(
        format!("joint.{name}.parent"),
        format!(
            "wing.{counterpart}, the mirror image of wing.{child}, is given no joint and there is no {other:?}: it would \
             hang on {parent:?}, too"
        ),
        "a body without a side in its name, or one that both sides have",
        format!(
            "add segment.{other} with its joint; or wing.{child}.mirror = false for a flyer of one wing; or, if both \
             wings do hang on it, rename {parent:?}"
        ),
    ))
}

/// Refuses strokes of right and left wings that differ, and joints whose springs, dampers or stops do, where one
/// half of the air is computed.
pub(crate) fn check_halves(case: &Case) -> Built<()> {
    if !case.air.mirror || case.air.model != AirModel::VortexLattice {
        return Ok(());
    }
    if case.motion.difference != AdjustCase::default() {
        return Err(Fault::new(
            "motion.difference",
            "strokes of right and left wings differ, and one half of the air is computed (air.mirror = true)",
            "none where air.mirror = true",
            "set air.mirror = false: both sides are computed",
        ));
    }
    for (name, joint) in &case.joint {
        let counterpart = mirror_name(&joint.child);
        let of_other = |(_, j): &(&String, &JointCase)| Some(&j.child) == counterpart.as_ref();
        let Some((other, image)) = case.joint.iter().find(of_other) else {
            continue;
        };
        let pairs = joint.element.iter().zip(&image.element).enumerate();
        for (k, (a, b)) in pairs.filter(|(_, (a, b))| a.direction == b.direction) {
            let differs = numbers(a).into_iter().zip(numbers(b)).find(|(x, y)| x != y);
            if let Some(((key, x), (_, y))) = differs {
                return Err(Fault::new(
                    format!("joint.{name}.element[{k}].{key}"),
                    format!("{}, and that of joint.{other} is {}", said(x), said(y)),
                    "the same on either side where one half of the air is computed (air.mirror = true)",
                    "give one joint of the two, which brings its mirror image along, or air.mirror = false",
                ));
            }
        }
    }
    Ok(())
}

fn said(x: Option<f64>) -> String {
    x.map_or("left out".to_owned(), |x| x.to_string())
}

/// What has no sign of an element, by keys.
fn numbers(e: &ElementCase) -> [(&'static str, Option<f64>); 6] {
    let stop = e.stop.as_ref();
    [
        ("stiffness_newton_m_per_rad", e.stiffness_newton_m_per_rad),
        ("stiffness_newton_per_m", e.stiffness_newton_per_m),
        ("damping_newton_m_s_per_rad", e.damping_newton_m_s_per_rad),
        ("damping_newton_s_per_m", e.damping_newton_s_per_m),
        (
            "stop.stiffness_newton_m_per_rad",
            stop.map(|s| s.stiffness_newton_m_per_rad),
        ),
        ("stop.damping_s_per_rad", stop.map(|s| s.damping_s_per_rad)),
    ]
}

fn point(x: [f64; 3]) -> [f64; 3] {
    wingbeat_math::mirrored(x.into()).into()
}

fn travel(of: &TravelCase) -> TravelCase {
    let points = |list: &[[f64; 3]]| list.iter().copied().map(point).collect();
    TravelCase {
        frequency_hz: of.frequency_hz,
        cosine_m: points(&of.cosine_m),
        sine_m: points(&of.sine_m),
    }
}

/// The other sense for the first and third angle of a spherical joint.
fn reverse_turns(joint: &mut JointCase) {
    for starts in [&mut joint.start_deg, &mut joint.start_deg_s] {
        let angles = starts.iter_mut().flatten().step_by(2);
        angles.for_each(|angle| *angle = -*angle);
    }
    let reversed = joint.element.iter_mut().filter(|e| e.direction != 1);
    reversed.for_each(reverse);
}

/// The other sense for what acts along an angle.
fn reverse(element: &mut ElementCase) {
    element.rest_deg = element.rest_deg.map(|angle| -angle);
    if let Some(stop) = &mut element.stop {
        (stop.lower_deg, stop.upper_deg) = (-stop.upper_deg, -stop.lower_deg);
    }
    let target = element.follow.as_mut().map(|f| &mut f.angle_deg);
    let series = element.moment_newton_m.as_mut().into_iter().chain(target);
    series.for_each(negate);
}

fn negate(series: &mut SeriesCase) {
    series.mean = -series.mean;
    let amplitudes = series.cosine.iter_mut().chain(&mut series.sine);
    amplitudes.for_each(|x| *x = -*x);
}
