//! The default animal: the fruit fly *Drosophila melanogaster*.
//!
//! The body frame origin is the **mass centre of the body** (head, thorax, abdomen and the legs,
//! without wings); b1 points along the body to the head.
//!
//! | figure | value | source |
//! |---|---|---|
//! | wing length R | 2.5 mm | Grand Unified Fly (willdickson/fmech; Dickson, Straw & Dickinson 2008) |
//! | mean chord | 0.699 mm | same |
//! | wing mass | 5.35 ug | same |
//! | body mass | 0.9315 mg | same |
//! | body length L | 2.5 mm | same |
//! | hinge from body mass centre | 0.6 mm ahead, 0.36 mm aside, 0.15 mm above | same |
//! | nominal wingbeat | 5 ms, 200 Hz | same |
//! | r2_hat | 0.586 | shape moments of a digitised wing (drosophila, J. Gruber) |
//! | shares of head, thorax with legs, abdomen | 0.15 : 0.4372 : 0.38 | flybody (52 females; Vaxenburg et al. 2025) |
//! | body pitch in hover | 47.5 deg | flybody's convention for the conventional flight posture |
//! | wing motion | [`fry_hover`] | Fry, Sayaman & Dickinson 2005 |
//!
//! Fry's flies beat at 218 Hz with R = 2.39 mm; forces scale as R^4 f^2, and 200 Hz with R = 2.5 mm carries the
//! same within one per cent. Not published and chosen here: lengths and radii of the three parts (ellipsoids
//! with gaps of 0.02 mm, sized so that each has near the density of water, the thorax slimmer so that the wings
//! pass it at stroke reversal), the root offset of 0.05 R, the part 0.25 of the chord ahead of the hinge axis,
//! the least chord at root and tip (0.15 of the largest).

use crate::animal::{Animal, BodyPart, Wing};
use crate::build::{BodyMass, fit_body_length};
use crate::error::{ModelError, require_count};
use crate::kinematics::fry_hover;
use crate::mesh::Side;
use crate::mesh::integrate::MassInput;
use crate::mesh::revolution::Revolution;
use crate::motion::Start;
use crate::planform::{Beta, ChordSize, Planform, WingShape};
use std::f64::consts::FRAC_PI_2;
use wingbeat_math::DVec3;

/// Choices for the fruit fly; `default()` is the fly of the default flight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlyOptions {
    /// Size relative to the measured fly \[1\]: lengths x s, masses x s^3.
    pub scale: f64,
    /// Wing panels along the chord.
    pub wing_rows: usize,
    /// Wing panels along the span.
    pub wing_cols: usize,
    /// Panels from pole to pole of head, thorax, abdomen.
    pub stations: [usize; 3],
    /// Panels around of head, thorax, abdomen; even.
    pub meridians: [usize; 3],
    /// Wingbeat frequency \[Hz\].
    pub frequency: f64,
    /// Body pitch in hover \[rad\] for which the stroke plane is horizontal.
    pub body_pitch: f64,
    /// Start of the wing motion; `None`: smooth over one wingbeat.
    pub start: Option<Start>,
}

/// Body pitch in hover, nose up \[rad\].
pub const HOVER_BODY_PITCH: f64 = 47.5 * std::f64::consts::PI / 180.0;

impl Default for FlyOptions {
    fn default() -> Self {
        Self {
            scale: 1.0,
            wing_rows: 5,
            wing_cols: 10,
            stations: [4, 6, 6],
            meridians: [8, 8, 8],
            frequency: 200.0,
            body_pitch: HOVER_BODY_PITCH,
            start: None,
        }
    }
}

