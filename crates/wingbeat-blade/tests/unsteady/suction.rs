//! Thrust and power of strips with wakes that plunge and pitch, against Garrick's theory of propulsion.

use std::f64::consts::{PI, TAU};

use wingbeat_blade::*;
use wingbeat_math::{BodyAcceleration, BodyMotion, DVec3, r2};

use super::functions::theodorsen;
use super::{Flown, section};

/// A plunge of velocity `cos(k t)` and a pitch of `ratio` times the angle `cos(k t + phase)`, both over the size of
/// the motion; density, half chord and speed are 1.
#[derive(Clone, Copy, Debug)]
struct Oscillation {
    k: f64,
    /// Axis behind mid chord in half chords \[1\].
    a: f64,
    plunges: bool,
    ratio: f64,
    phase: f64,
}

/// Means over a period, over the square of the size of the motion.
#[derive(Clone, Copy, Debug)]
struct Means {
    thrust: f64,
    power: f64,
    suction: f64,
}

/// Size of the motions: what is of the fourth order in it is 1e-6 of the means.
const SIZE: f64 = 1e-3;

/// A complex number, real part first.
type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn sum<const N: usize>(parts: [(f64, Complex); N]) -> Complex {
    parts
        .iter()
        .fold([0.0; 2], |s, (by, z)| [s[0] + by * z[0], s[1] + by * z[1]])
}

/// Mean of a product of two oscillations.
fn mean(x: Complex, y: Complex) -> f64 {
    0.5 * (x[0] * y[0] + x[1] * y[1])
}

impl Oscillation {
    /// Amplitudes of h', h'', alpha, alpha', alpha'' over `exp(i k t)`.
    fn amplitudes(&self) -> [Complex; 5] {
        let rate = |z: Complex| times([0.0, self.k], z);
        let h1 = [f64::from(u8::from(self.plunges)), 0.0];
        let alpha = [self.ratio * self.phase.cos(), self.ratio * self.phase.sin()];
        let alpha_1 = rate(alpha);
        [h1, rate(h1), alpha, alpha_1, rate(alpha_1)]
    }

    /// Garrick's mean thrust `pi S^2 + alpha P` with `S = (2 C Q - alpha') / sqrt 2` \[NACA Rep. 567, 1936\], mean
    /// power by lift and moment of Theodorsen \[NACA Rep. 496, 1935\], for this `C`.
    fn published(&self, c: Complex) -> Means {
        let [h1, h2, alpha, alpha_1, alpha_2] = self.amplitudes();
        let a = self.a;
        let wash = sum([(1.0, h1), (1.0, alpha), (0.5 - a, alpha_1)]);
        let lagging = times(c, wash);
        let lift = sum([(PI, h2), (PI, alpha_1), (-PI * a, alpha_2), (TAU, lagging)]);
        let moment = sum([
            (PI * a, h2),
            (-PI * (0.5 - a), alpha_1),
            (-PI * (0.125 + a * a), alpha_2),
            (TAU * (a + 0.5), lagging),
        ]);
        let s = sum([(2.0_f64.sqrt(), lagging), (-0.5_f64.sqrt(), alpha_1)]);
        let suction = PI * mean(s, s);
        Means {
            thrust: suction - mean(alpha, lift),
            power: mean(lift, h1) - mean(moment, alpha_1),
            suction,
        }
    }

    /// The same of the strip, flown until its wake is that of the motion for ever.
    fn flown(&self, theory: Unsteady, added_mass: AddedMassModel) -> Means {
        let per = 400;
        let periods = (250.0 * self.k / TAU).ceil() as usize + 2;
        let wing = section(self.a, Some(theory));
        let settings = BladeSettings {
            added_mass,
            centre_of_pressure: CentreOfPressure::Fixed(0.25),
            ..*wing.settings()
        };
        let wing = BladeWing::new(wing.strips().to_vec(), settings).unwrap();
        let mut flown = Flown::new(wing);
        let z = self.amplitudes();
        let [mut thrust, mut power] = [0.0; 2];
        for step in 0..=periods * per {
            let t = TAU / self.k * step as f64 / per as f64;
            let (sin, cos) = (self.k * t).sin_cos();
            let at = z.map(|z| SIZE * (z[0] * cos - z[1] * sin));
            let m = BodyMotion {
                r: r2(at[2]),
                v: DVec3::new(1.0, 0.0, at[0]),
                w: DVec3::new(0.0, at[3], 0.0),
                ..BodyMotion::REST
            };
            let by = BodyAcceleration {
                linear: DVec3::new(0.0, 0.0, at[1]),
                angular: DVec3::new(0.0, at[4], 0.0),
            };
            let load = flown.load(t, &m, Calm);
            let added = flown.wing.acceleration_load(&m, &by);
            let force = m.r * (load.force + added.force);
            let moment = load.moment + added.moment;
            if step > (periods - 1) * per {
                let over = per as f64 * SIZE * SIZE;
                thrust += force.x / over;
                power -= (force.z * at[0] + moment.y * at[3]) / over;
            }
        }
        Means {
            thrust,
            power,
            suction: 0.0,
        }
    }
}

