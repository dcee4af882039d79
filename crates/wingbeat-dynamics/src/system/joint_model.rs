//! What a joint leaves free, and what acts along its free directions.
//!
//! A joint sits on a frame K of the parent: at the anchor on the parent, moved by a prescribed
//! travel and turned by a prescribed law (see [`crate::Joint::law`]). The child's frame L coincides
//! with K in axes, and the anchor on the child with K's origin, when all free coordinates are zero.

use std::sync::Arc;

use wingbeat_math::{DVec3, DriftingFourier};

/// A displacement prescribed as a function of time, twice continuously differentiable.
pub trait TravelLaw: Send + Sync + std::fmt::Debug {
    /// Displacement \[m\], velocity [m/s] and acceleration [m/s2] at time `t` \[s\], components of
    /// the parent.
    fn at(&self, t: f64) -> [DVec3; 3];
}

/// Relative motion that a joint allows beside what it prescribes. Axes are unit vectors in the
/// joint's frame K, which are those of the child at zero coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointType {
    /// None: welded to the moving frame K.
    Weld,
    /// Rotation about one axis.
    Revolute {
        /// The axis.
        axis: DVec3,
    },
    /// Rotation about the first axis, fixed in K, then about the second, fixed in the child.
    Universal {
        /// Two perpendicular axes.
        axes: [DVec3; 2],
    },
    /// Any rotation.
    Spherical,
    /// Displacement along one axis.
    Prismatic {
        /// The axis.
        axis: DVec3,
    },
    /// Any rotation, and displacement along one axis: the child's anchor stays on a line of K.
    /// Closes planar loops without asking twice for what their other joints hold already.
    PointOnLine {
        /// The line's direction.
        axis: DVec3,
    },
}

impl JointType {
    /// The axes named by the joint.
    pub fn axes(&self) -> &[DVec3] {
        match self {
            Self::Weld | Self::Spherical => &[],
            Self::Revolute { axis } | Self::Prismatic { axis } | Self::PointOnLine { axis } => {
                std::slice::from_ref(axis)
            }
            Self::Universal { axes } => axes,
        }
    }

    /// Number of free directions that elements can act along: a point on a line has its three rotations.
    pub fn directions(&self) -> usize {
        match self {
            Self::Weld => 0,
            Self::Revolute { .. } | Self::Prismatic { .. } => 1,
            Self::Universal { .. } => 2,
            Self::Spherical | Self::PointOnLine { .. } => 3,
        }
    }
}

/// What acts along a free direction. An effort is a moment [N m] for rotations and a force \[N\]
/// for displacements, positive where it increases the coordinate; coordinates in rad or m.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementLaw {
    /// `-stiffness (q - rest)`.
    Spring {
        /// Stiffness [N m/rad or N/m].
        stiffness: f64,
        /// Coordinate without effort [rad or m].
        rest: f64,
    },
    /// `-coefficient u`.
    Damper {
        /// Coefficient [N m s or N s/m].
        coefficient: f64,
    },
    /// Outside [lower, upper], pushes back with `stiffness d (1 + damping d')`, d the depth; never
    /// pulls [Hunt & Crossley 1975].
    Stop {
        /// Lower end of the free range [rad or m].
        lower: f64,
        /// Upper end of the free range [rad or m].
        upper: f64,
        /// Stiffness [N m/rad or N/m].
        stiffness: f64,
        /// Damping per depth rate [s/rad or s/m]; 0 gives all energy back.
        damping: f64,
    },
    /// An actuator's effort as a function of time.
    Effort(DriftingFourier),
    /// Proportional-derivative actuator towards a motion.
    Follow {
        /// The coordinate aimed at [rad or m].
        target: DriftingFourier,
        /// Gain on the coordinate [N m/rad or N/m].
        stiffness: f64,
        /// Gain on the rate [N m s or N s/m].
        damping: f64,
    },
}

impl ElementLaw {
    /// Effort at time `t` \[s\] for coordinate `q` and rate `u`.
    pub fn effort(&self, t: f64, q: f64, u: f64) -> f64 {
        match self {
            Self::Spring { stiffness, rest } => -stiffness * (q - rest),
            Self::Damper { coefficient } => -coefficient * u,
            Self::Stop {
                lower,
                upper,
                stiffness,
                damping,
            } => {
                let push = |depth: f64, rate: f64| {
                    stiffness * depth.max(0.0) * (1.0 + damping * rate).max(0.0)
                };
                push(lower - q, -u) - push(q - upper, u)
            }
            Self::Effort(f) => f.at(t)[0],
            Self::Follow {
                target,
                stiffness,
                damping,
            } => {
                let [aim, rate, _] = target.at(t);
                stiffness * (aim - q) + damping * (rate - u)
            }
        }
    }

    /// Energy stored at coordinate `q` \[J\]: springs and stops.
    pub fn stored(&self, q: f64) -> f64 {
        match self {
            Self::Spring { stiffness, rest } => 0.5 * stiffness * (q - rest).powi(2),
            Self::Stop {
                lower,
                upper,
                stiffness,
                ..
            } => 0.5 * stiffness * (lower - q).max(q - upper).max(0.0).powi(2),
            _ => 0.0,
        }
    }

    /// Whether it stores energy: springs and stops.
    pub(crate) fn stores(&self) -> bool {
        matches!(self, Self::Spring { .. } | Self::Stop { .. })
    }

