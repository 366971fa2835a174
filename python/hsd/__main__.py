"""The program hsd: what pip installs as `hsd`, and `python -m hsd`."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> int:
    """Runs the program with the arguments of this process; returns its exit status."""
    # Signals are the program's: Python would answer none before its end.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.main(["hsd", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
