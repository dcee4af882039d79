//! Work beside the interpreter: the thread that called waits, looks for signals and reports progress.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use pyo3::prelude::*;

use crate::errors::broken;
use crate::threads::within;

/// How often signals are looked for.
const PERIOD: Duration = Duration::from_millis(40);
/// How long work that was told to stop may take before it is left to itself.
const PATIENCE: Duration = Duration::from_millis(120);

/// What work and the waiting thread know of each other.
#[derive(Default)]
pub struct Watch {
    stop: AtomicBool,
    done: AtomicUsize,
}

impl Watch {
    /// `done` parts are done; whether to stop.
    pub fn reached(&self, done: usize) -> bool {
        self.done.store(done, Ordering::Relaxed);
        self.stop.load(Ordering::Relaxed)
    }
}

/// What came of work, and what interrupted it: a signal or the progress callback.
pub struct Worked<T> {
    /// None where it was to stop and did not in time, or was not waited for.
    pub result: Option<T>,
    /// The exception that ended it.
    pub interrupted: Option<PyErr>,
}

/// Does `work` within the pool of threads while Python goes on, and calls `progress(done, of)` meanwhile. A
/// signal stops it: work that is `patient` (it writes files) is then waited for until another signal comes, other work
/// for a moment only.
pub fn work<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<(&Py<PyAny>, usize)>,
    patient: bool,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<Worked<T>> {
    let watch = Arc::new(Watch::default());
    let (sender, results) = channel();
    let results = Mutex::new(results);
    let of_work = Arc::clone(&watch);
    std::thread::spawn(move || {
        // Within the pool: handing it work from outside wakes a thread for every sum.
        if let Ok(result) = within(|| rayon::scope(|_| work(&of_work))) {
            let _ = sender.send(result); // nobody waits for it any more
        }
    });
    let interrupted = loop {
        match py.detach(|| receive(&results, PERIOD)) {
            Ok(result) => {
                // A signal of the last moment, too: Python would raise it elsewhere, and the result were lost.
                let go_on = py.check_signals().and_then(|()| tell(py, progress, &watch));
                return Ok(Worked {
                    result: Some(result),
                    interrupted: go_on.err(),
                });
            }
            Err(RecvTimeoutError::Disconnected) => return Err(broken()),
            Err(RecvTimeoutError::Timeout) => {}
        }
        let go_on = py.check_signals().and_then(|()| tell(py, progress, &watch));
        if let Err(e) = go_on {
            break e;
        }
    };
    watch.stop.store(true, Ordering::Relaxed);
    let result = match patient {
        true => finished(py, &results),
        false => py.detach(|| receive(&results, PATIENCE).ok()),
    };
    Ok(Worked {
        result,
        interrupted: Some(interrupted),
    })
}

/// What work that was told to stop has when it has ended; none where another signal says not to wait for it.
fn finished<T: Send>(py: Python<'_>, results: &Mutex<Receiver<T>>) -> Option<T> {
    loop {
        match py.detach(|| receive(results, PERIOD)) {
            Err(RecvTimeoutError::Timeout) if py.check_signals().is_ok() => {}
            result => return result.ok(),
        }
    }
}

/// Waits for the result, for so long at most.
fn receive<T>(results: &Mutex<Receiver<T>>, most: Duration) -> Result<T, RecvTimeoutError> {
    let results = results.lock().unwrap_or_else(PoisonError::into_inner);
    results.recv_timeout(most)
}

fn tell(py: Python<'_>, progress: Option<(&Py<PyAny>, usize)>, watch: &Watch) -> PyResult<()> {
    if let Some((callback, of)) = progress {
        callback.call1(py, (watch.done.load(Ordering::Relaxed), of))?;
    }
    Ok(())
}

/// Does `work`, an analysis that cannot be stopped half-way; a signal leaves it to itself.
pub fn analyse<T: Send + 'static>(
    py: Python<'_>,
    task: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let worked = work(py, None, false, |_| task())?;
    match (worked.interrupted, worked.result) {
        (Some(e), _) => Err(e),
        (None, Some(result)) => Ok(result),
        (None, None) => Err(broken()),
    }
}
