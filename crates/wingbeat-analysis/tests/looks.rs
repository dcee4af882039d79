//! Regulators that look several times in a wingbeat.

use crate::common::{self, matrix, sizes};

use wingbeat_analysis::control::{
    CONTROLS, Channels, Controls, Departure, Held, Law, Limits, Orbit, ProcessNoise,
    ProportionalDerivative, Reference, Regulator, STATES, Sensors, SteeredBeats, Steering,
    Stiffness, Timing, Weights, adjustments, disturbed, sides, states,
};
use wingbeat_analysis::{Beat, Level, Perturbation, Trim, eigen};
use wingbeat_dynamics::BodyMotion;
use wingbeat_flight::{Controller, Sensed};
use wingbeat_math::{DMat3, DVec3};

/// The steering of a regulator that begins with these commands in force and under way.
fn steering(trim: &Trim, regulator: &Regulator, timing: &Timing) -> Steering {
    let reference = Reference::trimmed(trim).expect("a reference");
    let law = Law::Regulator(regulator.clone());
    let mut steering = Steering::new(law, Held::Known(reference), &trim.setup);
    steering.orbit = Orbit::new(trim, timing.parts).expect("an orbit").points;
    steering.limits = Limits {
        amplitude: f64::INFINITY,
        angle: f64::INFINITY,
    };
    steering
}

/// The controller's memory with these commands in force and under way, its place counted from the reference flight's.
fn memory(trim: &Trim, commands: &[f64]) -> Vec<f64> {
    let first = Reference::trimmed(trim).expect("a reference").to_vec();
    let known = [&[first.len() as f64 + 3.0], &first[..], &[0.0; 3]].concat();
    [&known[..], &[0.0; CONTROLS], commands].concat()
}

/// A wingbeat of the linear flight from states and commands `z`.
fn predicted(regulator: &Regulator, z: &[f64]) -> Vec<f64> {
    let mut regulator = regulator.clone();
    let (x, commands) = z.split_at(STATES);
    regulator.restore(commands).expect("its memory");
    let mut x: [f64; STATES] = x.try_into().expect("all states");
    for look in 0..regulator.plants().len() {
        let d = Departure {
            look,
            position: DVec3::from_slice(&x),
            state: Perturbation::from_array(std::array::from_fn(|k| x[3 + k])),
        };
        let u = regulator.controls(&d);
        let in_force =
            |r: &Regulator| -> Controls { r.memory()[..CONTROLS].try_into().expect("one") };
        let now = in_force(&regulator);
        regulator.remember(&d, u, 1);
        let ahead = regulator.plants()[look].advance(&x, &now, &in_force(&regulator));
        x = ahead.try_into().expect("no free joints");
    }
    [&x[..], &regulator.memory()].concat()
}

/// The same flown: half the difference of flights from small departures of opposite signs, over their size.
fn flown(trim: &Trim, regulator: &Regulator, timing: &Timing, z: &[f64]) -> Vec<f64> {
    const SMALL: f64 = 1e-4;
    let level = Level::new(trim.beat.root(&trim.state).r, trim.beat.gravity());
    let own = Perturbation::of(&trim.beat, &level, &trim.state).to_array();
    let sides = sides(&trim.setup);
    let ends = [SMALL, -SMALL].map(|size| {
        let z: Vec<f64> = z.iter().map(|x| size * x).collect();
        let (x, commands) = z.split_at(STATES);
        let departed = Perturbation::from_array(std::array::from_fn(|k| own[k] + x[3 + k]));
        let under_way = commands.as_chunks::<CONTROLS>().0.iter();
        let under_way: Vec<_> = under_way.map(|u| adjustments(u, &sides)).collect();
        let held = Beat::between(&trim.setup, 1, &under_way[0], &under_way[0]).expect("a beat");
        let mut state = departed.state(&held, &level, &[]);
        let place = DVec3::from_slice(&trim.state) + level.to_n * DVec3::from_slice(x);
        place.write_to_slice(&mut state);
        let mut controller = steering(trim, regulator, timing);
        let restored = controller.restore(&memory(trim, commands));
        restored.expect("its memory");
        let flight = SteeredBeats::new(trim, state, Some(controller), timing.latency);
        let flight = flight.expect("a flight").commanded(under_way);
        let mut flight = flight.expect("commands").lagged(timing.share());
        flight.beat().expect("it is held");
        let memory = flight.controller().expect("one").memory();
        let commands = &memory[memory.len() - commands.len()..];
        [&states(&flight.departure())[..], commands].concat()
    });
    let pairs = ends[0].iter().zip(&ends[1]);
    pairs.map(|(a, b)| (a - b) / (2.0 * SMALL)).collect()
}

