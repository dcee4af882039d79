//! Wings, motions and the stepping that the tests share.

#[path = "../../../wingbeat-verify/src/lab/stepping.rs"]
mod stepping;

pub use stepping::{Run, fly, order, rectangle, sphere, total_force, translating};

use wingbeat_air::{AirSettings, LeadingEdge, LoadMethod, SheddingKinds};
use wingbeat_math::DVec3;

/// Forces on segments in this stream of density 1; leading and trailing edges may shed.
pub fn with_leading_edges(leading: LeadingEdge, stream: DVec3) -> AirSettings {
    AirSettings {
        shedding: SheddingKinds {
            leading: true,
            ..SheddingKinds::TRAILING
        },
        loads: LoadMethod::Joukowski,
        leading,
        ..AirSettings::accurate(1.0, stream)
    }
}
