//! Wings that joints drive: a four-bar linkage against the same motion prescribed joint by joint.

use crate::common;

use std::sync::Arc;

use common::*;
use wingbeat_analysis::control::{Regulator, Timing, Weights};
use wingbeat_analysis::*;
use wingbeat_dynamics::{ElementLaw, Joint, JointModel, JointType};
use wingbeat_flight::joints::AxisTurn;
use wingbeat_flight::*;
use wingbeat_math::{DMat3, DVec3, DriftingFourier, MassProperties, RotationLaw, r2};
use wingbeat_model::motion::{Adjustment, AngleLaw};
use wingbeat_model::{Segment, Side, Wing};

/// Length of crank and rocker [m].
const BAR: f64 = 1e-3;

/// Stroke angle of the drive: mean, cosine and sine of the first harmonic [rad].
const STROKE: [f64; 3] = [-0.25, -1.15, -0.095];

/// A bar of the linkage that ends at `end` [m] from its origin.
fn bar(name: String, origin: DVec3, end: DVec3) -> Segment {
    let mass = 2e-9;
    let thick = DMat3::IDENTITY * (mass * 1e-8);
    let rod = MassProperties::point(mass / 3.0, end) + MassProperties::point(mass / 6.0, end * 0.5);
    let mut mass = rod + MassProperties::point(mass / 2.0, DVec3::ZERO);
    mass.inertia += thick;
    Segment {
        name,
        origin_b: origin,
        mass,
        parts: vec![],
    }
}

/// The drive turns by this much about its axis.
fn drive(axis: DVec3, frequency: f64, factor: f64) -> Arc<dyn RotationLaw> {
    let [mean, cosine, sine] = STROKE.map(|x| factor * x);
    let angle = DriftingFourier::periodic(mean, frequency, [vec![cosine], vec![sine]]);
    Arc::new(AxisTurn { axis, angle })
}

/// How the rocker comes to turn.
#[derive(Clone, Copy, PartialEq)]
enum Drive {
    /// By a crank and a coupler parallel to the line between their pivots.
    Linkage,
    /// By laws of its own, and so do crank and coupler.
    Laws,
}

/// The fruit fly with wings that feather as measured on rockers, which a drive turns about the normal of the
/// stroke plane.
fn driven(by: Drive) -> FlightSetup {
    let mut setup = fly();
    let wings = setup.animal.wings.len();
    for k in 0..wings {
        let wing = &mut setup.animal.wings[k];
        wing.motion.angles.phi = AngleLaw::Constant(0.0);
        let (hinge, name) = (wing.hinge_b, wing.name.clone());
        let sense = if wing.side == Side::Right { 1.0 } else { -1.0 };
        let plane = r2(wing.motion.stroke_plane_pitch);
        let axis = sense * plane.x_axis;
        let (ground, out) = (BAR * plane.z_axis, BAR * sense * plane.y_axis);
        let first = 1 + wings + 3 * k;
        setup.animal.segments.extend([
            bar(format!("rocker {name}"), hinge, out),
            bar(format!("crank {name}"), hinge + ground, out),
            bar(format!("coupler {name}"), hinge + ground + out, -ground),
        ]);
        let f = wing.motion.frequency;
        let linkage = by == Drive::Linkage;
        let joint = |what: &str, parent, child, [at, from]: [DVec3; 2]| {
            let name = format!("{what} {name}");
            Joint::new(&name, Some(parent), child, JointType::Weld).at(at, from)
        };
        let zero = DVec3::ZERO;
        let mut rocker = joint("rocker", 0, first, [hinge, zero]);
        let mut crank = joint("crank", 0, first + 1, [hinge + ground, zero]);
        crank.law = Some(drive(axis, f, 1.0));
        let mut coupler = joint("coupler", first + 1, first + 2, [out, zero]);
        let wing = joint("wing", first, 1 + k, [zero, zero]);
        if linkage {
            // Crossed bars close the loop too: it starts near the position meant.
            let start = STROKE[0] + STROKE[1];
            rocker.model = JointModel::new(JointType::Revolute { axis }).starting(&[start], &[]);
            coupler.model = JointModel::new(JointType::Revolute { axis }).starting(&[-start], &[]);
        } else {
            rocker.law = Some(drive(axis, f, 1.0));
            coupler.law = Some(drive(axis, f, -1.0));
        }
        setup.joints.extend([rocker, crank, coupler, wing]);
        if linkage {
            let mut closing = joint("closing", first, first + 2, [out, -ground]);
            closing.model = JointModel::new(JointType::PointOnLine { axis });
            setup.joints.push(closing);
        }
    }
    setup
}

