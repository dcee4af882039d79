//! Outlines digitised from pictures: points once around a wing.

use crate::error::{ModelError, finite, positive, require_count};

/// Part of the length of a wing that its contour may reach behind the hinge.
const BEHIND: f64 = 0.05;

/// An edge of a wing: points (r, x) \[m\] from root to tip.
pub type EdgePoints = Vec<(f64, f64)>;

/// Where a wing lies in the picture it was digitised from, in the numbers of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmarks {
    /// The hinge \[`unit`\].
    pub hinge: [f64; 2],
    /// The wing tip, or any other point on the span axis \[`unit`\].
    pub tip: [f64; 2],
    /// A point on the side of the leading edge \[`unit`\]. None: that side is to the left on the way from the
    /// hinge to the tip, the second number counted upwards.
    pub leading_edge: Option<[f64; 2]>,
    /// Length of one unit of the picture \[m\].
    pub unit: f64,
}

impl Landmarks {
    /// The scale of a wing whose hinge and tip are `length` \[m\] apart.
    pub fn scaled_to(self, length: f64) -> Self {
        let [dx, dy] = self.along();
        Self {
            unit: length / dx.hypot(dy),
            ..self
        }
    }

    /// Points of the picture as points (r, x) \[m\] of the wing.
    ///
    /// # Errors
    /// A tip in the place of the hinge, a point of the leading edge on the line through both, numbers that are
    /// not finite.
    pub fn place(&self, points: &[[f64; 2]]) -> Result<EdgePoints, ModelError> {
        let marks = [self.hinge, self.tip, self.leading_edge.unwrap_or(self.tip)];
        for (name, [x, y]) in ["hinge", "tip", "leading_edge"].into_iter().zip(marks) {
            finite(name, x)?;
            finite(name, y)?;
        }
        let [dx, dy] = self.along();
        let length = dx.hypot(dy);
        if length == 0.0 {
            return Err(ModelError::Planform(
                "hinge and tip are the same point".into(),
            ));
        }
        let unit = positive("unit", self.unit)?;
        let to_wing = |[x, y]: [f64; 2]| {
            let (x, y) = (x - self.hinge[0], y - self.hinge[1]);
            [(x * dx + y * dy) / length, (y * dx - x * dy) / length]
        };
        let side = match self.leading_edge.map(to_wing) {
            None => 1.0,
            Some([_, 0.0]) => {
                return Err(ModelError::Planform(
                    "the point on the side of the leading edge lies on the line from hinge to tip"
                        .into(),
                ));
            }
            Some([_, x]) => x.signum(),
        };
        let place = |[r, x]: [f64; 2]| (unit * r, unit * side * x);
        Ok(points.iter().map(|&p| place(to_wing(p))).collect())
    }

    fn along(&self) -> [f64; 2] {
        [self.tip[0] - self.hinge[0], self.tip[1] - self.hinge[1]]
    }
}

/// Leading and trailing edge of a closed polygon of points (r, x) \[m\]: the foremost and the rearmost of its
/// points at each r that a corner has. What reaches behind the hinge, a twentieth of the length at most, is
/// left out.
///
/// # Errors
/// Fewer than three points, numbers that are not finite, a wing behind its hinge.
pub(super) fn edges(points: &[(f64, f64)]) -> Result<[EdgePoints; 2], ModelError> {
    let n = points.len();
    require_count("planform.points", n, n >= 3, ">= 3")?;
    for (k, &(r, x)) in points.iter().enumerate() {
        finite(&format!("planform.points[{k}].r"), r)?;
        finite(&format!("planform.points[{k}].x"), x)?;
    }
    let mut places: Vec<f64> = points.iter().map(|p| p.0).collect();
    places.sort_by(f64::total_cmp);
    let (root, tip) = (places[0], places[n - 1]);
    if root < -BEHIND * tip {
        return Err(ModelError::Planform(format!(
            "it reaches from {root} m to {tip} m along the span from the hinge: more than {} % of it lie behind the hinge",
            100.0 * BEHIND
        )));
    }
    places.retain(|r| *r >= 0.0);
    if root < 0.0 {
        places.insert(0, 0.0);
    }
    places.dedup();
    let sides = || points.iter().zip(points[1..].iter().chain(&points[..1]));
    let section = |r: f64| {
        let at = |(a, b): (&(f64, f64), &(f64, f64))| crossing(*a, *b, r);
        let all = sides().filter_map(at).flatten();
        all.fold([f64::NEG_INFINITY, f64::INFINITY], |[most, least], x| {
            [most.max(x), least.min(x)]
        })
    };
    let (mut leading, mut trailing) = (vec![], vec![]);
    for r in places {
        let [most, least] = section(r);
        leading.push((r, most));
        trailing.push((r, least));
    }
    Ok([leading, trailing])
}

/// Where the side from a to b is at r: at its ends the points themselves.
fn crossing(a: (f64, f64), b: (f64, f64), r: f64) -> Option<[f64; 2]> {
    if r < a.0.min(b.0) || r > a.0.max(b.0) {
        return None;
    }
    let at = |p: (f64, f64)| (p.0 == r).then_some(p.1);
    Some(match (at(a), at(b)) {
        (Some(x), Some(y)) => [x, y],
        (Some(x), None) | (None, Some(x)) => [x, x],
        (None, None) => [a.1 + (b.1 - a.1) * (r - a.0) / (b.0 - a.0); 2],
    })
}
