//! How the singularity of a vortex filament is regularised.

use std::f64::consts::LOG2_E;

/// Lamb-Oseen constant: the swirl is largest at r_c when 2 alpha = exp(alpha) - 1
/// [Lamb 1932, sec. 334a].
pub const LAMB_ALPHA: f64 = 1.256_431_208_626_169_7;

/// Regularisation of the filament; with h the distance from the line and r_c the core radius, the
/// velocity of the bare filament is multiplied by the factor given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CoreModel {
    /// Cut-off [van Garrel 2003, ECN-C-03-079, eq. 3.2]:
    /// v = Gamma/(4 pi) (r1 x r2)(n1 + n2) / (n1 n2 (n1 n2 + r1.r2) + (delta r0)^2), n = abs(r).
    ///
    /// As published the added term is m^2 beside m^4, so `delta` is a **length** \[m\]: the cut-off
    /// that is 0.01 on a lattice of unit panels is 0.01 times the panel length on any other.
    CutOff {
        /// Cut-off \[m\].
        delta: f64,
    },
    /// Vatistas with n = 2: h^2 / sqrt(h^4 + r_c^4) [Vatistas, Kozel, Mih 1991].
    Vatistas {
        /// Core radius \[m\].
        radius: f64,
    },
    /// Scully: h^2 / (h^2 + r_c^2), Vatistas with n = 1 [Scully 1975].
    Scully {
        /// Core radius \[m\].
        radius: f64,
    },
    /// Lamb-Oseen: 1 - exp(-alpha h^2 / r_c^2), r_c^2 = radius^2 + 4 alpha viscosity age.
    LambOseen {
        /// Core radius at age zero \[m\].
        radius: f64,
        /// Effective (eddy included) kinematic viscosity \[m^2/s\].
        viscosity: f64,
    },
    /// Algebraic: vorticity of the filament and of what is there spread alike, so that what a filament does
    /// to another one is what the other one does to it, reversed. The bare kernel `r / abs(r)^3` becomes
    /// `r / (r^2 + sigma^2)^(3/2)` with `sigma^2` the mean of the squared core radii here and there
    /// [Rosenhead 1930, Proc. R. Soc. A 127:590; Moore 1972, Aeronaut. Q. 23:307]. Core radii belong to nodes and are
    /// squared and linear in between; those of places where velocities are wanted to [`crate::Points::core`].
    Algebraic {
        /// Core radius at age zero \[m\].
        radius: f64,
        /// Effective (eddy included) kinematic viscosity \[m^2/s\]; cores spread as with Lamb-Oseen.
        viscosity: f64,
    },
}

impl CoreModel {
    /// The name that case files have for its kind.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::CutOff { .. } => "cut_off",
            Self::Vatistas { .. } => "vatistas",
            Self::Scully { .. } => "scully",
            Self::LambOseen { .. } => "lamb_oseen",
            Self::Algebraic { .. } => "algebraic",
        }
    }

    /// Radius \[m\] that the core is given; a cut-off has none.
    pub const fn radius(&self) -> Option<f64> {
        match *self {
            Self::CutOff { .. } => None,
            Self::Vatistas { radius }
            | Self::Scully { radius }
            | Self::LambOseen { radius, .. }
            | Self::Algebraic { radius, .. } => Some(radius),
        }
    }

    /// Viscosity \[m^2/s\] by which the core spreads; none where it stays as it is.
    ///
    /// ```
    /// use wingbeat_vortex::CoreModel;
    /// let core = |viscosity| CoreModel::Algebraic { radius: 1e-4, viscosity };
    /// assert_eq!(core(1.5e-5).viscosity(), Some(1.5e-5));
    /// assert_eq!(core(0.0).viscosity(), None);
    /// ```
    pub fn viscosity(&self) -> Option<f64> {
        match *self {
            Self::LambOseen { viscosity, .. } | Self::Algebraic { viscosity, .. } => {
                Some(viscosity).filter(|v| *v > 0.0)
            }
            Self::CutOff { .. } | Self::Vatistas { .. } | Self::Scully { .. } => None,
        }
    }

    /// Whether its numbers are finite and none is below 0.
    pub fn is_sound(&self) -> bool {
        let sound = |x: f64| x.is_finite() && x >= 0.0;
        match *self {
            Self::CutOff { delta } => sound(delta),
            Self::Vatistas { radius } | Self::Scully { radius } => sound(radius),
            Self::LambOseen { radius, viscosity } | Self::Algebraic { radius, viscosity } => {
                sound(radius) && sound(viscosity)
            }
        }
    }

    /// Regularisation number of a segment of this `length` \[m\] and `age` \[s\]:
    /// (delta length)^2 for the cut-off, r_c^2 \[m^2\] for the others; only Lamb-Oseen and algebraic cores age.
    ///
    /// ```
    /// use wingbeat_vortex::CoreModel;
    /// assert_eq!(CoreModel::CutOff { delta: 0.5 }.core(3.0, 0.0), 2.25);
    /// assert_eq!(CoreModel::Scully { radius: 0.5 }.core(3.0, 0.0), 0.25);
    /// ```
    pub fn core(&self, length: f64, age: f64) -> f64 {
        match *self {
            Self::CutOff { delta } => (delta * length).powi(2),
            Self::Vatistas { radius } | Self::Scully { radius } => radius * radius,
            Self::LambOseen { radius, viscosity } | Self::Algebraic { radius, viscosity } => {
                radius * radius + 4.0 * LAMB_ALPHA * viscosity * age
            }
        }
    }

    /// What is added to the squared distance from a node with this squared core radius \[m^2\].
    pub(crate) fn softening(&self, core: f64) -> f64 {
        match self {
            Self::Algebraic { .. } => 0.5 * core,
            _ => 0.0,
        }
    }

    /// What the kernel loop wants of `core`, with the squared length l2 \[m^2\].
    ///
    /// The cut-off adds it twice to a denominator that is twice the published one. The others compare h^2 with
    /// r_c^2, which is (r1 x r2)^2 with r_c^2 l2; Vatistas wants its square, Lamb-Oseen alpha / (r_c^2 l2)
    /// for a power of two.
    pub(crate) fn kernel_term(&self, core: f64, l2: f64) -> f64 {
        match self {
            Self::CutOff { .. } => 2.0 * core,
            Self::Vatistas { .. } => (core * l2).powi(2),
            Self::Scully { .. } => core * l2,
            Self::Algebraic { .. } => 0.0,
            Self::LambOseen { .. } => LAMB_ALPHA * LOG2_E / (core * l2).max(f64::MIN_POSITIVE),
        }
    }
}
