//! Sudden start of finite wings: two other programs, and where they are not converged.

use crate::lab::series::{Table, interpolate};
use crate::lab::{extrapolated, forces, rectangle, translating};
use crate::{Case, Part, Row, VerifyError};
use wingbeat_air::{AirError, AirSettings, CoreModel, Lattice, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[Case {
    name: "sudden-start",
    about: "Rectangular wings of aspect ratio 4 and 8 started suddenly at 5 deg. The published \
            histories have four chordwise panels and steps of a sixteenth of a chord, a quarter of a \
            panel: that overrates the early lift. Once in their setting, then converged.",
    part: Part::Programs,
    quick: true,
    run,
}];

/// Lift coefficients over 10 chords, the first at once after the start.
fn history(aspect: f64, mesh: [usize; 2], dt: f64, accurate: bool) -> Result<Vec<f64>, AirError> {
    let alpha = 5_f64.to_radians();
    let stream = DVec3::new(alpha.cos(), 0.0, alpha.sin());
    let scheme = match accurate {
        true => AirSettings::accurate(1.0, stream),
        false => AirSettings::benchmark(1.0, stream),
    };
    let core = CoreModel::Scully { radius: 1e-4 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        ..scheme
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", mesh[0], mesh[1])], settings)?;
    let mut nodes = rectangle(mesh[0], mesh[1], DVec3::X, aspect * DVec3::Y);
    if !accurate {
        their_rings(&mut nodes, mesh, dt);
    }
    let motion = |_| translating(nodes.clone(), DVec3::ZERO);
    let force = forces(&lattice, motion, dt, (10.0 / dt).round() as usize)?;
    let lift = |f: &DVec3| (f.z * alpha.cos() - f.x * alpha.sin()) / (0.5 * aspect);
    Ok(force.iter().map(lift).collect())
}

/// Their rings: a quarter panel aft of the panels, the last one ending 0.3 steps behind the trailing
/// edge.
fn their_rings(nodes: &mut [DVec3], [rows, cols]: [usize; 2], dt: f64) {
    nodes.iter_mut().for_each(|x| x.x += 0.25 / rows as f64);
    nodes[rows * (cols + 1)..]
        .iter_mut()
        .for_each(|x| x.x = 1.0 + 0.3 * dt);
}

struct Published {
    aspect: f64,
    mesh: [usize; 2],
    /// Chords travelled at each lift coefficient.
    chords: Vec<f64>,
    lift: Vec<f64>,
    source: &'static str,
}

fn published() -> [Published; 2] {
    let of = |text: &str| {
        let table = Table::new(text);
        let chords = table.numbers("step").iter().map(|n| n / 16.0).collect();
        (chords, table.numbers("CL"))
    };
    let (c4, l4) = of(include_str!("../../data/volcanor_kp_ar4.csv"));
    let (c8, l8) = of(include_str!("../../data/katz_plotkin_p16_ar8.csv"));
    [
        Published {
            aspect: 4.0,
            mesh: [4, 26],
            chords: c4,
            lift: l4,
            source: "free-wake program VOLCANOR, case KatzNPlotkin AR 4 (repository cibinjoseph/VOLCANOR)",
        },
        Published {
            aspect: 8.0,
            mesh: [4, 26],
            chords: c8,
            lift: l8,
            source: "Katz & Plotkin, Low-Speed Aerodynamics, program 16 (log in cibinjoseph/KatzPlotkin)",
        },
    ]
}

fn run(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let mut rows = Vec::new();
    // The short form leaves out the longer wing and the converged history.
    for case in published().into_iter().take(if quick { 1 } else { 2 }) {
        let theirs = |chords: f64| interpolate(&case.chords, &case.lift, chords);
        let same = history(case.aspect, case.mesh, 1.0 / 16.0, false)?;
        let cols = (5.0 * case.aspect.sqrt()) as usize;
        let n = if quick { 2 } else { 8 };
        let runs =
            [n, 2 * n].map(|n| history(case.aspect, [n, cols * n / 4], 1.0 / n as f64, true));
        let [coarse, fine] = runs;
        let (coarse, fine) = (coarse?, fine?);
        for chords in [0.5_f64, 1.0, 2.0, 5.0, 10.0] {
            let computed = same[(chords * 16.0) as usize];
            rows.push(
                Row::new(format!("AR {}, {chords} chords, their setting: C_L", case.aspect), "1", computed)
                    .against(theirs(chords), case.source)
                    .within_part(0.05, "rings as theirs, but control points of the last row 0.02 chords ahead of theirs"),
            );
            let at = |x: &[f64], n: usize| x[(chords * n as f64) as usize];
            let (a, b) = (at(&coarse, n), at(&fine, 2 * n));
            let limit = extrapolated(a, b, 1.0);
            rows.push(
                Row::new(
                    format!("AR {}, {chords} chords, converged: C_L", case.aspect),
                    "1",
                    limit,
                )
                .against(theirs(chords), case.source)
                .uncertain(limit - b)
                .because("what their step and four panels add to the converged lift"),
            );
        }
    }
    Ok(rows)
}
