//! Closed bodies: sphere and ellipsoids in potential flow.

use crate::lab::{extrapolated, fly, order, sphere, total_force, translating};
use crate::{Case, Part, Row, VerifyError};
use wingbeat_air::{AirError, AirSettings, Lattice, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "sphere",
        about: "A sphere of panels: surface velocity in a stream, added mass, d'Alembert's paradox.",
        part: Part::Analytic,
        quick: true,
        run: ball,
    },
    Case {
        name: "ellipsoid",
        about: "An ellipsoid of semi-axes 3, 2, 1: added mass and surface velocity along each axis, \
                Munk's moment.",
        part: Part::Analytic,
        quick: true,
        run: ellipsoid,
    },
];

const RHO: f64 = 1.3;
const LAMB: &str = "Lamb, Hydrodynamics, art. 91, 114, 124";

fn body(n: usize, axes: DVec3, stream: DVec3) -> Result<(Lattice, Vec<DVec3>), AirError> {
    let (nodes, quads) = sphere(n);
    let surface = Surface::closed("body", nodes.len(), quads);
    let settings = AirSettings::benchmark(RHO, stream).with_cut_off_for(0.01);
    let lattice = Lattice::new(vec![surface], settings)?;
    Ok((lattice, nodes.iter().map(|x| *x * axes).collect()))
}

fn volume(axes: DVec3) -> f64 {
    4.0 / 3.0 * std::f64::consts::PI * axes.x * axes.y * axes.z
}

/// Added over displaced mass along the axis `direction`, from the third step of constant acceleration.
fn added_mass(n: usize, axes: DVec3, direction: DVec3) -> Result<f64, AirError> {
    let (lattice, nodes) = body(n, axes, DVec3::ZERO)?;
    let motion = |t: f64| {
        let path = 0.5 * direction * t * t;
        translating(nodes.iter().map(|x| *x + path).collect(), direction * t)
    };
    let run = fly(&lattice, motion, 0.1, 2, |_, _, _, _| {})?;
    Ok(-total_force(&run.loads).dot(direction) / (RHO * volume(axes)))
}

/// Root of the mean square error of the outer surface velocity in a unit stream along `direction`,
/// whose added-mass factor is `k`: exactly the tangential part of (1 + k) times the stream.
fn speed_error(n: usize, axes: DVec3, direction: DVec3, k: f64) -> Result<f64, AirError> {
    let (lattice, nodes) = body(n, axes, direction)?;
    let motion = |_| translating(nodes.clone(), DVec3::ZERO);
    let run = fly(&lattice, motion, 1.0, 0, |_, _, _, _| {})?;
    let (mut sum, mut area) = (0.0, 0.0);
    for p in 0..lattice.panel_count() {
        let outer = run.loads.velocity[p] + 0.5 * run.loads.velocity_jump[p];
        let normal = (run.loads.panels.point[p] / (axes * axes)).normalize();
        let exact = (1.0 + k) * (direction - normal * direction.dot(normal));
        sum += (outer - exact).length_squared() * run.loads.panels.area[p];
        area += run.loads.panels.area[p];
    }
    Ok((sum / area).sqrt())
}

/// Lamb's alpha0, beta0, gamma0: abc integral of dl / ((a_i^2 + l) sqrt((a^2 + l)(b^2 + l)(c^2 + l)),
/// with l = s^2 / (1 - s)^2.
fn lamb(axes: DVec3) -> [f64; 3] {
    let n = 20_000;
    let abc = axes.x * axes.y * axes.z;
    axes.to_array().map(|ai| {
        let term = |k: usize| {
            let s = (k as f64 + 0.5) / n as f64;
            let l = (s / (1.0 - s)).powi(2);
            let dl = 2.0 * s / (1.0 - s).powi(3);
            let q = axes * axes + DVec3::splat(l);
            dl / ((ai * ai + l) * (q.x * q.y * q.z).sqrt())
        };
        abc * (0..n).map(term).sum::<f64>() / n as f64
    })
}

/// Added-mass factors along the three axes.
fn factors(axes: DVec3) -> [f64; 3] {
    lamb(axes).map(|a| a / (2.0 - a))
}

const EDGES: &str = "6 n^2 panels of first order, and of less where three or four rows of different \
                     directions meet: 0.1 at n = 8";
