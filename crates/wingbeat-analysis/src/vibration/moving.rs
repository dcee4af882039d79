//! Modes of elastic wings in which something moves.

use wingbeat_flight::elastic::ElasticWing;
use wingbeat_structure::Mode;

/// Part of the kinetic energy in the turns of the nodes of a sheet from which on nothing moves \[1\].
const TURNING: f64 = 0.5;

/// Whether nodes turn in this mode and nothing moves.
pub(crate) fn only_turns(wing: &ElasticWing, mode: &Mode) -> bool {
    wing.is_sheet() && mode.turning(wing.structure()) > TURNING
}

/// Part of the kinetic energy in the turns of the nodes up to which a mode that is left out moves, too: a wave
/// of the sheet mixed with such turns of nearly its frequency \[1\].
const MIXED: f64 = 0.9;

/// Whether among the slowest modes of a wing there are `count` that vibrate and in which something moves.
pub(crate) fn enough(wing: &ElasticWing, count: usize) -> impl Fn(&[Mode]) -> bool {
    move |slowest| {
        let vibrating = slowest.iter().filter(|m| m.square > 0.0);
        vibrating.filter(|m| !only_turns(wing, m)).count() >= count
    }
}

/// The leading modes of a wing in which something moves.
pub(crate) struct Moving {
    /// The modes.
    pub modes: Vec<Mode>,
    /// How many below the last of them were left out.
    pub left_out: usize,
    /// Frequencies of those left out that are mixed with waves [rad/s].
    pub mixed: Vec<f64>,
}

/// The leading `count` of the slowest modes, `all` or [`enough`], of a wing in which something moves.
pub(crate) fn moving(wing: &ElasticWing, all: Vec<Mode>, count: usize) -> Moving {
    let (mut modes, mut left_out, mut since) = (vec![], vec![], vec![]);
    for mode in all {
        if modes.len() == count {
            break;
        }
        if only_turns(wing, &mode) {
            since.push(mode);
            continue;
        }
        left_out.append(&mut since);
        modes.push(mode);
    }
    let mixed = left_out
        .iter()
        .filter(|m| m.turning(wing.structure()) < MIXED);
    Moving {
        modes,
        mixed: mixed.map(Mode::frequency).collect(),
        left_out: left_out.len(),
    }
}
