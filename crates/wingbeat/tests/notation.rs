//! Every public number says its unit, every public vector its frame.

use std::fs;
use std::path::{Path, PathBuf};

/// A public field of a struct with its documentation and that of the struct.
struct Field {
    at: String,
    kind: String,
    docs: String,
}

/// Public fields of the structs of a source, its tests left out.
fn fields(path: &Path, text: &str) -> Vec<Field> {
    let mut found = vec![];
    let (mut docs, mut of_struct) = (String::new(), None::<String>);
    for (k, line) in text.lines().enumerate() {
        let code = line.trim();
        if code == "#[cfg(test)]" {
            break;
        }
        if let Some(doc) = code.strip_prefix("///") {
            docs += doc;
            continue;
        }
        if code.starts_with("#[") {
            continue;
        }
        let field = code.strip_prefix("pub ").and_then(|f| f.split_once(": "));
        if code.starts_with("pub struct ") && code.ends_with('{') {
            of_struct = Some(std::mem::take(&mut docs));
        } else if line == "}" {
            of_struct = None;
        } else if let (Some(whole), Some((_, kind))) = (&of_struct, field) {
            found.push(Field {
                at: format!("{}:{}", path.display(), k + 1),
                kind: kind.trim_end_matches(',').to_owned(),
                docs: format!("{docs} {whole}"),
            });
        }
        docs.clear();
    }
    found
}

/// The innermost type of options, lists and arrays.
fn innermost(kind: &str) -> &str {
    let inner = ["Option<", "Vec<", "["]
        .iter()
        .find_map(|outer| kind.strip_prefix(outer));
    match inner {
        Some(inner) => innermost(inner),
        None => kind.split(['>', ';', ']']).next().unwrap_or(kind),
    }
}

/// A unit stands in square brackets, in rustdoc's way or plainly; comparisons carry theirs in a field.
fn has_unit(docs: &str) -> bool {
    docs.contains('[') && docs.contains(']')
}

/// Components of a frame, or the names of three angles.
fn has_frame(docs: &str) -> bool {
    let words = [
        "components",
        "frame",
        "axes",
        "axis",
        "angles",
        "Roll",
        "b1",
        "n1",
    ];
    words.iter().any(|w| docs.contains(w))
}

fn sources(dir: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(dir).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn invariant_every_public_number_has_a_unit_and_every_vector_a_frame() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = vec![];
    for entry in fs::read_dir(&crates).expect("the crates") {
        let src = entry.expect("a crate").path().join("src");
        // Keys of cases carry their units in their names; what Python sees is documented there.
        if src.is_dir() && !src.to_string_lossy().contains("wingbeat-python") {
            sources(&src, &mut files);
        }
    }
    files.retain(|f| !f.components().any(|c| c.as_os_str() == "raw"));
    let (mut numbers, mut vectors, mut wrong) = (0, 0, vec![]);
    for path in files {
        let text = fs::read_to_string(&path).expect("a source");
        for field in fields(&path, &text) {
            let kind = innermost(&field.kind);
            let is_vector = kind == "DVec3";
            if kind == "f64" || kind == "f32" || is_vector {
                numbers += 1;
                if !has_unit(&field.docs) {
                    wrong.push(format!("{}: no unit", field.at));
                }
            }
            if is_vector {
                vectors += 1;
                if !has_frame(&field.docs) {
                    wrong.push(format!("{}: no frame", field.at));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // The walk sees them.
    assert!(numbers > 400 && vectors > 100, "{numbers} {vectors}");
}

#[test]
fn behaves_a_number_without_unit_and_a_vector_without_frame_are_found() {
    let text = "/// A whole.\npub struct A {\n    /// Mass [kg].\n    pub m: f64,\n    /// Place.\n    pub p: Option<DVec3>,\n}\n";
    let found = fields(Path::new("x"), text);
    assert_eq!(found.len(), 2);
    assert!(has_unit(&found[0].docs) && innermost(&found[0].kind) == "f64");
    let place = &found[1];
    assert!(innermost(&place.kind) == "DVec3" && !has_unit(&place.docs) && !has_frame(&place.docs));
}
