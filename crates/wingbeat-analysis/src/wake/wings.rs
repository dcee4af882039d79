//! Floquet's modes of a flyer whose wings bend or whose strips leave wakes, in air without wakes in space:
//! body, wings and wakes are disturbed.
//!
//! Of what wings can do their leading modes of vibration about their shape at the start of the beat are taken
//! along: a departure of the wings is its projections on them, displacements and velocities, `phi^T M dq` and
//! `phi^T M dv`. What other modes do has died before the beat is over. Wakes of strips are coordinates with all
//! their states. Disturbed flights are looked at soon after their start and a wingbeat later; what takes the
//! one into the other has Floquet's multipliers as its eigenvalues.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use wingbeat_flight::elastic::{ElasticState, ElasticWing, ElasticWings};
use wingbeat_flight::{AirMemory, FlightError, MotionMode, Past, Record, Simulation};
use wingbeat_math::{DQuat, DVec3, MassProperties, rotation_vector};
use wingbeat_structure::{FrameMotion, MassBetween, Mode, NODE, slowest_modes};

use super::differences::{departures, map_between};
use super::free_beat::{disturbance, level, scales, seen, steps_per_beat};
use super::orbit::numbers;
use super::trim::WakeTrim;
use crate::AnalysisError;
use crate::beat::level::{Level, Perturbation};
use crate::stability::eigen::{Eigenpair, eigen};
use crate::stability::modes::{ModeSet, Scales};
use crate::vibration::moving::{enough, moving};

/// Components of a departure of the body.
pub(super) const BODY: usize = 9;

/// Disturbances over natural sizes \[1\].
const PART: f64 = 1e-3;

/// Steps after which a disturbed flight is looked at first: accelerations of the wings have found what belongs to them.
const SETTLING: usize = 4;

/// A map of departures over one wingbeat.
#[derive(Clone, Debug)]
pub struct ElasticMonodromy {
    /// By rows: the nine components of [`Perturbation`], the velocity that through the air, then wing by wing displacements and velocities of the
    /// modes, then strip by strip the states of their wakes, all over their natural sizes \[1\].
    pub matrix: Vec<f64>,
    /// Its order.
    pub order: usize,
    /// States of wakes among it, the last.
    pub wakes: usize,
    /// Modes of each elastic wing among it, whose displacements come before their velocities.
    pub wings: Vec<usize>,
    /// The departures that it maps, one column a disturbance: at first and a beat later \[1\].
    pub(super) departures: [Vec<f64>; 2],
    /// Period of a wingbeat [s].
    pub(super) period: f64,
}

/// The map of the departures of body, wings and wakes over a beat, `count` modes of each wing.
///
/// # Errors
/// A trim of another kind; a flight that fails; departures that the disturbances do not reach.
pub fn elastic_monodromy(trim: &WakeTrim, count: usize) -> Result<ElasticMonodromy, AnalysisError> {
    let flights = DisturbedFlights::new(trim, count)?;
    let n = flights.order();
    let departures = departures(n, |_| PART, |k, part| flights.fly(k, part))?;
    Ok(ElasticMonodromy {
        matrix: map_between(&departures, n)?,
        departures,
        order: n,
        wakes: flights.wakes.len(),
        wings: flights.wings.iter().map(|w| w.modes.len()).collect(),
        period: flights.scales.period,
    })
}

/// Floquet's modes of a flyer with elastic wings about its trimmed flight, with `count` modes of each wing.
///
/// # Errors
/// As [`elastic_monodromy`].
pub fn elastic_floquet(trim: &WakeTrim, count: usize) -> Result<ModeSet, AnalysisError> {
    elastic_modes(&elastic_monodromy(trim, count)?)
}

/// The same of a map that is known.
///
/// # Errors
/// Numbers that are not finite.
pub fn elastic_modes(map: &ElasticMonodromy) -> Result<ModeSet, AnalysisError> {
    let pairs = eigen(&map.matrix, map.order)?;
    let one = Scales {
        velocity: 1.0,
        rate: 1.0,
        period: map.period,
    };
    let wings = vec![1.0; map.order - map.wakes - BODY];
    let parts = own_parts(&pairs, map.wakes);
    let both = pairs.into_iter().zip(parts);
    let own = both.filter(|(pair, part)| !lies_in_wakes(pair, *part));
    Ok(ModeSet::with_wings(
        own.map(|(pair, _)| without(map.wakes)(pair)).collect(),
        &one,
        &wings,
    ))
}