/// Largest difference between two lists over the largest number of the second.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let gaps = a.iter().zip(b).map(|(x, y)| (x - y).abs());
    gaps.fold(0.0, f64::max) / size
}

/// Both ways to drive the wings.
fn both() -> [FlightSetup; 2] {
    [Drive::Linkage, Drive::Laws].map(driven)
}

/// A parallelogram's rocker turns by the angle of its crank: what loops make of the joints is known, and all
/// that follows from the map of a beat is the same.
#[test]
fn exact_parallelogram_drives_wings_as_laws_do() {
    let setups = both();
    let beats = setups.each_ref().map(|s| Beat::new(s, 60).unwrap());
    let states = beats.each_ref().map(|beat| {
        let (v, w) = (DVec3::new(0.1, 0.02, -0.1), DVec3::new(1.0, 5.0, -2.0));
        let y = beat.state(DVec3::ZERO, r2(0.8), v, w);
        let end = beat.advance(&y).unwrap();
        (y, end)
    });
    assert!(beats[0].joint_sizes().is_empty());
    // Roundings of Newton's closing at each of 120 times (measured 2e-12 of the angular momentum).
    for part in [0..3, 3..7, 7..10, 10..13] {
        let [a, b] = states.each_ref().map(|s| &s.1[part.clone()]);
        assert!(apart(a, b) < 2e-11, "{part:?}: {:.1e}", apart(a, b));
    }
    // Differences with steps of 1e-3 and 1e-4 divide roundings by them.
    let [a, b] = [0, 1].map(|k| linear_model(&beats[k], &states[k].0).unwrap().matrix);
    assert!(apart(&a, &b) < 4e-12, "{:.1e}", apart(&a, &b));
    let [a, b] = setups.each_ref().map(|s| {
        let list = control_derivatives(s, r2(0.8), DVec3::ZERO, 40).unwrap();
        let forces = list.iter().flat_map(|d| d.derivative.force.to_array());
        forces.collect::<Vec<f64>>()
    });
    assert!(apart(&a, &b) < 6e-10, "{:.1e}", apart(&a, &b));
}

