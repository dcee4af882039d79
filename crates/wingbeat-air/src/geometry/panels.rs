//! Geometry and motion of the panels at one instant.

use crate::error::AirError;
use crate::geometry::control::Controls;
use crate::geometry::corners::{two_triangles, vector_area};
use crate::geometry::node_motion::NodeMotion;
use crate::geometry::topology::Topology;
use wingbeat_math::DVec3;

/// Panels at one instant, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panels {
    /// Control points [m]: where panels are equal the mean of the corners of the ring, else three quarters of the panel
    /// along the chord, and midway in the angle across columns of cosine spacing.
    pub point: Vec<DVec3>,
    /// Velocity of the control points with the surface [m/s].
    pub velocity: Vec<DVec3>,
    /// Unit normals at the control points, N components \[1\].
    pub normal: Vec<DVec3>,
    /// Areas, as two triangles [m2].
    pub area: Vec<f64>,
    /// Vector areas, half the cross product of the diagonals [m2].
    pub vector_area: Vec<DVec3>,
}

impl Panels {
    fn clear(&mut self) {
        self.point.clear();
        self.velocity.clear();
        self.normal.clear();
        self.area.clear();
        self.vector_area.clear();
    }

    /// Root of the mean area [m].
    pub(crate) fn size(&self) -> f64 {
        (self.area.iter().sum::<f64>() / self.area.len().max(1) as f64).sqrt()
    }

    /// Fills in all panels, between the nodes of their rings.
    ///
    /// # Errors
    /// Panels without area, with an edge without length, with crossing sides.
    pub(crate) fn update(
        &mut self,
        (topology, controls): (&Topology, &Controls),
        motion: &NodeMotion,
        step: u64,
    ) -> Result<(), AirError> {
        self.clear();
        for (p, corners) in topology.panels.iter().enumerate() {
            let x = corners.map(|n| motion.position[n]);
            let v = corners.map(|n| motion.velocity[n]);
            let named = || topology.locate_panel(p);
            if let Some(nodes) = coincident(corners, &x) {
                let (surface, panel) = named();
                let [from, to] = nodes.map(|n| topology.locate_node(n).1);
                return Err(AirError::NoLength {
                    step,
                    surface,
                    panel,
                    from,
                    to,
                });
            }
            if is_crossed(&x) {
                let (surface, panel) = named();
                return Err(AirError::Crossed {
                    step,
                    surface,
                    panel,
                });
            }
            let vector_area = vector_area(&x);
            let normal = controls.normal(p, corners, &motion.position);
            let normal = normal.ok_or_else(|| {
                let (surface, panel) = named();
                AirError::FlatPanel {
                    step,
                    surface,
                    panel,
                }
            })?;
            self.point.push(controls.point(p, corners, &x));
            self.velocity.push(controls.point(p, corners, &v));
            self.normal.push(normal);
            self.area.push(two_triangles(&x));
            self.vector_area.push(vector_area);
        }
        Ok(())
    }
}

/// Neighbouring corners, not the same node, on one place.
fn coincident(corners: &[usize; 4], x: &[DVec3; 4]) -> Option<[usize; 2]> {
    (0..4)
        .map(|k| (k, (k + 1) % 4))
        .find(|&(a, b)| corners[a] != corners[b] && x[a] == x[b])
        .map(|(a, b)| [corners[a], corners[b]])
}

/// Whether two sides cross: then either diagonal cuts the panel into triangles that face opposite
/// ways. (Where the panel is merely concave, one of the diagonals does not.)
fn is_crossed(x: &[DVec3; 4]) -> bool {
    let face = |a: usize, b: usize, c: usize| (x[b] - x[a]).cross(x[c] - x[a]);
    face(0, 1, 2).dot(face(0, 2, 3)) < 0.0 && face(1, 2, 3).dot(face(1, 3, 0)) < 0.0
}
