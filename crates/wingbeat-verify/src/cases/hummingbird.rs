//! A hummingbird's wings with the surface that cameras measured, prescribed as it is: what they carry.
//!
//! Of the bird itself neither mass nor force is known: hummingbirds of its species have 4 to 5 g, and one that
//! hovers is carried and pushed nowhere. The distance of the wings' bases is not published either; they stand a
//! tenth of the wing's length from the plane of symmetry.

use crate::lab::insect::{Choice, DEFAULT, Flown, Fluid, MODELS, STEP_BEFORE, middle};
use crate::lab::series::{Table, interpolate, mean};
use crate::{Case, Comparison, Part, Row, VerifyError};
use wingbeat_case::raw::{
    AngleCase, DeformationCase, PlanformCase, RectangleCase, SurfaceCase, WingCase, WingMotionCase,
};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "hummingbird-maeda-2017",
    about: "The measured surface of a hovering hummingbird's wing over a beat, flown on both sides: vertical and horizontal \
            force, power, and what camber and twist do.",
    part: Part::Experiments,
    quick: false,
    run,
}];

const LENGTH: f64 = 69.3e-3;
const CHORD: f64 = 19.5e-3;
const FREQUENCY: f64 = 28.8;
/// Air at 22 deg C.
const DENSITY: f64 = 1.196;
const VISCOSITY: f64 = 1.53e-5;
/// Middle of what hummingbirds of the species have.
const MASS: f64 = 4.5e-3;
const WEIGHT: f64 = MASS * 9.81;

/// What the measured sections lose.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    /// Chords are straight.
    NoCamber,
    /// Chords are straight and all along the mean chord.
    Flat,
}

/// Surfaces phase by phase in wing axes [m]: rows from the leading edge, each from the base to the tip, axis 2
/// outboard.
fn measured() -> SurfaceCase {
    let table = Table::new(include_str!("../../data/maeda2017_wing_surface_mm.csv"));
    let along = |c: &str| table.numbers(c).into_iter().map(|x| -1e-3 * x); // y and z the other way
    let rows: Vec<Vec<[f64; 3]>> = (0..=10)
        .rev()
        .map(|i| {
            let [x, y, z] = ["x", "y", "z"].map(|a| along(&format!("{a}{}", 2 * i)));
            x.zip(y).zip(z).map(|((x, y), z)| [-x, y, z]).collect()
        })
        .collect();
    let all = table.numbers("phase");
    let stations = all.iter().filter(|x| **x == all[0]).count();
    let phases: Vec<f64> = all.iter().copied().step_by(stations).collect();
    let surface = |k: usize| {
        let row = |row: &Vec<[f64; 3]>| row[k * stations..(k + 1) * stations].to_vec();
        rows.iter().map(row).collect()
    };
    SurfaceCase {
        nodes_m: (0..phases.len()).map(surface).collect(),
        phases,
        ..SurfaceCase::default()
    }
}

/// The surface with columns across the wing. Stations along a feathered wing are not: lines through those of
/// one number are up to 65 deg off the normal of the leading edge, and what leaves the edge of so sheared a
/// mesh is resolved worse. At the tip it lacks 1 to 2 % of the area.
fn across(mut surface: SurfaceCase) -> SurfaceCase {
    let places = lengthwise(&surface.nodes_m);
    let last = places[0].len() - 1;
    let even: Vec<f64> = (0..=last)
        .map(|j| places[0][last] * j as f64 / last as f64)
        .collect();
    for rows in &mut surface.nodes_m {
        for (row, places) in rows.iter_mut().zip(&places) {
            let along: [Vec<f64>; 3] = [0, 1, 2].map(|a| row.iter().map(|x| x[a]).collect());
            let point = |y: &f64| [0, 1, 2].map(|a| interpolate(places, &along[a], *y));
            *row = even.iter().map(point).collect();
        }
    }
    surface
}

/// How far from the base towards the tip the points of each row lie, mean over the phases [m].
fn lengthwise(phases: &[Vec<Vec<[f64; 3]>>]) -> Vec<Vec<f64>> {
    let point = |x: &[f64; 3]| DVec3::from(*x);
    let mut mean = vec![vec![0.0; phases[0][0].len()]; phases[0].len()];
    for rows in phases {
        let base = point(&rows[0][0]);
        let towards = (point(&rows[0][rows[0].len() - 1]) - base).normalize();
        for (mean, row) in mean.iter_mut().zip(rows) {
            for (mean, x) in mean.iter_mut().zip(row) {
                *mean += (point(x) - base).dot(towards) / phases.len() as f64;
            }
        }
    }
    mean
}