const THIN: &str =
    "first order of 1/n: the cube's mesh stretched to 3 : 2 : 1 has steep panels at the ends";
const LAST: &str = "no more than the last refinement, from n to 2 n panels a side, still changes";

fn ball(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let n = if quick { [4, 8] } else { [8, 16] };
    let speed = [
        speed_error(n[0], DVec3::ONE, DVec3::X, 0.5)?,
        speed_error(n[1], DVec3::ONE, DVec3::X, 0.5)?,
    ];
    let k = [
        added_mass(n[0], DVec3::ONE, DVec3::X)?,
        added_mass(n[1], DVec3::ONE, DVec3::X)?,
    ];
    let (lattice, nodes) = body(n[0], DVec3::ONE, DVec3::X)?;
    let motion = |_| translating(nodes.clone(), DVec3::ZERO);
    let run = fly(&lattice, motion, 1.0, 1, |_, _, _, _| {})?;
    let h = 4.0 / n[1] as f64;
    Ok(vec![
        Row::new(
            "rms error of the surface speed over the stream",
            "1",
            speed[1],
        )
        .against(0.0, LAMB)
        .uncertain(speed[0] - speed[1])
        .within(0.2 * h, EDGES),
        Row::new("its order", "1", order(speed[0], speed[1]))
            .because("first at the edges of the cube that the mesh comes from, higher elsewhere"),
        Row::new("added over displaced mass", "1", k[1])
            .against(0.5, LAMB)
            .uncertain(k[1] - k[0])
            .within((k[1] - k[0]).abs(), LAST),
        Row::new(
            "drag in a steady stream over rho U^2 R^2",
            "1",
            total_force(&run.loads).length() / RHO,
        )
        .against(0.0, "d'Alembert's paradox")
        .within(1e-10, "roundings; the mesh is symmetric"),
    ])
}

fn ellipsoid(quick: bool) -> Result<Vec<Row>, VerifyError> {
    let n = if quick { [4, 8] } else { [8, 16] };
    let axes = DVec3::new(3.0, 2.0, 1.0);
    let k = factors(axes);
    let mut rows = Vec::new();
    for (i, name) in ["long", "middle", "short"].into_iter().enumerate() {
        let e = DVec3::AXES[i];
        let computed = [added_mass(n[0], axes, e)?, added_mass(n[1], axes, e)?];
        rows.push(
            Row::new(
                format!("added mass along the {name} axis"),
                "1",
                computed[1],
            )
            .against(k[i], LAMB)
            .uncertain(computed[1] - computed[0])
            .within(0.9 / n[1] as f64, THIN),
        );
        let speed = [
            speed_error(n[0], axes, e, k[i])?,
            speed_error(n[1], axes, e, k[i])?,
        ];
        rows.push(
            Row::new(
                format!("rms error of surface speed, stream along the {name} axis"),
                "1",
                speed[1],
            )
            .against(0.0, LAMB)
            .uncertain(speed[0] - speed[1])
            .within(0.15 * (1.0 + k[i]) * 8.0 / n[1] as f64, EDGES),
        );
    }
    rows.push(munk(n, axes, k)?);
    Ok(rows)
}

/// Moment on the ellipsoid in a stream at 0.4 rad to its long axis in the plane of long and short.
fn munk(n: [usize; 2], axes: DVec3, k: [f64; 3]) -> Result<Row, VerifyError> {
    let alpha = 0.4_f64;
    let stream = DVec3::new(alpha.cos(), 0.0, alpha.sin());
    let mut computed = [0.0; 2];
    for (n, computed) in n.into_iter().zip(&mut computed) {
        let (lattice, nodes) = body(n, axes, stream)?;
        let motion = |_| translating(nodes.clone(), DVec3::ZERO);
        let run = fly(&lattice, motion, 1.0, 1, |_, _, _, _| {})?;
        *computed = run.loads.surfaces[0].moment.y / (RHO * volume(axes));
    }
    let exact = 0.5 * (k[2] - k[0]) * (2.0 * alpha).sin();
    let limit = extrapolated(computed[0], computed[1], 1.0);
    Ok(
        Row::new("Munk's moment over rho U^2 Vol, extrapolated", "1", limit)
            .against(exact, LAMB)
            .uncertain(limit - computed[1])
            .within_part(0.04, "second-order remainder; thin ends"),
    )
}
