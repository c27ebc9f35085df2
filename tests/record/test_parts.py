"""Forgetting by the clock over a record that is run in parts."""

from __future__ import annotations

import numpy as np
import pandas as pd

import forgetting as fg
from forgetting.record import identify
from forgetting.record.half_life import LastTime


def test_time_over_missing_rows_is_forgotten_wherever_a_part_ends():
    """Of 3000 rows three make a part; some end in missing rows."""
    rng = np.random.default_rng(0)
    t = np.arange(3000.0)
    x = rng.normal(size=3000)
    y = 2.0 * x + 0.1 * rng.normal(size=3000)
    y[rng.random(3000) < 0.4] = np.nan
    frame = pd.DataFrame({"time": t, "x": x, "y": y})
    found = identify(frame, formula="y ~ 0 + x", rule="exponential", half_life="20s")
    est = fg.RLS(1, rule=fg.Exponential(half_life=20.0))
    run = est.run(x[:, None], y, outputs=("theta",), missing="skip", time=t)
    np.testing.assert_array_equal(found.theta[:, :, 0], run.theta)


def test_last_time():
    last = LastTime()
    time = np.array([1.0, 2.0])
    assert last.ahead_of(time).tolist() == [1.0, 2.0]
    last.note(time, np.array([True, False]))
    last.note(time + 2, np.array([False, False]))
    assert last.ahead_of(time + 4).tolist() == [1.0, 5.0, 6.0]
