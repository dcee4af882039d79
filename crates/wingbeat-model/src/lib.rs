//! The flapping animal: geometry, quad meshes, mass properties, wing motion laws (seed sec. 2).
//!
//! What is computed here: closed surfaces of revolution for head, thorax and abdomen; flat
//! wings from a planform; everything in four-node quadrilaterals; mass, first moment and inertia
//! by integration over those meshes; the prescribed rotation C(t) of each wing with two analytic
//! time derivatives; published motions and sizes of the fruit fly.
//!
//! What this crate does not know: air, forces, equations of motion, files.
//!
//! | symbol | name in code | meaning | unit, frame | seed |
//! |---|---|---|---|---|
//! | R, L | [`WingReport::length`](check::WingReport), [`Animal::body_length`] | wing and body length | m | sec. 2 |
//! | m, U, I | [`Animal::body`], [`Wing::mass`] | mass, first and second moment about the frame origin | kg, kg m, kg m2 | eq. 19 |
//! | r_rai, r_rad | [`Wing::hinge_b`] | hinge | m, body | eq. 4 |
//! | C | [`WingMotion`] | wing components to body components | 1 | eq. 4 |
//! | phi, theta, psi | [`WingMotion::angles`](fn@WingMotion::angles) | flap, deviation, feathering, sequence 1-3-2 | rad | sec. 3 |
//! | eta | [`WingMotion::stroke_plane_pitch`] | stroke plane to body | rad | |
//! | x | [`WingMotion::phase_at`] | phase | wingbeats | |
//! | tau, h, w | [`deformation`] | twist, camber over chord, bending of a wing | rad, 1, m | |
//!
//! Body axes: b1 forward, b2 right, b3 down. Wing axes: 1 to the leading edge, 2 along the span
//! of the right wing (against it on the left wing), 3 normal; origin at the hinge.
//! `docs/ANGLES.md` draws them.
#![warn(missing_docs)]

pub mod animal;
pub mod build;
pub mod check;
mod contact;
pub mod deformation;
pub mod error;
pub mod kinematics;
pub mod mesh;
pub mod motion;
mod pair;
pub mod planform;
pub mod species;
pub mod structure;

pub use animal::{Animal, BodyPart, Segment, Wing};
pub use build::{BodyMass, fit_body_length};
pub use check::{ElasticReport, WingReport};
pub use contact::bent::Bending;
pub use contact::coincident::{coincident, in_one_place};
pub use contact::crossing::depth::crossing_depth;
pub use contact::crossing::flown::{FlownCounts, FlownCrossings};
pub use contact::crossing::{Crossing, are_joined, crossings, nearest_nodes, pairs, root_gap};
pub use contact::inside::{Inside, Solid, inside};
pub use contact::narrow::{Faced, NarrowGap, NarrowGaps, Narrowest, SeenGaps, instants_of_gaps};
pub use contact::touching::{
    PairOnPart, RootOnPart, pairs_on_parts, roots_beside_parts, roots_meet, roots_on_parts,
};
pub use deformation::{Deformation, DeformingMesh};
pub use error::ModelError;
pub use mesh::import::Imported;
pub use mesh::integrate::MassInput;
pub use mesh::revolution::{Profile, Revolution};
pub use mesh::{GridMesh, QuadMesh, Side, Spacing, mirror_name, side_in_name};
pub use motion::{AngleLaw, AngleLaws, Start, WingMotion};
pub use pair::are_pair;
pub use planform::{Planform, WingShape};
pub use structure::{
    BeamMass, Coupling, ElasticBody, Members, Region, Vein, VeinStiffness, WingBeam, WingShell,
    WingStructure,
};
