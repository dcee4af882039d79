//! Every preset is a case that can be flown, and a resolved case is the same case.

use std::path::Path;

use wingbeat_case::{LoadedCase, presets::PRESETS};
use wingbeat_flight::{AirModel, FlightSetup, Record, Simulation};
use wingbeat_math::{DMat3, DVec3, RotationLaw};
use wingbeat_model::Wing;

#[test]
fn agrees_every_preset_with_its_resolved_case() {
    for preset in PRESETS {
        let case = LoadedCase::find(preset.name, &[]).unwrap_or_else(|e| panic!("{e}"));
        let again = LoadedCase::from_text("resolved", &case.resolved(), Path::new(""), &[])
            .unwrap_or_else(|e| panic!("{e}\n{}", case.resolved()));
        assert_eq!(
            format!("{:?}", case.setup),
            format!("{:?}", again.setup),
            "{}",
            preset.name
        );
        assert_eq!(case.raw, again.raw, "{}", preset.name);
    }
}

#[test]
fn agrees_the_default_preset_with_the_fruit_fly_of_the_model() {
    // Frequency and mean stroke angle of the preset are those of its hover.
    let measured = [
        "motion.frequency_hz=200",
        "motion.adjust.stroke_offset_deg=0",
    ];
    let case = LoadedCase::find("fruit-fly-hover", &measured.map(String::from)).unwrap();
    let fly = wingbeat_model::species::drosophila_melanogaster(&Default::default()).unwrap();
    let (a, b) = (&case.setup.animal, &fly);
    // Same numbers by another order of operations: a few roundings.
    let close = |x: f64, y: f64| (x - y).abs() <= 1e-12 * x.abs().max(y.abs());
    assert!(close(a.mass(), b.mass()), "{} {}", a.mass(), b.mass());
    assert!(
        close(a.body.inertia.y_axis.y, b.body.inertia.y_axis.y),
        "{:?} {:?}",
        a.body,
        b.body
    );
    assert_eq!(a.wings.len(), b.wings.len());
    for (w, v) in a.wings.iter().zip(&b.wings) {
        assert_eq!(w.name, v.name);
        assert!((w.hinge_b - v.hinge_b).length() < 1e-15);
        assert!(close(w.mass.inertia.x_axis.x, v.mass.inertia.x_axis.x));
        for k in 0..20 {
            let t = f64::from(k) * 3e-4;
            let (p, q) = (w.motion.angles(t), v.motion.angles(t));
            for i in 0..3 {
                assert!((p[i][0] - q[i][0]).abs() < 1e-12);
            }
        }
        for (x, y) in w.mesh.nodes.iter().zip(&v.mesh.nodes) {
            assert!((*x - *y).length() < 1e-15); // metres, roundings of 1e-3
        }
    }
}

#[test]
fn exact_schema_describes_every_key_of_the_resolved_default() {
    let schema: serde_json::Value = serde_json::from_str(&wingbeat_case::schema()).unwrap();
    let case = LoadedCase::find("fruit-fly-hover", &[]).unwrap();
    let resolved: toml::Table = case.resolved().parse().unwrap();
    for key in resolved.keys() {
        assert!(
            schema["properties"][key].is_object(),
            "`{key}` is not in the schema"
        );
    }
    assert_eq!(schema["additionalProperties"], false);
}

fn simulation(preset: &str, set: &[&str]) -> Simulation {
    let set: Vec<String> = set.iter().map(|&s| s.to_owned()).collect();
    let case = LoadedCase::find(preset, &set).unwrap_or_else(|e| panic!("{e}"));
    Simulation::new(case.setup).unwrap_or_else(|e| panic!("{preset}: {e}"))
}

/// Mirror image about the plane of symmetry.
fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(v.x, -v.y, v.z)
}

