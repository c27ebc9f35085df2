"""Speed of `forgetting` beside its peers: `python -m benchmarks [--quick] [--only single,calls]`.

Prints Markdown. All sides of a table get the same data, in one process, and take turns; every
time is the least of many turns. Read ratios.
"""

from __future__ import annotations

from . import environment  # isort: skip  # noqa: F401

import argparse
import time

from . import (
    calls,
    fleet,
    levels,
    limits,
    live,
    machine,
    memory,
    peers,
    resetting,
    rules,
    single,
    tables,
    variable_direction,
)
from .ledger import Ledger
from .plan import SIZES, Plan

PARTS = {
    "machine": machine,
    "limits": limits,
    "single": single,
    "levels": levels,
    "peers": peers,
    "rules": rules,
    "resetting": resetting,
    "variable_direction": variable_direction,
    "calls": calls,
    "live": live,
    "memory": memory,
    "fleet": fleet,
    "tables": tables,
}


def title(part: object) -> str:
    """The first line of a part's documentation."""
    return str(part.__doc__).splitlines()[0].rstrip(".")


def arguments() -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer turns, sizes and peers")
    parser.add_argument("--only", default=",".join(PARTS), help="some of: %(default)s")
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)), help="some of: %(default)s")
    asked = parser.parse_args()
    if unknown := set(asked.only.split(",")) - set(PARTS):
        parser.error(f"--only {', '.join(sorted(unknown))}, allowed: {', '.join(PARTS)}")
    return asked


def main() -> None:
    """Print the report."""
    asked = arguments()
    plan = Plan(asked.quick, tuple(int(n) for n in asked.sizes.split(",")))
    ledger, start = Ledger(), time.monotonic()
    print("# Speed of forgetting\n")
    for name in asked.only.split(","):
        print(f"## {title(PARTS[name])}\n", flush=True)
        for text in PARTS[name].report(plan, ledger):
            print(text, flush=True)
        print()
    for text in ledger.report():
        print(text)
    print(f"\nMeasured in {time.monotonic() - start:.0f} s.")


if __name__ == "__main__":
    main()
