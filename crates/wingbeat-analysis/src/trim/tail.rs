//! The tail whose incidence a trim may choose.

use wingbeat_flight::FlightSetup;
use wingbeat_model::{Side, are_pair, pairs};

use crate::AnalysisError;
use crate::beat::glide::glides;

/// The wings of the tail of `setup`, left and right: the pair of wings on the body that stands still beside wings that
/// beat; of a flyer whose wings all stand still the pair beside that of the longest wings. Single surfaces (fins) and
/// wings on joints are none.
///
/// # Errors
/// No such pair, or several.
pub fn tail_wings(setup: &FlightSetup) -> Result<[usize; 2], AnalysisError> {
    let pairs = pairs_that_stand_still(setup);
    let name = |w: usize| format!("`{}`", setup.animal.wings[w].name);
    match pairs.as_slice() {
        [tail] => Ok(*tail),
        [] => Err(AnalysisError::not_covered(
            "tail_incidence asks for a tail, a pair of wings on the body with constant angles beside wings that beat or beside longer ones, and there is none",
            "choose other unknowns; a single surface, or one on a joint, is no tail",
        )),
        several => {
            let names: Vec<String> = several.iter().map(|p| name(p[1])).collect();
            Err(AnalysisError::not_covered(
                format!(
                    "tail_incidence is that of one tail, and several pairs of wings stand still: {}",
                    names.join(", ")
                ),
                "choose other unknowns, and set psi of the pair that is the elevator in the case",
            ))
        }
    }
}

/// Pairs of wings that stand still, that of the main wings left out: of each the left wing, then the right one.
fn pairs_that_stand_still(setup: &FlightSetup) -> Vec<[usize; 2]> {
    let wings = &setup.animal.wings;
    let is_glider = glides(setup);
    let longest = setup.animal.wing_length();
    let stands = |w: usize| {
        let on_body = setup.joints.iter().all(|j| j.child != w + 1);
        on_body && wings[w].is_still() && (is_glider || setup.is_held_wing(w))
    };
    let is_main = |w: usize| is_glider && wings[w].length() >= longest;
    let tail = |pair: [usize; 2]| {
        let is_tail = are_pair(wings, pair) && pair.into_iter().all(|w| stands(w) && !is_main(w));
        let [a, b] = pair;
        is_tail.then(|| match wings[a].side {
            Side::Left => [a, b],
            Side::Right => [b, a],
        })
    };
    pairs(0..wings.len()).filter_map(tail).collect()
}
