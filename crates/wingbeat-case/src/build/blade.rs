//! `[air.blade]`: the blade-element model.

use wingbeat_blade::{
    AddedMass, BladeSettings, BodyDrag, CentreOfPressure, Rotation, Translation, ViscousMoment,
    find_set,
};
use wingbeat_flight::BladeOptions;

use super::{Built, not_negative, positive, vector};
use crate::error::Fault;
use crate::raw::{AddedMassCase, AirCase, BladeCase, PressureCase, RotationCase};

/// The blade elements of the case.
pub(super) fn options(air: &AirCase) -> Built<BladeOptions> {
    let case = &air.blade;
    let blade = BladeSettings {
        density: positive("air.density_kg_m3", air.density_kg_m3)?,
        free_stream: vector(air.stream_m_s),
        translation: translation(case)?,
        centre_of_pressure: match case.centre_of_pressure {
            PressureCase::Cosine => CentreOfPressure::Cosine,
            PressureCase::Chen2016 => CentreOfPressure::Chen2016,
            PressureCase::Fixed(x) => CentreOfPressure::Fixed(x),
        },
        rotation: match (case.rotation, case.rotation_coefficient) {
            (RotationCase::None, _) => Rotation::None,
            (_, Some(c)) => Rotation::Coefficient(c),
            (RotationCase::Circulation, None) => Rotation::Circulation,
            (RotationCase::SaneDickinson, None) => Rotation::SaneDickinson,
        },
        added_mass: match case.added_mass {
            AddedMassCase::None => AddedMass::None,
            AddedMassCase::Normal => AddedMass::Normal,
            AddedMassCase::Section => AddedMass::Section,
        },
        viscous: case.viscous.map(|v| ViscousMoment {
            linear: v.linear_hz,
            quadratic: v.quadratic,
        }),
    };
    blade.check().map_err(|e| {
        Fault::new(
            "air.blade",
            e.to_string(),
            "see the message",
            "correct that number",
        )
    })?;
    Ok(BladeOptions {
        blade,
        body_drag: body_drag(case)?,
        induced: vector(case.induced_m_s),
        wind: super::air::wind(air)?,
    })
}

fn translation(case: &BladeCase) -> Built<Translation> {
    if let Some(own) = case.own {
        return Ok(Translation::DoubleAngle {
            lift: own.lift,
            drag_0: not_negative("air.blade.own.drag_0", own.drag_0)?,
            drag_90: not_negative("air.blade.own.drag_90", own.drag_90)?,
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

fn body_drag(case: &BladeCase) -> Built<Option<BodyDrag>> {
    let Some(drag) = case.body_drag else {
        return Ok(None);
    };
    Ok(Some(BodyDrag {
        area: not_negative("air.blade.body_drag.area_m2", drag.area_m2)?,
        along: not_negative("air.blade.body_drag.along", drag.along)?,
        across: not_negative("air.blade.body_drag.across", drag.across)?,
    }))
}
