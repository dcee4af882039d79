//! Units and frames of the columns of a history, from their names.

/// Endings of column names and the units they stand for, longer ones first.
const UNITS: [(&str, &str); 14] = [
    ("_kg_m2_per_s", "kg m2 s-1"),
    ("_kg_m_per_s", "kg m s-1"),
    ("_rad_per_s", "rad s-1"),
    ("_m_per_s", "m s-1"),
    ("_dimensionless", "1"),
    ("_newton_m", "N m"),
    ("_newton", "N"),
    ("_joule", "J"),
    ("_watt", "W"),
    ("_pascal", "Pa"),
    ("_count", "1"),
    ("_rad", "rad"),
    ("_m", "m"),
    ("_s", "s"),
];

/// Unit of a column.
pub fn unit(column: &str) -> &'static str {
    let found = UNITS.iter().find(|(end, _)| column.ends_with(end));
    found.map_or("1", |u| u.1)
}

/// Frame of a column, in words.
pub fn frame(column: &str) -> &'static str {
    let has = |part: &str| column.contains(part);
    let angle = ["_phi_", "_theta_", "_psi_"].iter().any(|a| has(a));
    let numbered = |axis: &str| (1..=3).any(|k| has(&format!("_{axis}{k}_")));
    if numbered("n") {
        "N: inertial, n3 along gravity"
    } else if numbered("b") {
        "B: body, forward, right, down"
    } else if numbered("w") {
        "W: wing, leading edge, span to the right, normal"
    } else if has("_prescribed_") {
        "wing against the stroke plane, Euler 1-3-2"
    } else if angle && column.starts_with("body_") {
        "body against N, Euler 2-3-1"
    } else if angle {
        "wing against N, Euler 1-3-2"
    } else if ["_x_", "_y_", "_z_"].iter().any(|a| has(a)) && !has("quaternion") {
        "N: inertial, n3 along gravity"
    } else if has("quaternion") {
        "body to N"
    } else {
        "none: scalar"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_units_and_frames_of_columns() {
        let columns = [
            ("time_s", "s", "none"),
            ("body_x_m", "m", "N:"),
            ("body_x_rate_m_per_s", "m s-1", "N:"),
            ("wing_left_phi_rate_rad_per_s", "rad s-1", "wing against N"),
            (
                "wing_left_prescribed_phi_rad",
                "rad",
                "wing against the stroke",
            ),
            ("hinge_wing_left_moment_w2_newton_m", "N m", "W:"),
            ("body_angular_velocity_b1_rad_per_s", "rad s-1", "B:"),
            ("angular_momentum_n3_kg_m2_per_s", "kg m2 s-1", "N:"),
            ("body_quaternion_w_dimensionless", "1", "body to N"),
        ];
        for (column, u, f) in columns {
            assert_eq!(unit(column), u, "{column}");
            assert!(frame(column).starts_with(f), "{column}: {}", frame(column));
        }
    }
}
