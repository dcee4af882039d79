//! The averaged and the periodic problem of hover against a second program, written from the formulas alone.
//!
//! The crates and [`crate::common::quasi_steady`] share the numbers of the case (masses, strips, coefficients of the
//! angles, the start of the trimmed beat) and nothing else. Compared are, for the fruit fly (wings of 1.1 % of the
//! mass, Fourier series of the measured strokes) and the hawkmoth (5.7 %, feathering between sine and square wave):
//! mean lift and power, the 36 derivatives of the mean loads, the modes of the averaged rigid body, the closure of
//! the trimmed orbit and Floquet's multipliers.

use wingbeat_analysis::*;
use wingbeat_blade::Translation;
use wingbeat_flight::{AirModel, FlightSetup};
use wingbeat_math::{DMat3, DVec3, MassProperties};
use wingbeat_model::AngleLaw;

use crate::common::flight_laws::{Means, State, eigenvalues};
use crate::common::quasi_steady::{Flyer, Law, Mass, Matrix, Sections, Strip, Wing, about};
use crate::common::{fly, hover, moth};

/// Longitudinal and lateral components of u, v, w, p, q, r, phi, theta, psi.
const PLANES: [&[usize]; 2] = [&[0, 2, 4, 7], &[1, 3, 5, 6, 8]];

fn law(law: &AngleLaw) -> Law {
    match law {
        AngleLaw::Constant(q) => Law::Series(*q, vec![], vec![]),
        AngleLaw::Fourier(f) => Law::Series(f.mean, f.cos.clone(), f.sin.clone()),
        AngleLaw::SmoothSquare(f) => Law::Square([f.mean, f.amplitude, f.shape, f.shift]),
        other => panic!("{other:?}"),
    }
}

fn mass(m: &MassProperties) -> Mass {
    let row = |i: usize| [0, 1, 2].map(|j| m.inertia.col(j)[i]);
    Mass {
        mass: m.mass,
        first: m.first_moment.to_array(),
        inertia: [0, 1, 2].map(row),
    }
}

/// One strip per column of the mesh: chord and place halfway between its sides.
fn strips(wing: &wingbeat_model::Wing) -> Vec<Strip> {
    let mesh = &wing.mesh;
    let node = |i: usize, j: usize| mesh.nodes[mesh.node(i, j)];
    let strip = |j: usize| {
        let [front, rear] = [0, mesh.rows].map(|i| 0.5 * (node(i, j).x + node(i, j + 1).x));
        Strip {
            y: 0.5 * (node(0, j).y + node(0, j + 1).y),
            leading: front,
            chord: front - rear,
            width: (node(0, j + 1).y - node(0, j).y).abs(),
        }
    };
    (0..mesh.cols).map(strip).collect()
}

/// The numbers of a case.
fn flyer(setup: &FlightSetup) -> Flyer {
    let AirModel::BladeElement(air) = &setup.air else {
        panic!("blade elements");
    };
    let Translation::DoubleAngle {
        lift,
        drag_0,
        drag_90,
    } = air.blade.translation
    else {
        panic!("C_L = lift sin 2a");
    };
    let wing = |w: &wingbeat_model::Wing| Wing {
        hinge: w.hinge_b.to_array(),
        mass: mass(&w.mass),
        strips: strips(w),
        plane: w.motion.stroke_plane_pitch,
        angles: [
            &w.motion.angles.phi,
            &w.motion.angles.theta,
            &w.motion.angles.psi,
        ]
        .map(law),
    };
    Flyer {
        body: mass(&setup.animal.body),
        wings: setup.animal.wings.iter().map(wing).collect(),
        frequency: setup.animal.wings[0].motion.frequency,
        gravity: setup.gravity.z,
        air: Sections {
            density: air.blade.density,
            lift,
            drag_0,
            drag_90,
        },
    }
}

/// A trimmed hover in both programs.
struct Both {
    name: &'static str,
    trim: Trim,
    flyer: Flyer,
}

fn both() -> [Both; 2] {
    [("fruit fly", fly()), ("hawkmoth", moth())].map(|(name, setup)| {
        let trim = trim(&setup, &hover(200)).unwrap();
        assert!(
            trim.solution.converged,
            "{name}: {:?}",
            trim.solution.residual
        );
        Both {
            name,
            flyer: flyer(&trim.setup),
            trim,
        }
    })
}

