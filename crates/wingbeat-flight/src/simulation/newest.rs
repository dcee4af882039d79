//! What is asked of a flight at its newest step.

use wingbeat_air::{Plane, Points};
use wingbeat_dynamics::BodyMotion;
use wingbeat_math::DVec3;
use wingbeat_model::{QuadMesh, Solid};
use wingbeat_structure::{Configuration, FrameMotion, StaticSettings, equilibrium};

use super::Simulation;
use crate::air::LatticeAir;
use crate::elastic::ElasticWings;
use crate::error::FlightError;
use crate::interface::record::{Snapshot, SurfaceSnapshot};
use crate::interface::{Instant, WingResponse};
use crate::setup::AirModel;

impl Simulation {
    /// Motion of the root at the newest step.
    pub fn root(&self) -> BodyMotion {
        self.scratch.motions[0]
    }

    /// Surfaces and wakes at the newest step; empty in vacuum. Pressure jumps are not part of the
    /// saved state: after [`Self::resume`] they are not numbers until the next step.
    pub fn snapshot(&self) -> Snapshot {
        let (memory, s) = (self.state.air.as_ref(), &self.scratch.air_scratch);
        Snapshot {
            step: self.state.step,
            time: self.newest_time(),
            ..self.equations().air.snapshot(memory, s)
        }
    }

    /// Velocity of the air [m/s] at `points` [m], N, at the newest step; none where the air is no
    /// vortex lattice.
    ///
    /// # Errors
    /// What the air reports.
    pub fn air_velocity(&self, points: &Points) -> Result<Option<Points>, FlightError> {
        (self.equations().air).velocity(self.state.air.as_ref(), points)
    }

    /// Whether there is air at `points` [m], N, at the newest step: not within body parts of the lattice nor
    /// beyond the ground, where [`Self::air_velocity`] is that of vortices and images alone.
    pub fn is_in_air(&self, points: &[DVec3]) -> Vec<bool> {
        let AirModel::VortexLattice(air) = &self.setup.air else {
            return vec![true; points.len()];
        };
        let solid = |SurfaceSnapshot { nodes, quads, .. }| Solid::new(&QuadMesh { nodes, quads });
        let scratch = &self.scratch.air_scratch;
        let surfaces = self.equations().air.surfaces(scratch).into_iter();
        let parts = surfaces.skip(self.setup.animal.wings.len());
        let solids: Vec<Solid> = parts.map(solid).collect();
        let side = |plane: &Plane| (*plane, plane.side(&scratch.nodes.position));
        let sides: Vec<(Plane, f64)> = air.lattice.images.iter().map(side).collect();
        let is_in_air = |&x: &DVec3| {
            let mut sides = sides.iter();
            !solids.iter().any(|s| s.contains(x))
                && sides.all(|(plane, side)| side * plane.height(x) >= 0.0)
        };
        points.iter().map(is_in_air).collect()
    }

    /// The wings that loads bend, as [`FlightState::wings`] has their states.
    pub fn elastic_wings(&self) -> &ElasticWings {
        &self.equations().elastic
    }

    /// Shape of elastic wing number `k` of [`Self::elastic_wings`] in equilibrium under its weight alone, its frame as it
    /// is at the newest step and at rest.
    ///
    /// # Errors
    /// No equilibrium.
    pub fn bent_by_weight(&self, k: usize) -> Result<Configuration, FlightError> {
        let wing = &self.elastic_wings().wings()[k];
        let (structure, r) = (wing.structure(), self.scratch.motions[wing.wing() + 1].r);
        let zero = [DVec3::ZERO; 2];
        let frame = FrameMotion::from_inertial(r, [DVec3::ZERO, self.setup.gravity], zero);
        let (none, settings) = (
            |_: &Configuration, _: &mut [f64]| {},
            StaticSettings::default(),
        );
        let found = equilibrium(structure, structure.rest(), &frame, &none, &settings);
        Ok(found?)
    }

    /// Added mass of the air on elastic wing number `k` of [`Self::elastic_wings`] at the newest step: six
    /// numbers a node ([`crate::elastic::ElasticWing::added_mass`]). None where the air has none.
    ///
    /// # Errors
    /// A singular influence matrix.
    pub fn added_mass(&self, k: usize) -> Result<Option<Vec<f64>>, FlightError> {
        let wing = &self.elastic_wings().wings()[k];
        let at = Instant {
            time: self.newest_time(),
            step: self.setup.time.step,
            motions: &self.scratch.motions,
            accelerations: &self.scratch.solution.bodies,
            shapes: self.scratch.elastic.shapes(),
        };
        let answer = match &self.setup.air {
            AirModel::VortexLattice(options) => {
                LatticeAir::inertia(&self.setup, options, wing.wing(), &at)?
            }
            _ if self.equations().air.follows_accelerations() => {
                let (mut answer, memory) = (WingResponse::default(), self.state.air.as_ref());
                let (air, number) = (&self.equations().air, wing.wing());
                air.wing_response(number, &at, memory, &mut air.scratch(), &mut answer)?;
                answer
            }
            _ => return Ok(None),
        };
        let frame = &self.scratch.motions[wing.wing() + 1];
        let at = &self.state.wings[k].structure.configuration;
        Ok(Some(wing.added_mass(&answer, frame, at)))
    }
}
