//! How the nodes of a sheet move.

use crate::error::AirError;
use crate::state::{WakeEvents, WakeSheet};
use crate::wake::move_step::{MoveStep, sum};
use wingbeat_math::DVec3;

/// Straight ways of points within a step: starts and ends [m], N components.
#[derive(Default)]
pub(crate) struct Paths {
    pub from: Vec<DVec3>,
    pub to: Vec<DVec3>,
}

/// What happened to one sheet within a step.
#[derive(Default)]
pub(crate) struct SheetMove {
    /// Of its nodes, row after row from the oldest on, those that were on the shedding edge at last.
    pub nodes: Paths,
    /// Where the nodes would have ended without surfaces in the way [m]; empty if none was held back.
    pub unhindered: Vec<DVec3>,
    /// Of its particles.
    pub particles: Paths,
    /// Impulse per density [m4/s], N components, that surfaces in the way took from its particles.
    pub taken: DVec3,
}

impl SheetMove {
    /// Fills sheet `k` with its moved nodes, those that were on the shedding edge being the new last row. Nodes that left
    /// the middle of a body, a column of the sheet, move as those that left the root do, until
    /// [`super::joined_nodes`] puts them between both roots'.
    ///
    /// # Errors
    /// Velocities that are not finite.
    pub(crate) fn move_nodes(
        &mut self,
        step: &MoveStep,
        (k, number): (usize, u64),
        sheet: &mut WakeSheet,
    ) -> Result<WakeEvents, AirError> {
        let limited = self.find_ends(step, (k, number), sheet)?;
        if step.looks_back {
            let (velocity, [first, _]) = (&step.flow.nodes.velocity, step.flow.first[k]);
            sheet.velocity.clear();
            for (i, &x) in self.nodes.from.iter().enumerate() {
                sheet
                    .velocity
                    .push(velocity.get(first + i) + step.stream(x));
            }
        }
        let near_surface = self.hold_back(step, k, sheet);
        sheet.nodes.clear();
        self.nodes.to.iter().for_each(|&x| sheet.nodes.push(x));
        Ok(WakeEvents {
            limited,
            near_surface,
            ..WakeEvents::default()
        })
    }

    /// Where the nodes go without surfaces in the way; returns how many displacements were shortened.
    fn find_ends(
        &mut self,
        step: &MoveStep,
        (k, number): (usize, u64),
        sheet: &WakeSheet,
    ) -> Result<u64, AirError> {
        let (rows, width) = (sheet.rows() + 1, sheet.columns + 1);
        let (flow, [first, _]) = (&step.flow.nodes, step.flow.first[k]);
        let Paths { from, to } = &mut self.nodes;
        from.clear();
        from.extend((first..first + rows * width).map(|n| flow.places.get(n)));
        to.clear();
        // A sheet with a middle has two columns of nodes.
        let middle = step.lattice.middle_column(k);
        let leads = |i: usize| i ^ usize::from(middle == Some(i % width));
        let mut limited = 0;
        for (i, &x) in from.iter().enumerate() {
            let (v, stream) = (flow.velocity.get(first + leads(i)), step.stream(x));
            let past = (i < sheet.velocity.len()).then(|| sheet.velocity.get(leads(i)));
            let change = past.map_or(DVec3::ZERO, |past| step.change * (v + stream - past));
            let (end, is_limited) = step.end(x, stream, v + change);
            if !end.is_finite() {
                return Err(AirError::WakeNotFinite {
                    step: number,
                    sheet: k,
                    row: rows - 1 - i / width,
                    column: i % width,
                    velocity: v,
                });
            }
            limited += u64::from(is_limited);
            to.push(end);
        }
        Ok(limited)
    }

    /// Keeps the nodes off surfaces; returns how many with strength it changed.
    fn hold_back(&mut self, step: &MoveStep, k: usize, sheet: &WakeSheet) -> u64 {
        let width = sheet.columns + 1;
        let Paths { from, to } = &mut self.nodes;
        self.unhindered.clear();
        self.unhindered.extend_from_slice(to);
        let has_strength = |i: usize| sheet.has_strength(i / width);
        let [all, strong] = match step.lattice.middle_column(k) {
            None => step.keep_clear((from, to), has_strength),
            // The middle is within the body.
            Some(middle) => (1 - middle..to.len())
                .step_by(width)
                .map(|i| step.keep_clear((&from[i..=i], &mut to[i..=i]), |_| has_strength(i)))
                .fold([0; 2], sum),
        };
        if all == 0 {
            self.unhindered.clear();
        }
        strong
    }

    /// Where a node of the sheet with its new row was before [m], N components; the last row was the shedding edge.
    pub(crate) fn node_before(&self, row: usize, sheet: &WakeSheet, column: usize) -> DVec3 {
        self.nodes.from[row * (sheet.columns + 1) + column]
    }
}
