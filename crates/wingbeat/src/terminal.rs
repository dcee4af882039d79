//! Standard output and standard error.
//!
//! A print that fails stops no work: a flight goes on when nobody can be told of it. The first
//! failure is kept, nothing more is printed there, and [`close`] turns it into the exit code. Only
//! a reader who has seen enough (`wingbeat show DIR | head -1`) is no failure.

use std::fmt::Arguments;
use std::io::{self, ErrorKind, Write};
use std::sync::{Mutex, PoisonError};

/// Exit code of a command whose work is done, but whose words are lost.
const UNSAID: u8 = 1;

static OUTPUT: Stream = Stream(Mutex::new(None));
static ERRORS: Stream = Stream(Mutex::new(None));

/// A stream and why it is given up.
struct Stream(Mutex<Option<ErrorKind>>);

impl Stream {
    /// Prints by `print` unless the stream is given up.
    fn print(&self, print: impl FnOnce() -> io::Result<()>) {
        let mut lost = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if lost.is_none() {
            *lost = print().err().map(|e| e.kind());
        }
    }

    /// The failure that nobody wanted.
    fn failure(&self) -> Option<ErrorKind> {
        let lost = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        lost.filter(|kind| *kind != ErrorKind::BrokenPipe)
    }
}

/// A line on the standard output, as `println!` but without its panic.
macro_rules! say {
    ($($text:tt)*) => {
        $crate::terminal::output(format_args!("{}\n", format_args!($($text)*)))
    };
}

/// A line on the standard error, as `eprintln!` but without its panic.
macro_rules! tell {
    ($($text:tt)*) => {
        $crate::terminal::errors(format_args!("{}\n", format_args!($($text)*)))
    };
}

pub(crate) use {say, tell};

/// Prints on the standard output.
pub(crate) fn output(text: Arguments<'_>) {
    OUTPUT.print(|| io::stdout().write_fmt(text));
}

/// Prints on the standard error.
pub(crate) fn errors(text: Arguments<'_>) {
    ERRORS.print(|| io::stderr().write_fmt(text));
}

/// Help, version, or what is wrong with the command line; its exit code.
pub(crate) fn usage(message: &clap::Error) -> u8 {
    let stream = if message.use_stderr() {
        &ERRORS
    } else {
        &OUTPUT
    };
    stream.print(|| message.print());
    u8::try_from(message.exit_code()).unwrap_or(2)
}

/// The last word: the exit code of a command that ended with `code`.
pub(crate) fn close(code: u8) -> u8 {
    OUTPUT.print(|| io::stdout().flush());
    let lost = OUTPUT.failure().map(|kind| ("output", kind));
    let lost = lost.or(ERRORS.failure().map(|kind| ("error", kind)));
    match lost {
        Some((stream, kind)) => {
            tell!(
                "error: the standard {stream} cannot be written: {kind}; files are not touched by this"
            );
            code.max(UNSAID)
        }
        None => code,
    }
}
