//! Surfaces joined along an edge: two halves of one lifting surface.
//!
//! The edges of a seam are interior edges like any other: filaments with the difference of the
//! circulations on either side, so no vortex leaves there and the sheet is continuous. The nodes of
//! the seam exist on both surfaces, and so do the wake nodes they leave; both are kept on one place.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::state::{NodeMotion, WakeSheet};
use crate::surface::Surface;
use crate::topology::{Sheet, Topology};
use wingbeat_math::DVec3;

/// How far the two nodes of a seam may be apart, in panel sizes: far above round-off, far below what
/// changes any velocity.
const TOLERANCE: f64 = 1e-6;

/// An edge line that two open surfaces share. Their normals must agree across it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seam {
    /// Numbers of the surfaces.
    pub surfaces: [usize; 2],
    /// Nodes along the line, each counted in its surface: one of the first, one of the second.
    pub nodes: Vec<[usize; 2]>,
}

/// Two columns of wake nodes that left one place: (sheet, column) of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie(pub [(usize, usize); 2]);

/// Checks the seams against the surfaces.
///
/// # Errors
/// [`AirError::Seam`] says what does not fit.
pub(crate) fn check(seams: &[Seam], surfaces: &[Surface]) -> Result<(), AirError> {
    for (seam, s) in seams.iter().enumerate() {
        let wrong = |problem: &'static str| Err(AirError::Seam { seam, problem });
        let [a, b] = s.surfaces;
        let (Some(first), Some(second)) = (surfaces.get(a), surfaces.get(b)) else {
            return wrong("there is no such surface");
        };
        if a == b || first.closed || second.closed {
            return wrong("a seam joins two different open surfaces");
        }
        if s.nodes.len() < 2 {
            return wrong("a seam needs at least two pairs of nodes");
        }
        let inside = |n: &[usize; 2]| n[0] < first.node_count && n[1] < second.node_count;
        if !s.nodes.iter().all(inside) {
            return wrong("a node does not exist");
        }
    }
    Ok(())
}

/// Columns of wake nodes that leave the nodes of the seams.
pub(crate) fn ties(seams: &[[usize; 2]], sheets: &[Sheet]) -> Vec<Tie> {
    let places = |node: usize| {
        let of = move |(s, sheet): (usize, &Sheet)| -> Vec<(usize, usize)> {
            let here = |(_, n): &(usize, &usize)| **n == node;
            let columns = sheet.nodes.iter().enumerate().filter(here);
            columns.map(|(column, _)| (s, column)).collect()
        };
        sheets.iter().enumerate().flat_map(of)
    };
    let pairs = |&[a, b]: &[usize; 2]| {
        places(a)
            .flat_map(move |x| places(b).map(move |y| Tie([x, y])))
            .collect::<Vec<_>>()
    };
    seams.iter().flat_map(pairs).collect()
}

/// Puts tied wake nodes midway between them: roundings and what a tree leaves out would part them.
pub(crate) fn tie(topology: &Topology, sheets: &mut [WakeSheet]) {
    for Tie(ends) in &topology.ties {
        let rows = ends.map(|(s, _)| sheets[s].rows());
        for back in 1..=rows[0].min(rows[1]) {
            let at = [0, 1].map(|k| {
                let (s, column) = ends[k];
                (s, (rows[k] - back) * (sheets[s].columns + 1) + column)
            });
            let middle = |of: fn(&WakeSheet, usize) -> DVec3| {
                let [x, y] = at.map(|(s, n)| of(&sheets[s], n));
                0.5 * (x + y)
            };
            let place = middle(|sheet, n| sheet.nodes.get(n));
            let looks_back = at.iter().all(|&(s, n)| n < sheets[s].velocity.len());
            let velocity = looks_back.then(|| middle(|sheet, n| sheet.velocity.get(n)));
            for (s, n) in at {
                sheets[s].nodes.set(n, place);
                if let Some(v) = velocity {
                    sheets[s].velocity.set(n, v);
                }
            }
        }
    }
}

impl Lattice {
    /// # Errors
    /// [`AirError::SeamOpen`] names the first two nodes of a seam that are not on one place.
    pub(crate) fn check_seams(
        &self,
        motion: &NodeMotion,
        size: f64,
        step: u64,
    ) -> Result<(), AirError> {
        for &[a, b] in &self.topology().seams {
            let distance = motion.position[a].distance(motion.position[b]);
            if distance > TOLERANCE * size {
                let node = |n: usize| {
                    let s = self.topology().first_node.partition_point(|&f| f <= n) - 1;
                    (
                        self.surfaces()[s].name.clone(),
                        n - self.topology().first_node[s],
                    )
                };
                let nodes = [node(a), node(b)];
                return Err(AirError::SeamOpen {
                    step,
                    nodes: Box::new(nodes),
                    distance,
                });
            }
        }
        Ok(())
    }
}