/// Largest difference between the air's force on a wing and the mirror image of that on its twin over
/// `steps` steps, relative to the largest force.
fn asymmetry(flight: &mut Simulation, steps: usize) -> f64 {
    let names: Vec<String> = (flight.setup().animal.wings.iter())
        .map(|w| w.name.clone())
        .collect();
    let twin = |k: usize| {
        let twin = names[k].replace("left", "right");
        names.iter().position(|n| *n == twin).filter(|&t| t != k)
    };
    let pairs: Vec<[usize; 2]> = (0..names.len())
        .filter_map(|k| twin(k).map(|t| [k, t]))
        .collect();
    assert!(!pairs.is_empty());
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for _ in 0..steps {
        let air = &flight.step().unwrap_or_else(|e| panic!("{e}")).air;
        for [a, b] in pairs.iter().map(|p| p.map(|w| air[1 + w].force)) {
            apart = apart.max(a.distance(mirrored(b)));
            largest = largest.max(a.length());
        }
    }
    apart / largest
}

/// Without `air.mirror` both halves are computed, and rounding is all that may part them: it decides
/// nothing, not even where wakes meet wings.
#[test]
fn invariant_left_equals_right_with_a_clearance() {
    let both = ["air.mirror=false", "time.beats=1", "air.summation=direct"];
    let attached = "air.shed=[\"trailing\",\"tip\"]";
    let mut flight = simulation("fruit-fly-tethered", &[&both[..], &[attached]].concat());
    let attached = asymmetry(&mut flight, 40);
    let mut flight = simulation("fruit-fly-tethered", &both);
    let separated = asymmetry(&mut flight, 40);
    let met = flight
        .state()
        .air
        .as_ref()
        .and_then(wingbeat_flight::AirMemory::wakes)
        .unwrap()
        .events
        .near_surface;
    println!(
        "left and right differ by {attached:.1e} attached, {separated:.1e} separated, {met} contacts"
    );
    assert!(met > 100, "the wakes must meet the wings: {met}");
    // Roundings, a hundred of them; 1e-8 where the sums are in single precision.
    assert!(attached < 1e-13 && separated < 1e-12);
}

/// Half of the air, and the other half as its mirror image, for a body of parts that move against each
/// other.
#[test]
fn agrees_mirrored_air_of_an_articulated_body_with_both_halves() {
    let forces = |mirror: &str| -> Vec<DVec3> {
        let set = ["air.summation=direct", mirror];
        let mut flight = simulation("fruit-fly-abdomen", &set);
        let mut forces = vec![];
        for _ in 0..20 {
            let record = flight.step().unwrap_or_else(|e| panic!("{e}"));
            forces.extend(record.air.iter().map(|w| w.force));
        }
        forces
    };
    let [half, whole] = ["air.mirror=true", "air.mirror=false"].map(forces);
    let largest = whole.iter().map(|f| f.length()).fold(0.0, f64::max);
    let apart = half.iter().zip(&whole).map(|(a, b)| a.distance(*b));
    let apart = apart.fold(0.0, f64::max) / largest;
    // Roundings of two orders of summation.
    println!("apart by {apart:.1e}");
    assert!(apart < 1e-13, "{apart:.1e}");
}

/// The paper's first stage: head, thorax and abdomen do not move against each other, so that five bodies
/// with 30 coordinates and 24 constraints are three with 18 and 12, their wings' multipliers the same.
#[test]
fn agrees_five_bodies_of_the_paper_with_three() {
    let records = |name: &str, set: &[&str], steps: usize| -> Vec<Record> {
        let mut flight = simulation(name, set);
        let step = |_| flight.step().unwrap_or_else(|e| panic!("{e}")).clone();
        (0..steps).map(step).collect()
    };
    for (set, steps, bound) in [
        // Roundings of a matrix of 54 instead of 30 rows, some 1e5 of them (measured 3e-12).
        (&["air.model=none"][..], 80, 3e-11),
        // The separated wake lets them grow (measured 2e-11).
        (&[], 8, 2e-10),
    ] {
        let three = records("roccia-2011", set, steps);
        let five = records("roccia-2011-five-bodies", set, steps);
        let mut worst = [0.0_f64; 2];
        let largest = |all: &[Record]| -> f64 {
            let forces = all.iter().flat_map(|r| &r.multipliers[..3]);
            forces.fold(0.0, |a: f64, x| a.max(x.abs()))
        };
        let scale = largest(&three);
        for (a, b) in three.iter().zip(&five) {
            assert_eq!((a.coordinates.len(), b.coordinates.len()), (18, 30));
            assert_eq!((a.multipliers.len(), b.multipliers.len()), (12, 24));
            // Position over the length of a wing, angles: central body and wings.
            let apart = |i: usize| {
                let unit = if i % 6 < 3 { 2.5e-3 } else { 1.0 };
                (a.coordinates[i] - b.coordinates[i]).abs() / unit
            };
            worst[0] = (0..18).map(apart).fold(worst[0], f64::max);
            let forces = |i: usize| (a.multipliers[i] - b.multipliers[i]).abs() / scale;
            worst[1] = (0..3).map(forces).fold(worst[1], f64::max);
        }
        println!(
            "{set:?}: coordinates apart by {:.1e}, forces by {:.1e}",
            worst[0], worst[1]
        );
        assert!(worst[0] < bound && worst[1] < 10.0 * bound, "{worst:?}");
    }
}

