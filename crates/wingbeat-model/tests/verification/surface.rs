//! Measured surfaces: series that are recovered, laws that say the same, symmetry, bad input.

use std::f64::consts::TAU;
use wingbeat_math::DVec3;
use wingbeat_model::deformation::{MovingSurface, SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{
    Deformation, DeformingMesh, MassInput, Planform, Side, Wing, WingMotion, WingShape,
};

/// A rectangle of chord 2 and span 3, half a unit outboard of the hinge.
fn wing(side: Side) -> Wing {
    let planform = Planform::Outline {
        leading: vec![(0.5, 0.5), (3.5, 0.5)],
        trailing: vec![(0.5, -1.5), (3.5, -1.5)],
        least_chord: 0.1,
    };
    let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
    motion.frequency = 2.0;
    let mass = MassInput::Total(0.1);
    let shape = WingShape::uniform(planform, 4, 6);
    Wing::new("wing", side, DVec3::ZERO, &shape, &mass, motion).unwrap()
}

/// Place of the point at these parts of chord and span, of two harmonics in the phase and bilinear in the
/// parts, with its first two derivatives by the phase.
fn place([s, t]: [f64; 2], x: f64) -> [DVec3; 3] {
    let wave = |k: f64, d: i32| (TAU * k).powi(d) * (TAU * k * x + f64::from(d) * TAU / 4.0).sin();
    let of = |d: i32| {
        let rest = DVec3::new(0.7 - 2.0 * s, 0.4 + 3.0 * t, 0.1 * s * t);
        let rest = if d == 0 { rest } else { DVec3::ZERO };
        rest + DVec3::new(0.2 * t, -0.1 * s * t, t - 0.3 * s) * wave(1.0, d)
            + DVec3::new(0.05 * s, 0.02 * t, 0.1 * s * t) * wave(2.0, d)
    };
    [of(0), of(1), of(2)]
}

fn sampled(phases: &[f64], [rows, cols]: [usize; 2], harmonics: usize) -> Deformation {
    let part = |k: usize, n: usize| k as f64 / (n - 1) as f64;
    let row = |x: f64, i: usize| {
        let point = |j: usize| place([part(i, rows), part(j, cols)], x)[0];
        (0..cols).map(point).collect()
    };
    let at = |x: &f64| (0..rows).map(|i| row(*x, i)).collect();
    let surface = MovingSurface {
        phases: phases.to_vec(),
        places: phases.iter().map(at).collect(),
        harmonics,
    };
    Deformation {
        surface: Some(surface),
        ..Deformation::default()
    }
}

/// Nine phases that are not equally far apart.
const PHASES: [f64; 9] = [0.02, 0.13, 0.21, 0.36, 0.44, 0.55, 0.7, 0.78, 0.91];

#[test]
fn exact_series_are_recovered_between_the_phases() {
    let wing = wing(Side::Right);
    for (points, harmonics) in [([2, 2], 2), ([3, 5], 3)] {
        let mesh = DeformingMesh::new(&wing.mesh, &sampled(&PHASES, points, harmonics));
        let (x, x1, x2) = (3.287, 2.0, -5.0);
        let mut seen = 0;
        mesh.visit([x, x1, x2], |n, [p, v, a]| {
            let [i, j] = [n / 7, n % 7];
            let [q, q1, q2] = place([i as f64 / 4.0, j as f64 / 6.0], x);
            // Roundings of the least squares, times (2 pi 3)^2 in accelerations.
            assert!((p - q).length() < 1e-13);
            assert!((v - q1 * x1).length() < 1e-12);
            assert!((a - q2 * x1 * x1 - q1 * x2).length() < 1e-10);
            seen += 1;
        });
        assert_eq!(seen, 35);
    }
}

#[test]
fn agrees_with_a_law_of_bending() {
    let wing = wing(Side::Left);
    let time = Fourier {
        mean: 0.1,
        cos: vec![0.3],
        sin: vec![-0.2],
    };
    let law = Deformation {
        bending: vec![Term {
            span: SpanLaw::Linear {
                root: 0.0,
                tip: 0.6,
            },
            time,
        }],
        ..Deformation::default()
    };
    let by_law = DeformingMesh::new(&wing.mesh, &law);
    let outboard = |x: DVec3| DVec3::new(x.x, -x.y, x.z); // this wing is a left one
    let at = |x: &f64| -> Vec<Vec<DVec3>> {
        let places: Vec<DVec3> = by_law.places(*x).into_iter().map(outboard).collect();
        places.chunks(7).map(<[DVec3]>::to_vec).collect()
    };
    let surface = MovingSurface {
        phases: PHASES.to_vec(),
        places: PHASES.iter().map(at).collect(),
        harmonics: 2,
    };
    let measured = Deformation {
        surface: Some(surface),
        ..Deformation::default()
    };
    let measured = DeformingMesh::new(&wing.mesh, &measured);
    let states = [&by_law, &measured].map(|m| {
        let mut all = vec![[DVec3::NAN; 3]; 35];
        m.visit([0.613, 2.0, 1.0], |n, state| all[n] = state);
        all
    });
    for (a, b) in states[0].iter().zip(&states[1]) {
        for (a, b, tolerance) in [
            (a[0], b[0], 1e-13),
            (a[1], b[1], 1e-12),
            (a[2], b[2], 1e-10),
        ] {
            assert!((a - b).length() < tolerance, "{a} {b}"); // as above
        }
    }
}

#[test]
fn invariant_mirror_and_scale_of_a_surface() {
    let d = sampled(&PHASES, [3, 4], 2);
    let [right, left] = [Side::Right, Side::Left].map(|s| wing(s).mesh);
    let [a, b] = [&right, &left].map(|m| DeformingMesh::new(m, &d).places(0.4));
    let large = DeformingMesh::new(&right.scaled(2.0), &d.scaled(2.0)).places(0.4);
    for ((a, b), c) in a.iter().zip(&b).zip(&large) {
        assert_eq!(wingbeat_math::mirrored(*a), *b);
        assert!((*a * 2.0 - *c).length() < 1e-14); // roundings of quotients
    }
}

#[test]
fn refuses_surfaces_that_do_not_fit() {
    let with = |change: &dyn Fn(&mut MovingSurface)| {
        let mut d = sampled(&PHASES, [3, 4], 2);
        change(d.surface.as_mut().unwrap());
        let error = wing(Side::Right).deformed_by(d).unwrap_err();
        error.to_string()
    };
    for (change, said) in [
        (
            &(|s: &mut MovingSurface| s.phases[3] = 0.2) as &dyn Fn(&mut MovingSurface),
            "rise",
        ),
        (&|s| s.phases[8] = 1.02, "a beat or more"),
        (&|s| s.harmonics = 0, "without harmonics"),
        (&|s| s.harmonics = 4, "0.1500 wingbeats later"),
        (&|s| s.phases.truncate(5), "fewer harmonics"),
        (&|s| s.places.truncate(8), "8 surfaces for 9 phases"),
        (&|s| s.places[4].truncate(1), "at least 2 rows"),
        (&|s| s.places[4][1].truncate(3), "a row of 3 points"),
        (&|s| s.places[4][1][2].z = f64::NAN, "not finite"),
    ] {
        let error = with(change);
        assert!(error.contains(said), "`{error}` does not say `{said}`");
    }
    let mut both = sampled(&PHASES, [3, 4], 2);
    both.twist = vec![Term::steady(SpanLaw::constant(0.1))];
    let error = wing(Side::Right).deformed_by(both).unwrap_err().to_string();
    assert!(error.contains("beside a surface"), "{error}");
}
