//! Every preset is a case that can be flown, and a resolved case is the same case.

use std::path::Path;

use wingbeat_case::{LoadedCase, presets::PRESETS};

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
    let case = LoadedCase::find("fruit-fly-hover", &[]).unwrap();
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
