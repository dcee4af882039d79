//! Prescribed deformation: closed forms, analytic derivatives, symmetry, bad input.

use std::f64::consts::TAU;
use wingbeat_math::{DVec3, r2};
use wingbeat_model::deformation::{SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{
    AngleLaw, Deformation, DeformingMesh, GridMesh, MassInput, Planform, Side, Start, Wing,
    WingMotion, WingShape,
};

const ROOT: f64 = 0.2;

fn shape() -> WingShape {
    let planform = Planform::Outline {
        leading: vec![(ROOT, 0.3), (0.8, 0.4), (1.5, 0.25)],
        trailing: vec![(ROOT, -0.4), (1.0, -0.6), (1.5, -0.1)],
        least_chord: 0.1,
    };
    WingShape::uniform(planform, 4, 6)
}

fn wing(side: Side, frequency: f64) -> Wing {
    let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
    motion.angles.phi = AngleLaw::Constant(0.3);
    motion.frequency = frequency;
    motion.start = Start::Smooth { duration: 0.4 };
    let mass = MassInput::Total(0.1);
    Wing::new("wing", side, DVec3::ZERO, &shape(), &mass, motion).unwrap()
}

fn term(root: f64, tip: f64, time: Fourier) -> Term {
    let span = SpanLaw::Linear { root, tip };
    Term { span, time }
}

fn series(mean: f64, cos: &[f64], sin: &[f64]) -> Fourier {
    let (cos, sin) = (cos.to_vec(), sin.to_vec());
    Fourier { mean, cos, sin }
}

/// Everything at once, two terms of twist among it.
fn everything() -> Deformation {
    let table = SpanLaw::Table(vec![(0.0, 0.0), (0.5, 0.02), (1.0, 0.3)]);
    Deformation {
        axis_fraction: 0.3,
        camber_peak: 0.4,
        twist: vec![
            term(0.1, 0.5, series(0.2, &[0.3], &[1.0, -0.2])),
            Term::steady(SpanLaw::constant(-0.15)),
        ],
        camber: vec![term(0.02, 0.1, series(1.0, &[], &[0.7]))],
        bending: vec![Term {
            span: table,
            time: series(0.0, &[1.0, 0.1], &[0.2]),
        }],
        surface: None,
    }
}

fn at(mesh: &DeformingMesh, phase: [f64; 3]) -> Vec<[DVec3; 3]> {
    let mut all = vec![[DVec3::NAN; 3]; 35];
    mesh.visit(phase, |n, state| all[n] = state);
    all
}

#[test]
fn order_velocities_and_accelerations_are_those_of_the_places() {
    let wing = wing(Side::Right, 3.0);
    let mesh = DeformingMesh::new(&wing.mesh, &everything());
    // In the smooth start, where the phase itself is accelerated, and after it.
    for t in [0.17, 0.31, 1.23] {
        let error = |h: f64| -> [f64; 2] {
            let [before, now, after] =
                [t - h, t, t + h].map(|t| at(&mesh, wing.motion.phase_at(t)));
            let mut worst = [0.0_f64; 2];
            for n in 0..now.len() {
                let [x, v, a] = now[n];
                let slope = (after[n][0] - before[n][0]) / (2.0 * h);
                let bend = (after[n][0] - 2.0 * x + before[n][0]) / (h * h);
                worst = [
                    worst[0].max((slope - v).length()),
                    worst[1].max((bend - a).length()),
                ];
            }
            worst
        };
        let (coarse, fine) = (error(2e-3), error(1e-3));
        for k in 0..2 {
            let order = (coarse[k] / fine[k]).log2();
            println!(
                "t = {t}: derivative {}: {:.2e}, order {order:.3}",
                k + 1,
                fine[k]
            );
            // Central differences are of second order; the rest is their next term.
            assert!((order - 2.0).abs() < 0.05, "{coarse:?} {fine:?}");
        }
    }
}

#[test]
fn exact_constant_twist_is_a_rotation_about_the_axis() {
    let rest = wing(Side::Right, 0.0).mesh;
    let twist = 0.4;
    let mesh = DeformingMesh::new(
        &rest,
        &Deformation {
            axis_fraction: 0.6,
            twist: vec![Term::steady(SpanLaw::constant(twist))],
            ..Deformation::default()
        },
    );
    for (n, x) in mesh.places(0.3).into_iter().enumerate() {
        let j = n % (rest.cols + 1);
        let [lead, trail] = [0, rest.rows].map(|i| rest.nodes[rest.node(i, j)].x);
        let axis = DVec3::new(lead + 0.6 * (trail - lead), rest.nodes[n].y, 0.0);
        let turned = axis + r2(twist) * (rest.nodes[n] - axis);
        assert!((x - turned).length() < 1e-15); // a few roundings of lengths of 1
        // The leading edge goes towards -axis 3.
        assert!(n > rest.cols || x.z < 0.0);
    }
}

#[test]
fn exact_camber_and_bending_have_the_written_heights() {
    let rest = wing(Side::Left, 0.0).mesh;
    let table = vec![(0.1, 0.0), (0.4, 0.01), (1.0, 0.2)];
    let deformation = Deformation {
        camber_peak: 0.25,
        camber: vec![Term::steady(SpanLaw::Linear {
            root: 0.04,
            tip: 0.1,
        })],
        bending: vec![Term::steady(SpanLaw::Table(table))],
        ..Deformation::default()
    };
    let mesh = DeformingMesh::new(&rest, &deformation);
    let places = mesh.places(0.0);
    for j in 0..=rest.cols {
        let r = rest.nodes[j].y.abs() / 1.5;
        let bending = if r < 0.4 {
            0.01 * (r - 0.1) / 0.3
        } else {
            0.01 + 0.19 * (r - 0.4) / 0.6
        };
        let height = 0.04 + 0.06 * (1.5 * r - ROOT) / (1.5 - ROOT);
        let column = |i: usize| places[rest.node(i, j)];
        let chord = column(0).x - column(4).x;
        // Edges are bent alone; row 1 of 4 lies under the peak.
        for i in [0, 4] {
            assert!((column(i).z + bending).abs() < 1e-15);
        }
        assert!((column(1).z + bending + height * chord).abs() < 1e-15);
        // Aft of the peak the second parabola of the four-digit series, s = 3/4.
        let aft = (0.5 + 2.0 * 0.25 * 0.75 - 0.75 * 0.75) / 0.5625;
        assert!((column(3).z + bending + height * aft * chord).abs() < 1e-15);
    }
}

#[test]
fn exact_no_amplitude_leaves_every_bit() {
    let rest = wing(Side::Right, 0.0).mesh;
    let none = |_: &Term| term(0.0, 0.0, series(0.3, &[1.0], &[2.0]));
    let full = everything();
    let mesh = DeformingMesh::new(
        &rest,
        &Deformation {
            twist: full.twist.iter().map(none).collect(),
            camber: full.camber.iter().map(none).collect(),
            bending: full.bending.iter().map(none).collect(),
            ..full
        },
    );
    for (n, [x, v, a]) in at(&mesh, [0.37, 4.0, 5.0]).into_iter().enumerate() {
        assert_eq!((x, v, a), (rest.nodes[n], DVec3::ZERO, DVec3::ZERO));
    }
}

#[test]
fn invariant_mirror_and_scale() {
    let [right, left]: [GridMesh; 2] = [Side::Right, Side::Left].map(|s| wing(s, 0.0).mesh);
    let d = everything();
    let states = [&right, &left].map(|m| at(&DeformingMesh::new(m, &d), [0.37, 4.0, 5.0]));
    for (r, l) in states[0].iter().zip(&states[1]) {
        for k in 0..3 {
            assert_eq!(wingbeat_math::mirrored(r[k]), l[k]);
        }
    }
    // Twice the size: all places twice as far, to a rounding of the quotients.
    let large = DeformingMesh::new(&right.scaled(2.0), &d.scaled(2.0)).places(0.37);
    for (x, y) in states[0].iter().zip(&large) {
        assert!((2.0 * x[0] - y).length() < 1e-15);
    }
    let moved = states[0].iter().zip(&right.nodes);
    assert!(
        moved
            .into_iter()
            .all(|(x, rest)| (x[0] - *rest).length() > 1e-3)
    ); // not nothing
}

#[test]
fn exact_period_of_a_beat() {
    let mesh = DeformingMesh::new(&wing(Side::Right, 1.0).mesh, &everything());
    let [a, b] = [0.125, 5.125].map(|x| at(&mesh, [x, TAU, 0.0]));
    assert_eq!(a, b); // exact binary phases
}

#[test]
fn refuses_laws_that_do_not_fit() {
    let with = |change: &dyn Fn(&mut Deformation)| {
        let mut d = everything();
        change(&mut d);
        wing(Side::Right, 2.0)
            .deformed_by(d)
            .unwrap_err()
            .to_string()
    };
    let says = |text: String, parts: &[&str]| {
        for part in parts {
            assert!(text.contains(part), "`{text}` does not say `{part}`");
        }
    };
    let table =
        |rows: Vec<(f64, f64)>| with(&move |d| d.bending[0].span = SpanLaw::Table(rows.clone()));
    let key = "wing.deformation.bending[0].table";
    says(
        table(vec![(0.5, 0.0), (1.0, 1.0)]),
        &[key, "row 1", "cover"],
    );
    says(
        table(vec![(0.0, 0.0), (0.9, 1.0)]),
        &[key, "row 2", "cover"],
    );
    says(
        table(vec![(0.0, 0.0), (0.7, 1.0), (0.7, 2.0), (1.0, 0.0)]),
        &["row 3", "does not increase"],
    );
    says(table(vec![(0.0, 0.0), (1.0, f64::NAN)]), &["row 2", "NaN"]);
    says(table(vec![(1.0, 0.0)]), &["2 rows"]);
    says(
        with(&|d| d.twist[1].span = SpanLaw::constant(f64::INFINITY)),
        &["twist[1]", "inf"],
    );
    says(with(&|d| d.camber_peak = 1.0), &["camber_peak = 1"]);
    says(with(&|d| d.axis_fraction = f64::NAN), &["axis_fraction"]);
    says(
        with(&|d| d.camber[0].time.sin[0] = f64::NAN),
        &["camber[0].fourier.sin[0]"],
    );
    let still = wing(Side::Right, 0.0).deformed_by(everything());
    says(still.unwrap_err().to_string(), &["twist[0]", "frequency"]);
}
