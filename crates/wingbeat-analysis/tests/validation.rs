//! The fruit fly: trim, modes, power, stabilised hover.

use crate::common;

use common::*;
use wingbeat_analysis::control::{
    Departure, Held, Law, ProportionalDerivative, Reference, Regulator, SteeredBeats, Steering,
    Stiffness, Weights, disturbed,
};
use wingbeat_analysis::*;
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DQuat, DVec3};

#[test]
fn published_fry_strokes_carry_the_fly() {
    // Hovering flies of 0.96 to 1.0 mg by these strokes. Quasi-steady two-wing lift, worked out
    // independently for R = 2.5 mm, 200 Hz: 1.04-1.22 mg translational, 1.23-1.38 mg with rotation
    // (the spread is that of wing outlines; other coefficients, no added mass).
    let lift = |rotation| {
        let mut setup = fly();
        if let AirModel::BladeElement(options) = &mut setup.air {
            options.blade.rotation = rotation;
            options.blade.translation = wingbeat_blade::find_set("dickinson-1999").unwrap().law;
        }
        let beat = Beat::new(&setup, 100).unwrap();
        let y = beat.state(
            DVec3::ZERO,
            wingbeat_math::r2(47.5_f64.to_radians()),
            DVec3::ZERO,
            DVec3::ZERO,
        );
        let level = Level::new(beat.root(&y).r, beat.gravity());
        let load = beat.mean_load(&level, DVec3::ZERO, DVec3::ZERO).unwrap();
        -load.force.z / 9.81 * 1e6
    };
    use wingbeat_blade::Rotation;
    let (without, with) = (lift(Rotation::None), lift(Rotation::SaneDickinson));
    // 5 % on either side for the outline, a beta distribution of the same r2_hat.
    assert!(
        (1.04 * 0.95..1.22 * 1.05).contains(&without),
        "{without} mg"
    );
    assert!((1.23 * 0.95..1.38 * 1.05).contains(&with), "{with} mg");
}

#[test]
fn balances_hover_trims_and_then_stays_where_it_is() {
    let t = trim(&fly(), &hover(100)).unwrap();
    assert!(
        t.solution.converged && t.solution.error() < 1e-9,
        "{:?}",
        t.solution.residual
    );
    // Flown freely by the coupled simulation, a different integrator: within 1 % of R and 0.1
    // degree of the start after the first beat.
    let root = t.beat.root(&t.state);
    let mut setup = t.setup.clone();
    for wing in &mut setup.animal.wings {
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    let angles = wingbeat_math::EulerSequence::BODY_231.angles(root.r);
    setup.mode = MotionMode::Free(StartState {
        position: root.p,
        angles,
        velocity: root.v,
        angular_velocity: root.w,
        held_steps: 0,
        held_motion: None,
    });
    let mut flight = Simulation::new(setup).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let record = flight.record();
    let p = DVec3::from_slice(&record.coordinates);
    assert!((p - root.p).length() < 0.01 * 2.5e-3, "{:?}", p - root.p);
    let turned = (record.coordinates[3] - angles.x).abs();
    assert!(turned < 0.1_f64.to_radians(), "{turned}");
}

#[test]
fn balances_forward_flight_and_climb_trim_too() {
    for velocity in [DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.0, 0.0, -0.3)] {
        let problem = TrimProblem {
            velocity,
            ..hover(60)
        };
        let t = trim(&fly(), &problem).unwrap();
        assert!(
            t.solution.converged,
            "{velocity}: {:?}",
            t.solution.residual
        );
        let end = t.beat.advance(&t.state).unwrap();
        let travelled = DVec3::from_slice(&end) / t.beat.period();
        assert!((travelled - velocity).length() < 1e-6, "{travelled}"); // tolerance times R/T
    }
}

#[test]
fn limit_an_impossible_trim_reports_the_best_point() {
    // Ten times gravity: no stroke of this wing carries that.
    let mut setup = fly();
    setup.gravity *= 10.0;
    let t = trim(&setup, &hover(40)).unwrap();
    assert!(!t.solution.converged);
    let untouched = trim(
        &setup,
        &TrimProblem {
            settings: TrimSettings {
                iterations: 0,
                ..hover(40).settings
            },
            ..hover(40)
        },
    )
    .unwrap();
    assert!(t.solution.error() < untouched.solution.error());
}

