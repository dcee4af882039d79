//! Paths of keys in a document: `load[0].force_n`.

use toml::{Table, Value};

/// Parts of a key at most; `wing.right.deformation.twist[0].course.fourier.cosine_deg[0]` has ten.
const MAX_PARTS: usize = 32;

/// Refuses what is no path: behind a name there may be indices in brackets, and nothing else.
pub(super) fn check(path: &str) -> Result<(), String> {
    let is_whole = |piece: &str| {
        let mut rest = &piece[piece.find(['[', ']']).unwrap_or(piece.len())..];
        while let Some((index, behind)) = rest.strip_prefix('[').and_then(|r| r.split_once(']')) {
            if index.parse::<usize>().is_err() {
                return false;
            }
            rest = behind;
        }
        rest.is_empty()
    };
    match path.split('.').all(is_whole) {
        true => Ok(()),
        false => Err(format!(
            "`{path}` is no key: the elements of a list are [0], [1] and so on"
        )),
    }
}

/// The parts of a path: `load[0].force_n` is `load`, `[0]`, `force_n`.
fn parts(path: &str) -> impl Iterator<Item = Part<'_>> {
    path.split('.').flat_map(|piece| {
        let (name, rest) = piece.split_at(piece.find('[').unwrap_or(piece.len()));
        let indices = rest
            .split(['[', ']'])
            .filter_map(|n| n.parse().ok())
            .map(Part::Index);
        std::iter::once(Part::Name(name)).chain(indices)
    })
}

enum Part<'a> {
    Name(&'a str),
    Index(usize),
}

/// The value at a path.
pub(crate) fn find<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    let mut steps = parts(path);
    let Some(Part::Name(first)) = steps.next() else {
        return None;
    };
    steps.try_fold(table.get(first)?, |value, part| match part {
        Part::Name(name) => value.get(name),
        Part::Index(k) => value.get(k),
    })
}

/// The same, to be changed.
pub(crate) fn find_mut<'a>(table: &'a mut Table, path: &str) -> Option<&'a mut Value> {
    let mut steps = parts(path);
    let Some(Part::Name(first)) = steps.next() else {
        return None;
    };
    steps.try_fold(table.get_mut(first)?, |value, part| match part {
        Part::Name(name) => value.get_mut(name),
        Part::Index(k) => value.get_mut(k),
    })
}

/// Puts a value at a path, making tables on the way.
pub(super) fn set(table: &mut Table, path: &str, value: Value) -> Result<(), String> {
    let steps: Vec<Part<'_>> = parts(path).collect();
    if steps.len() > MAX_PARTS {
        return Err(format!(
            "a key of {} parts: no case has one that deep",
            steps.len()
        ));
    }
    let Some((Part::Name(first), rest)) = steps.split_first() else {
        return Err("the key is empty".to_owned());
    };
    if first.is_empty() {
        return Err("the key is empty".to_owned());
    }
    let fresh = || Value::Table(Table::new());
    let mut slot = table.entry((*first).to_owned()).or_insert_with(fresh);
    for part in rest {
        slot = match (part, slot) {
            (Part::Name(name), Value::Table(t)) => {
                t.entry((*name).to_owned()).or_insert_with(fresh)
            }
            (Part::Index(k), Value::Array(items)) if *k < items.len() => &mut items[*k],
            (Part::Index(k), _) => return Err(format!("there is no element [{k}] to set")),
            (Part::Name(name), _) if name.parse::<usize>().is_ok() => {
                return Err(format!(
                    "`{name}` cannot be set: the elements of a list are [0], [1] and so on, without a point before them"
                ));
            }
            (Part::Name(name), _) => {
                return Err(format!(
                    "`{name}` cannot be set: what holds it is not a table"
                ));
            }
        };
    }
    *slot = value;
    Ok(())
}

/// Takes the key or the element of a list at `path` out of the document, which must have it.
pub(super) fn take_away(table: &mut Table, path: &str) -> Result<(), String> {
    let none =
        || format!("the case has no such key to take away (which `{path}=` without a value does)");
    let element = path.strip_suffix(']').and_then(|p| p.rsplit_once('['));
    let gone = if let Some((list, index)) = element {
        let items = find_mut(table, list).and_then(Value::as_array_mut);
        let index = index.parse().ok();
        (items.zip(index)).and_then(|(items, k)| (k < items.len()).then(|| items.remove(k)))
    } else {
        let (outer, key) = path.rsplit_once('.').unwrap_or(("", path));
        let holder = match outer {
            "" => Some(table),
            outer => find_mut(table, outer).and_then(Value::as_table_mut),
        };
        holder.and_then(|t| t.remove(key))
    };
    gone.map(|_| ()).ok_or_else(none)
}