/// Whether a segment meets a triangle.
fn meets([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let (way, u, v) = (q - p, b - a, c - a);
    let system = DMat3::from_cols(u, v, -way);
    if system.determinant().abs() < 1e-12 * u.length() * v.length() * way.length() {
        return false;
    }
    let s = system.inverse() * (p - a);
    s.x >= 0.0 && s.y >= 0.0 && s.x + s.y <= 1.0 && (0.0..=1.0).contains(&s.z)
}

/// Panels of a wing in the body's axes at time `t`.
fn panels(wing: &Wing, t: f64) -> Vec<[DVec3; 4]> {
    let turn = wing.motion.at(t).c;
    let node = |n: usize| wing.hinge_b + turn * wing.mesh.nodes[n];
    let all = wing.mesh.panels(wing.side);
    all.into_iter().map(|c| c.map(node)).collect()
}

/// Least and largest coordinates.
fn bounds(points: &[DVec3]) -> [DVec3; 2] {
    let all = || points.iter().copied();
    [all().reduce(DVec3::min), all().reduce(DVec3::max)].map(|x| x.unwrap())
}

/// Whether the wings `a` and `b` cut through each other.
fn cut(a: &[[DVec3; 4]], b: &[[DVec3; 4]]) -> bool {
    let edges = |w: &[[DVec3; 4]]| -> Vec<[DVec3; 2]> {
        w.iter()
            .flat_map(|c| [0, 1, 2, 3].map(|k| [c[k], c[(k + 1) % 4]]))
            .collect()
    };
    let halves = |c: &[DVec3; 4]| [[c[0], c[1], c[2]], [c[0], c[2], c[3]]];
    let one_way = |a: &[[DVec3; 4]], b: &[[DVec3; 4]]| {
        let edges = edges(a);
        // Boxes first: most panels are far from the other wing.
        let [low, high] = bounds(edges.as_flattened());
        let near = |t: &[DVec3; 3]| {
            let [from, to] = bounds(t);
            from.cmple(high).all() && to.cmpge(low).all()
        };
        let mut triangles = b.iter().flat_map(halves).filter(near);
        triangles.any(|t| edges.iter().any(|e| meets(*e, t)))
    };
    one_way(a, b) || one_way(b, a)
}

/// Stiff wings of a lattice that pass through each other see each other's vortices without end. Left
/// out: wings on joints of their own, which move otherwise than prescribed, wings joined at an edge they
/// share, and strips of blade elements, which do not see each other (of measured motions with stiff
/// wings some cut a little: those of the hawkmoth at their roots, of the locust fore in hind wings).
#[test]
fn exact_lattice_wings_of_presets_do_not_cut_each_other() {
    let mut seen = 0;
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        let AirModel::VortexLattice(air) = &setup.air else {
            continue;
        };
        if !setup.joints.is_empty() || !air.joined.is_empty() {
            continue;
        }
        seen += 1;
        let Some(period) = setup.time.period else {
            continue;
        };
        let wings = &setup.animal.wings;
        for k in 0..120 {
            let t = k as f64 / 40.0 * period;
            let now: Vec<_> = wings.iter().map(|w| panels(w, t)).collect();
            for i in 0..now.len() {
                for j in 0..i {
                    let [a, b] = [i, j].map(|w| &wings[w].name);
                    assert!(
                        !cut(&now[i], &now[j]),
                        "{}: `{a}` and `{b}`, beat {:.3}",
                        preset.name,
                        k as f64 / 40.0
                    );
                }
            }
        }
    }
    assert!(seen > 5, "{seen} presets fly in a lattice");
}

