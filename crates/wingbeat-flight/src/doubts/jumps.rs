//! Blade elements whose forces jump: no derivative of them is known.

use wingbeat_blade::{CentreOfPressure, Rotation};

use crate::setup::{AirModel, FlightSetup};

impl FlightSetup {
    /// Says that derivatives of the air's forces are differences across jumps; none of other air.
    pub fn jumping_forces(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        let rotation = (air.blade.rotation == Rotation::SaneDickinson).then_some([
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
        let found: Vec<[&str; 2]> = rotation.into_iter().chain(place).collect();
        let each = |k: usize| found.iter().map(|f| f[k]).collect::<Vec<_>>().join(" and ");
        (!found.is_empty()).then(|| {
            format!(
                "{} that jumps where the air along a chord reverses while it meets the wing broadside: derivatives, modes of flight and gains of feedback are differences across these jumps, and change with the time steps without end (look at them with other --steps); {}",
                each(0),
                each(1)
            )
        })
    }
}
