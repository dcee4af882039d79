//! Air of which one half is computed, the other being its mirror image: the shape of one wing of a pair is
//! computed then, too, and joints of both move alike.

use super::{apart, beam, fly, strings};
use wingbeat::flight::Record;

/// Wings that slowly come into their motion on hinges of one kind, one half of the air computed or both.
fn hinged(hinge: &[&str], more: &[String], mirror: bool) -> Vec<Record> {
    let set = strings(&[
        "air.model=\"vortex_lattice\"",
        "air.shed=[\"trailing\"]",
        "air.summation=\"direct\"",
        "wing.right.mesh.chordwise=2",
        "wing.right.mesh.spanwise=3",
        "time.beats=0.2",
        &format!("air.mirror={mirror}"),
    ]);
    let hinge = hinge.iter().map(|h| format!("joint.h.{h}"));
    let child = "joint.h.child=\"right\"".to_owned();
    let all: Vec<String> = set.into_iter().chain([child]).chain(hinge).collect();
    fly(&[&all[..], more].concat())
}

/// Largest of all joint coordinates, and by how much they differ.
fn joints_apart(a: &[Record], b: &[Record]) -> [f64; 2] {
    let all = |r: &Record| r.joints.iter().map(|j| j[0]).collect::<Vec<f64>>();
    let [a, b] = [a, b].map(|x| x.iter().flat_map(all).collect::<Vec<f64>>());
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
    [
        a.iter().fold(0.0, |m, x| x.abs().max(m)),
        apart.fold(0.0, f64::max),
    ]
}

const STIFF: &str = "stiffness_newton_m_per_rad = 0.05, damping_newton_m_s_per_rad = 1e-5";

/// Hinges of all kinds with springs, free and on a tether, rigid and elastic wings.
#[test]
fn agrees_half_of_the_air_with_both_halves_for_wings_on_joints() {
    let springs = |count: usize| {
        let spring = |k| format!("{{ direction = {k}, {STIFF} }}");
        format!(
            "element=[{}]",
            (0..count).map(spring).collect::<Vec<_>>().join(", ")
        )
    };
    let slide = "element=[{ stiffness_newton_per_m = 2.0, damping_newton_s_per_m = 0.01 }]";
    let kinds: [(&[&str], String); 4] = [
        (&["kind=\"revolute\"", "axis=[0.6,0.8,0]"], springs(1)),
        (
            &["kind=\"universal\"", "axes=[[0,1,0],[1,0,0]]"],
            springs(2),
        ),
        (&["kind=\"spherical\""], springs(3)),
        (&["kind=\"prismatic\"", "axis=[0,0.6,0.8]"], slide.into()),
    ];
    let bdf = strings(&["dynamics.integrator=\"bdf\""]);
    let held = strings(&["flight.mode=\"tethered\""]);
    let soft = beam(2e-2).to_vec();
    let rigid = |mode: &[String]| [&bdf, mode].concat();
    let settings = [
        rigid(&[]),
        [&rigid(&[])[..], &soft].concat(),
        [&rigid(&held)[..], &soft].concat(),
    ];
    // The added mass of a rigid wing holds its image where one half is computed, and what is taken for it is of
    // second order in the step; elastic wings and air agree to 1e-10 of the natural sizes, which hinges of
    // small inertia turn into accelerations.
    let bounds = [5e-3, 1e-3, 1e-3];
    for (kind, springs) in &kinds {
        let hinge = [kind, &[springs.as_str()][..]].concat();
        for (setting, bound) in settings.iter().zip(bounds) {
            let [half, both] = [true, false].map(|m| hinged(&hinge, setting, m));
            let [largest, apart] = joints_apart(&half, &both);
            assert!(
                largest > 1e-5 && apart < bound * largest,
                "{hinge:?}: {apart:e} of {largest:e}"
            );
            for r in &half {
                let (left, right) = r.joints.split_at(r.joints.len() / 2);
                let sizes = left.iter().zip(right).map(|(l, r)| l[0].abs() - r[0].abs());
                assert!(sizes.fold(0.0, |m: f64, d| d.abs().max(m)) == 0.0);
            }
        }
    }
}

/// Wings whose roots are driven: beams, and sheets with a vein.
#[test]
fn agrees_half_of_the_air_with_both_halves_for_elastic_wings() {
    let sheet = strings(&[
        "wing.right.structure.shell.young_pa=1e9",
        "wing.right.structure.shell.thickness_m=[4e-4,2e-4]",
        "wing.right.structure.vein=[{ radius_m = [1e-3, 5e-4], young_pa = 5e9 }]",
    ]);
    for structure in [beam(2e-3).to_vec(), sheet] {
        let flight = |mirror: bool| {
            let set = strings(&[
                "air.model=\"vortex_lattice\"",
                "air.shed=[\"trailing\",\"tip\"]",
                "air.summation=\"direct\"",
                &format!("air.mirror={mirror}"),
            ]);
            fly(&[set, structure.clone()].concat())
        };
        let [half, both] = [true, false].map(flight);
        let largest = both
            .iter()
            .fold(0.0_f64, |m, r| m.max(r.air_force().length()));
        let tips = |r: &Record| r.elastic.iter().map(|e| e.tip.length()).fold(0.0, f64::max);
        let moved = both.iter().map(tips).fold(0.0, f64::max);
        assert!(moved > 1e-4, "{moved}");
        // Shape and air agree to 1e-10 of the forces, step by step.
        let apart = apart(&half, &both);
        assert!(apart < 3e-7 * largest, "{apart:e} of {largest:e}");
        for r in &half {
            let [left, right] = [0, 1].map(|k| r.elastic[k]);
            let image = wingbeat::math::DVec3::new(right.tip.x, -right.tip.y, right.tip.z);
            // The difference of two places: a rounding of the length of the wing.
            assert!(left.tip.distance(image) < 1e-16);
            assert!(left.strain_energy == right.strain_energy);
        }
    }
}
