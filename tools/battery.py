"""Writes the record that ships in the package: a battery cell under load, computed.

A cell of 10 Ah is loaded in blocks as a vehicle would, rests twice, and its resistance grows by
half from begin to end:

    V = 3.2 + 0.9 s − R(t) I − w          s: charge, R from 30 to 45 mΩ
    w₊ = 0.8 w + 0.2 · 0.004 I            what diffusion takes, time constant about 9 s

with voltage to 1 mV and a noise of 2 mV. Some cells of the table are empty, one stretch of time was
not logged. ``python tools/battery.py`` writes the file.
"""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

RECORD = Path(__file__).parents[1] / "python" / "forgetting" / "demo" / "data" / "battery.csv"
ROWS, STEP = 2000, 2
"""Samples, and seconds between two of them."""
RESTS = (slice(600, 850), slice(1400, 1600))
LOST = slice(1050, 1200)
"""Samples that were not logged."""
RESISTANCE = (0.030, 0.045)
START = datetime(2026, 3, 2, 8, 0, 0)


def load(random: np.random.Generator) -> np.ndarray:
    """Current in ampere: steps of 4 to 30 s between −6 A (braking) and 20 A, and rests."""
    current = np.empty(0)
    while len(current) < ROWS:
        current = np.append(current, np.full(random.integers(2, 16), random.uniform(-6.0, 20.0)))
    current = current[:ROWS]
    for rest in RESTS:
        current[rest] = 0.0
    return current.round(2)


def signals() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Voltage (V), current (A) and temperature (°C), (2000,) each."""
    random = np.random.default_rng(20260302)
    current = load(random)
    charge = 0.95 - np.cumsum(current) * STEP / 3600 / 10.0
    resistance = np.linspace(*RESISTANCE, ROWS)
    slow, warm = np.zeros(ROWS), np.full(ROWS, 21.0)
    for k in range(1, ROWS):
        slow[k] = 0.8 * slow[k - 1] + 0.2 * 0.004 * current[k - 1]
        heat = resistance[k] * current[k - 1] ** 2
        warm[k] = warm[k - 1] + STEP * (heat - 0.3 * (warm[k - 1] - 21.0)) / 60.0
    noise = random.normal(0.0, 0.002, ROWS)
    return 3.2 + 0.9 * charge - resistance * current - slow + noise, current, warm


def text() -> str:
    """The whole file."""
    voltage, current, warm = signals()
    empty = set(np.random.default_rng(7).choice(ROWS, 12, replace=False).tolist())
    lines = ["# battery cell under load, computed by tools/battery.py", "time,V,I,T", ",V,A,°C"]
    for k in range(ROWS):
        if LOST.start <= k < LOST.stop:
            continue
        stamp = START + timedelta(seconds=STEP * k)
        v = "" if k in empty else f"{voltage[k]:.3f}"
        lines.append(f"{stamp:%Y-%m-%d %H:%M:%S},{v},{current[k]:.2f},{warm[k]:.1f}")
    return "\n".join(lines) + "\n"


def write() -> None:
    """Write the record into the package."""
    RECORD.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    write()
