//! Orders of convergence, agreement of the two formulations, and the limit of light wings.

use crate::common;

use common::*;
use wingbeat_dynamics::{
    Baumgarte, BodyMotion, DynamicsError, EulerForm, Formulation, MomentumForm,
};
use wingbeat_math::ode::{Convergence, Hamming, Memoryless, Multistep, Rk4, block_start};
use wingbeat_math::{DMat3, DQuat, DVec3, MassProperties};

/// Duration of the compared flights, in wingbeats.
const BEATS: usize = 2;

/// End of the flight under gravity and loads at `n` steps per beat.
fn end(form: &dyn Formulation, n: usize) -> BodyMotion {
    end_of_flight(form, applied, &start(), BEAT / n as f64, BEATS * n)
}

/// The reference: the momentum form at many steps (error below 1e-12, see the test of its order).
fn reference() -> BodyMotion {
    end(&MomentumForm::new(fly(GRAVITY)), 2560)
}

/// Errors in position (wing lengths) and attitude (rad) against the reference.
fn errors(form: impl Fn(usize) -> Box<dyn Formulation>, steps: &[usize]) -> [Vec<f64>; 2] {
    let exact = reference();
    let pairs = steps
        .iter()
        .map(|&n| distance(&end(form(n).as_ref(), n), &exact));
    let (p, r): (Vec<f64>, Vec<f64>) = pairs.unzip();
    [p, r]
}

#[test]
fn order_momentum_form_with_runge_kutta_is_four() {
    let [p, r] = errors(
        |_| Box::new(MomentumForm::new(fly(GRAVITY))),
        &[40, 80, 160, 320],
    );
    println!(
        "momentum form: position {p:.2?} attitude {r:.2?}",
        p = Sci(&p),
        r = Sci(&r)
    );
    for e in [&p, &r] {
        let o = orders(e);
        assert!(
            (o[1] - 4.0).abs() < 0.5 && (o[2] - 4.0).abs() < 0.3,
            "{o:?}"
        );
    }
    assert!(r[1] < 1e-6); // 80 steps per beat
}

#[test]
fn order_euler_form_with_fixed_baumgarte_is_four() {
    // alpha = beta = 1600 / s is 0.1 / h at 80 steps per beat, then held.
    let b = Baumgarte::for_step(BEAT / 80.0);
    let [p, r] = errors(
        |_| Box::new(EulerForm::new(fly(GRAVITY), b)),
        &[80, 160, 320, 640],
    );
    println!(
        "Euler form, fixed alpha: position {:?} attitude {:?}",
        Sci(&p),
        Sci(&r)
    );
    for e in [&p, &r] {
        let o = orders(e);
        assert!(
            (o[1] - 4.0).abs() < 0.5 && (o[2] - 4.0).abs() < 0.3,
            "{o:?}"
        );
    }
}

#[test]
fn order_euler_form_with_step_tied_baumgarte_is_lower() {
    // What the documentation says: alpha = a / h costs the order of the integrator.
    let form = |n: usize| -> Box<dyn Formulation> {
        Box::new(EulerForm::new(
            fly(GRAVITY),
            Baumgarte::for_step(BEAT / n as f64),
        ))
    };
    let [p, r] = errors(form, &[160, 320, 640]);
    println!(
        "Euler form, alpha = 0.1 / h: position {:?} attitude {:?}",
        Sci(&p),
        Sci(&r)
    );
    assert!(orders(&r)[1] < 3.5, "{:?}", orders(&r));
    assert!(r[2] < r[0] && p[2] < p[0]);
}

#[test]
fn agrees_both_forms_on_asymmetric_flapping_with_gravity_and_loads() {
    // At 640 steps per beat, each form integrated for itself from the same start.
    let b = Baumgarte::for_step(BEAT / 80.0);
    let [p, r] = errors(|_| Box::new(EulerForm::new(fly(GRAVITY), b)), &[640]);
    println!(
        "640 steps per beat, {BEATS} beats: position {:.1e}, attitude {:.1e}",
        p[0], r[0]
    );
    assert!(p[0] < 1e-7 && r[0] < 1e-7); // the acceptance limit
    let moved = distance(&reference(), &start());
    println!(
        "the flight: {:.2} wing lengths, {:.2} rad",
        moved.0, moved.1
    );
    assert!(moved.0 > 0.3 && moved.1 > 0.1); // a flight worth comparing
}

