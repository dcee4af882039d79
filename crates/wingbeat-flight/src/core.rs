//! How the root body moves: freely, by one of the formulations, or as a tether prescribes.

use wingbeat_dynamics::{
    AddedMass, BodyAcceleration, BodyMotion, Formulation, MirrorSymmetry, RootMotion, ShapeMass,
    Solution, System, Workspace, Wrench, tethered, tethered_motions,
};
use wingbeat_math::{DVec3, EulerSequence};

use crate::error::FlightError;
use crate::prescribed::PrescribedMotion;
use crate::setup::{FlightSetup, MotionMode, StartState};

/// The bodies' equations of motion, free or tethered.
#[expect(clippy::large_enum_variant, reason = "there are one or two per flight")]
pub enum Core {
    /// Integrated: free flight, or a support that carries a root with free joints.
    Free(Box<dyn Formulation>),
    /// Tethered with all joints prescribed: nothing to integrate, the support's reaction is what is asked for.
    Tethered {
        /// The bodies.
        system: System,
        /// Motion of the root.
        motion: PrescribedMotion,
    },
}

impl std::fmt::Debug for Core {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Free(form) => write!(f, "Free({:?})", form.system()),
            Self::Tethered { motion, .. } => write!(f, "Tethered({motion:?})"),
        }
    }
}

impl Core {
    /// The bodies.
    pub fn system(&self) -> &System {
        match self {
            Self::Free(form) => form.system(),
            Self::Tethered { system, .. } => system,
        }
    }

    /// Whether a support holds the root.
    pub fn is_held(&self) -> bool {
        match self {
            Self::Free(form) => form.is_supported(),
            Self::Tethered { .. } => true,
        }
    }

    /// Whether all accelerations follow from time alone, whatever the loads.
    pub fn prescribes_all(&self) -> bool {
        matches!(self, Self::Tethered { .. })
    }

    /// Whether the momenta of the state are those of wings that bend ([`Formulation::takes_shapes`]).
    pub fn takes_shapes(&self) -> bool {
        match self {
            Self::Free(form) => form.takes_shapes(),
            Self::Tethered { .. } => false,
        }
    }

    /// Whether whole turns of joints count among the state.
    pub fn counts_turns(&self) -> bool {
        match self {
            Self::Free(form) => form.counts_turns(),
            Self::Tethered { .. } => false,
        }
    }

    /// Length of the state vector; 0 when tethered.
    pub fn dim(&self) -> usize {
        match self {
            Self::Free(form) => form.dim(),
            Self::Tethered { .. } => 0,
        }
    }

    /// Natural sizes of the state components.
    pub fn scales(&self) -> Vec<f64> {
        match self {
            Self::Free(form) => form.scales(),
            Self::Tethered { .. } => vec![],
        }
    }

    /// Consistent state at time `t` [s] for a root that moves like `root`.
    ///
    /// # Errors
    /// No consistent state exists, or it is singular.
    pub fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, FlightError> {
        match self {
            Self::Free(form) => Ok(form.initial(t, root)?),
            Self::Tethered { .. } => Ok(vec![]),
        }
    }

    /// Consistent state at time `t` [s] for bodies that move like `motions` and have these shapes.
    ///
    /// # Errors
    /// No consistent state exists, or it is singular.
    pub fn initial_from(
        &self,
        t: f64,
        motions: &[BodyMotion],
        shapes: &[ShapeMass],
    ) -> Result<Vec<f64>, FlightError> {
        match self {
            Self::Free(form) => Ok(form.initial_shaped(t, motions, shapes)?),
            Self::Tethered { .. } => Ok(vec![]),
        }
    }

    /// Room for intermediate results.
    pub fn workspace(&self) -> Workspace {
        match self {
            Self::Free(form) => form.workspace(),
            Self::Tethered { system, .. } => Workspace::new(system),
        }
    }

    /// Puts the state back onto what it must fulfil, after a step of a one-step method.
    ///
    /// # Errors
    /// The projection fails.
    pub fn normalise(&self, t: f64, y: &mut [f64], ws: &mut Workspace) -> Result<(), FlightError> {
        if let Self::Free(form) = self {
            form.normalise(t, y, ws)?;
        }
        Ok(())
    }

    /// Motions of all bodies.
    ///
    /// # Errors
    /// The state is not finite or singular.
    pub fn motions(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), FlightError> {
        match self {
            Self::Free(form) => form.motions(t, y, ws, out)?,
            Self::Tethered { system, motion } => {
                tethered_motions(system, t, &root_motion(motion, t).motion, ws, out);
            }
        }
        Ok(())
    }

