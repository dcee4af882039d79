//! How deep wings reach through each other.

use super::{Shared, between_middles, instants, joined, overlap, pass_through};
use crate::animal::Animal;
use crate::contact::sheet::Sheet;
use wingbeat_math::DVec3;

/// How exactly the way by which a wing is moved is found, over that by which it is surely apart \[1\].
const PART: f64 = 1e-9;

/// How deep the two of a crossing reach through each other at most \[m\], at the instants of [`super::crossings`]: the
/// larger of two lengths.
///
/// Of each line of nodes that passes through the other wing, the part that lies less far behind that wing's plane
/// there; and how far one of them must be moved along the line between the middles of both to be apart, for wings
/// that lie nearly in one plane overlap far though neither is far behind the other.
pub fn crossing_depth(animal: &Animal, wings: [usize; 2], is_joined: bool) -> f64 {
    let wings = wings.map(|w| &animal.wings[w]);
    let sheets = wings.map(Sheet::new);
    let shared = is_joined.then(|| Shared::roots(wings.map(|w| &w.mesh)));
    let deeper = |deepest: f64, t: f64| {
        let nodes = [0, 1].map(|w| sheets[w].at(t));
        deeper(
            sheets.each_ref(),
            joined(sheets.each_ref(), nodes, shared),
            deepest,
        )
    };
    instants(wings).fold(0.0, deeper)
}

/// How deep two sheets with these nodes reach through each other \[m\]; `least` if that is no more.
pub(super) fn deeper([one, other]: [&Sheet; 2], [a, b]: [Vec<DVec3>; 2], least: f64) -> f64 {
    let across = one.depth(&a, other, &b).max(other.depth(&b, one, &a));
    way_apart([one, other], [&a, &b], least.max(across))
}

/// How far the second of two sheets must be moved away from the first along the line between their middles until they
/// no longer pass through each other \[m\]; `least` if that is no more.
fn way_apart(sheets: [&Sheet; 2], [a, b]: [&[DVec3]; 2], least: f64) -> f64 {
    let Some(way) = between_middles(a, b).try_normalize() else {
        return least;
    };
    let meet = |s: f64| {
        let moved: Vec<DVec3> = b.iter().map(|x| x + s * way).collect();
        pass_through(sheets, [a, &moved])
    };
    let (mut near, mut far) = (least, overlap(a, b, way));
    if far <= near || !meet(0.0) || !meet(near) {
        return least;
    }
    let exact = PART * far;
    while far - near > exact {
        let s = 0.5 * (near + far);
        *(if meet(s) { &mut near } else { &mut far }) = s;
    }
    far
}

impl Sheet {
    /// How deep this sheet reaches through the other \[m\].
    fn depth(&self, a: &[DVec3], other: &Self, b: &[DVec3]) -> f64 {
        let behind = |([m, n], [x, y, z], _): ([usize; 2], [DVec3; 3], DVec3)| {
            let normal = (y - x).cross(z - x).normalize();
            let (row, column) = (m / self.columns, m % self.columns);
            let whole: Vec<usize> = match self.is_along([m, n]) {
                true => (0..self.columns).map(|j| row * self.columns + j).collect(),
                false => (0..self.rows).map(|i| i * self.columns + column).collect(),
            };
            let farthest = |part: &mut dyn Iterator<Item = &usize>| {
                part.map(|&k| (a[k] - x).dot(normal).abs())
                    .fold(0.0, f64::max)
            };
            let before = farthest(&mut whole.iter().filter(|k| **k <= m));
            let after = farthest(&mut whole.iter().filter(|k| **k >= n));
            f64::min(before, after)
        };
        self.piercing(a, other, b).map(behind).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::WingMotion;
    use crate::{MassInput, Planform, Side, Wing, WingShape};

    /// A rectangle of length 1 and chord 0.5 beside the root at `hinge` \[m\], held at these angles phi, theta, psi [deg].
    fn wing(hinge: [f64; 3], angles: [f64; 3]) -> Wing {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (1.0, 0.2)],
            trailing: vec![(0.0, -0.3), (1.0, -0.3)],
            least_chord: 0.1,
        };
        let shape = WingShape::uniform(planform, 3, 30);
        let motion = WingMotion::fixed(0.0, angles.map(f64::to_radians));
        let (hinge, mass) = (DVec3::from(hinge), MassInput::Total(0.1));
        Wing::new("wing", Side::Right, hinge, &shape, &mass, motion).unwrap()
    }

    /// How deep the wing and its mirror image reach through each other \[m\].
    fn depth(right: Wing) -> f64 {
        let left = right.mirrored("left");
        let animal = Animal {
            name: "crossing".into(),
            body: right.mass,
            parts: vec![],
            wings: vec![right, left],
            segments: vec![],
        };
        crossing_depth(&animal, [0, 1], false)
    }

    /// Two rectangles that lie nearly in one plane and overlap by 0.22 beside their roots: behind each other they are
    /// by the sine of the small angle between them, and by 0.22 they must be moved to be apart.
    #[test]
    fn exact_overlap_of_wings_that_lie_nearly_in_one_plane() {
        for angle in [0.1f64, 1.0, 5.0] {
            let found = depth(wing([0.0, -0.11, 0.0], [angle, 0.0, 0.0]));
            // What is a touch, 4e-6, over the slope of one wing to the other.
            let touch = 1e-5 / angle.to_radians().sin();
            assert!((found - 0.22).abs() < touch, "{angle}: {found}");
        }
    }

    /// Swept by 20 degrees about the line of their hinges, they overlap by what lies beyond the plane of symmetry on
    /// both sides: twice the part of the chord on that side of the hinge times the sine.
    #[test]
    fn exact_overlap_of_swept_wings() {
        for (sweep, behind) in [(20f64, 0.3), (-20.0, 0.2)] {
            let found = depth(wing([0.0; 3], [1.0, sweep, 0.0]));
            let beyond = 2.0 * behind * sweep.to_radians().sin().abs() * 1f64.to_radians().cos();
            assert!((found - beyond).abs() < 1e-3, "{sweep}: {found} {beyond}");
        }
    }

    /// Wings that clap beyond the plane of symmetry: their tips are that much past it, each on its side, and a tip is
    /// less far behind the plane of the other.
    #[test]
    fn exact_depth_of_wings_that_clap_past_each_other() {
        for past in [1e-3, 0.01, 0.05] {
            let hinge = 10f64.to_radians().sin() - past;
            let found = depth(wing([0.0, hinge, 0.0], [100.0, 0.0, 0.0]));
            assert!((found - 2.0 * past).abs() < 1e-5, "{past}: {found}"); // what is a touch
        }
    }

    /// A wing across another at right angles reaches through it by the shorter of what is on either side.
    #[test]
    fn exact_depth_of_a_wing_across_another() {
        let upright = wing([0.0; 3], [90.0, 0.0, 0.0]);
        let level = wing([0.0, -0.51, 0.52], [0.0; 3]);
        let [a, b] = [&upright, &level].map(|w| (Sheet::new(w), Sheet::new(w).at(0.0)));
        let found = a.0.depth(&a.1, &b.0, &b.1);
        assert!((found - 0.48).abs() < 1e-12, "{found}"); // roundings
    }
}
