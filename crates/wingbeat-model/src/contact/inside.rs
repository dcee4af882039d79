//! Wings inside parts of the body: no animal's are, and a vortex lattice that has both as surfaces says nothing
//! of the air there, nor of the forces on either.

use std::f64::consts::PI;

use crate::animal::Animal;
use crate::contact::crossing::INSTANTS;
use crate::contact::sheet::{Sheet, pierces};
use crate::mesh::QuadMesh;
use wingbeat_math::DVec3;

/// What is no more than a touch, over the size of the part: hinges lie on surfaces, and panels beside them.
const SKIN: f64 = 0.03;

/// A wing that is inside a part of the central body in its prescribed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Inside {
    /// The wing, among those of the animal.
    pub wing: usize,
    /// The part, among those of the central body.
    pub part: usize,
    /// Part of the beat in which it is \[1\].
    pub time: f64,
}

/// Which of `wings` of the animal are inside parts of the central body once their motion has started: at 100
/// instants of a beat, deformed as prescribed, on at most 8 x 16 panels, deeper than 3 % of the way from the middle of
/// the part to its surface.
pub fn inside(animal: &Animal, wings: &[usize]) -> Vec<Inside> {
    let solids: Vec<Solid> = animal.parts.iter().map(|p| Solid::new(&p.mesh)).collect();
    let of_wing = |&wing: &usize| {
        let sheet = Sheet::new(&animal.wings[wing]);
        let frequency = animal.wings[wing].motion.frequency;
        let times = |solid: &Solid| solid.time_of(&sheet, frequency);
        let times: Vec<f64> = solids.iter().map(times).collect();
        let found = times.into_iter().enumerate().filter(|(_, t)| *t > 0.0);
        found.map(move |(part, time)| Inside { wing, part, time })
    };
    wings.iter().flat_map(of_wing).collect()
}

/// What a closed surface of triangles encloses, all places in the same components \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    triangles: Vec<[DVec3; 3]>,
    /// Corners of the box around it.
    bounds: [DVec3; 2],
}

impl Solid {
    /// Of a closed surface.
    pub fn new(surface: &QuadMesh) -> Self {
        Self {
            triangles: surface.triangles(),
            bounds: surface.bounds(),
        }
    }

    /// Whether a place [m] is inside.
    pub fn contains(&self, x: DVec3) -> bool {
        let [low, high] = self.bounds;
        x.cmpge(low).all() && x.cmple(high).all() && self.winds_about(x)
    }

    /// Part of a beat in which the sheet is inside \[1\].
    fn time_of(&self, sheet: &Sheet, frequency: f64) -> f64 {
        let (instants, beat) = match frequency > 0.0 {
            true => (INSTANTS, 1.0 / frequency),
            false => (1, 0.0),
        };
        let at = |k: usize| sheet.at(beat * k as f64 / INSTANTS as f64);
        let met = (0..instants).filter(|&k| self.holds(sheet, at(k)));
        met.count() as f64 / instants as f64
    }

    /// Whether a node of the sheet is inside, or a line between two passes through the surface, the sheet drawn
    /// away from the middle by the skin that does not count.
    fn holds(&self, sheet: &Sheet, mut nodes: Vec<DVec3>) -> bool {
        let [low, high] = self.bounds;
        let middle = 0.5 * (low + high);
        let away = |x: &mut DVec3| *x = middle + (*x - middle) / (1.0 - SKIN);
        nodes.iter_mut().for_each(away);
        let near = |x: DVec3, y: DVec3| x.min(y).cmple(high).all() && x.max(y).cmpge(low).all();
        if nodes.iter().any(|x| near(*x, *x) && self.winds_about(*x)) {
            return true;
        }
        let lines = sheet.lines().map(|l| l.map(|n| nodes[n]));
        let mut lines = lines.filter(|[x, y]| near(*x, *y));
        lines.any(|line| self.triangles.iter().any(|t| pierces(line, *t, 0.0)))
    }

