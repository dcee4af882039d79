//! Episodes that are steered from outside.

use crate::common;

use std::sync::{Arc, Mutex};

use wingbeat_analysis::control::{
    Held, Law, Reference, Regulator, SteeredBeats, Steering, Weights, adjustments, disturbed, sides,
};
use wingbeat_analysis::episode::{
    CALM_BEATS, CALM_SPEED, CALM_TILT, Course, Draw, Episode, Flyer, Model, OBSERVED, SharedModel,
    Start, SteadyStroke, SteeredStroke, Task, Transition, Tumbles,
};
use wingbeat_analysis::{Beat, Perturbation, Trim};
use wingbeat_dynamics::Formulation;
use wingbeat_flight::{AirModel, MotionBlend};
use wingbeat_math::{DVec3, RotationLaw};
use wingbeat_model::motion::Adjustment;
use wingbeat_model::{Start as Beginning, WingMotion};

const STEPS: usize = 40;

fn model(trim: &Trim) -> SharedModel {
    Arc::new(Mutex::new(Model::new(trim).expect("a model")))
}

/// In air that has no wind a gust would never come.
#[test]
fn refuses_gusts_where_none_blow() {
    let mut trim = common::hovering(STEPS);
    assert!(Course::new(Task::Gust, trim.clone()).is_ok());
    trim.setup.air = AirModel::None;
    assert!(Course::new(Task::Hover, trim.clone()).is_ok());
    let refused = Course::new(Task::Gust, trim).map(drop).unwrap_err();
    let said = refused.to_string();
    for word in ["no air", "blade_element", "hover"] {
        assert!(said.contains(word), "{said}");
    }
}

/// The map of a beat has the wings' motions themselves blended and tabulated; the flyer blends commands. The
/// same method in the same steps, so they differ by rounding, which grows over unstable beats.
#[test]
fn agrees_a_steered_flyer_with_the_map_of_a_beat() {
    let trim = common::hovering(STEPS);
    let start = Start {
        by: Perturbation {
            tilt: DVec3::new(0.1, -0.05, 0.2),
            velocity: DVec3::new(0.02, 0.01, -0.03),
            rate: DVec3::new(5.0, -3.0, 2.0),
        },
        gust: None,
    };
    let mut flyer = Flyer::new(&trim, &model(&trim), &start).expect("a flyer");
    let mut y = flyer.state().clone();
    let sides = sides(&trim.setup);
    let mut from = vec![Adjustment::default(); sides.len()];
    for command in [[0.1, 0.05, -0.1, 0.08], [-0.05, 0.1, 0.15, 0.0], [0.0; 4]] {
        flyer.fly(&trim, &command, STEPS).expect("a beat");
        let to = adjustments(&command, &sides);
        let beat = Beat::between(&trim.setup, STEPS, &from, &to).expect("a beat");
        y = beat.advance(&y).expect("a beat");
        from = to;
        for (k, (a, b)) in flyer.state().iter().zip(&y).enumerate() {
            let size = trim.beat.flight().form().scales()[k];
            assert!((a - b).abs() < 1e-11 * size, "{k}: {a} {b}");
        }
    }
}

/// Both ways of going over from a command to another, at all half steps of two beats.
#[test]
fn agrees_steered_strokes_with_the_passage_of_a_flight() {
    let options = wingbeat_model::species::FlyOptions::default();
    let fly = wingbeat_model::species::drosophila_melanogaster(&options).expect("a fly");
    let (steps, command) = (20, |x: f64| Adjustment {
        stroke_amplitude: 0.1 * x,
        stroke_offset: -0.2 * x,
        stroke_plane: 0.15 * x,
        ..Adjustment::default()
    });
    for wing in &fly.wings {
        let period = 1.0 / wing.motion.frequency;
        let steered = SteeredStroke::new(Arc::new(SteadyStroke::new(wing, period, steps)));
        let before = Transition::default().then(&command(1.0), -period, period);
        steered.follow(before.then(&command(-0.5), 0.3 * period, 0.5 * period));
        let steady = WingMotion {
            start: Beginning::Impulsive,
            ..wing.motion.clone()
        };
        let blend = MotionBlend {
            from: steady.adjusted(wing.side, &command(1.0)),
            to: steady.adjusted(wing.side, &command(-0.5)),
            start: 0.3 * period,
            duration: 0.5 * period,
        };
        for k in 0..4 * steps {
            let t = k as f64 * period / (2 * steps) as f64;
            let (a, b) = (steered.at(t), blend.at(t));
            let size = b.w.length().max(1.0 / period);
            assert!((0..3).all(|i| (a.c.col(i) - b.c.col(i)).length() < 1e-12));
            assert!((a.w - b.w).length() < 1e-11 * size);
            assert!((a.w_dot - b.w_dot).length() < 1e-10 * size / period);
        }
    }
}

