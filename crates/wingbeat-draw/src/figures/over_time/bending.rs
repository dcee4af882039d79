//! How an elastic wing bends over time: deflection, twist and camber of sections along its span.

use wingbeat_flight::FlightSetup;
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;

use crate::figures::axes::units::length_floor;
use crate::figures::over_time::measure::{Kept, Line, Measure, Measured, Unit};

/// Names of the sections in columns, and what stands for them in a figure.
const SECTIONS: [[&str; 2]; 4] = [
    ["quarter", "1/4"],
    ["half", "1/2"],
    ["three_quarters", "3/4"],
    ["tip", "tip"],
];

/// Camber over chord that is rounding \[1\].
const ROUNDING: f64 = 1e-12;

/// Of the last elastic wing, which stands for all; none where wings are rigid.
pub(crate) fn bending(setup: &FlightSetup, history: &History) -> Option<Measured> {
    let wings = &setup.animal.wings;
    let last = wings.iter().rposition(|w| w.structure.is_some())?;
    let wing = &column_stems(&setup.animal)[last + 1];
    let lines = |of: &dyn Fn(&str) -> String| {
        let line = |[name, label]: [&str; 2]| Line::new(label, history.column(&of(name)).to_vec());
        SECTIONS.map(line).into_iter().collect::<Vec<_>>()
    };
    // Of the tip the columns have their own names.
    let named = |what: &str, unit: &str, tip: &str| {
        let tip = format!("tip_{wing}_{tip}");
        let stem = format!("{wing}_{unit}");
        lines(&|name: &str| match name {
            "tip" if !tip.ends_with('_') => tip.clone(),
            _ => format!("{what}_{name}_{stem}"),
        })
    };
    let power = format!("strain_power_{wing}_watt");
    let power = Line::new("power", history.column(&power).to_vec());
    // Sections of beams stay as they are but for rounding.
    let camber = named("camber", "dimensionless", "").into_iter();
    let camber = camber.map(|line| line.kept(Kept::Over(ROUNDING)));
    let panels = vec![
        Measure::new(
            "deflection",
            Unit::Prefixed("m"),
            named("deflection", "m", "displacement_w3_m"),
        )
        .floored(length_floor(setup)),
        Measure::new("twist", Unit::Degrees, named("twist", "rad", "twist_rad")),
        Measure::new("camber over chord", Unit::Given, camber.collect()),
        Measure::new(
            "power into elastic energy",
            Unit::Prefixed("W"),
            vec![power.kept(Kept::Always)],
        ),
    ];
    Some(Measured {
        name: "bending",
        title: format!(
            "bending of {} at parts of its length",
            wing.replace('_', " ")
        ),
        shaded: true,
        panels: panels.into_iter().map(|p| p.of_wing(last)).collect(),
    })
}
