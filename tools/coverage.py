"""The table of docs/trust.md: how often 95 % prediction intervals are right, rule by rule."""

from __future__ import annotations

import re
from pathlib import Path
from statistics import NormalDist

import numpy as np

import forgetting as fg

PAGE = Path(__file__).resolve().parents[1] / "docs" / "trust.md"
RUNS, SAMPLES, PARAMETERS, START = 100, 1000, 3, 4.0
FACTORS = (0.99, 0.95)
ABOUT = {about["name"]: about for about in fg.rules()}


def rated(name: str) -> bool:
    """Whether the rule has a forgetting factor; `custom` stands for `exponential`."""
    return bool(ABOUT[name]["forgetting_factor"]) or name == "custom"


def make(name: str, factor: float) -> fg.Rule:
    """The rule with its defaults and this λ; `custom` is exponential."""
    if name == "custom":
        return fg.Custom(lambda r, phi, error: (1 - factor) * r)  # type: ignore[call-arg, misc]
    return fg.rule(name, **({"forgetting_factor": factor} if rated(name) else {}))


def record(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Fixed parameters drawn from the prior, white regressors and noise of variance 1."""
    rng = np.random.default_rng(seed)
    phi = rng.normal(size=(SAMPLES, PARAMETERS))
    theta = START**0.5 * rng.normal(size=PARAMETERS)
    return phi, phi @ theta + rng.normal(size=SAMPLES)


def coverage(rule: fg.Rule) -> float:
    """Share of 100,000 outputs in their 95 % interval, in percent."""
    quantile, inside = NormalDist().inv_cdf(0.975), 0
    for seed in range(RUNS):
        est = fg.RLS(PARAMETERS, rule=rule, initial_covariance=START)
        run = est.run(*record(seed), outputs=["whitened_innovation"])
        inside += int((np.abs(run.whitened_innovation) <= quantile).sum())
    return 100 * inside / (RUNS * SAMPLES)


def table() -> str:
    """One line a rule; one that uses no forgetting factor has one number."""
    lines = ["| rule | λ = 0.99, % inside | λ = 0.95, % inside |", "|---|---|---|"]
    for name in ABOUT:
        first = f"{coverage(make(name, FACTORS[0])):.1f}"
        second = f"{coverage(make(name, FACTORS[1])):.1f}" if rated(name) else "–"
        lines.append(f"| `{name}` | {first} | {second} |")
    return "\n".join(lines)


def printed() -> dict[str, tuple[float | None, ...]]:
    """Coverage by rule, as the page has it."""
    rows = re.findall(r"^\| `(\w+)` \| ([\d.]+|–) \| ([\d.]+|–) \|$", PAGE.read_text("utf-8"), re.M)
    return {name: tuple(float(x) if x != "–" else None for x in row) for name, *row in rows}


def write() -> None:
    """Write the page again."""
    made = f"<!-- coverage -->\n\n{table()}\n\n<!-- /coverage -->"
    text = PAGE.read_text(encoding="utf-8")
    text = re.sub(r"<!-- coverage -->.*<!-- /coverage -->", lambda _: made, text, flags=re.DOTALL)
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write()
