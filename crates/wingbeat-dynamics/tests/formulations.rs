//! The three formulations of one system against each other: coordinates, reactions, multipliers;
//! momenta and drift over many beats; the singularity that only one of them has.

use crate::common;

use common::*;
use wingbeat_dynamics::{
    Baumgarte, BodyMotion, DynamicsError, EulerForm, Formulation, MomentumForm, QuaternionForm,
    Solution, Stabilization, System,
};
use wingbeat_math::ode::{
    AdamsBashforthMoulton, Convergence, Dop853, Hamming, Memoryless, Multistep, Rk4, Tolerance,
    block_start,
};
use wingbeat_math::{DVec3, EulerSequence};

/// Both wings beat unlike each other, away from the singularity of the Euler angles.
fn gentle(gravity: DVec3) -> System {
    let left = Flapping::new([-3.0, -38.0, 0.2], [-1.0, -9.0, 0.3], [-90.0, 35.0, 1.7]);
    fly_with(CENTRE, WING_MASS, left, Flapping::gentle(), gravity)
}

/// Motions and solutions at the ends of beats.
type Beats = Vec<(Vec<BodyMotion>, Solution)>;

/// Ten beats by the method of order eight at tolerance `tol`, projected or not at every `grid`-th
/// part of a beat.
fn adaptive(form: &dyn Formulation, start: &BodyMotion, tol: f64, grid: usize) -> Beats {
    let mut flight = Flight::new(form, applied);
    let mut ws = form.workspace();
    let tolerance = Tolerance {
        relative: tol,
        absolute: tol,
        max_steps: 10_000,
    };
    let mut method = Dop853::new(tolerance, form.scales());
    let mut y = form.initial(0.0, start).unwrap();
    let mut beats = vec![];
    for k in 0..10 * grid {
        let at = |k: usize| k as f64 * BEAT / grid as f64;
        method
            .integrate((at(k), at(k + 1)), &mut y, |t, y, dy| {
                flight.rates(t, y, dy)
            })
            .unwrap();
        form.normalise(at(k + 1), &mut y, &mut ws).unwrap();
        if (k + 1) % grid == 0 {
            let s = flight.solve(at(k + 1), &y).unwrap().clone();
            beats.push((flight.motions.clone(), s));
        }
    }
    beats
}

/// Largest differences over the beats: position (wing lengths), attitude (rad), reactions and
/// multipliers (relative to the largest of their kind).
fn gaps(a: &Beats, b: &Beats) -> [f64; 4] {
    let mut gap = [0.0_f64; 4];
    let forces = |s: &Solution| {
        s.hinges
            .iter()
            .map(|h| h.force.length())
            .fold(0.0, f64::max)
    };
    let moments = |s: &Solution| {
        s.hinges
            .iter()
            .map(|h| h.moment.length())
            .fold(0.0, f64::max)
    };
    let (force, moment) = a.iter().fold((0.0_f64, 0.0_f64), |(f, m), (_, s)| {
        (f.max(forces(s)), m.max(moments(s)))
    });
    for ((ma, sa), (mb, sb)) in a.iter().zip(b) {
        for (x, y) in ma.iter().zip(mb) {
            let (p, r) = distance(x, y);
            (gap[0], gap[1]) = (gap[0].max(p), gap[1].max(r));
        }
        for (x, y) in sa.hinges.iter().zip(&sb.hinges) {
            let f = (x.force - y.force).length() / force;
            gap[2] = gap[2].max(f).max((x.moment - y.moment).length() / moment);
        }
        let connection = 3 * sa.hinges.len();
        for (i, (x, y)) in sa.multipliers.iter().zip(&sb.multipliers).enumerate() {
            let unit = if i < connection { force } else { moment };
            gap[3] = gap[3].max((x - y).abs() / unit);
        }
    }
    gap
}

fn forms(system: &System, a: Baumgarte) -> [Box<dyn Formulation>; 3] {
    [
        Box::new(EulerForm::new(system.clone(), a)),
        Box::new(QuaternionForm::new(
            system.clone(),
            Stabilization::Baumgarte(a),
        )),
        Box::new(MomentumForm::new(system.clone())),
    ]
}

/// Numbers with two digits.
fn sci<const N: usize>(x: [f64; N]) -> String {
    x.map(|x| format!("{x:.1e}")).join(" ")
}

