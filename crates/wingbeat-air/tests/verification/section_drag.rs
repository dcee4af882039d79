//! Drag of the sections, and wakes from side edges.

use crate::common::{fly, rectangle, total_force, translating, with_leading_edges};
use wingbeat_air::{
    AirSettings, EdgeKind, Friction, Lattice, LeadingEdge, NodeMotion, SectionDrag, SheddingKinds,
    Surface, VortexLift,
};
use wingbeat_math::{DVec3, r2};

const RHO: f64 = 1.2;
const NU: f64 = 1.5e-5;

fn with(drag: Option<SectionDrag>, stream: DVec3) -> AirSettings {
    AirSettings {
        section_drag: drag,
        ..AirSettings::benchmark(RHO, stream)
    }
}

const BLASIUS: SectionDrag = SectionDrag {
    friction: Friction::Blasius { viscosity: NU },
    cd0: 0.0,
    cd2: 0.0,
};

/// Force and power of the air on a wing of chord 0.1 and span 0.3 after three steps.
fn drag(settings: AirSettings, alpha: f64, velocity: DVec3) -> (DVec3, f64) {
    let lattice = Lattice::new(vec![Surface::grid("wing", 3, 5)], settings).unwrap();
    let places: Vec<DVec3> = rectangle(3, 5, 0.1 * DVec3::X, 0.3 * DVec3::Y)
        .into_iter()
        .map(|x| r2(alpha) * x)
        .collect();
    let motion = |t: f64| translating(places.iter().map(|x| *x + t * velocity).collect(), velocity);
    let run = fly(&lattice, motion, 0.01, 2, |_, _, _, _| {}).unwrap();
    let loads = &run.loads;
    let power = loads.force.iter().zip(&loads.panels.velocity);
    (total_force(loads), power.map(|(f, v)| f.dot(*v)).sum())
}

#[test]
fn exact_friction_of_a_flat_plate_along_the_stream() {
    let speed = 4.0;
    let (force, _) = drag(with(Some(BLASIUS), speed * DVec3::X), 0.0, DVec3::ZERO);
    let reynolds = speed * 0.1 / NU;
    let coefficient = 1.328 / reynolds.sqrt() + 2.67 / reynolds.powf(0.875);
    let closed = 0.5 * RHO * speed * speed * 0.1 * 0.3 * 2.0 * coefficient;
    assert!((force.x / closed - 1.0).abs() < 1e-12, "{force} {closed}"); // roundings
    assert!(force.y.abs() + force.z.abs() < 1e-14);
    // A plate that moves through still air at the same speed: the same, and its power.
    let velocity = -speed * DVec3::X;
    let (moving, power) = drag(with(Some(BLASIUS), DVec3::ZERO), 0.0, velocity);
    assert!((moving - force).length() < 1e-12 * closed);
    assert!((power + closed * speed).abs() < 1e-12 * closed * speed);
    // On the way back the force is reversed and takes the same power.
    let (back, taken) = drag(with(Some(BLASIUS), DVec3::ZERO), 0.0, -velocity);
    assert!((back + moving).length() < 1e-12 * closed);
    assert!((taken - power).abs() < 1e-12 * closed * speed);
}

/// Friction acts along the surface alone: at incidence that of the velocity's part along it, broadside on none.
#[test]
fn exact_friction_acts_along_the_surface() {
    let (alpha, speed) = (0.6_f64, 4.0);
    let added = |alpha: f64, speed: f64| {
        let of = |d| drag(with(d, speed * DVec3::X), alpha, DVec3::ZERO).0;
        of(Some(BLASIUS)) - of(None)
    };
    let along = r2(alpha) * DVec3::X;
    let flat = added(0.0, speed * alpha.cos()).x;
    assert!((added(alpha, speed) - flat * along).length() < 1e-11 * flat); // roundings of the pressures
    assert!(added(0.5 * std::f64::consts::PI, speed).length() < 1e-8 * flat); // 1.6e-16 to the 9/8
}

/// The face that the flow leaves at the leading edge has as much friction as the edge holds: all, none, or the
/// threshold over the suction parameter of the plate.
#[test]
fn exact_friction_where_leading_edges_shed() {
    let (alpha, speed) = (0.5_f64, 4.0);
    let hold = |threshold: f64| LeadingEdge::Suction {
        threshold,
        efficiency: 0.0,
    };
    let vortex_lift = LeadingEdge::VortexLift(VortexLift {
        threshold: 0.2,
        ..VortexLift::default()
    });
    let along = r2(alpha) * DVec3::X;
    let added = |leading: LeadingEdge| {
        let of = |d| {
            let settings = AirSettings {
                density: RHO,
                section_drag: d,
                ..with_leading_edges(leading, speed * DVec3::X)
            };
            drag(settings, alpha, DVec3::ZERO).0
        };
        let force = of(Some(BLASIUS)) - of(None);
        assert!((force - force.dot(along) * along).length() < 1e-10 * force.length());
        force.dot(along)
    };
    let attached = added(LeadingEdge::Never);
    for (leading, part) in [
        (LeadingEdge::Always, 0.5),
        (LeadingEdge::AngleOfAttack { threshold: 0.6 }, 1.0),
        (LeadingEdge::AngleOfAttack { threshold: 0.4 }, 0.5),
        (hold(0.9), 1.0),
        (hold(0.2), 0.5 + 0.1 / alpha.sin()),
        (vortex_lift, 0.5 + 0.1 / alpha.sin()),
    ] {
        let felt = added(leading) / attached;
        assert!((felt - part).abs() < 1e-9, "{leading:?}: {felt}, {part}"); // roundings of the pressures
    }
}

