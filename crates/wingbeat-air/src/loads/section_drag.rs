//! Drag of the sections of wings at low Reynolds number, which an inviscid lattice lacks.
//!
//! Every strip behind the leading edge feels `D = 1/2 rho A (|U_t| U_t C_f + |U| U (cd0 + cd2 alpha^2))`, A its
//! area, U the velocity of the undisturbed air past it and U_t the part of U along the strip:
//!
//! - C_f is the friction of a laminar flat plate, see [`SectionDrag::speed_times_friction`]: attached boundary
//!   layers in steady flow, Re from 10 to about 5e5. Where the flow leaves the leading edge, the face behind it
//!   lies in a bubble whose flow goes to and fro along it: of the friction of that face acts what the edge
//!   holds of the suction of a plate at the angle alpha. (The force along a robot's wing falls with its
//!   incidence from 0.4 to nothing at 45 deg in the fit of Deng et al. 2006, IEEE Trans. Robot. 22:776.)
//! - `cd0 + cd2 alpha^2` is a polar of the user's, alpha the angle between U and the strip.
//!
//! U is that of stream and motion at the control points, their mean over the strip by area: what wing and wakes
//! induce is left out. The length in C_f is that of the strip's column of panels, however it stands on the
//! edge. The lattice has the pressure drag of a wing at incidence already; the polar is for what it lacks. The
//! force is spread over the panels of the strip by their area.

use crate::geometry::{Strip, column, vector_area};
use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use crate::settings::SectionDrag;
use wingbeat_math::DVec3;

/// Adds the drag of the sections to the forces of the panels.
pub(crate) fn add_section_drag(lattice: &Lattice, position: &[DVec3], out: &mut AirLoads) {
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
    vector_area(&x).length()
}

/// Force per area of a strip [Pa], N components.
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
    let (wind, normal) = (flow / whole, normal.normalize_or_zero());
    let (speed, chord) = (wind.length(), column(strip, position).length());
    if speed == 0.0 || chord == 0.0 {
        return DVec3::ZERO;
    }
    let through = wind.dot(normal);
    let along = wind - through * normal;
    let alpha = (through.abs() / speed).min(1.0).asin();
    let felt = lattice.settings().friction_felt(alpha);
    let friction = felt * drag.speed_times_friction(along.length(), chord) * along;
    0.5 * lattice.settings().density * (friction + speed * drag.profile(alpha) * wind)
}
