//! Mass properties by integration: exact on polyhedra, frame-independent, scaling.

use crate::gap;
use wingbeat_math::{DMat3, DVec3, MassProperties, r1, r3};
use wingbeat_model::mesh::integrate;
use wingbeat_model::species::{FlyOptions, drosophila_melanogaster};
use wingbeat_model::{
    Animal, BodyMass, BodyPart, MassInput, Planform, Profile, QuadMesh, Revolution, Side,
    WingShape, fit_body_length,
};

/// A box of edges `e` with its lowest corner at `p`.
fn cuboid(p: DVec3, e: DVec3) -> QuadMesh {
    let node = |k: usize| {
        let bit = |b: usize| ((k >> b) & 1) as f64;
        p + e * DVec3::new(bit(0), bit(1), bit(2))
    };
    QuadMesh {
        nodes: (0..8).map(node).collect(),
        quads: vec![
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ],
    }
}

fn close(a: &MassProperties, b: &MassProperties, tolerance: f64) -> bool {
    (a.mass - b.mass).abs() < tolerance
        && (a.first_moment - b.first_moment).length() < tolerance
        && gap(a.inertia, b.inertia) < tolerance
}

#[test]
fn exact_box() {
    let (p, e, rho) = (DVec3::new(0.5, -1.0, 0.25), DVec3::new(1.0, 2.0, 3.0), 2.0);
    let mesh = cuboid(p, e);
    assert_eq!(crate::euler_characteristic(&mesh), 2);
    let m = rho * 6.0;
    let j = DVec3::new(4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0) * (m / 12.0);
    let expected = MassProperties::about_centre(m, p + e * 0.5, DMat3::from_diagonal(j));
    // Gauss points are exact for the polynomials: what is left is rounding of numbers up to 70.
    assert!(close(&integrate::solid(&mesh, rho), &expected, 1e-12));
}

#[test]
fn invariant_integration_commutes_with_moving_the_mesh() {
    let (r, p) = (r1(0.7) * r3(-1.2), DVec3::new(0.3, -0.8, 1.1));
    let shape = Revolution::ellipsoid(DVec3::new(0.1, 0.2, 0.3), 2.0, 0.4, [5, 6]);
    let mesh = shape.mesh("part").unwrap();
    let moved = integrate::solid(&mesh.map(|x| r * x + p), 3.0);
    // Bilinear patches move rigidly with their corners: equal up to rounding.
    assert!(close(
        &moved,
        &integrate::solid(&mesh, 3.0).moved(r, p),
        1e-12
    ));
}

/// Off the origin and slanted, so that every moment is in use.
fn slanted(profile: Profile, panels: [usize; 2]) -> Revolution {
    Revolution {
        direction: DVec3::new(1.0, 0.4, -0.7),
        profile,
        ..Revolution::ellipsoid(DVec3::new(0.3, -0.2, 0.5), 2.0, 0.4, panels)
    }
}

fn profiles() -> [Profile; 4] {
    let table = vec![(0.0, 0.0), (0.25, 0.9), (0.5, 1.0), (1.0, 0.0)];
    [
        Profile::Ellipsoid,
        Profile::Superellipse { exponent: 3.0 },
        Profile::Superellipse { exponent: 1.5 },
        Profile::Table(table),
    ]
}

#[test]
fn exact_mass_of_a_round_ellipsoid_whatever_its_panels() {
    let (a, b, rho) = (1.0, 0.4, 3.0); // semi-axes
    let m = rho * 4.0 / 3.0 * std::f64::consts::PI * a * b * b;
    let shape = slanted(Profile::Ellipsoid, [6, 8]);
    let axis = shape.direction.normalize();
    let across = 0.2 * m * (a * a + b * b);
    let about_centre = DMat3::from_diagonal(DVec3::splat(across))
        + wingbeat_math::outer(axis) * (0.4 * m * b * b - across);
    let expected = MassProperties::about_centre(m, shape.centre, about_centre);
    for panels in [[6, 8], [3, 4]] {
        let shape = slanted(Profile::Ellipsoid, panels);
        let part = |mass| BodyPart::revolution("part", &shape, &mass).unwrap().mass;
        // Moments of 4 kg m2: rounding.
        assert!(close(&part(MassInput::Density(rho)), &expected, 1e-14));
        assert!(close(&part(MassInput::Total(m)), &expected, 1e-14));
    }
}

