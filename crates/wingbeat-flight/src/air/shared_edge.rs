//! Edges that two wings share: their roots, or the tip of one and the root of another that it carries.

use wingbeat_air::NodeMotion;
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::{Animal, root_gap};

use crate::error::FlightError;

/// How far tip and root that are one may be apart, over their chord \[1\].
const SAME: f64 = 1e-6;

/// Two wings that share an edge. Where their motions part it, the edge lies midway.
#[derive(Clone, Debug)]
pub struct SharedEdge {
    /// The wings.
    pub wings: [usize; 2],
    names: [String; 2],
    /// Nodes of the edge of the one and of the other among all nodes, from leading to trailing edge.
    pub nodes: Vec<[usize; 2]>,
    /// How far they may part [m]: half the width of the panels there.
    limit: f64,
}

impl SharedEdge {
    /// The roots of two wings, whose nodes are numbered as in `nodes`.
    pub fn of_roots(
        animal: &Animal,
        wings: [usize; 2],
        nodes: [std::ops::Range<usize>; 2],
    ) -> Self {
        let meshes = wings.map(|w| &animal.wings[w].mesh);
        let rows = 0..=meshes[0].rows.min(meshes[1].rows);
        Self {
            wings,
            names: names(animal, wings),
            limit: root_gap(meshes),
            nodes: rows
                .map(|i| [0, 1].map(|k| nodes[k].start + meshes[k].node(i, 0)))
                .collect(),
        }
    }

    /// The tip of the first wing and the root of the second, each with the column of nodes next to it; all nodes are
    /// `local` \[m\] in the frames of their bodies.
    pub fn of_tip(
        animal: &Animal,
        wings: [usize; 2],
        columns: [[Vec<usize>; 2]; 2],
        local: &[DVec3],
    ) -> Self {
        let width = |[edge, next]: &[Vec<usize>; 2]| {
            let widths = edge.iter().zip(next);
            let widths = widths.map(|(&a, &b)| local[a].distance(local[b]));
            widths.fold(f64::INFINITY, f64::min)
        };
        let [tip, root] = &columns;
        let nodes = tip[0].iter().zip(&root[0]);
        Self {
            wings,
            names: names(animal, wings),
            limit: 0.5 * width(tip).min(width(root)),
            nodes: nodes.map(|(&a, &b)| [a, b]).collect(),
        }
    }

    /// Puts the shared nodes midway between the two edges at time `t` \[s\].
    ///
    /// # Errors
    /// They are too far apart.
    pub fn join(&self, t: f64, out: &mut NodeMotion) -> Result<(), FlightError> {
        for &[a, b] in &self.nodes {
            let gap = out.position[a].distance(out.position[b]);
            if gap > self.limit {
                return Err(FlightError::RootsApart {
                    wings: self.names.clone(),
                    time: t,
                    gap,
                    limit: self.limit,
                });
            }
            for x in [&mut out.position, &mut out.velocity] {
                let middle = 0.5 * (x[a] + x[b]);
                (x[a], x[b]) = (middle, middle);
            }
        }
        Ok(())
    }
}

fn names(animal: &Animal, wings: [usize; 2]) -> [String; 2] {
    wings.map(|w| animal.wings[w].name.clone())
}

/// How far the tip of the first wing and the root of the second are apart at their ends, over the chord of the tip \[1\]:
/// where all angles are zero, as of a wing that the first carries; or, `moved`, as their motions begin.
pub fn tip_gap(animal: &Animal, pair: [usize; 2], moved: bool) -> f64 {
    let ends = [0, 1].map(|k| {
        let wing = &animal.wings[pair[k]];
        let (mesh, column) = (&wing.mesh, [wing.mesh.cols, 0][k]);
        [0, mesh.rows].map(|i| {
            let x = mesh.nodes[mesh.node(i, column)];
            let turned = if moved { wing.motion.at(0.0).c * x } else { x };
            wing.hinge_b + turned
        })
    });
    let [[a, b], [c, d]] = ends;
    a.distance(c).max(b.distance(d)) / a.distance(b).max(f64::MIN_POSITIVE)
}

/// Whether the tip of the first wing is the root of the second where all angles are zero, as it must be to be joined.
///
/// # Errors
/// Other chords or panels, edges apart, a tip without length.
pub fn check_joined_tip(animal: &Animal, pair: [usize; 2]) -> Result<(), FlightError> {
    let [one, other] = pair.map(|w| &animal.wings[w]);
    let refused = |problem: String| {
        let names = format!("{}, {}", one.name, other.name);
        Err(FlightError::setup("joined", names, problem))
    };
    let rows = [one.mesh.rows, other.mesh.rows];
    if rows[0] != rows[1] {
        return refused(format!(
            "the tip has {} panels along the chord, the root {}",
            rows[0], rows[1]
        ));
    }
    let place = |k: usize, i: usize| {
        let (wing, column) = ([one, other][k], [one.mesh.cols, 0][k]);
        wing.hinge_b + wing.mesh.nodes[wing.mesh.node(i, column)]
    };
    let chord = place(0, 0).distance(place(0, rows[0]));
    let apart = (0..=rows[0]).map(|i| place(0, i).distance(place(1, i)));
    let apart = apart.fold(0.0, f64::max);
    match apart <= SAME * chord {
        true if chord > 0.0 => Ok(()),
        true => refused("the tip has no length".to_owned()),
        false => refused(format!(
            "tip and root are {apart:.3e} m apart where all angles are zero"
        )),
    }
}
