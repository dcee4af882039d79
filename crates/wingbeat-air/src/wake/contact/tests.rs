//! Single paths that meet a sheet or a body.

use super::*;

/// A sheet of 2 x 3 unit squares from the origin in the plane z = 0, folded by `fold` [1] along
/// the middle row, that rises with speed `w` during a step of one second; mirrored in y if
/// `left`.
fn sheet(w: f64, fold: f64, left: bool) -> Obstacles {
    let side = if left { -1.0 } else { 1.0 };
    let corner = |i: usize, j: usize| {
        let z = -fold * (i as f64 - 1.0).abs();
        [0.0, w].map(|rise| DVec3::new(i as f64, side * j as f64, z + rise))
    };
    let mut wing = Obstacle::default();
    for (i, j) in (0..6).map(|k| (k / 3, k % 3)) {
        let ends = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| corner(i, j));
        let panel = Panel::new(ends, [j == 0, i == 1, j == 2, i == 0]);
        let sides = (0..4).filter(|&k| panel.is_border[k]);
        (wing.border).extend(sides.map(|k| [0, 1].map(|end| panel.side(end, k))));
        wing.panels.push(panel);
    }
    wing.enclose();
    Obstacles {
        surfaces: vec![wing],
        clearance: 0.1,
        ..Obstacles::default()
    }
}

fn end(o: &Obstacles, from: [f64; 3], to: [f64; 3]) -> DVec3 {
    let mut to = [DVec3::from(to)];
    o.keep_off(&[DVec3::from(from)], &mut to, |_| true);
    to[0]
}

#[test]
fn exact_node_that_would_cross_a_wing_stays_on_its_side() {
    let o = sheet(0.0, 0.0, false);
    let stopped = end(&o, [0.5, 0.5, 0.3], [0.6, 0.5, -0.4]);
    assert!((stopped - DVec3::new(0.6, 0.5, 0.1)).length() < 1e-15);
    let beside = end(&o, [2.5, 0.5, 0.3], [2.6, 0.5, -0.4]);
    assert_eq!(beside, DVec3::new(2.6, 0.5, -0.4), "passes beside the wing");
    // The path crosses the wing more than a clearance from its edge, though it ends beyond it.
    assert!((end(&o, [1.8, 0.5, 0.01], [2.3, 0.5, -0.4]).z - 0.1).abs() < 1e-15);
    // Within a clearance of the edge the wing blocks a part only: half of it at half of that.
    let near = end(&o, [1.95, 0.5, 0.2], [1.95, 0.5, -0.2]);
    assert!((near.z - (0.5 * 0.1 + 0.5 * -0.2)).abs() < 1e-15);
}

#[test]
fn exact_rows_of_plane_wakes_are_held_back_as_their_middles() {
    let o = sheet(0.0, 0.0, false);
    let row = |z: f64| [0.0, 3.0].map(|y| DVec3::new(0.5, y, z));
    let (from, mut to, mut single) = (row(0.3), row(-0.4), row(-0.4));
    assert_eq!(o.keep_rows_off(&from, &mut to, |_| false), [2, 0]);
    let short = to.map(|x| (x.z - 0.1).abs());
    assert!(short.iter().all(|d| *d < 1e-15), "{to:?}");
    // Each by itself they pass beside the ends of the wing.
    assert_eq!(o.keep_off(&from, &mut single, |_| true), [0; 2]);
}

#[test]
fn exact_wing_that_overtakes_a_resting_node_takes_it_along() {
    let o = sheet(0.5, 0.0, false);
    let swept = end(&o, [0.5, 0.5, 0.2], [0.5, 0.5, 0.2]);
    assert!((swept - DVec3::new(0.5, 0.5, 0.6)).length() < 1e-15);
}

#[test]
fn exact_node_inside_a_body_comes_out_to_the_clearance() {
    let mut o = sheet(0.0, 0.0, false);
    o.surfaces[0].closed = true;
    assert!((end(&o, [0.5, 0.5, 0.3], [0.5, 0.4, -0.2]).z - 0.1).abs() < 1e-15);
}

/// Paths from and to places of every kind: on edges, corners and sides between panels, on the
/// surface, in the clearance and beyond.
fn paths() -> Vec<[[f64; 3]; 2]> {
    let (x, z) = ([-0.1, 0.0, 0.03, 1.0, 1.6, 2.0], [-0.2, -0.05, 0.0, 0.07]);
    let places = || {
        x.into_iter().flat_map(move |x| {
            let y = [-0.02, 0.0, 0.4, 1.0, 3.0];
            y.into_iter().flat_map(move |y| z.map(|z| [x, y, z]))
        })
    };
    places()
        .flat_map(|a| places().map(move |b| [a, b]))
        .collect()
}

