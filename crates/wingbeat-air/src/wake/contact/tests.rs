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
