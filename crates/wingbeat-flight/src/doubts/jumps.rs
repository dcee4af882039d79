//! Blade elements whose forces jump: no derivative of them is known, and steps of elastic wings may end where shape and
//! loads agree in no motion.
//!
//! An elastic wing is in balance at the end of a step with loads that follow its velocities there. Where these turn the
//! air along a chord round, the force jumps from a wing that it turns one way to one that it turns back, and between the
//! two there is no balance, however short the step is.

use wingbeat_blade::CentreOfPressure;

use crate::setup::{AirModel, FlightSetup};

impl FlightSetup {
    /// Says that derivatives of the air's forces are differences across jumps, and what elastic wings do at them; none of
    /// other air.
    pub fn jumping_forces(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        let rotation = self.air.jumps().then_some([
            "air.blade.rotation = sane_dickinson has a force",
            "\"circulation\" is continuous",
        ]);
        let place = match air.blade.centre_of_pressure {
            CentreOfPressure::Fixed(x) if x != 0.5 => Some([
                "air.blade.centre_of_pressure.fixed has a moment",
                "\"cosine\" is continuous",
            ]),
            _ => None,
        };
        let bent = match rotation.is_some() && self.animal.is_elastic() {
            true => {
                ", and a flight of elastic wings may end in an error there, in steps of any size and with any damping (\"circulation\" and a rotation_coefficient have no jumps)"
            }
            false => "",
        };
        let found: Vec<[&str; 2]> = rotation.into_iter().chain(place).collect();
        let each = |k: usize| found.iter().map(|f| f[k]).collect::<Vec<_>>().join(" and ");
        (!found.is_empty()).then(|| {
            format!(
                "{} that jumps where the air along a chord reverses while it meets the wing broadside: derivatives, modes of flight and gains of feedback are differences across these jumps, and change with the time steps without end (look at them with other --steps); {}{bent}",
                each(0),
                each(1)
            )
        })
    }
}
