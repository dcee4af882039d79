//! The pool of threads of this process. A process that is a fork of another has none of its threads, but believes that
//! it has: work handed to them would wait for ever. So forks have a pool of their own.

use std::process;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// The process whose threads the common pool has: the one that loaded this module.
static FIRST: OnceLock<u32> = OnceLock::new();
/// The pool of a fork, and whose it is.
static OWN: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Takes down which process loaded this module.
pub fn begin() {
    FIRST.get_or_init(process::id);
}

/// The pool of this process; none where the common one is.
fn own() -> Result<Option<Arc<ThreadPool>>, ThreadPoolBuildError> {
    let id = process::id();
    if *FIRST.get_or_init(|| id) == id {
        return Ok(None);
    }
    let mut own = OWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((of, pool)) = &*own
        && *of == id
    {
        return Ok(Some(Arc::clone(pool)));
    }
    let pool = Arc::new(ThreadPoolBuilder::new().build()?);
    // The pool of the process that was forked is not dropped: that would wait for its threads.
    std::mem::forget(own.replace((id, Arc::clone(&pool))));
    Ok(Some(pool))
}

/// Does `work` where the sums within it find threads of this process.
pub fn within<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, ThreadPoolBuildError> {
    Ok(match own()? {
        Some(pool) => pool.install(work),
        None => work(),
    })
}

/// The same beside the interpreter.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| within(work))
        .map_err(|e| PyRuntimeError::new_err(e.to_string()))
}
