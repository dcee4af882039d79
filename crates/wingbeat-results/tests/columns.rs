//! The columns of histories say what they hold, and their page is that of the program.

use std::fs;
use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_results::columns::Columns;

#[test]
fn behaves_columns_say_what_they_hold() {
    let case = LoadedCase::find("fruit-fly-abdomen-spring", &[]).unwrap();
    let columns = Columns::new(&case.setup, false).unwrap();
    for (name, unit, frame) in [
        ("step_count", "1", "none"),
        ("time_s", "s", "none"),
        ("body_x_m", "m", "N:"),
        ("body_x_rate_m_per_s", "m s-1", "N:"),
        ("body_phi_rad", "rad", "body against N"),
        ("wing_left_phi_rate_rad_per_s", "rad s-1", "wing against N"),
        (
            "wing_left_prescribed_phi_rad",
            "rad",
            "wing against the stroke",
        ),
        ("hinge_wing_left_moment_w2_newton_m", "N m", "W:"),
        ("body_angular_velocity_b1_rad_per_s", "rad s-1", "B:"),
        ("body_acceleration_n3_m_per_s2", "m s-2", "N:"),
        (
            "wing_left_angular_acceleration_w1_rad_per_s2",
            "rad s-2",
            "W:",
        ),
        (
            "segment_abdomen_angular_acceleration_s2_rad_per_s2",
            "rad s-2",
            "S:",
        ),
        ("joint_waist_rotation_rad", "rad", "K:"),
        ("joint_waist_rotation_rate_rad_per_s", "rad s-1", "K:"),
        ("angular_momentum_n3_kg_m2_per_s", "kg m2 s-1", "N:"),
        ("air_impulse_n1_newton_s", "N s", "N:"),
        ("body_quaternion_w_dimensionless", "1", "body to N"),
    ] {
        let column = columns
            .find(name)
            .unwrap_or_else(|| panic!("no column `{name}`"));
        assert_eq!(column.unit, unit, "{name}");
        assert!(column.frame.starts_with(frame), "{name}: {}", column.frame);
        assert!(
            !column.about.contains('{') && column.about.len() > 3,
            "{name}"
        );
    }
}

#[test]
fn regress_the_page_of_columns_is_that_of_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/columns.md");
    let page = fs::read_to_string(path).unwrap();
    assert!(
        page == wingbeat_results::columns_page(),
        "docs/columns.md is old: cargo run -p wingbeat-results --example columns > docs/columns.md"
    );
}
