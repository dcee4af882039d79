//! Figures over time: angles, forces, trajectory, balances.

use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;
use wingbeat_model::{Side, Wing};

use crate::figures::axes::units::{POWER_FLOOR, force_times_speed, length_floor, scaled};
use crate::figures::over_time::bending::bending;
use crate::figures::over_time::measure::{Kept, Line, Measure, Measured, Unit};
use crate::figures::over_time::part::TimeWindow;
use crate::figures::over_time::wing_angles::wing_angles;
use wingbeat_results::History;
use wingbeat_results::columns::column_stems;
use wingbeat_results::summary::{air_force, down, driving_power, driving_power_name};

/// Relative changes of strokes that are rounding \[1\].
const CHANGE_FLOOR: f64 = 1e-7;

/// The figures over time that make sense for a run, row by row in SI units.
pub(crate) fn measured(setup: &FlightSetup, history: &History, part: &TimeWindow) -> Vec<Measured> {
    let mut list = vec![];
    if setup.air.is_some() {
        list.push(forces(setup, history));
    }
    list.push(trajectory(setup, history, part));
    if setup.time.period.is_some() && !setup.animal.wings.is_empty() {
        list.push(angles(setup, history));
    }
    if setup.feedback.is_some() {
        list.push(commands(setup, history));
    }
    list.extend(bending(setup, history));
    list.push(balances(history));
    list
}

/// Time axis: wingbeats where there are any, else seconds.
pub(crate) fn time_axis(setup: &FlightSetup, history: &History) -> (String, Vec<f64>) {
    let time = history.column("time_s");
    match setup.time.period {
        Some(period) => (
            "wingbeats".to_owned(),
            time.iter().map(|t| t / period).collect(),
        ),
        None => ("time [s]".to_owned(), time.to_vec()),
    }
}

fn forces(setup: &FlightSetup, history: &History) -> Measured {
    let lines = vec![
        Line::new("up", air_force(history, -down(setup))),
        Line::new("forward", air_force(history, DVec3::X)),
        Line::new("right", air_force(history, DVec3::Y)).kept(Kept::Felt),
    ];
    let mut panels = vec![Measure::new("force of the air", Unit::Weight, lines)];
    let name = driving_power_name(setup, history);
    if let Some(name) = name {
        let whole = Line::new("", force_times_speed(setup, history)).kept(Kept::Floor(POWER_FLOOR));
        let power = vec![Line::new("power", driving_power(history)), whole];
        panels.push(Measure::new(name, Unit::Prefixed("W"), power));
    }
    let title = if name.is_some() {
        "forces and power"
    } else {
        "forces"
    };
    Measured {
        name: "forces",
        title: title.to_owned(),
        shaded: true,
        panels,
    }
}

/// Path and attitude; beside them the reference if the flight follows one.
fn trajectory(setup: &FlightSetup, history: &History, part: &TimeWindow) -> Measured {
    let follows = (setup.feedback.as_ref()).is_some_and(|f| f.controller.follows());
    let column = |name: &str| history.column(name).to_vec();
    let mut place = vec![
        Line::new("forward n1", column("body_x_m")).since_start(),
        Line::new("right n2", column("body_y_m")).since_start(),
        Line::new("up −n3", scaled(history.column("body_z_m"), -1.0)).since_start(),
    ];
    if follows {
        let up = scaled(history.column("reference_z_m"), -1.0);
        let centre = |k: usize| {
            let place = history.column(&format!("mass_centre_n{k}_m"));
            place.first().copied().unwrap_or(0.0)
        };
        // A flyer that is not where it is to be is shown so, whatever part of the flight is drawn.
        place.extend([
            Line::new("reference n1", column("reference_x_m")).since(centre(1)),
            Line::new("reference n2", column("reference_y_m")).since(centre(2)),
            Line::new("reference −n3", up).since(-centre(3)),
        ]);
    }
    let attitude = vec![
        Line::new("pitch", column("body_phi_rad")),
        Line::new("yaw", column("body_theta_rad")),
        Line::new("roll", column("body_psi_rad")),
    ];
    Measured {
        name: "trajectory",
        title: "path of the body and attitude".to_owned(),
        shaded: true,
        panels: vec![
            Measure::new(
                &format!("position from {}", part.origin()),
                Unit::Prefixed("m"),
                place,
            )
            .floored(length_floor(setup))
            .if_moving(),
            Measure::new("attitude", Unit::Degrees, attitude),
        ],
    }
}

