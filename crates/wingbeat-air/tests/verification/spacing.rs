//! Panels of cosine spacing along chord and span: where their control points lie.

use crate::centre_of_pressure::{moment, oscillating, schemes, theodorsen};
use crate::common::{fly, total_force, translating};
use std::f64::consts::PI;
use wingbeat_air::{
    AirSettings, Lattice, LeadingEdge, LoadMethod, NodeMotion, SheddingKinds, Surface,
};
use wingbeat_math::DVec3;

const LOADS: [LoadMethod; 2] = [LoadMethod::Pressure, LoadMethod::Joukowski];

const LONG: f64 = 1e6;

/// Edges of `n` panels of cosine spacing, from 0 to 1.
fn cosine(n: usize) -> Vec<f64> {
    let at = |k: usize| 0.5 * (1.0 - (PI * k as f64 / n as f64).cos());
    (0..=n).map(at).collect()
}

fn even(n: usize) -> Vec<f64> {
    (0..=n).map(|k| k as f64 / n as f64).collect()
}

/// A rectangle of chord 1 with its leading edge on the second axis.
fn plate(along: &[f64], across: &[f64], span: f64) -> (Surface, Vec<DVec3>) {
    let at = |x: f64, y: f64| DVec3::new(x, span * y, 0.0);
    let nodes: Vec<DVec3> = (along.iter())
        .flat_map(|&x| across.iter().map(move |&y| at(x, y)))
        .collect();
    let surface = Surface::grid("wing", along.len() - 1, across.len() - 1);
    (surface.with_rest(nodes.clone()), nodes)
}

fn steady(
    settings: AirSettings,
    (surface, nodes): (Surface, Vec<DVec3>),
    (dt, steps): (f64, usize),
) -> [f64; 2] {
    let lattice = Lattice::new(vec![surface], settings).unwrap();
    let motion = |_| -> NodeMotion { translating(nodes.clone(), DVec3::ZERO) };
    let loads = fly(&lattice, motion, dt, steps, |_, _, _, _| {})
        .unwrap()
        .loads;
    let lift = total_force(&loads).z;
    [lift, -moment(&loads) / lift]
}

/// Circulation and moment of a flat plate in plane flow are exact on panels of any lengths whose vortices lie at a
/// quarter and control points at three quarters [James 1972]; with control points in the middles of the rings the
/// centre of pressure is at 0.217, 0.222 and 0.233 chords on 4, 8 and 16 panels of cosine spacing. The same where what
/// leaves the leading edge is part of the solution, and nothing leaves: then A0 is known, too.
#[test]
fn exact_lift_and_centre_of_pressure_of_a_flat_plate_on_cosine_panels() {
    let alpha = 0.1_f64;
    let [_, accurate] = schemes(alpha);
    let implicit = LeadingEdge::SuctionImplicit {
        threshold: 9.0,
        efficiency: 1.0,
    };
    let leading = SheddingKinds {
        leading: true,
        ..SheddingKinds::TRAILING
    };
    for rows in [3, 4, 8, 16] {
        for shedding in [SheddingKinds::TRAILING, leading] {
            for loads in LOADS {
                let settings = AirSettings {
                    loads,
                    shedding,
                    leading: implicit,
                    ..accurate.clone()
                };
                let plate = plate(&cosine(rows), &even(1), LONG);
                let [lift, centre] = steady(settings, plate, (0.1 * LONG, 150));
                // Normal to the plate.
                let exact = PI * LONG * alpha.sin() * alpha.cos();
                println!("{rows} {loads:?}: {centre:.8}, {:.2e}", lift / exact - 1.0);
                // What the lattice leaves of the suction, and the starting vortex, 15 spans behind.
                assert!((lift / exact - 1.0).abs() < 5e-6);
                assert!((centre - 0.25).abs() < 1e-7);
            }
        }
    }
}

/// Lift and moment of a plate that plunges and pitches, on eight panels of cosine spacing.
#[test]
fn limit_theodorsen_on_cosine_panels() {
    let (k, c) = (0.5, [0.5979, -0.1507]); // Bisplinghoff, Ashley, Halfman, Aeroelasticity, table 5-1.
    let [_, accurate] = schemes(0.0);
    for (loads, pitches) in LOADS.iter().flat_map(|l| [(*l, false), (*l, true)]) {
        let settings = AirSettings {
            loads,
            ..accurate.clone()
        };
        let (surface, flat) = plate(&cosine(8), &even(1), 1e4);
        let [found, lift] = oscillating(&settings, (pitches, k), (surface, &flat), (8, 1e4));
        let want = theodorsen(pitches, k, c);
        let off = (found[0] - want[0]).hypot(found[1] - want[1]);
        let off = 0.5 * off / lift[0].hypot(lift[1]); // chords
        println!("{loads:?} pitches {pitches}: {off:.5}");
        assert!(off < 0.005);
    }
}

