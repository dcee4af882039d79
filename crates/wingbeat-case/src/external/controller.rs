//! A controller in another program, asked look by look over its standard input and output.
//!
//! The protocol is that of `docs/control.md`: one line of JSON each way. All that the program wants to remember
//! beyond its present line it can give back as `memory`, which is part of the state of the flight.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use wingbeat_analysis::control::{Limits, Route, Sensors};
use wingbeat_flight::control::check_heeded;
use wingbeat_flight::{
    Aim, ControlModel, Controller, FlightError, FlightSetup, RESUME_AS_SAVED, Sensed,
};
use wingbeat_math::{DVec3, to_digits};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::{Side, Wing};

use super::partner::{Partner, Program, Protocol};
use crate::raw::AdjustCase;

/// Version of the protocol.
pub const PROTOCOL: &str = "wingbeat-control 1";

/// How a controller is spoken to: its memory is part of a line.
const SPOKEN: Protocol = Protocol {
    timeout_key: "control.external.timeout_s",
    max_bytes: 1 << 16,
    farewell: "",
};

/// Numbers of an adjustment that are commanded.
const NUMBERS: usize = 7;

/// An angle or a rate in degrees, without the last digit, which is the rounding of the conversion: 12, as a case has it.
fn degrees(radians: f64) -> f64 {
    to_digits(radians.to_degrees(), 15)
}

/// A controller in a program that is started for each flight.
#[derive(Clone, Debug, PartialEq)]
pub struct ProcessController {
    /// The program.
    pub program: Program,
    /// Largest commands of every wing.
    pub limits: Limits,
    /// Looks from one question to the next; the command is kept between them.
    pub every: usize,
    /// Looks from sensing to acting.
    pub latency: usize,
    /// Time constant of the actuators [s].
    pub lag: f64,
    /// Time from one look to the next [s].
    pub interval: f64,
    /// Noise and bias of what it sees.
    pub sensors: Option<Sensors>,
    /// Where it is to bring the flyer.
    pub route: Route,
}

impl ControlModel for ProcessController {
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        let partner = Partner::start(&self.program, SPOKEN).map_err(|problem| {
            let command = self.program.command.join(" ");
            FlightError::setup("control.external.command", command, problem)
        })?;
        let wings = &setup.animal.wings;
        Ok(Box::new(Conversation {
            partner,
            model: self.clone(),
            names: wings.iter().map(WingName::of).collect(),
            wings: wings.clone(),
            period: setup.time.period.unwrap_or(0.0),
            origin: None,
            command: vec![Adjustment::default(); wings.len()],
            is_limited: false,
            memory: vec![],
        }))
    }

    fn follows(&self) -> bool {
        !self.route.0.is_empty()
    }

    fn every(&self) -> usize {
        self.every
    }

    fn arrivals(&self) -> Vec<f64> {
        self.route.arrivals()
    }

    fn redrawn(&self, by: u64) -> Option<Arc<dyn ControlModel>> {
        let sensors = self.sensors?.redrawn(by)?;
        Some(Arc::new(Self {
            sensors: Some(sensors),
            ..self.clone()
        }))
    }
}

/// Stands in for a program where nothing may be started: commands nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Uncommanded;

/// As many wings as do what they would without a controller.
struct Still(usize);

impl ControlModel for Uncommanded {
    fn open(&self, setup: &FlightSetup) -> Result<Box<dyn Controller>, FlightError> {
        Ok(Box::new(Still(setup.animal.wings.len())))
    }
}

impl Controller for Still {
    fn command(&mut self, _sensed: &Sensed) -> Result<Vec<Adjustment>, String> {
        Ok(vec![Adjustment::default(); self.0])
    }
}

/// The protocol with a running partner.
struct Conversation {
    partner: Partner,
    model: ProcessController,
    wings: Vec<Wing>,
    names: Vec<WingName>,
    /// Of the wingbeat [s].
    period: f64,
    /// Mass centre at the first look, the true one, N components [m].
    origin: Option<DVec3>,
    command: Vec<Adjustment>,
    /// Whether the limits cut what was asked for.
    is_limited: bool,
    memory: Vec<f64>,
}

/// A wing in a question.
#[derive(Clone, Debug, Serialize)]
struct WingName {
    name: String,
    side: &'static str,
}

