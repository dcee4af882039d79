//! Trims from speed to speed.

use crate::common;

use common::*;
use wingbeat_analysis::*;
use wingbeat_math::DVec3;

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
    assert!(matches!(found.lost, Some((_, Lost::Stroke(s))) if s > std::f64::consts::PI));
}
