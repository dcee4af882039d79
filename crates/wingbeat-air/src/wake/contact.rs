//! Wakes that meet surfaces: free nodes do not pass through wings nor into bodies.
//!
//! An inviscid sheet would slide along a surface it meets. A discrete one, moved by finite steps,
//! can jump through: then a filament lies inside a body or on the wrong side of a wing, and the
//! loads blow up. So a node whose path crosses a wing panel, or ends nearer to a surface than the
//! clearance, ends at the clearance from it, on the side it came from; only the part of its
//! displacement normal to the surface is changed. Every such event is counted.
//!
//! The surfaces at the end of the step are not known yet (the wake is moved before the bodies):
//! they are extrapolated with the velocities of the accepted step, an error of half the
//! acceleration times the step squared, which the clearance must exceed.

use crate::lattice::Lattice;
use crate::state::AirState;
use rayon::prelude::*;
use wingbeat_math::DVec3;

/// A panel at the start and at the end of the step.
struct Panel {
    corners: [[DVec3; 4]; 2],
    centre: [DVec3; 2],
    normal: [DVec3; 2],
}

/// One surface with a sphere that holds it at the start and at the end of the step.
#[derive(Default)]
struct Obstacle {
    closed: bool,
    panels: Vec<Panel>,
    centre: DVec3,
    radius: f64,
}

/// All surfaces in the way of the wakes during one step.
#[derive(Default)]
pub(crate) struct Obstacles {
    surfaces: Vec<Obstacle>,
    clearance: f64,
}

impl Obstacles {
    /// Takes the surfaces of `state`, moving on for `dt` [s]; none if the clearance is zero.
    pub(crate) fn take(&mut self, lattice: &Lattice, state: &AirState, dt: f64) {
        self.clearance = lattice.settings().clearance;
        let count = if self.clearance > 0.0 {
            lattice.surfaces().len()
        } else {
            0
        };
        let ends = |n: usize| {
            [
                state.position[n],
                state.position[n] + dt * state.velocity[n],
            ]
        };
        self.surfaces.resize_with(count, Obstacle::default);
        for (s, obstacle) in self.surfaces.iter_mut().enumerate() {
            let own = lattice.panels_of(s);
            let panels = own.map(|p| panel(lattice.topology().panels[p].map(ends)));
            obstacle.panels.clear();
            obstacle.panels.extend(panels);
            let nodes = || lattice.nodes_of(s).flat_map(ends);
            obstacle.closed = lattice.surfaces()[s].closed;
            obstacle.centre = nodes().sum::<DVec3>() / nodes().count() as f64;
            obstacle.radius = nodes().fold(0.0_f64, |r, x| r.max(x.distance(obstacle.centre)));
        }
    }

    /// Mends the ends of the paths `from` -> `to` of all nodes; returns how many were changed.
    /// Nodes are independent: the result does not depend on the number of threads.
    pub(crate) fn keep_off(&self, from: &[DVec3], to: &mut [DVec3]) -> u64 {
        if self.surfaces.is_empty() {
            return 0;
        }
        to.par_iter_mut()
            .zip(from)
            .map(|(to, &from)| u64::from(self.keep_one_off(from, to)))
            .sum()
    }

    fn keep_one_off(&self, from: DVec3, to: &mut DVec3) -> bool {
        let mut changed = false;
        for s in &self.surfaces {
            let reach = s.radius + self.clearance;
            if distance_to_segment(s.centre, from, *to) > reach {
                continue;
            }
            changed |= if s.closed {
                s.push_out(to, self.clearance)
            } else {
                s.hold_back(from, to, self.clearance)
            };
        }
        changed
    }
}

impl Obstacle {
    /// A convex body: out to the clearance from the plane of the nearest panel.
    fn push_out(&self, to: &mut DVec3, clearance: f64) -> bool {
        let distance = |p: &&Panel| p.centre[1].distance_squared(*to);
        let nearest = self
            .panels
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let Some(panel) = nearest else {
            return false;
        };
        let lack = clearance - (*to - panel.centre[1]).dot(panel.normal[1]);
        if lack > 0.0 {
            *to += lack * panel.normal[1];
        }
        lack > 0.0
    }

