//! A case walked along its schema: every number within its bounds, every key with an effect.

use toml::{Table, Value};

use super::bounds;
use super::needs::{self, Need};
use super::schema::Shape;
use crate::error::Fault;
use crate::text::source::{CaseSource, join};

/// Where the air's model is chosen.
const MODEL: &str = "air.model";
/// Where the controller is chosen.
const CONTROLLER: &str = "control.controller";
/// Where the integrator is chosen.
const INTEGRATOR: &str = "dynamics.integrator";
/// Where edges that shed are chosen, how leading edges do, and how velocities are summed.
const WAYS: [&str; 3] = ["air.shed", "air.leading_edge", "air.summation"];

type Checked = Result<(), Fault>;

/// Checks the values of all keys, each by itself.
pub(crate) fn alone(document: &Table) -> Checked {
    each(
        Shape::case(),
        "",
        document,
        &mut |shape, path, value| match bounds::check(shape, value) {
            None => Ok(()),
            Some(w) => Err(Fault::new(path, w.problem, w.allowed, w.remedy)),
        },
    )
}

/// Visits all values of a table, lists and tables in it too.
fn each(
    shape: Shape,
    path: &str,
    table: &Table,
    visit: &mut impl FnMut(Shape, &str, &Value) -> Checked,
) -> Checked {
    for (name, value) in table {
        if let Some(key) = shape.at(name) {
            each_in(key, &join(path, name), value, visit)?;
        }
    }
    Ok(())
}

