//! Figures over time: angles, forces, trajectory, balances.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use super::chart::{Chart, Panel};
use super::time_axis;
use wingbeat_results::History;
use wingbeat_results::columns::body_names;
use wingbeat_results::summary::{air_force, down, hinge_power};

/// The charts over time that make sense for a run, by kind.
pub(super) fn all(setup: &FlightSetup, history: &History) -> Vec<(&'static str, Chart)> {
    let mut list = vec![];
    if setup.air.is_some() {
        list.push(("forces", forces(setup, history)));
    }
    list.push(("trajectory", trajectory(setup, history)));
    if setup.time.period.is_some() {
        list.push(("angles", angles(setup, history)));
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

pub(super) fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

/// Name in column names of the wing that stands for all, the last one, and the sign that makes its
/// stroke angle rise in the downstroke; none for a motion without a period.
pub(super) fn reference_wing(setup: &FlightSetup) -> Option<(String, f64)> {
    setup.time.period?;
    let wing = setup.animal.wings.last()?;
    let name = body_names(&setup.animal).swap_remove(setup.animal.wings.len());
    Some((name, wing.side.sign()))
}

/// Whether the reference wing goes down (or forward: its stroke angle phi rises) from each row to
/// the next.
pub(super) fn goes_down(setup: &FlightSetup, history: &History) -> Vec<bool> {
    let Some((wing, sign)) = reference_wing(setup) else {
        return vec![];
    };
    let phi = history.column(&format!("{wing}_prescribed_phi_rad"));
    phi.windows(2).map(|p| sign * (p[1] - p[0]) > 0.0).collect()
}

/// Intervals of the downstroke.
pub(super) fn downstrokes(setup: &FlightSetup, history: &History, x: &[f64]) -> Vec<[f64; 2]> {
    let mut list: Vec<[f64; 2]> = vec![];
    for (ends, down) in x.windows(2).zip(goes_down(setup, history)) {
        match list.last_mut() {
            _ if !down => {}
            Some(last) if last[1] == ends[0] => last[1] = ends[1],
            _ => list.push([ends[0], ends[1]]),
        }
    }
    list
}

/// What forces are given in: unit as a label, and the factor from newtons.
pub(super) fn force_unit(setup: &FlightSetup, values: &[f64]) -> (String, f64) {
    let weight = setup.animal.mass() * setup.gravity.length();
    if weight > 0.0 {
        return ("weight".to_owned(), 1.0 / weight);
    }
    let (scale, prefix) = prefix(values);
    (format!("{prefix}N"), 1.0 / scale)
}

fn forces(setup: &FlightSetup, history: &History) -> Chart {
    let up = air_force(history, -down(setup));
    let forward = air_force(history, DVec3::X);
    let right = air_force(history, DVec3::Y);
    let (unit, factor) = force_unit(setup, &up);
    let size = |f: &[f64]| f.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let mut series = vec![
        ("up", scaled(&up, factor)),
        ("forward", scaled(&forward, factor)),
    ];
    if size(&right) > 1e-9 * size(&up).max(size(&forward)) {
        series.push(("right", scaled(&right, factor)));
    }
    let label = match &unit[..] {
        "weight" => "force of the air / weight".to_owned(),
        _ => format!("force of the air [{unit}]"),
    };
    let power = hinge_power(history);
    let (scale, prefix) = prefix(&power);
    let panels = vec![
        Panel::new(&label, series),
        Panel::new(
            &format!("power of the hinges [{prefix}W]"),
            vec![("power", scaled(&power, 1.0 / scale))],
        ),
    ];
    chart(setup, history, "forces and power", panels)
}

/// A decimal prefix that suits the largest magnitude, and its factor.
pub(super) fn prefix(values: &[f64]) -> (f64, &'static str) {
    let finite = values.iter().filter(|v| v.is_finite());
    let top = finite.fold(0.0_f64, |a, v| a.max(v.abs()));
    let all = [(1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")];
    let fits = |(scale, _): &(f64, &str)| top >= 0.99 * scale;
    let smallest = if top > 0.0 { all[4] } else { all[1] };
    all.into_iter().find(fits).unwrap_or(smallest)
}

fn trajectory(setup: &FlightSetup, history: &History) -> Chart {
    let path: Vec<Vec<f64>> = ["body_x_m", "body_y_m", "body_z_m"]
        .iter()
        .map(|name| from_start(history.column(name)))
        .collect();
    let all: Vec<f64> = path.iter().flatten().copied().collect();
    let (scale, unit) = prefix(&all);
    let position = Panel::new(
        &format!("position from the start [{unit}m]"),
        vec![
            ("forward n1", scaled(&path[0], 1.0 / scale)),
            ("right n2", scaled(&path[1], 1.0 / scale)),
            ("up −n3", scaled(&path[2], -1.0 / scale)),
        ],
    );
    let angle = |name: &str| scaled(history.column(name), 1f64.to_degrees());
    let attitude = Panel::new(
        "attitude [deg]",
        vec![
            ("pitch", angle("body_phi_rad")),
            ("yaw", angle("body_theta_rad")),
            ("roll", angle("body_psi_rad")),
        ],
    );
    let panels = vec![position, attitude];
    chart(setup, history, "path of the body and attitude", panels)
}

/// Differences to the first number.
pub(super) fn from_start(values: &[f64]) -> Vec<f64> {
    let first = values.first().copied().unwrap_or(0.0);
    values.iter().map(|v| v - first).collect()
}

fn angles(setup: &FlightSetup, history: &History) -> Chart {
    let names = body_names(&setup.animal);
    let panels = names[1..][..setup.animal.wings.len()].iter().map(|wing| {
        let angle = |k: &str| {
            let column = format!("{wing}_prescribed_{k}_rad");
            scaled(history.column(&column), 1f64.to_degrees())
        };
        let series = vec![
            ("stroke φ", angle("phi")),
            ("deviation θ", angle("theta")),
            ("feathering ψ", angle("psi")),
        ];
        Panel::new(&format!("{} [deg]", wing.replace('_', " ")), series)
    });
    chart(setup, history, "prescribed wing angles", panels.collect())
}

fn balances(setup: &FlightSetup, history: &History) -> Chart {
    let column = |name: &str| history.column(name).to_vec();
    let names = [
        ("kinetic", "kinetic_energy_joule"),
        ("potential", "potential_energy_joule"),
        ("work of hinges", "hinge_work_joule"),
        ("work of air", "air_work_joule"),
        ("work of deformation", "deformation_work_joule"),
        ("work of loads", "applied_work_joule"),
        ("residual", "energy_residual_joule"),
    ];
    let mut energies: Vec<(&str, Vec<f64>)> =
        names.map(|(label, name)| (label, column(name))).into();
    energies[1].1 = from_start(&energies[1].1);
    energies.retain(|(label, values)| *label == "residual" || values.iter().any(|v| *v != 0.0));
    let all: Vec<f64> = energies.iter().flat_map(|e| &e.1).copied().collect();
    let (scale, prefix) = prefix(&all);
    let residual = energies.last().map_or(vec![], |e| e.1.clone());
    let shown = energies
        .into_iter()
        .map(|(label, values)| (label, scaled(&values, 1.0 / scale)));
    let momentum = vec![
        ("momentum", magnitude(history, "momentum", "kg_m_per_s")),
        (
            "residual",
            magnitude(history, "momentum_residual", "kg_m_per_s"),
        ),
    ];
    let constraints = vec![
        ("position [m]", column("violation_position_m")),
        (
            "orientation [1]",
            column("violation_orientation_dimensionless"),
        ),
    ];
    let mut panels = vec![
        Panel::new(&format!("energy [{prefix}J]"), shown.collect()),
        Panel::new("energy residual [J]", vec![("residual", residual)]).logarithmic(),
        Panel::new("momentum [kg m/s]", momentum).logarithmic(),
    ];
    // Forms that cannot violate a constraint have nothing to show.
    if constraints.iter().flat_map(|c| &c.1).any(|v| *v != 0.0) {
        panels.push(Panel::new("violation of constraints", constraints).logarithmic());
    }
    let mut chart = chart(
        setup,
        history,
        "balances (magnitudes on logarithmic axes)",
        panels,
    );
    chart.shaded.clear();
    chart.title = format!("{}: balances (magnitudes on logarithmic axes)", setup.name);
    chart
}

/// Length of a vector, row by row.
fn magnitude(history: &History, stem: &str, unit: &str) -> Vec<f64> {
    let c = |k: usize| history.column(&format!("{stem}_n{k}_{unit}"));
    let parts = c(1).iter().zip(c(2)).zip(c(3));
    parts
        .map(|((a, b), c)| DVec3::new(*a, *b, *c).length())
        .collect()
}
