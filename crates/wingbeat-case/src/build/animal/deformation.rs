//! `[wing.NAME.deformation]` and `wing.NAME.joined`.

use wingbeat_flight::{check_joined, check_joined_tip};
use wingbeat_model::deformation::{MovingSurface, SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{Animal, Deformation, ModelError, Wing, mirror_name};

use crate::build::fault::Built;
use crate::error::Fault;
use crate::motion::carrier::carrier;
use crate::raw::{Case, CourseCase, DeformationCase, SurfaceCase};

/// A term as it is written, whatever it deforms.
struct Written<'a> {
    /// Key of the term.
    path: String,
    /// Ending of its keys: the unit.
    unit: &'static str,
    /// From the unit to SI.
    scale: f64,
    linear: Option<[f64; 2]>,
    table: Option<&'a Vec<[f64; 2]>>,
    course: Option<&'a CourseCase>,
}

/// Deforms `wing` as the table `[path]` says.
pub(crate) fn deform(wing: Wing, path: &str, case: &DeformationCase) -> Built<Wing> {
    let twist = case.twist.iter().enumerate().map(|(k, t)| Written {
        path: format!("{path}.twist[{k}]"),
        unit: "_deg",
        scale: 1f64.to_radians(),
        linear: t.linear_deg,
        table: t.table_deg.as_ref(),
        course: t.fourier.as_ref(),
    });
    let camber = case.camber.iter().enumerate().map(|(k, t)| Written {
        path: format!("{path}.camber[{k}]"),
        unit: "",
        scale: 1.0,
        linear: t.linear,
        table: t.table.as_ref(),
        course: t.fourier.as_ref(),
    });
    let bending = case.bending.iter().enumerate().map(|(k, t)| Written {
        path: format!("{path}.bending[{k}]"),
        unit: "_m",
        scale: 1.0,
        linear: t.linear_m,
        table: t.table_m.as_ref(),
        course: t.fourier.as_ref(),
    });
    let term = |w: Written<'_>| term(&w, &wing);
    let deformation = Deformation {
        axis_fraction: case.axis_fraction,
        camber_peak: case.camber_peak,
        twist: twist.map(term).collect::<Built<_>>()?,
        camber: camber.map(term).collect::<Built<_>>()?,
        bending: bending.map(term).collect::<Built<_>>()?,
        surface: match &case.surface {
            Some(case) => Some(surface(&format!("{path}.surface"), case, &wing)?),
            None => None,
        },
    };
    let whole = |e: ModelError| Fault::new(path, e.to_string(), "", "correct this table");
    wing.deformed_by(deformation).map_err(whole)
}

fn term(w: &Written<'_>, wing: &Wing) -> Built<Term> {
    let (path, unit) = (&w.path, w.unit);
    let rows = |rows: &[[f64; 2]]| rows.iter().map(|&[r, v]| (r, v * w.scale)).collect();
    let span = match (w.linear, w.table) {
        (Some([root, tip]), None) => SpanLaw::Linear {
            root: root * w.scale,
            tip: tip * w.scale,
        },
        (None, Some(table)) => SpanLaw::Table(rows(table)),
        _ => {
            return Err(Fault::new(
                path,
                "the law along the span must be given once",
                format!("linear{unit} or table{unit}"),
                format!("linear{unit} = [value at the root, value at the tip]"),
            ));
        }
    };
    span.check("law", wing.root()).map_err(|e| {
        let row = match &e {
            ModelError::Table { row, .. } if *row > 0 => format!("[{}]", row - 1),
            _ => String::new(),
        };
        Fault::new(
            format!("{path}.table{unit}{row}"),
            e.to_string(),
            "rows [r/R, value], r/R rising from the root (or 0, the hinge) to 1, the tip",
            "divide distances from the hinge by the wing length",
        )
    })?;
    let term = Term {
        span,
        time: w.course.map_or_else(always, course),
    };
    if wing.motion.frequency == 0.0 && !term.is_steady() {
        return Err(Fault::new(
            format!("{path}.fourier"),
            "the deformation varies over a beat, but there is no wingbeat frequency",
            "a frequency > 0, or `mean` alone",
            "add `frequency_hz = ...` to [motion]",
        ));
    }
    Ok(term)
}