/// The closed loop over a wingbeat, flown from small departures of states and commands, is the one the
/// regulator was laid out on, and so are its eigenvalues: looks once to five times in a wingbeat, latencies of
/// whole looks, actuators that lag.
#[test]
fn agrees_closed_loop_flown_with_that_of_the_layout() {
    let trim = common::hovering(40);
    for (parts, latency, lag) in [
        (1, 0, 0.0),
        (1, 1, 0.0),
        (2, 1, 0.0),
        (5, 3, 0.0),
        (1, 1, 1.5),
        (4, 2, 3.0),
    ] {
        let timing = Timing {
            parts,
            latency,
            lag,
        };
        let regulator = Regulator::timed(&trim, &Weights::default(), &timing).expect("gains");
        let commanded = vec![1.0; CONTROLS * (latency + 1)];
        let sizes = [&sizes(&trim)[..], &commanded].concat();
        let expect = matrix(&sizes, |z| predicted(&regulator, z));
        let found = matrix(&sizes, |z| flown(&trim, &regulator, &timing, z));
        let size = expect.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let pairs = expect.iter().zip(&found);
        let error = pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size;
        let n = sizes.len();
        let largest = |m: &[f64]| -> f64 {
            let pairs = eigen(m, n).expect("eigenvalues");
            pairs
                .iter()
                .fold(0.0, |m, p| m.max(p.value[0].hypot(p.value[1])))
        };
        let [a, b] = [largest(&expect), largest(&found)];
        println!("{timing:?}: {error:e} of {size}; largest eigenvalue {a} predicted, {b} flown");
        // Central differences of small departures: second order in 1e-4, and rounding over it.
        assert!(error < 2e-8, "{timing:?}: {error:e}");
        assert!(a < 1.0 && (a - b).abs() < 1e-9, "{timing:?}: {a} {b}");
    }
}

/// Looks within the beat hold a flyer with a shorter latency: it comes back nearer after 40 wingbeats from a tumble.
#[test]
fn balances_a_tilted_flight_under_looks_within_the_beat() {
    let trim = common::hovering(40);
    let left = [(1, 1), (4, 1)].map(|(parts, latency)| {
        let timing = Timing {
            parts,
            latency,
            lag: 0.0,
        };
        let regulator = Regulator::timed(&trim, &Weights::default(), &timing).expect("gains");
        let mut controller = steering(&trim, &regulator, &timing);
        controller.limits = Limits::default();
        let by = Perturbation {
            tilt: DVec3::splat(0.3),
            ..Perturbation::default()
        };
        let start = disturbed(&trim, &by);
        let mut flight =
            SteeredBeats::new(&trim, start, Some(controller), latency).expect("a flight");
        let mut strayed = 0.0_f64;
        for _ in 0..80 {
            flight.beat().expect("it is held");
            strayed = strayed.max(flight.departure().position.length());
        }
        let d = flight.departure();
        println!(
            "{timing:?}: strayed {strayed:e} m, left {:e} rad",
            d.state.tilt.length()
        );
        assert!(d.state.tilt.length() < 0.01, "{timing:?}");
        strayed
    });
    assert!(left[1] < left[0], "{left:?}");
}