/// Numbers in scientific notation.
struct Sci<'a>(&'a [f64]);

impl std::fmt::Debug for Sci<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for e in self.0 {
            write!(f, "{e:.2e} ")?;
        }
        write!(f, "(orders {:.2?})", orders(self.0))
    }
}

/// The standard aircraft equations: one rigid body, u, v, w and p, q, r in body axes about its
/// mass centre (Etkin & Reid), written without anything of this crate.
fn aircraft(mass: &MassProperties, start: &BodyMotion, h: f64, steps: usize) -> BodyMotion {
    let (c, inertia) = (mass.centre(), mass.inertia_about_centre());
    let inverse = inertia.inverse();
    let q = DQuat::from_mat3(&start.r);
    let u = start.r.transpose() * start.v + start.w.cross(c);
    let x = start.p + start.r * c;
    let mut y: Vec<f64> = [x.to_array(), u.to_array(), start.w.to_array()].concat();
    y.extend(q.to_array());
    let v = |y: &[f64], i: usize| DVec3::from_slice(&y[i..]);
    let turn = |y: &[f64]| DQuat::from_slice(&y[9..]);
    let mut rk4 = Rk4::new(13);
    for n in 0..steps {
        rk4.advance(n as f64 * h, h, &mut y, |_, y, dy| {
            let (u, w, q) = (v(y, 3), v(y, 6), turn(y));
            let r = DMat3::from_quat(q.normalize());
            let couple = w * -1e-11; // the loads of `damped`
            (r * u).write_to_slice(&mut dy[0..]);
            (r.transpose() * GRAVITY - w.cross(u)).write_to_slice(&mut dy[3..]);
            (inverse * (couple - w.cross(inertia * w))).write_to_slice(&mut dy[6..]);
            (q * DQuat::from_xyzw(w.x, w.y, w.z, 0.0) * 0.5).write_to_slice(&mut dy[9..]);
            Ok::<(), DynamicsError>(())
        })
        .unwrap();
    }
    let r = DMat3::from_quat(turn(&y).normalize());
    BodyMotion {
        p: v(&y, 0) - r * c,
        r,
        v: r * (v(&y, 3) - v(&y, 6).cross(c)),
        w: v(&y, 6),
    }
}

/// A damping moment on the body.
fn damped(_: f64, motions: &[BodyMotion], out: &mut [wingbeat_dynamics::Wrench]) {
    out.fill(wingbeat_dynamics::Wrench::default());
    out[0].moment = motions[0].r * motions[0].w * -1e-11;
}

#[test]
fn limit_of_light_wings_is_the_rigid_aircraft_at_first_order() {
    let (h, n) = (BEAT / 160.0, 160 * BEATS);
    let rigid = aircraft(&body_mass(CENTRE), &start(), h, n);
    let light = |wing: f64| {
        let system = fly_with(CENTRE, wing, Flapping::left(), Flapping::right(), GRAVITY);
        let end = end_of_flight(&MomentumForm::new(system), damped, &start(), h, n);
        distance(&end, &rigid)
    };
    let (p, r): (Vec<f64>, Vec<f64>) = [1e-2, 1e-3, 1e-4]
        .map(|k| light(k * WING_MASS))
        .into_iter()
        .unzip();
    println!(
        "wing mass 1e-2, 1e-3, 1e-4 of a fly's: position {p:.2?} attitude {r:.2?}",
        p = Sci(&p),
        r = Sci(&r)
    );
    for e in [&p, &r] {
        for ratio in e.windows(2).map(|e| e[0] / e[1]) {
            assert!((ratio - 10.0).abs() < 0.3); // first order in the wing mass
        }
    }
    let (p, r) = light(0.0);
    println!("without wing mass: position {p:.1e}, attitude {r:.1e}");
    assert!(p < 1e-8 && r < 1e-8); // both integrated by Runge-Kutta, in different variables
}

