"""Pages of docs/notebooks run as notebooks, and the example that learns."""

from __future__ import annotations

import runpy
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGES = sorted((ROOT / "docs" / "notebooks").glob("*.md"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_behaves_page_runs(page):
    command = [sys.executable, ROOT / "scripts" / "run-notebook.py", page]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-3000:]


def test_behaves_a_policy_that_learned_flies_longer_than_none():
    """Of 30 wingbeats: 27.7 to 28.7 for three seeds of the search; half of the way from no control to the regulator is asked
    for.
    """
    example = runpy.run_path(str(ROOT / "crates" / "wingbeat-python" / "examples" / "learn_to_hover.py"))
    short = {"beats": 30, "flights": 2, "test": 16}
    regulator, none = example["baselines"](test=16, beats=30)
    (judged,) = example["learn"](20, judge_every=20, **short)
    assert regulator.mean() > 29.5
    assert judged.mean > 0.5 * (none.mean() + regulator.mean())


def test_behaves_learning_repeats_itself():
    example = runpy.run_path(str(ROOT / "crates" / "wingbeat-python" / "examples" / "learn_to_hover.py"))
    twice = [list(example["learn"](2, judge_every=1, beats=10, flights=1, test=8)) for _ in range(2)]
    first, again = [[judged._replace(core_seconds=0) for judged in curve] for curve in twice]
    assert first == again and len(first) == 2
