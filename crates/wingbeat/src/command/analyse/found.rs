//! What is reported of a trim.

use serde_json::{Map, Value, json};
use wingbeat::analysis::wake::WakeTrim;
use wingbeat::analysis::{Trim, TrimProblem, Unknown};
use wingbeat::case::LoadedCase;
use wingbeat::model::motion::Adjustment;
use wingbeat::results::fixed::signed;

use crate::command::report::{Report, line};

/// What is reported of a trim of either kind.
pub(crate) struct Found {
    pub(crate) converged: bool,
    pub(crate) residual: Vec<f64>,
    pub(crate) iterations: usize,
    pub(crate) adjustment: Adjustment,
    pub(crate) mass_centre: f64,
    pub(crate) body_pitch: f64,
}

impl From<&Trim> for Found {
    fn from(t: &Trim) -> Self {
        Self {
            converged: t.converged,
            residual: t.residual.clone(),
            iterations: t.iterations,
            adjustment: t.adjustment,
            mass_centre: t.mass_centre,
            body_pitch: t.body_pitch,
        }
    }
}

impl From<&WakeTrim> for Found {
    fn from(t: &WakeTrim) -> Self {
        Self {
            converged: t.converged,
            residual: t.residual.to_vec(),
            iterations: t.iterations,
            adjustment: t.adjustment,
            mass_centre: t.mass_centre,
            body_pitch: t.body_pitch,
        }
    }
}

/// Names of the residuals: in words, and for programs.
const RESIDUALS: [[&str; 2]; 6] = [
    ["force forward / weight", "force_forward_over_weight"],
    ["force down / weight", "force_down_over_weight"],
    [
        "pitch moment / (weight R)",
        "pitch_moment_over_weight_and_length",
    ],
    ["pitch per beat [rad]", "pitch_per_beat_rad"],
    [
        "drift forward / R per beat",
        "drift_forward_over_length_per_beat",
    ],
    ["drift down / R per beat", "drift_down_over_length_per_beat"],
];

/// The trim.
pub(super) fn tell(report: &mut Report, case: &LoadedCase, problem: &TrimProblem, t: &Found) {
    let (forward, up) = (problem.velocity.x, 0.0 - problem.velocity.z);
    line!(
        report,
        "{}: trim to {forward:.3} m/s forward, {up:.3} m/s up",
        case.name
    );
    let has_control = case.raw.control.is_some();
    if has_control {
        line!(report, "of the open loop: [control] is left out");
    }
    report.value("control_left_out", has_control);
    let verdict = if t.converged {
        "trimmed"
    } else {
        "NOT trimmed; the best point found"
    };
    let largest = t.residual.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
    line!(
        report,
        "{verdict} after {} Newton steps, largest residual {largest:.1e}",
        t.iterations
    );
    for u in problem.unknowns {
        line!(report, "  {:<18}{}", u.name(), value(u, t).0);
    }
    for ([name, _], r) in RESIDUALS.iter().zip(&t.residual) {
        line!(report, "  residual of {name:<28}{r:>10.1e}");
    }
    let residuals = RESIDUALS.iter().zip(&t.residual);
    let mut residuals: Map<String, Value> = residuals
        .map(|([_, key], r)| ((*key).to_owned(), json!(r)))
        .collect();
    if let Some(joints) = t.residual.get(RESIDUALS.len()..).filter(|j| !j.is_empty()) {
        let largest = joints.iter().fold(0.0_f64, |m, r| m.max(r.abs()));
        line!(
            report,
            "  residual of {:<28}{largest:>10.1e}",
            "free joints, largest"
        );
        residuals.insert("free_joints_largest".to_owned(), json!(largest));
    }
    report.value("case", case.name.as_str());
    report.value("forward_m_s", forward);
    report.value("climb_m_s", up);
    report.value("converged", t.converged);
    report.value("newton_steps", t.iterations);
    report.value("unknowns", values(&problem.unknowns, t));
    report.value("residuals", residuals);
}

/// What was found of the unknowns, units in the names.
pub(super) fn values(unknowns: &[Unknown], t: &Found) -> Map<String, Value> {
    let one = |u: &Unknown| {
        let (_, unit, value) = value(*u, t);
        (format!("{}{unit}", u.name()), json!(value))
    };
    unknowns.iter().map(one).collect()
}

/// An unknown in words; the unit its name ends with for programs, and the value in it.
fn value(u: Unknown, t: &Found) -> (String, &'static str, f64) {
    let a = &t.adjustment;
    let degrees = |x: f64| {
        let x = x.to_degrees();
        (format!("{} deg", signed(x, 4)), "_deg", x)
    };
    let part = |x: f64| (format!("{} %", signed(100.0 * x, 3)), "_change_relative", x);
    match u {
        Unknown::StrokeAmplitude => part(a.stroke_amplitude),
        Unknown::StrokeOffset => degrees(a.stroke_offset),
        Unknown::Frequency => part(a.frequency),
        Unknown::StrokePlane => degrees(a.stroke_plane),
        Unknown::FeatheringOffset => degrees(a.feathering_offset),
        Unknown::FeatheringLead => {
            let x = a.feathering_lead;
            (format!("{} wingbeats", signed(x, 5)), "_wingbeats", x)
        }
        Unknown::DeviationOffset => degrees(a.deviation_offset),
        Unknown::BodyPitch => degrees(t.body_pitch),
        Unknown::MassCentre => {
            let x = t.mass_centre;
            (
                format!("{} mm forward", signed(1e3 * x, 4)),
                "_forward_m",
                x,
            )
        }
    }
}