fn each_in(
    shape: Shape,
    path: &str,
    value: &Value,
    visit: &mut impl FnMut(Shape, &str, &Value) -> Checked,
) -> Checked {
    visit(shape, path, value)?;
    match value {
        Value::Table(table) => each(shape, path, table, visit),
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                if let Some(element) = shape.element(k) {
                    each_in(element, &format!("{path}[{k}]"), item, visit)?;
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

/// A case with its defaults filled in beside the document it was read from.
struct Pair<'a> {
    /// All keys, with their defaults.
    whole: &'a Table,
    source: &'a CaseSource,
}

/// Checks that every key of the document has an effect beside the others; `whole` is the same case
/// with its defaults. Where the command line chose the air's model, the integrator, the controller or the edges that
/// shed, settings of the file for its own may stand by.
pub(crate) fn together(source: &CaseSource, whole: &Table) -> Checked {
    let pair = Pair { whole, source };
    pair.table(Shape::case(), "", &source.table, whole)
}

impl Pair<'_> {
    fn table(&self, shape: Shape, path: &str, given: &Table, whole: &Table) -> Checked {
        for (name, value) in given {
            let Some(key) = shape.at(name) else { continue };
            let path = join(path, name);
            for need in needs::of(key) {
                let idle = !need.is_met(self.whole, whole, given);
                if idle && !self.stands_by(key, need, &path, value) {
                    let [problem, allowed, remedy] = need.explained(self.whole, whole);
                    return Err(Fault::new(path, problem, allowed, remedy));
                }
            }
            given_once(key, name, &path, given)?;
            if let Some(inner) = whole.get(name) {
                self.inside(key, &path, value, inner)?;
            }
        }
        Ok(())
    }

    fn inside(&self, shape: Shape, path: &str, given: &Value, whole: &Value) -> Checked {
        match (given, whole) {
            (Value::Table(given), Value::Table(whole)) => self.table(shape, path, given, whole),
            (Value::Array(given), Value::Array(whole)) => {
                for (k, (given, whole)) in given.iter().zip(whole).enumerate() {
                    if let Some(element) = shape.element(k) {
                        self.inside(element, &format!("{path}[{k}]"), given, whole)?;
                    }
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// What the file says for another air model, integrator, controller, other edges or sums than the command line
    /// chose, but for properties of the air itself. The integrator follows from the model unless it is given.
    /// Whatever else the command line chose, zeros that a case has filled in as defaults do not contradict it.
    fn stands_by(&self, key: Shape, need: Need, path: &str, value: &Value) -> bool {
        let source = self.source;
        let follows =
            source.chooses(INTEGRATOR) || !source.gives(INTEGRATOR) && source.chooses(MODEL);
        let chosen = |key: &str| need.is_value_of(key) && source.chooses(key);
        let decided = need.chosen_by(path);
        let chosen_way = |by: &String| WAYS.contains(&&by[..]) && source.chooses(by);
        let switched = chosen(MODEL)
            || chosen(CONTROLLER)
            || need.is_value_of(INTEGRATOR) && follows
            || decided.as_ref().is_some_and(chosen_way);
        let stays = switched && key.key.get("always").is_none();
        let is_default = || {
            let is_nothing = is_zero(value) || !says(value);
            let is_chosen = decided.as_ref().is_some_and(|by| source.chooses(by));
            is_chosen && is_nothing && key.is_default(value)
        };
        !source.touches(path) && (stays || is_default())
    }
}

/// Checks that the case says nothing that a model of the air of one's own would lose: how the air moves and where the
/// ground is, and whatever was set on top for another model. What the file says for that one may stand by.
pub(crate) fn beside_own_air(source: &CaseSource) -> Checked {
    let air = source.table.get("air").and_then(Value::as_table);
    for (name, value) in air.into_iter().flatten() {
        let path = join("air", name);
        let Some(key) = Shape::case().at("air").and_then(|air| air.at(name)) else {
            continue;
        };
        let of_model = needs::of(key).iter().any(|n| n.is_value_of(MODEL));
        let moves = key.key.get("always").is_some() || name == "stream_m_s";
        let lost = moves.then(|| path.clone()).or_else(|| source.set_at(&path));
        if let Some(lost) = lost.filter(|_| of_model && says(value)) {
            return Err(Fault::new(
                lost,
                "this has no effect beside a model of the air of your own",
                "in air that the case chooses (air.model)",
                "let the model compute it, and take the key away",
            ));
        }
    }
    Ok(())
}

/// Whether a value is more than an empty list or zeros.
fn says(value: &Value) -> bool {
    value
        .as_array()
        .is_none_or(|list| !list.iter().all(is_zero))
}

fn is_zero(value: &Value) -> bool {
    value.as_float() == Some(0.0) || value.as_integer() == Some(0)
}

/// Of alternatives only one is given.
fn given_once(key: Shape, name: &str, path: &str, given: &Table) -> Checked {
    let others = key.texts("or");
    match others.iter().find(|o| given.contains_key(**o)) {
        None => Ok(()),
        Some(other) => Err(Fault::new(
            path,
            format!("this is given twice, also as {other}"),
            format!("one of {}, {name}", others.join(", ")),
            "remove one of them",
        )),
    }
}

/// The keys of `given` that have an effect; `whole` is the same case with all defaults.
pub(crate) fn effective(whole: &Table, given: &Table) -> Table {
    kept(Shape::case(), whole, given)
}

fn kept(shape: Shape, root: &Table, table: &Table) -> Table {
    let effective = |key: Shape| needs::of(key).iter().all(|n| n.is_met(root, table, table));
    let keep = |(name, value): (&String, &Value)| {
        let key = shape.at(name)?;
        effective(key).then(|| (name.clone(), kept_in(key, root, value)))
    };
    let left: Table = table.iter().filter_map(keep).collect();
    // Keys that need each other go together: what needs one that went goes next.
    if left.len() < table.len() {
        kept(shape, root, &left)
    } else {
        left
    }
}

fn kept_in(shape: Shape, root: &Table, value: &Value) -> Value {
    match value {
        Value::Table(table) => Value::Table(kept(shape, root, table)),
        Value::Array(items) => {
            let kept = |(k, item): (usize, &Value)| match shape.element(k) {
                Some(element) => kept_in(element, root, item),
                None => item.clone(),
            };
            Value::Array(items.iter().enumerate().map(kept).collect())
        }
        other => other.clone(),
    }
}
