//! Right-hand sides per second of a three-body fly without air, on one core.
//!
//! The wings flap and feather by one harmonic each, a law of two sines and cosines: what is timed
//! is the mechanics. A law of many harmonics costs its own time on top.
//!
//! `cargo bench -p wingbeat-dynamics --bench rates`

use divan::{Bencher, counter::ItemsCount};
use wingbeat_dynamics::{
    Baumgarte, BodyMotion, ElementLaw, EulerForm, Formulation, JointModel, JointType, MomentumForm,
    QuaternionForm, Stabilization, Wrench,
};

#[path = "../tests/common/mod.rs"]
mod common;
use common::*;
use wingbeat_math::{DMat3, DVec3, MovingRotation, RotationLaw};

fn main() {
    divan::main();
}

/// Stroke about axis 1 and feathering about axis 2, `R1(a) R2(b)` with angles of one harmonic.
#[derive(Clone, Copy, Debug)]
struct Simple(f64);

impl RotationLaw for Simple {
    fn at(&self, t: f64) -> MovingRotation {
        let w = std::f64::consts::TAU / BEAT;
        let (s, c) = (w * t).sin_cos();
        let (a, da, dda) = (self.0 * c, -self.0 * w * s, -self.0 * w * w * c);
        let (b, db, ddb) = (0.7 * s - 1.5, 0.7 * w * c, -0.7 * w * w * s);
        let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
        // Columns of R1(a) R2(b); angular velocity R2^T e1 a' + e2 b' and its derivative.
        let r = DMat3::from_cols(
            DVec3::new(cb, sa * sb, -ca * sb),
            DVec3::new(0.0, ca, sa),
            DVec3::new(sb, -sa * cb, ca * cb),
        );
        let v = DVec3::new(cb * da, db, sb * da);
        let v_dot = DVec3::new(cb * dda - sb * db * da, ddb, sb * dda + cb * db * da);
        MovingRotation {
            c: r,
            w: v,
            w_dot: v_dot,
        }
    }
}

fn time(bencher: Bencher, form: &dyn Formulation) {
    let start = BodyMotion {
        w: DVec3::new(3.0, -8.0, 5.0),
        ..BodyMotion::REST
    };
    let y = form.initial(0.0, &start).unwrap();
    let mut ws = form.workspace();
    let loads = [Wrench::default(); 3];
    let mut dy = vec![0.0; form.dim()];
    let calls = 1000_u32;
    bencher.counter(ItemsCount::new(calls)).bench_local(|| {
        for k in 0..calls {
            // Within a thousandth of a beat the constraints of the Euler form still hold nearly.
            let t = f64::from(k) * 1e-6 * BEAT;
            form.rates(t, &y, &loads, &mut ws, &mut dy).unwrap();
            divan::black_box(&dy);
        }
    });
}

fn system() -> wingbeat_dynamics::System {
    fly_with(CENTRE, WING_MASS, Simple(-0.8), Simple(0.8), GRAVITY)
}

#[divan::bench]
fn momentum_form(bencher: Bencher) {
    time(bencher, &MomentumForm::new(system()));
}

#[divan::bench]
fn euler_form(bencher: Bencher) {
    let form = EulerForm::new(system(), Baumgarte::for_step(BEAT / 80.0));
    time(bencher, &form);
}

#[divan::bench]
fn quaternion_form(bencher: Bencher) {
    let b = Stabilization::Baumgarte(Baumgarte::for_step(BEAT / 80.0));
    time(bencher, &QuaternionForm::new(system(), b));
}

#[divan::bench]
fn momentum_form_with_passive_hinges(bencher: Bencher) {
    let spring = ElementLaw::Spring {
        stiffness: 1e-9,
        rest: 0.0,
    };
    let passive =
        || JointModel::new(JointType::Revolute { axis: DVec3::Y }).with(0, spring.clone());
    let hinged = system()
        .with_joint(0, passive())
        .and_then(|s| s.with_joint(1, passive()));
    time(bencher, &MomentumForm::new(hinged.unwrap()));
}
