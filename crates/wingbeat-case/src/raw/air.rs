//! `[air]`: the air and the settings of the vortex lattice.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use wingbeat_air::{CirculationRate, Convection, EdgeKind, LoadMethod, Method};

use super::cores::{CoreCase, LambOseenCase};
use super::wind::{GroundCase, GustCase, VortexStreetCase};
use super::{BladeCase, DerivativesCase, ExternalCase, Open, ParticlesCase, SectionDragCase};

/// Keys of the vortex lattice.
const LATTICE: &str = "air.model = vortex_lattice";
/// Keys of wakes.
const SHEDDING: &str = "shed = trailing | tip | leading | root";
/// Keys of the air that moves.
const WIND: &str = "air.model = vortex_lattice | blade_element";
/// Keys of the undisturbed air.
const FLUID: &str = "air.model = vortex_lattice | blade_element | derivatives";

/// The air and its model.
#[derive(Clone, Debug, PartialEq, SmartDefault, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AirCase {
    /// The model of the air.
    ///
    /// Change it to `blade_element` for speed, to `none` to see what inertia alone does.
    #[default(AirModel::VortexLattice)]
    pub model: AirModel,
    /// Density of the air; of derivatives, those of `air.derivatives.dimensionless` ask for it.
    ///
    /// Change it for another altitude or fluid; of a liquid give `viscosity_m2_s`, too.
    #[default = 1.225]
    #[schemars(extend("exclusiveMinimum" = 0, "with" = FLUID))]
    pub density_kg_m3: f64,
    /// Whether the closed parts of the body and of segments feel the buoyancy of the fluid that they displace: each its
    /// weight, against gravity, at the centre of its volume. Wings, which have none, feel nothing of it; a mass weighed
    /// in the fluid is given as it is there, without this.
    ///
    /// Change it to true in water.
    #[schemars(extend("with" = WIND))]
    pub buoyancy: bool,
    /// Kinematic viscosity of the air: of friction, of wakes that spread, and of the Reynolds numbers of `check`; no force
    /// of blade elements depends on it. Default: of a gas 1.84e-5 Pa s, the dynamic viscosity of air, over the density
    /// (1.5e-5 at 1.225 kg/m3); of a liquid 1.5e-5 in the lattice, and no Reynolds number in blade elements. The lattice takes either this, or those of `wake_core` and `section_drag`.
    ///
    /// Change it for a liquid (1e-6 in water), and for gases and temperatures of which you know it.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = WIND))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub viscosity_m2_s: Option<f64>,
    /// Velocity of the undisturbed air, inertial axes.
    ///
    /// Change it for wind, or for a tunnel: a body at rest in a stream.
    #[schemars(inner(range(min = -10_000, max = 10_000)), extend("with" = FLUID))]
    pub stream_m_s: [f64; 3],
    /// Whether head, thorax and abdomen are part of the lattice.
    ///
    /// Change it to false where the body hardly moves the air at the wings: the flight is faster. Wings must be
    /// outside of its parts; the circulation of wings whose roots lie on one goes on through it
    /// (docs/wings-on-bodies.md, "Wings on a body").
    #[default = true]
    #[schemars(extend("with" = LATTICE))]
    pub body: bool,
    /// The flight is mirror-symmetric: the air is computed on one half. Lateral motion cannot
    /// grow; a motion, a stream, a gust, a shear or a ground that is not symmetric is refused.
    ///
    /// Change it to true for symmetric flight: it costs about half as much.
    #[schemars(extend("with" = LATTICE))]
    pub mirror: bool,
    /// Edges of the wings that shed wakes. Roots that are joined, or whose circulation goes on through a body, shed nothing.
    ///
    /// Change it to trailing edges alone where the flow stays attached, as in cruise.
    #[default(vec![EdgeKind::Trailing, EdgeKind::Tip, EdgeKind::Leading, EdgeKind::Root])]
    #[schemars(extend("with" = LATTICE))]
    pub shed: Vec<EdgeKind>,
    /// Core of the vortex filaments on the surfaces. Default: algebraic, 0.01 mean chords; of animals without
    /// wings 0.01 mean widths of the panels of their bodies, which stand for the chord there. At least a millionth of
    /// that, but for the algebraic one, which may be 0: beside their own line filaments know distances to rounding.
    ///
    /// Change it with care: a core wider than half a panel spoils the Kutta condition.
    #[default(LambOseenCase::chords(0.01))]
    #[schemars(extend("with" = LATTICE))]
    pub bound_core: CoreCase,
    /// Core of the vortex filaments in the wakes: a physical input of hover. Default:
    /// algebraic, from 0.07 mean chords on, which the radius is where a table gives the viscosity alone.
    ///
    /// Change it by a factor of two both ways to see what depends on it; for the drag of attached wings in a
    /// stream to 0.01 chords, with `wake_overlap_slope` = 0.03 (docs/lattice-settings.md,
    /// "Induced drag of attached wings").
    #[default(LambOseenCase::chords(0.07))]
    #[schemars(extend("with" = LATTICE))]
    pub wake_core: CoreCase,
    /// Least core radius of a free wake filament over its length: keeps wakes resolved that the flow stretches.
    /// Default: 1, or 0 where `wake_core` is a cut-off, which has no radius. Algebraic cores are no wider for
    /// it than `wake_overlap_slope` allows.
    ///
    /// Change it to 0 to compare with codes whose cores do not widen; wakes that roll up lose their impulse then, and
    /// long hover blows up.
    #[schemars(extend("minimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Open::is_open")]
    pub wake_overlap: Open<f64>,
    /// Radius of a core of the wake over the way along the sheet from its edge, at most, for the sake of
    /// `wake_overlap`. Default: 0.25. Only with algebraic cores and a `wake_overlap` above 0.
    ///
    /// Change it to 0.03 for the drag of attached wings in a stream (docs/lattice-settings.md,
    /// "Induced drag of attached wings").
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_overlap_slope: Option<f64>,
    /// Length from which a wake filament turns into a vortex blob, wholly at 1.25 times this
    /// length; left out: never. Blobs are summed on a mesh: the cost of long flights then grows
    /// with the wake and not with its square. Needs `wake_overlap` of 0.5 or more, and as
    /// `wake_core` `lamb_oseen`, `vatistas` or `scully`: algebraic cores, as `fruit-fly-hover` has them, refuse it.
    ///
    /// Change it for flights of more than ten beats: two mean chords.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_blob_length_m: Option<f64>,
    /// The length of `wake_blob_length_m` in mean chords of all wings.
    ///
    /// Change it for flights of more than ten beats: 2 is a good length. Refused by algebraic cores.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING], "or" = "wake_blob_length_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wake_blob_length_chords: Option<f64>,
    /// Set of numerical choices: what the keys `circulation_rate`, `convection` and `ring_inset`
    /// are where they are left out, and how the newest wake row meets its edge.
    ///
    /// Change it to `benchmark` to reproduce published first-order results.
    #[default(SchemeCase::Accurate)]
    #[schemars(extend("with" = LATTICE))]
    pub scheme: SchemeCase,
    /// How the rate of change of circulation in the pressure is formed. Default: by `scheme`.
    ///
    /// Change it to `omitted` for quasi-steady loads.
    #[schemars(extend("with" = LATTICE))]
    #[serde(skip_serializing_if = "Open::is_open")]
    pub circulation_rate: Open<CirculationRate>,
    /// How wake nodes are moved; with algebraic cores, with a correction besides the velocity of the air that
    /// cancels their share of force (docs/separated-flow-method.md). Default: by `scheme`.
    ///
    /// Change it to study the order of the method in the step.
    #[schemars(extend("with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Open::is_open")]
    pub convection: Open<Convection>,
    /// Part of a panel by which rings stay inside side edges that do not shed, but for columns of cosine spacing, and
    /// lie aft. Default: by `scheme`, 0 or 0.25.
    ///
    /// Change it to 0 for rings on the panel edges.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 0.5, "with" = LATTICE))]
    #[serde(skip_serializing_if = "Open::is_open")]
    pub ring_inset: Open<f64>,
    /// How forces follow from circulations.
    ///
    /// Change it to `pressure` for the published benchmark's, without the suction of attached leading edges.
    #[default(LoadMethod::Joukowski)]
    #[schemars(extend("with" = LATTICE))]
    pub loads: LoadMethod,
    /// Where the flow leaves leading edges, if `shed` names them.
    ///
    /// Change it to `suction`, with roots left out of `shed`, for hover with strokes alike back and forth in two thirds of
    /// the time (docs/separated-flow.md); to `angle_of_attack` where measurements tell when a wing of this section stalls.
    #[default(LeadingEdgeCase::SuctionImplicit)]
    #[schemars(extend("with" = [LATTICE, "shed = leading"]))]
    pub leading_edge: LeadingEdgeCase,
    /// Effective angle of attack above which a strip sheds from its leading edge.
    ///
    /// Change it with the section of the wing and its Reynolds number.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 180, "with" = [LATTICE, "leading_edge = angle_of_attack"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leading_edge_threshold_deg: Option<f64>,
    /// Leading-edge suction parameter that the leading edge of a strip holds: what is beyond it sheds.
    ///
    /// Change it with the section of the wing: aerofoils hold about 0.18 times the root of their nose's radius
    /// over 0.008 chords.
    #[default(0.15)]
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, "leading_edge = suction | suction_implicit | vortex_lift", "shed = leading"]))]
    pub leading_edge_threshold: f64,
    /// Part of the force of that suction which acts, and of all else that pulls along the wing: none on the
    /// thin edges of insects.
    ///
    /// Change it to 1 for round leading edges.
    #[default(0.0)]
    #[schemars(extend("minimum" = 0, "maximum" = 1, "with" = [LATTICE, "leading_edge = suction | suction_implicit | vortex_lift", "shed = leading", "loads = joukowski"]))]
    pub leading_edge_suction_efficiency: f64,
    /// Chords of travel, of each strip by the chord of its section normal to the edge, for which the vortex of
    /// a leading edge can be fed before its lift is lost.
    ///
    /// Change it within what is measured, 3.4 to 4.5.
    #[default(4.0)]
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, "leading_edge = vortex_lift"]))]
    pub leading_edge_formation_chords: f64,
    /// Gusts, added to the stream.
    ///
    /// Change it to meet the animal with one; several add up.
    #[schemars(extend("with" = WIND, "always" = true))]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gust: Vec<GustCase>,
    /// A vortex street, added to the stream; left out: none.
    ///
    /// Change it to fly in the wake of a body or of an animal ahead.
    #[schemars(extend("with" = WIND, "always" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vortex_street: Option<VortexStreetCase>,
    /// Gradient of a steady shear, three rows: the velocity (gradient x position) is added to the
    /// stream; left out: none.
    ///
    /// Change it for flight near the ground or in a wake.
    #[schemars(extend("with" = WIND, "always" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_1_s: Option<[[f64; 3]; 3]>,
    /// A plane through which no air goes: stream, gusts and shear go along it, and bodies and wings stay on one
    /// side; a root or tip that lies on it all along is joined to its mirror image. Left out: none.
    ///
    /// Change it for take-off, landing and hovering near the ground, and for half a model on a wall.
    #[schemars(extend("with" = LATTICE, "always" = true))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ground: Option<GroundCase>,
    /// Wake rows older than this are dropped; left out: none.
    ///
    /// Change it to make long flights cheaper; what is dropped is missing.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_age_s: Option<f64>,
    /// Wake rows farther than this from their edge are dropped; left out: none.
    ///
    /// Change it to make long flights cheaper; what is dropped is missing.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_distance_m: Option<f64>,
    /// The distance of `max_wake_distance_m` in mean chords of all wings.
    ///
    /// Change it to make long flights cheaper; what is dropped is missing.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING], "or" = "max_wake_distance_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_distance_chords: Option<f64>,
    /// Rows kept in each wake sheet, at least 2 where leading edges shed by a criterion; left out: all.
    ///
    /// Change it to make long flights cheaper; what is dropped is missing.
    #[schemars(range(min = 1), extend("with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_wake_rows: Option<usize>,
    /// Nodes of a row of wake move alike, with the air in the middle of the row, and ends of sections move no
    /// air: plane flow.
    ///
    /// Change it to true for sections: wings of one panel along the span, a hundred times as long as their chord,
    /// with `mirror = false` and without tips and roots in `shed` (docs/lattice-settings.md, "Plane flow").
    #[schemars(extend("with" = [LATTICE, SHEDDING]))]
    pub plane_wakes: bool,
    /// Longest displacement of a wake node in a step; left out: no limit.
    ///
    /// Change it as a last resort against wakes that blow up: it is counted and reported.
    #[schemars(extend("exclusiveMinimum" = 0, "with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_displacement_m: Option<f64>,
    /// Wake nodes keep this distance from surfaces and do not pass through them, which is
    /// counted and reported; 0 lets them pass (the published benchmark's).
    ///
    /// Change it with the cores: a little more than the radius of those in the wake.
    #[schemars(range(min = 0), extend("with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_m: Option<f64>,
    /// The distance of `clearance_m` in mean chords of all wings. Default: 0.1, if `clearance_m` is left out.
    ///
    /// Change it with the cores: a little more than the radius of those in the wake.
    #[schemars(range(min = 0), extend("with" = [LATTICE, SHEDDING], "or" = "clearance_m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_chords: Option<f64>,
    /// Vortex particles in place of old or leading-edge rows of wake; left out: rings only.
    ///
    /// Change it where sheets tangle so that rings lose their meaning.
    #[schemars(extend("with" = [LATTICE, SHEDDING]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub particles: Option<ParticlesCase>,
    /// Friction and profile drag of the wings' sections, added to the forces of the lattice, which itself has no
    /// viscosity. Default: friction in air of the viscosity of `wake_core`, or `viscosity_m2_s`; none where neither is.
    ///
    /// Change it to `{ friction = "none" }` for inviscid air, or to add what the sections' polar has.
    #[schemars(extend("with" = LATTICE))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section_drag: Option<SectionDragCase>,
    /// How the velocities of the wakes are summed.
    ///
    /// Change it to `direct` to see what the approximations change: less than `summation_tolerance`. `mesh`
    /// asks for algebraic cores and a `summation_tolerance` of 1e-3 or more.
    #[default(Method::Auto)]
    #[schemars(extend("with" = LATTICE))]
    pub summation: Method,
    /// Allowed error of meshes, tree and single precision, relative to the velocity; it is checked at every sum.
    /// Below 1e-5 all is in double precision; from 1e-3 on there are meshes, and the loads of one wing are in single
    /// precision, too.
    ///
    /// Change it to 1e-3 for long hover, to less for studies of convergence.
    #[default = 1e-4]
    #[schemars(range(max = 0.1), extend("exclusiveMinimum" = 0, "with" = [LATTICE, "summation = auto | single | tree | mesh"]))]
    pub summation_tolerance: f64,
    /// Settings of the blade elements.
    #[schemars(extend("with" = "air.model = blade_element"))]
    pub blade: BladeCase,
    /// Settings of the stability derivatives.
    #[schemars(extend("with" = "air.model = derivatives"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<DerivativesCase>,
    /// The program that computes the air.
    #[schemars(extend("with" = "air.model = external"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub external: Option<ExternalCase>,
}

