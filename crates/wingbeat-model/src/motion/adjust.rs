//! Adjusted angle laws: the means of steering and trim.

use super::{AngleLaw, Oval, SmoothSquare, SmoothTriangle, SplitCycle, WingMotion};
use crate::mesh::Side;

impl AngleLaw {
    /// Whether it is one angle at all times, whatever it could be by its form.
    pub fn is_constant(&self) -> bool {
        match self {
            AngleLaw::Constant(_) => true,
            AngleLaw::Fourier(law) => law.is_constant(),
            AngleLaw::SmoothTriangle(SmoothTriangle { amplitude, .. })
            | AngleLaw::SmoothSquare(SmoothSquare { amplitude, .. })
            | AngleLaw::Oval(Oval { amplitude, .. })
            | AngleLaw::SplitCycle(SplitCycle { amplitude, .. }) => *amplitude == 0.0,
            AngleLaw::Table(law) => law.is_constant(),
        }
    }

    /// Mean over a beat \[rad\].
    pub fn mean(&self) -> f64 {
        match self {
            AngleLaw::Constant(q) => *q,
            AngleLaw::Fourier(law) => law.mean,
            AngleLaw::SmoothTriangle(law) => law.mean,
            AngleLaw::SmoothSquare(law) => law.mean,
            AngleLaw::Oval(law) => law.mean,
            AngleLaw::SplitCycle(law) => law.mean,
            AngleLaw::Table(law) => law.mean(),
        }
    }

    /// The law `q(x) + offset` \[rad\].
    pub fn raised(&self, offset: f64) -> Self {
        let mut law = self.clone();
        match &mut law {
            AngleLaw::Constant(q) => *q += offset,
            AngleLaw::Fourier(law) => law.mean += offset,
            AngleLaw::SmoothTriangle(law) => law.mean += offset,
            AngleLaw::SmoothSquare(law) => law.mean += offset,
            AngleLaw::Oval(law) => law.mean += offset,
            AngleLaw::SplitCycle(law) => law.mean += offset,
            AngleLaw::Table(law) => *law = law.raised(offset),
        }
        law
    }

    /// The law with `factor` times the swing about its mean.
    pub fn amplified(&self, factor: f64) -> Self {
        let mean = self.mean();
        self.raised(-mean).scaled(factor).raised(mean)
    }

    /// The law with `more` of the beat given to its first half stroke: of split-cycle strokes; others have no such
    /// share and stay as they are.
    pub fn split_by(&self, more: f64) -> Self {
        let mut law = self.clone();
        if let AngleLaw::SplitCycle(law) = &mut law {
            law.first_share += more;
        }
        law
    }

    /// The law `q(x + lead)`, lead in wingbeats.
    pub fn advanced(&self, lead: f64) -> Self {
        let turn = std::f64::consts::TAU * lead;
        let mut law = self.clone();
        match &mut law {
            AngleLaw::Constant(_) => {}
            AngleLaw::Fourier(law) => *law = law.shifted(lead),
            AngleLaw::SmoothTriangle(law) => law.shift += turn,
            AngleLaw::SmoothSquare(law) => law.shift += turn,
            AngleLaw::Oval(law) => law.shift += turn * law.count as f64,
            AngleLaw::SplitCycle(law) => law.shift += turn,
            AngleLaw::Table(law) => *law = law.advanced(lead),
        }
        law
    }
}

/// Adjustments of a wing's motion. All zero leaves it as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Adjustment {
    /// Relative change of the stroke's swing about its mean \[1\].
    pub stroke_amplitude: f64,
    /// Added to the stroke angle, positive forward (ventral) on either side \[rad\].
    pub stroke_offset: f64,
    /// Added to the feathering angle \[rad\].
    pub feathering_offset: f64,
    /// Relative change of the feathering's swing about its mean \[1\].
    pub feathering_amplitude: f64,
    /// Lead of feathering \[wingbeats\].
    pub feathering_lead: f64,
    /// Added to the deviation, in the sense of a right wing on either side \[rad\].
    pub deviation_offset: f64,
    /// Added to the pitch of the stroke plane \[rad\].
    pub stroke_plane: f64,
    /// Relative change of the frequency \[1\].
    pub frequency: f64,
}

