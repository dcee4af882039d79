//! Shipped sets of measured wing angles.

use wingbeat_model::kinematics::{self, FwuavInsect, PublishedMotion, Timing};

use crate::error::Fault;
use crate::text::nearest::nearest;

/// Names of the shipped sets of wing angles with a line about each.
pub fn data_sets() -> Vec<(&'static str, String)> {
    NAMES
        .iter()
        .map(|&n| (n, data_set(n).map_or(String::new(), |d| d.name)))
        .collect()
}

const NAMES: [&str; 15] = [
    "fry-hover",
    "robofly-advanced",
    "robofly-symmetrical",
    "robofly-delayed",
    "robofly-sane-advanced",
    "robofly-sane-symmetrical",
    "robofly-sane-delayed",
    "robofly-table-advanced",
    "robofly-table-symmetrical",
    "robofly-table-delayed",
    "berman-wang-fruit-fly",
    "whitehead-fruit-fly",
    "fwuav-monarch",
    "fwuav-hawkmoth",
    "fwuav-bumblebee",
];

fn data_set(name: &str) -> Option<PublishedMotion> {
    // Dickinson's robot: total stroke 160 deg, angle of attack at mid stroke 40 deg.
    let (stroke, attack) = (160f64.to_radians(), 40f64.to_radians());
    let timing = match name.rsplit('-').next()? {
        "advanced" => Timing::Advanced,
        "delayed" => Timing::Delayed,
        _ => Timing::Symmetrical,
    };
    match name {
        "fry-hover" => Some(kinematics::fry_hover()),
        "berman-wang-fruit-fly" => Some(kinematics::berman_wang_fruit_fly()),
        "whitehead-fruit-fly" => Some(kinematics::whitehead_fruit_fly()),
        "fwuav-monarch" => Some(kinematics::fwuav_hover(FwuavInsect::Monarch).0),
        "fwuav-hawkmoth" => Some(kinematics::fwuav_hover(FwuavInsect::Hawkmoth).0),
        "fwuav-bumblebee" => Some(kinematics::fwuav_hover(FwuavInsect::Bumblebee).0),
        _ if !NAMES.contains(&name) => None,
        _ if name.contains("table") => kinematics::robofly_table(timing).ok(),
        _ if name.contains("sane") => Some(kinematics::robofly_sane_dickinson2001(
            timing, stroke, attack,
        )),
        _ => Some(kinematics::robofly_dickinson1999(timing, stroke, attack)),
    }
}

/// The shipped set `name`, which stands at `key`.
pub(crate) fn find_data(key: &str, name: &str) -> Result<PublishedMotion, Fault> {
    data_set(name).ok_or_else(|| {
        let remedy = match nearest(name, &NAMES) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "give the angles phi, theta, psi of your own".to_owned(),
        };
        Fault::new(
            key,
            "there is no such set of wing angles",
            NAMES.join(", "),
            remedy,
        )
    })
}
