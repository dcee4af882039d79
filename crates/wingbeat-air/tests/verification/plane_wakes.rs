//! Plane flow: rows of wake that stay straight.

use crate::common::{fly, rectangle, total_force, translating, with_leading_edges};
use wingbeat_air::{
    AirSettings, AirState, CoreModel, JoinedEdge, Lattice, LeadingEdge, Plane, SheddingKinds,
    Surface,
};
use wingbeat_math::{DVec3, r2};

const SPAN: f64 = 50.0;

/// A unit stream along x beside a wall at the root, cores of 0.02 chords.
fn settings(plane_wakes: bool) -> AirSettings {
    AirSettings {
        plane_wakes,
        images: vec![Plane {
            point: DVec3::ZERO,
            normal: DVec3::Y,
        }],
        ..AirSettings::accurate(1.0, DVec3::X).with_cut_off_for(2.0)
    }
}

/// A plate of one panel along the span that plunges two beats at a Strouhal number of 0.6.
fn plunge(plane_wakes: bool) -> AirState {
    let flat = rectangle(6, 1, DVec3::X, SPAN * DVec3::Y);
    let lattice = Lattice::new(vec![Surface::grid("plate", 6, 1)], settings(plane_wakes)).unwrap();
    let (heave, omega) = (0.2, 3.0 * std::f64::consts::PI);
    let motion = |t: f64| {
        let at = heave * (omega * t).cos() * DVec3::Z;
        let velocity = -heave * omega * (omega * t).sin() * DVec3::Z;
        translating(flat.iter().map(|x| *x + at).collect(), velocity)
    };
    fly(&lattice, motion, 1.0 / 60.0, 80, |_, _, _, _| {})
        .unwrap()
        .state
}

/// How far the two ends of a row part at most across the span, and how far they leave their planes \[chords\].
fn parting(state: &AirState) -> [f64; 2] {
    let sheet = &state.sheets[0];
    let ends = (0..sheet.rows()).map(|r| [sheet.node(r, 0), sheet.node(r, 1)]);
    ends.fold([0.0, 0.0], |[apart, along], [a, b]| {
        let d = b - a;
        let off = [a, b].map(|x| x.y.abs().min((x.y - SPAN).abs()));
        [
            f64::max(apart, d.x.hypot(d.z)),
            off.into_iter().fold(along, f64::max),
        ]
    })
}

#[test]
fn invariant_rows_of_plane_wakes_stay_straight_and_across_the_flow() {
    let plane = parting(&plunge(true));
    assert!(plane.iter().all(|x| *x < 1e-11), "{plane:?}"); // roundings of 50 chords, 80 steps
    // Without it the wake moves half as fast at the free end of the plate as at the wall.
    let free = parting(&plunge(false));
    assert!(free[0] > 0.02, "{free:?}");
}

#[test]
fn refuses_plane_wakes_of_side_edges() {
    let shedding = SheddingKinds {
        tip: true,
        ..SheddingKinds::TRAILING
    };
    let wing = vec![Surface::grid("plate", 6, 1)];
    let settings = AirSettings {
        shedding,
        ..settings(true)
    };
    let error = Lattice::new(wing, settings).unwrap_err().to_string();
    assert!(error.contains("plane_wakes"), "{error}");
}

/// A section of one panel along the span and 4 along the chord whose leading edge sheds what it does not hold.
fn separated(max_rows: Option<usize>) -> Lattice {
    let core = |radius: f64| CoreModel::Algebraic {
        radius,
        viscosity: 0.0,
    };
    let held = LeadingEdge::SuctionImplicit {
        threshold: 0.15,
        efficiency: 0.0,
    };
    let settings = AirSettings {
        plane_wakes: true,
        bound_core: core(0.01),
        wake_core: core(0.07),
        wake_overlap: 1.0,
        clearance: 0.1,
        max_rows,
        ..with_leading_edges(held, DVec3::X)
    };
    Lattice::new(vec![Surface::grid("plate", 4, 1)], settings).unwrap()
}

/// Such a section of this span at 8 deg in a unit stream that plunges by half a chord at a reduced frequency of 0.5, and
/// so sheds more vorticity of one sign; on its way back in every period the rings have gained circulation.
fn gaining(span: f64, periods: usize) -> Vec<[f64; 2]> {
    const STEPS: usize = 60;
    let lattice = separated(None);
    let chord = r2(8.0_f64.to_radians()) * DVec3::X;
    let flat = rectangle(4, 1, chord, span * DVec3::Y);
    let omega = 1.0; // twice the reduced frequency
    let dt = std::f64::consts::TAU / omega / STEPS as f64;
    let motion = |t: f64| {
        let at = 0.5 * (omega * t).cos() * DVec3::Z;
        let velocity = -0.5 * omega * (omega * t).sin() * DVec3::Z;
        translating(flat.iter().map(|x| *x + at).collect(), velocity)
    };
    let mut seen = vec![];
    fly(&lattice, motion, dt, periods * STEPS, |_, _, loads, _| {
        seen.push([total_force(loads).z, loads.impulse.z].map(|x| x / span));
    })
    .unwrap();
    seen
}

