//! `[air]`: the air's model, and the settings of the vortex lattice.

use wingbeat_air::{
    AirSettings, CirculationRate, Convection, CoreModel, Friction, Gust, GustShape, LeadingEdge,
    LoadMethod, Method, ParticleSettings, Plane, SectionDrag, SheddingKinds, Stretching, Wind,
};
use wingbeat_flight::{AirModel, AirOptions};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_model::Animal;

use super::{Built, at_least, blade, deformation, derivatives, not_negative, positive, vector};
use crate::error::Fault;
use crate::raw::{
    AirCase, AirModel as Model, Case, CirculationRateCase, ConvectionCase, CoreCase, EdgeCase,
    FrictionCase, GustCase, LeadingEdgeCase, LoadMethodCase, ParticlesCase, SchemeCase,
    SectionDragCase, StretchingCase, SummationCase,
};

/// Default cut-off over the mean panel length, the published benchmark's.
const CUT_OFF: f64 = 0.01;

/// Vortex cores where the case leaves them open.
pub(super) fn fill_defaults(case: &mut Case, animal: &Animal) {
    if case.air.bound_core.is_none() {
        let length_m = CUT_OFF * mean_panel_length(animal);
        case.air.bound_core = Some(CoreCase::CutOff { length_m });
    }
    if case.air.wake_core.is_none() {
        case.air.wake_core.clone_from(&case.air.bound_core);
    }
    if case.air.wake_overlap.is_none() {
        let has_radius = !matches!(case.air.wake_core, Some(CoreCase::CutOff { .. }));
        case.air.wake_overlap = Some(if has_radius { 1.0 } else { 0.0 });
    }
}

/// Square root of the mean area of a wing panel [m]; 1 without wings.
fn mean_panel_length(animal: &Animal) -> f64 {
    let reports = animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let panels: usize = reports.iter().map(|r| r.panels).sum();
    if panels == 0 {
        1.0
    } else {
        (area / panels as f64).sqrt()
    }
}

/// The air of the flight.
pub(super) fn options(whole: &Case, animal: &Animal) -> Built<AirModel> {
    let case = &whole.air;
    match case.model {
        Model::None => Ok(AirModel::None),
        Model::BladeElement => Ok(AirModel::BladeElement(blade::options(case)?)),
        Model::Derivatives => Ok(AirModel::Derivatives(derivatives::table(whole, animal)?)),
        Model::External => Ok(AirModel::External(derivatives::external(case, animal)?)),
        Model::VortexLattice => {
            let joined = deformation::joined(whole, animal)?;
            Ok(AirModel::VortexLattice(lattice(case, joined)?))
        }
    }
}

