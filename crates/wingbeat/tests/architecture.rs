//! Keeps ARCHITECTURE.md and NOTATION.md true by reading manifests and sources.

mod modules;
mod notation;
mod words;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn rust_files(dir: &Path) -> Vec<PathBuf> {
    let mut files = vec![];
    for entry in fs::read_dir(dir).unwrap_or_else(|e| panic!("{}: {e}", dir.display())) {
        let path = entry.expect("a directory entry").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// How names of tests may begin, by CONTRIBUTING.md.
const EVIDENCE: [&str; 11] = [
    "exact_",
    "order_",
    "conserves_",
    "balances_",
    "invariant_",
    "limit_",
    "agrees_",
    "published_",
    "regress_",
    "refuses_",
    "behaves_",
];

#[test]
fn invariant_names_of_tests_say_which_evidence_they_are() {
    let told = fs::read_to_string(root().join("CONTRIBUTING.md")).expect("CONTRIBUTING.md");
    for kind in EVIDENCE {
        assert!(told.contains(&format!("`{kind}`")), "{kind}");
    }
    for file in rust_files(&root().join("crates")) {
        let text = fs::read_to_string(&file).expect("a source");
        for test in text.split("#[test]\n").skip(1) {
            let after = test.split("fn ").nth(1).unwrap_or("");
            let name = after.split('(').next().unwrap_or("");
            let says = EVIDENCE.iter().any(|kind| name.starts_with(kind));
            assert!(says, "{}: {name}", file.display());
        }
    }
}

/// Where a manifest lists its test programs, every file of its tests is one of them or a module of one.
#[test]
fn invariant_no_test_is_left_out_of_the_test_programs() {
    for entry in fs::read_dir(root().join("crates")).expect("crates") {
        let dir = entry.expect("a crate").path();
        let manifest = fs::read_to_string(dir.join("Cargo.toml")).expect("a manifest");
        if !manifest.contains("autotests = false") {
            continue;
        }
        let files = rust_files(&dir.join("tests"));
        let texts = files.iter().map(|f| fs::read_to_string(f).expect("a test"));
        let text: String = texts.collect();
        for file in &files {
            let stem = |p: &Path| {
                p.file_stem()
                    .expect("a name")
                    .to_string_lossy()
                    .into_owned()
            };
            let name = match stem(file) {
                n if n == "mod" || n == "main" => stem(file.parent().expect("a folder")),
                n => n,
            };
            let in_use = manifest.contains(&format!("name = \"{name}\"\n"))
                || text.lines().any(|l| l.ends_with(&format!("mod {name};")));
            assert!(in_use, "{} is not compiled", file.display());
        }
    }
}

/// Own crates that the manifest of `name` names under `[dependencies]`.
fn dependencies(name: &str) -> BTreeSet<String> {
    let manifest = root().join("crates").join(name).join("Cargo.toml");
    let text = fs::read_to_string(manifest).expect("a manifest");
    text.split("[dependencies]")
        .nth(1)
        .unwrap_or("")
        .lines()
        .take_while(|l| !l.starts_with('['))
        .filter(|l| l.starts_with("wingbeat"))
        .map(|l| l.split(['.', ' ', '=']).next().expect("a name").to_string())
        .collect()
}

#[test]
fn invariant_dependency_graph_is_the_architecture() {
    let expect = [
        ("wingbeat-vortex", vec![]),
        ("wingbeat-math", vec![]),
        ("wingbeat-structure", vec!["math"]),
        ("wingbeat-model", vec!["math", "structure"]),
        ("wingbeat-dynamics", vec!["math"]),
        ("wingbeat-blade", vec!["math"]),
        ("wingbeat-air", vec!["math", "vortex"]),
        (
            "wingbeat-flight",
            vec!["math", "model", "dynamics", "blade", "air", "structure"],
        ),
        (
            "wingbeat-analysis",
            vec![
                "math",
                "model",
                "dynamics",
                "blade",
                "air",
                "structure",
                "flight",
            ],
        ),
        (
            "wingbeat-case",
            vec![
                "math", "model", "dynamics", "blade", "air", "flight", "analysis",
            ],
        ),
        (
            "wingbeat-results",
            vec![
                "math", "model", "dynamics", "air", "flight", "analysis", "case",
            ],
        ),
        (
            "wingbeat-draw",
            vec!["math", "model", "flight", "case", "results"],
        ),
        (
            "wingbeat-campaign",
            vec!["math", "flight", "analysis", "case", "results", "draw"],
        ),
        (
            "wingbeat-verify",
            vec![
                "math",
                "structure",
                "model",
                "vortex",
                "air",
                "flight",
                "analysis",
                "case",
            ],
        ),
    ];
    for (name, needed) in expect {
        let needed: BTreeSet<_> = needed.iter().map(|d| format!("wingbeat-{d}")).collect();
        assert_eq!(dependencies(name), needed, "{name}");
    }
}

/// Only the package for Python knows Python.
#[test]
fn invariant_library_crates_know_nothing_of_python() {
    for entry in fs::read_dir(root().join("crates")).expect("crates") {
        let path = entry.expect("a crate").path();
        let text = fs::read_to_string(path.join("Cargo.toml")).expect("a manifest");
        let knows = ["pyo3", "numpy"].iter().any(|word| text.contains(word));
        assert_eq!(
            knows,
            path.ends_with("wingbeat-python"),
            "{}",
            path.display()
        );
    }
}

/// Modules of a crate that lie in import cycles: among files, and among the files and folders of a folder.
fn tangled(crate_name: &str) -> BTreeSet<String> {
    let src = root().join("crates").join(crate_name).join("src");
    let graph = modules::graph(&src, &rust_files(&src));
    assert!(graph.len() > 1, "{crate_name} has modules");
    let folders = modules::folders(&graph);
    let within = folders.values().flat_map(modules::cycles);
    let all = modules::cycles(&graph).into_iter().chain(within);
    all.map(|m| format!("crate::{}", m.join("::"))).collect()
}

#[test]
fn invariant_no_import_cycle_among_the_modules_of_a_crate() {
    let mut problems = vec![];
    for entry in fs::read_dir(root().join("crates")).expect("crates") {
        let name = entry.expect("a crate").file_name();
        let name = name.to_str().expect("a name");
        let found = tangled(name);
        if !found.is_empty() {
            problems.push(format!(
                "{name}: modules import each other in circles: {found:#?}"
            ));
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// The reader of imports itself: two files that import each other through a re-export, and a folder that
/// imports what imports it.
#[test]
fn behaves_cycles_are_found() {
    let dir = std::env::temp_dir().join(format!("wingbeat-modules-{}", std::process::id()));
    let write = |name: &str, text: &str| {
        let path = dir.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    };
    let found = || {
        let graph = modules::graph(&dir, &rust_files(&dir));
        let folders = modules::folders(&graph);
        let within = folders.values().any(|f| !modules::cycles(f).is_empty());
        (modules::cycles(&graph).len(), within)
    };
    write("lib.rs", "mod a; mod b; pub use a::A;");
    write("a.rs", "pub struct A;");
    write("b.rs", "use crate::A; pub struct B(A);");
    assert_eq!(found(), (0, false));
    // In a test it does not count.
    write(
        "a.rs",
        "pub struct A; #[cfg(test)] mod tests { use crate::b::B; }",
    );
    assert_eq!(found(), (0, false));
    write("a.rs", "pub struct A; fn f() { vec![crate::b::B::new()]; }");
    assert_eq!(found(), (2, true));
    // Folders import each other though no file does.
    write("a.rs", "pub struct A;");
    write("lib.rs", "mod a; mod x; mod y;");
    write("x/mod.rs", "mod one; mod two;");
    write("x/one.rs", "use crate::y::one::Y;");
    write("x/two.rs", "pub struct X;");
    write("y/mod.rs", "pub mod one; mod two;");
    write("y/one.rs", "pub struct Y;");
    write("y/two.rs", "use crate::x::two::X;");
    write("b.rs", "");
    assert_eq!(found(), (0, true));
    fs::remove_dir_all(&dir).expect("removed");
}

#[test]
fn invariant_below_cases_nothing_touches_files_clock_environment_or_chance() {
    let banned = [
        "std::fs",
        "std::env",
        "std::time",
        "SystemTime",
        "Instant::now",
        "rand::",
        "File::",
    ];
    for name in [
        "vortex",
        "math",
        "structure",
        "model",
        "dynamics",
        "blade",
        "air",
        "flight",
        "analysis",
    ] {
        for file in rust_files(&root().join(format!("crates/wingbeat-{name}/src"))) {
            let text = fs::read_to_string(&file).expect("a source file");
            for (n, line) in text.lines().enumerate() {
                if line.trim_start().starts_with("//") {
                    continue;
                }
                for word in banned {
                    assert!(!line.contains(word), "{}:{}: {word}", file.display(), n + 1);
                }
            }
        }
    }
}

/// Rows `| number | functions | tests |` of the equation index.
fn equation_index() -> Vec<(usize, Vec<String>, Vec<String>)> {
    let text = fs::read_to_string(root().join("NOTATION.md")).expect("NOTATION.md");
    let cells = |line: &str| -> Vec<String> {
        line.trim_matches('|')
            .split('|')
            .map(|c| c.trim().to_string())
            .collect()
    };
    let quoted = |cell: &str| -> Vec<String> {
        cell.split('`')
            .skip(1)
            .step_by(2)
            .map(str::to_string)
            .collect()
    };
    text.lines()
        .skip_while(|l| !l.starts_with("## Equation index"))
        .filter(|l| l.starts_with('|'))
        .map(cells)
        .filter_map(|c| Some((c[0].parse().ok()?, quoted(&c[2]), quoted(&c[3]))))
        .collect()
}

/// All sources without comments, imports and tests inside of them.
fn code_in_use() -> String {
    let crates = fs::read_dir(root().join("crates")).expect("crates");
    let folders = crates.map(|c| c.expect("a crate").path().join("src"));
    let files: Vec<_> = folders.flat_map(|src| rust_files(&src)).collect();
    let code = |file: &PathBuf| -> String {
        let text = fs::read_to_string(file).expect("a source file");
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let lines = code.lines().filter(|l| {
            let l = l.trim_start();
            !["//", "use ", "pub use "].iter().any(|s| l.starts_with(s))
        });
        lines.map(|l| format!("{l}\n")).collect()
    };
    files.iter().map(code).collect()
}

/// Whether `name` is in the code otherwise than where it is declared.
fn is_used(code: &str, name: &str) -> bool {
    code.match_indices(name).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + name.len()..]);
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let is_whole = !before.ends_with(is_word) && !after.starts_with(is_word);
        let kinds = ["fn ", "struct ", "const ", "trait ", "impl "];
        is_whole && !kinds.iter().any(|kind| before.ends_with(kind))
    })
}

#[test]
fn exact_a_function_that_is_only_declared_is_not_in_use() {
    let code = "pub fn lift(x: f64) { drag(x) }\nfn drag(x: f64) {}\nfn airlift() { airlifted() }";
    assert!(is_used(code, "drag") && !is_used(code, "lift"));
}

#[test]
fn invariant_every_seed_equation_has_a_function_and_a_test_that_exist() {
    let sources: String = rust_files(&root().join("crates"))
        .iter()
        .map(|f| fs::read_to_string(f).expect("a source file"))
        .collect();
    let flown = code_in_use();
    let index = equation_index();
    let numbers: Vec<_> = index.iter().map(|row| row.0).collect();
    assert_eq!(
        numbers,
        (1..=30).collect::<Vec<_>>(),
        "equations 1 to 30, in order"
    );
    for (number, functions, tests) in index {
        assert!(
            !functions.is_empty() && !tests.is_empty(),
            "eq. {number} lacks a function or a test"
        );
        for function in &functions {
            let name = function.rsplit("::").next().expect("a name");
            let declared = ["fn ", "struct ", "const ", "trait "]
                .iter()
                .any(|kind| sources.contains(&format!("{kind}{name}")));
            assert!(declared, "eq. {number}: {function} is not in the sources");
            assert!(
                is_used(&flown, name),
                "eq. {number}: {function} is only tested"
            );
        }
        for test in &tests {
            assert!(
                sources.contains(&format!("fn {test}(")),
                "eq. {number}: no test {test}"
            );
        }
    }
}
