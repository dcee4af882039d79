//! `[[air.gust]]`, `[air.vortex_street]`, `air.shear_1_s` and `[air.ground]`.

use wingbeat_air::{
    AirError, Gust, GustShape, NEUTRAL_WIDTH, Plane, Turbulence, VortexStreet, Wind,
};
use wingbeat_math::{DMat3, DVec3};

use crate::build::fault::Built;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{AirCase, GroundCase, GustCase, TurbulenceCase, VortexStreetCase};

/// Shortest time scale of turbulence: that of the smallest eddies of air is a thousand times as long \[s\].
const SHORTEST: f64 = 1e-6;

/// Circulation over spacing of a vortex street at most, beyond the speed of sound \[m/s\].
const FASTEST: f64 = 1e3;

/// What is added to the stream.
pub(crate) fn wind(case: &AirCase) -> Built<Wind> {
    let gusts: Built<Vec<Gust>> = case.gust.iter().enumerate().map(gust).collect();
    let wind = Wind {
        shear: case.shear_1_s.map(shear),
        gusts: gusts?,
        street: case.vortex_street.as_ref().map(street).transpose()?,
    };
    wind.validate().map_err(|e| refused(case, &e))?;
    Ok(wind)
}

/// What the air refuses of its wind, at the key it is about.
fn refused(case: &AirCase, error: &AirError) -> Fault {
    match error {
        AirError::GustTable { gust, row, problem } => {
            let table = format!("air.gust[{gust}].table");
            let rows = case.gust[*gust].table.as_ref().map_or(0, Vec::len);
            let key = match *row < rows {
                true => format!("{table}[{row}]"),
                false => table,
            };
            let allowed = "at least two rows of time and share, times rising";
            Fault::new(
                key,
                *problem,
                allowed,
                "put the rows in the order of their times",
            )
        }
        AirError::Setting {
            key,
            value,
            allowed,
        } => Fault::new(
            key_of(key).unwrap_or("air"),
            value,
            *allowed,
            "change this key",
        ),
        error => Fault::new("air", error.to_string(), "", "correct the air"),
    }
}

/// The key of a case that a setting of the wind comes from.
pub(crate) fn key_of(setting: &str) -> Option<&'static str> {
    match setting {
        "shear" => Some("air.shear_1_s"),
        name if name.starts_with("gust") => Some("air.gust"),
        name if name.starts_with("vortex street") => Some("air.vortex_street"),
        _ => None,
    }
}

fn shear(rows: [[f64; 3]; 3]) -> DMat3 {
    let [a, b, c] = rows.map(DVec3::from_array);
    DMat3::from_cols(a, b, c).transpose()
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
        (None, Some(rows), None) => GustShape::Table(rows.clone()),
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

/// The plane of the ground, along which the stream goes.
pub(crate) fn ground(case: &GroundCase, stream: DVec3) -> Built<Plane> {
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
