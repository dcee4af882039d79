//! Bad numbers and words on the command line.

use std::process::Command;

use crate::field::Field;

/// No number of any kind.
const NO_NUMBERS: [&str; 8] = ["nan", "inf", "-inf", "1e999", "", "two", "1,5", "0x10"];

#[test]
fn refuses_bad_numbers_in_every_option() {
    let mut field = Field::new("attack-options");
    let counts: [(&[&str], &str); 9] = [
        (&["run", "case.toml", "--out", "new"], "--threads"),
        (&["resume", "r"], "--threads"),
        (&["trim"], "--steps"),
        (&["trim"], "--hold"),
        (&["stabilise"], "--beats"),
        (&["stabilise"], "--latency"),
        (&["stabilise"], "--sample"),
        (
            &["velocity", "r", "--corner", "0,0,0", "--corner", "1,0,0"],
            "--line",
        ),
        (&["plot", "r"], "--step"),
    ];
    let no_counts = [
        "-1",
        "1.5",
        "18446744073709551616",
        "99999999999999999999999",
    ];
    let too_many = ["0", "18446744073709551615", "1000000000"];
    for (command, option) in counts {
        for value in no_counts.into_iter().chain(NO_NUMBERS) {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
        let whole = ["--latency", "--step"].contains(&option);
        for value in too_many.into_iter().filter(|v| !whole || *v != "0") {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
    }
    let numbers: [(&[&str], &str, &[&str]); 8] = [
        (&["plot", "r"], "--from", &[]),
        (&["plot", "r"], "--to", &[]),
        (&["plot", "r"], "--beats", &["0", "-1"]),
        (&["trim"], "--forward", &["340", "-1e308", "1e308"]),
        (&["stability"], "--climb", &["340", "-1e308", "1e308"]),
        (&["power"], "--muscle", &["0", "-0.3", "1.01", "1e308"]),
        (
            &["view", "r", "--no-open"],
            "--size",
            &["0", "-1", "1e308", "1e5"],
        ),
        (
            &["velocity", "r"],
            "--point",
            &["0,0", "0,0,0,0", "nan,0,0", "1e308,0,0", ",,", "0;0;0"],
        ),
    ];
    for (command, option, bad) in numbers {
        for value in bad.iter().copied().chain(NO_NUMBERS) {
            field.refused(&[command, &[&format!("{option}={value}")]].concat());
        }
    }
    for plane in [
        "100000x100000",
        "1x1",
        "0x5",
        "5",
        "5x5x5",
        "x",
        "4294967296x4294967296",
        "-2x2",
    ] {
        field.refused(&["velocity", "r", "--plane", plane, "--corner", "0,0,0"]);
    }
    for tilt in [
        ["nan", "0", "0"],
        ["0", "inf", "0"],
        ["0", "0", "181"],
        ["a", "0", "0"],
    ] {
        field.refused(&[&["stabilise", "--tilt"], &tilt[..]].concat());
    }
    field.end(180);
}

/// Negative numbers are refused by what an option takes, and not taken for options.
#[test]
fn refuses_negative_numbers_by_their_option() {
    let dir = std::env::temp_dir();
    let point = &["campaign", "run", "c.toml"][..];
    for (command, option, value) in [
        (&["run", "fruit-fly-blade"][..], "--threads", "-1"),
        (&["ensemble", "fruit-fly-blade"], "--members", "-1"),
        (&["plot", "r"], "--step", "-1"),
        (&["view", "r"], "--size", "-1"),
        (point, "--jobs", "-1"),
        (point, "--points", "-1"),
        (point, "--points", "-1..3"),
        (point, "--shard", "-1/2"),
        (&["flutter"], "--speeds", "-1:2:3"),
        (&["velocity", "r"], "--plane", "-4x5"),
        (&["trim"], "--sideslip", "-inf"),
        (&["trim"], "--forward", "-400.5"),
        (&["stabilise", "--tumbles", "3"], "--seed", "-1"),
    ] {
        let args = [command, &[option, value]].concat();
        let out = Command::new(env!("CARGO_BIN_EXE_wingbeat"))
            .current_dir(&dir)
            .args(&args)
            .output();
        let out = out.unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        assert_eq!(out.status.code(), Some(2), "{args:?}: {said}");
        let names = said.contains(&format!("invalid value '{value}' for")) && said.contains(option);
        let advised = said.contains("give ") && !said.contains("'-- -");
        assert!(names && advised, "{args:?}: {said}");
    }
}

#[test]
fn refuses_bad_words_on_the_command_line() {
    let mut field = Field::new("attack-words");
    let long = "x".repeat(100_000);
    let commands = [
        "",
        "rnu",
        "runn",
        "--run",
        "-x",
        "fruit-fly-hover",
        "case.toml",
        "RUN",
        "run ",
        "..",
        &long,
    ];
    for command in commands {
        field.refused(&[command]);
    }
    let all = [
        "run",
        "resume",
        "view",
        "plot",
        "export",
        "show",
        "compare",
        "check",
        "trim",
        "stability",
        "derivatives",
        "power",
        "stabilise",
        "velocity",
        "verify",
        "presets",
        "new",
        "schema",
    ];
    for command in all {
        field.refused(&[command, "--no-such-option"]);
        field.refused(&[command, "a", "b", "c", "d"]);
    }
    let flies = [
        "run",
        "check",
        "trim",
        "stability",
        "derivatives",
        "power",
        "stabilise",
    ];
    let names = [
        "",
        " ",
        "no-such-case",
        "fruit-fly-hoover",
        "folder",
        "r",
        "/dev/null",
        "/dev/zero",
        "/",
        "mine.txt",
        "case.toml/",
        "nowhere/case.toml",
        &long,
    ];
    for command in flies {
        for name in names {
            field.refused(&[command, name]);
        }
    }
    for command in ["resume", "view", "plot", "show", "velocity"] {
        for name in [
            "",
            "nowhere",
            "folder",
            "mine.txt",
            "/dev/null",
            "case.toml",
            "/",
            &long,
        ] {
            field.refused(&[command, name]);
        }
    }
    let lines: [&[&str]; 22] = [
        &["run", "case.toml", "--quiet", "--json"],
        &["run", "case.toml", "--overwrite"],
        &["run", "case.toml", "--out", ""],
        &["run", "case.toml", "--out", "mine.txt"],
        &["run", "case.toml", "--out", "mine.txt/r"],
        &["run", "case.toml", "--out", "mine.txt", "--overwrite"],
        &["run", "case.toml", "--out", "folder"],
        &["run", "case.toml", "--out", "/dev/null/r"],
        &["plot", "r", "smoke"],
        &["plot", "r", "--style", "loud"],
        &["plot", "r", "--format", "bmp"],
        &["export", "r"],
        &["export", "r", "--format", "docx"],
        &["new"],
        &["new", "no-such-preset"],
        &["new", "benchmark-1", "folder"],
        &["new", "benchmark-1", "/dev/null"],
        &["trim", "--unknowns", "body_pitch", "body_pitch", "luck"],
        &["stability", "table1-sun-2007", "--forward", "1"],
        &["trim", "fruit-fly-blade", "--hold", "3"],
        &["stabilise", "--controller", "free", "--latency", "1"],
        &["verify", "--only", "no such case"],
    ];
    for line in lines {
        field.refused(line);
    }
    field.end(180);
}
