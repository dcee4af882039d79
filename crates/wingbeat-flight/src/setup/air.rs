//! The air of a flight and its model.

use std::sync::Arc;

use wingbeat_air::{
    AirSettings, CoreModel, Friction, LIQUID_DENSITY, LeadingEdge, LoadMethod, SheddingKinds, Wind,
    viscosity_of_density,
};
use wingbeat_blade::{BladeSettings, BodyDrag, DerivativeTable, Rotation, Unsteady};
use wingbeat_math::DVec3;

use crate::interface::memory::AirMemory;
use crate::interface::{Air, ExternalAir};

/// The air and its model: from none to the unsteady lattice.
#[derive(Clone, Debug, Default)]
pub enum AirModel {
    /// Vacuum.
    #[default]
    None,
    /// Quasi-steady blade elements: no memory, fast.
    BladeElement(BladeOptions),
    /// Non-linear unsteady vortex lattice with free wakes.
    VortexLattice(AirOptions),
    /// Stability derivatives of the whole animal, acting on the root body: linear.
    Derivatives(DerivativeTable),
    /// Loads computed by someone else.
    External(Arc<dyn ExternalAir>),
    /// A model of your own.
    Own(Arc<dyn Air>),
}

impl AirModel {
    /// The vortex lattice; none of another model.
    pub fn lattice(&self) -> Option<&AirOptions> {
        match self {
            Self::VortexLattice(options) => Some(options),
            _ => None,
        }
    }

