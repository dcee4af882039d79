//! What is dropped of a wake, and what becomes particles.

use crate::edges::EdgeKind;
use crate::lattice::Lattice;
use crate::state::{AirState, WakeEvents, WakeSheet};
use crate::wake::account::{SheetAccount, VorticitySum, free_rings, oldest_rings};
use crate::wake::contact::distance_to_segment;
use wingbeat_math::DVec3;

impl Lattice {
    /// Drops the oldest rows that are too many, too old or too far at the end of the step of `dt` [s], or makes
    /// particles of them, and puts their vorticity into the `account`.
    pub(crate) fn truncate(
        &self,
        k: usize,
        sheet: &mut WakeSheet,
        (state, dt): (&AirState, f64),
        account: &mut SheetAccount,
    ) -> WakeEvents {
        let settings = self.settings();
        let before = sheet.rows();
        let mut keep = before.min(settings.max_rows.unwrap_or(usize::MAX));
        if let Some(age) = settings.max_age {
            let young = |t: &&f64| state.time - **t <= age;
            keep = keep.min(sheet.shed_time.iter().filter(young).count());
        }
        if let Some(far) = settings.max_distance {
            let is_far = |r: usize| {
                let mut row = (0..=sheet.columns).map(|c| sheet.node(r, c));
                row.all(|x| self.way_from_edge(k, x, (state, dt)) > far)
            };
            let farthest = (0..before).rev().find(|&r| is_far(r));
            keep = keep.min(farthest.map_or(before, |r| before - 1 - r));
        }
        let dropped = before - keep.max(settings.least_rows()).min(before);
        if settings.particles.is_some() {
            return self.make_particles(k, sheet, dropped, (state, dt), account);
        }
        account.cut = oldest_rings(sheet, dropped);
        account.free = account.free - account.cut;
        sheet.keep(before - dropped);
        WakeEvents {
            dropped_rows: dropped as u64,
            ..WakeEvents::default()
        }
    }

    /// Distance of `x` from the edge that sheet `k` leaves [m], where it is at the end of the step by its velocity, as
    /// the nodes of the wake are.
    fn way_from_edge(&self, k: usize, x: DVec3, (state, dt): (&AirState, f64)) -> f64 {
        let at = |n: usize| state.position[n] + dt * state.velocity[n];
        let parts = self.sheets()[k].nodes.windows(2);
        let distances = parts.map(|ends| distance_to_segment(x, at(ends[0]), at(ends[1])));
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Makes particles of the rows of sheet `k` that are due, and of its oldest `dropped` rows in any
    /// case; drops particles that are too old or too far.
    fn make_particles(
        &self,
        k: usize,
        sheet: &mut WakeSheet,
        dropped: usize,
        (state, dt): (&AirState, f64),
        account: &mut SheetAccount,
    ) -> WakeEvents {
        let Some(settings) = &self.settings().particles else {
            return Default::default();
        };
        let (rows, kinds) = (sheet.rows(), &self.sheets()[k].kinds);
        let due = |c: usize| {
            let at_once = settings.leading_at_once && kinds[c] == EdgeKind::Leading;
            let keep = if at_once { Some(1) } else { settings.after };
            rows.saturating_sub(keep.unwrap_or(rows)).max(dropped)
        };
        let new_particles = sheet.convert(settings.radius, due);
        sheet.drop_converted();
        let (age, far) = (self.settings().max_age, self.settings().max_distance);
        let before = VorticitySum::of_particles(&sheet.particles);
        account.converted = free_rings(sheet) + before - account.free;
        let dropped_particles = sheet.particles.retain(|x, shed| {
            age.is_none_or(|age| state.time - shed <= age)
                && far.is_none_or(|far| self.way_from_edge(k, x, (state, dt)) <= far)
        });
        let particles = VorticitySum::of_particles(&sheet.particles);
        account.cut = before - particles;
        account.free = free_rings(sheet) + particles;
        WakeEvents {
            new_particles,
            dropped_particles,
            ..WakeEvents::default()
        }
    }
}
