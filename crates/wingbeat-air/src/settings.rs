//! Choices of the air model.

use crate::error::AirError;
use crate::images::{Plane, mirrors};
use crate::particles::ParticleSettings;
use crate::section_drag::SectionDrag;
use crate::surface::EdgeKind;
use crate::wind::Wind;
use wingbeat_math::DVec3;
use wingbeat_vortex::{CoreModel, LAMB_ALPHA, Method};

/// How the rate of change of circulation in the unsteady Bernoulli equation is formed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CirculationRate {
    /// Backward difference over the step, first order, the published benchmark's.
    #[default]
    Backward,
    /// Backward difference over two steps (of any lengths), second order; the first step that
    /// has a predecessor falls back to [`Self::Backward`].
    BackwardSecond,
    /// Left out: quasi-steady loads.
    Omitted,
}

/// How wake nodes are moved with the velocities of the accepted step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Convection {
    /// With the velocity of the step: explicit Euler, first order, the published benchmark's.
    #[default]
    Euler,
    /// With the velocity extrapolated to the middle of the step from those of this step and the
    /// one before (Adams-Bashforth, steps of any lengths): second order. A node that has just left
    /// its edge has no past and takes one Euler step.
    AdamsBashforth,
}

/// How circulation is spread over the newest row of a wake, next to its edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NewestRow {
    /// One value, that of the panel when the row's far side left: first order, the published
    /// benchmark's.
    #[default]
    Constant,
    /// As the lattice continued into the wake would have it: second order. In rows of up to eight
    /// panel lengths the circulation falls from the panel's present one to its past one in steps of
    /// a panel length; rows shorter than a panel leave with a delay.
    Matched,
}

/// How forces follow from circulations. The methods differ in what they do with the suction at
/// attached leading edges: never mix them in one comparison.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LoadMethod {
    /// Unsteady Bernoulli, pressure jump times normal: no suction (the published benchmark's).
    #[default]
    Pressure,
    /// Joukowski's force on every segment and `rho A dGamma/dt` along the normal: with suction at
    /// the edges that do not shed.
    Joukowski,
    /// Pressure, and the suction of the leading edge of each strip turned into a normal force on
    /// its leading panel: Polhamus's analogy for an attached leading-edge vortex
    /// [Polhamus 1966, NASA TN D-3767].
    Polhamus,
}

/// Where and when the flow leaves leading edges, judged strip by strip at every step. Needs
/// [`SheddingKinds::leading`]; see [`crate::strips`] for the two numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LeadingEdge {
    /// Nowhere.
    Never,
    /// Everywhere.
    #[default]
    Always,
    /// Where the effective angle of attack [rad] exceeds the threshold.
    AngleOfAttack {
        /// Threshold [rad], 0 to pi.
        threshold: f64,
    },
    /// Where the leading-edge suction parameter exceeds the threshold.
    Suction {
        /// Threshold, above 0.
        threshold: f64,
    },
}

/// Which kinds of edges shed wakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheddingKinds {
    /// Trailing edges shed.
    pub trailing: bool,
    /// Tips shed.
    pub tip: bool,
    /// Leading edges shed.
    pub leading: bool,
    /// Roots shed.
    pub root: bool,
}

impl SheddingKinds {
    /// Only the trailing edge, the published benchmark's.
    pub const TRAILING: Self = Self {
        trailing: true,
        tip: false,
        leading: false,
        root: false,
    };

    /// Whether this kind sheds.
    pub fn sheds(&self, kind: EdgeKind) -> bool {
        match kind {
            EdgeKind::Trailing => self.trailing,
            EdgeKind::Tip => self.tip,
            EdgeKind::Leading => self.leading,
            EdgeKind::Root => self.root,
        }
    }
}

