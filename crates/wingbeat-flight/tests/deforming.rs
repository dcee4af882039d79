//! Wings whose deformation is prescribed: against rigid wings that are or move the same, balances,
//! symmetry, theory.

use crate::common;

use common::{FREQUENCY, Fly, fly, sine};
use wingbeat_air::LoadMethod;
use wingbeat_blade::{AddedMassModel, BladeSettings};
use wingbeat_flight::*;
use wingbeat_math::{DVec3, MassProperties, r2};
use wingbeat_model::deformation::{MovingSurface, SpanLaw, Term};
use wingbeat_model::motion::Fourier;
use wingbeat_model::{AngleLaw, Deformation, DeformingMesh};

fn series(mean: f64, cos: f64, sin: f64) -> Fourier {
    Fourier {
        mean,
        cos: vec![cos],
        sin: vec![sin],
    }
}

fn term(root: f64, tip: f64, time: Fourier) -> Term {
    let span = SpanLaw::Linear { root, tip };
    Term { span, time }
}

/// Twist that grows towards the tip, camber, and bending, all over the beat.
fn everything() -> Deformation {
    Deformation {
        twist: vec![term(0.0, 0.3, series(0.1, 0.2, 1.0))],
        camber: vec![term(0.03, 0.06, series(0.5, 0.0, 1.0))],
        bending: vec![term(0.0, 2e-4, series(0.0, 1.0, 0.3))],
        ..Deformation::default()
    }
}

/// The same flight with every wing deformed.
fn deformed(mut setup: FlightSetup, deformation: &Deformation) -> FlightSetup {
    for wing in &mut setup.animal.wings {
        *wing = wing.clone().deformed_by(deformation.clone()).unwrap();
    }
    setup
}

fn blade(mut setup: FlightSetup, added_mass: AddedMassModel) -> FlightSetup {
    setup.air = AirModel::BladeElement(BladeOptions {
        blade: BladeSettings {
            added_mass,
            free_stream: DVec3::new(-0.8, 0.3, 0.4),
            ..BladeSettings::insect(1.2)
        },
        body_drag: None,
        induced: DVec3::ZERO,
        wind: wingbeat_air::Wind::default(),
        viscosity: None,
    });
    setup.integrator = IntegratorChoice::RungeKutta;
    setup
}

fn air(setup: &mut FlightSetup) -> &mut AirOptions {
    match &mut setup.air {
        AirModel::VortexLattice(air) => air,
        _ => unreachable!("the little fly has a lattice"),
    }
}

/// Largest difference of the air's loads on the wings over their largest, and of the coordinates.
fn difference(a: &[Record], b: &[Record]) -> [f64; 2] {
    let (mut gap, mut size, mut place) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (a, b) in a.iter().zip(b) {
        for (x, y) in a.air.iter().zip(&b.air) {
            gap = gap.max((x.force - y.force).length());
            size = size.max(x.force.length());
        }
        for (x, y) in a.coordinates.iter().zip(&b.coordinates) {
            place = place.max((x - y).abs());
        }
    }
    [gap / size, place]
}

#[test]
fn exact_no_amplitude_is_the_rigid_flight_bit_for_bit() {
    let mut none = everything();
    for t in [&mut none.twist, &mut none.camber, &mut none.bending] {
        t[0].span = SpanLaw::constant(0.0);
    }
    let setup = Fly::default().setup(40, 0.5);
    let rigid = fly(setup.clone());
    let powers = rigid.iter().map(|r| r.hinges[0].power.abs());
    let scale = powers.fold(0.0, f64::max);
    for mut record in fly(deformed(setup, &none)) {
        // Roundings of the difference of two equal velocities.
        let power = std::mem::take(&mut record.deformation_power);
        assert!(
            power.iter().all(|p| p.abs() < 1e-14 * scale),
            "{power:?} {scale}"
        );
        assert!(record.deformation_work.abs() < 1e-14 * scale / FREQUENCY);
        record.deformation_work = 0.0;
        let positive = rigid[record.step].positive_work;
        assert!((record.positive_work - positive).abs() < 1e-14 * scale / FREQUENCY);
        record.positive_work = positive;
        record.air_work = rigid[record.step].air_work;
        record.energy_residual = rigid[record.step].energy_residual;
        assert_eq!(record, rigid[record.step]);
    }
}

