//! From the document to raw case types, with serde's messages turned into sentences for users.

use serde::de::DeserializeOwned;

use crate::error::{CaseError, Fault};
use crate::keys::without_unit;
use crate::text::nearest::nearest;
use crate::text::path::find_mut;
use crate::text::source::CaseSource;

/// Decodes the document; unknown keys, missing keys and wrong types become located errors.
pub(crate) fn decode<T: DeserializeOwned>(source: &CaseSource) -> Result<T, Box<CaseError>> {
    let mut table = source.table.clone();
    let decoded = loop {
        let document = toml::Value::Table(table.clone());
        match serde_path_to_error::deserialize(document) {
            // 40.0 where a whole number is wanted; each turn makes one of them whole.
            Err(e) if wants_whole(e.inner().message()) => {
                let value = find_mut(&mut table, &e.path().to_string());
                match value.and_then(|v| Some((whole(v)?, v))) {
                    Some((n, value)) => *value = toml::Value::Integer(n),
                    None => break Err(e),
                }
            }
            other => break other,
        }
    };
    decoded.map_err(|e| {
        let path = e.path().to_string();
        let path = if path == "." { String::new() } else { path };
        let message = e.inner().message();
        let fault = match message.starts_with(ONE_CHOICE) {
            true => no_choice::<T>(&table, &path)
                .unwrap_or_else(|| one_choice(&path, &source.keys_at(&path))),
            false => explain(&path, message),
        };
        Box::new(source.locate(fault))
    })
}

/// Whether the decoder complains of a number in the place of a whole one.
fn wants_whole(message: &str) -> bool {
    let rest = message.strip_prefix("invalid type: floating point");
    let wanted = rest.and_then(|r| r.split_once(", expected "));
    wanted.is_some_and(|(_, what)| {
        ["usize", "u64", "u32", "i64"]
            .iter()
            .any(|w| what.starts_with(w))
    })
}

/// The whole number that a number without a fraction is.
fn whole(value: &toml::Value) -> Option<i64> {
    const EXACT: f64 = (1_u64 << 53) as f64;
    let x = value.as_float().filter(|x| x.fract() == 0.0)?;
    (x.abs() < EXACT).then_some(x as i64)
}

/// How the decoder begins what it says of a choice that is none, or several.
const ONE_CHOICE: &str = "wanted exactly 1 element";

/// A table that has to hold one of several choices holds `keys`.
fn one_choice(path: &str, keys: &[&str]) -> Fault {
    let (problem, example) = match keys {
        [] => ("none is chosen".to_owned(), "..."),
        [.., last] => (format!("{} at once", keys.join(" and ")), *last),
    };
    let name = path.rsplit('.').next().unwrap_or(path);
    let whole = format!("give the whole table to choose another: {name} = {{ {example} = ... }}");
    let others = keys.split_last().map_or(&[][..], |(_, others)| others);
    let remedy = match others {
        [] => whole,
        _ => {
            let all: Vec<String> = others.iter().map(|key| format!("{path}.{key}")).collect();
            format!(
                "delete {} to keep `{example}`; or {whole}",
                all.join(" and ")
            )
        }
    };
    Fault::new(path, problem, "one of several choices", remedy)
}

/// Of several choices at once in the table at `path` one that is none, with the whole table to give in its place.
fn no_choice<T: DeserializeOwned>(table: &toml::Table, path: &str) -> Option<Fault> {
    let keys: Vec<String> = (find_mut(&mut table.clone(), path)?.as_table()?)
        .keys()
        .cloned()
        .collect();
    keys.iter().filter(|_| keys.len() > 1).find_map(|key| {
        let mut alone = table.clone();
        let choices = find_mut(&mut alone, path)?.as_table_mut()?;
        choices.retain(|k, _| k == key);
        let error = serde_path_to_error::deserialize::<_, T>(toml::Value::Table(alone)).err()?;
        let message = error.inner().message();
        let is_none = message.starts_with("unknown variant") && error.path().to_string().starts_with(path);
        let fault = is_none.then(|| explain(&error.path().to_string(), message))?;
        let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
        let near = same_quantity(key, &quoted[1..]).or_else(|| nearest(key, &quoted[1..]))?;
        let name = path.rsplit('.').next().unwrap_or(path);
        Some(Fault {
            remedy: format!("give the whole table to choose another: {name} = {{ {near} = ... }}; the unit is part of the key"),
            ..fault
        })
    })
}

