//! How sources are summed, and what a sum tells of itself.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cores::CoreModel;
use crate::instruction_set::InstructionSet;

/// How to sum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The one that is fastest at this size.
    #[default]
    Auto,
    /// Every source at every target, in double precision.
    Direct,
    /// Every source at every target, in single precision; in double where the tolerance wants that.
    Single,
    /// Far sources by cells, near ones in single precision if the tolerance allows it.
    Tree,
    /// Filaments of wide algebraic cores by Gaussians on meshes, narrow ones in single precision; the tolerance
    /// is at least 1e-3.
    Mesh,
}

/// Settings of a [`FastSum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FastSettings {
    /// Regularisation.
    pub model: CoreModel,
    /// Allowed error: root mean square over targets, relative to that of the velocity.
    pub tolerance: f64,
    /// Direct, in single precision, by a tree or by meshes.
    pub method: Method,
    /// Vector instructions.
    pub instructions: InstructionSet,
}

impl FastSettings {
    /// Tolerance 1e-4, method and instructions chosen by themselves.
    pub fn new(model: CoreModel) -> Self {
        let instructions = InstructionSet::Best;
        Self {
            model,
            tolerance: 1e-4,
            method: Method::Auto,
            instructions,
        }
    }
}

/// Sums that were checked so far, and what was made in vain for them: a slow sum, not a wrong one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Sums for which a faster way than one by one in double precision was tried \[1\].
    pub checked: u64,
    /// Sums at all targets that were thrown away, their error being above the tolerance \[1\].
    pub discarded: u64,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.checked += other.checked;
        self.discarded += other.discarded;
    }
}

/// What a sum did and how well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// How it was summed, never [`Method::Auto`].
    pub method: Method,
    /// Root mean square of the error at the sampled targets, relative to that of the velocity there \[1\].
    pub error_rms: f64,
    /// Largest error at a sampled target, relative to the root mean square of the velocity \[1\].
    pub error_max: f64,
    /// Targets sampled; 0 for the direct sum, which has no error to speak of.
    pub samples: usize,
    /// Attempts it took to keep the tolerance.
    pub attempts: usize,
    /// Evaluations of an expansion (cell, target).
    pub far: u64,
    /// Evaluations of the kernel (edge, target), the check not included.
    pub near: u64,
}
