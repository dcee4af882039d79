"""One campaign on all engines at once: the command line, two shards, Dask and Ray work in one directory while workers and
masters get SIGKILL; the merged files are compared with those of one undisturbed process.

    python campaign_engines.py [POINTS] [KILLS]

needs ``wingbeat[engines]``. Says one line of JSON.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FILE = """case = "fruit-fly-blade"
keep = ["lift_over_weight", "power_watt", "end.mass_centre_n3_m"]
mean_beats = 1
samples = {points}
seed = 3
[set]
"time.beats" = 1
[parameter."motion.frequency_hz"]
uniform = {{ from = 180, to = 220 }}
[parameter."body.mass_kg"]
normal = {{ mean = 0.93e-6, standard_deviation = 0.05e-6 }}
"""
TABLES = ["points.csv", "points.parquet", "points.nc", "failed.csv"]
ENGINE = """import sys
from wingbeat import campaign
if __name__ == "__main__":
    if sys.argv[1] == "dask":
        import dask
        from distributed import Client, LocalCluster
        dask.config.set({"distributed.deploy.lost-worker-timeout": "300s"})
        with LocalCluster(n_workers=2, threads_per_worker=1) as cluster, Client(cluster) as client:
            campaign.run("study.toml", client, out="mixed", attempts=50)
    else:
        import ray
        ray.init(num_cpus=2, include_dashboard=False)
        campaign.run("study.toml", campaign.Ray(max_retries=-1), out="mixed", attempts=50)
"""


def command(*words: str) -> list[str]:
    return [sys.executable, "-m", "wingbeat", "campaign", *words]


def masters() -> dict[str, list[str]]:
    run = ["run", "study.toml", "--out", "mixed", "--jobs", "2", "--quiet"]
    return {
        "processes": command(*run),
        "shard 1/2": command(*run, "--shard", "1/2"),
        "shard 2/2": command(*run, "--shard", "2/2"),
        "dask": [sys.executable, "engine.py", "dask"],
        "ray": [sys.executable, "engine.py", "ray"],
    }


def started(name: str) -> subprocess.Popen[bytes]:
    """A master; what it says goes to a file."""
    with open(name.replace("/", " of ") + ".txt", "ab") as said:
        return subprocess.Popen(masters()[name], stderr=said)


def workers(folder: Path) -> list[int]:
    """Processes that fly points in this directory."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            words = (path / "cmdline").read_bytes().split(b"\0")
            if b"work" in words and b"campaign" in words and os.readlink(path / "cwd") == str(folder):
                found.append(int(path.name))
        except OSError:
            continue
    return found


def main(points: int, kills: int) -> None:
    folder = Path(tempfile.mkdtemp())
    print(f"in {folder}", file=sys.stderr)
    os.chdir(folder)
    Path("study.toml").write_text(FILE.format(points=points))
    Path("engine.py").write_text(ENGINE)
    start = time.monotonic()
    subprocess.run(command("run", "study.toml", "--out", "alone", "--jobs", "1", "--quiet"), check=True)
    alone = time.monotonic() - start

    start = time.monotonic()
    running = {name: started(name) for name in masters()}
    killed = {"workers": 0, "masters": 0}
    chance = random.Random(1)
    while any(p.poll() is None for p in running.values()):
        time.sleep(chance.uniform(0.3, 1.2))
        if sum(killed.values()) >= kills:
            continue
        if chance.random() < 0.3:
            name = chance.choice(["processes", "shard 1/2", "shard 2/2"])
            if running[name].poll() is None:
                running[name].kill()
                running[name].wait()
                killed["masters"] += 1
                running[name] = started(name)
        elif victims := workers(folder):
            try:
                os.kill(chance.choice(victims), signal.SIGKILL)
                killed["workers"] += 1
            except ProcessLookupError:
                pass
    took = time.monotonic() - start
    codes = {name: p.returncode for name, p in running.items()}
    for out in ("alone", "mixed"):
        subprocess.run(command("merge", "study.toml", "--out", out), check=True, capture_output=True)
    same = all(Path("alone", t).read_bytes() == Path("mixed", t).read_bytes() for t in TABLES)
    status = subprocess.run(command("status", "study.toml", "--out", "mixed", "--json"), capture_output=True, check=True)
    print(json.dumps({"same_bytes": same, "killed": killed, "codes": codes, "seconds": took, "alone_s": alone} | json.loads(status.stdout)))


if __name__ == "__main__":
    main(*[int(x) for x in sys.argv[1:3]] or [10_000, 50])
