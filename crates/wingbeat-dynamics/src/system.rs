//! The mechanical system: rigid bodies, hinges with prescribed rotation, gravity.

pub(crate) mod body;
pub(crate) mod check;
pub(crate) mod joint;
pub(crate) mod joint_model;
pub(crate) mod mirror;
pub(crate) mod offsets;
pub(crate) mod placement;
pub(crate) mod shape;

use wingbeat_math::{DVec3, to_digits};

use crate::error::DynamicsError;
use crate::system::body::{Body, NaturalUnits};
use crate::system::check::{check_finite, check_positive};
use crate::system::joint::{Joint, check_joint, check_numbers_of};
use crate::system::joint_model::{JointModel, JointType};
use crate::system::offsets::{JointOffsets, start};

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
    hinges: Vec<Joint>,
    gravity: DVec3,
    units: NaturalUnits,
    outward: Vec<usize>,
    offsets: Vec<JointOffsets>,
    behind: Vec<Vec<bool>>,
    loops: Vec<Joint>,
}

impl System {
    /// A system of `bodies` joined by `hinges` in the field `gravity` [m/s2, N components].
    ///
    /// # Errors
    /// Impossible mass properties, no mass at all, numbers that are not finite, hinges that do
    /// not join the bodies to a tree rooted at body 0.
    pub fn new(
        bodies: Vec<Body>,
        hinges: Vec<Joint>,
        gravity: DVec3,
        units: NaturalUnits,
    ) -> Result<Self, DynamicsError> {
        check_numbers(&bodies, gravity, units)?;
        let outward = outward_order(&bodies, &hinges)?;
        hinges.iter().try_for_each(check_carrying)?;
        let behind = bodies_behind(bodies.len(), &hinges, &outward);
        Ok(Self {
            offsets: offsets(&hinges),
            bodies,
            hinges,
            gravity,
            units,
            outward,
            behind,
            loops: vec![],
        })
    }

    /// The same system with `joint` at hinge `index`: what is free there beside the prescribed
    /// rotation, a prescribed travel, springs, dampers, stops, actuators.
    ///
    /// # Errors
    /// No such hinge; axes that are no unit vectors, numbers that are not finite, elements along
    /// directions that are not free; a joint that only closes loops.
    pub fn with_joint(mut self, index: usize, model: JointModel) -> Result<Self, DynamicsError> {
        let Some(hinge) = self.hinges.get_mut(index) else {
            return Err(DynamicsError::BadJoint {
                joint: format!("number {index}"),
                what: "hinge that does not exist: number".into(),
                value: index as f64,
            });
        };
        hinge.model = model;
        check_carrying(hinge)?;
        self.offsets = offsets(&self.hinges);
        Ok(self)
    }

    /// The same system with joints that close loops on top of the tree. Only the quaternion form
    /// flies it.
    ///
    /// # Errors
    /// Bodies that do not exist; impossible numbers of a joint.
    pub fn with_loops(self, loops: Vec<Joint>) -> Result<Self, DynamicsError> {
        (loops.iter()).try_for_each(|l| check_joint(l, self.bodies.len()))?;
        Ok(Self { loops, ..self })
    }

    /// The joints that close loops.
    pub fn loops(&self) -> &[Joint] {
        &self.loops
    }

    /// An error if there are loops, which `form` does not have.
    pub(crate) fn refuse_loops(&self, form: &'static str) -> Result<(), DynamicsError> {
        let first = self.loops.first();
        first.map_or(Ok(()), |l| {
            Err(DynamicsError::Loop {
                joint: l.name.clone(),
                form,
            })
        })
    }

