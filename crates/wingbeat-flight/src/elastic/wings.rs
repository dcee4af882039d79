//! All elastic wings of an animal.

use wingbeat_dynamics::{BodyAcceleration, BodyMotion};
use wingbeat_math::DVec3;
use wingbeat_model::Animal;

use super::image::Image;
use super::step::{FINE_TOLERANCE, TOLERANCE};
use super::wing::{ElasticState, ElasticWing};
use crate::error::FlightError;
use crate::interface::BentShape;

/// All wings of an animal that loads bend.
#[derive(Debug, Default)]
pub struct ElasticWings {
    pub(super) wings: Vec<ElasticWing>,
    /// Those whose shape is the mirror image of another's; empty where both halves of the air are computed.
    images: Vec<Option<Image>>,
    /// Number of wings, elastic or not.
    count: usize,
    pub(super) gravity: DVec3,
    /// Whether wings hang on free joints.
    pub(super) on_joints: bool,
    /// Whether wings or joints are driven.
    is_driven: bool,
    /// Whether wings hang on free joints, or the flyer is light as a whole: small moments of inertia turn small
    /// forces into accelerations.
    is_delicate: bool,
    /// Whether forces of the air jump with the motion.
    pub(super) air_jumps: bool,
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
            images: vec![],
            count: animal.wings.len(),
            gravity,
            on_joints: false,
            is_driven: false,
            is_delicate: false,
            air_jumps: false,
        })
    }

    /// The same of an animal whose wings hang on free joints, if `on_joints`, or that is light as a whole, if
    /// `is_light`.
    pub fn carried_by(self, on_joints: bool, is_light: bool) -> Self {
        Self {
            on_joints,
            is_delicate: on_joints || is_light,
            ..self
        }
    }

    /// The same, wings or joints driven if `is_driven`.
    pub fn driven(self, is_driven: bool) -> Self {
        Self { is_driven, ..self }
    }

    /// The same in air whose forces jump with the motion, if it `jumps`.
    pub fn in_air(self, jumps: bool) -> Self {
        Self {
            air_jumps: jumps,
            ..self
        }
    }

    /// Whether wings hang on free joints and nothing is driven: what joints do is then little beside what it
    /// takes to move a rigid wing so, where joints jerk, and is counted by itself.
    pub fn are_passive(&self) -> bool {
        !self.wings.is_empty() && self.on_joints && !self.is_driven
    }

    /// The same in air of which one half is computed, wings of which these `pairs` are mirror images of each
    /// other: the shape of the first of a pair is computed, and that of the second is its image.
    pub fn mirrored(self, pairs: &[[usize; 2]]) -> Self {
        let place = |wing: usize| self.wings.iter().position(|w| w.wing == wing);
        let image = |w: &ElasticWing| {
            let [of, _] = pairs.iter().find(|pair| pair[1] == w.wing)?;
            let of = place(*of)?;
            Some(Image::new(
                of,
                self.wings[of].structure.rest(),
                w.structure.rest(),
            ))
        };
        Self {
            images: self.wings.iter().map(image).collect(),
            ..self
        }
    }

    /// Whose image the elastic wing number `k` is; none of wings whose shape is computed.
    pub(super) fn image(&self, k: usize) -> Option<&Image> {
        self.images.get(k).and_then(Option::as_ref)
    }

    /// The elastic wing whose shape is that of number `k`: itself or the one whose image it is.
    pub(super) fn original(&self, k: usize) -> usize {
        self.image(k).map_or(k, |image| image.of)
    }

    /// Where free joints carry wings: the share \[1\] of the fastest vibrations that is to be left from step to
    /// step, the least that any of the structures asks for. Such joints take part in vibrations far above one
    /// over the step.
    pub fn damping_on_joints(&self) -> Option<f64> {
        let radii = self.wings.iter().map(|w| w.spectral_radius);
        self.on_joints.then(|| radii.reduce(f64::min)).flatten()
    }

    /// Whether wings hang on free joints, or the flyer is light as a whole.
    pub fn is_delicate(&self) -> bool {
        self.is_delicate
    }

    /// Forces that are left unbalanced over those at the nodes \[1\].
    pub(super) fn tolerance(&self) -> f64 {
        match self.is_delicate {
            true => FINE_TOLERANCE,
            false => TOLERANCE,
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
    pub(super) fn shapes(&self) -> Vec<Option<BentShape>> {
        let mut shapes = vec![None; self.count];
        for w in &self.wings {
            shapes[w.wing] = Some(BentShape::default());
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