impl WingName {
    fn of(wing: &Wing) -> Self {
        Self {
            name: wing.name.clone(),
            side: match wing.side {
                Side::Left => "left",
                Side::Right => "right",
            },
        }
    }
}

/// Largest commands in a question.
#[derive(Clone, Copy, Debug, Serialize)]
struct LimitsTold {
    amplitude: f64,
    angle_deg: f64,
}

/// Where the flyer is to be, in a question.
#[derive(Clone, Copy, Debug, Serialize)]
struct ReferenceTold {
    position_m: [f64; 3],
    velocity_m_s: [f64; 3],
    heading_deg: f64,
    heading_rate_deg_s: f64,
}

/// What is asked at a look.
#[derive(Clone, Debug, Serialize)]
struct Question<'a> {
    protocol: &'static str,
    look: usize,
    time_s: f64,
    period_s: f64,
    interval_s: f64,
    latency_s: f64,
    lag_s: f64,
    position_m: [f64; 3],
    velocity_m_s: [f64; 3],
    /// From body to inertial axes, by rows.
    attitude: [[f64; 3]; 3],
    angular_velocity_rad_s: [f64; 3],
    mass_centre_m: [f64; 3],
    mass_centre_velocity_m_s: [f64; 3],
    reference: ReferenceTold,
    wings: &'a [WingName],
    limits: LimitsTold,
    memory: &'a [f64],
}

/// What is answered.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    /// One for each wing, in the order of the question.
    wings: Option<Vec<AdjustCase>>,
    #[serde(default)]
    memory: Vec<f64>,
    /// Ends the flight.
    error: Option<String>,
}

impl Conversation {
    fn aim_from(&self, origin: DVec3, time: f64) -> Aim {
        let aim = self.model.route.at(time);
        Aim {
            position: origin + aim.position,
            ..aim
        }
    }

    /// What is asked where `sensed` is seen, of a flyer whose mass centre was at `origin` [m] at the release.
    fn question(&self, sensed: &Sensed, origin: DVec3) -> String {
        let aim = self.aim_from(origin, sensed.time);
        let (model, root) = (&self.model, &sensed.root);
        let question = Question {
            protocol: PROTOCOL,
            look: sensed.look,
            time_s: sensed.time,
            period_s: self.period,
            interval_s: model.interval * model.every as f64,
            latency_s: model.interval * model.latency as f64,
            lag_s: model.lag,
            position_m: root.p.to_array(),
            velocity_m_s: root.v.to_array(),
            attitude: root.r.transpose().to_cols_array_2d(),
            angular_velocity_rad_s: root.w.to_array(),
            mass_centre_m: sensed.centre.to_array(),
            mass_centre_velocity_m_s: sensed.velocity.to_array(),
            reference: ReferenceTold {
                position_m: aim.position.to_array(),
                velocity_m_s: aim.velocity.to_array(),
                heading_deg: degrees(aim.heading),
                heading_rate_deg_s: degrees(aim.heading_rate),
            },
            wings: &self.names,
            limits: LimitsTold {
                amplitude: model.limits.amplitude,
                angle_deg: degrees(model.limits.angle),
            },
            memory: &self.memory,
        };
        let line = serde_json::to_string(&question).expect("numbers and names are JSON");
        line + "\n"
    }

    /// What the wings are asked for, and the memory of an answer.
    fn understood(&self, line: &str) -> Result<(Vec<Adjustment>, Vec<f64>), String> {
        let answer: Answer = serde_json::from_str(line).map_err(|e| {
            let is_none = e.is_syntax() && ["NaN", "Inf"].iter().any(|word| line.contains(word));
            let note = if is_none {
                "; JSON has no NaN and no Infinity"
            } else {
                ""
            };
            format!("its answer is not what docs/control.md asks for ({e}{note}): `{line}`")
        })?;
        if let Some(problem) = answer.error {
            return Err(match problem.trim() {
                "" => "its answer is an error without words, {\"error\": \"\"}".to_owned(),
                _ => problem,
            });
        }
        let wings = answer.wings.ok_or_else(|| {
            "its answer has no \"wings\": {\"wings\": [{...}, ...]}, one {...} for each".to_owned()
        })?;
        if wings.len() != self.wings.len() {
            let names: Vec<&str> = self.names.iter().map(|w| &w.name[..]).collect();
            return Err(format!(
                "its answer commands {} wings, and there are {}, in this order: {}",
                wings.len(),
                names.len(),
                names.join(", ")
            ));
        }
        if let Some(lead) = wings
            .iter()
            .map(|w| w.feathering_lead)
            .find(|x| x.abs() > MAX_LEAD)
        {
            return Err(format!(
                "its answer has feathering_lead = {lead} wingbeats; allowed: from -{MAX_LEAD} to {MAX_LEAD}"
            ));
        }
        let asked: Vec<Adjustment> = wings.iter().map(Adjustment::from).collect();
        check_heeded(&self.wings, &asked).map_err(|problem| format!("its answer: {problem}"))?;
        Ok((asked, answer.memory))
    }