impl Both {
    /// Start of the trimmed beat.
    fn start(&self) -> State {
        let root = self.trim.beat.root(&self.trim.state);
        State {
            attitude: rows(&root.r),
            v: (root.r.transpose() * root.v).to_array(),
            w: root.w.to_array(),
        }
    }

    /// Level axes to the body's: the body is pitched up by the mean angle of the beat.
    fn level(&self) -> Matrix {
        about(1, -self.flyer.mean_pitch(&self.start()))
    }

    /// Natural velocity and rate: wing lengths and radians per beat.
    fn sizes(&self) -> [f64; 2] {
        let beat = &self.trim.beat;
        [beat.wing_length(), 1.0].map(|x| x / beat.period())
    }
}

fn rows(m: &DMat3) -> Matrix {
    [0, 1, 2].map(|i| m.row(i).to_array())
}

/// Largest difference of `a` from `b` over the largest of `b`, block by block: forces and moments by velocities and
/// rates.
fn blocks_apart(a: &[[f64; 6]; 6], b: &[[f64; 6]; 6]) -> f64 {
    let mut worst = 0.0_f64;
    for block in 0..4 {
        let (row, column) = (3 * (block / 2), 3 * (block % 2));
        let entries = (0..9).map(|k| (row + k / 3, column + k % 3));
        let (mut apart, mut size) = (0.0_f64, 0.0_f64);
        for (i, j) in entries {
            apart = apart.max((a[i][j] - b[i][j]).abs());
            size = size.max(b[i][j].abs());
        }
        worst = worst.max(apart / size);
    }
    worst
}

/// Largest distance of a value of `a` from the nearest of `b`.
fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let far = |x: &[f64; 2]| {
        let each = b.iter().map(|y| (x[0] - y[0]).hypot(x[1] - y[1]));
        each.fold(f64::INFINITY, f64::min)
    };
    a.iter().map(far).fold(0.0, f64::max)
}

/// Multipliers of a set of modes, of oscillations both.
fn multipliers(set: &ModeSet) -> Vec<[f64; 2]> {
    let of = |m: &Mode| {
        let [re, im] = m.multiplier;
        match m.frequency > 0.0 {
            true => vec![[re, im], [re, -im]],
            false => vec![[re, im]],
        }
    };
    set.modes.iter().flat_map(of).collect()
}

/// Part of a matrix.
fn part(a: &[Vec<f64>], of: &[usize]) -> Vec<Vec<f64>> {
    let row = |&i: &usize| of.iter().map(|&j| a[i][j]).collect();
    of.iter().map(row).collect()
}

/// Rates of u, v, w, p, q, r, phi, theta, psi about hover: the mean rigid body under the derivatives of its loads,
/// level axes. The air goes with it, and turned wings keep their angular momentum.
fn averaged(
    means: &Means,
    level: &Matrix,
    derivatives: &[[f64; 6]; 6],
    (added, gyroscopic): (&[[f64; 6]; 6], &Matrix),
    gravity: f64,
) -> Vec<Vec<f64>> {
    use crate::common::flight_laws::solve;
    use crate::common::quasi_steady::{product, transposed};
    let inertia = product(&product(&transposed(level), &means.inertia), level);
    let whole = |i: usize, j: usize| {
        let own = match (i < 3, j < 3) {
            (true, true) if i == j => means.mass,
            (false, false) => inertia[i - 3][j - 3],
            _ => 0.0,
        };
        own + added[i][j]
    };
    let whole: Vec<Vec<f64>> = (0..6)
        .map(|i| (0..6).map(|j| whole(i, j)).collect())
        .collect();
    let mut a = vec![vec![0.0; 9]; 9];
    for j in 0..9 {
        let load = |i: usize| match (i, j) {
            (3.., 3..=5) => derivatives[i][j] - gyroscopic[i - 3][j - 3],
            (_, 0..=5) => derivatives[i][j],
            (0, 7) => -gravity * means.mass,
            (1, 6) => gravity * means.mass,
            _ => 0.0,
        };
        let rates = solve(whole.clone(), (0..6).map(load).collect());
        (0..6).for_each(|i| a[i][j] = rates[i]);
    }
    (0..3).for_each(|i| a[6 + i][3 + i] = 1.0);
    a
}

