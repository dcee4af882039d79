//! From step to step: the wakes move and shed a row.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::settings::Convection;
use crate::state::{AirState, WakeEvents, WakeSheet};
use crate::wake::account::{SheetAccount, free_rings, impulse_with};
use crate::wake::contact::Obstacles;
use crate::wake::filaments::Filaments;
use crate::wake::force_free::ForceFree;
use crate::wake::joined_nodes::{merge_joined_nodes, put_on_planes};
use crate::wake::mover::Mover;
use crate::wake::near_wake::RowShape;
use crate::wake::particle_flow::ParticleFlow;
use crate::wake::summation::Sums;
use std::ops::Range;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Memory of the motion of the wakes.
#[derive(Default)]
pub(crate) struct WakeMotion {
    /// Nodes that are moved, and the velocity there without the undisturbed air.
    nodes: Points,
    velocity: Points,
    /// Middles of the rows of plane wakes, once for every node.
    middles: Points,
    flow: ParticleFlow,
    force_free: ForceFree,
    /// Surfaces in the way.
    obstacles: Obstacles,
    /// Paths of the nodes of a sheet.
    from: Vec<DVec3>,
    to: Vec<DVec3>,
    unhindered: Vec<DVec3>,
    /// What happened to the impulse of each sheet.
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
        filaments.movable(lattice, state, &mut self.nodes);
        self.velocity.reset(self.nodes.len());
        sums.load_for_wakes(lattice.settings(), filaments);
        let velocity = &mut self.velocity;
        let mut places = &self.nodes;
        if lattice.settings().plane_wakes {
            // Where the flow is plane: in the middle of each row, far from its ends.
            self.middles.copy_from(&self.nodes);
            for row in rows(lattice, state) {
                let ends = [row.start, row.end - 1].map(|n| self.nodes.get(n));
                row.for_each(|n| self.middles.set(n, ends[0].midpoint(ends[1])));
            }
            places = &self.middles;
        }
        if lattice.settings().is_symmetric() {
            (self.force_free).add_velocity(lattice, state, filaments, sums, places, velocity);
        } else {
            sums.add_at_wakes(places, lattice.mirrors(), velocity);
        }
        if lattice.settings().plane_wakes {
            for row in rows(lattice, state) {
                make_plane(row, &self.nodes, velocity);
            }
        }
        self.flow.take(lattice, state, sums);
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
        let looks_back = lattice.settings().convection == Convection::AdamsBashforth;
        let mut mover = Mover {
            lattice,
            nodes: &self.nodes,
            velocity: &self.velocity,
            limit: lattice.settings().max_displacement.unwrap_or(f64::INFINITY),
            time: state.time,
            dt,
            looks_back,
            change: if looks_back && state.dt_wake > 0.0 {
                0.5 * dt / state.dt_wake
            } else {
                0.0
            },
            obstacles: &self.obstacles,
            next: 0,
            first: 0,
            flow: &self.flow,
            next_particle: 0,
            events: WakeEvents::default(),
            from: std::mem::take(&mut self.from),
            to: std::mem::take(&mut self.to),
            unhindered: std::mem::take(&mut self.unhindered),
            taken_from_particles: DVec3::ZERO,
        };
        let mut sheets = std::mem::take(&mut state.sheets);
        self.accounts.clear();
        let moved = move_each(&mut mover, state, &mut sheets, newest, &mut self.accounts);
        (self.from, self.to, self.unhindered) = (mover.from, mover.to, mover.unhindered);
        let mut sum = SheetAccount::default();
        self.accounts.iter().for_each(|account| sum += *account);
        let topology = lattice.topology();
        let is_joined = !topology.joined_columns.is_empty() || !topology.plane_columns.is_empty();
        if moved.is_ok() && is_joined {
            let before = impulses(lattice, state, &sheets);
            merge_joined_nodes(lattice, &mut sheets);
            put_on_planes(lattice, &state.position, &mut sheets);
            let after = impulses(lattice, state, &sheets);
            sum.impulse.moved += after[0] - before[0];
            sum.free += after[1] - before[1];
            sum.released -= (after[0] - after[1]) - (before[0] - before[1]);
        }
        state.sheets = sheets;
        moved?;
        book(lattice, state, &sum);
        lattice.drop_common_circulation(state);
        Ok(mover.events)
    }
}

