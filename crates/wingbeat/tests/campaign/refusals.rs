//! Wrong campaign files: each is refused with its line, what is allowed and what to try, and nothing is written.

use std::fs;

use crate::support::{Scratch, contents, wingbeat};
use crate::write;

/// A campaign that is fine.
const GOOD: &str = r#"# A campaign that is fine.
case = "case.toml"
do = ["run"]
keep = ["end.mass_centre_n3_m", "summary.mass_kg"]
samples = 3
seed = 1

[set]
"time.beats" = 1

[parameter."motion.frequency_hz"]
range = { from = 90.0, to = 110.0, count = 3 }

[parameter."body.part.thorax.mass_kg"]
uniform = { from = 1e-6, to = 2e-6 }

[[zip]]
"wing.right.planform.rectangle.chord_m" = [1e-3, 2e-3]
"wing.right.planform.rectangle.span_m" = [2e-3, 3e-3]
"#;

/// What is put in the place of what; a text in the line that the report names; words of the report.
type Wrong = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

const FILES: [Wrong; 44] = [
    (
        "do = [\"run\"]",
        "do = [\"run\"",
        "keep =",
        &["this is not TOML"],
    ),
    (
        "case = \"case.toml\"\n",
        "",
        "",
        &["case: this key is missing", "add `case = ...`"],
    ),
    (
        "case.toml",
        "case.tml",
        "case =",
        &["no case file and no preset called `case.tml`"],
    ),
    (
        "samples = 3",
        "sample = 3",
        "sample =",
        &["unknown key `sample`", "did you mean `samples`?"],
    ),
    (
        "[\"run\"]",
        "[\"rum\"]",
        "do =",
        &["unknown choice `rum`", "did you mean `run`?"],
    ),
    ("[\"run\"]", "[]", "do =", &["nothing is done"]),
    (
        "[\"run\"]",
        "[\"run\", \"run\"]",
        "do =",
        &["this is done twice"],
    ),
    (
        "[\"run\"]",
        "[\"run\", \"power\"]",
        "do =",
        &["this needs a trimmed flight", "put \"trim\" before it"],
    ),
    (
        "end.mass_centre_n3_m",
        "end.mass_center_n3_m",
        "keep =",
        &[
            "no number called `end.mass_center_n3_m`",
            "did you mean `end.mass_centre_n3_m`?",
        ],
    ),
    (
        "summary.mass_kg",
        "power.peak_watt",
        "keep =",
        &["`power.peak_watt` is a number of `power`, which is not done"],
    ),
    (
        "summary.mass_kg",
        "end.mass_centre_n3_m",
        "keep =",
        &["kept twice"],
    ),
    (
        "[\"end.mass_centre_n3_m\", \"summary.mass_kg\"]",
        "[]",
        "keep =",
        &["no number is kept"],
    ),
    ("seed = 1", "seed = -1", "seed =", &["a whole number >= 0"]),
    (
        "seed = 1",
        "seed = 1\nmean_beats = 0",
        "mean_beats =",
        &["there is no mean over no wingbeat", "a whole number >= 1"],
    ),
    (
        "seed = 1",
        "seed = 4294967297 # beside sobol\n[parameter.\"body.part.thorax.length_m\"]\nsobol = { from = 1e-3, to = 2e-3 }",
        "seed =",
        &["4294967297", "a whole number from 0 to 4294967295"],
    ),
    (
        "\"time.beats\" = 1",
        "\"time.beats\" = 1\n\"motion.frequency_hz\" = 100",
        "\"motion.frequency_hz\" = 100",
        &[
            "`motion.frequency_hz` is varied, by parameter.motion.frequency_hz",
            "remove it from [set]",
        ],
    ),
    (
        "samples = 3\n",
        "",
        "thorax",
        &["this is drawn", "`samples` is missing"],
    ),
    ("samples = 3", "samples = 0", "samples =", &["from 1 to"]),
    (
        "seed = 1",
        "mean_beats = 2",
        "mean_beats",
        &["this has no effect: no mean"],
    ),
    (
        "seed = 1",
        "files = [\"page\", \"page\"]",
        "files",
        &["this is named twice"],
    ),
    (
        "seed = 1",
        "files = [\"pages\"]",
        "files",
        &["unknown choice `pages`", "did you mean `page`?"],
    ),
    (
        "[set]",
        "files = [\"frames\"]\n\n[set]\n\"output.frames_every\" = 0",
        "files",
        &["no frames are there to be kept: output.frames_every is 0"],
    ),
    (
        "seed = 1",
        "format = 2",
        "format",
        &["this version of the language is not known"],
    ),
    (
        "seed = 1",
        "name = \"../x\"",
        "name",
        &["the name becomes the name of a directory"],
    ),
    (
        "seed = 1",
        "table = \"none.csv\"",
        "table",
        &["cannot read", "none.csv"],
    ),
    (
        "seed = 1",
        "table = \"case.toml\"",
        "table",
        &["table = \"case.toml\""],
    ),
    (
        "seed = 1\n",
        "seed = 1\n[trim]\nforward_m_s = 1.0\n",
        "[trim]",
        &["this has no effect: nothing is trimmed"],
    ),
    (
        "seed = 1\n",
        "seed = 1\n[budget]\nattempts = 0\n",
        "attempts",
        &["from 1 to 1000"],
    ),
    (
        "seed = 1\n",
        "seed = 1\n[budget]\ndisk_mb = -2.0\n",
        "disk_mb",
        &["this must be positive"],
    ),
    (
        "seed = 1\n",
        "seed = 1\n[budget]\ntime_per_point_s = 1e20\n",
        "time_per_point_s",
        &["longer than any flight takes", "at most 1e9 s"],
    ),
    (
        "seed = 1\n",
        "seed = 1\n[retention]\nevery = 2\n",
        "every",
        &["this has no effect without files"],
    ),
    (
        "\"time.beats\" = 1",
        "\"time.beat\" = 1",
        "time.beat",
        &["unknown key `beat`", "did you mean `beats`?"],
    ),
    (
        "\"time.beats\" = 1",
        "\"output.page\" = true",
        "output.page",
        &["`files` says what is drawn"],
    ),
    (
        "motion.frequency_hz",
        "motion.frequenzy_hz",
        "frequenzy",
        &["unknown key `frequenzy_hz`", "did you mean `frequency_hz`?"],
    ),
    (
        "range = {",
        "rang = {",
        "rang =",
        &["unknown key `rang`", "did you mean `range`?"],
    ),
    (
        "count = 3",
        "count = 1",
        "range =",
        &["a range has both of its ends"],
    ),
    (
        "count = 3",
        "count = 30_000_000",
        "range =",
        &[
            "these are too many values",
            "a whole number from 2 to 1000000",
            "take fewer",
        ],
    ),
    (
        "to = 110.0",
        "to = 90.0",
        "range =",
        &["the ends of this range are the same"],
    ),
    (
        "from = 90.0",
        "from = -90.0",
        "range =",
        &["must not be negative", "remove the minus sign"],
    ),
    (
        "range = { from = 90.0, to = 110.0, count = 3 }",
        "list = []",
        "list",
        &["this list is empty"],
    ),
    (
        "from = 1e-6, to = 2e-6",
        "from = 2e-6, to = 1e-6",
        "uniform",
        &["nothing between these ends"],
    ),
    (
        "uniform = {",
        "log_uniform = { to = 2e-6, from = 0.0 }\nsobol = {",
        "thorax",
        &["this varies in 2 ways: log_uniform, sobol"],
    ),
    (
        "uniform = { from = 1e-6, to = 2e-6 }",
        "normal = { mean = 1e-6, standard_deviation = 0.0 }",
        "normal",
        &["this must be positive"],
    ),
    (
        "[2e-3, 3e-3]",
        "[2e-3]",
        "span_m",
        &["this list has 1 values, others of its group 2"],
    ),
];

