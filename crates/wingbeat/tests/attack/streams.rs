//! Bad streams, and bad places for what is written.

use wingbeat::math::SplitMix64;

use crate::field::{Field, Wanted};
use crate::support::QUICK;

#[test]
fn refuses_streams_that_are_no_case() {
    let mut field = Field::new("attack-streams");
    let nested = |open: &str, n: usize| format!("format = 1\nx = {}", open.repeat(n)).into_bytes();
    let streams: Vec<Vec<u8>> = vec![
        b"".to_vec(),
        b"\n\n \t".to_vec(),
        b"\0\0\0\0".to_vec(),
        b"\xff\xfe\x00".to_vec(),
        b"\xef\xbb\xbf".to_vec(),
        vec![b'a'; 1 << 20],
        vec![b'\n'; 1 << 20],
        nested("[", 100_000),
        nested("{a=", 50_000),
        nested("-", 100_000),
        format!("format = 1\n[{}a]", "a.".repeat(50_000)).into_bytes(),
        format!("format = {}", "9".repeat(100_000)).into_bytes(),
        format!("format = 1e{}", "9".repeat(1000)).into_bytes(),
        b"format = 1\nformat = 1".to_vec(),
        b"format = nan".to_vec(),
        b"{\"format\": 1}".to_vec(),
        b"#:schema ./wingbeat.schema.json\n".to_vec(),
        QUICK.replace("1e-6", "1e-6\0").into_bytes(),
        QUICK.replace("1e-6", "nan").into_bytes(),
        QUICK.replace("[time]", "[time]\n[time]").into_bytes(),
        QUICK.replace("beats = 0.2", "beats = 1e300").into_bytes(),
        QUICK
            .replace("chordwise = 2", "chordwise = 2000000000")
            .into_bytes(),
    ];
    for stream in &streams {
        for command in ["check", "run", "trim", "stability", "power"] {
            field.fed(Wanted::Refused, stream, &[command, "-"]);
        }
    }
    field.end(110);
}

/// What bytes are changed to.
const BYTES: &[u8] = b" =[]{}\"\n#.-+e019xn\xff\0";

/// A byte of a good case changed: whatever comes of it is said.
#[test]
fn behaves_cases_with_a_changed_byte_are_checked_or_refused() {
    let mut field = Field::new("attack-bytes");
    let mut chance = SplitMix64::new(1);
    for _ in 0..100 {
        let mut text = QUICK.as_bytes().to_vec();
        let [place, byte] = [text.len(), BYTES.len()].map(|n| chance.bits() as usize % n);
        text[place] = BYTES[byte];
        field.fed(Wanted::Survived, &text, &["check", "-"]);
    }
    field.end(100);
}

#[test]
fn refuses_bad_places_for_every_text() {
    let mut field = Field::new("attack-places");
    let long = "x".repeat(300);
    let places = [
        "",
        "mine.txt",
        "case.toml",
        "folder",
        "/dev/null",
        "/dev/full",
        "nowhere/x",
        "r/case.toml",
        "r/x/../history.csv",
        "/",
        "..",
        &long,
    ];
    let quick = ["--steps", "20"];
    let commands: [(&[&str], &str); 13] = [
        (&["check", "case.toml"], "--out"),
        (&["show", "r"], "--out"),
        (&["compare", "r", "r"], "--out"),
        (&["compare", "r", "r"], "--page"),
        (&["presets"], "--out"),
        (&["trim", quick[0], quick[1]], "--out"),
        (&["trim", quick[0], quick[1]], "--write"),
        (&["stability", quick[0], quick[1]], "--out"),
        (&["stability", quick[0], quick[1]], "--write"),
        (&["derivatives", quick[0], quick[1]], "--out"),
        (&["power", quick[0], quick[1]], "--out"),
        (&["stabilise", quick[0], quick[1]], "--figure"),
        (&["velocity", "r", "--point", "0,0,0"], "--out"),
    ];
    for (command, option) in commands {
        for place in places {
            field.refused(&[command, &[&format!("{option}={place}")]].concat());
        }
    }
    let twice: [&[&str]; 9] = [
        &["trim", "--steps", "20", "--write", "new", "--out", "new"],
        &["trim", "--steps", "20", "--write", "new", "--out", "./new"],
        &[
            "stability",
            "--steps",
            "8",
            "--write",
            "folder/../new",
            "--out",
            "new",
        ],
        &[
            "stabilise",
            "--steps",
            "8",
            "--figure",
            "new",
            "--out",
            "new",
        ],
        &["compare", "r", "r", "--page", "new", "--out", "new"],
        &["trim", "--write", "new", "--out", "new", "--overwrite"],
        &["trim", "--write", "-", "--json"],
        &["compare", "r", "r", "--page", "-", "--out", "-"],
        &["presets", "--overwrite"],
    ];
    for line in twice {
        field.refused(line);
    }
    for command in ["run", "export", "plot", "verify"] {
        let case = if command == "run" { "case.toml" } else { "r" };
        let args = match command {
            "verify" => vec![command, "--out", "-"],
            "export" => vec![command, case, "--format", "hdf5", "--out", "-"],
            _ => vec![command, case, "--out", "-"],
        };
        field.refused(&args);
    }
    println!("{} attacks", field.count());
    field.end(160);
}
