//! The stroke plane in the world, as papers give it.

use wingbeat_case::LoadedCase;
use wingbeat_math::{DVec3, RotationLaw};

/// Inclination beta of the stroke plane against the horizontal, above 0 when the downstroke goes forward and down, and the
/// angle chi of the body: `stroke_plane_pitch_deg = 90 - chi - beta` (docs/measured-angles.md).
#[test]
fn exact_a_downstroke_in_an_inclined_stroke_plane_goes_forward_and_down() {
    for (chi, beta) in [(40.0, 25.0), (10.0, -15.0), (57.0, 0.0)] {
        let set = [
            format!("flight.pitch_deg={chi}"),
            format!("motion.stroke_plane_pitch_deg={}", 90.0 - chi - beta),
            "motion.data=".to_owned(),
            "wing.right.motion.phi={fourier={sine_deg=[60]}}".to_owned(),
            "wing.right.motion.theta.constant_deg=0".to_owned(),
            "wing.right.motion.psi.constant_deg=0".to_owned(),
        ];
        let setup = LoadedCase::find("fruit-fly-blade", &set).unwrap().setup;
        let body = setup.root_at_start().r;
        for wing in &setup.animal.wings {
            let motion = wing.motion.impulsive();
            let tip = DVec3::Y * wing.side.sign();
            let at = |phase: f64| body * (motion.at(phase / motion.frequency).c * tip);
            let way = (at(0.25) - at(-0.25)).normalize(); // phi from -60 to 60 deg: the downstroke
            let (sin, cos) = f64::to_radians(beta).sin_cos();
            // N components, n3 down; roundings.
            assert!((way - DVec3::new(cos, 0.0, sin)).length() < 1e-12, "{way}");
        }
    }
}
