//! Forces of strips that their wakes slow down.

use wingbeat_math::DVec2;

use crate::lag::{Lag, Lags, StripWind};
use crate::pair::{self, PairForce, PairMotion, StripPair};
use crate::settings::BladeSettings;

/// The wind on a strip whose front is so far from mid chord, over half the chord: 1 is the leading edge.
pub(crate) type Gust<'a> = dyn Fn(usize, f64) -> StripWind + 'a;

/// Where a section meets the air that moves along its chord with `u` and along its normal with `w` \[m/s\],
/// from mid chord over half the chord: at the leading edge (1), at the trailing edge where it flies backwards
/// (-1), in the middle where it meets the air broadside on.
pub(crate) fn front(u: f64, w: f64) -> f64 {
    match u.hypot(w) {
        0.0 => 1.0,
        speed => u / speed,
    }
}

/// Strips that their wakes slow down.
pub(crate) struct Slowed<'a, 'b> {
    pub lags: &'a Lags,
    pub lag: &'a mut Lag<'b>,
    pub gust: &'a Gust<'a>,
    /// Number of strips.
    pub count: usize,
}

impl Slowed<'_, '_> {
    /// Pair number `k`, which moves like `m`, less the downwash of its wake.
    pub fn slowed(&mut self, k: usize, pair: &StripPair, mut m: PairMotion) -> PairMotion {
        let mut less = DVec2::ZERO;
        for lane in 0..2.min(self.count - 2 * k) {
            let strip = 2 * k + lane;
            less[lane] = match &mut self.lag {
                Lag::Known(trial) => trial[strip].downwash,
                Lag::Trial {
                    memory,
                    time,
                    trial,
                } => {
                    let (u, w, q) = (m.u[lane], m.w[lane], m.q[lane]);
                    let ahead = front(u, w);
                    let wind = (self.gust)(strip, ahead);
                    let feathers = pair.lever(lane, ahead) * q;
                    let own = [w + wind.at_axis + feathers, u.hypot(w)];
                    let at = (*memory, strip, *time);
                    let here = self.lags.downwash(at, pair.chord()[lane], own, wind);
                    trial[strip] = here;
                    here.downwash
                }
            };
        }
        m.w -= less;
        m
    }
}

/// As [`pair::forces`] of `pairs` that wakes slow down, if there are any.
#[inline]
pub(crate) fn slowed_forces(
    pairs: &[StripPair],
    settings: &BladeSettings,
    wakes: Option<&mut Slowed<'_, '_>>,
    motion: impl Fn(usize, &StripPair) -> PairMotion,
    put: impl FnMut(usize, &StripPair, PairForce),
) {
    match wakes {
        None => pair::forces(pairs, settings, motion, put),
        Some(s) => pair::forces(pairs, settings, |k, p| s.slowed(k, p, motion(k, p)), put),
    }
}
