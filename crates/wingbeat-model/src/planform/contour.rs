//! Outlines digitised from pictures: points once around a wing.

use crate::error::{ModelError, finite, positive, require_count};

/// Part of the length of a wing that its contour may reach behind the hinge.
const BEHIND: f64 = 0.05;

/// Part of the length of a wing over which its edges jump, to either side.
const STEP: f64 = 1e-9;

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
/// points at each r. Where they jump (sides along the chord, corners at which the polygon turns back), the edges have
/// two points [`STEP`] of the length apart. What reaches behind the hinge, a twentieth of the length at most, is
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
    let step = STEP * tip;
    let (mut leading, mut trailing): (EdgePoints, EdgePoints) = (vec![], vec![]);
    let mut add = |r: f64, [most, least]: [f64; 2]| {
        if leading.last().is_none_or(|&(before, _)| before < r) {
            leading.push((r, most));
            trailing.push((r, least));
        }
    };
    for (k, &r) in places.iter().enumerate() {
        let [inside, outside] = [inner, outer].map(|ends| section(points, r, ends));
        match (inside, outside) {
            (Some(inside), Some(outside)) if k > 0 && inside != outside => {
                add(r - step.min(0.25 * (r - places[k - 1])), inside);
                add(r + step.min(0.25 * (places[k + 1] - r)), outside);
            }
            (Some(edges), _) if k > 0 => add(r, edges),
            (_, Some(edges)) | (Some(edges), None) => add(r, edges),
            (None, None) => {}
        }
    }
    Ok([leading, trailing])
}

/// Whether a side between these distances from the hinge reaches to `r` from nearer the hinge.
fn inner(r: f64, [near, far]: [f64; 2]) -> bool {
    near < r && r <= far
}

/// Whether it goes on from `r` away from the hinge.
fn outer(r: f64, [near, far]: [f64; 2]) -> bool {
    near <= r && r < far
}

/// The foremost and the rearmost x \[m\] at r of the sides of a polygon that `reach` there; none if none does.
fn section(
    points: &[(f64, f64)],
    r: f64,
    reach: impl Fn(f64, [f64; 2]) -> bool,
) -> Option<[f64; 2]> {
    let sides = points.iter().zip(points[1..].iter().chain(&points[..1]));
    let reaching = sides.filter(|(a, b)| reach(r, [a.0.min(b.0), a.0.max(b.0)]));
    let both = reaching.map(|(a, b)| [at(*a, *b, r); 2]);
    both.reduce(|[most, least], [x, _]| [most.max(x), least.min(x)])
}

/// x \[m\] at r of the side from a to b, which is not along the chord: at its ends that of the points themselves.
fn at(a: (f64, f64), b: (f64, f64), r: f64) -> f64 {
    match r {
        _ if r == a.0 => a.1,
        _ if r == b.0 => b.1,
        _ => a.1 + (b.1 - a.1) * (r - a.0) / (b.0 - a.0),
    }
}
