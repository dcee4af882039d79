//! Added mass of plates accelerated normal to themselves, without wakes.

use crate::lab::outline::{self, Spread};
use crate::lab::{extrapolated, fly, order, rectangle, total_force, translating};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::PI;
use wingbeat_air::{AirError, AirSettings, CoreModel, Lattice, SheddingKinds, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "added-mass-of-plates",
    about: "Added mass of plates that start from rest, in the accurate discretisation (rings inset \
            by a quarter panel) and in the benchmark's.",
    part: Part::Analytic,
    quick: true,
    run: plates,
}];

const NONE: SheddingKinds = SheddingKinds {
    trailing: false,
    tip: false,
    leading: false,
    root: false,
};

/// Added mass for density 1 of a plate with these nodes [m3].
fn added_mass(nodes: &[DVec3], [rows, cols]: [usize; 2], accurate: bool) -> Result<f64, AirError> {
    let core = CoreModel::Scully { radius: 1e-7 };
    let scheme = match accurate {
        true => AirSettings::accurate(1.0, DVec3::ZERO),
        false => AirSettings::benchmark(1.0, DVec3::ZERO),
    };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        shedding: NONE,
        ..scheme
    };
    let lattice = Lattice::new(vec![Surface::grid("plate", rows, cols)], settings)?;
    // Constant acceleration 2 m/s2: circulation grows in proportion to time, both rates are exact.
    let motion = |t: f64| {
        let at = nodes.iter().map(|x| *x + t * t * DVec3::Z).collect();
        translating(at, 2.0 * t * DVec3::Z)
    };
    let run = fly(&lattice, motion, 0.01, 2, |_, _, _, _| {})?;
    Ok(-total_force(&run.loads).z / 2.0)
}

const TABLE: &str = "rectangular plates: pi/4 rho c^2 b times 0.579, 0.757, 0.872, 0.934 for b/c = 1, 2, 4, 8 \
     (table of DNV-RP-H103, after Meyerhoff 1970)";

fn plates(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    for (aspect, k) in [(1.0, 0.579), (2.0, 0.757), (4.0, 0.872), (8.0, 0.934)] {
        let exact = 0.25 * PI * aspect * k;
        let of = |n: usize, accurate: bool| {
            let mesh = [n, (n as f64 * aspect.sqrt()) as usize];
            let nodes = rectangle(mesh[0], mesh[1], DVec3::X, aspect * DVec3::Y);
            added_mass(&nodes, mesh, accurate).map(|m| m / exact)
        };
        let [coarse, fine] = [of(8, true)?, of(16, true)?];
        rows.push(
            Row::new(
                format!("rectangle b/c = {aspect}, 16 panels, accurate"),
                "1",
                fine,
            )
            .against(1.0, TABLE)
            .uncertain(extrapolated(coarse, fine, 2.0) - fine)
            .within(0.01, "three digits of the table, second-order mesh error"),
        );
        let [coarse, fine] = [of(8, false)?, of(16, false)?];
        rows.push(
            Row::new(
                format!("rectangle b/c = {aspect}, 16 panels, benchmark rings"),
                "1",
                fine,
            )
            .against(1.0, TABLE)
            .uncertain(extrapolated(coarse, fine, 1.0) - fine)
            .because("rings on the true edges overrate added mass at first order"),
        );
    }
    rows.extend(disc()?);
    rows.push(long_plate()?);
    Ok(rows)
}

/// A circular disc: 8/3 rho a^3 [Lamb art. 102].
fn disc() -> Result<Vec<Row>, VerifyError> {
    let of = |n: usize| {
        let mesh = [n, n];
        let nodes = outline::nodes(outline::circle, [-0.9992, 0.9992], mesh, Spread::Cosine);
        added_mass(&nodes, mesh, true).map(|m| m / (8.0 / 3.0))
    };
    let [coarse, fine] = [of(8)?, of(16)?];
    Ok(vec![
        Row::new("disc, 16 x 16 panels, accurate", "1", fine)
            .against(1.0, "8/3 rho a^3, Lamb art. 102")
            .uncertain(extrapolated(coarse, fine, 1.0) - fine)
            .within(0.02, "a polygon in the circle; panels narrow to the tips"),
    ])
}

fn long_plate() -> Result<Row, VerifyError> {
    let of = |rows: usize| {
        let nodes = rectangle(rows, 1, DVec3::X, 1e4 * DVec3::Y);
        added_mass(&nodes, [rows, 1], true).map(|m| m / (0.25 * PI * 1e4))
    };
    let [coarse, fine] = [of(8)?, of(16)?];
    let name = format!(
        "endless plate, 16 panels, accurate (order {:.1})",
        order(coarse - 1.0, fine - 1.0)
    );
    Ok(Row::new(name, "1", fine)
        .against(1.0, "pi/4 rho c^2, Lamb art. 71")
        .uncertain(extrapolated(coarse, fine, 2.0) - fine)
        .within(0.005, "second-order mesh error"))
}
