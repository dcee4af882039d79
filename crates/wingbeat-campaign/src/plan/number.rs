//! The numbers that may be kept of a point, by their names: what each is, in which unit, and which task gives it.

use std::collections::HashSet;

use wingbeat_analysis::{AnalysisError, LOADS, Power, UNKNOWNS, Unknown, UnknownKind};
use wingbeat_case::nearest;
use wingbeat_flight::FlightSetup;
use wingbeat_results::Summary;
use wingbeat_results::columns::Columns;
use wingbeat_results::summary::PerBeat;

use crate::plan::raw::Task;

/// Modes that may be kept of a set.
const MAX_MODES: usize = 20;

/// A number that is kept.
#[derive(Clone, Debug)]
pub struct Number {
    /// Its name.
    pub name: String,
    /// Its unit, as units are written: `m s-1`.
    pub unit: String,
    /// What it is.
    pub about: String,
    /// Where it comes from.
    pub source: Source,
}

/// Where a number comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// Of the means of wingbeats, averaged over the last ones.
    Beat(fn(&PerBeat) -> Option<f64>),
    /// Standard error of such a mean.
    Error(fn(&PerBeat) -> Option<f64>),
    /// Thrust times airspeed over power.
    Efficiency,
    /// Of a column of the history.
    Column(Of, String),
    /// Of the summary.
    Summary(fn(&Summary) -> Option<f64>),
    /// Of the trim.
    Trim(TrimNumber),
    /// Of the modes.
    Mode(Modes, usize, ModeNumber),
    /// A derivative of the averaged model: load, component of the motion.
    Derivative(usize, usize),
    /// Of the power.
    Power(fn(&Power) -> f64),
}

/// What is taken of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Mean over the last wingbeats, by the trapezoidal rule.
    Mean,
    /// The last number.
    End,
    /// The least number in the last wingbeats; of a flight without wingbeats, of all of it.
    Min,
    /// The largest number, likewise.
    Max,
}

/// What is taken of a trim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrimNumber {
    /// An unknown, chosen or given.
    Unknown(Unknown),
    /// Largest residual.
    Residual,
    /// Newton steps.
    Iterations,
}

/// Which modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Modes {
    /// Of the periodic orbit.
    Floquet,
    /// Of the averaged model.
    Averaged,
}

/// What is taken of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModeNumber {
    /// Real part of the exponent.
    Growth,
    /// Imaginary part of the exponent.
    Frequency,
}

impl Source {
    /// The task that gives it.
    pub fn task(&self) -> Task {
        match self {
            Self::Beat(_)
            | Self::Error(_)
            | Self::Efficiency
            | Self::Column(..)
            | Self::Summary(_) => Task::Run,
            Self::Trim(_) => Task::Trim,
            Self::Mode(..) | Self::Derivative(..) => Task::Stability,
            Self::Power(_) => Task::Power,
        }
    }

    /// Whether it is taken over the last wingbeats: a mean, or an extreme.
    pub fn is_mean(&self) -> bool {
        matches!(
            self,
            Self::Beat(_)
                | Self::Error(_)
                | Self::Efficiency
                | Self::Column(Of::Mean | Of::Min | Of::Max, _)
        )
    }

    /// Whether it is an extreme of a column.
    pub fn is_extreme(&self) -> bool {
        matches!(self, Self::Column(Of::Min | Of::Max, _))
    }

    /// Whether it is taken of all steps of the history: a mean of a column, or an extreme.
    pub fn needs_every_step(&self) -> bool {
        matches!(self, Self::Column(Of::Mean | Of::Min | Of::Max, _))
    }

    /// Whether it needs the averaged model.
    pub fn needs_average(&self) -> bool {
        matches!(self, Self::Mode(Modes::Averaged, ..) | Self::Derivative(..))
    }
}

/// Powers over the mass of the animal: name, meaning.
type OverMass = (&'static str, &'static str, fn(&Power) -> f64);

const POWERS_OVER_MASS: [OverMass; 2] = [
    (
        "perfect_storage",
        "power of actuators (muscles, motors) with perfect storage over mass",
        |p| p.body_specific(p.perfect_storage),
    ),
    (
        "no_storage",
        "power of actuators (muscles, motors) without storage over mass",
        |p| p.body_specific(p.no_storage),
    ),
];

/// Motions that derivatives are taken by.
const MOTIONS: [&str; 6] = ["u", "v", "w", "p", "q", "r"];

/// Name of the efficiency.
const EFFICIENCY: (&str, &str) = (
    "efficiency",
    "propulsive efficiency: mean thrust times the mean speed through the air along n1 over mean power; none where the air drives the wings, negative of drag",
);

