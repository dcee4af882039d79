//! The section behind a segment of a leading edge, and what its two foremost vortices tell of its suction.
//!
//! The suction parameter A0 is the coefficient of the suction singularity in thin-airfoil theory, `A0 = 1 / (pi
//! U) integral w dtheta` along the chord, `cos theta = 1 - 2 x / c`, w the normal velocity of air against wing
//! that the wing's own vorticity has to annul [Ramesh et al. 2014, J. Fluid Mech. 751:500].
//!
//! A lattice of a section in plane flow, vortices v at a quarter and control points c at three quarters along
//! panels of any lengths, is solved by partial fractions: if w is even it has the circulations `G_j = 2 pi w
//! P_j`, `P_j = prod_i |c_i - v_j| / prod_(k != j) |v_k - v_j|` [James 1972, Comput. Methods Appl. Mech. Eng.
//! 1:59], and if w is linear, `U A0 + b (x - c / 2)`, it has `G_j = 2 pi P_j (U A0 + b v_j)`. So `G_j / (2 pi U
//! P_j)` is linear in the place of the vortices and A0 its value at the leading edge, on any number of panels.
//! The foremost vortex alone [Hirato et al. 2019, AIAA J. 57:4034] has a part of the next modes besides, of
//! first order in the length of its panel: a plate that pitches about its quarter chord seems to have 11 % too
//! much suction on eight panels.
//!
//! U is the speed of stream and motion at the quarter chord, in the plane of the section.

use crate::geometry::{Panels, Strip, section};
use crate::lattice::Lattice;
use std::f64::consts::PI;
use wingbeat_math::DVec3;

/// A strip at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeadingSection {
    /// Middle of the leading edge [m], N.
    pub middle: DVec3,
    /// Unit vector backward, normal to the edge, N.
    pub aft: DVec3,
    /// Rear ends of the two foremost panels, the chord where there is but one, and chord [m].
    pub extent: [f64; 3],
    /// Speed of stream and motion at the quarter chord, in the plane of the section [m/s].
    pub speed: f64,
    /// Circulation over speed of the foremost vortex at a suction parameter of one if w is even [m].
    pub per_speed: f64,
    /// Weights of the normal velocities at the two foremost control points in speed times suction parameter \[1\].
    pub weights: [f64; 2],
    /// Circulation of the foremost vortex over that of the second if w is even, 1 where there is but one \[1\].
    ratio: f64,
    /// Distance of the foremost vortex from the edge over that between the two, 0 where there is but one \[1\].
    ahead: f64,
}

impl LeadingSection {
    pub fn of(
        (lattice, panels, time): (&Lattice, &Panels, f64),
        strip: &Strip,
        position: &[DVec3],
    ) -> Self {
        let (aft, chord) = section(strip, position);
        let middle = |k: usize| {
            let [a, b] = strip.sides[k];
            position[a].midpoint(position[b])
        };
        let edge = middle(0);
        let place = |k: usize| (middle(k) - edge).dot(aft);
        // A section bent so far that it turns back counts as one panel.
        let count = match (1..strip.sides.len()).all(|k| place(k) > place(k - 1)) {
            true => strip.panels.len(),
            false => 1,
        };
        let row = Row {
            place: |k: usize| if k < count { place(k) } else { chord },
            count,
            shift: lattice.settings().ring_shift(),
            along: |k: usize| match count > 1 {
                true => lattice.controls().along(strip.panels[k]),
                false => 0.5,
            },
        };
        let quarter = |k: usize| 0.75 * (row.place)(k) + 0.25 * (row.place)(k + 1);
        let wind = quarter_chord_wind((lattice, panels, time), strip, (edge, aft, chord));
        let (first, several) = (row.strength(0), count > 1);
        Self {
            middle: edge,
            aft,
            extent: [(row.place)(1), (row.place)(2.min(count)), chord],
            speed: wind
                .dot(aft)
                .hypot(wind.dot(panels.normal[strip.panels[0]])),
            per_speed: 2.0 * PI * first,
            weights: if several {
                [0, 1].map(|i| row.weight(i))
            } else {
                [1.0, 0.0]
            },
            ratio: if several {
                first / row.strength(1)
            } else {
                1.0
            },
            ahead: match several {
                true => quarter(0) / (quarter(1) - quarter(0)),
                false => 0.0,
            },
        }
    }

    /// Circulation of the foremost vortex at a suction parameter of one if w is even [m2/s].
    pub fn unit(&self) -> f64 {
        self.speed * self.per_speed
    }

    /// Circulation that the foremost vortex would have without the next mode of thin-airfoil theory, of which
    /// it has the given share, 0 to 1; `net` are those of the two foremost [m2/s].
    pub fn counted(&self, net: [f64; 2], share: f64) -> f64 {
        net[0] + share * self.ahead * (net[0] - self.ratio * net[1])
    }

    /// Largest circulation of the foremost vortex, not below zero, that counts as a suction parameter of
    /// `threshold` where the second has `second` [m2/s], counted positive in the same direction.
    pub fn limit(&self, threshold: f64, second: f64, share: f64) -> f64 {
        let without = self.counted([0.0, second], share);
        ((threshold * self.unit() - without) / (1.0 + share * self.ahead)).max(0.0)
    }

