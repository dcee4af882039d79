//! Mirror-symmetric flow computed on one half: whatever has a mirror image on the other side of a plane is
//! computed once and reflected.
//!
//! Nothing is left out of the sums: surfaces and wakes are there on both sides. Only the points
//! where velocities are wanted, the unknowns and the nodes that are moved are those of one half, so
//! sums cost half, the influence matrix a quarter, its factors an eighth, and the flow stays symmetric
//! bit for bit about a plane through the axes.

use crate::error::AirError;
use crate::geometry::topology::Topology;
use crate::images::{Mirror, Plane};
use wingbeat_math::{DVec3, largest};
use wingbeat_vortex::Points;

/// Largest distance of a node from the image of its partner, relative to the farthest node's from the
/// plane: far above round-off, far below anything an asymmetric motion does.
const TOLERANCE: f64 = 1e-7;

/// Which node and which panel is whose mirror image: pairs, so the image of every index has that index as its
/// image. The normals of paired panels are mirror images too.
#[derive(Clone, Debug, PartialEq)]
pub struct MirrorPairs {
    /// The plane of symmetry, N.
    pub plane: Plane,
    /// Mirror image of each node of all surfaces.
    pub node: Vec<usize>,
    /// Mirror image of each panel of all surfaces.
    pub panel: Vec<usize>,
}

/// Mirror pairs with all that follows from them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Symmetry {
    pub plane: Plane,
    pub mirror: Mirror,
    pub node: Vec<usize>,
    pub panel: Vec<usize>,
    /// Mirror image of each wake sheet.
    pub sheet: Vec<usize>,
    /// The panel of each pair that is computed, and the unknown of each panel.
    pub computed: Vec<usize>,
    pub unknown: Vec<usize>,
}

impl Symmetry {
    /// # Errors
    /// [`AirError::MirrorPairs`] names the first node, panel or sheet whose image does not fit.
    pub fn new(pairs: MirrorPairs, topology: &Topology) -> Result<Self, AirError> {
        let wrong = |what, index| Err(AirError::MirrorPairs { what, index });
        let MirrorPairs { plane, node, panel } = pairs;
        let Some(mirror) = Mirror::of(&plane) else {
            return wrong("plane", 0);
        };
        let nodes = *topology.first_node.last().unwrap_or(&0);
        if let Some(n) = first_misfit(&node, nodes) {
            return wrong("node", n);
        }
        if let Some(p) = first_misfit(&panel, topology.panels.len()) {
            return wrong("panel", p);
        }
        for (p, &q) in panel.iter().enumerate() {
            let image = topology.panels[p].map(|n| node[n]);
            if !runs_backward(image, topology.panels[q]) {
                return wrong("panel", p);
            }
        }
        let mut sheet = Vec::new();
        for (k, s) in topology.sheets.iter().enumerate() {
            let image: Vec<usize> = s.nodes.iter().map(|&n| node[n]).collect();
            match topology.sheets.iter().position(|t| t.nodes == image) {
                Some(other) if other != k => sheet.push(other),
                _ => return wrong("wake sheet", k),
            }
        }
        let computed: Vec<usize> = (0..panel.len()).filter(|&p| p <= panel[p]).collect();
        let mut unknown = vec![0; panel.len()];
        for (u, &p) in computed.iter().enumerate() {
            (unknown[p], unknown[panel[p]]) = (u, u);
        }
        Ok(Self {
            plane,
            mirror,
            node,
            panel,
            sheet,
            computed,
            unknown,
        })
    }

    /// # Errors
    /// [`AirError::Asymmetric`] names the first node that is not where the image of its partner is.
    pub fn check(&self, position: &[DVec3], step: u64) -> Result<(), AirError> {
        let far = |x: &DVec3| self.plane.height(*x).abs();
        let allowed = TOLERANCE * largest(position.iter().map(far));
        for (node, &image) in self.node.iter().enumerate() {
            let reflected = self.mirror.point(position[image]);
            let distance = position[node].distance(reflected);
            if distance.is_nan() || distance > allowed {
                return Err(AirError::Asymmetric {
                    step,
                    node,
                    image,
                    distance,
                });
            }
        }
        Ok(())
    }

    /// Values of the computed panels, which stand first, go to their panels and to the images of these.
    pub fn spread_in_place(&self, values: &mut [f64]) {
        // Panel p has no later unknown than p, and an image its partner's.
        for &p in self.computed.iter().rev() {
            values[p] = values[self.unknown[p]];
        }
        for p in 0..values.len() {
            let computed = p.min(self.panel[p]);
            values[p] = values[computed];
        }
    }

    /// Velocities at the computed panels, and reflected at their images.
    pub fn reflect(&self, computed: &Points, all: &mut Points) {
        all.reset(self.panel.len());
        for (u, &p) in self.computed.iter().enumerate() {
            let v = computed.get(u);
            all.set(self.panel[p], self.mirror.vector(v));
            all.set(p, v);
        }
    }
}

/// Whether the panel with corners `b` has the edges of `a`, run the other way round: so its normal
/// is the mirror image of that of the panel whose image `a` is.
fn runs_backward(a: [usize; 4], b: [usize; 4]) -> bool {
    let edges = |c: [usize; 4]| (0..4).map(move |i| [c[i], c[(i + 1) % 4]]);
    edges(a).all(|[from, to]| from == to || edges(b).any(|e| e == [to, from]))
}

/// First index that is not the image of its image.
fn first_misfit(image: &[usize], count: usize) -> Option<usize> {
    if image.len() != count {
        return Some(image.len().min(count));
    }
    (0..count).find(|&i| image.get(image[i]) != Some(&i))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_places_that_are_not_numbers() {
        let (point, normal) = (DVec3::ZERO, DVec3::Y);
        let plane = Plane { point, normal };
        let pair = Symmetry {
            plane,
            mirror: Mirror::of(&plane).expect("a plane"),
            node: vec![1, 0],
            panel: vec![],
            sheet: vec![],
            computed: vec![],
            unknown: vec![],
        };
        assert_eq!(pair.check(&[DVec3::Y, -DVec3::Y], 0), Ok(()));
        for k in 0..2 {
            let mut position = [DVec3::Y, -DVec3::Y];
            position[k].x = f64::NAN;
            let said = pair.check(&position, 0);
            assert!(matches!(said, Err(AirError::Asymmetric { .. })), "{k}");
        }
    }
}
