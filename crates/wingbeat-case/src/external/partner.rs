//! A program that runs beside ours: started in a process group of its own, spoken to and heard with
//! a time limit, ended with everything it started.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Lines that wait to be heard at most; a program that says more waits itself.
const MAX_LINES: usize = 64;
/// Time to end of its own accord.
const GRACE: Duration = Duration::from_secs(1);

/// What is said of a program that is gone.
const ENDED: &str = "it ended its output";

/// What is said of a program whose input is full.
const UNREAD: &str = "it does not read its input";

/// A program to be started for each flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// Longest wait for an answer.
    pub timeout: Duration,
}

/// What differs between the protocols.
#[derive(Clone, Copy, Debug)]
pub(super) struct Protocol {
    /// Key of the case that says how long an answer may take.
    pub timeout_key: &'static str,
    /// Bytes of a line at most.
    pub max_bytes: usize,
    /// Last line before its input ends; may be none.
    pub farewell: &'static str,
}

/// Why a program was not told.
enum Deaf {
    /// It has not read in time.
    Late,
    /// It has closed its input.
    Gone(String),
}

/// Process groups that are running. Who starts one holds it until the group is in it; who waits for its leader takes
/// the group out before, while its number is its own still.
static RUNNING: Mutex<Vec<u32>> = Mutex::new(Vec::new());

fn running() -> MutexGuard<'static, Vec<u32>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends all partners at once, for a program that is about to end itself.
pub fn end_all() {
    running().iter().for_each(|group| kill_group(*group));
}

/// A running program.
pub(super) struct Partner {
    name: String,
    child: Child,
    /// To the thread that writes; none once it is to end.
    words: Option<Sender<String>>,
    written: Receiver<io::Result<()>>,
    lines: Receiver<Result<String, String>>,
    timeout: Duration,
    protocol: Protocol,
}

