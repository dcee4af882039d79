//! Blade elements whose force of feathering jumps: no derivative of them is known, and steps of elastic wings may end
//! where shape and loads agree in no motion.
//!
//! An elastic wing is in balance at the end of a step with loads that follow its velocities there. Where these turn the
//! air along a chord round, the force jumps from a wing that it turns one way to one that it turns back, and between the
//! two there is no balance, however short the step is.

use crate::setup::FlightSetup;

impl FlightSetup {
    /// Says that derivatives of the air's forces are differences across jumps, and what elastic wings do at them; none of
    /// other air.
    pub fn jumping_rotation(&self) -> Option<String> {
        let bent = match self.animal.is_elastic() {
            true => {
                ", and a flight of elastic wings may end in an error there, in steps of any size and with any damping (\"circulation\" and a rotation_coefficient have no jumps)"
            }
            false => "",
        };
        self.air.jumps().then(|| {
            format!(
                "air.blade.rotation = sane_dickinson has a force that jumps where the air along a chord reverses while it meets the wing broadside: derivatives, modes of flight and gains of feedback are differences across these jumps, and change with the time steps without end (look at them with other --steps); \"circulation\" is continuous{bent}"
            )
        })
    }
}
