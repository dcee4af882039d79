//! Beams that several tests use.
#![allow(dead_code)] // each test binary uses its part

use wingbeat_math::{DQuat, DVec3};
use wingbeat_structure::*;

/// Numbers without pattern in (-1, 1).
pub fn scatter(k: usize) -> f64 {
    let x = (12.9898 * (k + 1) as f64).sin() * 43758.5453;
    2.0 * (x - x.floor()) - 1.0
}

/// A vector of such numbers.
pub fn scatter3(k: usize) -> DVec3 {
    DVec3::new(scatter(3 * k), scatter(3 * k + 1), scatter(3 * k + 2))
}

/// Nodes at equal distances along axis 1, without attitude.
pub fn line(elements: usize, length: f64) -> Configuration {
    let place = |i: usize| DVec3::X * (length * i as f64 / elements as f64);
    Configuration {
        position: (0..=elements).map(place).collect(),
        rotation: vec![DQuat::IDENTITY; elements + 1],
    }
}

/// A straight beam along axis 1 with its section's axis 2 along axis 2, clamped at node 0 if asked for.
pub fn straight(elements: usize, length: f64, section: &BeamSection) -> StructureBuilder {
    let rest = line(elements, length);
    let mut builder = StructureBuilder::new(rest.clone());
    for i in 0..elements {
        let beam = Beam::straight(&rest, [i, i + 1], DVec3::Y, section).unwrap();
        builder = builder.element(beam);
    }
    builder
}

/// A section without shear and stretch to speak of: bending stiffness one, mass one.
pub fn slender() -> BeamSection {
    BeamSection::new(&Stiffness {
        axial: 1e8,
        shear: [1e8; 2],
        torsion: 1.0,
        bending: [1.0, 1.0],
    })
    .with_mass(1.0, [0.0; 2], [1e-9; 2])
}

/// A fully coupled section with offsets of all centres.
pub fn coupled() -> BeamSection {
    let stiffness = Stiffness {
        axial: 900.0,
        shear: [300.0, 250.0],
        torsion: 2.0,
        bending: [3.0, 5.0],
    };
    BeamSection::with_offsets(&stiffness, [0.03, -0.05], [-0.07, 0.02])
        .with_mass(0.7, [0.04, -0.03], [0.01, 0.02])
        .turned(0.4)
}

/// Dead or following load at one node.
pub fn load(node: usize, force: DVec3, moment: DVec3, follows: bool) -> [NodeLoad; 1] {
    [NodeLoad {
        node,
        force,
        moment,
        follows,
    }]
}

/// A configuration off another by numbers without pattern.
pub fn shaken(at: &Configuration, by: f64) -> Configuration {
    let mut moved = at.clone();
    let change: Vec<f64> = (0..NODE * at.len()).map(|k| by * scatter(k)).collect();
    moved.moved(&change);
    moved
}

/// A curved beam of two elements with coupling and offsets between shaken nodes.
pub fn crooked() -> (Configuration, Vec<Beam>) {
    let rest = shaken(&line(2, 1.0), 0.3);
    let end = |i: usize| BeamEnd {
        place: rest.position[i] + 0.05 * scatter3(i + 40),
        rotation: DQuat::from_scaled_axis(0.2 * scatter3(i + 50)),
    };
    let beam = |i: usize| Beam::between(&rest, [i, i + 1], [end(i), end(i + 1)], &coupled());
    let beams = (0..2).map(|i| beam(i).unwrap()).collect();
    (rest, beams)
}

/// The damping force `C(q) v` of an element and its derivative by q, v held, against differences.
pub fn damping_tangent_error(element: &dyn Element, at: &Configuration) -> f64 {
    let numbers: Vec<usize> = (element.nodes().iter())
        .flat_map(|n| 6 * n..6 * n + 6)
        .collect();
    let size = numbers.len();
    let velocity: Vec<f64> = (0..size).map(|k| ((3 * k + 1) as f64).cos()).collect();
    let mut tangent = vec![0.0; size * size];
    element.add_dissipation_tangent((at, at), &velocity, 0.3, &mut tangent);
    let force = |at: &Configuration| -> Vec<f64> {
        let mut out = ElementForces::default();
        element.dissipation(at, &mut out);
        let rows = out.tangent.chunks_exact(size);
        rows.map(|r| 0.3 * r.iter().zip(&velocity).map(|(c, v)| c * v).sum::<f64>())
            .collect()
    };
    let (h, mut error) = (1e-5, 0.0_f64);
    for (k, number) in numbers.iter().enumerate() {
        let side = |h: f64| {
            let (mut there, mut d) = (at.clone(), vec![0.0; 6 * at.len()]);
            d[*number] = h;
            there.moved(&d);
            force(&there)
        };
        let (plus, minus) = (side(h), side(-h));
        for i in 0..size {
            let slope = (plus[i] - minus[i]) / (2.0 * h);
            error = error.max((slope - tangent[i * size + k]).abs());
        }
    }
    error / tangent.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}
