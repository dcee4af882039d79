//! How a wing is bent along its span: deflection, twist and camber of its sections.

use wingbeat_math::DVec3;
use wingbeat_structure::{Configuration, Follower};

use crate::interface::record::{STATIONS, SectionRecord};

/// A section between two columns of nodes of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Station {
    /// Nodes of both columns, from the leading to the trailing edge.
    columns: [Vec<usize>; 2],
    /// Share of the second column \[1\].
    part: f64,
}

impl Station {
    /// The stations of a mesh of `rows` x `cols` panels with these nodes at rest.
    pub fn all(nodes: &[DVec3], [rows, cols]: [usize; 2]) -> [Self; 4] {
        let distance = |j: usize| (nodes[j].y - nodes[0].y).abs();
        let column = |j: usize| (0..=rows).map(|i| i * (cols + 1) + j).collect();
        STATIONS.map(|station| {
            let r = station * distance(cols);
            let j = (1..cols).find(|&j| distance(j) >= r).unwrap_or(cols);
            Self {
                columns: [column(j - 1), column(j)],
                part: (r - distance(j - 1)) / (distance(j) - distance(j - 1)),
            }
        })
    }

    /// The section in the configuration `at`, against `rest`.
    pub fn record(&self, followers: &[Follower], [at, rest]: [&Configuration; 2]) -> SectionRecord {
        let [a, b] = [0, 1].map(|k| {
            let shape = |c: &Configuration| SectionShape::new(&self.columns[k], followers, c);
            let (now, before) = (shape(at), shape(rest));
            [
                now.middle - before.middle,
                now.pitch - before.pitch,
                now.camber - before.camber,
            ]
        });
        let [deflection, twist, camber] = std::array::from_fn(|k| a[k] + self.part * (b[k] - a[k]));
        SectionRecord {
            deflection,
            twist,
            camber,
        }
    }
}

/// The shape of one column of nodes.
struct SectionShape {
    /// Place of the middle between the edges along axis 3 \[m\].
    middle: f64,
    pitch: f64,
    /// Largest height over the chord towards -axis 3, over the chord \[1\].
    camber: f64,
}

impl SectionShape {
    fn new(nodes: &[usize], followers: &[Follower], at: &Configuration) -> Self {
        let place = |n: &usize| followers[*n].position(at);
        let ends = [nodes.first(), nodes.last()].map(|n| n.map_or(DVec3::ZERO, place));
        let [lead, trail] = ends;
        let chord = lead - trail;
        let along = chord.normalize_or_zero();
        let normal = -(DVec3::Z - along.z * along).normalize_or_zero();
        let height = |n: &usize| (place(n) - trail).dot(normal);
        let higher = |a: f64, h: f64| if h.abs() > a.abs() { h } else { a };
        let inner = nodes.len().saturating_sub(1);
        let heights = nodes[1.min(inner)..inner].iter().map(height);
        Self {
            middle: lead.midpoint(trail).z,
            pitch: (-chord.z).atan2(chord.x),
            camber: heights.fold(0.0, higher) / chord.length().max(f64::MIN_POSITIVE),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wingbeat_math::DQuat;

    #[test]
    fn exact_camber_of_an_arched_section() {
        // A mean line that is lifted by 5 % of the chord towards -axis 3, however the section is pitched.
        let arched = [[1.0, 0.0], [0.5, -0.05], [0.0, 0.0]];
        for pitch in [0.0, 0.4, -1.0] {
            let turned = |[x, z]: [f64; 2]| DQuat::from_rotation_y(pitch) * DVec3::new(x, 0.0, z);
            let at = Configuration {
                position: arched.map(turned).to_vec(),
                rotation: vec![DQuat::IDENTITY; 3],
            };
            let follower = |n: usize| Follower::new(at.position[n], &[(n, 1.0)], &at);
            let followers = [0, 1, 2].map(follower);
            let camber = SectionShape::new(&[0, 1, 2], &followers, &at).camber;
            assert!((camber - 0.05).abs() < 1e-15, "{pitch}: {camber}");
        }
    }
}