impl Shape {
    const WITHOUT: [Self; 2] = [Self::NoCamber, Self::Flat];

    fn name(self) -> &'static str {
        match self {
            Self::NoCamber => "straight chords",
            Self::Flat => "straight chords, all along their mean",
        }
    }

    /// The surface without what this shape lacks; leading edges and lengths of chords stay.
    fn of(self, mut surface: SurfaceCase) -> SurfaceCase {
        (surface.nodes_m.iter_mut()).for_each(|rows| self.straighten(rows));
        surface
    }

    fn straighten(self, rows: &mut [Vec<[f64; 3]>]) {
        let last = rows.len() - 1;
        let point = |x: [f64; 3]| DVec3::from(x);
        let lead: Vec<DVec3> = rows[0].iter().map(|x| point(*x)).collect();
        let chords = lead.iter().zip(&rows[last]);
        let mut chords: Vec<DVec3> = chords.map(|(a, b)| point(*b) - *a).collect();
        if self == Self::Flat {
            let along = chords.iter().sum::<DVec3>().normalize();
            chords.iter_mut().for_each(|c| *c = c.length() * along);
        }
        for (i, row) in rows.iter_mut().enumerate() {
            let part = i as f64 / last as f64;
            for (x, (lead, chord)) in row.iter_mut().zip(lead.iter().zip(&chords)) {
                *x = (*lead + *chord * part).to_array();
            }
        }
    }
}

/// What the flight of a shape gives: means of the second and the third beat, half strokes of the motion's second beat.
struct Means {
    /// Vertical and forward force over the weight, power over the mass [W/kg]; half the change between the beats.
    mean: [[f64; 2]; 3],
    /// Vertical force of downstroke and upstroke over the weight.
    strokes: [f64; 2],
    /// Vertical force over the weight, a beat from the start of the downstroke on.
    history: Vec<f64>,
}

fn fly(choice: Choice, surface: SurfaceCase) -> Result<Means, VerifyError> {
    let mut case = choice.case(Fluid {
        density: DENSITY,
        viscosity: VISCOSITY,
        stream: [0.0; 3],
        chord: CHORD,
        frequency: FREQUENCY,
    });
    let still = WingMotionCase {
        phi: Some(AngleCase::ConstantDeg(0.0)),
        ..WingMotionCase::default()
    };
    let rest = RectangleCase {
        chord_m: CHORD,
        span_m: LENGTH,
        root_offset_m: 0.0,
        axis_fraction: 0.25,
    };
    let wing = WingCase {
        hinge_m: Some([0.0, 0.1 * LENGTH, 0.0]),
        mass_kg: Some(1e-9),
        planform: Some(PlanformCase::Rectangle(rest)),
        mesh: Some(choice.mesh()),
        motion: Some(still),
        deformation: Some(DeformationCase {
            surface: Some(surface),
            ..DeformationCase::default()
        }),
        ..WingCase::default()
    };
    case.wing.insert("right".into(), wing);
    let flown = Flown::of(case)?;
    let n = choice.steps;
    let up: Vec<f64> = flown.force.iter().map(|f| -f.z / WEIGHT).collect();
    let ahead: Vec<f64> = flown.force.iter().map(|f| f.x / WEIGHT).collect();
    let power: Vec<f64> = flown.power.iter().map(|p| p / MASS).collect();
    let beats = |x: &[f64]| middle(&[1, 2].map(|b| mean(&x[b * n..=(b + 1) * n])));
    // A smooth start takes half a beat of phase: downstrokes begin in the middle of the flight's beats.
    let half = |k: usize| mean(&up[(3 + k) * n / 2..=(4 + k) * n / 2]);
    Ok(Means {
        mean: [&up, &ahead, &power].map(|x| beats(x)),
        strokes: [half(0), half(1)],
        history: up[3 * n / 2..5 * n / 2].to_vec(),
    })
}

const SOURCE: &str = "Maeda et al. 2017 (surface), weight of a bird of 4.5 g";
const BAND: &str = "hummingbirds of this species have 4 to 5 g, and within 20 % of their middle a hovering one must be carried; \
                    uncertainty: half the change from the second to the third beat";
const STROKES: &str = "Dong et al. 2022, Int. J. Aerosp. Eng. 5433184, Navier-Stokes with this surface: 3.5; ruby-throated hummingbird \
                       2.5 (Song et al. 2014)";

/// The models of the leading edge, the judged one first.
fn models() -> Vec<(&'static str, Choice)> {
    let chosen = ["leading-edge sheets", "attached, Joukowski", "vortex lift"];
    let of = |name: &str| MODELS.into_iter().find(|m| m.0 == name);
    let mut models: Vec<_> = chosen.map(|name| of(name).expect("a model")).to_vec();
    models.insert(1, STEP_BEFORE);
    models
}

