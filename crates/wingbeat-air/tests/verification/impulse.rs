//! Force against the rate of change of the impulse of all vorticity.

use crate::common::{fly, order, rectangle, total_force, translating};
use std::f64::consts::{PI, TAU};
use wingbeat_air::{
    AirLoads, AirSettings, CirculationRate, CoreModel, Lattice, LoadMethod, SheddingKinds, Surface,
};
use wingbeat_math::DVec3;

const NONE: SheddingKinds = SheddingKinds {
    trailing: false,
    tip: false,
    leading: false,
    root: false,
};

fn wing(rows: usize, cols: usize, shedding: SheddingKinds) -> Lattice {
    let settings = AirSettings {
        shedding,
        ..AirSettings::benchmark(1.2, DVec3::ZERO).with_cut_off_for(0.01)
    };
    Lattice::new(vec![Surface::grid("wing", rows, cols)], settings).unwrap()
}

/// Normal forces from pressure and from impulse in the last of `steps` steps of a wing of chord 1
/// and span 3 that advances along -x and heaves smoothly along z.
fn heaving(rows: usize, cols: usize, steps: usize) -> [f64; 2] {
    let lattice = wing(rows, cols, SheddingKinds::TRAILING);
    let flat = rectangle(rows, cols, DVec3::X, 3.0 * DVec3::Y);
    let motion = |t: f64| {
        let path = DVec3::new(-t, 0.0, 0.2 * (1.0 - (2.0 * t).cos()));
        let velocity = DVec3::new(-1.0, 0.0, 0.4 * (2.0 * t).sin());
        translating(flat.iter().map(|x| *x + path).collect(), velocity)
    };
    let dt = 2.0 / steps as f64;
    let mut impulse = [DVec3::ZERO; 2];
    let run = fly(&lattice, motion, dt, steps, |_, state, _, ws| {
        impulse = [impulse[1], lattice.impulse(state, ws).unwrap()];
    })
    .unwrap();
    let rate = (impulse[1] - impulse[0]) / dt;
    [total_force(&run.loads).z, -rate.z]
}

/// Without wake and sliding the pressure is `rho dGamma/dt` alone, and force is exactly the rate of
/// the impulse of the rings.
#[test]
fn conserves_impulse_of_a_plate_without_wake() {
    let lattice = wing(4, 6, NONE);
    let flat = rectangle(4, 6, DVec3::X, 2.0 * DVec3::Y);
    let motion = |t: f64| {
        let path = DVec3::new(0.0, 0.0, t * t * t);
        let velocity = DVec3::new(0.0, 0.0, 3.0 * t * t);
        translating(flat.iter().map(|x| *x + path).collect(), velocity)
    };
    let mut impulse = Vec::new();
    let run = fly(&lattice, motion, 0.1, 3, |_, state, _, ws| {
        impulse.push(lattice.impulse(state, ws).unwrap());
    })
    .unwrap();
    let rate = (impulse[3] - impulse[2]) / 0.1;
    let force = total_force(&run.loads);
    assert!(force.z < -0.1); // the air resists the acceleration
    assert!((force + rate).length() < 1e-12 * force.length()); // roundings
}

/// With a wake the pressure jump is taken at control points: force and impulse agree in the limit
/// of fine panels and steps.
#[test]
fn conserves_impulse_of_a_heaving_wing_at_first_order() {
    let mut errors = Vec::new();
    for k in [1, 2, 4] {
        let [force, rate] = heaving(3 * k, 4 * k, 10 * k);
        println!("heave: pressure {force:.5}, impulse {rate:.5}");
        errors.push((force - rate) / rate);
    }
    assert!(errors[2].abs() < 0.03, "{errors:?}");
    assert!(order(errors[0], errors[2]) / 2.0 > 0.7, "{errors:?}");
}

