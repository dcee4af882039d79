//! Steady wings: lift slopes and centres of pressure.

use crate::lab::outline::{self, Spread};
use crate::lab::{extrapolated, fly, total_force, total_moment, translating};
use crate::{Case, Part, Row, VerifyError};
use std::f64::consts::{PI, TAU};
use wingbeat_air::{AirError, AirSettings, CoreModel, Lattice, Surface};
use wingbeat_math::DVec3;

pub(super) const CASES: &[Case] = &[
    Case {
        name: "steady-rectangular",
        about: "Lift slope of flat rectangular wings of aspect ratio 1, 4, 8 and 20 in a steady stream.",
        part: Part::Analytic,
        quick: true,
        run: rectangular,
    },
    Case {
        name: "steady-elliptic",
        about: "Lift slope of an elliptic wing of aspect ratio 8 and of the circular wing.",
        part: Part::Analytic,
        quick: true,
        run: elliptic,
    },
    Case {
        name: "steady-warren-12",
        about: "Lift and moment slope of the swept, tapered wing Warren-12.",
        part: Part::Analytic,
        quick: true,
        run: warren,
    },
];

struct Wing {
    nodes: Vec<DVec3>,
    mesh: [usize; 2],
    span: f64,
    area: f64,
}

/// Slopes of lift and of the pitching moment about the origin (nose up, reference length 1) with the
/// angle of attack, after the starting vortex has been left 30 spans behind.
fn slopes(wing: &Wing) -> Result<[f64; 2], AirError> {
    let alpha = 1e-3_f64;
    let stream = DVec3::new(alpha.cos(), 0.0, alpha.sin());
    let core = CoreModel::Scully { radius: 1e-7 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        ..AirSettings::accurate(1.0, stream)
    };
    let [rows, cols] = wing.mesh;
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, cols)], settings)?;
    let motion = |_| translating(wing.nodes.clone(), DVec3::ZERO);
    let run = fly(&lattice, motion, wing.span, 30, |_, _, _, _| {})?;
    let q = 0.5 * wing.area * alpha;
    Ok([
        total_force(&run.loads).z / q,
        total_moment(&run.loads).y / q,
    ])
}

/// Slopes on two meshes and their extrapolation at first order (moment) and second order (lift).
fn refined(wing: impl Fn(usize) -> Wing) -> Result<[Slope; 2], AirError> {
    let [a, b, c] = [slopes(&wing(1))?, slopes(&wing(2))?, slopes(&wing(4))?];
    Ok([0, 1].map(|i| Slope {
        fine: c[i],
        limit: extrapolated(b[i], c[i], 1.0),
        order: ((b[i] - a[i]) / (c[i] - b[i])).abs().log2(),
    }))
}

struct Slope {
    fine: f64,
    limit: f64,
    order: f64,
}

impl Slope {
    fn row(&self, what: &str) -> Row {
        let name = format!("{what} (order {:.1} on three meshes)", self.order);
        Row::new(name, "1/rad", self.fine).uncertain(self.limit - self.fine)
    }
}

fn rectangle(aspect: f64, k: usize) -> Wing {
    let mesh = [2 * k, (8.0 * aspect.sqrt()) as usize * k];
    Wing {
        nodes: outline::nodes(|_| [0.0, 1.0], [0.0, aspect], mesh, Spread::Uniform),
        mesh,
        span: aspect,
        area: aspect,
    }
}

/// Prandtl's lifting line of a rectangular wing, section slope 2 pi: Glauert's series with 60 terms
/// at 60 stations of half the span.
fn lifting_line(aspect: f64) -> f64 {
    let n = 60;
    let mu = PI / (2.0 * aspect);
    let mut a = vec![0.0; n * n];
    let mut b = vec![0.0; n];
    for i in 0..n {
        let theta = 0.5 * PI * (i as f64 + 1.0) / n as f64;
        for j in 0..n {
            let m = (2 * j + 1) as f64;
            a[i * n + j] = (m * theta).sin() * (m * mu + theta.sin());
        }
        b[i] = mu * theta.sin();
    }
    let mut lu = wingbeat_math::DenseLu::new(n);
    lu.factor(&a).expect("Glauert's equations are regular");
    lu.solve_in_place(&mut b);
    PI * aspect * b[0]
}

