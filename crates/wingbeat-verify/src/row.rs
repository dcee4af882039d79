//! One line of the report.

use std::borrow::Cow;

use wingbeat_math::root_mean_square;

/// What a row says about us.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within the tolerance.
    Pass,
    /// Outside it.
    Fail,
    /// Stated, not judged.
    Unjudged,
}

/// Why a case could not be run to its end.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// The air refused.
    #[error("{0}")]
    Air(#[from] wingbeat_air::AirError),
    /// The flight refused.
    #[error("{0}")]
    Flight(#[from] wingbeat_flight::FlightError),
    /// The analysis refused.
    #[error("{0}")]
    Analysis(#[from] wingbeat_analysis::AnalysisError),
    /// The elastic body refused.
    #[error("{0}")]
    Structure(#[from] wingbeat_structure::StructureError),
    /// The wing refused.
    #[error("{0}")]
    Model(#[from] wingbeat_model::ModelError),
    /// The case file was refused.
    #[error("{0}")]
    Case(#[from] wingbeat_case::IoError),
    /// The measured points do not determine what is fitted to them.
    #[error("measured points do not determine what is fitted to them: {0}")]
    Fit(#[from] wingbeat_math::SingularMatrix),
}

/// A quantity, its reference and the computed value.
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
pub struct Row {
    /// What is compared.
    pub quantity: String,
    /// Its unit.
    pub unit: Cow<'static, str>,
    /// The reference, in [`Self::unit`]; none where a bound or a spread alone is stated.
    pub reference: Option<f64>,
    /// Where the reference comes from.
    pub source: Cow<'static, str>,
    /// The same as computed, in [`Self::unit`].
    #[serde(deserialize_with = "number")]
    pub computed: f64,
    /// Half-width of our own uncertainty, from refinement, in [`Self::unit`]; none for exact statements.
    pub uncertainty: Option<f64>,
    /// Largest error that passes, in [`Self::unit`]; none: a report.
    pub tolerance: Option<f64>,
    /// Why that much, or what a report means.
    pub reason: Cow<'static, str>,
    /// The course of the quantity behind the number, for the figure of the case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub comparison: Option<Comparison>,
}

/// A history or polar beside its reference.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Comparison {
    /// Quantity and unit upward; comparisons of one quantity and one reference share a pair of axes.
    pub quantity: Cow<'static, str>,
    /// Quantity and unit along.
    pub along: Cow<'static, str>,
    /// Name of the reference.
    pub against: Cow<'static, str>,
    /// Name of what was computed.
    pub name: Cow<'static, str>,
    /// Abscissa \[unit of `along`\], reference and computed value \[unit of `quantity`\].
    pub points: Vec<[f64; 3]>,
}

impl Comparison {
    /// A history over one wingbeat, at equal steps from its start, beside what others have.
    pub fn over_a_beat(
        quantity: impl Into<Cow<'static, str>>,
        name: &'static str,
        computed: &[f64],
        reference: &[f64],
    ) -> Self {
        let part = |k: usize| k as f64 / reference.len() as f64;
        let both = reference.iter().zip(computed).enumerate();
        Self {
            quantity: quantity.into(),
            along: "wingbeats [1]".into(),
            against: "reference".into(),
            name: name.into(),
            points: both.map(|(k, (r, c))| [part(k), *r, *c]).collect(),
        }
    }

    /// Root of the mean square of the differences.
    pub fn rms_error(&self) -> f64 {
        root_mean_square(self.points.iter().map(|p| p[2] - p[1]))
    }
}

/// A number; what JSON has no number for is written as null.
fn number<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    let read: Option<f64> = serde::Deserialize::deserialize(from)?;
    Ok(read.unwrap_or(f64::NAN))
}

impl Row {
    /// What was computed against a reference, as a report until [`Self::within`] judges it.
    pub fn new(quantity: impl Into<String>, unit: &'static str, computed: f64) -> Self {
        Self {
            quantity: quantity.into(),
            unit: unit.into(),
            reference: None,
            source: "".into(),
            computed,
            uncertainty: None,
            tolerance: None,
            reason: "".into(),
            comparison: None,
        }
    }

    /// What it is compared with, and where that stands.
    pub fn against(mut self, reference: f64, source: &'static str) -> Self {
        self.reference = Some(reference);
        self.source = source.into();
        self
    }

    /// Our own uncertainty, in the unit.
    pub fn uncertain(mut self, by: f64) -> Self {
        self.uncertainty = Some(by.abs());
        self
    }

    /// Judged: the error may be this large, in the unit, for this reason.
    pub fn within(mut self, tolerance: f64, reason: &'static str) -> Self {
        self.tolerance = Some(tolerance);
        self.reason = reason.into();
        self
    }

    /// As [`Self::within`], as a part of the reference.
    pub fn within_part(self, part: f64, reason: &'static str) -> Self {
        let scale = self.reference.unwrap_or(1.0).abs();
        self.within(part * scale, reason)
    }

    /// What a report means.
    pub fn because(mut self, reason: &'static str) -> Self {
        self.reason = reason.into();
        self
    }

    /// With the course of the quantity.
    pub fn drawn(mut self, comparison: Comparison) -> Self {
        self.comparison = Some(comparison);
        self
    }

    /// Computed value less the reference; the computed value where there is none.
    pub fn error(&self) -> f64 {
        self.computed - self.reference.unwrap_or(0.0)
    }

    /// The judgement.
    pub fn verdict(&self) -> Verdict {
        match self.tolerance {
            None => Verdict::Unjudged,
            Some(tolerance) if self.error().abs() <= tolerance => Verdict::Pass,
            Some(_) => Verdict::Fail,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_verdicts_follow_the_tolerance() {
        let row = Row::new("x", "1", 1.02).against(1.0, "by hand");
        assert_eq!(row.verdict(), Verdict::Unjudged);
        assert_eq!(row.clone().within(0.03, "").verdict(), Verdict::Pass);
        assert_eq!(row.within_part(0.01, "").verdict(), Verdict::Fail);
        let lost = Row::new("x", "1", f64::NAN).within(1.0, "");
        let text = serde_json::to_string(&lost).unwrap();
        let read: Row = serde_json::from_str(&text).unwrap();
        assert_eq!(read.verdict(), Verdict::Fail, "nor after it was written");
        assert_eq!(lost.verdict(), Verdict::Fail, "not a number never passes");
    }
}