/// What part body and wings have in each motion: the sum of their participation factors, which no unit of a
/// component changes [Perez-Arriaga, Verghese & Schweppe 1982, IEEE Trans. Power Appar. Syst. 101:3117].
fn own_parts(pairs: &[Eigenpair], wakes: usize) -> Vec<f64> {
    let n = pairs.len();
    let right = Mat::from_fn(n, n, |k, i| {
        let [re, im] = pairs[i].vector[k];
        c64::new(re, im)
    });
    let left = right.partial_piv_lu().solve(Mat::<c64>::identity(n, n));
    let part = |i: usize| {
        (0..n - wakes)
            .map(|k| (right[(k, i)] * left[(i, k)]).re)
            .sum()
    };
    (0..n).map(part).collect()
}

/// Whether a motion decays in which the wakes have more part than body and wings, `part`.
fn lies_in_wakes(pair: &Eigenpair, part: f64) -> bool {
    part < 0.5 && pair.value[0].hypot(pair.value[1]) < 1.0
}

/// An eigenpair without the components of the wakes.
fn without(wakes: usize) -> impl Fn(Eigenpair) -> Eigenpair {
    move |mut pair| {
        pair.vector.truncate(pair.vector.len() - wakes);
        pair
    }
}

/// The trimmed flight and how it is disturbed.
struct DisturbedFlights<'a> {
    trim: &'a WakeTrim,
    steps: usize,
    level: Level,
    scales: Scales,
    wings: Vec<WingBasis>,
    /// States of the wakes at the start of the beat \[m/s\].
    wakes: Vec<f64>,
}

/// Modes of a wing.
struct WingBasis {
    masses: Vec<MassProperties>,
    between: Vec<MassBetween>,
    modes: Vec<Mode>,
    /// Amplitude of each mode that moves some node by the size of the wing.
    sizes: Vec<f64>,
}

impl<'a> DisturbedFlights<'a> {
    fn new(trim: &'a WakeTrim, count: usize) -> Result<Self, AnalysisError> {
        if !trim.is_orbit() {
            return Err(AnalysisError::not_covered(
                "the flight was trimmed without a periodic motion of elastic wings or of wakes of strips",
                "trim wings with a structure, or with air.blade.unsteady, in blade elements",
            ));
        }
        let setup = &trim.setup;
        let elastic = ElasticWings::new(&setup.animal, setup.gravity)?;
        let both = elastic.wings().iter().zip(&trim.past.wings);
        let wings = both.map(|(w, s)| WingBasis::new(w, s, count));
        Ok(Self {
            trim,
            steps: steps_per_beat(setup)?,
            level: level(setup),
            scales: scales(setup),
            wings: wings.collect::<Result<_, _>>()?,
            wakes: numbers(&trim.past),
        })
    }

    /// Number of components.
    fn order(&self) -> usize {
        BODY + self.shapes() + self.wakes.len()
    }

    /// Number of those of elastic wings.
    fn shapes(&self) -> usize {
        self.wings.iter().map(|w| 2 * w.modes.len()).sum()
    }

    /// Departures soon after the start and a wingbeat later of a flight whose component `k` is disturbed by
    /// `part` of its size.
    fn fly(&self, k: usize, part: f64) -> Result<[Vec<f64>; 2], AnalysisError> {
        let mut setup = self.trim.setup.clone();
        let mut past = self.trim.past.clone();
        setup.time.steps = SETTLING + self.steps;
        if k < BODY {
            let by = Perturbation::component(k, part * self.scales.array()[k]);
            let by = disturbance(&self.trim.setup, &self.level, &by);
            setup.mode = MotionMode::Free(by.start(self.trim.start()));
        } else if k < BODY + self.shapes() {
            self.disturb(&mut past.wings, k - BODY, part);
        } else {
            let by = part * self.scales.velocity;
            disturb_wakes(&mut past, k - BODY - self.shapes(), by);
        }
        let mut flight = Simulation::after(setup, &past)?;
        let mut looked = vec![];
        for step in 1..=SETTLING + self.steps {
            flight.step()?;
            if step == SETTLING || step == SETTLING + self.steps {
                looked.push(self.seen(flight.record(), &Past::of(flight.state())));
            }
        }
        let after = looked.pop().unwrap_or_default();
        Ok([looked.pop().unwrap_or_default(), after])
    }

    /// Disturbs component `k` of the wings.
    fn disturb(&self, wings: &mut [ElasticState], mut k: usize, part: f64) {
        for (basis, state) in self.wings.iter().zip(wings) {
            let count = basis.modes.len();
            if k >= 2 * count {
                k -= 2 * count;
                continue;
            }
            let mode = k % count;
            let amplitude = part * basis.sizes[mode];
            let by: Vec<f64> = (basis.modes[mode].shape.iter())
                .map(|x| amplitude * x)
                .collect();
            match k < count {
                true => displace(state, &by),
                false => (state.structure.velocity.iter_mut().zip(&by))
                    .for_each(|(v, x)| *v += x / self.scales.period),
            }
            return;
        }
    }

