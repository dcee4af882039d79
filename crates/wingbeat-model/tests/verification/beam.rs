//! Beams of wings: lumped masses, coupled sections, the left wing as the mirror image, bad input.

use wingbeat_math::{DMat3, DVec3, outer, r1, r2, trace};
use wingbeat_model::deformation::SpanLaw;
use wingbeat_model::structure::{Blank, Damping};
use wingbeat_model::{
    BeamMass, Coupling, ElasticBody, GridMesh, Members, Spacing, WingBeam, WingShell, WingStructure,
};
use wingbeat_structure::{
    Configuration, FrameMotion, NodeLoad, StaticSettings, equilibrium, modes,
};

const SPAN: f64 = 2.0;

/// A rectangle of one metre's chord, its leading edge half a metre ahead of the hinge.
fn mesh() -> GridMesh {
    let at = |k: usize| DVec3::new(0.5 - (k / 5) as f64, SPAN * (k % 5) as f64 / 4.0, 0.0);
    GridMesh {
        rows: 1,
        cols: 4,
        nodes: (0..10).map(at).collect(),
        columns: Spacing::Uniform,
    }
}

fn beam() -> WingBeam {
    WingBeam {
        axis_fraction: 0.5,
        elements: 24,
        stations: None,
        flap: SpanLaw::constant(3.0),
        lag: Some(SpanLaw::constant(300.0)),
        torsion: SpanLaw::constant(2.0),
        axial: None,
        shear: None,
        coupling: Coupling::default(),
        mass: Some(SpanLaw::constant(0.5)),
        mass_fraction: 0.5,
        inertia: Some(SpanLaw::constant(1e-6)),
        masses: vec![],
    }
}

fn point(at: f64, mass: f64) -> BeamMass {
    BeamMass {
        at,
        mass,
        offset: DVec3::ZERO,
        inertia: DMat3::ZERO,
    }
}

fn made(beam: &WingBeam, mesh: &GridMesh, mass: f64) -> ElasticBody {
    let structure = WingStructure {
        members: Members::Beam(beam.clone()),
        damping: Damping::default(),
        spectral_radius: 1.0,
    };
    structure.check("wing", 0.0).unwrap();
    structure.check_mass("wing", mass).unwrap();
    let name = "wing";
    structure.body(&Blank { name, mesh, mass }).unwrap()
}

#[test]
fn exact_first_frequency_with_a_mass_at_the_tip() {
    // 1 + cos b cosh b + mu b (cos b sinh b - sin b cosh b) = 0, mu the mass at the tip over that of the beam,
    // by bisection.
    for mu in [0.5, 5.0] {
        let f =
            |b: f64| 1.0 + b.cos() * b.cosh() + mu * b * (b.cos() * b.sinh() - b.sin() * b.cosh());
        let (mut low, mut high) = (0.1, 1.875_1);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if f(middle) > 0.0 {
                low = middle
            } else {
                high = middle
            }
        }
        let expected = low * low / (SPAN * SPAN) * (3.0_f64 / 0.5).sqrt();
        let loaded = WingBeam {
            masses: vec![point(1.0, mu * 0.5 * SPAN)],
            ..beam()
        };
        let body = made(&loaded, &mesh(), 0.0).structure;
        let found = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        // Mass of 24 elements at their points of Gauss: 0.019 / 24^2 of the first mode without a mass at the tip.
        let error = found[0].frequency() / expected - 1.0;
        assert!(error.abs() < 1e-4, "{mu}: {error:e}");
    }
}

type Change = fn(&mut WingBeam);

/// A rectangle of a chord \[m\] and span 0.5 m on a round spar of EI 0.5 N m2, 0.1 kg/m, in elements of 25 to the span.
fn on_a_round_spar(chord: f64, change: Change) -> ElasticBody {
    let at = |k: usize| DVec3::new(chord * (0.5 - (k / 5) as f64), (k % 5) as f64 / 8.0, 0.0);
    let mesh = GridMesh {
        rows: 1,
        cols: 4,
        nodes: (0..10).map(at).collect(),
        columns: Spacing::Uniform,
    };
    let mut spar = WingBeam {
        elements: 25,
        flap: SpanLaw::constant(0.5),
        lag: Some(SpanLaw::constant(0.5)),
        torsion: SpanLaw::constant(1e3),
        mass: Some(SpanLaw::constant(0.1)),
        inertia: Some(SpanLaw::constant(1e-8)),
        ..beam()
    };
    change(&mut spar);
    made(&spar, &mesh, 0.0)
}

