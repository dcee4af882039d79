//! The interface of the air: wind in blade elements, what a partner gets, a model of one's own.

use crate::common;

use std::sync::{Arc, Mutex};

use common::Fly;
use wingbeat_air::{Gust, GustShape, VortexStreet, Wind};
use wingbeat_blade::{BladeSettings, BodyDrag};
use wingbeat_dynamics::{BodyAcceleration, BodyMotion, Wrench};
use wingbeat_flight::air::BladeAir;
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3, EulerSequence, MassProperties, r1, r2};
use wingbeat_model::deformation::{Deformation, SpanLaw, Term};
use wingbeat_model::{Animal, BodyPart, MassInput, Profile, Revolution};

fn blade(stream: DVec3, wind: Wind) -> FlightSetup {
    let mut setup = Fly::default().setup(40, 1.0);
    setup.air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings {
            free_stream: stream,
            ..BladeSettings::insect(1.2)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind,
        viscosity: None,
    });
    setup
}

fn end(setup: FlightSetup) -> Record {
    let mut flight = Simulation::new(setup).expect("a flight");
    while !flight.finished() {
        flight.step().expect("a step");
    }
    flight.record().clone()
}

/// A gust that blows all the time and everywhere.
fn steady(amplitude: DVec3) -> Wind {
    Wind {
        gusts: vec![Gust {
            amplitude,
            start: -1.0,
            slowness: DVec3::ZERO,
            shape: GustShape::Table(vec![(0.0, 1.0), (1e3, 1.0)]),
        }],
        ..Wind::default()
    }
}

#[test]
fn exact_steady_gust_on_blade_elements_is_a_stream() {
    let u = DVec3::new(-0.6, 0.2, 0.3);
    let (a, b) = (
        end(blade(u, Wind::default())),
        end(blade(DVec3::ZERO, steady(u))),
    );
    let still = end(blade(DVec3::ZERO, Wind::default()));
    let gap = (a.mass_centre - b.mass_centre).length();
    let drift = (a.mass_centre - still.mass_centre).length();
    assert!(
        drift > 1e-6,
        "the stream carries the fly along: {drift:e} m"
    );
    assert!(gap < 1e-10 * drift, "{gap:e} of {drift:e} m");
}

/// Loads of blade elements on the bodies of `setup` that move like `motions` at time `t` \[s\], and those of
/// their added mass if all accelerate alike by `acc` \[m/s2\] and do not turn the faster.
fn loads(setup: &FlightSetup, t: f64, motions: &[BodyMotion], acc: DVec3) -> Vec<Wrench> {
    let AirModel::BladeElement(options) = &setup.air else {
        panic!("blade elements");
    };
    let air = BladeAir::new(&setup.animal, options).expect("strips");
    let at = Instant::rigid(t, 1e-4, motions);
    let mut out = vec![Wrench::default(); motions.len()];
    let mut scratch = air.scratch();
    air.loads(&at, None, &mut scratch, &mut out).expect("loads");
    let mut masses = vec![];
    air.added_mass(t, &mut scratch, &mut masses);
    for mass in masses {
        let by = BodyAcceleration {
            linear: acc,
            angular: DVec3::ZERO,
        };
        out[mass.body()] += mass.wrench(&motions[mass.body()], &by);
    }
    out
}

#[test]
fn invariant_wings_in_air_that_swings_feel_what_wings_that_swing_in_still_air_do() {
    let gust = Gust {
        amplitude: DVec3::new(0.3, -0.2, 0.9),
        start: 1e-3,
        slowness: DVec3::ZERO,
        shape: GustShape::OneMinusCosine { duration: 4e-3 },
    };
    let twist = Deformation {
        twist: vec![Term::steady(SpanLaw::Linear {
            root: 0.1,
            tip: -0.4,
        })],
        ..Deformation::default()
    };
    let wind = Wind {
        gusts: vec![gust],
        ..Wind::default()
    };
    let flat = [Wind::default(), wind.clone()].map(|w| blade(DVec3::new(-0.4, 0.0, 0.1), w));
    let mut bent = flat.clone();
    for wing in bent.iter_mut().flat_map(|s| &mut s.animal.wings) {
        *wing = wing.clone().deformed_by(twist.clone()).expect("a twist");
    }
    for [still, windy] in [flat, bent] {
        let t = 2.3e-3;
        let [u, rate] = wind.at_once(t);
        // At rest, and in some motion.
        for size in [0.0, 1.0] {
            let motion = |k: usize| BodyMotion {
                r: r1(0.3 + k as f64) * r2(0.7),
                v: size * DVec3::new(0.5, 0.1, -0.4),
                w: size * DVec3::new(90.0, -300.0, 200.0) * k as f64,
                ..BodyMotion::REST
            };
            let motions = [0, 1, 2].map(motion);
            let met = loads(&windy, t, &motions, DVec3::ZERO);
            let swung = motions.map(|m| BodyMotion { v: m.v - u, ..m });
            let moved = loads(&still, t, &swung, -rate);
            let slow = loads(&still, t, &swung, DVec3::ZERO);
            for k in 1..3 {
                let apart = (met[k].force - moved[k].force).length();
                let rated = (slow[k].force - moved[k].force).length();
                let turned = (met[k].moment - moved[k].moment).length();
                assert!(apart < 1e-12 * moved[k].force.length(), "{apart:e}");
                assert!(turned < 1e-12 * moved[k].moment.length(), "{turned:e}");
                // The rate is a part of the force that counts.
                assert!(rated > 0.01 * moved[k].force.length(), "{rated:e}");
            }
        }
    }
}

