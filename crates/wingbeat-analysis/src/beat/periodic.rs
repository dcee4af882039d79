//! Whether the joints of a system are back after a wingbeat.

use wingbeat_dynamics::System;
use wingbeat_math::DVec3;

use crate::AnalysisError;

/// An error if a joint of the system is not back after a wingbeat of `period` [s] or is driven at another
/// frequency.
pub(crate) fn check_periodic(system: &System, period: f64) -> Result<(), AnalysisError> {
    // Roundings of a phase, some thousands of them.
    const CLOSE: f64 = 1e-9;
    let differs = |a: DVec3, b: DVec3, size: f64| (a - b).length() > CLOSE * size;
    let length = system.units().length;
    for hinge in system.hinges() {
        let joint = &hinge.model;
        let (a, b) = (hinge.rotation(0.0), hinge.rotation(period));
        let turned = (0..3).any(|k| differs(a.c.col(k), b.c.col(k), 1.0));
        let spun = differs(a.w * period, b.w * period, 1.0 + a.w.length() * period);
        let travelled = joint.travel.as_ref().is_some_and(|law| {
            let ([x, v, _], [y, u, _]) = (law.at(0.0), law.at(period));
            let size = length + v.length() * period;
            differs(x, y, size) || differs(v * period, u * period, size)
        });
        let driven = joint.elements.iter().filter_map(|e| e.law.drive());
        let drifts = driven.clone().any(|series| series.rate != 0.0);
        let varying = driven.filter(|series| series.oscillates());
        let mut phases = varying.map(|series| series.frequency * period);
        let off = phases.any(|x| (x - x.round()).abs() > CLOSE * x.abs());
        if turned || spun || travelled || drifts || off {
            return Err(AnalysisError::not_covered(
                format!(
                    "joint `{}` is not back after a wingbeat of {period:.4e} s",
                    hinge.name
                ),
                "drive it at the wings' frequency (motion.frequency_hz) or a multiple of it, or fly it with `run`, without a regulator or stabiliser",
            ));
        }
    }
    Ok(())
}
