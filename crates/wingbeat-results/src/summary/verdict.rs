//! A flight at a glance: green, amber or red, from its outcome and its warnings.

use serde::{Deserialize, Serialize};

use crate::Outcome;

/// How far a flight can be trusted; also what a warning alone makes of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Nothing is known against it but what its models leave out, which they say.
    #[default]
    Green,
    /// Something limits trust.
    Amber,
    /// It failed, or its numbers mean nothing.
    Red,
}

impl Verdict {
    /// As a number: 0 green, 1 amber, 2 red.
    pub fn level(self) -> u8 {
        match self {
            Self::Green => 0,
            Self::Amber => 1,
            Self::Red => 2,
        }
    }

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Green => "green",
            Self::Amber => "amber",
            Self::Red => "red",
        }
    }
}

/// What a reader should know before using the numbers, each with what it makes of the flight.
#[derive(Default)]
pub(super) struct Warnings(Vec<(Verdict, String)>);

impl Warnings {
    /// What a model leaves out or takes as given.
    pub(super) fn note(&mut self, text: impl Into<String>) {
        self.0.push((Verdict::Green, text.into()));
    }

    /// What makes this of the flight; a fault comes first.
    pub(super) fn add(&mut self, verdict: Verdict, text: String) {
        match verdict {
            Verdict::Green => self.note(text),
            Verdict::Amber => self.limit(text),
            Verdict::Red => self.fault(text),
        }
    }

    /// What limits trust.
    pub(super) fn limit(&mut self, text: impl Into<String>) {
        self.0.push((Verdict::Amber, text.into()));
    }

    /// The same, where it comes before all that is said so far.
    pub(super) fn limit_first(&mut self, text: impl Into<String>) {
        self.0.insert(0, (Verdict::Amber, text.into()));
    }

    /// Puts others before all that is said so far.
    pub(super) fn put_first(&mut self, others: Self) {
        self.0.splice(..0, others.0);
    }

    /// What forbids trust; it comes first.
    pub(super) fn fault(&mut self, text: impl Into<String>) {
        self.0.insert(0, (Verdict::Red, text.into()));
    }

    /// The verdict on a flight that ended so, and the reason for it.
    pub(super) fn verdict(&self, outcome: &Outcome) -> (Verdict, String) {
        let end = match outcome {
            Outcome::Finished => (Verdict::Green, ""),
            Outcome::Interrupted => (Verdict::Amber, "it was interrupted"),
            Outcome::Running => (Verdict::Amber, "it is still running"),
            Outcome::Unwritten(_) => (Verdict::Red, "it could not be written to its end"),
            Outcome::Failed(_) => (Verdict::Red, "it ended early"),
        };
        let of_warnings = self
            .0
            .iter()
            .map(|(verdict, text)| (*verdict, first_sentence(text)));
        let all: Vec<(Verdict, &str)> = std::iter::once(end).chain(of_warnings).collect();
        let worst = all.iter().map(|w| w.0).max().unwrap_or_default();
        let mut reasons = all.iter().filter(|w| w.0 == worst).map(|w| w.1);
        let reason = match (worst, reasons.next()) {
            (Verdict::Green, _) | (_, None) => {
                "its balances close, and nothing limits trust but what its models leave out"
                    .to_owned()
            }
            (_, Some(first)) => match reasons.count() {
                0 => first.to_owned(),
                more => format!("{first} ({more} more below)"),
            },
        };
        (worst, reason)
    }

    /// The texts.
    pub(super) fn into_texts(self) -> Vec<String> {
        self.0.into_iter().map(|w| w.1).collect()
    }
}

/// The first sentence, without its full stop.
fn first_sentence(text: &str) -> &str {
    let end = text.find(". ").unwrap_or(text.len());
    text[..end].trim_end_matches('.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_worst_decides_and_the_first_of_the_worst_is_the_reason() {
        let mut warnings = Warnings::default();
        warnings.note("The air is quasi-steady. It has no wake.");
        let verdict = |w: &Warnings| w.verdict(&Outcome::Finished);
        assert_eq!(verdict(&warnings).0, Verdict::Green);
        warnings.limit("One. More of it.");
        assert_eq!(verdict(&warnings), (Verdict::Amber, "One".to_owned()));
        warnings.limit("Two.");
        let (amber, reason) = verdict(&warnings);
        assert_eq!((amber.word(), &reason[..]), ("amber", "One (1 more below)"));
        warnings.fault("Residual 1.5e-3 here.");
        let red = (Verdict::Red, "Residual 1.5e-3 here".to_owned());
        assert_eq!(verdict(&warnings), red);
        let failed = warnings.verdict(&Outcome::Failed("it fell".to_owned()));
        assert_eq!(
            failed,
            (Verdict::Red, "it ended early (1 more below)".to_owned())
        );
        assert_eq!(warnings.into_texts()[0], "Residual 1.5e-3 here.");
    }
}