/// The fly with drag of its body, whose drag names the point `centre` or none, described from the origin `o` \[m\].
fn dragged(animal: &Animal, centre: Option<DVec3>, o: DVec3) -> Record {
    let mut setup = blade(DVec3::new(-1.5, 0.4, 0.6), Wind::default());
    setup.animal = animal.with_origin(o);
    let MotionMode::Free(start) = &mut setup.mode else {
        panic!("a free flight");
    };
    let turn = EulerSequence::BODY_231.rotation(start.angles);
    start.position += turn * o;
    start.velocity += turn * start.angular_velocity.cross(o);
    let AirModel::BladeElement(options) = &mut setup.air else {
        panic!("blade elements");
    };
    options.body_drag = Some(BodyDrag {
        area: 1e-6,
        along: 0.6,
        across: 1.3,
        centre,
    });
    end(setup)
}

#[test]
fn invariant_flights_of_a_body_with_drag_do_not_hang_on_its_origin() {
    let bare = Fly::default().animal();
    let solid = Revolution {
        centre: DVec3::new(-3e-4, 0.0, 2e-4),
        direction: DVec3::new(1.0, 0.0, -0.2),
        length: 2e-3,
        radius: 4e-4,
        profile: Profile::Ellipsoid,
        stations: 4,
        meridians: 6,
    };
    let part = BodyPart::revolution("trunk", &solid, &MassInput::Density(0.0)).expect("a part");
    let clad = Animal {
        parts: vec![part],
        ..bare.clone()
    };
    assert!((clad.body_centre() - solid.centre).length() < 1e-12);
    assert_eq!(bare.body_centre(), bare.body.centre());
    let o = DVec3::new(7e-4, 0.0, -4e-4);
    let at = DVec3::new(-5e-4, 0.0, 3e-4);
    for (animal, centre) in [(&bare, None), (&clad, None), (&clad, Some(at))] {
        let here = dragged(animal, centre, DVec3::ZERO);
        let moved = dragged(animal, centre.map(|c| c - o), o);
        let elsewhere = dragged(animal, Some(animal.body_centre() + o), DVec3::ZERO);
        let spin = |a: &Record, b: &Record| {
            let apart = a.angular_momentum - b.angular_momentum;
            apart.length() / here.angular_momentum.length()
        };
        let gap = (here.mass_centre - moved.mass_centre).length();
        // Roundings of 40 steps; a lever of the size of the body turns it by far more.
        assert!(gap < 1e-10 * here.mass_centre.length(), "{gap:e}");
        assert!(spin(&here, &moved) < 1e-9, "{:e}", spin(&here, &moved));
        assert!(spin(&here, &elsewhere) > 1e-3);
        // The work of the air holds that of the moment.
        let open = here.energy_residual.abs() / here.air_work.abs();
        assert!(open < 1e-4, "{open:e}");
    }
}

