//! Modes of small vibrations of elastic wings: in vacuum, and with the added mass of the air.
//!
//! A wing vibrates in its frame, which is held. In air the added mass of a lattice without wakes joins that of
//! the wing: what a stream and a wake do to frequencies and damping is [`crate::vibration::flutter`]'s question. Other
//! wings are held; of a lattice that computes one half only, the other half vibrates as the mirror image.
//!
//! Sheets have modes in which nodes turn and nothing moves, of the elements and of no sheet: quarters of panels
//! are lumped at nodes and turn with them. Among those of solid sheets they are the fastest; of sheets that
//! bend much more easily they lie among the first. A wave of number k over panels of length d has `(k d)^2 /
//! 12` times as much energy in turns as in displacements, less than as much even for two panels a wave: where
//! there is more, nothing moves. They are left out, and counted.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | omega | [`WingMode::frequency`] | angular frequency of a mode | rad/s |
//! | phi | [`WingMode::displacement`] | shape of a mode at the nodes of the mesh, the largest displacement 1 | - |
//! | m | [`WingMode::mass`] | modal mass for that shape, `phi^T M phi` | kg |

use wingbeat_flight::elastic::ElasticWing;
use wingbeat_flight::{FlightError, FlightSetup, FlightState, Simulation};
use wingbeat_math::DVec3;
use wingbeat_structure::{Configuration, FrameMotion, Mode, Slowest, slowest_modes};

use crate::AnalysisError;
use crate::plausibility::bent_by_weight;
use crate::progress;
use crate::vibration::flutter::{ElasticRig, FlutterSettings};
use crate::vibration::moving::{enough, moving, only_turns};

/// The state that wings vibrate about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum About {
    /// As built, at the start of the flight.
    Rest,
    /// The steady state in a stream, wings held.
    Steady,
}

/// A mode of small vibration of a wing.
#[derive(Clone, Debug, PartialEq)]
pub struct WingMode {
    /// Angular frequency [rad/s]; 0 of a mode that does not vibrate.
    pub frequency: f64,
    /// Rate [1/s] at which it grows about a state that is no stable equilibrium; 0 of a mode that vibrates.
    pub growth: f64,
    /// Displacements of the nodes of the mesh, wing components, the largest of length 1 \[1\].
    pub displacement: Vec<DVec3>,
    /// Modal mass for that shape \[kg\], the added mass of the air included where it is there.
    pub mass: f64,
}

impl WingMode {
    fn new(wing: &ElasticWing, at: &Configuration, mode: &Mode) -> Self {
        let followers = wing.followers().iter();
        let mut displacement: Vec<DVec3> = followers.map(|f| f.velocity(at, &mode.shape)).collect();
        let largest = displacement.iter().copied().fold(DVec3::ZERO, longer);
        // At the place that moves most, towards w3 or else w1: signs do not depend on rounding in the solver.
        let ahead = if largest.z.abs() > 0.5 * largest.length() {
            largest.z
        } else {
            largest.x
        };
        let size = largest.length().copysign(ahead);
        displacement.iter_mut().for_each(|d| *d /= size);
        Self {
            frequency: mode.frequency(),
            growth: (-mode.square).max(0.0).sqrt(),
            displacement,
            mass: size.powi(-2),
        }
    }

    /// How alike two shapes are \[1\]: the modal assurance criterion of Allemang & Brown (1982) on the nodes of
    /// the mesh.
    pub fn likeness(&self, other: &Self) -> f64 {
        let product = |a: &Self, b: &Self| -> f64 {
            let both = a.displacement.iter().zip(&b.displacement);
            both.map(|(a, b)| a.dot(*b)).sum()
        };
        product(self, other).powi(2) / (product(self, self) * product(other, other))
    }
}

fn longer(a: DVec3, b: DVec3) -> DVec3 {
    // A hair's breadth of preference for the first: equal lengths at mirrored places differ by rounding.
    if b.length() > (1.0 + 1e-9) * a.length() {
        b
    } else {
        a
    }
}

