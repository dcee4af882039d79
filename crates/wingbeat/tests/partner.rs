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
        said.contains("will start this one with your rights: sh -c 'touch started"),
        "{said}"
    );
    assert!(!dir.join("started").exists());
    for extra in [&[][..], &["--quiet"], &["--json"]] {
        let args = [&["run", "case.toml", "--out", "r"][..], extra].concat();
        let said = complaint(&wingbeat(dir, &args));
        let named = said.find("which runs with your rights: sh -c 'touch started");
        let failed = said.find("expected `ready 2`, got `nonsense`");
        assert!(named.is_some() && named < failed, "{said}");
        assert!(dir.join("started").exists() && !dir.join("r").exists());
        fs::remove_file(dir.join("started")).unwrap();
    }
}

/// Says `ready 2`, then answers 6 zeros for each of the three bodies, as long as it is asked.
const CALM: &str = r#"while read a b c; do case $a in
bodies) echo ready 2;; evaluate) echo 0 0 0 0 0 0; echo 0 0 0 0 0 0; echo 0 0 0 0 0 0;; esac; done"#;

/// A line too many, in an answer or after `accept`, ends the flight: loads heard later would be old ones. An
/// error is heard.
#[test]
fn refuses_lines_that_nothing_asked_for() {
    let scratch = Scratch::new("unasked");
    let dir = &scratch.0;
    let extra =
        "it says more than a line for each of the 3 bodies, or a line that nothing asked for: `";
    for (script, wanted) in [
        (
            CALM.replacen("evaluate)", "evaluate) echo 1e-9 0 0 0 0 0;", 1),
            extra, // which of its lines is the surplus one is a matter of time
        ),
        (
            CALM.replacen("esac", "accept) echo 1e-9 0 0 0 0 0;; esac", 1),
            extra,
        ),
        (
            CALM.replacen("esac", "accept) echo error no more;; esac", 1),
            "`: no more",
        ),
    ] {
        // Each answer takes a while, in which what was said before is heard; loads that are none of theirs are
        // small, lest the flight end of them first.
        let script = script.replacen("evaluate)", "evaluate) sleep 0.01;", 1);
        scripted(dir, &script, "5");
        let out = wingbeat(dir, &["run", "case.toml", "--quiet", "--out", "r"]);
        let said = complaint(&out);
        assert_ne!(out.status.code(), Some(0), "{script}");
        assert!(said.contains(wanted), "{said}");
        let _ = fs::remove_dir_all(dir.join("r"));
    }
}

/// Of a line without its end nobody knows how many digits are left out; a complaint without one is heard.
#[test]
fn refuses_a_line_that_the_end_of_output_cuts_off() {
    let scratch = Scratch::new("cut-off");
    let dir = &scratch.0;
    for (last, wanted) in [
        (
            "printf '0 0 0 0 0 1.23'; exit",
            "its output ended within a line: `0 0 0 0 0 1.23`",
        ),
        ("printf 'error no more'; exit", "`: no more"),
    ] {
        let last = format!("evaluate) echo 0 0 0 0 0 0; echo 0 0 0 0 0 0; {last};");
        let script = CALM.replacen("evaluate)", &last, 1);
        scripted(dir, &script, "5");
        let said = complaint(&wingbeat(dir, &["run", "case.toml", "--out", "r"]));
        assert!(said.contains(wanted), "{said}");
        let _ = fs::remove_dir_all(dir.join("r"));
    }
}

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

