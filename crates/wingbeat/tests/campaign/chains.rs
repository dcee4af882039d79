//! Chains of tasks: trim, modes, power, and the flight of what was trimmed.

use serde_json::Value;

use crate::support::{Scratch, flown, wingbeat};
use crate::{column, merged, numbers, write};

/// A chain of all tasks at two speeds.
const CHAIN: &str = r#"case = "fruit-fly-blade"
do = ["trim", "stability", "power", "run"]
keep = ["trim.stroke_amplitude", "trim.body_pitch_rad", "stability.floquet.1.growth_per_s",
        "stability.averaged.2.frequency_rad_per_s", "stability.derivative.M_q", "power.perfect_storage_watt",
        "lift_over_weight", "summary.forward_m"]
[set]
"time.beats" = 1
[trim]
steps_per_beat = 40
[parameter."trim.forward_m_s"]
list = [0, 0.1]
"#;

/// The numbers of a campaign are those of the commands.
#[test]
fn agrees_trim_stability_and_power_with_their_commands() {
    let scratch = Scratch::new("campaign-chain");
    let dir = &scratch.0;
    write(dir, CHAIN);
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    let own = |name: &str| numbers(dir, "r", name);
    for (k, speed) in ["0", "0.1"].iter().enumerate() {
        let say = |command: &str| -> Value {
            let args = [
                command,
                "fruit-fly-blade",
                "--set",
                "time.beats=1",
                "--steps",
                "40",
                "--forward",
                speed,
                "--json",
            ];
            let out = wingbeat(dir, &args);
            serde_json::from_slice(&out.stdout).unwrap()
        };
        let [stability, power] = ["stability", "power"].map(say);
        let mode = &stability["floquet_modes"][0];
        assert_eq!(
            own("stability.floquet.1.growth_per_s")[k],
            mode["growth_per_s"]
        );
        let mode = &stability["averaged_modes"][1];
        assert_eq!(
            own("stability.averaged.2.frequency_rad_per_s")[k],
            mode["frequency_rad_per_s"]
        );
        let derivative = &stability["derivatives_si_by_u_v_w_p_q_r"][4][4];
        assert_eq!(own("stability.derivative.M_q")[k], *derivative);
        let watt = &power["power"]["perfect_storage"]["watt"];
        assert_eq!(own("power.perfect_storage_watt")[k], *watt);
        // What was trimmed flies: it carries its weight and goes as fast as was asked. The impulse of the air is summed
        // over 40 steps, two of which turn it to the other edge at reversal: measured 8e-5 off.
        assert!(
            (own("lift_over_weight")[k] - 1.0).abs() < 3e-4,
            "{:?}",
            own("lift_over_weight")
        );
        let way = own("summary.forward_m")[k];
        let period = stability["wingbeat_s"].as_f64().unwrap();
        assert!(
            (way / period - speed.parse::<f64>().unwrap()).abs() < 1e-5,
            "{way}"
        );
    }
    assert!(own("trim.stroke_amplitude")[0] != own("trim.stroke_amplitude")[1]);
}

/// Tables say how far each flight can be trusted, and how well its means are known.
#[test]
fn agrees_verdicts_and_errors_with_those_of_the_flights() {
    let scratch = Scratch::new("campaign-verdicts");
    let dir = &scratch.0;
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["lift_over_weight", "error.lift_over_weight", "summary.verdict"]
mean_beats = 3
[set]
"time.beats" = 5
"flight.mode" = "tethered"
[parameter."time.steps_per_beat"]
list = [5, 200]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    let own = |name: &str| numbers(dir, "r", name);
    let mut words = vec![];
    for (k, steps) in [5, 200].into_iter().enumerate() {
        let keys = [
            "time.beats=5".to_owned(),
            "flight.mode=tethered".to_owned(),
            format!("time.steps_per_beat={steps}"),
        ];
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        let run = wingbeat::Flight::preset_with("fruit-fly-blade", &keys)
            .unwrap()
            .fly()
            .unwrap();
        let summary = run.summary();
        let lift = summary.means.unwrap().estimate.lift_over_weight.unwrap();
        assert_eq!(own("lift_over_weight")[k], lift.mean);
        assert_eq!(
            own("error.lift_over_weight")[k],
            lift.standard_error.unwrap()
        );
        assert_eq!(
            own("summary.verdict")[k],
            f64::from(summary.verdict.level())
        );
        words.push(summary.verdict.word().to_owned());
    }
    assert_ne!(words[0], "green", "five steps a beat");
    assert_eq!(column(dir, "r", "verdict"), words);
    let doubtful = words.iter().filter(|w| *w != "green").count();
    let status = wingbeat(
        dir,
        &["campaign", "status", "c.toml", "--out", "r", "--json"],
    );
    let status: Value = serde_json::from_slice(&status.stdout).unwrap();
    let count = |of: &str| status[of].as_u64().unwrap() as usize;
    assert_eq!(count("red") + count("amber"), doubtful);
}

/// Means of a column are those of the history; efficiency is thrust times airspeed over power.
#[test]
fn agrees_means_with_the_history() {
    let scratch = Scratch::new("campaign-means");
    let dir = &scratch.0;
    write(
        dir,
        r#"case = "fruit-fly-blade"
keep = ["body_phi_rad", "min.body_phi_rad", "max.body_phi_rad", "end.body_phi_rad", "efficiency", "thrust_newton", "power_watt"]
mean_beats = 2
[set]
"time.beats" = 3.5
"time.steps_per_beat" = 40
"air.stream_m_s" = [-0.5, 0, 0]
"#,
    );
    flown(dir, &["campaign", "run", "c.toml", "--out", "r", "--quiet"]);
    merged(dir, "r");
    let own = |name: &str| numbers(dir, "r", name)[0];
    let keys = [
        "time.beats=3.5",
        "time.steps_per_beat=40",
        "air.stream_m_s=[-0.5, 0, 0]",
    ];
    let run = wingbeat::Flight::preset_with("fruit-fly-blade", &keys)
        .unwrap()
        .fly()
        .unwrap();
    let history = run.history().unwrap();
    let angle = history.column("body_phi_rad");
    // Steps 40 to 120: the second and the third wingbeat, evenly spaced, half a weight at the ends.
    let mean = (angle[41..120].iter().sum::<f64>() + 0.5 * (angle[40] + angle[120])) / 80.0;
    assert!(
        (own("body_phi_rad") / mean - 1.0).abs() < 1e-12,
        "roundings of 80 terms"
    );
    assert_eq!(own("end.body_phi_rad"), angle[140]);
    // Extremes are of the same wingbeats, not of the start before them nor of the half beat behind them.
    let extremes = |angle: &[f64]| {
        let over = |f: fn(f64, f64) -> f64| angle.iter().copied().reduce(f).unwrap();
        [over(f64::min), over(f64::max)]
    };
    let counted = extremes(&angle[40..=120]);
    assert_eq!(
        ["min", "max"].map(|of| own(&format!("{of}.body_phi_rad"))),
        counted
    );
    assert_ne!(counted, extremes(angle));
    let way = run.records[120].mass_centre.x - run.records[40].mass_centre.x;
    let speed = way / (run.records[120].time - run.records[40].time) + 0.5;
    let wanted = own("thrust_newton") * speed / own("power_watt");
    assert!((own("efficiency") / wanted - 1.0).abs() < 1e-12, "{wanted}");
}
