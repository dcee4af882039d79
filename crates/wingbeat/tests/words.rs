//! Words of the field: none that only we use where the field has its own, in names, messages and docs.

use std::fs;
use std::path::{Path, PathBuf};

/// A private word in all its forms, and what the field says.
const PRIVATE: &[(&str, &str)] = &[
    ("anew", "again"),
    ("blame blames blamed", "fault of, traced to"),
    ("dossier dossiers", "verification report"),
    ("ladder", "levels"),
    ("leak leaks leaked", "net-flux residual"),
    ("manner", "run options"),
    ("misses", "failed rows"),
    ("ours", "computed"),
    ("penetration", "normal-velocity residual"),
    ("price", "power, cost"),
    ("rung rungs", "level"),
    ("seam seams", "joined edge; interface"),
    (
        "settle settles settled",
        "converge, finish, become periodic",
    ),
    ("sew sews sewn", "join"),
    ("spent", "converted"),
    ("tame tames tamed", "limit"),
    ("trouble", "error"),
    ("twin twins", "mirror image, counterpart"),
];

/// Beginnings of constants, and what the standard library says.
const BEGINNINGS: &[(&str, &str)] = &[("MOST_", "MAX_"), ("LEAST_", "MIN_")];

/// Phrases that hide a term.
const PHRASES: &[(&str, &str)] = &[
    ("is told", "arguments of"),
    ("is open by", "does not close: residual"),
    ("pushes up with", "lift"),
    ("flown to its end already", "has already finished"),
];

/// Where such a word stays, and why.
const EXCEPT: &[(&str, &str, &str)] = &[
    (
        "model/src/kinematics/convert.rs",
        "ours",
        "our convention of angles beside others",
    ),
    ("case/src/external/partner.rs", "ours", "our own program"),
    (
        "results/src/run/directory.rs",
        "ours",
        "files that the program wrote",
    ),
    (
        "results/src/run/saver.rs",
        "ours",
        "files that the program wrote",
    ),
];

/// Folders whose words have not been looked through yet.
const LATER: &[&str] = &[
    "crates/wingbeat-vortex/",
    "crates/wingbeat-air/src/wake/",
    "crates/wingbeat-air/src/loads/",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Sources without tests, and pages.
fn texts() -> Vec<(String, String)> {
    let mut all = vec![];
    let mut folders = vec![root().join("crates"), root().join("docs")];
    let pages = [
        "README.md",
        "ARCHITECTURE.md",
        "NOTATION.md",
        "CONTRIBUTING.md",
    ];
    let mut files: Vec<PathBuf> = pages.iter().map(|p| root().join(p)).collect();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
            let is_text = [".rs", ".md"].iter().any(|end| name.ends_with(end));
            match path.is_dir() {
                true if ["tests", "benches", "target"].contains(&name) => {}
                true => folders.push(path),
                false if is_text => files.push(path),
                false => {}
            }
        }
    }
    let base = root();
    for file in files {
        let name = file.strip_prefix(&base).expect("below the root");
        let name = name.to_str().expect("a plain name").replace('\\', "/");
        if !LATER.iter().any(|folder| name.starts_with(folder)) {
            all.push((name, fs::read_to_string(&file).expect("a text")));
        }
    }
    all
}

/// Words of a line, names taken apart at `_` and at capitals, all in small letters.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut after_small = false;
    for c in line.chars() {
        if !c.is_alphabetic() || (c.is_uppercase() && after_small) {
            words.push(String::new());
        }
        if c.is_alphabetic() {
            words
                .last_mut()
                .expect("one at least")
                .extend(c.to_lowercase());
        }
        after_small = c.is_lowercase();
    }
    words.retain(|w| !w.is_empty());
    words
}

/// What is wrong with a line: the private word and what to say instead.
fn private(line: &str) -> Option<(&'static str, &'static str)> {
    let words = words(line);
    let is_there = |forms: &str| forms.split(' ').any(|form| words.iter().any(|w| w == form));
    let word = PRIVATE.iter().find(|(forms, _)| is_there(forms));
    let begins = |start: &str| {
        let names = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        names.into_iter().any(|name| name.starts_with(start))
    };
    let beginning = BEGINNINGS.iter().find(|(start, _)| begins(start));
    let phrase = PHRASES.iter().find(|(phrase, _)| line.contains(phrase));
    word.or(beginning).or(phrase).copied()
}

#[test]
fn invariant_words_are_those_of_the_field() {
    let mut problems = vec![];
    for (file, text) in texts() {
        for (n, line) in text.lines().enumerate() {
            let Some((word, instead)) = private(line) else {
                continue;
            };
            let stays = |(place, kept, _why): &&(&str, &str, &str)| {
                file.ends_with(place) && word.split(' ').any(|w| w == *kept)
            };
            if !EXCEPT.iter().any(|e| stays(&e)) {
                problems.push(format!("{file}:{}: `{word}`, say {instead}: {line}", n + 1));
            }
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// The reader of words itself, and no exception that nothing needs.
#[test]
fn behaves_private_words_are_found() {
    let found = |line: &str| private(line).map(|(word, _)| word);
    assert_eq!(found("const MOST_PARTS: usize = 3;"), Some("MOST_"));
    assert_eq!(found("struct WakeSeam;"), Some("seam seams"));
    assert_eq!(found("let leak_velocity = 1.0;"), Some("leak leaks leaked"));
    assert_eq!(found("/// What `run` is told."), Some("is told"));
    assert_eq!(found("fn leading_edge(seamless: f64) // at most_all"), None);
    for (place, kept, why) in EXCEPT {
        let texts = texts();
        let mut lines = texts
            .iter()
            .filter(|(file, _)| file.ends_with(place))
            .flat_map(|(_, text)| text.lines());
        let used = lines.any(|l| private(l).is_some_and(|(w, _)| w.split(' ').any(|w| w == *kept)));
        assert!(used, "{place}: `{kept}` ({why}) is not there any more");
    }
}
