//! `-` as the standard input and output: cases and reports pass from program to program.

use std::fs;
use std::process::Output;

use crate::support::{QUICK, Scratch, contents, piped};

fn said(out: &Output) -> &str {
    str::from_utf8(&out.stdout).unwrap()
}

fn told(out: &Output) -> &str {
    str::from_utf8(&out.stderr).unwrap()
}

#[test]
fn behaves_a_case_goes_from_new_to_trim_to_run() {
    let scratch = Scratch::new("pipes");
    let dir = &scratch.0;
    let case = piped(dir, "", &["new", "bumblebee-blade", "-"]);
    assert!(case.status.success() && told(&case).is_empty());
    let preset = wingbeat::case::presets::find("bumblebee-blade").unwrap();
    assert!(said(&case).ends_with(preset.text));
    assert!(contents(dir).is_empty(), "no file named -");

    let check = piped(dir, &case.stdout, &["check", "-"]);
    assert!(said(&check).starts_with("stdin: this case can be flown."));
    let trim = ["trim", "-", "--steps", "40", "--write", "-"];
    let trim = piped(dir, &case.stdout, &trim);
    assert!(trim.status.success(), "{}", told(&trim));
    assert!(said(&trim).starts_with("# `bumblebee-blade`, trimmed"));
    assert!(told(&trim).contains("trimmed after"));
    // The words that hold in a report to a file are not lost either.
    let args = ["trim", "-", "--steps", "40", "--write", "-", "--out", "t"];
    let again = piped(dir, &case.stdout, &args);
    assert_eq!((&again.stdout, told(&again)), (&trim.stdout, ""));
    assert_eq!(fs::read_to_string(dir.join("t")).unwrap(), told(&trim));

    let run = ["run", "-", "--quiet", "--out", "r", "--set", "time.beats=1"];
    let run = piped(dir, &trim.stdout, &run);
    assert!(run.status.success(), "{}", told(&run));
    let kept = fs::read_to_string(dir.join("r/case.toml")).unwrap();
    assert!(kept.contains("bumblebee-blade"));
}

#[test]
fn refuses_streams_that_hold_no_case_or_two_texts() {
    let scratch = Scratch::new("pipes-refused");
    let dir = &scratch.0;
    let long = "x".repeat(100_000);
    let cases: [(&[u8], &[&str], &str); 14] = [
        (b"", &["run", "-"], "standard input`: it is empty"),
        (b" \n", &["trim", "-"], "it is empty"),
        (b"\xff\xfe", &["check", "-"], "UTF-8"),
        (b"format = 1\nbodi = 2", &["run", "-"], "stdin:2:1"),
        (long.as_bytes(), &["stability", "-"], "not TOML"),
        (b"", &["trim", "--write", "-", "--json"], "share"),
        (b"", &["trim", "--write", "-", "--out", "-"], "share"),
        (b"", &["stabilise", "--figure", "-", "--json"], "share"),
        (
            b"",
            &["trim", "--write", "-", "--overwrite"],
            "replaces nothing",
        ),
        (b"", &["run", "--out", "-"], "folder"),
        (b"", &["verify", "--out", "-"], "folder"),
        (b"", &["man", "-"], "folder"),
        (b"", &["show", "-"], "not a result directory"),
        (b"", &["new", "no-such-preset", "-"], "no-such-preset"),
    ];
    for (input, args, reason) in cases {
        let out = piped(dir, input, args);
        assert_eq!(out.status.code(), Some(2), "{args:?}: {}", told(&out));
        assert!(told(&out).contains(reason), "{args:?}: {}", told(&out));
        assert!(out.stdout.is_empty(), "{args:?}");
    }
    assert!(contents(dir).is_empty());
}

#[test]
fn behaves_a_file_named_dash_is_still_within_reach() {
    let scratch = Scratch::new("pipes-file");
    let dir = &scratch.0;
    fs::write(dir.join("-"), QUICK).unwrap();
    let out = piped(dir, "", &["check", "./-"]);
    assert!(said(&out).contains("can be flown"), "{}", told(&out));
    let out = piped(dir, "", &["new", "benchmark-1", "./-"]);
    assert!(told(&out).contains("exists already"), "{}", told(&out));
}