#[test]
fn limit_a_vortex_street_that_is_far_wider_than_the_fly_is_a_stream() {
    // What differs is the shear of the street over the reach of the strokes: it falls with the size of the street.
    let street = |size: f64| VortexStreet {
        circulation: 2.0 * size,
        spacing: 3.0 * size,
        width: 0.84 * size,
        concentration: 0.9,
        drift: DVec3::new(1e-6, 0.0, 0.0),
        axis: DVec3::Y,
        point: DVec3::new(0.3, 0.0, 0.2) * size,
    };
    let still = end(blade(DVec3::ZERO, Wind::default())).momentum;
    let apart = |size: f64| {
        let street = street(size);
        let velocity = street.at(DVec3::ZERO, 0.0);
        assert!(velocity.length() > 0.1, "{velocity}");
        let wind = Wind {
            street: Some(street),
            ..Wind::default()
        };
        let stream = end(blade(velocity, Wind::default())).momentum;
        let met = end(blade(DVec3::ZERO, wind)).momentum;
        (met - stream).length() / (stream - still).length()
    };
    let [near, far] = [1e3, 1e4].map(apart);
    assert!(
        far < 1e-5 && (8.0..12.0).contains(&(near / far)),
        "{near:e} {far:e}"
    );
}

#[test]
fn exact_shear_on_blade_elements_is_a_stream_at_the_wings() {
    // A shear whose velocity is the same at all points of a plane, which the strokes hardly leave:
    // to first order in the distance the loads differ by the gradient alone. Doubling the gradient
    // doubles the difference.
    let with = |rate: f64| {
        let shear = DMat3::from_cols(DVec3::ZERO, DVec3::ZERO, DVec3::new(rate, 0.0, 0.0));
        let wind = Wind {
            shear: Some(shear),
            ..Wind::default()
        };
        end(blade(DVec3::ZERO, wind)).momentum
    };
    let still = with(0.0);
    let (one, two) = (with(1e-3) - still, with(2e-3) - still);
    assert!(one.length() > 0.0, "a shear must be felt");
    assert!(
        (two - 2.0 * one).length() < 1e-4 * one.length(),
        "{one} {two}"
    );
}

/// Remembers what it was told.
#[derive(Clone, Debug, Default)]
struct Listener(Arc<Mutex<Vec<String>>>);

impl ExternalAir for Listener {
    fn open(&self, flyer: &Announcement) -> Result<Box<dyn ExternalSession>, String> {
        self.0.lock().expect("no panic").clone_from(&flyer.bodies);
        Ok(Box::new(Still(flyer.bodies.len())))
    }
}

struct Still(usize);

impl ExternalSession for Still {
    fn loads(
        &mut self,
        _step: usize,
        _time: f64,
        motions: &[BodyMotion],
        out: &mut [Wrench],
    ) -> Result<(), String> {
        assert_eq!(
            (motions.len(), out.len()),
            (self.0, self.0),
            "all bodies announced"
        );
        out.fill(Wrench::default());
        Ok(())
    }

    fn accept(&mut self, _step: usize) -> Result<(), String> {
        Ok(())
    }
}

#[test]
fn behaves_external_air_is_told_of_every_body_it_is_asked_for() {
    let mut setup = Fly::default().setup(40, 0.1);
    let listener = Listener::default();
    setup.air = AirModel::External(Arc::new(listener.clone()));
    end(setup.clone());
    let told = listener.0.lock().expect("no panic").clone();
    assert_eq!(
        told.len(),
        1 + setup.animal.wings.len() + setup.animal.segments.len()
    );
    assert_eq!(told[0], "body");
}

/// Linear drag on every body.
#[derive(Debug)]
struct Syrup(f64);

impl Air for Syrup {
    fn loads(
        &self,
        at: &Instant<'_>,
        _memory: Option<&AirMemory>,
        _scratch: &mut AirScratch,
        out: &mut [Wrench],
    ) -> Result<(), FlightError> {
        for (load, m) in out.iter_mut().zip(at.motions) {
            *load = Wrench::at(-self.0 * m.v, DVec3::ZERO);
        }
        Ok(())
    }
}

#[test]
fn exact_own_air_model_reaches_terminal_velocity() {
    // A single body in linear drag: v = m g / c (1 - exp(-c t / m)).
    let mut setup = Fly::default().setup(40, 40.0);
    setup.animal.wings.clear();
    // Weight and drag act at one point.
    setup.animal.body = MassProperties::about_centre(
        setup.animal.body.mass,
        DVec3::ZERO,
        setup.animal.body.inertia_about_centre(),
    );
    setup.integrator = IntegratorChoice::RungeKutta;
    setup.mode = MotionMode::Free(StartState::default());
    let (m, t) = (
        setup.animal.mass(),
        setup.time.step * setup.time.steps as f64,
    );
    let c = 3.0 * m / t;
    setup.air = AirModel::Own(Arc::new(Syrup(c)));
    let found = end(setup).momentum.z / m;
    let origin = 9.81 * m / c * (1.0 - (-3.0_f64).exp());
    assert!((found / origin - 1.0).abs() < 1e-8, "{found} {origin}");
}
