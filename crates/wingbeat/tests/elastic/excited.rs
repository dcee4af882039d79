//! Torsion of a wing in a stream, in quasi-steady blade elements: what the moments of the air make of it.

use std::f64::consts::PI;

use wingbeat::case::LoadedCase;
use wingbeat::flight::{DoubtKind, Simulation};

use crate::support::case_of;

/// A clamped even wing that bends little and twists about 0.4 of its chord, in thin-airfoil strips.
const CASE: &str = r#"
format = 1
name = "torsion"
gravity_m_s2 = [0, 0, 0]
[time]
step_s = 0.00025
steps = 900
[flight]
mode = "tethered"
[air]
model = "blade_element"
density_kg_m3 = 1.225
stream_m_s = [-5, 0, 0]
blade.own = { lift = 3.141592653589793, drag_0 = 0, drag_90 = 0 }
blade.centre_of_pressure.fixed = 0.25
[body]
mass_kg = 1.0
inertia_about_centre_kg_m2 = [1, 1, 1, 0, 0, 0]
[wing.right]
hinge_m = [0, 0, 0]
motion.psi.constant_deg = 0.2
mirror = false
planform.rectangle = { chord_m = 0.08, span_m = 0.3, axis_fraction = 0.25 }
[wing.right.mesh]
chordwise = 1
spanwise = 10
[wing.right.structure]
spectral_radius = 1.0
[wing.right.structure.beam]
axis_fraction = 0.4
mass_fraction = 0.4
elements = 10
flap_newton_m2 = [2000, 2000]
torsion_newton_m2 = [0.1, 0.1]
mass_kg_per_m = [0.0133, 0.0133]
"#;

/// The circulation of feathering as thin-airfoil theory has it about a quarter of the chord, without its couple.
const NO_COUPLE: &str = "air.blade.rotation_coefficient=1.5707963267948966";

fn case(set: &[&str]) -> LoadedCase {
    case_of("torsion", CASE, set)
}

/// Growth [1/s] and angular frequency [rad/s] of the twist of the tip about its mean, from the first and last third.
fn growth(set: &[&str]) -> [f64; 2] {
    let setup = case(set).setup;
    let step = setup.time.step;
    let mut flight = Simulation::new(setup).unwrap();
    let mut twist = vec![];
    while !flight.finished() {
        twist.push(flight.step().unwrap().elastic[0].twist);
    }
    // Instants at which it goes up through its mean, interpolated: whole periods lie between.
    let mean = twist.iter().sum::<f64>() / twist.len() as f64;
    let crossings: Vec<f64> = (1..twist.len())
        .filter(|&k| twist[k - 1] < mean && twist[k] >= mean)
        .map(|k| k as f64 - (twist[k] - mean) / (twist[k] - twist[k - 1]))
        .collect();
    let periods = crossings.len() - 1;
    let amplitude = |first: usize| {
        let [from, to] = [crossings[first], crossings[first + periods / 3]].map(|x| x as usize);
        let part = &twist[from..to];
        let mean = part.iter().sum::<f64>() / part.len() as f64;
        let square = part.iter().map(|x| (x - mean).powi(2)).sum::<f64>();
        (square / part.len() as f64).sqrt()
    };
    let later = periods - periods / 3;
    let way = (crossings[later] - crossings[0]) * step;
    let period = (crossings[periods] - crossings[0]) * step / periods as f64;
    [
        (amplitude(later) / amplitude(0)).ln() / way,
        2.0 * PI / period,
    ]
}

