//! Steady wings of the flight's own making: joined, twisted, with lines of panels spaced either way.

use crate::common;

use common::{Fly, fly};
use wingbeat_air::AirSettings;
use wingbeat_flight::*;
use wingbeat_math::{DVec3, MassProperties};
use wingbeat_model::deformation::{SpanLaw, Term};
use wingbeat_model::{Deformation, Planform, Spacing, WingMotion, WingShape};

/// A steady rectangular wing: panels along chord and half span, their spacing and washout.
#[derive(Clone, Copy)]
struct Steady {
    aspect: f64,
    panels: [usize; 2],
    spacing: [Spacing; 2],
    washout: f64,
}

/// Incidence [rad]: so small that the wakes lie flat.
const ALPHA: f64 = 1e-6;

impl Steady {
    const UNIFORM: [Spacing; 2] = [Spacing::Uniform; 2];

    /// Lift coefficient of two joined half wings thirty spans after a sudden start.
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
            wing.motion = WingMotion::fixed(0.0, [0.0, 0.0, ALPHA]);
            *wing = wing.clone().deformed_by(washout.clone()).unwrap();
        }
        setup.mode = MotionMode::Tethered(PrescribedMotion::at_rest(DVec3::ZERO, DVec3::ZERO));
        setup.time = TimeGrid {
            step: self.aspect,
            steps: 30,
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
            joined_tips: vec![],
            has_own_viscosity: false,
        });
        let records = fly(setup);
        let force = records.last().unwrap().air.iter().map(|l| l.force);
        // Pressure alone: normal to the wing, as lift at these angles.
        -force.sum::<DVec3>().z / (0.5 * self.aspect)
    }
}

/// Linear washout of rectangular wings against Prandtl's lifting line, which is their limit for large
/// aspect ratio: the slope of the lift, and the part of it that the washout takes.
#[test]
fn limit_twisted_wings_tend_to_the_lifting_line() {
    let errors = |aspect: f64| {
        let wing = |k: usize, washout: f64| Steady {
            aspect,
            panels: [2, 10 * k],
            spacing: Steady::UNIFORM,
            washout,
        };
        // The error of the lattice is of second order in the width of its panels.
        let lift = |washout| (4.0 * wing(2, washout).lift() - wing(1, washout).lift()) / 3.0;
        let (flat, twisted) = (lift(0.0), lift(-ALPHA));
        let [slope, share] = lifting_line(aspect);
        let found = [flat / ALPHA, 1.0 - twisted / flat];
        println!("aspect {aspect}: slope and share {found:.4?}, line {slope:.4} {share:.4}");
        [found[0] / slope - 1.0, found[1] / share - 1.0]
    };
    let [long, longer, longest] = [12.0, 24.0, 48.0].map(errors);
    for k in 0..2 {
        // What the line leaves out falls like ln(A) / A: by 0.6 for each doubling.
        for ratio in [longer[k] / long[k], longest[k] / longer[k]] {
            assert!((0.45..0.7).contains(&ratio), "{ratio}");
        }
        assert!(longest[k].abs() < 0.01, "{}", longest[k]);
    }
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