    /// What a record, its wings and wakes look like, over natural sizes.
    fn seen(&self, r: &Record, past: &Past) -> Vec<f64> {
        let body = seen(&self.trim.setup, &self.level, r);
        let sizes = self.scales.array();
        let mut all: Vec<f64> = (body.to_array().iter().zip(sizes))
            .map(|(x, s)| x / s)
            .collect();
        let trimmed = self.trim.past.wings.iter();
        for ((basis, state), at) in self.wings.iter().zip(&past.wings).zip(trimmed) {
            let (moved, velocity) = departure(state, at);
            let period = self.scales.period;
            all.extend(basis.amplitudes(at, &moved));
            all.extend(basis.amplitudes(at, &velocity).map(|x| x * period));
        }
        let wakes = numbers(past).into_iter().zip(&self.wakes);
        all.extend(wakes.map(|(z, at)| (z - at) / self.scales.velocity));
        all
    }
}

impl WingBasis {
    fn new(wing: &ElasticWing, at: &ElasticState, count: usize) -> Result<Self, AnalysisError> {
        let structure = wing.structure();
        let at = &at.structure.configuration;
        let still = (&FrameMotion::REST, None);
        let all = slowest_modes(structure, at, still, &enough(wing, count));
        let modes = moving(wing, all.map_err(FlightError::from)?.modes, count).modes;
        let size = |m: &Mode| {
            let nodes = m.shape.chunks_exact(NODE);
            let moves = |six: &[f64]| {
                let turn = DVec3::from_slice(&six[3..]).length();
                (DVec3::from_slice(six).length() / structure.size()).max(turn)
            };
            1.0 / nodes.map(moves).fold(0.0, f64::max)
        };
        Ok(Self {
            masses: structure.masses().to_vec(),
            between: structure.masses_between().to_vec(),
            sizes: modes.iter().map(size).collect(),
            modes,
        })
    }

    /// `phi^T M x` over the natural size of every mode, M that of the wing bent as in `at`.
    fn amplitudes<'b>(&'b self, at: &ElasticState, x: &[f64]) -> impl Iterator<Item = f64> + 'b {
        let rotation = &at.structure.configuration.rotation;
        let nodes = self.masses.iter().zip(rotation).zip(x.chunks_exact(NODE));
        let momentum = nodes.flat_map(|((m, r), six)| {
            let (v, w) = (DVec3::from_slice(six), DVec3::from_slice(&six[3..]));
            let p = m.mass * v + *r * w.cross(m.first_moment);
            let h = m.first_moment.cross(r.inverse() * v) + m.inertia * w;
            [p.to_array(), h.to_array()].concat()
        });
        let mut momentum: Vec<f64> = momentum.collect();
        for m in &self.between {
            let [a, b] = m.nodes.map(|n| DVec3::from_slice(&x[NODE * n..]));
            let half = 0.5 * m.mass * a.midpoint(b);
            for n in m.nodes {
                let own = &mut momentum[NODE * n..];
                own.iter_mut()
                    .zip(half.to_array())
                    .for_each(|(p, h)| *p += h);
            }
        }
        let modes = self.modes.iter().zip(&self.sizes);
        modes.map(move |(mode, size)| {
            let both = mode.shape.iter().zip(&momentum);
            both.map(|(a, b)| a * b).sum::<f64>() / size
        })
    }
}

/// Adds `by` \[m/s\] to number `k` of the states of all wakes.
fn disturb_wakes(past: &mut Past, mut k: usize, by: f64) {
    let wings = past.air.as_mut().and_then(AirMemory::strips_mut);
    for wing in wings.into_iter().flatten() {
        let count = wing.numbers().count();
        if k < count {
            wing.disturb(k, by);
            return;
        }
        k -= count;
    }
}

/// Moves the nodes by six numbers each.
fn displace(state: &mut ElasticState, by: &[f64]) {
    let at = &mut state.structure.configuration;
    let places = at.position.iter_mut().zip(&mut at.rotation);
    for ((p, r), six) in places.zip(by.chunks_exact(NODE)) {
        *p += DVec3::from_slice(six);
        *r = (*r * DQuat::from_scaled_axis(DVec3::from_slice(&six[3..]))).normalize();
    }
}

/// Six numbers a node by which a wing lies, and moves, otherwise than another.
fn departure(state: &ElasticState, from: &ElasticState) -> (Vec<f64>, Vec<f64>) {
    let (a, b) = (&state.structure, &from.structure);
    let (p, r) = (&a.configuration.position, &a.configuration.rotation);
    let places = p.iter().zip(r);
    let others = (b.configuration.position.iter()).zip(&b.configuration.rotation);
    let moved = places.zip(others).flat_map(|((p, r), (q, s))| {
        let turn = rotation_vector(s.inverse() * *r);
        [(*p - *q).to_array(), turn.to_array()].concat()
    });
    let velocity = a.velocity.iter().zip(&b.velocity).map(|(u, v)| u - v);
    (moved.collect(), velocity.collect())
}
