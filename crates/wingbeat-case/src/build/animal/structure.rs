//! `[wing.NAME.structure]`.

use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::structure::Damping;
use wingbeat_model::{
    BeamMass, Coupling, Members, ModelError, Region, Vein, VeinStiffness, Wing, WingBeam,
    WingShell, WingStructure,
};

use crate::build::fault::{Built, fault_at};
use crate::build::numbers::{symmetric, vector};
use crate::error::Fault;
use crate::raw::{
    BeamCase, BeamMassCase, RegionCase, ShellCase, ShellRule, StructureCase, VeinCase,
};
use crate::text::path::find;
use crate::text::source::table_of;

/// Elements of a beam where nothing is said.
const ELEMENTS: usize = 10;

/// Makes `wing` of what the table `[path]` says.
pub(crate) fn make(wing: Wing, path: &str, case: &StructureCase) -> Built<Wing> {
    let members = match (&case.beam, &case.shell) {
        (Some(beam), _) => Members::Beam(self::beam(&format!("{path}.beam"), beam)?),
        (None, Some(shell)) => {
            let (table, path) = (path, format!("{path}.shell"));
            check_clamps(&path, shell, [wing.mesh.rows, wing.mesh.cols])?;
            let sheet = match shell.rule {
                Some(ShellRule::CombesDaniel) if shell.density_kg_m3.is_some() => {
                    return Err(Fault::new(
                        format!("{path}.density_kg_m3"),
                        "the rule takes the thickness of the sheet from the mass of the wing, and this would give that from the thickness",
                        "the wing's mass_kg beside rule, or thickness_m and young_pa beside density_kg_m3",
                        "remove it and give the wing mass_kg",
                    ));
                }
                Some(ShellRule::CombesDaniel) => {
                    let (report, mass) = (wing.report(), wing.mass.mass);
                    let sizes = [report.length, report.area, mass];
                    WingShell::combes_daniel(sizes, shell.poisson)
                }
                None => self::shell(&path, shell)?,
            };
            Members::Shell(WingShell {
                regions: regions(table, case, shell)?,
                veins: veins(table, case)?,
                ..edges(sheet, shell)
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
    wing.made_of(structure).map_err(|e| traced(path, case, &e))
}

/// A fault of the model traced to the table it is about; a number of a law is one along the span.
fn traced(path: &str, case: &StructureCase, error: &ModelError) -> Fault {
    let fault = traced_to_key(path, case, error);
    let whole = table_of(case);
    let inside = fault
        .key
        .strip_prefix(path)
        .and_then(|k| k.strip_prefix('.'));
    let rows = inside
        .and_then(|k| find(&whole, k))
        .and_then(toml::Value::as_array);
    let (ModelError::Value { value, .. }, true, Some(rows)) =
        (error, fault.key.contains("_table_"), rows)
    else {
        return fault;
    };
    let is_low = |row: &toml::Value| {
        let second = row.as_array().and_then(|r| r.get(1));
        second.is_some_and(|x| x.as_float().or(x.as_integer().map(|n| n as f64)) <= Some(0.0))
    };
    let row = rows.iter().position(is_low);
    Fault {
        key: row.map_or(fault.key.clone(), |k| format!("{}[{k}]", fault.key)),
        problem: format!(
            "along the span it comes to {value}: must be {}",
            fault.allowed
        ),
        remedy: "correct this row".to_owned(),
        ..fault
    }
}

fn traced_to_key(path: &str, case: &StructureCase, error: &ModelError) -> Fault {
    let key = match error {
        ModelError::Value { key, .. } | ModelError::Count { key, .. } => key,
        ModelError::Table {
            table,
            row,
            problem,
        } => return of_row(path, case, table, *row, problem),
        _ => return fault_at(path, case, error),
    };
    let table = key.rsplit('.').nth(1).unwrap_or_default();
    let (root, path) = (path, format!("{path}.{table}"));
    let number = |list: &str| {
        let inside = table.strip_prefix(list)?.strip_prefix('[')?;
        inside.strip_suffix(']')?.parse::<usize>().ok()
    };
    let vein = number("vein").and_then(|k| case.vein.get(k));
    let region = number("region").and_then(|k| case.region.get(k));
    let lump = number("mass").and_then(|k| case.beam.as_ref()?.mass.get(k));
    if let Some(lump) = lump {
        return fault_at(&format!("{root}.beam.{table}"), lump, error);
    }
    match (table, vein, region, &case.beam, &case.shell) {
        (_, Some(vein), ..) => fault_at(&path, vein, error),
        (_, _, Some(region), ..) => fault_at(&path, region, error),
        ("beam", .., Some(beam), _) => fault_at(&path, beam, error),
        ("shell", .., Some(shell)) => fault_at(&path, shell, error),
        _ => fault_at(root, case, error),
    }
}

/// A fault of a row, counted from 1, of a table that the model calls `table`, at the key that gives it.
fn of_row(path: &str, case: &StructureCase, table: &str, row: usize, problem: &str) -> Fault {
    let inside = table
        .rsplit_once("structure.")
        .map_or(table, |(_, name)| name);
    let inside = inside.strip_suffix(".table").unwrap_or(inside);
    let (holder, stem) = inside.rsplit_once('.').unwrap_or(("", inside));
    let whole = table_of(case);
    let keys = find(&whole, holder).and_then(toml::Value::as_table);
    let begins = |key: &&String| key.starts_with(&format!("{stem}_table"));
    let key = keys.and_then(|t| t.keys().find(begins));
    let key = match key {
        Some(key) => format!("{path}.{holder}.{key}[{}]", row.saturating_sub(1)),
        None => path.to_owned(),
    };
    Fault::new(
        key,
        problem,
        "rows [r/R, value] from the root, or farther in, to the tip: r/R rises to 1, the distance from the hinge over the wing length",
        "correct this row, or add the rows that are missing",
    )
}

fn beam(path: &str, case: &BeamCase) -> Built<WingBeam> {
    let flap = law(
        path,
        "flap",
        "newton_m2",
        (case.flap_newton_m2, case.flap_table_newton_m2.as_ref()),
    )?;
    let mass = (case.mass_kg_per_m, case.mass_table_kg_per_m.as_ref());
    Ok(WingBeam {
        axis_fraction: case.axis_fraction,
        elements: case.elements.unwrap_or(ELEMENTS),
        stations: case.stations.clone(),
        flap,
        lag: given((case.lag_newton_m2, case.lag_table_newton_m2.as_ref())),
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
        shear: given((case.shear_newton, case.shear_table_newton.as_ref())),
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
    let missing = || {
        let key = format!("{path}.young_pa");
        Fault::missing(key, "a number above 0", "3e9 is that of cuticle")
    };
    let young = case.young_pa.ok_or_else(missing)?;
    let thickness = (case.thickness_m, case.thickness_table_m.as_ref());
    let thickness = law(path, "thickness", "m", thickness)?;
    let young = [young, case.young_chord_pa.unwrap_or(young)];
    Ok(WingShell {
        shear: case.shear_pa,
        ..WingShell::solid(young, case.poisson, thickness)
    })
}

/// Refuses a root that is free on a perimeter that is clamped, a perimeter that all nodes lie on, and a leading
/// edge that is held anyway.
fn check_clamps(path: &str, case: &ShellCase, [rows, cols]: [usize; 2]) -> Built<()> {
    if case.clamped_perimeter && rows.min(cols) < 2 {
        return Err(Fault::new(
            format!("{path}.clamped_perimeter"),
            format!("true: every node of {rows} x {cols} panels lies on the perimeter"),
            "true on meshes of 2 x 2 panels or more",
            "refine mesh.chordwise or mesh.spanwise of this wing",
        ));
    }
    let holds = [
        (case.clamped_perimeter, "clamped_perimeter"),
        (case.rigid_fraction > 0.0, "rigid_fraction"),
    ];
    if let (true, Some((_, key))) = (case.clamped_leading_edge, holds.iter().find(|h| h.0)) {
        return Err(Fault::new(
            format!("{path}.clamped_leading_edge"),
            format!("true has no effect: {key} holds the leading edge"),
            format!("false beside {key}"),
            "remove one of the two",
        ));
    }
    match case.clamped_perimeter && !case.clamped_root {
        true => Err(Fault::new(
            format!("{path}.clamped_root"),
            "false: the root is part of the perimeter, which is clamped",
            "true, or clamped_perimeter = false",
            "remove one of the two",
        )),
        false => Ok(()),
    }
}

/// The same with mass, fibres, tension and what is clamped as the case says.
fn edges(wing: WingShell, case: &ShellCase) -> WingShell {
    WingShell {
        stretching: case.stretching_young_pa.or(wing.stretching),
        density: case.density_kg_m3,
        fibre_angle: case.fibre_angle_deg.to_radians(),
        prestress: case.prestress_newton_per_m,
        bending_factor: case.bending_factor,
        clamps_root: case.clamped_root,
        clamps_leading_edge: case.clamped_leading_edge,
        clamps_perimeter: case.clamped_perimeter,
        rigid_fraction: case.rigid_fraction,
        ..wing
    }
}

fn regions(path: &str, case: &StructureCase, shell: &ShellCase) -> Built<Vec<Region>> {
    let region = |(k, g): (usize, &RegionCase)| {
        if g.density_kg_m3.is_some() && shell.density_kg_m3.is_none() {
            return Err(Fault::new(
                format!("{path}.region[{k}].density_kg_m3"),
                "this has no effect: the mass of the wing is spread evenly over its area",
                "a region's density beside that of the shell",
                format!("remove it, or give {path}.shell.density_kg_m3"),
            ));
        }
        if *g
            == (RegionCase {
                span_range: g.span_range,
                chord_range: g.chord_range,
                ..RegionCase::default()
            })
        {
            return Err(Fault::new(
                format!("{path}.region[{k}]"),
                "this region is made of the same as the rest",
                "a region with a modulus, thickness, density, direction of fibres or tension of its own",
                "remove it, or say what is different there",
            ));
        }
        let across = |y: f64| [y, g.young_chord_pa.unwrap_or(y)];
        Ok(Region {
            span: g.span_range,
            chord: g.chord_range,
            young: g.young_pa.map(across),
            poisson: g.poisson,
            shear: g.shear_pa,
            thickness: g.thickness_m,
            density: g.density_kg_m3,
            fibre_angle: g.fibre_angle_deg.map(f64::to_radians),
            prestress: g.prestress_newton_per_m,
        })
    };
    case.region.iter().enumerate().map(region).collect()
}

fn veins(path: &str, case: &StructureCase) -> Built<Vec<Vein>> {
    let vein = |(k, v): (usize, &VeinCase)| {
        let missing = |key: &str, allowed: &str, remedy: &str| {
            Fault::missing(format!("{path}.vein[{k}].{key}"), allowed, remedy)
        };
        let stiffness = match (v.young_pa, v.bending_newton_m2, v.torsion_newton_m2) {
            (Some(young), _, _) => VeinStiffness::Solid {
                young,
                shear: v.shear_pa,
            },
            (None, Some(bending), Some(torsion)) => VeinStiffness::Given { bending, torsion },
            _ => {
                let allowed = "young_pa, or bending_newton_m2 with torsion_newton_m2";
                let remedy = "give the modulus of a solid bar, or what was measured";
                return Err(missing("young_pa", allowed, remedy));
            }
        };
        let allowed = "radius_m = [at its beginning, at its end]";
        let remedy = "for flat bars the radius of a round one of the same area";
        Ok(Vein {
            from: v.from,
            to: v.to,
            radius: (v.radius_m).ok_or_else(|| missing("radius_m", allowed, remedy))?,
            stiffness,
            density: v.density_kg_m3,
            is_clamped: v.clamped,
        })
    };
    case.vein.iter().enumerate().map(vein).collect()
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
        Fault::missing(
            format!("{path}.{name}_{unit}"),
            format!("{name}_{unit} = [value at the root, value at the tip] or {name}_table_{unit}"),
            "give the stiffness along the span",
        )
    })
}

/// The key that gives a structure a mass of its own, if one does.
pub(crate) fn own_mass(case: &StructureCase) -> Option<&'static str> {
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
