"""How often outputs are within the intervals of forecasts: `python -m benchmarks.ahead`.

Simulated: of each kind so many random systems, each identified from one record without forgetting,
which ends where the forecast begins. Measured: every record of a folder, with the default bank; at
every sample forecasts are made, and judged by both readings.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

import forgetting as fg
from forgetting.record.dynamics import columns
from forgetting.record.read import read

Array = NDArray[np.float64]

LEVEL, HORIZONS = 0.9, (1, 5, 20)
KINDS: dict[str, Any] = {
    "ARX": fg.ARX(2, 2, 1, offset=True, rule="none"),
    "ARMA": fg.ARMA(2, 1, offset=True, rule="none"),
    "ARMAX": fg.ARMAX(2, 2, 1, offset=True, rule="none"),
    "OE": fg.OE(2, 2, offset=True, rule="none"),
    "BJ": fg.BJ(2, 1, 1, 2, offset=True, rule="none"),
}


def poles(rng: np.random.Generator, order: int) -> Array:
    """A polynomial with real or complex roots of moduli from 0.3 to 0.95."""
    modulus = rng.uniform(0.3, 0.95)
    if order == 1:
        return np.array([1.0, -rng.choice([-1.0, 1.0]) * modulus])
    if rng.random() < 0.5:
        return np.array([1.0, -2 * modulus * np.cos(rng.uniform(0, np.pi)), modulus**2])
    return np.convolve([1.0, -modulus], [1.0, -rng.uniform(-0.9, 0.9)])


def record(kind: str, rng: np.random.Generator, samples: int) -> tuple[Array, Array]:
    """Input and output of a random system at an operating point."""
    u, e = rng.normal(size=(2, samples))
    model = KINDS[kind]
    orders = {name: getattr(model, name, 0) for name in ("na", "nc", "nd", "nf")}
    A, C, D, F = (poles(rng, n) if n else np.ones(1) for n in orders.values())
    driven = lfilter(np.r_[0.0, rng.normal(size=2)], F, u) if getattr(model, "nb", 0) else 0.0
    y = lfilter([1.0], A, driven + lfilter(C, D, rng.uniform(0.2, 1.0) * e))
    return u, 20.0 + y


def simulated(kind: str, systems: int, samples: int) -> Array:
    """The share of outputs inside, at each horizon."""
    rng, inside = np.random.default_rng(1), np.zeros(max(HORIZONS))
    for _ in range(systems):
        u, y = record(kind, rng, samples + len(inside))
        model = type(KINDS[kind])(**KINDS[kind].get_params())
        has_input = getattr(model, "nb", 0)
        model.fit(u[:samples] if has_input else None, y[:samples])
        made = model.forecast(u[samples:] if has_input else len(inside), level=LEVEL)
        inside += (made.lower <= y[samples:]) & (y[samples:] <= made.upper)
    return np.asarray(inside[np.array(HORIZONS) - 1] / systems)


def measured(folder: Path) -> Iterator[tuple[str, str, fg.Forecasts]]:
    """Each record as an ARX and an ARMAX model of its last column on the others."""
    for path in sorted(folder.glob("*.csv")):
        found = read(path)
        names = [str(name) for name in found.frame.columns]
        if found.clock is not None:
            names.remove(found.clock.name)
        y, u = columns(found, names[-1:]), columns(found, names[:-1])
        for model in (fg.ARX(2, 2, 1, offset=True), fg.ARMAX(2, 2, 2, offset=True)):
            kind = type(model).__name__
            yield path.stem, kind, fg.forecasts(model, u, y, HORIZONS, LEVEL)


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--systems", type=int, default=300)
    parser.add_argument("--records", type=Path)
    given = parser.parse_args()
    print(f"of {given.systems} random systems within intervals of {LEVEL:.0%}, {HORIZONS} ahead")
    for samples in (400, 2000):
        for kind in KINDS:
            held = " ".join(f"{share:.3f}" for share in simulated(kind, given.systems, samples))
            print(f"{kind:6} after {samples:5} samples  {held}", flush=True)
    if given.records is None:
        return
    print(f"measured, level {LEVEL:.0%}, {HORIZONS} ahead: that follows the errors / of the noise")
    for name, kind, made in measured(given.records):
        held = (f"{h['conformal']:.3f}/{h['noise']:.3f}" for h in made.coverage().values())
        print(f"{name:26} {kind:6} {len(made.measured):6}  {'  '.join(held)}", flush=True)


if __name__ == "__main__":
    main()
