//! What came of flights out of random tumbles, as a table.

use serde_json::{Value, json};
use wingbeat::analysis::Trim;
use wingbeat::analysis::episode::{CALM_BEATS, CALM_SPEED, CALM_TILT, Recovery};

use crate::command::report::{Report, line};

/// Upper ends of the classes of tilt at the start, degrees: beyond 1.2 rad about each of three axes there are none.
const CLASSES: [f64; 4] = [30.0, 60.0, 90.0, 120.0];

/// Recoveries of some tumbles.
struct Share<'a> {
    all: Vec<&'a Recovery>,
    /// Wingbeats that those who recovered needed, in order.
    beats: Vec<usize>,
}

impl<'a> Share<'a> {
    fn of(all: Vec<&'a Recovery>) -> Self {
        let mut beats: Vec<usize> = all.iter().filter_map(|r| r.beats).collect();
        beats.sort_unstable();
        Self { all, beats }
    }

    /// Share that recovered, and its standard error \[1\]: that of Jeffreys' estimate (k + 1/2)/(n + 1), which is not zero where
    /// all or none did.
    fn recovered(&self) -> [f64; 2] {
        let (k, n) = (self.beats.len() as f64, self.all.len() as f64);
        let p = (k + 0.5) / (n + 1.0);
        [k / n, (p * (1.0 - p) / (n + 1.0)).sqrt()]
    }

    /// The wingbeats that a part of those who recovered do not exceed.
    fn quantile(&self, part: f64) -> Option<usize> {
        let last = self.beats.len().checked_sub(1)?;
        Some(self.beats[(part * last as f64).round() as usize])
    }

    /// Median of the farthest distances of those who recovered, in wing lengths `length` \[m\].
    fn strayed(&self, length: f64) -> Option<f64> {
        let recovered = self.all.iter().filter(|r| r.beats.is_some());
        let mut far: Vec<f64> = recovered.map(|r| r.strayed / length).collect();
        far.sort_unstable_by(f64::total_cmp);
        far.get(far.len() / 2).copied()
    }
}

/// Writes the table; every flight stands in the JSON.
pub(super) fn tell(report: &mut Report, trim: &Trim, first: u64, recoveries: &[Recovery]) {
    let length = trim.beat.wing_length();
    line!(
        report,
        "\n{} tumbles, seeds {first} on. Recovered: tilt below {:.0} degrees and speed below {CALM_SPEED} wing lengths a beat for {CALM_BEATS} wingbeats.",
        recoveries.len(),
        CALM_TILT.to_degrees()
    );
    line!(
        report,
        "\n  {:<14}{:>8}{:>18}{:>16}{:>12}{:>20}",
        "tilt at start",
        "flights",
        "recovered",
        "beats, median",
        "90 %",
        "strayed, median"
    );
    let mut rows = vec![];
    let mut from = 0.0;
    for to in CLASSES {
        let within = |r: &&Recovery| (from..to).contains(&r.tilt.to_degrees());
        let share = Share::of(recoveries.iter().filter(within).collect());
        rows.extend(row(
            report,
            &format!("{from:.0} to {to:.0} deg"),
            &share,
            length,
        ));
        from = to;
    }
    let all = Share::of(recoveries.iter().collect());
    rows.extend(row(report, "all", &all, length));
    report.value("tumbles", rows);
    let flight = |(k, r): (usize, &Recovery)| {
        json!({
            "seed": first.wrapping_add(k as u64),
            "tilt_rad": r.tilt,
            "rate_rad_per_s": r.rate,
            "beats": r.beats,
            "strayed_m": r.strayed,
        })
    };
    let flights: Vec<Value> = recoveries.iter().enumerate().map(flight).collect();
    report.value("flights", flights);
}

fn row(report: &mut Report, name: &str, share: &Share<'_>, length: f64) -> Option<Value> {
    if share.all.is_empty() {
        return None;
    }
    let [part, error] = share.recovered();
    let [median, most] = [0.5, 0.9].map(|q| share.quantile(q));
    let strayed = share.strayed(length);
    let whole = |x: Option<usize>| x.map_or("-".to_owned(), |x| x.to_string());
    line!(
        report,
        "  {name:<14}{:>8}{:>18}{:>16}{:>12}{:>20}",
        share.all.len(),
        format!("{:.1} +- {:.1} %", 100.0 * part, 100.0 * error),
        whole(median),
        whole(most),
        strayed.map_or("-".to_owned(), |x| format!("{x:.1} wing lengths"))
    );
    Some(json!({
        "tilt": name,
        "flights": share.all.len(),
        "recovered": part,
        "recovered_standard_error": error,
        "beats_median": median,
        "beats_90_percent": most,
        "strayed_median_wing_lengths": strayed,
    }))
}
