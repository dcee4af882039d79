//! All settings of the air.

use crate::edges::SheddingKinds;
use crate::images::{Mirror, Plane, ROUNDING};
use crate::settings::choices::{CirculationRate, Convection, LeadingEdge, LoadMethod, NewestRow};
use crate::settings::particles::ParticleSettings;
use crate::settings::section_drag::SectionDrag;
use crate::settings::wind::Wind;
use wingbeat_math::{DVec3, smoothstep};
use wingbeat_vortex::{CoreModel, LAMB_ALPHA, Method};

/// Kinematic viscosity of air at 20 degrees Celsius [m2/s].
pub const AIR_VISCOSITY: f64 = 1.5e-5;

/// Density of that air [kg/m3].
const AIR_DENSITY: f64 = 1.225;

/// Densities from here on are those of liquids; the densest gases have a tenth of it [kg/m3].
pub const LIQUID_DENSITY: f64 = 100.0;

/// Kinematic viscosity [m2/s] of a fluid of this density [kg/m3] of which no more is known: of a gas that with the
/// dynamic viscosity of air, 1.84e-5 Pa s, which hardly depends on pressure (at -50 degrees Celsius it is 20 % less,
/// that of helium and heliox 7 % more); of a liquid that of air, which is wrong.
///
/// ```
/// use wingbeat_air::viscosity_of_density;
/// assert_eq!(viscosity_of_density(1.225), 1.5e-5);
/// assert!((viscosity_of_density(0.41) - 4.48e-5).abs() < 1e-7);
/// ```
pub fn viscosity_of_density(density: f64) -> f64 {
    match density < LIQUID_DENSITY {
        true => AIR_VISCOSITY * (AIR_DENSITY / density),
        false => AIR_VISCOSITY,
    }
}

/// [`AirSettings::overlap_slope`] of wakes that roll up near flapping wings.
pub const OVERLAP_SLOPE: f64 = 0.25;

/// Settings of the air. [`AirSettings::benchmark`] is the discretisation of the published
/// benchmark, everything else is stated against it.
#[derive(Clone, Debug, PartialEq)]
pub struct AirSettings {
    /// Density rho [kg/m3].
    pub density: f64,
    /// Velocity of the undisturbed air [m/s], N components.
    pub free_stream: DVec3,
    /// Core of the filaments of the surfaces, the shedding edges among them.
    pub bound_core: CoreModel,
    /// Core of the filaments of the wakes.
    pub wake_core: CoreModel,
    /// Least core radius of a free wake filament over its length; 0: as `wake_core` says. Wakes are
    /// resolved only while the cores of neighbours overlap. Without this a filament that the flow
    /// stretches far beyond its core has strains no mesh follows: they stretch it on, and the wake
    /// around a hovering animal gains energy until it blows up. With 1 no filament moves air on
    /// scales smaller than its own length. Far off it changes nothing, nor any circulation or
    /// impulse. Algebraic cores are no wider for it than [`Self::overlap_slope`] allows.
    pub wake_overlap: f64,
    /// Radius of an algebraic core over the way along the sheet from its edge, at most, for the overlap's sake.
    ///
    /// Cores as wide as filaments are long blunt what a sheet does to anything nearer than that. Without this limit
    /// a row loses its effect on the panels at its edge the moment it leaves it, later if steps are longer: the
    /// lift of a hovering fly went up by a seventh from 40 to 160 steps a beat, and by a seventh with half the
    /// overlap. With a quarter the velocity of a sheet is right to 3 parts in a hundred at any distance, and where
    /// filaments stretch, a chord or two from the edge, cores are as wide as they are long.
    pub overlap_slope: f64,
    /// Length [m] from which a free wake filament turns into a vortex blob, wholly at 1.25 times this length:
    /// its strength Gamma (b - a) as a Gaussian about its middle, as wide as its core; none: never. Where
    /// `wake_overlap` has made cores as wide as filaments are long, hardly more than the description changes,
    /// but blobs can be summed at a cost that grows with their number and not with its square
    /// ([`wingbeat_vortex::GaussianSum`]).
    pub wake_blob_length: Option<f64>,
    /// Which edges shed.
    pub shedding: SheddingKinds,
    /// Circulation rate in the loads.
    pub rate: CirculationRate,
    /// Rows of rings kept in each wake sheet; none keeps all. The oldest row is dropped ring by
    /// ring, so what is left is closed; its far influence is lost.
    pub max_rows: Option<usize>,
    /// Rows older than this [s] are dropped, as above.
    pub max_age: Option<f64>,
    /// Rows farther from their edge than this [m] with all nodes are dropped, as above, with all
    /// older ones.
    pub max_distance: Option<f64>,
    /// Largest displacement of a wake node in a step, relative to the undisturbed air [m]; longer
    /// ones are shortened and counted.
    pub max_displacement: Option<f64>,
    /// Free wake nodes keep this distance [m] from surfaces and do not pass through them; the
    /// core radius is the natural choice. 0 lets them pass (the published benchmark).
    pub clearance: f64,
    /// Whether the flow is plane: all nodes of a row of wake move alike, with the air in the middle of the row, and
    /// what closes the rings of lattice and wakes at the ends of the section moves no air. Where long straight
    /// filaments end in nodes that move each by itself, these part within beats; and with a circulation G of all
    /// rings that leading edges feed, ends L apart would move the air by G / (pi L), which grows with every beat. What
    /// is left of the ends is of the order of the square of the chord over the span.
    pub plane_wakes: bool,
    /// Convection of the wakes.
    pub convection: Convection,
    /// Circulation of the newest row of a wake.
    pub newest_row: NewestRow,
    /// Forces of open surfaces; those of closed ones are pressures always.
    pub loads: LoadMethod,
    /// Separation from leading edges.
    pub leading: LeadingEdge,
    /// Drag of the wings' sections added to the forces; none is the method's own.
    pub section_drag: Option<SectionDrag>,
    /// Part of its panel by which a ring stays inside a side edge that does not shed; a quarter
    /// makes the loads of coarse lattices good to second order, 0 is the published benchmark's.
    /// Where trailing edges shed and leading edges do not, or hold their suction in the solution
    /// ([`LeadingEdge::SuctionImplicit`]), all rings lie aft by the same part.
    pub inset: f64,
    /// What is added to the free stream.
    pub wind: Wind,
    /// Planes of symmetry and ground: none, one, or two at right angles.
    pub images: Vec<Plane>,
    /// Vortex particles in place of old or leading-edge rows of wake; none: rings only.
    pub particles: Option<ParticleSettings>,
    /// How the velocities of the wakes' rings are summed.
    pub summation: Method,
    /// Allowed error of meshes, tree and single precision: root mean square over the places where velocities
    /// are wanted, relative to that of the velocity.
    pub tolerance: f64,
}

