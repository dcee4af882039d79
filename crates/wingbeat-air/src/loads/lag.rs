//! How far behind its rings a lattice's forces act.
//!
//! A lattice whose flow leaves one edge smoothly stands for a plate with its vortices at a quarter and its
//! control points at three quarters of every panel, counted towards that edge: then circulation and moment of a
//! flat plate in plane flow are exact on any number of panels [James 1972, Comput. Methods Appl. Mech. Eng.
//! 1:59; Katz & Plotkin, Low-Speed Aerodynamics, sec. 11.1]. Rings that lie on the edges of the panels have
//! them at zero and at half: they are those of a wing a quarter panel ahead, and what they feel acts a quarter
//! panel farther aft. Where the flow leaves both edges or none, neither side has an advantage; what leaves an
//! edge whose suction is solved for is vorticity beside an attached wing. What left is that of the step before;
//! as far as nothing moved then, nothing has.

use crate::lattice::Lattice;
use crate::loads::values::AirLoads;
use crate::settings::LeadingEdge;
use crate::state::AirState;
use crate::wake::Filaments;
use wingbeat_math::DVec3;

/// Vortices lie so far behind the front of the panel they stand for, in panels.
const VORTEX: f64 = 0.25;

/// Moves the forces of all strips from the rings to where they act: by [`VORTEX`] towards the edge that the
/// flow leaves, less what the rings are moved already.
pub(crate) fn add_lag(
    lattice: &Lattice,
    state: &AirState,
    filaments: &Filaments,
    position: &[DVec3],
    out: &mut AirLoads,
) {
    let (topology, settings) = (lattice.topology(), lattice.settings());
    let known = lattice.known_part(state, &out.gamma);
    let middle = |n: [usize; 2]| position[n[0]].midpoint(position[n[1]]);
    for (k, strip) in lattice.strips().iter().enumerate() {
        let leading = &topology.edges[strip.edge];
        let aft = f64::from(settings.shedding.trailing);
        let forward = match (leading.wake, settings.leading) {
            (None, _) => 0.0,
            (_, LeadingEdge::SuctionImplicit { .. }) => 0.0,
            _ => known * (1.0 - lattice.held_of_strip(state, k, &filaments.newest)),
        };
        let part = VORTEX * (aft - forward) - settings.ring_shift();
        if part == 0.0 {
            continue;
        }
        for (&p, sides) in strip.panels.iter().zip(strip.sides.windows(2)) {
            let lag = part * (middle(sides[1]) - middle(sides[0]));
            out.couple[p] += lag.cross(out.force[p]);
        }
    }
}
