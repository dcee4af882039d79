//! Keys that act on wings and their wakes, in cases without wings: each is refused by name.

use toml::Table;

use crate::build::fault::{Built, idle};
use crate::build::resolve;
use crate::error::Fault;
use crate::raw::{AirCase, AirModel, Case, WingInertia};
use crate::text::source::{CaseSource, table_of};

const WITHOUT_WINGS: &str = "without wings";
const WITH_WINGS: &str = "with a wing ([wing.NAME])";

/// Keys of the lattice that act on wings and their wakes alone.
const LATTICE: [&str; 24] = [
    "viscosity_m2_s",
    "shed",
    "wake_overlap",
    "wake_overlap_slope",
    "wake_blob_length_m",
    "wake_blob_length_chords",
    "convection",
    "ring_inset",
    "loads",
    "leading_edge",
    "leading_edge_threshold_deg",
    "leading_edge_threshold",
    "leading_edge_suction_efficiency",
    "leading_edge_formation_chords",
    "max_wake_age_s",
    "max_wake_distance_m",
    "max_wake_distance_chords",
    "max_wake_rows",
    "plane_wakes",
    "max_displacement_m",
    "clearance_m",
    "clearance_chords",
    "particles",
    "section_drag",
];

/// Keys of the blade elements that act on wings alone.
const BLADES: [&str; 10] = [
    "coefficients",
    "own",
    "rotation",
    "rotation_coefficient",
    "added_mass",
    "centre_of_pressure",
    "viscous",
    "unsteady",
    "states",
    "induced_m_s",
];

/// Checks what the case says of the air where there are no wings. Values that are the default may stand, as
/// resolved cases have them.
pub(crate) fn check(case: &Case, source: &CaseSource) -> Built<()> {
    if !case.wing.is_empty() {
        return Ok(());
    }
    if case.dynamics.wings != WingInertia::Massive && source.gives("dynamics.wings") {
        return Err(idle("dynamics.wings", WITHOUT_WINGS, WITH_WINGS));
    }
    match case.air.model {
        AirModel::VortexLattice => lattice(&case.air, source),
        AirModel::BladeElement => blades(&case.air, source),
        AirModel::Derivatives | AirModel::External | AirModel::None => Ok(()),
    }
}

fn lattice(air: &AirCase, source: &CaseSource) -> Built<()> {
    let mut plain = AirCase {
        scheme: air.scheme,
        wake_core: air.wake_core.clone(),
        ..AirCase::default()
    };
    resolve::air(&mut plain);
    unchanged("air", &LATTICE, [&table_of(air), &table_of(&plain)], source)?;
    // One core asks for the other, of the same kind.
    match source.gives("air.wake_core") && !source.gives("air.bound_core") {
        true => Err(idle("air.wake_core", WITHOUT_WINGS, WITH_WINGS)),
        false => Ok(()),
    }
}

fn blades(air: &AirCase, source: &CaseSource) -> Built<()> {
    let [given, plain] = [air, &AirCase::default()].map(table_of);
    unchanged("air", &["viscosity_m2_s"], [&given, &plain], source)?;
    let drag = air.blade.body_drag.as_ref();
    if drag.is_none_or(|d| d.area_m2 == 0.0 || (d.along == 0.0 && d.across == 0.0)) {
        return Err(Fault::new(
            "air.model",
            "the blade elements have no wings, and the body has no drag: nothing meets the air",
            "blade_element with wings or air.blade.body_drag",
            "give air.blade.body_drag, or fly without air: air.model = \"none\"",
        ));
    }
    let tables = [&air.blade, &AirCase::default().blade].map(table_of);
    unchanged("air.blade", &BLADES, [&tables[0], &tables[1]], source)
}

/// An error at the first of `keys` in the table at `path` that the case gives another value than its default.
fn unchanged(
    path: &str,
    keys: &[&str],
    [own, plain]: [&Table; 2],
    source: &CaseSource,
) -> Built<()> {
    let full = |key: &str| format!("{path}.{key}");
    let mut differ = keys.iter().filter(|k| own.get(**k) != plain.get(**k));
    match differ.find(|k| source.gives(&full(k))) {
        Some(key) => Err(idle(full(key), WITHOUT_WINGS, WITH_WINGS)),
        None => Ok(()),
    }
}
