//! From step to step: the wakes move and shed a row.

use crate::error::AirError;
use crate::lattice::Lattice;
use crate::settings::Convection;
use crate::state::{AirState, WakeEvents, WakeSheet};
use crate::wake::contact::Obstacles;
use crate::wake::filaments::Filaments;
use crate::wake::force_free::ForceFree;
use crate::wake::joined_nodes::merge_joined_nodes;
use crate::wake::mover::Mover;
use crate::wake::particle_flow::ParticleFlow;
use crate::wake::summation::Sums;
use wingbeat_math::DVec3;
use wingbeat_vortex::Points;

/// Memory of the motion of the wakes.
#[derive(Default)]
pub(crate) struct WakeMotion {
    /// Nodes that are moved, and the velocity there without the undisturbed air.
    nodes: Points,
    velocity: Points,
    flow: ParticleFlow,
    force_free: ForceFree,
    /// Surfaces in the way.
    obstacles: Obstacles,
    /// Paths of the nodes of a sheet.
    from: Vec<DVec3>,
    to: Vec<DVec3>,
    unhindered: Vec<DVec3>,
    /// Impulse per density of what each sheet dropped and of what contact took from it.
    dropped: Vec<DVec3>,
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
        sums.add_at_wakes(&self.nodes, lattice.mirrors(), &mut self.velocity);
        if lattice.settings().is_symmetric() {
            let velocity = &mut self.velocity;
            (self.force_free).correct(lattice, state, filaments, sums, velocity);
        }
        self.flow.take(lattice, state, sums);
    }

    /// Moves all sheets by `dt` [s], sheds a row from each and drops what is due; `lengths` are those of the
    /// newest rows. Returns what had to be limited.
    ///
    /// # Errors
    /// Velocities that are not finite.
    pub(crate) fn move_sheets(
        &mut self,
        lattice: &Lattice,
        state: &mut AirState,
        dt: f64,
        lengths: &[Vec<f64>],
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
            flow: &self.flow,
            next_particle: 0,
            events: WakeEvents::default(),
            from: std::mem::take(&mut self.from),
            to: std::mem::take(&mut self.to),
            unhindered: std::mem::take(&mut self.unhindered),
        };
        let mut sheets = std::mem::take(&mut state.sheets);
        self.dropped.clear();
        let moved = move_each(&mut mover, state, &mut sheets, lengths, &mut self.dropped);
        (self.from, self.to, self.unhindered) = (mover.from, mover.to, mover.unhindered);
        if moved.is_ok() {
            merge_joined_nodes(lattice.topology(), &mut sheets);
        }
        state.sheets = sheets;
        moved?;
        state.dropped_impulse += self.dropped.iter().sum::<DVec3>();
        Ok(mover.events)
    }
}

/// Moves sheet after sheet; `dropped` gets the impulse per density of what each has dropped or contact took from it.
fn move_each(
    mover: &mut Mover,
    state: &AirState,
    sheets: &mut [WakeSheet],
    lengths: &[Vec<f64>],
    dropped: &mut Vec<DVec3>,
) -> Result<(), AirError> {
    let lattice = mover.lattice;
    for (k, lengths) in lengths.iter().enumerate() {
        let (before, rest) = sheets.split_at_mut(k);
        let sheet = &mut rest[0];
        let Some((source, mirror)) = lattice.reflected_sheet(k) else {
            move_sheet(mover, (k, state.step), sheet)?;
            lattice.shed(k, sheet, state, lengths);
            let taken = mover.taken_by_contact(sheet);
            let (events, impulse) = lattice.truncate(k, sheet, state);
            mover.events += events;
            dropped.push(impulse + taken);
            continue;
        };
        lattice.shed(k, sheet, state, lengths);
        let rows = sheet.reflect(&before[source], mirror);
        if lattice.settings().particles.is_none() {
            mover.events.dropped_rows += rows;
        }
        dropped.push(mirror.vector(dropped[source]));
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
        .move_nodes(sheet)
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
