//! Vectors, matrices and masses from the numbers of a case.

use wingbeat_math::{DMat3, DVec3, MassProperties};

use crate::build::fault::Built;
use crate::error::Fault;

/// Vector from a list.
pub(super) fn vector(v: [f64; 3]) -> DVec3 {
    DVec3::from_array(v)
}

/// Published moments of inertia have three digits: the largest of a flat body, which is the sum of the
/// two others, may then exceed it by this part of itself. It is lowered to the sum.
const ROUNDING: f64 = 5e-3;

/// Mass properties given as numbers at `path`: mass, centre, and the inertia about it.
pub(super) fn given_mass(
    path: &str,
    mass: f64,
    centre: DVec3,
    inertia: DMat3,
) -> Built<MassProperties> {
    let given = MassProperties::about_centre(mass, centre, inertia);
    given.within_rounding(ROUNDING).map_err(|e| {
        Fault::new(
            format!("{path}.inertia_about_centre_kg_m2"),
            e.to_string(),
            "moments that some distribution of positive mass has, to three digits",
            "check order (xx, yy, zz, xy, xz, yz), signs and unit",
        )
    })
}

/// Symmetric matrix from xx, yy, zz, xy, xz, yz.
pub(super) fn symmetric([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> DMat3 {
    DMat3::from_cols_array(&[xx, xy, xz, xy, yy, yz, xz, yz, zz])
}
