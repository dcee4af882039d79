//! Hostile surroundings: variables, streams, limits.

use crate::field::{Field, Wanted};

/// Commands that write no file, and fewer words than fill a pipe.
const COMMANDS: [&[&str]; 6] = [
    &["check", "case.toml"],
    &["show", "r"],
    &["compare", "r", "r", "--json"],
    &["trim", "--steps", "20"],
    &["new", "--species", "honeybee", "-"],
    &["presets"],
];

#[test]
fn behaves_whatever_the_surroundings() {
    let mut field = Field::new("attack-surroundings");
    let surroundings = [
        "export TERM=dumb;",
        "unset TERM HOME PATH LANG;",
        "export COLUMNS=0;",
        "export COLUMNS=99999999999999999999;",
        "export NO_COLOR=1 CLICOLOR_FORCE=1;",
        "export RAYON_NUM_THREADS=0;",
        "export RAYON_NUM_THREADS=no;",
        "export RAYON_NUM_THREADS=-1;",
        "export TMPDIR=/nonexistent;",
        "export LANG=xx_YY.no LC_ALL=no;",
        "export RUST_LOG=trace;",
        "ulimit -s 512;",
        "ulimit -c 0; ulimit -t 9;",
        "exec <&-;",
        "exec >&-;",
        "exec 2>&-;",
        "exec <&- >&- 2>&-;",
    ];
    for around in surroundings {
        for command in COMMANDS {
            field.within(Wanted::Done, around, b"", command);
        }
    }
    for command in COMMANDS {
        let full = field.within(Wanted::Survived, "exec >/dev/full;", b"", command);
        assert_eq!(
            full.status.code(),
            Some(1),
            "{command:?}: what it said is lost"
        );
        field.within(Wanted::Survived, "ulimit -n 4;", b"", command);
        field.within(
            Wanted::Survived,
            "mkdir gone; cd gone; rmdir ../gone;",
            b"",
            command,
        );
    }
    field.end(120);
}
