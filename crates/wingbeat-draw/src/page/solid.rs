//! Rigid surfaces that bodies carry along: the parts of the body as the case gives them, and for a
//! body without any shape the homogeneous ellipsoid of its mass and inertia.

use serde::Serialize;
use wingbeat_math::{DMat3, DVec3, MassProperties, trace};
use wingbeat_model::Animal;

use wingbeat_results::poses::{Poses, picture};

/// Nodes of an ellipsoid along a meridian and around.
const MERIDIAN: usize = 8;
const AROUND: usize = 12;

/// A rigid surface.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Solid {
    pub name: String,
    /// Body that carries it.
    pub body: usize,
    /// Whether it stands for a body whose shape the case does not give.
    stand_in: bool,
    /// Nodes in the axes of its body, as picture axes (b1, -b2, -b3) \[m\].
    nodes: Vec<[f64; 3]>,
    /// Panels as four nodes; a triangle names one node twice.
    pub quads: Vec<[usize; 4]>,
    /// Where its panels begin in the lists of pressures.
    first_panel: Option<usize>,
}

impl Solid {
    /// Longest edge of its box \[m\].
    pub fn size(&self) -> f64 {
        let edge = |k: usize| {
            let along = self.nodes.iter().map(|p| p[k]);
            let ends = along.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
            ends[1] - ends[0]
        };
        (0..3).map(edge).fold(0.0, f64::max)
    }
}

/// The solids of an animal: its body parts, and stand-ins for bodies without parts.
pub(super) fn solids(animal: &Animal, poses: &Poses) -> Vec<Solid> {
    let mut list = vec![];
    let mut panel = 0;
    for s in &poses.surfaces {
        if !poses.is_wing(s.body) {
            list.push(Solid {
                name: s.name.clone(),
                body: s.body,
                stand_in: false,
                nodes: s.nodes.iter().copied().map(picture).collect(),
                quads: s.quads.clone(),
                first_panel: Some(panel),
            });
        }
        panel += s.quads.len();
    }
    let first = animal.wings.len() + 1;
    let own = [("body", 0, animal.body)].into_iter();
    let others =
        (animal.segments.iter().enumerate()).map(|(k, s)| (&s.name[..], first + k, s.mass));
    for (name, body, mass) in own.chain(others) {
        if !list.iter().any(|s| s.body == body) {
            list.extend(ellipsoid(name, body, &mass));
        }
    }
    list
}

/// The homogeneous ellipsoid of this mass and inertia: with the second moments `C = integral rho r r^T`
/// about its centre, `x = sqrt(5 / m) L u` over the unit sphere, where `L L^T = C`; none without mass
/// or extent.
fn ellipsoid(name: &str, body: usize, mass: &MassProperties) -> Option<Solid> {
    let inertia = mass.inertia_about_centre();
    let trace = trace(inertia);
    let moments = 0.5 * trace * DMat3::IDENTITY - inertia;
    if mass.mass <= 0.0 || trace <= 0.0 {
        return None;
    }
    let shape = (5.0 / mass.mass).sqrt() * cholesky(moments);
    let place = |i: usize, j: usize| {
        let [a, b] = [
            std::f64::consts::PI * i as f64 / MERIDIAN as f64,
            std::f64::consts::TAU * j as f64 / AROUND as f64,
        ];
        let u = DVec3::new(a.cos(), a.sin() * b.cos(), a.sin() * b.sin());
        picture(mass.centre() + shape * u)
    };
    let rings = (1..MERIDIAN).flat_map(|i| (0..AROUND).map(move |j| (i, j)));
    let nodes = [(0, 0)].into_iter().chain(rings).chain([(MERIDIAN, 0)]);
    let node = |i: usize, j: usize| match i {
        0 => 0,
        MERIDIAN => 1 + (MERIDIAN - 1) * AROUND,
        _ => 1 + (i - 1) * AROUND + j % AROUND,
    };
    let quads = (0..MERIDIAN).flat_map(|i| {
        (0..AROUND).map(move |j| {
            [
                node(i, j),
                node(i, j + 1),
                node(i + 1, j + 1),
                node(i + 1, j),
            ]
        })
    });
    Some(Solid {
        name: name.to_owned(),
        body,
        stand_in: true,
        nodes: nodes.map(|(i, j)| place(i, j)).collect(),
        quads: quads.collect(),
        first_panel: None,
    })
}

/// Lower triangular L with L L^T = A for a positive semidefinite A; what rounding makes negative
/// counts as zero.
fn cholesky(a: DMat3) -> DMat3 {
    let a = |i: usize, j: usize| a.col(j)[i];
    let mut l = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..=i {
            let rest = a(i, j) - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
            l[i][j] = match i == j {
                true => rest.max(0.0).sqrt(),
                false if l[j][j] > 0.0 => rest / l[j][j],
                false => 0.0,
            };
        }
    }
    DMat3::from_cols_array_2d(&l).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A homogeneous ellipsoid with half axes a, b, c has J = m/5 diag(b² + c², a² + c², a² + b²).
    #[test]
    fn exact_the_ellipsoid_of_an_ellipsoid_is_itself() {
        let [a, b, c, m] = [3.0_f64, 2.0, 1.0, 0.7];
        let moment = |p: f64, q: f64| m / 5.0 * (p * p + q * q);
        let own = DMat3::from_diagonal(DVec3::new(moment(b, c), moment(a, c), moment(a, b)));
        let turn = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(1.1);
        let inertia = turn * own * turn.transpose();
        let centre = DVec3::new(5.0, -1.0, 0.5);
        let mass = MassProperties::about_centre(m, centre, inertia);
        let solid = ellipsoid("body", 0, &mass).unwrap();
        assert_eq!((solid.nodes.len(), solid.quads.len()), (2 + 7 * 12, 8 * 12));
        for p in &solid.nodes {
            let x = turn.transpose() * (DVec3::from_array(picture((*p).into())) - centre);
            let on = (x.x / a).powi(2) + (x.y / b).powi(2) + (x.z / c).powi(2);
            assert!((on - 1.0).abs() < 1e-13, "{on}");
        }
        assert!(ellipsoid("point", 0, &MassProperties::point(1.0, DVec3::X)).is_none());
    }
}
