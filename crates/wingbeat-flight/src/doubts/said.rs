//! What is said of wings: their names, and those of which the same is said.

/// Names in backticks, with `between` between them.
pub fn names<'a>(wings: impl IntoIterator<Item = &'a str>, between: &str) -> String {
    let names: Vec<String> = wings.into_iter().map(|w| format!("`{w}`")).collect();
    names.join(between)
}

/// What is said of wings, each once with the names of those that it is said of.
pub fn grouped<'a, T: PartialEq>(
    all: impl Iterator<Item = (T, &'a str)>,
) -> Vec<(T, Vec<&'a str>)> {
    let mut found: Vec<(T, Vec<&str>)> = vec![];
    for (said, wing) in all {
        match found.iter_mut().find(|f| f.0 == said) {
            Some((_, wings)) => wings.push(wing),
            None => found.push((said, vec![wing])),
        }
    }
    found
}
