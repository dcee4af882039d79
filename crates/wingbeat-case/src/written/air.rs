//! `[air]`.

use wingbeat_air::{
    AirSettings, CoreModel, EdgeKind, Friction, Gust, GustShape, LeadingEdge, Method, NewestRow,
    ParticleSettings, Plane, SectionDrag, SheddingKinds, Turbulence, VortexLift, VortexStreet,
    Wind,
};
use wingbeat_blade::{BladeSettings, Rotation, SETS, Translation, Unsteady};
use wingbeat_flight::{AirModel, AirOptions, BladeOptions};
use wingbeat_math::DVec3;

use super::refusal::{Written, no_keys};
use crate::raw::{
    AirCase, AirModel as Model, BladeCase, BodyDragCase, CoreCase, CutOffCase, FrictionCase,
    GroundCase, GustCase, LambOseenCase, LeadingEdgeCase, OwnCoefficients, ParticlesCase,
    RadiusCase, RotationCase, SchemeCase, SectionDragCase, TurbulenceCase, UnsteadyCase,
    ViscousCase, VortexStreetCase,
};

/// The air of the flight, lengths in metres.
pub(super) fn write(air: &AirModel) -> Written<AirCase> {
    match air {
        AirModel::None => Ok(AirCase {
            model: Model::None,
            ..AirCase::default()
        }),
        AirModel::BladeElement(options) => blade(options),
        AirModel::VortexLattice(options) => lattice(options),
        AirModel::Derivatives(_) | AirModel::External(_) | AirModel::Own(_) => Err(no_keys(
            format!("air ({})", air.name()),
            "it was made or changed in Rust, or the animal was",
            "write history and summary with `Run::write`",
        )),
    }
}

fn with_wind(case: AirCase, wind: &Wind) -> AirCase {
    let Wind {
        shear,
        gusts,
        street,
    } = wind;
    AirCase {
        shear_1_s: shear.map(|s| [0, 1, 2].map(|k| s.row(k).to_array())),
        gust: gusts.iter().map(gust).collect(),
        vortex_street: street.map(vortex_street),
        ..case
    }
}

fn vortex_street(street: VortexStreet) -> VortexStreetCase {
    let VortexStreet {
        circulation,
        spacing,
        width,
        concentration,
        drift,
        axis,
        point,
    } = street;
    VortexStreetCase {
        circulation_m2_s: circulation,
        spacing_m: spacing,
        width_m: Some(width),
        concentration,
        drift_m_s: drift.to_array(),
        axis: axis.to_array(),
        point_m: point.to_array(),
    }
}

fn gust(gust: &Gust) -> GustCase {
    let Gust {
        amplitude,
        start,
        slowness,
        shape,
    } = gust;
    let (duration_s, table, turbulence) = match shape {
        GustShape::OneMinusCosine { duration } => (Some(*duration), None, None),
        GustShape::Table(rows) => (None, Some(rows.clone()), None),
        GustShape::Turbulence(air) => {
            let Turbulence {
                spectrum,
                time_scale,
                seed,
                ..
            } = *air;
            let turbulence = TurbulenceCase {
                spectrum,
                time_scale_s: time_scale,
                seed,
            };
            (None, None, Some(turbulence))
        }
    };
    let front = (*slowness != DVec3::ZERO).then(|| *slowness / slowness.length_squared());
    GustCase {
        amplitude_m_s: amplitude.to_array(),
        start_s: *start,
        front_m_s: front.map(|u| u.to_array()),
        duration_s,
        table,
        turbulence,
    }
}

fn blade(options: &BladeOptions) -> Written<AirCase> {
    let BladeOptions {
        blade,
        body_drag,
        induced,
        wind,
        viscosity,
    } = options;
    let BladeSettings {
        density,
        free_stream,
        translation,
        centre_of_pressure,
        rotation,
        added_mass,
        viscous,
        unsteady,
    } = *blade;
    let (unsteady, states) = match unsteady {
        None => (UnsteadyCase::None, BladeCase::default().states),
        Some(Unsteady::Jones) => (UnsteadyCase::Jones, BladeCase::default().states),
        Some(Unsteady::Peters { states }) => (UnsteadyCase::Peters, states),
    };
    let (rotation, rotation_coefficient) = match rotation {
        Rotation::None => (RotationCase::None, None),
        Rotation::Circulation => (RotationCase::Circulation, None),
        Rotation::SaneDickinson => (RotationCase::SaneDickinson, None),
        Rotation::Coefficient(c) => (RotationCase::Circulation, Some(c)),
    };
    let case = BladeCase {
        rotation,
        rotation_coefficient,
        added_mass,
        centre_of_pressure,
        viscous: viscous.map(|v| ViscousCase {
            linear_hz: v.linear,
            quadratic: v.quadratic,
        }),
        body_drag: body_drag.map(|d| BodyDragCase {
            area_m2: d.area,
            along: d.along,
            across: d.across,
            centre_m: d.centre.map(|x| x.to_array()),
        }),
        unsteady,
        states,
        induced_m_s: induced.to_array(),
        ..coefficients(translation)?
    };
    let air = AirCase {
        model: Model::BladeElement,
        density_kg_m3: density,
        viscosity_m2_s: *viscosity,
        stream_m_s: free_stream.to_array(),
        blade: case,
        ..AirCase::default()
    };
    Ok(with_wind(air, wind))
}

