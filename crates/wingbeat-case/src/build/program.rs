//! Programs that are asked during a flight: `[air.external]` and `[control.external]`.

use std::time::Duration;

use crate::build::fault::Built;
use crate::error::Fault;
use crate::external::Program;
use crate::raw::ExternalCase;

/// Longest wait for an answer [s]: a month or so.
const MAX_TIMEOUT: f64 = 3e6;

/// The program of the table `path`, which `chosen` asks for; its protocol stands on `page`.
pub(super) fn program(
    case: Option<&ExternalCase>,
    path: &str,
    chosen: &str,
    page: &str,
) -> Built<Program> {
    let Some(external) = case else {
        return Err(Fault::new(
            format!("{path}.command"),
            format!("{chosen} needs a program to ask"),
            "[\"PROGRAM\", \"ARGUMENT\", ...]",
            format!("the protocol is described in {page}"),
        ));
    };
    if external.timeout_s > MAX_TIMEOUT {
        return Err(Fault::new(
            format!("{path}.timeout_s"),
            "this is longer than any program is waited for",
            format!("a number > 0, at most {MAX_TIMEOUT:e}"),
            "600 is the default",
        ));
    }
    Ok(Program {
        command: external.command.clone(),
        timeout: Duration::from_secs_f64(external.timeout_s),
    })
}