/// One side of a plate along the stream: Janour's experiments in oil, 2.90 / Re^0.601 from Re = 12 to 2335
/// [Janour 1951, NACA TM 1316], which scatter by some per cent, and solutions of the Navier-Stokes equations.
#[test]
fn published_friction_of_plates_at_low_reynolds_numbers() {
    let law =
        |reynolds: f64| 0.5 * BLASIUS.speed_times_friction(reynolds * NU, 1.0) / reynolds / NU;
    for (reynolds, solution) in [
        (40.0, 0.311),
        (100.0, 0.180),
        (400.0, 0.0812),
        (1000.0, 0.0496),
    ] {
        let (law, janour) = (law(reynolds), 2.90 / reynolds.powf(0.601));
        println!("Re {reynolds}: {law:.4}, Navier-Stokes {solution:.4}, Janour {janour:.4}");
        assert!((law / solution - 1.0).abs() < 0.04);
        assert!((law / janour - 1.0).abs() < 0.07);
    }
}

#[test]
fn exact_polar_is_added_along_the_wind_and_nothing_else_changes() {
    let (alpha, speed) = (0.15_f64, 3.0);
    let polar = SectionDrag {
        friction: Friction::None,
        cd0: 0.02,
        cd2: 0.7,
    };
    let still = -speed * DVec3::X;
    let accurate = |d, u| AirSettings {
        section_drag: d,
        ..AirSettings::accurate(RHO, u)
    };
    let both: [fn(Option<SectionDrag>, DVec3) -> AirSettings; 2] = [with, accurate];
    for settings in both {
        let (without, _) = drag(settings(None, DVec3::ZERO), alpha, still);
        let (force, power) = drag(settings(Some(polar), DVec3::ZERO), alpha, still);
        let (added, closed) = (force - without, 0.02 + 0.7 * alpha * alpha);
        // Roundings; the area is that of the wing, though the rings of the accurate scheme are smaller.
        let area = added.x / (0.5 * RHO * speed * speed * closed);
        assert!((area / 0.03 - 1.0).abs() < 1e-11, "{area}");
        assert!(added.y.abs() + added.z.abs() < 1e-11 * added.x);
        assert!((power - without.dot(still) + added.x * speed).abs() < 1e-12 * power.abs());
    }
}

#[test]
fn refuses_drag_without_sense() {
    let says = |drag: SectionDrag, what: &str| {
        let wing = vec![Surface::grid("wing", 1, 1)];
        let error = Lattice::new(wing, with(Some(drag), DVec3::X)).unwrap_err();
        assert!(error.to_string().contains(what), "{error}");
    };
    let viscosity = |viscosity: f64| SectionDrag {
        friction: Friction::Blasius { viscosity },
        ..BLASIUS
    };
    says(viscosity(0.0), "viscosity");
    says(viscosity(f64::NAN), "viscosity");
    says(
        SectionDrag {
            cd0: -0.1,
            ..BLASIUS
        },
        "cd0",
    );
    says(
        SectionDrag {
            cd2: f64::INFINITY,
            ..BLASIUS
        },
        "cd2",
    );
}

/// A wing that sheds from both side edges is the same seen from either side.
#[test]
fn invariant_root_sheds_as_the_tip_does() {
    let kinds = SheddingKinds {
        trailing: true,
        tip: true,
        leading: false,
        root: true,
    };
    let settings = AirSettings {
        shedding: kinds,
        ..AirSettings::benchmark(RHO, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 3, 6)], settings).unwrap();
    // Tip, trailing edge and root in one sheet.
    assert_eq!(lattice.sheets().len(), 1);
    let kinds = &lattice.sheets()[0].kinds;
    assert_eq!((kinds[0], kinds[11]), (EdgeKind::Tip, EdgeKind::Root));
    let places: Vec<DVec3> = rectangle(3, 6, DVec3::X, 2.0 * DVec3::Y)
        .into_iter()
        .map(|x| r2(0.2) * (x - DVec3::Y))
        .collect();
    let motion = |_: f64| -> NodeMotion { translating(places.clone(), DVec3::ZERO) };
    let mut run = fly(&lattice, motion, 0.2, 10, |_, _, _, _| {}).unwrap();
    let gamma = &run.loads.gamma;
    for (p, g) in gamma.iter().enumerate() {
        let other = gamma[p / 6 * 6 + 5 - p % 6];
        assert!((g - other).abs() < 1e-10 * gamma[2].abs()); // roundings in a free wake
    }
    // The newest rings continue the panels they leave, at the root too.
    let before = run.state.gamma.clone();
    lattice.convect(&mut run.state, 0.2, &mut run.ws).unwrap();
    let (sheet, root) = (&run.state.sheets[0], &lattice.sheets()[0]);
    let newest = &sheet.gamma[sheet.gamma.len() - sheet.columns..];
    for c in 0..12 {
        assert_eq!(newest[c], root.signs[c] * before[root.panels[c]]);
    }
    assert!(newest[11].abs() > 1e-3);
}
