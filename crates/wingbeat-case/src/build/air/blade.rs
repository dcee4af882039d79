//! `[air.blade]`: the blade-element model.

use wingbeat_blade::{
    BladeSettings, BodyDrag, Rotation, Translation, Unsteady, ViscousMoment, find_set,
};
use wingbeat_flight::BladeOptions;

use crate::build::air::wind::wind;
use crate::build::fault::Built;
use crate::build::numbers::vector;
use crate::error::Fault;
use crate::raw::{AirCase, BladeCase, BodyDragCase, RotationCase, UnsteadyCase};

/// The blade elements of the case, about an animal of this scale.
pub(crate) fn options(air: &AirCase, scale: f64) -> Built<BladeOptions> {
    let case = &air.blade;
    let blade = BladeSettings {
        density: air.density_kg_m3,
        free_stream: vector(air.stream_m_s),
        translation: translation(case)?,
        centre_of_pressure: case.centre_of_pressure,
        rotation: match (case.rotation, case.rotation_coefficient) {
            (RotationCase::None, _) => Rotation::None,
            (_, Some(c)) => Rotation::Coefficient(c),
            (RotationCase::Circulation, None) => Rotation::Circulation,
            (RotationCase::SaneDickinson, None) => Rotation::SaneDickinson,
        },
        added_mass: case.added_mass,
        viscous: case.viscous.map(|v| ViscousMoment {
            linear: v.linear_hz,
            quadratic: v.quadratic,
        }),
        unsteady: match case.unsteady {
            UnsteadyCase::None => None,
            UnsteadyCase::Jones => Some(Unsteady::Jones),
            UnsteadyCase::Peters => Some(Unsteady::Peters {
                states: case.states,
            }),
        },
    };
    Ok(BladeOptions {
        blade,
        body_drag: case.body_drag.map(|drag| body_drag(drag, scale)),
        induced: vector(case.induced_m_s),
        wind: wind(air)?,
        viscosity: air.viscosity_m2_s,
    })
}

fn translation(case: &BladeCase) -> Built<Translation> {
    if let Some(own) = case.own {
        return Ok(Translation::DoubleAngle {
            lift: own.lift,
            drag_0: own.drag_0,
            drag_90: own.drag_90,
        });
    }
    let set = find_set(&case.coefficients).map_err(|e| {
        Fault::new(
            "air.blade.coefficients",
            e.to_string(),
            "the name of a shipped set",
            "or give lift, drag_0 and drag_90 of your own in [air.blade.own]",
        )
    })?;
    Ok(set.law)
}

fn body_drag(case: BodyDragCase, scale: f64) -> BodyDrag {
    BodyDrag {
        area: case.area_m2 * scale * scale,
        along: case.along,
        across: case.across,
        centre: case.centre_m.map(|x| vector(x) * scale),
    }
}
