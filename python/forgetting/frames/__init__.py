"""Data frames of pandas, Polars, PyArrow and xarray: names and index in, names and index out.

>>> import numpy as np
>>> import pandas as pd
>>> import forgetting as fg
>>> from forgetting import frames
>>> days = pd.date_range("2024-06-01", periods=4, name="day")
>>> phi = pd.DataFrame({"base": 1.0, "sun": [0.0, 1.0, 2.0, 3.0]}, index=days)
>>> y = 2.0 + 3.0 * phi["sun"]
>>> frames.run(fg.RLS(2), phi, y, outputs=("theta", "error")).round(2).tail(2)
            base  sun  error
day
2024-06-03   2.0  3.0    0.0
2024-06-04   2.0  3.0    0.0
"""

from forgetting.frames.results import run, to_frame
from forgetting.frames.table import Table, aligned, read, shaped_like

__all__ = ["Table", "aligned", "read", "run", "shaped_like", "to_frame"]