/// A body that tilts in a stream meets it from elsewhere: flight through air that moves is that through air
/// that does not.
#[test]
fn invariant_averaged_modes_in_a_stream_are_those_of_flight_through_still_air() {
    for velocity in [DVec3::new(0.5, 0.0, 0.0), DVec3::new(0.1, 0.0, -0.4)] {
        let modes = |setup: &FlightSetup, v: DVec3| {
            let problem = TrimProblem {
                velocity: v,
                ..hover(100)
            };
            let t = trim(setup, &problem).unwrap();
            assert!(t.solution.converged);
            linear_model(&t.beat, &t.state).unwrap().modes
        };
        let mut streaming = fly();
        *streaming.air.stream_mut().unwrap() = -velocity;
        let [still, stream] = [modes(&fly(), velocity), modes(&streaming, DVec3::ZERO)];
        for plane in [Plane::Longitudinal, Plane::Lateral] {
            for (a, b) in still.plane(plane).zip(stream.plane(plane)) {
                let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
                // Steps of 1e-3 of the natural sizes, other ones in other variables.
                assert!(
                    apart < 1e-5 * a.growth.hypot(a.frequency).max(1.0),
                    "{a:?} {b:?}"
                );
            }
        }
    }
}

/// Averaging is exact where nothing moves within a beat: of bodies a thousand and ten thousand times as heavy,
/// the wings and the weight kept. All that is of the order of the slow motion counts: the added mass that rates
/// of the velocity meet, the angular momentum of strokes that draw loops, the wings' own mass.
#[test]
fn limit_averaged_modes_of_heavy_bodies_are_floquets() {
    let apart = |heavier: f64| {
        let mut setup = smooth(fly());
        setup.gravity /= heavier;
        setup.animal.body.mass *= heavier;
        setup.animal.body.first_moment *= heavier;
        setup.animal.body.inertia *= heavier;
        for part in &mut setup.animal.parts {
            part.mass = wingbeat_math::MassProperties::ZERO; // not asked for
        }
        let problem = TrimProblem {
            velocity: DVec3::new(0.4, 0.0, 0.0),
            ..hover(100)
        };
        let t = trim(&setup, &problem).unwrap();
        assert!(t.solution.converged);
        let averaged = linear_model(&t.beat, &t.state).unwrap().modes;
        let exact = floquet(&t.beat, &t.state).unwrap();
        let lateral = |set: &ModeSet| -> Vec<[f64; 2]> {
            let modes = set.plane(Plane::Lateral).filter(|m| !m.is_neutral());
            modes.map(|m| [m.growth, m.frequency]).collect()
        };
        let pairs = lateral(&averaged).into_iter().zip(lateral(&exact));
        let off = pairs.map(|(a, b)| (a[0] / b[0] - 1.0).abs());
        off.fold(0.0, f64::max)
    };
    let [light, heavy] = [1e3, 1e4].map(apart);
    // Measured 7e-4 and 3e-5 (without the added mass 5e-3, without the angular momentum 9e-2).
    assert!(light < 2e-3 && heavy < 2e-4, "{light:e} {heavy:e}");
}

