//! Places and attitudes of the nodes of an elastic body.

use wingbeat_math::{DQuat, DVec3, rotation_vector, six};

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

    /// Six numbers of each node by which [`Self::moved`] brings this to `to`.
    pub fn increment_to(&self, to: &Self) -> Vec<f64> {
        let node = |n: usize| {
            let shift = to.position[n] - self.position[n];
            let turn = rotation_vector(self.rotation[n].inverse() * to.rotation[n]);
            six(shift, turn)
        };
        (0..self.len()).flat_map(node).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_moving_by_the_increment_arrives() {
        let rotation = |x: DVec3| vec![DQuat::from_scaled_axis(x); 2];
        let from = Configuration {
            position: vec![DVec3::new(0.1, -0.2, 0.3), DVec3::ZERO],
            rotation: rotation(DVec3::new(0.4, 0.5, -1.6)),
        };
        let to = Configuration {
            position: vec![DVec3::ONE, DVec3::new(0.0, 2.0, -1.0)],
            rotation: rotation(DVec3::new(-0.7, 1.1, 0.2)),
        };
        let mut moved = from.clone();
        moved.moved(&from.increment_to(&to));
        for n in 0..2 {
            // Roundings of numbers of order one.
            assert!((moved.position[n] - to.position[n]).length() < 1e-15);
            assert!(moved.rotation[n].angle_between(to.rotation[n]) < 1e-7); // arc cosine of 1 less a rounding
        }
    }
}