/// Differences to the first number.
pub(crate) fn from_start(values: &[f64]) -> Vec<f64> {
    let first = values.first().copied().unwrap_or(0.0);
    values.iter().map(|v| v - first).collect()
}

fn angles(setup: &FlightSetup, history: &History) -> Measured {
    let names = column_stems(&setup.animal);
    let (mut feathers, mut joints) = (false, false);
    let panels = (0..setup.animal.wings.len()).map(|k| {
        let found = wing_angles(setup, history, k);
        feathers |= found.feathers;
        joints |= !found.joint.is_empty();
        let labels = ["stroke φ", "deviation θ", "feathering ψ"];
        let lines = labels.into_iter().zip(found.angles);
        let lines = lines.map(|(label, values)| Line::new(label, values));
        let others = found.joint.into_iter();
        let others = others.map(|(label, values)| Line::new(&label, values));
        let label = names[k + 1].replace('_', " ");
        Measure::new(&label, Unit::Degrees, lines.chain(others).collect()).of_wing(k)
    });
    let panels = panels.collect();
    let title = match (feathers, joints) {
        (false, false) => "prescribed wing angles",
        (true, false) => "wing angles, with those of passive joints",
        (_, true) => "prescribed wing angles, and those of joints",
    };
    let is_left = |wing: &Wing| wing.side == Side::Left;
    let signs = match setup.animal.wings.iter().any(is_left) {
        true => " (φ and θ of left wings have the opposite sign)",
        false => "",
    };
    Measured {
        name: "angles",
        title: format!("{title}{signs}"),
        shaded: true,
        panels,
    }
}

/// Commands of amplitude, mean stroke angle and stroke plane, wing by wing.
fn commands(setup: &FlightSetup, history: &History) -> Measured {
    let names = column_stems(&setup.animal);
    let wings = &names[1..][..setup.animal.wings.len()];
    let lines = |what: &str| {
        let line = |wing: &String| {
            let column = format!("command_{wing}_{what}");
            Line::new(&wing.replace('_', " "), history.column(&column).to_vec())
        };
        wings.iter().map(line).collect()
    };
    let amplitude = lines("stroke_amplitude_dimensionless");
    let [offset, plane] = ["stroke_offset_rad", "stroke_plane_rad"].map(lines);
    Measured {
        name: "commands",
        title: "commands of feedback".to_owned(),
        shaded: false,
        panels: vec![
            Measure::new("stroke amplitude, relative change", Unit::Given, amplitude)
                .floored(CHANGE_FLOOR)
                .of_alike(),
            Measure::new("mean stroke angle, forward", Unit::Degrees, offset).of_alike(),
            Measure::new("pitch of the stroke plane", Unit::Degrees, plane).of_alike(),
        ],
    }
}

fn balances(history: &History) -> Measured {
    let line = |label: &str, name: &str| Line::new(label, history.column(name).to_vec());
    let work = |label: &str, name: &str| line(label, name).kept(Kept::NotZero);
    let energies = vec![
        work("kinetic", "kinetic_energy_joule"),
        work("potential", "potential_energy_joule").since_start(),
        work("work of hinges", "hinge_work_joule"),
        work("work of air", "air_work_joule"),
        work("work of deformation", "deformation_work_joule"),
        work("work of loads", "applied_work_joule"),
        line("residual", "energy_residual_joule"),
    ];
    let momentum =
        |label: &str, stem: &str| Line::new(label, magnitude(history, stem, "kg_m_per_s"));
    let constraints = vec![
        work("position [m]", "violation_position_m"),
        work("orientation [1]", "violation_orientation_dimensionless"),
    ];
    let residual = vec![line("residual", "energy_residual_joule")];
    let momenta = vec![
        momentum("momentum", "momentum"),
        momentum("residual", "momentum_residual"),
    ];
    let given = |label: &str, lines| Measure::new(label, Unit::Given, lines).logarithmic();
    Measured {
        name: "balances",
        title: "balances (magnitudes on logarithmic axes)".to_owned(),
        shaded: false,
        panels: vec![
            Measure::new("energy", Unit::Prefixed("J"), energies),
            given("energy residual [J]", residual),
            given("momentum [kg m/s]", momenta),
            given("violation of constraints", constraints),
        ],
    }
}