/// A tilted ellipsoid reaches sqrt((a u)^2 + (b v)^2) to either side; other shapes what their panels come to.
#[test]
fn exact_lengths_and_centres_of_bodies_whatever_their_panels() {
    for profile in profiles() {
        let ends = slanted(profile.clone(), [6, 8])
            .ends_along_b1("part")
            .unwrap();
        let fine = slanted(profile.clone(), [240, 480])
            .mesh("part")
            .unwrap()
            .bounds();
        for (exact, panels) in ends.iter().zip(fine) {
            // Panels of a table's corners, of second order elsewhere.
            assert!(
                (exact - panels.x).abs() < 1e-3,
                "{profile:?}: {ends:?} {fine:?}"
            );
        }
        let fitted = |panels| fit_body_length(&[slanted(profile.clone(), panels)], 3.0).unwrap();
        assert_eq!(fitted([6, 8])[0].length, fitted([20, 30])[0].length);
    }
    let round = slanted(Profile::Ellipsoid, [6, 8]);
    let axis = round.direction.normalize();
    let reach = (axis.x.powi(2) + 0.16 * (1.0 - axis.x.powi(2))).sqrt();
    let [low, high] = round.ends_along_b1("part").unwrap();
    assert!((low - (0.3 - reach)).abs() < 1e-15 && (high - (0.3 + reach)).abs() < 1e-15);

    let centre = |stations: usize| {
        let ahead = Revolution::ellipsoid(DVec3::new(2.0, 0.0, 0.0), 1.0, 0.3, [stations, 6]);
        let parts = [("a", slanted(Profile::Ellipsoid, [6, 8])), ("b", ahead)];
        let part = |(name, shape): (&str, Revolution)| {
            BodyPart::revolution(name, &shape, &MassInput::Density(1.0)).unwrap()
        };
        let parts = parts.map(part).to_vec();
        let animal = Animal::new("two", BodyMass::FromParts, parts, vec![]).unwrap();
        // Of the density 1, the mass centre is that of the volume.
        let apart = animal.body_centre() - animal.body.centre();
        assert!(apart.length() < 1e-14, "{apart:?}");
        let scaled = animal.scaled(2.0).unwrap().body_centre();
        assert!((scaled - 2.0 * animal.body_centre()).length() < 1e-14);
        animal.body_centre()
    };
    assert_eq!(centre(4), centre(12));
}

#[test]
fn order_solids_within_panels_converge_to_the_round_ones_at_second_order() {
    for profile in profiles() {
        let gaps = |n: usize| {
            let shape = slanted(profile.clone(), [n, 2 * n]);
            let panels = integrate::solid(&shape.mesh("part").unwrap(), 1.0);
            let round = shape.solid("part", 1.0).unwrap();
            [
                (panels.mass - round.mass).abs(),
                (panels.first_moment - round.first_moment).length(),
                gap(panels.inertia, round.inertia),
            ]
        };
        let (coarse, fine) = (gaps(60), gaps(120));
        for k in 0..3 {
            // Rows of the table are stations of both meshes; 3.8 at the ends of the exponent 1.5.
            let ratio = coarse[k] / fine[k];
            assert!((3.7..4.3).contains(&ratio), "{profile:?} {k}: {ratio}");
            assert!(fine[k] < 1e-3, "{profile:?} {k}: {}", fine[k]);
        }
    }
}

#[test]
fn exact_rectangular_plate_and_tapered_density() {
    let planform = Planform::Rectangle {
        chord: 1.0,
        span: 2.0,
        root_offset: 0.0,
        axis_fraction: 0.5,
    };
    let mesh = WingShape::uniform(planform, 3, 5)
        .mesh("wing", Side::Left)
        .unwrap();
    let plate = MassInput::Total(6.0).of_wing("wing", &mesh).unwrap();
    let j = DVec3::new(4.0, 1.0, 5.0) * (6.0 / 12.0); // m (b^2, c^2, b^2 + c^2) / 12
    let expected =
        MassProperties::about_centre(6.0, DVec3::new(0.0, -1.0, 0.0), DMat3::from_diagonal(j));
    assert!(close(&plate, &expected, 1e-13)); // rounding
    // sigma = 3 (2 - r) / 2: mass 3, centre at r = 2/3, int sigma r^2 = 2.
    let table = MassInput::SpanTable(vec![(0.0, 3.0), (2.0, 0.0)]);
    let tapered = table.of_wing("wing", &mesh).unwrap();
    assert!((tapered.mass - 3.0).abs() < 1e-13);
    assert!((tapered.centre().y + 2.0 / 3.0).abs() < 1e-13);
    assert!((tapered.inertia.x_axis.x - 2.0).abs() < 1e-13);
}

#[test]
fn exact_scaling_lengths_by_s_scales_mass_by_s3_and_inertia_by_s5() {
    let fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    let s = 3.0;
    let options = FlyOptions {
        scale: s,
        ..Default::default()
    };
    let big = drosophila_melanogaster(&options).unwrap();
    let ratio = |a: f64, b: f64, power: i32| (a / b / s.powi(power) - 1.0).abs() < 1e-13; // rounding
    assert!(ratio(big.body_length(), fly.body_length(), 1));
    assert!(ratio(big.mass(), fly.mass(), 3));
    assert!(ratio(
        big.body.inertia.y_axis.y,
        fly.body.inertia.y_axis.y,
        5
    ));
    let (a, b) = (&big.wings[0], &fly.wings[0]);
    assert!(ratio(a.mass.inertia.z_axis.z, b.mass.inertia.z_axis.z, 5));
    assert!(ratio(a.report().length, b.report().length, 1));
    assert!((a.report().r2_hat - b.report().r2_hat).abs() < 1e-14);
    // The scaled meshes with the same densities integrate to the scaled masses.
    let part =
        |f: &wingbeat_model::Animal| f.parts[1].mass.mass / integrate::volume(&f.parts[1].mesh);
    assert!((part(&big) / part(&fly) - 1.0).abs() < 1e-13);
}

#[test]
fn invariant_wing_pair_of_the_fly_is_mirror_symmetric() {
    let fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    let (left, right) = (&fly.wings[0], &fly.wings[1]);
    assert_eq!((left.side, right.side), (Side::Left, Side::Right));
    let total = left.mass + right.mass;
    assert_eq!(total.first_moment.y, 0.0);
    assert_eq!([total.inertia.x_axis.y, total.inertia.y_axis.z], [0.0, 0.0]);
    assert_eq!(left.mirrored("right"), *right);
    // The body is symmetric but for rounding of sums in a different order.
    assert!(fly.body.first_moment.y.abs() < 1e-14 * fly.body.mass * fly.body_length());
}
