//! From step to step: the wakes move and shed a row.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::state::{AirState, WakeEvents, WakeSheet};
use crate::wake::account::{SheetAccount, VorticitySum, book, free_rings, impulses};
use crate::wake::contact::Obstacles;
use crate::wake::filaments::Filaments;
use crate::wake::joined_nodes::{merge_joined_nodes, put_on_planes};
use crate::wake::move_step::MoveStep;
use crate::wake::near_wake::RowShape;
use crate::wake::sheet_move::SheetMove;
use crate::wake::summation::Sums;
use crate::wake::wake_flow::WakeFlow;

/// Memory of the motion of the wakes.
#[derive(Default)]
pub(crate) struct WakeMotion {
    flow: WakeFlow,
    /// Surfaces in the way.
    obstacles: Obstacles,
    /// What happened to the sheet that was moved last.
    moved: SheetMove,
    /// What happened to the vorticity of each sheet.
    accounts: Vec<SheetAccount>,
}

impl WakeMotion {
    /// Takes the velocities of the accepted step, whose filaments have their circulations.
    pub(crate) fn take_velocities(
        &mut self,
        lattice: &Lattice,
        state: &AirState,
        filaments: &Filaments,
        sums: &mut Sums,
    ) {
        self.flow.take(lattice, state, filaments, sums);
    }

    /// Moves all sheets by `dt` [s], sheds a row from each and drops what is due; `newest` are the newest rows.
    /// Returns what had to be limited.
    ///
    /// # Errors
    /// Velocities that are not finite.
    pub(crate) fn move_sheets(
        &mut self,
        lattice: &Lattice,
        state: &mut AirState,
        dt: f64,
        newest: &[RowShape],
    ) -> Result<WakeEvents, AirError> {
        self.obstacles.take(lattice, state, dt);
        let step = MoveStep::new(lattice, (&self.flow, &self.obstacles), state, dt);
        let mut sheets = std::mem::take(&mut state.sheets);
        self.accounts.clear();
        let out = (&mut self.moved, &mut self.accounts);
        let events = move_each(&step, state, &mut sheets, newest, out);
        let mut sum = SheetAccount::default();
        self.accounts.iter().for_each(|account| sum += *account);
        let topology = lattice.topology();
        let is_joined = !topology.joined_columns.is_empty() || !topology.plane_columns.is_empty();
        if events.is_ok() && is_joined {
            let before = impulses(lattice, state, &sheets);
            merge_joined_nodes(lattice, &mut sheets);
            put_on_planes(lattice, &state.position, &mut sheets);
            let after = impulses(lattice, state, &sheets);
            sum.moved.impulse += after[0] - before[0];
            sum.free.impulse += after[1] - before[1];
            sum.released.impulse -= (after[0] - after[1]) - (before[0] - before[1]);
        }
        state.sheets = sheets;
        let events = events?;
        book(lattice, state, &sum);
        lattice.drop_common_circulation(state);
        Ok(events)
    }
}

/// Moves sheet after sheet, in `moved`; `accounts` get what happens to the vorticity of each.
fn move_each(
    step: &MoveStep,
    state: &AirState,
    sheets: &mut [WakeSheet],
    newest: &[RowShape],
    (moved, accounts): (&mut SheetMove, &mut Vec<SheetAccount>),
) -> Result<WakeEvents, AirError> {
    let lattice = step.lattice;
    let mut events = WakeEvents::default();
    for (k, shape) in newest.iter().enumerate() {
        let (others, rest) = sheets.split_at_mut(k);
        let sheet = &mut rest[0];
        let Some((source, mirror)) = lattice.reflected_sheet(k) else {
            let before = [
                free_rings(sheet),
                VorticitySum::of_particles(&sheet.particles),
            ];
            events += moved.move_nodes(step, (k, state.step), sheet)?;
            events += moved.move_particles(step, (k, state.step), &mut sheet.particles)?;
            lattice.shed(k, (others, sheet), state, shape);
            events.leading_rings += lattice.leading_rings(k, sheet);
            let mut account = SheetAccount::of_move((step, moved), (k, state), sheet, before);
            events += lattice.truncate(k, sheet, (state, step.dt), &mut account);
            accounts.push(account);
            continue;
        };
        lattice.shed(k, (others, sheet), state, shape);
        let rows = sheet.reflect(&others[source], mirror);
        if lattice.settings().particles.is_none() {
            events.dropped_rows += rows;
        }
        accounts.push(accounts[source].reflected(mirror));
    }
    Ok(events)
}