fn lattice(case: &AirCase, joined: Vec<[usize; 2]>) -> Built<AirOptions> {
    let limit = |key: &str, value: Option<f64>| value.map(|v| positive(key, v)).transpose();
    let sheds = |edge: EdgeCase| case.shed.contains(&edge);
    let density = positive("air.density_kg_m3", case.density_kg_m3)?;
    let scheme = match case.scheme {
        SchemeCase::Benchmark => AirSettings::benchmark,
        SchemeCase::Accurate => AirSettings::accurate,
    };
    let scheme = scheme(density, vector(case.stream_m_s));
    let ground = case.ground.map(|g| Plane {
        point: vector(g.point_m),
        normal: vector(g.normal),
    });
    let lattice = AirSettings {
        bound_core: core("air.bound_core", case.bound_core.as_ref())?,
        wake_core: core("air.wake_core", case.wake_core.as_ref())?,
        wake_overlap: not_negative(
            "air.wake_overlap",
            case.wake_overlap.expect("the default was filled in"),
        )?,
        wake_blob_length: limit("air.wake_blob_length_m", case.wake_blob_length_m)?,
        shedding: SheddingKinds {
            trailing: sheds(EdgeCase::Trailing),
            tip: sheds(EdgeCase::Tip),
            leading: sheds(EdgeCase::Leading),
            root: sheds(EdgeCase::Root),
        },
        rate: match case.circulation_rate {
            None => scheme.rate,
            Some(CirculationRateCase::Backward) => CirculationRate::Backward,
            Some(CirculationRateCase::BackwardSecond) => CirculationRate::BackwardSecond,
            Some(CirculationRateCase::Omitted) => CirculationRate::Omitted,
        },
        convection: match case.convection {
            None => scheme.convection,
            Some(ConvectionCase::Euler) => Convection::Euler,
            Some(ConvectionCase::AdamsBashforth) => Convection::AdamsBashforth,
        },
        inset: case.ring_inset.unwrap_or(scheme.inset),
        loads: match case.loads {
            LoadMethodCase::Pressure => LoadMethod::Pressure,
            LoadMethodCase::Joukowski => LoadMethod::Joukowski,
            LoadMethodCase::Polhamus => LoadMethod::Polhamus,
        },
        leading: leading_edge(case)?,
        wind: wind(case)?,
        images: ground.into_iter().collect(),
        max_age: limit("air.max_wake_age_s", case.max_wake_age_s)?,
        max_distance: limit("air.max_wake_distance_m", case.max_wake_distance_m)?,
        max_rows: match case.max_wake_rows {
            Some(rows) => Some(at_least("air.max_wake_rows", rows, 1)?),
            None => None,
        },
        max_displacement: limit("air.max_displacement_m", case.max_displacement_m)?,
        clearance: not_negative("air.clearance_m", case.clearance_m)?,
        particles: match &case.particles {
            Some(p) => Some(particles(p, case)?),
            None => None,
        },
        section_drag: case.section_drag.map(section_drag).transpose()?,
        summation: match case.summation {
            SummationCase::Auto => Method::Auto,
            SummationCase::Direct => Method::Direct,
            SummationCase::Single => Method::Single,
            SummationCase::Tree => Method::Tree,
        },
        tolerance: positive("air.summation_tolerance", case.summation_tolerance)?,
        ..scheme
    };
    lattice.validate().map_err(|e| {
        Fault::new(
            "air",
            e.to_string(),
            "see the message",
            "correct that number",
        )
    })?;
    Ok(AirOptions {
        lattice,
        body_surfaces: case.body,
        mirror: case.mirror,
        joined,
    })
}

/// Drag of the sections.
fn section_drag(case: SectionDragCase) -> Built<SectionDrag> {
    let key = |k: &str| format!("air.section_drag.{k}");
    let viscosity = case.viscosity_m2_s.unwrap_or(0.0);
    let friction = match case.friction {
        FrictionCase::None => Friction::None,
        FrictionCase::Blasius if case.viscosity_m2_s.is_none() => {
            return Err(Fault::new(
                key("viscosity_m2_s"),
                "the friction needs the viscosity of the air, which has no default",
                "a finite number > 0",
                "1.5e-5 for air at sea level; friction = \"none\" leaves friction out",
            ));
        }
        FrictionCase::Blasius => Friction::Blasius {
            viscosity: positive(&key("viscosity_m2_s"), viscosity)?,
        },
    };
    Ok(SectionDrag {
        friction,
        cd0: not_negative(&key("cd0"), case.cd0)?,
        cd2: not_negative(&key("cd2_per_rad2"), case.cd2_per_rad2)?,
    })
}

/// The separation criterion with the threshold it needs.
fn leading_edge(case: &AirCase) -> Built<LeadingEdge> {
    let need = |key: &str, value: Option<f64>| {
        value.ok_or_else(|| {
            Fault::new(
                key,
                "air.leading_edge needs this threshold, which has no default",
                "a finite number > 0",
                "give a threshold that fits wing section and Reynolds number",
            )
        })
    };
    Ok(match case.leading_edge {
        LeadingEdgeCase::Never => LeadingEdge::Never,
        LeadingEdgeCase::Always => LeadingEdge::Always,
        LeadingEdgeCase::AngleOfAttack => {
            let key = "air.leading_edge_threshold_deg";
            let threshold = need(key, case.leading_edge_threshold_deg)?;
            LeadingEdge::AngleOfAttack {
                threshold: positive(key, threshold)?.to_radians(),
            }
        }
        LeadingEdgeCase::Suction => {
            let key = "air.leading_edge_threshold";
            let threshold = need(key, case.leading_edge_threshold)?;
            LeadingEdge::Suction {
                threshold: positive(key, threshold)?,
            }
        }
    })
}

