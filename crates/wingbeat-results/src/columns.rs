//! The columns of history.csv: every field of a record, with its unit spelled out in its name.

use wingbeat_case::column_name;
use wingbeat_flight::{HingeRecord, LoadRecord, Record};
use wingbeat_math::DVec3;
use wingbeat_model::Animal;

/// Names and numbers of one row, in step.
struct Row<'a> {
    names: Option<&'a mut Vec<String>>,
    values: &'a mut Vec<f64>,
}

impl Row<'_> {
    fn number(&mut self, name: impl FnOnce() -> String, value: f64) {
        if let Some(names) = &mut self.names {
            names.push(name());
        }
        self.values.push(value);
    }

    fn plain(&mut self, name: &str, value: f64) {
        self.number(|| name.to_owned(), value);
    }

    /// Three components on axes called `axis`1 to `axis`3.
    fn vector(&mut self, stem: &str, axis: &str, unit: &str, v: DVec3) {
        for k in 0..3 {
            self.number(|| format!("{stem}_{axis}{}_{unit}", k + 1), v[k]);
        }
    }

    fn load(&mut self, stem: &str, load: &LoadRecord) {
        self.vector(&format!("{stem}_force"), "n", "newton", load.force);
        self.vector(&format!("{stem}_moment"), "n", "newton_m", load.moment);
    }
}

/// Names of the bodies in column names: `body`, then `wing_NAME`, then `segment_NAME`.
pub fn body_names(animal: &Animal) -> Vec<String> {
    let wing = |w: &wingbeat_model::Wing| format!("wing_{}", column_name(&w.name));
    let wings = animal.wings.iter().map(wing);
    let segment = |s: &wingbeat_model::Segment| format!("segment_{}", column_name(&s.name));
    let segments = animal.segments.iter().map(segment);
    let body = std::iter::once("body".to_owned());
    body.chain(wings).chain(segments).collect()
}

/// Column names for records of this animal, as filled by a first record.
pub fn names(bodies: &[String], record: &Record) -> Vec<String> {
    let mut names = vec![];
    let row = Row {
        names: Some(&mut names),
        values: &mut vec![],
    };
    fill(bodies, record, row);
    names
}

/// The numbers of a record in the order of [`names`].
pub fn values(bodies: &[String], record: &Record, values: &mut Vec<f64>) {
    values.clear();
    fill(
        bodies,
        record,
        Row {
            names: None,
            values,
        },
    );
}