impl Partner {
    /// Starts `program`, which speaks `protocol`.
    ///
    /// # Errors
    /// A program that cannot be started.
    pub fn start(program: &Program, protocol: Protocol) -> Result<Self, String> {
        let (words, timeout) = (&program.command, program.timeout);
        let name = words.join(" ");
        let mut program = Command::new(&words[0]);
        program.args(&words[1..]);
        program.stdin(Stdio::piped()).stdout(Stdio::piped());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut program, 0);
        let mut child = {
            let mut running = running();
            let child = program
                .spawn()
                .map_err(|e| format!("`{name}` cannot be started: {e}"))?;
            running.push(child.id());
            child
        };
        let input = child.stdin.take().expect("a piped input");
        let output = child.stdout.take().expect("a piped output");
        let ((words, inbox), (outbox, written)) = (channel(), channel());
        std::thread::spawn(move || write(input, &inbox, &outbox));
        let (send, lines) = sync_channel(MAX_LINES);
        std::thread::spawn(move || read(output, &send, protocol.max_bytes));
        Ok(Self {
            name,
            child,
            words: Some(words),
            written,
            lines,
            timeout,
            protocol,
        })
    }

    /// Says whole lines.
    ///
    /// # Errors
    /// A program that does not listen; what it said before it went, if anything.
    pub fn say(&mut self, lines: String) -> Result<(), String> {
        self.send(lines).map_err(|deaf| match deaf {
            Deaf::Late => self.too_late(UNREAD),
            Deaf::Gone(problem) => self.last_words(&problem),
        })
    }

    /// Says the first lines and hears the answer; a program that has gone may have answered before.
    ///
    /// # Errors
    /// As [`Self::say`] and [`Self::hear`].
    pub fn greet(&mut self, lines: String) -> Result<String, String> {
        match self.send(lines) {
            Ok(()) => self.hear(),
            Err(Deaf::Late) => Err(self.too_late(UNREAD)),
            Err(Deaf::Gone(_)) => self.hear_within(self.timeout + GRACE),
        }
    }

    fn send(&self, lines: String) -> Result<(), Deaf> {
        let words = self.words.as_ref().expect("open while the flight lasts");
        let sent = words.send(lines);
        let written = sent.map_or(Err(RecvTimeoutError::Disconnected), |()| {
            self.written.recv_timeout(self.timeout)
        });
        match written {
            Ok(Ok(())) => Ok(()),
            Ok(Err(e)) => Err(Deaf::Gone(e.to_string())),
            Err(RecvTimeoutError::Timeout) => Err(Deaf::Late),
            Err(RecvTimeoutError::Disconnected) => Err(Deaf::Gone("it ended".to_owned())),
        }
    }

    /// A line that it says before it is asked, if there is one.
    pub fn unasked(&self) -> Option<String> {
        let line = self.lines.try_recv().ok()?;
        Some(line.unwrap_or_else(|problem| problem))
    }

    /// The next line.
    ///
    /// # Errors
    /// A program that is silent too long, has ended, or says what is no line.
    pub fn hear(&mut self) -> Result<String, String> {
        self.hear_within(self.timeout)
    }

    fn hear_within(&self, time: Duration) -> Result<String, String> {
        match self.lines.recv_timeout(time) {
            Ok(line) => line.map_err(|problem| self.complain(&problem)),
            Err(RecvTimeoutError::Timeout) => Err(self.too_late("no answer")),
            Err(RecvTimeoutError::Disconnected) => Err(self.complain(&self.ended())),
        }
    }

    /// What is said of it once its output has ended: how it ended itself, if it has.
    fn ended(&self) -> String {
        let until = Instant::now() + GRACE;
        loop {
            if let Some(how) = how_ended(&self.child) {
                return format!("{ENDED}: {how}");
            }
            if Instant::now() > until {
                return ENDED.to_owned();
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// A complaint about it.
    pub fn complain(&self, problem: &str) -> String {
        format!("`{}`: {problem}", self.name)
    }

    fn too_late(&self, problem: &str) -> String {
        self.complain(&format!(
            "{problem} within {} s; allow more with {}",
            self.timeout.as_secs_f64(),
            self.protocol.timeout_key
        ))
    }

    /// Why it no longer listens: what it complained of before it went, if anything.
    fn last_words(&mut self, problem: &str) -> String {
        let until = Instant::now() + GRACE;
        loop {
            let left = until.saturating_duration_since(Instant::now());
            let reason = match self.lines.recv_timeout(left) {
                Ok(Ok(line)) => match line.trim().strip_prefix("error") {
                    Some(reason) => reason.trim().to_owned(),
                    None => continue,
                },
                Ok(Err(reason)) => reason,
                Err(RecvTimeoutError::Timeout) => format!("it does not listen: {problem}"),
                Err(RecvTimeoutError::Disconnected) => self.ended(),
            };
            return self.complain(&reason);
        }
    }
}

impl Drop for Partner {
    /// A program that listens ends on the farewell or on the end of its input; whatever is left of its
    /// group a second later is killed.
    fn drop(&mut self) {
        if let Some(words) = self.words.take() {
            let _ = words.send(self.protocol.farewell.to_owned()); // it may have gone already
        }
        let began = Instant::now();
        while began.elapsed() < GRACE && !has_ended(&mut self.child) {
            std::thread::sleep(Duration::from_millis(5));
        }
        // Not yet waited for, so that its number is still its own.
        kill_group(self.child.id());
        let _ = self.child.kill();
        running().retain(|group| *group != self.child.id());
        let _ = self.child.wait();
    }
}

/// Writes what comes, and says of each how it went.
fn write(mut input: ChildStdin, inbox: &Receiver<String>, outbox: &Sender<io::Result<()>>) {
    for words in inbox {
        let written = input.write_all(words.as_bytes());
        if outbox.send(written).is_err() {
            break; // nobody waits any more
        }
    }
}

/// Reads line by line; the last thing sent of a line that does not end is the complaint.
fn read(output: ChildStdout, send: &SyncSender<Result<String, String>>, max_bytes: usize) {
    let mut output = BufReader::new(output);
    loop {
        let mut line = vec![];
        let mut start = output.by_ref().take(max_bytes as u64);
        let line = match start.read_until(b'\n', &mut line) {
            Ok(1..) if line.ends_with(b"\n") => {
                String::from_utf8(line).map_err(|_| "a line is not UTF-8".to_owned())
            }
            Ok(n) if n >= max_bytes => Err(format!("a line is longer than {max_bytes} bytes")),
            Ok(1..) => Err(cut_off(&line)),
            Ok(0) | Err(_) => return,
        };
        let last = line.is_err();
        let line = line.map(|l| l.trim_end_matches(['\n', '\r']).to_owned());
        if send.send(line).is_err() || last {
            return;
        }
    }
}

/// What is said of a last line without its end: numbers may lack digits. A complaint is taken as it is.
fn cut_off(line: &[u8]) -> String {
    let line = String::from_utf8_lossy(line);
    match line.trim().strip_prefix("error") {
        Some(problem) => problem.trim().to_owned(),
        None => format!("its output ended within a line: `{}`", line.trim()),
    }
}

/// How a program has ended; none while it runs. It is not waited for, so that its number stays its own.
#[cfg(unix)]
fn how_ended(child: &Child) -> Option<String> {
    use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    let status = waitid(WaitId::Pid(Pid::from_child(child)), options).ok()??;
    let code = status
        .exit_status()
        .map(|code| format!("exit status {code}"));
    let signal = || Some(format!("ended by signal {}", status.terminating_signal()?));
    code.or_else(signal)
}

#[cfg(not(unix))]
fn how_ended(_child: &Child) -> Option<String> {
    None
}

#[cfg(unix)]
fn has_ended(child: &mut Child) -> bool {
    use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    // A failure is that of a child waited for already.
    !matches!(
        waitid(WaitId::Pid(Pid::from_child(child)), options),
        Ok(None)
    )
}

#[cfg(not(unix))]
fn has_ended(child: &mut Child) -> bool {
    !matches!(child.try_wait(), Ok(None))
}

/// Kills a process and all it started, unless they left its group.
#[cfg(unix)]
fn kill_group(leader: u32) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let pid = i32::try_from(leader).ok().and_then(Pid::from_raw);
    if let Some(pid) = pid {
        let _ = kill_process_group(pid, Signal::KILL); // it may be empty already
    }
}

#[cfg(not(unix))]
fn kill_group(_leader: u32) {}
