//! The settings of the vortex lattice.

use wingbeat_air::{
    AirError, AirSettings, CoreModel, EdgeKind, Friction, LeadingEdge, OVERLAP_SLOPE,
    ParticleSettings, SectionDrag, SheddingKinds, VortexLift,
};
use wingbeat_flight::AirOptions;
use wingbeat_model::Animal;

use crate::build::air::lengths::Chord;
use crate::build::air::{viscosity, wind};
use crate::build::animal::deformation;
use crate::build::fault::{Built, idle};
use crate::build::numbers::vector;
use crate::build::resolve;
use crate::error::Fault;
use crate::raw::{
    AirCase, Case, CoreCase, FrictionCase, LeadingEdgeCase, ParticlesCase, SchemeCase,
    SectionDragCase,
};

/// The lattice and what of the animal it sees.
pub(crate) fn options(whole: &Case, animal: &Animal) -> Built<AirOptions> {
    let (case, chord) = (&whole.air, Chord::of(animal));
    let settings = settings(case, &chord)?;
    settings.validate().map_err(|e| refused(case, &e))?;
    Ok(AirOptions {
        lattice: settings,
        body_surfaces: case.body,
        mirror: case.mirror,
        joined: deformation::joined(whole, animal)?,
        joined_tips: deformation::joined_tips(whole, animal)?,
        has_own_viscosity: case.viscosity_m2_s.is_some(),
    })
}

fn settings(case: &AirCase, chord: &Chord) -> Built<AirSettings> {
    let length = |name: &str, metres, chords| chord.length(&format!("air.{name}"), metres, chords);
    let sheds = |edge: EdgeKind| case.shed.contains(&edge);
    let stream = vector(case.stream_m_s);
    let scheme = match case.scheme {
        SchemeCase::Benchmark => AirSettings::benchmark,
        SchemeCase::Accurate => AirSettings::accurate,
    };
    viscosity::given_once(case)?;
    let wake_core = chord.core("air.wake_core", &case.wake_core, viscosity::of_fluid(case))?;
    let ground = case.ground.map(|g| wind::ground(&g, stream)).transpose()?;
    let particles = |p| particles(p, case, chord, wake_core);
    let bound_core = bound_core(chord, &case.bound_core, wake_core)?;
    chord.check_bound_core(&bound_core)?;
    Ok(AirSettings {
        bound_core,
        wake_core,
        wake_overlap: case.wake_overlap.value(),
        overlap_slope: overlap_slope(case)?,
        wake_blob_length: length(
            "wake_blob_length",
            case.wake_blob_length_m,
            case.wake_blob_length_chords,
        )?,
        shedding: SheddingKinds {
            trailing: sheds(EdgeKind::Trailing),
            tip: sheds(EdgeKind::Tip),
            leading: sheds(EdgeKind::Leading),
            root: sheds(EdgeKind::Root),
        },
        rate: case.circulation_rate.value(),
        convection: case.convection.value(),
        inset: case.ring_inset.value(),
        loads: case.loads,
        leading: leading_edge(case)?,
        wind: wind::wind(case)?,
        images: ground.into_iter().collect(),
        max_age: case.max_wake_age_s,
        max_distance: length(
            "max_wake_distance",
            case.max_wake_distance_m,
            case.max_wake_distance_chords,
        )?,
        max_rows: case.max_wake_rows,
        max_displacement: case.max_displacement_m,
        plane_wakes: case.plane_wakes,
        clearance: length("clearance", case.clearance_m, case.clearance_chords)?.unwrap_or(0.0),
        particles: case.particles.as_ref().map(particles).transpose()?,
        section_drag: section_drag(
            case.section_drag,
            wake_core.viscosity().or(case.viscosity_m2_s),
        )?,
        summation: case.summation,
        tolerance: case.summation_tolerance,
        ..scheme(case.density_kg_m3, stream)
    })
}

/// [`AirSettings::overlap_slope`], which a case may change only where it acts.
fn overlap_slope(case: &AirCase) -> Built<f64> {
    match case.wake_overlap_slope {
        Some(slope) if slope != OVERLAP_SLOPE && !resolve::has_slope(case) => Err(idle(
            "air.wake_overlap_slope",
            "without algebraic cores of the wake, as wide as air.wake_overlap (above 0) has them",
            "with air.wake_core = algebraic and an air.wake_overlap above 0",
        )),
        slope => Ok(slope.unwrap_or(OVERLAP_SLOPE)),
    }
}

