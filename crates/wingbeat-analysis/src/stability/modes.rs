//! Modes of flight, named in the words of flight dynamics.

use std::f64::consts::{LN_2, TAU};

use crate::beat::level::STATE;
use crate::stability::eigen::Eigenpair;

/// Natural sizes by which components of eigenvectors are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Of velocities: R / T [m/s].
    pub velocity: f64,
    /// Of angular velocities: 1 / T [rad/s].
    pub rate: f64,
    /// Period of a wingbeat T [s].
    pub period: f64,
}

impl Scales {
    /// Those of a flyer of wing length R `length` [m] and a wingbeat of `period` [s].
    pub fn new(length: f64, period: f64) -> Self {
        Self {
            velocity: length / period,
            rate: 1.0 / period,
            period,
        }
    }

    /// Size of each of the nine components; angles by one radian.
    pub fn array(&self) -> [f64; 9] {
        let (v, w) = (self.velocity, self.rate);
        [v, v, v, w, w, w, 1.0, 1.0, 1.0]
    }
}

/// Which motions a mode consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// u, w, q, theta.
    Longitudinal,
    /// v, p, r, phi, psi.
    Lateral,
    /// The free joints.
    Joints,
    /// Wings that loads bend.
    Wings,
}

/// A mode of flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Name, as "unstable oscillation", "fast subsidence".
    pub name: String,
    /// Which motions it consists of.
    pub plane: Plane,
    /// Real part of the exponent [1/s].
    pub growth: f64,
    /// Imaginary part of the exponent, >= 0: one mode stands for the conjugate pair [rad/s].
    pub frequency: f64,
    /// Floquet multiplier (of the averaged model: `exp(exponent T)`) \[1\].
    pub multiplier: [f64; 2],
    /// Period of a wingbeat [s], for times in wingbeats.
    pub wingbeat: f64,
    /// Components of the eigenvector over their natural sizes, largest 1: size, and phase from that of the
    /// largest component of flight \[rad\].
    pub vector: Vec<(&'static str, f64, f64)>,
}

impl Mode {
    /// Period of the oscillation [s]; none of a subsidence or divergence.
    pub fn period(&self) -> Option<f64> {
        (self.frequency > 0.0).then(|| TAU / self.frequency)
    }

    /// Time to double (growing) or halve (decaying) [s]; none if neutral.
    pub fn doubling(&self) -> Option<f64> {
        (!self.is_neutral()).then(|| LN_2 / self.growth.abs())
    }

    /// Whether no component is larger than heading.
    fn is_heading(&self) -> bool {
        self.vector.iter().any(|c| c.0 == "psi" && c.1 == 1.0)
    }

    /// Neither grows nor decays by a millionth in a wingbeat.
    pub fn is_neutral(&self) -> bool {
        (self.growth * self.wingbeat).abs() < 1e-6 && self.frequency * self.wingbeat < 1e-3
    }
}

/// All modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeSet {
    /// By falling growth.
    pub modes: Vec<Mode>,
}

impl ModeSet {
    /// From eigenpairs of a rate matrix, values in 1/s.
    pub fn of_exponents(pairs: Vec<Eigenpair>, scales: &Scales) -> Self {
        let with = |p: &Eigenpair| {
            let [re, im] = [p.value[0] * scales.period, p.value[1] * scales.period];
            (p.value, [re.exp() * im.cos(), re.exp() * im.sin()])
        };
        Self::build(&pairs, scales, ([].as_slice(), JOINTS), with)
    }

    /// From eigenpairs of a monodromy matrix, `wings` the natural sizes of the components of elastic wings
    /// behind the nine of flight. What has decayed to a thousandth within a beat is left out: what else wings
    /// do is of that size.
    pub fn with_wings(mut pairs: Vec<Eigenpair>, scales: &Scales, wings: &[f64]) -> Self {
        pairs.retain(|p| p.value[0].hypot(p.value[1]) > 1e-3);
        Self::of_map(&pairs, scales, (wings, WINGS))
    }

    /// From eigenpairs of a monodromy matrix, `joints` the natural sizes of the components of free
    /// joints behind the nine of flight. What has decayed to nothing within a beat is left out.
    pub fn of_multipliers(mut pairs: Vec<Eigenpair>, scales: &Scales, joints: &[f64]) -> Self {
        pairs.retain(|p| p.value[0].hypot(p.value[1]) > 1e-12);
        Self::of_map(&pairs, scales, (joints, JOINTS))
    }

