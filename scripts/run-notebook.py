"""Runs a page of docs/notebooks as a notebook, in its folder: `python scripts/run-notebook.py PAGE...`. Needs jupytext, nbclient and
ipykernel. An error in a cell ends it with that error."""

import sys
import time
from pathlib import Path

import jupytext
from nbclient import NotebookClient


def run(page: Path) -> None:
    """Runs all cells of the page."""
    notebook = jupytext.read(page)
    resources = {"metadata": {"path": str(page.parent)}}
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources=resources).execute()


if __name__ == "__main__":
    for name in sys.argv[1:]:
        begun = time.monotonic()
        run(Path(name))
        print(f"{name}: {time.monotonic() - begun:.1f} s")
