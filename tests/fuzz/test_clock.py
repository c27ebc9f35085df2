"""Clocks: whatever the columns hold, there is a clock with its gaps, none, or one line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from hypothesis import strategies as st

from forgetting.record.clock import find_clock, gap_of
from forgetting.words.duration import SECONDS

from .target import fuzz
from .texts import DATES, MISSING

NAMES = ("time", "Date", "Time / s", "t [ms]", "year", "month", "day", "hour", "x", "column 1", "T")
GAPS = ("5min", "0", "-1", "none", "1e400", "nan", "", "1 day", "99999999999d", "5 apples", "\x00")


@dataclass(frozen=True)
class Case:
    """A table, and what is said of its clock."""

    frame: pd.DataFrame
    named: str | None
    gap: str | float | None
    units: dict[str, str]


def cells(length: int) -> st.SearchStrategy[list[Any]]:
    """Columns: one form of time from row to row, numbers that run, or anything."""
    odd = st.one_of(st.sampled_from(DATES), st.sampled_from(MISSING), st.text(max_size=12))
    forms = ("%Y-%m-%d %H:%M:%S", "%d.%m.%Y %H:%M", "%m/%d/%Y", "%H:%M:%S", "%Y%m%d", "%j", "%c")
    step = st.sampled_from(("1s", "1h", "1D", "7D", "-1h", "0s", "31D", "1ns", "366D"))
    start = st.datetimes(pd.Timestamp("1700-01-01"), pd.Timestamp("2200-01-01"))
    run = st.tuples(start, step, st.sampled_from(forms)).map(
        lambda part: [
            (pd.Timestamp(part[0]) + k * pd.Timedelta(part[1])).strftime(part[2])
            for k in range(length)
        ]
    )
    count = st.tuples(st.floats(allow_nan=False), st.floats(-1e20, 1e20)).map(
        lambda part: [part[0] + k * part[1] for k in range(length)]
    )
    whole = st.tuples(st.integers(-(2**62), 2**62), st.integers(-(10**9), 10**9)).map(
        lambda part: [part[0] + k * part[1] for k in range(length)]
    )
    stamps = st.lists(st.datetimes(), min_size=length, max_size=length)
    spans = st.lists(st.timedeltas(), min_size=length, max_size=length)
    several = st.lists(odd, min_size=length, max_size=length)
    one = st.sampled_from(DATES).map(lambda date: [date] * length)
    floats = st.lists(st.floats(), min_size=length, max_size=length)
    return st.one_of(run, run, run, count, whole, stamps, spans, several, one, floats)


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """A table of a few columns, some of their cells replaced."""
    length = draw(st.integers(1, 12))
    names = draw(st.lists(st.sampled_from(NAMES), min_size=1, max_size=4, unique=True))
    columns = {}
    for name in names:
        values = draw(cells(length))
        for _ in range(draw(st.integers(0, 2))):
            values[draw(st.integers(0, length - 1))] = draw(
                st.sampled_from((None, "", np.nan, values[0], "off", "x" * 200_000))
            )
        columns[name] = pd.Series(values)
    units = draw(st.dictionaries(st.sampled_from(names), st.sampled_from((*SECONDS, "V", "-"))))
    named = draw(st.sampled_from((None, None, None, "none", ",".join(names[:2]), names[0], "zz")))
    return Case(pd.DataFrame(columns), named, draw(st.sampled_from((None, *GAPS, 0.5))), units)


def check(case: Case) -> None:
    """Find the clock and ask it everything."""
    clock = find_clock(case.frame, case.named, gap_of(case.gap), case.units, "record")
    if clock is None:
        return
    length = len(case.frame)
    assert len(clock.seconds()) == len(clock.segments()) == length
    assert len(clock.steps) == len(clock.is_gap) == length - 1
    assert str(clock) and not np.isinf(clock.steps).any() and clock.runs_forward in (True, False)


def test_clock() -> None:
    fuzz("clock", 60, cases(), check)
