//! The example `free_flight` without its records, which are not shipped.

#[path = "../examples/free_flight.rs"]
#[expect(dead_code, reason = "main is for the command line")]
mod free_flight;

use free_flight::{RATE, compare, passive, spins};
use wingbeat_math::{DMat3, DVec3, r1, r3};

#[test]
fn behaves_missing_records_are_skipped() {
    let nowhere = std::path::Path::new("no such folder");
    assert_eq!(compare(nowhere, false), Ok(0));
}

/// In axes turned by `a` about axis 3, the direction at the angle `a` is the first axis.
#[test]
fn exact_quaternions_turn_the_axes() {
    let a: f64 = 0.7;
    let turn = passive([0.0, 0.0, (0.5 * a).sin(), (0.5 * a).cos()]);
    let seen = turn * DVec3::new(a.cos(), a.sin(), 0.0);
    assert!((seen - DVec3::X).length() < 1e-15);
}

/// A steady turn about an axis of the wing that is itself tilted.
#[test]
fn exact_spin_of_a_steady_turn() {
    let rate = 500.0;
    let turns: Vec<DMat3> = (0..9)
        .map(|k| r1(0.4) * r3(rate * f64::from(k) / RATE))
        .collect();
    for spin in spins(&turns) {
        // Central differences are low by (w dt)^2 / 6, 7.4e-4 here.
        let exact = rate * DVec3::Z;
        assert!((spin - exact).length() < 1e-3 * rate, "{spin}");
    }
}
