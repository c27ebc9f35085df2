"""How accurate is an estimator that was told nothing, beside the best that could have been chosen?

    python -m benchmarks.accuracy FOLDER        # a folder of records, .csv or .parquet

Each record is an ARX model of its last column on the others, two past outputs, two of each input
and an offset; or, with --formula, any model. For each: the root mean square of the one-step errors
from a tenth of the record on, over that of the best of a grid of rules, factors and priors, with
every column scaled to unit mean square (hindsight: scale and grid see the whole record). Peers run
at their defaults, on the columns as they are.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import forgetting as fg
from forgetting.record.identify import build
from forgetting.record.read import read

Array = NDArray[np.float64]
Candidate = Callable[[Array, Array], Array]

FACTORS = (0.8, 0.9, 0.95, 0.97, 0.98, 0.99, 0.995, 0.998, 0.999, 0.9995)
PRIORS = (1e2, 1e4, 1e8)
SUFFIXES = (".csv", ".parquet")


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
    """What is told nothing: ours, and peers that are installed."""
    found: dict[str, Candidate] = {
        "fg.Bank(n)": lambda phi, y: errors(fg.Bank(phi.shape[1]), phi, y),
        "fg.RLS(n)": lambda phi, y: errors(fg.RLS(phi.shape[1]), phi, y),
        "no forgetting": lambda phi, y: errors(fg.RLS(phi.shape[1], rule="none"), phi, y),
        "exponential 0.99": lambda phi, y: errors(fg.RLS(phi.shape[1], rule="exponential"), phi, y),
        "last value": lambda phi, y: np.concatenate([[0.0], np.diff(y)]),
    }
    try:
        import padasip  # type: ignore[import-not-found,unused-ignore]
    except ImportError:
        return found
    found["padasip FilterRLS"] = lambda phi, y: np.asarray(
        padasip.filters.FilterRLS(phi.shape[1]).run(y, phi)[1]
    )
    return found


def problems(folder: Path, formula: str | None) -> Iterator[tuple[str, Array, Array]]:
    """Regressors and output of each record of a folder."""
    for path in sorted(p for p in folder.iterdir() if p.suffix in SUFFIXES):
        record = read(path)
        names = [str(name) for name in record.frame.columns]
        if record.clock is not None:
            names.remove(record.clock.name)
        if formula is None:
            samples = build(record, None, [names[-1]], names[:-1], (2, 2, 1))
        else:
            samples = build(record, formula, [], [], None)
        complete = samples.complete
        yield path.stem, samples.phi[complete], samples.y[complete, 0]


def report(folder: Path, formula: str | None = None) -> Iterator[str]:
    """The lines of a table."""
    chosen = candidates()
    yield "| record | " + " | ".join(chosen) + " |"
    yield "|---|" + "---|" * len(chosen)
    ratios = []
    for name, phi, y in problems(folder, formula):
        best = hindsight(phi, y)
        ratios.append([rms(run(phi, y)) / best for run in chosen.values()])
        yield f"| {name} | " + " | ".join(f"{ratio:.3f}" for ratio in ratios[-1]) + " |"
    if ratios:
        mean = np.exp(np.mean(np.log(ratios), axis=0))
        worst = np.max(ratios, axis=0)
        yield "| geometric mean | " + " | ".join(f"{ratio:.3f}" for ratio in mean) + " |"
        yield "| worst | " + " | ".join(f"{ratio:.3f}" for ratio in worst) + " |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("--formula", help="one model for all records, in place of ARX")
    asked = parser.parse_args()
    for line in report(asked.folder, asked.formula):
        print(line, flush=True)


if __name__ == "__main__":
    main()