/// The first episode of `seed`, alone with its model.
fn episode(course: &Course, seed: u64) -> Episode {
    let model = course.model().expect("a model");
    Episode::new(Arc::new(course.clone()), &model, seed).expect("an episode")
}

/// Rewards and observations of `steps` steps under a command that varies.
fn course_of(episode: &mut Episode, steps: usize) -> Vec<f64> {
    (0..steps).flat_map(|k| look(episode, k)).collect()
}

/// Reward and observation of step `k`.
fn look(episode: &mut Episode, k: usize) -> Vec<f64> {
    let mut seen = [0.0; OBSERVED];
    let outcome = episode.step(&[0.1 * (k as f64).sin(), 0.0, 0.05, -0.05]);
    episode.observe(&mut seen);
    [&[outcome.reward], &seen[..]].concat()
}

#[test]
fn behaves_an_episode_follows_from_its_seed_alone() {
    for (_, task) in Task::ALL {
        let mut course = Course::new(task, common::hovering(STEPS)).expect("a course");
        course.sensors.noise.tilt = 0.01;
        course.delay = 1;
        let (mut one, mut other) = (episode(&course, 7), episode(&course, 8));
        let [first, second] = [&mut one, &mut other].map(|e| course_of(e, 5));
        assert_ne!(first, second, "{task:?}");
        other.reset(Some(7)).expect("an episode");
        assert_eq!(course_of(&mut other, 5), first, "{task:?}");
        let again = [&mut one, &mut other].map(|e| {
            e.reset(None).expect("an episode");
            course_of(e, 5)
        });
        assert_eq!(again[0], again[1], "{task:?}");
        assert_ne!(again[0], first, "{task:?}: the next episode is another");
    }
}

/// Control steps of half a wingbeat and of a fortieth: where models keep what they know of an instant, its
/// flyer is another one.
#[test]
fn exact_episodes_that_take_turns_fly_as_if_alone() {
    for (_, task) in Task::ALL {
        for interval in [STEPS / 2, 1] {
            let mut course = Course::new(task, common::hovering(STEPS)).expect("a course");
            course.interval = interval;
            let seeds = [3, 4, 5];
            let alone = seeds.map(|seed| course_of(&mut episode(&course, seed), 12));
            let (model, course) = (course.model().expect("a model"), Arc::new(course));
            let mut list = seeds
                .map(|seed| Episode::new(Arc::clone(&course), &model, seed).expect("an episode"));
            let mut flown = [const { vec![] }; 3];
            for k in 0..12 {
                for (episode, flown) in list.iter_mut().zip(&mut flown) {
                    flown.extend(look(episode, k));
                }
            }
            assert_eq!(flown, alone, "{task:?}, {interval}");
        }
    }
}

/// The regulator holds a disturbed hover; without it the flyer is lost.
#[test]
fn behaves_the_regulator_masters_hover_and_nothing_does_not() {
    let course = Course::new(Task::Hover, common::hovering(STEPS)).expect("a course");
    let limits = course.limits;
    let sizes = [
        limits.amplitude,
        limits.angle,
        limits.amplitude,
        limits.angle,
    ];
    let mut regulator = Regulator::new(&course.trim, &Weights::default(), 0).expect("gains");
    let mut rewards = [0.0; 2];
    for (steered, total) in [true, false].into_iter().zip(&mut rewards) {
        let mut episode = episode(&course, 3);
        for k in 1..=course.beats {
            let d = episode.seen();
            let u = limits.applied(regulator.controls(&d));
            regulator.remember(&d, u, usize::from(!limits.reached(&u)));
            let controls = std::array::from_fn(|i| if steered { u[i] / sizes[i] } else { 0.0 });
            let outcome = episode.step(&controls);
            *total += outcome.reward;
            assert_eq!(outcome.is_over, k == course.beats);
            if outcome.is_lost {
                break;
            }
        }
    }
    assert!(rewards[0] > 90.0 && rewards[1] < 60.0, "{rewards:?}");
}

