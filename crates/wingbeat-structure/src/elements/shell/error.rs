//! What can be wrong with a shell.

use wingbeat_math::DVec3;

/// Why a shell cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShellError {
    /// A number of the material or of the section.
    #[error("shell: {name} is {value:e}; it must be {allowed}")]
    Material {
        /// Name of the field.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A corner is no node.
    #[error("shell: there is no node {node}, the structure has {nodes}")]
    NoNode {
        /// Number of the node.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// The corners lie on a line, or their order crosses itself.
    #[error("shell: the corners {corners:?} enclose no area; give at least three that go round")]
    NoArea {
        /// Corners \[m\], W components.
        corners: [DVec3; 4],
    },
    /// The fibre axis has no part in the tangent plane.
    #[error("shell: the fibre axis {axis} is along the normal {normal}; give one in the plane")]
    Axis {
        /// Fibre axis, W components.
        axis: DVec3,
        /// Normal, W components.
        normal: DVec3,
    },
    /// Points do not fit the lattice.
    #[error("shell: {found} points, of which all must be finite, where the lattice has {expected}")]
    Lattice {
        /// Number of points.
        found: usize,
        /// What rows and columns need.
        expected: usize,
    },
}

impl ShellError {
    /// Refuses a value that is not finite or not `allowed`.
    pub(super) fn require(
        name: &'static str,
        value: f64,
        ok: bool,
        allowed: &'static str,
    ) -> Result<(), Self> {
        if ok && value.is_finite() {
            Ok(())
        } else {
            Err(Self::Material {
                name,
                value,
                allowed,
            })
        }
    }
}
