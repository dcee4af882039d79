//! Forces of strips that their wakes slow down.

use wingbeat_math::DVec2;

use crate::lag::{Lag, Lags};
use crate::pair::{self, PairForce, PairMotion, StripPair};
use crate::settings::BladeSettings;

/// Normal velocities \[m/s\] of the wind at the feathering axis and the leading edge of a strip.
pub(crate) type Gust<'a> = dyn Fn(usize) -> [f64; 2] + 'a;

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
                    let wind = (self.gust)(strip);
                    let (u, w, q) = (m.u[lane], m.w[lane], m.q[lane]);
                    let own = [w + wind[0] + pair.lever()[lane] * q, u.hypot(w)];
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
