//! Planforms have the size and shape that was asked for.

use std::f64::consts::PI;

use wingbeat_math::{DVec3, MassProperties};
use wingbeat_model::planform::{Beta, BetaChord, ChordSize, Landmarks};
use wingbeat_model::{
    Animal, GridMesh, MassInput, Planform, Side, Spacing, Wing, WingMotion, WingReport, WingShape,
};

fn wing(shape: &WingShape) -> Wing {
    let mass = MassInput::Given(MassProperties::ZERO);
    let motion = WingMotion::fixed(0.0, [0.0; 3]);
    Wing::new("wing", Side::Right, DVec3::ZERO, shape, &mass, motion).unwrap()
}

fn square(axis_fraction: f64) -> WingShape {
    let planform = Planform::Rectangle {
        chord: 4.0,
        span: 4.0,
        root_offset: 0.0,
        axis_fraction,
    };
    WingShape::uniform(planform, 4, 4)
}

fn beta() -> Beta {
    Beta {
        length: 2.5,
        size: ChordSize::Mean(0.7),
        r2_hat: 0.586,
        root_offset: 0.1,
        axis_fraction: 0.25,
        least_chord: 0.2,
    }
}

fn report(planform: Planform, n: usize) -> WingReport {
    wing(&WingShape::uniform(planform, 4, n)).report()
}

#[test]
fn exact_a_four_by_four_square_has_its_nodes_at_integers() {
    let mesh = square(0.0).mesh("wing", Side::Right).unwrap();
    for i in 0..=4 {
        for j in 0..=4 {
            let at = mesh.nodes[mesh.node(i, j)];
            assert_eq!(at, DVec3::new(-(i as f64), j as f64, 0.0));
        }
    }
    let r = wing(&square(0.25)).report();
    assert_eq!(
        [r.length, r.area, r.max_chord, r.mean_chord],
        [4.0, 16.0, 4.0, 4.0]
    );
}

#[test]
fn exact_wing_length_is_along_the_span_and_reach_to_the_farthest_corner() {
    // A square of 4 m whose axis lies at a quarter of the chord: the corner behind at the tip is 3 m and 4 m
    // away.
    let wings = vec![wing(&square(0.25)), wing(&square(0.25)).mirrored("left")];
    let animal = Animal {
        name: "square".into(),
        body: MassProperties::ZERO,
        parts: vec![],
        wings,
        segments: vec![],
    };
    assert_eq!([animal.wing_length(), animal.wing_reach()], [4.0, 5.0]);
    assert!(animal.wing_reports().iter().all(|r| r.length == 4.0));
}

#[test]
fn invariant_normals_are_plus_three_on_both_sides_and_left_mirrors_right_bit_for_bit() {
    let shape = WingShape {
        chordwise: Spacing::Cosine,
        spanwise: Spacing::Cosine,
        ..WingShape::uniform(Planform::Beta(beta()), 5, 7)
    };
    let right = shape.mesh("wing", Side::Right).unwrap();
    let left = shape.mesh("wing", Side::Left).unwrap();
    assert_eq!(left, right.mirrored());
    let normals = |m: &GridMesh, side| {
        let quads = m.to_quads(side);
        (0..35).map(move |p| {
            let [a, b, c, d] = quads.corners(p);
            (c - a).cross(d - b)
        })
    };
    for (r, l) in normals(&right, Side::Right).zip(normals(&left, Side::Left)) {
        assert!(r.z > 0.0 && r == l);
    }
    let one = wing(&shape);
    let other = one.mirrored("left");
    assert_eq!(other.mesh, left);
    assert_eq!(other.mirrored("wing"), one);
}

#[test]
fn exact_beta_moments_have_the_closed_form_of_the_beta_function() {
    // Without a least chord the mean of the distribution is r1 and its second moment
    // (0.929 r1^0.732)^2 [Ellington 1984 II].
    for r1 in [0.42_f64, 0.53, 0.65] {
        let [m0, m1, m2] = BetaChord::of_r1(r1, 0.0).moments();
        let r2 = 0.929 * r1.powf(0.732);
        // Simpson's rule meets the weak end singularity xi^(p-1), p > 1.1, here: 1e-6.
        assert!((m1 / m0 - r1).abs() < 1e-6);
        assert!((m2 / m0 - r2 * r2).abs() < 1e-6);
    }
}

#[test]
fn exact_the_beta_wing_keeps_length_chord_and_r2_hat_as_given() {
    let r = report(Planform::Beta(beta()), 400);
    assert_eq!(r.length, 2.5);
    // 400 trapezoids along the span: relative error of order (1/400)^2.
    assert!((r.mean_chord / 0.7 - 1.0).abs() < 2e-5, "{}", r.mean_chord);
    assert!((r.r2_hat / 0.586 - 1.0).abs() < 2e-5, "{}", r.r2_hat);
    let by_max = Beta {
        size: ChordSize::Max(r.max_chord),
        ..beta()
    };
    let same = report(Planform::Beta(by_max), 400);
    assert!((same.area / r.area - 1.0).abs() < 1e-4); // largest chord read between two lines
    let area = Beta {
        size: ChordSize::Area(1.75),
        ..beta()
    };
    assert!((report(Planform::Beta(area), 400).area / 1.75 - 1.0).abs() < 2e-5);
}

