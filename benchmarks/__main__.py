"""Speed of `forgetting` beside its peers: `python -m benchmarks [--quick]`. Prints Markdown."""

from __future__ import annotations

from . import environment, single  # isort: skip

import argparse


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    quick = parser.parse_args().quick
    print(f"Threads: {environment.THREADS}\n")
    for text in single.report(1.0 if quick else 5.0):
        print(text, flush=True)


if __name__ == "__main__":
    main()