#[test]
fn agrees_lift_and_power_of_hover_with_a_program_from_the_formulas() {
    for case in both() {
        let means = case.flyer.means();
        let weight = means.mass * case.flyer.gravity;
        let load = case
            .flyer
            .mean_load(means.centre, &case.level(), [0.0; 3], [0.0; 3]);
        let beat = &case.trim.beat;
        let level = Level::new(
            beat.mean_attitude(&case.trim.state).unwrap(),
            beat.gravity(),
        );
        let computed = beat.mean_load(&level, DVec3::ZERO, DVec3::ZERO).unwrap();
        let lift = (load[2] - computed.force.z).abs() / weight;
        let pitching = (load[4] - computed.moment.y).abs() / (weight * beat.wing_length());
        let held = power(&case.trim.tethered().unwrap()).unwrap();
        let power = (means.power / held.aerodynamic - 1.0).abs();
        println!(
            "{}: lift {:.6} weights, apart by {lift:.1e}, moment {pitching:.1e}, power {:.6e} W {power:.1e}",
            case.name,
            -load[2] / weight,
            means.power
        );
        assert!((means.mass / beat.mass() - 1.0).abs() < 1e-14);
        // Two ways to the mean pitch (measured 3.5e-12); power: 200 samples of a
        // feathering that turns quickly (measured 4.0e-8).
        assert!(lift < 3e-11 && pitching < 4e-12 && power < 4e-7);
    }
}

#[test]
fn agrees_derivatives_and_averaged_modes_with_a_program_from_the_formulas() {
    for case in both() {
        let model = linear_model(&case.trim.beat, &case.trim.state).unwrap();
        let means = case.flyer.means();
        let d = case
            .flyer
            .derivatives(means.centre, &case.level(), case.sizes());
        let by_block = blocks_apart(&d, &model.derivatives);
        let added = case.flyer.added_mass(means.centre, &case.level());
        let by_block_of_mass = blocks_apart(&added, &model.added_mass);
        let gyroscopic = case.flyer.gyroscopic(&case.level(), case.sizes()[1]);
        let more = (&added, &gyroscopic);
        let matrix = averaged(&means, &case.level(), &d, more, case.flyer.gravity);
        let period = case.trim.beat.period();
        let computed = multipliers(&model.modes);
        let theirs = PLANES.iter().flat_map(|p| eigenvalues(&part(&matrix, p)));
        let theirs: Vec<[f64; 2]> = theirs
            .map(|[re, im]| [(re * period).exp(), im * period])
            .map(|[size, angle]| [size * angle.cos(), size * angle.sin()])
            .collect();
        let modes = apart(&theirs, &computed).max(apart(&computed, &theirs));
        println!(
            "{}: derivatives apart by {by_block:.1e}, added mass by {by_block_of_mass:.1e}, averaged modes by {modes:.1e} per beat",
            case.name
        );
        // Two ways to the mean pitch, good to 1e-10; a feathering that turns quickly in few samples (measured 7.8e-9, 4.0e-8
        // and 1.8e-10).
        assert!(by_block < 3e-8 && by_block_of_mass < 3e-7 && modes < 5e-10);
    }
}

#[test]
fn agrees_floquets_multipliers_with_a_program_from_the_formulas() {
    for case in both() {
        let start = case.start();
        let missed = Flyer::departure(&start, &case.flyer.beat(&start));
        let [velocity, rate] = case.sizes();
        let open = (0..9).map(|i| missed[i].abs() / [velocity, rate, 1.0][i / 3]);
        let open = open.fold(0.0, f64::max);
        let matrix = case.flyer.monodromy(&start, case.sizes());
        let theirs = PLANES.iter().flat_map(|p| eigenvalues(&part(&matrix, p)));
        let theirs: Vec<[f64; 2]> = theirs.collect();
        let exact = floquet(&case.trim.beat, &case.trim.state).unwrap();
        let computed = multipliers(&exact);
        let far = apart(&theirs, &computed).max(apart(&computed, &theirs));
        println!(
            "{}: closure of the orbit {open:.1e}, multipliers apart by {far:.1e}",
            case.name
        );
        assert_eq!(computed.len(), 9);
        // Errors of the Runge-Kutta method over a beat, 200 steps each (measured 1.6e-8); multipliers: roundings
        // over steps of 1e-4, spread by their nearness to each other (measured 3.1e-7).
        assert!(open < 1.6e-7 && far < 3e-6);
    }
}