/// Torsion of an even wing about an axis `a` c behind the leading edge in strips whose normal force of translation is
/// `2 pi slope` times the angle and acts `x_cp` c behind the edge: a mode of a quarter of a sine wave, with the moment per
/// span `pi rho c^2 U^2 slope (a - x_cp)` by the angle, `pi rho c^3 U k` by its rate and
/// `pi rho c^4 ((1/2 - a)^2 + 1/32)/4` by its acceleration.
fn exact_of(a: f64, [slope, x_cp]: [f64; 2], k: f64) -> [f64; 2] {
    let (rho, u, c): (f64, f64, f64) = (1.225, 5.0, 0.08);
    let inertia =
        0.0133 * c * c / 12.0 + 0.25 * PI * rho * c.powi(4) * ((0.5 - a).powi(2) + 1.0 / 32.0);
    let stiffness =
        0.1 * (0.5 * PI / 0.3_f64).powi(2) - PI * rho * c * c * u * u * slope * (a - x_cp);
    let growth = 0.5 * PI * rho * c.powi(3) * u * k / inertia;
    [growth, (stiffness / inertia - growth * growth).sqrt()]
}

/// The same of thin-airfoil strips about 0.4 of the chord.
fn exact(k: f64) -> [f64; 2] {
    exact_of(0.4, [1.0, 0.25], k)
}

#[test]
fn exact_torsion_grows_without_the_couple_of_feathering_and_decays_with_it() {
    let a = 0.4;
    let circulation = (a - 0.25) * (0.75 - a) - 0.25 * (0.5 - a);
    let cases = [
        (NO_COUPLE, circulation),
        (
            "air.blade.rotation=\"circulation\"",
            circulation - 1.0 / 16.0,
        ),
        (
            "air.blade.rotation=\"none\"",
            (a - 0.25) * (0.25 - a) - 0.25 * (0.5 - a), // the force follows the downwash of the feathering axis
        ),
    ];
    for (set, k) in cases {
        let [[growth, omega], [g, o]] = [growth(&[set]), exact(k)];
        println!("{set}: growth {growth:.3} {g:.3}, frequency {omega:.2} {o:.2}");
        // Ten elements and strips along a quarter of a wave, 45 steps a period: 1 % and 0.2 %.
        assert!((growth / g - 1.0).abs() < 0.02, "{set}: {growth} {g}");
        assert!((omega / o - 1.0).abs() < 0.005, "{set}: {omega} {o}");
    }
}

/// What is said of the torsion of the wing with these keys set.
fn doubted(set: &[&str]) -> Option<String> {
    let doubts = case(set).setup.doubts();
    let mut of_torsion = doubts
        .into_iter()
        .filter(|d| d.kind == DoubtKind::ExcitedTorsion);
    of_torsion.next().map(|d| d.said)
}

/// The default coefficients have less lift, and the drag at no incidence counts as lift does: with the moment
/// against feathering, too, torsion grows ahead of mid chord, the more the farther the centre of pressure is ahead; without
/// any circulation of feathering, about an axis ahead of that of feathering.
#[test]
fn exact_torsion_of_measured_coefficients_is_doubted_where_it_grows() {
    let slope = (3.3207 + 0.4123) / (2.0 * PI);
    let (moment, none) = (1.0 / 16.0, "air.blade.rotation=\"none\"");
    for (a, x0, x_cp, rotation) in [
        (0.40, 0.0, 0.25, ""),
        (0.43, 0.0, 0.25, ""),
        (0.43, 0.25, 0.25, ""),
        (0.465, 0.25, 0.25, ""),
        (0.30, 0.0, 0.05, ""),
        (0.45, 0.0, 0.35, ""),
        (0.45, 0.75, 0.25, none),
        (0.50, 0.25, 0.25, none),
    ] {
        let circulation = if rotation.is_empty() { 0.75 - x0 } else { 0.0 };
        let couple = if rotation.is_empty() { moment } else { 0.0 };
        let k = (a - x_cp) * (slope * (x0 - a) + circulation) - 0.25 * (0.5 - a) - couple;
        let beam = "wing.right.structure.beam";
        let keys = [
            format!("{beam}.axis_fraction={a}"),
            format!("{beam}.mass_fraction={a}"),
            format!("wing.right.planform.rectangle.axis_fraction={x0}"),
            format!("air.blade.centre_of_pressure.fixed={x_cp}"),
            "air.blade.own={lift=1.66035,drag_0=0.4123,drag_90=3.5793}".to_owned(),
            // Motions that grow stay linear.
            "wing.right.motion.psi.constant_deg=0.02".to_owned(),
            rotation.to_owned(),
        ];
        let set: Vec<&str> = keys
            .iter()
            .map(|k| &k[..])
            .filter(|k| !k.is_empty())
            .collect();
        let ([grown, omega], [g, o]) = (growth(&set), exact_of(a, [slope, x_cp], k));
        println!(
            "{a} {x0} {x_cp} {rotation}: growth {grown:.3} {g:.3}, frequency {omega:.2} {o:.2}"
        );
        // Errors of strips, elements and steps as above.
        assert!(
            (grown - g).abs() < 0.02 * g.abs(),
            "{a} {x0} {x_cp}: {grown} {g}"
        );
        assert!(
            (omega / o - 1.0).abs() < 0.005,
            "{a} {x0} {x_cp}: {omega} {o}"
        );
        assert_eq!(
            doubted(&set).is_some(),
            g > 0.0,
            "{a} {x0} {x_cp} {rotation}"
        );
    }
}

