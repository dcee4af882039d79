//! `[wing.NAME.structure]`.

use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::structure::Damping;
use wingbeat_model::{BeamMass, Coupling, Members, Wing, WingBeam, WingShell, WingStructure};

use super::fault::{Built, fault_at};
use super::numbers::{symmetric, vector};
use crate::error::Fault;
use crate::raw::{BeamCase, BeamMassCase, ShellCase, ShellRule, StructureCase};

/// In-plane over out-of-plane stiffness of a beam where nothing is said.
const LAG: f64 = 100.0;

/// Elements of a beam where nothing is said.
const ELEMENTS: usize = 10;

/// Makes `wing` of what the table `[path]` says.
pub(super) fn make(wing: Wing, path: &str, case: &StructureCase) -> Built<Wing> {
    let members = match (&case.beam, &case.shell) {
        (Some(beam), _) => Members::Beam(self::beam(&format!("{path}.beam"), beam)?),
        (None, Some(shell)) => {
            let path = format!("{path}.shell");
            Members::Shell(match shell.rule {
                Some(ShellRule::CombesDaniel) => {
                    let wing = {
                        let (report, mass) = (wing.report(), wing.mass.mass);
                        let sizes = [report.length, report.area, mass];
                        WingShell::combes_daniel(sizes, shell.poisson)
                    };
                    edges(wing, shell)
                }
                None => self::shell(&path, shell)?,
            })
        }
        (None, None) => {
            return Err(Fault::new(
                path,
                "the wing is made of nothing",
                "structure.beam or structure.shell",
                format!("add [{path}.beam] with flap_newton_m2 and torsion_newton_m2"),
            ));
        }
    };
    let structure = WingStructure {
        members,
        damping: Damping {
            strain_rate: case.damping_s,
            mass: case.mass_damping_per_s,
        },
        spectral_radius: case.spectral_radius,
    };
    wing.made_of(structure)
        .map_err(|e| fault_at(path, case, &e))
}

fn beam(path: &str, case: &BeamCase) -> Built<WingBeam> {
    let flap = law(
        path,
        "flap",
        "newton_m2",
        (case.flap_newton_m2, case.flap_table_newton_m2.as_ref()),
    )?;
    let lag = (case.lag_newton_m2, case.lag_table_newton_m2.as_ref());
    let mass = (case.mass_kg_per_m, case.mass_table_kg_per_m.as_ref());
    Ok(WingBeam {
        axis_fraction: case.axis_fraction,
        elements: case.elements.unwrap_or(ELEMENTS),
        stations: case.stations.clone(),
        lag: given(lag).unwrap_or_else(|| flap.scaled(LAG)),
        flap,
        torsion: law(
            path,
            "torsion",
            "newton_m2",
            (
                case.torsion_newton_m2,
                case.torsion_table_newton_m2.as_ref(),
            ),
        )?,
        axial: given((case.axial_newton, case.axial_table_newton.as_ref())),
        coupling: coupling(&case.coupling_table_newton_m_m2),
        mass: given(mass),
        masses: case.mass.iter().map(lumped).collect(),
        mass_fraction: case.mass_fraction,
        inertia: given((case.inertia_kg_m, case.inertia_table_kg_m.as_ref())),
    })
}

fn coupling(rows: &[[f64; 7]]) -> Coupling {
    let row = |&[r, a, b, c, d, e, f]: &[f64; 7]| (r, [a, b, c, d, e, f]);
    Coupling(rows.iter().map(row).collect())
}

fn lumped(case: &BeamMassCase) -> BeamMass {
    BeamMass {
        at: case.at,
        mass: case.mass_kg,
        offset: vector(case.offset_m),
        inertia: symmetric(case.inertia_about_centre_kg_m2),
    }
}

fn shell(path: &str, case: &ShellCase) -> Built<WingShell> {
    let missing = |key: &str, remedy: &str| {
        Fault::new(
            format!("{path}.{key}"),
            "this key is missing",
            "a number above 0",
            remedy,
        )
    };
    let young = (case.young_pa).ok_or_else(|| missing("young_pa", "3e9 is that of cuticle"))?;
    let thickness = (case.thickness_m, case.thickness_table_m.as_ref());
    let wing = WingShell {
        young: [young, case.young_chord_pa.unwrap_or(young)],
        poisson: case.poisson,
        shear: case.shear_pa,
        thickness: law(path, "thickness", "m", thickness)?,
        density: None,
        clamps_root: true,
        rigid_fraction: 0.0,
    };
    Ok(edges(wing, case))
}

/// The same with the mass and what is clamped as the case says.
fn edges(wing: WingShell, case: &ShellCase) -> WingShell {
    WingShell {
        density: case.density_kg_m3,
        clamps_root: case.clamped_root,
        rigid_fraction: case.rigid_fraction,
        ..wing
    }
}

type Values<'a> = (Option<[f64; 2]>, Option<&'a Vec<[f64; 2]>>);

fn given((linear, table): Values<'_>) -> Option<SpanLaw> {
    let rows = |rows: &Vec<[f64; 2]>| rows.iter().map(|&[r, v]| (r, v)).collect();
    match (linear, table) {
        (Some([root, tip]), _) => Some(SpanLaw::Linear { root, tip }),
        (None, Some(table)) => Some(SpanLaw::Table(rows(table))),
        (None, None) => None,
    }
}

fn law(path: &str, name: &str, unit: &str, values: Values<'_>) -> Built<SpanLaw> {
    given(values).ok_or_else(|| {
        Fault::new(
            format!("{path}.{name}_{unit}"),
            "this key is missing",
            format!("{name}_{unit} = [value at the root, value at the tip] or {name}_table_{unit}"),
            "give the stiffness along the span",
        )
    })
}

/// The key that gives a structure a mass of its own, if one does.
pub(super) fn own_mass(case: &StructureCase) -> Option<&'static str> {
    let beam = case.beam.as_ref();
    let linear = beam.is_some_and(|b| b.mass_kg_per_m.is_some());
    let table = beam.is_some_and(|b| b.mass_table_kg_per_m.is_some());
    let dense = case
        .shell
        .as_ref()
        .is_some_and(|s| s.density_kg_m3.is_some());
    let keys = [
        (linear, "beam.mass_kg_per_m"),
        (table, "beam.mass_table_kg_per_m"),
        (dense, "shell.density_kg_m3"),
    ];
    keys.into_iter()
        .find(|(given, _)| *given)
        .map(|(_, key)| key)
}