    /// Whether the surface is seen all around: the solid angle is 4 pi inside and 0 outside
    /// [van Oosterom and Strackee 1983, eq. 8].
    fn winds_about(&self, x: DVec3) -> bool {
        let half_angle = |t: &[DVec3; 3]| {
            let [a, b, c] = t.map(|p| p - x);
            let [p, q, r] = [a, b, c].map(DVec3::length);
            let over = p * q * r + a.dot(b) * r + b.dot(c) * p + c.dot(a) * q;
            a.dot(b.cross(c)).atan2(over)
        };
        self.triangles.iter().map(half_angle).sum::<f64>().abs() > PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::animal::BodyPart;
    use crate::motion::{AngleLaw, Fourier};
    use crate::{MassInput, Planform, Revolution, Side, Wing, WingMotion, WingShape};
    use wingbeat_math::MassProperties;

    /// A spheroid of length 2 and diameter 1 and wings of length 3 and chord 0.4 that flap about the axis of
    /// their chord, hinged at this place beside its middle.
    fn animal(hinge: DVec3, amplitude: f64) -> Animal {
        let planform = Planform::Outline {
            leading: vec![(0.0, 0.2), (3.0, 0.2)],
            trailing: vec![(0.0, -0.2), (3.0, -0.2)],
            least_chord: 0.1,
        };
        let mut motion = WingMotion::fixed(0.0, [0.0; 3]);
        let (mean, cos, sin) = (0.0, vec![], vec![amplitude]);
        motion.angles.phi = AngleLaw::Fourier(Fourier { mean, cos, sin });
        motion.frequency = 3.0;
        let shape = WingShape::uniform(planform, 3, 6);
        let mass = MassInput::Total(0.1);
        let right = Wing::new("right", Side::Right, hinge, &shape, &mass, motion).unwrap();
        let trunk = Revolution::ellipsoid(DVec3::ZERO, 2.0, 0.5, [16, 48]);
        let mass = MassInput::Given(MassProperties::point(0.1, DVec3::ZERO));
        let part = BodyPart::revolution("trunk", &trunk, &mass).unwrap();
        Animal {
            name: "inside".into(),
            body: right.mass,
            parts: vec![part],
            wings: vec![right.mirrored("left"), right],
            segments: vec![],
        }
    }
    /// Half a span above the axis the wings reach the body where 0.8 cos(phi) falls below its radius less the
    /// skin: 53 of 80 deg.
    #[test]
    fn exact_time_for_which_a_wing_is_inside() {
        let amplitude = 80f64.to_radians();
        let found = inside(&animal(DVec3::new(0.0, 0.0, -0.8), amplitude), &[0, 1]);
        let meets = (0.5 * (1.0 - SKIN) / 0.8).acos();
        let time = 0.5 - (meets / amplitude).asin() / PI;
        assert_eq!(found.len(), 2, "{found:?}");
        for (wing, one) in found.iter().enumerate() {
            assert_eq!([one.wing, one.part], [wing, 0]);
            // Instants are a hundredth apart, and there are two ends.
            assert!((one.time - time).abs() < 0.02, "{} {time}", one.time);
        }
    }

    #[test]
    fn behaves_wings_that_touch_a_part_from_outside_are_not_inside() {
        let flap = 50f64.to_radians();
        for (aside, expected) in [(0.0, 1.0), (0.4, 1.0), (0.49, 0.0), (0.5, 0.0), (0.6, 0.0)] {
            let found = inside(&animal(DVec3::new(0.0, aside, 0.0), flap), &[1]);
            let time = found.first().map_or(0.0, |one| one.time);
            assert_eq!(time, expected, "hinge {aside} from the axis");
        }
        let still = animal(DVec3::ZERO, 0.0);
        assert_eq!(inside(&still, &[0, 1]).len(), 2);
        assert_eq!(inside(&still, &[]), []);
    }
}