/// A stream down is an induced flow down where only wings meet the air, and the body tilts against either.
#[test]
fn agrees_averaged_modes_in_an_induced_flow_with_those_in_a_stream() {
    let down = DVec3::new(0.0, 0.0, 0.6);
    let modes = |streams: bool| {
        let mut setup = fly();
        let AirModel::BladeElement(options) = &mut setup.air else {
            panic!("blade elements");
        };
        options.body_drag = None;
        match streams {
            true => options.blade.free_stream = down,
            false => options.induced = down,
        }
        let t = trim(&setup, &hover(100)).unwrap();
        assert!(t.solution.converged);
        linear_model(&t.beat, &t.state).unwrap().modes
    };
    let [stream, induced] = [true, false].map(modes);
    for (a, b) in stream.modes.iter().zip(&induced.modes) {
        let apart = (a.growth - b.growth).hypot(a.frequency - b.frequency);
        // Central differences of other variables.
        assert!(
            apart < 1e-5 * a.growth.hypot(a.frequency).max(1.0),
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn published_longitudinal_modes_have_the_known_structure() {
    // One unstable oscillation, one fast and one slow subsidence: published for bumblebee [Sun &
    // Xiong 2005], hoverfly, crane fly, drone fly, hawkmoth [Sun, Wang & Xiong 2007].
    let t = trim(&fly(), &hover(100)).unwrap();
    let averaged = linear_model(&t.beat, &t.state).unwrap().modes;
    let exact = floquet(&t.beat, &t.state).unwrap();
    for set in [&averaged, &exact] {
        let names: Vec<_> = set
            .plane(Plane::Longitudinal)
            .map(|m| m.name.as_str())
            .collect();
        assert_eq!(
            names,
            ["unstable oscillation", "slow subsidence", "fast subsidence"]
        );
    }
    // The averaged theory is good for insects of high wingbeat frequency [Wu & Sun 2012]: here
    // within 3 % of Floquet's.
    for (a, b) in averaged
        .plane(Plane::Longitudinal)
        .zip(exact.plane(Plane::Longitudinal))
    {
        assert!(
            (a.growth / b.growth - 1.0).abs() < 0.03,
            "{} {}",
            a.growth,
            b.growth
        );
    }
}

#[test]
fn balances_power_of_hover() {
    let t = trim(&fly(), &hover(100)).unwrap();
    let mut setup = t.setup.clone();
    let angles = DVec3::new(t.solution.body_pitch, 0.0, 0.0);
    setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(DVec3::ZERO, angles));
    setup.time.steps = 300;
    let p = power(&setup).unwrap();
    // Over a period inertia and added mass return all they took, so the mean power is
    // aerodynamic; the mean of a periodic function over 100 equal steps is exact to round-off.
    assert!((p.perfect_storage / p.aerodynamic - 1.0).abs() < 1e-6);
    assert!(p.no_storage >= p.perfect_storage && p.peak >= p.no_storage);
    // Published for the hovering Drosophila virilis: 28.7 W/kg [Sun & Tang 2002]; hoverflies 27.5 to
    // 46.3 W/kg. The species differ: the same order of magnitude is all that can be asked.
    let specific = p.body_specific(p.no_storage);
    assert!((10.0..60.0).contains(&specific), "{specific} W/kg");
}

/// The trimmed flight disturbed.
struct Disturbed<'a> {
    trim: &'a Trim,
    by: Perturbation,
}

impl Disturbed<'_> {
    fn steering(&self, law: Law) -> Steering {
        let held = Held::Known(Reference::trimmed(self.trim).unwrap());
        Steering::new(law, held, &self.trim.setup)
    }

    /// The same in free flight, for `beats` wingbeats.
    fn setup(&self, feedback: Option<Feedback>, beats: usize) -> FlightSetup {
        let trim = Trim {
            state: disturbed(self.trim, &self.by),
            ..self.trim.clone()
        };
        let mut setup = trim.free();
        setup.time.steps *= beats;
        setup.feedback = feedback;
        setup
    }

    /// Departures at the ends of the first `beats` wingbeats.
    fn flown(&self, controller: Option<Steering>, latency: usize, beats: usize) -> Vec<Departure> {
        let start = disturbed(self.trim, &self.by);
        let mut flight = SteeredBeats::new(self.trim, start, controller, latency).unwrap();
        let beat = |_| {
            flight.beat().unwrap();
            flight.departure()
        };
        (0..beats).map(beat).collect()
    }
}

/// Largest and last distance from the start in wing lengths, last tilt in degrees.
fn hundred_beats(t: &Trim, law: Option<Law>, latency: usize) -> [f64; 3] {
    let case = Disturbed {
        trim: t,
        by: Perturbation::component(7, 10.0_f64.to_radians()),
    };
    let flown = case.flown(law.map(|law| case.steering(law)), latency, 100);
    let far = flown
        .iter()
        .map(|d| d.position.length())
        .fold(0.0, f64::max);
    let (last, r) = (flown[99], t.beat.wing_length());
    let tilt = last.state.tilt.length().to_degrees();
    [far / r, last.position.length() / r, tilt]
}

#[test]
fn balances_stabilised_hover_recovers_from_ten_degrees_of_pitch() {
    let t = trim(&fly(), &hover(60)).unwrap();
    for latency in [0, 2] {
        let regulator = Regulator::new(&t, &Weights::default(), latency).unwrap();
        let [far, end, tilt] = hundred_beats(&t, Some(Law::Regulator(regulator)), latency);
        assert!(far < 1.0, "latency {latency}: {far} R");
        assert!(
            end < 0.02 && tilt < 0.1,
            "latency {latency}: {end} R, {tilt} deg"
        );
    }
    // Without feedback the same disturbance is lost: hover is unstable.
    let [far, ..] = hundred_beats(&t, None, 0);
    assert!(far > 5.0, "{far}");
}