#[test]
fn exact_first_frequency_of_a_slender_beam_whatever_its_chord() {
    let expected = 1.875_104_07_f64.powi(2) / 0.25 * (0.5_f64 / 0.1).sqrt();
    // What is changed, and the frequency of its first mode over that of bending out of the plane.
    let changes: [(Change, f64); 4] = [
        (|_| (), 1.0),
        (|b| b.axial = Some(SpanLaw::constant(100.0)), 1.0),
        (|b| b.lag = Some(SpanLaw::constant(5e-3)), 0.1),
        (
            |b| (b.lag, b.axial) = (None, Some(SpanLaw::constant(100.0))),
            1.0,
        ),
    ];
    let all = |chord: f64| changes.map(|(change, part)| (chord, change, part));
    for (chord, change, part) in [0.05, 0.175, 0.35].into_iter().flat_map(all) {
        let body = on_a_round_spar(chord, change).structure;
        let found = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
        // Lumping: 0.019 / 25^2.
        let error = found[0].frequency() / (part * expected) - 1.0;
        assert!(error.abs() < 5e-5, "{chord}: {error:e}");
    }
}

#[test]
fn exact_deflection_of_a_beam_that_shears() {
    // Timoshenko: P L^3 / (3 EI) + P L / GA, 14 and 86 % of it here, in the plane and out of it.
    let (force, shear) = (1e-6, 1.0);
    let body = on_a_round_spar(0.175, |b| b.shear = Some(SpanLaw::constant(1.0))).structure;
    let expected = force * (0.5_f64.powi(3) / (3.0 * 0.5) + 0.5 / shear);
    let (node, settings) = (body.nodes() - 1, StaticSettings::default());
    for axis in [DVec3::X, DVec3::Z] {
        let load = [NodeLoad {
            node,
            force: force * axis,
            moment: DVec3::ZERO,
            follows: false,
        }];
        let rest = body.rest();
        let at = equilibrium(&body, rest, &FrameMotion::REST, &load[..], &settings).unwrap();
        let moved = (at.position[node] - rest.position[node]).dot(axis);
        assert!((moved / expected - 1.0).abs() < 1e-6, "{moved} {expected}");
    }
}

#[test]
fn exact_lumped_masses_add_to_the_wing_where_they_are() {
    let store = BeamMass {
        at: 0.617,
        mass: 0.3,
        offset: DVec3::new(0.2, 0.05, -0.1),
        inertia: DMat3::from_diagonal(DVec3::new(0.02, 0.03, 0.04)),
    };
    let loaded = WingBeam {
        masses: vec![store],
        ..beam()
    };
    for mesh in [mesh(), mesh().mirrored()] {
        let of = |beam: &WingBeam| {
            let body = made(beam, &mesh, 0.0).structure;
            body.mass_properties(body.rest())
        };
        let (with, without) = (of(&loaded), of(&beam()));
        let side = mesh.nodes[4].y.signum();
        let centre = DVec3::new(0.2, side * (0.617 * SPAN + 0.05), -0.1);
        let added = wingbeat_math::MassProperties::about_centre(0.3, centre, store.inertia);
        let sum = without + added;
        assert!((with.mass - sum.mass).abs() < 1e-14);
        assert!((with.first_moment - sum.first_moment).length() < 1e-14);
        assert!(crate::gap(with.inertia, sum.inertia) < 1e-13);
    }
}

#[test]
fn exact_lumped_masses_are_part_of_the_mass_of_the_wing() {
    let loaded = WingBeam {
        mass: None,
        inertia: None,
        masses: vec![point(0.3, 0.4)],
        ..beam()
    };
    let body = made(&loaded, &mesh(), 1.5).structure;
    let all = body.mass_properties(body.rest());
    assert!((all.mass - 1.5).abs() < 1e-14);
    assert!((all.first_moment.y - (1.1 * 0.5 * SPAN + 0.4 * 0.3 * SPAN)).abs() < 0.4 * SPAN / 48.0);
}

