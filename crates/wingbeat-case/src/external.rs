//! Air computed by another program, asked line by line over its standard input and output.
//!
//! The protocol is that of `docs/external-air.md`: words and numbers separated by blanks, SI units,
//! N components unless said.

use std::io::{BufRead, BufReader, BufWriter, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_flight::{Announcement, ExternalAir, ExternalSession};
use wingbeat_math::DVec3;

/// Version of the protocol.
pub const PROTOCOL: u32 = 2;

/// A program to be started for each flight.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessAir {
    /// The program and its arguments.
    pub command: Vec<String>,
    /// Longest wait for an answer [s].
    pub timeout: f64,
}

impl ExternalAir for ProcessAir {
    fn open(&self, flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String> {
        let mut session = Conversation::start(self)?;
        session.greet(flyer)?;
        Ok(Box::new(session))
    }
}

/// A running partner.
struct Conversation {
    name: String,
    child: Child,
    input: Option<BufWriter<ChildStdin>>,
    lines: Receiver<String>,
    timeout: Duration,
}

impl Conversation {
    fn start(air: &ProcessAir) -> Result<Self, String> {
        let name = air.command.join(" ");
        let mut child = Command::new(&air.command[0])
            .args(&air.command[1..])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|e| format!("`{name}` cannot be started: {e}"))?;
        let input = child.stdin.take().map(BufWriter::new);
        let output = child.stdout.take().expect("a piped output");
        // A thread of its own reads, so that a silent partner can be given up.
        let (send, lines) = channel();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if send.send(line).is_err() {
                    break;
                }
            }
        });
        Ok(Self {
            name,
            child,
            input,
            lines,
            timeout: Duration::from_secs_f64(air.timeout),
        })
    }

    fn greet(&mut self, flyer: &Announcement) -> Result<(), String> {
        self.say(&format!("wingbeat-air {PROTOCOL}"))?;
        self.say(&format!("step_s {:e}", flyer.step))?;
        self.say(&format!("bodies {}", flyer.bodies.len()))?;
        for name in &flyer.bodies {
            self.say(name)?;
        }
        self.say(&format!("joints {}", flyer.joints.len()))?;
        for (name, parent, child) in &flyer.joints {
            self.say(&format!("{parent} {child} {name}"))?;
        }
        self.flush()?;
        let answer = self.hear()?;
        let ready = format!("ready {PROTOCOL}");
        if answer.trim() == ready {
            return Ok(());
        }
        Err(self.complain(&format!("expected `{ready}`, got `{answer}`")))
    }

    fn say(&mut self, line: &str) -> Result<(), String> {
        let input = self.input.as_mut().expect("open while the flight lasts");
        let said = writeln!(input, "{line}");
        said.map_err(|e| self.last_words(&e))
    }

    fn flush(&mut self) -> Result<(), String> {
        let input = self.input.as_mut().expect("open while the flight lasts");
        let done = input.flush();
        done.map_err(|e| self.last_words(&e))
    }

    /// Why a partner no longer listens: what it said before it went, if anything.
    fn last_words(&mut self, e: &std::io::Error) -> String {
        let said = self.lines.recv_timeout(Duration::from_secs(1));
        let problem = said.ok().and_then(|line| {
            let problem = line.trim().strip_prefix("error")?;
            Some(problem.trim().to_owned())
        });
        self.complain(&problem.unwrap_or_else(|| format!("it does not listen: {e}")))
    }

    /// The next line of the partner.
    fn hear(&mut self) -> Result<String, String> {
        match self.lines.recv_timeout(self.timeout) {
            Ok(line) => match line.trim().strip_prefix("error") {
                Some(problem) => Err(self.complain(problem.trim())),
                None => Ok(line),
            },
            Err(RecvTimeoutError::Timeout) => Err(self.complain(&format!(
                "no answer within {} s; allow more with air.external.timeout_s",
                self.timeout.as_secs_f64()
            ))),
            Err(RecvTimeoutError::Disconnected) => Err(self.complain("it ended its output")),
        }
    }

    fn complain(&self, problem: &str) -> String {
        format!("`{}`: {problem}", self.name)
    }

    fn wrench(&mut self) -> Result<Wrench, String> {
        let line = self.hear()?;
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers {
            Ok(n) if n.len() == 6 => Ok(Wrench {
                force: DVec3::from_slice(&n),
                moment: DVec3::from_slice(&n[3..]),
            }),
            _ => Err(self.complain(&format!("expected six numbers, got `{line}`"))),
        }
    }
}

/// Position, rotation by rows, velocity, angular velocity (body axes).
fn numbers(m: &BodyMotion) -> String {
    let r = m.r.transpose().to_cols_array();
    let all = [
        m.p.to_array().as_slice(),
        &r,
        &m.v.to_array(),
        &m.w.to_array(),
    ]
    .concat();
    let words: Vec<String> = all.iter().map(|x| format!("{x:e}")).collect();
    words.join(" ")
}

impl ExternalSession for Conversation {
    fn loads(
        &mut self,
        step: usize,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        self.say(&format!("evaluate {step} {time:e}"))?;
        for m in motions {
            self.say(&numbers(m))?;
        }
        self.flush()?;
        for w in out {
            *w = self.wrench()?;
        }
        Ok(())
    }

    fn accept(&mut self, step: usize) -> Result<(), String> {
        self.say(&format!("accept {step}"))?;
        self.flush()
    }
}

impl Drop for Conversation {
    fn drop(&mut self) {
        // A partner that listens ends on `end` or on the end of its input.
        let _ = self.say("end").and_then(|()| self.flush());
        self.input = None;
        for _ in 0..100 {
            if !matches!(self.child.try_wait(), Ok(None)) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
