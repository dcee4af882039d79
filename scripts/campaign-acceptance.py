#!/usr/bin/env python3
"""What campaigns promise, measured by hand: scripts/campaign-acceptance.py WINGBEAT [points kills plan status lattice].

kills    10,000 points in blade elements: two masters on one range with two workers each, two shards and a full
         disk, 50 kill -9 of random workers and masters; merged files equal those of one undisturbed worker
plan     a table of a million points: time and memory
rate     points a second of two workers over those of two plain loops, which take turns
lattice  64 points of the fruit fly in the vortex lattice, workers killed within points
"""
import hashlib, os, random, resource, signal, subprocess, sys, tempfile, time
from pathlib import Path

W = str(Path(sys.argv[1]).resolve())
MOUNTS = []
WHAT = sys.argv[2:] or ["plan", "kills", "rate", "lattice"]
FILES = ["points.csv", "points.parquet", "points.nc", "failed.csv"]
BLADE = """case = "fruit-fly-blade"
keep = ["lift_over_weight", "power_watt", "end.mass_centre_n3_m"]
samples = %d
seed = 3
[set]
"time.beats" = 1
"time.steps_per_beat" = 40
[budget]
attempts = 20
[parameter."motion.frequency_hz"]
range = { from = 180, to = 220, count = 10 }
[parameter."body.mass_kg"]
normal = { mean = 0.93e-6, standard_deviation = 0.05e-6 }
"""
LATTICE = """case = "fruit-fly-hover"
keep = ["lift_over_weight", "power_watt", "air_body_force_n1_newton"]
[set]
"time.beats" = 1.0
"wing.right.mesh.spanwise" = 4
"wing.right.mesh.chordwise" = 2
"output.checkpoint_every" = 5
[budget]
attempts = 50
[parameter."motion.frequency_hz"]
range = { from = 190, to = 220, count = 8 }
[parameter."motion.adjust.stroke_amplitude"]
range = { from = -0.05, to = 0.05, count = 8 }
"""


def children(pid):
    text = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(x) for x in text.split()]


