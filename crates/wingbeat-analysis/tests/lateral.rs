//! Flight that parts right from left: turns, sideslip, wings that differ; unknowns with bounds, and more of them than
//! steady flight determines.

use crate::common;

use common::*;
use wingbeat_analysis::*;
use wingbeat_flight::{FlightSetup, Simulation};
use wingbeat_math::{DVec3, r3};

/// Body roll and differences of stroke amplitude and stroke plane beside the unknowns of straight flight.
fn lateral(steps: usize) -> TrimProblem {
    let mut problem = hover(steps);
    problem.unknowns.extend([
        Unknown::BodyRoll,
        Unknown::StrokeAmplitudeDifference,
        Unknown::StrokePlaneDifference,
    ]);
    problem
}

/// A flight with this forward velocity [m/s] that turns by `turn_rate` [rad/s].
fn turning(forward: f64, turn_rate: f64) -> TrimProblem {
    TrimProblem {
        velocity: DVec3::new(forward, 0.0, 0.0),
        turn_rate,
        ..lateral(60)
    }
}

fn trimmed(setup: &FlightSetup, problem: &TrimProblem) -> Trim {
    let found = trim(setup, problem).unwrap();
    assert!(found.solution.converged, "{:?}", found.solution.residual);
    found
}

#[test]
fn agrees_a_turn_flown_freely_with_its_circle() {
    // Second method: the flight simulator, from the trimmed start, over three wingbeats. Mass centre on the circle of
    // radius V / turn rate, heading with it. The trim is good to 1e-9 a beat; instability adds a few times that.
    let (v, rate) = (0.3, 5.0);
    let found = trimmed(&fly(), &turning(v, rate));
    let mut setup = found.free();
    let beats = 3;
    setup.time.steps *= beats;
    let mut flight = Simulation::new(setup).unwrap();
    let start = (flight.root().r, flight.record().mass_centre);
    for _ in 0..60 * beats {
        flight.step().unwrap();
    }
    let turned = rate * found.beat.period() * beats as f64;
    let radius = v / rate;
    let way = flight.record().mass_centre - start.1;
    let on_circle = radius * DVec3::new(turned.sin(), 1.0 - turned.cos(), 0.0);
    assert!(
        (way - on_circle).length() < 1e-8 * radius,
        "{way} {on_circle}"
    );
    let heading = r3(turned) * start.0;
    let apart =
        (heading.transpose() * flight.root().r - wingbeat_math::DMat3::IDENTITY).to_cols_array();
    assert!(apart.iter().all(|x| x.abs() < 1e-7), "{apart:?}");
}

#[test]
fn invariant_turns_to_either_side_are_mirror_images() {
    let [right, left] = [5.0, -5.0].map(|rate| trimmed(&fly(), &turning(0.3, rate)));
    for unknown in &right.solution.unknowns {
        let [a, b] = [&right, &left].map(|t| t.solution.value(*unknown).unwrap());
        let mirrored = if unknown.is_lateral() { -b } else { b };
        // Both are trimmed to 1e-9 of forces whose slopes are of order one.
        assert!((a - mirrored).abs() < 1e-8, "{}: {a} {b}", unknown.name());
    }
    assert!(
        right.solution.body_roll > 0.1,
        "into the turn: {}",
        right.solution.body_roll
    );
    let [a, b] = [&right, &left].map(|t| power_of_trim(t).unwrap().aerodynamic);
    assert!((a / b - 1.0).abs() < 1e-7, "{a} {b}");
}

#[test]
fn exact_the_mean_force_of_a_turn_is_centripetal() {
    // Newton: the horizontal momentum of a beat turns with the heading, so the mean force towards the centre is
    // m V rate; the air gives it besides the weight. Power is paid for both.
    let (v, rate) = (0.3, 5.0);
    let found = trimmed(&fly(), &turning(v, rate));
    let (beat, end) = (&found.beat, found.beat.advance(&found.state).unwrap());
    let force = |k: usize| (end[7 + k] - found.state[7 + k]) / beat.period();
    let mean = DVec3::new(force(0), force(1), force(2));
    let half = r3(0.5 * rate * beat.period()).transpose() * mean;
    // The velocity at the start of a beat is not the mean one: it oscillates, and turns with the rest.
    let start = DVec3::from_slice(&found.state[7..]) / beat.mass();
    let seen = r3(0.5 * rate * beat.period()) * start;
    let chord = 2.0 * (0.5 * rate * beat.period()).sin() / beat.period();
    let wanted = beat.mass() * chord * DVec3::new(0.0, 0.0, 1.0).cross(seen);
    assert!(
        (mean - wanted).length() < 1e-8 * beat.mass() * 9.81,
        "{mean} {wanted}"
    );
    assert!(
        (half.y / (beat.mass() * v * rate) - 1.0).abs() < 0.05,
        "{half}"
    );
}