/// Air from behind meets the trailing edge: torsion grows and decays as of the wing turned round, whose axes are as far
/// behind the edge in front, on both sides of mid chord.
#[test]
fn exact_torsion_in_air_from_behind_is_doubted_where_it_grows() {
    for (a, x0) in [(0.40, 0.25), (0.45, 0.25), (0.55, 0.25), (0.55, 0.6)] {
        let k = (a - 0.25) * (0.75 - a) - 0.25 * (0.5 - a) - 1.0 / 16.0;
        let beam = "wing.right.structure.beam";
        let keys = [
            format!("{beam}.axis_fraction={}", 1.0 - a),
            format!("{beam}.mass_fraction={}", 1.0 - a),
            format!("wing.right.planform.rectangle.axis_fraction={}", 1.0 - x0),
            "air.stream_m_s=[5,0,0]".to_owned(),
            "wing.right.motion.psi.constant_deg=0.02".to_owned(),
        ];
        let set: Vec<&str> = keys.iter().map(|k| &k[..]).collect();
        let ([grown, omega], [g, o]) = (growth(&set), exact_of(a, [1.0, 0.25], k));
        println!("{a} {x0} behind: growth {grown:.3} {g:.3}, frequency {omega:.2} {o:.2}");
        // Errors of strips, elements and steps as above.
        assert!((grown - g).abs() < 0.02 * g.abs(), "{a} {x0}: {grown} {g}");
        assert!((omega / o - 1.0).abs() < 0.005, "{a} {x0}: {omega} {o}");
        let said = doubted(&set);
        assert_eq!(said.is_some(), g > 0.0, "{a} {x0}: {said:?}");
    }
}