/// Whether the process whose number is in this file still runs after the seconds that a busy machine may take
/// to end it.
fn lives(pid_file: &Path) -> bool {
    let pid = fs::read_to_string(pid_file).unwrap();
    let runs = || {
        let stat = fs::read_to_string(format!("/proc/{}/stat", pid.trim()));
        stat.is_ok_and(|s| !s.contains(") Z "))
    };
    let began = Instant::now();
    while runs() && began.elapsed() < Duration::from_secs(5) {
        std::thread::sleep(Duration::from_millis(20));
    }
    runs()
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
    assert!(began.elapsed() < AT_ONCE);
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
    let asked = |answer: &str| {
        format!(
            "echo ready 2; while read a b; do case $a in evaluate) {answer}; sleep 300;; esac; done"
        )
    };
    let talks = [
        ("yes | tr -d '\\n'", "a line is longer than 4096 bytes"),
        ("yes", "expected `ready 2`, got `y`"),
        ("cat /dev/zero", "a line is longer than 4096 bytes"),
        ("echo ready 2; printf '\\377\\n'", "a line is not UTF-8"),
        (&asked("echo 0 0 0 0 0 nan"), "not finite"),
        (&asked("echo 0 0 0 0 0"), "expected six numbers"),
        (
            "exec 0<&-; sleep 1; echo error I am deaf; sleep 300",
            "`: I am deaf",
        ),
        ("true", "it ended its output: exit status 0"),
        ("exit 3", "it ended its output: exit status 3"),
        // Answers that no question waits for.
        (
            "echo ready 2; yes '0 0 0 0 0 0'",
            "nothing asked for: `0 0 0 0 0 0`",
        ),
    ];
    // At once: those that are deaf have a second each to end.
    all_at_once(&talks, |number, (script, wanted)| {
        let dir = &dir.join(number.to_string());
        fs::create_dir(dir).unwrap();
        scripted(dir, script, &PATIENCE.to_string());
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
        assert!(began.elapsed() < AT_ONCE, "{script}");
    });
}

/// Does this with each of the list and its number, in threads of their own; what fails in one fails.
fn all_at_once<T: Sync>(list: &[T], of: impl Fn(usize, &T) + Sync) {
    std::thread::scope(|scope| {
        for (number, item) in list.iter().enumerate() {
            let of = &of;
            scope.spawn(move || of(number, item));
        }
    });
}

/// What a program may take [s] that is not meant to be waited for in vain, on a busy machine too; and within what
/// time a flight has ended that waited for none.
const PATIENCE: u64 = 60;
const AT_ONCE: Duration = Duration::from_secs(PATIENCE - 10);

/// The preset's fly in blade elements under a controller in another program.
fn commanded(dir: &Path, out: &str, command: &str, more: &[&str]) -> Output {
    let external = format!("control.external={{command={command},timeout_s={PATIENCE}}}");
    let mut args = vec!["run", "hover.toml", "--quiet", "--out", out];
    for set in ["control.controller=external", &external]
        .iter()
        .chain(more)
    {
        args.extend(["--set", set]);
    }
    wingbeat(dir, &args)
}

/// The trimmed fly of 40 steps a beat.
fn trimmed(dir: &Path) {
    let args = [
        "trim",
        "fruit-fly-blade",
        "--steps",
        "40",
        "--write",
        "hover.toml",
    ];
    support::flown(dir, &args);
}

/// Rows of a column of a history.
fn column(run: &Path, name: &str) -> Vec<f64> {
    let history = wingbeat::results::History::read(&run.join("history.csv")).unwrap();
    history.column(name).to_vec()
}

/// `["python3", "hover.py"]` with the example's path.
fn example() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hover.py");
    format!("[\"python3\",{:?}]", path.to_str().unwrap())
}

