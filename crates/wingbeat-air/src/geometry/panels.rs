//! Geometry and motion of the panels at one instant.

use crate::error::AirError;
use crate::geometry::node_motion::NodeMotion;
use crate::geometry::topology::Topology;
use wingbeat_math::DVec3;

/// Panels at one instant, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Panels {
    /// Control points, the mean of the corners [m].
    pub point: Vec<DVec3>,
    /// Velocity of the control points with the surface [m/s].
    pub velocity: Vec<DVec3>,
    /// Unit normals, along the cross product of the diagonals, N components \[1\].
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
        topology: &Topology,
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
            let normal = vector_area.try_normalize().ok_or_else(|| {
                let (surface, panel) = named();
                AirError::FlatPanel {
                    step,
                    surface,
                    panel,
                }
            })?;
            self.point.push(mean_corner(corners, &x));
            self.velocity.push(mean_corner(corners, &v));
            self.normal.push(normal);
            self.area.push(two_triangles(&x));
            self.vector_area.push(vector_area);
        }
        Ok(())
    }
}

/// Control point and unit normal of a panel with these corners; none without area.
pub(crate) fn point_and_normal(corners: &[usize; 4], nodes: &[DVec3]) -> Option<[DVec3; 2]> {
    let x = corners.map(|n| nodes[n]);
    let normal = vector_area(&x).try_normalize()?;
    Some([mean_corner(corners, &x), normal])
}

/// Half the cross product of the diagonals.
pub(crate) fn vector_area(x: &[DVec3; 4]) -> DVec3 {
    0.5 * (x[2] - x[0]).cross(x[3] - x[1])
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

/// The first of the two places among the corners that a triangle's repeated corner has.
fn repeated(corners: &[usize; 4]) -> Option<usize> {
    (0..4).find(|&k| corners[k] == corners[(k + 1) % 4])
}

/// Weights of the corners in their mean: a repeated corner counts once, half at each of its places.
pub(crate) fn corner_weights(corners: &[usize; 4]) -> [f64; 4] {
    let Some(k) = repeated(corners) else {
        return [0.25; 4];
    };
    let is_repeated = |j: usize| j == k || j == (k + 1) % 4;
    std::array::from_fn(|j| if is_repeated(j) { 1.0 / 6.0 } else { 1.0 / 3.0 })
}

/// Mean over the corners, a repeated corner counted once.
pub(super) fn mean_corner(corners: &[usize; 4], x: &[DVec3; 4]) -> DVec3 {
    let sum = (x[0] + x[1]) + (x[2] + x[3]);
    match repeated(corners) {
        Some(k) => (sum - x[k]) / 3.0,
        None => 0.25 * sum,
    }
}

/// Area of the triangles (0, 1, 2) and (0, 2, 3).
fn two_triangles(x: &[DVec3; 4]) -> f64 {
    let d = x[2] - x[0];
    0.5 * ((x[1] - x[0]).cross(d).length() + d.cross(x[3] - x[0]).length())
}
