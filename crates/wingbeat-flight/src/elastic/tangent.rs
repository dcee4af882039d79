//! The air's answer to the motion of an elastic wing, for the left-hand side of a step.

use wingbeat_math::DMat3;
use wingbeat_structure::{Configuration, Follower, LoadTangent, NODE};

use crate::interface::WingResponse;

/// Derivatives of the loads on the nodes of an elastic body by their six numbers and by their rates.
#[derive(Clone, Debug, Default)]
pub(super) struct AirTangent {
    /// By places, N/m, N, N m.
    pub position: Vec<f64>,
    /// By velocities.
    pub velocity: Vec<f64>,
    /// By accelerations; empty where loads do not follow them at once.
    pub acceleration: Vec<f64>,
    wash: [Vec<f64>; 2],
    answer: Vec<f64>,
}

impl AirTangent {
    /// From the answer of a wing of attitude `r` whose mesh follows by `followers` in the configuration `at`.
    pub fn set(
        &mut self,
        air: &WingResponse,
        r: DMat3,
        followers: &[Follower],
        at: &Configuration,
    ) {
        let (count, width) = (air.panels.len(), NODE * at.len());
        let back = r.transpose();
        for (k, rows) in self.wash.iter_mut().enumerate() {
            rows.clear();
            rows.resize(count * width, 0.0);
            for (panel, row) in air.panels.iter().zip(rows.chunks_exact_mut(width)) {
                for (node, by) in panel {
                    followers[*node].add_force(at, back * by[k], row);
                }
            }
        }
        let [by_velocity, by_place] = &self.wash;
        for (out, wash) in [
            (&mut self.velocity, by_velocity),
            (&mut self.position, by_place),
        ] {
            times(&air.matrix, wash, count, width, &mut self.answer);
            transposed_times(by_velocity, &self.answer, count, width, out);
        }
        self.acceleration.clear();
        if !air.inertia.is_empty() {
            times(&air.inertia, by_velocity, count, width, &mut self.answer);
            let out = &mut self.acceleration;
            transposed_times(by_velocity, &self.answer, count, width, out);
        }
    }

    /// The derivatives as the structure takes them.
    pub fn loads(&self) -> LoadTangent<'_> {
        LoadTangent {
            position: Some(&self.position),
            velocity: Some(&self.velocity),
            acceleration: (!self.acceleration.is_empty()).then_some(&self.acceleration),
        }
    }
}

/// Added mass of a wing of attitude `r` whose mesh follows by `followers` in the configuration `at`, from how
/// its panels answer to accelerations: force in W and moment in node components by accelerations of the nodes,
/// rows of six numbers a node each.
pub(super) fn added_mass(
    air: &WingResponse,
    r: DMat3,
    followers: &[Follower],
    at: &Configuration,
) -> Vec<f64> {
    let mut tangent = AirTangent::default();
    tangent.set(air, r, followers, at);
    let by_acceleration = match tangent.acceleration.is_empty() {
        true => &tangent.velocity,
        false => &tangent.acceleration,
    };
    by_acceleration.iter().map(|x| -x).collect()
}

/// `out = a b`, a of order `n`, b of n rows of `width`.
fn times(a: &[f64], b: &[f64], n: usize, width: usize, out: &mut Vec<f64>) {
    out.clear();
    out.resize(n * width, 0.0);
    for (row, to) in a.chunks_exact(n).zip(out.chunks_exact_mut(width)) {
        let felt = row
            .iter()
            .zip(b.chunks_exact(width))
            .filter(|(x, _)| **x != 0.0);
        for (x, from) in felt {
            to.iter_mut().zip(from).for_each(|(t, f)| *t += x * f);
        }
    }
}

/// `out = a^T b`, both of `n` rows of `width`.
fn transposed_times(a: &[f64], b: &[f64], n: usize, width: usize, out: &mut Vec<f64>) {
    out.clear();
    out.resize(width * width, 0.0);
    let rows = a.chunks_exact(width).zip(b.chunks_exact(width));
    for (row, from) in rows.take(n) {
        for (x, to) in row.iter().zip(out.chunks_exact_mut(width)) {
            if *x != 0.0 {
                to.iter_mut().zip(from).for_each(|(t, f)| *t += x * f);
            }
        }
    }
}
