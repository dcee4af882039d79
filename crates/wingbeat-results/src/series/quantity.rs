//! What a quantity behind columns of a history is: name, unit, frame, symbol, meaning, and its place
//! in a [`Record`].

use wingbeat_flight::Record;
use wingbeat_math::{larger, smaller};

/// What decides on frames and units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The whole flight.
    Flight,
    /// The central body.
    Body,
    /// A wing.
    Wing,
    /// A further segment.
    Segment,
    /// A coordinate that is an angle.
    Rotation,
    /// A coordinate that is a displacement.
    Displacement,
}

/// A number of a record.
pub(crate) enum Entry<'a> {
    /// A measured number.
    Real(&'a mut f64),
    /// A whole one.
    Count(&'a mut usize),
}

impl Entry<'_> {
    pub fn get(&self) -> f64 {
        match self {
            Self::Real(x) => **x,
            Self::Count(n) => **n as f64,
        }
    }

    pub fn set(self, value: f64) {
        match self {
            Self::Real(x) => *x = value,
            Self::Count(n) => *n = value as usize,
        }
    }
}

/// How a row of a thinned history stands for the steps since the row before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fold {
    /// It holds its own step.
    Last,
    /// The sum over these steps.
    Sum,
    /// The largest of these steps.
    Largest,
    /// The smallest of these steps.
    Smallest,
}

impl Fold {
    /// In words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Last => "",
            Self::Sum => "sum",
            Self::Largest => "largest",
            Self::Smallest => "smallest",
        }
    }

    /// The number for the steps so far and one more.
    pub(crate) fn join(self, so_far: f64, value: f64) -> f64 {
        match self {
            Self::Last => value,
            Self::Sum => so_far + value,
            Self::Largest => larger(so_far, value),
            Self::Smallest => smaller(so_far, value),
        }
    }
}

/// A unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    Second,
    Metre,
    Radian,
    MetrePerSecond,
    RadianPerSecond,
    MetrePerSecond2,
    RadianPerSecond2,
    Newton,
    NewtonMetre,
    NewtonSecond,
    Watt,
    Joule,
    Momentum,
    AngularMomentum,
    One,
    Wingbeat,
    Count,
    /// Radian or metre, as the subject is.
    Coordinate,
    /// Its rate.
    CoordinateRate,
}

impl Unit {
    /// The unit of this quantity of such a subject.
    pub fn of(self, kind: Kind) -> Self {
        match (self, kind) {
            (Self::Coordinate, Kind::Displacement) => Self::Metre,
            (Self::Coordinate, _) => Self::Radian,
            (Self::CoordinateRate, Kind::Displacement) => Self::MetrePerSecond,
            (Self::CoordinateRate, _) => Self::RadianPerSecond,
            (unit, _) => unit,
        }
    }

    /// As it ends a name, and as units are written.
    fn texts(self) -> [&'static str; 2] {
        match self {
            Self::Second => ["s", "s"],
            Self::Metre => ["m", "m"],
            Self::Radian | Self::Coordinate => ["rad", "rad"],
            Self::MetrePerSecond => ["m_per_s", "m s-1"],
            Self::RadianPerSecond | Self::CoordinateRate => ["rad_per_s", "rad s-1"],
            Self::MetrePerSecond2 => ["m_per_s2", "m s-2"],
            Self::RadianPerSecond2 => ["rad_per_s2", "rad s-2"],
            Self::Newton => ["newton", "N"],
            Self::NewtonMetre => ["newton_m", "N m"],
            Self::NewtonSecond => ["newton_s", "N s"],
            Self::Watt => ["watt", "W"],
            Self::Joule => ["joule", "J"],
            Self::Momentum => ["kg_m_per_s", "kg m s-1"],
            Self::AngularMomentum => ["kg_m2_per_s", "kg m2 s-1"],
            Self::One => ["dimensionless", "1"],
            Self::Wingbeat => ["wingbeats", "wingbeat"],
            Self::Count => ["count", "1"],
        }
    }

    /// As it ends the name of a column.
    pub fn suffix(self) -> &'static str {
        self.texts()[0]
    }

    /// As units are written.
    pub fn symbol(self) -> &'static str {
        self.texts()[1]
    }
}

/// Axes that components belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Frame {
    /// None.
    Scalar,
    /// The inertial frame.
    Inertial,
    /// The subject's own axes.
    Own,
    /// Euler angles of the subject against the inertial frame.
    Attitude,
    /// Angles of a wing against its stroke plane.
    Stroke,
    /// A quaternion from body to inertial axes.
    BodyToInertial,
    /// Axes of a joint's frame, which are those of the child at zero coordinates.
    Joint,
}

impl Frame {
    /// In words, of any subject.
    pub fn words_of_all(self) -> &'static str {
        match self {
            Self::Own => "own axes",
            Self::Attitude => "against N, body and segments Euler 2-3-1, wings Euler 1-3-2",
            other => other.words(Kind::Flight),
        }
    }

    /// In words.
    pub fn words(self, kind: Kind) -> &'static str {
        match (self, kind) {
            (Self::Scalar, _) => "none: scalar",
            (Self::Inertial, _) => "N: inertial, n3 along the default gravity",
            (Self::Own, Kind::Wing) => "W: wing, leading edge, span to the right, normal",
            (Self::Own, Kind::Segment) => {
                "S: segment, parallel to the body's in the posture of reference"
            }
            (Self::Own, _) => "B: body, forward, right, down",
            (Self::Attitude, Kind::Wing) => "wing against N, Euler 1-3-2",
            (Self::Attitude, _) => "body against N, Euler 2-3-1",
            (Self::Stroke, _) => "wing against the stroke plane, Euler 1-3-2",
            (Self::BodyToInertial, _) => "body to N",
            (Self::Joint, _) => "K: joint, along its free direction",
        }
    }
}

