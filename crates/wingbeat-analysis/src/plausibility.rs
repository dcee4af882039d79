//! What a flight will be like, before it is flown: the numbers a biologist or engineer knows by
//! heart, the lift that blade elements expect, and what of it is implausible.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | R, c | `length`, `mean_chord` | wing length and mean chord | m |
//! | f, Phi | `frequency`, `stroke_amplitude` | wingbeats per second, stroke from end to end | Hz, rad |
//! | U_t | `tip_speed` | mean speed of the tip from flapping, `2 Phi R f` [Ellington 1984] | m/s |
//! | U | `speed` | the larger of U_t and the flight speed | m/s |
//! | Re | `reynolds` | `U c / nu` | 1 |
//! | k | `reduced_frequency` | `pi f c / U` | 1 |
//!
//! The limits of [`Estimate::doubts`] are wide: they catch slips of unit, sign and scale, not
//! unusual animals. Nothing here is used by a flight.

use wingbeat_air::{CoreModel, Friction, Wind};
use wingbeat_blade::BladeSettings;
use wingbeat_flight::{
    AirModel, AirOptions, BladeOptions, DriftingFourier, FlightSetup, MotionMode, PrescribedMotion,
    Simulation, StartState, TimeGrid,
};
use wingbeat_math::DVec3;
use wingbeat_model::{Start, Wing, WingReport};

use crate::AnalysisError;

/// Kinematic viscosity of air at 20 degrees Celsius [m2/s].
const AIR_VISCOSITY: f64 = 1.5e-5;
/// Steps per wingbeat with which the blade elements are flown.
const STEPS: usize = 60;

/// What is expected of one wing.
#[derive(Clone, Debug, PartialEq)]
pub struct WingEstimate {
    /// Sizes of the wing.
    pub report: WingReport,
    /// Stroke angle from end to end \[rad\]; 0 for a wing that does not flap.
    pub stroke_amplitude: f64,
    /// Mean speed of the tip from flapping [m/s].
    pub tip_speed: f64,
    /// The larger of tip speed and flight speed [m/s].
    pub speed: f64,
    /// Reynolds number of the mean chord; none where the viscosity is not known.
    pub reynolds: Option<f64>,
    /// Reduced frequency of the mean chord; none where nothing flaps or moves.
    pub reduced_frequency: Option<f64>,
}

/// What is expected of a flight.
#[derive(Clone, Debug)]
pub struct Estimate {
    /// Mass \[kg\].
    pub mass: f64,
    /// Wingbeats per second \[Hz\]; none for motions without a period.
    pub frequency: Option<f64>,
    /// Speed through the undisturbed air at the start [m/s].
    pub flight_speed: f64,
    /// Weight over the area of all wings [N/m2]; none without weight or wings.
    pub wing_loading: Option<f64>,
    /// Moments of inertia of the central body about its mass centre, body axes [kg m2].
    pub inertia: DVec3,
    /// Kinematic viscosity [m2/s]: that of the case, or of air where the density is that of air.
    pub viscosity: Option<f64>,
    /// The wings, in the animal's order.
    pub wings: Vec<WingEstimate>,
    /// Mean lift over weight in the attitude and at the velocity of the start, by blade elements;
    /// none without weight, air or wingbeats.
    pub lift_over_weight: Option<f64>,
    /// What is implausible, in whole sentences; empty where nothing is.
    pub doubts: Vec<String>,
}

/// Estimates what a flight will be like.
///
/// # Errors
/// Blade elements that cannot be flown: what the flight reports.
pub fn estimate(setup: &FlightSetup) -> Result<Estimate, AnalysisError> {
    let animal = &setup.animal;
    let reports = animal.wing_reports();
    let area: f64 = reports.iter().map(|r| r.area).sum();
    let weight = animal.mass() * setup.gravity.length();
    let inertia = animal.body.inertia_about_centre();
    let flight_speed = (start_velocity(setup) - stream(&setup.air)).length();
    let mut estimate = Estimate {
        mass: animal.mass(),
        frequency: setup.time.period.map(|p| 1.0 / p),
        flight_speed,
        wing_loading: (weight > 0.0 && area > 0.0).then(|| weight / area),
        inertia: DVec3::new(inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z),
        viscosity: viscosity(&setup.air),
        wings: vec![],
        lift_over_weight: lift_over_weight(setup)?,
        doubts: vec![],
    };
    let wings = animal.wings.iter().zip(reports);
    estimate.wings = wings.map(|(w, r)| estimate.wing(w, r)).collect();
    estimate.doubts = doubts(setup, &estimate);
    Ok(estimate)
}