/// Between the looks of one that looks rarely nothing is seen: what its filter and its sums make of the flight follows
/// from the looks alone, of which each stands for the beats to the next one.
#[test]
fn exact_what_happens_between_rare_looks_is_not_seen() {
    const EVERY: usize = 3;
    let trim = common::hovering(40);
    let timing = Timing {
        parts: 1,
        latency: 1,
        lag: 0.0,
    };
    let weights = Weights {
        sum: Some(2.0),
        ..Weights::default()
    };
    let noise = Channels {
        position: 2e-4,
        velocity: 0.02,
        tilt: 0.03,
        rate: 5.0,
    };
    let regulator = Regulator::timed(&trim, &weights, &timing).expect("gains");
    let observed = regulator
        .clone()
        .observed(&trim, &ProcessNoise::default(), &noise);
    let loops = Stiffness {
        integral: 0.02,
        ..Stiffness::default()
    };
    let loops = ProportionalDerivative::new(&trim, &loops).expect("loops");
    let sensed = |look: usize, off: f64, turn: f64| {
        let root = trim.beat.root(&trim.state);
        let place = DVec3::splat(off);
        Sensed {
            look,
            time: look as f64 * trim.beat.period(),
            root: BodyMotion {
                p: root.p + place,
                r: DMat3::from_rotation_z(turn) * root.r,
                ..root
            },
            centre: DVec3::from_slice(&trim.state) + place,
            velocity: trim.beat.velocity(&trim.state),
        }
    };
    for (law, is_filtered) in [
        (Law::Regulator(regulator), false),
        (Law::Regulator(observed.expect("a filter")), true),
        (Law::Stabiliser(loops), false),
    ] {
        let new = |every: usize| {
            let reference = Reference::trimmed(&trim).expect("a reference");
            let mut steering = Steering::new(law.clone(), Held::Known(reference), &trim.setup);
            steering.every = every;
            steering.limits = Limits {
                amplitude: 10.0,
                angle: 10.0,
            };
            steering
        };
        let [mut still, mut moved] = [new(EVERY), new(EVERY)];
        for look in 0..4 * EVERY {
            let off = 1e-5 * look as f64;
            let between = if look.is_multiple_of(EVERY) {
                off
            } else {
                1e-3
            };
            let [a, b] = [(&mut still, off), (&mut moved, between)]
                .map(|(steering, off)| steering.command(&sensed(look, off, 0.0)).unwrap());
            assert_eq!(a, b, "{look}");
            assert_eq!(still.memory(), moved.memory(), "{look}");
        }
        // As many beats are summed as go by: of what is seen, without a filter.
        let sums = |every: usize| {
            let mut steering = new(every);
            for look in 0..2 * EVERY {
                steering.command(&sensed(look, 0.0, 0.01)).unwrap();
            }
            let memory = steering.memory();
            let first = 1 + memory[0] as usize + CONTROLS;
            memory[first..first + CONTROLS].to_vec()
        };
        let [often, rarely] = [sums(1), sums(EVERY)];
        let largest = often.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (a, b) in often.iter().zip(&rarely) {
            let off = (a - b).abs() / largest;
            assert!(off < 1e-12 || is_filtered, "{often:?} {rarely:?}");
        }
        assert!(largest > 1e-6, "{often:?}");
    }
}

/// The place that is held is that of the release, whatever noise is in the first look.
#[test]
fn exact_the_place_that_is_held_is_the_true_one() {
    let trim = common::hovering(40);
    let regulator = Regulator::new(&trim, &Weights::default(), 1).expect("gains");
    let timing = Timing {
        parts: 1,
        latency: 1,
        lag: 0.0,
    };
    let mut steering = steering(&trim, &regulator, &timing);
    steering.sensors = Some(Sensors {
        noise: Channels {
            position: 1e-3,
            ..Channels::default()
        },
        ..Sensors::default()
    });
    let centre = DVec3::new(0.1, -0.2, 0.3);
    let truth = Sensed {
        look: 0,
        time: 0.0,
        root: BodyMotion {
            p: centre,
            ..BodyMotion::REST
        },
        centre,
        velocity: DVec3::ZERO,
    };
    steering.command(&truth).expect("a command");
    let aim = Controller::aim(&steering, 0.0).expect("a place");
    assert_eq!(aim.position, centre);
}
