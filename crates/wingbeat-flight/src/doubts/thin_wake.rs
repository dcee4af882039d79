//! Cores of wakes of leading edges that widen too little along the sheet.
//!
//! Behind leading edges wakes roll up and stretch, and they are resolved only while the cores of neighbours
//! overlap. A plate of aspect ratio 4 at 30 deg, 20 chords after its start, leaves 1.3, 0.5, 26, 17 and 21 % of
//! the impulse with cores that widen by 0.25, 0.15, 0.1, 0.06 and 0.03 of the way along the sheet (`suction`),
//! 0.9, 3.3, 4.3, 3.1 and 10 % by `suction_implicit`; a dragonfly in its third beat 3, 3 and 25 % with 0.25,
//! 0.1 and 0.03, a tethered fly after five beats 1.3, 2.6 and 4.9 % with 0.1, 0.06 and 0.03.

use crate::setup::FlightSetup;

/// Slope up to which it is said \[1\].
const SLIGHT: f64 = 0.1;

impl FlightSetup {
    /// Says that cores are kept too thin for the wakes of leading edges (`air.wake_overlap_slope`); none where
    /// these shed nothing, and of cores that know no such slope.
    pub fn thin_cores_behind_leading_edges(&self) -> Option<String> {
        let air = &self.air.lattice()?.lattice;
        let sheds = air.leading_edges_shed();
        let widens = air.is_symmetric() && air.wake_overlap > 0.0;
        (sheds && widens && air.overlap_slope <= SLIGHT).then(|| {
            format!(
                "leading edges shed, and cores of wakes widen by no more than {} of the way along the sheet (air.wake_overlap_slope): wakes that \
                 roll up are not resolved then and do not keep their impulse (a plate at 30 deg left 3 to 26 % of it with 0.03 to 0.1, a \
                 dragonfly 25 % with 0.03, both 3 % or less with 0.25); leave wake_overlap_slope out, it is for attached wings",
                air.overlap_slope
            )
        })
    }
}