    /// What the hinges leave free, in their order.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = &JointModel> {
        self.hinges.iter().map(|h| &h.model)
    }

    /// Where the free coordinates of the hinges lie.
    pub fn offsets(&self) -> &[JointOffsets] {
        &self.offsets
    }

    /// Number of free joint coordinates (four for a spherical joint).
    pub fn coordinates(&self) -> usize {
        self.offsets.last().map_or(0, |s| s.q + s.coordinates)
    }

    /// Number of free joint speeds.
    pub fn speeds(&self) -> usize {
        self.offsets.last().map_or(0, |s| s.u + s.speeds)
    }

    /// The first hinge whose motion is not all prescribed by its rotation law.
    pub fn first_free_hinge(&self) -> Option<&str> {
        let moves = |j: &JointModel| j.kind != JointType::Weld || j.travel.is_some();
        let found = self.hinges.iter().find(|h| moves(&h.model))?;
        Some(&found.name)
    }

    /// Which bodies hang behind hinge `index`.
    pub(crate) fn behind(&self, index: usize) -> &[bool] {
        &self.behind[index]
    }

    /// Start of the free coordinates and speeds.
    pub fn start(&self) -> (Vec<f64>, Vec<f64>) {
        let (mut q, mut u) = (vec![0.0; self.coordinates()], vec![0.0; self.speeds()]);
        for (joint, offsets) in self.joints().zip(&self.offsets) {
            start(joint, offsets, &mut q, &mut u);
        }
        (q, u)
    }

    /// What looks like a slip of units, as text; nothing here is an error.
    ///
    /// ```
    /// # use wingbeat_dynamics::{Body, NaturalUnits, System};
    /// # use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties};
    /// let mass = MassProperties::about_centre(1.0, DVec3::ZERO, DMat3::IDENTITY * 1e-7);
    /// let fly = Body { name: "fly".into(), mass, sequence: EulerSequence::BODY_231 };
    /// let units = NaturalUnits { length: 2.5e-3, time: 5e-3 };
    /// let system = System::new(vec![fly], vec![], DVec3::new(0.0, 0.0, 9.81), units).unwrap();
    /// assert!(system.warnings()[0].contains("1 kg"));
    /// ```
    pub fn warnings(&self) -> Vec<String> {
        let mut out = vec![];
        let (mass, length) = (self.total_mass(), self.units.length);
        let density = mass / length.powi(3);
        // Flying animals: 30 kg/m3 (a bee's mass over its wing length cubed) to 3000.
        if !(0.1..1e5).contains(&density) {
            out.push(format!(
                "total mass {} kg with wing length {} m: mass over length cubed is {density:.1e} kg/m3, flying animals have 1 to 10000; check the units of mass and length",
                to_digits(mass, 4),
                to_digits(length, 4)
            ));
        }
        let g = self.gravity.length();
        if g > 100.0 {
            out.push(format!(
                "gravity {g} m/s2 is more than ten times the Earth's; check its unit"
            ));
        }
        out
    }

    /// The bodies; 0 is the root.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The hinges, in the order in which reactions and multipliers are given.
    pub fn hinges(&self) -> &[Joint] {
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

fn check_numbers(
    bodies: &[Body],
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
    check_positive("natural unit of length [m]", units.length)?;
    check_positive("natural unit of time [s]", units.time)
}

/// An error if a joint cannot carry its child.
fn check_carrying(hinge: &Joint) -> Result<(), DynamicsError> {
    if let JointType::PointOnLine { .. } = hinge.model.kind {
        return Err(DynamicsError::BadJoint {
            joint: hinge.name.clone(),
            what: "the number of free directions of a point on a line, which closes loops and carries nothing (the first joint of a child by name carries it: name another one before it),".into(),
            value: 4.0,
        });
    }
    check_numbers_of(hinge)
}

/// Where the coordinates of the hinges lie.
fn offsets(hinges: &[Joint]) -> Vec<JointOffsets> {
    let next = |before: &mut JointOffsets, h: &Joint| {
        *before = JointOffsets::after(before, h.model.kind);
        Some(*before)
    };
    hinges.iter().scan(JointOffsets::default(), next).collect()
}

/// For every hinge, which bodies hang behind it.
fn bodies_behind(bodies: usize, hinges: &[Joint], outward: &[usize]) -> Vec<Vec<bool>> {
    let mut behind = vec![vec![false; bodies]; hinges.len()];
    for &k in outward {
        let (parent, child) = (hinges[k].tree_parent(), hinges[k].child);
        behind[k][child] = true;
        for other in &mut behind {
            if other[parent] {
                other[child] = true;
            }
        }
    }
    behind
}

/// Orders the hinges from the root outward.
fn outward_order(bodies: &[Body], hinges: &[Joint]) -> Result<Vec<usize>, DynamicsError> {
    if bodies.is_empty() {
        return Err(DynamicsError::NoBodies);
    }
    check_ends(bodies, hinges)?;
    let mut reached = vec![false; bodies.len()];
    reached[0] = true;
    let mut order = Vec::with_capacity(hinges.len());
    while let Some(k) = (0..hinges.len())
        .find(|&k| hinges[k].parent.is_some_and(|p| reached[p]) && !reached[hinges[k].child])
    {
        reached[hinges[k].child] = true;
        order.push(k);
    }
    check_tree(bodies, hinges, &reached)?;
    Ok(order)
}

fn check_ends(bodies: &[Body], hinges: &[Joint]) -> Result<(), DynamicsError> {
    for h in hinges {
        for index in h.parent.into_iter().chain([h.child]) {
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

fn check_tree(bodies: &[Body], hinges: &[Joint], reached: &[bool]) -> Result<(), DynamicsError> {
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