    fn of_map(pairs: &[Eigenpair], scales: &Scales, rest: (&[f64], &'static str)) -> Self {
        let with = |p: &Eigenpair| {
            let [a, b] = p.value;
            let exponent = [a.hypot(b).ln() / scales.period, b.atan2(a) / scales.period];
            (exponent, p.value)
        };
        Self::build(pairs, scales, rest, with)
    }

    fn build(
        pairs: &[Eigenpair],
        scales: &Scales,
        rest: (&[f64], &'static str),
        with: impl Fn(&Eigenpair) -> ([f64; 2], [f64; 2]),
    ) -> Self {
        let upper = pairs.iter().filter(|p| p.value[1] >= 0.0);
        let mode = |p: &Eigenpair| {
            let (exponent, multiplier) = with(p);
            let vector = scaled_vector(p, scales, rest);
            let mut mode = Mode {
                name: String::new(),
                plane: plane(&vector),
                growth: exponent[0],
                frequency: exponent[1].abs(),
                multiplier,
                wingbeat: scales.period,
                vector,
            };
            if mode.is_neutral() {
                mode.frequency = 0.0; // of a rounding
            }
            mode
        };
        let mut modes: Vec<Mode> = vec![];
        for p in upper {
            let mode = mode(p);
            // Eigenvalues of nothing that rounding made a pair of are two motions, each by itself.
            if mode.is_neutral() && p.value[1] > 0.0 {
                modes.push(mode.clone());
            }
            modes.push(mode);
        }
        modes.sort_by(|a, b| b.growth.total_cmp(&a.growth));
        name(&mut modes);
        Self { modes }
    }

    /// The modes of a plane, by falling growth.
    pub fn plane(&self, plane: Plane) -> impl Iterator<Item = &Mode> {
        self.modes.iter().filter(move |m| m.plane == plane)
    }

    /// What the modes of a plane are: whether each swings, and grows, in alphabetical order of their names; the neutral
    /// one, which rounding makes grow or decay, left out with all that change by less than a hundredth in a
    /// wingbeat.
    pub fn kinds(&self, plane: Plane) -> Vec<&'static str> {
        let clear = |m: &&Mode| m.frequency > 0.0 || (m.growth * m.wingbeat).abs() > 1e-2;
        let name = |m: &Mode| match (m.frequency > 0.0, m.growth > 0.0) {
            (true, true) => "unstable oscillation",
            (true, false) => "stable oscillation",
            (false, true) => "divergence",
            (false, false) => "subsidence",
        };
        let mut kinds: Vec<&'static str> = self.plane(plane).filter(clear).map(name).collect();
        kinds.sort_unstable();
        kinds
    }

    /// The first mode of this name in a plane.
    pub fn find(&self, plane: Plane, name: &str) -> Option<&Mode> {
        self.plane(plane).find(|m| m.name == name)
    }
}

/// Name of the component that stands for all free joints, or all elastic wings: the root of their squares.
const JOINTS: &str = "joints";
const WINGS: &str = "wings";

/// Components over their sizes, the largest 1.
fn scaled_vector(
    p: &Eigenpair,
    scales: &Scales,
    (sizes, name_of_rest): (&[f64], &'static str),
) -> Vec<(&'static str, f64, f64)> {
    let scaled = |(z, s): (&[f64; 2], &f64)| [z[0] / s, z[1] / s];
    let (flight, rest) = p.vector.split_at(9);
    let flight: Vec<[f64; 2]> = flight.iter().zip(&scales.array()).map(scaled).collect();
    let squares = rest.iter().zip(sizes).map(scaled);
    let of_rest = squares.map(|z| z[0] * z[0] + z[1] * z[1]).sum::<f64>();
    let size = |z: &[f64; 2]| z[0].hypot(z[1]);
    let first = flight.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    let [re, im] = *first.expect("nine components");
    let largest = f64::max(re.hypot(im), of_rest.sqrt());
    // Phases from that of the largest component of flight.
    let component = |(z, name): (&[f64; 2], &&'static str)| {
        let phase = (z[1] * re - z[0] * im).atan2(z[0] * re + z[1] * im);
        (*name, size(z) / largest, phase)
    };
    let mut vector: Vec<_> = flight.iter().zip(&STATE).map(component).collect();
    if !sizes.is_empty() {
        vector.push((name_of_rest, of_rest.sqrt() / largest, 0.0));
    }
    vector
}

/// The plane in which most of the eigenvector lies.
fn plane(vector: &[(&'static str, f64, f64)]) -> Plane {
    let share = |names: &[&str]| -> f64 {
        let of = vector.iter().filter(|c| names.contains(&c.0));
        of.map(|c| c.1 * c.1).sum()
    };
    let longitudinal = share(&["u", "w", "q", "theta"]);
    let lateral = share(&["v", "p", "r", "phi", "psi"]);
    if share(&[JOINTS]) > longitudinal + lateral {
        Plane::Joints
    } else if share(&[WINGS]) > longitudinal + lateral {
        Plane::Wings
    } else if longitudinal > lateral {
        Plane::Longitudinal
    } else {
        Plane::Lateral
    }
}

/// Names the modes of each plane: oscillations by stability, two longitudinal ones as phugoid
/// (the slower) and short period; real ones as divergence or subsidence, the fastest and slowest
/// subsidence told apart; a neutral one that is most of all a turn about the vertical is heading.
fn name(modes: &mut [Mode]) {
    for plane in [
        Plane::Longitudinal,
        Plane::Lateral,
        Plane::Joints,
        Plane::Wings,
    ] {
        let real = |m: &Mode| m.plane == plane && m.frequency == 0.0 && !m.is_neutral();
        let decaying: Vec<f64> = modes
            .iter()
            .filter(|m| real(m) && m.growth < 0.0)
            .map(|m| m.growth)
            .collect();
        let waves = modes
            .iter()
            .filter(|m| m.plane == plane && m.frequency > 0.0);
        let speeds: Vec<f64> = waves.map(|m| m.growth.hypot(m.frequency)).collect();
        let slowest_wave = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let wave = |m: &Mode| match (plane, speeds.len()) {
            (Plane::Longitudinal, 2) if m.growth.hypot(m.frequency) == slowest_wave => "phugoid",
            (Plane::Longitudinal, 2) => "short period",
            _ => "oscillation",
        };
        let fastest = decaying.iter().copied().fold(0.0, f64::min);
        for m in modes.iter_mut().filter(|m| m.plane == plane) {
            m.name = match (m.is_neutral(), m.frequency > 0.0, m.growth > 0.0) {
                (true, _, _) if m.is_heading() => "neutral (heading)".to_owned(),
                (true, _, _) => "neutral".to_owned(),
                (_, true, true) => format!("unstable {}", wave(m)),
                (_, true, false) => format!("stable {}", wave(m)),
                (_, false, true) => "divergence".to_owned(),
                _ if decaying.len() < 2 => "subsidence".to_owned(),
                _ if m.growth == fastest => "fast subsidence".to_owned(),
                _ => "slow subsidence".to_owned(),
            };
        }
    }
}