/// What the components of a quantity are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Components {
    /// There is one number.
    Scalar,
    /// Along the inertial axes, called x, y, z.
    Place,
    /// Euler angles.
    Angles,
    /// Along the inertial axes, called n1 to n3.
    Inertial,
    /// Along the subject's own axes: b1 to b3 of the body, w1 of a wing, s1 of a segment.
    Own,
    /// Along the own axes of what hangs at a hinge, called w1 to w3.
    Child,
    /// Of a quaternion.
    Quaternion,
}

impl Components {
    /// What stands for any component.
    pub fn placeholder(self) -> &'static str {
        match self {
            Self::Scalar => "",
            Self::Place => "x,y,z",
            Self::Angles => "phi,theta,psi",
            Self::Inertial => "n1,n2,n3",
            Self::Own => "b,w,s 1,2,3",
            Self::Child => "w1,w2,w3",
            Self::Quaternion => "w,x,y,z",
        }
    }

    pub fn names(self, kind: Kind) -> &'static [&'static str] {
        match (self, kind) {
            (Self::Scalar, _) => &[""],
            (Self::Place, _) => &["x", "y", "z"],
            (Self::Angles, _) => &["phi", "theta", "psi"],
            (Self::Inertial, _) => &["n1", "n2", "n3"],
            (Self::Own, Kind::Wing) | (Self::Child, _) => &["w1", "w2", "w3"],
            (Self::Own, Kind::Segment) => &["s1", "s2", "s3"],
            (Self::Own, _) => &["b1", "b2", "b3"],
            (Self::Quaternion, _) => &["w", "x", "y", "z"],
        }
    }
}

/// What has quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    /// The whole flight.
    Flight,
    /// The central body, the wings, the segments.
    Bodies,
    /// The wings.
    Wings,
    /// The wings, where any deforms.
    Deforming,
    /// The elastic wings.
    Elastic,
    /// The whole flight, where wings are elastic.
    Bending,
    /// The wings, where feedback commands them.
    Commanded,
    /// The whole flight, where there is feedback.
    Steered,
    /// The whole flight, where feedback follows a reference.
    Following,
    /// The whole flight, where feedback holds an attitude that is not that of the release.
    Holding,
    /// What hangs at a hinge: wings and segments.
    Children,
    /// Multipliers of connection.
    Connections,
    /// Multipliers of orientation.
    Orientations,
    /// Coordinates along the free directions of joints.
    Coordinates,
    /// The whole flight, where joints have free directions.
    Jointed,
    /// Joints that close loops.
    Loops,
}

/// A quantity of a record.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HistoryQuantity {
    /// Name of its columns without the unit: {s} is the subject, {c} the component.
    pub name: &'static str,
    pub unit: Unit,
    pub components: Components,
    pub frame: Frame,
    /// Symbol in NOTATION.md, if it has one.
    pub symbol: &'static str,
    /// What it is; {s} is the subject in words.
    pub about: &'static str,
    pub fold: Fold,
    /// Place in a record: of which subject, which component.
    pub entry: fn(&mut Record, usize, usize) -> Entry<'_>,
}

/// Quantities that stand together, subject after subject.
#[derive(Debug)]
pub(crate) struct Group {
    pub of: Of,
    pub quantities: &'static [HistoryQuantity],
}

impl HistoryQuantity {
    /// With components in a frame.
    pub const fn along(self, components: Components, frame: Frame) -> Self {
        Self {
            components,
            frame,
            ..self
        }
    }

    /// A scalar that belongs to axes all the same.
    pub const fn in_frame(self, frame: Frame) -> Self {
        Self { frame, ..self }
    }

    /// With a symbol of NOTATION.md.
    pub const fn symbol(self, symbol: &'static str) -> Self {
        Self { symbol, ..self }
    }

    /// That a row folds so.
    pub const fn fold(self, fold: Fold) -> Self {
        Self { fold, ..self }
    }
}

/// A number for each subject.
pub(crate) const fn scalar(
    name: &'static str,
    unit: Unit,
    about: &'static str,
    entry: fn(&mut Record, usize, usize) -> Entry<'_>,
) -> HistoryQuantity {
    HistoryQuantity {
        name,
        unit,
        components: Components::Scalar,
        frame: Frame::Scalar,
        symbol: "",
        about,
        fold: Fold::Last,
        entry,
    }
}

#[cfg(test)]
mod tests {
    use super::Fold;

    #[test]
    fn behaves_rows_of_a_thinned_history_keep_numbers_that_are_none() {
        for fold in [Fold::Sum, Fold::Largest, Fold::Smallest] {
            assert!(fold.join(f64::NAN, 1.0).is_nan() && fold.join(1.0, f64::NAN).is_nan());
        }
        assert_eq!(Fold::Largest.join(1.0, 2.0), 2.0);
        assert_eq!(Fold::Smallest.join(1.0, 2.0), 1.0);
    }
}