/// What the lattice refuses, at the key it is about.
fn refused(case: &AirCase, error: &AirError) -> Fault {
    if let AirError::WindThroughPlane { part } = error {
        return Fault::new(
            key_of(part),
            format!("the {part} blows through the ground (air.ground)"),
            "air that goes along the ground: none goes through it",
            "take the part along the normal of the ground away, or remove air.ground",
        );
    }
    let AirError::Setting {
        key,
        value,
        allowed,
    } = error
    else {
        return Fault::new("air", error.to_string(), "", "correct the air");
    };
    let in_chords = case.wake_blob_length_chords.is_some();
    let (key, unit) = match key_of(key) {
        "air.wake_blob_length_m" if in_chords => ("air.wake_blob_length_chords", " m"),
        key => (key, ""),
    };
    Fault::new(
        key,
        format!("{value}{unit} does not fit {}", beside(case, key)),
        *allowed,
        match key {
            "air.loads" => {
                "air.loads = \"joukowski\", or another air.leading_edge than vortex_lift"
            }
            "air.plane_wakes" => {
                "leave tip and root out of air.shed, and air.particles and air.wake_blob_length_m out; or air.plane_wakes = false"
            }
            _ => "change this key or the one it does not fit",
        },
    )
}

/// What the value of `key` does not fit: the other key with its value, where it is one.
fn beside(case: &AirCase, key: &str) -> String {
    let leading = || {
        let value = toml::Value::try_from(case.leading_edge);
        value.map_or_else(
            |_| "air.leading_edge".to_owned(),
            |v| format!("air.leading_edge = {v}"),
        )
    };
    match key {
        "air.loads" => leading(),
        "air.max_wake_rows" | "air.plane_wakes" if case.particles.is_some() => {
            "air.particles".to_owned()
        }
        "air.max_wake_rows" if case.max_wake_rows == Some(1) => leading(),
        _ => "the other settings".to_owned(),
    }
}

/// The key of a case that a setting of the lattice comes from.
pub(crate) fn key_of(setting: &str) -> &'static str {
    match setting {
        "density" => "air.density_kg_m3",
        "shedding" => "air.shed",
        "free_stream" | "stream" => "air.stream_m_s",
        "bound_core" => "air.bound_core",
        "wake_core" => "air.wake_core",
        "wake_overlap" => "air.wake_overlap",
        "overlap_slope" => "air.wake_overlap_slope",
        "wake_blob_length" => "air.wake_blob_length_m",
        "max_displacement" => "air.max_displacement_m",
        "plane_wakes" => "air.plane_wakes",
        "clearance" => "air.clearance_m",
        "max_age" => "air.max_wake_age_s",
        "max_distance" => "air.max_wake_distance_m",
        "max_rows" => "air.max_wake_rows",
        "inset" => "air.ring_inset",
        "summation" => "air.summation",
        "summation tolerance" => "air.summation_tolerance",
        "images" => "air.ground",
        "particles leading_at_once" => "air.particles.leading_edge",
        name if name.starts_with("particles") => "air.particles",
        name if name.starts_with("section drag") => "air.section_drag",
        "loads" => "air.loads",
        name if name.starts_with("leading") => "air.leading_edge",
        name => wind::key_of(name).unwrap_or("air"),
    }
}

/// The core of the surfaces, which do not age: its viscosity is that of the wakes, which no case needs to give.
fn bound_core(chord: &Chord, case: &CoreCase, wake_core: CoreModel) -> Built<CoreModel> {
    let spreading = wake_core.viscosity().unwrap_or(0.0);
    let mut case = case.clone();
    let (name, core) = match &mut case {
        CoreCase::LambOseen(core) => ("lamb_oseen", core),
        CoreCase::Algebraic(core) => ("algebraic", core),
        _ => return chord.core("air.bound_core", &case, spreading),
    };
    let own = core.viscosity_m2_s.replace(spreading);
    let Some(own) = own.filter(|own| *own != spreading) else {
        return chord.core("air.bound_core", &case, spreading);
    };
    let (allowed, remedy) = match wake_core.viscosity() {
        Some(of_wakes) => (
            format!("the {of_wakes} of air.wake_core, or none"),
            "give the viscosity of the air in air.wake_core",
        ),
        None => (
            "none".to_owned(),
            "remove it; friction takes that of air.section_drag.viscosity_m2_s",
        ),
    };
    Err(Fault::new(
        format!("air.bound_core.{name}.viscosity_m2_s"),
        format!("{own} has no effect: filaments on surfaces do not age"),
        allowed,
        remedy,
    ))
}

