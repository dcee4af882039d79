//! Circulations from the influence equations: by iteration from what surfaces do to themselves, or by factors.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::solve::row_blocks::RowBlocks;
use crate::solve::self_influence::SelfInfluence;
use crate::solve::unknowns::{panel, unknowns};
use crate::state::AirState;
use wingbeat_math::{BiCgStab, DenseLu, LuError};

/// Memory of the solution.
#[derive(Default)]
pub(crate) struct Circulation {
    /// Right-hand side and circulations, of one half where only that is computed.
    wanted: Vec<f64>,
    found: Vec<f64>,
    iterations: BiCgStab,
    rows: Vec<f64>,
    lu: DenseLu,
}

impl Circulation {
    /// Solves for the circulations in place of the right-hand side, which stands in the first unknowns.
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
        self.wanted.clear();
        self.wanted.extend(&gamma[..unknowns(lattice)]);
        if !self.iterate((lattice, known), state, matrix) {
            let singular = |source| AirError::Singular {
                step: state.step,
                source,
            };
            self.eliminate(matrix).map_err(singular)?;
        }
        match lattice.symmetry() {
            None => gamma.copy_from_slice(&self.found),
            Some(symmetry) => symmetry.spread(&self.found, gamma),
        }
        Ok(())
    }

    /// Starts from the circulations of the state, which do not depend on what was tried before; false if not all
    /// surfaces are known, or if it does not get there.
    fn iterate(
        &mut self,
        (lattice, known): (&Lattice, &[SelfInfluence]),
        state: &AirState,
        matrix: &RowBlocks,
    ) -> bool {
        let (count, n): (usize, _) = (
            known.iter().map(|k| k.unknowns.len()).sum(),
            unknowns(lattice),
        );
        if count < n {
            return false;
        }
        self.found.clear();
        (self.found).extend((0..n).map(|i| state.gamma[panel(lattice, i)]));
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
    fn eliminate(&mut self, matrix: &RowBlocks) -> Result<(), LuError> {
        let n = matrix.order();
        matrix.to_rows(&mut self.rows);
        if self.lu.order() != n {
            self.lu = DenseLu::new(n);
        }
        self.lu.factor(&self.rows)?;
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
