//! The case of an insect as a commented file.

use super::number::number;
use super::scaling::Insect;

/// The air of a new case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InsectAir {
    /// Quasi-steady: blade elements.
    BladeElement,
    /// Unsteady vortex lattice with free wakes.
    Lattice,
}

/// Attack at the middle of a stroke [deg], the same both ways.
const ATTACK: f64 = 35.0;
/// Density of the body [kg/m3]: that of water.
const DENSITY: f64 = 1000.0;
/// Height of the hinges above the mass centre in hover over the wing length.
const HINGE_HEIGHT: f64 = 0.25;
/// Hinges to the side of the middle, over the diameter of the body, at least: wings do not dip into it.
const HINGE_CLEARANCE: f64 = 0.65;
/// Distance of the wing's root from its hinge over the wing length.
const ROOT: f64 = 0.045;
/// Pitch of the body in hover [deg].
const PITCH: f64 = 45.0;

/// The case file with this stroke from end to end [deg]; hinges are so many times as far aside as they are at least \[1\].
pub(super) fn text(insect: &Insect, air: InsectAir, (stroke, aside): (f64, f64)) -> String {
    [
        head(insect),
        flight(insect, air),
        body(insect),
        wing(insect, stroke, aside),
    ]
    .concat()
}

fn head(insect: &Insect) -> String {
    let Insect {
        name,
        title,
        made_by,
        ..
    } = insect;
    format!(
        "\
# Hovering {title}
# Made by `{made_by}`: numbers have their sources beside them, and what is an estimate says so.
# `wingbeat trim FILE` finds the wing motion and attitude that hold it where it is.
# Axes: inertial n3 points down. Body: b1 forward, b2 right, b3 down. Units are part of each key.
format = 1
name = \"{name}\"
description = \"Hovering {title}\"
"
    )
}

fn flight(insect: &Insect, air: InsectAir) -> String {
    let f = &insect.frequency;
    let (steps, start, air) = match air {
        InsectAir::BladeElement => (200, "start = \"impulsive\"", BLADES.to_owned()),
        InsectAir::Lattice => (40, "start = \"smooth\"", lattice()),
    };
    let held = match start.contains("smooth") {
        true => {
            "held_beats = 1.0           # the body is held for its first beat while the wake builds up\n"
        }
        false => "",
    };
    format!(
        "
[time]
steps_per_beat = {steps}
beats = 5

[motion]
frequency_hz = {}  # {}
stroke_plane_pitch_deg = {PITCH:?}  # with this body pitch the stroke plane is horizontal
{start}

[flight]
{held}pitch_deg = {PITCH:?}           # nose up
{air}",
        number(f.value),
        f.source
    )
}

const BLADES: &str = "
[air]
model = \"blade_element\"
density_kg_m3 = 1.225

[air.blade]
coefficients = \"dickson-2008\"  # measured on a fruit fly's wing
";

fn lattice() -> String {
    "
[air]
model = \"vortex_lattice\"
density_kg_m3 = 1.225
body = true
mirror = true              # symmetric flight: half the air is computed; false for anything else
shed = [\"trailing\", \"tip\", \"leading\", \"root\"]
# For what hangs on yaw, as turns and lateral modes: leading_edge = \"vortex_lift\" (docs/flight-mechanics.md).
summation = \"single\"       # for more than ten beats \"auto\" with summation_tolerance = 1e-3
# Vortex cores and the clearance are in mean chords; cores spread with age as viscosity makes them.
# They are inputs of hover, not results: vary them before trusting a number.
bound_core.algebraic = { radius_chords = 0.01 }
wake_core.algebraic = { radius_chords = 0.07 }
wake_overlap = 1.0         # wake filaments have cores of at least this many times their length
clearance_chords = 0.1     # wakes keep this distance from wings and body

[output]
frames_every = 2
"
    .to_owned()
}

/// An ellipsoid of revolution with the density of water.
fn body_mass(insect: &Insect) -> f64 {
    insect.mass.value - 2.0 * insect.wing_mass.value
}

/// Diameter of the ellipsoid that stands for the body [m].
fn diameter(insect: &Insect) -> f64 {
    let volume = body_mass(insect) / DENSITY;
    (6.0 * volume / (std::f64::consts::PI * insect.body_length.value)).sqrt()
}

fn body(insect: &Insect) -> String {
    let (mass, length) = (body_mass(insect), insect.body_length.value);
    let diameter = diameter(insect);
    format!(
        "
[body]
mass_kg = {}  # without wings; with them {} kg: {}
origin = \"mass_centre\"     # hinges are measured from the mass centre of the body

[body.part.body]           # an ellipsoid of the density of water, which gives the inertia: estimate
length_m = {}  # {}
diameter_m = {}
",
        number(mass),
        number(insect.mass.value),
        insect.mass.source,
        number(length),
        insect.body_length.source,
        number(diameter)
    )
}

fn wing(insect: &Insect, stroke: f64, apart: f64) -> String {
    let length = insect.wing_length.value;
    let up = HINGE_HEIGHT * length / 2.0_f64.sqrt();
    let aside = apart * up.max(HINGE_CLEARANCE * diameter(insect));
    let why = match apart > 1.0 {
        true => {
            "; so far aside that the wings pass neither through each other nor through the body"
        }
        false => "",
    };
    let measured = insect.stroke.as_ref().map_or(String::new(), |stroke| {
        format!(
            "; {} deg from end to end: {}",
            number(stroke.value),
            stroke.source
        )
    });
    format!(
        "
# The right wing; the left one is its mirror image.
[wing.right]
hinge_m = [{up}, {aside}, -{up}]  # {HINGE_HEIGHT} wing lengths above the mass centre in hover: estimate{why}
mass_kg = {mass}  # a wing; {rest}

[wing.right.motion.phi.fourier]
mean_deg = 0
sine_deg = [{half}]  # half of the stroke: what carries the weight by blade elements{measured}

[wing.right.motion.psi.smooth_square]
amplitude_deg = {feathering:?}  # {ATTACK} degrees of attack at mid stroke, the same both ways: estimate
shape = 2.5                # quick turns at the ends of the stroke
shift_deg = 90

[wing.right.planform.beta] # an outline from three numbers (Ellington's beta distribution)
length_m = {r}  # {r_source}
mean_chord_m = {c}  # {c_source}
r2_hat = {r2_hat}  # {r2_source}
root_offset_m = {root}  # estimate
axis_fraction = 0.25       # part of the chord ahead of the hinge axis: estimate
least_chord = 0.15         # at root and tip, relative to the largest

[wing.right.mesh]
chordwise = 4
spanwise = 10
",
        up = number(up),
        aside = number(aside),
        mass = number(insect.wing_mass.value),
        rest = insect.wing_mass.source,
        half = number(0.5 * stroke),
        feathering = ATTACK - 90.0,
        r = number(length),
        r_source = insect.wing_length.source,
        c = number(insect.mean_chord.value),
        c_source = insect.mean_chord.source,
        r2_hat = insect.r2_hat.value,
        r2_source = insect.r2_hat.source,
        root = number(ROOT * length),
    )
}
