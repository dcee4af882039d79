//! Blade elements whose force of feathering jumps: no derivative of them is known.

use wingbeat_blade::Rotation;

use crate::setup::{AirModel, FlightSetup};

impl FlightSetup {
    /// Says that derivatives of the air's forces are differences across jumps; none of other air.
    pub fn jumping_rotation(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        (air.blade.rotation == Rotation::SaneDickinson).then(|| {
            "air.blade.rotation = sane_dickinson has a force that jumps where the air along a chord reverses while it meets the wing broadside: derivatives, modes of flight and gains of feedback are differences across these jumps, and change with the time steps without end (look at them with other --steps); \"circulation\" is smooth".to_owned()
        })
    }
}