    /// Rates of the state under external `loads`.
    ///
    /// # Errors
    /// The state is not finite or singular.
    pub fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        if let Self::Free(form) = self {
            form.rates(t, y, loads, ws, dy)?;
        }
        Ok(())
    }

    /// Leaves of the rates `dy` of the state `y` those of a motion that is its own image in `mirror`.
    pub fn symmetrise(&self, mirror: &MirrorSymmetry, y: &[f64], dy: &mut [f64]) {
        if let Self::Free(form) = self {
            form.symmetrise(mirror, y, dy);
        }
    }

    /// Adds to `loads` what the air that bodies carry along exerts. `out` is scratch.
    ///
    /// # Errors
    /// As [`Self::solve`]; added masses that no accelerations agree with.
    pub fn add_mass(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), FlightError> {
        match self {
            Self::Free(form) => form.add_mass((t, y), added, loads, ws, out)?,
            Self::Tethered { system, motion } => {
                // Accelerations are prescribed: they do not depend on the loads.
                let root = root_motion(motion, t);
                tethered(system, t, &root, loads, ws, out);
                let motions = ws.motions();
                for a in added {
                    let (m, acc) = (&motions[a.body()], &out.bodies[a.body()]);
                    loads[a.body()] += a.wrench(m, acc);
                }
            }
        }
        Ok(())
    }

    /// Rates under `loads` and the air that bodies carry along; `loads` and `out` are scratch.
    ///
    /// # Errors
    /// As [`Self::add_mass`].
    pub fn rates_with(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
        dy: &mut [f64],
    ) -> Result<(), FlightError> {
        match self {
            Self::Free(form) if added.is_empty() => form.rates(t, y, loads, ws, dy)?,
            Self::Free(form) => form.rates_with((t, y), added, loads, ws, out, dy)?,
            Self::Tethered { .. } => {}
        }
        Ok(())
    }

    /// Accelerations, reactions, energies and momenta.
    ///
    /// # Errors
    /// The state is not finite or singular.
    pub fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), FlightError> {
        match self {
            Self::Free(form) => form.solve(t, y, loads, ws, out)?,
            Self::Tethered { system, motion } => {
                tethered(system, t, &root_motion(motion, t), loads, ws, out);
            }
        }
        Ok(())
    }
}

/// The prescribed root in the words of the dynamics.
pub fn root_motion(motion: &PrescribedMotion, t: f64) -> RootMotion {
    let root = motion.at(t);
    RootMotion {
        motion: BodyMotion {
            p: root.position,
            r: root.rotation,
            v: root.velocity,
            w: root.angular_velocity,
        },
        acceleration: BodyAcceleration {
            linear: root.acceleration,
            angular: root.angular_acceleration,
        },
    }
}

impl FlightSetup {
    /// Motion of the root at time zero.
    pub fn root_at_start(&self) -> BodyMotion {
        match &self.mode {
            MotionMode::Tethered(motion) => root_motion(motion, 0.0).motion,
            MotionMode::Free(start) if start.held_steps > 0 => {
                root_motion(&start.hold(), 0.0).motion
            }
            MotionMode::Free(start) if start.held_motion.is_some() => start.released(0.0),
            MotionMode::Free(start) => BodyMotion {
                p: start.position,
                r: start.rotation(),
                v: start.velocity,
                w: start.angular_velocity,
            },
        }
    }
}

impl FlightSetup {
    /// Pitch, yaw and roll of the root where its free flight begins, be it released then or not; tethered all
    /// along, the means over its motion \[rad\].
    pub fn angles_at_release(&self) -> DVec3 {
        match &self.mode {
            MotionMode::Tethered(motion) => {
                DVec3::from_array(motion.angles.each_ref().map(|a| a.constant))
            }
            MotionMode::Free(start) if start.held_motion.is_some() => {
                let root = start.released(start.held_steps as f64 * self.time.step);
                EulerSequence::BODY_231.angles(root.r)
            }
            MotionMode::Free(start) => start.angles,
        }
    }
}

impl StartState {
    /// Motion of the root that is released at `time` \[s\].
    pub fn released(&self, time: f64) -> BodyMotion {
        let mut root = root_motion(&self.hold(), time).motion;
        root.w += self.angular_velocity;
        root
    }
}