fn coefficients(law: Translation) -> Written<BladeCase> {
    if let Some(set) = SETS.iter().find(|set| set.law == law) {
        return Ok(BladeCase {
            coefficients: set.name.to_owned(),
            ..BladeCase::default()
        });
    }
    match law {
        Translation::DoubleAngle {
            lift,
            drag_0,
            drag_90,
        } => Ok(BladeCase {
            own: Some(OwnCoefficients {
                lift,
                drag_0,
                drag_90,
            }),
            ..BladeCase::default()
        }),
        Translation::Harmonic { .. } | Translation::NormalTangential { .. } => Err(no_keys(
            "coefficients of the blade elements",
            "a law of this kind is written by the name of a shipped set, and none is this one",
            "take a shipped set, or `Translation::DoubleAngle`",
        )),
    }
}

fn lattice(options: &AirOptions) -> Written<AirCase> {
    let AirOptions {
        lattice,
        body_surfaces,
        mirror,
        joined: _, // keys of the wings
        joined_tips: _,
        has_own_viscosity,
    } = options;
    let air = AirCase {
        model: Model::VortexLattice,
        body: *body_surfaces,
        mirror: *mirror,
        loads: lattice.loads,
        ground: ground(&lattice.images)?,
        particles: lattice.particles.map(particles),
        section_drag: Some(section_drag(
            lattice.section_drag.unwrap_or(SectionDrag::NONE),
        )),
        ..settings(lattice)
    };
    let air = match has_own_viscosity {
        true => with_one_viscosity(air),
        false => air,
    };
    Ok(with_wind(with_leading_edge(air, lattice), &lattice.wind))
}

/// The viscosity of cores and friction as that of the fluid, where they have the same.
fn with_one_viscosity(mut air: AirCase) -> AirCase {
    let of_core = match &mut air.wake_core {
        CoreCase::LambOseen(core) | CoreCase::Algebraic(core) => Some(&mut core.viscosity_m2_s),
        _ => None,
    };
    let of_friction = air.section_drag.as_mut().map(|d| &mut d.viscosity_m2_s);
    let all = of_core.into_iter().chain(of_friction);
    let all: Vec<&mut Option<f64>> = all.filter(|v| v.is_some()).collect();
    let first = all.first().and_then(|v| **v);
    if all.iter().all(|v| **v == first) {
        air.viscosity_m2_s = first;
        all.into_iter().for_each(|v| *v = None);
    }
    air
}

fn settings(lattice: &AirSettings) -> AirCase {
    let AirSettings {
        density,
        free_stream,
        bound_core,
        wake_core,
        wake_overlap,
        overlap_slope,
        wake_blob_length,
        shedding,
        rate,
        max_rows,
        max_age,
        max_distance,
        max_displacement,
        clearance,
        plane_wakes,
        convection,
        newest_row,
        inset,
        summation,
        tolerance,
        // Keys of their own, see `lattice`.
        loads: _,
        leading: _,
        section_drag: _,
        wind: _,
        images: _,
        particles: _,
    } = *lattice;
    let default = AirCase::default();
    AirCase {
        density_kg_m3: density,
        stream_m_s: free_stream.to_array(),
        shed: shed(shedding),
        bound_core: without_viscosity(core(bound_core)),
        wake_core: core(wake_core),
        wake_overlap: wake_overlap.into(),
        wake_overlap_slope: (lattice.is_symmetric() && wake_overlap > 0.0).then_some(overlap_slope),
        wake_blob_length_m: wake_blob_length,
        scheme: match newest_row {
            NewestRow::Constant => SchemeCase::Benchmark,
            NewestRow::Matched => SchemeCase::Accurate,
        },
        circulation_rate: rate.into(),
        convection: convection.into(),
        ring_inset: inset.into(),
        max_wake_age_s: max_age,
        max_wake_distance_m: max_distance,
        max_wake_rows: max_rows,
        max_displacement_m: max_displacement,
        clearance_m: Some(clearance),
        plane_wakes,
        summation,
        summation_tolerance: match summation {
            Method::Direct => default.summation_tolerance, // without effect
            Method::Auto | Method::Single | Method::Tree | Method::Mesh => tolerance,
        },
        ..default
    }
}