    fn asked(
        &mut self,
        sensed: &Sensed,
        origin: DVec3,
    ) -> Result<(Vec<Adjustment>, Vec<f64>), String> {
        if let Some(line) = self.partner.unasked() {
            let problem = format!("it says more than one line for a look: `{line}`");
            return Err(self.partner.complain(&problem));
        }
        let question = self.question(sensed, origin);
        self.partner.say(question)?;
        let line = self.partner.hear()?;
        self.understood(&line)
            .map_err(|problem| self.partner.complain(&problem))
    }
}

/// Longest lead of the feathering before the stroke \[wingbeats\]: half a beat is as far as there is.
const MAX_LEAD: f64 = 0.5;

/// The command of a wing within the limits.
fn limited(a: &Adjustment, limits: &Limits) -> Adjustment {
    let share = |x: f64| x.clamp(-limits.amplitude, limits.amplitude);
    let angle = |x: f64| x.clamp(-limits.angle, limits.angle);
    Adjustment {
        stroke_amplitude: share(a.stroke_amplitude),
        stroke_offset: angle(a.stroke_offset),
        feathering_offset: angle(a.feathering_offset),
        feathering_amplitude: share(a.feathering_amplitude),
        feathering_lead: a.feathering_lead,
        deviation_offset: angle(a.deviation_offset),
        stroke_plane: angle(a.stroke_plane),
        frequency: 0.0,
    }
}

impl Controller for Conversation {
    fn command(&mut self, sensed: &Sensed) -> Result<Vec<Adjustment>, String> {
        if sensed.look.is_multiple_of(self.model.every) {
            let origin = *self.origin.get_or_insert(sensed.centre);
            let seen = self.model.sensors.map_or(*sensed, |s| s.seen(sensed));
            let answer = self.asked(&seen, origin);
            let (wanted, memory) = answer.map_err(|problem| {
                let look = sensed.look;
                format!(
                    "look {look}: {problem}; try the program on a line by hand, see docs/control.md"
                )
            })?;
            let limits = &self.model.limits;
            self.command = wanted.iter().map(|a| limited(a, limits)).collect();
            self.is_limited = self.command != wanted;
            self.memory = memory;
        }
        Ok(self.command.clone())
    }

    fn aim(&self, time: f64) -> Option<Aim> {
        self.origin.map(|origin| self.aim_from(origin, time))
    }

    fn is_limited(&self) -> bool {
        self.is_limited
    }

    fn memory(&self) -> Vec<f64> {
        let numbers = |a: &Adjustment| a.numbers().map(|(_, x)| x).into_iter().take(NUMBERS);
        let command: Vec<f64> = self.command.iter().flat_map(numbers).collect();
        let origin = self.origin.map_or([0.0; 3], |o| o.to_array());
        // 0 before the first look, 1 after it, 2 if the command stands at a limit.
        let begun = f64::from(u8::from(self.origin.is_some()) + u8::from(self.is_limited));
        [&command[..], &origin, &[begun], &self.memory].concat()
    }

    fn restore(&mut self, memory: &[f64]) -> Result<(), String> {
        let split = memory.split_at_checked(NUMBERS * self.command.len());
        let Some((command, [x, y, z, begun, memory @ ..])) = split else {
            return Err(format!("it has no commands; {RESUME_AS_SAVED}"));
        };
        self.origin = (*begun != 0.0).then(|| DVec3::new(*x, *y, *z));
        self.is_limited = *begun == 2.0;
        for (a, x) in self.command.iter_mut().zip(command.chunks(NUMBERS)) {
            let number = |k: usize| x.get(k).copied().unwrap_or(0.0); // the frequency
            *a = Adjustment::of_numbers(std::array::from_fn(number));
        }
        self.memory = memory.to_vec();
        Ok(())
    }
}