#[test]
fn balances_integral_action_takes_back_a_steady_load() {
    // A force of 5 % of the weight to each side: the regulator alone leans against it out of place,
    // with sums it comes back. After 200 beats 1e-8 is left.
    let t = trim(&fly(), &hover(60)).unwrap();
    let steps = t.beat.steps();
    let away = |sum: Option<f64>| {
        let weights = Weights {
            sum,
            ..Weights::default()
        };
        let law = Law::Regulator(Regulator::new(&t, &weights, 1).unwrap());
        let case = Disturbed {
            trim: &t,
            by: Perturbation::default(),
        };
        let mut setup = case.setup(Some(case.steering(law).feedback(steps, 1)), 200);
        let force = 0.05 * t.beat.mass() * 9.81;
        setup.loads.push(AppliedLoad {
            body: 0,
            frame: LoadFrame::Inertial,
            point: DVec3::ZERO,
            force: [force, -force, force].map(DriftingFourier::constant),
            couple: [0.0; 3].map(DriftingFourier::constant),
        });
        let mut flight = Simulation::new(setup).unwrap();
        let origin = flight.record().mass_centre;
        while !flight.finished() {
            flight.step().unwrap();
        }
        (flight.record().mass_centre - origin).length() / t.beat.wing_length()
    };
    let (without, with) = (away(None), away(Some(2.0)));
    assert!(without > 0.05, "{without} R");
    assert!(with < 1e-7, "{with} R");
}

#[test]
fn invariant_results_do_not_depend_on_heading() {
    // The same flight turned about the vertical: same state one beat later, turned.
    let beat = Beat::new(&fly(), 50).unwrap();
    let turn = DMat3::from_quat(DQuat::from_rotation_z(1.1));
    let r = wingbeat_math::r2(0.8);
    let (v, w) = (DVec3::new(0.3, 0.1, -0.2), DVec3::new(5.0, -8.0, 3.0));
    let fly = |r, v| {
        let y = beat.state(DVec3::ZERO, r, v, w);
        beat.root(&beat.advance(&y).unwrap())
    };
    let (a, b) = (fly(r, v), fly(turn * r, turn * v));
    // Roundings of 50 steps of velocities of order 1.
    assert!((turn * a.v - b.v).length() < 1e-12);
    assert!((a.w - b.w).length() < 1e-9);
}

#[test]
fn balances_loops_hold_attitude_and_altitude() {
    let t = trim(&fly(), &hover(60)).unwrap();
    let loops = ProportionalDerivative::new(&t, &Stiffness::default()).unwrap();
    let case = Disturbed {
        trim: &t,
        by: Perturbation {
            tilt: DVec3::new(3.0, 10.0, 3.0).map(f64::to_radians),
            ..Perturbation::default()
        },
    };
    for (latency, every) in [(0, 1), (1, 1), (0, 2)] {
        let mut steering = case.steering(Law::Stabiliser(loops.clone()));
        steering.every = every;
        let flown = case.flown(Some(steering), latency, 150);
        let left = flown[149].state.tilt.length().to_degrees();
        assert!(left < 1.0, "latency {latency}, every {every}: {left} deg");
        assert!(flown[149].position.z.abs() < 0.1 * t.beat.wing_length());
    }
}

#[test]
fn agrees_feedback_in_flight_with_feedback_on_the_map_of_beats() {
    // One regulator, two loops: the map of beats, and a flight that is resumed halfway. The trimmed
    // level frame is the inertial one.
    let t = trim(&fly(), &hover(100)).unwrap();
    let weights = Weights {
        sum: Some(2.0),
        ..Weights::default()
    };
    let regulator = Regulator::new(&t, &weights, 1).unwrap();
    let case = Disturbed {
        trim: &t,
        by: Perturbation {
            velocity: DVec3::new(0.05, 0.03, -0.02),
            ..Perturbation::default()
        },
    };
    let steering = case.steering(Law::Regulator(regulator));
    let expect = case.flown(Some(steering.clone()), 1, 12);
    let expect: Vec<DVec3> = expect.iter().map(|d| d.position).collect();
    let setup = case.setup(Some(steering.feedback(100, 1)), 12);
    let mut flight = Simulation::new(setup.clone()).unwrap();
    let start = flight.record().mass_centre;
    for (beat, place) in expect.iter().enumerate() {
        for _ in 0..100 {
            flight.step().unwrap();
        }
        let gap = (flight.record().mass_centre - start - *place).length();
        // The same equations and method; quaternions are scaled every step here, every beat there.
        assert!(gap < 1e-9 * t.beat.wing_length(), "beat {beat}: {gap:e} m");
        if beat == 5 {
            let saved = flight.state().clone();
            flight = Simulation::resume(setup.clone(), saved).unwrap();
        }
    }
    let commanded = &flight.record().commands;
    assert_eq!(commanded.len(), 2);
    assert!(commanded.iter().any(|c| c.stroke_amplitude != 0.0));
    // Without feedback the push is not taken back.
    let free = case.flown(None, 0, 12);
    let (held, lost) = (expect[11].length(), free[11].position.length());
    assert!(held < lost, "{held} {lost}");
}
