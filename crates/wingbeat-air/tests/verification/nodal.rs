//! Forces on nodes in place of those on panels.

use crate::common::{fly, translating};
use wingbeat_air::{
    AirSettings, EdgeKind, Lattice, LoadMethod, NodeMotion, SheddingSegment, Surface,
};
use wingbeat_math::DVec3;

/// A quadrilateral with a triangle at its tip.
fn pointed() -> (Surface, Vec<DVec3>) {
    let mut wing = Surface::grid("wing", 1, 1);
    wing.node_count = 5;
    wing.panels.push([1, 3, 4, 4]);
    wing.shedding = vec![vec![SheddingSegment {
        from: 3,
        to: 2,
        panel: 0,
        kind: EdgeKind::Trailing,
    }]];
    let places = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.7, 2.0]];
    let nodes = places.map(|[x, y]| DVec3::new(x, y, -0.2 * x));
    (wing, nodes.to_vec())
}

#[test]
fn conserves_force_moment_and_power_of_triangles() {
    for loads in [LoadMethod::Pressure, LoadMethod::Joukowski] {
        let (wing, nodes) = pointed();
        let settings = AirSettings {
            loads,
            ..AirSettings::benchmark(1.2, DVec3::X)
        };
        let lattice = Lattice::new(vec![wing], settings).unwrap();
        let still = translating(nodes.clone(), DVec3::ZERO);
        let run = fly(&lattice, |_| still.clone(), 0.1, 3, |_, _, _, _| {}).unwrap();
        let (at, mut forces) = (&run.loads, Vec::new());
        lattice.nodal_forces(0, at, &still, &mut NodeMotion::default(), &mut forces);
        let moment =
            |x: &[DVec3], f: &[DVec3]| -> DVec3 { x.iter().zip(f).map(|(x, f)| x.cross(*f)).sum() };
        let couples: DVec3 = at.couple.iter().sum();
        let force: DVec3 = at.force.iter().sum();
        let wanted = moment(&at.panels.point, &at.force) + couples;
        let [total, turning] = [forces.iter().sum(), moment(&nodes, &forces)];
        assert!(
            force.distance(total) < 1e-14 * force.length(),
            "{force} {total}"
        );
        // With a quarter at each corner, as of quadrilaterals, a hundredth is missing.
        assert!(
            wanted.distance(turning) < 1e-14 * wanted.length(),
            "{wanted} {turning}"
        );
    }
}
