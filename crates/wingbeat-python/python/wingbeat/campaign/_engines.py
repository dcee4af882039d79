"""Engines: processes of one's own, the calling process, Ray."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import TYPE_CHECKING, Any

from wingbeat.campaign import _task
from wingbeat._packages import needs
from wingbeat.errors import CaseError, FlightError

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor

_STARTS = 3
"""How often a pool is started before it is given up."""


class Serial(Executor):
    """The calling process, one point after the other."""

    _max_workers = 1

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Calls it now."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as e:
            future.set_exception(e)
        return future


class Processes(Executor):
    """Processes of this machine, one thread each: a ``ProcessPoolExecutor`` that is started again when a process of it dies.

    ``workers`` is their number, by default that of the processors this process may use. They are started by the fork server
    where there is one, so nothing of this program's memory goes with them; functions come from modules.
    """

    def __init__(self, workers: int | None = None) -> None:
        if workers is not None and (isinstance(workers, bool) or not isinstance(workers, int) or not 1 <= workers <= 4096):
            raise CaseError(f"workers = {workers!r}: no number of processes", key="workers", remedy="1 to 4096")
        self._max_workers = workers or available()
        self._pool: ProcessPoolExecutor | None = None
        self._lock = threading.Lock()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Hands it to the pool; to a new one where the last has died."""
        with self._lock:
            while True:
                if self._pool is None:
                    self._pool = self._started()
                future = _handed(self._pool, fn, args, kwargs)
                if future is not None:
                    return future
                _end(self._pool)
                self._pool = None

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends the processes when what was handed to them is done; the next ``submit`` starts new ones."""
        with self._lock:
            pool, self._pool = self._pool, None
        if pool is not None and getattr(pool, "_broken", False):
            _end(pool)
        elif pool is not None:
            pool.shutdown(wait=wait, cancel_futures=cancel_futures)

    def stop(self) -> None:
        """Ends the processes at once."""
        with self._lock:
            pool, self._pool = self._pool, None
        if pool is not None:
            _end(pool)

    def _started(self) -> ProcessPoolExecutor:
        """A pool that has a process that runs. One may be killed while it starts; several are no accident."""
        from concurrent.futures import BrokenExecutor, ProcessPoolExecutor

        for remaining in reversed(range(_STARTS)):
            pool = ProcessPoolExecutor(self._max_workers, mp_context=_context(), initializer=_begin)
            try:
                pool.submit(os.getpid).result()
                return pool
            except (BrokenExecutor, OSError, EOFError) as e:  # the last two: the fork server was killed
                _end(pool)
                if not remaining:
                    raise FlightError(
                        f"worker processes end before they fly anything: {e}",
                        key="executor",
                        remedy="in a script, put what is to run once under `if __name__ == '__main__':`; is there memory left?",
                    ) from e
        raise AssertionError


def _handed(pool: ProcessPoolExecutor, fn: Callable[..., Any], args: Any, kwargs: Any) -> Future[Any] | None:
    """The future of a call, None if the pool has died. A pool that dies while it is handed something may forget it (CPython
    3.11), so this looks again afterwards.
    """
    from concurrent.futures import BrokenExecutor

    try:
        future = pool.submit(fn, *args, **kwargs)
    except (BrokenExecutor, OSError, EOFError):
        return None
    return None if getattr(pool, "_broken", False) else future


def _end(pool: ProcessPoolExecutor) -> None:
    """Ends the processes of a pool at once. One that it was starting when it died would be waited for, for ever."""
    processes = list((getattr(pool, "_processes", None) or {}).values())
    pool.shutdown(wait=False, cancel_futures=True)
    for process in processes:
        process.kill()


class Ray(Executor):
    """Ray as an executor: tasks of one processor each on the cluster that ``ray.init`` has found or started.

    ``options`` are those of ``ray.remote(...).options``, e.g. ``num_cpus=0.5``.
    """

    def __init__(self, **options: Any) -> None:
        needs("ray", "engines", "executor")
        import ray

        if not ray.is_initialized():
            raise CaseError("executor: Ray is not connected", key="executor", remedy="call ray.init() before")
        self._ray = ray
        self._options = {"num_cpus": 1} | options
        self._calls: dict[Callable[..., Any], Any] = {}
        each = float(self._options["num_cpus"]) or 1.0
        self._max_workers = max(1, int(ray.cluster_resources().get("CPU", 1) / each))

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Starts a task."""
        if fn not in self._calls:
            self._calls[fn] = self._ray.remote(fn).options(**self._options)
        future: Future[Any] = self._calls[fn].remote(*args, **kwargs).future()
        return future


def engine(executor: Any, workers: int | None) -> tuple[Executor, bool]:
    """The executor that was meant, and whether it was made here."""
    if executor is None:
        return Processes(workers), True
    if isinstance(executor, type):
        raise _no_executor(executor, f"an instance: {executor.__name__}()")
    if hasattr(executor, "get_executor"):  # a client of Dask
        executor = executor.get_executor()
    if not callable(getattr(executor, "submit", None)):
        raise _no_executor(executor, "Processes(), Serial() or Ray() of wingbeat.campaign, or any concurrent.futures.Executor")
    return executor, False


def capacity(executor: Any, workers: int | None) -> int:
    """Batches that run at a time."""
    if workers is not None:
        return workers
    known = getattr(executor, "_max_workers", None)
    if isinstance(known, int) and known > 0:
        return int(known)
    client = getattr(executor, "_client", None)  # of Dask
    if client is not None and hasattr(client, "nthreads"):
        return max(1, sum(int(threads) for threads in client.nthreads().values()))
    return available()


def available() -> int:
    """Processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _no_executor(executor: Any, remedy: str) -> CaseError:
    return CaseError(f"executor = {executor!r}: no executor", key="executor", remedy=remedy)


def _context() -> Any:
    import multiprocessing

    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["wingbeat.campaign"])
    return context


def _begin() -> None:
    """In a new process: one thread, Ctrl-C is the master's, and no life without it."""
    import multiprocessing

    _task.one_thread()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    master = multiprocessing.parent_process()

    def follow() -> None:
        if master is not None:
            master.join()
            os._exit(1)

    threading.Thread(target=follow, daemon=True).start()