#[test]
fn agrees_lateral_trim_of_symmetric_hover_with_the_symmetric_one() {
    let plain = trimmed(&fly(), &hover(60));
    let all = trimmed(&fly(), &lateral(60));
    for unknown in &all.solution.unknowns {
        let x = all.solution.value(*unknown).unwrap();
        let expected = plain.solution.value(*unknown).unwrap_or(0.0);
        assert!((x - expected).abs() < 1e-8, "{}: {x}", unknown.name());
    }
}

#[test]
fn exact_a_turning_orbit_has_the_neutral_multiplier_of_its_heading() {
    // Whatever the heading, the flight is the same: one multiplier is 1, to the error of the differences.
    let found = trimmed(&fly(), &turning(0.3, 8.0));
    let modes = floquet_of_trim(&found).unwrap().modes;
    let from_one = modes
        .iter()
        .map(|m| (m.multiplier[0] - 1.0).hypot(m.multiplier[1]));
    let nearest = from_one.fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-6, "{nearest}");
}

/// The fly with a left wing that is a tenth shorter.
fn clipped() -> FlightSetup {
    let mut setup = fly();
    for wing in &mut setup.animal.wings {
        if wing.name.contains("left") {
            wing.mesh.nodes.iter_mut().for_each(|r| r.y *= 0.9);
        }
    }
    setup
}

#[test]
fn refuses_to_trim_half_of_a_flight_that_parts_right_from_left() {
    let said = trim(&clipped(), &hover(40)).unwrap_err().to_string();
    assert!(
        said.contains("parts right from left") && said.contains("body_roll"),
        "{said}"
    );
    let mut few = turning(0.0, 1.0);
    few.unknowns.truncate(3);
    let said = trim(&fly(), &few).unwrap_err().to_string();
    assert!(said.contains("determines 6 unknowns, and 3"), "{said}");
    let mut windy = fly();
    windy.air.stream_mut().unwrap().x = 0.1;
    let said = trim(&windy, &turning(0.0, 1.0)).unwrap_err().to_string();
    assert!(said.contains("turn is about the vertical"), "{said}");
}

#[test]
fn balances_a_fly_with_a_clipped_wing_hovers() {
    let found = trimmed(&clipped(), &lateral(60));
    // The short wing strokes farther.
    assert!(
        found.solution.difference.stroke_amplitude < -0.05,
        "{:?}",
        found.solution.difference
    );
    let mut flight = Simulation::new(found.free()).unwrap();
    let start = flight.record().mass_centre;
    for _ in 0..60 {
        flight.step().unwrap();
    }
    let way = flight.record().mass_centre - start;
    assert!(way.length() < 1e-8 * found.beat.wing_length(), "{way}");
}

#[test]
fn limit_least_power_is_no_more_than_at_any_frequency() {
    // Second method: the power of trims over a range of frequencies, each given. What was found lies below all, and
    // is where their parabola through the three nearest has its bottom.
    let mut problem = hover(40);
    problem.unknowns.push(Unknown::Frequency);
    problem.unknowns.push(Unknown::FeatheringLead);
    let found = trim_within(&fly(), &problem).unwrap();
    assert!(
        found.solution.converged && found.solution.at_bound.is_empty(),
        "{:?}",
        found.solution.at_bound
    );
    let paid = |t: &Trim| power_of_trim(t).unwrap().perfect_storage;
    let least = paid(&found);
    let [f, lead] =
        [Unknown::Frequency, Unknown::FeatheringLead].map(|u| found.solution.value(u).unwrap());
    let at = |df: f64, dl: f64| {
        let given = vec![
            (Unknown::Frequency, f + df),
            (Unknown::FeatheringLead, lead + dl),
        ];
        paid(&trimmed(&fly(), &TrimProblem { given, ..hover(40) }))
    };
    for d in [0.02, -0.02] {
        for (df, dl) in [(d, 0.0), (0.0, 0.5 * d), (d, 0.5 * d), (d, -0.5 * d)] {
            assert!(at(df, dl) > least, "{df} {dl}");
        }
    }
    for (df, dl) in [(0.02, 0.0), (0.0, 0.01)] {
        let [a, b] = [at(-df, -dl), at(df, dl)];
        // Bottom of the parabola, in steps: the search ends at 1e-7 of the cost.
        let bottom = 0.5 * (a - b) / (a - 2.0 * least + b);
        assert!(bottom.abs() < 0.2, "{bottom}");
    }
}

