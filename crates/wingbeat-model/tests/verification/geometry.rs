//! Surfaces of revolution are closed, outward, symmetric and converge to their solids.

use wingbeat_math::DVec3;
use wingbeat_model::mesh::integrate;
use wingbeat_model::species::{FlyOptions, drosophila_melanogaster};
use wingbeat_model::{Profile, QuadMesh, Revolution};

fn shapes() -> Vec<Revolution> {
    let base = Revolution::ellipsoid(DVec3::new(0.3, 0.0, -0.2), 2.0, 0.5, [6, 8]);
    let table = vec![(0.0, 0.0), (0.2, 0.7), (0.7, 1.0), (1.0, 0.0)];
    vec![
        base.clone(),
        Revolution {
            direction: DVec3::new(1.0, 0.0, -0.3),
            profile: Profile::Superellipse { exponent: 2.5 },
            stations: 2,
            meridians: 4,
            ..base.clone()
        },
        Revolution {
            direction: DVec3::new(0.2, 1.0, 0.4),
            profile: Profile::Table(table),
            stations: 9,
            meridians: 14,
            ..base
        },
    ]
}

#[test]
fn invariant_every_surface_of_revolution_is_closed_outward_and_a_sphere_in_topology() {
    for shape in shapes() {
        let m = shape.mesh("part").unwrap();
        assert_eq!(crate::euler_characteristic(&m), 2);
        let (s, n) = (shape.stations, shape.meridians);
        assert_eq!(m.nodes.len(), (s - 1) * n + 2);
        assert_eq!(m.quads.len(), (s - 1) * n);
        for p in 0..m.quads.len() {
            let [a, b, c, d] = m.corners(p);
            let normal = (c - a).cross(d - b);
            let out = (a + b + c + d) / 4.0 - shape.centre;
            assert!(normal.dot(out) > 0.0, "panel {p} looks inward"); // convex about its centre
            let mut nodes = m.quads[p];
            nodes.sort_unstable();
            assert!(nodes.windows(2).all(|w| w[0] != w[1]));
        }
    }
}

#[test]
fn exact_poles_stand_one_length_apart_and_nodes_lie_on_the_ellipsoid() {
    let shape = &shapes()[0];
    let m = shape.mesh("part").unwrap();
    assert_eq!(m.nodes[0] - m.nodes[1], DVec3::new(2.0, 0.0, 0.0));
    for x in &m.nodes {
        let r = *x - shape.centre;
        let on = r.x * r.x + (r.y * r.y + r.z * r.z) / 0.25;
        assert!((on - 1.0).abs() < 1e-14); // a few roundings
    }
}

#[test]
fn invariant_a_part_in_the_symmetry_plane_is_its_own_mirror_image_bit_for_bit() {
    let bits = |x: DVec3| (x + DVec3::ZERO).to_array().map(f64::to_bits); // -0 + 0 = 0
    let sorted = |m: &QuadMesh| {
        let mut all: Vec<_> = m.nodes.iter().map(|&x| bits(x)).collect();
        all.sort_unstable();
        all
    };
    for shape in &shapes()[..2] {
        let m = shape.mesh("part").unwrap();
        assert_eq!(sorted(&m), sorted(&m.map(wingbeat_math::mirrored)));
    }
}

#[test]
fn order_ellipsoid_volume_and_inertia_converge_at_second_order() {
    let (a, r) = (1.0_f64, 0.5_f64); // semi-axes along and across
    let volume = 4.0 / 3.0 * std::f64::consts::PI * a * r * r;
    let inertia = [0.4 * r * r, 0.2 * (a * a + r * r)]; // per unit mass
    let errors = |n: usize| {
        let shape = Revolution::ellipsoid(DVec3::ZERO, 2.0 * a, r, [n, 2 * n]);
        let solid = integrate::solid(&shape.mesh("part").unwrap(), 1.0);
        let j = solid.inertia;
        [
            volume - solid.mass,
            volume * inertia[0] - j.x_axis.x,
            volume * inertia[1] - j.y_axis.y,
            volume * inertia[1] - j.z_axis.z,
        ]
    };
    let (coarse, fine) = (errors(16), errors(32));
    for k in 0..4 {
        let order = (coarse[k] / fine[k]).log2();
        // The next term of the error is (1/16)^2 of the leading one: 0.1 in the order is ample.
        assert!((order - 2.0).abs() < 0.1, "quantity {k}: order {order}");
        assert!(coarse[k] > 0.0); // an inscribed polyhedron is too small
    }
}

#[test]
fn exact_parts_of_the_fly_do_not_touch_and_its_wings_stay_outside_them() {
    let fly = drosophila_melanogaster(&FlyOptions::default()).unwrap();
    for k in 1..3 {
        let (front, rear) = (fly.parts[k - 1].mesh.bounds(), fly.parts[k].mesh.bounds());
        let gap = front[0].x - rear[1].x;
        // Coaxial ellipsoids one behind the other: the gap of 0.02 mm is between the poles.
        assert!((gap - 0.02e-3).abs() < 1e-9, "gap {gap}");
    }
    let inside = |x: DVec3| {
        fly.parts.iter().any(|p| {
            let [lo, hi] = p.mesh.bounds();
            let (c, half) = ((lo + hi) * 0.5, (hi - lo) * 0.5);
            ((x - c) / half).length_squared() < 1.0
        })
    };
    for step in 0..100 {
        let t = 5e-3 + step as f64 * 5e-5; // one beat after the start
        for wing in &fly.wings {
            let c = wingbeat_math::RotationLaw::at(&wing.motion, t).c;
            let hit = wing
                .mesh
                .nodes
                .iter()
                .find(|&&x| inside(wing.hinge_b + c * x));
            assert!(hit.is_none(), "{} wing inside the body at {t}", wing.name);
        }
    }
}
