//! Every numbered example runs to its end.

#[path = "../examples/03_controller.rs"]
mod controller;
#[path = "../examples/01_first_flight.rs"]
mod first_flight;
#[path = "../examples/02_own_insect.rs"]
mod own_insect;

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