/// Takes the record apart without `..`: a field that is added cannot be forgotten here.
fn fill(bodies: &[String], record: &Record, mut row: Row<'_>) {
    let Record {
        step,
        time,
        wing_angles,
        commands,
        coordinates,
        rates,
        root_quaternion,
        root_angular_velocity,
        mass_centre,
        multipliers,
        hinges,
        joints,
        air,
        applied,
        tether,
        kinetic_energy,
        potential_energy,
        hinge_work,
        air_work,
        deformation_power,
        deformation_work,
        applied_work,
        energy_residual,
        momentum,
        angular_momentum,
        momentum_residual,
        angular_momentum_residual,
        violation_position,
        violation_orientation,
        euler_regularity,
        corrector_passes,
        corrector_residual,
        vortex_impulse,
        wake_rings,
        wake_particles,
        regularised,
        leak_velocity,
    } = record;
    row.plain("step_count", *step as f64);
    row.plain("time_s", *time);
    prescribed(&mut row, &bodies[1..], wing_angles);
    motion(&mut row, bodies, [coordinates, rates]);
    for (name, value) in ["w", "x", "y", "z"].iter().zip(root_quaternion) {
        row.number(|| format!("body_quaternion_{name}_dimensionless"), *value);
    }
    row.vector(
        "body_angular_velocity",
        "b",
        "rad_per_s",
        *root_angular_velocity,
    );
    row.vector("mass_centre", "n", "m", *mass_centre);
    forces(&mut row, bodies, [multipliers], hinges);
    for (k, [value, rate]) in joints.iter().enumerate() {
        row.number(|| format!("joint_coordinate_{}_rad_or_m", k + 1), *value);
        row.number(|| format!("joint_rate_{}_rad_or_m_per_s", k + 1), *rate);
    }
    for (wing, power) in bodies[1..].iter().zip(deformation_power) {
        row.number(|| format!("deformation_{wing}_power_watt"), *power);
    }
    for (what, loads) in [("air", air), ("applied", applied)] {
        for (body, load) in bodies.iter().zip(loads) {
            row.load(&format!("{what}_{body}"), load);
        }
    }
    row.load("tether", tether);
    for (name, value) in [
        ("kinetic_energy_joule", kinetic_energy),
        ("potential_energy_joule", potential_energy),
        ("hinge_work_joule", hinge_work),
        ("air_work_joule", air_work),
        ("deformation_work_joule", deformation_work),
        ("applied_work_joule", applied_work),
        ("energy_residual_joule", energy_residual),
    ] {
        row.plain(name, *value);
    }
    let (linear, angular) = ("kg_m_per_s", "kg_m2_per_s");
    row.vector("momentum", "n", linear, *momentum);
    row.vector("angular_momentum", "n", angular, *angular_momentum);
    row.vector("momentum_residual", "n", linear, *momentum_residual);
    row.vector(
        "angular_momentum_residual",
        "n",
        angular,
        *angular_momentum_residual,
    );
    row.plain("violation_position_m", *violation_position);
    row.plain(
        "violation_orientation_dimensionless",
        *violation_orientation,
    );
    row.plain("euler_regularity_dimensionless", *euler_regularity);
    row.plain("corrector_passes_count", *corrector_passes as f64);
    row.plain("corrector_residual_dimensionless", *corrector_residual);
    row.vector("vortex_impulse", "n", linear, *vortex_impulse);
    row.plain("wake_rings_count", *wake_rings as f64);
    row.plain("wake_particles_count", *wake_particles as f64);
    row.plain("regularised_count", *regularised as f64);
    row.plain("leak_velocity_m_per_s", *leak_velocity);
    for (wing, command) in bodies[1..].iter().zip(commands) {
        for (name, value) in command.numbers() {
            let unit = match name {
                "stroke_amplitude" | "feathering_amplitude" | "frequency" => "dimensionless",
                "feathering_lead" => "wingbeats",
                _ => "rad",
            };
            row.number(|| format!("command_{wing}_{name}_{unit}"), value);
        }
    }
}

fn prescribed(row: &mut Row<'_>, wings: &[String], angles: &[DVec3]) {
    for (wing, angle) in wings.iter().zip(angles) {
        for (k, name) in ["phi", "theta", "psi"].iter().enumerate() {
            row.number(|| format!("{wing}_prescribed_{name}_rad"), angle[k]);
        }
    }
}

fn motion(row: &mut Row<'_>, bodies: &[String], [coordinates, rates]: [&[f64]; 2]) {
    const NAMES: [(&str, &str); 6] = [
        ("x", "m"),
        ("y", "m"),
        ("z", "m"),
        ("phi", "rad"),
        ("theta", "rad"),
        ("psi", "rad"),
    ];
    for (body, q) in bodies.iter().zip(coordinates.chunks(6)) {
        for ((name, unit), value) in NAMES.iter().zip(q) {
            row.number(|| format!("{body}_{name}_{unit}"), *value);
        }
    }
    for (body, q) in bodies.iter().zip(rates.chunks(6)) {
        for ((name, unit), value) in NAMES.iter().zip(q) {
            row.number(|| format!("{body}_{name}_rate_{unit}_per_s"), *value);
        }
    }
}

fn forces(
    row: &mut Row<'_>,
    bodies: &[String],
    [multipliers]: [&[f64]; 1],
    hinges: &[HingeRecord],
) {
    let connections = multipliers.len() / 2;
    for (k, value) in multipliers.iter().enumerate() {
        let unit = if k < connections {
            "newton"
        } else {
            "newton_m"
        };
        row.number(|| format!("multiplier_{}_{unit}", k + 1), *value);
    }
    for (wing, hinge) in bodies[1..].iter().zip(hinges) {
        let HingeRecord {
            force,
            moment,
            power,
        } = hinge;
        row.vector(&format!("hinge_{wing}_force"), "n", "newton", *force);
        row.vector(&format!("hinge_{wing}_moment"), "w", "newton_m", *moment);
        row.number(|| format!("hinge_{wing}_power_watt"), *power);
    }
}