/// Complex lift over pi q c of a long plate that plunges with the reduced frequency 1, down by `e^{i w t}` half
/// chords, in steps of so many panels: by pressures and by the impulse, as [real, imaginary].
fn plunging(rows: usize, step: f64, loads: LoadMethod) -> [[f64; 2]; 2] {
    const SPAN: f64 = 1e4;
    let (period, amplitude) = (PI, 1e-4);
    let per_period = (period * rows as f64 / step).round() as usize;
    let (dt, w) = (period / per_period as f64, TAU / period);
    let core = CoreModel::Scully { radius: 1e-8 };
    let settings = AirSettings {
        bound_core: core,
        wake_core: core,
        loads,
        ..AirSettings::accurate(1.0, DVec3::X)
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", rows, 1)], settings).unwrap();
    let flat = rectangle(rows, 1, DVec3::X, SPAN * DVec3::Y);
    let motion = |t: f64| {
        let (s, c) = (w * t).sin_cos();
        let shift = -0.5 * amplitude * c * DVec3::Z;
        let nodes = flat.iter().map(|x| *x + shift).collect();
        translating(nodes, 0.5 * amplitude * w * s * DVec3::Z)
    };
    let (mut lift, mut impulse) = (vec![], vec![]);
    fly(&lattice, motion, dt, 3 * per_period, |_, _, loads, _| {
        lift.push(total_force(loads).z);
        impulse.push(loads.impulse.z);
    })
    .unwrap();
    let harmonic = |x: &dyn Fn(usize) -> f64| {
        let phase = |i: usize| TAU * i as f64 / per_period as f64;
        let sum = |part: fn(f64) -> f64| -> f64 {
            let steps = 0..per_period;
            steps
                .map(|i| x(2 * per_period + i - 1) * part(phase(i) - phase(1)))
                .sum()
        };
        let scale = 0.25 * PI * amplitude * SPAN * per_period as f64;
        [sum(f64::cos) / scale, -sum(f64::sin) / scale]
    };
    let rate = |i: usize| (impulse[i - 1] - impulse[i + 1]) / (2.0 * dt);
    [harmonic(&|i| lift[i]), harmonic(&rate)]
}

/// In steps of less than a panel a part of what is shed waits on the trailing edge. It stands for vorticity on
/// the plate, which feels a force: with all of it but half of what leaves within a step, the lift has no more
/// error than the impulse, that of eight panels. With half of all it was off by 3.4 and 2.9 %.
#[test]
fn limit_theodorsen_lift_of_a_plunging_plate_in_steps_of_less_than_a_panel() {
    let [f, g] = [0.539_4, -0.100_3]; // C(1) [Bisplinghoff, Ashley, Halfman, table 5-1]
    let exact = [-1.0 - 2.0 * g, 2.0 * f];
    let apart = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) / b[0].hypot(b[1]);
    for (step, most) in [(0.25, 0.031), (0.5, 0.026)] {
        for loads in [LoadMethod::Pressure, LoadMethod::Joukowski] {
            let [force, impulse] = plunging(8, step, loads);
            let [off, of_impulse] = [force, impulse].map(|lift| apart([lift, exact]));
            let both = apart([force, impulse]);
            println!("{loads:?}, steps of {step} panels: {off:.4}, {of_impulse:.4}, {both:.4}");
            assert!(off < most && both < 0.01);
        }
    }
}

/// Added mass per span of a long plate: `pi/4 rho chord^2` [Lamb art. 71]. Rings on the true edges
/// overrate it by order panel size.
#[test]
fn limit_added_mass_of_a_long_plate() {
    let errors = [8, 16].map(|rows| {
        let lattice = wing(rows, 1, NONE);
        let flat = rectangle(rows, 1, DVec3::X, 200.0 * DVec3::Y);
        let motion = |t: f64| {
            translating(
                flat.iter().map(|x| *x + t * t * DVec3::Z).collect(),
                2.0 * t * DVec3::Z,
            )
        };
        let run = fly(&lattice, motion, 0.01, 1, |_, _, _, _| {}).unwrap();
        let added = -total_force(&run.loads).z / (2.0 * 1.2 * 200.0);
        added / std::f64::consts::FRAC_PI_4 - 1.0
    });
    println!("added mass of a long plate {errors:.4?}");
    assert!(errors[1].abs() < 0.08 && order(errors[0], errors[1]) > 0.8);
}

/// A heaving plate without wake has circulation in proportion to its speed 3 t^2, a polynomial that
/// the two-step difference differentiates exactly, even with steps of different lengths.
#[test]
fn exact_second_order_rate_of_a_quadratic_circulation() {
    let settings = AirSettings {
        rate: CirculationRate::BackwardSecond,
        ..wing(3, 3, NONE).settings().clone()
    };
    let lattice = Lattice::new(vec![Surface::grid("wing", 3, 3)], settings).unwrap();
    let flat = rectangle(3, 3, DVec3::X, DVec3::Y);
    let at = |t: f64| translating(flat.clone(), 3.0 * t * t * DVec3::Z);
    let mut state = lattice.initial_state(&at(0.0));
    let (mut ws, mut loads) = (lattice.workspace(), AirLoads::default());
    let times = [0.1, 0.2, 0.35, 0.4];
    for (k, &t) in times.iter().enumerate() {
        let dt = t - times[k.saturating_sub(1)];
        let now = at(t);
        lattice
            .loads(&state, t, dt, &now, &mut ws, &mut loads)
            .unwrap();
        lattice.accept(&mut state, &now, &loads).unwrap();
        lattice.convect(&mut state, 0.05, &mut ws).unwrap();
    }
    let t = 0.4;
    for (gamma, rate) in loads.gamma.iter().zip(&loads.gamma_rate) {
        assert!((rate - gamma * 2.0 / t).abs() < 1e-12); // roundings over steps of 0.05
    }
}
