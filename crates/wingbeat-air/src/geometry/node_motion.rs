//! How the nodes of the surfaces move.

use crate::error::AirError;
use crate::geometry::topology::Topology;
use wingbeat_math::DVec3;

/// How far two joined nodes may be apart, in panel sizes: far above round-off, far below what
/// changes any velocity.
const TOLERANCE: f64 = 1e-6;

/// Positions and velocities of the nodes of all surfaces, concatenated in the order of the
/// surfaces, in the inertial frame N.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeMotion {
    /// Positions [m], N components.
    pub position: Vec<DVec3>,
    /// Velocities [m/s], N components.
    pub velocity: Vec<DVec3>,
}

impl NodeMotion {
    /// Checks number and finiteness of the nodes.
    ///
    /// # Errors
    /// [`AirError::MotionSize`], or [`AirError::SurfaceNotFinite`] for the first node.
    pub(crate) fn check(&self, topology: &Topology, step: u64) -> Result<(), AirError> {
        let expected = *topology.first_node.last().expect("never empty");
        for got in [self.position.len(), self.velocity.len()] {
            if got != expected {
                return Err(AirError::MotionSize { got, expected });
            }
        }
        let nodes = self.position.iter().zip(&self.velocity);
        let mut nodes = nodes.enumerate();
        match nodes.find(|(_, (x, v))| !(x.is_finite() && v.is_finite())) {
            None => Ok(()),
            Some((n, (&position, &velocity))) => {
                let (surface, node) = topology.locate_node(n);
                Err(AirError::SurfaceNotFinite {
                    step,
                    surface,
                    node,
                    position,
                    velocity,
                })
            }
        }
    }

    /// Checks that joined nodes are in one place, panels having this mean `size` [m].
    ///
    /// # Errors
    /// [`AirError::JoinOpen`] names the first two nodes that are not.
    pub(crate) fn check_joined(
        &self,
        topology: &Topology,
        size: f64,
        step: u64,
    ) -> Result<(), AirError> {
        for &[a, b] in &topology.joined_nodes {
            let distance = self.position[a].distance(self.position[b]);
            if distance > TOLERANCE * size {
                let nodes = [a, b].map(|n| topology.locate_node(n));
                return Err(AirError::JoinOpen {
                    step,
                    nodes: Box::new(nodes),
                    distance,
                });
            }
        }
        Ok(())
    }
}
