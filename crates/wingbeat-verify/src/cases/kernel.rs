//! Biot-Savart sums against closed forms.

use crate::lab::order;
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::{PI, TAU};
use wingbeat_math::DVec3;
use wingbeat_vortex::{CoreModel, Network, Points, add_velocity};

pub(super) const CASES: &[Case] = &[
    Case {
        name: "biot-savart-filament",
        about: "Velocity of straight filaments: finite, and as good as endless.",
        part: Part::Analytic,
        quick: true,
        run: |_| Ok(filament()),
    },
    Case {
        name: "vortex-ring",
        about: "A polygon of filaments as a vortex ring: velocity on its axis, its own speed, a pair.",
        part: Part::Analytic,
        quick: true,
        run: ring,
    },
];

const BARE: CoreModel = CoreModel::Scully { radius: 0.0 };

fn velocity(model: CoreModel, segments: &Network, at: DVec3) -> DVec3 {
    let mut v = Points::zeros(1);
    add_velocity(model, segments, &Points::from_iter([at]), &mut v);
    v.get(0)
}

fn filament() -> Vec<Row> {
    let mut one = Network::default();
    let (a, b) = (DVec3::new(-0.3, 0.0, 0.0), DVec3::new(1.1, 0.0, 0.0));
    one.push_segment(a, b, 2.0, 0.0);
    let mut worst = 0.0_f64;
    for (x, h) in [
        (0.4, 0.2),
        (-1.0, 0.5),
        (1.2, 0.01),
        (3.0, 2.0),
        (0.0, 30.0),
    ] {
        let p = DVec3::new(x, 0.6 * h, 0.8 * h);
        let cosine = |end: DVec3| (p - end).x / (p - end).length();
        let exact = 2.0 / (4.0 * PI * h) * (cosine(a) - cosine(b));
        let computed = velocity(BARE, &one, p);
        let direction = DVec3::X.cross(p).normalize();
        worst = worst.max((computed - exact * direction).length() / exact.abs());
    }
    let mut pair = Network::default();
    let half = 1e5 * DVec3::X;
    pair.push_segment(-half, half, 1.5, 0.0);
    pair.push_segment(half + 0.4 * DVec3::Y, -half + 0.4 * DVec3::Y, 1.5, 0.0);
    let speed = velocity(BARE, &pair, DVec3::ZERO).length();
    vec![
        Row::new(
            "finite filament, largest relative error of five points",
            "1",
            worst,
        )
        .against(0.0, "Gamma/(4 pi h)(cos a1 - cos a2)")
        .within(1e-12, "rounding of the reference's difference of cosines"),
        Row::new("speed of a vortex pair 0.4 m apart", "m/s", speed)
            .against(1.5 / (TAU * 0.4), "Gamma/(2 pi b) of endless filaments")
            .within(
                1e-9,
                "filaments of 2e5 m: 1e-11 of the speed is missing, and roundings",
            ),
    ]
}

/// A regular polygon of `n` sides on the circle of radius `r` at the height z.
fn polygon(segments: &mut Network, model: CoreModel, n: usize, r: f64, z: f64, gamma: f64) {
    let at = |k: usize| {
        let (s, c) = (TAU * (k % n) as f64 / n as f64).sin_cos();
        DVec3::new(r * c, r * s, z)
    };
    for k in 0..n {
        let length = (at(k + 1) - at(k)).length();
        segments.push_segment(at(k), at(k + 1), gamma, model.core(length, 0.0));
    }
}

/// Speed of a ring of radius 1 and circulation 1 whose filament has Scully's core `rc`, as an integral
/// along the ring: the core's factor h^2/(h^2 + rc^2) with h = 2 sin^2(phi/2), the distance from the
/// tangent.
fn scully_ring_speed(rc: f64) -> f64 {
    let n = 200_000;
    let term = |k: usize| {
        let s = (PI * (k as f64 + 0.5) / n as f64).sin();
        let h = 2.0 * s * s;
        1.0 / s * h * h / (h * h + rc * rc)
    };
    (0..n).map(term).sum::<f64>() * (TAU / n as f64) / (16.0 * PI)
}

fn ring(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let axis = |n: usize, z: f64| {
        let mut s = Network::default();
        polygon(&mut s, BARE, n, 1.0, 0.0, 1.0);
        velocity(BARE, &s, z * DVec3::Z).z - 0.5 / (1.0 + z * z).powf(1.5)
    };
    let model = CoreModel::Scully { radius: 0.1 };
    let own = |n: usize| {
        let mut s = Network::default();
        polygon(&mut s, model, n, 1.0, 0.0, 1.0);
        velocity(model, &s, DVec3::X).z
    };
    let (speed, exact) = ([200, 400].map(own), scully_ring_speed(0.1));
    let axis = [100, 200].map(|n| axis(n, 0.5));
    let [drift, turns] = leapfrog(CoreModel::Scully { radius: 0.02 });
    Ok(vec![
        Row::new("velocity on the axis, 200 sides, error", "m/s", axis[1])
            .against(0.0, "Gamma R^2 / (2 (R^2 + z^2)^(3/2))")
            .within(2e-4, "a polygon of n sides: (pi/n)^2 of the velocity"),
        Row::new(
            "order of that error in the sides",
            "1",
            order(axis[0], axis[1]),
        )
        .against(2.0, "chord against arc")
        .within(0.05, "two meshes in the asymptotic range"),
        Row::new(
            "own speed with Scully's core 0.1 R, 400 sides",
            "m/s",
            speed[1],
        )
        .against(
            exact,
            "the same integral taken along the circle by quadrature",
        )
        .uncertain(speed[1] - speed[0])
        .within_part(2e-3, "sides of 0.016 R beside a core that acts over 0.4 R"),
        Row::new(
            "two leapfrogging rings: drift of the impulse R1^2 + R2^2",
            "1",
            drift,
        )
        .against(0.0, "conservation of impulse in an unbounded fluid")
        .within(2e-3, "polygons of 96 sides with cores of 0.02 R"),
        Row::new("their exchange of size", "1", turns)
            .because("smallest radius reached by the ring that slips through, of 1 at the start"),
    ])
}

/// Two equal coaxial rings 0.6 R apart for two radii of travel: drift of the impulse, smallest radius.
fn leapfrog(model: CoreModel) -> [f64; 2] {
    let mut y = [1.0, 0.0, 1.0, 0.6];
    let rate = |y: [f64; 4]| {
        let mut s = Network::default();
        polygon(&mut s, model, 96, y[0], y[1], 1.0);
        polygon(&mut s, model, 96, y[2], y[3], 1.0);
        let v =
            [(y[0], y[1]), (y[2], y[3])].map(|(r, z)| velocity(model, &s, DVec3::new(r, 0.0, z)));
        [v[0].x, v[0].z, v[1].x, v[1].z]
    };
    let step = |y: [f64; 4], k: [f64; 4], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let (h, mut smallest) = (0.05, 1.0_f64);
    for _ in 0..160 {
        let k1 = rate(y);
        let k2 = rate(step(y, k1, 0.5 * h));
        let k3 = rate(step(y, k2, 0.5 * h));
        let k4 = rate(step(y, k3, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        smallest = smallest.min(y[0]).min(y[2]);
    }
    [(y[0] * y[0] + y[2] * y[2]) / 2.0 - 1.0, smallest]
}
