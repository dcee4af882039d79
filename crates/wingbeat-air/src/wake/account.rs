//! What happens to the impulse of a wake sheet within a step.

use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::state::{AirState, ImpulseAccount, WakeSheet};
use crate::wake::move_step::MoveStep;
use crate::wake::sheet_move::SheetMove;
use wingbeat_math::DVec3;

/// Changes of the impulse per density [m4/s] of one sheet, N components.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SheetAccount {
    /// Per density, and nothing created.
    pub impulse: ImpulseAccount,
    /// What the row that left had less what the new one at the edge has: no longer that of the attached vorticity.
    pub released: DVec3,
    /// What the free rings and particles have at the end.
    pub free: DVec3,
}

impl std::ops::AddAssign for SheetAccount {
    fn add_assign(&mut self, other: Self) {
        self.impulse += other.impulse;
        self.released += other.released;
        self.free += other.free;
    }
}

impl SheetAccount {
    /// That of the mirror image.
    pub(crate) fn reflected(&self, mirror: Mirror) -> Self {
        let of = |impulse| mirror.vector(impulse);
        Self {
            impulse: self.impulse.map(of),
            released: of(self.released),
            free: of(self.free),
        }
    }

    /// The account of `sheet` k, moved in `step` and with its new row shed; `before` is what its free rings had before,
    /// and what its particles had.
    pub(crate) fn of_move(
        (step, moved): (&MoveStep, &SheetMove),
        (k, state): (usize, &AirState),
        sheet: &WakeSheet,
        before: [DVec3; 2],
    ) -> Self {
        let rows = sheet.rows();
        let edge = |c: usize| moved.node_before(rows - 1, sheet, c);
        let start = impulse_with(sheet, rows, |r, c| {
            moved.node_before(r.min(rows - 1), sheet, c)
        });
        let end = impulse_with(sheet, rows, |r, c| match r < rows {
            true => sheet.node(r, c),
            false => edge(c),
        });
        let absorbed = taken_by_surfaces((step, moved), (k, state), sheet);
        let [rings_before, particles_before] = before;
        let (rings, particles) = (free_rings(sheet), sheet.particles.impulse());
        let taken = moved.taken;
        Self {
            impulse: ImpulseAccount {
                moved: (end + absorbed - start) + (particles + taken - particles_before),
                absorbed: absorbed + taken,
                ..ImpulseAccount::default()
            },
            released: (start - rings_before) - (end - rings),
            free: rings + particles,
        }
    }
}

/// Impulse per density [m4/s], N, of the rings of sheet `k` without surfaces in the way, less what it is with
/// them. The newest rows reach to where the shedding edge goes within the step: were it left behind, they would
/// be longer by the way of the animal, and what is taken would depend on the inertial frame.
fn taken_by_surfaces(
    (step, moved): (&MoveStep, &SheetMove),
    (k, state): (usize, &AirState),
    sheet: &WakeSheet,
) -> DVec3 {
    if moved.unhindered.is_empty() {
        return DVec3::ZERO;
    }
    let (rows, edge) = (sheet.rows(), &step.lattice.sheets()[k].nodes);
    let with = |free: &dyn Fn(usize, usize) -> DVec3| {
        impulse_with(sheet, rows, |r, c| match r < rows {
            true => free(r, c),
            false => state.position[edge[c]] + step.dt * state.velocity[edge[c]],
        })
    };
    let unhindered = with(&|r, c| moved.unhindered[r * (sheet.columns + 1) + c]);
    unhindered - with(&|r, c| sheet.node(r, c))
}

/// Impulse per density [m4/s], N, of the rings of a sheet but the newest row, which is still at the edge.
pub(crate) fn free_rings(sheet: &WakeSheet) -> DVec3 {
    oldest_rings(sheet, sheet.rows().saturating_sub(1))
}

/// The same of the oldest `rows` rows.
pub(crate) fn oldest_rings(sheet: &WakeSheet, rows: usize) -> DVec3 {
    let rows = rows.min(sheet.rows().saturating_sub(1));
    impulse_with(sheet, rows, |r, c| sheet.node(r, c))
}

/// Impulse per density [m4/s], N, of the oldest `rows` rows of rings of a sheet with its nodes at `at` (row, column).
/// Where rings of the sheet have become particles, that of its filaments, which hold what borders on those.
pub(crate) fn impulse_with(
    sheet: &WakeSheet,
    rows: usize,
    at: impl Fn(usize, usize) -> DVec3,
) -> DVec3 {
    if sheet.converted.iter().all(|&rows| rows == 0) {
        return sheet.impulse_with(rows, at);
    }
    let gamma = |r: usize, c: usize| match r < rows {
        true => sheet.ring(r, c),
        false => 0.0,
    };
    let mut sum = DVec3::ZERO;
    for r in 0..=rows {
        for c in 0..=sheet.columns {
            let mut add = |to: DVec3, net: f64| sum += 0.5 * net * at(r, c).cross(to);
            if sheet.borders_ring([r, c], true) {
                let older = r.checked_sub(1).map_or(0.0, |r| gamma(r, c));
                add(at(r, c + 1), gamma(r, c) - older);
            }
            if r < rows && sheet.borders_ring([r, c], false) {
                add(at(r + 1, c), sheet.between_columns(r, c));
            }
        }
    }
    sum
}

/// Impulses per density [m4/s], N, of all rings of the sheets, the newest rows reaching to the edges, and of free ones.
pub(crate) fn impulses(lattice: &Lattice, state: &AirState, sheets: &[WakeSheet]) -> [DVec3; 2] {
    let each = sheets.iter().zip(lattice.sheets()).map(|(sheet, root)| {
        let all = impulse_with(sheet, sheet.rows(), |r, c| match r < sheet.rows() {
            true => sheet.node(r, c),
            false => state.position[root.nodes[c]],
        });
        [all, free_rings(sheet)]
    });
    each.fold([DVec3::ZERO; 2], |[all, free], [a, f]| [all + a, free + f])
}

/// Puts what happened within a step into the account of the state.
pub(crate) fn book(lattice: &Lattice, state: &mut AirState, step: &SheetAccount) {
    let density = lattice.settings().density;
    state.impulse += step.impulse.map(|x| density * x);
    state.attached_impulse -= density * step.released;
    state.free_impulse = density * step.free;
}
