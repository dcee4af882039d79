//! Verification of the model crate: closed forms, orders of convergence, symmetries.

mod beam;
mod deformation;
mod errors;
mod geometry;
mod import;
mod mass;
mod motion;
mod planform;
mod surface;

/// Euler characteristic `V - E + F` of a closed mesh: 2 for a sphere. Each edge joins two quadrilaterals, `E = 2 F`.
pub fn euler_characteristic(mesh: &wingbeat_model::QuadMesh) -> usize {
    assert_eq!(mesh.check_closed("mesh"), Ok(()));
    mesh.nodes.len() - mesh.quads.len()
}

/// Largest absolute entry of a matrix difference.
pub fn gap(a: wingbeat_math::DMat3, b: wingbeat_math::DMat3) -> f64 {
    let d = (a - b).to_cols_array();
    d.iter().fold(0.0_f64, |m, e| m.max(e.abs()))
}
