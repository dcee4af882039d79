//! The wakes of strips over a flight: what each remembers, and what its downwash is in a trial motion.
//!
//! Within a step the downwash w of a strip goes linearly over its way, of which the mean speed decides: with
//! that the equations of [`crate::indicial`] are solved exactly, `z1 = exp(-p ds) z0 + (1 - exp(-p ds)) / (p
//! ds) (w1 - w0)`. What the motion at the end of the step changes in lambda is so part of every trial: second
//! order in the step, stable whatever the step.
//!
//! The downwash of the wake comes up to the whole strip, along its normal: the strip's coefficients, whatever
//! their law, see `w - lambda`. The way is that with the speed through the air, `sqrt(u^2 + w^2)`: where the
//! strip turns back or meets the air broadside on, all of this stays finite and smooth. Where the wind beside
//! the stream changes, what changes comes up by Kuessner's function from when the edge in front meets it, but
//! for what changes everywhere at once, which is as a motion of the strip ([`crate::LocalWind`]), and for what
//! is there when the memory begins, which is as the stream. What the turning of the strip changes of the wind
//! along its normal is part of the strip's own motion, as of the stream.
//!
//! | symbol | name in code | meaning | unit |
//! |---|---|---|---|
//! | w | `drive` | downwash of the strip's motion, `w + c q ((1/2 - x0) + u / (4 sqrt(u^2 + w^2)))`: at 3/4 of the chord from the edge in front where it is edge-on; with one coefficient `w + C_rot / pi c q u / sqrt(u^2 + w^2)` | m/s |
//! | lambda | `downwash` | downwash of the wake, and what is still missing of the wind's | m/s |
//! | s | `way` | way through the air in half chords | 1 |
//! | z | `wake`, `gust` | states of the wake | m/s |

use faer::c64;
use wingbeat_math::DVec3;

use crate::indicial::{Indicial, Pole, Unsteady, passed};

/// What a strip remembers of its wake.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct StripMemory {
    /// Downwash of its motion and speed at the last accepted instant \[m/s\].
    drive: f64,
    speed: f64,
    /// Wind at the edge in front \[m/s\] and normal of the strip then, N components; none before the first.
    wind: DVec3,
    normal: DVec3,
    /// Way since the memory began, in half chords \[1\].
    way: f64,
    /// States of the wake, and those of the wind \[m/s\]: one number of a real rate, two of a pair.
    wake: Vec<f64>,
    gust: Vec<f64>,
}

/// What the strips of a wing remember.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct WingMemory {
    time: f64,
    strips: Vec<StripMemory>,
}

/// The wind beside the stream on a strip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StripWind {
    /// Its velocity along the normal at the feathering axis, which the motion through the air lacks \[m/s\].
    pub at_axis: f64,
    /// Its velocity where the strip meets the air, N components \[m/s\].
    pub at_front: DVec3,
    /// Its velocity at the edge behind, N components \[m/s\].
    pub at_rear: DVec3,
    /// What has changed everywhere at once since the memory, N components \[m/s\].
    pub at_once: DVec3,
    /// Normal of the strip, N components \[1\].
    pub normal: DVec3,
}

/// A strip in a trial motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StripTrial {
    drive: f64,
    speed: f64,
    wind: DVec3,
    at_once: DVec3,
    normal: DVec3,
    /// Downwash of its wake \[m/s\].
    pub(crate) downwash: f64,
}

/// Where the downwash of the wakes comes from.
#[derive(Debug)]
pub enum Lag<'a> {
    /// From what the strips remember, at this time \[s\]; what they do in the trial stays in `trial`.
    Trial {
        /// What they remember.
        memory: &'a WingMemory,
        /// Time \[s\].
        time: f64,
        /// The strips in the trial.
        trial: &'a mut Vec<StripTrial>,
    },
    /// It is that of the trial before.
    Known(&'a [StripTrial]),
}

impl Lag<'_> {
    /// When the memory was accepted \[s\]; none of a trial that is known.
    pub fn since(&self) -> Option<f64> {
        match self {
            Self::Trial { memory, .. } => Some(memory.time),
            Self::Known(_) => None,
        }
    }
}