impl Estimate {
    fn wing(&self, wing: &Wing, report: WingReport) -> WingEstimate {
        let stroke_amplitude = stroke_amplitude(wing);
        let f = wing.motion.frequency;
        let tip_speed = 2.0 * stroke_amplitude * report.length * f;
        let speed = tip_speed.max(self.flight_speed);
        let flaps = tip_speed > 0.0;
        WingEstimate {
            stroke_amplitude,
            tip_speed,
            speed,
            reynolds: (self.viscosity).map(|nu| speed * report.mean_chord / nu),
            reduced_frequency: flaps.then(|| std::f64::consts::PI * f * report.mean_chord / speed),
            report,
        }
    }
}

/// Largest less smallest stroke angle of a beat \[rad\].
fn stroke_amplitude(wing: &Wing) -> f64 {
    const SAMPLES: usize = 200;
    let phi = |k: usize| wing.motion.angles.phi.at(k as f64 / SAMPLES as f64)[0];
    let ends = (0..SAMPLES)
        .map(phi)
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], x| {
            [lo.min(x), hi.max(x)]
        });
    ends[1] - ends[0]
}

/// Velocity of the body at the start, N components [m/s].
fn start_velocity(setup: &FlightSetup) -> DVec3 {
    match &setup.mode {
        MotionMode::Free(start) => start.velocity,
        MotionMode::Tethered(motion) => {
            let [x, y, z] = &motion.position;
            DVec3::new(x.rate, y.rate, z.rate)
        }
    }
}

/// Velocity of the undisturbed air, N components [m/s].
fn stream(air: &AirModel) -> DVec3 {
    match air {
        AirModel::VortexLattice(air) => air.lattice.free_stream,
        AirModel::BladeElement(air) => air.blade.free_stream,
        AirModel::None | AirModel::Derivatives(_) | AirModel::External(_) | AirModel::Own(_) => {
            DVec3::ZERO
        }
    }
}

/// Density [kg/m3], where the air has one.
fn density(air: &AirModel) -> Option<f64> {
    match air {
        AirModel::VortexLattice(air) => Some(air.lattice.density),
        AirModel::BladeElement(air) => Some(air.blade.density),
        AirModel::None | AirModel::Derivatives(_) | AirModel::External(_) | AirModel::Own(_) => {
            None
        }
    }
}

fn viscosity(air: &AirModel) -> Option<f64> {
    if let AirModel::VortexLattice(air) = air {
        let drag = air.lattice.section_drag.as_ref();
        if let Some(Friction::Blasius { viscosity }) = drag.map(|d| &d.friction) {
            return Some(*viscosity);
        }
        if let CoreModel::LambOseen { viscosity, .. } = air.lattice.wake_core {
            return Some(viscosity);
        }
    }
    let is_air = |rho: &f64| (0.3..3.0).contains(rho);
    density(air).filter(is_air).map(|_| AIR_VISCOSITY)
}