    /// A thin surface: a node that crosses a panel or ends too near goes back to its own side.
    fn hold_back(&self, from: DVec3, to: &mut DVec3, clearance: f64) -> bool {
        let mut changed = false;
        for panel in &self.panels {
            let start = (from - panel.centre[0]).dot(panel.normal[0]);
            let end = (*to - panel.centre[1]).dot(panel.normal[1]);
            // A node just shed lies in the surface: its side is the one it goes to.
            let in_surface = start.abs() < 1e-6 * clearance;
            let side = if in_surface {
                end.signum()
            } else {
                start.signum()
            };
            let lack = clearance - side * end;
            if lack <= 0.0 || !panel.is_under(from, *to, start, end) {
                continue;
            }
            *to += side * lack * panel.normal[1];
            changed = true;
        }
        changed
    }
}

impl Panel {
    /// Whether the path meets the panel: where it crosses the panel's plane, or else at its end.
    fn is_under(&self, from: DVec3, to: DVec3, start: f64, end: f64) -> bool {
        let crosses = start * end < 0.0;
        let s = if crosses { start / (start - end) } else { 1.0 };
        let at = |i: usize| self.corners[0][i].lerp(self.corners[1][i], s);
        let (x, normal) = (from.lerp(to, s), self.normal[0].lerp(self.normal[1], s));
        (0..4).all(|k| {
            let (a, b) = (at(k), at((k + 1) % 4));
            (b - a).cross(x - a).dot(normal) >= 0.0
        })
    }
}

fn panel(ends: [[DVec3; 2]; 4]) -> Panel {
    let corners = [0, 1].map(|e| ends.map(|c| c[e]));
    Panel {
        centre: corners.map(|c| 0.25 * ((c[0] + c[1]) + (c[2] + c[3]))),
        normal: corners.map(|c| (c[2] - c[0]).cross(c[3] - c[1]).normalize_or_zero()),
        corners,
    }
}

fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let ab = b - a;
    let length2 = ab.length_squared();
    let s = if length2 > 0.0 {
        ((p - a).dot(ab) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    p.distance(a + s * ab)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit square in the plane z = 0 that rises with speed `w` during a step of one second.
    fn square(w: f64, closed: bool) -> Obstacles {
        let corner = |x, y| [DVec3::new(x, y, 0.0), DVec3::new(x, y, w)];
        let ends = [
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ];
        let surface = Obstacle {
            closed,
            panels: vec![panel(ends)],
            centre: DVec3::splat(0.5),
            radius: 2.0,
        };
        Obstacles {
            surfaces: vec![surface],
            clearance: 0.1,
        }
    }

    fn end(o: &Obstacles, from: [f64; 3], to: [f64; 3]) -> DVec3 {
        let mut to = [DVec3::from(to)];
        o.keep_off(&[DVec3::from(from)], &mut to);
        to[0]
    }

    #[test]
    fn exact_node_that_would_cross_a_wing_stays_on_its_side() {
        let o = square(0.0, false);
        let stopped = end(&o, [0.5, 0.5, 0.3], [0.6, 0.5, -0.4]);
        assert!((stopped - DVec3::new(0.6, 0.5, 0.1)).length() < 1e-15);
        let beside = end(&o, [1.5, 0.5, 0.3], [1.6, 0.5, -0.4]);
        assert_eq!(beside, DVec3::new(1.6, 0.5, -0.4), "passes beside the wing");
        // The path crosses the plane over the panel though it ends beyond the edge.
        assert!(end(&o, [0.9, 0.5, 0.05], [1.3, 0.5, -0.4]).z > 0.0);
    }

    #[test]
    fn exact_wing_that_overtakes_a_resting_node_takes_it_along() {
        let o = square(0.5, false);
        let swept = end(&o, [0.5, 0.5, 0.2], [0.5, 0.5, 0.2]);
        assert!((swept - DVec3::new(0.5, 0.5, 0.6)).length() < 1e-15);
    }

    #[test]
    fn exact_node_inside_a_body_comes_out_to_the_clearance() {
        let o = square(0.0, true);
        assert!((end(&o, [0.5, 0.5, 0.3], [0.5, 0.4, -0.2]).z - 0.1).abs() < 1e-15);
    }
}