def merged(folder, file, out):
    subprocess.run([W, "campaign", "merge", file, "--out", out], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return {f: hashlib.sha256((folder / out / f).read_bytes()).hexdigest() for f in FILES}


def master(folder, file, out, *more, limit=None):
    def before():
        if limit:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    return subprocess.Popen([W, "campaign", "run", file, "--out", out, "--quiet", *more], cwd=folder, preexec_fn=before, stderr=subprocess.PIPE, text=True)


def killed(folder, file, out, kills, parts, pause, full_disk):
    """Runs with random kills until all is done; what was killed."""
    random.seed(5)
    masters = [None] * len(parts)
    count = {"workers": 0, "masters": 0}
    codes = []
    if full_disk:
        full(folder, file, out)
    while True:
        for k, part in enumerate(parts):
            if masters[k] is None:
                masters[k] = master(folder, file, out, "--jobs", "2", *part)
        time.sleep(pause * random.random())
        living = [m for m in masters if m and m.poll() is None]
        if sum(count.values()) < kills and living:
            m = random.choice(living)
            workers = children(m.pid)
            if workers and random.random() < 0.7:
                victim, kind = random.choice(workers), "workers"
            else:
                victim, kind = m.pid, "masters"
            try:
                os.kill(victim, signal.SIGKILL)
                count[kind] += 1
            except ProcessLookupError:
                pass
        for k, m in enumerate(masters):
            if m and m.poll() is not None and m.returncode != 0:
                codes.append(m.returncode)
                masters[k] = None
        if all(m and m.poll() == 0 for m in masters):
            return count


def full(folder, file, out):
    """A disk of 2 MB, full in the middle of the campaign; then there is space again. Without the right to mount: files
    that may not grow."""
    (folder / out).mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m,nr_inodes=1000000", "tmpfs", folder / out], stderr=subprocess.DEVNULL).returncode == 0
    if not mounted:
        assert master(folder, file, out, "--points", "0..5").wait() == 0
    m = master(folder, file, out, limit=None if mounted else 64)
    code, said = m.wait(), m.stderr.read().splitlines()[:1]
    flown = sum(1 for p in (folder / out / "points").rglob("*.ok"))
    half = [p for p in (folder / out).rglob("*.part")]
    print(f"  {'a full disk' if mounted else 'files may not grow'} after {flown} points: exit code {code}, {said}, {len(half)} half-written files", flush=True)
    assert code == 1 and not half
    if mounted:
        MOUNTS.append(folder / out)
        subprocess.run(["mount", "-o", "remount,size=2g", folder / out], check=True)


def compare(name, folder, text, kills, parts, pause, full_disk=False):
    file = f"{name}.toml"
    (folder / file).write_text(text)
    begun = time.time()
    assert master(folder, file, "serial", "--jobs", "1").wait() == 0
    serial = time.time() - begun
    begun = time.time()
    count = killed(folder, file, "disturbed", kills, parts, pause, full_disk)
    took = time.time() - begun
    a, b = merged(folder, file, "serial"), merged(folder, file, "disturbed")
    status = subprocess.run([W, "campaign", "status", file, "--out", "disturbed"], cwd=folder, capture_output=True, text=True).stdout
    print(f"{name}: serial {serial:.1f} s, disturbed {took:.1f} s with {count} killed; {status.strip()}")
    for f in FILES:
        print(f"  {f}: {'the same bytes' if a[f] == b[f] else 'DIFFERENT'}")
    begun = time.time()
    subprocess.run([W, "campaign", "status", file, "--out", "disturbed"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    first = time.time() - begun
    begun = time.time()
    assert master(folder, file, "disturbed").wait() == 0
    print(f"  finished: status {first:.2f} s, run again {time.time() - begun:.2f} s")
    assert a == b


def plan(folder):
    (folder / "million.toml").write_text(BLADE % 100_000)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begun = time.time()
    child = subprocess.Popen([W, "campaign", "plan", "million.toml", "--out", "million.csv"], cwd=folder, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    assert status == 0
    lines = sum(1 for _ in open(folder / "million.csv"))
    print(f"plan: {lines - 1} points in {time.time() - begun:.2f} s ({used.ru_utime + used.ru_stime:.2f} s of processor), {used.ru_maxrss / 1024:.0f} MB")


def used():
    r = resource.getrusage(resource.RUSAGE_CHILDREN)
    return r.ru_utime + r.ru_stime


def rate(folder):
    """Two workers beside two plain loops over the same flights, in turns: ratio of rates, by the clock and by processor
    time, which other programs on the machine disturb less."""
    (folder / "rate.toml").write_text(BLADE % 300)
    loop = Path(W).parent / "examples" / "campaign_loop"
    clock, processor = [], []
    for k in range(4):
        begun, before = time.time(), used()
        loops = [subprocess.Popen([str(loop), "rate.toml", str(j), "2"], cwd=folder, stdout=subprocess.DEVNULL) for j in range(2)]
        assert all(p.wait() == 0 for p in loops)
        plain = [time.time() - begun, used() - before]
        begun, before = time.time(), used()
        assert master(folder, "rate.toml", f"rate-{k}", "--jobs", "2").wait() == 0
        own = [time.time() - begun, used() - before]
        clock.append(plain[0] / own[0])
        processor.append(plain[1] / own[1])
        print(f"  3,000 points: loops {plain[0]:.2f} s ({plain[1]:.2f} s of processor), workers {own[0]:.2f} s ({own[1]:.2f} s), ratio {clock[-1]:.3f} ({processor[-1]:.3f})", flush=True)
    median = lambda x: sorted(x)[len(x) // 2]
    print(f"rate: median ratio {median(clock):.3f} by the clock, {median(processor):.3f} by processor time")


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    try:
        if "plan" in WHAT:
            plan(folder)
        if "kills" in WHAT:
            parts = [[], [], ["--shard", "1/2"], ["--shard", "2/2"]]
            compare("kills", folder, BLADE % 1000, 50, parts, 0.8, full_disk=True)
        if "rate" in WHAT:
            rate(folder)
        if "lattice" in WHAT:
            compare("lattice", folder, LATTICE, 20, [[]], 2.0)
    finally:
        for mount in MOUNTS:
            subprocess.run(["umount", mount], check=False)
