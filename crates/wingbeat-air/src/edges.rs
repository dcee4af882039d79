//! The edges of a wing, and which of them shed wakes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which edge of a wing a shedding segment belongs to.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum EdgeKind {
    /// Trailing edge.
    Trailing,
    /// Wing tip.
    Tip,
    /// Leading edge.
    Leading,
    /// Wing root.
    Root,
}

/// Which kinds of edges shed wakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheddingKinds {
    /// Trailing edges shed.
    pub trailing: bool,
    /// Tips shed.
    pub tip: bool,
    /// Leading edges shed.
    pub leading: bool,
    /// Roots shed.
    pub root: bool,
}

impl SheddingKinds {
    /// Only the trailing edge, the published benchmark's.
    pub const TRAILING: Self = Self {
        trailing: true,
        tip: false,
        leading: false,
        root: false,
    };

    /// Whether any edge sheds a wake.
    pub fn any(self) -> bool {
        self != Self::NONE
    }

    /// None: flow without circulation about the wings.
    pub const NONE: Self = Self {
        trailing: false,
        ..Self::TRAILING
    };

    /// Whether this kind sheds.
    pub fn sheds(&self, kind: EdgeKind) -> bool {
        match kind {
            EdgeKind::Trailing => self.trailing,
            EdgeKind::Tip => self.tip,
            EdgeKind::Leading => self.leading,
            EdgeKind::Root => self.root,
        }
    }
}
