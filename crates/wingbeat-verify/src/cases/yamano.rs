//! A square sheet in axial flow, clamped at its leading edge, beside the program of Yamano and others.

use std::f64::consts::TAU;
use std::path::Path;

use wingbeat_analysis::flutter::{Condition, FlutterSettings, condition, crossings};
use wingbeat_analysis::{About, AnalysisError, wing_modes};
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;
use wingbeat_math::DVec3;

use crate::lab::series::{Table, interpolate, rms};
use crate::{Case, Comparison, Part, Row, VerifyError};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "sheet-modes",
        about: "A square sheet, clamped at its leading edge, 15 x 10 shells: frequencies without air beside those of the program of Yamano et al. \
                (absolute nodal coordinates) and Leissa's.",
        part: Part::Programs,
        quick: true,
        run: frequencies,
    },
    Case {
        name: "sheet-flutter",
        about: "The same sheet: the reduced speed at which it begins to flutter, on two lattices.",
        part: Part::Programs,
        quick: false,
        run: flutter,
    },
    Case {
        name: "sheet-kick",
        about: "The same sheet in axial flow, mass ratio 1, reduced speed 25, after a kick: its slope across the stream at a third of its length and a \
                tenth of its width, beside a stored run of that program. The file of that run calls the column the displacement of the trailing edge, but \
                picks component 513 of a state of nine a node: the slope dz/dy of node 57.",
        part: Part::Programs,
        quick: false,
        run: kick,
    },
];

const PROGRAM: &str = "Yamano, Shintani, Ito, Nakagawa & Ijima 2020, J. Sound Vib. 478:115359: their program (KRproject-tech/FSI_by_FEM_and_UVLM), run stored in \
                       ExuberantWitness/FLUXVortex";

/// Reduced speed of the case, `U L sqrt(rho_m h W / EI)`, at a speed of 1 m/s.
const REDUCED: f64 = 25.0;

fn load(set: &[String]) -> Result<LoadedCase, VerifyError> {
    let text = include_str!("../../data/yamano.toml");
    Ok(LoadedCase::from_text("yamano", text, Path::new(""), set)?)
}

fn frequencies(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let found = wing_modes(&load(&[])?.setup, About::Rest, 5)?.swap_remove(0);
    let theirs = [
        0.145_542_67,
        0.356_709_68,
        0.894_175_52,
        1.139_322_3,
        1.298_004_4,
    ];
    // `omega L^2 sqrt(rho_m h / D)`; the reduced speed has EI, not D = EI / (1 - nu^2).
    let leissa = [3.471, 8.507, 21.29, 27.20, 30.96].map(|k| k / (REDUCED * 0.91_f64.sqrt()));
    let mut rows = vec![];
    for (k, mode) in found.vacuum.iter().enumerate() {
        let row = |of: &str, known: f64, source| {
            Row::new(
                format!("frequency {} beside that of {of}", k + 1),
                "rad/s",
                mode.frequency,
            )
            .against(known, source)
            .within_part(0.01, "the error of 15 x 10 elements, of second order")
        };
        rows.push(row("the program", theirs[k], PROGRAM));
        rows.push(row(
            "the plate",
            leissa[k],
            "Leissa 1969, NASA SP-160, table 4.46",
        ));
    }
    Ok(rows)
}

/// Node whose slope is compared: rows behind the leading edge, columns from the side.
const NODE: [usize; 2] = [5, 1];
/// Panels of the mesh.
const MESH: [usize; 2] = [15, 10];
/// The kick: a pressure `0.5 sin(pi t / 0.2)` while t < 0.2, here a weight, as the sheet has 1 kg/m2.
const KICK: [f64; 2] = [0.5, 0.2];
/// Way that wakes are kept.
const WAKE: f64 = 5.5;

/// What the sheet does, step after step, along the direction of the kick.
struct History {
    time: Vec<f64>,
    /// Slope across the stream at [`NODE`] \[1\].
    slope: Vec<f64>,
    /// The error that ended the flight, if one did.
    ended: Option<String>,
}

