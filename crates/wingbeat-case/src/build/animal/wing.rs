//! `[wing.NAME]`: planform, mesh, mass, hinge; pairs by mirror symmetry.

use wingbeat_dynamics::Joint;
use wingbeat_flight::setup::carriers;
use wingbeat_math::DVec3;
use wingbeat_model::planform::{Beta, ChordSize, Planform, WingShape};
use wingbeat_model::{
    Animal, GridMesh, MassInput, ModelError, Side, Spacing, Wing, WingMotion, mirror_name,
    side_in_name,
};

use crate::build::animal::hinge::hinge;
use crate::build::animal::{deformation, motion, structure};
use crate::build::fault::{Built, fault_at};
use crate::build::numbers::{given_mass, symmetric, vector};
use crate::error::Fault;
use crate::motion::carrier::rides_on_wing;
use crate::motion::own_motion::takes;
use crate::raw::{
    BetaCase, Case, OutlineCase, PlanformCase, RectangleCase, StructureCase, WingCase, WingMeshCase,
};
use crate::text::nearest::nearest;

/// All wings in the order of their names, mirror images among them, without the adjustments of the case.
pub(crate) fn build_all(case: &Case) -> Built<Vec<Wing>> {
    let mut wings = vec![];
    for (name, own) in &case.wing {
        let side = side(case, name, own)?;
        let counterpart = mirror_name(name).and_then(|n| case.wing.get_key_value(&n));
        wings.push(build(case, name, side, own, counterpart)?);
        let image =
            mirror_name(name).filter(|_| own.mirror.unwrap_or(true) && counterpart.is_none());
        if let Some(other) = image {
            wings.push(wings[wings.len() - 1].mirrored(&other));
        }
    }
    wings.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(wings)
}

/// Adjusts the wings of the flyer with these joints that it steers: tails and wings on wings stay as they are.
pub(crate) fn adjust(case: &Case, animal: &mut Animal, joints: &[Joint]) -> Result<(), ModelError> {
    let is_adjusted = |w: usize| carriers::is_adjusted(animal, joints, w);
    let adjusted: Vec<bool> = (0..animal.wings.len()).map(is_adjusted).collect();
    let wings = animal.wings.iter_mut().zip(adjusted);
    for wing in wings.filter(|(_, is_adjusted)| *is_adjusted).map(|w| w.0) {
        wing.motion = motion::adjusted(case, &wing.motion, wing.side);
        wing.motion.check(&wing.name)?;
    }
    Ok(())
}

/// The wing of the case a wing of the animal was made from.
pub(crate) fn source_of(case: &Case, wing: &str) -> String {
    match mirror_name(wing) {
        Some(counterpart)
            if case.wing.contains_key(&counterpart)
                && case.wing.get(wing).is_none_or(|w| w.hinge_m.is_none()) =>
        {
            counterpart
        }
        _ => wing.to_owned(),
    }
}

fn side(case: &Case, name: &str, own: &WingCase) -> Built<Side> {
    match own.side {
        Some(side) => Ok(side),
        None => side_in_name(name).ok_or_else(|| no_side(case, name)),
    }
}

fn no_side(case: &Case, name: &str) -> Fault {
    let [left, right] = ["left", "right"].map(|side| name.contains(side));
    let others = case.wing.keys().map(String::as_str).filter(|n| *n != name);
    let near = nearest(name, &others.collect::<Vec<_>>()).filter(|_| !left && !right);
    let remedy = match near {
        Some(other) => format!("did you mean wing.{other}?"),
        None => "add `side = \"right\"`, or call the wing e.g. `fore-right`: left or right as one word of its name, and not both".to_owned(),
    };
    Fault::new(
        format!("wing.{name}.side"),
        "this key is missing and the name does not tell the side",
        "left, right",
        remedy,
    )
}

/// A key's value from the wing itself or, mirrored, from its counterpart.
struct Source<'a> {
    name: &'a str,
    own: &'a WingCase,
    counterpart: Option<(&'a String, &'a WingCase)>,
}

impl<'a> Source<'a> {
    /// The wing that has the key, its name, and whether it is the counterpart.
    fn of(&self, has: impl Fn(&WingCase) -> bool) -> (&'a str, &'a WingCase, bool) {
        match self.counterpart {
            Some((name, counterpart)) if !has(self.own) && has(counterpart) => {
                (name, counterpart, true)
            }
            _ => (self.name, self.own, false),
        }
    }
}

