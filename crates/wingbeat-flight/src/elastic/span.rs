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
    /// How far each goes along axis 2 at rest, from the trailing to the leading edge, over the way from one to the other
    /// \[1\]: without as much of that way a column lies across the span, and bending does not turn it.
    aslant: [f64; 2],
}

/// What is rounding of that.
const ALONG: f64 = 1e-9;

impl Station {
    /// The stations of a mesh of `rows` x `cols` panels with these nodes at rest.
    pub fn all(nodes: &[DVec3], [rows, cols]: [usize; 2]) -> [Self; 4] {
        let distance = |j: usize| (nodes[j].y - nodes[0].y).abs();
        let column = |j: usize| (0..=rows).map(|i| i * (cols + 1) + j).collect();
        let ends = |j: usize| [0, rows].map(|i| nodes[i * (cols + 1) + j].y);
        STATIONS.map(|station| {
            let r = station * distance(cols);
            let j = (1..cols).find(|&j| distance(j) >= r).unwrap_or(cols);
            let [a, b] = [j - 1, j].map(ends);
            let way = 0.5 * (b[0] + b[1] - a[0] - a[1]);
            let aslant = [a, b].map(|[lead, trail]| (lead - trail) / way);
            Self {
                columns: [column(j - 1), column(j)],
                part: (r - distance(j - 1)) / (distance(j) - distance(j - 1)),
                aslant: aslant.map(|x| if x.abs() < ALONG { 0.0 } else { x }),
            }
        })
    }

    /// Shapes and pitch angles \[rad\] of both columns in the configuration `at`.
    fn shapes(&self, followers: &[Follower], at: &Configuration) -> [(SectionShape, f64); 2] {
        let [a, b] = [0, 1].map(|k| SectionShape::new(&self.columns[k], followers, at));
        let way = b.middle - a.middle;
        let pitch = |shape: &SectionShape, aslant: f64| {
            let chord = shape.chord - aslant * way;
            (-chord.z).atan2(chord.x)
        };
        let pitches = [pitch(&a, self.aslant[0]), pitch(&b, self.aslant[1])];
        [(a, pitches[0]), (b, pitches[1])]
    }

    /// Twist of the second column \[rad\] in the configuration `at`, against `rest`.
    pub fn outer_twist(&self, followers: &[Follower], [at, rest]: [&Configuration; 2]) -> f64 {
        let [now, before] = [at, rest].map(|c| self.shapes(followers, c)[1].1);
        now - before
    }

    /// The section in the configuration `at`, against `rest`.
    pub fn record(&self, followers: &[Follower], [at, rest]: [&Configuration; 2]) -> SectionRecord {
        let [now, before] = [at, rest].map(|c| self.shapes(followers, c));
        let [a, b] = [0, 1].map(|k| {
            let ((now, pitch), (before, at_rest)) = (&now[k], &before[k]);
            [
                now.middle.z - before.middle.z,
                pitch - at_rest,
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
    /// Middle between the edges \[m\], and what lies between them, forward.
    middle: DVec3,
    chord: DVec3,
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
            middle: lead.midpoint(trail),
            chord,
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

    /// Columns of nodes that are not along the chord: bending does not twist them, and twist is the angle by which
    /// they turn.
    #[test]
    fn exact_twist_of_columns_aslant_to_the_chord() {
        let nodes: Vec<DVec3> = (0..6)
            .map(|k| {
                let (i, j) = (f64::from(k / 2), f64::from(k % 2));
                DVec3::new(
                    0.1 - 0.3 * i - 0.2 * j,
                    1.0 + 0.5 * j + (0.2 - 0.1 * j) * i,
                    0.0,
                )
            })
            .collect();
        let configuration = |turn: DQuat| Configuration {
            position: nodes.iter().map(|x| turn * *x).collect(),
            rotation: vec![turn; 6],
        };
        let rest = configuration(DQuat::IDENTITY);
        let follower = |n: usize| Follower::new(rest.position[n], &[(n, 1.0)], &rest);
        let followers: Vec<Follower> = (0..6).map(follower).collect();
        for (turn, twist) in [
            (DQuat::from_rotation_x(-0.3), 0.0),
            (DQuat::from_rotation_y(0.2), 0.2),
        ] {
            let at = configuration(turn);
            for station in Station::all(&nodes, [2, 1]) {
                let found = station.record(&followers, [&at, &rest]).twist;
                let tip = station.outer_twist(&followers, [&at, &rest]);
                assert!((found - twist).abs() < 1e-15, "{turn}: {found}");
                assert!((tip - twist).abs() < 1e-15, "{turn}: {tip}");
            }
        }
    }
}
