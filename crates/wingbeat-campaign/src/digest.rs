//! What a result depends on that every campaign and ensemble of a case has in common.

use sha2::{Digest, Sha256};
use wingbeat_case::LoadedCase;
use wingbeat_flight::{AirModel, FlightSetup};

/// The law of blade elements by its name: results by another are not taken for those of this one.
pub(crate) const LAW_OF_BLADES: &str = "feathering by thin-airfoil theory\n"; // it was of the leading edge, without a moment

/// A digest begun with version and case.
pub(crate) fn of_case(case: &LoadedCase) -> Sha256 {
    let mut hash = Sha256::new_with_prefix(concat!("wingbeat ", env!("CARGO_PKG_VERSION"), "\n"));
    hash.update(Sha256::digest(case.resolved()));
    hash.update(Sha256::digest(case.text()));
    hash
}

/// The law by which a setup flies, where builds of this version flew by another.
pub(crate) fn law_of(setup: &FlightSetup) -> &'static str {
    match setup.air {
        AirModel::BladeElement(_) => LAW_OF_BLADES,
        _ => "",
    }
}