/// Length of a vector, row by row.
fn magnitude(history: &History, stem: &str, unit: &str) -> Vec<f64> {
    let c = |k: usize| history.column(&format!("{stem}_n{k}_{unit}"));
    let parts = c(1).iter().zip(c(2)).zip(c(3));
    parts
        .map(|((a, b), c)| DVec3::new(*a, *b, *c).length())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{Chart, charts_of};
    use wingbeat_case::LoadedCase;
    use wingbeat_flight::Record;
    use wingbeat_model::WingMotion;
    use wingbeat_results::columns::Columns;

    /// A history of a preset whose records `change` fills, step by step.
    fn history(
        setup: &FlightSetup,
        deforms: bool,
        steps: usize,
        change: impl Fn(usize, &mut Record),
    ) -> History {
        let columns = Columns::new(setup, deforms).unwrap();
        let record = |step| {
            let mut record = columns.blank();
            record.step = step;
            record.time = step as f64 * setup.time.step;
            change(step, &mut record);
            record
        };
        let records: Vec<Record> = (0..steps).map(record).collect();
        History::of(&columns, &records)
    }

    fn chart(setup: &FlightSetup, history: &History, name: &str) -> Chart {
        let mut all = charts_of(setup, history);
        let at = all.iter().position(|c| c.0 == name).unwrap();
        all.swap_remove(at).1
    }

    /// A flyer that is off its way at the start of a part that is drawn alone is shown off it, and its body begins at 0.
    #[test]
    fn exact_a_part_shows_how_far_the_flyer_is_off_its_way() {
        let set = ["control.waypoint=[{ time_s = 0.06, position_m = [0.005, 0, 0] }]"];
        let setup = LoadedCase::find("fruit-fly-controlled", &set.map(str::to_owned))
            .unwrap()
            .setup;
        let history = history(&setup, false, 3, |step, record| {
            let moved = DVec3::new(3e-3, -2e-3, 1e-3) + 1e-4 * step as f64;
            record.mass_centre = moved;
            let origin = moved + 5e-4 * DVec3::Z;
            record.coordinates[..3].copy_from_slice(&origin.to_array());
        });
        let lines = &chart(&setup, &history, "trajectory").panels[0].series;
        let ends: Vec<f64> = lines.iter().map(|l| l.values[2]).collect();
        assert_eq!(ends.len(), 6);
        for (end, wanted) in ends.iter().zip([0.2, 0.2, -0.2, -3.0, 2.0, 1.0]) {
            assert!((end - wanted).abs() < 1e-9, "{ends:?} mm"); // rounding
        }
    }

    /// A joint about the axis of feathering turns the wing beyond what is prescribed; one about another axis stands
    /// beside that.
    #[test]
    fn exact_the_feathering_is_that_of_the_wing() {
        for (set, title, values) in [
            (
                &[][..],
                "wing angles, with those of passive joints",
                vec![0.0, 0.0, 20.0],
            ),
            (
                &["joint.hinge-right.axis=[0,-1,0]"],
                "wing angles, with those of passive joints",
                vec![0.0, 0.0, -20.0],
            ),
            (
                &["joint.hinge-right.axis=[1,0,0]"],
                "prescribed wing angles, and those of joints",
                vec![0.0, 0.0, 0.0, 20.0],
            ),
        ] {
            let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
            let setup = LoadedCase::find("robobee", &set).unwrap().setup;
            let history = history(&setup, false, 3, |_, r| {
                r.joints.iter_mut().for_each(|q| q[0] = 20f64.to_radians());
            });
            let chart = chart(&setup, &history, "angles");
            assert!(chart.title.contains(title), "{}", chart.title);
            let right = chart.panels.iter().find(|p| p.label == "wing right [deg]");
            let series = &right.unwrap().series;
            assert_eq!(series.len(), values.len());
            for (line, wanted) in series.iter().zip(values) {
                assert!((line.values[1] - wanted).abs() < 1e-12, "{}", line.label);
            }
        }
    }

    /// Fore wings go down in the first half of the beat, hind wings in the second.
    #[test]
    fn exact_each_wing_has_its_own_downstroke() {
        let setup = LoadedCase::find("dragonfly", &[]).unwrap().setup;
        let history = history(&setup, false, 41, |k, r| {
            let phi = -(k as f64 * std::f64::consts::TAU / 40.0).cos();
            for (angles, wing) in r.wing_angles.iter_mut().zip(&setup.animal.wings) {
                let pair = if wing.name.contains("fore") {
                    1.0
                } else {
                    -1.0
                };
                angles[0] = pair * wing.side.sign() * phi;
            }
        });
        let angles = chart(&setup, &history, "angles");
        assert!(angles.title.ends_with("(downstroke shaded)"));
        for panel in &angles.panels {
            let shaded = panel.shaded.as_ref().unwrap_or(&angles.shaded);
            let wanted = if panel.label.contains("fore") {
                [0.0, 0.5]
            } else {
                [0.5, 1.0]
            };
            assert_eq!(shaded.len(), 1, "{}", panel.label);
            assert!(
                (0..2).all(|c| (shaded[0][c] - wanted[c]).abs() < 1e-9),
                "{shaded:?}"
            );
        }
        let forces = chart(&setup, &history, "forces");
        assert!(
            forces
                .title
                .ends_with("(downstroke of wing hind right shaded)"),
            "{}",
            forces.title
        );
    }

    /// Fore wings beat, hind wings are a fixed tail: the fore wing's downstroke, which is the first half of the
    /// beat, is shaded.
    #[test]
    fn behaves_a_fixed_tail_does_not_stand_for_the_wings() {
        let still = ["left", "right"].map(|side| {
            format!("wing.hind-{side}.motion={{ phi = {{ constant_deg = 0 }}, psi = {{ constant_deg = 0 }} }}")
        });
        let setup = LoadedCase::find("dragonfly", &still).unwrap().setup;
        let history = history(&setup, false, 41, |k, r| {
            let phi = -(k as f64 * std::f64::consts::TAU / 40.0).cos();
            for (angles, wing) in r.wing_angles.iter_mut().zip(&setup.animal.wings) {
                let beats = f64::from(u8::from(wing.name.contains("fore")));
                angles[0] = beats * wing.side.sign() * phi;
            }
        });
        let (wing, _) = crate::figures::over_time::strokes::reference_wing(&setup).unwrap();
        assert!(wing.contains("fore"), "{wing}");
        let forces = chart(&setup, &history, "forces");
        assert!(
            forces.title.ends_with("(downstroke shaded)"),
            "{}",
            forces.title
        );
        assert_eq!(forces.shaded.len(), 1);
        assert!((forces.shaded[0][1] - 0.5).abs() < 1e-9);
    }

    #[test]
    fn behaves_a_body_without_wings_has_no_angles() {
        let setup = LoadedCase::find("table1-sun-2007", &[]).unwrap().setup;
        let history = history(&setup, false, 3, |_, _| {});
        let all = charts_of(&setup, &history);
        assert!(all.len() > 2 && all.iter().all(|c| c.0 != "angles"));
    }

    #[test]
    fn behaves_bending_names_its_wing() {
        let setup = LoadedCase::find("hawkmoth-elastic", &[]).unwrap().setup;
        let history = history(&setup, false, 3, |_, _| {});
        let title = chart(&setup, &history, "bending").title;
        assert!(
            title.contains("bending of wing right at parts of its length"),
            "{title}"
        );
    }

    /// Rounding fills no axis: places that differ by 1e-19 m, angles that differ by 5e-8 deg.
    #[test]
    fn exact_axes_do_not_show_rounding() {
        let setup = LoadedCase::find("fruit-fly-controlled", &[]).unwrap().setup;
        let history = history(&setup, false, 41, |k, r| {
            let noise = (k as f64).sin();
            r.coordinates[0] = 1e-19 * noise;
            r.coordinates[1] = 1e-9 * noise; // m: a nanometre is no rounding
            r.commands[0].stroke_plane = 5e-8f64.to_radians() * noise;
        });
        let place = &chart(&setup, &history, "trajectory").panels[0];
        assert_eq!(place.label, "position from the start [nm]");
        let range = place.range();
        assert!((1.9..3.0).contains(&(range[1] - range[0])), "{range:?}");
        let plane = &chart(&setup, &history, "commands").panels[2];
        let range = plane.range();
        assert!(plane.label.starts_with("pitch of the stroke plane"));
        assert!((range[1] - range[0] - 1e-5).abs() < 1e-12, "{range:?}");
        let still = self::history(&setup, false, 41, |k, r| {
            r.coordinates[0] = 1e-19 * (k as f64).sin();
        });
        // A body that stays has an attitude, and no way to show.
        let labels: Vec<String> = chart(&setup, &still, "trajectory")
            .panels
            .into_iter()
            .map(|p| p.label)
            .collect();
        assert_eq!(labels, ["attitude [deg]"]);
    }

    /// Hinges of 1 W and deformation of 2 W, each of two wings.
    #[test]
    fn exact_power_is_named_for_what_it_drives() {
        for (preset, deforms, power, name) in [
            (
                "bird-cruise",
                true,
                6.0,
                "power of hinges and deformation [W]",
            ),
            ("fruit-fly-hover", false, 2.0, "power of the hinges [W]"),
            ("robobee", false, 1.5, "power of the actuators [W]"),
        ] {
            let setup = LoadedCase::find(preset, &[]).unwrap().setup;
            let history = history(&setup, deforms, 3, |_, r| {
                r.hinges[..2].iter_mut().for_each(|h| h.power = 1.0);
                r.deformation_power.iter_mut().for_each(|p| *p = 2.0);
                r.passive_power = 0.5;
            });
            let panel = &chart(&setup, &history, "forces").panels[1];
            assert_eq!((&panel.label[..], panel.series[0].values[2]), (name, power));
        }
    }

    /// Power of 1e-15 of weight times speed is rounding: its axis is wider by far. Without joints there is none; of
    /// joined wings that do not move it is that of the hinges.
    #[test]
    fn behaves_power_that_is_rounding_is_flat() {
        for (beats, name) in [
            (true, "power of hinges and deformation"),
            (false, "power of the hinges"),
        ] {
            let mut setup = LoadedCase::find("bird-cruise", &[]).unwrap().setup;
            for wing in setup.animal.wings.iter_mut().filter(|_| !beats) {
                wing.motion = WingMotion::fixed(0.0, [0.1, 0.0, 0.0]);
                wing.deformation = None;
            }
            let weight = setup.animal.mass() * setup.gravity.length();
            let history = history(&setup, true, 41, |k, r| {
                r.hinges[0].power = 1e-15 * weight * (k as f64).sin();
            });
            let panel = &chart(&setup, &history, "forces").panels[1];
            assert!(
                panel.label.starts_with(&format!("{name} [")),
                "{}",
                panel.label
            );
            let most = panel.series[0]
                .values
                .iter()
                .fold(0.0, |a: f64, v| a.max(v.abs()));
            assert!(panel.least > 100.0 * most && most > 0.0, "{}", panel.least);
        }
        let mut setup = LoadedCase::find("fruit-fly-hover", &[]).unwrap().setup;
        setup.animal.wings.clear();
        let chart = chart(&setup, &history(&setup, false, 3, |_, _| {}), "forces");
        assert_eq!(chart.panels.len(), 1);
    }
}