    /// Suction parameter \[1\] where [`Self::counted`] is this [m2/s]; none where nothing flows past the section.
    pub fn parameter(&self, counted: f64) -> f64 {
        match self.unit() > 0.0 {
            true => counted / self.unit(),
            false => 0.0,
        }
    }
}

/// Vortices and control points of the panels of a section, by the places of their ends [m].
struct Row<F, G> {
    place: F,
    count: usize,
    /// Vortices are so far along their panels \[1\]: a quarter, or the boundary condition is so much farther aft.
    shift: f64,
    /// Part of the way from one vortex to the next at which the control point between them lies \[1\].
    along: G,
}

impl<F: Fn(usize) -> f64, G: Fn(usize) -> f64> Row<F, G> {
    /// Vortex of panel `k`; one more as far behind the last panel.
    fn vortex(&self, k: usize) -> f64 {
        let at = &self.place;
        let here = at(k);
        match k < self.count {
            true => here + self.shift * (at(k + 1) - here),
            false => here + self.shift * (here - at(k - 1)),
        }
    }

    /// Control point between vortex `k` and the next.
    fn point(&self, k: usize) -> f64 {
        let [from, to] = [self.vortex(k), self.vortex(k + 1)];
        match (self.along)(k) {
            0.5 => from.midpoint(to),
            part => from + part * (to - from),
        }
    }

    /// `P_j` [m].
    fn strength(&self, j: usize) -> f64 {
        let v = self.vortex(j);
        let part = |k: usize| match k == j {
            true => (self.point(k) - v).abs(),
            false => ((self.point(k) - v) / (self.vortex(k) - v)).abs(),
        };
        (0..self.count).map(part).product()
    }

    /// Weight of the normal velocity at control point `i` in that at the leading edge of what the two foremost
    /// vortices make of a linear one.
    fn weight(&self, i: usize) -> f64 {
        let c = self.point(i);
        let part = |k: usize| match k == i {
            true => (c - self.vortex(k)).abs(),
            false => ((c - self.vortex(k)) / (c - self.point(k))).abs(),
        };
        let [u, v] = [0, 1].map(|j| self.vortex(j));
        (0..self.count).map(part).product::<f64>() * (c - u - v) / ((c - u) * (c - v))
    }
}

/// The wind that stream and motion make at the quarter chord of a strip, whose leading edge is at `middle` [m,
/// m/s]: that of its control points, which is linear along a rigid section.
fn quarter_chord_wind(
    (lattice, panels, time): (&Lattice, &Panels, f64),
    strip: &Strip,
    (middle, aft, c): (DVec3, DVec3, f64),
) -> DVec3 {
    let ends = [strip.panels[0], strip.panels[strip.panels.len() - 1]];
    let place = ends.map(|p| (panels.point[p] - middle).dot(aft));
    let wind = ends.map(|p| lattice.stream(panels.point[p], time) - panels.velocity[p]);
    let way = place[1] - place[0];
    match way > 0.0 {
        true => wind[0].lerp(wind[1], (0.25 * c - place[0]) / way),
        false => wind[0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the two foremost vortices make of an even normal velocity is that velocity, and nothing of one that
    /// is linear about mid chord, for panels of any lengths.
    #[test]
    fn exact_weights_of_even_and_linear_normal_velocities() {
        for ends in [
            &[0.0, 0.5, 1.0][..],
            &[0.0, 0.1, 0.35, 0.8, 0.9],
            &[0.0, 0.04, 0.3, 0.8],
        ] {
            let (count, chord) = (ends.len() - 1, ends[ends.len() - 1]);
            let row = Row {
                place: |k: usize| ends[k],
                count,
                shift: 0.25,
                along: |k: usize| {
                    let d = |k: usize| ends[k + 1] - ends[k];
                    0.5 * d(k) / (0.75 * d(k) + 0.25 * d((k + 1).min(count - 1)))
                },
            };
            let weights: Vec<f64> = (0..count).map(|i| row.weight(i)).collect();
            let even: f64 = weights.iter().sum();
            let about_middle = |(i, w): (usize, &f64)| w * (row.point(i) - 0.5 * chord);
            let linear: f64 = weights.iter().enumerate().map(about_middle).sum();
            assert!(
                (even - 1.0).abs() < 1e-12 && linear.abs() < 1e-12,
                "{weights:?}"
            );
        }
    }

    /// The largest circulation is that which counts as the threshold, whatever share of the next mode it has.
    #[test]
    fn exact_limit_counts_as_the_threshold() {
        let section = LeadingSection {
            middle: DVec3::ZERO,
            aft: DVec3::X,
            extent: [0.2, 0.4, 1.0],
            speed: 2.0,
            per_speed: 1.5,
            weights: [0.4, 0.1],
            ratio: 2.0,
            ahead: 0.25,
        };
        for (second, share) in [(0.3, 0.0), (0.3, 1.0), (-0.1, 0.6)] {
            let most = section.limit(0.15, second, share);
            let parameter = section.parameter(section.counted([most, second], share));
            assert!(
                (parameter - 0.15).abs() < 1e-15,
                "{second}, {share}: {parameter}"
            );
        }
        assert_eq!(section.limit(0.15, -9.0, 1.0), 0.0);
        let still = LeadingSection {
            speed: 0.0,
            ..section
        };
        assert_eq!(still.parameter(1.0), 0.0);
    }
}
