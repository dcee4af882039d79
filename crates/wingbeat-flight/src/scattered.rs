//! Measured angles whose samples scatter: wings that beat with the noise of a camera.

use wingbeat_model::motion::Scatter;
use wingbeat_model::{AngleLaw, Wing};

use crate::setup::FlightSetup;

/// Steps for each sample of a table below which a flight does not follow a spline through samples that scatter:
/// a camera's noise of a degree in 200 samples needs twice as many steps for its lift to come within a per
/// cent.
const STEPS: f64 = 2.0;

impl FlightSetup {
    /// Says which tables of wing angles hold noise, or samples that are wrong, how much, and what to do about it.
    pub fn scattered_angles(&self) -> Vec<String> {
        let mut found: Vec<(String, Vec<&str>)> = vec![];
        for wing in &self.animal.wings {
            for (angle, scatter) in scatters(wing) {
                let text = self.say_scatter(angle, &scatter);
                match found.iter_mut().find(|f| f.0 == text) {
                    Some((_, wings)) => wings.push(&wing.name),
                    None => found.push((text, vec![&wing.name])),
                }
            }
        }
        let named = |(text, wings): (String, Vec<&str>)| {
            let (what, names) = match &wings[..] {
                [one] => ("wing", format!("`{one}`")),
                more => ("wings", format!("`{}`", more.join("`, `"))),
            };
            format!("{what} {names}: {text}")
        };
        found.into_iter().map(named).collect()
    }

    fn say_scatter(&self, angle: &str, s: &Scatter) -> String {
        let least = STEPS * s.samples as f64;
        let steps = self.time.period.map(|p| p / self.time.step);
        let few = match steps.filter(|steps| *steps < least * (1.0 - 1e-9)) {
            Some(steps) => format!(
                ", which {steps:.0} steps per wingbeat do not even follow ({least:.0} at least)"
            ),
            None => String::new(),
        };
        format!(
            "the samples of motion.{angle} scatter by some {:.2} deg (noise, or single ones that are wrong): beyond harmonic {} there are rates of {:.0} % of those of the motion{few}; look at the samples, then fit them by `harmonics = {}` in this table, or give smoother ones",
            s.deviation.to_degrees(),
            s.harmonics,
            100.0 * s.rates,
            s.harmonics
        )
    }
}

/// The angles of a wing whose samples scatter.
fn scatters(wing: &Wing) -> impl Iterator<Item = (&'static str, Scatter)> {
    let laws = &wing.motion.angles;
    let angles = [
        ("phi", &laws.phi),
        ("theta", &laws.theta),
        ("psi", &laws.psi),
    ];
    angles.into_iter().filter_map(|(name, law)| match law {
        AngleLaw::Table(table) => Some((name, table.scatter()?)),
        _ => None,
    })
}
