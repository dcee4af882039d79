//! Published beams.

mod common;

use common::*;
use wingbeat_math::{DQuat, DVec3};
use wingbeat_structure::*;

/// Geradin & Cardona's cantilever [Simpson & Palacios 2013]: tip down 2.159 m, shortening 0.596 m, rotation 0.672 rad.
fn geradin(elements: usize) -> (DVec3, f64) {
    let section = BeamSection::new(&Stiffness {
        axial: 4.8e8,
        shear: [3.231e8; 2],
        torsion: 1e6,
        bending: [9.346e6; 2],
    })
    .with_mass(1.0, [0.0; 2], [1e-4; 2]);
    let body = straight(elements, 5.0, &section).clamp(0).build().unwrap();
    let force = load(elements, DVec3::Z * -600e3, DVec3::ZERO, false);
    let at = equilibrium(
        &body,
        body.rest(),
        &FrameMotion::REST,
        &force[..],
        &Default::default(),
    );
    let at = at.unwrap();
    let tip = at.position[elements] - body.rest().position[elements];
    (tip, at.rotation[elements].to_scaled_axis().y)
}

#[test]
fn published_cantilever_of_geradin_and_cardona() {
    let (tip, turn) = geradin(20);
    println!("{tip} {turn}");
    assert!((tip.z + 2.159).abs() < 1e-3, "{tip}"); // printed digits
    assert!((tip.x + 0.596).abs() < 1e-3, "{tip}");
    assert!((turn - 0.672).abs() < 1e-3, "{turn}");
}

/// Bathe & Bolourchi's bend of 45 degrees [Int. J. Numer. Methods Engrg 14:961, 1979].
fn bend(elements: usize, force: f64) -> DVec3 {
    // Authors take the polar moment 1/6 for the torsion constant, which is 0.1406.
    let section = BeamSection::new(&Stiffness {
        axial: 1e7,
        shear: [5e6; 2],
        torsion: 5e6 / 6.0,
        bending: [1e7 / 12.0; 2],
    })
    .with_mass(1.0, [0.0; 2], [1.0 / 12.0; 2]);
    let angle = |i: usize| std::f64::consts::FRAC_PI_4 * i as f64 / elements as f64;
    let radius = 100.0;
    let place = |i: usize| radius * DVec3::new(angle(i).sin(), 1.0 - angle(i).cos(), 0.0);
    let rest = Configuration {
        position: (0..=elements).map(place).collect(),
        rotation: vec![DQuat::IDENTITY; elements + 1],
    };
    let mut body = StructureBuilder::new(rest.clone()).clamp(0);
    for i in 0..elements {
        let ends = [i, i + 1].map(|n| BeamEnd {
            place: place(n),
            rotation: DQuat::from_rotation_z(angle(n)),
        });
        body = body.element(Beam::between(&rest, [i, i + 1], ends, &section).unwrap());
    }
    let body = body.build().unwrap();
    let force = load(elements, DVec3::Z * force, DVec3::ZERO, false);
    let at = equilibrium(
        &body,
        &rest,
        &FrameMotion::REST,
        &force[..],
        &Default::default(),
    );
    at.unwrap().position[elements]
}

#[test]
fn published_bend_of_bathe_and_bolourchi() {
    let tip = bend(16, 600.0);
    println!("{tip} {}", bend(32, 600.0));
    // (47.2, 15.9, 53.4): half a unit across authors.
    assert!((tip - DVec3::new(47.2, 15.9, 53.4)).length() < 0.5, "{tip}");
    let start = bend(16, 0.0);
    assert!((start - DVec3::new(70.71, 29.29, 0.0)).length() < 0.005); // printed digits
}

/// First flap frequency of a rotating cantilever of unit stiffness, mass and length.
fn rotating(elements: usize, speed: f64) -> f64 {
    let body = straight(elements, 1.0, &slender())
        .clamp(0)
        .build()
        .unwrap();
    let frame = FrameMotion {
        w: DVec3::Z * speed,
        ..FrameMotion::REST
    };
    let rest = body.rest();
    let at = equilibrium(&body, rest, &frame, &(), &Default::default()).unwrap();
    let all = modes(&body, &at, &frame, None).unwrap();
    let tip = |m: &&Mode| m.shape[NODE * elements + 2].abs() > m.shape[NODE * elements + 1].abs();
    all.iter().find(tip).unwrap().frequency()
}

#[test]
fn published_rotating_cantilever_of_wright() {
    // Wright et al. 1982, hub radius 0: first flap frequency by dimensionless speed.
    for (speed, published) in [(0.0, 3.5160), (3.0, 4.7973), (6.0, 7.3604), (12.0, 13.1702)] {
        let ratio = rotating(16, speed) / published - 1.0;
        println!("{speed} {ratio:.2e}");
        assert!(ratio.abs() < 1e-3, "{speed}: {ratio:.2e}"); // issue 22
    }
}

#[test]
fn published_frequencies_of_a_cantilever() {
    for elements in [4, 8, 16, 24, 32, 48] {
        let body = straight(elements, 1.0, &slender())
            .clamp(0)
            .build()
            .unwrap();
        let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        for (k, exact) in [3.516015, 22.034492, 61.697214].into_iter().enumerate() {
            let ratio = all[2 * k].frequency() / exact - 1.0;
            // The mass at the nodes: second order from four elements on.
            let of_order_two = ratio * (elements * elements) as f64;
            println!("{elements} {k} {ratio:.3e} {of_order_two:.3}");
            let limit = [0.02, 0.33, 1.25][k];
            assert!(of_order_two.abs() < limit, "{elements} {k}: {ratio:.3e}");
        }
    }
}
