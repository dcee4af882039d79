//! Converters from published angle conventions to the one of this program, one per convention.
//! `docs/ANGLES.md` draws ours.
//!
//! Ours, for either wing: `C = R2(eta) R1(phi) R3(theta) R2(psi)` (active, wing components to
//! body components), body axes forward, right, down; all results are laws of the **right** wing.

use crate::motion::{AngleLaw, AngleLaws, SmoothSquare, SmoothTriangle};

/// FluSI / WABBIT [Engels et al. 2016], stroke `phi`, deviation `theta`, feathering `alpha`.
///
/// Their left wing is `v_wing = Ry(alpha) Rz(theta) Rx(phi) Ry(eta) v_body` with passive
/// rotations in axes x forward, y left, z up. Passive matrices transpose to active ones in
/// reverse order, `C = Ry(eta) Rx(phi) Rz(theta) Ry(alpha)`, and going over to our axes is a
/// turn by pi about x, which reverses the angles about y and z:
/// `phi_L = phi_F, theta_L = -theta_F, psi_L = -alpha_F`, stroke-plane pitch `-eta_F`. The
/// right wing follows by mirror symmetry.
pub fn flusi(phi: AngleLaw, theta: AngleLaw, alpha: AngleLaw) -> AngleLaws {
    AngleLaws {
        phi: phi.scaled(-1.0),
        theta,
        psi: alpha.scaled(-1.0),
    }
}

/// FWUAV [Sridhar, Lee et al.], right wing `exp(beta e2) exp(phi e1) exp(-psi e3) exp(theta e2)`
/// in axes forward, right, down: their pitch `theta` is our psi, their deviation `psi` our
/// `-theta`, stroke-plane pitch `beta`.
pub fn fwuav(phi: AngleLaw, pitch: AngleLaw, deviation: AngleLaw) -> AngleLaws {
    AngleLaws {
        phi,
        theta: deviation.scaled(-1.0),
        psi: pitch,
    }
}

/// Parameters of Berman & Wang's stroke and feathering angles, `phi` about the lateral position
/// and `eta` about the chord normal to the stroke plane (eta_0 = 90 deg) \[rad\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BermanWang {
    /// Stroke amplitude phi_m \[rad\].
    pub phi_m: f64,
    /// Stroke shape K.
    pub k: f64,
    /// Feathering amplitude eta_m \[rad\].
    pub eta_m: f64,
    /// Feathering shape C_eta.
    pub c_eta: f64,
    /// Feathering phase Phi_eta \[rad\].
    pub phi_eta: f64,
}

/// Berman & Wang 2007 with eta_0 = 90 deg and no deviation: eta is measured from the stroke
/// plane, so our `psi = eta - 90 deg`; `phi` is taken positive forward. The stored files leave
/// the sign of phi open; the opposite reading (both signs reversed, so that the leading edge
/// still leads) is the same motion half a wingbeat later.
pub fn berman_wang(p: &BermanWang) -> AngleLaws {
    AngleLaws {
        phi: AngleLaw::SmoothTriangle(SmoothTriangle {
            amplitude: p.phi_m,
            shape: p.k,
            shift: 0.0,
            mean: 0.0,
        }),
        theta: AngleLaw::Constant(0.0),
        psi: AngleLaw::SmoothSquare(SmoothSquare {
            amplitude: p.eta_m,
            shape: p.c_eta,
            shift: p.phi_eta,
            mean: 0.0,
        }),
    }
}

/// Rows (phase \[wingbeats\], angle \[rad\]).
type Rows = Vec<(f64, f64)>;

/// Robofly benchmark tables: stroke counted from its start, pitch from the vertical chord,
/// positive while the stroke grows. The first half stroke is made the downstroke (forward):
/// `phi = stroke - (stroke range)/2`, `psi = -pitch`.
pub fn robofly_table(stroke: &[(f64, f64)], pitch: &[(f64, f64)]) -> (Rows, Rows) {
    let half = 0.5 * stroke.iter().fold(0.0_f64, |a, r| a.max(r.1));
    let phi = stroke.iter().map(|&(t, s)| (t, s - half)).collect();
    let psi = pitch.iter().map(|&(t, p)| (t, -p)).collect();
    (phi, psi)
}