fn largest<const N: usize>(x: [f64; N]) -> f64 {
    x.into_iter().fold(0.0, f64::max)
}

#[test]
fn agrees_three_forms_over_ten_beats_at_tight_settings() {
    let system = gentle(GRAVITY);
    let [e, q, m] = forms(&system, Baumgarte::for_step(BEAT / 80.0))
        .map(|f| adaptive(f.as_ref(), &start(), 1e-13, 10));
    let (a, b) = (gaps(&m, &e), gaps(&m, &q));
    println!("position, attitude, reactions, multipliers after ten beats");
    println!("(a) against (c): {}\n(b) against (c): {}", sci(a), sci(b));
    assert!(largest(a) < 1e-9 && largest(b) < 1e-9); // some 1e5 evaluations at 1e-13
    let (p, r) = distance(&m[9].0[0], &start());
    assert!(
        p > 1.0 && r > 0.3,
        "a flight worth comparing: {p} wing lengths, {r} rad"
    );
}

#[test]
fn agrees_three_forms_over_ten_beats_at_default_settings() {
    // The default for dynamics alone: order eight at 1e-10 on a grid of 80 steps per beat, and the
    // step-tied stabilization.
    let system = gentle(GRAVITY);
    let [e, q, m] = forms(&system, Baumgarte::for_step(BEAT / 80.0))
        .map(|f| adaptive(f.as_ref(), &start(), 1e-10, 80));
    let (a, b) = (gaps(&m, &e), gaps(&m, &q));
    println!("(a) against (c): {}\n(b) against (c): {}", sci(a), sci(b));
    assert!(a[0].max(b[0]) < 1e-6 && a[1].max(b[1]) < 1e-5);
    let projected = adaptive(
        &QuaternionForm::new(system, Stabilization::Projection),
        &start(),
        1e-10,
        80,
    );
    println!("(b) projected:   {}", sci(gaps(&m, &projected)));
    assert!(largest(gaps(&m, &projected)) < 1e-9);
}

#[test]
fn agrees_quaternion_and_momentum_form_through_the_euler_singularity() {
    // A body that yaws through 90 degrees, where the seed's 2-3-1 angles are singular.
    let turning = BodyMotion {
        r: EulerSequence::BODY_231.rotation(DVec3::new(0.0, 1.2, 0.0)),
        w: DVec3::new(0.0, 0.0, 60.0),
        ..start()
    };
    let system = gentle(GRAVITY);
    let [euler, quaternion, momentum] = forms(&system, Baumgarte::for_step(BEAT / 80.0));
    let (q, m) = (
        adaptive(quaternion.as_ref(), &turning, 1e-13, 10),
        adaptive(momentum.as_ref(), &turning, 1e-13, 10),
    );
    let gap = gaps(&m, &q);
    println!("through the singularity, (b) against (c): {}", sci(gap));
    assert!(largest(gap) < 1e-9);
    // The Euler form says so, and when.
    let mut flight = Flight::new(euler.as_ref(), applied);
    let mut y = flight.form.initial(0.0, &turning).unwrap();
    let end = flight.fly(BEAT / 80.0, 800, &mut y, |_, _, _, _| {});
    match end {
        Err(e @ DynamicsError::Singular { .. }) => println!("{e}"),
        other => panic!("{other:?}"),
    }
}

/// Largest changes over 200 beats in vacuum: linear and angular momentum (in natural units: mass,
/// wing length, period), violation of positions (wing lengths) and orientations.
fn long_flight(form: &dyn Formulation) -> [f64; 4] {
    let mut flight = Flight::new(form, none);
    let (mut ws, mut method) = (form.workspace(), single_steps(form));
    // Slow and from the origin: rounding of far positions is none of the method's.
    let near = BodyMotion {
        p: DVec3::ZERO,
        r: EulerSequence::BODY_231.rotation(DVec3::new(0.15, 0.1, -0.2)),
        v: DVec3::new(0.02, -0.01, 0.005),
        w: DVec3::new(3.0, -8.0, 5.0),
    };
    let mut y = form.initial(0.0, &near).unwrap();
    let first = flight.solve(0.0, &y).unwrap().budget;
    let mass = form.system().total_mass();
    let (h, mut worst) = (BEAT / 80.0, [0.0_f64; 4]);
    for n in 0..200 * 80 {
        let rates = |t: f64, y: &[f64], dy: &mut [f64]| flight.rates(t, y, dy);
        let ends = (n as f64 * h, (n + 1) as f64 * h);
        method.integrate(ends, &mut y, rates).unwrap();
        let t = (n + 1) as f64 * h;
        form.normalise(t, &mut y, &mut ws).unwrap();
        if n % 16 == 15 {
            let s = flight.solve(t, &y).unwrap();
            let (p, q) = (s.budget.momentum, s.budget.angular_momentum);
            let changes = [
                (p - first.momentum).length() / (mass * LENGTH / BEAT),
                (q - first.angular_momentum).length() / (mass * LENGTH * LENGTH / BEAT),
                s.violation.position / LENGTH,
                s.violation.orientation,
            ];
            (0..4).for_each(|k| worst[k] = worst[k].max(changes[k]));
        }
    }
    worst
}

