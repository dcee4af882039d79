//! The grid of panels between the edges.

use crate::error::{ModelError, require_count};
use crate::mesh::{GridMesh, Side, Spacing};
use crate::planform::fit::fit;
use crate::planform::outline::Planform;
use wingbeat_math::DVec3;

/// A flat wing: planform and mesh density.
#[derive(Clone, Debug, PartialEq)]
pub struct WingShape {
    /// Outline.
    pub planform: Planform,
    /// Panels along the chord.
    pub rows: usize,
    /// Panels along the span.
    pub cols: usize,
    /// Spacing along the chord.
    pub chordwise: Spacing,
    /// Spacing along the span.
    pub spanwise: Spacing,
}

impl WingShape {
    /// With uniform spacing both ways.
    pub fn uniform(planform: Planform, rows: usize, cols: usize) -> Self {
        Self {
            planform,
            rows,
            cols,
            chordwise: Spacing::Uniform,
            spanwise: Spacing::Uniform,
        }
    }

    /// The mesh in the wing frame. The left wing is the mirror image of the right bit for bit.
    ///
    /// # Errors
    /// No panels, or a planform that is not allowed; `name` names the wing.
    pub fn mesh(&self, name: &str, side: Side) -> Result<GridMesh, ModelError> {
        let (rows, cols) = (self.rows, self.cols);
        require_count(&format!("{name}.rows"), rows, rows > 0, ">= 1")?;
        require_count(&format!("{name}.cols"), cols, cols > 0, ">= 1")?;
        let edges = self.planform.edges()?;
        let line = |j| edges.root + (edges.tip - edges.root) * self.spanwise.at(j, cols);
        let lines: Vec<f64> = (0..=cols).map(line).collect();
        let ends = fit(&edges, &lines)?;
        let mut nodes = Vec::with_capacity((rows + 1) * (cols + 1));
        for i in 0..=rows {
            let s = self.chordwise.at(i, rows);
            for (r, [lead, trail]) in lines.iter().zip(&ends) {
                let x = lead + (trail - lead) * s;
                nodes.push(DVec3::new(x, side.sign() * r, 0.0));
            }
        }
        let mesh = GridMesh {
            rows,
            cols,
            nodes,
            columns: self.spanwise,
        };
        mesh.check(name)?;
        Ok(mesh)
    }
}