impl Adjustment {
    /// The numbers with their names.
    pub fn numbers(&self) -> [(&'static str, f64); 8] {
        [
            ("stroke_amplitude", self.stroke_amplitude),
            ("stroke_offset", self.stroke_offset),
            ("feathering_offset", self.feathering_offset),
            ("feathering_amplitude", self.feathering_amplitude),
            ("feathering_lead", self.feathering_lead),
            ("deviation_offset", self.deviation_offset),
            ("stroke_plane", self.stroke_plane),
            ("frequency", self.frequency),
        ]
    }

    /// From the numbers in the order of [`Self::numbers`].
    pub fn of_numbers(x: [f64; 8]) -> Self {
        let [
            stroke_amplitude,
            stroke_offset,
            feathering_offset,
            feathering_amplitude,
            feathering_lead,
            deviation_offset,
            stroke_plane,
            frequency,
        ] = x;
        Self {
            stroke_amplitude,
            stroke_offset,
            feathering_offset,
            feathering_amplitude,
            feathering_lead,
            deviation_offset,
            stroke_plane,
            frequency,
        }
    }

    /// Number by number of this one and another.
    fn with(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.numbers(), other.numbers());
        Self::of_numbers(std::array::from_fn(|k| f(a[k].1, b[k].1)))
    }

    /// That of the wings of one side: this one, and half of `difference` (right less left) to either side.
    pub fn on(&self, side: Side, difference: &Self) -> Self {
        let half = 0.5 * side.sign();
        self.with(difference, |a, d| a + half * d)
    }

    /// What of it acts on a wing that another wing carries, or that stands still beside wings that beat: the frequency.
    pub fn on_wing(&self) -> Self {
        Self {
            frequency: self.frequency,
            ..Self::default()
        }
    }

    /// The share `share` of the way from here to `to`.
    pub fn toward(&self, to: &Self, share: f64) -> Self {
        self.with(to, |a, b| a + share * (b - a))
    }

    /// What right wings with this one and left ones with the other have in the mean.
    pub fn mean(&self, other: &Self) -> Self {
        self.with(other, |a, b| 0.5 * (a + b))
    }

    /// What this one has more than the other.
    pub fn less(&self, other: &Self) -> Self {
        self.with(other, |a, b| a - b)
    }

    /// This one and then the other: relative changes multiply, angles and leads add.
    pub fn then(&self, next: &Self) -> Self {
        let both = |a: f64, b: f64| (1.0 + a) * (1.0 + b) - 1.0;
        Self {
            stroke_amplitude: both(self.stroke_amplitude, next.stroke_amplitude),
            feathering_amplitude: both(self.feathering_amplitude, next.feathering_amplitude),
            frequency: both(self.frequency, next.frequency),
            ..self.with(next, |a, b| a + b)
        }
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.numbers().iter().all(|(_, x)| x.is_finite())
    }
}

impl WingMotion {
    /// What of `by` has an effect here: of an angle that is constant there is neither swing nor lead.
    pub fn heeded(&self, by: &Adjustment) -> Adjustment {
        let mut heeded = *by;
        if self.angles.phi.is_constant() {
            heeded.stroke_amplitude = 0.0;
        }
        if self.angles.psi.is_constant() {
            (heeded.feathering_amplitude, heeded.feathering_lead) = (0.0, 0.0);
        }
        heeded
    }

    /// The numbers of `by` that are not zero and have no effect here, with their names.
    pub fn idle(&self, by: &Adjustment) -> impl Iterator<Item = (&'static str, f64)> {
        let numbers = by.numbers().into_iter().zip(self.heeded(by).numbers());
        let idle = numbers.filter(|(told, heeded)| told.1 != 0.0 && heeded.1 == 0.0);
        idle.map(|(told, _)| told)
    }

    /// The motion of a wing of this side with the adjustment.
    pub fn adjusted(&self, side: Side, by: &Adjustment) -> Self {
        if *by == Adjustment::default() {
            return self.clone(); // to the bit
        }
        let s = side.sign();
        let mut m = self.clone();
        let a = &self.angles;
        m.angles.phi = a
            .phi
            .amplified(1.0 + by.stroke_amplitude)
            .raised(s * by.stroke_offset);
        m.angles.theta = a.theta.raised(s * by.deviation_offset);
        m.angles.psi = a
            .psi
            .amplified(1.0 + by.feathering_amplitude)
            .advanced(by.feathering_lead)
            .raised(by.feathering_offset);
        m.stroke_plane_pitch += by.stroke_plane;
        m.frequency *= 1.0 + by.frequency;
        m
    }
}
