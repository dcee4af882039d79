//! Strips with wakes of their own, against unsteady thin-airfoil theory.

mod functions;
mod suction;

use functions::theodorsen;
use std::f64::consts::{PI, TAU};
use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DMat3, DVec3, Wrench, r2};

/// Density, half chord and speed are 1; the axis is `a` half chords behind mid chord.
fn section(a: f64, unsteady: Option<Unsteady>) -> BladeWing {
    let settings = BladeSettings {
        translation: Translation::DoubleAngle {
            lift: PI,
            drag_0: 0.0,
            drag_90: 0.0,
        },
        unsteady,
        ..BladeSettings::insect(1.0)
    };
    let strip = Strip {
        y: 0.0,
        x_leading: 1.0 + a,
        chord: 2.0,
        width: 1.0,
    };
    BladeWing::new(vec![strip], settings).unwrap()
}

const PETERS: Unsteady = Unsteady::Peters { states: 6 };

/// A section with its wake: loads at ever later instants.
struct Flown {
    wing: BladeWing,
    memory: WingMemory,
    trial: Vec<StripTrial>,
}

impl Flown {
    fn new(wing: BladeWing) -> Self {
        Self {
            memory: wing.memory().expect("a wake"),
            wing,
            trial: vec![],
        }
    }

    /// The load by velocities at `time`, which is accepted.
    fn load(&mut self, time: f64, m: &BodyMotion, wind: impl LocalWind) -> Wrench {
        let lag = Lag::Trial {
            memory: &self.memory,
            time,
            trial: &mut self.trial,
        };
        let load = self.wing.lagging_load(m, wind, Some(lag));
        self.wing.accept(&mut self.memory, &self.trial, time);
        load
    }
}

fn along(velocity: DVec3) -> BodyMotion {
    BodyMotion {
        r: DMat3::IDENTITY,
        v: velocity,
        w: DVec3::ZERO,
        ..BodyMotion::REST
    }
}

/// Largest error of the lift after a step of the plunge, over the lift in the end, at s from 0 to 64.
fn wagner_error(theory: Unsteady) -> f64 {
    let (w, mut flown) = (1e-4, Flown::new(section(0.0, Some(theory))));
    let mut worst = 0.0_f64;
    for k in 0..=640 {
        let s = 0.1 * f64::from(k);
        let lift = -flown.load(s, &along(DVec3::new(1.0, 0.0, w)), Calm).force.z;
        let phi = lift / (TAU * w);
        assert!((phi - theory.indicial().at(s)).abs() < 1e-7, "{s}");
        if let Some(exact) = functions::WAGNER.iter().find(|e| (e.0 - s).abs() < 1e-9) {
            worst = worst.max((phi - exact.1).abs());
        }
    }
    worst
}

#[test]
fn order_lift_after_a_step_is_wagners_function_better_with_more_states() {
    let errors = [2, 4, 6, 8].map(|states| wagner_error(Unsteady::Peters { states }));
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
    // What the states leave of the function: 0.12, 0.029, 0.013, 0.0047; two exponentials 0.0087.
    assert!(errors[2] < 0.014 && errors[3] < 0.0052, "{errors:?}");
    assert!(wagner_error(Unsteady::Jones) < 0.0095);
}

#[test]
fn published_answer_to_oscillations_is_theodorsens_function() {
    // F and G of Theodorsen (1935); errors of the states as their authors found them.
    for (k, f, g) in [
        (0.05, 0.9090, -0.1306),
        (0.1, 0.8319, -0.1723),
        (0.2, 0.7276, -0.1886),
        (0.5, 0.5979, -0.1507),
        (1.0, 0.5394, -0.1003),
    ] {
        let exact = theodorsen(k);
        assert!((exact[0] - f).abs() < 1e-4 && (exact[1] - g).abs() < 1e-4);
        for (theory, allowed) in [
            (Unsteady::Jones, 0.025),
            (PETERS, 0.019),
            (Unsteady::Peters { states: 8 }, 0.013),
        ] {
            let here = theory.indicial().answer(k);
            let apart = (here[0] - f).hypot(here[1] - g) / f.hypot(g);
            assert!(apart < allowed, "{theory:?} {k}: {apart}");
        }
    }
}