/// Trim, the trimmed flight flown with all constraints, steering and power.
#[test]
fn agrees_trim_of_a_linkage_with_prescribed_joints() {
    const STEPS: usize = 24;
    let problem = TrimProblem {
        unknowns: vec![
            Unknown::BodyPitch,
            Unknown::Frequency,
            Unknown::FeatheringOffset,
        ],
        ..hover(STEPS)
    };
    let [a, b] = both().map(|s| trim(&s, &problem).unwrap());
    assert!(a.solution.converged && b.solution.converged);
    // Both are trimmed to 1e-9.
    for (x, y) in [
        (a.solution.body_pitch, b.solution.body_pitch),
        (
            a.solution.adjustment.frequency,
            b.solution.adjustment.frequency,
        ),
        (
            a.solution.adjustment.feathering_offset,
            b.solution.adjustment.feathering_offset,
        ),
    ] {
        assert!((x - y).abs() < 1e-8, "{x} {y}");
    }
    // Quaternions and multipliers of eleven bodies against momenta: two methods of fourth order.
    let mut flight = Simulation::new(a.free()).unwrap();
    while !flight.finished() {
        flight.step().unwrap();
    }
    let (root, end) = (
        flight.root(),
        a.beat.root(&a.beat.advance(&a.state).unwrap()),
    );
    let gap = (root.p - end.p).length() / a.beat.wing_length();
    println!("{gap:e}");
    assert!(gap < 1.2e-3, "{gap:.1e}");
    // The inertial power is counted limb by limb, and the linkage makes one limb of two. Projected constraints
    // hold to roundings.
    let [p, q] = [&a, &b].map(|t| {
        let p = power(&t.tethered().unwrap()).unwrap();
        [p.aerodynamic, p.perfect_storage, p.peak]
    });
    assert!(apart(&p, &q) < 1e-11, "{:.1e}", apart(&p, &q));
    let now = vec![Adjustment::default(); 2];
    let next = vec![
        Adjustment {
            feathering_offset: 0.05,
            ..Adjustment::default()
        };
        2
    ];
    let [x, y] = [&a, &b].map(|t| {
        let beat = Beat::between(&t.setup, STEPS, &now, &next).unwrap();
        beat.advance(&a.state).unwrap()
    });
    assert!(apart(&x[10..], &y[10..]) < 1e-9);
    // Looks within the wingbeat, too: loops are known at those instants.
    let timing = Timing {
        parts: 4,
        latency: 1,
        lag: 0.2,
    };
    let [p, q] = [&a, &b].map(|t| {
        let regulator = Regulator::timed(t, &Weights::default(), &timing).unwrap();
        let plants = regulator.plants().iter();
        plants.flat_map(|p| p.m.clone()).collect::<Vec<f64>>()
    });
    println!("{:e}", apart(&p, &q));
    assert!(apart(&p, &q) < 1e-6, "{:.1e}", apart(&p, &q));
}

fn refused<T>(found: Result<T, AnalysisError>) -> String {
    found.err().expect("refused").to_string()
}

#[test]
fn refuses_by_name_what_a_map_of_beats_cannot_be_asked() {
    let mut loose = driven(Drive::Linkage);
    let crank = loose
        .joints
        .iter_mut()
        .find(|j| j.name.starts_with("crank"))
        .unwrap();
    (crank.law, crank.model) = (
        None,
        JointModel::new(JointType::Revolute { axis: DVec3::X }),
    );
    let said = refused(Beat::new(&loose, 20));
    assert!(said.contains("closing") && said.contains("free"), "{said}");

    let mut other = driven(Drive::Laws);
    let name = other.joints[1].name.clone();
    other.joints[1].law = Some(drive(DVec3::X, 150.0, 1.0));
    let said = refused(Beat::new(&other, 20));
    assert!(said.contains(&name) && said.contains("frequency"), "{said}");

    let faster = DriftingFourier {
        frequency: 150.0,
        cosine: vec![1e-9],
        ..DriftingFourier::default()
    };
    let drifting = DriftingFourier {
        rate: 1e-9,
        ..DriftingFourier::default()
    };
    for series in [faster, drifting] {
        let mut motor = fly();
        motor.joints = hinged(&motor, ElementLaw::Effort(series));
        let said = refused(Beat::new(&motor, 20));
        assert!(
            said.contains("hinge") && said.contains("frequency"),
            "{said}"
        );
    }

    for (unknown, what) in [
        (Unknown::StrokeAmplitude, "stroke_amplitude changes nothing"),
        (Unknown::DriveAmplitude, "no joint has one"),
    ] {
        let unknowns = [Unknown::BodyPitch, Unknown::Frequency, unknown];
        let said = refused(trim(
            &driven(Drive::Laws),
            &TrimProblem {
                unknowns: unknowns.to_vec(),
                ..hover(20)
            },
        ));
        assert!(said.contains(what), "{said}");
    }
}

