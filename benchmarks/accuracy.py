"""How accurate is an estimator that was told nothing, beside the best that could have been chosen?

    python -m benchmarks.accuracy               # records inside the packages that `make demo` needs
    python -m benchmarks.accuracy FOLDER        # a folder of records, .csv or .parquet

Each record of a folder is an ARX model of its last column on the others, two past outputs, two of
each input and an offset; or, with --formula, any model. For each: the root mean square of the
one-step errors from a tenth of the record on, over that of the best of a grid of rules, factors and
priors, with every column scaled to unit mean square (hindsight: scale and grid see the whole
record). Peers run at their defaults, on the columns as they are. One that is not installed is
named; one that fails on a record has there how it failed in place of a number.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import forgetting as fg

from .accuracy_peers import PEERS
from .accuracy_records import Problem, of_folder, packaged

Array = NDArray[np.float64]
Candidate = Callable[[Array, Array], Array]

FACTORS = (0.8, 0.9, 0.95, 0.97, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995)
PRIORS = (1e2, 1e4, 1e8)


def grid(prior: float) -> Iterator[object]:
    """The rules that hindsight chooses among."""
    yield fg.rule("none")
    for factor in FACTORS:
        yield fg.rule("exponential", forgetting_factor=factor)
        yield fg.rule("exponential_resetting", forgetting_factor=factor, information=1 / prior)
        yield fg.rule("subspace", forgetting_factor=factor)
    for power in range(-10, 5):
        yield fg.rule("random_walk", process_noise=10.0**power)


def errors(estimator: fg.RLS | fg.Bank, phi: Array, y: Array) -> Array:
    """One-step errors, (T,)."""
    return np.asarray(estimator.run(phi, y, outputs=("error",)).error).reshape(-1)


def rms(error: Array) -> float:
    """Root mean square from a tenth on; infinite if anything is not finite."""
    value = float(np.sqrt(np.mean(np.square(error[len(error) // 10 :]))))
    return value if np.isfinite(value) else np.inf


def hindsight(phi: Array, y: Array) -> float:
    """The least error of the grid."""
    scale = np.sqrt(np.maximum(np.mean(phi**2, axis=0), 1e-300))
    least = np.inf
    for prior in PRIORS:
        for rule in grid(prior):
            estimator = fg.RLS(phi.shape[1], rule=rule, initial_covariance=prior)  # type: ignore[arg-type]
            try:
                least = min(least, rms(errors(estimator, phi / scale, y)))
            except (fg.NumericalRange, fg.InvalidInput):
                continue
    return least


def candidates() -> dict[str, Candidate]:
    """What is told nothing: ours, and peers that are installed; one row is told the best factor."""
    found: dict[str, Candidate] = {
        "`Bank(n)`": lambda phi, y: errors(fg.Bank(phi.shape[1]), phi, y),
        "`RLS(n)`": lambda phi, y: errors(fg.RLS(phi.shape[1]), phi, y),
        "no forgetting": lambda phi, y: errors(fg.RLS(phi.shape[1], rule="none"), phi, y),
        "exponential 0.99": lambda phi, y: errors(fg.RLS(phi.shape[1], rule="exponential"), phi, y),
        "exponential, λ in hindsight": best_exponential,
        "last value": lambda phi, y: np.concatenate([[0.0], np.diff(y)]),
    }
    return found | {name: run for name, (package, run) in PEERS.items() if find_spec(package)}


def best_exponential(phi: Array, y: Array) -> Array:
    """Exponential forgetting with the factor that is best on this very record."""
    tried = []
    for factor in FACTORS:
        try:
            estimator = fg.RLS(phi.shape[1], rule=fg.rule("exponential", forgetting_factor=factor))
            tried.append(errors(estimator, phi, y))
        except fg.NumericalRange:
            continue
    return min(tried, key=rms)


def ratio(run: Candidate, phi: Array, y: Array, best: float) -> tuple[float, str]:
    """The error over the best of hindsight, infinite where it fails, and how."""
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            found = rms(run(phi, y)) / best
    except Exception as error:
        # whatever a peer raises is its result
        return np.inf, type(error).__name__
    return found, "" if np.isfinite(found) else "not finite"


def report(problems: Iterator[Problem]) -> Iterator[str]:
    """The lines of two tables: record by record, and what it comes to."""
    chosen = candidates()
    for name, (package, _) in PEERS.items():
        if name not in chosen:
            yield f"not installed: {package}, so no {name}"
    yield "| record | samples | n | " + " | ".join(chosen) + " |"
    yield "|---|---|---|" + "---|" * len(chosen)
    rows = []
    for name, phi, y in problems:
        best = hindsight(phi, y)
        found = [ratio(run, phi, y, best) for run in chosen.values()]
        rows.append([value for value, _ in found])
        cells = " | ".join(failed or number(value) for value, failed in found)
        yield f"| {name} | {len(y)} | {phi.shape[1]} | {cells} |"
    yield from summary(list(chosen), np.array(rows).reshape(-1, len(chosen)))


def number(value: float) -> str:
    """Three decimals, or the order of magnitude."""
    return f"{value:.3f}" if value < 1000 else f"{value:.1e}"


def summary(names: list[str], ratios: Array) -> Iterator[str]:
    """A line for each candidate: mean and worst, and on how many records it failed."""
    yield "\n| | geometric mean | worst | failed |"
    yield "|---|---|---|---|"
    for name, column in zip(names, ratios.T, strict=True):
        done = column[np.isfinite(column)]
        failed = len(column) - len(done)
        mean = f"{np.exp(np.mean(np.log(done))):.3g}" if len(done) else "-"
        note = f"{mean} on {len(done)} records" if failed else mean
        worst = "no bound" if failed else f"{done.max():.3g}" if len(done) else "-"
        yield f"| {name} | {note} | {worst} | {failed or '-'} |"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--formula", help="one model for all records, in place of ARX")
    asked = parser.parse_args()
    problems = packaged() if asked.folder is None else of_folder(asked.folder, asked.formula)
    for line in report(problems):
        print(line, flush=True)


if __name__ == "__main__":
    main()