fn build(
    case: &Case,
    name: &str,
    side: Side,
    own: &WingCase,
    counterpart: Option<(&String, &WingCase)>,
) -> Built<Wing> {
    let source = Source {
        name,
        own,
        counterpart,
    };
    let mesh = mesh(&source, side)?;
    let mass = mass(&source)?;
    let law = motion_of(case, &source, side)?;
    let path = format!("wing.{name}");
    let wing = Wing::with_mesh(name, side, hinge(case, name)?, mesh, &mass, law);
    let wing = wing.map_err(|e| fault_of_wing(&path, &source, &e))?;
    let (from, deformed, _) = source.of(|w| w.deformation.is_some());
    let wing = match &deformed.deformation {
        Some(case) => deformation::deform(wing, &format!("wing.{from}.deformation"), case)?,
        None => wing,
    };
    let (from, made, _) = source.of(|w| w.structure.is_some());
    match &made.structure {
        Some(case) if case.rigid => {
            check_rigid(&source, case)?;
            Ok(wing)
        }
        Some(case) => {
            check_mass_of_structure(&source, case, wing.mass.mass)?;
            structure::make(wing, &format!("wing.{from}.structure"), case)
        }
        None => Ok(wing),
    }
}

/// The motion of the wing of this source, with what it takes from the mirror image of its counterpart.
fn motion_of(case: &Case, source: &Source<'_>, side: Side) -> Built<WingMotion> {
    if let (Some(own), Some((other, counterpart))) = (&source.own.motion, source.counterpart)
        && let Some(counterpart) = &counterpart.motion
    {
        let has_data = case.motion.data.is_some() && !rides_on_wing(case, source.name);
        motion::check_halves(has_data, (source.name, own), (other, counterpart))?;
    }
    let taken = source.counterpart.filter(|(_, counterpart)| {
        let there = counterpart.motion.as_ref();
        there.is_some_and(|there| takes(source.own.motion.as_ref(), there))
    });
    let base = taken.map(|(name, counterpart)| {
        Ok(motion::law(case, name, counterpart, side.other(), None)?.mirrored())
    });
    let base = base.transpose()?;
    motion::law(case, source.name, source.own, side, base.as_ref())
}

/// A wing is said to be rigid beside a counterpart that is not, and nothing else of it.
fn check_rigid(source: &Source<'_>, case: &StructureCase) -> Built<()> {
    let key = format!("wing.{}.structure", source.name);
    let plain = StructureCase {
        rigid: true,
        ..StructureCase::default()
    };
    if *case != plain {
        return Err(Fault::new(
            key,
            "a wing that is rigid is made of nothing that bends",
            "rigid = true alone",
            "remove the other keys of the structure, or rigid",
        ));
    }
    let other = source.counterpart.and_then(|(_, w)| w.structure.as_ref());
    match other.is_some_and(|s| !s.rigid) {
        true => Ok(()),
        false => Err(Fault::new(
            format!("{key}.rigid"),
            "true has no effect: its counterpart on the other side is not elastic",
            "true beside an elastic counterpart",
            "remove [wing.NAME.structure]: wings without one are rigid",
        )),
    }
}

/// A structure has the `mass` of the wing \[kg\] spread evenly, or its own.
fn check_mass_of_structure(source: &Source<'_>, made: &StructureCase, mass: f64) -> Built<()> {
    let (name, wing, taken) = source.of(has_mass);
    let has_own = structure::own_mass(made).is_some();
    if has_own && taken && source.own.structure.is_some() {
        return Ok(()); // the mass is the counterpart's alone
    }
    if !has_own && mass <= 0.0 {
        let key = match wing.areal_density_kg_m2 {
            Some(_) => "areal_density_kg_m2",
            None => "mass_kg",
        };
        return Err(Fault::new(
            format!("wing.{name}.{key}"),
            "what has no mass cannot vibrate",
            "above 0 beside a structure",
            "an insect's wing has 0.5 to 1 % of the body mass",
        ));
    }
    let other = [
        (
            "inertia_about_centre_kg_m2",
            wing.inertia_about_centre_kg_m2.is_some(),
        ),
        (
            "areal_density_table_m_kg_m2",
            wing.areal_density_table_m_kg_m2.is_some(),
        ),
    ];
    match other.into_iter().find(|(_, given)| *given) {
        None => Ok(()),
        Some((key, _)) => Err(Fault::new(
            format!("wing.{name}.{key}"),
            "this has no effect beside a structure, which has a mass of its own",
            "mass_kg, areal_density_kg_m2 or structure.beam.mass_kg_per_m",
            "remove it, or give structure.beam.mass_table_kg_per_m",
        )),
    }
}

