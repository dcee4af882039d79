//! The programs of others that a case runs.

use wingbeat::case::LoadedCase;

use crate::command::output::terminal::tell;

/// Says which programs of the case are going to run, before they do: they run with the user's rights.
pub(crate) fn name_program(case: &LoadedCase) {
    if let Some(program) = case.program() {
        tell!(
            "{}: the air is computed by another program, which runs with your rights: {program}",
            case.name
        );
    }
    let program = case.control_program();
    if let Some(program) = program.filter(|_| case.setup.feedback.is_some()) {
        tell!(
            "{}: the wings are commanded by another program, which runs with your rights: {program}",
            case.name
        );
    }
}
