//! `wingbeat modes`.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};
use wingbeat::analysis::flutter::ElasticRig;
use wingbeat::analysis::{About, Alike, WingMode, WingModes, wing_modes};
use wingbeat::model::Wing;

use crate::command::options::{self, CaseArgs};
use crate::command::output::failure::Failure;
use crate::command::output::report::{Report, ReportArgs, line};
use crate::command::output::terminal::tell as announce;
use crate::command::progress::watch::watched;

/// Relative difference of frequencies up to which two wings count as one \[1\]: rounding of mirror images.
const SAME: f64 = 1e-6;

/// Displacement by weight over the length of a wing above which modes about rest are those of another wing \[1\].
const FAR: f64 = 0.1;

/// Likeness below which a mode in air is called like none in vacuum \[1\]: it has most of its shape from others.
const ALIKE: f64 = 0.5;

/// Arguments of `wingbeat modes`.
#[derive(Args)]
#[command(
    mut_arg("case", |a| a.help("Case file or preset with elastic wings; - is the standard input")),
    mut_arg("set", |a| a.help("Set a key of the case, e.g. wing.right.structure.shell.young_pa=2e9; KEY= takes it away (may be repeated)")),
)]
pub(crate) struct ModesArgs {
    #[command(flatten)]
    case: CaseArgs,
    /// Modes of each wing.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = options::count::<1, 100>)]
    count: usize,
    /// About the deformed steady state in the stream of the case; else about the wing at rest.
    #[arg(long)]
    steady: bool,
    /// Write the shapes as CSV: displacements of the nodes of the mesh, the largest of length 1.
    #[arg(long, value_name = "FILE")]
    shapes: Option<PathBuf>,
    #[command(flatten)]
    report: ReportArgs,
}

/// The whole command.
pub(crate) fn run(args: &ModesArgs) -> Result<(), Failure> {
    let about = match args.steady {
        true => About::Steady,
        false => About::Rest,
    };
    args.report.deliver([&args.shapes], |report, [shapes]| {
        let case = args.case.load()?;
        if args.steady && case.setup.air.keeps_wake() && ElasticRig::covers(&case.setup) {
            announce!(
                "{}: looking for the steady state in a wake; this takes minutes",
                case.name
            );
        }
        let found = watched("modes", || wing_modes(&case.setup, about, args.count))?;
        let wings = &case.setup.animal.wings;
        let free = case
            .setup
            .joints
            .iter()
            .filter(|j| j.model.kind.directions() > 0);
        let hinged: Vec<usize> = free.map(|j| j.child).collect();
        tell(report, (&case.name, args.steady), wings, &hinged, &found);
        let value = |w: &WingModes| values(&wings[w.wing], w);
        report.value("case", case.name.as_str());
        report.value("about", if args.steady { "steady" } else { "rest" });
        report.value("wings", found.iter().map(value).collect::<Vec<_>>());
        match shapes {
            Some(file) => Ok(file.write(&csv(wings, &found))?),
            None => Ok(()),
        }
    })
}

/// `hinged`: bodies that turn or slide on free joints.
fn tell(
    report: &mut Report,
    (name, steady): (&str, bool),
    wings: &[Wing],
    hinged: &[usize],
    found: &[WingModes],
) {
    let about = match steady {
        true => "the deformed steady state",
        false => "the wing at rest",
    };
    line!(report, "{name}: modes of elastic wings about {about}");
    for (k, w) in found.iter().enumerate() {
        let wing = &wings[w.wing];
        if let Some(first) = found[..k].iter().find(|f| is_same(f, w)) {
            let first = &wings[first.wing].name;
            line!(report, "\nwing {}: as {first}", wing.name);
            continue;
        }
        line!(report, "\nwing {}, {:.4e} kg", wing.name, w.mass);
        if hinged.contains(&(w.wing + 1)) {
            line!(
                report,
                "  its hinge is held: what turns about it freely vibrates otherwise"
            );
        }
        let deflection = w.deflection.iter().map(|d| d.length());
        if steady {
            let most = deflection.fold(0.0, f64::max);
            line!(report, "  bent by at most {most:.4e} m");
        }
        if let Some(bent) = w.bent_by_weight.filter(|bent| *bent > FAR) {
            line!(
                report,
                "  weight is left out: across the wing it would bend it by some {bent:.2} of its length, were that linear; --steady has the modes about the bent wing"
            );
        }
        table(report, "in vacuum", wing, &w.vacuum, None);
        tell_left_out(report, w.left_out[0]);
        tell_mixed(report, &w.mixed);
        if w.turning_growth > 0.0 {
            line!(
                report,
                "  some of these grow, by up to {:.3e} 1/s: the sheet buckles between its nodes, and this state is no stable equilibrium",
                w.turning_growth
            );
        }
        if let Some(air) = &w.air {
            let title = "with the added mass of the air";
            table(report, title, wing, air, Some(&w.alike));
            tell_left_out(report, w.left_out[1]);
        }
    }
    line!(
        report,
        "\n  tip: displacement where the largest is 1; w3 and w1 of the middle of the tip, twist: trailing less leading edge along w3"
    );
}

fn tell_left_out(report: &mut Report, count: usize) {
    if count > 0 {
        line!(
            report,
            "  left out below the last: {count} in which nodes turn and nothing moves, of the elements and not of the film"
        );
    }
}

/// Frequencies about which waves of the sheet are missing from the table.
fn tell_mixed(report: &mut Report, mixed: &[f64]) {
    if mixed.is_empty() {
        return;
    }
    let hz: Vec<String> = mixed.iter().map(|w| format!("{:.1}", w / TAU)).collect();
    line!(
        report,
        "  of these, modes of {} Hz move, too: waves of the sheet mixed with turns of nearly their frequency, which are missing above and lie \
         near them; take another mesh, or a smaller structure.shell.bending_factor",
        hz.join(", ")
    );
}