#[test]
fn exact_constant_deformation_is_a_wing_of_that_shape() {
    let steady = |root, tip| vec![Term::steady(SpanLaw::Linear { root, tip })];
    let constant = Deformation {
        axis_fraction: 0.4,
        twist: steady(0.1, 0.35),
        camber: steady(0.05, 0.02),
        bending: steady(0.0, 3e-4),
        ..Deformation::default()
    };
    let setup = Fly::default().setup(40, 0.5);
    let mut shaped = setup.clone();
    for wing in &mut shaped.animal.wings {
        // The mass stays that of the flat wing.
        wing.mesh.nodes = DeformingMesh::new(&wing.mesh, &constant).places(0.0);
    }
    let (a, b) = (fly(shaped), fly(deformed(setup, &constant)));
    let [force, place] = difference(&a, &b);
    println!("constant deformation: loads differ by {force:.1e}");
    assert!(force < 1e-9 && place < 1e-9); // roundings in a free wake
    let most = b.iter().flat_map(|r| &r.deformation_power);
    let power = most.fold(0.0_f64, |m, p| m.max(p.abs()));
    let scale = b
        .iter()
        .map(|r| r.hinges[0].power.abs())
        .fold(0.0, f64::max);
    assert!(power < 1e-9 * scale, "{power} of {scale}"); // nothing is deformed against the air
}

/// Strips of a bent wing lie on it and are as wide as it is.
#[test]
fn exact_strips_of_a_wing_bent_for_good_are_those_of_a_wing_of_that_shape() {
    let constant = Deformation {
        bending: vec![Term::steady(SpanLaw::Linear {
            root: 0.0,
            tip: 6e-4,
        })],
        ..Deformation::default()
    };
    for added in [
        AddedMassModel::None,
        AddedMassModel::Section,
        AddedMassModel::Impulse,
    ] {
        let setup = blade(Fly::default().setup(40, 0.5), added);
        let mut shaped = setup.clone();
        for wing in &mut shaped.animal.wings {
            wing.mesh.nodes = DeformingMesh::new(&wing.mesh, &constant).places(0.0);
        }
        let (a, b) = (fly(shaped), fly(deformed(setup.clone(), &constant)));
        let [force, place] = difference(&a, &b);
        let [flat, _] = difference(&a, &fly(setup));
        println!("{added:?}: bent for good {force:.1e}, flat {flat:.1e}");
        assert!(force < 1e-10 && place < 1e-10); // roundings
        assert!(flat > 0.05);
    }
}

/// Wings without mass, tethered, the body without weight to carry: hinges work against the air alone.
fn massless(mut setup: FlightSetup) -> FlightSetup {
    setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(
        DVec3::ZERO,
        DVec3::new(0.8, 0.0, 0.0),
    ));
    for wing in &mut setup.animal.wings {
        wing.mass = MassProperties::ZERO;
        wing.motion.angles.phi = AngleLaw::Constant(0.2);
        wing.motion.angles.theta = AngleLaw::Constant(0.0);
    }
    setup
}

/// A wing that twists all over its span about its hinge axis is a wing that feathers: the same loads,
/// and what the hinge gives in the one case the deformation takes in the other.
fn twist_is_feathering(setup: FlightSetup) {
    let setup = massless(setup);
    let mut feathering = setup.clone();
    for wing in &mut feathering.animal.wings {
        wing.motion.angles.psi = sine(0.2, 0.5, 0.3);
    }
    let mut twisting = setup;
    for wing in &mut twisting.animal.wings {
        wing.motion.angles.psi = AngleLaw::Constant(0.0);
    }
    let uniform = Deformation {
        twist: vec![term(1.0, 1.0, series(0.2, 0.5, 0.3))],
        ..Deformation::default() // the wings' axis is at a quarter of the chord, too
    };
    let (a, b) = (fly(feathering), fly(deformed(twisting, &uniform)));
    let [force, _] = difference(&a, &b);
    let scale = a
        .iter()
        .map(|r| r.hinges[0].power.abs())
        .fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for (a, b) in a.iter().zip(&b) {
        for k in 0..2 {
            worst = worst.max((a.hinges[k].power - b.deformation_power[k]).abs() / scale);
            assert!(b.hinges[k].power.abs() < 1e-12 * scale);
        }
        let work = a.hinge_work - b.deformation_work;
        assert!(work.abs() < 1e-8 * scale / FREQUENCY);
        assert!((a.air_work - b.air_work).abs() < 1e-8 * scale / FREQUENCY);
    }
    println!("twist and feathering: loads differ by {force:.1e}, powers by {worst:.1e}");
    assert!(force < 1e-9 && worst < 1e-9); // roundings
}