/// One of serde's messages as a fault.
fn explain(path: &str, message: &str) -> Fault {
    let message = message.trim();
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    if message.starts_with("unknown field") {
        return unknown(path, quoted[0], &quoted[1..], "key");
    }
    if message.starts_with("unknown variant") {
        return unknown(path, quoted[0], &quoted[1..], "choice");
    }
    if message.starts_with("missing field") {
        let key = inside(path, quoted[0]);
        let remedy = match quoted[0] {
            // The only one there is.
            "format" => "add `format = 1`".to_owned(),
            key => format!("add `{key} = ...`"),
        };
        return Fault::missing(key, "it has no default", remedy);
    }
    let (problem, expected) = message.split_once(", expected ").unwrap_or((message, ""));
    if let Some(fault) = of_choice(path, problem, expected) {
        return fault;
    }
    Fault::new(
        path,
        found_in_words(problem),
        expected_in_words(expected),
        remedy(problem, expected),
    )
}

/// A choice without the value that it has, or with one where it is its name alone; `path` ends with its name.
fn of_choice(path: &str, problem: &str, expected: &str) -> Option<Fault> {
    let (key, choice) = path.rsplit_once('.')?;
    if problem.ends_with("unit variant") && expected.ends_with("variant") {
        return Some(Fault::new(
            key,
            format!("the choice `{choice}` has a value of its own, and none is given"),
            format!("`{choice}` with its value: {path} = ..."),
            format!(
                "give it as a key: {path} = ..., a number or a table of settings as docs/case-keys.md has it"
            ),
        ));
    }
    let found = problem.strip_prefix("expected table, found ")?;
    Some(Fault::new(
        path,
        format!("the choice `{choice}` has no value of this kind ({found})"),
        "the name of the choice alone, or a table of its settings where it has some",
        format!("{key} = \"{choice}\""),
    ))
}

fn inside(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        _ if path.rsplit('.').next() == Some(key) => path.to_owned(),
        _ => format!("{path}.{key}"),
    }
}

fn unknown(path: &str, got: &str, expected: &[&str], what: &str) -> Fault {
    let key = if what == "key" {
        inside(path, got)
    } else {
        path.to_owned()
    };
    let remedy = match (
        same_quantity(got, expected),
        one_word_away(got, expected).or_else(|| nearest(got, expected)),
    ) {
        (Some(near), _) if one_word_away(got, expected).is_none() => {
            format!("`{near}`: the unit is part of the key, convert the value")
        }
        (_, Some(near)) => format!("did you mean `{near}`?"),
        (_, None) => format!("remove it or use one of the allowed {what}s"),
    };
    Fault::new(
        key,
        format!("unknown {what} `{got}`"),
        expected.join(", "),
        remedy,
    )
}

/// The only expected key that has one word more or less than `got`, within or before its unit:
/// `stiffness_newton_m_per_rad` for `stiffness_newton_m_rad`.
fn one_word_away<'a>(got: &str, expected: &[&'a str]) -> Option<&'a str> {
    let words = |key: &'_ str| key.split('_').map(str::to_owned).collect::<Vec<_>>();
    let own = words(got);
    let is_near = |key: &&&str| {
        let other = words(key);
        let [long, short] = match own.len() > other.len() {
            true => [&own, &other],
            false => [&other, &own],
        };
        let without = |k: usize| [&long[..k], &long[k + 1..]].concat() == *short;
        long.len() == short.len() + 1 && (0..long.len()).any(without)
    };
    // Another unit of the same quantity, or none, is a number to be converted.
    let stem = without_unit(got).unwrap_or(got);
    let is_converted = |key: &&&str| without_unit(key) == Some(stem);
    let mut near = expected
        .iter()
        .filter(|key| is_near(key) && !is_converted(key));
    near.next().filter(|_| near.next().is_none()).copied()
}

