//! Modes of elastic wings in which something moves.

use wingbeat_flight::elastic::ElasticWing;
use wingbeat_structure::Mode;

/// Part of the kinetic energy in the turns of the nodes of a sheet from which on nothing moves \[1\].
const TURNING: f64 = 0.5;

/// Whether nodes turn in this mode and nothing moves.
pub fn only_turns(wing: &ElasticWing, mode: &Mode) -> bool {
    wing.is_sheet() && mode.turning(wing.structure()) > TURNING
}

/// The leading `count` of `all` modes of a wing in which something moves, and how many below the last of them were left out.
pub fn moving(wing: &ElasticWing, all: Vec<Mode>, count: usize) -> (Vec<Mode>, usize) {
    let (mut kept, mut left_out, mut since) = (vec![], 0, 0);
    for mode in all {
        if kept.len() == count {
            break;
        }
        if only_turns(wing, &mode) {
            since += 1;
            continue;
        }
        left_out += std::mem::take(&mut since);
        kept.push(mode);
    }
    (kept, left_out)
}
