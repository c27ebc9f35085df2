"""Records that the tests of this folder read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest


@pytest.fixture
def csv(tmp_path: Path) -> Callable[[str], Path]:
    """Write text as a CSV file and return its path."""

    def write(text: str, name: str = "record.csv") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def plant() -> pd.DataFrame:
    """The record of a plant, for this test alone."""
    return plant_record()


def plant_record() -> pd.DataFrame:
    """Two inputs, two outputs, a difference equation with a little noise, 400 samples of 0.5 s."""
    rng = np.random.default_rng(7)
    u = rng.normal(size=(400, 2))
    y = np.zeros((400, 2))
    a = np.array([[0.7, 0.1], [-0.2, 0.5]])
    b = np.array([[1.0, 0.0], [0.5, -0.3]])
    for k in range(1, 400):
        y[k] = a @ y[k - 1] + b @ u[k - 1] + 0.01 * rng.normal(size=2)
    table = {"time": 0.5 * np.arange(400), "u1": u[:, 0], "u2": u[:, 1]}
    return pd.DataFrame(table | {"y1": y[:, 0], "y2": y[:, 1]})
