//! `[[joint.NAME.element]]`: springs, dampers, stops, actuators.

use wingbeat_dynamics::{Element, ElementLaw};
use wingbeat_math::DriftingFourier;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::raw::{ElementCase, JointCase, JointKind, SeriesCase};

/// All laws of a joint.
pub(crate) fn build_all(path: &str, joint: &JointCase, frequency: f64) -> Built<Vec<Element>> {
    let mut out = vec![];
    for (k, case) in joint.element.iter().enumerate() {
        let path = format!("{path}.element[{k}]");
        let directions = match joint.kind {
            JointKind::Weld | JointKind::PointOnLine => 0,
            JointKind::Revolute | JointKind::Prismatic => 1,
            JointKind::Universal => 2,
            JointKind::Spherical => 3,
        };
        if case.direction >= directions {
            return Err(Fault::new(
                format!("{path}.direction"),
                format!("this kind of joint has {directions} free directions"),
                "numbers from 0, below the number of free directions",
                "set joint.NAME.kind, or correct the direction",
            ));
        }
        let slides = joint.kind == JointKind::Prismatic;
        check_kind(&path, case, slides)?;
        let laws = laws(&path, case, frequency)?;
        if laws.is_empty() {
            let allowed = "stiffness_*, damping_*, stop, moment_newton_m, force_newton, follow";
            return Err(Fault::new(
                path,
                "this element does nothing",
                allowed,
                "add one",
            ));
        }
        let direction = case.direction;
        out.extend(laws.into_iter().map(|law| Element { direction, law }));
    }
    Ok(out)
}

/// Rotations have moments, displacements have forces.
fn check_kind(path: &str, c: &ElementCase, slides: bool) -> Built<()> {
    let turning = [
        (
            "stiffness_newton_m_per_rad",
            c.stiffness_newton_m_per_rad.is_some(),
        ),
        ("rest_deg", c.rest_deg.is_some()),
        (
            "damping_newton_m_s_per_rad",
            c.damping_newton_m_s_per_rad.is_some(),
        ),
        ("stop", c.stop.is_some()),
        ("moment_newton_m", c.moment_newton_m.is_some()),
        ("follow", c.follow.is_some()),
    ];
    let sliding = [
        ("stiffness_newton_per_m", c.stiffness_newton_per_m.is_some()),
        ("rest_m", c.rest_m.is_some()),
        ("damping_newton_s_per_m", c.damping_newton_s_per_m.is_some()),
        ("force_newton", c.force_newton.is_some()),
    ];
    let wrong = if slides {
        turning.to_vec()
    } else {
        sliding.to_vec()
    };
    let Some((key, _)) = wrong.into_iter().find(|(_, given)| *given) else {
        return Ok(());
    };
    let (what, allowed) = if slides {
        (
            "a displacement takes forces",
            "stiffness_newton_per_m, damping_newton_s_per_m, force_newton",
        )
    } else {
        (
            "a rotation takes moments",
            "stiffness_newton_m_per_rad, damping_newton_m_s_per_rad, stop, moment_newton_m, follow",
        )
    };
    Err(Fault::new(
        format!("{path}.{key}"),
        what,
        allowed,
        "convert the value",
    ))
}

fn laws(path: &str, c: &ElementCase, frequency: f64) -> Built<Vec<ElementLaw>> {
    let mut laws = vec![];
    let springs = [
        (
            c.stiffness_newton_m_per_rad,
            c.rest_deg.map(f64::to_radians),
        ),
        (c.stiffness_newton_per_m, c.rest_m),
    ];
    for (stiffness, rest) in springs {
        let rest = rest.unwrap_or(0.0);
        laws.extend(stiffness.map(|stiffness| ElementLaw::Spring { stiffness, rest }));
    }
    for damping in [c.damping_newton_m_s_per_rad, c.damping_newton_s_per_m] {
        laws.extend(damping.map(|coefficient| ElementLaw::Damper { coefficient }));
    }
    if let Some(s) = &c.stop {
        if s.lower_deg >= s.upper_deg {
            return Err(Fault::new(
                format!("{path}.stop.lower_deg"),
                "the lower end is not below the upper end",
                "lower_deg < upper_deg",
                "exchange them",
            ));
        }
        laws.push(ElementLaw::Stop {
            lower: s.lower_deg.to_radians(),
            upper: s.upper_deg.to_radians(),
            stiffness: s.stiffness_newton_m_per_rad,
            damping: s.damping_s_per_rad,
        });
    }
    for effort in c.moment_newton_m.iter().chain(&c.force_newton) {
        laws.push(ElementLaw::Effort(series(effort, frequency, 1.0)));
    }
    if let Some(f) = &c.follow {
        laws.push(ElementLaw::Follow {
            target: series(&f.angle_deg, frequency, 1f64.to_radians()),
            stiffness: f.stiffness_newton_m_per_rad,
            damping: f.damping_newton_m_s_per_rad,
        });
    }
    Ok(laws)
}

fn series(case: &SeriesCase, frequency: f64, unit: f64) -> DriftingFourier {
    let scaled = |list: &Vec<f64>| list.iter().map(|x| x * unit).collect();
    DriftingFourier::periodic(
        case.mean * unit,
        case.frequency_hz.unwrap_or(frequency),
        [&case.cosine, &case.sine].map(scaled),
    )
}