/// Amplitudes of lift and of moment about the axis, nose up, over those of the motion: plunge (velocity) or
/// pitch (angle), of reduced frequency `k`, one after another of real and imaginary part.
fn flown_amplitudes(k: f64, a: f64, pitches: bool) -> [[f64; 2]; 2] {
    const SIZE: f64 = 1e-5;
    let mut flown = Flown::new(section(a, Some(PETERS)));
    let per = 600;
    let periods = (200.0 * k / TAU).ceil() as usize + 2;
    let mut sums = [[0.0; 2]; 2];
    for step in 0..=periods * per {
        let t = TAU / k * step as f64 / per as f64;
        let (sin, cos) = (k * t).sin_cos();
        let x = SIZE * [cos, -k * sin, -k * k * cos].map(|x| x)[0];
        let [v, acc] = [-SIZE * k * sin, -SIZE * k * k * cos];
        let (m, by) = match pitches {
            true => (
                BodyMotion {
                    r: r2(x),
                    v: DVec3::X,
                    w: DVec3::new(0.0, v, 0.0),
                    ..BodyMotion::REST
                },
                BodyAcceleration {
                    angular: DVec3::new(0.0, acc, 0.0),
                    ..BodyAcceleration::default()
                },
            ),
            false => (
                along(DVec3::new(1.0, 0.0, x)),
                BodyAcceleration {
                    linear: DVec3::new(0.0, 0.0, v),
                    ..BodyAcceleration::default()
                },
            ),
        };
        let mut load = flown.load(t, &m, Calm);
        let added = flown.wing.acceleration_load(&m, &by);
        load.force += added.force;
        load.moment += added.moment;
        if step > (periods - 1) * per {
            for (sum, x) in sums.iter_mut().zip([-load.force.z, load.moment.y]) {
                sum[0] += 2.0 / per as f64 * x * cos / SIZE;
                sum[1] -= 2.0 / per as f64 * x * sin / SIZE;
            }
        }
    }
    sums
}

/// Theodorsen's lift and moment for `C`: of a plunge of unit velocity or a pitch of unit angle [NACA Rep. 496, 1935].
fn published(k: f64, a: f64, pitches: bool, c: [f64; 2]) -> [[f64; 2]; 2] {
    // Rates of h and alpha; with h' = 1, h'' = i k.
    let (h1, h2) = match pitches {
        true => ([0.0, 0.0], [0.0, 0.0]),
        false => ([1.0, 0.0], [0.0, k]),
    };
    let (al, al1, al2) = match pitches {
        true => ([1.0, 0.0], [0.0, k], [-k * k, 0.0]),
        false => ([0.0; 2], [0.0; 2], [0.0; 2]),
    };
    let each = |f: &dyn Fn(usize) -> f64| [f(0), f(1)];
    let wash = each(&|i| h1[i] + al[i] + (0.5 - a) * al1[i]);
    let lagging = [
        c[0] * wash[0] - c[1] * wash[1],
        c[0] * wash[1] + c[1] * wash[0],
    ];
    let lift = each(&|i| PI * (h2[i] + al1[i] - a * al2[i]) + TAU * lagging[i]);
    let moment = each(&|i| {
        let air = a * h2[i] - (0.5 - a) * al1[i] - (0.125 + a * a) * al2[i];
        PI * air + TAU * (a + 0.5) * lagging[i]
    });
    [lift, moment]
}