/// Distance from the plane of symmetry over the length of the longest wing, and turn out of it.
fn out_of_symmetry(flight: &Simulation) -> f64 {
    let length = |w: &Wing| w.mesh.nodes.iter().map(|x| x.length()).fold(0.0, f64::max);
    let longest = flight
        .setup()
        .animal
        .wings
        .iter()
        .map(length)
        .fold(0.0, f64::max);
    let root = flight.root();
    (root.p.y.abs() / longest).max((root.r.y_axis - DVec3::Y).length())
}

/// Whether nothing in the setup tells left from right.
fn is_symmetric(setup: &FlightSetup) -> bool {
    let animal = &setup.animal;
    let twin = |w: &Wing| {
        let image = w.mirrored(&w.name.replace("left", "right"));
        animal
            .wings
            .iter()
            .any(|v| v.name == image.name && format!("{v:?}") == format!("{image:?}"))
    };
    let mut left = animal.wings.iter().filter(|w| w.name.contains("left"));
    let pairs = animal.wings.len() == 2 * left.clone().count();
    let root = setup.root_at_start();
    pairs
        && left.all(twin)
        && setup.loads.is_empty()
        // Feedback wants both halves computed, which part by chaos of their wakes after some beats.
        && setup.feedback.is_none()
        && root.p.y == 0.0
        && root.w.x == 0.0
        && root.w.z == 0.0
        && root.v.y == 0.0
        && (root.r.y_axis - DVec3::Y).length() < 1e-15
}

/// Without air nothing tells left from right, to the last bit: bodies, wing motions and the equations of both
/// forms round alike on both sides.
#[test]
fn exact_symmetric_presets_fly_straight_without_air() {
    let mut symmetric = 0;
    for preset in PRESETS {
        let mut setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        if !is_symmetric(&setup) {
            continue;
        }
        setup.air = AirModel::None;
        let mut flight = Simulation::new(setup).unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        for _ in 0..20 {
            flight
                .step()
                .unwrap_or_else(|e| panic!("{}: {e}", preset.name));
        }
        // Free joints are eliminated one side after the other: a few roundings (measured 2.3e-19).
        // Elastic wings are brought to balance one by one, rounding each in its own axes (measured 5.3e-17).
        let is_elastic = !flight.elastic_wings().is_empty();
        let allowed = match flight.setup().joints.is_empty() {
            _ if is_elastic => 5e-16,
            true => 0.0,
            false => 2e-18,
        };
        let apart = out_of_symmetry(&flight);
        assert!(apart <= allowed, "{}: {apart:.1e}", preset.name);
        symmetric += 1;
    }
    assert!(symmetric > 20, "{symmetric}");
}

/// Every preset is flown to its end; those that do not tell left from right stay in their plane of
/// symmetry.
#[test]
#[ignore = "minutes; see CONTRIBUTING.md"]
fn invariant_every_preset_flies_to_its_end_symmetric_ones_symmetrically() {
    let mut symmetric = 0;
    for preset in PRESETS {
        let begun = std::time::Instant::now();
        let mut flight = simulation(preset.name, &[]);
        let tells_no_side = is_symmetric(flight.setup());
        let mut worst = 0.0_f64;
        while !flight.finished() {
            let step = flight.state().step;
            (flight.step()).unwrap_or_else(|e| panic!("{}, step {step}: {e}", preset.name));
            worst = worst.max(out_of_symmetry(&flight));
        }
        let state = flight.state();
        println!(
            "{}: {} steps, {:.1} s, out of symmetry {worst:.1e}{}",
            preset.name,
            state.step,
            begun.elapsed().as_secs_f64(),
            if tells_no_side { "" } else { " (asymmetric)" }
        );
        assert_eq!(state.step, flight.setup().time.steps);
        if tells_no_side {
            symmetric += 1;
            // Roundings (measured 1e-14 at most). Where both halves of a lattice are computed, each sums the
            // vortices of its own side first or last, and the separated wake makes what the roundings differ by
            // grow: 1e-12 m/s of lateral speed at the start end as 80 pm and 6e-7 rad of roll. Measured 4e-11 and
            // 4e-10 with flights that differ by roundings alone.
            let both = matches!(&flight.setup().air, AirModel::VortexLattice(air) if !air.mirror);
            let allowed = if both { 4e-9 } else { 1e-13 };
            assert!(worst < allowed, "{}: {worst:.1e}", preset.name);
        }
    }
    assert!(symmetric > 20, "{symmetric}");
}

