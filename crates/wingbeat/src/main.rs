//! The wingbeat command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(wingbeat::command::main(std::env::args_os()))
}