/// The expected key that differs from `got` only in its unit: `mass_mg` for `mass_kg`.
fn same_quantity<'a>(got: &str, expected: &[&'a str]) -> Option<&'a str> {
    let is_same = |e: &&&str| {
        without_unit(e)
            .is_some_and(|s| got == s || got.strip_prefix(s).is_some_and(|r| r.starts_with('_')))
    };
    // Of lengths in metres and in chords the one that was meant, of the others the one spelled most alike.
    let likeness = |e: &&&str| {
        let stem = without_unit(e).map_or(0, str::len);
        let in_chords = e.ends_with("_chords") == got.contains("chord");
        (
            stem,
            in_chords,
            std::cmp::Reverse(strsim::damerau_levenshtein(got, e)),
        )
    };
    let same = expected.iter().filter(is_same);
    same.max_by_key(likeness).copied()
}

/// What serde found, in words; the value itself stands beside the key.
fn found_in_words(problem: &str) -> String {
    let kind = |text: &str| text.split([' ', '`', '"']).next().unwrap_or("").to_owned();
    if problem.ends_with("unit variant") {
        return "wrong type: this is no choice".to_owned();
    }
    let (what, found) = match problem.split_once(": ") {
        Some(("invalid type", rest)) if rest.starts_with("floating point") => {
            let number = problem
                .split('`')
                .nth(1)
                .and_then(|x| x.parse::<f64>().ok());
            return match number.is_some_and(|x| x.fract() == 0.0) {
                true => "wrong type: a number",
                false => "wrong type: a number with a fraction",
            }
            .to_owned();
        }
        Some(("invalid type", rest)) => ("wrong type: ", kind(rest)),
        Some(("invalid value", rest)) => ("value out of range: ", kind(rest)),
        _ => return expected_in_words(problem),
    };
    let words = match found.as_str() {
        "integer" => "a whole number",
        "boolean" => "true or false",
        "string" => "a text",
        "sequence" => "a list",
        "map" => "a table",
        "unit" => "a choice by its name alone",
        "newtype" | "tuple" | "struct" => "a choice with settings",
        other => other,
    };
    format!("{what}{words}")
}

/// What serde wants, in words: Rust's names of types say nothing to a user.
fn expected_in_words(text: &str) -> String {
    let words = [
        (
            "string only",
            "the name of a choice, or a table with its settings",
        ),
        ("floating point", "the number"),
        ("a sequence", "a list"),
        ("sequence", "a list"),
        ("a map", "a table"),
        ("map", "a table"),
        ("f64", "a number"),
        ("usize", "a whole number >= 0"),
        ("u32", "a whole number from 0 to 4294967295"),
        ("u64", "a whole number >= 0"),
        ("a boolean", "true or false"),
        ("boolean", "the truth value"),
        ("an array of length 3", "a list of three numbers [x, y, z]"),
        ("an array of length 2", "a list of two values"),
        ("an array of length", "a list of length"),
        ("a tuple of size", "a list of length"),
    ];
    let plain = words
        .iter()
        .fold(text.to_owned(), |t, (from, to)| t.replace(from, to));
    // `struct TimeCase`, `tuple variant ProfileCase::Table`, ...
    [
        ("tuple struct ", "a list"),
        ("newtype struct ", "a value"),
        ("unit struct ", "a table"),
        ("struct variant ", "a table"),
        ("newtype variant ", "a value"),
        ("tuple variant ", "a list"),
        ("unit variant ", "a name alone"),
        ("struct ", "a table"),
        ("enum ", "a choice"),
    ]
    .iter()
    .fold(plain, |t, (kind, word)| without_name(&t, kind, word))
}

/// `text` with every `kind` and the name after it replaced by `word`.
fn without_name(text: &str, kind: &str, word: &str) -> String {
    let mut parts = text.split(kind);
    let mut out = parts.next().unwrap_or("").to_owned();
    for part in parts {
        out.push_str(word);
        out.push_str(part.trim_start_matches(|c: char| c.is_alphanumeric() || "_:".contains(c)));
    }
    out
}

fn remedy(problem: &str, expected: &str) -> &'static str {
    if problem.contains("string") && expected.contains("f64") {
        "write the number without quotes and without a unit; the unit is part of the key"
    } else if expected.contains("length 3") {
        "vectors have three components, e.g. [0, 0, 9.81]"
    } else if expected.contains("length 2") {
        "give two values: of what varies along a wing or a vein those where it begins and where it ends, [root, tip], the same twice for a constant"
    } else {
        "give a value of the kind that is allowed"
    }
}
