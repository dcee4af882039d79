//! Trims from speed to speed.

use std::ops::ControlFlow;

use crate::common;

use common::*;
use wingbeat_analysis::*;
use wingbeat_math::DVec3;
use wingbeat_model::{AngleLaw, AngleLaws};

fn forward(speeds: &[f64]) -> Vec<DVec3> {
    speeds.iter().map(|v| DVec3::new(*v, 0.0, 0.0)).collect()
}

#[test]
fn agrees_a_sweep_with_trims_one_by_one() {
    // Two ways to one orbit, both to 1e-9: the unknowns agree to that over the slopes of the residuals.
    let found = sweep(&fly(), &hover(40), &forward(&[0.0, 0.3, 0.6])).unwrap();
    assert!(found.lost.is_none());
    for f in &found.flights {
        let problem = TrimProblem {
            velocity: f.velocity,
            ..hover(40)
        };
        let alone = trim(&fly(), &problem).unwrap();
        assert!(alone.solution.converged && f.trim.solution.converged);
        for (a, b) in alone.point.iter().zip(&f.trim.point) {
            assert!((a - b).abs() < 1e-7, "{:?} {:?}", alone.point, f.trim.point);
        }
        let paid = power_of_trim(&alone).unwrap();
        assert!((paid.aerodynamic / f.power.aerodynamic - 1.0).abs() < 1e-6);
    }
    let least = found.least_power().unwrap().power.perfect_storage;
    let all = found.flights.iter().map(|f| f.power.perfect_storage);
    assert!(all.into_iter().all(|p| p >= least));
    assert!(found.least_work().unwrap().velocity.x > 0.0);
}

/// A power that is a parabola of the speed has its least where that is, whatever the speeds flown.
#[test]
fn exact_least_power_between_speeds_of_a_parabola() {
    let flown = sweep(&fly(), &hover(40), &forward(&[0.0])).unwrap();
    let with = |speeds: &[f64], least: f64| {
        let flight = |v: &f64| {
            let mut flight = flown.flights[0].clone();
            flight.velocity.x = *v;
            flight.power.perfect_storage = 2.0 + 0.7 * (v - least).powi(2);
            flight
        };
        Sweep {
            flights: speeds.iter().map(flight).collect(),
            ..Sweep::default()
        }
    };
    let uneven = [0.0, 0.4, 0.7, 0.9, 1.5];
    for least in [0.3, 0.55, 0.72, 1.1] {
        let found = with(&uneven, least).least_power_forward().unwrap();
        assert!((found - least).abs() < 1e-12, "{found} {least}");
    }
    // At an end nothing is known of what lies beyond.
    for least in [-0.5, 1.6] {
        assert_eq!(with(&uneven, least).least_power_forward(), None);
    }
    // Work per distance is infinite in hover: no parabola goes through it.
    assert_eq!(with(&[0.0, 2.0, 9.0], 0.0).least_work_forward(), None);
}

#[test]
fn limit_a_sweep_ends_where_no_flight_is() {
    // A fruit fly does not fly at 60 m/s: forces grow with the square of the speed, and the point before is far.
    let found = sweep(&fly(), &hover(40), &forward(&[0.0, 60.0, 61.0])).unwrap();
    assert_eq!(found.flights.len(), 1);
    let (velocity, why) = found.lost.unwrap();
    assert_eq!(velocity.x, 60.0);
    assert!(matches!(why, Lost::NotTrimmed(_) | Lost::Stroke(_)));
}

#[test]
fn limit_strokes_of_more_than_half_a_circle_are_no_flight() {
    // A body three times as heavy, carried by amplitude alone, would need them.
    let mut heavy = fly();
    heavy.gravity *= 3.0;
    let found = sweep(&heavy, &hover(40), &forward(&[0.0, 0.1])).unwrap();
    assert!(found.flights.is_empty());
    assert_eq!(found.missed.len(), 2);
    let too_far = |why: &Lost| matches!(why, Lost::Stroke(s) if *s > std::f64::consts::PI);
    assert!(found.missed.iter().all(|(_, why)| too_far(why)));
}

