//! Stiffness of the strains of a quadrilateral.

use super::ShellSection;
use super::bending::bending;
use super::geometry::Quad;
use super::strain::{DRILL, IN_PLANE_BENDING, MEMBRANE, STRAINS, Stiffness};

/// Stiffness of the turn of a node about the normal against the surface's, in parts of the membrane's shear stiffness.
const DRILL_STIFFNESS: f64 = 0.1;

/// Second derivatives of the strain energy by the strains, and first ones at rest, by tension.
pub(super) fn stiffness(quad: &Quad, section: &ShellSection) -> (Box<Stiffness>, [f64; STRAINS]) {
    let mut c = Box::new([[0.0; STRAINS]; STRAINS]);
    membrane(quad, section, &mut c);
    bending(quad, section, &mut c);
    let drill = DRILL_STIFFNESS * section.membrane.z_axis.z * quad.area / 4.0;
    (DRILL..DRILL + 4).for_each(|k| c[k][k] = drill);
    let mut tension = [0.0; STRAINS];
    for k in 0..3 {
        tension[MEMBRANE + k] = quad.area * section.prestress[k];
    }
    (c, tension)
}

/// Area times A; in-plane bending resists with the uniaxial moduli, lateral contraction free.
fn membrane(quad: &Quad, section: &ShellSection, c: &mut Stiffness) {
    let compliance = section.membrane.inverse();
    for i in 0..3 {
        for j in 0..3 {
            c[MEMBRANE + i][MEMBRANE + j] = quad.area * section.membrane.col(j)[i];
        }
    }
    for k in 0..2 {
        let modulus = 1.0 / compliance.col(k)[k];
        c[IN_PLANE_BENDING + k][IN_PLANE_BENDING + k] = modulus * quad.roughness[k];
    }
}