impl WingMemory {
    /// Of `strips` strips at rest at time zero, no wake yet.
    pub(crate) fn new(strips: usize, lags: &Lags) -> Self {
        let strip = StripMemory {
            wake: vec![0.0; lags.wake.numbers()],
            gust: vec![0.0; lags.gust.numbers()],
            ..StripMemory::default()
        };
        Self {
            time: 0.0,
            strips: vec![strip; strips],
        }
    }

    /// The same at the time `time` \[s\], ways counted from there.
    #[must_use]
    pub fn at(mut self, time: f64) -> Self {
        self.time = time;
        self.strips.iter_mut().for_each(|s| s.way = 0.0);
        self
    }

    /// Sets the time \[s\] at which the memory was accepted.
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// Whether another memory is one of the same strips, all numbers finite.
    pub fn fits(&self, other: &Self) -> bool {
        let same = |a: &StripMemory, b: &StripMemory| {
            let numbers = b.wake.iter().chain(&b.gust);
            let mut numbers = numbers.chain([&b.drive, &b.speed, &b.way]);
            (a.wake.len(), a.gust.len()) == (b.wake.len(), b.gust.len())
                && numbers.all(|x| x.is_finite())
                && [b.wind, b.normal].iter().all(|v| v.is_finite())
        };
        let mut both = self.strips.iter().zip(&other.strips);
        self.strips.len() == other.strips.len()
            && other.time.is_finite()
            && both.all(|(a, b)| same(a, b))
    }

    /// States of the wakes \[m/s\], strip by strip.
    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        self.strips.iter().flat_map(|s| s.wake.iter().copied())
    }

    /// Adds `by` \[m/s\] to number `k` of [`Self::numbers`].
    pub fn disturb(&mut self, k: usize, by: f64) {
        let mut numbers = self.strips.iter_mut().flat_map(|s| s.wake.iter_mut());
        if let Some(x) = numbers.nth(k) {
            *x += by;
        }
    }
}

/// The indicial functions of a wing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lags {
    wake: Indicial,
    gust: Indicial,
}

impl Lags {
    pub fn of(theory: Unsteady) -> Self {
        Self {
            wake: theory.indicial(),
            gust: Indicial::kuessner(),
        }
    }

    /// The strip moved on by `duration` \[s\] to where it moves as in `trial`, its chord being 2 `half` \[m\].
    fn accept_strip(&self, strip: &mut StripMemory, trial: &StripTrial, duration: f64, half: f64) {
        let way = strip.way_to(trial.speed, duration, half);
        let [wake, gust] = strip.changes(trial);
        let lists = [
            (&self.wake, &mut strip.wake, wake),
            (&self.gust, &mut strip.gust, gust),
        ];
        for (law, states, change) in lists {
            let mut states = &mut states[..];
            for pole in law.poles() {
                let (own, rest) = states.split_at_mut(pole.numbers());
                let z = next(pole.rate, complex(own), change, way);
                keep(z, own);
                states = rest;
            }
        }
        strip.way += way;
        (strip.drive, strip.speed) = (trial.drive, trial.speed);
        (strip.wind, strip.normal) = (trial.wind, trial.normal);
    }

    /// What is missing of the circulation's and of the wind's downwash \[m/s\].
    fn missing(&self, strip: &StripMemory, trial: &StripTrial, duration: f64, half: f64) -> f64 {
        let way = strip.way_to(trial.speed, duration, half);
        let parts_of = |law: &Indicial, mut states: &[f64], change: f64| -> f64 {
            let part = |pole: &Pole| {
                let (own, rest) = states.split_at(pole.numbers());
                states = rest;
                (pole.weight * next(pole.rate, complex(own), change, way)).re
            };
            law.poles().iter().map(part).sum()
        };
        let [own, met] = strip.changes(trial);
        let wake = parts_of(&self.wake, &strip.wake, own);
        match met == 0.0 && strip.gust.iter().all(|z| *z == 0.0) {
            true => wake,
            false => wake - parts_of(&self.gust, &strip.gust, met),
        }
    }