/// Place and rotation vector of the tip under a small force and moment there.
fn tip(beam: &WingBeam, mesh: &GridMesh, force: DVec3, moment: DVec3) -> [DVec3; 2] {
    let body = made(beam, mesh, 0.0).structure;
    let last = body.nodes() - 1;
    let load = [NodeLoad {
        node: last,
        force,
        moment,
        follows: false,
    }];
    let rest: &Configuration = body.rest();
    let settings = StaticSettings::default();
    let at = equilibrium(&body, rest, &FrameMotion::REST, &load[..], &settings).unwrap();
    [
        at.position[last] - rest.position[last],
        at.rotation[last].to_scaled_axis(),
    ]
}

/// A beam that couples twist with bending, GJ 2, EI 3, K 1.
fn twisting() -> WingBeam {
    let terms = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    WingBeam {
        coupling: Coupling(vec![(0.0, terms), (1.0, terms)]),
        ..beam()
    }
}

#[test]
fn exact_twist_of_a_coupled_cantilever_under_a_force_at_its_tip() {
    // Curvatures are the inverse of [[GJ, K], [K, EI]] times (0, M), M = P (L - y): the tip turns by -K / (GJ
    // EI - K^2) P L^2 / 2 and rises by GJ / (GJ EI - K^2) P L^3 / 3. A force up is -w3; bending up turns about
    // section axis 2 by less than nothing.
    let small = 1e-6;
    let [place, turn] = tip(&twisting(), &mesh(), -small * DVec3::Z, DVec3::ZERO);
    let determinant = 2.0 * 3.0 - 1.0;
    let rise = 2.0 / determinant * small * SPAN.powi(3) / 3.0;
    let twist = 1.0 / determinant * small * SPAN * SPAN / 2.0;
    // Shear of GA L2 / EI 1e6 (0.6 of 3e-6 of bending without coupling) and squares of the rotation, 1e-6.
    assert!((-place.z - rise).abs() < 3e-6 * rise, "{place}");
    assert!((turn.y - twist).abs() < 1e-5 * twist, "{turn} {twist}");
}

#[test]
fn invariant_a_left_wing_is_the_mirror_image() {
    let terms = [3.0, -4.0, 5.0, 0.7, -9.0, 6.0];
    let coupled = WingBeam {
        coupling: Coupling(vec![(0.0, terms), (1.0, terms)]),
        masses: vec![point(0.5, 0.2)],
        ..beam()
    };
    let (force, moment) = (DVec3::new(0.3, -0.2, 0.5), DVec3::new(0.4, 0.1, -0.6));
    let flip = DVec3::new(1.0, -1.0, 1.0);
    let right = tip(&coupled, &mesh(), 1e-3 * force, 1e-3 * moment);
    let left = tip(
        &coupled,
        &mesh().mirrored(),
        1e-3 * flip * force,
        -1e-3 * flip * moment,
    );
    assert!((left[0] - flip * right[0]).length() < 1e-12 * right[0].length().max(1e-3));
    assert!((left[1] + flip * right[1]).length() < 1e-12 * right[1].length().max(1e-3));
    assert!(right[1].length() > 1e-5);
}

#[test]
fn exact_force_through_the_tension_centre_stretches_without_bending() {
    // Tension centre a tenth of a metre ahead: K of stretch and lag -EA y, EI about the axis that much larger.
    let (axial, ahead) = (3600.0, 0.1);
    let terms = [0.0, 0.0, -axial * ahead, 0.0, 0.0, 0.0];
    let off = WingBeam {
        axial: Some(SpanLaw::constant(axial)),
        lag: Some(SpanLaw::constant(300.0 + axial * ahead * ahead)),
        coupling: Coupling(vec![(0.0, terms), (1.0, terms)]),
        ..beam()
    };
    let force = 1e-3;
    // About the axis the force ahead has the moment x X y = z.
    let moment = ahead * force * DVec3::Z;
    let [place, turn] = tip(&off, &mesh(), force * DVec3::Y, moment);
    assert!(
        (place.y - force * SPAN / axial).abs() < 1e-6 * place.y,
        "{place}"
    );
    assert!(
        turn.length() < 1e-12 && place.x.abs() < 1e-12,
        "{turn} {place}"
    );
}