/// Numbers of the nodes of every row of wake that is moved, the shedding edge among them.
fn rows<'a>(lattice: &'a Lattice, state: &'a AirState) -> impl Iterator<Item = Range<usize>> + 'a {
    let sheets = state.sheets.iter().enumerate();
    let moved = sheets.filter(|(k, _)| lattice.reflected_sheet(*k).is_none());
    let widths = moved.flat_map(|(_, sheet)| (0..=sheet.rows()).map(|_| sheet.columns + 1));
    widths.scan(0, |end, width| {
        *end += width;
        Some(*end - width..*end)
    })
}

/// Gives the nodes of a row of wake their mean velocity, without its part along the row.
fn make_plane(row: Range<usize>, nodes: &Points, velocity: &mut Points) {
    let mean = row.clone().map(|n| velocity.get(n)).sum::<DVec3>() / row.len() as f64;
    let along = nodes.get(row.end - 1) - nodes.get(row.start);
    let across = mean - mean.project_onto(along);
    row.for_each(|n| velocity.set(n, across));
}

/// Impulses per density [m4/s], N, of all rings of the sheets, the newest rows reaching to the edges, and of free ones.
fn impulses(lattice: &Lattice, state: &AirState, sheets: &[WakeSheet]) -> [DVec3; 2] {
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
fn book(lattice: &Lattice, state: &mut AirState, step: &SheetAccount) {
    let density = lattice.settings().density;
    state.impulse += step.impulse.map(|x| density * x);
    state.attached_impulse -= density * step.released;
    state.free_impulse = density * step.free;
}

/// Moves sheet after sheet; `accounts` get what happens to the impulse of each.
fn move_each(
    mover: &mut Mover,
    state: &AirState,
    sheets: &mut [WakeSheet],
    newest: &[RowShape],
    accounts: &mut Vec<SheetAccount>,
) -> Result<(), AirError> {
    let lattice = mover.lattice;
    for (k, shape) in newest.iter().enumerate() {
        let (others, rest) = sheets.split_at_mut(k);
        let sheet = &mut rest[0];
        let Some((source, mirror)) = lattice.reflected_sheet(k) else {
            let before = [free_rings(sheet), sheet.particles.impulse()];
            move_sheet(mover, (k, state.step), sheet)?;
            lattice.shed(k, (others, sheet), state, shape);
            mover.events.leading_rings += lattice.leading_rings(k, sheet);
            let mut account = SheetAccount::of_move(mover, (k, state), sheet, before);
            mover.events += lattice.truncate(k, sheet, (state, mover.dt), &mut account);
            accounts.push(account);
            continue;
        };
        lattice.shed(k, (others, sheet), state, shape);
        let rows = sheet.reflect(&others[source], mirror);
        if lattice.settings().particles.is_none() {
            mover.events.dropped_rows += rows;
        }
        accounts.push(accounts[source].reflected(mirror));
    }
    Ok(())
}

/// Moves nodes and particles of sheet `k`.
fn move_sheet(
    mover: &mut Mover,
    (k, step): (usize, u64),
    sheet: &mut WakeSheet,
) -> Result<(), AirError> {
    mover
        .move_nodes(sheet, mover.lattice.middle_column(k))
        .map_err(|(row, column, velocity)| AirError::WakeNotFinite {
            step,
            sheet: k,
            row,
            column,
            velocity,
        })?;
    mover
        .move_particles(&mut sheet.particles)
        .map_err(|(particle, velocity)| AirError::ParticleNotFinite {
            step,
            sheet: k,
            particle,
            velocity,
        })
}