/// Particles; radius and viscosity are those of the wake's filaments where left out, unless these
/// are as wide as they are long.
fn particles(case: &ParticlesCase, air: &AirCase) -> Built<ParticleSettings> {
    let (radius, viscosity) = match &air.wake_core {
        Some(CoreCase::LambOseen {
            radius_m,
            viscosity_m2_s,
        }) => (Some(*radius_m), *viscosity_m2_s),
        Some(CoreCase::Vatistas { radius_m } | CoreCase::Scully { radius_m }) => {
            (Some(*radius_m), 0.0)
        }
        _ => (None, 0.0),
    };
    let default = radius.filter(|_| air.wake_overlap == Some(0.0));
    let radius = case.radius_m.or(default).ok_or_else(|| {
        Fault::new(
            "air.particles",
            "particles need a radius, and wake_core has none or wake_overlap widens it",
            "radius_m > 0",
            "add radius_m: about the distance between rows of wake",
        )
    })?;
    if case.after_rows.is_none() && !case.leading_edge {
        return Err(Fault::new(
            "air.particles",
            "nothing becomes a particle",
            "after_rows, leading_edge = true, or both",
            "add after_rows = 8",
        ));
    }
    let after = |rows| at_least("air.particles.after_rows", rows, 1);
    Ok(ParticleSettings {
        after: case.after_rows.map(after).transpose()?,
        leading_at_once: case.leading_edge,
        radius: positive("air.particles.radius_m", radius)?,
        viscosity: not_negative(
            "air.particles.viscosity_m2_s",
            case.viscosity_m2_s.unwrap_or(viscosity),
        )?,
        stretching: match case.stretching {
            StretchingCase::Transpose => Stretching::Transpose,
            StretchingCase::Classical => Stretching::Classical,
            StretchingCase::Omitted => Stretching::Omitted,
        },
    })
}

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
    let shape = match (case.duration_s, &case.table) {
        (Some(duration), None) => GustShape::OneMinusCosine {
            duration: positive(&format!("air.gust[{k}].duration_s"), duration)?,
        },
        (None, Some(rows)) => {
            if let Some(row) = rows.windows(2).position(|w| w[1].0 <= w[0].0) {
                return Err(Fault::new(
                    format!("air.gust[{k}].table"),
                    format!(
                        "the time of row {} is not later than that of the row before",
                        row + 1
                    ),
                    "rows of time and share, counted from 0, times rising",
                    "put the rows in the order of their times",
                ));
            }
            GustShape::Table(rows.clone())
        }
        _ => {
            return Err(Fault::new(
                format!("air.gust[{k}]"),
                "a gust has either a duration or a table",
                "duration_s or table",
                "give one of the two",
            ));
        }
    };
    let front = case.front_m_s.map(vector);
    Ok(Gust {
        amplitude: vector(case.amplitude_m_s),
        start: case.start_s,
        slowness: front.map_or(DVec3::ZERO, |u| u / u.length_squared()),
        shape,
    })
}

fn core(path: &str, case: Option<&CoreCase>) -> Built<CoreModel> {
    let number = |key: &str, value: f64| not_negative(&format!("{path}.{key}"), value);
    Ok(match case.expect("defaults were filled in") {
        CoreCase::CutOff { length_m } => CoreModel::CutOff {
            delta: number("cut_off.length_m", *length_m)?,
        },
        CoreCase::Vatistas { radius_m } => CoreModel::Vatistas {
            radius: number("vatistas.radius_m", *radius_m)?,
        },
        CoreCase::Scully { radius_m } => CoreModel::Scully {
            radius: number("scully.radius_m", *radius_m)?,
        },
        CoreCase::LambOseen {
            radius_m,
            viscosity_m2_s,
        } => CoreModel::LambOseen {
            radius: number("lamb_oseen.radius_m", *radius_m)?,
            viscosity: number("lamb_oseen.viscosity_m2_s", *viscosity_m2_s)?,
        },
    })
}