#[test]
fn exact_lift_and_moment_of_plunge_and_pitch_are_theodorsens() {
    for (k, a, pitches) in [
        (0.05, -0.4, true),
        (0.05, 0.2, false),
        (0.2, -0.4, true),
        (0.5, 0.0, true),
        (0.5, -0.4, false),
        (1.0, -0.4, true),
        (1.0, 0.2, false),
    ] {
        let found = flown_amplitudes(k, a, pitches);
        // With the theory's own function, to the error of 600 steps a period; with Theodorsen's, to that of six states.
        let own = PETERS.indicial().answer(k);
        for (c, allowed) in [(own, 2e-4), (theodorsen(k), 0.018)] {
            let expected = published(k, a, pitches, c);
            for (x, y) in found.iter().zip(&expected) {
                let size = expected[0][0].hypot(expected[0][1]);
                let apart = (x[0] - y[0]).hypot(x[1] - y[1]) / size;
                assert!(apart < allowed, "{k} {a} {pitches}: {found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn published_lift_in_a_sharp_gust_is_kuessners_function() {
    let (gust, mut flown) = (1e-4, Flown::new(section(-0.3, Some(PETERS))));
    for k in 1..=3200 {
        let s = 0.01 * f64::from(k);
        // The front comes towards the wing, whose leading edge is at 0.7.
        let front = 0.7 - s;
        let wind = |r: DVec3| match r.x >= front {
            true => DVec3::new(0.0, 0.0, -gust),
            false => DVec3::ZERO,
        };
        // It flies straight on; the gust comes from below, against axis 3.
        let lift = -flown.load(s, &along(DVec3::X), wind).force.z / (TAU * gust);
        if let Some(exact) = functions::KUESSNER.iter().find(|e| (e.0 - s).abs() < 1e-9) {
            // The fit is good to 0.015; half a step of the front is 0.002 at first.
            assert!((lift - exact.1).abs() < 0.018, "{s}: {lift} {}", exact.1);
        }
    }
}

/// A section that pitches and plunges up and down through air that streams, or blows as a steady wind: forces
/// of the last period.
fn pitching(stream: DVec3, wind: DVec3) -> Vec<Wrench> {
    let settings = BladeSettings {
        free_stream: stream,
        ..*section(-0.3, Some(PETERS)).settings()
    };
    let strips = section(-0.3, None).strips().to_vec();
    let mut flown = Flown::new(BladeWing::new(strips, settings).unwrap());
    let (per, periods) = (40, 60);
    let load = |step: usize| {
        let t = 10.0 * step as f64 / per as f64;
        let (sin, cos) = (TAU * t / 10.0).sin_cos();
        let rotation = r2(0.8 * sin);
        let m = BodyMotion {
            r: rotation,
            v: DVec3::new(0.0, 0.0, 0.3 * cos),
            w: DVec3::new(0.0, 0.8 * TAU / 10.0 * cos, 0.0),
            ..BodyMotion::REST
        };
        flown.load(t, &m, |_| rotation.transpose() * wind)
    };
    let all: Vec<Wrench> = (0..=periods * per).map(load).collect();
    all[(periods - 1) * per..].to_vec()
}

#[test]
fn exact_steady_wind_is_a_stream_to_a_strip_that_turns() {
    // From ahead, and from behind: then the trailing edge is in front.
    for v in [DVec3::new(-1.0, 0.0, 0.2), DVec3::new(1.0, 0.0, 0.2)] {
        let pairs = pitching(v, DVec3::ZERO)
            .into_iter()
            .zip(pitching(DVec3::ZERO, v));
        for (a, b) in pairs {
            let apart = (a.force - b.force).length();
            assert!(apart < 1e-10 * a.force.length().max(1.0), "{a:?} {b:?}");
        }
    }
}

#[test]
fn invariant_gust_from_behind_is_met_by_the_trailing_edge() {
    // The gust comes up from behind and reaches the trailing edge, 1.3 behind the axis, at s = 2.
    let mut flown = Flown::new(section(-0.3, Some(PETERS)));
    for k in 1..=400 {
        let s = 0.01 * f64::from(k);
        let wind = |r: DVec3| match r.x <= s - 3.305 {
            true => DVec3::new(0.0, 0.0, -1e-4),
            false => DVec3::ZERO,
        };
        let lift = -flown.load(s, &along(-DVec3::X), wind).force.z;
        assert_eq!(lift != 0.0, s > 2.0, "{s}: {lift}");
    }
}

#[test]
fn limit_slow_motion_has_the_quasi_steady_force() {
    let steady = section(-0.2, None);
    for theory in [Unsteady::Jones, PETERS] {
        let mut flown = Flown::new(section(-0.2, Some(theory)));
        let m = along(DVec3::new(0.9, 0.0, 0.6));
        let mut load = Wrench::default();
        for k in 0..3000 {
            load = flown.load(f64::from(k), &m, Calm);
        }
        let expected = steady.velocity_load(&m);
        assert!((load.force - expected.force).length() < 1e-12, "{theory:?}");
        assert!((load.moment - expected.moment).length() < 1e-12);
    }
}

#[test]
fn order_of_downwash_that_is_no_straight_line_is_second() {
    // A plunge that swings about a mean, the way of the speed with it: against a fine step.
    let lift = |steps: usize| {
        let mut flown = Flown::new(section(0.0, Some(PETERS)));
        let mut last = 0.0;
        for k in 0..=steps {
            let t = 10.0 * k as f64 / steps as f64;
            let v = DVec3::new(1.0 + 0.5 * (0.7 * t).sin(), 0.0, 0.3 * (1.1 * t).sin());
            last = flown.load(t, &along(v), Calm).force.z;
        }
        last
    };
    let exact = lift(25_600);
    let errors = [50, 100, 200].map(|n| (lift(n) - exact).abs());
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.2, "{errors:?}");
    }
}

#[test]
fn behaves_smoothly_where_a_strip_turns_back() {
    // A stroke through rest, broadside on and backwards: loads stay within those of the largest speed and
    // change by little in a step.
    let mut flown = Flown::new(wing_of_insect());
    let (steps, mut before, mut largest) = (4000, None, 0.0_f64);
    for k in 0..=3 * steps {
        let t = TAU * f64::from(k) / f64::from(steps);
        let (u, w) = (t.cos(), 0.8 * (2.0 * t).sin());
        let load = flown.load(t, &along(DVec3::new(u, 0.0, w)), Calm).force;
        assert!(load.is_finite());
        largest = largest.max(load.length());
        if let Some(before) = before {
            let change: f64 = (load - before as DVec3).length();
            assert!(change < 0.02, "{t}: {change}");
        }
        before = Some(load);
    }
    // 1/2 rho c C V^2 with C at most 3.6 and V^2 at most 1.64.
    assert!(largest > 0.3 && largest < 6.0, "{largest}");
}

fn wing_of_insect() -> BladeWing {
    let settings = BladeSettings {
        unsteady: Some(Unsteady::Jones),
        added_mass: AddedMassModel::None,
        ..BladeSettings::insect(1.0)
    };
    BladeWing::new(section(0.0, None).strips().to_vec(), settings).unwrap()
}

#[test]
fn exact_periodic_memory_is_what_many_beats_come_to() {
    let fly = |from: WingMemory| {
        let mut flown = Flown {
            memory: from.at(0.0),
            ..Flown::new(section(0.0, Some(PETERS)))
        };
        for k in 0..=40 {
            let t = 0.5 * f64::from(k);
            let w = 0.1 * (TAU * t / 20.0).sin();
            flown.load(t, &along(DVec3::new(1.0, 0.0, w)), Calm);
        }
        flown.memory
    };
    let wing = section(0.0, Some(PETERS));
    let first = wing.memory().unwrap();
    let after = fly(first.clone());
    let periodic = wing.periodic(&first, &after);
    let next = fly(periodic.clone());
    let pairs = periodic.numbers().zip(next.numbers());
    for (a, b) in pairs {
        assert!((a - b).abs() < 1e-14, "{a} {b}");
    }
    assert_eq!(periodic.numbers().count(), 6);
    let moved = after.numbers().zip(periodic.numbers());
    assert!(moved.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) > 1e-3);
}

#[test]
fn refuses_more_states_than_help() {
    for states in [0, 1, 9] {
        let strips = section(0.0, None).strips().to_vec();
        let settings = BladeSettings {
            unsteady: Some(Unsteady::Peters { states }),
            ..BladeSettings::insect(1.0)
        };
        let e = BladeWing::new(strips, settings).unwrap_err().to_string();
        assert!(e.contains("unsteady.states") && e.contains("2 to 8"), "{e}");
    }
}
