//! Steady wings of the flight's own making: joined, twisted, with lines of panels spaced either way.

mod common;

use common::{Fly, fly};
use wingbeat_air::AirSettings;
use wingbeat_flight::*;
use wingbeat_math::{DVec3, MassProperties};
use wingbeat_model::deformation::{SpanLaw, Term};
use wingbeat_model::{Deformation, Planform, Spacing, WingMotion, WingShape};

/// A steady rectangular wing: panels along chord and half span, their spacing, washout and incidence.
#[derive(Clone, Copy)]
struct Steady {
    aspect: f64,
    panels: [usize; 2],
    spacing: [Spacing; 2],
    washout: f64,
    alpha: f64,
}

impl Steady {
    const UNIFORM: [Spacing; 2] = [Spacing::Uniform; 2];

    /// Lift coefficient of two joined half wings thirty chords after a sudden start.
    fn lift(&self) -> f64 {
        let mut setup = Fly::default().setup(40, 0.1);
        let planform = Planform::Rectangle {
            chord: 1.0,
            span: 0.5 * self.aspect,
            root_offset: 0.0,
            axis_fraction: 0.25,
        };
        let shape = WingShape {
            chordwise: self.spacing[0],
            spanwise: self.spacing[1],
            ..WingShape::uniform(planform, self.panels[0], self.panels[1])
        };
        let washout = Deformation {
            twist: vec![Term::steady(SpanLaw::Linear {
                root: 0.0,
                tip: self.washout,
            })],
            ..Deformation::default()
        };
        for wing in &mut setup.animal.wings {
            wing.mass = MassProperties::ZERO;
            wing.mesh = shape.mesh(&wing.name, wing.side).unwrap();
            wing.hinge_b = DVec3::ZERO;
            wing.motion = WingMotion::fixed(0.0, [0.0, 0.0, self.alpha]);
            *wing = wing.clone().deformed_by(washout.clone()).unwrap();
        }
        setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(DVec3::ZERO, DVec3::ZERO));
        setup.time = TimeGrid {
            step: 1.5,
            steps: 20,
            period: None,
        };
        let core = wingbeat_air::CoreModel::Scully { radius: 1e-6 };
        setup.air = AirModel::VortexLattice(AirOptions {
            lattice: AirSettings {
                bound_core: core,
                wake_core: core,
                ..AirSettings::accurate(1.0, -DVec3::X)
            },
            body_surfaces: false,
            mirror: true,
            joined: vec![[0, 1]],
        });
        let records = fly(setup);
        let force = records.last().unwrap().air.iter().map(|l| l.force);
        // Pressure alone: normal to the wing, as lift at these angles.
        -force.sum::<DVec3>().z / (0.5 * self.aspect)
    }
}

/// Linear washout of a rectangular wing against Prandtl's lifting line.
#[test]
fn agrees_twisted_wing_with_the_lifting_line() {
    let aspect = 12.0;
    let line = lifting_line(aspect);
    // Lattices of 2 x 10 and 4 x 20 panels on each half, extrapolated: second order.
    let of = |k: usize, washout: f64| {
        let wing = Steady {
            aspect,
            panels: [2 * k, 10 * k],
            spacing: Steady::UNIFORM,
            washout,
            alpha: 0.05,
        };
        wing.lift()
    };
    let lift = |washout: f64| (4.0 * of(2, washout) - of(1, washout)) / 3.0;
    let (flat, twisted) = (lift(0.0), lift(-0.05));
    let (slope, share) = (flat / 0.05, 1.0 - twisted / flat);
    println!("lift slope {slope:.4}, lifting line {:.4}", line[0]);
    println!(
        "lift lost to washout {share:.4}, lifting line {:.4}",
        line[1]
    );
    // A lifting line overrates the slope of a wing of this aspect ratio by 2 to 3 per cent (it has
    // no chord); what part of the lift the washout takes hardly depends on that.
    assert!((slope / line[0] - 1.0).abs() < 0.04);
    assert!((share / line[1] - 1.0).abs() < 0.01);
}

/// Lift slope of a rectangular wing of this aspect ratio, and what part of the lift at the root's
/// incidence is lost if that falls linearly to nothing at the tips: Glauert's series, sixty terms.
fn lifting_line(aspect: f64) -> [f64; 2] {
    let n = 60;
    // sum A_k sin(k th) (sin th + k mu) = mu alpha(th) sin th, mu = pi / (2 aspect) for c_l = 2 pi alpha
    let mu = std::f64::consts::PI / (2.0 * aspect);
    let lift = |alpha: &dyn Fn(f64) -> f64| {
        let mut lu = wingbeat_math::DenseLu::new(n);
        let (mut matrix, mut right) = (vec![0.0; n * n], vec![0.0; n]);
        for i in 0..n {
            let th = std::f64::consts::FRAC_PI_2 * (i as f64 + 1.0) / n as f64;
            for j in 0..n {
                let k = (2 * j + 1) as f64;
                matrix[i * n + j] = (k * th).sin() * (th.sin() + k * mu);
            }
            right[i] = mu * alpha(th.cos()) * th.sin();
        }
        lu.factor(&matrix).unwrap();
        lu.solve_in_place(&mut right);
        std::f64::consts::PI * aspect * right[0]
    };
    let (flat, lost) = (lift(&|_| 1.0), lift(&|y: f64| y.abs()));
    [flat, lost / flat]
}

/// Lift on three meshes, each twice as fine as the one before, for either spacing.
#[test]
fn order_of_the_lift_with_either_spacing() {
    let cosine = Spacing::Cosine;
    let mut limits = vec![];
    for spacing in [Steady::UNIFORM, [Spacing::Uniform, cosine], [cosine; 2]] {
        let lift = |k: usize| {
            let wing = Steady {
                aspect: 6.0,
                panels: [2 * k, 4 * k],
                spacing,
                washout: 0.0,
                alpha: 0.05,
            };
            wing.lift()
        };
        let [a, b, c] = [1, 2, 4].map(lift);
        let order = ((b - a) / (c - b)).abs().log2();
        let limit = c + (c - b) / (order.exp2() - 1.0);
        println!("{spacing:?}: {a:.6} {b:.6} {c:.6}, order {order:.2}, limit {limit:.6}");
        limits.push(limit);
        assert!(order > 0.8);
    }
    for limit in &limits {
        assert!((limit / limits[0] - 1.0).abs() < 3e-3, "{limits:?}");
    }
}
