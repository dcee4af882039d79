//! Files that are no cases.

use crate::field::Field;
use crate::support::QUICK;

#[test]
fn refuses_files_that_are_no_cases() {
    let mut field = Field::new("attack-files");
    let table = |rows: &str| {
        QUICK.replace(
            "phi.fourier]\ncosine_deg = [60.0]",
            &format!("phi.table]\n{rows}"),
        )
    };
    let part = |rows: &str| QUICK.replace("length_m = 1e-3\ndiameter_m = 1e-3\n", rows);
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("empty", vec![]),
        ("zeros", vec![0; 4096]),
        ("latin", b"name = \"caf\xe9\"".to_vec()),
        ("marks", b"\xef\xbb\xbf\xff\xfe".to_vec()),
        ("json", b"{\"format\": 1}".to_vec()),
        ("script", b"#!/bin/sh\necho hello\n".to_vec()),
        ("half", QUICK.as_bytes()[..200].to_vec()),
        ("twice", [QUICK, QUICK].concat().into()),
        (
            "dots",
            format!("format = 1\n{} = 1\n", vec!["a"; 20_000].join(".")).into(),
        ),
        (
            "headers",
            format!("format = 1\n[{}]\n", vec!["a"; 20_000].join(".")).into(),
        ),
        (
            "lists",
            format!("x = {}{}\n", "[".repeat(20_000), "]".repeat(20_000)).into(),
        ),
        (
            "tables",
            format!("x = {}1{}\n", "{a = ".repeat(20_000), "}".repeat(20_000)).into(),
        ),
        (
            "line",
            format!("name = \"{}\"", "x".repeat(5_000_000)).into(),
        ),
        ("format", QUICK.replace("format = 1", "format = 1.5").into()),
        ("no-rows", table("rows_deg = []").into()),
        ("no-file", table("file = \"nowhere.csv\"").into()),
        ("empty-csv", table("file = \"empty.csv\"").into()),
        ("header-csv", table("file = \"header.csv\"").into()),
        ("short-csv", table("file = \"short.csv\"").into()),
        ("device", table("file = \"/dev/zero\"").into()),
        ("folder-csv", table("file = \"folder\"").into()),
        ("own-csv", table("file = \"case.toml\"").into()),
        ("mesh", part("file = \"nowhere.obj\"\n").into()),
        ("mesh-empty", part("file = \"empty.obj\"\n").into()),
        ("mesh-index", part("file = \"index.obj\"\n").into()),
        ("mesh-format", part("file = \"mine.txt\"\n").into()),
        ("mesh-device", part("file = \"/dev/random\"\n").into()),
        ("mesh-stl", part("file = \"huge.stl\"\n").into()),
        (
            "quads",
            part("nodes_m = [[0,0,0]]\nquads = [[0, 1, 2, 9223372036854775807]]\n").into(),
        ),
    ];
    field.file("empty.csv", "");
    field.file("header.csv", "phase,phi\n");
    field.file("short.csv", "phase,phi\n0,1\n");
    field.file("empty.obj", "");
    field.file("index.obj", "v 0 0 0\nf 1 2 99999999999999999999\n");
    // A binary STL that promises four thousand million triangles.
    field.file("huge.stl", [&[0; 80][..], &[0xff; 4]].concat());
    let names: Vec<String> = files.iter().map(|f| format!("{}.toml", f.0)).collect();
    for ((_, text), name) in files.iter().zip(&names) {
        field.file(name, text);
    }
    for name in &names {
        field.refused(&["check", name]);
        field.refused(&["run", name, "--out", "new"]);
    }
    field.end(50);
}