/// The kicked sheet for a time \[s\] with so many steps a second.
fn flown(until: f64, per_second: usize) -> Result<History, VerifyError> {
    let steps = (until * per_second as f64).round() as usize;
    let case = load(&[
        format!("time.step_s={}", 1.0 / per_second as f64),
        format!("time.steps={steps}"),
        format!("air.max_wake_rows={}", (WAKE * per_second as f64) as usize),
    ])?;
    let mut flight = Simulation::new(case.setup.clone())?;
    let rest = flight.elastic_wings().wings()[0].structure().rest().clone();
    let node = |[i, j]: [usize; 2]| i * (MESH[1] + 1) + j;
    let (at, end) = (node(NODE), node([MESH[0], MESH[1] / 2]));
    let mut way = 0.0;
    let mut h = History {
        time: vec![0.0],
        slope: vec![0.0],
        ended: None,
    };
    for k in 1..=steps {
        let t = k as f64 / per_second as f64;
        if t <= KICK[1] + 1.5 / per_second as f64 {
            let mut setup = case.setup.clone();
            let weight = if t < KICK[1] {
                KICK[0] * (TAU * t / (2.0 * KICK[1])).sin()
            } else {
                0.0
            };
            setup.gravity = weight * DVec3::Z;
            flight = Simulation::resume(setup, flight.state().clone())?;
        }
        if let Err(error) = flight.step() {
            h.ended = Some(error.to_string());
            break;
        }
        let now = &flight.state().wings[0].structure.configuration;
        let across = now.rotation[at] * (rest.rotation[at].inverse() * DVec3::Y);
        h.time.push(t);
        h.slope.push(across.z);
        if t <= KICK[1] {
            way += (now.position[end] - rest.position[end]).z;
        }
    }
    // Along the kick, whichever way w3 points.
    h.slope.iter_mut().for_each(|x| *x *= f64::signum(way));
    Ok(h)
}

/// Depth \[1\] and time \[s\] of the first trough of a slope at times.
fn trough(time: &[f64], slope: &[f64]) -> [f64; 2] {
    let early = time.iter().zip(slope).filter(|(t, _)| **t <= 0.6);
    early.fold([0.0; 2], |best, (t, x)| match *x < best[0] {
        true => [*x, *t],
        false => best,
    })
}

/// The stored slope and that of two flights at its times.
struct Courses {
    time: Vec<f64>,
    theirs: Vec<f64>,
    /// With more and with fewer steps a second.
    here: [Vec<f64>; 2],
    /// The errors that ended flights.
    ended: String,
}

impl Courses {
    /// Until a time \[s\] with so many steps a second.
    fn fly(until: f64, steps: [usize; 2]) -> Result<Self, VerifyError> {
        let table = Table::new(include_str!("../../data/yamano2020_slope.csv"));
        let (mut time, mut theirs) = (table.numbers("time"), table.numbers("slope"));
        let looked = time.iter().filter(|t| **t <= until).count();
        time.truncate(looked);
        theirs.truncate(looked);
        let (fine, coarse) = (flown(until, steps[0])?, flown(until, steps[1])?);
        let here = [&fine, &coarse].map(|h| {
            let at = |t: &f64| interpolate(&h.time, &h.slope, *t);
            time.iter().map(at).collect()
        });
        let end = |h: &History| {
            let error = h.ended.as_ref()?;
            Some(format!(
                "; a flight ended at {:.2} s: {error}",
                h.time.last()?
            ))
        };
        let ended = [end(&fine), end(&coarse)].into_iter().flatten().collect();
        Ok(Self {
            time,
            theirs,
            here,
            ended,
        })
    }