#[test]
fn agrees_uniform_twist_with_feathering_in_the_lattice() {
    twist_is_feathering(Fly::default().setup(40, 0.5));
    let mut segments = Fly::default().setup(40, 0.5);
    air(&mut segments).lattice.loads = LoadMethod::Joukowski;
    twist_is_feathering(segments);
}

#[test]
fn agrees_uniform_twist_with_feathering_in_blade_elements() {
    let all = [
        AddedMassModel::None,
        AddedMassModel::Normal,
        AddedMassModel::Section,
        AddedMassModel::Impulse,
    ];
    for added in all {
        twist_is_feathering(blade(Fly::default().setup(40, 0.5), added));
    }
}

/// A wing that is bent by the same displacement all along its span plunges.
fn bending_is_plunging(setup: FlightSetup) {
    let mut setup = massless(setup);
    let (amplitude, psi) = (4e-4, 0.3);
    for wing in &mut setup.animal.wings {
        wing.motion.stroke_plane_pitch = 0.0;
        wing.motion.start = wingbeat_model::Start::Impulsive;
        wing.motion.angles.phi = AngleLaw::Constant(0.0);
        wing.motion.angles.psi = AngleLaw::Constant(psi);
    }
    let mut bending = setup.clone();
    let mut plunging = setup;
    let still = PrescribedMotion::at_rest(DVec3::ZERO, DVec3::ZERO);
    let mut along = still.clone();
    // Towards -axis 3 of the wing, which psi has turned.
    for (axis, share) in [(0, -psi.sin()), (2, -psi.cos())] {
        along.position[axis] = DriftingFourier {
            frequency: FREQUENCY,
            sine: vec![amplitude * share],
            ..DriftingFourier::default()
        };
    }
    plunging.mode = MotionMode::Tethered(along);
    bending.mode = MotionMode::Tethered(still);
    let uniform = Deformation {
        bending: vec![term(amplitude, amplitude, series(0.0, 0.0, 1.0))],
        ..Deformation::default()
    };
    let (a, b) = (fly(plunging), fly(deformed(bending, &uniform)));
    let [force, _] = difference(&a, &b);
    println!("bending and plunging: loads differ by {force:.1e}");
    assert!(force < 1e-9); // roundings in a free wake
    let scale = b
        .iter()
        .map(|r| r.deformation_work.abs())
        .fold(0.0, f64::max);
    for (a, b) in a.iter().zip(&b) {
        assert!((a.air_work - b.air_work).abs() < 1e-8 * scale);
        // The wings take from the tether in the one case what deforms them in the other.
        assert!((b.deformation_work + b.air_work).abs() < 1e-12 * scale);
    }
    assert!(scale > 0.0);
}

#[test]
fn agrees_uniform_bending_with_plunging() {
    bending_is_plunging(Fly::default().setup(40, 0.5));
    for added in [
        AddedMassModel::None,
        AddedMassModel::Section,
        AddedMassModel::Impulse,
    ] {
        bending_is_plunging(blade(Fly::default().setup(40, 0.5), added));
    }
}

#[test]
fn invariant_strips_of_a_mesh_at_incidence_fly_as_feathered_ones() {
    let angle = 0.3;
    for added in [
        AddedMassModel::None,
        AddedMassModel::Section,
        AddedMassModel::Impulse,
    ] {
        let feathered = blade(Fly::default().setup(40, 0.5), added);
        let mut turned = feathered.clone();
        for wing in &mut turned.animal.wings {
            wing.mesh.nodes.iter_mut().for_each(|x| *x = r2(angle) * *x);
            wing.mass = wing.mass.moved(r2(angle), DVec3::ZERO);
            wing.motion.angles.psi = sine(-angle, 0.0, -0.8);
        }
        let [gap, place] = difference(&fly(turned), &fly(feathered));
        println!("{added:?}: {gap:.1e}, {place:.1e}");
        // The feathering angle itself differs by the incidence.
        assert!(gap < 1e-10 && place < angle + 1e-10);
    }
}