#[test]
fn agrees_stations_at_equal_distances_with_elements() {
    let stations = (0..=24).map(|k| f64::from(k) / 24.0).collect();
    let given = WingBeam {
        stations: Some(stations),
        ..beam()
    };
    let load = |beam: &WingBeam| tip(beam, &mesh(), DVec3::new(0.0, 0.0, 0.3), DVec3::ZERO);
    assert!((load(&given)[0] - load(&beam())[0]).length() < 1e-12);
}

#[test]
fn refuses_impossible_beams_by_name() {
    let off = |change: fn(&mut WingBeam)| {
        let mut beam = beam();
        change(&mut beam);
        let structure = WingStructure {
            members: Members::Beam(beam),
            damping: Damping::default(),
            spectral_radius: 1.0,
        };
        let checked = structure.check("wing", 0.0);
        let weighed = checked.and_then(|()| structure.check_mass("wing", 0.1));
        weighed.unwrap_err().to_string()
    };
    for (says, change) in [
        (
            "mass[0].at",
            (|b| b.masses.push(point(1.5, 0.1))) as fn(&mut WingBeam),
        ),
        ("mass[0].mass", |b| b.masses.push(point(0.5, -0.1))),
        ("mass[0].inertia", |b| {
            b.masses.push(BeamMass {
                inertia: -DMat3::IDENTITY,
                ..point(0.5, 0.1)
            });
        }),
        ("beam.mass", |b| {
            b.mass = None;
            b.masses.push(point(0.5, 0.2));
        }),
        // All of the wing's 0.1 kg, and all but rounding: nothing, or a mass of rounding, is left.
        ("beam.mass", |b| {
            b.mass = None;
            b.masses.push(point(0.5, 0.1));
        }),
        ("beam.mass", |b| {
            b.mass = None;
            b.masses.push(point(0.5, 0.1 * (1.0 - 1e-15)));
        }),
        ("stations", |b| b.stations = Some(vec![0.0, 0.6, 0.5, 1.0])),
        ("stations", |b| b.stations = Some(vec![0.0, 0.6])),
        ("coupling", |b| {
            b.coupling = Coupling(vec![(0.2, [0.0; 6]), (1.0, [0.0; 6])])
        }),
        ("mass", |b| b.mass = Some(SpanLaw::constant(0.0))),
        ("axial", |b| b.axial = Some(SpanLaw::constant(0.0))),
        ("shear", |b| b.shear = Some(SpanLaw::constant(0.0))),
    ] {
        let said = off(change);
        assert!(said.contains(says), "{says}: {said}");
    }
    // Coupling that leaves no positive stiffness is refused when the elastic body is made.
    let mut unstable = twisting();
    unstable.coupling.0[1].1[3] = 3.0;
    unstable.coupling.0[0].1[3] = 3.0;
    let structure = WingStructure {
        members: Members::Beam(unstable),
        damping: Damping::default(),
        spectral_radius: 1.0,
    };
    let (name, mesh) = ("wing", &mesh());
    let mass = 0.0;
    assert!(structure.body(&Blank { name, mesh, mass }).is_err());
}

/// A swept, tapered wing whose mesh is turned by `turn` about the hinge.
fn turned(turn: DMat3) -> GridMesh {
    let node = |k: usize| {
        let (i, y) = ((k / 5) as f64 / 2.0, 0.1 + 0.45 * (k % 5) as f64);
        turn * DVec3::new(0.4 - 0.1 * y - (0.8 - 0.2 * y) * i, y, 0.0)
    };
    GridMesh {
        rows: 2,
        cols: 4,
        nodes: (0..15).map(node).collect(),
        columns: Spacing::Uniform,
    }
}

