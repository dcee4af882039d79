//! Where in a case a key of some name stands.

use super::schema::Shape;

/// The paths of all keys and tables with this name, `NAME` and `[]` for names and numbers of the user's choice.
pub(crate) fn places(name: &str) -> Vec<String> {
    let mut found = vec![];
    visit(Shape::case(), "", name, &mut found);
    found
}

fn visit(shape: Shape, path: &str, name: &str, found: &mut Vec<String>) {
    let inside = |key: &str| match path {
        "" => key.to_owned(),
        _ => format!("{path}.{key}"),
    };
    if let Some(keys) = shape.properties() {
        for key in keys.keys() {
            if key == name {
                found.push(inside(key));
            }
            let there = shape.at(key).expect("a key of the table");
            visit(there, &inside(key), name, found);
        }
    } else if let Some(entry) = shape.entry() {
        visit(entry, &inside("NAME"), name, found);
    } else if let Some(element) = shape.element(0) {
        visit(element, &format!("{path}[]"), name, found);
    } else {
        for variant in shape.variants() {
            for key in variant.properties().into_iter().flat_map(|p| p.keys()) {
                let there = variant.at(key).expect("a choice with content");
                visit(there, &inside(key), name, found);
            }
        }
    }
}