/// Air model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AirModel {
    /// Non-linear unsteady vortex lattice with free wakes.
    VortexLattice,
    /// Quasi-steady blade elements: fast.
    BladeElement,
    /// A table of stability derivatives acting on the body.
    Derivatives,
    /// A program of your own.
    External,
    /// No air.
    None,
}

/// Set of numerical choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SchemeCase {
    /// The published benchmark's: first order.
    Benchmark,
    /// Second order, rings at quarter panels, newest wake row matched to the lattice.
    Accurate,
}

/// Where the flow leaves leading edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LeadingEdgeCase {
    /// Nowhere.
    Never,
    /// Everywhere.
    Always,
    /// Strips whose effective angle of attack exceeds `leading_edge_threshold_deg`.
    AngleOfAttack,
    /// What is beyond the leading-edge suction parameter `leading_edge_threshold`, so that the suction stays
    /// there [Ramesh et al. 2014, J. Fluid Mech. 751:500].
    Suction,
    /// The same, found together with the circulations of the wings: the suction is not above the threshold but where a
    /// wing turns into what it has just shed (which is counted), and what is shed hangs less on panels and steps.
    SuctionImplicit,
    /// Nowhere: what is beyond the threshold acts as the normal force of a leading-edge vortex that stays
    /// [Polhamus 1966, NASA TN D-3767], until it has been fed for `leading_edge_formation_chords`. Smooth: for
    /// trim, modes and many flights.
    VortexLift,
}
