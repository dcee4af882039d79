//! Ctrl-C, SIGTERM and hang-up: the first ends a flight after its step, a second one at once. While a flight is
//! being built, its controller laid out, the first ends the program: nothing is written yet.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};

use crate::command::output::failure::INTERRUPTED;
use crate::command::output::terminal::tell;

/// What the first signal sets. Signals that are ignored when the program starts stay ignored:
/// `nohup wingbeat run` outlives its terminal, `wingbeat run &` in a script the Ctrl-C meant for
/// another program.
#[derive(Clone, Default)]
pub(crate) struct Interrupts {
    stop: Arc<AtomicBool>,
    is_built: Arc<AtomicBool>,
    /// What follows the first signal before the report, where that may take a while.
    finishes: Option<&'static str>,
}

impl Interrupts {
    /// From now on; until [`Self::flight_is_built`] a signal ends the program at once.
    pub(crate) fn while_building() -> Self {
        Self::default().watched()
    }

    fn watched(self) -> Self {
        if let Err(e) = watch(self.clone()) {
            tell!("warning: Ctrl-C will not end the run cleanly ({e})");
        }
        self
    }

    /// The flight is there, and is written from now on: signals end it after its step.
    pub(crate) fn flight_is_built(&self) {
        self.is_built.store(true, Ordering::SeqCst);
    }

    /// Set by the first signal.
    pub(crate) fn stop(&self) -> &AtomicBool {
        &self.stop
    }
}

/// Set by the first signal, for work in parts that may take a while: what becomes of those under way, in words
/// (`this speed is finished`), and what is done is reported.
pub(crate) fn stop_flag_after(part: &'static str) -> Arc<AtomicBool> {
    let interrupts = Interrupts {
        finishes: Some(part),
        ..Interrupts::default()
    };
    interrupts.flight_is_built();
    interrupts.watched().stop
}

/// Set by the first signal, for what is begun already.
pub(crate) fn stop_flag() -> Arc<AtomicBool> {
    let interrupts = Interrupts::while_building();
    interrupts.flight_is_built();
    interrupts.stop
}

#[cfg(unix)]
fn watch(interrupts: Interrupts) -> std::io::Result<()> {
    let mut signals = signal_hook::iterator::Signals::new(heeded())?;
    std::thread::spawn(move || {
        for _ in signals.forever() {
            let is_built = interrupts.is_built.load(Ordering::SeqCst);
            if !is_built {
                tell!("interrupted before the flight began: nothing is written");
            }
            if interrupts.stop.swap(true, Ordering::SeqCst) || !is_built {
                wingbeat::case::external::end_all();
                std::process::exit(i32::from(INTERRUPTED));
            }
            if let Some(part) = interrupts.finishes {
                tell!(
                    "interrupted: {part}, and what is done is reported; a second Ctrl-C ends it at once"
                );
            }
        }
    });
    Ok(())
}

/// From here on a file that grows beyond what is allowed (`ulimit -f`) is an error of writing, as a full disk is.
pub(crate) fn bear_limits_of_files() {
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::signal::SIGXFSZ, Arc::default());
}

#[cfg(not(unix))]
fn watch(Interrupts { stop, .. }: Interrupts) -> std::io::Result<()> {
    for signal in [SIGINT, SIGTERM] {
        let code = i32::from(INTERRUPTED);
        signal_hook::flag::register_conditional_shutdown(signal, code, Arc::clone(&stop))?;
        signal_hook::flag::register(signal, Arc::clone(&stop))?;
    }
    Ok(())
}

/// Signals that end the flight. Which ones are ignored only Linux tells without unsafe code;
/// elsewhere a hang-up, which is the one ignored in practice, is left to the system.
#[cfg(unix)]
fn heeded() -> Vec<i32> {
    let status = std::fs::read_to_string("/proc/self/status").ok();
    match status.and_then(|text| ignored(&text)) {
        Some(mask) => {
            let all = [SIGINT, SIGTERM, signal_hook::consts::SIGHUP].into_iter();
            all.filter(|signal| mask >> (signal - 1) & 1 == 0).collect()
        }
        None => vec![SIGINT, SIGTERM],
    }
}

/// The mask of ignored signals in the text of `/proc/self/status`; bit 0 is signal 1.
#[cfg(unix)]
fn ignored(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|l| l.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(line.trim(), 16).ok()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn exact_mask_of_ignored_signals() {
        let status = "Name:\twingbeat\nSigBlk:\t0000000000000000\nSigIgn:\t0000000000001001\n";
        assert_eq!(ignored(status), Some(0x1001)); // SIGHUP (1) and SIGPIPE (13)
        assert_eq!(ignored("Name:\tx\n"), None);
    }
}