/// The map of a beat lays out every wingbeat by itself and keeps its own queue of commands.
#[test]
fn agrees_recoveries_with_the_map_of_a_beat() {
    let trim = common::hovering(STEPS);
    let (latency, beats) = (1, 30);
    let law = Law::Regulator(Regulator::new(&trim, &Weights::default(), latency).expect("gains"));
    let tumbles = Tumbles::new(&trim, Some(law.clone()), latency, beats).expect("tumbles");
    let mut recovered = 0;
    for seed in 1..=12 {
        let recovery = tumbles.recovery(seed).expect("a flight");
        let start = Start::drawn(Task::Recover, &trim.beat, &mut Draw::new(seed, 0));
        assert_eq!(recovery.tilt, start.by.tilt.length());
        let held = Held::Known(Reference::trimmed(&trim).expect("a reference"));
        let steering = Steering::new(law.clone(), held, &trim.setup);
        let flight = SteeredBeats::new(&trim, disturbed(&trim, &start.by), Some(steering), latency);
        let calm_from = calm_from(&trim, flight.expect("a flight"), beats);
        assert_eq!(recovery.beats, calm_from, "seed {seed}");
        recovered += usize::from(calm_from.is_some());
    }
    assert!(
        (1..12).contains(&recovered),
        "{recovered}: all alike say little"
    );
}

/// The first of ten calm wingbeats in a row.
fn calm_from(trim: &Trim, mut flight: SteeredBeats<'_>, beats: usize) -> Option<usize> {
    let scale = trim.beat.period() / trim.beat.wing_length();
    let mut calm = 0;
    for k in 0..beats + CALM_BEATS {
        let d = flight.departure();
        if Task::Recover.is_lost(&trim.beat, &d) {
            return None;
        }
        let is_calm = d.state.tilt.length() < CALM_TILT;
        let is_slow = d.state.velocity.length() * scale < CALM_SPEED;
        calm = if is_calm && is_slow { calm + 1 } else { 0 };
        if calm == CALM_BEATS {
            return Some(k + 1 - CALM_BEATS);
        }
        flight.beat().ok()?;
    }
    None
}

#[test]
fn behaves_no_tumble_ends_by_itself() {
    let trim = common::hovering(STEPS);
    let open = Tumbles::new(&trim, None, 0, 60).expect("tumbles");
    assert!((1..=8).all(|seed| open.recovery(seed).expect("a flight").beats.is_none()));
}

/// Noise of the sensors is that of the seed and of the episode, from the first look on; the flight knows
/// nothing of it.
#[test]
fn exact_episodes_have_noise_of_their_own() {
    let mut course = Course::new(Task::ALL[0].1, common::hovering(STEPS)).expect("a course");
    course.sensors.noise.position = 1e-4;
    let course = Arc::new(course);
    let model = course.model().expect("a model");
    let mut errors = vec![];
    for seed in [5, 5, 6] {
        let mut episode = Episode::new(Arc::clone(&course), &model, seed).expect("an episode");
        let error = |e: &Episode| e.seen().position - e.truth().expect("numbers").position;
        errors.push(error(&episode));
        episode.reset(None).expect("another");
        errors.push(error(&episode));
    }
    let [a, a2, b, b2, c, c2] = errors[..] else {
        panic!("six")
    };
    assert_eq!([a, a2], [b, b2]);
    let all = [a, a2, c, c2];
    for (k, x) in all.iter().enumerate() {
        assert!((1e-6..1e-3).contains(&x.length()), "{x}");
        assert!(all[..k].iter().all(|y| x.distance(*y) > 1e-6), "{k}");
    }
}

/// Noise, delay, a gust on the way and a command that is under way: an episode that another one goes on from,
/// and the next one after it, have the same bits.
#[test]
fn agrees_an_episode_that_goes_on_elsewhere_with_the_one_that_was_kept() {
    for task in [Task::Hover, Task::Path, Task::Gust] {
        let mut course = Course::new(task, common::hovering(STEPS)).expect("a course");
        (course.interval, course.delay) = (STEPS / 4, 3);
        course.sensors.noise.position = 1e-5;
        let course = Arc::new(course);
        let model = course.model().expect("a model");
        let begin = |seed| Episode::new(Arc::clone(&course), &model, seed).expect("an episode");
        let observed = |episode: &Episode| {
            let mut numbers = [0.0; OBSERVED];
            episode.observe(&mut numbers);
            numbers
        };
        let action = |k: usize| [0.3, -0.2, 0.1, 0.4].map(|x| x * (k as f64).sin());
        let (mut first, mut second) = (begin(5), begin(9));
        first.reset(None).expect("the next episode");
        for k in 0..17 {
            first.step(&action(k));
        }
        let kept = first.keep();
        second.go_on(&kept).expect("the same course");
        assert_eq!(second.keep(), kept);
        for k in 17..60 {
            assert_eq!(observed(&first), observed(&second), "{task:?} {k}");
            assert_eq!(first.step(&action(k)), second.step(&action(k)));
        }
        first.reset(None).expect("the next episode");
        second.reset(None).expect("the next episode");
        assert_eq!(observed(&first), observed(&second));
        let short = wingbeat_analysis::episode::Kept::default();
        assert!(second.go_on(&short).is_err());
    }
}