#[test]
fn agrees_euler_form_without_wing_mass_with_the_momentum_form() {
    let system = fly_with(CENTRE, 0.0, Flapping::left(), Flapping::right(), GRAVITY);
    let form = EulerForm::new(system.clone(), Baumgarte::for_step(BEAT / 80.0));
    let a = end_of_flight(&form, damped, &start(), BEAT / 320.0, 640);
    let b = end_of_flight(
        &MomentumForm::new(system),
        damped,
        &start(),
        BEAT / 320.0,
        640,
    );
    let (p, r) = distance(&a, &b);
    println!("no wing mass, both forms: position {p:.1e}, attitude {r:.1e}");
    assert!(p < 1e-8 && r < 1e-8); // the body moves smoothly; Runge-Kutta at 320 steps per beat
}

const FIXED: Convergence = Convergence {
    tolerance: 0.0,
    max_passes: 2,
    relaxation: 1.0,
    accelerated_from: None,
};

/// Starting values from the block formulas, then Hamming's method to `steps`.
fn hamming(form: &dyn Formulation, h: f64, steps: usize) -> (Multistep, Hamming) {
    let mut flight = Flight::new(form, applied);
    let y0 = form.initial(0.0, &start()).unwrap();
    let tight = Convergence {
        tolerance: 1e-14,
        max_passes: 60,
        relaxation: 1.0,
        accelerated_from: None,
    };
    let mut f0 = vec![0.0; form.dim()];
    flight.rates(0.0, &y0, &mut f0).unwrap();
    let mut replay = Memoryless {
        t0: 0.0,
        step: h,
        rates: |t, y: &[f64], f: &mut [f64]| flight.rates(t, y, f),
    };
    let (mut past, _) = block_start(&y0, &f0, h, tight, &form.scales(), &mut replay).unwrap();
    let mut method = Hamming::new(h, FIXED, form.scales());
    go_on(&mut flight, &mut method, &mut past, 3, steps);
    (past, method)
}

fn go_on(flight: &mut Flight, method: &mut Hamming, past: &mut Multistep, from: usize, to: usize) {
    for n in from..to {
        let t = (n + 1) as f64 * method.step;
        method
            .advance(past, |y, dy| flight.rates(t, y, dy))
            .unwrap();
    }
}

#[test]
fn order_hamming_flies_both_forms_at_order_four() {
    let exact = reference();
    let b = Baumgarte::for_step(BEAT / 80.0);
    let forms: [Box<dyn Formulation>; 2] = [
        Box::new(MomentumForm::new(fly(GRAVITY))),
        Box::new(EulerForm::new(fly(GRAVITY), b)),
    ];
    for form in &forms {
        let (mut p, mut r) = (vec![], vec![]);
        for n in [160, 320, 640] {
            let (past, _) = hamming(form.as_ref(), BEAT / n as f64, BEATS * n);
            let mut flight = Flight::new(form.as_ref(), applied);
            let m = flight.motions(BEATS as f64 * BEAT, past.newest())[0];
            let (dp, dr) = distance(&m, &exact);
            p.push(dp);
            r.push(dr);
        }
        println!("Hamming: position {:?} attitude {:?}", Sci(&p), Sci(&r));
        for e in [&p, &r] {
            assert!(orders(e)[1] > 3.5, "{:?}", orders(e)); // four, up to five with its modifiers
        }
    }
}

#[test]
fn invariant_flight_restarts_bit_for_bit_from_a_saved_past() {
    for form in [
        Box::new(MomentumForm::new(fly(GRAVITY))) as Box<dyn Formulation>,
        Box::new(EulerForm::new(
            fly(GRAVITY),
            Baumgarte::for_step(BEAT / 80.0),
        )),
    ] {
        let h = BEAT / 80.0;
        let (whole, _) = hamming(form.as_ref(), h, 160);
        let (saved, _) = hamming(form.as_ref(), h, 77);
        let mut past = saved.clone();
        // A fresh workspace and a fresh method: nothing but the saved past carries over.
        let mut flight = Flight::new(form.as_ref(), applied);
        let mut method = Hamming::new(h, FIXED, form.scales());
        go_on(&mut flight, &mut method, &mut past, 77, 160);
        assert_eq!(past, whole);
    }
}
