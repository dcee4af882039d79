//! Places and attitudes of the nodes of an elastic body.

use wingbeat_math::{DQuat, DVec3};

/// Numbers of a node: three of the place, three of the attitude.
pub const NODE: usize = 6;

/// Places and attitudes of the nodes, in the frame W of the body that carries the elastic one.
#[derive(Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Configuration {
    /// Places \[m\], W components.
    pub position: Vec<DVec3>,
    /// Attitudes, node components to W components.
    pub rotation: Vec<DQuat>,
}

/// Written out because a derived `clone_from` allocates, and Newton's passes copy configurations.
impl Clone for Configuration {
    fn clone(&self) -> Self {
        Self {
            position: self.position.clone(),
            rotation: self.rotation.clone(),
        }
    }

    fn clone_from(&mut self, source: &Self) {
        self.position.clone_from(&source.position);
        self.rotation.clone_from(&source.rotation);
    }
}

impl Configuration {
    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Moves node n by the six numbers `increment[6 n..]`: dx \[m\] in W components, dtheta \[rad\] in node components,
    /// `R <- R exp(dtheta)`.
    pub fn moved(&mut self, increment: &[f64]) {
        let nodes = self.position.iter_mut().zip(&mut self.rotation);
        for ((x, r), d) in nodes.zip(increment.chunks_exact(NODE)) {
            *x += DVec3::from_slice(d);
            let turn = DQuat::from_scaled_axis(DVec3::from_slice(&d[3..]));
            *r = (*r * turn).normalize();
        }
    }
}