/// Names of the body parts, front to rear.
pub const PARTS: [&str; 3] = ["head", "thorax", "abdomen"];
/// Lengths of the parts \[m\]; with two gaps of 0.02 mm they sum to the body length.
const PART_LENGTHS: [f64; 3] = [0.42e-3, 0.93e-3, 1.11e-3];
const PART_RADII: [f64; 3] = [0.42e-3, 0.39e-3, 0.42e-3];
const GAP: f64 = 0.02e-3;
const BODY_LENGTH: f64 = 2.5e-3;
const BODY_MASS: f64 = 0.9315e-6;
/// flybody \[kg\]: head, thorax with six legs of 0.0162 mg, abdomen.
const PART_MASSES: [f64; 3] = [0.15e-6, 0.34e-6 + 6.0 * 0.0162e-6, 0.38e-6];
const WING_LENGTH: f64 = 2.5e-3;
const MEAN_CHORD: f64 = 0.699e-3;
const WING_MASS: f64 = 5.35e-9;
/// Right hinge from the mass centre of the body \[m\].
const HINGE: DVec3 = DVec3::new(0.6e-3, 0.36e-3, -0.15e-3);

/// The fruit fly: body, left wing, right wing (in this order), hovering wing motion.
///
/// ```
/// let fly = wingbeat_model::species::drosophila_melanogaster(&Default::default()).unwrap();
/// assert_eq!(fly.wings[0].name, "left");
/// assert!((fly.mass() * 1e6 - 0.9422).abs() < 1e-4); // 0.9315 mg + 2 x 0.00535 mg
/// ```
///
/// # Errors
/// An option that is not allowed.
pub fn drosophila_melanogaster(options: &FlyOptions) -> Result<Animal, ModelError> {
    let motion = |side| {
        let eta = FRAC_PI_2 - options.body_pitch;
        let mut motion = fry_hover().wing(side, options.frequency, eta);
        motion.start = options.start.unwrap_or(motion.start);
        motion
    };
    let mass = MassInput::Total(WING_MASS);
    let shape = wing_shape(options.wing_rows, options.wing_cols);
    let right = Wing::new(
        "right",
        Side::Right,
        HINGE,
        &shape,
        &mass,
        motion(Side::Right),
    )?;
    let body = body(options)?;
    let centre = body.body.centre();
    Animal {
        name: "Drosophila melanogaster".to_owned(),
        wings: vec![right.mirrored("left"), right],
        ..body.with_origin(centre)
    }
    .scaled(options.scale)
    .and_then(|fly| fly.check().map(|()| fly))
}

/// The wing of the fruit fly with the given numbers of panels.
pub fn wing_shape(rows: usize, cols: usize) -> WingShape {
    let planform = Planform::Beta(Beta {
        length: WING_LENGTH,
        size: ChordSize::Mean(MEAN_CHORD),
        r2_hat: 0.58592,
        root_offset: 0.05 * WING_LENGTH,
        axis_fraction: 0.25,
        least_chord: 0.15,
    });
    WingShape::uniform(planform, rows, cols)
}

/// Head, thorax and abdomen along b1, nose at the origin.
fn body(options: &FlyOptions) -> Result<Animal, ModelError> {
    let mut shapes = Vec::new();
    let mut front = 0.0;
    for k in 0..3 {
        let density = [options.stations[k], options.meridians[k]];
        require_count(
            &format!("{}.stations", PARTS[k]),
            density[0],
            density[0] >= 2,
            ">= 2",
        )?;
        let centre = DVec3::new(front - 0.5 * PART_LENGTHS[k], 0.0, 0.0);
        shapes.push(Revolution::ellipsoid(
            centre,
            PART_LENGTHS[k],
            PART_RADII[k],
            density,
        ));
        front -= PART_LENGTHS[k] + GAP;
    }
    let shapes = fit_body_length(&shapes, BODY_LENGTH)?;
    let part = |k: usize| {
        let mass = MassInput::Total(PART_MASSES[k]);
        BodyPart::revolution(PARTS[k], &shapes[k], &mass)
    };
    let parts = (0..3).map(part).collect::<Result<Vec<_>, _>>()?;
    Animal::new("body", BodyMass::Total(BODY_MASS), parts, Vec::new())
}
