//! Mirror-symmetric flow computed on one half: whatever has a twin on the other side of a plane is
//! computed once and reflected.
//!
//! Nothing is left out of the sums: surfaces and wakes are there on both sides. Only the places
//! where velocities are wanted, the unknowns and the nodes that are moved are those of the *lead*
//! half, so sums cost half, the influence matrix a quarter, its factors an eighth, and the flow
//! stays symmetric bit for bit about a plane through the axes.

use crate::error::AirError;
use crate::images::{Mirror, Plane};
use crate::state::NodeMotion;
use crate::topology::Topology;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Largest distance of a node from the image of its twin, relative to the farthest node's from the
/// plane: far above round-off, far below anything an asymmetric motion does.
const TOLERANCE: f64 = 1e-7;

/// Which node and which panel is whose mirror image. Every index is its twin's twin; the normals of
/// twin panels are mirror images too.
#[derive(Clone, Debug, PartialEq)]
pub struct Twins {
    /// The plane of symmetry, N.
    pub plane: Plane,
    /// Twin of each node of all surfaces.
    pub node: Vec<usize>,
    /// Twin of each panel of all surfaces.
    pub panel: Vec<usize>,
}

/// Twins with all that follows from them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Halves {
    pub plane: Plane,
    pub mirror: Mirror,
    pub node: Vec<usize>,
    pub panel: Vec<usize>,
    /// Twin of each wake sheet.
    pub sheet: Vec<usize>,
    /// The panel of each pair that is computed, and the unknown of each panel.
    pub lead: Vec<usize>,
    pub unknown: Vec<usize>,
}

impl Halves {
    /// # Errors
    /// [`AirError::Twins`] names the first node, panel or sheet whose twin does not fit.
    pub fn new(twins: Twins, topology: &Topology) -> Result<Self, AirError> {
        let wrong = |what, index| Err(AirError::Twins { what, index });
        let Twins { plane, node, panel } = twins;
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
                Some(twin) if twin != k => sheet.push(twin),
                _ => return wrong("wake sheet", k),
            }
        }
        let lead: Vec<usize> = (0..panel.len()).filter(|&p| p <= panel[p]).collect();
        let mut unknown = vec![0; panel.len()];
        for (u, &p) in lead.iter().enumerate() {
            (unknown[p], unknown[panel[p]]) = (u, u);
        }
        Ok(Self {
            plane,
            mirror,
            node,
            panel,
            sheet,
            lead,
            unknown,
        })
    }

    /// # Errors
    /// [`AirError::Asymmetric`] names the first node that is not where the image of its twin is.
    pub fn check(&self, motion: &NodeMotion, step: u64) -> Result<(), AirError> {
        let far = |x: &DVec3| self.plane.height(*x).abs();
        let size = motion.position.iter().map(far).fold(0.0, f64::max);
        for (node, &twin) in self.node.iter().enumerate() {
            let image = self.mirror.place(motion.position[twin]);
            let distance = motion.position[node].distance(image);
            if distance > TOLERANCE * size {
                return Err(AirError::Asymmetric {
                    step,
                    node,
                    twin,
                    distance,
                });
            }
        }
        Ok(())
    }

    /// Values of the lead panels go to their twins too.
    pub fn spread(&self, lead: &[f64], all: &mut [f64]) {
        for (p, value) in all.iter_mut().enumerate() {
            *value = lead[self.unknown[p]];
        }
    }

    /// Velocities at the lead panels, and reflected at their twins.
    pub fn reflect(&self, lead: &Points, all: &mut Points) {
        all.reset(self.panel.len());
        for (u, &p) in self.lead.iter().enumerate() {
            let v = lead.get(u);
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

/// First index that is no twin of its twin.
fn first_misfit(twin: &[usize], count: usize) -> Option<usize> {
    if twin.len() != count {
        return Some(twin.len().min(count));
    }
    (0..count).find(|&i| twin.get(twin[i]) != Some(&i))
}
