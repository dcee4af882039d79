//! Waves along sheets whose panels are long across them.

mod plate;

use plate::rectangle;
use wingbeat_structure::{FrameMotion, Lamina, NODE, StructureBuilder, modes};

/// A strip of unit length, stiffness and mass, clamped along one side and `width` wide: frequencies [rad/s] of the
/// modes whose free side moves evenly, `panels` along and one across.
fn even_waves(width: f64, panels: usize) -> Vec<f64> {
    let lamina = Lamina::isotropic(12e9, 0.0, 1e-3, 1e3);
    let mesh = rectangle(1, panels, 1.0, width);
    let plate = mesh.rest.clone();
    let mut body = StructureBuilder::new(plate.clone());
    for shell in mesh.shells(|_| lamina.section().ok()).unwrap() {
        body = body.element(shell);
    }
    for (n, x) in plate.position.iter().enumerate() {
        if x.x < 1e-9 {
            body = body.clamp(n);
        }
    }
    let body = body.build().unwrap();
    let all = modes(&body, body.rest(), &FrameMotion::REST, None).unwrap();
    let free = [panels, 2 * panels + 1].map(|n| NODE * n + 2);
    let even = all.iter().filter(|m| {
        let [a, b] = free.map(|k| m.shape[k]);
        (a - b).abs() < 1e-6 * a.abs().max(b.abs()) && a.abs() > 0.1 / width.sqrt()
    });
    even.map(wingbeat_structure::Mode::frequency).collect()
}

/// Waves along a strip have the frequencies of a beam, `1.875^2`, `4.694^2` and `7.855^2`, however wide it is and
/// however long its panels are across.
#[test]
fn order_waves_along_a_strip_do_not_know_its_width() {
    let exact = [1.8751041, 4.6940911, 7.8547574].map(|b: f64| b * b);
    for width in [1.0, 4.0, 200.0] {
        let [coarse, fine] = [10, 20].map(|n| even_waves(width, n));
        for (k, exact) in exact.iter().enumerate() {
            let [a, b] = [&coarse, &fine].map(|w| w[k] / exact - 1.0);
            println!("width {width}, mode {}: {a:.1e} {b:.1e}", k + 1);
            assert!(a.abs() < 0.03 && b.abs() < 0.35 * a.abs(), "{a:e} {b:e}");
        }
    }
}
