//! What a sum costs.

/// Work of a sum.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Work {
    /// Evaluations of expansions at targets, of grids on grids, or of meshes at targets.
    pub far: u64,
    /// Pairs of filament and target.
    pub near: u64,
}

impl std::ops::Add for Work {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            far: self.far + other.far,
            near: self.near + other.near,
        }
    }
}
