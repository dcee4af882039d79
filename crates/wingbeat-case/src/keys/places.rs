//! Where in a case a key of some name stands.

use super::page::meaning;
use super::schema::Shape;
use super::unit::{unit, with_exponents};

/// Unit of the key at a path as tables write units (`m s-1`; 1 of what has none), and what the key is, in a
/// sentence; none of paths at which a case has no key. `wing.right.mass_kg` and `air.stream_m_s[0]` are paths.
pub fn described(path: &str) -> Option<[String; 2]> {
    let mut shape = Shape::case();
    let (mut name, mut about) = ("", String::new());
    for step in path.split('.') {
        let (key, elements) = step.split_once('[').unwrap_or((step, ""));
        shape = shape.at(key)?;
        (name, about) = (key, meaning(shape).0);
        for k in elements.split('[').filter(|k| !k.is_empty()) {
            shape = shape.element(k.strip_suffix(']')?.parse().ok()?)?;
        }
    }
    Some([
        with_exponents(unit(name)),
        first_sentence(&about).to_owned(),
    ])
}

/// The first sentence of a text, without its full stop, with the dots of a list that goes on.
fn first_sentence(text: &str) -> &str {
    let begins = |k: &usize| text[k + 2..].starts_with(char::is_uppercase);
    let end = text.match_indices(". ").map(|(k, _)| k).find(begins);
    let sentence = end.map_or(text, |k| &text[..=k]);
    match sentence.ends_with("...") {
        true => sentence,
        false => sentence.strip_suffix('.').unwrap_or(sentence),
    }
}

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

#[cfg(test)]
mod tests {
    use super::described;

    #[test]
    fn behaves_keys_are_described_by_their_paths() {
        for (path, unit, word) in [
            ("motion.frequency_hz", "Hz", "beat"),
            ("wing.right.mass_kg", "kg", "ass"),
            ("air.stream_m_s[1]", "m s-1", "air"),
            ("time.beats", "1", "beats"),
        ] {
            let found = described(path).unwrap_or_else(|| panic!("{path}"));
            assert_eq!(found[0], unit, "{path}");
            assert!(found[1].contains(word), "{path}: {}", found[1]);
        }
        let [_, about] = described("body.mass_kg").unwrap();
        assert_eq!(about, "Mass of the body without wings");
        let [_, about] = described("wing.right.motion.phi.fourier.cosine_deg[0]").unwrap();
        assert!(about.ends_with("harmonics 1, 2, ..."), "{about}");
        assert_eq!(described("motion.frequncy_hz"), None);
        assert_eq!(described("trim.forward_m_per_s"), None);
    }
}