/// Fins that stand still do not hide the strokes of the wings, whichever come first.
#[test]
fn invariant_strokes_of_more_than_half_a_circle_whatever_the_order_of_wings() {
    let mut heavy = fly();
    heavy.gravity *= 3.0;
    let small = heavy.animal.scaled(1e-3).unwrap().wings;
    let fins = small.into_iter().map(|mut fin| {
        fin.name = format!("a-fin-{}", fin.name);
        fin.motion.angles = AngleLaws {
            phi: AngleLaw::Constant(0.0),
            theta: AngleLaw::Constant(0.0),
            psi: AngleLaw::Constant(0.0),
        };
        fin
    });
    let wings = heavy.animal.wings.clone();
    heavy.animal.wings = fins.chain(wings).collect();
    let found = sweep(&heavy, &hover(40), &forward(&[0.0])).unwrap();
    assert!(
        matches!(found.missed[..], [(_, Lost::Stroke(_))]),
        "{:?}",
        found.missed
    );
    // Of normal weight they fly, and the stroke is that of the wings.
    heavy.gravity /= 3.0;
    let found = sweep(&heavy, &hover(40), &forward(&[0.0])).unwrap();
    let alone = sweep(&fly(), &hover(40), &forward(&[0.0])).unwrap();
    let strokes = [&found, &alone].map(|f| f.flights[0].stroke_amplitude);
    // The fins have a millionth of the area, and 1e-9 of the mass.
    assert!((strokes[0] / strokes[1] - 1.0).abs() < 1e-4, "{strokes:?}");
}

/// From the controls of its hover Newton's method finds no flight of a hawkmoth at 3 m/s; by way of a slower one it is
/// the flight that a sweep has.
#[test]
fn agrees_a_fast_flight_by_way_of_slower_ones_with_a_sweep() {
    let problem = TrimProblem {
        velocity: DVec3::new(3.0, 0.0, 0.0),
        ..hover(40)
    };
    let direct = trim(&moth(), &problem).unwrap().solution;
    assert!(!direct.converged, "the test is void");
    let found = trim_within(&moth(), &problem).unwrap();
    assert!(found.solution.converged);
    let swept = sweep(&moth(), &hover(40), &forward(&[1.0, 2.0, 3.0])).unwrap();
    let last = &swept.flights[2].trim;
    for (a, b) in found.point.iter().zip(&last.point) {
        // Two ways to one orbit, both to 1e-9.
        assert!((a - b).abs() < 1e-7, "{:?} {:?}", found.point, last.point);
    }
}

#[test]
fn behaves_a_sweep_begins_at_the_first_speed_that_is_found() {
    let found = sweep(&fly(), &hover(40), &forward(&[20.0, 0.6, 0.3])).unwrap();
    let missed: Vec<f64> = found.missed.iter().map(|(v, _)| v.x).collect();
    assert_eq!(missed, [20.0]);
    let flown: Vec<f64> = found.flights.iter().map(|f| f.velocity.x).collect();
    assert_eq!(flown, [0.6, 0.3]);
    assert!(found.lost.is_none());
}

/// A range from its fast end has the flights of the range from its slow end, and says where they end.
#[test]
fn invariant_a_range_from_either_end() {
    let speeds = [0.0, 0.6, 1.2, 1.8, 2.4];
    let turned = [2.4, 1.8, 1.2, 0.6, 0.0];
    let up = sweep(&fly(), &hover(40), &forward(&speeds)).unwrap();
    let down = sweep(&fly(), &hover(40), &forward(&turned)).unwrap();
    assert!(up.flights.len() >= 2 && up.missed.is_empty() && down.lost.is_none());
    assert_eq!(up.flights.len(), down.flights.len());
    for (a, b) in up.flights.iter().zip(down.flights.iter().rev()) {
        assert_eq!(a.velocity, b.velocity);
        // Both are trimmed from the slow end.
        assert_eq!(a.trim.point, b.trim.point);
    }
    let (end, why) = up.lost.unwrap();
    let (last, faster) = down.missed.split_last().unwrap();
    assert_eq!(*last, (end, why));
    assert_eq!(up.flights.len() + down.missed.len(), speeds.len());
    assert!(faster.iter().all(|(_, why)| *why == Lost::Beyond));
}