/// Rounding decides nothing: places moved by some roundings give ends that are moved by no more
/// than their heights over the surface are uncertain, 1e-15 over a thousandth of a clearance.
#[test]
fn invariant_push_is_continuous_on_edges_and_between_panels() {
    let mut largest = 0.0_f64;
    for o in [sheet(0.0, 0.0, false), sheet(0.1, 0.2, false)] {
        for [from, to] in paths() {
            let place = end(&o, from, to);
            for k in [0, 11, 22, 37, 42, 63] {
                let moved = |p: [f64; 3], bits: usize| -> [f64; 3] {
                    std::array::from_fn(|i| {
                        let sign = if bits >> i & 1 == 0 { 1.0 } else { -1.0 };
                        p[i] + sign * 1e-15
                    })
                };
                let other = end(&o, moved(from, k), moved(to, k >> 3));
                largest = largest.max(place.distance(other));
            }
        }
    }
    println!("largest change {largest:.1e}");
    assert!(largest < 1e-10);
}

#[test]
fn invariant_mirrored_path_ends_at_the_mirrored_place() {
    let mut largest = 0.0_f64;
    for (w, fold) in [(0.0, 0.0), (0.1, 0.2)] {
        let [right, left] = [false, true].map(|left| sheet(w, fold, left));
        for [from, to] in paths() {
            let mirrored = |p: [f64; 3]| [p[0], -p[1], p[2]];
            let b = end(&left, mirrored(from), mirrored(to));
            let a = end(&right, from, to);
            largest = largest.max(a.distance(DVec3::new(b.x, -b.y, b.z)));
        }
    }
    assert!(largest < 1e-14, "{largest:.1e}");
}

/// A spheroid of 6 stations by 8 meridians and semi-axes 1 and 0.76 that moves by `way` within the step.
fn spheroid(way: DVec3) -> Obstacles {
    use std::f64::consts::PI;
    let corner = |i: usize, k: usize| {
        let (along, meridian) = (i as f64 / 3.0 - 1.0, 0.25 * PI * k as f64);
        let radius = 0.76 * (1.0 - along * along).sqrt();
        let x = DVec3::new(along, radius * meridian.cos(), radius * meridian.sin());
        [x, x + way]
    };
    let mut body = Obstacle {
        closed: true,
        ..Obstacle::default()
    };
    for (i, k) in (0..48).map(|n| (n / 8, n % 8)) {
        let ends = [(i, k), (i, k + 1), (i + 1, k + 1), (i + 1, k)].map(|(i, k)| corner(i, k));
        body.panels.push(Panel::new(ends, [false; 4]));
    }
    body.enclose();
    Obstacles {
        surfaces: vec![body],
        clearance: 0.126,
        ..Obstacles::default()
    }
}

/// Places in even directions all around, at distances from the centre that grow by a thousandth of a clearance
/// from inside the body to three clearances beyond it.
fn rays(clearance: f64) -> impl Iterator<Item = Vec<DVec3>> {
    (0..200).map(move |n| {
        let x = (2 * n + 1) as f64 / 200.0 - 1.0;
        let (around, radius) = (2.399963 * n as f64, (1.0 - x * x).sqrt());
        let direction = DVec3::new(x, radius * around.cos(), radius * around.sin());
        let distance = |k: u32| 0.9 + 1e-3 * clearance * f64::from(k);
        (0..3800).map(|k| distance(k) * direction).collect()
    })
}

#[test]
fn invariant_push_of_a_coarse_body_is_continuous_and_ends_two_clearances_from_it() {
    let o = spheroid(DVec3::ZERO);
    let (mut steepest, mut beyond) = (0.0_f64, 0.0_f64);
    for ray in rays(o.clearance) {
        let pushes: Vec<DVec3> = ray.iter().map(|x| o.push(*x, *x)).collect();
        for (pair, x) in pushes.windows(2).zip(&ray) {
            steepest = steepest.max(pair[0].distance(pair[1]) / (1e-3 * o.clearance));
            if x.length() > 1.0 + o.clearance {
                beyond = beyond.max(pair[0].length() / o.clearance);
            }
            assert!(x.length() < 1.0 + 2.0 * o.clearance || pair[0] == DVec3::ZERO);
        }
    }
    println!("steepest {steepest:.2}, beyond a clearance {beyond:.3} clearances");
    // Of a distance, and what fades out; a jump of a hundredth of a clearance has a slope of 10. Planes that
    // are tilted push beyond a clearance.
    assert!(steepest < 1.5 && beyond > 0.01);
}

#[test]
fn invariant_push_of_bodies_and_wings_under_the_motion_of_the_observer() {
    let mut largest = 0.0_f64;
    let way = DVec3::new(7.0, -3.0, 11.0);
    let [rest, moving] = [DVec3::ZERO, way].map(spheroid);
    for x in rays(rest.clearance).flat_map(|ray| ray.into_iter().step_by(50)) {
        let from = x - DVec3::new(0.3, 0.1, -0.2);
        largest = largest.max(rest.push(from, x).distance(moving.push(from, x + way)));
    }
    // Rise of the sheet of the other tests, and so of all that is around it.
    let [rest, moving] = [0.0, 40.0].map(|w| sheet(w, 0.2, false));
    let rise = 40.0 * DVec3::Z;
    for [from, to] in paths() {
        let [from, to] = [from, to].map(DVec3::from);
        largest = largest.max(rest.push(from, to).distance(moving.push(from, to + rise)));
    }
    println!("largest change {largest:.1e}");
    // Roundings of places 40 away.
    assert!(largest < 5e-13);
}
