//! Blade elements whose coefficients have far more drag at small incidence than wings at their Reynolds number.
//!
//! The published sets were found for strokes of insects, at Reynolds numbers of some hundred and incidences of 20 to 60
//! degrees, where the drag follows from the lift. At smaller incidence it is friction, and falls with the Reynolds number:
//! wings of insects have about twice the laminar friction of both faces of a plate, which is 0.15 at 1240, where those of
//! bumblebees have 0.2 (Dudley & Ellington 1990, quoted).

use crate::setup::{AirModel, FlightSetup};
use wingbeat_blade::SETS;

/// Incidence up to which drag is friction [rad].
const SMALL: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Part of the sizes of all forces that excess drag may have: it acts one way. Of *Anax* at 1.5 m/s 0.044 are a fourth of
/// the weight; strokes of hovering insects in planes that are level or nearly so have 0.02 at most.
const PART: f64 = 0.03;

impl FlightSetup {
    /// Says that wings which meet the air at small incidence have much more drag by a named set of coefficients than at
    /// their Reynolds number. None of coefficients of one's own, and of wings whose motion is not known beforehand: those on
    /// free joints, and elastic ones.
    pub fn drag_of_slow_coefficients(&self) -> Option<String> {
        let AirModel::BladeElement(air) = &self.air else {
            return None;
        };
        let law = air.blade.translation;
        let set = SETS.iter().find(|set| set.law == law)?;
        let viscosity = self.air.viscosity()?;
        let [_, drag] = law.at(0.0);
        let [mut all, mut excess, mut weighted] = [0.0; 3];
        for (w, wing) in self.animal.wings.iter().enumerate() {
            if wing.structure.is_some() || self.prescribed_in_body(w, 0.0).is_none() {
                continue;
            }
            self.visit_sections(w, 0, |section, _| {
                let pressure = section.speed * section.speed * section.area;
                let incidence = (section.downwash[1].abs() / section.speed).min(1.0).asin();
                let [lift_here, drag_here] = law.at(incidence);
                all += pressure * lift_here.hypot(drag_here);
                if incidence < SMALL {
                    let reynolds = section.speed * section.chord / viscosity;
                    let more = (drag - friction(reynolds)).max(0.0) * pressure;
                    excess += more;
                    weighted += more * reynolds;
                }
            });
        }
        (excess > PART * all).then(|| {
            let reynolds = weighted / excess;
            format!(
                "wings meet the air at less than 20 deg of incidence, at Reynolds numbers of about {reynolds:.0}, where \
                 drag is friction: a coefficient of {:.2}, for which these coefficients have {drag:.2} \
                 (air.blade.coefficients = \"{}\", found for strokes of insects). {:.0} % of the sizes of all forces are this \
                 excess, which acts one way: power comes out too large, thrust too small; give coefficients with a smaller drag_0 \
                 ([air.blade.own]), and compare with the lattice",
                friction(reynolds),
                set.name,
                100.0 * excess / all
            )
        })
    }
}

/// Drag coefficient at no incidence: twice the laminar friction of both faces of a plate [Blasius 1908].
fn friction(reynolds: f64) -> f64 {
    4.0 * 1.328 / reynolds.sqrt()
}
