//! Cases of insects from a few numbers: scaling laws, and numbers as people write them.

use crate::common;
use wingbeat_case::insect::{InsectAir, SPECIES, Size, Species, case_of_size};

/// Case text has five digits.
const ROUNDING: f64 = 5e-5;

fn text(size: &Size) -> String {
    case_of_size(size, InsectAir::BladeElement).unwrap()
}

/// Numbers of a case: wing length, mean chord, length of the body [m], mass with wings [kg], frequency [Hz].
fn numbers(text: &str) -> [f64; 5] {
    let table: toml::Table = text.parse().unwrap();
    let at = |path: &str| {
        let mut keys = path.split('.');
        let top = &table[keys.next().unwrap()];
        keys.fold(top, |value, key| &value[key]).as_float().unwrap()
    };
    [
        at("wing.right.planform.beta.length_m"),
        at("wing.right.planform.beta.mean_chord_m"),
        at("body.part.body.length_m"),
        at("body.mass_kg") + 2.0 * at("wing.right.mass_kg"),
        at("motion.frequency_hz"),
    ]
}

#[test]
fn exact_an_insect_of_the_size_of_a_species_has_its_proportions() {
    let close = |x: f64, y: f64| (x / y - 1.0).abs() < 2.0 * ROUNDING;
    for s in SPECIES {
        let [wing, chord, body, mass, _] = numbers(&text(&Size {
            mass: Some(s.mass),
            ..Size::default()
        }));
        assert!(close(wing, s.wing_length), "{}", s.name);
        assert!(close(chord, s.mean_chord), "{}", s.name);
        assert!(close(body, s.body_length), "{}", s.name);
        assert!(close(mass, s.mass), "{}", s.name);
        let larger = 1.2 * s.wing_length;
        let [wing, _, _, mass, _] = numbers(&text(&Size {
            wing_length: Some(larger),
            ..Size::default()
        }));
        let nearest = Species::nearest(None, Some(larger));
        let ratio = (larger / nearest.wing_length).powi(3);
        assert!(close(wing, larger), "{}", s.name);
        assert!(close(mass, ratio * nearest.mass), "{}", s.name);
    }
}

/// The law holds across insects with a scatter of some tens of percent: here from 0.73 (drone fly) to 1.50
/// (ladybird).
#[test]
fn published_wingbeat_frequencies_follow_deakins_law() {
    for s in SPECIES {
        let size = Size {
            mass: Some(s.mass),
            wing_length: Some(s.wing_length),
            ..Size::default()
        };
        let [.., frequency] = numbers(&text(&size));
        let ratio = frequency / s.frequency;
        println!("{:<18}{ratio:.3}", s.name);
        assert!((0.7..1.55).contains(&ratio), "{}: {ratio}", s.name);
    }
}

#[test]
fn exact_five_digits_with_exponents_by_threes() {
    let size = |mass, frequency| Size {
        mass: Some(mass),
        frequency: Some(frequency),
        ..Size::default()
    };
    let written = text(&size(101.900_04e-6, 231.123_456));
    assert!(written.contains("with them 101.9e-6 kg"), "{written}");
    assert!(written.contains("frequency_hz = 231.12  #"), "{written}");
    let written = text(&size(0.999_999_9e-6, 231.0));
    assert!(written.contains("with them 1e-6 kg"), "{written}");
    assert!(written.contains("frequency_hz = 231.0  #"), "{written}");
}

/// Flyers of the size of micro air vehicles, with strokes up to 165 deg: their wings pass neither through each other nor
/// through the body, in either air; a chord that is given is written, and wider wings need shorter strokes.
#[test]
fn behaves_wings_of_new_flyers_keep_clear_of_each_other_and_of_the_body() {
    for (mass, wing, frequency) in [
        (19e-3, 74e-3, 30.0),
        (19e-3, 60e-3, 45.0),
        (19e-3, 90e-3, 20.0),
        (12e-3, 120e-3, 10.0),
        (5e-3, 90e-3, 10.0),
        (1e-3, 30e-3, 45.0),
    ] {
        let size = Size {
            mass: Some(mass),
            wing_length: Some(wing),
            frequency: Some(frequency),
            ..Size::default()
        };
        for air in [InsectAir::BladeElement, InsectAir::Lattice] {
            let text = case_of_size(&size, air).unwrap();
            assert!(text.contains("pass neither through each other"), "{text}");
            let setup = common::load(&text, &[]).unwrap().setup;
            assert!(setup.crossing_wings().is_empty() && setup.wings_inside_parts().is_empty());
            assert!(setup.doubts().is_empty(), "{:?}", setup.doubts());
        }
        let wide = Size {
            mean_chord: Some(0.45 * wing),
            ..size
        };
        let [a, b] = [size, wide].map(|size| text(&size));
        let stroke = |text: &str| -> f64 {
            let (_, from) = text.split_once("sine_deg = [").unwrap();
            from.split_once(']').unwrap().0.parse().unwrap()
        };
        assert!((numbers(&b)[1] / (0.45 * wing) - 1.0).abs() < ROUNDING);
        assert!(stroke(&b) < stroke(&a));
    }
}

#[test]
fn refuses_chords_that_no_wing_has() {
    let size = Size {
        wing_length: Some(0.07),
        mean_chord: Some(5e-3),
        ..Size::default()
    };
    let said = case_of_size(&size, InsectAir::BladeElement)
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("--chord 5.0mm is out of proportion") && said.contains("from 7.0 to 70.0 mm"),
        "{said}"
    );
}
