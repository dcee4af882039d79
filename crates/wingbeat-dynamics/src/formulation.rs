//! The interface between a mechanical system and a time integrator.

pub mod euler;
pub(crate) mod euler_form;
pub(crate) mod inverse;
pub(crate) mod mobility;
pub(crate) mod momentum;
pub(crate) mod quaternion;
pub(crate) mod tether;
pub(crate) mod workspace;

use wingbeat_math::{BodyMotion, Wrench};

use std::fmt;

use crate::system::mirror::MirrorSymmetry;
use crate::system::shape::ShapeMass;
use crate::{AddedMass, DynamicsError, Solution, System, Workspace};

/// A way to write the motion of a [`System`] as `y' = f(t, y)`.
///
/// `loads` holds one [`Wrench`] per body, gravity not included. All buffers are in the
/// [`Workspace`]: steps allocate nothing, errors apart.
pub trait Formulation: fmt::Debug + Send + Sync {
    /// The system.
    fn system(&self) -> &System;

    /// Length of the state vector y.
    fn dim(&self) -> usize;

    /// Whether a support carries the root.
    fn is_supported(&self) -> bool {
        false
    }

    /// Whether angles of joints are coordinates of its own, so that whole turns count; else they are those of
    /// the bodies' attitudes, in (-pi, pi].
    fn counts_turns(&self) -> bool {
        false
    }

    /// Whether its momenta are those of bodies that change their shapes ([`Workspace::set_shapes`]): its rates are then
    /// asked for under external loads alone, its accelerations under all.
    fn takes_shapes(&self) -> bool {
        false
    }

    /// [`Self::initial_from`] for bodies of these shapes.
    ///
    /// # Errors
    /// As [`Self::initial`].
    fn initial_shaped(
        &self,
        t: f64,
        motions: &[BodyMotion],
        _shapes: &[ShapeMass],
    ) -> Result<Vec<f64>, DynamicsError> {
        self.initial_from(t, motions)
    }

    /// Room for intermediate results.
    fn workspace(&self) -> Workspace {
        Workspace::new(self.system())
    }

    /// The state at time `t` \[s\] in which the root moves like `root` and every other body as its
    /// hinge prescribes.
    ///
    /// # Errors
    /// The root's rotation or a law's is not a rotation; no consistent state exists.
    fn initial(&self, t: f64, root: &BodyMotion) -> Result<Vec<f64>, DynamicsError>;

    /// The state in which the bodies move like `motions`, which fulfil all constraints at time `t`
    /// \[s\]: how a flight changes over from other equations.
    ///
    /// # Errors
    /// As [`Self::initial`].
    fn initial_from(&self, t: f64, motions: &[BodyMotion]) -> Result<Vec<f64>, DynamicsError> {
        self.initial(t, &motions[0])
    }

    /// Motion of every body in the state `y` at time `t` \[s\].
    ///
    /// # Errors
    /// The state is not finite or singular.
    fn motions(
        &self,
        t: f64,
        y: &[f64],
        ws: &mut Workspace,
        out: &mut [BodyMotion],
    ) -> Result<(), DynamicsError>;

    /// Time derivative of the state.
    ///
    /// # Errors
    /// The state is not finite or singular.
    fn rates(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError>;

    /// Accelerations, hinge reactions, multipliers, energies and momenta in the state `y`.
    ///
    /// # Errors
    /// The state is not finite or singular.
    fn solve(
        &self,
        t: f64,
        y: &[f64],
        loads: &[Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError>;

    /// Adds to `loads` what the air that bodies carry along exerts under the accelerations that
    /// follow from all loads together. `out` is scratch.
    ///
    /// # Errors
    /// As [`Self::solve`]; added masses that no accelerations agree with.
    fn add_mass(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
    ) -> Result<(), DynamicsError> {
        add_by_response(self, (t, y), added, loads, ws, out)
    }

    /// [`Self::rates`] under `loads` and the air that bodies carry along. `loads` and `out` are scratch.
    ///
    /// # Errors
    /// As [`Self::add_mass`].
    fn rates_with(
        &self,
        (t, y): (f64, &[f64]),
        added: &[AddedMass],
        loads: &mut [Wrench],
        ws: &mut Workspace,
        out: &mut Solution,
        dy: &mut [f64],
    ) -> Result<(), DynamicsError> {
        self.add_mass((t, y), added, loads, ws, out)?;
        self.rates(t, y, loads, ws, dy)
    }

    /// Projects the rates `dy` of the state `y` onto motions that are symmetric in `mirror`; the Euler form,
    /// which has no free joints, leaves them as they are.
    fn symmetrise(&self, _mirror: &MirrorSymmetry, _y: &[f64], _dy: &mut [f64]) {}

    /// Natural size of every component of y, for norms of differences.
    fn scales(&self) -> Vec<f64>;

    /// Moves the state back onto what it must fulfil (unit quaternions). For one-step integrators, between steps.
    ///
    /// # Errors
    /// The projection fails.
    fn normalise(&self, t: f64, y: &mut [f64], ws: &mut Workspace) -> Result<(), DynamicsError>;
}

/// Adds to `loads` what `added` exerts, by the response of the formulation to unit loads: any
/// formulation, free joints and loops. `out` is scratch.
///
/// # Errors
/// What the formulation reports; added masses that no accelerations agree with.
pub fn add_by_response<F: Formulation + ?Sized>(
    form: &F,
    (t, y): (f64, &[f64]),
    added: &[AddedMass],
    loads: &mut [Wrench],
    ws: &mut Workspace,
    out: &mut Solution,
) -> Result<(), DynamicsError> {
    let mut response = std::mem::take(&mut ws.response);
    response.motions.resize(loads.len(), BodyMotion::REST);
    form.motions(t, y, ws, &mut response.motions)?;
    let mut solve = |loads: &[Wrench], out: &mut Solution| form.solve(t, y, loads, ws, out);
    let done = response.add((t, added), loads, &mut solve, out);
    ws.response = response;
    done
}