    /// The strips of chords `chords` \[m\] after they have moved as in `trial` at `time` \[s\].
    pub fn accept(
        &self,
        memory: &mut WingMemory,
        trial: &[StripTrial],
        time: f64,
        chords: impl Iterator<Item = f64>,
    ) {
        let duration = time - memory.time;
        for ((own, trial), chord) in memory.strips.iter_mut().zip(trial).zip(chords) {
            self.accept_strip(own, trial, duration, 0.5 * chord);
        }
        memory.time = time;
    }

    /// The downwash \[m/s\] to be taken from a strip of chord `chord` \[m\] in the `wind`, and the trial that
    /// it belongs to: its motion has the downwash `drive` and the `speed`.
    pub fn downwash(
        &self,
        (memory, strip, time): (&WingMemory, usize, f64),
        chord: f64,
        [drive, speed]: [f64; 2],
        wind: StripWind,
    ) -> StripTrial {
        let own = &memory.strips[strip];
        let mut here = StripTrial {
            drive,
            speed,
            wind: wind.at_front,
            at_once: match own.remembers() {
                true => wind.at_once,
                false => wind.at_rear,
            },
            normal: wind.normal,
            downwash: 0.0,
        };
        let missing = self.missing(own, &here, time - memory.time, 0.5 * chord);
        // Of the wind at the axis, which the motion has, that at the edge in front takes the place.
        here.downwash = missing + (wind.at_front.dot(wind.normal) - wind.at_axis);
        here
    }

    /// The beat after which a memory `after` was found that began with `before`, ended by the states that come
    /// back: of the same motion, beat after beat.
    pub fn periodic(&self, before: &WingMemory, after: &mut WingMemory) {
        /// Parts of a state that a beat must take away for its periodic value to be known.
        const FELT: f64 = 1e-3;
        for (a, b) in after.strips.iter_mut().zip(&before.strips) {
            let way = a.way;
            let mut from = 0;
            for pole in self.wake.poles() {
                let range = from..from + pole.numbers();
                from = range.end;
                let left = passed(pole.rate, way).0;
                let lost = 1.0 - left;
                if lost.norm() > FELT {
                    let kept = left * complex(&b.wake[range.clone()]);
                    let own = &mut a.wake[range];
                    keep((complex(own) - kept) / lost, own);
                }
            }
        }
    }
}

/// One or two numbers as a complex one.
fn complex(numbers: &[f64]) -> c64 {
    c64::new(numbers[0], numbers.get(1).copied().unwrap_or(0.0))
}

/// A complex number as one or two.
fn keep(z: c64, numbers: &mut [f64]) {
    let count = numbers.len();
    numbers.copy_from_slice(&[z.re, z.im][..count]);
}

/// A state after its downwash has changed by `change` over a `way`.
fn next(rate: c64, z: c64, change: f64, way: f64) -> c64 {
    let (left, gained) = passed(rate, way);
    left * z + gained * change
}

impl StripMemory {
    /// Whether it has met air yet.
    fn remembers(&self) -> bool {
        self.normal != DVec3::ZERO
    }

    /// Way in half chords to an instant `duration` \[s\] later at which its speed is `speed` \[m/s\].
    fn way_to(&self, speed: f64, duration: f64, half: f64) -> f64 {
        0.5 * (self.speed + speed) * duration / half
    }

    /// By how much the downwash of the motion, and of the wind that is met, has changed in a trial \[m/s\]: of
    /// the product of wind and normal what the normal changes belongs to the motion, and what changes
    /// everywhere at once, or is there at the start, is a motion of the strip against it.
    fn changes(&self, trial: &StripTrial) -> [f64; 2] {
        let normal = match self.remembers() {
            true => self.normal,
            false => trial.normal,
        };
        let turned = 0.5 * (self.wind + trial.wind).dot(trial.normal - normal);
        let both = 0.5 * (trial.normal + normal);
        let met = (trial.wind - self.wind - trial.at_once).dot(both);
        [
            trial.drive - self.drive - turned - trial.at_once.dot(both),
            met,
        ]
    }
}
