//! Induced flow of a flapping pair by momentum theory [Rankine & Froude; Ellington 1984 VI].
//!
//! The wings push air down through the disc they sweep. Coefficients measured on a flapping robot
//! (`dickinson-1999`, `dickson-2008`) already hold the effect; it is for coefficients of sections
//! and revolving wings, and always a stated choice.

/// Induced velocity [m/s] at a disc of area `area` [m2] that carries `thrust` [N] in air of
/// density `density` [kg/m3] climbing at `climb` [m/s] along the thrust:
/// `v = -V/2 + sqrt((V/2)^2 + T/(2 rho A))`.
///
/// ```
/// // A fruit fly of 1 mg on a disc of 11 mm2: about 0.6 m/s.
/// let v = wingbeat_air::blade::induced::induced_velocity(9.81e-6, 1.225, 1.1e-5, 0.0);
/// assert!((v - 0.603).abs() < 1e-3);
/// ```
///
/// # Panics
/// If density or area is not positive.
pub fn induced_velocity(thrust: f64, density: f64, area: f64, climb: f64) -> f64 {
    assert!(
        density > 0.0 && area > 0.0,
        "a disc of air has density and area"
    );
    let half = 0.5 * climb;
    -half + (half * half + thrust.max(0.0) / (2.0 * density * area)).sqrt()
}

/// Area [m2] swept by a pair of wings of length `length` [m] through the total stroke angle
/// `stroke` [rad] each: `Phi R^2` [Ellington 1984 VI].
pub fn swept_area(length: f64, stroke: f64) -> f64 {
    stroke * length * length
}
