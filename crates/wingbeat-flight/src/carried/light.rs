//! Whether a flyer as a whole is light beside the air that its wings carry along.
//!
//! The wings together have the added mass `A = sum J^T A_w J`, the bodies the inertia `M = sum J^T M_b J`, J
//! from the acceleration of the root's origin and its angular acceleration to those of a body, all joints as
//! they stand. The largest mu of `A x = mu M x` says how passes that bring both to agree go and how far
//! `hamming` is stable (docs/dynamics.md): the flyer is light where `mu > LIMIT`, so where `LIMIT M - A` is not
//! positive definite. Postures change over the wingbeat: that of the start and those at [`PHASES`] of a
//! wingbeat at its full rate are looked at, and the worst counts. Free joints stay as they are at the start,
//! wings that bend as they are at rest.

use wingbeat_dynamics::{BodyMotion, System, Workspace, Wrench, tethered_motions};
use wingbeat_math::six_by_six::{Ldlt, ZERO, from_entries, unit};
use wingbeat_math::{DMat3, SixBySix, six};
use wingbeat_model::WingMotion;

use crate::error::FlightError;
use crate::interface::{Air, Instant};
use crate::setup::FlightSetup;

/// Added mass over mass above which the rate of the circulation joins the inertia of the bodies \[1\]:
/// `hamming` is stable to 0.36, and passes converge by a factor of 0.2 to 0.25 there.
const LIMIT: f64 = 0.3;

/// Phases of the wingbeat at which the posture is looked at: between neighbours strokes of 90 deg turn by 35
/// deg at most.
const PHASES: usize = 8;

/// Directions of the root (origin, then turn) in which a flyer moves: those of symmetric flight where one half
/// is computed.
const ALL: &[usize] = &[0, 1, 2, 3, 4, 5];
const SYMMETRIC: &[usize] = &[0, 2, 4];

/// Whether the flyer of `setup` is light in `air` at the start or at any phase of its wingbeat.
///
/// # Errors
/// What the air reports at the start; a posture of the wingbeat that it does not take is not looked at: the
/// flight says so when it comes to it.
pub fn is_light(
    setup: &FlightSetup,
    system: &System,
    air: &dyn Air,
    is_symmetric: bool,
) -> Result<bool, FlightError> {
    if is_light_at(0.0, setup, system, air, is_symmetric)? {
        return Ok(true);
    }
    let mut beat = phases(setup);
    Ok(beat.any(|t| is_light_at(t, setup, system, air, is_symmetric).unwrap_or(false)))
}

/// Times at which the posture is looked at beside the start \[s\]: over a wingbeat at its full rate, of the
/// slowest wing; none where none beats.
fn phases(setup: &FlightSetup) -> impl Iterator<Item = f64> {
    let motions = setup.animal.wings.iter().map(|w| &w.motion);
    let rise = |m: &WingMotion| 2.0 * m.start.delay();
    let from = motions.clone().map(rise).fold(0.0, f64::max);
    let beating = motions.map(|m| m.frequency).filter(|f| *f > 0.0);
    let slowest = beating.fold(f64::INFINITY, f64::min);
    let count = if slowest.is_finite() { PHASES } else { 0 };
    (0..count).map(move |k| from + k as f64 / (PHASES as f64 * slowest))
}

/// Whether the flyer is light in the posture at time `t` \[s\].
fn is_light_at(
    t: f64,
    setup: &FlightSetup,
    system: &System,
    air: &dyn Air,
    is_symmetric: bool,
) -> Result<bool, FlightError> {
    let mut motions = vec![BodyMotion::REST; system.bodies().len()];
    let (root, mut ws) = (setup.root_at_start(), Workspace::new(system));
    tethered_motions(system, t, &root, &mut ws, &mut motions);
    let at = Instant::rigid(t, setup.time.step, &motions);
    let (mut s, mut loads) = (air.scratch(), vec![Wrench::default(); motions.len()]);
    air.place(&at, &mut s)?;
    let memory = air.initial(&s);
    air.loads(&at, memory.as_ref(), &mut s, &mut loads)?;
    let mut left = ZERO;
    for (body, m) in system.bodies().iter().zip(&motions) {
        let mass = body.mass.matrix(DMat3::IDENTITY);
        add_moved(&mass, LIMIT, [m, &motions[0]], &mut left);
    }
    for w in 0..setup.animal.wings.len() {
        if let Some(answer) = air.wing_inertia(w, &at, memory.as_ref(), &mut s)? {
            add_moved(
                &answer.mass,
                -1.0,
                [&motions[w + 1], &motions[0]],
                &mut left,
            );
        }
    }
    let directions = if is_symmetric { SYMMETRIC } else { ALL };
    Ok(!is_positive(&left, directions))
}

/// Whether the rows and columns of a symmetric matrix that `directions` name are those of a positive definite one.
fn is_positive(of: &SixBySix, directions: &[usize]) -> bool {
    // A direction that is left out stands alone, with one.
    let counts = |k: usize| directions.contains(&k);
    let entry = |i: usize, j: usize| match counts(i) && counts(j) {
        true => of[i][j],
        false => f64::from(u8::from(i == j)),
    };
    Ldlt::new(from_entries(entry)).is_positive()
}

/// Adds `factor J^T A J` to `out`: `of` in components of the body that moves like `m`, `out` in those of the root.
fn add_moved(of: &SixBySix, factor: f64, [m, root]: [&BodyMotion; 2], out: &mut SixBySix) {
    let (turn, arm) = (
        m.r.transpose() * root.r,
        root.r.transpose() * (m.p - root.p),
    );
    // Column k of J: what the body's origin and axes accelerate at where the root does in direction k.
    let column = |k: usize| {
        let [a, alpha] = unit(k);
        six(turn * (a + alpha.cross(arm)), turn * alpha)
    };
    let columns: SixBySix = std::array::from_fn(column);
    for (k, l) in (0..36).map(|n| (n / 6, n % 6)) {
        let entries = (0..36).map(|n| (n / 6, n % 6));
        let sum = entries.map(|(i, j)| columns[k][i] * of[i][j] * columns[l][j]);
        out[k][l] += factor * sum.sum::<f64>();
    }
}
