"""The directory of a campaign file, flown by any engine.

Workers of engines run the same worker process as ``wingbeat campaign run``: points are leased, and a point is flown once,
whoever works in the directory beside them. So a campaign may be begun on one engine and ended on another.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
import uuid
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from pathlib import Path
from typing import Any

from wingbeat import _paths
from wingbeat.campaign import _engines
from wingbeat.errors import CaseError, FlightError

_PARTS = 8
"""Parts of the campaign for each worker: small enough that all workers end together."""
_INTERRUPTED = 130
_PERIOD_S = 0.5


def run(
    file: str | os.PathLike[str],
    executor: Executor | None = None,
    *,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    attempts: int = 3,
) -> dict[str, int]:
    """Flies a campaign file on an engine, into the directory that ``wingbeat campaign run`` would use.

    ``out`` is that directory (results/NAME, by ``name`` in the file or that of the file); all workers must see it and the file
    by the same paths. ``executor`` and ``workers`` are those of :func:`wingbeat.campaign.map`. Points that are done are not flown
    again; a part of the points whose worker dies is handed out again, in a row ``attempts`` times at most without a point more
    being done. Returns how many ``points`` there are, how many are ``done`` and how many of those ``failed``.
    ``wingbeat campaign merge FILE`` makes the tables.
    """
    path = Path(_paths.path("file", file)).absolute()  # names beside a link are relative to the link
    kept = "results" if out is None else _paths.path("out", out)
    folder = Path(kept).absolute() / _name(path) if out is None else Path(kept).absolute()
    if isinstance(attempts, bool) or not isinstance(attempts, int) or attempts < 1:
        raise CaseError(f"attempts = {attempts!r}: no count", key="attempts", remedy="1 or more")
    _begin(path, folder)
    used, is_made_here = _engines.engine(executor, workers)
    try:
        _fly(path, folder, used, _engines.capacity(used, workers), attempts)
    except BaseException:
        if is_made_here and isinstance(used, _engines.Processes):
            used.stop()
        raise
    if is_made_here:
        used.shutdown()
    return _status(path, folder)


def _name(path: Path) -> str:
    """The name of a campaign; of a file that cannot be read, which is told later, that of the file."""
    try:
        name = tomllib.loads(path.read_text(encoding="utf-8")).get("name")
    except (OSError, ValueError):
        name = None
    return name if isinstance(name, str) else path.stem


def _begin(path: Path, folder: Path) -> None:
    """Flies the first point here: what is wrong with file or directory is told before anything is handed out, and results
    that are damaged, or lack the files that are kept, are found.
    """
    words = ["run", str(path), "--out", str(folder), "--points", "0..1", "--jobs", "1", "--quiet", "--inspect"]
    done = subprocess.run(_command(words), capture_output=True, text=True)
    if done.returncode == 2:
        raise CaseError(done.stderr.strip(), key="file", remedy=f"wingbeat campaign check {path}")
    _check(done.returncode, done.stderr)


def _status(path: Path, folder: Path) -> dict[str, int]:
    status = _told(path, folder)
    return {name: int(status[name]) for name in ("points", "done", "failed")}


def _told(path: Path, folder: Path) -> dict[str, Any]:
    done = subprocess.run(_command(["status", str(path), "--out", str(folder), "--json"]), capture_output=True, text=True)
    _check(done.returncode, done.stderr)
    status: dict[str, Any] = json.loads(done.stdout)
    return status


def work(path: str, folder: str, points: str, plan: str, call: str) -> int:
    """In a worker of an engine: a worker process, which ends with this one. Its exit code; 0 and 130 are no failure.

    ``plan`` is that of the file as it was when the campaign began; ``call`` differs from call to call: Dask takes equal calls for one.
    """
    words = ["work", path, "--out", folder, "--points", points, "--plan", plan]
    with subprocess.Popen(
        _command(words), stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stderr is not None
        said = process.stderr.read()
        code = process.wait()
    if code > 0:
        _check(code, said)
    return code


def _fly(path: Path, folder: Path, executor: Executor, workers: int, attempts: int) -> None:
    """Hands out parts until each has ended well."""
    begun = _told(path, folder)
    count, plan = int(begun["points"]), str(begun["plan"])
    parts = min(count, _PARTS * workers)
    waiting = [f"{count * k // parts}..{count * (k + 1) // parts}" for k in range(parts)]
    waiting.reverse()
    flying: dict[Future[Any], str] = {}
    losses, done = 0, 0
    while waiting or flying:
        while waiting and len(flying) < 2 * workers:
            part = waiting.pop()
            flying[_submitted(executor, (str(path), str(folder), part, plan, uuid.uuid4().hex))] = part
        for future in wait(flying, timeout=_PERIOD_S, return_when=FIRST_COMPLETED).done:
            part = flying.pop(future)
            error = future.exception()
            if isinstance(error, FlightError):
                raise error
            ended = f"it ended with code {future.result()}" if error is None else f"{type(error).__name__}: {error}"
            if error is None and future.result() == 0:
                losses = 0
                continue
            waiting.append(part)
            losses += 1
            if losses > attempts * workers:
                now = _status(path, folder)["done"]
                if now == done:
                    raise FlightError(
                        f"{losses} worker processes died one after the other before they did a point; the last: {ended}",
                        key="executor",
                        remedy="look whether the engine still runs and its workers have memory; the same call goes on",
                    )
                losses, done = 0, now


def _submitted(executor: Executor, arguments: tuple[str, ...]) -> Future[Any]:
    try:
        return executor.submit(work, *arguments)
    except BrokenExecutor as e:
        raise FlightError(
            f"the executor is broken: {e}",
            key="executor",
            remedy="executor=None, or wingbeat.campaign.Processes(), which start processes again when one dies",
        ) from e


def _command(words: list[str]) -> list[str]:
    return [sys.executable, "-m", "wingbeat", "campaign", *words]


def _check(code: int, said: str) -> None:
    if code not in (0, _INTERRUPTED):
        raise FlightError(
            said.strip() or f"the worker process ended with code {code}",
            key="file",
            remedy="what is done is kept: when that is mended, the same call goes on",
        )
