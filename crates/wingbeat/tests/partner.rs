//! Programs that compute the air: named before they are started, never started by a command that
//! only looks, ended with all their children, and never believed without limit.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Output;
use std::time::{Duration, Instant};

mod support;

use support::{QUICK, Scratch, wingbeat};

/// A case whose air is the shell script `script`.
fn scripted(dir: &Path, script: &str, timeout: &str) {
    let air = format!(
        "[air]\nmodel = \"external\"\nexternal = {{ command = [\"sh\", \"-c\", {script:?}], timeout_s = {timeout} }}\n"
    );
    let case = QUICK.replace("[air]\nmodel = \"none\"\n", &air);
    fs::write(dir.join("case.toml"), case).unwrap();
}

fn complaint(out: &Output) -> String {
    String::from_utf8_lossy(&out.stderr).into_owned()
}

#[test]
fn behaves_a_check_starts_nothing_and_a_run_says_what_it_starts() {
    let scratch = Scratch::new("check-starts");
    let dir = &scratch.0;
    scripted(dir, "touch started; echo nonsense", "5");
    let out = wingbeat(dir, &["check", "case.toml"]);
    assert!(out.status.success(), "{}", complaint(&out));
    let said = String::from_utf8(out.stdout).unwrap();
    assert!(
        said.contains("will start this one with your rights: sh -c \"touch started"),
        "{said}"
    );
    assert!(!dir.join("started").exists());
    for extra in [&[][..], &["--quiet"], &["--json"]] {
        let args = [&["run", "case.toml", "--out", "r"][..], extra].concat();
        let said = complaint(&wingbeat(dir, &args));
        let named = said.find("which runs with your rights: sh -c \"touch started");
        let failed = said.find("expected `ready 2`, got `nonsense`");
        assert!(named.is_some() && named < failed, "{said}");
        assert!(dir.join("started").exists() && !dir.join("r").exists());
        fs::remove_file(dir.join("started")).unwrap();
    }
}

/// Says `ready 2`, then answers 6 zeros for each of the three bodies, as long as it is asked.
const CALM: &str = r#"while read a b c; do case $a in
bodies) echo ready 2;; evaluate) echo 0 0 0 0 0 0; echo 0 0 0 0 0 0; echo 0 0 0 0 0 0;; esac; done"#;

#[test]
fn behaves_looking_at_a_result_starts_nothing() {
    let scratch = Scratch::new("look-starts");
    let dir = &scratch.0;
    scripted(dir, &format!("date >> started; {CALM}"), "5");
    let keep = ["--set", "output.keep_checkpoint=true"];
    let fly = wingbeat(
        dir,
        &[&["run", "case.toml", "--quiet", "--out", "r"], &keep[..]].concat(),
    );
    assert!(fly.status.success(), "{}", complaint(&fly));
    let starts = || {
        fs::read_to_string(dir.join("started"))
            .unwrap()
            .lines()
            .count()
    };
    assert_eq!(starts(), 1);
    let looks: [&[&str]; 9] = [
        &["show", "r"],
        &["compare", "r", "r"],
        &["plot", "r", "--overwrite"],
        &["view", "r", "--no-open"],
        &["export", "r", "--format", "hdf5"],
        &["velocity", "r", "--point", "0,0,0"],
        &["check", "r/case.toml"],
        &["resume", "r"],
        &["check", "case.toml"],
    ];
    for args in looks {
        wingbeat(dir, args);
        assert_eq!(starts(), 1, "{args:?}");
    }
}

/// Whether the process whose number is in this file still runs.
fn lives(pid_file: &Path) -> bool {
    let pid = fs::read_to_string(pid_file).unwrap();
    let stat = fs::read_to_string(format!("/proc/{}/stat", pid.trim()));
    stat.is_ok_and(|s| !s.contains(") Z "))
}

#[test]
fn behaves_a_silent_program_ends_with_its_children() {
    let scratch = Scratch::new("children");
    let dir = &scratch.0;
    let silent = "sleep 300 & echo $! > child; echo $$ > leader; trap '' TERM; sleep 300";
    scripted(dir, silent, "0.5");
    let began = Instant::now();
    let out = wingbeat(dir, &["run", "case.toml", "--out", "r"]);
    assert_eq!(out.status.code(), Some(2));
    let said = complaint(&out);
    assert!(
        said.contains("no answer within 0.5 s; allow more with air.external.timeout_s"),
        "{said}"
    );
    assert!(began.elapsed() < Duration::from_secs(8));
    for name in ["child", "leader"] {
        assert!(!lives(&dir.join(name)), "the {name} lives on");
    }
    // Children of a program that ends by itself do not stay either.
    scripted(dir, &format!("sleep 300 & echo $! > child; {CALM}"), "5");
    let out = wingbeat(dir, &["run", "case.toml", "--quiet", "--out", "r"]);
    assert!(out.status.success(), "{}", complaint(&out));
    assert!(!lives(&dir.join("child")));
}

#[test]
fn refuses_programs_that_talk_without_end_or_do_not_listen() {
    let scratch = Scratch::new("talk");
    let dir = &scratch.0;
    let zeros = "yes '0 0 0 0 0 0'";
    let talks = [
        ("yes | tr -d '\\n'", "a line is longer than 4096 bytes"),
        ("yes", "expected `ready 2`, got `y`"),
        ("cat /dev/zero", "a line is longer than 4096 bytes"),
        ("echo ready 2; printf '\\377\\n'", "a line is not UTF-8"),
        ("echo ready 2; echo 0 0 0 0 0 nan; sleep 9", "not finite"),
        (
            "echo ready 2; echo 0 0 0 0 0; sleep 9",
            "expected six numbers",
        ),
        (
            "exec 0<&-; sleep 1; echo error I am deaf; sleep 9",
            "I am deaf",
        ),
        ("true", "it ended its output"),
        // Never reads: sooner or later there is no room for another question.
        (
            &format!("echo ready 2; {zeros}"),
            "it does not read its input within 1 s",
        ),
    ];
    for (script, wanted) in talks {
        scripted(dir, script, "1");
        let limit = "ulimit -v 4000000; exec \"$0\" \"$@\"";
        let mut command = std::process::Command::new("sh");
        command.args(["-c", limit, env!("CARGO_BIN_EXE_wingbeat")]);
        command.args(["run", "case.toml", "--quiet", "--out", "r", "--overwrite"]);
        command.args(["--set", "time.beats=1000"]);
        let began = Instant::now();
        let out = command.current_dir(dir).output().unwrap();
        let said = complaint(&out);
        assert!(matches!(out.status.code(), Some(1 | 2)), "{script}: {said}");
        assert!(said.contains(wanted), "{script}: {said}");
        assert!(began.elapsed() < Duration::from_secs(10), "{script}");
    }
}