/// The gain of circulation runs along the ends of a section, which plane flow has not: a section of 30 chords has the
/// lift of one of 3000, to the square of the chord over the span. With ends that move air mean lifts of the third period
/// are 0.58 and 0.19.
#[test]
fn limit_lift_of_sections_that_gain_circulation_does_not_hang_on_their_span() {
    let mean = |span: f64| {
        let seen = gaining(span, 3);
        let last = &seen[seen.len() - 60..];
        last.iter().map(|[force, _]| force).sum::<f64>() / 60.0
    };
    let [short, long] = [30.0, 3000.0].map(mean);
    println!("mean lift of the third period: {short} {long}");
    assert!((short / long - 1.0).abs() < 0.01, "{short} {long}");
}

/// The force is what the vorticity loses of its impulse, over a period of a flow that gains circulation.
#[test]
fn conserves_impulse_of_sections_that_gain_circulation() {
    let seen = gaining(1000.0, 2);
    let (first, last) = (60, 120);
    let dt = std::f64::consts::TAU / 60.0;
    let force: f64 = (first + 1..=last).map(|k| seen[k][0]).sum::<f64>() * dt;
    let lost = seen[first][1] - seen[last][1];
    println!("impulse of force {force}, lost {lost}");
    assert!((force / lost - 1.0).abs() < 0.03, "{force} {lost}");
}

/// Lift and vortex impulse along it over the span, step by step of 0.05 chords, of a section at 20 deg whose wake keeps so
/// many rows.
fn stalled(max_rows: Option<usize>) -> Vec<[f64; 2]> {
    const SPAN: f64 = 100.0;
    let chord = r2(20.0_f64.to_radians()) * DVec3::X;
    let nodes = rectangle(4, 1, chord, SPAN * DVec3::Y);
    let motion = |_: f64| translating(nodes.clone(), DVec3::ZERO);
    let mut seen = vec![];
    fly(&separated(max_rows), motion, 0.05, 200, |_, _, loads, _| {
        seen.push([total_force(loads).z, loads.impulse.z].map(|x| x / SPAN));
    })
    .unwrap();
    seen
}

/// A section sheds all around if both its edges do. What its rings gain in common is gone where its wake is cut: the
/// forces are those with the whole wake, and the rate of the impulse, with what was dropped.
#[test]
fn limit_forces_of_sections_whose_wakes_are_cut_are_those_of_the_whole_wake() {
    let mean = |seen: &[[f64; 2]]| seen.iter().map(|s| s[0]).sum::<f64>() / seen.len() as f64;
    let uncut = stalled(None);
    let whole = mean(&uncut[160..]);
    let cut = stalled(Some(80));
    for part in [&cut[120..160], &cut[160..]] {
        let lift = mean(part);
        assert!((lift / whole - 1.0).abs() < 0.01, "{lift} {whole}"); // 0.4 and 0.2 %: four chords of wake
    }
    let balance = |seen: &[[f64; 2]]| {
        let (first, last) = (120, 199);
        let force = 0.05 * seen[first + 1..=last].iter().map(|s| s[0]).sum::<f64>();
        force / (seen[first][1] - seen[last][1])
    };
    let [of_cut, of_whole] = [&cut, &uncut].map(|seen| balance(seen));
    // 0.972 and 0.975: the cut costs 0.3 %.
    assert!(
        (of_cut / of_whole - 1.0).abs() < 0.01,
        "{of_cut} {of_whole}"
    );
    assert!((of_cut - 1.0).abs() < 0.05, "{of_cut}");
}

/// Two sections that share an edge are one: plane flow has no side edges from which rings could lie inside.
#[test]
fn exact_joined_sections_are_one_section() {
    let settings = AirSettings {
        images: vec![],
        ..settings(true)
    };
    let lift = |surfaces: Vec<Surface>, joined: &[JoinedEdge], spans: &[[f64; 2]]| {
        let lattice = Lattice::joined(surfaces, joined, settings.clone()).unwrap();
        let chord = r2(0.1) * DVec3::X;
        let of = |&[from, to]: &[f64; 2]| {
            let nodes = rectangle(4, 1, chord, (to - from) * DVec3::Y);
            nodes.into_iter().map(move |x| x + from * DVec3::Y)
        };
        let nodes: Vec<DVec3> = spans.iter().flat_map(of).collect();
        let motion = |_: f64| translating(nodes.clone(), DVec3::ZERO);
        let run = fly(&lattice, motion, 0.2, 40, |_, _, _, _| {}).unwrap();
        total_force(&run.loads).z
    };
    let grid = |name: &str| Surface::grid(name, 4, 1);
    let whole = lift(vec![grid("whole")], &[], &[[0.0, 2000.0]]);
    let edge = JoinedEdge {
        surfaces: [0, 1],
        nodes: (0..=4).map(|i| [2 * i + 1, 2 * i]).collect(),
    };
    let halves = [[0.0, 1000.0], [1000.0, 2000.0]];
    let both = lift(vec![grid("right"), grid("left")], &[edge], &halves);
    println!("{whole} {both}");
    // Velocities are taken at the middles of one and of two panels: the square of the chord over the span.
    assert!((both / whole - 1.0).abs() < 1e-4, "{whole} {both}");
}
