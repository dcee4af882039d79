//! Forces of strips by their velocities, two strips at a time: a vector register holds two numbers.

use std::f64::consts::PI;

use wingbeat_math::DVec2;

use crate::coefficients::Translation;
use crate::feathering::RotationCoefficient;
use crate::settings::{BladeSettings, Rotation};
use crate::strip::Strip;

/// Two strips and what their forces need; the second may be one that feels nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StripPair {
    /// Place along axis 2 \[m\].
    pub y: DVec2,
    x_leading: DVec2,
    chord: DVec2,
    /// `rho/2 c dr` [kg/m].
    pressure: DVec2,
    /// `rho C_rot c^2 dr` of a section that meets the air broadside on \[kg\], and what of it goes with the cosine.
    circulation: [DVec2; 2],
    /// `pi/16 rho c^4 dr` [kg m].
    viscous: DVec2,
    /// How far behind the feathering axis the downwash is that the circulation follows \[m\], as
    /// [`RotationCoefficient::lever`] has it: part without the cosine, part with it.
    lever: [DVec2; 2],
    /// `pi/16 rho c^3 dr` \[kg\].
    couple: DVec2,
    /// Mid chord ahead of the feathering axis \[m\].
    x_mid: DVec2,
    /// Added mass m of which the force along the chord is reckoned \[kg\].
    chordwise: DVec2,
}

/// How the points of two strips on the feathering axis move through the air.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairMotion {
    /// Velocity along the chord, forward [m/s].
    pub u: DVec2,
    /// Velocity along the normal [m/s].
    pub w: DVec2,
    /// Rate of feathering [rad/s].
    pub q: DVec2,
}

/// Force along chord and normal \[N\], moment about the point on the feathering axis [N m].
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairForce {
    pub along: DVec2,
    pub normal: DVec2,
    pub about: DVec2,
}

impl StripPair {
    /// All `strips`, two by two.
    pub fn all(strips: &[Strip], settings: &BladeSettings) -> Vec<Self> {
        let pairs = strips.chunks(2);
        pairs.map(|pair| Self::new(pair, settings)).collect()
    }

    fn new(pair: &[Strip], settings: &BladeSettings) -> Self {
        let rho = settings.density;
        let lanes =
            |f: &dyn Fn(&Strip) -> f64| DVec2::from_array([0, 1].map(|k| f(&strip(pair, k))));
        let rotation = |s: &Strip| RotationCoefficient::of(settings, s);
        Self {
            y: lanes(&|s| s.y),
            x_leading: lanes(&|s| s.x_leading),
            chord: lanes(&|s| s.chord),
            pressure: lanes(&|s| 0.5 * rho * s.chord * s.width),
            circulation: [0, 1].map(|part| {
                lanes(&|s| rho * rotation(s).parts()[part] * s.chord * s.chord * s.width)
            }),
            viscous: lanes(&|s| PI / 16.0 * rho * s.chord.powi(4) * s.width),
            lever: [0, 1].map(|part| lanes(&|s| rotation(s).lever()[part] * s.chord)),
            couple: lanes(&|s| PI / 16.0 * rho * s.chord.powi(3) * s.width),
            x_mid: lanes(&Strip::x_mid),
            chordwise: lanes(&|s| match settings.added_mass.is_kirchhoff() {
                true => s.added_mass(rho),
                false => 0.0,
            }),
        }
    }

    /// How far behind the feathering axis the downwash is that the circulation of strip `lane` follows \[m\], where
    /// the air is met at `front` (cosine of the angle of attack, negative from behind).
    pub fn lever(&self, lane: usize, front: f64) -> f64 {
        self.lever[0][lane] + self.lever[1][lane] * front
    }

    /// What leading-edge suction lacks of Kutta and Joukowski's force at the feathering axis, over the rate of
    /// feathering `q` \[N s\].
    ///
    /// Where the circulation Gamma lags, the axis feels `rho Gamma (w - lambda)` along the chord. The suction of
    /// a flat plate is `2 pi rho b (v - lambda)^2`, v the normal velocity of mid chord: `S = (2 C Q - b q) / sqrt 2`
    /// [Garrick 1936, NACA Rep. 567], with `C Q - b q / 2 = v - lambda`. With `Gamma = 2 pi b C Q` it is
    /// `(rho Gamma - m q) (v - lambda)`: both forces, that of the circulation and that of the added mass m, go
    /// with what mid chord meets. `bound` is `rho Gamma dr` \[kg/s\], `w` is `w - lambda` at the axis \[m/s\].
    #[inline]
    fn suction_by_turning(&self, bound: DVec2, w: DVec2, q: DVec2) -> DVec2 {
        let middle = w - q * self.x_mid;
        bound * self.x_mid + self.chordwise * middle
    }