/// Mean lift over weight of the second wingbeat of a tethered flight in blade elements.
fn lift_over_weight(setup: &FlightSetup) -> Result<Option<f64>, AnalysisError> {
    let weight = setup.animal.mass() * setup.gravity.length();
    let (Some(period), Some(density)) = (setup.time.period, density(&setup.air)) else {
        return Ok(None);
    };
    if weight == 0.0 || setup.animal.wings.is_empty() {
        return Ok(None);
    }
    let blades = BladeOptions {
        blade: BladeSettings {
            free_stream: stream(&setup.air),
            ..BladeSettings::insect(density)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind: match &setup.air {
            AirModel::VortexLattice(air) => air.lattice.wind.clone(),
            _ => Wind::default(),
        },
    };
    let mut tethered = setup.clone();
    for wing in &mut tethered.animal.wings {
        wing.motion.start = Start::Impulsive;
    }
    if !matches!(setup.air, AirModel::BladeElement(_)) {
        tethered.air = AirModel::BladeElement(blades);
    }
    tethered.mode = MotionMode::Tethered(held(setup));
    tethered.time = TimeGrid {
        step: period / STEPS as f64,
        steps: 2 * STEPS,
        period: Some(period),
    };
    let mut flight = Simulation::new(tethered)?;
    let (down, mut lift) = (setup.gravity / setup.gravity.length(), 0.0);
    while !flight.finished() {
        let record = flight.step()?;
        if record.step > STEPS {
            lift -= record.air.iter().map(|a| a.force.dot(down)).sum::<f64>();
        }
    }
    Ok(Some(lift / STEPS as f64 / weight))
}

/// The root as it starts, attitude and velocity kept.
fn held(setup: &FlightSetup) -> PrescribedMotion {
    match &setup.mode {
        MotionMode::Tethered(motion) => motion.clone(),
        MotionMode::Free(StartState {
            position,
            angles,
            velocity,
            ..
        }) => {
            let (x, v) = (position.to_array(), velocity.to_array());
            PrescribedMotion {
                position: std::array::from_fn(|i| DriftingFourier {
                    rate: v[i],
                    ..DriftingFourier::constant(x[i])
                }),
                angles: angles.to_array().map(DriftingFourier::constant),
            }
        }
    }
}

/// A number outside these limits is doubted.
struct Limit {
    low: f64,
    high: f64,
    /// What may have gone wrong where it is lower, and where it is higher.
    hints: [&'static str; 2],
}

impl Limit {
    fn doubt(&self, what: &str, x: f64, unit: &str) -> Option<String> {
        let [low, high] = self.hints;
        let (side, hint) = match x {
            x if x < self.low => ("below", low),
            x if x > self.high => ("above", high),
            _ => return None,
        };
        let limit = if side == "below" { self.low } else { self.high };
        Some(format!(
            "{what} {}{unit} is {side} {limit}{unit}: {hint}",
            rounded(x)
        ))
    }
}

/// Three digits, as people write them.
fn rounded(x: f64) -> String {
    if x != 0.0 && !(1e-2..1e5).contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let digits = (2 - x.abs().max(1e-9).log10().floor() as i32).clamp(0, 4);
    format!("{x:.*}", digits as usize)
}

const FREQUENCY: Limit = Limit {
    low: 0.05,
    high: 1100.0,
    hints: [
        "slower than the largest birds and robots; is it a period?",
        "the fastest known wings, those of midges, beat at about 1000 Hz; is it in rad/s?",
    ],
};
const WING_LOADING: Limit = Limit {
    low: 0.02,
    high: 500.0,
    hints: [
        "lighter than the smallest insects; is the mass in kg and the wing in m?",
        "heavier than any bird or insect on its wings; is the mass in kg and the wing in m?",
    ],
};
const TIP_SPEED: Limit = Limit {
    low: 0.02,
    high: 60.0,
    hints: [
        "slower than any wing that carries an animal",
        "faster than any animal's; are wing length and frequency right?",
    ],
};
const REYNOLDS: Limit = Limit {
    low: 3.0,
    high: 2e6,
    hints: [
        "friction rules there, and wingbeat's air has little or none",
        "larger than any animal's; are chord, speed and viscosity right?",
    ],
};
const REDUCED_FREQUENCY: Limit = Limit {
    low: 0.0,
    high: 3.0,
    hints: [
        "",
        "the wing hardly moves by its own chord in a beat; is the stroke in degrees?",
    ],
};
const STROKE: Limit = Limit {
    low: 0.0,
    high: 190.0,
    hints: ["", "left and right wing pass through each other"],
};
const GYRATION: Limit = Limit {
    low: 0.03,
    high: 3.0,
    hints: [
        "a body this small for its wings; is the inertia in kg m2?",
        "a body this large for its wings; is the inertia in kg m2?",
    ],
};
const WING_MASS: Limit = Limit {
    low: 0.0,
    high: 0.4,
    hints: [
        "",
        "wings of animals are at most a fifth of the mass; is wing.mass_kg that of one wing?",
    ],
};
const LIFT: Limit = Limit {
    low: 0.5,
    high: 2.0,
    hints: [
        "it will fall; raise stroke or frequency, or let `wingbeat trim` find them",
        "it will rise; lower stroke or frequency, or let `wingbeat trim` find them",
    ],
};
const WAKE_CORE: Limit = Limit {
    low: 0.02,
    high: 0.4,
    hints: [
        "finer than the lattice can resolve; 0.07 chords are usual: air.wake_core, after the size of the animal",
        "it blurs the wake over the wing; 0.07 chords are usual: air.wake_core, after the size of the animal",
    ],
};
const BOUND_CORE: Limit = Limit {
    low: 0.0,
    high: 0.5,
    hints: [
        "",
        "it spoils the flow at the trailing edge: air.bound_core",
    ],
};
const CLEARANCE: Limit = Limit {
    low: 0.0,
    high: 0.5,
    hints: [
        "",
        "wakes are pushed far off the wings; 0.1 chords are usual: air.clearance_m",
    ],
};
const TIP_STEP: Limit = Limit {
    low: 0.0,
    high: 1.5,
    hints: ["", "take more steps: time.steps_per_beat"],
};

fn doubts(setup: &FlightSetup, e: &Estimate) -> Vec<String> {
    let mut list: Vec<String> = vec![];
    let mut see = |limit: &Limit, what: &str, x: Option<f64>, unit: &str| {
        list.extend(x.and_then(|x| limit.doubt(what, x, unit)));
    };
    let is_free = matches!(setup.mode, MotionMode::Free(_));
    see(&FREQUENCY, "wingbeat frequency", e.frequency, " Hz");
    let loading = e.wing_loading.filter(|_| is_free);
    see(&WING_LOADING, "wing loading", loading, " N/m2");
    let lift = e.lift_over_weight.filter(|_| is_free);
    see(&LIFT, "mean lift over weight by blade elements", lift, "");
    let wings: f64 = e.wings.iter().map(|w| w.report.mass).sum();
    let part = (is_free && e.mass > 0.0).then(|| wings / e.mass);
    see(
        &WING_MASS,
        "mass of the wings over that of the animal",
        part,
        "",
    );
    let body = setup.animal.body.mass;
    let length = e.wings.iter().map(|w| w.report.length).fold(0.0, f64::max);
    let gyration = (e.inertia.max_element() / body).sqrt() / length;
    let gyration = Some(gyration).filter(|g| is_free && g.is_finite() && *g > 0.0);
    see(
        &GYRATION,
        "radius of gyration of the body over the wing length",
        gyration,
        "",
    );
    let mut said = std::collections::BTreeSet::new();
    for (wing, w) in setup.animal.wings.iter().zip(&e.wings) {
        let mut own = wing_doubts(setup, wing, w);
        own.retain(|d| said.insert(d.clone())); // mirrored wings share their doubts
        let name = |d| format!("wing `{}`: {d}", wing.name);
        list.extend(own.into_iter().map(name));
    }
    list
}

fn wing_doubts(setup: &FlightSetup, wing: &Wing, w: &WingEstimate) -> Vec<String> {
    let mut list = vec![];
    let mut see = |limit: &Limit, what: &str, x: Option<f64>, unit: &str| {
        list.extend(x.and_then(|x| limit.doubt(what, x, unit)));
    };
    let flaps = Some(w.tip_speed).filter(|u| *u > 0.0);
    see(&TIP_SPEED, "mean tip speed", flaps, " m/s");
    see(
        &STROKE,
        "stroke amplitude",
        Some(w.stroke_amplitude.to_degrees()),
        " deg",
    );
    see(
        &REYNOLDS,
        "Reynolds number",
        w.reynolds.filter(|_| w.speed > 0.0),
        "",
    );
    see(
        &REDUCED_FREQUENCY,
        "reduced frequency",
        w.reduced_frequency,
        "",
    );
    if let AirModel::VortexLattice(air) = &setup.air {
        let chord = w.report.mean_chord;
        let step = flaps.map(|u| u * setup.time.step / chord);
        see(&TIP_STEP, "way of the tip in a step", step, " chords");
        let [wake, bound, clearance] = lattice_sizes(air, wing, chord);
        see(&WAKE_CORE, "vortex core of the wake", wake, " mean chords");
        see(
            &BOUND_CORE,
            "vortex core of the wing",
            bound,
            " panel lengths",
        );
        see(&CLEARANCE, "clearance", clearance, " mean chords");
    }
    let outward = wing.side.sign() * wing.hinge_b.y;
    if outward < -1e-3 * w.report.length {
        list.push(format!(
            "its hinge lies {:.3} mm on the other side of the body: the sign of hinge_m[1]",
            -1e3 * outward
        ));
    }
    list
}

/// Wake core and clearance over the mean chord, bound core over the mean panel length.
fn lattice_sizes(air: &AirOptions, wing: &Wing, chord: f64) -> [Option<f64>; 3] {
    let s = &air.lattice;
    let panel = chord / wing.mesh.rows as f64;
    [
        radius(&s.wake_core).map(|r| r / chord),
        radius(&s.bound_core).map(|r| r / panel),
        Some(s.clearance / chord),
    ]
}

/// Radius of a core \[m\]; a cut-off has none.
fn radius(core: &CoreModel) -> Option<f64> {
    match *core {
        CoreModel::CutOff { .. } => None,
        CoreModel::Vatistas { radius }
        | CoreModel::Scully { radius }
        | CoreModel::LambOseen { radius, .. } => Some(radius),
    }
}
