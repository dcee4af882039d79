//! Sheets whose tension at rest pulls at free edges.

mod plate;

use plate::rectangle;
use wingbeat_math::DVec3;
use wingbeat_structure::{FrameMotion, Lamina, Structure, StructureBuilder, StructureError, modes};

/// A strip that is clamped at one end cannot hold a tension along it: it shortens until the strain `(l^2 - 1) /
/// 2 = -N / (E h)` leaves no stress, and vibrates as a strip without tension.
#[test]
fn exact_a_strip_with_a_free_end_gives_way_to_tension() {
    let strip = |tension: f64| {
        let lamina = Lamina {
            prestress: [tension, 0.0, 0.0],
            ..Lamina::isotropic(1e6, 0.0, 1e-3, 1e3)
        };
        let mesh = rectangle(2, 12, 1.0, 0.1);
        let shells = mesh.shells(|_| lamina.section().ok()).unwrap();
        let ends = (0..mesh.rest.len()).filter(|&n| mesh.rest.position[n].x < 1e-9);
        let held = ends.fold(
            StructureBuilder::new(mesh.rest.clone()),
            StructureBuilder::clamp,
        );
        shells
            .into_iter()
            .fold(held, StructureBuilder::element)
            .build()
    };
    let (slack, tight) = (strip(0.0).unwrap(), strip(1.0).unwrap());
    let stretch = (1.0 - 2.0 * 1.0 / 1e3_f64).sqrt();
    for (x, without) in (tight.rest().position.iter()).zip(&slack.rest().position) {
        let off = *x - *without * DVec3::new(stretch, 1.0, 1.0);
        assert!(off.length() < 1e-13, "{off}");
    }
    let of = |s: &Structure| modes(s, s.rest(), &FrameMotion::REST, None).unwrap();
    for (t, s) in of(&tight).iter().zip(of(&slack)).take(4) {
        let ratio = t.frequency() / s.frequency();
        assert!((ratio - 1.0).abs() < 3e-3, "{ratio}"); // shorter by 1e-3
    }
    // One that would shorten it by a tenth is refused.
    let error = strip(100.0).unwrap_err();
    assert!(matches!(error, StructureError::Slack { .. }), "{error}");
}
