//! Chord by Ellington's beta distribution [Ellington 1984, Phil. Trans. R. Soc. B 305:17, II].
//!
//! With xi from root (0) to tip (1): `c ~ xi^(p-1) (1-xi)^(q-1)`. Mean `r1` and second moment
//! `r2^2` of the distribution fix p and q; Ellington found `r2 = 0.929 r1^0.732` over the
//! insects, which leaves one parameter. A beta wing has no chord at root and tip: a least chord
//! is kept there so that no panel degenerates, and the parameter is solved for so that the wing
//! as built has the wanted r2_hat about the hinge.

use crate::error::{ModelError, fraction, not_negative, positive, require};
use std::f64::consts::PI;

/// How the size of the chord is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ChordSize {
    /// Mean chord S/R \[m\].
    Mean(f64),
    /// Area of one wing \[m2\].
    Area(f64),
    /// Largest chord \[m\].
    Max(f64),
}

/// A wing of beta-distributed chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beta {
    /// Wing length R, hinge to tip \[m\].
    pub length: f64,
    /// Size of the chord.
    pub size: ChordSize,
    /// Radius of the second moment of wing area about the hinge, relative to R \[1\].
    pub r2_hat: f64,
    /// Distance from the hinge to the root \[m\].
    pub root_offset: f64,
    /// Part of the chord ahead of the hinge axis, 0 to 1 \[1\].
    pub axis_fraction: f64,
    /// Least chord relative to the largest \[1\], above 0 and below 0.9.
    pub least_chord: f64,
}

/// The fitted chord distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BetaChord {
    /// Exponent p \[1\].
    pub p: f64,
    /// Exponent q \[1\].
    pub q: f64,
    /// Largest chord \[m\].
    pub max: f64,
    /// Least chord relative to the largest \[1\].
    pub least: f64,
}

/// Range of the beta mean r1 searched: p > 1 and q > 1 throughout (finite chords at the ends);
/// from 0.76 on, Ellington's relation would want a negative variance.
const R1: [f64; 2] = [0.385, 0.72];

impl BetaChord {
    /// The exponents of mean `r1`, with unit largest chord.
    pub fn of_r1(r1: f64, least: f64) -> Self {
        let r2 = 0.929 * r1.powf(0.732); // [Ellington 1984 II]
        let sum = r1 * (1.0 - r1) / (r2 * r2 - r1 * r1) - 1.0;
        Self {
            p: r1 * sum,
            q: (1.0 - r1) * sum,
            max: 1.0,
            least,
        }
    }

    /// Chord at `xi` in [0, 1] \[m\].
    pub fn at(&self, xi: f64) -> f64 {
        let (a, b) = (self.p - 1.0, self.q - 1.0);
        let shape = |x: f64| x.powf(a) * (1.0 - x).powf(b);
        let relative = shape(xi.clamp(0.0, 1.0)) / shape(a / (a + b));
        self.max * relative.max(self.least)
    }

    /// Moments `int c xi^k dxi`, k = 0, 1, 2 \[m\], by Simpson's rule in the angle t of
    /// `xi = (1 - cos t) / 2`.
    pub fn moments(&self) -> [f64; 3] {
        const N: usize = 1000;
        let mut sum = [0.0; 3];
        for i in 0..=N {
            let weight = if i == 0 || i == N {
                1.0
            } else {
                2.0 + 2.0 * (i % 2) as f64
            };
            let t = PI * i as f64 / N as f64;
            let xi = 0.5 * (1.0 - t.cos());
            let c = self.at(xi) * weight * 0.5 * t.sin() * PI / (3.0 * N as f64);
            sum[0] += c;
            sum[1] += c * xi;
            sum[2] += c * xi * xi;
        }
        sum
    }

    /// r2_hat about the hinge of a wing whose root lies at the part `e` of its length.
    fn r2_hat(&self, e: f64) -> f64 {
        let [m0, m1, m2] = self.moments();
        let l = 1.0 - e;
        (e * e + 2.0 * e * l * m1 / m0 + l * l * m2 / m0).sqrt()
    }
}

impl Beta {
    /// The chord distribution whose wing has the given length, size and r2_hat.
    ///
    /// # Errors
    /// A number out of range; [`ModelError::Planform`] if no beta distribution has the r2_hat.
    pub fn fit(&self) -> Result<BetaChord, ModelError> {
        self.check()?;
        let e = self.root_offset / self.length;
        let r1 = self.solve_r1(e)?;
        let unit = BetaChord::of_r1(r1, self.least_chord);
        let unit_area = unit.moments()[0] * (self.length - self.root_offset);
        let max = match self.size {
            ChordSize::Mean(c) => positive("planform.mean_chord", c)? * self.length / unit_area,
            ChordSize::Area(s) => positive("planform.area", s)? / unit_area,
            ChordSize::Max(c) => positive("planform.max_chord", c)?,
        };
        Ok(BetaChord { max, ..unit })
    }

    /// Bisection: r2_hat rises with r1.
    fn solve_r1(&self, e: f64) -> Result<f64, ModelError> {
        let at = |r1: f64| BetaChord::of_r1(r1, self.least_chord).r2_hat(e);
        let [mut lo, mut hi] = R1;
        let [least, most] = [at(lo), at(hi)];
        if !(least..=most).contains(&self.r2_hat) {
            return Err(ModelError::Planform(format!(
                "r2_hat = {} is out of reach: beta distributions with this root offset and least chord have {least:.3} to {most:.3}",
                self.r2_hat
            )));
        }
        for _ in 0..50 {
            let mid = 0.5 * (lo + hi);
            if at(mid) < self.r2_hat {
                lo = mid
            } else {
                hi = mid
            }
        }
        Ok(0.5 * (lo + hi))
    }

    fn check(&self) -> Result<(), ModelError> {
        positive("planform.length", self.length)?;
        let r0 = not_negative("planform.root_offset", self.root_offset)?;
        let inside = r0 < self.length;
        require(
            "planform.root_offset",
            r0,
            inside,
            "less than the wing length",
        )?;
        fraction("planform.axis_fraction", self.axis_fraction)?;
        let least = self.least_chord;
        let ok = least > 0.0 && least < 0.9;
        require("planform.least_chord", least, ok, "in (0, 0.9)")?;
        Ok(())
    }
}
