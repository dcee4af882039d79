//! The mechanical system: rigid bodies, hinges with prescribed rotation, gravity.

use std::sync::Arc;

use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties, RotationLaw};

use crate::DynamicsError;

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name, for messages and results.
    pub name: String,
    /// Mass properties about the body's frame origin, body components.
    pub mass: MassProperties,
    /// Euler sequence of its three angles in the Euler form (seed: 2-3-1 body, 1-3-2 wings).
    pub sequence: EulerSequence,
}

/// A spherical joint whose rotation is prescribed in time: the child hangs at a point of the
/// parent and is turned against it by the law C(t) (seed eq. 4).
#[derive(Clone, Debug)]
pub struct Hinge {
    /// Name, for messages and results.
    pub name: String,
    /// Index of the parent body.
    pub parent: usize,
    /// Index of the child body.
    pub child: usize,
    /// Hinge point in the parent's frame \[m\].
    pub anchor_parent: DVec3,
    /// Hinge point in the child's frame \[m\]; zero for wings, whose origin is the hinge.
    pub anchor_child: DVec3,
    /// Prescribed rotation C(t): child components to parent components.
    pub law: Arc<dyn RotationLaw>,
}

/// Natural units of the problem: tolerances and scales are relative to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NaturalUnits {
    /// Length \[m\], for an insect its wing length.
    pub length: f64,
    /// Time \[s\], for an insect 1/f, the period of a wingbeat.
    pub time: f64,
}

/// Bodies joined by hinges to a tree; body 0 is the root, which moves freely.
///
/// ```
/// use wingbeat_dynamics::{Body, NaturalUnits, System};
/// use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties};
/// let mass = MassProperties::about_centre(2.0, DVec3::ZERO, DMat3::IDENTITY);
/// let body = Body { name: "ball".into(), mass, sequence: EulerSequence::BODY_231 };
/// let units = NaturalUnits { length: 1.0, time: 1.0 };
/// let system = System::new(vec![body], vec![], DVec3::new(0.0, 0.0, 9.81), units).unwrap();
/// assert_eq!(system.total_mass(), 2.0);
/// ```
#[derive(Clone, Debug)]
pub struct System {
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    gravity: DVec3,
    units: NaturalUnits,
    outward: Vec<usize>,
}

impl System {
    /// A system of `bodies` joined by `hinges` in the field `gravity` [m/s2, N components].
    ///
    /// # Errors
    /// Impossible mass properties, no mass at all, numbers that are not finite, hinges that do
    /// not join the bodies to a tree rooted at body 0.
    pub fn new(
        bodies: Vec<Body>,
        hinges: Vec<Hinge>,
        gravity: DVec3,
        units: NaturalUnits,
    ) -> Result<Self, DynamicsError> {
        check_numbers(&bodies, &hinges, gravity, units)?;
        let outward = outward_order(&bodies, &hinges)?;
        Ok(Self {
            bodies,
            hinges,
            gravity,
            units,
            outward,
        })
    }

    /// The bodies; 0 is the root.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The hinges, in the order in which reactions and multipliers are given.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// Gravity [m/s2], N components.
    pub fn gravity(&self) -> DVec3 {
        self.gravity
    }

    /// Natural units.
    pub fn units(&self) -> NaturalUnits {
        self.units
    }

    /// Total mass \[kg\].
    pub fn total_mass(&self) -> f64 {
        self.bodies.iter().map(|b| b.mass.mass).sum()
    }

    /// Indices of the hinges in an order in which every parent comes before its children.
    pub fn outward(&self) -> &[usize] {
        &self.outward
    }
}

/// Largest deviation of `r^T r` from the identity.
pub(crate) fn orthogonality_error(r: DMat3) -> f64 {
    let e = r.transpose() * r - DMat3::IDENTITY;
    e.to_cols_array().iter().fold(0.0, |a, x| a.max(x.abs()))
}

/// An error if `r` is not a rotation to 1e-9 (round-off of a long chain of products is below
/// 1e-12; a matrix typed with six digits is off by 1e-6).
pub(crate) fn check_rotation(
    r: DMat3,
    time: f64,
    what: impl FnOnce() -> String,
) -> Result<(), DynamicsError> {
    let (deviation, determinant) = (orthogonality_error(r), r.determinant());
    if deviation <= 1e-9 && determinant > 0.0 {
        return Ok(());
    }
    Err(DynamicsError::NotARotation {
        what: what(),
        time,
        deviation,
        determinant,
    })
}

fn check_numbers(
    bodies: &[Body],
    hinges: &[Hinge],
    gravity: DVec3,
    units: NaturalUnits,
) -> Result<(), DynamicsError> {
    for b in bodies {
        b.mass.validate().map_err(|source| DynamicsError::Mass {
            body: b.name.clone(),
            source,
        })?;
    }
    if !bodies.is_empty() && bodies.iter().all(|b| b.mass.mass == 0.0) {
        return Err(DynamicsError::NoMass);
    }
    check_finite("gravity [m/s2]", gravity)?;
    for h in hinges {
        check_finite(
            &format!("hinge `{}`: anchor on the parent [m]", h.name),
            h.anchor_parent,
        )?;
        check_finite(
            &format!("hinge `{}`: anchor on the child [m]", h.name),
            h.anchor_child,
        )?;
    }
    check_positive("natural unit of length [m]", units.length)?;
    check_positive("natural unit of time [s]", units.time)
}

fn check_finite(what: &str, v: DVec3) -> Result<(), DynamicsError> {
    match v.to_array().into_iter().find(|x| !x.is_finite()) {
        None => Ok(()),
        Some(value) => Err(bad_number(what, value, "")),
    }
}

fn check_positive(what: &str, value: f64) -> Result<(), DynamicsError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(bad_number(what, value, " > 0"))
}

fn bad_number(what: &str, value: f64, bound: &'static str) -> DynamicsError {
    DynamicsError::BadNumber {
        what: what.to_owned(),
        value,
        bound,
    }
}

/// Orders the hinges from the root outward.
fn outward_order(bodies: &[Body], hinges: &[Hinge]) -> Result<Vec<usize>, DynamicsError> {
    if bodies.is_empty() {
        return Err(DynamicsError::NoBodies);
    }
    check_ends(bodies, hinges)?;
    let mut reached = vec![false; bodies.len()];
    reached[0] = true;
    let mut order = Vec::with_capacity(hinges.len());
    while let Some(k) =
        (0..hinges.len()).find(|&k| reached[hinges[k].parent] && !reached[hinges[k].child])
    {
        reached[hinges[k].child] = true;
        order.push(k);
    }
    check_tree(bodies, hinges, &reached)?;
    Ok(order)
}

fn check_ends(bodies: &[Body], hinges: &[Hinge]) -> Result<(), DynamicsError> {
    for h in hinges {
        for index in [h.parent, h.child] {
            if index >= bodies.len() {
                return Err(DynamicsError::NoSuchBody {
                    hinge: h.name.clone(),
                    index,
                    last: bodies.len() - 1,
                });
            }
        }
    }
    Ok(())
}

fn check_tree(bodies: &[Body], hinges: &[Hinge], reached: &[bool]) -> Result<(), DynamicsError> {
    for (i, body) in bodies.iter().enumerate() {
        let count = hinges.iter().filter(|h| h.child == i).count();
        if count != usize::from(i > 0) || !reached[i] {
            return Err(DynamicsError::NotATree {
                body: body.name.clone(),
                hinges: count,
                reached: if reached[i] { "is" } else { "is not" },
            });
        }
    }
    Ok(())
}