#[test]
fn balances_hover_under_a_program_and_goes_on_bit_for_bit() {
    let scratch = Scratch::new("program");
    let dir = &scratch.0;
    trimmed(dir);
    let flight = [
        "time.beats=40",
        "output.checkpoint_every=130",
        "control.sensors={seed=3,tilt_noise_deg=0.2}",
    ];
    let whole = commanded(dir, "whole", &example(), &flight);
    assert!(whole.status.success(), "{}", complaint(&whole));
    let start = [
        "body_x_m",
        "body_y_m",
        "body_z_m",
        "body_phi_rad",
        "body_theta_rad",
        "body_psi_rad",
    ];
    for name in start {
        let rows = column(&dir.join("whole"), name);
        let strayed = rows.iter().fold(0.0_f64, |m, x| m.max((x - rows[0]).abs()));
        println!("{name}: {strayed:e}");
        // A wing length is 2.5 mm; the beat itself pitches by 3 degrees and heaves by 0.02 mm.
        let most = if name.ends_with("_m") { 2.5e-4 } else { 0.1 };
        assert!(strayed < most, "{name}: {strayed}");
    }
    // A program that ends after 18 answers the first time: the flight goes on from the last checkpoint.
    let program = example();
    let path = program.split('"').nth(3).unwrap();
    let once = format!(
        "if [ -e died ]; then exec python3 {path}; fi; touch died; sed -u 18q | python3 {path}"
    );
    let once = serde_json::json!(["sh", "-c", once]).to_string();
    let broken = commanded(dir, "broken", &once, &flight);
    assert_eq!(broken.status.code(), Some(1), "{}", complaint(&broken));
    let resumed = wingbeat(dir, &["resume", "broken"]);
    let said = complaint(&resumed);
    assert!(resumed.status.success(), "{said}");
    assert!(
        said.contains("which runs with your rights: sh -c"),
        "{said}"
    );
    let history = |run: &str| fs::read(dir.join(run).join("history.csv")).unwrap();
    assert_eq!(history("broken"), history("whole"));
}