/// Wakes follow the downwash of theory, which less lift answers: with default coefficients they do not damp all that
/// the circulation of feathering drives. Moments by Theodorsen's function 1/2, slow air.
#[test]
fn limit_torsion_that_wakes_do_not_damp_is_doubted() {
    let slope = (3.3207 + 0.4123) / (2.0 * PI);
    for (a, x0) in [(0.42, 0.0), (0.47, 0.0), (0.46, 0.25), (0.52, 0.25)] {
        let circulation = 0.75 - x0;
        let downwash = 0.5 * (x0 - a) - 0.5 * circulation;
        let k = (a - 0.25) * (slope * downwash + circulation) - 0.25 * (0.5 - a) - 1.0 / 16.0;
        let beam = "wing.right.structure.beam";
        let keys = [
            format!("{beam}.axis_fraction={a}"),
            format!("{beam}.mass_fraction={a}"),
            format!("wing.right.planform.rectangle.axis_fraction={x0}"),
            "air.blade.own={lift=1.66035,drag_0=0.4123,drag_90=3.5793}".to_owned(),
            "air.blade.unsteady=\"peters\"".to_owned(),
        ];
        let set: Vec<&str> = keys.iter().map(|k| &k[..]).collect();
        let ([grown, _], [g, _]) = (growth(&set), exact_of(a, [slope, 0.25], k));
        println!("{a} {x0} wakes: growth {grown:.3} {g:.3}");
        // The reduced frequency is 4.5, Theodorsen's function 0.507 - 0.027 i: 0.25 and less.
        assert!((grown - g).abs() < 0.5, "{a} {x0}: {grown} {g}");
        let said = doubted(&set);
        assert_eq!(said.is_some(), g > 0.0, "{a} {x0}: {said:?}");
        assert!(said.is_none_or(|s| s.contains("axis_fraction")), "{a} {x0}");
    }
}

/// Damping of rates of strain takes `tau G J (pi / 2 L)^2 / 2` over the inertia, as much as the air gives at
/// the border: on both sides of it torsion does what is said of it.
#[test]
fn exact_damped_torsion_is_doubted_where_it_grows() {
    let (rho, u, c, a): (f64, f64, f64, f64) = (1.225, 5.0, 0.08, 0.4);
    let k = (a - 0.25) * (0.75 - a) - 0.25 * (0.5 - a);
    let border = PI * rho * c.powi(3) * u * k / (0.1 * (0.5 * PI / 0.3_f64).powi(2));
    let undamped = exact(k)[0];
    for part in [0.8, 1.2] {
        let damping = format!("wing.right.structure.damping_s={}", part * border);
        let grown = growth(&[NO_COUPLE, &damping])[0];
        println!("{part} of {border:e}: {grown} {}", (1.0 - part) * undamped);
        // Two differences of 1 % each.
        assert!(
            (grown - (1.0 - part) * undamped).abs() < 0.02 * undamped,
            "{part}: {grown}"
        );
        assert_eq!(
            doubted(&[NO_COUPLE, &damping]).is_some(),
            part < 1.0,
            "{part}"
        );
    }
    // Ten strips of a quarter of a wave.
    for (part, grows) in [(0.97, true), (1.03, false)] {
        let damping = format!("wing.right.structure.damping_s={}", part * border);
        assert_eq!(doubted(&[NO_COUPLE, &damping]).is_some(), grows, "{part}");
    }
}

#[test]
fn behaves_undamped_torsion_in_quasi_steady_strips_is_doubted() {
    assert_eq!(doubted(&[]), None);
    let said = doubted(&[NO_COUPLE]).unwrap();
    assert!(
        said.contains("without rotation_coefficient") && said.contains("`right`"),
        "{said}"
    );
    assert_eq!(doubted(&["air.blade.rotation=\"none\""]), None);
    for remedy in [
        "air.blade.unsteady=\"peters\"",
        "wing.right.structure.damping_s=1.1e-4",
    ] {
        assert_eq!(doubted(&[NO_COUPLE, remedy]), None, "{remedy}");
    }
    let forward = ["axis", "mass"].map(|k| format!("wing.right.structure.beam.{k}_fraction=0.25"));
    assert_eq!(doubted(&[NO_COUPLE, &forward[0], &forward[1]]), None);
    assert!(doubted(&[NO_COUPLE, &forward[0]]).is_some());
    let behind = "wing.right.structure.beam.axis_fraction=0.6";
    let said = doubted(&[behind]).unwrap();
    assert!(
        said.contains("so far behind the centre of pressure"),
        "{said}"
    );
    // What stays with the moment of the default is for wakes.
    let said = doubted(&[NO_COUPLE, behind]).unwrap();
    assert!(
        !said.contains("circulation") && said.contains("peters"),
        "{said}"
    );
}