/// Lift slope of an elliptic wing [van Dyke 1964, Appl. Math. Rev. 15:90].
fn van_dyke(aspect: f64) -> f64 {
    let third = 16.0 / (PI * PI) * ((PI * aspect).ln() - 1.125) / aspect.powi(2);
    TAU / (1.0 + 2.0 / aspect + third)
}

fn rectangular(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let [one, _] = refined(|k| rectangle(1.0, k))?;
    let mut rows = vec![
        one.row("lift slope, aspect ratio 1")
            .against(
                1.4602,
                "Tuck 1993, J. Austral. Math. Soc. B 35:127 (square wing)",
            )
            .within_part(0.01, "8 x 32 panels"),
    ];
    for (aspect, tolerance) in [(4.0, 0.03), (8.0, 0.02), (20.0, 0.015)] {
        let [slope, _] = refined(|k| rectangle(aspect, k))?;
        rows.push(
            slope
                .row(&format!("lift slope, aspect ratio {aspect}"))
                .against(
                    lifting_line(aspect) * van_dyke(aspect) / (TAU / (1.0 + 2.0 / aspect)),
                    "Prandtl's lifting line (Glauert's series) with van Dyke's third-order factor",
                )
                .within_part(tolerance, "the factor is that of an elliptic wing"),
        );
    }
    Ok(rows)
}

fn elliptic(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    // The tip is cut where the chord is 4 % of the root's: a node without chord is no panel.
    let cut = 0.9992;
    let ellipse = |stretch: f64, k: usize| {
        let mesh = [2 * k, 10 * k];
        let chord = move |y: f64| outline::circle(y / stretch);
        let half = cut * stretch;
        Wing {
            nodes: outline::nodes(chord, [-half, half], mesh, Spread::Uniform),
            mesh,
            span: 2.0 * stretch,
            area: PI * stretch,
        }
    };
    let [circle, _] = refined(|k| ellipse(1.0, k))?;
    let aspect = 8.0;
    let [long, _] = refined(|k| ellipse(aspect * PI / 4.0, k))?;
    Ok(vec![
        circle
            .row("lift slope of the circular wing")
            .against(1.790, "Jordan 1971; Tuck 1993: 1.790")
            .within_part(0.01, "8 x 40 panels, polygonal outline of area 0.5 % less"),
        long.row("lift slope of the elliptic wing, aspect ratio 8")
            .against(van_dyke(aspect), "van Dyke 1964, third-order lifting line")
            .within_part(0.01, "8 x 40 panels; next term of the series"),
    ])
}

fn warren(_quick: bool) -> Result<Vec<Row>, VerifyError> {
    let wing = |k: usize| {
        let mesh = [3 * k, 12 * k];
        let half = std::f64::consts::SQRT_2;
        Wing {
            nodes: outline::nodes(outline::warren_12, [-half, half], mesh, Spread::Uniform),
            mesh,
            span: 2.0 * half,
            area: 2.0 * half,
        }
    };
    let [lift, moment] = refined(wing)?;
    let moment = Slope {
        fine: moment.limit,
        limit: moment.limit + (moment.limit - moment.fine),
        ..moment
    };
    let source = "Warren-12 planform: C_La = 2.743, C_ma = -3.10 about the apex, mean chord";
    Ok(vec![
        lift.row("lift slope")
            .against(2.743, source)
            .within_part(0.01, "12 x 48 panels"),
        moment
            .row("moment slope about the apex, extrapolated at first order")
            .against(-3.10, source)
            .within_part(0.02, "12 x 48 panels, swept: of first order"),
    ])
}
