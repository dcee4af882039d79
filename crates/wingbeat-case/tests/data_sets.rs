//! Shipped sets of measured motion beside frequency, stroke plane and angles of the case's own.

use std::path::Path;

use crate::common::found;
use wingbeat_case::LoadedCase;

const FREQUENCY: &str = "motion.frequency_hz=26";
const PLANE: &str = "motion.stroke_plane_pitch_deg=20";
const OWN_PLANE: &str = "wing.right.motion.stroke_plane_pitch_deg=30";
const ANGLES: [&str; 3] = [
    "wing.right.motion.phi.fourier={cosine_deg=[60.0]}",
    "wing.right.motion.psi.fourier={sine_deg=[-45.0]}",
    "wing.right.motion.theta.constant_deg=0",
];

/// A fruit fly whose motion is that of a set, beside what else is said.
fn load(set: &str, own: &[&str]) -> Result<LoadedCase, String> {
    let data = format!("motion.data={set}");
    found("fruit-fly-blade", &[&["motion=", &data], own].concat())
}

/// Every case that is accepted is read back from what is written of it, as the same flight; a set that gives nothing
/// is refused.
#[test]
fn behaves_sets_beside_keys_of_the_case_are_read_back_or_refused() {
    for set in ["fry-hover", "fwuav-hawkmoth"] {
        for choice in 0..16 {
            let [frequency, plane, own_plane, angles] = [1, 2, 4, 8].map(|bit| choice & bit != 0);
            let mut own = Vec::new();
            own.extend(frequency.then_some(FREQUENCY));
            own.extend(plane.then_some(PLANE));
            own.extend(own_plane.then_some(OWN_PLANE));
            own.extend(ANGLES.iter().filter(|_| angles));
            match load(set, &own) {
                Ok(case) => {
                    assert!(!plane || !own_plane, "{own:?}");
                    let again =
                        LoadedCase::from_text("again", &case.resolved(), Path::new(""), &[]);
                    let again = again.unwrap_or_else(|e| panic!("{set} {own:?}: {e}"));
                    assert_eq!(again.resolved(), case.resolved());
                    let wings = |c: &LoadedCase| format!("{:?}", c.setup.animal.wings);
                    assert_eq!(wings(&again), wings(&case));
                }
                Err(said) => {
                    let idle =
                        frequency && angles || plane && own_plane || set == "fry-hover" && angles;
                    let is_still = set == "fry-hover" && !frequency;
                    let says = said.contains("has no effect") && idle
                        || said.contains("no wingbeat frequency") && is_still;
                    assert!(says, "{own:?}: {said}");
                }
            }
        }
    }
    let planes = [FREQUENCY, ANGLES[0], ANGLES[1], ANGLES[2]];
    assert!(
        load("fwuav-hawkmoth", &planes).is_ok(),
        "it gives the stroke plane"
    );
    let all = [&planes[..], &[OWN_PLANE]].concat();
    let said = load("fwuav-hawkmoth", &all).err().unwrap_or_default();
    assert!(said.contains("motion.data"), "{said}");
}