/// Pure plunge, pure pitch about the leading edge, and both together about axes at 1/4, 1/3, 1/2 and 3/4 of the
/// chord.
fn oscillations() -> impl Iterator<Item = Oscillation> {
    let motions = [
        (0.1, -0.5, true, 0.3, 1.6),
        (0.5, 0.0, true, 0.0, 0.0),
        (0.5, -1.0, false, 1.0, 0.0),
        (0.5, -1.0 / 3.0, true, 0.9, 1.3),
        (1.0, 0.5, true, 0.9, -1.0),
        (2.0, 0.0, true, 0.9, 0.5),
    ];
    motions
        .into_iter()
        .map(|(k, a, plunges, ratio, phase)| Oscillation {
            k,
            a,
            plunges,
            ratio,
            phase,
        })
}

#[test]
fn exact_thrust_and_power_of_plunge_and_pitch_are_garricks() {
    // To Garrick's with Theodorsen's function what the theories have of that: 1.4 and 0.54 % of the suction.
    for (theory, allowed) in [
        (Unsteady::Jones, 0.02),
        (Unsteady::Peters { states: 8 }, 0.01),
    ] {
        for added_mass in [AddedMassModel::Impulse, AddedMassModel::Section] {
            for o in oscillations() {
                let found = o.flown(theory, added_mass);
                let own = theory.indicial().answer(o.k);
                // With the theory's own function to the error of 400 steps a period, 1.6e-5.
                for (c, allowed) in [(own, 5e-5), (theodorsen(o.k), allowed)] {
                    let expected = o.published(c);
                    let apart = [found.thrust - expected.thrust, found.power - expected.power];
                    let size = allowed * expected.suction.max(expected.power.abs());
                    assert!(
                        apart.iter().all(|x| x.abs() < size),
                        "{theory:?} {o:?}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn balances_power_that_is_not_thrust_stays_in_the_wake() {
    let theory = Unsteady::Peters { states: 8 };
    for o in oscillations() {
        let found = o.flown(theory, AddedMassModel::Impulse);
        // rho Gamma u lambda = 2 pi rho b u C Q (1 - C) Q [Garrick 1936, his E].
        let [h1, _, alpha, alpha_1, _] = o.amplitudes();
        let wash = sum([(1.0, h1), (1.0, alpha), (0.5 - o.a, alpha_1)]);
        let lagging = times(theory.indicial().answer(o.k), wash);
        let lost = TAU * mean(lagging, sum([(1.0, wash), (-1.0, lagging)]));
        let wake = found.power - found.thrust;
        assert!(
            lost > 0.0 && (wake - lost).abs() < 1e-4 * found.power.max(lost),
            "{o:?}: {wake} {lost}"
        );
    }
}

/// By the sums over a flat wing, and strip by strip, where it turns about all axes.
#[test]
fn agrees_suction_of_a_flat_wing_with_that_of_its_sections() {
    let strips = Strip::rectangle(3, [0.2, 3.2], 1.1, 0.3, 1.0);
    let placed = |k: usize| PlacedStrip {
        strip: strips[k],
        axis: DVec3::new(0.0, strips[k].y, 0.0),
        turn: wingbeat_math::DMat3::IDENTITY,
    };
    let m = BodyMotion {
        r: r2(0.3),
        v: DVec3::new(3.0, 0.4, 0.9),
        w: DVec3::new(0.7, -1.3, 0.4),
        ..BodyMotion::REST
    };
    for added_mass in [
        AddedMassModel::None,
        AddedMassModel::Section,
        AddedMassModel::Impulse,
    ] {
        let settings = BladeSettings {
            added_mass,
            unsteady: Some(Unsteady::Jones),
            ..BladeSettings::insect(1.2)
        };
        let wing = BladeWing::new(strips.clone(), settings).unwrap();
        let whole = wing.velocity_load(&m);
        let section = |k: usize| SectionMotion::fixed(&placed(k));
        let parts = wing.deforming_velocity_load(&m, section, Calm, None).load;
        let apart = [whole.force - parts.force, whole.moment - parts.moment];
        assert!(
            apart
                .iter()
                .all(|x| x.length() < 1e-13 * whole.force.length()),
            "{added_mass:?}: {whole:?} {parts:?}"
        );
    }
}