/// The edges that shed.
fn shed(shedding: SheddingKinds) -> Vec<EdgeKind> {
    let edges = [
        (shedding.trailing, EdgeKind::Trailing),
        (shedding.tip, EdgeKind::Tip),
        (shedding.leading, EdgeKind::Leading),
        (shedding.root, EdgeKind::Root),
    ];
    let sheds = edges.into_iter().filter(|(sheds, _)| *sheds);
    sheds.map(|(_, edge)| edge).collect()
}

/// The core of surfaces, which do not age.
fn without_viscosity(mut case: CoreCase) -> CoreCase {
    if let CoreCase::LambOseen(core) | CoreCase::Algebraic(core) = &mut case {
        core.viscosity_m2_s = None;
    }
    case
}

fn core(model: CoreModel) -> CoreCase {
    let plain = |radius| RadiusCase {
        radius_m: Some(radius),
        ..RadiusCase::default()
    };
    let spreading = |radius, viscosity| LambOseenCase {
        radius_m: Some(radius),
        viscosity_m2_s: Some(viscosity),
        ..LambOseenCase::default()
    };
    match model {
        CoreModel::CutOff { delta } => CoreCase::CutOff(CutOffCase {
            length_m: Some(delta),
            ..CutOffCase::default()
        }),
        CoreModel::Vatistas { radius } => CoreCase::Vatistas(plain(radius)),
        CoreModel::Scully { radius } => CoreCase::Scully(plain(radius)),
        CoreModel::LambOseen { radius, viscosity } => {
            CoreCase::LambOseen(spreading(radius, viscosity))
        }
        CoreModel::Algebraic { radius, viscosity } => {
            CoreCase::Algebraic(spreading(radius, viscosity))
        }
    }
}

fn with_leading_edge(air: AirCase, lattice: &AirSettings) -> AirCase {
    let of = |leading_edge| AirCase {
        leading_edge,
        ..air.clone()
    };
    match lattice.leading {
        _ if !lattice.shedding.leading => air,
        LeadingEdge::Never => of(LeadingEdgeCase::Never),
        LeadingEdge::Always => of(LeadingEdgeCase::Always),
        LeadingEdge::AngleOfAttack { threshold } => AirCase {
            leading_edge_threshold_deg: Some(threshold.to_degrees()),
            ..of(LeadingEdgeCase::AngleOfAttack)
        },
        LeadingEdge::Suction {
            threshold,
            efficiency,
        } => AirCase {
            leading_edge_threshold: threshold,
            leading_edge_suction_efficiency: efficiency,
            ..of(LeadingEdgeCase::Suction)
        },
        LeadingEdge::SuctionImplicit {
            threshold,
            efficiency,
        } => AirCase {
            leading_edge_threshold: threshold,
            leading_edge_suction_efficiency: efficiency,
            ..of(LeadingEdgeCase::SuctionImplicit)
        },
        LeadingEdge::VortexLift(VortexLift {
            threshold,
            efficiency,
            formation,
        }) => AirCase {
            leading_edge_threshold: threshold,
            leading_edge_suction_efficiency: efficiency,
            leading_edge_formation_chords: formation,
            ..of(LeadingEdgeCase::VortexLift)
        },
    }
}

fn ground(images: &[Plane]) -> Written<Option<GroundCase>> {
    match images {
        [] => Ok(None),
        [Plane { point, normal }] => Ok(Some(GroundCase {
            point_m: point.to_array(),
            normal: normal.to_array(),
        })),
        _ => Err(no_keys(
            "planes of the air",
            format!("there are {}, and a case has one", images.len()),
            "leave one plane; mirror symmetry is `AirOptions::mirror`",
        )),
    }
}

fn particles(settings: ParticleSettings) -> ParticlesCase {
    let ParticleSettings {
        after,
        leading_at_once,
        radius,
        viscosity,
        stretching,
    } = settings;
    ParticlesCase {
        after_rows: after,
        leading_edge: leading_at_once,
        radius_m: Some(radius),
        radius_chords: None,
        viscosity_m2_s: Some(viscosity),
        stretching,
    }
}

fn section_drag(drag: SectionDrag) -> SectionDragCase {
    let (friction, viscosity_m2_s) = match drag.friction {
        Friction::None => (FrictionCase::None, None),
        Friction::Blasius { viscosity } => (FrictionCase::Blasius, Some(viscosity)),
    };
    SectionDragCase {
        friction,
        viscosity_m2_s,
        cd0: drag.cd0,
        cd2_per_rad2: drag.cd2,
    }
}