/// Settings of the air. [`AirSettings::benchmark`] is the discretisation of the published
/// benchmark, everything else is stated against it.
#[derive(Clone, Debug, PartialEq)]
pub struct AirSettings {
    /// Density rho [kg/m3].
    pub density: f64,
    /// Velocity of the undisturbed air [m/s], N.
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
    /// impulse.
    pub wake_overlap: f64,
    /// Length [m] from which a free wake filament turns into a vortex blob, wholly at 1.25 times this length: its strength
    /// Gamma (b - a) as a Gaussian about its middle, as wide as its core; none: never. Where `wake_overlap` has made
    /// cores as wide as filaments are long, hardly more than the description changes, but blobs can be summed at
    /// a cost that grows with their number and not with its square ([`wingbeat_vortex::BlobSum`]).
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
    /// Rows farther from the middle of their edge than this [m] with all nodes are dropped, as
    /// above, with all older ones.
    pub max_distance: Option<f64>,
    /// Longest way a wake node may go in a step, relative to the undisturbed air [m]; longer
    /// ones are shortened and counted.
    pub max_displacement: Option<f64>,
    /// Free wake nodes keep this distance [m] from surfaces and do not pass through them; the
    /// core radius is the natural choice. 0 lets them pass (the published benchmark).
    pub clearance: f64,
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
    /// Where trailing edges shed and leading edges do not, all rings lie aft by the same part.
    pub inset: f64,
    /// What is added to the free stream.
    pub wind: Wind,
    /// Planes of symmetry and ground: none, one, or two at right angles.
    pub images: Vec<Plane>,
    /// Vortex particles in place of old or leading-edge rows of wake; none: rings only.
    pub particles: Option<ParticleSettings>,
    /// How the velocities of the wakes' rings are summed.
    pub summation: Method,
    /// Allowed error of tree and single precision: root mean square over the places where velocities are wanted,
    /// relative to that of the velocity.
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
            wake_blob_length: None,
            shedding: SheddingKinds::TRAILING,
            rate: CirculationRate::Backward,
            max_rows: None,
            max_displacement: None,
            max_age: None,
            max_distance: None,
            clearance: 0.0,
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
        self.wake_blob_length.map_or(0.0, |from| {
            let t = ((length / from - 1.0) / 0.25).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        })
    }

    /// Variance [m2] of the Gaussian that a Lamb-Oseen core of this squared radius [m2] has across its filament.
    pub(crate) fn blob_variance(&self, core: f64) -> f64 {
        core / (2.0 * LAMB_ALPHA)
    }

    /// The least variance [m2] that a blob can have.
    pub(crate) fn least_variance(&self) -> f64 {
        let length = self.wake_blob_length.unwrap_or(1.0);
        self.blob_variance((self.wake_overlap * length).powi(2))
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`AirError::Setting`] names the first one that makes no sense.
    pub fn validate(&self) -> Result<(), AirError> {
        let check = |ok: bool, key, value: String, allowed| match ok {
            true => Ok(()),
            false => Err(AirError::Setting {
                key,
                value,
                allowed,
            }),
        };
        let positive = |x: f64| x.is_finite() && x > 0.0;
        check(
            positive(self.density),
            "density",
            self.density.to_string(),
            "a finite number of kg/m3 above 0",
        )?;
        check(
            self.free_stream.is_finite(),
            "free_stream",
            self.free_stream.to_string(),
            "three finite numbers in m/s",
        )?;
        let has_radius = !matches!(self.wake_core, CoreModel::CutOff { .. });
        check(
            self.wake_overlap == 0.0
                || self.wake_overlap > 0.0 && self.wake_overlap.is_finite() && has_radius,
            "wake_overlap",
            self.wake_overlap.to_string(),
            "a finite number from 0; above 0 only if wake_core has a radius, which a cut-off has not",
        )?;
        check(
            self.wake_blob_length
                .is_none_or(|l| positive(l) && self.wake_overlap >= 0.5),
            "wake_blob_length",
            format!("{:?}", self.wake_blob_length),
            "a finite length in m above 0, with wake_overlap 0.5 or more: blobs narrower than their filaments are \
             long leave gaps; or none",
        )?;
        check(
            self.max_displacement.is_none_or(positive),
            "max_displacement",
            format!("{:?}", self.max_displacement),
            "a finite length in m above 0, or none for no limit",
        )?;
        check(
            self.clearance.is_finite() && self.clearance >= 0.0,
            "clearance",
            self.clearance.to_string(),
            "a finite height in m, 0 to count nothing",
        )?;
        for (key, value) in [
            ("max_age", self.max_age),
            ("max_distance", self.max_distance),
        ] {
            let allowed = "a finite number above 0, or none for no limit";
            check(
                value.is_none_or(positive),
                key,
                format!("{value:?}"),
                allowed,
            )?;
        }
        check(
            (0.0..0.5).contains(&self.inset),
            "inset",
            self.inset.to_string(),
            "a part of a panel from 0 to below 1/2",
        )?;
        check(
            positive(self.tolerance) && self.tolerance <= 0.1,
            "summation tolerance",
            self.tolerance.to_string(),
            "a number above 0 and up to 0.1",
        )?;
        self.check_leading()?;
        self.particles.map_or(Ok(()), |p| p.validate(self))?;
        self.section_drag.map_or(Ok(()), |d| d.validate())?;
        self.wind.validate()?;
        mirrors(&self.images)?;
        let through = |p: &&Plane| {
            let across = self.free_stream.dot(p.normal.normalize()).abs();
            across > 1e-12 * self.free_stream.length()
        };
        if let Some(plane) = self.images.iter().find(through) {
            return Err(AirError::Setting {
                key: "images",
                value: format!("{plane:?}"),
                allowed: "planes along the free stream: no air goes through them",
            });
        }
        check(
            self.max_rows != Some(0),
            "max_rows",
            "0".to_owned(),
            "at least 1 row, or none to keep all; without any shed row there is no Kutta condition",
        )
    }

    fn check_leading(&self) -> Result<(), AirError> {
        let (key, value, ok, allowed) = match self.leading {
            LeadingEdge::AngleOfAttack { threshold: a } => (
                "leading angle-of-attack threshold",
                a,
                (0.0..=std::f64::consts::PI).contains(&a),
                "an angle in rad from 0 to pi",
            ),
            LeadingEdge::Suction { threshold: a } => (
                "leading suction threshold",
                a,
                a.is_finite() && a > 0.0,
                "a finite number above 0",
            ),
            LeadingEdge::Never | LeadingEdge::Always => return Ok(()),
        };
        let value = value.to_string();
        match ok {
            true => Ok(()),
            false => Err(AirError::Setting {
                key,
                value,
                allowed,
            }),
        }
    }
}
