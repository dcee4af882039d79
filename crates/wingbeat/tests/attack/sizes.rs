//! Insects of impossible, extreme and usual sizes.

use crate::field::{Field, Wanted};

/// No size of any kind, whatever the unit.
const NO_SIZES: [&str; 26] = [
    "",
    " ",
    "mg",
    "mm",
    "Hz",
    "0mg",
    "-1mg",
    "-0mm",
    "nan",
    "nanmg",
    "infmm",
    "-inf",
    "1e999mg",
    "1e-999mm",
    "0x10mg",
    "1,5mg",
    "1.5.5mm",
    "1 000mg",
    "100MG",
    "100 lb",
    "1mgmg",
    "\u{663}mg",
    "1\u{b5}g",
    "--",
    "1e400Hz",
    "99999Hz",
];

#[test]
fn refuses_sizes_that_are_none() {
    let mut field = Field::new("attack-sizes");
    let long = "9".repeat(100_000);
    for option in ["--mass", "--wing", "--frequency"] {
        for value in NO_SIZES.into_iter().chain([&long[..]]) {
            field.refused(&["new", &format!("{option}={value}"), "-"]);
        }
    }
    for name in [
        "",
        " ",
        "bee",
        "Honeybee",
        "honey bee",
        "../honeybee",
        "-",
        "fruit-fly-hover",
        &long,
    ] {
        field.refused(&["new", &format!("--species={name}"), "-"]);
    }
    let lines: [&[&str]; 14] = [
        &["new", "--species"],
        &["new", "--frequency", "200"],
        &["new", "--species", "honeybee", "--species", "bumblebee"],
        &["new", "--species", "honeybee", "--mass", "1mg"],
        &["new", "--species", "honeybee", "--frequency", "200"],
        &["new", "--mass", "1mg", "--mass", "2mg"],
        &["new", "--mass", "1mg", "one.toml", "two.toml"],
        &["new", "--mass", "1mg", "--air", "none"],
        &["new", "--air", "lattice"],
        &["new", "robobee", "--air", "blade"],
        &["new", "--mass", "1mg", "mine.txt"],
        &["new", "--mass", "1mg", "folder"],
        &["new", "--mass", "1mg", "nowhere/bee.toml"],
        &["new", "--mass", "1mg", "r/case.toml", "--overwrite"],
    ];
    for line in lines {
        field.refused(line);
    }
    field.end(100);
}

/// Over the whole range of sizes: a case that is checked without a doubt about sizes, or a reason why not.
#[test]
fn behaves_every_size_gives_a_case_or_a_reason() {
    let mut field = Field::new("attack-grid");
    let mut flying = 0;
    for mass in ["20ug", "1mg", "30mg", "1g", "50g"] {
        for wing in [None, Some("0.3mm"), Some("3mm"), Some("12mm"), Some("20cm")] {
            for frequency in [None, Some("1"), Some("120"), Some("1200Hz")] {
                let mut args = vec!["new", "--mass", mass, "-"];
                args.extend(wing.iter().flat_map(|w| ["--wing", w]));
                args.extend(frequency.iter().flat_map(|f| ["--frequency", f]));
                let out = field.attack(Wanted::Survived, &args);
                if out.status.success() {
                    flying += 1;
                    let quick = ["check", "-", "--set", "time.beats=0.02"];
                    field.fed(Wanted::Done, &out.stdout, &quick);
                } else {
                    assert_eq!(out.status.code(), Some(2), "{args:?}");
                }
            }
        }
    }
    println!("{flying} of 100 sizes fly");
    assert!(flying >= 8, "{flying}");
    field.end(100);
}
