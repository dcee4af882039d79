//! Which figures there are and what they show.

use wingbeat_flight::FlightSetup;

use super::chart::{Chart, Panel};
use super::time_axis;
use crate::result::History;
use crate::result::columns::body_names;
use crate::result::summary::{air_force, down, hinge_power};

/// The figures of a run by file name.
pub(super) fn all(setup: &FlightSetup, history: &History) -> Vec<(&'static str, Chart)> {
    let mut list = vec![];
    if setup.air.is_some() {
        list.push(("lift", lift(setup, history)));
    }
    list.push(("trajectory", trajectory(setup, history)));
    if setup.time.period.is_some() {
        list.push(("wings", wings(setup, history)));
    }
    list.push(("balances", balances(setup, history)));
    list
}

fn chart(setup: &FlightSetup, history: &History, title: &str, panels: Vec<Panel>) -> Chart {
    let (x_label, x) = time_axis(setup, history);
    let shaded = downstrokes(setup, history, &x);
    let note = if shaded.is_empty() {
        ""
    } else {
        " (downstroke shaded)"
    };
    Chart {
        title: format!("{}: {title}{note}", setup.name),
        x_label,
        x,
        shaded,
        panels,
    }
}

fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

/// Intervals in which the tip of the last (right) wing moves down or forward: towards +axis 3
/// or, in a horizontal stroke plane, ventrally: its stroke angle phi rises.
fn downstrokes(setup: &FlightSetup, history: &History, x: &[f64]) -> Vec<[f64; 2]> {
    let Some(wing) = setup
        .animal
        .wings
        .last()
        .filter(|_| setup.time.period.is_some())
    else {
        return vec![];
    };
    let name = body_names(&setup.animal).pop().unwrap_or_default();
    let phi = history.column(&format!("{name}_prescribed_phi_rad"));
    let sign = wing.side.sign();
    let mut list: Vec<[f64; 2]> = vec![];
    for k in 1..phi.len().min(x.len()) {
        if sign * (phi[k] - phi[k - 1]) <= 0.0 {
            continue;
        }
        match list.last_mut() {
            Some(last) if last[1] == x[k - 1] => last[1] = x[k],
            _ => list.push([x[k - 1], x[k]]),
        }
    }
    list
}

fn lift(setup: &FlightSetup, history: &History) -> Chart {
    let weight = setup.animal.mass() * setup.gravity.length();
    let up = air_force(history, -down(setup));
    let forward = air_force(history, wingbeat_math::DVec3::X);
    let (unit, factor) = if weight > 0.0 {
        ("weight", 1.0 / weight)
    } else {
        ("N", 1.0)
    };
    let label = if weight > 0.0 {
        "air force / weight".to_owned()
    } else {
        "air force [N]".to_owned()
    };
    let forces = Panel::new(
        &label,
        vec![
            ("up", scaled(&up, factor)),
            ("forward", scaled(&forward, factor)),
        ],
    );
    let (scale, prefix) = prefix(&hinge_power(history));
    let power = Panel::new(
        &format!("hinge power [{prefix}W]"),
        vec![("power", scaled(&hinge_power(history), 1.0 / scale))],
    );
    let title = if unit == "weight" {
        "lift over weight, hinge power"
    } else {
        "air force, hinge power"
    };
    chart(setup, history, title, vec![forces, power])
}

/// A decimal prefix that suits the largest magnitude.
fn prefix(values: &[f64]) -> (f64, &'static str) {
    let top = values.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let all = [(1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n")];
    all.into_iter()
        .find(|(s, _)| top >= *s)
        .unwrap_or((1.0, ""))
}

fn trajectory(setup: &FlightSetup, history: &History) -> Chart {
    let from_start = |name: &str, factor: f64| {
        let c = history.column(name);
        c.iter().map(|v| (v - c[0]) * factor).collect::<Vec<f64>>()
    };
    let path: Vec<Vec<f64>> = ["body_x_m", "body_y_m", "body_z_m"]
        .iter()
        .map(|n| from_start(n, 1.0))
        .collect();
    let all: Vec<f64> = path.iter().flatten().copied().collect();
    let (scale, unit) = prefix(&all);
    let path: Vec<Vec<f64>> = path.iter().map(|c| scaled(c, 1.0 / scale)).collect();
    let position = Panel::new(
        &format!("position [{unit}m]"),
        vec![
            ("forward n1", path[0].clone()),
            ("right n2", path[1].clone()),
            ("up -n3", scaled(&path[2], -1.0)),
        ],
    );
    let degrees = 1f64.to_degrees();
    let angle = |name: &str| scaled(history.column(name), degrees);
    let attitude = Panel::new(
        "attitude [deg]",
        vec![
            ("pitch", angle("body_phi_rad")),
            ("yaw", angle("body_theta_rad")),
            ("roll", angle("body_psi_rad")),
        ],
    );
    chart(
        setup,
        history,
        "path from the start and attitude",
        vec![position, attitude],
    )
}

fn wings(setup: &FlightSetup, history: &History) -> Chart {
    let panels = body_names(&setup.animal)[1..]
        .iter()
        .map(|wing| {
            let angle = |k: &str| {
                scaled(
                    history.column(&format!("{wing}_prescribed_{k}_rad")),
                    1f64.to_degrees(),
                )
            };
            let series = vec![
                ("stroke phi", angle("phi")),
                ("deviation theta", angle("theta")),
                ("feathering psi", angle("psi")),
            ];
            Panel::new(&format!("{} [deg]", wing.replace('_', " ")), series)
        })
        .collect();
    chart(setup, history, "wing angles", panels)
}

fn balances(setup: &FlightSetup, history: &History) -> Chart {
    let column = |name: &str| history.column(name).to_vec();
    let magnitude = |stem: &str, unit: &str| -> Vec<f64> {
        let c = |k: usize| history.column(&format!("{stem}_n{k}_{unit}"));
        let squares = c(1).iter().zip(c(2)).zip(c(3));
        squares
            .map(|((a, b), c)| (a * a + b * b + c * c).sqrt())
            .collect()
    };
    let constraints = Panel::new(
        "violation",
        vec![
            ("position [m]", column("violation_position_m")),
            (
                "orientation [1]",
                column("violation_orientation_dimensionless"),
            ),
        ],
    );
    let energy = Panel::new(
        "energy [J]",
        vec![
            ("work of hinges", column("hinge_work_joule")),
            ("work of air", column("air_work_joule")),
            ("kinetic", column("kinetic_energy_joule")),
            ("residual", column("energy_residual_joule")),
        ],
    );
    let momentum = Panel::new(
        "momentum [kg m/s]",
        vec![
            ("momentum", magnitude("momentum", "kg_m_per_s")),
            ("residual", magnitude("momentum_residual", "kg_m_per_s")),
        ],
    );
    let panels = vec![
        constraints.logarithmic(),
        energy.logarithmic(),
        momentum.logarithmic(),
    ];
    let mut chart = chart(setup, history, "constraints and balances", panels);
    chart.shaded.clear();
    chart.title = format!("{}: constraints and balances (magnitudes)", setup.name);
    chart
}
