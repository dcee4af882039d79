//! How the sections of a wing meet the undisturbed air in its prescribed motion.

use crate::setup::{FlightSetup, LOOKS, MotionMode};
use wingbeat_math::DVec3;
use wingbeat_model::{DeformingMesh, Wing};

/// Instants of a beat that are looked at in free flight.
const INSTANTS: usize = 100;

/// A chordwise strip of a wing at an instant.
pub(super) struct Section {
    /// Its number from the root.
    pub column: usize,
    /// Past the quarter chord, in the plane of the section [m/s].
    pub speed: f64,
    /// Along the normal, at the half of the chord and at three quarters [m/s].
    pub downwash: [f64; 2],
    /// [m]
    pub chord: f64,
    /// [m2]
    pub area: f64,
}

/// The instant at which sections are looked at.
#[derive(Clone, Copy)]
pub(super) struct Instant {
    /// Until the next one \[s\].
    pub duration: f64,
    /// Whether it lies before the wingbeat that counts.
    pub is_before: bool,
}

impl FlightSetup {
    /// Shows `see` all sections of wing `w` at the instants of its flight, of its first [`LOOKS`] steps where nothing
    /// beats, or of a wingbeat of free flight after so many `beats_before`. The motion begins at its full rate; that
    /// of wings on joints must be known beforehand ([`Self::prescribed_in_body`]).
    pub(super) fn visit_sections(
        &self,
        w: usize,
        beats_before: usize,
        mut see: impl FnMut(&Section, Instant),
    ) {
        let wing = &self.animal.wings[w];
        let motion = wing.motion.impulsive();
        let (before, count, duration) = match (&self.mode, motion.frequency > 0.0) {
            (MotionMode::Free(_), true) => {
                let duration = 1.0 / (motion.frequency * INSTANTS as f64);
                (beats_before * INSTANTS, INSTANTS, duration)
            }
            // What follows from step to step asks for all of them: those of the beginning where nothing beats.
            _ => match self.time.steps_per_beat() {
                None => (0, self.time.steps.min(LOOKS), self.time.step),
                Some(_) => {
                    let (count, duration) = self.time.looks(LOOKS);
                    (0, count, duration)
                }
            },
        };
        let shape = wing.deformation.as_ref();
        let shape = shape.map(|d| DeformingMesh::new(&wing.mesh, d));
        let rest = &wing.mesh.nodes;
        let mut nodes: Vec<[DVec3; 2]> = rest.iter().map(|x| [*x, DVec3::ZERO]).collect();
        for k in 0..before + count {
            let t = k as f64 * duration;
            if let Some(shape) = &shape {
                shape.visit(motion.phase_at(t), |n, [x, v, _]| nodes[n] = [x, v]);
            }
            let on_joint = self.has_own_joint(w).then(|| self.prescribed_in_body(w, t));
            let past: Box<dyn Fn(DVec3) -> DVec3> = match on_joint.flatten() {
                Some(moving) => Box::new(self.air_past_moving(moving, t)),
                None => Box::new(self.air_past(wing, &motion, t)),
            };
            let instant = Instant {
                duration,
                is_before: k < before,
            };
            for j in 0..wing.mesh.cols {
                if let Some(section) = section(wing, &nodes, j, &past) {
                    see(&section, instant);
                }
            }
        }
    }
}

/// Strip `j` of the wing, whose nodes have these places [m] and velocities [m/s] in wing components, `past` the air past
/// its places [m/s]; none of a strip without a chord, or that meets no air.
fn section(
    wing: &Wing,
    nodes: &[[DVec3; 2]],
    j: usize,
    past: impl Fn(DVec3) -> DVec3,
) -> Option<Section> {
    let mesh = &wing.mesh;
    let at = |i: usize, j: usize| nodes[mesh.node(i, j)];
    let middle = |i: usize| [0, 1].map(|k| at(i, j)[k].midpoint(at(i, j + 1)[k]));
    let (front, rear) = (middle(0), middle(mesh.rows));
    let across = at(0, j + 1)[0] - at(0, j)[0];
    let chord = front[0].distance(rear[0]);
    let aft = (rear[0] - front[0]).try_normalize()?;
    let normal = aft.cross(across).try_normalize()?;
    let relative = |s: f64| past(front[0].lerp(rear[0], s)) - front[1].lerp(rear[1], s);
    let quarter = relative(0.25);
    let speed = quarter.dot(aft).hypot(quarter.dot(normal));
    let downwash = [0.5, 0.75].map(|s| relative(s).dot(normal));
    let width = across.reject_from(aft).length();
    (speed > 0.0).then_some(Section {
        column: j,
        speed,
        downwash,
        chord,
        area: chord * width,
    })
}