/// Drag of the sections in air of this viscosity; friction if nothing is said.
fn section_drag(
    case: Option<SectionDragCase>,
    viscosity: Option<f64>,
) -> Built<Option<SectionDrag>> {
    let Some(case) = case else {
        return Ok(viscosity.map(|viscosity| SectionDrag {
            friction: Friction::Blasius { viscosity },
            ..SectionDrag::NONE
        }));
    };
    let friction = match (case.friction, case.viscosity_m2_s.or(viscosity)) {
        (FrictionCase::None, _) => Friction::None,
        (FrictionCase::Blasius, Some(viscosity)) => Friction::Blasius { viscosity },
        (FrictionCase::Blasius, None) => {
            return Err(Fault::new(
                "air.section_drag.viscosity_m2_s",
                "the friction needs the viscosity of the air, and air.wake_core has none",
                "a finite number > 0",
                "1.5e-5 for air at sea level, here or as air.viscosity_m2_s; friction = \"none\" leaves friction out",
            ));
        }
    };
    let drag = SectionDrag {
        friction,
        cd0: case.cd0,
        cd2: case.cd2_per_rad2,
    };
    Ok(Some(drag).filter(|d| *d != SectionDrag::NONE))
}

/// The separation criterion with the threshold it needs.
fn leading_edge(case: &AirCase) -> Built<LeadingEdge> {
    Ok(match case.leading_edge {
        _ if !case.shed.contains(&EdgeKind::Leading) => LeadingEdge::default(),
        LeadingEdgeCase::Never => LeadingEdge::Never,
        LeadingEdgeCase::Always => LeadingEdge::Always,
        LeadingEdgeCase::AngleOfAttack => {
            let threshold = case.leading_edge_threshold_deg.ok_or_else(|| {
                Fault::new(
                    "air.leading_edge_threshold_deg",
                    "air.leading_edge needs this threshold, which has no default",
                    "a finite number > 0",
                    "give a threshold that fits wing section and Reynolds number",
                )
            })?;
            LeadingEdge::AngleOfAttack {
                threshold: threshold.to_radians(),
            }
        }
        LeadingEdgeCase::Suction => LeadingEdge::Suction {
            threshold: case.leading_edge_threshold,
            efficiency: case.leading_edge_suction_efficiency,
        },
        LeadingEdgeCase::SuctionImplicit => LeadingEdge::SuctionImplicit {
            threshold: case.leading_edge_threshold,
            efficiency: case.leading_edge_suction_efficiency,
        },
        LeadingEdgeCase::VortexLift => LeadingEdge::VortexLift(VortexLift {
            threshold: case.leading_edge_threshold,
            efficiency: case.leading_edge_suction_efficiency,
            formation: case.leading_edge_formation_chords,
        }),
    })
}

/// Particles; radius and viscosity are those of the wake's filaments where left out, unless these
/// are as wide as they are long.
fn particles(
    case: &ParticlesCase,
    air: &AirCase,
    chord: &Chord,
    wake_core: CoreModel,
) -> Built<ParticleSettings> {
    let (radius, viscosity) = match wake_core {
        CoreModel::LambOseen { radius, viscosity } | CoreModel::Algebraic { radius, viscosity } => {
            (Some(radius), viscosity)
        }
        CoreModel::Vatistas { radius } | CoreModel::Scully { radius } => (Some(radius), 0.0),
        CoreModel::CutOff { .. } => (None, 0.0),
    };
    let own = chord.length("air.particles.radius", case.radius_m, case.radius_chords)?;
    let default = radius.filter(|_| air.wake_overlap.value() == 0.0);
    let radius = own.or(default).ok_or_else(|| {
        Fault::new(
            "air.particles",
            "particles need a radius, and wake_core has none or wake_overlap widens it",
            "radius_m or radius_chords, > 0",
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
    Ok(ParticleSettings {
        after: case.after_rows,
        leading_at_once: case.leading_edge,
        radius,
        viscosity: case.viscosity_m2_s.unwrap_or(viscosity),
        stretching: case.stretching,
    })
}
