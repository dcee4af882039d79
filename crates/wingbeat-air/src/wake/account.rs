//! What happens to the impulse of a wake sheet within a step.

use crate::images::Mirror;
use crate::lattice::Lattice;
use crate::state::{AirState, ImpulseAccount, Particles, WakeSheet};
use crate::wake::move_step::MoveStep;
use crate::wake::sheet_move::SheetMove;
use wingbeat_math::DVec3;

/// Impulse of vorticity about the origin, and its total strength: that of closed rings is zero, that of particles, and
/// of the filaments that border on rings which became particles, is not.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct VorticitySum {
    /// Half the sum of `x cross alpha`, per density [m4/s], N components.
    pub impulse: DVec3,
    /// Sum of all alpha [m3/s], N components.
    pub strength: DVec3,
}

impl VorticitySum {
    /// Of vorticity whose total strength is zero.
    fn closed(impulse: DVec3) -> Self {
        Self {
            impulse,
            strength: DVec3::ZERO,
        }
    }

    pub(crate) fn of_particles(set: &Particles) -> Self {
        Self {
            impulse: set.impulse(),
            strength: set.strength.iter().sum(),
        }
    }

    /// That of the mirror image: with `x' = T x + s` and `alpha' = det(T) T alpha`, half the sum of `x' cross alpha'`
    /// is `T` times that of `x cross alpha`, and `s / 2 cross` the total strength of the image.
    fn reflected(&self, mirror: Mirror) -> Self {
        let strength = mirror.axial(self.strength);
        Self {
            impulse: mirror.vector(self.impulse) + 0.5 * mirror.shift().cross(strength),
            strength,
        }
    }
}

impl std::ops::Add for VorticitySum {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            impulse: self.impulse + other.impulse,
            strength: self.strength + other.strength,
        }
    }
}

impl std::ops::Sub for VorticitySum {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            impulse: self.impulse - other.impulse,
            strength: self.strength - other.strength,
        }
    }
}

/// Changes of the vorticity of one sheet, as [`ImpulseAccount`] has them of the impulse.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SheetAccount {
    pub moved: VorticitySum,
    pub converted: VorticitySum,
    pub cut: VorticitySum,
    pub absorbed: VorticitySum,
    /// What the row that left had less what the new one at the edge has: no longer that of the attached vorticity.
    pub released: VorticitySum,
    /// What the free rings and particles have at the end.
    pub free: VorticitySum,
}

impl std::ops::AddAssign for SheetAccount {
    fn add_assign(&mut self, other: Self) {
        *self = Self {
            moved: self.moved + other.moved,
            converted: self.converted + other.converted,
            cut: self.cut + other.cut,
            absorbed: self.absorbed + other.absorbed,
            released: self.released + other.released,
            free: self.free + other.free,
        };
    }
}

impl SheetAccount {
    /// That of the mirror image.
    pub(crate) fn reflected(&self, mirror: Mirror) -> Self {
        Self {
            moved: self.moved.reflected(mirror),
            converted: self.converted.reflected(mirror),
            cut: self.cut.reflected(mirror),
            absorbed: self.absorbed.reflected(mirror),
            released: self.released.reflected(mirror),
            free: self.free.reflected(mirror),
        }
    }

    /// The account of `sheet` k, moved in `step` and with its new row shed; `before` is what its free rings had before,
    /// and what its particles had.
    pub(crate) fn of_move(
        (step, moved): (&MoveStep, &SheetMove),
        (k, state): (usize, &AirState),
        sheet: &WakeSheet,
        before: [VorticitySum; 2],
    ) -> Self {
        let rows = sheet.rows();
        let edge = |c: usize| moved.node_before(rows - 1, sheet, c);
        let start = vorticity_with(sheet, rows, |r, c| {
            moved.node_before(r.min(rows - 1), sheet, c)
        });
        let end = vorticity_with(sheet, rows, |r, c| match r < rows {
            true => sheet.node(r, c),
            false => edge(c),
        });
        let absorbed = taken_by_surfaces((step, moved), (k, state), sheet);
        let [rings_before, particles_before] = before;
        let rings = free_rings(sheet);
        let particles = VorticitySum::of_particles(&sheet.particles);
        let taken = VorticitySum::closed(moved.taken);
        Self {
            moved: (end + absorbed - start) + (particles + taken - particles_before),
            absorbed: absorbed + taken,
            released: (start - rings_before) - (end - rings),
            free: rings + particles,
            ..Self::default()
        }
    }
}