#[test]
fn refuses_answers_of_a_controller_that_cannot_be_flown() {
    let scratch = Scratch::new("answers");
    let dir = &scratch.0;
    trimmed(dir);
    let one = r#"{"wings":[{}]}"#;
    let nan = r#"{"wings":[{},{"stroke_amplitude":NaN}]}"#;
    let key = r#"{"wings":[{},{"frequency":0.1}]}"#;
    let answers = [
        ("yes", "look 0: `sh -c read line; yes"),
        ("echo 1 2 3", "not what docs/control.md asks for"),
        (
            &format!("echo '{one}'")[..],
            "commands 1 wings, and there are 2, in this order: ",
        ),
        (&format!("echo '{nan}'")[..], "JSON has no NaN"),
        (&format!("echo '{key}'")[..], "unknown field `frequency`"),
        ("echo '{}'", "has no \"wings\""),
        (r#"echo '{"error":"I am lost"}'"#, "`: I am lost"),
        (r#"echo '{"error":""}'"#, "an error without words"),
        (
            "sleep 300",
            "no answer within 2 s; allow more with control.external.timeout_s",
        ),
        ("true", "it ended its output: exit status 0"),
        ("kill -9 $$", "it ended its output: ended by signal 9"),
        (
            "echo '{\"wings\":[{},{}]}'; read line; echo '{}'",
            "look 1: `sh -c",
        ),
        (
            // In one piece, and more than one too many: a line that is heard late is the answer to the next look.
            "printf '%s\\n' '{\"wings\":[{},{}]}' '{\"wings\":[{},{}]}' '{\"wings\":[{},{}]}'; sleep 300",
            "it says more than one line for a look",
        ),
        (
            "echo '{\"wings\":[{},{\"feathering_lead\":1e15}]}'",
            "feathering_lead = 1000000000000000 wingbeats; allowed: from -0.5 to 0.5",
        ),
    ];
    all_at_once(&answers, |number, (script, wanted)| {
        let command = serde_json::json!(["sh", "-c", format!("read line; {script}")]);
        let began = Instant::now();
        let limit: &[&str] = match wanted.contains("within 2 s") {
            true => &["control.external.timeout_s=2"],
            false => &[],
        };
        let more = [&["time.beats=3"], limit].concat();
        let out = commanded(dir, &format!("r{number}"), &command.to_string(), &more);
        let said = complaint(&out);
        assert!(matches!(out.status.code(), Some(1 | 2)), "{script}: {said}");
        assert!(said.contains(wanted), "{script}: {said}");
        assert_eq!(
            said.contains("NaN"),
            script.contains("NaN"),
            "{script}: {said}"
        );
        assert!(
            said.contains("try the program on a line by hand, see docs/control.md"),
            "{script}: {said}"
        );
        assert!(began.elapsed() < AT_ONCE, "{script}");
    });
    let none = commanded(dir, "r", "[\"no-such-program\"]", &[]);
    let said = complaint(&none);
    assert!(
        said.contains("control.external.command") && said.contains("cannot be started"),
        "{said}"
    );
}

#[test]
fn behaves_a_check_starts_no_controller_and_a_run_says_what_it_starts() {
    let scratch = Scratch::new("check-controls");
    let dir = &scratch.0;
    let external = "control.external={command=[\"sh\",\"-c\",\"touch started\"]}";
    let case = [
        "fruit-fly-blade",
        "--set",
        "control.controller=external",
        "--set",
        external,
    ];
    let with = |words: &[&'static str]| [words, &case[..]].concat();
    let out = wingbeat(dir, &with(&["check"]));
    assert!(out.status.success(), "{}", complaint(&out));
    let said = String::from_utf8(out.stdout).unwrap();
    assert!(
        said.contains("will start this one with your rights: sh -c 'touch started'"),
        "{said}"
    );
    assert!(!dir.join("started").exists());
    let out = wingbeat(dir, &with(&["trim", "--steps", "40"]));
    assert!(out.status.success() && !dir.join("started").exists());
    let said = complaint(&wingbeat(dir, &with(&["run", "--out", "r"])));
    let named =
        said.find("the wings are commanded by another program, which runs with your rights");
    let failed = said.find("it ended its output");
    assert!(named.is_some() && named < failed, "{said}");
    assert!(dir.join("started").exists());
}

#[test]
fn exact_the_program_in_the_docs_is_the_example() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("../../docs/control.md")).unwrap();
    let example = fs::read_to_string(root.join("examples/hover.py")).unwrap();
    assert!(page.contains(&format!("```python\n{example}```\n")));
}

#[test]
fn exact_a_program_is_told_the_reference() {
    let scratch = Scratch::new("told");
    let dir = &scratch.0;
    trimmed(dir);
    let script = "while read -r line; do echo \"$line\" >> told; echo '{\"wings\":[{},{}]}'; done";
    let command = serde_json::json!(["sh", "-c", script]).to_string();
    let way = "control.waypoint=[{time_s=0.01,position_m=[0,0,-2e-3],heading_deg=90},{time_s=0.03},{time_s=0.04,heading_deg=0}]";
    let out = commanded(dir, "r", &command, &["time.beats=3", way]);
    assert!(out.status.success(), "{}", complaint(&out));
    let told = fs::read_to_string(dir.join("told")).unwrap();
    let looks: Vec<serde_json::Value> = told
        .lines()
        .map(|l| serde_json::from_str(l).unwrap())
        .collect();
    assert_eq!(looks.len(), 4);
    let number = |look: usize, key: &str| looks[look]["reference"][key].as_f64().unwrap();
    let height = |look: usize| looks[look]["reference"]["position_m"][2].as_f64().unwrap();
    // The second look is half way, and the fourth is beyond the end of the first way.
    assert!((height(1) - height(0) + 1e-3).abs() < 1e-15);
    assert!((height(3) - height(0) + 2e-3).abs() < 1e-15);
    assert!((number(1, "heading_deg") - 45.0).abs() < 1e-12);
    assert!((number(1, "heading_rate_deg_s") - 35.0 / 16.0 * 9000.0).abs() < 1e-8);
    let rows = column(&dir.join("r"), "reference_z_m");
    assert!((rows[40] - height(1)).abs() < 1e-15 && rows.len() == 121);
    // That is counted from the true place of the release, whatever noise there is in what is seen.
    fs::remove_file(dir.join("told")).unwrap();
    let noise = "control.sensors={position_noise_m=1e-4}";
    let out = commanded(dir, "n", &command, &["time.beats=0.5", noise]);
    assert!(out.status.success(), "{}", complaint(&out));
    let told = fs::read_to_string(dir.join("told")).unwrap();
    let noisy: serde_json::Value = serde_json::from_str(told.lines().next().unwrap()).unwrap();
    assert_eq!(noisy["reference"], looks[0]["reference"]);
    assert_ne!(noisy["mass_centre_m"], looks[0]["mass_centre_m"]);
    for (key, value) in [
        ("period_s", 0.005),
        ("interval_s", 0.005),
        ("latency_s", 0.0),
    ] {
        assert_eq!(looks[0][key].as_f64().unwrap(), value, "{key}");
    }
}