/// The mode in vacuum that one in air is most alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alike {
    /// Its number, counted from 0.
    pub mode: usize,
    /// How alike \[1\].
    pub likeness: f64,
}

impl Alike {
    fn of(m: &WingMode, vacuum: &[WingMode]) -> Self {
        let likenesses = vacuum.iter().map(|v| m.likeness(v)).enumerate();
        let (mode, likeness) = likenesses.fold((0, -1.0), |best, next| match next.1 > best.1 {
            true => next,
            false => best,
        });
        Self { mode, likeness }
    }
}

/// How many times as many modes in vacuum as are asked for those in air are compared with: heavy air changes
/// their order.
const COMPARED: usize = 4;

/// Growth over the highest frequency that rounding makes of a mode without stiffness \[1\].
const ROUNDING: f64 = 1e-5;

/// The modes of one elastic wing.
#[derive(Clone, Debug, PartialEq)]
pub struct WingModes {
    /// Number of the wing.
    pub wing: usize,
    /// Nodes of its mesh as it vibrates about them \[m\], wing components.
    pub nodes: Vec<DVec3>,
    /// Displacement of the nodes from where they are at rest \[m\], wing components.
    pub deflection: Vec<DVec3>,
    /// Mass of the wing \[kg\].
    pub mass: f64,
    /// Without air, of rising frequency.
    pub vacuum: Vec<WingMode>,
    /// With the added mass of the air; none in vacuum.
    pub air: Option<Vec<WingMode>>,
    /// Of each of those in air the mode in vacuum that is most alike.
    pub alike: Vec<Alike>,
    /// How many modes below the last of these were left out in which nodes turn and nothing moves: in vacuum, in air.
    pub left_out: [usize; 2],
    /// Frequencies of those left out in vacuum that move, too, if less than they turn: waves of the sheet mixed
    /// with turns [rad/s].
    pub mixed: Vec<f64>,
    /// About rest, displacement of the tip by weight across the wing over its length, were it linear, as an even cantilever
    /// of its first frequency has it; none about a steady state, which is bent by it \[1\].
    pub bent_by_weight: Option<f64>,
    /// Fastest growth in vacuum of a mode in which nodes turn and nothing moves; 0 if none grows [1/s].
    pub turning_growth: f64,
}

/// The leading `count` modes of all elastic wings of `setup`.
///
/// # Errors
/// No elastic wing; a steady state that is not reached; what the flight and the eigenproblem report.
pub fn wing_modes(
    setup: &FlightSetup,
    about: About,
    count: usize,
) -> Result<Vec<WingModes>, AnalysisError> {
    if setup.animal.wings.iter().all(|w| w.structure.is_none()) {
        return Err(AnalysisError::not_covered(
            "no wing is elastic",
            "give one a structure: [wing.NAME.structure]",
        ));
    }
    let flight = match about {
        About::Rest => Simulation::new(at_rest(setup))?,
        About::Steady => steady(setup)?,
    };
    let wings = 0..flight.elastic_wings().wings().len();
    let of = |k: usize| -> Result<WingModes, AnalysisError> {
        let mut found = of_wing(&flight, k, count)?;
        if about == About::Rest {
            let first = found.vacuum.first().map(|m| m.frequency);
            let wing = &setup.animal.wings[found.wing];
            found.bent_by_weight = bent_by_weight(wing, first, setup.gravity.length());
        }
        Ok(found)
    };
    wings.map(of).collect()
}

/// A flight of no steps: wings that are too soft for the first ones have modes, too.
fn at_rest(setup: &FlightSetup) -> FlightSetup {
    let mut setup = setup.clone();
    setup.time.steps = 0;
    setup
}