/// Straight lines between places on the edge would lose 5 and 8 % of area and second moment in five panels.
#[test]
fn exact_meshes_have_area_and_moments_of_their_planform() {
    for n in [1, 2, 5, 10, 40] {
        let r = report(Planform::Beta(beta()), n);
        println!("{n} panels: {:.6}, {:.6}", r.area, r.r2_hat);
        // Quadrature of a curve with two kinks.
        assert!((r.area / 1.75 - 1.0).abs() < 1e-5, "{n}: {}", r.area);
        let least = [0.03, 5e-3, 3e-4][usize::from(n > 1) + usize::from(n > 2)];
        assert!((r.r2_hat / 0.586 - 1.0).abs() < least, "{n}: {}", r.r2_hat);
    }
}

#[test]
fn exact_outline_of_a_trapezium_and_the_same_as_a_polygon() {
    let outline = Planform::Outline {
        leading: vec![(0.0, 0.5), (2.0, 0.25)],
        trailing: vec![(0.0, -1.5), (2.0, -0.75)],
        least_chord: 0.1,
    };
    let r = report(outline, 8);
    assert!((r.area - 3.0).abs() < 1e-14); // (2 + 1) / 2 x 2
    assert!((r.max_chord - 2.0).abs() < 1e-14 && r.length == 2.0);
    let corners = [(2.0, -0.75), (0.0, -1.5), (0.0, 0.5), (2.0, 0.25)];
    let polygon = Planform::from_polygon(&corners, 0.1).unwrap();
    assert_eq!(report(polygon, 8), r);
    let mut other_way = corners;
    other_way.reverse();
    assert_eq!(
        report(Planform::from_polygon(&other_way, 0.1).unwrap(), 8),
        r
    );
}

/// An ellipse in a picture that counts downwards, turned, in pixels, its contour begun anywhere, with a hair
/// and a notch behind it: area and second moment are `pi a b` and `pi a b (d^2 + a^2 / 4)`, d the distance of
/// its centre.
#[test]
fn exact_moments_of_an_ellipse_digitised_from_a_picture() {
    const N: usize = 720;
    let (a, b, d, pixel, turn) = (1.5, 0.4, 1.6, 1e-3, 0.7_f64);
    let hinge = [310.0, 250.0];
    let picture = |(r, x): (f64, f64)| {
        let (sin, cos) = turn.sin_cos();
        let (r, x) = (r / pixel, x / pixel);
        [hinge[0] + r * cos + x * sin, hinge[1] + r * sin - x * cos]
    };
    let around = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * (k as f64 + 0.5) / N as f64).sin_cos();
        (d + a * cos, b * sin)
    };
    let mut points: Vec<[f64; 2]> = (0..N).map(|k| picture(around((k + 100) % N))).collect();
    let marks = Landmarks {
        hinge,
        tip: picture((d + a, 0.0)),
        leading_edge: Some(picture((0.3, 0.1))),
        unit: 1.0,
    };
    let wanted = PI * a * b;
    let second = d * d + 0.25 * a * a;
    let check = |points: &[[f64; 2]]| {
        let placed = marks.scaled_to(d + a).place(points).unwrap();
        let r = report(Planform::from_polygon(&placed, 0.01).unwrap(), 40);
        let r2_hat = (second.sqrt()) / r.length;
        println!("{} {} of {wanted} {r2_hat}", r.area, r.r2_hat);
        // A polygon of 720 sides has 1 - (2 pi / 720)^2 / 6 of the area; ends are widened to a hundredth.
        assert!((r.area / wanted - 1.0).abs() < 1e-4, "{}", r.area);
        assert!((r.r2_hat / r2_hat - 1.0).abs() < 1e-4, "{}", r.r2_hat);
        placed
    };
    let placed = check(&points);
    let foremost = placed.iter().map(|p| p.1).fold(0.0, f64::max);
    assert!((foremost - b).abs() < 1e-4, "{foremost}");
    points.reverse();
    check(&points);
    // A hook inwards: points that turn back behind the rearmost ones.
    let from = points
        .iter()
        .position(|p| *p == picture(around(500)))
        .unwrap();
    let behind = [502, 506].map(around).map(|(r, x)| picture((r, x + 0.1)));
    points.splice(from..from, behind);
    check(&points);
}