#[test]
fn invariant_elastic_wings_of_a_turned_mesh_have_the_same_modes_and_mass() {
    let of_beam = |mass: Option<SpanLaw>| {
        let beam = beam();
        Members::Beam(WingBeam { mass, ..beam })
    };
    let sheet = WingShell {
        fibre_angle: 0.3,
        rigid_fraction: 0.3,
        ..WingShell::combes_daniel([2.0, 1.0, 0.5], 0.3)
    };
    let all = [
        of_beam(None),
        of_beam(Some(SpanLaw::constant(0.5))),
        Members::Shell(sheet),
    ];
    for members in all {
        let structure = WingStructure {
            members,
            damping: Damping::default(),
            spectral_radius: 1.0,
        };
        let found = |q: DMat3| {
            let mesh = turned(q);
            let wing = Blank {
                name: "wing",
                mesh: &mesh,
                mass: 0.5,
            };
            let body = structure.body(&wing).unwrap().structure;
            let modes = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
            let first = modes
                .iter()
                .take(6)
                .map(|m| m.frequency())
                .collect::<Vec<_>>();
            (first, body.mass_properties(body.rest()))
        };
        let (flat, mass) = found(DMat3::IDENTITY);
        for q in [r2(0.4), r1(0.5), r1(-0.3) * r2(0.6)] {
            let (frequencies, own) = found(q);
            for (a, b) in frequencies.iter().zip(&flat) {
                assert!((a / b - 1.0).abs() < 1e-6, "{frequencies:?} {flat:?}");
            }
            let centre = (own.first_moment - q * mass.first_moment).length();
            assert!((own.mass / mass.mass - 1.0).abs() < 1e-12 && centre < 1e-12);
        }
    }
}

/// Sections lie along the chord, oblique to a beam that is swept: masses and moments are those of the plate.
#[test]
fn exact_a_swept_beam_has_the_masses_of_its_plate() {
    let (sweep, mass) = (30f64.to_radians(), 0.8);
    for side in [1.0, -1.0] {
        let swept = |x: DVec3| DVec3::new(x.x - x.y * sweep.tan(), side * x.y, 0.0);
        let mut plate = mesh();
        plate.nodes.iter_mut().for_each(|x| *x = swept(*x));
        // Of the plate, chord 1 and span 2, about the hinge: a rod along the chord, wherever its middle is.
        let centre = swept(DVec3::new(0.0, 0.5 * SPAN, 0.0));
        let along = DVec3::new(-sweep.tan(), side, 0.0);
        let second =
            mass * (outer(centre) + SPAN * SPAN / 12.0 * outer(along) + outer(DVec3::X) / 12.0);
        let inertia = trace(second) * DMat3::IDENTITY - second;
        for elements in [1, 7] {
            let beam = WingBeam {
                axis_fraction: 0.2,
                mass: None,
                inertia: None,
                elements,
                ..beam()
            };
            let body = made(&beam, &plate, mass);
            let found = (body.structure).mass_properties(body.structure.rest());
            assert!((found.mass / mass - 1.0).abs() < 1e-12);
            assert!((found.first_moment - mass * centre).length() < 1e-12);
            // The thickness of a hundredth of the chord has a ten thousandth of its moment.
            let thick = 1e-4 / 12.0 * mass * (DMat3::IDENTITY - outer(DVec3::Z));
            let apart = (found.inertia - inertia - thick).to_cols_array();
            assert!(apart.iter().all(|x| x.abs() < 1e-14), "{apart:?}"); // roundings
        }
    }
}

/// A sheet ends at its point, where all rows of its mesh end, whatever number the node there has.
#[test]
fn exact_the_tip_of_a_pointed_sheet_is_its_point() {
    let at = |k: usize| {
        let (side, along) = ([1.0, 0.0, -1.0][k / 7], (k % 7) as f64 / 6.0);
        DVec3::new(side * 0.05 * (1.0 - along).sqrt(), 0.3 * along, 0.0)
    };
    let mesh = GridMesh {
        rows: 2,
        cols: 6,
        nodes: (0..21).map(at).collect(),
        columns: Spacing::Uniform,
    };
    let sheet = WingShell::solid([70e9; 2], 0.3, SpanLaw::constant(1e-3));
    let structure = WingStructure {
        members: Members::Shell(sheet),
        damping: Damping::default(),
        spectral_radius: 1.0,
    };
    let (name, mass, mesh) = ("wing", 0.1, &mesh);
    let body = structure.body(&Blank { name, mesh, mass }).unwrap();
    assert_eq!(body.structure.rest().position[body.tip], mesh.nodes[6]);
    let beam = made(&beam(), &self::mesh(), 1.0);
    let tip = beam.structure.rest().position[beam.tip];
    assert!((tip.y - SPAN).abs() < 1e-12, "{tip}");
}