/// The flight in its steady state.
fn steady(setup: &FlightSetup) -> Result<Simulation, AnalysisError> {
    let speed = setup.air.stream().map_or(0.0, |s| s.length());
    let rig = ElasticRig::new(setup, speed)?;
    let (state, _) = rig.to_steady(&FlutterSettings::default())?;
    Ok(Simulation::resume(rig.setup, state)?)
}

fn of_wing(flight: &Simulation, k: usize, count: usize) -> Result<WingModes, AnalysisError> {
    let wing = &flight.elastic_wings().wings()[k];
    let state: &FlightState = flight.state();
    let (structure, at) = (wing.structure(), &state.wings[k].structure.configuration);
    let slowest = |what: &str, added: Option<&[f64]>, count| -> Result<Slowest, AnalysisError> {
        progress::task(what, 0, 0);
        let moved = (&FrameMotion::REST, added);
        let found = slowest_modes(structure, at, moved, &enough(wing, count));
        Ok(found.map_err(FlightError::from)?)
    };
    let added = flight.added_mass(k)?;
    let in_vacuum = slowest("in vacuum", None, COMPARED * count)?;
    let in_air = added.map(|a| slowest("in air", Some(&a), count));
    let in_air = in_air.transpose()?.map(|found| found.modes);
    let turning_growth = turning_growth(wing, &in_vacuum);
    let in_vacuum = in_vacuum.modes;
    let (vacuum, left_out) = leading(wing, at, in_vacuum.clone(), count);
    let (air, left_out_in_air) = in_air.map(|a| leading(wing, at, a, count)).unzip();
    let compared = leading(wing, at, in_vacuum, COMPARED * count).0;
    let alike = air.iter().flatten().map(|m| Alike::of(m, &compared));
    let [nodes, rest] = [at, structure.rest()].map(|at| places(wing, at));
    Ok(WingModes {
        wing: wing.wing(),
        deflection: nodes.iter().zip(rest).map(|(a, b)| *a - b).collect(),
        nodes,
        mass: structure.mass_properties(structure.rest()).mass,
        vacuum,
        alike: alike.collect(),
        air,
        left_out: [left_out.count, left_out_in_air.map_or(0, |l| l.count)],
        mixed: left_out.mixed,
        bent_by_weight: None,
        turning_growth,
    })
}

/// Modes that are not among the leading ones.
struct LeftOut {
    /// How many turn nodes and move nothing.
    count: usize,
    /// As [`WingModes::mixed`].
    mixed: Vec<f64>,
}

/// The first `count` of the modes that move the wing; growth that is rounding is none.
fn leading(
    wing: &ElasticWing,
    at: &Configuration,
    all: Vec<Mode>,
    count: usize,
) -> (Vec<WingMode>, LeftOut) {
    let found = moving(wing, all, count);
    let leading = found.modes.iter().map(|m| WingMode::new(wing, at, m));
    let mut leading: Vec<WingMode> = leading.collect();
    let fastest = leading.iter().map(|m| m.frequency).fold(0.0, f64::max);
    for m in leading.iter_mut().filter(|m| m.growth < ROUNDING * fastest) {
        m.growth = 0.0;
    }
    let left_out = LeftOut {
        count: found.left_out,
        mixed: found.mixed,
    };
    (leading, left_out)
}

/// As [`WingModes::turning_growth`].
fn turning_growth(wing: &ElasticWing, slowest: &Slowest) -> f64 {
    let fastest = slowest.fastest;
    let turning = slowest.modes.iter().filter(|m| only_turns(wing, m));
    let growth = turning.map(|m| (-m.square).max(0.0).sqrt());
    let largest = growth.fold(0.0, f64::max);
    match largest > ROUNDING * fastest {
        true => largest,
        false => 0.0,
    }
}

/// Where the nodes of the wing are.
fn places(wing: &ElasticWing, at: &Configuration) -> Vec<DVec3> {
    wing.followers().iter().map(|f| f.position(at)).collect()
}