/// Galilei: by way of slower flights a moth is trimmed through still air, and held against a stream, alike.
#[test]
fn invariant_a_trim_by_way_of_slower_flights_in_a_stream() {
    const SPEED: f64 = 3.0;
    let trimmed = |stream: f64| {
        let mut setup = moth();
        *setup.air.stream_mut().unwrap() = DVec3::new(stream, 0.0, 0.0);
        let problem = TrimProblem {
            velocity: DVec3::new(SPEED + stream, 0.0, 0.0),
            ..hover(40)
        };
        trim_within(&setup, &problem).unwrap().solution
    };
    let still = trimmed(0.0);
    assert!(still.converged);
    for stream in [-SPEED, -0.6 * SPEED, 2.0] {
        let found = trimmed(stream);
        assert!(found.converged, "{stream}: {:?}", found.residual);
        for (a, b) in still.values.iter().zip(&found.values) {
            // Newton's method ends quadratically, at rounding: 3e-15.
            assert!((a - b).abs() < 3e-14, "{stream}: {a} {b}");
        }
    }
}

/// Which unknowns are named first does not decide whether least power is found, nor where.
#[test]
fn invariant_least_power_of_a_fast_flight_whatever_the_order_of_unknowns() {
    use Unknown::{BodyPitch, Frequency, StrokeAmplitude, StrokeOffset};
    let least = |unknowns: [Unknown; 4]| {
        let problem = TrimProblem {
            unknowns: unknowns.to_vec(),
            velocity: DVec3::new(3.0, 0.0, 0.0),
            ..hover(40)
        };
        let found = trim_within(&smooth(moth()), &problem).unwrap();
        assert!(found.solution.is_as_asked(), "{unknowns:?}");
        power_of_trim(&found).unwrap().perfect_storage
    };
    let first = least([BodyPitch, StrokeAmplitude, StrokeOffset, Frequency]);
    let second = least([BodyPitch, Frequency, StrokeOffset, StrokeAmplitude]);
    // Both within 1e-5 of where power is least, and flat: squares of that remain, 2.4e-9.
    assert!((second / first - 1.0).abs() < 2e-8, "{first} {second}");
}

/// A sweep that is stopped has the flights of one that is not, as far as it came, from either end.
#[test]
fn invariant_a_sweep_that_is_stopped_has_what_was_found() {
    for (speeds, kept, left) in [
        ([0.0, 0.2, 0.4, 0.6], [0.0, 0.2], [0.4, 0.6]),
        ([0.6, 0.4, 0.2, 0.0], [0.2, 0.0], [0.6, 0.4]),
    ] {
        let mut told = vec![];
        let found = sweep_watched(&fly(), &hover(40), &forward(&speeds), |v, lost| {
            told.push((v.x, lost));
            match told.len() {
                2 => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        });
        let found = found.unwrap();
        assert_eq!(told, [(0.0, None), (0.2, None)]);
        let flown: Vec<f64> = found.flights.iter().map(|f| f.velocity.x).collect();
        assert_eq!(flown, kept);
        assert_eq!(found.untried, forward(&left));
        assert!(found.lost.is_none() && found.missed.is_empty());
        let whole = sweep(&fly(), &hover(40), &forward(&speeds)).unwrap();
        assert!(whole.untried.is_empty());
        for f in &found.flights {
            let same = whole.flights.iter().find(|w| w.velocity == f.velocity);
            assert_eq!(same.unwrap().trim.point, f.trim.point);
        }
    }
}
