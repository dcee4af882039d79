//! Velocity at the nodes of the wakes.

use crate::lattice::Lattice;
use crate::state::AirState;
use crate::wake::filaments::Filaments;
use crate::wake::force_free::ForceFree;
use crate::wake::summation::Sums;
use std::ops::Range;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Velocity at all nodes that are moved (mirror images are reflected later), sheet after sheet.
#[derive(Default)]
pub(crate) struct NodeFlow {
    /// The nodes [m], N components: row after row from the oldest on, the shedding edge at last.
    pub places: Points,
    /// Without the undisturbed air [m/s], N components.
    pub velocity: Points,
    /// Middles of the rows of plane wakes, once for every node.
    middles: Points,
    force_free: ForceFree,
}

impl NodeFlow {
    /// Takes the velocities of the accepted step, whose filaments have their circulations; `sums` hold them.
    pub(crate) fn take(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        sums: &mut Sums,
    ) {
        filaments.movable(lattice, state, &mut self.places);
        self.velocity.reset(self.places.len());
        let is_plane = lattice.settings().plane_wakes;
        if is_plane {
            self.find_middles(lattice, state);
        }
        let places = if is_plane {
            &self.middles
        } else {
            &self.places
        };
        let velocity = &mut self.velocity;
        if lattice.settings().is_symmetric() {
            (self.force_free).add_velocity(lattice, state, filaments, sums, places, velocity);
        } else {
            sums.add_at_wakes(places, lattice.mirrors(), velocity);
        }
        if is_plane {
            for row in rows(lattice, state) {
                make_plane(row, &self.places, velocity);
            }
        }
    }

    /// Where the flow is plane: in the middle of each row, far from its ends.
    fn find_middles(&mut self, lattice: &Lattice, state: &AirState) {
        self.middles.clone_from(&self.places);
        for row in rows(lattice, state) {
            let ends = [row.start, row.end - 1].map(|n| self.places.get(n));
            row.for_each(|n| self.middles.set(n, ends[0].midpoint(ends[1])));
        }
    }
}

/// Numbers of the nodes of every row of wake that is moved, the shedding edge among them.
fn rows<'a>(lattice: &'a Lattice, state: &'a AirState) -> impl Iterator<Item = Range<usize>> + 'a {
    let sheets = state.sheets.iter().enumerate();
    let moved = sheets.filter(|(k, _)| lattice.reflected_sheet(*k).is_none());
    let widths = moved.flat_map(|(_, sheet)| (0..=sheet.rows()).map(|_| sheet.columns + 1));
    widths.scan(0, |end, width| {
        *end += width;
        Some(*end - width..*end)
    })
}

/// Gives the nodes of a row of wake their mean velocity, without its part along the row.
fn make_plane(row: Range<usize>, nodes: &Points, velocity: &mut Points) {
    let mean = row.clone().map(|n| velocity.get(n)).sum::<DVec3>() / row.len() as f64;
    let along = nodes.get(row.end - 1) - nodes.get(row.start);
    let across = mean - mean.project_onto(along);
    row.for_each(|n| velocity.set(n, across));
}