    /// A number of the computed slope beside that of the stored one, within a part of it.
    fn judged(&self, name: &str, unit: &'static str, part: f64, of: &dyn Fn(&[f64]) -> f64) -> Row {
        let [here, rough] = self.here.each_ref().map(|x| of(x));
        let row = Row::new(name, unit, here).against(of(&self.theirs), PROGRAM);
        self.told(row.uncertain(rough - here).within_part(part, BAND))
    }

    /// A row that says what ended flights.
    fn told(&self, mut row: Row) -> Row {
        row.reason = format!("{}{}", row.reason, self.ended).into();
        row
    }

    fn drawn(&self, row: Row) -> Row {
        let points = self.time.iter().zip(&self.theirs).zip(&self.here[0]);
        row.drawn(Comparison {
            quantity: "slope across the stream [1]".into(),
            along: "time [s]".into(),
            against: "Yamano et al.".into(),
            name: "15 x 10 panels".into(),
            points: points.map(|((t, a), b)| [*t, *a, *b]).collect(),
        })
    }
}

const BAND: &str = "stated beforehand; uncertainty: 30 steps a second for 60";

/// The first response to the kick: until when \[s\], and steps a second.
const FIRST: (f64, [usize; 2]) = (1.0, [60, 30]);

fn kick(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let courses = Courses::fly(FIRST.0, FIRST.1)?;
    let apart = |a: &[f64], b: &[f64]| {
        let both = a.iter().zip(b);
        rms(&both.map(|(a, b)| a - b).collect::<Vec<_>>()) / rms(b)
    };
    let ([here, rough], time) = (&courses.here, &courses.time);
    let row = Row::new(
        "slope in the first second: rms difference over rms",
        "1",
        apart(here, &courses.theirs),
    );
    let row = courses.told(row.uncertain(apart(rough, here)).within(0.25, BAND));
    Ok(vec![
        courses.drawn(row),
        courses.judged("first trough of the slope", "1", 0.2, &|x| {
            trough(time, x)[0]
        }),
        courses.judged("time of the first trough", "s", 0.1, &|x| {
            trough(time, x)[1]
        }),
    ])
}

fn flutter(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let onset = |[rows, cols]: [usize; 2], speeds: [f64; 2]| -> Result<[f64; 2], VerifyError> {
        let case = load(&[
            format!("wing.right.mesh.chordwise={rows}"),
            format!("wing.right.mesh.spanwise={cols}"),
            format!("time.step_s={}", 0.5 / rows as f64),
            format!("air.max_wake_rows={}", 10 * rows),
        ])?;
        let settings = FlutterSettings {
            modes: 4,
            ..FlutterSettings::default()
        };
        let both: Vec<Vec<Condition>> = speeds
            .into_iter()
            .map(|speed| condition(&case.setup, speed, &settings))
            .collect::<Result<_, _>>()?;
        let both = both.concat();
        let begins = crossings(&both).into_iter().find(|c| c.begins);
        let begins = begins.ok_or_else(|| {
            AnalysisError::Numbers(format!(
                "{rows} x {cols} panels: no flutter begins between {speeds:?} m/s"
            ))
        })?;
        Ok([REDUCED * begins.speed, begins.frequency / TAU])
    };
    let (coarse, fine) = (onset([6, 4], SPEEDS)?, onset([8, 4], SPEEDS)?);
    Ok(vec![
        Row::new(
            "reduced speed U L sqrt(rho_m h W / EI) at which flutter begins, 8 x 4 panels",
            "1",
            fine[0],
        )
        .uncertain(fine[0] - coarse[0])
        .because("stated, not judged; uncertainty: 6 x 4 panels for 8 x 4"),
        Row::new(
            "its frequency over that of the first mode without air",
            "1",
            fine[1] * TAU / (REDUCED.recip() * 3.471 / 0.91_f64.sqrt()),
        )
        .because("stated, not judged"),
    ])
}

/// Speeds between which the sheet begins to flutter [m/s].
const SPEEDS: [f64; 2] = [0.23, 0.29];
