//! Every numbered example runs to its end, and its numbers are right.

#[path = "../examples/03_controller.rs"]
mod controller;
#[path = "../examples/01_first_flight.rs"]
mod first_flight;
#[path = "../examples/05_gust.rs"]
mod gust;
#[path = "../examples/08_own_air.rs"]
mod own_air;
#[path = "../examples/02_own_insect.rs"]
mod own_insect;
#[path = "../examples/04_passive_hinge.rs"]
mod passive_hinge;
#[path = "../examples/07_results.rs"]
mod results;
#[path = "../examples/06_trim_and_modes.rs"]
mod trim_and_modes;

#[test]
fn behaves_first_flight() {
    first_flight::main().expect("a preset");
}

#[test]
fn behaves_own_insect() {
    own_insect::main().expect("an insect in two airs");
}

#[test]
fn behaves_own_controller() {
    controller::main().expect("a flight under feedback");
}

#[test]
fn behaves_stiffer_hinges_feather_less() {
    passive_hinge::main().expect("a robot in blade elements");
    let width = |factor| {
        let [least, most, _] = passive_hinge::last_beat(factor).expect("a flight");
        assert!(least < 0.0 && most > 0.0, "it feathers to both sides");
        most - least
    };
    assert!(width(4.0) < width(1.0));
}

#[test]
fn behaves_gust_carries_off_downwind_while_it_blows() {
    gust::main().expect("a flight in a gust");
    let gap = gust::carried_off().expect("a flight in a gust");
    // Of flights of 1e-4 m with and without a wind that is none yet: rounding.
    assert!(
        gap[..2].iter().all(|x| x.length() < 1e-18),
        "calm before it: {gap:?}"
    );
    assert!(gap[2].y > 0.0 && gap[3].y > gap[2].y, "{gap:?}");
}

#[test]
fn behaves_hover_is_trimmed_and_has_one_neutral_heading() {
    trim_and_modes::main().expect("a trim");
    let (trim, modes) = trim_and_modes::hover().expect("a trim");
    assert!(
        trim.solution.converged,
        "residual {:e}",
        trim.solution.error()
    );
    let neutral = modes.modes.iter().filter(|m| m.is_neutral());
    assert_eq!(neutral.count(), 1, "hover is the same in every heading");
}

#[test]
fn behaves_results_are_read_back() {
    results::main().expect("a result directory");
}

/// The fall has lasted 36 time constants `m / sum 16 mu a` of 5.5 ms: `exp(-36)` is below 1e-15; the
/// tolerance leaves room for the swing of the body below its wings, which dies out more slowly.
#[test]
fn exact_terminal_speed_in_an_air_of_ones_own() {
    own_air::main().expect("a fall");
    let [flown, closed] = own_air::fall().expect("a fall");
    assert!((flown / closed - 1.0).abs() < 1e-9, "{flown} {closed}");
}
