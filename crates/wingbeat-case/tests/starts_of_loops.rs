//! Joints of a closed loop that start as they are told, whichever of them is; names of joints.

use std::path::Path;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Simulation;

/// A parallelogram of two cranks of 0.1 m and a coupler, with this line at one of its three joints \[crank,
/// coupler, other crank\].
fn joints(lines: [&str; 3]) -> Result<Vec<[f64; 2]>, String> {
    let segment = |name: &str, x: f64, z: f64| {
        format!(
            "[segment.{name}]\nmass_kg = 0.2\ncentre_m = [{x}, 0, {z}]\ninertia_about_centre_kg_m2 = [2e-4, 3e-4, 3e-4, 0, 0, 0]\n"
        )
    };
    let joint = |name: &str, of: &str, x: f64, z: f64, line: &str| {
        format!(
            "[joint.{name}]\n{of}\nat_m = [{x}, 0, {z}]\nkind = \"revolute\"\naxis = [0, 1, 0]\n{line}\n"
        )
    };
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 1e-3\nsteps = 2\n[flight]\nmode = \"tethered\"\n\
         [air]\nmodel = \"none\"\n[body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0]\n{}{}{}{}{}{}{}",
        segment("c1", 0.0, -0.05),
        segment("cp", 0.15, -0.1),
        segment("c2", 0.3, -0.05),
        joint("j1", "child = \"c1\"", 0.0, 0.0, lines[0]),
        joint("j2", "parent = \"c1\"\nchild = \"cp\"", 0.0, -0.1, lines[1]),
        joint("j3", "child = \"c2\"", 0.3, 0.0, lines[2]),
        "[joint.j4]\nparent = \"cp\"\nchild = \"c2\"\nat_m = [0.3, 0, -0.1]\nkind = \"point_on_line\"\naxis = [0, 1, 0]\n",
    );
    let case = LoadedCase::from_text("parallelogram", &text, Path::new(""), &[]);
    let flight =
        Simulation::new(case.map_err(|e| e.to_string())?.setup).map_err(|e| e.to_string())?;
    Ok(flight.record().joints[..3].to_vec())
}

/// Both cranks turn alike, and the coupler keeps its direction.
#[test]
fn exact_starts_of_a_parallelogram_whichever_joint_is_told() {
    for (lines, [angle, rate]) in [
        (["start_deg_s = [300]", "", ""], [0.0, 300.0]),
        (["", "start_deg_s = [-300]", ""], [0.0, 300.0]),
        (["", "", "start_deg_s = [300]"], [0.0, 300.0]),
        (["start_deg = [10]", "", ""], [10.0, 0.0]),
        (
            ["", "start_deg = [-10]", "start_deg_s = [20]"],
            [10.0, 20.0],
        ),
        (
            ["start_deg = [10]", "", "start_deg_s = [300]"],
            [10.0, 300.0],
        ),
        (["start_deg = [10]", "", "start_deg = [10]"], [10.0, 0.0]),
    ] {
        let found = joints(lines).unwrap_or_else(|e| panic!("{lines:?}: {e}"));
        // Joints at the body come first.
        let signs = [1.0, 1.0, -1.0];
        for ([q, u], sign) in found.iter().zip(signs) {
            let [q, u] = [sign * q.to_degrees() - angle, sign * u.to_degrees() - rate];
            assert!(
                q.abs() < 2e-5 && u.abs() < 1e-9,
                "{lines:?}: {found:?} {q} {u}"
            );
        }
    }
}

#[test]
fn refuses_joints_whose_columns_are_the_same() {
    let set: Vec<String> = ["joint.tail-1", "joint.tail_1"]
        .into_iter()
        .map(|path| format!("{path}={{ child = \"abdomen\", at_m = [0, 0, 0] }}"))
        .collect();
    let error = LoadedCase::find("fruit-fly-abdomen", &set)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("joint.tail_1") && error.contains("columns"),
        "{error}"
    );
}

#[test]
fn refuses_starts_that_a_parallelogram_has_not() {
    let error = joints(["start_deg = [10]", "", "start_deg = [11]"]).unwrap_err();
    assert!(error.contains("joint `j"), "{error}");
    assert!(joints(["start_deg_s = [10]", "start_deg_s = [10]", ""]).is_err());
}
