//! What dampers and stops take up, where steps are long beside what happens at them.

use std::path::Path;

use crate::common::fly;
use wingbeat_case::LoadedCase;
use wingbeat_flight::Record;

/// A pendulum without weight on a hinge with this element, that starts at this rate \[deg/s\], in steps of 1 ms.
fn flight(element: &str, rate: f64) -> Vec<Record> {
    let text = format!(
        "format = 1\ngravity_m_s2 = [0, 0, 0]\n[time]\nstep_s = 0.001\nsteps = 400\n[flight]\nmode = \"tethered\"\n\
         [air]\nmodel = \"none\"\n[body]\nmass_kg = 1\ninertia_about_centre_kg_m2 = [0.1, 0.1, 0.1, 0, 0, 0]\n\
         [segment.a]\nmass_kg = 0.5\ncentre_m = [0, 0, 0.3]\ninertia_about_centre_kg_m2 = [0.01, 0.02, 0.015, 0, 0, 0]\n\
         [joint.ja]\nchild = \"a\"\nat_m = [0, 0, 0]\nkind = \"revolute\"\naxis = [0, 1, 0]\nstart_deg_s = [{rate}]\n\
         element = [{element}]\n"
    );
    fly(LoadedCase::from_text("pendulum", &text, Path::new(""), &[])
        .unwrap()
        .setup)
}

/// A hinge that only a damped stop acts at: its work is that of the hinge, and what has been lost of the energy
/// of the motion. Counted from step to step it was 10 % off: the stop rings at 460 Hz.
#[test]
fn balances_work_of_a_damped_stop_with_the_energy_of_the_motion() {
    let stop = "{ stop = { lower_deg = -5, upper_deg = 5, stiffness_newton_m_per_rad = 1e4, damping_s_per_rad = 1 } }";
    let records = flight(stop, 200.0);
    let start = records[0].kinetic_energy;
    let gap =
        |f: &dyn Fn(&Record) -> f64| records.iter().map(|r| f(r).abs()).fold(0.0, f64::max) / start;
    let of_hinge = gap(&|r| r.passive_work - r.hinge_work);
    let of_motion = gap(&|r| r.passive_work - (r.kinetic_energy - start));
    println!(
        "beside the work of the hinge {of_hinge:.1e}, the energy of the motion {of_motion:.1e}"
    );
    // The force of a stop jumps as it is met.
    assert!(of_hinge < 1e-5 && of_motion < 1e-5);
    let lost = 1.0 - records.last().unwrap().kinetic_energy / start;
    println!("lost {lost:.3}");
    assert!(lost > 0.9);
}

/// A hinge with a damper alone slows down as exp(-c t / I).
#[test]
fn exact_work_of_a_damper() {
    let records = flight("{ damping_newton_m_s_per_rad = 0.5 }", 100.0);
    let (start, inertia) = (records[0].kinetic_energy, 0.02 + 0.5 * 0.09);
    for r in &records {
        let exact = start * ((-2.0 * 0.5 / inertia * r.time).exp() - 1.0);
        assert!(
            (r.passive_work - exact).abs() < 1e-8 * start,
            "{} s",
            r.time
        );
    }
}