/// Steps of the chord, hooks and hairs along the span: areas and second moments of their rectangles.
#[test]
fn exact_steps_hooks_and_hairs_of_a_polygon() {
    let turned = |points: &[(f64, f64)], angle: f64| {
        let (sin, cos) = f64::sin_cos(angle);
        let mark = |(r, x): (f64, f64)| [r * cos + x * sin, r * sin - x * cos];
        let marks = Landmarks {
            hinge: [0.0, 0.0],
            tip: mark((6.0, 0.0)),
            leading_edge: Some(mark((3.0, 1.0))),
            unit: 1.0,
        };
        let picture: Vec<_> = points.iter().map(|&p| mark(p)).collect();
        marks.place(&picture).unwrap()
    };
    let step = [
        (0.0, 0.5),
        (6.0, 0.5),
        (6.0, -0.5),
        (3.0, -0.5),
        (3.0, -1.5),
        (0.0, -1.5),
    ];
    let hair = [
        (0.0, 0.5),
        (6.0, 0.5),
        (6.0, -0.5),
        (4.0, -0.5),
        (4.5, -1.0),
        (4.0, -0.5),
        (0.0, -0.5),
    ];
    // A barb of the triangle (4, -0.5), (4.5, -1), (4.2, -0.5), which leaves 1/2 x 0.5 x 0.5 with its shadow.
    let hook = [
        (0.0, 0.5),
        (6.0, 0.5),
        (6.0, -0.5),
        (4.2, -0.5),
        (4.5, -1.0),
        (4.0, -0.5),
        (0.0, -0.5),
    ];
    let third = |from: f64, to: f64, chord: f64| chord * (to.powi(3) - from.powi(3)) / 3.0;
    // The triangle below -0.5 from 4 to 4.5: chord r - 4.
    let barb = 0.25 * (4.5_f64.powi(4) - 4.0_f64.powi(4)) - 4.0 * third(4.0, 4.5, 1.0);
    for (points, area, second) in [
        (&step[..], 9.0, third(0.0, 3.0, 2.0) + third(3.0, 6.0, 1.0)),
        (&hair[..], 6.125, third(0.0, 6.0, 1.0) + barb),
        (&hook[..], 6.125, third(0.0, 6.0, 1.0) + barb),
    ] {
        for angle in [0.0, 0.7] {
            let polygon = Planform::from_polygon(&turned(points, angle), 0.01).unwrap();
            let r = report(polygon, 400);
            let r2_hat = (second / area).sqrt() / 6.0;
            println!("{} of {area}, {} of {r2_hat}", r.area, r.r2_hat);
            // Steps are a billionth of the length wide: 2.5e-10 and 6.5e-11 measured.
            assert!((r.area / area - 1.0).abs() < 2e-9, "{}", r.area);
            assert!((r.r2_hat / r2_hat - 1.0).abs() < 5e-10, "{}", r.r2_hat);
        }
    }
}

#[test]
fn behaves_contours_and_landmarks_that_are_no_wing_are_refused() {
    let square = [(-0.1, 0.0), (1.0, 0.0), (1.0, 1.0), (-0.1, 1.0)];
    let said = Planform::from_polygon(&square, 0.1)
        .unwrap_err()
        .to_string();
    assert!(said.contains("behind the hinge"), "{said}");
    let a_little = [(-0.04, 0.0), (1.0, 0.0), (1.0, 1.0), (-0.04, 1.0)];
    let r = report(Planform::from_polygon(&a_little, 0.1).unwrap(), 4);
    assert!((r.area - 1.0).abs() < 1e-14 && r.length == 1.0);
    assert!(Planform::from_polygon(&square[..2], 0.1).is_err());
    assert!(Planform::from_polygon(&[(0.0, f64::NAN); 4], 0.1).is_err());
    let marks = Landmarks {
        hinge: [1.0, 1.0],
        tip: [2.0, 1.0],
        leading_edge: None,
        unit: 1.0,
    };
    assert_eq!(marks.place(&[[2.0, 3.0]]).unwrap(), [(1.0, 2.0)]);
    let on_the_line = Landmarks {
        leading_edge: Some([1.5, 1.0]),
        ..marks
    };
    let same = Landmarks {
        tip: [1.0, 1.0],
        ..marks
    };
    let lost = Landmarks {
        hinge: [f64::NAN, 0.0],
        ..marks
    };
    for wrong in [on_the_line, same, lost, same.scaled_to(1.0)] {
        assert!(wrong.place(&[[2.0, 3.0]]).is_err(), "{wrong:?}");
    }
}

/// Half of it where edges of the mesh need it: the mesh has the area of the planform, 1.04 with ends as wide as
/// a fifth of the middle.
#[test]
fn exact_a_pointed_outline_keeps_its_area_and_half_of_its_least_chord() {
    let diamond = [(0.0, 0.0), (1.0, 0.5), (2.0, 0.0), (1.0, -0.5)];
    for n in [4, 7, 40] {
        let shape = WingShape::uniform(Planform::from_polygon(&diamond, 0.2).unwrap(), 2, n);
        let mesh = shape.mesh("wing", Side::Left).unwrap();
        let chord = |j| mesh.nodes[mesh.node(0, j)].x - mesh.nodes[mesh.node(2, j)].x;
        let least = (0..=n).map(chord).fold(f64::INFINITY, f64::min);
        let area = (0..n)
            .map(|j| (chord(j) + chord(j + 1)) / n as f64)
            .sum::<f64>();
        println!("{n} panels: area {area}, least chord {least}");
        assert!(
            least > 0.0999 && (area / 1.04 - 1.0).abs() < 1e-4,
            "{n}: {area}"
        );
    }
}
