//! What the tests of the program share.
#![allow(dead_code, reason = "not every test file uses everything")]

use std::collections::BTreeMap;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

use wingbeat::case::LoadedCase;

pub mod readers;

/// A folder of its own, removed at the end.
pub struct Scratch(pub PathBuf);

impl Scratch {
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0); // tests of one process may choose the same name
        let (process, number) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(format!("wingbeat-test-{name}-{process}-{number}"));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Runs the program in a folder.
pub fn wingbeat(dir: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    command.current_dir(dir).args(args).output().unwrap()
}

/// Runs the program in a folder with a text on its standard input.
pub fn piped(dir: &Path, input: impl AsRef<[u8]>, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wingbeat"));
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command
        .current_dir(dir)
        .args(args)
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let _ = stdin.write_all(input.as_ref()); // who refuses at once does not read it
    drop(stdin);
    child.wait_with_output().unwrap()
}

/// Runs the program, which must succeed.
pub fn flown(dir: &Path, args: &[&str]) {
    let out = wingbeat(dir, args);
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {said}");
}

/// `KEY=VALUE` of a case as the library takes them.
pub fn strings(set: &[&str]) -> Vec<String> {
    set.iter().map(|s| (*s).to_owned()).collect()
}

/// The case of a text with these keys set.
pub fn case_of(name: &str, text: &str, set: &[&str]) -> LoadedCase {
    let case = LoadedCase::from_text(name, text, Path::new("."), &strings(set));
    case.unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The preset with these keys set.
pub fn preset(name: &str, set: &[&str]) -> LoadedCase {
    LoadedCase::find(name, &strings(set)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// A case without air, 8 steps long, as `case.toml`; its name is `good`.
pub const QUICK: &str = r#"format = 1
name = "good"
[time]
steps_per_beat = 40
beats = 0.2
[motion]
frequency_hz = 100.0
[air]
model = "none"
[body.part.thorax]
length_m = 1e-3
diameter_m = 1e-3
mass_kg = 1e-6
[wing.right]
hinge_m = [0, 0.5e-3, 0]
mass_kg = 1e-8
[wing.right.planform.rectangle]
chord_m = 1e-3
span_m = 2e-3
[wing.right.mesh]
chordwise = 2
spanwise = 3
[wing.right.motion.phi.fourier]
cosine_deg = [60.0]
"#;

/// Writes [`QUICK`] into a folder.
pub fn quick_case(dir: &Path) {
    fs::write(dir.join("case.toml"), QUICK).unwrap();
}

/// Case of an elastic wing held at its root in a stream without gravity, its strips with wakes and the lift of thin
/// airfoils: further keys of time, air and wing, as TOML.
pub fn strips(time: &str, air: &str, wing: &str) -> String {
    format!(
        r#"format = 1
gravity_m_s2 = [0, 0, 0]
[time]
{time}
[flight]
mode = "tethered"
[air]
model = "blade_element"
blade.unsteady = "peters"
blade.own = {{ lift = 3.141592653589793, drag_0 = 0, drag_90 = 0 }}
blade.centre_of_pressure.fixed = 0.25
{air}
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
{wing}
"#
    )
}

/// Every file of a folder, with what it holds.
pub fn contents(dir: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![dir.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap();
            match entry.file_type().unwrap() {
                t if t.is_dir() => folders.push(entry.path()),
                t if t.is_file() => {
                    all.insert(entry.path(), fs::read(entry.path()).unwrap());
                }
                _ => {}
            }
        }
    }
    all
}

/// Says that a test is skipped, and why; where WINGBEAT_SKIPS=no (as in CI) that is a failure.
pub fn required(missing: &str) {
    assert!(
        std::env::var_os("WINGBEAT_SKIPS").is_none_or(|v| v != "no"),
        "{missing}"
    );
    println!("skipped: {missing}");
}

/// The numbers of one DataArray of a .vtp file.
pub fn array(text: &str, name: &str) -> Vec<[u8; 8]> {
    use base64::Engine as _;
    let tag = format!("Name=\"{name}\"");
    let body = text.split(&tag).nth(1).unwrap().split('\n').nth(1).unwrap();
    let bytes = base64::engine::general_purpose::STANDARD
        .decode(body)
        .unwrap();
    let length = u64::from_le_bytes(bytes[..8].try_into().unwrap());
    assert_eq!(length as usize, bytes.len() - 8);
    bytes[8..]
        .chunks(8)
        .map(|c| c.try_into().unwrap())
        .collect()
}

/// Standard output of a command that succeeds.
pub fn said(dir: &Path, args: &[&str]) -> String {
    let out = wingbeat(dir, args);
    let problem = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{args:?}: {problem}");
    String::from_utf8(out.stdout).unwrap()
}

/// Standard error of a command that fails with this exit code.
pub fn refused(dir: &Path, code: i32, args: &[&str]) -> String {
    let out = wingbeat(dir, args);
    let said = String::from_utf8(out.stderr).unwrap();
    assert_eq!(out.status.code(), Some(code), "{args:?}: {said}");
    said
}

/// What a text must say.
pub fn says(text: &str, part: &str) {
    assert!(text.contains(part), "{text}\ndoes not say: {part}");
}

/// Runs the program, which must refuse with exit code 2, say why, and change nothing in the folder.
pub fn refused_untouched(dir: &Path, args: &[&str], reason: &str) {
    let before = contents(dir);
    says(&refused(dir, 2, args), reason);
    assert!(before == contents(dir), "{args:?} changed something");
}

/// Runs a good case with a part of its text replaced, which must be refused with exit code 2 by a report that names
/// the line where `at` stands and says all of `wanted`; nothing but the case is left.
pub fn refused_with(
    good: &str,
    name: &str,
    [from, to]: [&str; 2],
    at: &str,
    wanted: &[&str],
) -> String {
    assert!(good.contains(from), "the test replaces nothing");
    let scratch = Scratch::new(name);
    let text = good.replacen(from, to, 1);
    fs::write(scratch.0.join("case.toml"), &text).unwrap();
    let report = refused(&scratch.0, 2, &["run", "case.toml", "--out", "run"]);
    let line = text.lines().position(|l| l.contains(at)).unwrap() + 1;
    says(&report, &format!("case.toml:{line}:"));
    for part in wanted {
        says(&report, part);
    }
    assert_eq!(contents(&scratch.0).len(), 1, "something was written");
    report
}

/// A column of the history of a run.
pub fn column(run: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(run.join("history.csv")).unwrap();
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let k = lines.next().unwrap().split(',').position(|c| c == name);
    let k = k.unwrap_or_else(|| panic!("no column {name}"));
    lines
        .map(|l| l.split(',').nth(k).unwrap().parse().unwrap())
        .collect()
}
