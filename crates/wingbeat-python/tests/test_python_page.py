"""Blocks of docs/python.md run as they are printed, one after the other: a script in an empty folder."""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap
from pathlib import Path

PAGE = (Path(__file__).parents[3] / "docs" / "python.md").read_text(encoding="utf-8")
LONG, SHORTER = '"time.beats": 3', '"time.beats": 1'
"""What is made shorter, so that it takes seconds."""


def test_behaves_blocks_run_in_order(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    assert len(blocks) > 5
    code = "\n".join(f"{block}print({k})" for k, block in enumerate(blocks))
    assert code.count(LONG) == 1, "it is not on the page any more"
    code = code.replace(LONG, SHORTER)
    script = "if __name__ == '__main__':  # processes of campaigns read it again\n" + textwrap.indent(code, "    ")
    (tmp_path / "page.py").write_text(script, encoding="utf-8")
    command = [sys.executable, "page.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-3000:]
    assert done.stdout.splitlines()[-1] == str(len(blocks) - 1), done.stdout
    assert (tmp_path / "results" / "python" / "summary.json").is_file() and (tmp_path / "fly.mat").is_file()


def test_balances_the_battery_of_the_page_on_motors(tmp_path):
    page = (Path(__file__).parents[3] / "docs" / "motors.md").read_text(encoding="utf-8")
    (tmp_path / "motor.toml").write_text(re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)[0], encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    fly = 'import wingbeat\nwingbeat.Flight.from_case("motor.toml").fly(out="motor")\n'
    command = [sys.executable, "-c", fly + block]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-3000:]
    assert done.stdout.startswith("0.536 W, of it 0.068 W heat"), done.stdout