/// Traces a fault of the model into planform, mesh, or the wing.
fn fault_of_wing(path: &str, source: &Source<'_>, error: &wingbeat_model::ModelError) -> Fault {
    let (name, wing, _) = source.of(|w| w.planform.is_some());
    let text = error.to_string();
    match &wing.planform {
        Some(planform) if text.contains("planform") => {
            let path = format!("wing.{name}.planform");
            match planform {
                PlanformCase::Beta(t) => fault_at(&format!("{path}.beta"), t, error),
                PlanformCase::Rectangle(t) => fault_at(&format!("{path}.rectangle"), t, error),
                PlanformCase::Outline(t) => fault_at(&format!("{path}.outline"), t, error),
                PlanformCase::NodesM(_) => fault_at(&path, planform, error),
            }
        }
        _ => fault_at(path, source.own, error),
    }
}

fn mesh(source: &Source<'_>, side: Side) -> Built<GridMesh> {
    let (name, wing, mirrored) = source.of(|w| w.planform.is_some());
    let path = format!("wing.{name}.planform");
    let Some(case) = &wing.planform else {
        return Err(Fault::missing(
            path,
            "planform.beta, planform.rectangle, planform.outline or planform.nodes_m",
            format!("add [wing.{name}.planform.beta] with length_m, mean_chord_m and r2_hat"),
        ));
    };
    let (_, wing, _) = source.of(|w| w.mesh.is_some());
    let planform = match case {
        // The mesh of the counterpart is that of another planform.
        PlanformCase::NodesM(rows) if source.own.mesh.is_none() => {
            let mesh = given_mesh(name, rows)?;
            return Ok(if mirrored { mesh.mirrored() } else { mesh });
        }
        PlanformCase::NodesM(_) => {
            return Err(Fault::new(
                format!("wing.{}.mesh", source.name),
                format!("this has no effect beside {path}.nodes_m, which is the mesh"),
                "beside other planforms, which it divides into panels",
                "remove it, or give the wing another planform",
            ));
        }
        PlanformCase::Beta(b) => beta(&format!("{path}.beta"), b)?,
        PlanformCase::Rectangle(r) => rectangle(r),
        PlanformCase::Outline(o) => outline(&format!("{path}.outline"), o)?,
    };
    let mesh = wing.mesh.clone().unwrap_or_else(WingMeshCase::default);
    let shape = WingShape {
        planform,
        rows: mesh.chordwise,
        cols: mesh.spanwise,
        chordwise: mesh.chordwise_spacing,
        spanwise: mesh.spanwise_spacing,
    };
    let path = format!("wing.{}", source.name);
    shape
        .mesh(source.name, side)
        .map_err(|e| fault_of_wing(&path, source, &e))
}

/// A mesh by its nodes.
fn given_mesh(name: &str, rows: &[Vec<[f64; 3]>]) -> Built<GridMesh> {
    let key = format!("wing.{name}.planform.nodes_m");
    let in_row = rows.first().map_or(0, Vec::len);
    let fault = |key: &str, problem: String| {
        let allowed = "at least two rows of at least two nodes [x, y, z], all rows alike, no panel without area";
        let remedy = "from the leading to the trailing edge, each row from the root to the tip";
        Fault::new(key, problem, allowed, remedy)
    };
    if let Some(row) = rows.iter().position(|row| row.len() != in_row) {
        let problem = format!("it has {} nodes, the first row {in_row}", rows[row].len());
        return Err(fault(&format!("{key}[{row}]"), problem));
    }
    let mesh = GridMesh {
        rows: rows.len().saturating_sub(1),
        cols: in_row.saturating_sub(1),
        nodes: rows.iter().flatten().map(|&x| vector(x)).collect(),
        columns: Spacing::Uniform,
    };
    mesh.check(name).map_err(|e| fault(&key, e.to_string()))?;
    Ok(mesh)
}