/// Lift slope of a rectangle of aspect ratio 2 on columns of cosine spacing: lifting-surface theory has 2.474. With
/// control points in the middles of the columns and rings inside of the tips it is 2.60, 2.58 and 2.56 on 12, 16 and
/// 24 columns.
#[test]
fn limit_lift_slope_on_cosine_columns() {
    let alpha = 1e-6;
    let [_, accurate] = schemes(alpha);
    for columns in [8, 12, 24] {
        let slopes = [true, false].map(|cosine_columns| {
            let settings = AirSettings {
                loads: LoadMethod::Joukowski,
                ..accurate.clone()
            };
            let across = if cosine_columns {
                cosine(columns)
            } else {
                even(columns)
            };
            let (surface, nodes) = plate(&even(4), &across, 2.0);
            let surface = Surface {
                cosine_columns,
                ..surface
            };
            let [lift, _] = steady(settings, (surface, nodes), (2.0, 20));
            lift / alpha
        });
        println!("{columns}: {slopes:.4?}");
        assert!((slopes[0] / 2.474 - 1.0).abs() < 0.004);
    }
}

/// A bent wing on panels of cosine spacing lifts as it does on many even ones: the normal is that of the surface at the
/// control point.
#[test]
fn agrees_camber_on_cosine_panels_with_thin_airfoils() {
    let [_, accurate] = schemes(0.0);
    for rows in [4, 8, 16] {
        let height = 1e-4;
        let (surface, mut nodes) = plate(&cosine(rows), &even(1), LONG);
        nodes
            .iter_mut()
            .for_each(|x| x.z = 4.0 * height * x.x * (1.0 - x.x));
        let [lift, centre] = steady(accurate.clone(), (surface, nodes), (0.1 * LONG, 150));
        // A parabola has a lift coefficient of 4 pi h, and its centre of pressure at mid chord.
        let off = lift / (2.0 * PI * height * LONG) - 1.0;
        println!("{rows}: lift {off:.2e}, centre {:.2e}", centre - 0.5);
        assert!(off.abs() < 1e-5 && (centre - 0.5).abs() < 1.0 / (rows * rows) as f64);
    }
}

/// Force over the acceleration across a plate without wakes, over `pi/4 rho c^2 b`.
fn added_mass(loads: LoadMethod, (surface, nodes): (Surface, Vec<DVec3>), span: f64) -> f64 {
    let settings = AirSettings {
        loads,
        shedding: SheddingKinds::NONE,
        ..schemes(0.0)[1].clone()
    };
    let density = settings.density;
    let lattice = Lattice::new(vec![surface], settings).unwrap();
    let motion = |t: f64| {
        let up = 0.5 * t * t * DVec3::Z;
        translating(nodes.iter().map(|x| *x + up).collect(), t * DVec3::Z)
    };
    let run = fly(&lattice, motion, 0.1, 3, |_, _, _, _| {}).unwrap();
    -total_force(&run.loads).z / (0.25 * PI * density * span)
}

/// The rule of Lobatto and Chebyshev along the chord: exact in plane flow on any rows of cosine spacing.
#[test]
fn exact_added_mass_of_a_flat_plate_on_cosine_rows() {
    for loads in LOADS {
        for rows in [3, 4, 6, 12, 24] {
            let found = added_mass(loads, plate(&cosine(rows), &even(1), LONG), LONG);
            println!("{loads:?} {rows}: {:.2e}", found - 1.0);
            // The core, 7e-11 on the smallest panels.
            assert!((found - 1.0).abs() < 5e-10);
        }
    }
}

/// Rectangular plates on rows and columns of cosine spacing [Meyerhoff 1970; Blevins 1979, table 14-1].
#[test]
fn published_added_mass_of_rectangular_plates_on_cosine_panels() {
    for (aspect, k) in [(1.0, 0.579), (2.0, 0.757), (4.0, 0.872)] {
        let found = [4, 8, 12].map(|n| {
            let (surface, nodes) = plate(&cosine(n), &cosine(2 * n), aspect);
            let surface = Surface {
                cosine_columns: true,
                ..surface
            };
            added_mass(LoadMethod::Pressure, (surface, nodes), aspect)
        });
        println!("aspect ratio {aspect}: {found:.4?} of {k}");
        // 0.29 % on the coarsest mesh of the shortest plate; digits of the table.
        assert!(found.iter().all(|m| (m / k - 1.0).abs() < 0.006));
        assert!((found[2] - k).abs() < 5e-4);
    }
}