#[test]
fn conserves_momenta_over_two_hundred_beats_in_vacuum() {
    let system = gentle(DVec3::ZERO);
    let momentum = long_flight(&MomentumForm::new(system.clone()));
    let projected = long_flight(&QuaternionForm::new(system, Stabilization::Projection));
    println!("P, H, position, orientation over 200 beats");
    println!("(c) {}\n(b), projected {}", sci(momentum), sci(projected));
    // (c): rounding. (b): order eight at 80 steps per beat leaves rounding, too. (a) meets its
    // singularity on so long a tumble.
    assert!(momentum[0] < 1e-12 && momentum[1] < 1e-12);
    assert!(projected[0] < 1e-12 && projected[1] < 1e-12);
    assert!(projected[2] < 1e-10 && projected[3] < 1e-10);
}

/// Root after `beats` beats by an integrator with `n` steps per beat.
type Method = fn(&dyn Formulation, usize, usize) -> BodyMotion;

/// Name, method, its order, the least number of steps per beat, the forms it flies.
type Case<'a> = (&'a str, Method, f64, usize, &'a [&'a dyn Formulation]);

fn multistep(form: &dyn Formulation, h: f64) -> Multistep {
    let mut flight = Flight::new(form, applied);
    let y0 = form.initial(0.0, &start()).unwrap();
    let mut f0 = vec![0.0; form.dim()];
    flight.rates(0.0, &y0, &mut f0).unwrap();
    let mut replay = Memoryless {
        t0: 0.0,
        step: h,
        rates: |t, y: &[f64], f: &mut [f64]| flight.rates(t, y, f),
    };
    let tight = Convergence {
        tolerance: 1e-14,
        max_passes: 60,
        relaxation: 1.0,
        accelerated_from: None,
    };
    block_start(&y0, &f0, h, tight, &form.scales(), &mut replay)
        .unwrap()
        .0
}

fn end(form: &dyn Formulation, beats: usize, y: &[f64]) -> BodyMotion {
    Flight::new(form, applied).motions(beats as f64 * BEAT, y)[0]
}

fn by_hamming(form: &dyn Formulation, n: usize, beats: usize) -> BodyMotion {
    let h = BEAT / n as f64;
    let mut past = multistep(form, h);
    let settings = Convergence {
        tolerance: 1e-10,
        max_passes: 30,
        relaxation: 1.0,
        accelerated_from: None,
    };
    let mut method = Hamming::new(h, settings, form.scales());
    let mut flight = Flight::new(form, applied);
    for k in 3..n * beats {
        let t = (k + 1) as f64 * h;
        method
            .advance(&mut past, |y, dy| flight.rates(t, y, dy))
            .unwrap();
    }
    end(form, beats, past.newest())
}

fn by_adams(form: &dyn Formulation, n: usize, beats: usize) -> BodyMotion {
    let h = BEAT / n as f64;
    let mut past = multistep(form, h);
    let mut method = AdamsBashforthMoulton::new(h, form.dim());
    let mut flight = Flight::new(form, applied);
    for k in 3..n * beats {
        let t = (k + 1) as f64 * h;
        method
            .advance(&mut past, |y, dy| flight.rates(t, y, dy))
            .unwrap();
    }
    end(form, beats, past.newest())
}

