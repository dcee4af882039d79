//! Plates and membranes of shells against closed forms.

mod plate;

use std::f64::consts::PI;

use plate::{CLAMPED, Plate, askew, rectangle};
use wingbeat_math::{DMat3, DVec3};
use wingbeat_structure::shell::ShellSection;
use wingbeat_structure::{Element, Lamina};

/// Simply supported on all sides, hard: deflection and the turn along the side are held.
fn simply_supported(a: f64, b: f64) -> impl Fn(DVec3) -> [bool; 6] {
    move |x| {
        let across = x.x < 1e-9 || x.x > a - 1e-9;
        let along = x.y < 1e-9 || x.y > b - 1e-9;
        [true, true, across || along, across, along, true]
    }
}

/// Deflection at the centre of a simply supported square plate under uniform pressure, thin and thick:
/// 0.0040623527 q a^4 / D [Timoshenko & Woinowsky-Krieger 1959, art. 30] and 0.0736713 q a^2 / (k G h) of shear.
#[test]
fn exact_simply_supported_square_under_pressure() {
    let error = |n: usize, thickness: f64| {
        let section = Lamina::isotropic(1.0, 0.3, thickness, 1.0)
            .section()
            .unwrap();
        let plate = Plate::new(
            &rectangle(n, n, 1.0, 1.0),
            section,
            simply_supported(1.0, 1.0),
        );
        let mut load = vec![0.0; 6 * plate.rest.len()];
        for shell in &plate.shells {
            shell
                .nodes()
                .iter()
                .for_each(|m| load[6 * m + 2] += 0.25 * shell.area());
        }
        let found = plate.linear(&load)[6 * plate.near(DVec3::new(0.5, 0.5, 0.0)) + 2];
        let exact = 0.004_062_352_7 / section.bending.x_axis.x + 0.073_671_35 / section.shear;
        found / exact - 1.0
    };
    for thickness in [1e-6, 1e-3, 0.1] {
        let [coarse, fine] = [error(8, thickness), error(16, thickness)];
        assert!(fine.abs() < 3e-3, "{thickness}: {fine:e}");
        let order = (coarse / fine).abs().log2();
        // Of the thick plate the soft edges converge more slowly.
        assert!(
            (1.6..2.3).contains(&order),
            "{thickness}: {coarse:e} {fine:e}"
        );
    }
}

/// Frequencies of a simply supported orthotropic plate 1 x 0.8:
/// `w^2 m = pi^4 (D11 (p/a)^4 + 2 (D12 + 2 D66) (p/a)^2 (q/b)^2 + D22 (q/b)^4)`.
#[test]
fn order_frequencies_of_an_orthotropic_plate() {
    let lamina = Lamina {
        axis: DVec3::X,
        added_mass: 0.0,
        ..askew(1e-4)
    };
    let section = lamina.section().unwrap();
    let [d, m] = [
        section.bending,
        DMat3::from_diagonal(DVec3::splat(section.area_density)),
    ];
    let exact = |p: f64, q: f64| {
        let (p, q) = (PI * p, PI * q / 0.8);
        let twist = 2.0 * (d.y_axis.x + 2.0 * d.z_axis.z);
        ((d.x_axis.x * p.powi(4) + twist * p * p * q * q + d.y_axis.y * q.powi(4)) / m.x_axis.x)
            .sqrt()
    };
    let mut modes = vec![
        exact(1.0, 1.0),
        exact(1.0, 2.0),
        exact(2.0, 1.0),
        exact(2.0, 2.0),
        exact(1.0, 3.0),
    ];
    modes.sort_by(f64::total_cmp);
    let errors = |n: usize| -> Vec<f64> {
        let plate = Plate::new(
            &rectangle(n, n, 1.0, 0.8),
            section,
            simply_supported(1.0, 0.8),
        );
        let found = plate.frequencies(4, 0.0);
        found.iter().zip(&modes).map(|(f, e)| f / e - 1.0).collect()
    };
    let (coarse, fine) = (errors(16), errors(32));
    for (c, f) in coarse.iter().zip(&fine) {
        // Lumped mass: (p^2 + q^2) / 2 (pi h)^2 / 12.
        assert!(f.abs() < 1e-2, "{fine:?}");
        assert!((1.8..2.2).contains(&(c / f).log2()), "{coarse:?} {fine:?}");
    }
}

/// A stretched square membrane without bending stiffness: `w = pi sqrt(N (p^2 + q^2) / m)`, also through the hourglass'
/// own geometric stiffness.
#[test]
fn order_frequencies_of_a_stretched_membrane() {
    let lamina = Lamina {
        prestress: [3.0, 3.0, 0.0],
        ..Lamina::isotropic(1e6, 0.3, 1e-3, 1e3)
    };
    let section = ShellSection {
        bending: DMat3::ZERO,
        shear: 0.0,
        ..lamina.section().unwrap()
    };
    let held = |x: DVec3| {
        let rim = |x: f64| !(1e-9..=1.0 - 1e-9).contains(&x);
        let side = rim(x.x) || rim(x.y);
        [side, side, side, true, true, true]
    };
    let errors = |n: usize| -> Vec<f64> {
        let plate = Plate::new(&rectangle(n, n, 1.0, 1.0), section, held);
        let found = plate.frequencies(4, 0.0);
        let exact = [2.0_f64, 5.0, 5.0, 8.0].map(|s| PI * (3.0 * s).sqrt());
        found.iter().zip(exact).map(|(f, e)| f / e - 1.0).collect()
    };
    let (coarse, fine) = (errors(16), errors(32));
    for (c, f) in coarse.iter().zip(&fine) {
        assert!(f.abs() < 1e-2, "{fine:?}");
        assert!((1.8..2.2).contains(&(c / f).log2()), "{coarse:?} {fine:?}");
    }
}

/// In-plane bending of a slender strip, one element across: `P L^3 / (3 E I)` and a little shear, with the turn
/// about the normal joined only weakly.
#[test]
fn limit_in_plane_bending_of_a_strip_is_a_beam() {
    let (length, width, thickness) = (10.0, 0.5, 0.01);
    let section = Lamina::isotropic(1.0, 0.0, thickness, 1.0)
        .section()
        .unwrap();
    let error = |n: usize| {
        let plate = Plate::new(&rectangle(1, n, length, width), section, |x| {
            if x.x < 1e-9 {
                CLAMPED
            } else {
                [false, false, true, true, true, false]
            }
        });
        let mut load = vec![0.0; 6 * plate.rest.len()];
        let tip = [0.0, width].map(|y| plate.near(DVec3::new(length, y, 0.0)));
        tip.iter().for_each(|n| load[6 * n + 1] = 0.5);
        let found = plate.linear(&load)[6 * tip[0] + 1];
        let inertia = thickness * width.powi(3) / 12.0;
        let exact = length.powi(3) / (3.0 * inertia) + length / (thickness * width * 0.5);
        found / exact - 1.0
    };
    let (coarse, fine) = (error(10), error(40));
    // One element across is stiff in its plane until it is as long as wide; second order.
    assert!(
        fine.abs() < 5e-2 && fine.abs() < 0.12 * coarse.abs(),
        "{coarse:e} {fine:e}"
    );
}