/// Vorticity of the rings of sheet `k` without surfaces in the way, less what it is with them. The newest rows reach
/// to where the shedding edge goes within the step: were it left behind, they would be longer by the way of the
/// animal, and what is taken would depend on the inertial frame.
fn taken_by_surfaces(
    (step, moved): (&MoveStep, &SheetMove),
    (k, state): (usize, &AirState),
    sheet: &WakeSheet,
) -> VorticitySum {
    if moved.unhindered.is_empty() {
        return VorticitySum::default();
    }
    let (rows, edge) = (sheet.rows(), &step.lattice.sheets()[k].nodes);
    let with = |free: &dyn Fn(usize, usize) -> DVec3| {
        vorticity_with(sheet, rows, |r, c| match r < rows {
            true => free(r, c),
            false => state.position[edge[c]] + step.dt * state.velocity[edge[c]],
        })
    };
    let unhindered = with(&|r, c| moved.unhindered[r * (sheet.columns + 1) + c]);
    unhindered - with(&|r, c| sheet.node(r, c))
}

/// Vorticity of the rings of a sheet but the newest row, which is still at the edge.
pub(crate) fn free_rings(sheet: &WakeSheet) -> VorticitySum {
    oldest_rings(sheet, sheet.rows().saturating_sub(1))
}

/// The same of the oldest `rows` rows.
pub(crate) fn oldest_rings(sheet: &WakeSheet, rows: usize) -> VorticitySum {
    let rows = rows.min(sheet.rows().saturating_sub(1));
    vorticity_with(sheet, rows, |r, c| sheet.node(r, c))
}

/// Vorticity of the oldest `rows` rows of rings of a sheet with its nodes at `at` (row, column). Where rings of the
/// sheet have become particles, that of its filaments, which hold what borders on those.
fn vorticity_with(
    sheet: &WakeSheet,
    rows: usize,
    at: impl Fn(usize, usize) -> DVec3,
) -> VorticitySum {
    if sheet.converted.iter().all(|&rows| rows == 0) {
        return VorticitySum::closed(sheet.impulse_with(rows, at));
    }
    let gamma = |r: usize, c: usize| match r < rows {
        true => sheet.ring(r, c),
        false => 0.0,
    };
    let mut sum = VorticitySum::default();
    for r in 0..=rows {
        for c in 0..=sheet.columns {
            let mut add = |to: DVec3, net: f64| {
                sum.impulse += 0.5 * net * at(r, c).cross(to);
                sum.strength += net * (to - at(r, c));
            };
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
        let all = vorticity_with(sheet, sheet.rows(), |r, c| match r < sheet.rows() {
            true => sheet.node(r, c),
            false => state.position[root.nodes[c]],
        });
        [all, free_rings(sheet)].map(|sum| sum.impulse)
    });
    each.fold([DVec3::ZERO; 2], |[all, free], [a, f]| [all + a, free + f])
}

/// Puts what happened within a step into the account of the state.
pub(crate) fn book(lattice: &Lattice, state: &mut AirState, step: &SheetAccount) {
    let density = lattice.settings().density;
    state.impulse += ImpulseAccount {
        created: DVec3::ZERO,
        moved: density * step.moved.impulse,
        converted: density * step.converted.impulse,
        cut: density * step.cut.impulse,
        absorbed: density * step.absorbed.impulse,
    };
    state.attached_impulse -= density * step.released.impulse;
    state.free_impulse = density * step.free.impulse;
}
