//! Choices of the air model.

use crate::error::AirError;
use crate::kernel::CoreModel;
use crate::surface::EdgeKind;
use wingbeat_math::DVec3;

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
    /// Which edges shed.
    pub shedding: SheddingKinds,
    /// Circulation rate in the loads.
    pub rate: CirculationRate,
    /// Rows of rings kept in each wake sheet; none keeps all. The oldest row is dropped ring by
    /// ring, so what is left is closed; its far influence is lost.
    pub max_rows: Option<usize>,
    /// Longest way a wake node may go in a step, relative to the undisturbed air [m]; longer
    /// ones are shortened and counted.
    pub max_displacement: Option<f64>,
    /// Free wake nodes keep this distance [m] from surfaces and do not pass through them; the
    /// core radius is the natural choice. 0 lets them pass (the published benchmark).
    pub clearance: f64,
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
            shedding: SheddingKinds::TRAILING,
            rate: CirculationRate::Backward,
            max_rows: None,
            max_displacement: None,
            clearance: 0.0,
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
        check(
            self.max_rows != Some(0),
            "max_rows",
            "0".to_owned(),
            "at least 1 row, or none to keep all; without any shed row there is no Kutta condition",
        )
    }
}
