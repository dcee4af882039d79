//! Wings whose prescribed deformation takes them through each other, or past each other.

use std::path::Path;

use wingbeat_case::LoadedCase;
use wingbeat_flight::FlightSetup;
use wingbeat_math::RotationLaw;
use wingbeat_model::FlownCrossings;

/// A flapping robot whose wings of one side beat against each other, with this motion of their chords.
fn robot(front: &str, back: &str) -> FlightSetup {
    let text = format!(
        "format = 1
[time]
steps_per_beat = 80
beats = 1
[motion]
frequency_hz = 17.0
stroke_plane_pitch_deg = 90.0
[flight]
mode = \"tethered\"
[air]
model = \"blade_element\"
[body]
mass_kg = 27.4e-3
inertia_about_centre_kg_m2 = [1.0e-4, 1.0e-4, 0.5e-4, 0, 0, 0]
[wing.front-right]
hinge_m = [8e-3, 10e-3, -27e-3]
mass_kg = 0.5e-3
planform.rectangle = {{ span_m = 140e-3, chord_m = 80e-3, axis_fraction = 0 }}
motion.phi.fourier = {{ mean_deg = 24, cosine_deg = [-22] }}
{front}
[wing.back-right]
hinge_m = [-8e-3, 10e-3, -27e-3]
mass_kg = 0.5e-3
planform.rectangle = {{ span_m = 140e-3, chord_m = 80e-3, axis_fraction = 0 }}
motion.phi.fourier = {{ mean_deg = -24, cosine_deg = [22] }}
{back}
"
    );
    let case = LoadedCase::from_text("robot", &text, Path::new("."), &[]);
    case.unwrap().setup
}

fn feathered(deg: f64) -> String {
    format!("motion.psi.fourier = {{ sine_deg = [{deg}] }}\n")
}

/// The same turn of all sections about the same axis.
fn twisted(deg: f64) -> String {
    format!(
        "deformation.axis_fraction = 0\ndeformation.twist = [{{ linear_deg = [{deg}, {deg}], fourier = {{ sine = [1] }} }}]\n"
    )
}

#[test]
fn agrees_crossings_of_twisted_wings_with_those_of_feathered_ones() {
    let rigid = robot(&feathered(-50.0), &feathered(50.0)).prescribed_crossings();
    assert!(
        rigid.len() >= 2 && rigid.iter().all(|c| c.part > 0.3),
        "{rigid:?}"
    );
    let setup = robot(&twisted(-50.0), &twisted(50.0));
    assert_eq!(setup.prescribed_crossings(), rigid);
    // As they are flown, too.
    let mut flown = FlownCrossings::new(&setup.animal, &setup.joined_pairs(), &[]);
    for k in 0..100 {
        let t = f64::from(k) / 100.0 / 17.0;
        let wings = setup.animal.wings.iter();
        let poses: Vec<_> = wings
            .map(|w| (w.hinge_b, w.motion.impulsive().at(t).c))
            .collect();
        flown.see(&poses, std::iter::empty(), |m| m.impulsive().phase_at(t)[0]);
    }
    let found: Vec<_> = flown.found().into_iter().map(|(c, _)| c).collect();
    assert_eq!(found, rigid);
}

#[test]
fn behaves_wings_that_twist_back_do_not_cross() {
    let both = |deg: f64| feathered(deg) + &twisted(-deg);
    let setup = robot(&both(-50.0), &both(50.0));
    assert_eq!(setup.prescribed_crossings(), []);
}
