//! `wingbeat new`: cases to start from.

mod support;

use std::fs;
use std::path::Path;

use support::{Scratch, contents, wingbeat};

/// Standard output of a command that succeeds.
fn said(dir: &Path, args: &[&str]) -> String {
    let out = wingbeat(dir, args);
    let problem = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {problem}");
    String::from_utf8(out.stdout).unwrap()
}

/// Standard error of a command that is refused.
fn refused(dir: &Path, args: &[&str]) -> String {
    let out = wingbeat(dir, args);
    assert_eq!(out.status.code(), Some(2), "{args:?}");
    assert!(out.stdout.is_empty(), "{args:?}");
    String::from_utf8(out.stderr).unwrap()
}

#[test]
fn behaves_a_case_names_the_schema_beside_it_and_is_the_case_it_was() {
    let scratch = Scratch::new("new-schema");
    let dir = &scratch.0;
    let text = said(dir, &["new", "benchmark-1", "--schema"]);
    assert!(text.contains("wrote wingbeat.schema.json\nwrote benchmark-1.toml"));
    let case = fs::read_to_string(dir.join("benchmark-1.toml")).unwrap();
    let first = case.lines().next().unwrap();
    let schema = dir.join(first.strip_prefix("#:schema ").unwrap());
    let schema: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(schema).unwrap()).unwrap();
    let tables = case.lines().filter_map(|l| l.strip_prefix('['));
    let tables: Vec<&str> = tables.filter_map(|l| l.split(['.', ']']).next()).collect();
    assert!(tables.len() > 5, "{tables:?}");
    let is_known = |name: &&str| schema["properties"][name].is_object();
    assert!(tables.iter().all(is_known), "{tables:?}");
    let preset = wingbeat::case::LoadedCase::find("benchmark-1", &[]).unwrap();
    let own = wingbeat::case::LoadedCase::from_file(&dir.join("benchmark-1.toml"), &[]).unwrap();
    assert_eq!(own.resolved(), preset.resolved());

    // The schema of the same program is left as it is, a foreign one is not replaced unasked.
    said(dir, &["new", "benchmark-2", "--schema"]);
    fs::write(dir.join("wingbeat.schema.json"), "{}").unwrap();
    let before = contents(dir);
    let problem = refused(dir, &["new", "robobee", "--schema"]);
    assert!(problem.contains("wingbeat.schema.json` exists already"));
    refused(dir, &["new", "robobee", "-", "--schema"]);
    assert_eq!(contents(dir), before);
}
