//! Numbers and lists: what is allowed at a key, and what is wrong with a value.

use toml::Value;

use super::schema::Shape;

/// What is wrong with a value, what is allowed, and what to try.
pub(super) struct Wrong {
    pub problem: String,
    pub allowed: String,
    pub remedy: String,
}

/// Checks one value against the bounds of its key.
pub(super) fn check(shape: Shape, value: &Value) -> Option<Wrong> {
    let problem = match value {
        Value::Float(x) => number(shape, *x),
        Value::Integer(n) => number(shape, *n as f64),
        Value::Array(items) => count(shape, items.len()),
        _ => None,
    }?;
    Some(Wrong {
        remedy: remedy(&problem, shape),
        problem,
        allowed: allowed(shape).unwrap_or_default(),
    })
}

fn number(shape: Shape, x: f64) -> Option<String> {
    let bound = |name: &str| shape.number(name);
    let least = bound("minimum").or(bound("exclusiveMinimum"));
    let low = bound("minimum").is_some_and(|b| x < b)
        || bound("exclusiveMinimum").is_some_and(|b| x <= b);
    let high = bound("maximum").is_some_and(|b| x > b)
        || bound("exclusiveMaximum").is_some_and(|b| x >= b);
    let uneven = bound("multipleOf").is_some_and(|b| x % b != 0.0);
    // Of whole numbers from 1 on, none is measured.
    let is_size = least.is_some_and(|b| (0.0..1.0).contains(&b));
    let problem = match (low, high) {
        (true, _) if x < 0.0 && is_size => "this must not be negative",
        (true, _) if x == 0.0 && is_size => "this must not be zero",
        (true, _) => "this is too small",
        (_, true) => "this is too large",
        _ if uneven => "this must be even",
        _ => return None,
    };
    Some(problem.to_owned())
}

fn count(shape: Shape, items: usize) -> Option<String> {
    let least = shape.number("minItems")?;
    let few = (items as f64) < least;
    few.then(|| format!("this list is too short, it has {items}"))
}

fn remedy(problem: &str, shape: Shape) -> String {
    match problem {
        "this must not be negative" => "remove the minus sign".to_owned(),
        "this must not be zero" => "give a measured or estimated value".to_owned(),
        _ if shape.number("minItems").is_some() => "add what is missing".to_owned(),
        _ => match shape.word("default") {
            Some(default) if default.is_number() => format!("{default} is the default"),
            _ => "choose a value in this range".to_owned(),
        },
    }
}

/// What is allowed, in words; nothing where all values of the type are.
pub(super) fn allowed(shape: Shape) -> Option<String> {
    if let Some(least) = shape.number("minItems") {
        let exactly = shape.number("maxItems") == Some(least);
        return (!exactly).then(|| format!("at least {least} elements"));
    }
    let signs = [
        ("minimum", ">="),
        ("exclusiveMinimum", ">"),
        ("maximum", "<="),
        ("exclusiveMaximum", "<"),
    ];
    let exact = shape
        .number("minimum")
        .filter(|m| shape.number("maximum") == Some(*m));
    if let Some(only) = exact {
        return Some(format!("{only}"));
    }
    let bound =
        |(name, sign): (&str, &str)| Some(format!("{sign} {}", in_few_digits(shape.number(name)?)));
    let bounds: Vec<String> = signs.into_iter().filter_map(bound).collect();
    if bounds.is_empty() {
        return None;
    }
    let what = match shape.word("type").and_then(|t| t.as_str()) {
        Some("integer") if shape.number("multipleOf") == Some(2.0) => "an even number",
        Some("integer") => "a whole number",
        _ => "a finite number",
    };
    Some(format!("{what} {}", bounds.join(" and ")))
}

/// A bound in digits, or in powers of ten where these are shorter.
fn in_few_digits(bound: f64) -> String {
    let [plain, powers] = [format!("{bound}"), format!("{bound:e}")];
    match plain.len() > 8 && powers.len() < plain.len() {
        true => powers,
        false => plain,
    }
}