/// A delta's edges are swept by more than 45 deg; insects' wings are not, nor is anything said where leading
/// edges shed.
#[test]
fn behaves_vortex_lift_is_doubted_at_swept_edges() {
    let wing = |name: &str, swept: &str, choice: &str| {
        let set = [
            format!("air.leading_edge={choice}"),
            format!("wing.right.planform={swept}"),
        ];
        let case = LoadedCase::find(name, &set).unwrap_or_else(|e| panic!("{e}"));
        case.setup.vortex_lift_of_swept_edges()
    };
    let outline = |sweep: f64| {
        let [tip, root] = [-3e-3 * sweep, 1e-3];
        format!(
            "{{ outline = {{ leading_m = [[0, {root}], [3e-3, {}]], trailing_m = [[0, -2e-3], [3e-3, {}]] }} }}",
            root + tip,
            root + tip - 1e-4
        )
    };
    let fly = "fruit-fly-tethered";
    assert!(
        wing(fly, &outline(1.3), "vortex_lift")
            .unwrap()
            .contains("are swept by up to")
    );
    assert_eq!(wing(fly, &outline(0.9), "vortex_lift"), None);
    assert_eq!(wing(fly, &outline(1.3), "suction"), None);
}

/// A delta held at 20 deg whose sharply swept edges shed is named; one swept by less, one that goes two chords,
/// one whose edges hold all and wings that beat are not.
#[test]
fn behaves_shedding_of_sharply_swept_edges_is_doubted() {
    let delta = |half: f64, steps: usize, angle: f64| {
        let text = format!(
            "format = 1\n[time]\nstep_s = 1e-3\nsteps = {steps}\n[flight]\nmode = \"tethered\"\n\
             [air]\nstream_m_s = [-10, 0, 0]\nbody = false\nleading_edge = \"suction_implicit\"\n\
             [body]\nmass_kg = 0.1\ninertia_about_centre_kg_m2 = [1e-4, 1e-4, 1e-4, 0, 0, 0]\n\
             [wing.right]\nhinge_m = [0, 0, 0]\njoined = true\nmass_kg = 0\nmotion.psi.constant_deg = {angle}\n\
             planform.outline = {{ leading_m = [[0, 0.05], [{half}, -0.048]], trailing_m = [[0, -0.05], [{half}, -0.05]], \
             least_chord = 0.02 }}\n"
        );
        let case = LoadedCase::from_text("delta", &text, Path::new("."), &[]);
        case.unwrap_or_else(|e| panic!("{e}"))
            .setup
            .shedding_of_swept_edges()
    };
    let said = delta(0.025, 40, 20.0).unwrap();
    assert!(said.contains("76 deg") && said.contains("20 deg"), "{said}");
    assert_eq!(delta(0.06, 40, 20.0), None);
    assert_eq!(delta(0.025, 10, 20.0), None);
    assert_eq!(delta(0.025, 40, 8.0), None);
    for preset in PRESETS {
        let setup = LoadedCase::find(preset.name, &[]).unwrap().setup;
        assert_eq!(setup.shedding_of_swept_edges(), None, "{}", preset.name);
    }
}

/// The slope that is advised for attached wings is doubted where leading edges shed.
#[test]
fn behaves_thin_cores_behind_leading_edges_are_doubted() {
    let said = |name: &str, slope: &str| {
        let set = [format!("air.wake_overlap_slope={slope}")];
        let case = LoadedCase::find(name, &set).unwrap_or_else(|e| panic!("{e}"));
        case.setup.thin_cores_behind_leading_edges()
    };
    assert!(said("fruit-fly-tethered", "0.03").unwrap().contains("0.03"));
    assert_eq!(said("fruit-fly-tethered", "0.25"), None);
    assert_eq!(said("dragonfly", "0.03"), None); // attached
}
