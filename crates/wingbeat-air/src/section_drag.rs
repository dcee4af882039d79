//! Drag of the sections of wings at low Reynolds number, which an inviscid lattice lacks.
//!
//! Every strip behind the leading edge feels `D = 1/2 rho |U| U A C` along the velocity U of the
//! undisturbed air past it, A its area, `C = C_f + cd0 + cd2 alpha^2`:
//!
//! - C_f is the friction of a laminar flat plate on both sides, `2 x 1.328 / sqrt(Re)`,
//!   `Re = |U| c / nu` [Blasius 1908; Schlichting, Boundary-Layer Theory, sec. 7.5: plates along the
//!   stream, Re from about 1e2 to 5e5, attached];
//! - `cd0 + cd2 alpha^2` is a polar of the user's, alpha the angle between U and the strip.
//!
//! U is that of stream and motion at the control points, their mean over the strip by area: what wing
//! and wakes induce is left out. The lattice has the pressure drag of a wing at incidence already;
//! the polar is for what it lacks. The force is spread over the panels of the strip by their area.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::loads::AirLoads;
use crate::strips::{Strip, chord};
use wingbeat_math::DVec3;

/// Drag of the sections of wings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionDrag {
    /// Friction.
    pub friction: Friction,
    /// Profile drag coefficient at zero incidence.
    pub cd0: f64,
    /// Its growth with the square of the incidence [1/rad2].
    pub cd2: f64,
}

/// Friction of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// None.
    None,
    /// Laminar flat plate, both sides.
    Blasius {
        /// Kinematic viscosity nu [m2/s].
        viscosity: f64,
    },
}

/// Mean friction coefficient of one side of a laminar flat plate times sqrt(Re).
const BLASIUS: f64 = 1.328;

impl SectionDrag {
    /// `|U| C` [m/s] of a strip of the given chord [m] at the speed |U| [m/s] and the incidence [rad].
    /// With the speed, because the friction coefficient alone grows beyond bounds at rest.
    pub fn speed_times_coefficient(&self, speed: f64, chord: f64, alpha: f64) -> f64 {
        let friction = match self.friction {
            Friction::None => 0.0,
            Friction::Blasius { viscosity } => 2.0 * BLASIUS * (viscosity * speed / chord).sqrt(),
        };
        friction + speed * (self.cd0 + self.cd2 * alpha * alpha)
    }

    /// # Errors
    /// [`AirError::Setting`] names the first number that makes no sense.
    pub(crate) fn validate(&self) -> Result<(), AirError> {
        let mut numbers = vec![
            (
                "section drag cd0",
                self.cd0,
                self.cd0 >= 0.0,
                "a finite number >= 0",
            ),
            (
                "section drag cd2",
                self.cd2,
                self.cd2 >= 0.0,
                "a finite number >= 0",
            ),
        ];
        if let Friction::Blasius { viscosity } = self.friction {
            let allowed = "a finite viscosity in m2/s above 0";
            numbers.push((
                "section drag viscosity",
                viscosity,
                viscosity > 0.0,
                allowed,
            ));
        }
        let wrong = |(_, x, ok, _): &&(_, f64, bool, _)| !(x.is_finite() && *ok);
        match numbers.iter().find(wrong) {
            None => Ok(()),
            Some(&(key, value, _, allowed)) => Err(AirError::Setting {
                key,
                value: value.to_string(),
                allowed,
            }),
        }
    }
}

/// Adds the drag of the sections to the forces of the panels.
pub(crate) fn add(lattice: &Lattice, position: &[DVec3], out: &mut AirLoads) {
    let Some(drag) = &lattice.settings().section_drag else {
        return;
    };
    for strip in lattice.strips() {
        let traction = traction(lattice, drag, strip, position, out);
        for &p in &strip.panels {
            out.force[p] += area(lattice, p, position) * traction;
        }
    }
}

/// Area of a panel [m2], that of the surface: rings may be smaller.
fn area(lattice: &Lattice, panel: usize, position: &[DVec3]) -> f64 {
    let x = lattice.topology().panels[panel].map(|n| position[n]);
    0.5 * (x[2] - x[0]).cross(x[3] - x[1]).length()
}

/// Force per area of a strip [Pa], N.
fn traction(
    lattice: &Lattice,
    drag: &SectionDrag,
    strip: &Strip,
    position: &[DVec3],
    out: &AirLoads,
) -> DVec3 {
    let panels = &out.panels;
    let (mut whole, mut flow, mut normal) = (0.0, DVec3::ZERO, DVec3::ZERO);
    for &p in &strip.panels {
        let wind = lattice.stream(panels.point[p], out.time) - panels.velocity[p];
        let part = area(lattice, p, position);
        whole += part;
        flow += part * wind;
        normal += part * panels.normal[p];
    }
    let wind = flow / whole;
    let (speed, (_, chord)) = (wind.length(), chord(strip, position));
    if speed == 0.0 || chord == 0.0 {
        return DVec3::ZERO;
    }
    let sine = wind.dot(normal.normalize_or_zero()).abs() / speed;
    let alpha = sine.min(1.0).asin();
    0.5 * lattice.settings().density * drag.speed_times_coefficient(speed, chord, alpha) * wind
}
