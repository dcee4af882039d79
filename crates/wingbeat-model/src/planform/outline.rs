//! Outlines of wings.

use crate::error::{
    ModelError, finite, fraction, in_row, not_negative, positive, require, require_count,
};
use crate::planform::beta::Beta;
use crate::planform::contour;
use crate::planform::edges::{Curve, Edges};
use wingbeat_math::interpolate_pairs;

/// Part of the span by which the ends of two edges may differ as numbers of 16 digits do \[1\].
const ROUNDING: f64 = 1e-9;

/// The outline of a wing.
#[derive(Clone, Debug, PartialEq)]
pub enum Planform {
    /// Constant chord.
    Rectangle {
        /// Chord \[m\].
        chord: f64,
        /// Span of the surface, root to tip \[m\].
        span: f64,
        /// Distance from the hinge to the root \[m\].
        root_offset: f64,
        /// Part of the chord ahead of the hinge axis, 0 (leading edge on the axis) to 1.
        axis_fraction: f64,
    },
    /// Ellington's beta distribution of the chord.
    Beta(Beta),
    /// Edges as polylines of points (r, x) \[m\] with r increasing, both from root to tip.
    Outline {
        /// Leading edge.
        leading: Vec<(f64, f64)>,
        /// Trailing edge.
        trailing: Vec<(f64, f64)>,
        /// Where the outline is narrower than this part of its largest chord (pointed tip or
        /// root), the edges are moved apart to it, so that no panel degenerates; in (0, 1).
        least_chord: f64,
    },
}

impl Planform {
    /// Edges as points \[r, x\] \[m\] with r increasing, both from root to tip, nowhere less than `least_chord`
    /// of the largest chord apart.
    pub fn outline(leading: &[[f64; 2]], trailing: &[[f64; 2]], least_chord: f64) -> Self {
        let points = |edge: &[[f64; 2]]| edge.iter().map(|&point| point.into()).collect();
        Self::Outline {
            leading: points(leading),
            trailing: points(trailing),
            least_chord,
        }
    }

    /// A closed polygon of points (r, x) \[m\], in either sense. Where it has several points in front of one
    /// another, as in notches and hooks, the edges are the foremost and the rearmost; what reaches behind the
    /// hinge, a twentieth of the length at most, is left out.
    ///
    /// # Errors
    /// Fewer than three points, numbers that are not finite, a polygon that reaches further behind the hinge.
    pub fn from_polygon(points: &[(f64, f64)], least_chord: f64) -> Result<Self, ModelError> {
        let [leading, trailing] = contour::edges(points)?;
        Ok(Self::Outline {
            leading,
            trailing,
            least_chord,
        })
    }

    /// The curves of both edges.
    ///
    /// # Errors
    /// A size that is not allowed, or a beta distribution that cannot have the wanted r2_hat.
    pub fn edges(&self) -> Result<Edges, ModelError> {
        match self {
            &Planform::Rectangle {
                chord,
                span,
                root_offset,
                axis_fraction,
            } => {
                positive("planform.chord", chord)?;
                positive("planform.span", span)?;
                not_negative("planform.root_offset", root_offset)?;
                fraction("planform.axis_fraction", axis_fraction)?;
                let lead = axis_fraction * chord;
                Ok(Edges {
                    root: root_offset,
                    tip: root_offset + span,
                    curve: Curve::Straight(lead, lead - chord),
                })
            }
            Planform::Beta(beta) => Ok(Edges {
                root: beta.root_offset,
                tip: beta.length,
                curve: Curve::Beta(beta.fit()?, beta.axis_fraction),
            }),
            Planform::Outline {
                leading,
                trailing,
                least_chord,
            } => outline_edges(leading, trailing, *least_chord),
        }
    }
}

fn outline_edges(
    leading: &[(f64, f64)],
    trailing: &[(f64, f64)],
    least_chord: f64,
) -> Result<Edges, ModelError> {
    check_edge("planform.leading", leading)?;
    check_edge("planform.trailing", trailing)?;
    let key = "planform.least_chord";
    require(
        key,
        least_chord,
        least_chord > 0.0 && least_chord < 1.0,
        "in (0, 1)",
    )?;
    let [root, tip] = [leading[0].0, leading[leading.len() - 1].0];
    let is_near = |a: f64, b: f64| (a - b).abs() <= ROUNDING * (tip - root);
    let same = is_near(trailing[0].0, root) && is_near(trailing[trailing.len() - 1].0, tip);
    if !same || root < 0.0 {
        return Err(ModelError::Planform(format!(
            "leading edge (r = {root} to {tip} m) and trailing edge (r = {} to {} m) must cover the same part of the span, r >= 0",
            trailing[0].0,
            trailing[trailing.len() - 1].0
        )));
    }
    let chord = |r: f64| interpolate_pairs(leading, r) - interpolate_pairs(trailing, r);
    let knots = || leading.iter().chain(trailing).map(|p| p.0);
    if let Some(r) = knots().find(|&r| chord(r) < 0.0) {
        return Err(ModelError::Planform(format!(
            "at r = {r} m the leading edge lies behind the trailing edge (x must rise towards the leading edge)"
        )));
    }
    let widest = positive("planform.max_chord", knots().map(chord).fold(0.0, f64::max))?;
    let curve = Curve::Points(leading.to_vec(), trailing.to_vec(), least_chord * widest);
    Ok(Edges { root, tip, curve })
}

fn check_edge(table: &str, points: &[(f64, f64)]) -> Result<(), ModelError> {
    require_count(table, points.len(), points.len() >= 2, ">= 2 points")?;
    for (k, &(r, x)) in points.iter().enumerate() {
        finite(&format!("{table}[{k}].r"), r)?;
        finite(&format!("{table}[{k}].x"), x)?;
        if k > 0 && r <= points[k - 1].0 {
            let problem = format!("r = {r} m does not increase from root to tip");
            return Err(in_row(table, k, problem));
        }
    }
    Ok(())
}