impl AirSettings {
    /// The discretisation of the published benchmark for a given density [kg/m3] and free
    /// stream [m/s]: wakes from trailing edges, backward circulation rate and the cut-off 0.01 of
    /// its panels of unit length; see [`Self::with_cut_off_for`] for panels of any other.
    pub fn benchmark(density: f64, free_stream: DVec3) -> Self {
        let core = CoreModel::CutOff { delta: 0.01 };
        Self {
            density,
            free_stream,
            bound_core: core,
            wake_core: core,
            wake_overlap: 0.0,
            overlap_slope: OVERLAP_SLOPE,
            wake_blob_length: None,
            shedding: SheddingKinds::TRAILING,
            rate: CirculationRate::Backward,
            max_rows: None,
            max_displacement: None,
            max_age: None,
            max_distance: None,
            clearance: 0.0,
            plane_wakes: false,
            convection: Convection::Euler,
            newest_row: NewestRow::Constant,
            loads: LoadMethod::Pressure,
            leading: LeadingEdge::Always,
            section_drag: None,
            inset: 0.0,
            wind: Wind::default(),
            images: Vec::new(),
            particles: None,
            summation: Method::Auto,
            tolerance: 1e-4,
        }
    }

    /// The accurate discretisation: as the benchmark, but circulation rate, convection and newest
    /// row of second order and side edges inset by a quarter panel.
    pub fn accurate(density: f64, free_stream: DVec3) -> Self {
        Self {
            rate: CirculationRate::BackwardSecond,
            convection: Convection::AdamsBashforth,
            newest_row: NewestRow::Matched,
            inset: 0.25,
            ..Self::benchmark(density, free_stream)
        }
    }

    /// The benchmark's cut-off for panels of the given size [m]. The benchmark adds
    /// `(0.01 length)^2` to a term of fourth power in length, so its 0.01 is a length, a hundredth
    /// of its panels' size.
    pub fn with_cut_off_for(self, panel_size: f64) -> Self {
        let core = CoreModel::CutOff {
            delta: 0.01 * panel_size,
        };
        Self {
            bound_core: core,
            wake_core: core,
            ..self
        }
    }

