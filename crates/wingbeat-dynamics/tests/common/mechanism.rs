//! Bodies in the plane and flights of mechanisms.

use wingbeat_dynamics::{AbsoluteForm, Body, BodyMotion, JointType, NaturalUnits, Wrench};
use wingbeat_math::ode::{Dop853, Tolerance};
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties};

use super::body;

pub const SI: NaturalUnits = NaturalUnits {
    length: 1.0,
    time: 1.0,
};
pub const REVOLUTE: JointType = JointType::Revolute { axis: DVec3::Z };
pub const ON_LINE: JointType = JointType::PointOnLine { axis: DVec3::Z };

/// A planar body: centre, mass, moment about the mass centre along axis 3.
pub fn planar(name: &str, mass: f64, centre: DVec3, spin: f64) -> Body {
    let inertia = DMat3::from_diagonal(DVec3::splat(spin));
    let m = MassProperties::about_centre(mass, centre, inertia);
    body(name, m, EulerSequence::BODY_231)
}

/// Flies from `times[0]` through all times at tolerance `tol`; returns the states there.
pub fn fly(
    form: &AbsoluteForm,
    y0: Vec<f64>,
    times: &[f64],
    tol: f64,
    loads: impl Fn(&[BodyMotion], &mut [Wrench]),
) -> Vec<Vec<f64>> {
    let mut s = form.scratch();
    let mut motions = vec![BodyMotion::REST; form.mechanism().bodies().len()];
    let mut wrenches = vec![Wrench::default(); motions.len()];
    let tolerance = Tolerance {
        relative: tol,
        absolute: tol,
        max_steps: 100_000,
    };
    let mut method = Dop853::new(tolerance, form.scales());
    let (mut y, mut out) = (y0.clone(), vec![y0]);
    for w in times.windows(2) {
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| {
            form.motions(t, y, &mut motions)?;
            wrenches.fill(Wrench::default());
            loads(&motions, &mut wrenches);
            form.rates(t, y, &wrenches, &mut s, dy)
        };
        (method.integrate((w[0], w[1]), &mut y, rates)).expect("a smooth motion");
        out.push(y.clone());
    }
    out
}

pub fn free(_: &[BodyMotion], _: &mut [Wrench]) {}

pub fn motions(form: &AbsoluteForm, t: f64, y: &[f64]) -> Vec<BodyMotion> {
    let mut m = vec![BodyMotion::REST; form.mechanism().bodies().len()];
    form.motions(t, y, &mut m).unwrap();
    m
}