    /// The function of time that drives an actuator, whose power comes from outside; none: passive.
    pub fn drive(&self) -> Option<&DriftingFourier> {
        match self {
            Self::Effort(series) | Self::Follow { target: series, .. } => Some(series),
            _ => None,
        }
    }

    /// A range of a stop whose upper end is below its lower one.
    fn reversed_range(&self) -> Option<(String, f64)> {
        match self {
            Self::Stop { lower, upper, .. } if lower > upper => Some((
                format!("upper end of a stop (it must not be below the lower end {lower})"),
                *upper,
            )),
            _ => None,
        }
    }

    /// The numbers of the law with their names.
    fn numbers(&self) -> Vec<(&'static str, f64)> {
        let series = |f: &DriftingFourier| {
            let harmonics = f.cosine.iter().chain(&f.sine).sum::<f64>();
            vec![
                ("frequency [Hz]", f.frequency),
                ("mean", f.constant),
                ("rate [1/s]", f.rate),
                ("sum of harmonics", harmonics),
            ]
        };
        match self {
            Self::Spring { stiffness, rest } => vec![("stiffness", *stiffness), ("rest", *rest)],
            Self::Damper { coefficient } => vec![("coefficient", *coefficient)],
            Self::Stop {
                lower,
                upper,
                stiffness,
                damping,
            } => vec![
                ("lower end", *lower),
                ("upper end", *upper),
                ("stiffness", *stiffness),
                ("damping", *damping),
            ],
            Self::Effort(f) => series(f),
            Self::Follow {
                target,
                stiffness,
                damping,
            } => {
                let mut n = series(target);
                n.extend([("stiffness", *stiffness), ("damping", *damping)]);
                n
            }
        }
    }
}

/// A law along one free direction of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Index of the direction: 0 for one axis; 0 or 1 for a universal joint; 0, 1, 2 for the
    /// components of the rotation vector of a spherical one, and for its dampers and given moments the axes of the
    /// child.
    pub direction: usize,
    /// What acts.
    pub law: ElementLaw,
}

/// What a joint allows beside its prescription, what acts on it, and where it starts.
#[derive(Clone, Debug)]
pub struct JointModel {
    /// The free relative motion.
    pub kind: JointType,
    /// Prescribed displacement of the joint's frame along the parent; none if it is fixed there.
    pub travel: Option<Arc<dyn TravelLaw>>,
    /// Springs, dampers, stops, actuators.
    pub elements: Vec<Element>,
    /// Coordinates at the start [rad or m], rotation vector for a spherical joint; missing ones
    /// are zero.
    pub coordinates: Vec<f64>,
    /// Their rates at the start [rad/s or m/s]; missing ones are zero.
    pub rates: Vec<f64>,
}

impl JointModel {
    /// Damping \[N m s or N s/m\] and stiffness \[N m/rad or N/m\] along free direction `k`, of all elements but stops.
    pub fn damping_and_stiffness(&self, k: usize) -> [f64; 2] {
        let along = self.elements.iter().filter(|e| e.direction == k);
        let of = |law: &ElementLaw| match *law {
            ElementLaw::Spring { stiffness, .. } => [0.0, stiffness],
            ElementLaw::Damper { coefficient } => [coefficient, 0.0],
            ElementLaw::Follow {
                stiffness, damping, ..
            } => [damping, stiffness],
            ElementLaw::Stop { .. } | ElementLaw::Effort(_) => [0.0; 2],
        };
        along.fold([0.0; 2], |sum, e| {
            let [c, k] = of(&e.law);
            [sum[0] + c, sum[1] + k]
        })
    }

    /// A joint of this `kind`, nothing acting on it, at rest at zero coordinates.
    pub fn new(kind: JointType) -> Self {
        Self {
            kind,
            travel: None,
            elements: vec![],
            coordinates: vec![],
            rates: vec![],
        }
    }

    /// The same with a law along free direction `direction`.
    pub fn with(mut self, direction: usize, law: ElementLaw) -> Self {
        self.elements.push(Element { direction, law });
        self
    }

    /// The same with a start.
    pub fn starting(self, coordinates: &[f64], rates: &[f64]) -> Self {
        Self {
            coordinates: coordinates.to_vec(),
            rates: rates.to_vec(),
            ..self
        }
    }

    /// The first thing wrong with the joint's numbers: what it is and its value.
    pub(crate) fn fault(&self) -> Option<(String, f64)> {
        let unit = |a: &&DVec3| (a.length() - 1.0).abs() > 1e-9;
        if let Some(a) = self.kind.axes().iter().find(unit) {
            return Some((
                "length of an axis (a unit vector is needed)".into(),
                a.length(),
            ));
        }
        if let JointType::Universal { axes: [a, b] } = self.kind
            && a.dot(b).abs() > 1e-9
        {
            return Some((
                "cosine between the two axes (they must be perpendicular)".into(),
                a.dot(b),
            ));
        }
        for e in &self.elements {
            if e.direction >= self.kind.directions() {
                return Some(("free direction of an element".into(), e.direction as f64));
            }
            if let Some((name, x)) = e.law.numbers().into_iter().find(|(_, x)| !x.is_finite()) {
                return Some((format!("{name} of an element"), x));
            }
            if let Some(fault) = e.law.reversed_range() {
                return Some(fault);
            }
        }
        let start = self.coordinates.iter().chain(&self.rates);
        let bad = start.copied().find(|x| !x.is_finite());
        bad.map(|x| ("start of a coordinate".into(), x))
    }
}
