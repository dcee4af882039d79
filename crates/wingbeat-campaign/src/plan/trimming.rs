//! What is asked of the trim at a point.

use wingbeat_analysis::{
    AnalysisError, SPEED_OF_SOUND, TRIM_STEPS, Trim, TrimRequest, UNKNOWNS, Unknown, trim_within,
};
use wingbeat_case::{Document, IoError, nearest};
use wingbeat_flight::FlightSetup;
use wingbeat_math::DVec3;

use crate::plan::Plan;
use crate::plan::raw::{RawCampaign, Task, TrimOptions};

/// Beginning of the keys that are options of the trim and not keys of the case.
pub const TRIM: &str = "trim.";

/// Options that may be parameters, as `trim.forward_m_s`.
pub const OPTIONS: [&str; 5] = [
    "forward_m_s",
    "climb_m_s",
    "sideslip_m_s",
    "turn_rate_deg_s",
    "steps_per_beat",
];

fn allowed_steps() -> String {
    let [least, most] = TRIM_STEPS;
    format!("a whole number from {least} to {most}")
}

/// Checks the options themselves, and that the air can be trimmed in.
///
/// # Errors
/// The first that cannot be used.
pub fn check(document: &Document, raw: &RawCampaign, setup: &FlightSetup) -> Result<(), IoError> {
    if !raw.tasks.contains(&Task::Trim) {
        return Ok(());
    }
    if setup.has_memory() {
        let bent = if setup.animal.is_elastic() {
            " with wings that loads bend"
        } else {
            ""
        };
        let wakes = if setup.air.has_strip_wakes() {
            " with wakes of its strips"
        } else {
            ""
        };
        let problem = format!(
            "in this air ({}){wakes}{bent} a trim seeks a periodic orbit, and campaigns do not trim there",
            setup.air.name()
        );
        let remedy = "set air.model = \"blade_element\" in [set], leave air.blade.unsteady out and take rigid wings, or trim point by point with `wingbeat trim`";
        return Err(document
            .fault("do", problem, "trim in air without memory", remedy)
            .into());
    }
    let names: Vec<&str> = UNKNOWNS.iter().map(|u| u.1).collect();
    let unknowns = raw.trim.iter().flat_map(|t| t.unknowns.iter().flatten());
    for (k, name) in unknowns.enumerate() {
        if !names.contains(&name.as_str()) {
            let remedy = match nearest(name, &names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "choose from these".to_owned(),
            };
            let place = format!("trim.unknowns[{k}]");
            return Err(document
                .fault(
                    &place,
                    format!("unknown choice `{name}`"),
                    names.join(", "),
                    remedy,
                )
                .into());
        }
    }
    Ok(())
}

/// An option that cannot be used: its name, what is wrong, what is allowed, what to try.
pub struct Bad {
    /// Key, as `trim.forward_m_s`.
    pub key: String,
    /// What is wrong.
    pub problem: String,
    /// What is allowed.
    pub allowed: String,
    /// What to try.
    pub remedy: &'static str,
}

/// The options at point `i`.
///
/// # Errors
/// A value that cannot be used.
pub fn options(raw: &RawCampaign, plan: &Plan, i: usize) -> Result<TrimOptions, Bad> {
    let mut options = raw.trim.clone().unwrap_or_default();
    for (key, value) in plan.keys().iter().zip(plan.values(i)) {
        let Some(name) = key.strip_prefix(TRIM) else {
            continue;
        };
        let number = value.number().ok_or_else(|| Bad {
            key: key.clone(),
            problem: format!("`{}` is no number", value.shown()),
            allowed: "a number".to_owned(),
            remedy: "give numbers",
        })?;
        match name {
            "forward_m_s" => options.forward_m_s = Some(number),
            "climb_m_s" => options.climb_m_s = Some(number),
            "sideslip_m_s" => options.sideslip_m_s = Some(number),
            "turn_rate_deg_s" => options.turn_rate_deg_s = Some(number),
            _ => options.steps_per_beat = Some(whole(key, number)?),
        }
    }
    check_options(&options)?;
    Ok(options)
}

/// A number of steps without a fraction; one that is too large for any is refused with the others out of range.
fn whole(key: &str, number: f64) -> Result<usize, Bad> {
    match number.fract() == 0.0 {
        true => Ok(number as usize),
        false => Err(Bad {
            key: key.to_owned(),
            problem: format!("{number} has a fraction"),
            allowed: allowed_steps(),
            remedy: "give whole numbers, by a list or a range",
        }),
    }
}

fn check_options(options: &TrimOptions) -> Result<(), Bad> {
    let speeds = [
        ("forward_m_s", options.forward_m_s),
        ("climb_m_s", options.climb_m_s),
        ("sideslip_m_s", options.sideslip_m_s),
    ];
    for (name, speed) in speeds {
        if let Some(speed) = speed.filter(|v| v.abs() >= SPEED_OF_SOUND) {
            return Err(Bad {
                key: format!("{TRIM}{name}"),
                problem: format!("{speed:?} m/s is no speed below that of sound"),
                allowed: format!("a speed between -{SPEED_OF_SOUND} and {SPEED_OF_SOUND}"),
                remedy: "the air is incompressible: choose a lower speed",
            });
        }
    }
    match options
        .steps_per_beat
        .filter(|s| !(TRIM_STEPS[0]..=TRIM_STEPS[1]).contains(s))
    {
        None => Ok(()),
        Some(steps) => Err(Bad {
            key: format!("{TRIM}steps_per_beat"),
            problem: format!("{steps} steps per wingbeat"),
            allowed: allowed_steps(),
            remedy: "100 is the default",
        }),
    }
}

/// Trims a flight, its feedback left out.
///
/// # Errors
/// What the analysis does not cover; why no steady flight was found.
pub fn trim(setup: &FlightSetup, options: &TrimOptions) -> Result<Trim, AnalysisError> {
    let mut open = setup.clone();
    open.feedback = None;
    let number = |x: Option<f64>| x.unwrap_or(0.0);
    let named = |names: &Vec<String>| names.iter().filter_map(|n| Unknown::from_name(n)).collect();
    let request = TrimRequest {
        velocity: DVec3::new(
            number(options.forward_m_s),
            number(options.sideslip_m_s),
            -number(options.climb_m_s),
        ),
        turn_rate: number(options.turn_rate_deg_s).to_radians(),
        unknowns: options.unknowns.as_ref().map(named),
        bounds: vec![],
        steps: options.steps_per_beat,
    };
    let trim = trim_within(&open, &request.problem(&open)?)?;
    match trim.solution.is_as_asked() {
        true => Ok(trim),
        false => Err(AnalysisError::Numbers(format!(
            "no steady flight was found: residual {:.1e} after {} Newton steps",
            trim.solution.error(),
            trim.solution.iterations
        ))),
    }
}
