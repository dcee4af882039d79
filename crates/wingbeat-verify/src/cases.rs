//! The suite, in the order of the report.

mod anax;
mod baik;
mod benchmark;
mod bodies;
mod bumblebee;
mod conservation;
mod dragonflies;
mod feathering;
mod garrick;
mod goland;
mod heathcote;
mod hinges;
mod hover;
mod hummingbird;
mod insects;
mod invariance;
mod kernel;
mod mancini;
mod membrane;
mod onset;
mod particles;
mod pazy;
mod peer;
mod plates;
mod ramp;
mod razak;
mod revolving;
mod scherer;
mod start;
mod steady;
mod unsteady;
mod wang;
mod wing_body;
mod yamano;
mod yang;
mod yeo;

use crate::case::Case;

/// All cases.
pub fn suite() -> Vec<Case> {
    [
        kernel::CASES,
        bodies::CASES,
        wing_body::CASES,
        steady::CASES,
        unsteady::CASES,
        garrick::CASES,
        plates::CASES,
        conservation::CASES,
        particles::CASES,
        invariance::CASES,
        benchmark::CASES,
        start::CASES,
        peer::CASES,
        yeo::CASES,
        onset::CASES,
        goland::CASES,
        pazy::CASES,
        membrane::CASES,
        yamano::CASES,
        heathcote::CASES,
        scherer::CASES,
        ramp::CASES,
        mancini::CASES,
        baik::CASES,
        yang::CASES,
        razak::CASES,
        wang::CASES,
        revolving::CASES,
        insects::CASES,
        bumblebee::CASES,
        hummingbird::CASES,
        dragonflies::CASES,
        anax::CASES,
        hinges::CASES,
        feathering::CASES,
        hover::CASES,
    ]
    .concat()
}

/// The cases of the short or the whole suite whose name holds `only`.
pub fn select(quick: bool, only: &str) -> Vec<Case> {
    let wanted = |c: &Case| (c.quick || !quick) && c.name.contains(only);
    suite().into_iter().filter(wanted).collect()
}
