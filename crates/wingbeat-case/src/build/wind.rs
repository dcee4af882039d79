//! `[[air.gust]]`, `air.shear_1_s` and `[air.ground]`.

use wingbeat_air::{Gust, GustShape, Plane, Turbulence, Wind};
use wingbeat_math::{DMat3, DVec3};

use super::fault::Built;
use super::numbers::vector;
use crate::error::Fault;
use crate::raw::{AirCase, GroundCase, GustCase, TurbulenceCase};

/// What is added to the stream.
pub(super) fn wind(case: &AirCase) -> Built<Wind> {
    let gusts: Built<Vec<Gust>> = case.gust.iter().enumerate().map(gust).collect();
    let shear = case.shear_1_s.map(|rows| {
        let [a, b, c] = rows.map(DVec3::from_array);
        DMat3::from_cols(a, b, c).transpose()
    });
    Ok(Wind {
        shear,
        gusts: gusts?,
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
    made.map_err(|_| {
        Fault::new(
            format!("{path}.turbulence.time_scale_s"),
            format!("{} s is no time scale", case.time_scale_s),
            "a time above 0",
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