fn beta(path: &str, b: &BetaCase) -> Built<Planform> {
    Ok(Planform::Beta(Beta {
        length: b.length_m,
        size: chord_size(path, b)?,
        r2_hat: b.r2_hat,
        root_offset: b.root_offset_m,
        axis_fraction: b.axis_fraction,
        least_chord: b.least_chord,
    }))
}

fn rectangle(r: &RectangleCase) -> Planform {
    Planform::Rectangle {
        chord: r.chord_m,
        span: r.span_m,
        root_offset: r.root_offset_m,
        axis_fraction: r.axis_fraction,
    }
}

fn outline(path: &str, o: &OutlineCase) -> Built<Planform> {
    match (&o.leading_m, &o.trailing_m) {
        (Some(leading), Some(trailing)) => Ok(Planform::outline(leading, trailing, o.least_chord)),
        _ => Err(Fault::new(
            path,
            "an edge is missing",
            "leading_m and trailing_m, or file",
            "give both edges from root to tip, or the file of points around the wing",
        )),
    }
}

fn chord_size(path: &str, b: &BetaCase) -> Built<ChordSize> {
    match (b.mean_chord_m, b.area_m2, b.max_chord_m) {
        (Some(c), _, _) => Ok(ChordSize::Mean(c)),
        (_, Some(s), _) => Ok(ChordSize::Area(s)),
        (_, _, Some(c)) => Ok(ChordSize::Max(c)),
        (None, None, None) => Err(Fault::new(
            path,
            "the chord is missing",
            "one of mean_chord_m, area_m2, max_chord_m",
            "give the one that was measured",
        )),
    }
}

fn mass(source: &Source<'_>) -> Built<MassInput> {
    let (name, wing, mirrored) = source.of(has_mass);
    let path = format!("wing.{name}");
    let (_, made, _) = source.of(|w| w.structure.is_some());
    let own = made.structure.as_ref().and_then(structure::own_mass);
    if let Some(key) = own {
        // The mass of a counterpart is not taken where the structure has one.
        let is_given = has_mass(wing) && !(mirrored && source.own.structure.is_some());
        return match is_given {
            false => Ok(MassInput::Total(0.0)),
            true => Err(Fault::new(
                format!("wing.{}.structure.{key}", source.name),
                "the mass of the wing is given twice: here and for the wing",
                "one of them",
                format!("remove {path}.mass_kg (or areal_density_kg_m2)"),
            )),
        };
    }
    if !has_mass(wing) {
        return Err(Fault::new(
            format!("{path}.mass_kg"),
            "the wing has no mass",
            "mass_kg, areal_density_kg_m2 or areal_density_table_m_kg_m2 (0 for a massless wing); of an elastic one also structure.beam.mass_kg_per_m or structure.shell.density_kg_m3",
            "an insect's wing has 0.5 to 1 % of the body mass",
        ));
    }
    mass_input(&path, wing, mirrored)
}

fn has_mass(w: &WingCase) -> bool {
    w.mass_kg.is_some()
        || w.areal_density_kg_m2.is_some()
        || w.areal_density_table_m_kg_m2.is_some()
}

fn mass_input(path: &str, wing: &WingCase, mirrored: bool) -> Built<MassInput> {
    if let Some(d) = wing.areal_density_kg_m2 {
        return Ok(MassInput::Density(d));
    }
    if let Some(rows) = &wing.areal_density_table_m_kg_m2 {
        return Ok(MassInput::SpanTable(
            rows.iter().map(|&[r, d]| (r, d)).collect(),
        ));
    }
    let m = wing.mass_kg.unwrap_or_default();
    let Some([xx, yy, zz, xy, xz, yz]) = wing.inertia_about_centre_kg_m2 else {
        return Ok(MassInput::Total(m));
    };
    let [x, y, z] = wing.centre_m.unwrap_or_default();
    let s = if mirrored { -1.0 } else { 1.0 };
    let inertia = symmetric([xx, yy, zz, s * xy, xz, s * yz]);
    let given = given_mass(path, m, DVec3::new(x, s * y, z), inertia)?;
    Ok(MassInput::Given(given))
}
