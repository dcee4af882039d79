//! The circulation that all rings of a wing and its wake have in common, where the wake is cut.
//!
//! An edge whose flow separates sheds circulation of one sign beat after beat, and another edge as much of the
//! other. On a wing that sheds all around every ring then has a circulation that grows without end. It means
//! nothing: lattice and wakes are one closed surface, and what is common to its rings moves no air. But where
//! the oldest rows are dropped the surface ends, and along that end runs a vortex with all the circulation of
//! the rings: as if everything that ever was dropped lay there. In the flow it lies behind, spread over the way
//! it has gone. So what all rings of the oldest row have, the least of them where they have one sign, is taken
//! from all rings: nothing changes but that the vortex is gone, which is booked as cut. Where an edge holds,
//! its rings have none, and nothing is taken. A section of plane flow, the ends of which move no air, sheds all around
//! if both its edges do.

use crate::geometry::ShedAround;
use crate::lattice::Lattice;
use crate::state::{AirState, WakeSheet};
use crate::wake::account::free_rings;
use wingbeat_math::DVec3;

impl Lattice {
    /// Takes from wings that shed all around, and from their wakes, what all rings have in common, once rows
    /// were dropped.
    pub(crate) fn drop_common_circulation(&self, state: &mut AirState) {
        if self.settings().particles.is_some() {
            return; // rows that end become particles, with their circulation
        }
        for wing in self.shed_around() {
            let is_cut = |&k: &usize| (state.sheets[k].rows() as u64) < state.step;
            if wing.sheets.iter().all(is_cut) {
                self.take_common(wing, state);
            }
        }
    }

    fn take_common(&self, wing: &ShedAround, state: &mut AirState) {
        let (mut least, mut most, mut area) = (f64::INFINITY, f64::NEG_INFINITY, DVec3::ZERO);
        let (part, about) = (self.impulse_part(), self.impulse_point(DVec3::ZERO));
        for &k in &wing.sheets {
            let (sheet, signs) = (&state.sheets[k], &self.sheets()[k].signs);
            for (c, sign) in signs.iter().enumerate() {
                least = least.min(sign * sheet.gamma[c]);
                most = most.max(sign * sheet.gamma[c]);
                let [a, b] = [c, c + 1].map(|c| sheet.node(0, c) - about);
                area += part * sign * a.cross(b);
            }
        }
        let common = least.max(0.0) + most.min(0.0);
        if common == 0.0 {
            return;
        }
        let free = |state: &AirState| -> DVec3 {
            let sheets = wing.sheets.iter().map(|&k| &state.sheets[k]);
            sheets.map(|sheet| free_rings(sheet).impulse).sum()
        };
        let before = free(state);
        for p in &wing.panels {
            state.gamma[*p] -= common;
            state.gamma_before[*p] -= common;
        }
        for &k in &wing.sheets {
            take(&mut state.sheets[k], &self.sheets()[k].signs, common);
        }
        let density = self.settings().density;
        let [all, of_free] = [density * common * area, density * (before - free(state))];
        state.impulse.cut += all;
        state.free_impulse -= of_free;
        state.attached_impulse -= all - of_free;
    }
}

/// Takes a circulation, counted as that of panels, from all rings.
fn take(sheet: &mut WakeSheet, signs: &[f64], common: f64) {
    for row in sheet.gamma.chunks_mut(signs.len()) {
        for (gamma, sign) in row.iter_mut().zip(signs) {
            *gamma -= sign * common;
        }
    }
}