/// A measured surface.
fn surface(path: &str, case: &SurfaceCase, wing: &Wing) -> Built<MovingSurface> {
    let row = |row: &Vec<[f64; 3]>| row.iter().map(|&x| x.into()).collect();
    let at = |rows: &Vec<Vec<[f64; 3]>>| rows.iter().map(row).collect();
    let surface = MovingSurface {
        phases: case.phases.clone(),
        places: case.nodes_m.iter().map(at).collect(),
        harmonics: case.harmonics,
    };
    if wing.motion.frequency == 0.0 {
        return Err(Fault::new(
            path,
            "the surface varies over a beat, but there is no wingbeat frequency",
            "a frequency > 0",
            "add `frequency_hz = ...` to [motion]",
        ));
    }
    let fault = |e: ModelError| {
        let (key, allowed, remedy) = match &e {
            ModelError::Table { table, row, .. } if table.ends_with("nodes") => (
                match row.saturating_sub(1) {
                    k if k < case.nodes_m.len() => format!("{path}.nodes_m[{k}]"),
                    _ => format!("{path}.nodes_m"), // too few or too many
                },
                "one surface for each phase, all of the same number of rows and points, at least 2 x 2",
                "rows from the leading to the trailing edge, each from the root to the tip",
            ),
            _ => (
                format!("{path}.phases"),
                "rising, all within one beat, neighbours less than 1 / (2 harmonics) apart, over the end of the beat too",
                "leave out the phase that repeats the first, or lower `harmonics`",
            ),
        };
        Fault::new(key, e.to_string(), allowed, remedy)
    };
    match surface.check("surface", &wing.motion) {
        Ok(()) => Ok(surface),
        Err(e) => Err(fault(e)),
    }
}

fn always() -> Fourier {
    Fourier {
        mean: 1.0,
        ..Fourier::default()
    }
}

fn course(case: &CourseCase) -> Fourier {
    Fourier {
        mean: case.mean,
        cos: case.cosine.clone(),
        sin: case.sine.clone(),
    }
}

/// Pairs of wings, by their numbers, that share the edge at their roots.
pub(crate) fn joined(case: &Case, animal: &Animal) -> Built<Vec<[usize; 2]>> {
    let mut pairs: Vec<[usize; 2]> = vec![];
    let on_body = |name: &str| carrier(case, name).is_none();
    let joined = case.wing.iter().filter(|(_, w)| w.joined == Some(true));
    for (name, _) in joined.filter(|(name, _)| on_body(name)) {
        let number = |n: &str| animal.wings.iter().position(|w| w.name == n);
        let counterpart = mirror_name(name).and_then(|t| number(&t));
        let fault = |problem: String, remedy: &str| {
            let allowed = "two wings, left and right, whose roots meet";
            Fault::new(format!("wing.{name}.joined"), problem, allowed, remedy)
        };
        let (Some(a), Some(b)) = (number(name), counterpart) else {
            let remedy = "call the wing e.g. `right` and let its mirror image come along";
            return Err(fault(
                "there is no mirror image on the other side to join with".to_owned(),
                remedy,
            ));
        };
        let pair = [a.min(b), a.max(b)];
        if !pairs.contains(&pair) {
            let remedy = "hinges and roots in the plane of symmetry: hinge_m = [..., 0, ...], root_offset_m = 0, the same panels along the chord on both sides";
            check_joined(animal, pair).map_err(|e| fault(e.to_string(), remedy))?;
            pairs.push(pair);
        }
    }
    Ok(pairs)
}

/// Pairs of wings, by their numbers, of which the tip of the first is the root of the second, which it carries.
pub(crate) fn joined_tips(case: &Case, animal: &Animal) -> Built<Vec<[usize; 2]>> {
    let mut pairs = vec![];
    for (number, wing) in animal.wings.iter().enumerate() {
        let given = |name: String| Some((case.wing.get(&name)?.joined?, name));
        let own = given(wing.name.clone());
        let said = own.or_else(|| mirror_name(&wing.name).and_then(given));
        let Some((true, name)) = said else { continue };
        let Some(carrier) = carrier(case, &wing.name) else {
            continue;
        };
        let by = animal.wings.iter().position(|w| w.name == carrier.wing);
        let pair = by.map(|by| [by, number]);
        if let Some(e) = pair.and_then(|pair| check_joined_tip(animal, pair).err()) {
            return Err(Fault::new(
                format!("wing.{name}.joined"),
                e.to_string(),
                "the wing whose tip is the root of this one carries it, with the same chord and panels there",
                format!(
                    "joint.{}.at_m at the tip of `{}`, the same mesh.chordwise, one chord",
                    carrier.joint, carrier.wing
                ),
            ));
        }
        pairs.extend(pair);
    }
    Ok(pairs)
}
