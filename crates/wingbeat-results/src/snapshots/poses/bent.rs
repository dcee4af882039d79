//! The shape of an elastic wing from what a row of its history says of four sections.

use std::array::from_fn;

use wingbeat_case::column_name;
use wingbeat_flight::STATIONS;
use wingbeat_math::{DVec3, r2};
use wingbeat_model::Wing;

/// Names of the sections in columns, at [`STATIONS`].
const SECTIONS: [&str; 4] = ["quarter", "half", "three_quarters", "tip"];

/// Chord of a tip over that of the root below which it is a point \[1\].
const POINTED: f64 = 1e-6;

/// Displacement along axis 3 \[m\], twist \[rad\] and camber \[1\] of the sections, and where nodes lie on theirs.
#[derive(Clone, Debug)]
pub(super) struct Bent {
    /// Columns of these three, section by section.
    columns: [[usize; 3]; 4],
    /// Of every node.
    places: Vec<Place>,
}

/// Where a node lies at rest.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// From the root of the surface to its tip \[1\].
    span: f64,
    /// The middle of its chord, wing axes \[m\].
    middle: DVec3,
    /// Height of a parabola of unit camber there \[m\].
    height: f64,
}

impl Bent {
    /// For a wing and the columns of a history; none where that does not say what sections do.
    pub fn new(wing: &Wing, names: &[String]) -> Option<Self> {
        let column = |name: String| names.iter().position(|n| *n == name);
        let own = column_name(&wing.name);
        let of = |section: &str| -> Option<[usize; 3]> {
            Some([
                column(format!("deflection_{section}_wing_{own}_m"))?,
                column(format!("twist_{section}_wing_{own}_rad"))?,
                column(format!("camber_{section}_wing_{own}_dimensionless"))?,
            ])
        };
        let columns: Option<Vec<_>> = SECTIONS.into_iter().map(of).collect();
        let mesh = &wing.mesh;
        let chord = |j: usize| [0, mesh.rows].map(|i| mesh.nodes[mesh.node(i, j)]);
        let middle = |j: usize| {
            let [front, rear] = chord(j);
            front.midpoint(rear)
        };
        // Where the sections are recorded: by the leading edge.
        let front = |j: usize| mesh.nodes[mesh.node(0, j)].y;
        let [root, tip] = [0, mesh.cols].map(front);
        let places = (0..mesh.nodes.len()).map(|n| {
            let j = n % (mesh.cols + 1);
            let [leading, trailing] = chord(j);
            let length = leading.distance(trailing);
            let part = mesh.nodes[n].distance(leading) / length.max(f64::MIN_POSITIVE);
            Place {
                span: (front(j) - root) / (tip - root),
                middle: middle(j),
                height: 4.0 * part * (1.0 - part) * length,
            }
        });
        let mut columns: [[usize; 3]; 4] = columns?.try_into().ok()?;
        // A tip that is a point has neither twist nor camber of its own.
        let [at_root, at_tip] = [0, mesh.cols].map(|j| chord(j)[0].distance(chord(j)[1]));
        if at_tip < POINTED * at_root {
            (columns[3][1], columns[3][2]) = (columns[2][1], columns[2][2]);
        }
        Some(Self {
            columns,
            places: places.collect(),
        })
    }

    /// The `nodes`, at rest, where this row has them, wing axes \[m\].
    pub fn places(&self, nodes: &[DVec3], row: &[f64]) -> Vec<DVec3> {
        let sections = self.columns.map(|columns| columns.map(|c| row[c]));
        let nodes = nodes.iter().zip(&self.places);
        let place = |(x, at): (&DVec3, &Place)| {
            let shares = shares(at.span);
            let [deflection, twist, camber] = from_fn(|k| {
                let part = |s: usize| shares[s] * sections[s][k];
                (0..4).map(part).sum::<f64>()
            });
            let section = *x - at.middle - camber * at.height * DVec3::Z;
            at.middle + r2(twist) * section + deflection * DVec3::Z
        };
        nodes.map(place).collect()
    }
}

/// What the stations count at `s`: of the polynomial that is zero at the root, Lagrange's.
fn shares(s: f64) -> [f64; 4] {
    from_fn(|k| {
        let others = STATIONS.iter().enumerate().filter(|(j, _)| *j != k);
        let ratio = |(_, other): (usize, &f64)| (s - other) / (STATIONS[k] - other);
        s / STATIONS[k] * others.map(ratio).product::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_shares_have_the_stations_and_polynomials() {
        for (k, s) in STATIONS.into_iter().enumerate() {
            assert_eq!(shares(s), from_fn(|j| f64::from(u8::from(j == k))));
        }
        let cubic = |s: f64| s * s * (3.0 - s);
        for s in [0.0, 0.1, 0.6, 0.93] {
            let sum: f64 = shares(s)
                .iter()
                .zip(STATIONS)
                .map(|(a, x)| a * cubic(x))
                .sum();
            assert!((sum - cubic(s)).abs() < 1e-14, "{s}");
        }
    }
}