fn one_step(
    form: &dyn Formulation,
    n: usize,
    beats: usize,
    mut step: impl FnMut(&mut Flight, f64, f64, &mut [f64]) -> Result<(), DynamicsError>,
) -> BodyMotion {
    let (h, mut flight, mut ws) = (
        BEAT / n as f64,
        Flight::new(form, applied),
        form.workspace(),
    );
    let mut y = form.initial(0.0, &start()).unwrap();
    for k in 0..n * beats {
        step(&mut flight, k as f64 * h, h, &mut y).unwrap();
        form.normalise((k + 1) as f64 * h, &mut y, &mut ws).unwrap();
    }
    end(form, beats, &y)
}

fn by_runge_kutta(form: &dyn Formulation, n: usize, beats: usize) -> BodyMotion {
    let mut rk4 = Rk4::new(form.dim());
    one_step(form, n, beats, |f, t, h, y| {
        rk4.advance(t, h, y, |t, y, dy| f.rates(t, y, dy))
    })
}

/// The method of order eight with one step from end to end, whatever its error: a first step that is too long is cut
/// to the interval.
fn single_steps(form: &dyn Formulation) -> Dop853 {
    let tolerance = Tolerance {
        relative: 0.0,
        absolute: 1.0,
        max_steps: 1,
    };
    Dop853::new(tolerance, form.scales()).starting_with(2.0)
}

fn by_order_eight(form: &dyn Formulation, n: usize, beats: usize) -> BodyMotion {
    let mut method = single_steps(form);
    one_step(form, n, beats, |f, t, h, y| {
        (method.integrate((t, t + h), y, |t, y, dy| f.rates(t, y, dy))).unwrap();
        Ok(())
    })
}

#[test]
fn order_of_every_integrator_with_every_form() {
    let system = gentle(GRAVITY);
    let exact = by_order_eight(&MomentumForm::new(system.clone()), 320, 2);
    let fixed = Baumgarte::for_step(BEAT / 40.0);
    let [e, q, m] = forms(&system, fixed);
    let projected: Box<dyn Formulation> = Box::new(QuaternionForm::new(
        system.clone(),
        Stabilization::Projection,
    ));
    let seed: Box<dyn Formulation> = Box::new(EulerForm::new(system, Baumgarte::OFF));
    // Multistep methods take no projected states: projection is for one-step methods.
    let cases: [Case; 4] = [
        ("Hamming", by_hamming, 4.0, 80, &[&*e, &*q, &*m]),
        ("Adams", by_adams, 4.0, 160, &[&*e, &*q, &*m]),
        (
            "Runge-Kutta",
            by_runge_kutta,
            4.0,
            80,
            &[&*e, &*q, &*m, &*projected, &*seed],
        ),
        (
            "order eight",
            by_order_eight,
            8.0,
            10,
            &[&*e, &*q, &*m, &*projected, &*seed],
        ),
    ];
    for (name, method, order, n, forms) in cases {
        for (k, form) in forms.iter().enumerate() {
            let error = |n: usize| distance(&method(*form, n, 2), &exact);
            let (p, r): (Vec<f64>, Vec<f64>) = [n, 2 * n, 4 * n].map(error).into_iter().unzip();
            // Over both halvings: at order eight the last error is near rounding.
            let slopes = [&p, &r].map(|e| 0.5 * (e[0] / e[2]).log2());
            println!(
                "{name}, form {k}: position {}, attitude {}, orders {slopes:.1?}",
                list(&p),
                list(&r)
            );
            assert!(slopes.iter().all(|o| *o > order - 1.0), "{slopes:?}");
        }
    }
}

#[test]
fn agrees_attitude_after_two_hundred_beats_at_default_settings() {
    let m = MomentumForm::new(gentle(GRAVITY));
    let exact = by_order_eight(&m, 160, 200);
    // Order eight is the default without air. Hamming's method is the one coupled with a wake,
    // whose own error is larger by far; over 200 beats it keeps four digits less.
    for (name, end, allowed) in [
        ("order eight", by_order_eight(&m, 80, 200), 1e-6),
        ("Hamming", by_hamming(&m, 80, 200), 1e-4),
    ] {
        let (p, r) = distance(&end, &exact);
        println!("{name}, 80 steps per beat, 200 beats: {p:.1e} wing lengths, {r:.1e} rad");
        assert!(r < allowed);
    }
}

fn list(x: &[f64]) -> String {
    sci([x[0], x[1], x[2]])
}
