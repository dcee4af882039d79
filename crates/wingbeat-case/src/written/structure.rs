//! What a wing is made of.

use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::{
    BeamMass, Members, Region, Vein, VeinStiffness, WingBeam, WingShell, WingStructure,
};

use super::motion::span;
use crate::raw::{BeamCase, BeamMassCase, RegionCase, ShellCase, StructureCase, VeinCase};

/// A structure.
pub(super) fn case(structure: &WingStructure) -> StructureCase {
    let WingStructure {
        members,
        damping,
        spectral_radius,
    } = structure;
    let (beam, shell) = match members {
        Members::Beam(beam) => (Some(beam_case(beam)), None),
        Members::Shell(shell) => (None, Some(shell_case(shell))),
    };
    let (vein, region) = match members {
        Members::Beam(_) => (vec![], vec![]),
        Members::Shell(shell) => (
            shell.veins.iter().map(vein_case).collect(),
            shell.regions.iter().map(region_case).collect(),
        ),
    };
    StructureCase {
        rigid: false,
        beam,
        shell,
        vein,
        region,
        damping_s: damping.strain_rate,
        mass_damping_per_s: damping.mass,
        spectral_radius: *spectral_radius,
    }
}

/// Whether it has a mass of its own.
pub(super) fn has_mass(structure: &WingStructure) -> bool {
    match &structure.members {
        Members::Beam(beam) => beam.mass.is_some(),
        Members::Shell(shell) => shell.density.is_some(),
    }
}

fn shell_case(shell: &WingShell) -> ShellCase {
    let WingShell {
        young: [young, young_chord],
        poisson,
        shear,
        stretching,
        thickness,
        density,
        fibre_angle,
        prestress,
        bending_factor,
        regions: _,
        veins: _,
        clamps_root,
        clamps_leading_edge,
        clamps_perimeter,
        rigid_fraction,
    } = shell;
    let (thickness_m, thickness_table_m) = span(thickness, |x| x);
    ShellCase {
        rule: None,
        young_pa: Some(*young),
        young_chord_pa: Some(*young_chord),
        poisson: *poisson,
        shear_pa: *shear,
        stretching_young_pa: *stretching,
        thickness_m,
        thickness_table_m,
        density_kg_m3: *density,
        fibre_angle_deg: fibre_angle.to_degrees(),
        prestress_newton_per_m: *prestress,
        bending_factor: *bending_factor,
        clamped_root: *clamps_root,
        clamped_leading_edge: *clamps_leading_edge,
        clamped_perimeter: *clamps_perimeter,
        rigid_fraction: *rigid_fraction,
    }
}

fn region_case(region: &Region) -> RegionCase {
    RegionCase {
        span_range: region.span,
        chord_range: region.chord,
        young_pa: region.young.map(|[along, _]| along),
        young_chord_pa: region.young.map(|[_, across]| across),
        poisson: region.poisson,
        shear_pa: region.shear,
        thickness_m: region.thickness,
        density_kg_m3: region.density,
        fibre_angle_deg: region.fibre_angle.map(f64::to_degrees),
        prestress_newton_per_m: region.prestress,
    }
}

fn vein_case(vein: &Vein) -> VeinCase {
    let (young_pa, shear_pa, bending_newton_m2, torsion_newton_m2) = match vein.stiffness {
        VeinStiffness::Solid { young, shear } => (Some(young), shear, None, None),
        VeinStiffness::Given { bending, torsion } => (None, None, Some(bending), Some(torsion)),
    };
    VeinCase {
        from: vein.from,
        to: vein.to,
        radius_m: Some(vein.radius),
        young_pa,
        shear_pa,
        bending_newton_m2,
        torsion_newton_m2,
        density_kg_m3: vein.density,
        clamped: vein.is_clamped,
    }
}

fn beam_case(beam: &WingBeam) -> BeamCase {
    let WingBeam {
        axis_fraction,
        elements,
        stations,
        flap,
        lag,
        torsion,
        axial,
        shear,
        coupling,
        mass,
        mass_fraction,
        inertia,
        masses,
    } = beam;
    let plain = |law: &SpanLaw| span(law, |x| x);
    let (flap_newton_m2, flap_table_newton_m2) = plain(flap);
    let (lag_newton_m2, lag_table_newton_m2) = lag.as_ref().map(plain).unwrap_or_default();
    let (torsion_newton_m2, torsion_table_newton_m2) = plain(torsion);
    let (axial_newton, axial_table_newton) = axial.as_ref().map(plain).unwrap_or_default();
    let (shear_newton, shear_table_newton) = shear.as_ref().map(plain).unwrap_or_default();
    let (mass_kg_per_m, mass_table_kg_per_m) = mass.as_ref().map(plain).unwrap_or_default();
    let (inertia_kg_m, inertia_table_kg_m) = inertia.as_ref().map(plain).unwrap_or_default();
    BeamCase {
        axis_fraction: *axis_fraction,
        elements: stations.is_none().then_some(*elements),
        stations: stations.clone(),
        flap_newton_m2,
        flap_table_newton_m2,
        lag_newton_m2,
        lag_table_newton_m2,
        torsion_newton_m2,
        torsion_table_newton_m2,
        axial_newton,
        axial_table_newton,
        shear_newton,
        shear_table_newton,
        coupling_table_newton_m_m2: coupling.0.iter().map(row).collect(),
        mass_kg_per_m,
        mass_table_kg_per_m,
        mass_fraction: *mass_fraction,
        inertia_kg_m,
        inertia_table_kg_m,
        mass: masses.iter().map(lumped).collect(),
    }
}

fn row(&(r, [a, b, c, d, e, f]): &(f64, [f64; 6])) -> [f64; 7] {
    [r, a, b, c, d, e, f]
}

fn lumped(mass: &BeamMass) -> BeamMassCase {
    let j = mass.inertia.to_cols_array();
    BeamMassCase {
        at: mass.at,
        mass_kg: mass.mass,
        offset_m: mass.offset.to_array(),
        inertia_about_centre_kg_m2: [j[0], j[4], j[8], j[1], j[2], j[5]],
    }
}