#[test]
fn limit_bounds_are_kept_where_there_is_a_choice_and_named_where_there_is_none() {
    let bound = Bound {
        unknown: Unknown::StrokeAmplitude,
        from: -0.05,
        to: 0.1,
    };
    let mut problem = hover(40);
    problem.bounds = vec![bound];
    let free = trim_within(&fly(), &problem).unwrap();
    assert!(free.solution.converged && free.solution.outside == [Unknown::StrokeAmplitude]);
    // No lift is enough for ten weights: the search ends at the bound, and names it.
    let mut heavy = fly();
    heavy.gravity *= 10.0;
    let ended = trim(&heavy, &problem).unwrap().solution;
    assert!(!ended.converged && ended.outside.is_empty());
    assert_eq!(ended.at_bound, [Unknown::StrokeAmplitude]);
    problem.unknowns.push(Unknown::Frequency);
    let found = trim_within(&fly(), &problem).unwrap();
    let x = found.solution.value(Unknown::StrokeAmplitude).unwrap();
    assert!(
        found.solution.converged && found.solution.outside.is_empty(),
        "{x}"
    );
    assert!((bound.from..=bound.to).contains(&x), "{x}");
}

/// Bounds are kept to rounding, whatever the unit: 1e-6 short of what steady flight needs is outside, 1e-6 beyond it is
/// inside and not at the bound.
#[test]
fn limit_a_bound_that_is_short_by_a_millionth_is_outside() {
    let own = trimmed(&fly(), &hover(40)).solution;
    for unknown in own.unknowns.clone() {
        let x = own.value(unknown).unwrap();
        let within = |to: f64| {
            let mut problem = hover(40);
            let from = x - 0.2;
            problem.bounds = vec![Bound { unknown, from, to }];
            trim(&fly(), &problem).unwrap().solution
        };
        let [short, enough] = [within(x - 1e-6), within(x + 1e-6)];
        assert_eq!(short.outside, [unknown]);
        assert!(!short.is_as_asked() && short.at_bound.is_empty());
        assert!(enough.is_as_asked() && enough.at_bound.is_empty());
    }
}

/// Where power falls across the bound of a spare unknown, the search for least power ends on that bound and names it.
#[test]
fn limit_least_power_lies_at_the_bound_that_it_is_kept_from_crossing() {
    let mut problem = hover(40);
    problem.unknowns.push(Unknown::Frequency);
    let free = trim_within(&fly(), &problem).unwrap().solution;
    let best = free.value(Unknown::Frequency).unwrap();
    let (from, to) = (best + 0.1, best + 0.3);
    problem.bounds = vec![Bound {
        unknown: Unknown::Frequency,
        from,
        to,
    }];
    let found = trim_within(&fly(), &problem).unwrap().solution;
    assert!(found.is_as_asked());
    assert_eq!(found.at_bound, [Unknown::Frequency]);
    // To what the search resolves.
    let over = found.value(Unknown::Frequency).unwrap() - from;
    assert!((0.0..1e-4).contains(&over), "{over}");
}

/// Where nothing is asked of an unknown, its default bound ends the search as one that is asked does, and is named so.
#[test]
fn limit_least_power_lies_at_a_default_bound() {
    let mut problem = hover(40);
    problem.unknowns = vec![
        Unknown::FeatheringLead,
        Unknown::MassCentre,
        Unknown::StrokeOffset,
        Unknown::BodyPitch,
    ];
    let found = trim_within(&smooth(fly()), &problem).unwrap().solution;
    assert!(found.is_as_asked());
    assert_eq!(found.unknowns, problem.unknowns);
    let offset = found.value(Unknown::StrokeOffset).unwrap();
    let short = Bound::default_of(Unknown::StrokeOffset).from - offset;
    assert!(short.abs() < 1e-5, "{offset}"); // what the search resolves
    assert_eq!(found.at_bound, [Unknown::StrokeOffset]);
}