/// All numbers that flights of `setup` may give.
///
/// # Errors
/// Joints that cannot be assembled.
pub fn registry(setup: &FlightSetup) -> Result<Vec<Number>, AnalysisError> {
    let mut all = vec![];
    let mut put = |name: String, unit: &str, about: &str, source| {
        all.push(Number {
            name,
            unit: unit.to_owned(),
            about: about.to_owned(),
            source,
        });
    };
    for q in PerBeat::QUANTITIES {
        put(q.name.to_owned(), q.unit, q.about, Source::Beat(q.of));
        let about = format!("standard error (of three wingbeats or more): {}", q.about);
        put(
            format!("error.{}", q.name),
            q.unit,
            &about,
            Source::Error(q.of),
        );
    }
    put(
        EFFICIENCY.0.to_owned(),
        "1",
        EFFICIENCY.1,
        Source::Efficiency,
    );
    let deforms = setup.animal.wings.iter().any(|w| w.deformation.is_some());
    let columns = Columns::new(setup, deforms)?;
    for (prefix, words, of) in [
        ("", "mean of ", Of::Mean),
        ("end.", "at the end: ", Of::End),
        ("min.", "least in the last wingbeats: ", Of::Min),
        ("max.", "largest in the last wingbeats: ", Of::Max),
    ] {
        for c in columns.iter() {
            let name = format!("{prefix}{}", c.name);
            let about = format!("{words}{}", c.about);
            put(name, c.unit, &about, Source::Column(of, c.name.clone()));
        }
    }
    for q in Summary::NUMBERS {
        let name = format!("summary.{}", q.name);
        put(name, q.unit, q.about, Source::Summary(q.of));
    }
    of_trim(&mut put);
    modes_and_derivatives(&mut put);
    for q in Power::QUANTITIES {
        let name = format!("power.{}_watt", q.name);
        put(name, "W", q.about, Source::Power(q.of));
    }
    for (name, about, of) in POWERS_OVER_MASS {
        let name = format!("power.{name}_watt_per_kg");
        put(name, "W kg-1", about, Source::Power(of));
    }
    Ok(all)
}

fn of_trim(put: &mut impl FnMut(String, &str, &str, Source)) {
    for (unknown, name) in UNKNOWNS {
        let [ending, unit] = unit_of(unknown);
        let source = Source::Trim(TrimNumber::Unknown(unknown));
        let about = format!("{} of the trim", name.replace('_', " "));
        put(format!("trim.{name}{ending}"), unit, &about, source);
    }
    let residual = Source::Trim(TrimNumber::Residual);
    put(
        "trim.residual".to_owned(),
        "1",
        "largest residual of the trim",
        residual,
    );
    let iterations = Source::Trim(TrimNumber::Iterations);
    put(
        "trim.iterations".to_owned(),
        "1",
        "Newton steps of the trim",
        iterations,
    );
}

fn modes_and_derivatives(put: &mut impl FnMut(String, &str, &str, Source)) {
    for (set, modes) in [("floquet", Modes::Floquet), ("averaged", Modes::Averaged)] {
        for k in 1..=MAX_MODES {
            let of = |what: &str| format!("{what} of mode {k} by falling growth, {set}");
            let source = |n| Source::Mode(modes, k - 1, n);
            put(
                format!("stability.{set}.{k}.growth_per_s"),
                "s-1",
                &of("growth"),
                source(ModeNumber::Growth),
            );
            put(
                format!("stability.{set}.{k}.frequency_rad_per_s"),
                "rad s-1",
                &of("frequency"),
                source(ModeNumber::Frequency),
            );
        }
    }
    for (l, load) in LOADS.iter().enumerate() {
        for (m, motion) in MOTIONS.iter().enumerate() {
            put(
                format!("stability.derivative.{load}_{motion}"),
                unit_of_derivative(l, m),
                &format!("derivative of the mean load {load} by {motion}"),
                Source::Derivative(l, m),
            );
        }
    }
}

/// Unit of the derivative of a load (three forces, three moments) by a motion (three velocities, three angular ones).
fn unit_of_derivative(load: usize, motion: usize) -> &'static str {
    match (load < 3, motion < 3) {
        (true, true) => "N s m-1",
        (true, false) => "N s rad-1",
        (false, true) => "N s",
        (false, false) => "N m s rad-1",
    }
}

/// Ending of the name of an unknown, and its unit.
fn unit_of(unknown: Unknown) -> [&'static str; 2] {
    match unknown.kind() {
        UnknownKind::Relative => ["", "1"],
        UnknownKind::Beats => ["_beats", "1"],
        UnknownKind::WingLengths => ["_lengths", "1"],
        UnknownKind::Angle => ["_rad", "rad"],
        UnknownKind::Speed => ["_m_per_s", "m s-1"],
    }
}

/// Takes those of `more` whose names are new.
pub fn join(all: &mut Vec<Number>, more: Vec<Number>) {
    let known: HashSet<String> = all.iter().map(|n| n.name.clone()).collect();
    all.extend(more.into_iter().filter(|n| !known.contains(&n.name)));
}

/// The number called `name`; else what to try.
///
/// # Errors
/// The nearest names, in words.
pub fn find(all: &[Number], name: &str) -> Result<Number, String> {
    if let Some(number) = all.iter().find(|n| n.name == name) {
        return Ok(number.clone());
    }
    let names: Vec<&str> = all.iter().map(|n| n.name.as_str()).collect();
    Err(match nearest(name, &names) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`wingbeat campaign numbers FILE` lists all names".to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_units_of_derivatives_are_those_of_load_and_motion() {
        let mut units = vec![];
        modes_and_derivatives(&mut |name, unit, _, _| units.push((name, unit.to_owned())));
        for (name, unit) in [
            ("X_u", "N s m-1"),
            ("Z_q", "N s rad-1"),
            ("L_v", "N s"),
            ("M_q", "N m s rad-1"),
        ] {
            let name = format!("stability.derivative.{name}");
            assert!(units.contains(&(name, unit.to_owned())), "{unit}");
        }
        assert!(units.iter().all(|(_, unit)| unit != "SI"));
    }
}
