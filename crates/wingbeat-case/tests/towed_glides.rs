//! Gliders in air with a memory: the vortex lattice, strips with wakes, and wings that bend.

use std::path::Path;
use std::sync::LazyLock;

use wingbeat_analysis::wake::{
    WakeMemory, WakeSettings, WakeTrim, elastic_floquet, steady_model, trim_with_wake, wake_floquet,
};
use wingbeat_analysis::{Plane, Trim, TrimRequest, Unknown, power_with_wake, trim};
use wingbeat_case::{LoadedCase, wake_trimmed_case};
use wingbeat_flight::{MotionMode, PrescribedMotion, Record, Simulation};
use wingbeat_math::DVec3;

/// A glider of joined wings and a tail above their wake, on a body whose mass centre is at its origin.
const LATTICE: &str = r#"
format = 1
name = "glider"
time = { step_s = 6e-3, steps = 40 }
flight = { velocity_m_s = [6, 0, 0.5] }
body = { mass_kg = 0.03, inertia_about_centre_kg_m2 = [1e-4, 3e-4, 3.5e-4, 0, 0, 0] }
[air]
body = false
density_kg_m3 = 1.225
shed = ["trailing"]
section_drag = { friction = "none", cd0 = 0.02 }
[wing.right]
hinge_m = [0.02, 0, 0]
joined = true
mass_kg = 0
motion.psi.constant_deg = 4
motion.phi.constant_deg = 0
planform.outline = { leading_m = [[0, 0], [0.25, 0]], trailing_m = [[0, -0.08], [0.25, -0.08]] }
mesh = { chordwise = 2, spanwise = 6 }
[wing.right_tail]
hinge_m = [-0.25, 0, -0.06]
joined = true
mass_kg = 0
motion.psi.constant_deg = 0
motion.phi.constant_deg = 0
planform.outline = { leading_m = [[0, 0], [0.1, 0]], trailing_m = [[0, -0.05], [0.1, -0.05]] }
mesh = { chordwise = 2, spanwise = 3 }
"#;

fn case(text: &str, set: &[&str]) -> LoadedCase {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    LoadedCase::from_text("glider", text, Path::new(""), &set).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn probe() {
    let c = case(LATTICE, &[]);
    let t0 = std::time::Instant::now();
    let problem = TrimRequest::default().problem(&c.setup).unwrap();
    let mut s = WakeSettings::of(&c.setup);
    s.tolerance = 1e-7;
    let found = trim_with_wake(&c.setup, &problem, &s).unwrap();
    println!("{:?} {:?} {:?} flights {} {:?}", found.solution.values, found.solution.residual, found.tow, found.flights, t0.elapsed());
    println!("{:?}", found.glide());
    let text = wake_trimmed_case(&c, &found);
    println!("{text}");
    let t0 = std::time::Instant::now();
    let m = steady_model(&found).unwrap();
    println!("{:?} {:?} np {}", m.derivatives, t0.elapsed(), m.neutral_point());
    for x in &m.modes.modes { println!("{} {:?} {} {}", x.name, x.plane, x.growth, x.frequency); }
    println!("imb {:?}", m.imbalance);
    for mem in [WakeMemory::Given, WakeMemory::Carried] {
    let t0 = std::time::Instant::now();
        let m = wake_floquet(&found, mem).unwrap();
        println!("{mem:?} {:?}", t0.elapsed());
        for x in &m.modes { println!("{} {:?} {} {}", x.name, x.plane, x.growth, x.frequency); }
    }
    for held in [1,2,4,8,16,32] {
        let s = WakeSettings { held_beats: held, iterations: 0, ..s };
        let mut p = problem.clone();
        p.velocity = found.velocity; p.body_pitch = found.solution.body_pitch;
        let f = trim_with_wake(&c.setup, &p, &s).unwrap();
        println!("{:?} {:?}", f.tow, f.solution.residual);
    }
    println!("{:?}", power_with_wake(&found));
}
