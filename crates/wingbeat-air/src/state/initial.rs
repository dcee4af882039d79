//! The state of air at rest, and whether a state fits a lattice.

use crate::error::AirError;
use crate::geometry::{NodeMotion, Sheet};
use crate::lattice::Lattice;
use crate::state::air_state::AirState;
use crate::state::inner_flow::InnerFlow;
use crate::state::particles::is_whole;
use crate::state::wake_sheet::WakeSheet;

impl Lattice {
    /// Air without circulation and wake around the surfaces as they are: the start from rest.
    pub fn initial_state(&self, motion: &NodeMotion) -> AirState {
        let sheet = |root: &Sheet| WakeSheet {
            columns: root.panels.len(),
            is_closed: root.is_closed(),
            converted: vec![0; root.panels.len()],
            ..WakeSheet::default()
        };
        AirState {
            gamma: vec![0.0; self.panel_count()],
            gamma_before: vec![0.0; self.panel_count()],
            position: motion.position.clone(),
            velocity: motion.velocity.clone(),
            inner: vec![InnerFlow::REST; self.surfaces().len()],
            inner_before: vec![InnerFlow::REST; self.surfaces().len()],
            hold: vec![f64::MAX; self.strips().len()],
            leaving: vec![0.0; self.strips().len()],
            fed: vec![0.0; self.strips().len()],
            sheets: self.sheets().iter().map(sheet).collect(),
            ..AirState::default()
        }
    }

    /// Checks that a state, perhaps read from a file, has the shape this lattice needs.
    ///
    /// # Errors
    /// [`AirError::StateMismatch`] says what differs.
    pub fn check_state(&self, state: &AirState) -> Result<(), AirError> {
        let mismatch = |what| Err(AirError::StateMismatch { what });
        let panels = self.panel_count();
        if state.gamma.len() != panels || state.gamma_before.len() != panels {
            return mismatch("number of panels");
        }
        if [&state.position, &state.velocity]
            .iter()
            .any(|x| x.len() != self.node_count())
        {
            return mismatch("number of nodes");
        }
        if [&state.hold, &state.leaving, &state.fed]
            .iter()
            .any(|x| x.len() != self.strips().len())
        {
            return mismatch("number of leading-edge strips");
        }
        if state.hold.iter().any(|hold| hold.is_nan() || *hold < 0.0) {
            return mismatch("circulation that leading edges hold");
        }
        if [&state.inner, &state.inner_before]
            .iter()
            .any(|x| x.len() != self.surfaces().len())
        {
            return mismatch("number of surfaces");
        }
        let fits = |(sheet, root): (&WakeSheet, &Sheet)| {
            sheet.columns == root.panels.len()
                && sheet.is_closed == root.is_closed()
                && [&sheet.nodes, &sheet.velocity].into_iter().all(is_whole)
                && sheet.nodes.len() == sheet.rows() * (sheet.columns + 1)
                && sheet.gamma.len() == sheet.rows() * sheet.columns
                && (sheet.velocity.is_empty() || sheet.velocity.len() == sheet.nodes.len())
                && sheet.converted.len() == sheet.columns
                && sheet.converted.iter().all(|&c| c < sheet.rows().max(1))
                && sheet.particles.is_sound()
                && (sheet.particles.is_empty() || self.settings().particles.is_some())
        };
        if state.sheets.len() != self.sheets().len()
            || !state.sheets.iter().zip(self.sheets()).all(fits)
        {
            return mismatch("wake sheets");
        }
        Ok(())
    }
}