#[test]
fn balances_free_flight_with_deforming_wings() {
    let lattice = deformed(Fly::default().setup(40, 1.0), &everything());
    let strips = blade(lattice.clone(), AddedMassModel::Impulse);
    for (setup, tolerance) in [(lattice, 1e-3), (strips, 1e-5)] {
        let weight = setup.animal.mass() * 9.81;
        let records = fly(setup);
        let last = records.last().unwrap();
        let most = |f: &dyn Fn(&Record) -> f64| {
            records.iter().map(f).fold(0.0, |m: f64, x| m.max(x.abs()))
        };
        let scale = most(&|r| r.hinge_work).max(most(&|r| r.air_work));
        let energy = most(&|r| r.energy_residual) / scale;
        let momentum = most(&|r| r.momentum_residual.length()) / (weight * last.time);
        let share = last.deformation_work / last.hinge_work;
        println!("energy {energy:.1e}, momentum {momentum:.1e}, deformation/hinge {share:.3}");
        // As for rigid wings at 40 steps a beat: order four, but for a wake that starts.
        assert!(energy < tolerance && momentum < 1e-9);
        assert!(share.abs() > 0.01); // it matters
    }
}

#[test]
fn invariant_symmetric_flight_with_deforming_wings_stays_symmetric() {
    let both = deformed(Fly::default().setup(40, 0.6), &everything());
    let mut half = both.clone();
    air(&mut half).mirror = true;
    let (a, b) = (fly(both), fly(half));
    let flip = DVec3::new(1.0, -1.0, 1.0);
    for (a, b) in a.iter().zip(&b) {
        let size = b.air[1].force.length();
        for (r, tolerance) in [(b, 1e-12), (a, 1e-9)] {
            // Exact to a rounding where one half is computed; in a free wake otherwise.
            let gap = (r.air[1].force - flip * r.air[2].force).length();
            assert!(gap <= tolerance * size, "step {}: {gap} of {size}", r.step);
        }
        assert!((a.air[1].force - b.air[1].force).length() <= 1e-9 * size);
        let powers = &b.deformation_power;
        assert!((powers[0] - powers[1]).abs() <= 1e-9 * powers[0].abs());
    }
    // Twins of different shape are none.
    let mut odd = deformed(Fly::default().setup(40, 0.1), &everything());
    odd.animal.wings[0].deformation = None;
    air(&mut odd).mirror = true;
    let error = Simulation::new(odd).err().expect("refused").to_string();
    assert!(error.contains("air.mirror"), "{error}");
}

/// The surface of the first wing under `deformation`, as cameras would see it at eleven phases.
fn measured(setup: &FlightSetup, deformation: &Deformation) -> Deformation {
    let mesh = &setup.animal.wings[0].mesh;
    let moving = DeformingMesh::new(mesh, deformation);
    let phases: Vec<f64> = (0..11).map(|k| 0.03 + f64::from(k) / 11.0).collect();
    let at = |x: &f64| -> Vec<Vec<DVec3>> {
        let outboard = |x: DVec3| DVec3::new(x.x, x.y.abs(), x.z);
        let places: Vec<DVec3> = moving.places(*x).into_iter().map(outboard).collect();
        places
            .chunks(mesh.cols + 1)
            .map(<[DVec3]>::to_vec)
            .collect()
    };
    let surface = MovingSurface {
        places: phases.iter().map(at).collect(),
        phases,
        harmonics: 2,
    };
    Deformation {
        surface: Some(surface),
        ..Deformation::default()
    }
}

#[test]
fn agrees_a_measured_surface_with_the_law_it_was_measured_of() {
    let bending = Deformation {
        bending: vec![term(0.0, 5e-4, series(0.1, 1.0, 0.3))],
        ..Deformation::default()
    };
    let setup = Fly::default().setup(40, 0.5);
    let surface = measured(&setup, &bending);
    let (a, b) = (
        fly(deformed(setup.clone(), &bending)),
        fly(deformed(setup, &surface)),
    );
    let [force, place] = difference(&a, &b);
    println!("measured surface: loads differ by {force:.1e}, places by {place:.1e}");
    assert!(force < 1e-8 && place < 1e-9); // roundings of the least squares in a free wake
    let scale = a
        .iter()
        .map(|r| r.deformation_work.abs())
        .fold(0.0, f64::max);
    for (a, b) in a.iter().zip(&b) {
        assert!((a.deformation_work - b.deformation_work).abs() < 1e-8 * scale);
    }
    assert!(scale > 0.0);
}

#[test]
fn refuses_measured_surfaces_beside_strips() {
    let setup = Fly::default().setup(40, 0.1);
    let surface = measured(&setup, &everything());
    let strips = blade(deformed(setup, &surface), AddedMassModel::None);
    let error = Simulation::new(strips).err().expect("refused").to_string();
    assert!(error.contains("measured surface"), "{error}");
}