#[test]
fn refuses_wrong_files_with_their_lines() {
    let scratch = Scratch::new("campaign-wrong");
    let dir = &scratch.0;
    write(dir, GOOD);
    let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
    assert!(
        out.status.success(),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    assert_eq!(
        String::from_utf8(out.stdout).unwrap().lines().count(),
        1 + 3 * 2 * 3
    );
    for (from, to, at, words) in FILES {
        assert!(GOOD.contains(from), "the test replaces nothing: {from}");
        let text = GOOD.replacen(from, to, 1);
        write(dir, &text);
        let before = contents(dir);
        for command in ["plan", "run"] {
            let out = wingbeat(dir, &["campaign", command, "c.toml"]);
            let report = String::from_utf8(out.stderr).unwrap();
            assert_eq!(out.status.code(), Some(2), "{to}: {report}");
            for word in words {
                assert!(report.contains(word), "{to}: `{word}` not in:\n{report}");
            }
            let line = text.lines().position(|l| l.contains(at)).map(|k| k + 1);
            if !at.is_empty() {
                let place = format!("c.toml:{}:", line.unwrap());
                assert!(report.contains(&place), "{to}: {place} not in:\n{report}");
            }
            assert!(report.contains("try: "), "{report}");
        }
        assert!(before == contents(dir), "{to}: something was written");
    }
}

/// Keys that meet each other: twice the same, one within another, an option of the trim where nothing is trimmed.
#[test]
fn refuses_keys_that_vary_twice_and_options_without_effect() {
    let scratch = Scratch::new("campaign-twice");
    let dir = &scratch.0;
    let more = [
        (
            "[[zip]]\n\"motion.frequency_hz\" = [1, 2]\n\"time.steps_per_beat\" = [40, 60]\n",
            "varied already",
        ),
        ("[parameter.motion]\nlist = [1]\n", "varied already"),
        (
            "[parameter.\"trim.forward_m_s\"]\nlist = [0.1]\n",
            "nothing is trimmed",
        ),
        (
            "[parameter.motion.period]\nlist = [0.1]\n",
            "varied already",
        ),
        (
            "[parameter.\"wing.right.hinge_m\"]\nlist = [{ a = 1 }]\n",
            "a table is no value of a key",
        ),
    ];
    for (text, word) in more {
        write(dir, &format!("{GOOD}{text}"));
        let out = wingbeat(dir, &["campaign", "run", "c.toml"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{text}: {report}");
        assert!(
            report.contains(word) || text.contains("period"),
            "{text}: {report}"
        );
    }
    assert!(!dir.join("results").exists());
}

#[test]
fn refuses_a_campaign_from_the_standard_input() {
    let scratch = Scratch::new("campaign-input");
    for command in ["check", "plan", "run", "status", "numbers"] {
        let out = wingbeat(&scratch.0, &["campaign", command, "-"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{command}: {report}");
        assert!(
            report.contains("workers read the file of a campaign again"),
            "{report}"
        );
        assert!(report.contains("write it to a file"), "{report}");
    }
}

#[test]
fn refuses_a_directory_that_holds_something_else() {
    let scratch = Scratch::new("campaign-elsewhere");
    let dir = &scratch.0;
    write(dir, GOOD);
    fs::create_dir(dir.join("mine")).unwrap();
    fs::write(dir.join("mine/notes.txt"), "mine").unwrap();
    let before = contents(dir);
    for command in ["run", "status", "merge", "retry", "view"] {
        let out = wingbeat(dir, &["campaign", command, "c.toml", "--out", "mine"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{command}: {report}");
        assert!(report.contains("no campaign.toml"), "{command}: {report}");
    }
    for (option, value) in [
        ("--shard", "0/2"),
        ("--shard", "3/2"),
        ("--points", "5..5"),
        ("--points", "0..19"),
    ] {
        let out = wingbeat(dir, &["campaign", "run", "c.toml", option, value]);
        assert_eq!(out.status.code(), Some(2), "{option} {value}");
    }
    assert!(before == contents(dir));
}

/// Steps of a trim are whole: 50.7 is not taken for 50.
#[test]
fn refuses_a_fraction_of_a_step_of_the_trim() {
    let scratch = Scratch::new("campaign-fraction");
    let dir = &scratch.0;
    let text = |list: &str| {
        format!(
            "case = \"fruit-fly-blade\"\ndo = [\"trim\"]\nkeep = [\"trim.residual\"]\n[parameter.\"trim.steps_per_beat\"]\nlist = [{list}]\n"
        )
    };
    write(dir, &text("50.0, 60"));
    let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
    assert!(out.status.success(), "{out:?}");
    for (list, word) in [
        ("50.7", "50.7 has a fraction"),
        ("1e300", "steps per wingbeat"),
    ] {
        write(dir, &text(list));
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{report}");
        for part in ["c.toml:4:", word, "a whole number from 20 to 2000"] {
            assert!(report.contains(part), "{part} not in:\n{report}");
        }
    }
}

/// Values of any length are traced to their lines, wherever they stand.
#[test]
fn refuses_long_values_with_their_lines() {
    let scratch = Scratch::new("campaign-long");
    let dir = &scratch.0;
    let long = "long".repeat(50);
    let set = format!("[set]\n\"body.part.thorax.mass_kg.a\" = \"{long}\"\n");
    let varied = format!("[parameter.\"body.part.thorax.mass_kg.a\"]\nlist = [\"{long}\"]\n");
    for text in [set, varied] {
        let head = "case = \"case.toml\"\nkeep = [\"summary.mass_kg\"]\n";
        write(dir, &format!("{head}{text}"));
        let out = wingbeat(dir, &["campaign", "plan", "c.toml"]);
        let report = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2), "{report}");
        assert!(report.contains("c.toml:4:"), "{report}");
    }
}