    /// What it is called.
    pub fn name(&self) -> &'static str {
        match self {
            Self::None => "no air",
            Self::BladeElement(_) => "blade elements",
            Self::VortexLattice(_) => "vortex lattice",
            Self::Derivatives(_) => "stability derivatives",
            Self::External(_) => "external program",
            Self::Own(_) => "a model of its own",
        }
    }

    /// The value of the key `air.model` of a case, for messages; of a model that has none what it is called.
    pub fn key_value(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::BladeElement(_) => "blade_element",
            Self::VortexLattice(_) => "vortex_lattice",
            Self::Derivatives(_) => "derivatives",
            Self::External(_) => "external",
            Self::Own(_) => self.name(),
        }
    }

    /// Whether there is air.
    pub fn is_some(&self) -> bool {
        !matches!(self, Self::None)
    }

    /// Whether its forces jump where the air along a chord reverses.
    pub(crate) fn jumps(&self) -> bool {
        match self {
            Self::BladeElement(options) => options.blade.rotation == Rotation::SaneDickinson,
            _ => false,
        }
    }

    /// Velocity of the undisturbed air, N components [m/s]; none where the model has no stream.
    pub fn stream(&self) -> Option<DVec3> {
        match self {
            Self::BladeElement(options) => Some(options.blade.free_stream),
            Self::VortexLattice(options) => Some(options.lattice.free_stream),
            Self::Derivatives(table) => Some(table.stream),
            Self::None | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Density of the air [kg/m3]; none where the model does not tell it.
    pub fn density(&self) -> Option<f64> {
        match self {
            Self::BladeElement(options) => Some(options.blade.density),
            Self::VortexLattice(options) => Some(options.lattice.density),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Kinematic viscosity of the air [m2/s]: that of the friction, of wakes that spread, of blade elements where it is given,
    /// or of a gas of this density; none of other air, and of liquids of which it is not known.
    pub fn viscosity(&self) -> Option<f64> {
        let of_lattice = |lattice: &AirSettings| {
            let friction = lattice.section_drag.as_ref().map(|d| &d.friction);
            match friction {
                Some(Friction::Blasius { viscosity }) => Some(*viscosity),
                _ => lattice.wake_core.viscosity(),
            }
        };
        let known = match self {
            Self::VortexLattice(options) => of_lattice(&options.lattice),
            Self::BladeElement(options) => options.viscosity,
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        };
        let gas = |rho: &f64| (f64::MIN_POSITIVE..LIQUID_DENSITY).contains(rho);
        known.or_else(|| self.density().filter(gas).map(viscosity_of_density))
    }

    /// Its stream, to be changed; none of stability derivatives, either.
    pub fn stream_mut(&mut self) -> Option<&mut DVec3> {
        match self {
            Self::BladeElement(options) => Some(&mut options.blade.free_stream),
            Self::VortexLattice(options) => Some(&mut options.lattice.free_stream),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Whether all of its memory is in the state of a flight, whose `memory` this is, so that the flight can go on from
    /// there: that of a program is not, nor that of a model of your own which keeps it to itself.
    pub fn is_saved(&self, memory: Option<&AirMemory>) -> bool {
        match self {
            Self::External(_) => false,
            Self::Own(air) => memory.is_some() || !air.has_memory(),
            _ => true,
        }
    }

    /// Whether half of the air stands for the whole.
    pub fn is_mirrored(&self) -> bool {
        matches!(self, Self::VortexLattice(options) if options.mirror)
    }

    /// Shear and gusts that are added to the stream; none where the model has no wind.
    pub fn wind(&self) -> Option<&Wind> {
        match self {
            Self::BladeElement(options) => Some(&options.wind),
            Self::VortexLattice(options) => Some(&options.lattice.wind),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn wind_mut(&mut self) -> Option<&mut Wind> {
        match self {
            Self::BladeElement(options) => Some(&mut options.wind),
            Self::VortexLattice(options) => Some(&mut options.lattice.wind),
            Self::None | Self::Derivatives(_) | Self::External(_) | Self::Own(_) => None,
        }
    }

    /// Whether the loads depend on the past.
    pub fn has_memory(&self) -> bool {
        self.has_strip_wakes() || self.keeps_wake()
    }

    /// Whether what is remembered is moved on once a step and known at the ends of steps alone, as a wake in space is.
    pub fn keeps_wake(&self) -> bool {
        match self {
            Self::VortexLattice(_) | Self::External(_) => true,
            Self::None | Self::BladeElement(_) | Self::Derivatives(_) => false,
            Self::Own(air) => air.has_memory(),
        }
    }

    /// Whether strips remember their own wakes, in a few states each.
    pub fn has_strip_wakes(&self) -> bool {
        self.strip_wakes().is_some()
    }

    /// By which theory strips remember their own wakes, if they do.
    pub fn strip_wakes(&self) -> Option<Unsteady> {
        match self {
            Self::BladeElement(options) => options.blade.unsteady,
            _ => None,
        }
    }
}

/// Blade elements and what else the air does to the animal.
#[derive(Clone, Debug, PartialEq)]
pub struct BladeOptions {
    /// Coefficients, rotation, added mass, density and stream.
    pub blade: BladeSettings,
    /// Drag of the body, at [`Animal::body_centre`] where it names no other point; none leaves the body out of the air.
    pub body_drag: Option<BodyDrag>,
    /// Induced flow at the wings, added to the stream, N components [m/s]; zero for coefficients
    /// that hold it already.
    pub induced: DVec3,
    /// Gusts and shear, added to the stream strip by strip.
    pub wind: Wind,
    /// Kinematic viscosity of the air [m2/s], for the Reynolds number of which the coefficients are judged; none:
    /// that of a gas of this density. No force depends on it.
    pub viscosity: Option<f64>,
}

impl BladeOptions {
    /// The coefficients of insects in air at rest of this density [kg/m3].
    pub fn insect(density: f64) -> Self {
        Self {
            blade: BladeSettings::insect(density),
            body_drag: None,
            induced: DVec3::ZERO,
            wind: Wind::default(),
            viscosity: None,
        }
    }
}

/// The vortex lattice and which parts of the animal it sees.
#[derive(Clone, Debug)]
pub struct AirOptions {
    /// Settings of the lattice: density, stream, vortex core, shedding, scheme.
    pub lattice: AirSettings,
    /// Whether head, thorax and abdomen are part of the lattice.
    pub body_surfaces: bool,
    /// Whether animal and motion are mirror-symmetric, so that the air is computed on one half.
    /// A motion that is not so is refused at the step where it shows.
    pub mirror: bool,
    /// Pairs of wings, by their numbers, that share the edge at their roots.
    pub joined: Vec<[usize; 2]>,
    /// Pairs of wings, by their numbers, of which the tip of the first is the root of the second, which a joint
    /// carries there.
    pub joined_tips: Vec<[usize; 2]>,
    /// Whether the viscosity was given as that of the fluid: no density makes it doubtful then.
    pub has_own_viscosity: bool,
}

impl AirOptions {
    /// What the presets of insects fly, for wings of this mean chord [m] in air at rest of this density [kg/m3]
    /// and kinematic viscosity [m2/s]: the accurate scheme, wakes from trailing edges and tips (not yet from
    /// leading edges, which would shed what they do not hold, nor from roots), forces on segments, algebraic
    /// cores: bound ones of 0.01 chords, those of wakes from 0.07 chords and never narrower than their
    /// filaments are long. The body is left out of the air.
    pub fn insect(density: f64, viscosity: f64, chord: f64) -> Self {
        let core = |chords: f64| CoreModel::Algebraic {
            radius: chords * chord,
            viscosity,
        };
        Self {
            lattice: AirSettings {
                bound_core: core(0.01),
                wake_core: core(0.07),
                wake_overlap: 1.0,
                loads: LoadMethod::Joukowski,
                shedding: SheddingKinds {
                    tip: true,
                    ..SheddingKinds::TRAILING
                },
                leading: LeadingEdge::SuctionImplicit {
                    threshold: 0.15,
                    efficiency: 0.0,
                },
                ..AirSettings::accurate(density, DVec3::ZERO)
            },
            body_surfaces: false,
            mirror: false,
            joined: vec![],
            joined_tips: vec![],
            has_own_viscosity: false,
        }
    }
}
