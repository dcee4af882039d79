//! Whether a mesh is the closed surface of a solid.

use crate::error::{ModelError, require_count};
use crate::mesh::QuadMesh;
use crate::mesh::integrate::volume;

impl QuadMesh {
    /// Panels, finite nodes, each edge shared by exactly two panels in opposite directions, one
    /// piece, normals outward.
    ///
    /// # Errors
    /// The first condition that fails.
    pub fn check_closed(&self, name: &str) -> Result<(), ModelError> {
        let key = format!("{name}.panels");
        require_count(&key, self.quads.len(), !self.quads.is_empty(), ">= 1")?;
        self.check_panels(name)?;
        self.check_edges(name)?;
        self.check_one_piece(name)?;
        let volume = volume(self);
        if volume > 0.0 {
            return Ok(());
        }
        Err(ModelError::Inward {
            part: name.to_owned(),
            volume,
        })
    }
}
