//! Shells and membranes: quadrilaterals between four nodes, or triangles between three.
//!
//! Geometrically exact Reissner-Mindlin kinematics [Simo & Fox 1989]: a place and a normal that turns with each
//! node, no limit to displacement and rotation. Every strain is a bilinear form of places and nodal axes
//! (`strain.rs`), so the energy is unchanged by rigid motions and force and tangent are its exact derivatives.
//!
//! | part | how | source |
//! |---|---|---|
//! | membrane | mean of Green's strain and its linear part, lateral contraction free in in-plane bending | [Flanagan & Belytschko 1981], [Belytschko & Bachrach 1986] |
//! | bending | derivatives of the normals, whole over the element | [Simo & Fox 1989] |
//! | transverse shear | at the middle of the edges | [Dvorkin & Bathe 1984] |
//! | thin limit | residual bending flexibility: an edge bends as a cubic, stiffness stays of the order of bending | [MacNeal 1978] |
//! | turn about the normal | against the surface's own turn | [Hughes & Brezzi 1989] |
//! | mass | quarters as rigid bodies at the nodes | |
//!
//! The membrane has three conditions an element, as many as a node has displacements, so that a sheet can bend without
//! stretching however thin it is; triangles with constant strain cannot.
//!
//! Left out: strains are small (the section's stiffness is that at rest), the thickness is constant over an element.

mod bending;
mod element;
mod energy;
mod error;
mod geometry;
mod mesh;
mod section;
mod stiffness;
mod strain;

pub use element::Shell;
pub use error::ShellError;
pub use mesh::ShellMesh;
pub use section::{Lamina, ShellSection};
