"""Models whose noise is not white: errors of the recursion beside those of the batch estimate.

python -m benchmarks.coloured [SEEDS]    100 seeds of 3000 samples if not said

Bias and root-mean-square error of each coefficient, by rule, over the same seeds for all. The batch
estimate minimises the same squared prediction errors over the whole record, begun at the truth.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np

import forgetting as fg

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from reference.polynomial import SYSTEMS, batch, record

SEEDS = 100
MODELS: dict[str, Any] = {
    "arma": lambda rule: fg.ARMA(na=1, nc=1, rule=rule),
    "armax": lambda rule: fg.ARMAX(na=2, nb=2, nc=2, rule=rule),
    "oe": lambda rule: fg.OE(nb=2, nf=2, rule=rule),
    "bj": lambda rule: fg.BJ(nb=2, nc=1, nd=1, nf=2, rule=rule),
}
RULES: dict[str, Any] = {
    "none": "none",
    "bank": "auto",
    "exponential 0.998": fg.Exponential(0.998),
}


def estimates(name: str, seeds: int) -> dict[str, Any]:
    """Errors of the estimates, (seeds, n), by method."""
    system, found = SYSTEMS[name], {method: [] for method in ("batch", *RULES)}
    for seed in range(seeds):
        u, y = record(system, seed)
        found["batch"].append(batch(system, u, y) - system.theta)
        for label, rule in RULES.items():
            found[label].append(MODELS[name](rule).fit(u, y).theta_ - system.theta)
    return {method: np.array(errors) for method, errors in found.items()}


def main(seeds: int) -> None:
    """Print a table for each system."""
    for name in MODELS:
        found = estimates(name, seeds)
        reference = np.sqrt(np.mean(found["batch"] ** 2, axis=0))
        print(f"{name}, {seeds} seeds: bias, rms error, and that over the batch's")
        for method, errors in found.items():
            spread = np.sqrt(np.mean(errors**2, axis=0))
            ratio = spread / reference
            print(f"  {method:18s} {errors.mean(axis=0).round(4)} {spread.round(4)}", end="")
            print(f" {ratio.min():.2f} to {ratio.max():.2f}", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else SEEDS)