    /// Chords \[m\].
    pub fn chord(&self) -> DVec2 {
        self.chord
    }
}

/// Strip `k` of a pair; where there is none, the first without width.
fn strip(pair: &[Strip], k: usize) -> Strip {
    let none = Strip {
        width: 0.0,
        ..pair[0]
    };
    pair.get(k).copied().unwrap_or(none)
}

/// Translation, rotation and viscous moment of all `pairs`: `motion(k, pair)` says how pair k moves,
/// `put(k, pair, force)` takes its force.
#[inline]
pub(crate) fn forces(
    pairs: &[StripPair],
    settings: &BladeSettings,
    motion: impl FnMut(usize, &StripPair) -> PairMotion,
    put: impl FnMut(usize, &StripPair, PairForce),
) {
    match settings.translation {
        Translation::DoubleAngle {
            lift,
            drag_0,
            drag_90,
        } => {
            let law = |sin: DVec2, cos: DVec2| {
                let lift = 2.0 * lift * sin * cos;
                [lift, drag_0 * cos * cos + drag_90 * sin * sin]
            };
            with_law(pairs, settings, motion, put, law);
        }
        law => with_law(pairs, settings, motion, put, |sin, cos| {
            let [a, b] = [0, 1].map(|k| law.of_direction(sin[k], cos[k]));
            [DVec2::new(a[0], b[0]), DVec2::new(a[1], b[1])]
        }),
    }
}

/// As [`forces`] with the lift and drag coefficients `law` of sine and cosine (both >= 0) of the
/// angle of attack.
#[inline]
fn with_law(
    pairs: &[StripPair],
    settings: &BladeSettings,
    mut motion: impl FnMut(usize, &StripPair) -> PairMotion,
    mut put: impl FnMut(usize, &StripPair, PairForce),
    law: impl Fn(DVec2, DVec2) -> [DVec2; 2],
) {
    let across = settings.rotation == Rotation::SaneDickinson;
    let is_unsteady = settings.unsteady.is_some();
    let damps = settings.damps_feathering();
    let viscous = settings
        .viscous
        .map_or([0.0; 2], |m| [m.linear, m.quadratic]);
    for (k, pair) in pairs.iter().enumerate() {
        let PairMotion { u, w, q } = motion(k, pair);
        let speed = (u * u + w * w).map(f64::sqrt);
        // At rest, and where the square of the speed is too small for a number, both are zero, and so is every force.
        let inverse = speed.map(|s| if s == 0.0 { 0.0 } else { s.recip() });
        let (cos, sin) = (u * inverse, w * inverse);
        let [lift, drag] = law(sin.abs(), cos.abs());
        let pressure = pair.pressure * (speed * speed);
        // Lift across the velocity and against w; drag against the velocity.
        let along = pressure * (lift * sin.abs() * cos.signum() - drag * cos);
        let normal = -pressure * (lift * cos.abs() * sin.signum() + drag * sin);
        let strength = (pair.circulation[0] + pair.circulation[1] * cos) * q;
        let [r1, r3] = match across {
            true => [DVec2::ZERO, -strength * speed * u.signum()],
            false => [strength * w, -strength * u],
        };
        let normal = normal + r3;
        let behind = settings.centre_of_pressure.behind_leading_edge(sin, cos);
        let x_cp = pair.x_leading - pair.chord * behind;
        let mut damping = pair.viscous * (viscous[0] + viscous[1] * q.abs()) * q;
        let mut along = along + r1;
        if is_unsteady {
            let lifting = pressure * lift * (sin.signum() * cos.signum() * inverse);
            let bound = if across { lifting } else { lifting + strength };
            along -= q * pair.suction_by_turning(bound, w, q);
        }
        if damps {
            // The force m u q of the added mass acts at 3/4 of the chord: about its middle `-pi/16 rho c^3 u q`
            // [Theodorsen 1935].
            damping += pair.couple * u.abs() * q;
        }
        let force = PairForce {
            along,
            normal,
            about: -damping - x_cp * normal,
        };
        put(k, pair, force);
    }
}
