//! What came of flights out of random tumbles, as a table.

use serde_json::{Value, json};
use wingbeat::analysis::Trim;
use wingbeat::analysis::episode::{CALM_BEATS, CALM_SPEED, CALM_TILT, Recoveries, Recovery};

use crate::command::output::report::{Report, line};

/// Upper ends of the classes of tilt at the start, degrees: beyond 1.2 rad about each of three axes there are none.
const CLASSES: [f64; 4] = [30.0, 60.0, 90.0, 120.0];

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
        let class = Recoveries::of(recoveries.iter().filter(within).collect());
        rows.extend(row(
            report,
            &format!("{from:.0} to {to:.0} deg"),
            &class,
            length,
        ));
        from = to;
    }
    let all = Recoveries::of(recoveries.iter().collect());
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

fn row(report: &mut Report, name: &str, class: &Recoveries<'_>, length: f64) -> Option<Value> {
    if class.is_empty() {
        return None;
    }
    let [part, error] = class.recovered();
    let [median, most] = [0.5, 0.9].map(|q| class.beats(q));
    let strayed = class.strayed().map(|x| x / length);
    let whole = |x: Option<usize>| x.map_or("-".to_owned(), |x| x.to_string());
    line!(
        report,
        "  {name:<14}{:>8}{:>18}{:>16}{:>12}{:>20}",
        class.len(),
        format!("{:.1} +- {:.1} %", 100.0 * part, 100.0 * error),
        whole(median),
        whole(most),
        strayed.map_or("-".to_owned(), |x| format!("{x:.1} wing lengths"))
    );
    Some(json!({
        "tilt": name,
        "flights": class.len(),
        "recovered": part,
        "recovered_standard_error": error,
        "beats_median": median,
        "beats_90_percent": most,
        "strayed_median_wing_lengths": strayed,
    }))
}
