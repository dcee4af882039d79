//! All elastic wings of an animal.

use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_math::DVec3;
use wingbeat_model::Animal;

use super::step::{FINE_TOLERANCE, TOLERANCE};
use super::wing::{ElasticState, ElasticWing};
use crate::error::FlightError;
use crate::interface::Shape;

/// All wings of an animal that loads bend.
#[derive(Debug, Default)]
pub struct ElasticWings {
    pub(super) wings: Vec<ElasticWing>,
    /// Number of wings, elastic or not.
    count: usize,
    pub(super) gravity: DVec3,
    /// Forces that are left unbalanced over those at the nodes \[1\].
    pub(super) tolerance: f64,
}

impl ElasticWings {
    /// Those of `animal` under `gravity` \[m/s2\], N components.
    ///
    /// # Errors
    /// What the elastic bodies refuse.
    pub fn new(animal: &Animal, gravity: DVec3) -> Result<Self, FlightError> {
        let elastic = |(i, w)| ElasticWing::new(i, w).transpose();
        let wings = animal.wings.iter().enumerate().filter_map(elastic);
        Ok(Self {
            wings: wings.collect::<Result<_, _>>()?,
            count: animal.wings.len(),
            gravity,
            tolerance: TOLERANCE,
        })
    }

    /// The same of an animal whose wings hang on free joints, or that is light as a whole.
    pub fn on_light_bodies(self) -> Self {
        Self {
            tolerance: FINE_TOLERANCE,
            ..self
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.wings.is_empty()
    }

    /// The wings.
    pub fn wings(&self) -> &[ElasticWing] {
        &self.wings
    }

    /// The wings at rest.
    pub fn initial(&self) -> Vec<ElasticState> {
        self.wings.iter().map(ElasticWing::initial).collect()
    }

    /// Room for the shapes of all wings.
    pub(super) fn shapes(&self) -> Vec<Option<Shape>> {
        let mut shapes = vec![None; self.count];
        for w in &self.wings {
            shapes[w.wing] = Some(Shape::default());
        }
        shapes
    }
}

/// What a frame does, as the elastic body on it feels it.
pub(super) fn frame_motion(
    m: &BodyMotion,
    a: &BodyAcceleration,
    gravity: DVec3,
) -> wingbeat_structure::FrameMotion {
    wingbeat_structure::FrameMotion::from_inertial(m.r, [a.linear, gravity], [m.w, a.angular])
}

/// A wrench in wing components as one in N components.
pub(super) fn turned(m: &BodyMotion, [force, moment]: [DVec3; 2]) -> Wrench {
    Wrench {
        force: m.r * force,
        moment: m.r * moment,
    }
}
