//! A trimmed flight as a case file.

use std::io::Write;
use std::path::Path;

use wingbeat_analysis::Trim;
use wingbeat_math::EulerSequence;

use super::LoadedCase;
use super::raw::{Mode, StartCase};
use crate::error::IoError;

/// The case of a trimmed flight as TOML: the given case with the adjusted wing motion, hinges and
/// the state of the body at the start of the periodic beat, impulsively started.
pub fn trimmed_case(case: &LoadedCase, trim: &Trim) -> String {
    let mut raw = case.raw.clone();
    let a = &trim.adjustment;
    let motion = &mut raw.motion;
    let adjust = &mut motion.adjust;
    adjust.stroke_amplitude = (1.0 + adjust.stroke_amplitude) * (1.0 + a.stroke_amplitude) - 1.0;
    adjust.stroke_offset_deg += a.stroke_offset.to_degrees();
    adjust.feathering_amplitude =
        (1.0 + adjust.feathering_amplitude) * (1.0 + a.feathering_amplitude) - 1.0;
    adjust.feathering_offset_deg += a.feathering_offset.to_degrees();
    adjust.feathering_lead += a.feathering_lead;
    adjust.deviation_offset_deg += a.deviation_offset.to_degrees();
    adjust.stroke_plane_deg += a.stroke_plane.to_degrees();
    motion.frequency_hz = motion.frequency_hz.map(|f| f * (1.0 + a.frequency));
    motion.start = StartCase::Impulsive;
    for hinge in raw.wing.values_mut().filter_map(|w| w.hinge_m.as_mut()) {
        hinge[0] -= trim.mass_centre / raw.animal.scale;
    }
    let root = trim.beat.root(&trim.state);
    let angles = EulerSequence::BODY_231.angles(root.r);
    let flight = &mut raw.flight;
    flight.mode = Mode::Free;
    flight.tether = None;
    flight.held_beats = 0.0;
    flight.pitch_deg = angles.x.to_degrees();
    flight.yaw_deg = angles.y.to_degrees();
    flight.roll_deg = angles.z.to_degrees();
    flight.velocity_m_s = root.v.to_array();
    flight.angular_velocity_deg_s = root.w.to_array().map(f64::to_degrees);
    let body = toml::to_string(&raw).expect("a case that was read can be written");
    format!(
        "# `{}`, trimmed: largest residual {:.1e} of weight, weight times wing length, radian and\n# wing length per beat.\n{body}",
        case.name,
        trim.error()
    )
}

/// Writes `text` to a file that does not exist yet.
///
/// # Errors
/// An existing file, or one that cannot be written.
pub fn write_new(path: &Path, text: &str) -> Result<(), IoError> {
    let created = std::fs::File::create_new(path);
    let mut out = created.map_err(|e| match e.kind() {
        std::io::ErrorKind::AlreadyExists => IoError::Exists {
            path: path.to_owned(),
            remedy: "name another file",
        },
        _ => IoError::write(path)(e),
    })?;
    out.write_all(text.as_bytes()).map_err(IoError::write(path))
}
