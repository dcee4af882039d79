//! Other programs in a flight, asked line by line over their standard input and output: air here, controllers in
//! [`controller`].
//!
//! The protocol of air is that of `docs/external-air.md`: words and numbers separated by blanks, SI units,
//! N components unless said.

pub mod controller;
mod partner;

use std::fmt::Write as _;

use wingbeat_dynamics::{BodyMotion, Wrench};
use wingbeat_flight::{Announcement, ExternalAir, ExternalSession};
use wingbeat_math::DVec3;

use partner::{Partner, Protocol};
pub use partner::{Program, end_all};

/// Version of the protocol.
pub const PROTOCOL: u32 = 2;

/// How its partner is spoken to; an answer has six numbers.
const SPOKEN: Protocol = Protocol {
    timeout_key: "air.external.timeout_s",
    max_bytes: 4096,
    farewell: "end\n",
};

/// Air of a program that is started for each flight.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessAir(pub Program);

impl ExternalAir for ProcessAir {
    fn open(&self, flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String> {
        let mut session = Conversation {
            partner: Partner::start(&self.0, SPOKEN)?,
        };
        session.greet(flyer)?;
        Ok(Box::new(session))
    }
}

/// Stands in for a program where nothing may be started; the air does not move and does nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unasked;

impl ExternalAir for Unasked {
    fn open(&self, _flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String> {
        Ok(Box::new(Self))
    }
}

impl ExternalSession for Unasked {
    fn loads(
        &mut self,
        _step: usize,
        _time: f64,
        _motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        out.fill(Wrench::default());
        Ok(())
    }

    fn accept(&mut self, _step: usize) -> Result<(), String> {
        Ok(())
    }
}

/// The protocol with a running partner.
struct Conversation {
    partner: Partner,
}

impl Conversation {
    fn greet(&mut self, flyer: &Announcement) -> Result<(), String> {
        let bodies = flyer.bodies.iter().map(|name| format!("{name}\n"));
        let joints = flyer.joints.iter();
        let joints = joints.map(|(name, parent, child)| format!("{parent} {child} {name}\n"));
        let answer = self.partner.greet(format!(
            "wingbeat-air {PROTOCOL}\nstep_s {:e}\nbodies {}\n{}joints {}\n{}",
            flyer.step,
            flyer.bodies.len(),
            bodies.collect::<String>(),
            flyer.joints.len(),
            joints.collect::<String>()
        ))?;
        let answer = self.unless_error(answer)?;
        let ready = format!("ready {PROTOCOL}");
        if answer.trim() == ready {
            return Ok(());
        }
        Err(self
            .partner
            .complain(&format!("expected `{ready}`, got `{answer}`")))
    }

    /// The next line, unless it is a complaint.
    fn hear(&mut self) -> Result<String, String> {
        let line = self.partner.hear()?;
        self.unless_error(line)
    }

    fn unless_error(&self, line: String) -> Result<String, String> {
        match line.trim().strip_prefix("error") {
            Some(problem) => Err(self.partner.complain(problem.trim())),
            None => Ok(line),
        }
    }

    /// Refuses lines that nothing asked for: what is heard next would be old.
    fn check_silence(&mut self, bodies: usize) -> Result<(), String> {
        let Some(line) = self.partner.unasked() else {
            return Ok(());
        };
        let line = self.unless_error(line)?;
        let problem = format!(
            "it says more than a line for each of the {bodies} bodies, or a line that nothing asked for: `{line}`"
        );
        Err(self.partner.complain(&problem))
    }

    fn wrench(&mut self) -> Result<Wrench, String> {
        let line = self.hear()?;
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers {
            Ok(n) if n.iter().any(|x| !x.is_finite()) => Err(self
                .partner
                .complain(&format!("a number is not finite: `{line}`"))),
            Ok(n) if n.len() == 6 => Ok(Wrench {
                force: DVec3::from_slice(&n),
                moment: DVec3::from_slice(&n[3..]),
            }),
            _ => Err(self
                .partner
                .complain(&format!("expected six numbers, got `{line}`"))),
        }
    }
}

/// Position, rotation by rows, velocity, angular velocity (body axes).
fn in_words(m: &BodyMotion) -> String {
    m.numbers().map(|x| format!("{x:e}")).join(" ")
}

impl ExternalSession for Conversation {
    fn loads(
        &mut self,
        step: usize,
        time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        let mut question = format!("evaluate {step} {time:e}\n");
        for m in motions {
            let _ = writeln!(question, "{}", in_words(m)); // a string takes everything
        }
        self.check_silence(motions.len())?;
        self.partner.say(question)?;
        for w in out {
            *w = self.wrench()?;
        }
        Ok(())
    }

    fn accept(&mut self, step: usize) -> Result<(), String> {
        self.partner.say(format!("accept {step}\n"))
    }
}
