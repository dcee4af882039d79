"""The command line: ``wingbeat`` and ``python -m wingbeat``."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Does what the command line says; the exit code."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        # The program answers Ctrl-C itself: it saves the state of the flight.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from wingbeat import _core

    return _core.main(["wingbeat", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