fn is_same(a: &WingModes, b: &WingModes) -> bool {
    let near =
        |(a, b): (&WingMode, &WingMode)| (a.frequency - b.frequency).abs() <= SAME * a.frequency;
    let all = |a: &[WingMode], b: &[WingMode]| a.len() == b.len() && a.iter().zip(b).all(near);
    let [air_a, air_b] = [a, b].map(|w| w.air.as_deref().unwrap_or_default());
    all(&a.vacuum, &b.vacuum) && all(air_a, air_b)
}

/// One line a mode; `alike`: the modes in vacuum that these are most alike.
fn table(
    report: &mut Report,
    title: &str,
    wing: &Wing,
    modes: &[WingMode],
    alike: Option<&[Alike]>,
) {
    let beat = wing.motion.frequency;
    let per_beat = if beat > 0.0 { "x wingbeat" } else { "" };
    let like = if alike.is_some() { "like vacuum" } else { "" };
    line!(report, "  {title}");
    line!(
        report,
        "  {:>6}{:>12}{per_beat:>12}{:>12}{:>9}{:>9}{:>9}  {like}",
        "mode",
        "Hz",
        "modal kg",
        "tip w3",
        "w1",
        "twist"
    );
    for (k, m) in modes.iter().enumerate() {
        let [w3, w1, twist] = tip(wing, m);
        let hz = m.frequency / TAU;
        let ratio = match beat > 0.0 {
            true => format!("{:.3}", hz / beat),
            false => String::new(),
        };
        let like = alike.map_or(String::new(), |all| match all[k] {
            Alike { likeness, .. } if likeness < ALIKE => "none".to_owned(),
            Alike { mode, likeness } => format!("mode {} ({likeness:.2})", mode + 1),
        });
        line!(
            report,
            "  {:>6}{:>12}{ratio:>12}{:>12.3e}{w3:>9.3}{w1:>9.3}{twist:>9.3}  {like}",
            k + 1,
            if m.growth > 0.0 {
                "grows".to_owned()
            } else {
                hertz(hz)
            },
            m.mass
        );
    }
    if let Some(fastest) = modes
        .iter()
        .map(|m| m.growth)
        .reduce(f64::max)
        .filter(|g| *g > 0.0)
    {
        line!(
            report,
            "  the state is no stable equilibrium: a mode grows by {fastest:.4} per s (a sheet under tension buckles where it is pushed together)"
        );
    }
}

/// A frequency with four digits or more behind the point, or five that count where it is small.
fn hertz(hz: f64) -> String {
    match hz > 0.0 && hz < 0.1 {
        true => format!("{hz:.4e}"),
        false => format!("{hz:.4}"),
    }
}

/// At the tip: w3 and w1 of the middle, w3 of the trailing less that of the leading edge.
fn tip(wing: &Wing, m: &WingMode) -> [f64; 3] {
    let mesh = &wing.mesh;
    let [lead, trail] = [0, mesh.rows].map(|i| m.displacement[mesh.node(i, mesh.cols)]);
    let middle = 0.5 * (lead + trail);
    [middle.z, middle.x, trail.z - lead.z]
}

fn values(wing: &Wing, w: &WingModes) -> Value {
    let mode = |m: &WingMode| {
        let [w3, w1, twist] = tip(wing, m);
        json!({
            "frequency_hz": m.frequency / TAU,
            "growth_per_s": m.growth,
            "modal_mass_kg": m.mass,
            "tip_w3": w3,
            "tip_w1": w1,
            "tip_twist": twist,
        })
    };
    let air = |all: &Vec<WingMode>| -> Vec<Value> {
        let each = all.iter().zip(&w.alike).map(|(m, alike)| {
            let mut value = mode(m);
            value["like_vacuum_mode"] = json!(alike.mode + 1);
            value["likeness"] = json!(alike.likeness);
            value
        });
        each.collect()
    };
    let deflection = w.deflection.iter().map(|d| d.length());
    json!({
        "name": wing.name,
        "mass_kg": w.mass,
        "deflection_m": deflection.fold(0.0, f64::max),
        "tip_by_weight_over_length": w.bent_by_weight,
        "vacuum": w.vacuum.iter().map(mode).collect::<Vec<_>>(),
        "air": w.air.as_ref().map(air),
        "vacuum_left_out": w.left_out[0],
        "air_left_out": w.left_out[1],
        "vacuum_left_out_mixed_hz": w.mixed.iter().map(|w| w / TAU).collect::<Vec<_>>(),
        "left_out_growth_per_s": w.turning_growth,
    })
}

/// All shapes, a line a node of the mesh.
fn csv(wings: &[Wing], found: &[WingModes]) -> String {
    let mut text =
        "wing,medium,mode,frequency_hz,node,w1_m,w2_m,w3_m,shape_w1,shape_w2,shape_w3\n".to_owned();
    for w in found {
        let name = &wings[w.wing].name;
        let air = w.air.as_deref().unwrap_or_default();
        for (medium, modes) in [("vacuum", &w.vacuum[..]), ("air", air)] {
            for (k, m) in modes.iter().enumerate() {
                let hz = m.frequency / TAU;
                for (n, (x, d)) in w.nodes.iter().zip(&m.displacement).enumerate() {
                    let [x, d] = [x, d].map(|v| format!("{:e},{:e},{:e}", v.x, v.y, v.z));
                    let _ = writeln!(text, "{name},{medium},{},{hz:e},{n},{x},{d}", k + 1);
                }
            }
        }
    }
    text
}