fn run(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let surface = across(measured());
    let mut flown = Vec::new();
    for (name, choice) in models() {
        flown.push((name, fly(choice, surface.clone())?));
    }
    let attached = flown[2].1.history.clone();
    let mut rows: Vec<Row> = flown
        .iter()
        .flat_map(|(name, means)| of_a_model(name, means, &attached))
        .collect();
    let reference = &flown[0].1;
    for shape in Shape::WITHOUT {
        let flown = fly(DEFAULT, shape.of(surface.clone()))?;
        rows.extend(of_a_shape(shape, &flown, reference));
    }
    rows.extend(of_a_change(
        "columns of panels along the measured stations",
        &fly(DEFAULT, measured())?,
        reference,
    ));
    for (what, choice, harmonics) in VARIED {
        let surface = SurfaceCase {
            harmonics,
            ..surface.clone()
        };
        rows.extend(of_a_change(what, &fly(choice, surface)?, reference));
    }
    Ok(rows)
}

/// What is changed, for the judged model: how, and the harmonics of the surface.
const VARIED: [(&str, Choice, usize); 5] = [
    ("3 harmonics for 4", DEFAULT, 3),
    ("5 harmonics", DEFAULT, 5),
    (
        "8 x 14 panels and 60 steps for 5 x 10 and 40",
        Choice {
            mesh: [8, 14],
            steps: 60,
            ..DEFAULT
        },
        4,
    ),
    (
        "10 x 20 panels and 80 steps",
        Choice {
            mesh: [10, 20],
            steps: 80,
            ..DEFAULT
        },
        4,
    ),
    (
        "cores x 2",
        Choice {
            core: 2.0,
            ..DEFAULT
        },
        4,
    ),
];

/// Mean vertical force, and how it is parted between the half strokes, against the judged flight's.
fn of_a_change(what: &str, flown: &Means, reference: &Means) -> [Row; 2] {
    let source = "leading-edge sheets, above";
    let parted = |means: &Means| means.strokes[0] / means.strokes[1];
    [
        Row::new(
            format!("{what}: mean vertical force"),
            "weights",
            flown.mean[0][0],
        )
        .against(reference.mean[0][0], source)
        .uncertain(flown.mean[0][1]),
        Row::new(
            format!("{what}: vertical force of the downstroke over that of the upstroke"),
            "1",
            parted(flown),
        )
        .against(parted(reference), source),
    ]
}

fn of_a_model(name: &'static str, flown: &Means, attached: &[f64]) -> [Row; 4] {
    let [up, ahead, power] = flown.mean;
    let row = |what: &str, unit, [value, change]: [f64; 2]| {
        Row::new(format!("{name}: {what}"), unit, value).uncertain(change)
    };
    let mut carried = row("mean vertical force", "weights", up).against(1.0, SOURCE);
    let mut pushed = row("mean horizontal force", "weights", ahead).against(0.0, SOURCE);
    if name == models()[0].0 {
        carried = carried.within(0.2, BAND);
        pushed = pushed.within(0.2, BAND);
    }
    let [down, back] = flown.strokes;
    let quantity = format!("{name}: vertical force of the downstroke over that of the upstroke");
    let mut drawn = Comparison::over_a_beat(
        "vertical force, downstroke first [weights]",
        name,
        &flown.history,
        attached,
    );
    drawn.against = "attached".into();
    let ratio = Row::new(quantity, "1", down / back).against(3.5, STROKES);
    [
        carried,
        pushed,
        row("power over mass", "W/kg", power),
        ratio.drawn(drawn),
    ]
}

fn of_a_shape(shape: Shape, flown: &Means, reference: &Means) -> Vec<Row> {
    let what = [
        "mean vertical force",
        "mean horizontal force",
        "power over mass",
    ];
    let with = "with the measured surface";
    let mut rows: Vec<Row> = (0..3)
        .map(|k| {
            let unit = if k == 2 { "W/kg" } else { "weights" };
            let quantity = format!("{}: {}", shape.name(), what[k]);
            let [value, change] = flown.mean[k];
            let row = Row::new(quantity, unit, value).uncertain(change);
            row.against(reference.mean[k][0], with)
        })
        .collect();
    let mut drawn = Comparison::over_a_beat(
        "vertical force by shape, downstroke first [weights]",
        shape.name(),
        &flown.history,
        &reference.history,
    );
    drawn.against = with.into();
    rows[0] = rows[0].clone().drawn(drawn);
    rows
}
