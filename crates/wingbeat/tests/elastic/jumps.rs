//! Elastic wings in air whose forces jump with their motion.

use wingbeat::case::LoadedCase;
use wingbeat::flight::Simulation;

use super::strings;

/// The hawkmoth with elastic wings in blade elements with these keys set: what its flight ends with, if it does before its
/// end, and what is said of its air beforehand.
fn flown(set: &[&str]) -> (Option<String>, Option<String>) {
    let set = [&["air.model=\"blade_element\""], set].concat();
    let setup = LoadedCase::find("hawkmoth-elastic", &strings(&set))
        .unwrap()
        .setup;
    let said = setup.jumping_rotation();
    let mut flight = Simulation::new(setup).unwrap();
    while !flight.finished() {
        if let Err(error) = flight.step() {
            return (Some(error.to_string()), said);
        }
    }
    (None, said)
}

/// Where the air along a chord reverses, a force with a jump lets a step have no balance: with the moment against
/// feathering (`unsteady`), too, which damps torsion. The same circulation without the jump flies on, and excites torsion.
#[test]
fn refuses_steps_across_a_jump_of_the_air_and_names_laws_without_one() {
    const JUMPS: &str = "air.blade.rotation=\"sane_dickinson\"";
    for unsteady in ["", "air.blade.unsteady=\"peters\""] {
        let set: Vec<&str> = [JUMPS, unsteady]
            .into_iter()
            .filter(|k| !k.is_empty())
            .collect();
        let (ended, said) = flown(&set);
        let (ended, said) = (ended.expect("an end"), said.expect("a doubt"));
        for told in [&ended, &said] {
            assert!(
                told.contains("jumps") && told.contains("rotation_coefficient"),
                "{told}"
            );
        }
    }
    let (ended, said) = flown(&["air.blade.rotation_coefficient=1.5707963267948966"]);
    assert_eq!((ended, said), (None, None));
    let rigid = LoadedCase::find("hawkmoth-blade", &strings(&[JUMPS])).unwrap();
    let said = rigid.setup.jumping_rotation().expect("a doubt");
    assert!(!said.contains("elastic"), "{said}");
}
