"""The command `forgetting`."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence

NEEDED = ("typer", "rich", "pandas")
"""What the command cannot start without; the rest is asked for where it is used."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code: 0, or 2 with one sentence on stderr.

    Ctrl-C ends it with exit code 130, as a shell expects.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command line without the program's name; ``sys.argv`` when absent.
    """
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        needs = " and ".join(missing)
        advice = "install it with pip install 'forgetting[cli]'"
        print(f"forgetting: the command needs {needs}; {advice}.", file=sys.stderr)
        return 2
    try:
        from forgetting.cli.app import run
    except KeyboardInterrupt:
        print("forgetting: stopped.", file=sys.stderr)
        return 130
    return run(list(sys.argv[1:] if arguments is None else arguments))
