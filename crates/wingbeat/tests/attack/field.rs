//! A folder of a user under attack, and what every attack must leave as it was.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write as _;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::support::{QUICK, Scratch, contents, flown};

/// Bytes of memory that an attack may take [kB]: what is refused is refused before it is made.
const MEMORY: usize = 4_000_000;
/// Nothing is silent for longer.
const PATIENCE: Duration = Duration::from_secs(10);

/// How an attack may end.
#[derive(Clone, Copy, PartialEq)]
pub enum Wanted {
    /// Refused with a reason, exit code 2, nothing written.
    Refused,
    /// Right: done, exit code 0.
    Done,
    /// Not wrong in itself: any true exit code, but no panic and no file changed.
    Survived,
}

/// A folder with a case, a run and files of the user; attacked one by one.
pub struct Field {
    scratch: Scratch,
    before: BTreeMap<PathBuf, Vec<u8>>,
    count: usize,
    failures: Vec<String>,
}

impl Field {
    pub fn new(name: &str) -> Self {
        let scratch = Scratch::new(name);
        let dir = scratch.0.clone();
        fs::write(dir.join("case.toml"), QUICK).unwrap();
        fs::write(dir.join("mine.txt"), "mine").unwrap();
        fs::create_dir(dir.join("folder")).unwrap();
        fs::write(dir.join("folder/mine.txt"), "mine").unwrap();
        flown(&dir, &["run", "case.toml", "--quiet", "--out", "r"]);
        Self {
            before: contents(&dir),
            scratch,
            count: 0,
            failures: vec![],
        }
    }

    pub fn dir(&self) -> &Path {
        &self.scratch.0
    }

    /// A file that the attacks need, before the first of them.
    pub fn file(&mut self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.dir().join(name), text).unwrap();
        self.before = contents(self.dir());
    }

    /// One attack; what is wrong with its end is noted.
    pub fn attack(&mut self, wanted: Wanted, args: &[&str]) -> Output {
        self.within(wanted, "", b"", args)
    }

    /// One attack with this on the standard input.
    pub fn fed(&mut self, wanted: Wanted, input: &[u8], args: &[&str]) {
        self.within(wanted, "", input, args);
    }

    /// One attack after these commands of a shell.
    pub fn within(&mut self, wanted: Wanted, around: &str, input: &[u8], args: &[&str]) -> Output {
        self.count += 1;
        let limit = format!("ulimit -v {MEMORY}; {around} exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command
            .args(["-c", &limit, env!("CARGO_BIN_EXE_wingbeat")])
            .args(args);
        command.current_dir(self.dir()).stdin(Stdio::piped());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let began = Instant::now();
        let mut child = command.spawn().unwrap();
        let pid = child.id();
        let (mut stdin, input) = (child.stdin.take().unwrap(), input.to_vec());
        let feeding = std::thread::spawn(move || {
            let _ = stdin.write_all(&input); // who refuses at once does not read it
        });
        // What it says fits into a pipe, or it is read by nobody and time runs out.
        while child.try_wait().unwrap().is_none() && began.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(2));
        }
        let late = began.elapsed() >= PATIENCE;
        if late {
            child.kill().unwrap();
        }
        let out = child.wait_with_output().unwrap();
        feeding.join().unwrap();
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        let mut problems = vec![];
        if late {
            problems.push("too long".to_owned());
        } else if let Some(signal) = out.status.signal() {
            problems.push(format!("ended by signal {signal}"));
        }
        if said.contains("panicked") || said.contains("overflowed its stack") {
            problems.push("a panic".to_owned());
        }
        let code = out.status.code();
        // What is said into a closed or full stream is not seen here.
        let is_quiet = args.contains(&"--quiet") || around.contains("exec ");
        if code == Some(0)
            && !is_quiet
            && out.stdout.is_empty()
            && said.is_empty()
            && self.before == contents(self.dir())
        {
            problems.push("nothing done and nothing said".to_owned());
        }
        if wanted == Wanted::Refused && !late && code != Some(2) {
            problems.push(format!("exit code {code:?}"));
        }
        if wanted == Wanted::Done && code != Some(0) {
            problems.push(format!("exit code {code:?}"));
        }
        if code.is_some_and(|c| c != 0) && said.trim().is_empty() && !around.contains("2>") {
            problems.push("no reason".to_owned());
        }
        if let Some(word) = rust_words(&said) {
            problems.push(format!("speaks Rust: {word}"));
        }
        let after = contents(self.dir());
        if self.before != after {
            problems.push("files changed".to_owned());
            self.before = after;
        }
        if !problems.is_empty() {
            let args: Vec<String> = args.iter().map(|a| a.chars().take(80).collect()).collect();
            let said: String = said.chars().take(400).collect();
            let problems = problems.join(", ");
            self.failures
                .push(format!("[{pid}] {around} {args:?}: {problems}\n{said}"));
        }
        out
    }

    pub fn refused(&mut self, args: &[&str]) {
        self.attack(Wanted::Refused, args);
    }

    /// How many attacks there were so far.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Ends the attacks: there were at least so many, and all were withstood.
    pub fn end(self, at_least: usize) {
        assert!(self.count >= at_least, "{} attacks only", self.count);
        let failed = self.failures.len();
        let list = self.failures.join("\n");
        assert!(failed == 0, "{failed} of {}:\n{list}", self.count);
    }
}

/// Names of Rust's types that a user should never read.
fn rust_words(said: &str) -> Option<&'static str> {
    let words = [
        "struct ",
        "enum ",
        "usize",
        "u32",
        "f64",
        "variant ",
        "Option<",
        "Vec<",
        "tuple",
        "untagged",
        "newtype",
        "Case,",
        "::",
        "18446744073709551615]",
    ];
    words.into_iter().find(|w| said.contains(w))
}