    /// Part of its panel by which all rings of a wing lie aft, see [`Self::inset`].
    pub(crate) fn ring_shift(&self) -> f64 {
        let leading_is_smooth = self.shedding.leading && !self.solves_suction();
        match self.shedding.trailing && !leading_is_smooth {
            true => self.inset,
            false => 0.0,
        }
    }

    /// Rows that are kept of every wake: leading edges with a criterion look at what left the step before.
    pub(crate) fn least_rows(&self) -> usize {
        let by_criterion = self.leading.sheds() && self.leading != LeadingEdge::Always;
        match self.shedding.leading && by_criterion {
            true => 2,
            false => 1,
        }
    }

    /// The first part of the undisturbed air or of the planes that this mirror does not leave as it is.
    pub(crate) fn asymmetric_part(&self, mirror: &Mirror) -> Option<&'static str> {
        let stream = self.free_stream;
        if mirror.vector(stream).distance(stream) > ROUNDING * stream.length() {
            return Some("the stream");
        }
        let image = |p: &Plane| Plane {
            point: mirror.point(p.point),
            normal: mirror.vector(p.normal),
        };
        let has_image = |p: &Plane| self.images.iter().any(|q| q.is(&image(p)));
        match self.images.iter().all(has_image) {
            true => self.wind.asymmetric_part(mirror),
            false => Some("the ground, or a plane of symmetry,"),
        }
    }

    /// Part of a panel by which rings that begin at the leading edge stand for the wing behind them where that
    /// edge holds all.
    pub(crate) fn held_shift(&self) -> f64 {
        let may_hold = self.shedding.leading && self.leading != LeadingEdge::Always;
        match self.shedding.trailing && may_hold && !self.solves_suction() {
            true => self.inset,
            false => 0.0,
        }
    }

    /// Whether leading edges shed by what decides there.
    pub fn leading_edges_shed(&self) -> bool {
        self.shedding.leading && self.leading.sheds()
    }

    /// Whether the flow may leave leading edges: they shed, or have vortex lift.
    pub fn flow_may_leave_leading_edges(&self) -> bool {
        self.leading_edges_shed() || matches!(self.leading, LeadingEdge::VortexLift(_))
    }

    /// Part of the friction of an attached plate at this incidence [rad], 0 to pi/2, that its strips feel: the
    /// face that the flow leaves at the leading edge has as much of its own as the edge holds of the suction
    /// \[1\].
    pub(crate) fn friction_felt(&self, incidence: f64) -> f64 {
        match self.flow_may_leave_leading_edges() {
            true => 0.5 * (1.0 + self.leading.holds(incidence)),
            false => 1.0,
        }
    }

    /// Whether what leaves leading edges is part of the solution for the circulations.
    pub fn solves_suction(&self) -> bool {
        self.shedding.leading && matches!(self.leading, LeadingEdge::SuctionImplicit { .. })
    }

    /// Whether filaments act on each other as the others act on them, see [`CoreModel::Algebraic`].
    pub fn is_symmetric(&self) -> bool {
        matches!(self.wake_core, CoreModel::Algebraic { .. })
    }

    /// Regularisation number of a filament of the free wake of this length [m] and age [s].
    pub(crate) fn free_core(&self, length: f64, age: f64) -> f64 {
        let core = self.wake_core.core(length, age);
        match self.wake_core {
            CoreModel::CutOff { .. } => core,
            _ => core.max((self.wake_overlap * length).powi(2)),
        }
    }

    /// The part of a free wake filament of this length [m] that is a blob: rises smoothly from 0 to 1.
    pub(crate) fn blob_part(&self, length: f64) -> f64 {
        self.wake_blob_length
            .map_or(0.0, |from| smoothstep((length / from - 1.0) / 0.25))
    }

    /// Variance [m2] of the Gaussian that a Lamb-Oseen core of this squared radius [m2] has across its filament.
    pub(crate) fn blob_variance(&self, core: f64) -> f64 {
        core / (2.0 * LAMB_ALPHA)
    }

    /// The smallest variance [m2] that a blob can have.
    pub(crate) fn min_variance(&self) -> f64 {
        let length = self.wake_blob_length.unwrap_or(1.0);
        self.blob_variance((self.wake_overlap * length).powi(2))
    }
}
