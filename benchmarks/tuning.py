"""Does tuning pay, and does `subspace` beat the bank? On the records of `benchmarks.accuracy`.

    python -m benchmarks.tuning               # records inside the packages that `make demo` needs
    python -m benchmarks.tuning FOLDER        # a folder of records, .csv or .parquet

Everything is chosen on the first two thirds of a record and scored on the rest. A number is the
error over that of the bank; beside it whether that is a win or a loss by the test of Diebold and
Mariano at 5 %, or a tie.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import forgetting as fg

from .accuracy_records import Problem, of_folder, packaged

COLUMNS = {"tuned": {}, "tuned, all rules": {"rules": "all"}} | {
    rule: {"rules": rule, "rates": False, "priors": False}
    for rule in ("subspace", "exponential", "random_walk", "none")
}
"""What is tried, and the arguments of `fg.tune` that try it."""


def outcome(found: fg.Tuning) -> tuple[str, str]:
    """The error over that of the bank, and what the test calls it."""
    difference = found.rest.differences.get("bank")
    if difference is None:
        return "failed", "failed"
    word = "tie"
    if difference.beyond_chance:
        word = "win" if difference.ratio < 1 else "loss"
    return f"{difference.ratio:.3f} {word}", word


def report(problems: Iterator[Problem]) -> Iterator[str]:
    """The lines of the table."""
    yield "| record | chosen | " + " | ".join(COLUMNS) + " |"
    yield "|---|---|" + "---|" * len(COLUMNS)
    counts: dict[str, Counter[str]] = {name: Counter() for name in COLUMNS}
    for record, phi, y in problems:
        cells, rule = [], ""
        for name, settings in COLUMNS.items():
            found = fg.tune(phi, y, **settings)
            rule = rule or found.python.partition("rule=")[2].replace("fg.", "")[:-1]
            cell, word = outcome(found)
            cells.append(cell)
            counts[name][word] += 1
        yield f"| {record} | `{rule}` | {' | '.join(cells)} |"
    told = (", ".join(f"{n} {word}" for word, n in count.items()) for count in counts.values())
    yield f"| all | | {' | '.join(told)} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, nargs="?")
    asked = parser.parse_args()
    problems = packaged() if asked.folder is None else of_folder(asked.folder, None)
    for line in report(problems):
        print(line, flush=True)


if __name__ == "__main__":
    main()
