//! Circulations from the influence equations: by iteration from what surfaces do to themselves, or by factors.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::solve::row_blocks::RowBlocks;
use crate::solve::self_influence::SelfInfluence;
use crate::solve::unknowns::panel;
use crate::state::AirState;
use wingbeat_math::{BiCgStab, DenseLu};

/// Memory of the solution.
#[derive(Default)]
pub(crate) struct Circulation {
    /// Right-hand side and circulations, of one half where only that is computed.
    wanted: Vec<f64>,
    found: Vec<f64>,
    iterations: BiCgStab,
    rows: Vec<f64>,
    lu: DenseLu,
    /// Whether the equations were solved by factors, which are there.
    by_factors: bool,
}

impl Circulation {
    /// Solves for the circulations in place of the right-hand side, one for each unknown.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(crate) fn solve(
        &mut self,
        (lattice, known): (&Lattice, &[SelfInfluence]),
        state: &AirState,
        matrix: &RowBlocks,
        gamma: &mut [f64],
    ) -> Result<(), AirError> {
        // From the circulations of the state, which do not depend on what was tried before.
        self.found.clear();
        (self.found).extend((0..gamma.len()).map(|i| state.gamma[panel(lattice, i)]));
        self.wanted.clear();
        self.wanted.extend_from_slice(gamma);
        self.by_factors = !self.iterate(known, matrix);
        if self.by_factors {
            self.eliminate(matrix, state)?;
        }
        gamma.copy_from_slice(&self.found);
        Ok(())
    }

    /// The same for another right-hand side of the same equations.
    ///
    /// # Errors
    /// The matrix is singular.
    pub(crate) fn solve_another(
        &mut self,
        known: &[SelfInfluence],
        state: &AirState,
        matrix: &RowBlocks,
        gamma: &mut [f64],
    ) -> Result<(), AirError> {
        if self.by_factors {
            self.lu.solve_in_place(gamma);
            return Ok(());
        }
        self.found.clear();
        self.found.resize(gamma.len(), 0.0);
        self.wanted.clear();
        self.wanted.extend_from_slice(gamma);
        if !self.iterate(known, matrix) {
            self.by_factors = true;
            self.eliminate(matrix, state)?;
        }
        gamma.copy_from_slice(&self.found);
        Ok(())
    }

    /// False if not all surfaces are known, or if it does not get there.
    fn iterate(&mut self, known: &[SelfInfluence], matrix: &RowBlocks) -> bool {
        let count: usize = known.iter().map(|k| k.unknowns.len()).sum();
        if count < self.wanted.len() {
            return false;
        }
        let multiply = |x: &[f64], out: &mut [f64]| matrix.multiply(x, out);
        let nearly_divide = |x: &[f64], out: &mut [f64]| {
            for k in known {
                let these = k.unknowns.clone();
                k.inverse.multiply(&x[these.clone()], &mut out[these]);
            }
        };
        let (wanted, found) = (&self.wanted, &mut self.found);
        (self.iterations).solve(&multiply, &nearly_divide, wanted, found)
    }

    /// By factors of the whole matrix.
    fn eliminate(&mut self, matrix: &RowBlocks, state: &AirState) -> Result<(), AirError> {
        let n = matrix.order();
        matrix.to_rows(&mut self.rows);
        self.lu.resize(n);
        let singular = |source| AirError::Singular {
            step: state.step,
            source,
        };
        self.lu.factor(&self.rows).map_err(singular)?;
        self.found.clone_from(&self.wanted);
        self.lu.solve_in_place(&mut self.found);
        Ok(())
    }

    /// Whether factors were ever needed.
    #[cfg(test)]
    pub(crate) fn has_factors(&self) -> bool {
        self.lu.order() > 0
    }
}
