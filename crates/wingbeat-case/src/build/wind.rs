//! `[[air.gust]]`, `[air.vortex_street]`, `air.shear_1_s` and `[air.ground]`.

use wingbeat_air::{Gust, GustShape, NEUTRAL_WIDTH, Plane, Turbulence, VortexStreet, Wind};
use wingbeat_math::{DMat3, DVec3, trace};

use super::fault::Built;
use super::numbers::vector;
use crate::error::Fault;
use crate::raw::{AirCase, GroundCase, GustCase, TurbulenceCase, VortexStreetCase};

/// Shortest time scale of turbulence: that of the smallest eddies of air is a thousand times as long \[s\].
const SHORTEST: f64 = 1e-6;

/// Circulation over spacing of a vortex street at most, beyond the speed of sound \[m/s\].
const FASTEST: f64 = 1e3;

/// What is added to the stream.
pub(super) fn wind(case: &AirCase) -> Built<Wind> {
    let gusts: Built<Vec<Gust>> = case.gust.iter().enumerate().map(gust).collect();
    Ok(Wind {
        shear: case.shear_1_s.map(shear).transpose()?,
        gusts: gusts?,
        street: case.vortex_street.as_ref().map(street).transpose()?,
    })
}

fn shear(rows: [[f64; 3]; 3]) -> Built<DMat3> {
    let [a, b, c] = rows.map(DVec3::from_array);
    let shear = DMat3::from_cols(a, b, c).transpose();
    let apart = trace(shear);
    let size = rows.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    match apart.abs() <= 1e-9 * size {
        true => Ok(shear),
        false => Err(Fault::new(
            "air.shear_1_s",
            format!(
                "its diagonal adds up to {apart:.4} 1/s: air that flows apart everywhere loses its density"
            ),
            "rows whose diagonal elements add up to 0",
            "let what flows apart along one axis come together along another",
        )),
    }
}

fn street(case: &VortexStreetCase) -> Built<VortexStreet> {
    let refused = |key: &str, problem: &str, allowed: &str, remedy: &str| {
        let key = format!("air.vortex_street.{key}");
        Err(Fault::new(key, problem, allowed, remedy))
    };
    let [drift, axis] = [case.drift_m_s, case.axis].map(vector);
    if drift == DVec3::ZERO {
        let problem = "the rows of a street that does not travel have no direction";
        return refused(
            "drift_m_s",
            problem,
            "a velocity other than 0",
            "give the speed of the wake",
        );
    }
    if axis == DVec3::ZERO || drift.dot(axis).abs() > 1e-9 * drift.length() * axis.length() {
        let problem = "the vortices do not stand square to the drift";
        return refused(
            "axis",
            problem,
            "a direction square to drift_m_s",
            "turn one of them",
        );
    }
    let speed = (case.circulation_m2_s / case.spacing_m).abs();
    if speed > FASTEST {
        let problem = format!("vortices so close would drive the air at {speed:.1e} m/s");
        return Err(Fault::new(
            "air.vortex_street.spacing_m",
            problem,
            format!("circulation_m2_s over spacing_m at most {FASTEST} m/s"),
            "check the units: metres, and m2/s",
        ));
    }
    Ok(VortexStreet {
        circulation: case.circulation_m2_s,
        spacing: case.spacing_m,
        width: case.width_m.unwrap_or(NEUTRAL_WIDTH * case.spacing_m),
        concentration: case.concentration,
        drift,
        axis,
        point: vector(case.point_m),
    })
}

fn gust((k, case): (usize, &GustCase)) -> Built<Gust> {
    let path = format!("air.gust[{k}]");
    let shape = match (case.duration_s, &case.table, case.turbulence) {
        (Some(duration), None, None) => GustShape::OneMinusCosine { duration },
        (None, Some(rows), None) => {
            rising(&path, rows)?;
            GustShape::Table(rows.clone())
        }
        (None, None, Some(t)) => GustShape::Turbulence(turbulence(&path, t)?),
        _ => {
            return Err(Fault::new(
                path,
                "a gust has a duration, a table or turbulence",
                "one of duration_s, table and turbulence",
                "give one of the three",
            ));
        }
    };
    let front = match case.front_m_s.map(vector) {
        Some(DVec3::ZERO) => {
            return Err(Fault::new(
                format!("{path}.front_m_s"),
                "a front that does not travel never arrives",
                "a velocity other than 0",
                "leave the key out for a gust that is everywhere at once",
            ));
        }
        front => front,
    };
    Ok(Gust {
        amplitude: vector(case.amplitude_m_s),
        start: case.start_s,
        slowness: front.map_or(DVec3::ZERO, |u| u / u.length_squared()),
        shape,
    })
}

fn turbulence(path: &str, case: TurbulenceCase) -> Built<Turbulence> {
    let made = Turbulence::new(case.spectrum, case.time_scale_s, case.seed);
    made.ok()
        .filter(|t| t.time_scale >= SHORTEST)
        .ok_or_else(|| {
            Fault::new(
                format!("{path}.turbulence.time_scale_s"),
                format!("{:e} s is no time scale of turbulence", case.time_scale_s),
                format!("a time of {SHORTEST:e} s or more"),
                "length scale over speed, e.g. 0.1",
            )
        })
}

/// Checks that the times of a gust's table rise.
fn rising(path: &str, rows: &[(f64, f64)]) -> Built<()> {
    let Some(row) = rows.windows(2).position(|w| w[1].0 <= w[0].0) else {
        return Ok(());
    };
    Err(Fault::new(
        format!("{path}.table"),
        format!(
            "the time of row {} is not later than that of the row before",
            row + 1
        ),
        "rows of time and share, counted from 0, times rising",
        "put the rows in the order of their times",
    ))
}

/// The plane of the ground, along which the stream goes.
pub(super) fn ground(case: &GroundCase, stream: DVec3) -> Built<Plane> {
    let [point, normal] = [case.point_m, case.normal].map(vector);
    let Some(unit) = normal.try_normalize() else {
        return Err(Fault::new(
            "air.ground.normal",
            "a plane needs a direction",
            "three numbers, not all zero",
            "[0, 0, 1] for level ground",
        ));
    };
    if stream.dot(unit).abs() > 1e-12 * stream.length() {
        return Err(Fault::new(
            "air.ground",
            "the stream goes through the plane",
            "a plane along air.stream_m_s",
            "turn the plane or the stream: no air goes through the ground",
        ));
    }
    Ok(Plane { point, normal })
}
