//! Planes of symmetry and grounds by images: what is on one side has its mirror image on the
//! other, so no air goes through the plane.
//!
//! The image of the whole vortex system makes at x the reflection of what the system itself makes
//! at the reflected place: no image filament is ever formed, a sum is taken at the reflected
//! targets and its result reflected back.

use crate::error::AirError;
use wingbeat_math::{DMat3, DVec3, largest, outer};

/// What directions and places that are the same in exact arithmetic may differ by, relative to their size: far above
/// round-off, far below what anyone means.
pub(crate) const ROUNDING: f64 = 1e-9;

/// A plane through which no air goes: a plane of symmetry or a ground. All surfaces lie on one
/// side of it, or touch it; the undisturbed air must not cross it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// A point of it [m], N components.
    pub point: DVec3,
    /// Its normal, of any length, N components \[1\].
    pub normal: DVec3,
}

impl Plane {
    /// Distance of `x` [m], positive on the side of the normal [m].
    pub fn height(&self, x: DVec3) -> f64 {
        (x - self.point).dot(self.normal) / self.normal.length()
    }

    /// On which side of it these points lie, N components [m]: 1 on that of the normal, -1 on the other, as the
    /// one of them that is farthest from it \[1\].
    pub fn side(&self, points: &[DVec3]) -> f64 {
        let most = |sign: f64| largest(points.iter().map(|x| sign * self.height(*x)));
        if most(1.0) < most(-1.0) { -1.0 } else { 1.0 }
    }

    /// Whether this is the same plane as `other`, but for rounding.
    pub(crate) fn is(&self, other: &Self) -> bool {
        let [a, b] = [self.normal, other.normal].map(DVec3::normalize);
        let size = self.point.length().max(other.point.length());
        a.cross(b).length() <= ROUNDING && self.height(other.point).abs() <= ROUNDING * size
    }

    /// The foot of the perpendicular from `x` [m], N components.
    pub fn foot(&self, x: DVec3) -> DVec3 {
        x - self.height(x) * self.normal.normalize()
    }

    /// The part of a vector along the plane, N components.
    pub fn along(&self, v: DVec3) -> DVec3 {
        v.reject_from(self.normal)
    }
}

/// A reflection, or two of them after each other: `x -> turn x + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mirror {
    turn: DMat3,
    shift: DVec3,
}

impl Mirror {
    /// The mirror of a plane that has a direction and a place.
    pub(crate) fn of(plane: &Plane) -> Option<Self> {
        let usable = plane.point.is_finite() && plane.normal.try_normalize().is_some();
        usable.then(|| Self::new(plane))
    }

    fn new(plane: &Plane) -> Self {
        let n = plane.normal.normalize();
        Self {
            turn: DMat3::IDENTITY - outer(n) * 2.0,
            shift: 2.0 * plane.point.dot(n) * n,
        }
    }

    /// The image of a point.
    pub(crate) fn point(&self, x: DVec3) -> DVec3 {
        self.turn * x + self.shift
    }

    /// The image of a velocity. All turns here are symmetric, so this is also the way back.
    pub(crate) fn vector(&self, v: DVec3) -> DVec3 {
        self.turn * v
    }

    /// The image of a vorticity: one reflection turns it over, two do not.
    pub(crate) fn axial(&self, w: DVec3) -> DVec3 {
        self.turn.determinant() * (self.turn * w)
    }

    /// The image of a gradient of velocity [1/s].
    pub(crate) fn gradient(&self, g: DMat3) -> DMat3 {
        self.turn * g * self.turn
    }

    /// How far the origin is moved [m], N components.
    pub(crate) fn shift(&self) -> DVec3 {
        self.shift
    }
}

/// The images that one plane, or two at right angles, make.
///
/// # Errors
/// [`AirError::Setting`] for more planes, other angles, or a normal without direction.
pub(crate) fn mirrors(planes: &[Plane]) -> Result<Vec<Mirror>, AirError> {
    let wrong = |allowed| {
        Err(AirError::Setting {
            key: "images",
            value: format!("{planes:?}"),
            allowed,
        })
    };
    if planes.iter().any(|p| Mirror::of(p).is_none()) {
        return wrong("planes with a finite point and a normal that has a direction");
    }
    match planes {
        [] => Ok(Vec::new()),
        [one] => Ok(vec![Mirror::new(one)]),
        [one, two] => {
            let cosine = one.normal.normalize().dot(two.normal.normalize());
            if cosine.abs() > 1e-12 {
                return wrong("two planes at right angles: others have endless images");
            }
            let [one, two] = [one, two].map(Mirror::new);
            let both = Mirror {
                turn: one.turn * two.turn,
                shift: one.point(two.shift),
            };
            Ok(vec![one, two, both])
        }
        _ => wrong("at most two planes"),
    }
}
