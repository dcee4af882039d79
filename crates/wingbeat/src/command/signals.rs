//! Ctrl-C, SIGTERM and hang-up: the first ends a flight after its step, a second one at once.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
#[cfg(unix)]
use std::sync::atomic::Ordering;

use signal_hook::consts::{SIGINT, SIGTERM};

use crate::command::failure::INTERRUPTED;
use crate::command::terminal::tell;

/// Set by the first signal. Signals that are ignored when the program starts stay ignored:
/// `nohup wingbeat run` outlives its terminal, `wingbeat run &` in a script the Ctrl-C meant for
/// another program.
pub(crate) fn stop_flag() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    if let Err(e) = watch(Arc::clone(&stop)) {
        tell!("warning: Ctrl-C will not end the run cleanly ({e})");
    }
    stop
}

#[cfg(unix)]
fn watch(stop: Arc<AtomicBool>) -> std::io::Result<()> {
    let mut signals = signal_hook::iterator::Signals::new(heeded())?;
    std::thread::spawn(move || {
        for _ in signals.forever() {
            if stop.swap(true, Ordering::SeqCst) {
                wingbeat::case::external::end_all();
                std::process::exit(i32::from(INTERRUPTED));
            }
        }
    });
    Ok(())
}

#[cfg(not(unix))]
fn watch(stop: Arc<AtomicBool>) -> std::io::Result<()> {
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