/// Passive feathering hinges for all wings of `setup` with a spring, a damper and `law`.
fn hinged(setup: &FlightSetup, law: ElementLaw) -> Vec<Joint> {
    let wings = setup.animal.wings.iter().enumerate();
    let joint = |(k, wing): (usize, &Wing)| Joint {
        // Three times as fast as the wings beat, half of critical damping.
        model: JointModel::new(JointType::Revolute { axis: DVec3::Y })
            .with(
                0,
                ElementLaw::Spring {
                    stiffness: 7e-9,
                    rest: 0.0,
                },
            )
            .with(
                0,
                ElementLaw::Damper {
                    coefficient: DAMPING,
                },
            )
            .with(0, law.clone()),
        ..Joint::new(
            &format!("hinge {}", wing.name),
            Some(0),
            1 + k,
            JointType::Weld,
        )
        .at(wing.hinge_b, DVec3::ZERO)
    };
    wings.map(joint).collect()
}

/// Damping of the hinges [N m s].
const DAMPING: f64 = 2e-12;

/// The fly in its hovering attitude, held, for some beats.
fn held(mut setup: FlightSetup, beats: usize) -> FlightSetup {
    let angles = DVec3::new(0.8, 0.0, 0.0);
    setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(DVec3::ZERO, angles));
    for wing in &mut setup.animal.wings {
        wing.motion.start = wingbeat_model::Start::Impulsive;
    }
    setup.time.steps = 100 * beats;
    setup
}

/// Prescribed wings move alike without air, where only inertia and weight are left.
#[test]
fn agrees_power_against_the_air_with_that_of_flights_with_and_without() {
    let setup = held(fly(), 2);
    let vacuum = FlightSetup {
        air: AirModel::None,
        ..setup.clone()
    };
    let [p, q] = [&setup, &vacuum].map(|s| power(s).unwrap());
    // Powers at each step: roundings.
    assert!((p.inertial_positive / q.inertial_positive - 1.0).abs() < 1e-12);
    assert!((p.aerodynamic / p.perfect_storage - 1.0).abs() < 1e-9);
    assert_eq!(q.aerodynamic, 0.0);
}

/// What the drives of the strokes give over a periodic beat, air and dampers of passive hinges take.
#[test]
fn balances_power_of_passive_hinges() {
    let mut setup = fly();
    for wing in &mut setup.animal.wings {
        wing.motion.angles.psi = AngleLaw::Constant(-1.2);
    }
    setup.joints = hinged(
        &setup,
        ElementLaw::Spring {
            stiffness: 0.0,
            rest: 0.0,
        },
    );
    let setup = held(setup, 60);
    let p = power(&setup).unwrap();
    let period = setup.time.period.unwrap();
    let mut flight = Simulation::new(setup).unwrap();
    let (mut damped, mut driven, mut positive) = (0.0, 0.0, 0.0);
    while !flight.finished() {
        let record = flight.step().unwrap();
        if record.step == 5900 {
            driven -= record.driving_work();
            positive -= record.positive_work;
        }
        if record.step > 5900 {
            damped += record
                .joints
                .iter()
                .map(|[_, u]| DAMPING * u * u)
                .sum::<f64>()
                / 100.0;
        }
    }
    let open = p.perfect_storage - p.aerodynamic - damped;
    println!("{p:?} damped {damped:.3e} W, balance open by {open:.1e} W");
    assert!(open.abs() < 1e-3 * damped, "{open:.1e} of {damped:.1e} W");
    // What a flight counts of its actuators, springs and dampers left out.
    driven = (driven + flight.record().driving_work()) / period;
    let apart = driven / p.perfect_storage - 1.0;
    println!("work of the actuators differs by {apart:.1e}");
    assert!(apart.abs() < 1e-4, "{driven:e} W, {apart:.1e}");
    positive = (positive + flight.record().positive_work) / period;
    let apart = positive / p.no_storage - 1.0; // the same sum, of another beat of a periodic motion
    println!("their positive work differs by {apart:.1e}");
    assert!(apart.abs() < 1e-6, "{positive:e} W, {apart:.1e}");
}
