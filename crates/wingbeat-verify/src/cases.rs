//! The suite, in the order of the dossier.

mod benchmark;
mod bodies;
mod conservation;
mod dragonflies;
mod hover;
mod insects;
mod invariance;
mod kernel;
mod particles;
mod peer;
mod plates;
mod start;
mod steady;
mod unsteady;
mod yeo;

use crate::Case;

/// All cases.
pub fn suite() -> Vec<Case> {
    [
        kernel::CASES,
        bodies::CASES,
        steady::CASES,
        unsteady::CASES,
        plates::CASES,
        conservation::CASES,
        particles::CASES,
        invariance::CASES,
        benchmark::CASES,
        start::CASES,
        peer::CASES,
        yeo::CASES,
        insects::CASES,
        dragonflies::CASES,
        hover::CASES,
    ]
    .concat()
}
