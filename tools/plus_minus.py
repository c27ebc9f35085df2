"""The table of docs/trust.md: how often two printed standard errors hold the true parameter.

python tools/plus_minus.py    computes the table and writes the page again, in minutes
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

import forgetting as fg
from forgetting.record import identify

PAGE = Path(__file__).resolve().parents[1] / "docs" / "trust.md"
RECORDS, SAMPLES, NOISE = 100, 1000, 0.5
CASES: dict[str, tuple[float, float]] = {
    "fixed parameters, white noise": (0.0, 0.0),
    "fixed, noise AR(1) 0.8, slow regressor": (0.8, 0.0),
    "fixed, noise AR(1) 0.95, slow regressor": (0.95, 0.0),
    "random walk 0.002 a sample, white noise": (0.0, 0.002),
    "random walk 0.01": (0.0, 0.01),
    "random walk 0.05": (0.0, 0.05),
}
"""Name of a row; pole of the noise, standard deviation of a step of each parameter."""
RULES: dict[str, Any] = {"auto": "auto", "exponential": fg.Exponential(0.99)}
TOO_SMALL = "times too small here"
"""What is printed beside ± of a rule where it is wrong."""


def coloured(random: np.random.Generator, pole: float) -> np.ndarray:
    """A stationary AR(1) process of variance 1."""
    made = random.normal(size=SAMPLES)
    for k in range(1, SAMPLES):
        made[k] = pole * made[k - 1] + (1 - pole**2) ** 0.5 * made[k]
    return made


def record(case: str, seed: int) -> tuple[pd.DataFrame, np.ndarray]:
    """A record y = a + b x + noise, and its (a, b) at the end."""
    pole, step = CASES[case]
    random = np.random.default_rng(seed)
    x = coloured(random, 0.98 if pole else 0.0)
    theta = np.array([1.0, 0.5]) + np.cumsum(step * random.normal(size=(SAMPLES, 2)), axis=0)
    y = theta[:, 0] + theta[:, 1] * x + NOISE * coloured(random, pole)
    return pd.DataFrame({"x": x, "y": y}), theta[-1]


def inside(case: str, rule: str, seeds: range) -> tuple[float, float]:
    """Percent of parameters within ± 2 s.e., and of records that say that ± is too small."""
    held, said = [], []
    for seed in seeds:
        frame, truth = record(case, seed)
        found = identify(frame, formula="y ~ x", rule=RULES[rule])
        table = found.parameters
        held.append(np.abs(table["value"] - truth) <= 2 * table["standard_error"])
        said.append(TOO_SMALL in found.uncertainty)
    return 100 * float(np.mean(held)), 100 * float(np.mean(said))


def table() -> str:
    """One line a case."""
    lines = [
        "| record | the bank, % inside | exponential 0.99, % inside | says ± is too small, % |",
        "|---|---|---|---|",
    ]
    for case in CASES:
        bank, _ = inside(case, "auto", range(RECORDS))
        rule, said = inside(case, "exponential", range(RECORDS))
        lines.append(f"| {case} | {bank:.1f} | {rule:.1f} | {said:.0f} |")
    return "\n".join(lines)


def printed() -> dict[str, tuple[float, float, float]]:
    """The shares by case, as the page has them."""
    part = PAGE.read_text("utf-8").partition("<!-- plus-minus -->")[2].partition("<!--")[0]
    rows = re.findall(r"^\| (.+?) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", part, re.M)
    return {name: (float(a), float(b), float(c)) for name, a, b, c in rows}


def write() -> None:
    """Write the page again."""
    made = f"<!-- plus-minus -->\n\n{table()}\n\n<!-- /plus-minus -->"
    text = PAGE.read_text(encoding="utf-8")
    marks = r"<!-- plus-minus -->.*<!-- /plus-minus -->"
    PAGE.write_text(re.sub(marks, lambda _: made, text, flags=re.DOTALL), encoding="utf-8")


if __name__ == "__main__":
    write()
