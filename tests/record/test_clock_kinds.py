"""Clocks of every kind: found, read in the right order, and their gaps."""

from __future__ import annotations

import datetime
import io
import time

import numpy as np
import pandas as pd
import pytest

from forgetting.record import RecordError, identify, read

HOUR = 3600.0
QUICK = 5.0
"""Seconds; the cell without an end took more than a minute."""


def clock_of(rows, name="stamp", **options):
    """The clock of a record whose first column has these cells."""
    text = f"{name};x\n" + "".join(f"{cell};{k}\n" for k, cell in enumerate(rows))
    frame = pd.read_csv(io.StringIO(text), sep=";")
    return read(frame, **options).clock


@pytest.mark.parametrize(
    ("rows", "steps"),
    [
        (["13/03/2020 23:30", "14/03/2020 00:00"], [1800]),
        (["03/13/2020 23:30", "03/14/2020 00:00"], [1800]),
        (["31.12.2020", "01.01.2021"], [86400]),
        (["31.12.20 23:59:59,5", "01.01.21 00:00:00,5"], [1]),
        (["2020/12/31 23:59", "2021/01/01 00:00"], [60]),
        (["20240105T235900", "20240106T000000"], [60]),
        (["5-Jan-2024", "6-Jan-2024"], [86400]),
        (["1/5/2024 11:59:00 PM", "1/6/2024 12:00:00 AM", "1/6/2024 12:01:00 AM"], [60, 60]),
        (["10.03.2020 23:00", "10.03.2020 24:00", "11.03.2020 01:00"], [HOUR, HOUR]),
        (["10/03/2020", "10/03/2020 01:00", "10/03/2020 02:00"], [HOUR, HOUR]),
        (["2024-01-01 00:00:00 UTC", "2024-01-01 00:00:01 UTC"], [1]),
        (["2022-03-27T01:30:00+01:00", "2022-03-27T03:00:00+02:00"], [1800]),
        (["23:58", "23:59", "00:00", "00:01"], [60, 60, 60]),
        (["25:59:59", "26:00:00"], [1]),
        (["0 days 23:59:59", "1 days 00:00:00"], [1]),
        (["00:00.5", "00:01.0"], [0.5]),
    ],
)
def test_text(rows, steps):
    clock = clock_of(rows)
    assert clock is not None
    assert clock.steps.tolist() == pytest.approx(steps) and not clock.is_gap.any()


@pytest.mark.parametrize(
    ("name", "rows", "steps"),
    [
        ("date", [20231231, 20240101], [86400]),
        ("caldt", [202311, 202312, 202401], [30 * 86400, 31 * 86400]),
        ("stamp", [20231231235900, 20240101000000], [60]),
        ("timestamp", [1700000000, 1700000010], [10]),
        ("timestamp", [1700000000123, 1700000000223], [0.1]),
        ("timestamp", [1700000000123456, 1700000000123556], [1e-4]),
        ("timestamp", [1700000000123456789, 1700000000123457789], [1e-6]),
        ("epoch", [1700000000.25, 1700000000.5], [0.25]),
        ("t [ms]", [0, 20, 40], [0.02, 0.02]),
        ("Test Time / min", [0, 1], [60]),
        ("TestTime_us", [0, 5], [5e-6]),
        ("Zeit (h)", [0, 2], [7200]),
        ("elapsed", [0, 2], [2]),
    ],
)
def test_numbers(name, rows, steps):
    clock = clock_of(rows, name)
    assert clock is not None and clock.name == name
    assert clock.steps.tolist() == pytest.approx(steps)


@pytest.mark.parametrize("name", ["timer", "lifetime", "Q", "T [K]", "runs"])
def test_other_numbers_are_no_clock(name):
    assert clock_of([3, 4, 5], name) is None


def test_a_column_that_runs_back_and_forth_is_no_clock():
    rng = np.random.default_rng(1)
    assert clock_of(rng.normal(size=300), "response time") is None


def test_of_several_the_one_that_runs_on_is_the_clock():
    frame = pd.DataFrame(
        {
            "Date_Time": ["2024-01-01 00:00:00"] * 2 + ["2024-01-01 00:00:01"] * 2,
            "Step_Time(s)": [0.0, 0.5, 0.0, 0.5],
            "Test_Time(s)": [0.0, 0.5, 1.0, 1.5],
        }
    )
    clock = read(frame).clock
    assert clock is not None and clock.name == "Test_Time(s)"


@pytest.mark.parametrize(
    ("day", "hour"),
    [
        (["16/12/2006", "17/12/2006"], ["23:59:00", "00:00:00"]),
        (["2006-12-16", "2006-12-17"], [datetime.time(23, 59), datetime.time(0, 0)]),
        ([20061216, 20061217], ["23:59", "0:00"]),
        (pd.to_datetime(["2006-12-16", "2006-12-17"]), pd.to_timedelta(["23:59:00", "0:00:00"])),
    ],
)
def test_date_and_time_in_two_columns(day, hour):
    frame = pd.DataFrame({"Date": day, "Time": hour, "x": [1.0, 2.0]})
    clock = read(frame, time="Date,Time").clock
    assert clock is not None and clock.steps.tolist() == [60] and clock.name == "Date + Time"


def test_year_month_day_in_columns_of_their_own():
    frame = pd.DataFrame({"year": 2024, "month": [2, 3], "day": [29, 1], "hour": [23, 0]})
    clock = read(frame).clock
    assert clock is not None and clock.steps.tolist() == [HOUR]


def test_year_and_month():
    frame = pd.DataFrame({"Year": [2023] * 2 + [2024], "Month": [11, 12, 1], "x": 0.0})
    clock = read(frame).clock
    assert clock is not None and clock.name == "Year + Month" and not clock.is_gap.any()


def test_stamps_coarser_than_the_rows():
    """Ten rows a second with stamps of whole seconds, two seconds lost."""
    stamps = np.repeat([0, 1, 2, 5, 6], 10)
    clock = read(pd.DataFrame({"time": stamps, "x": 0.0})).clock
    assert np.flatnonzero(clock.is_gap).tolist() == [29]
    assert clock.gaps().startswith("1 gap: 1 step over 1.5 s, most rows share a stamp")


def test_a_few_unreadable_stamps_are_missing_times():
    stamps = [f"2024-01-01 00:00:{k:02}" for k in range(30)]
    clock = read(pd.DataFrame({"time": [*stamps[:9], "???", *stamps[10:]], "x": 0.0})).clock
    assert np.flatnonzero(clock.is_gap).tolist() == [8, 9]
    assert clock.kind == "date-times, 1 of them unreadable"
    half = ["x" if k % 2 else stamp for k, stamp in enumerate(stamps)]
    assert read(pd.DataFrame({"time": half, "x": 0.0})).clock is None


def local(*stamps):
    return read(pd.DataFrame({"time": pd.to_datetime(list(stamps)), "x": 0.0})).clock


def test_the_repeated_and_the_left_out_hour_are_no_gaps():
    back = local(
        "2020-10-25 02:00", "2020-10-25 02:30", "2020-10-25 02:00", "2020-10-25 02:30",
        "2020-10-25 03:00",
    )  # fmt: skip
    assert back.steps.tolist() == [1800] * 4 and not back.is_gap.any()
    on = local("2020-03-29 01:00", "2020-03-29 01:30", "2020-03-29 03:00", "2020-03-29 03:30")
    assert not on.is_gap.any()
    # The same hour on another day is missing.
    gap = local("2020-03-30 01:00", "2020-03-30 01:30", "2020-03-30 03:00", "2020-03-30 03:30")
    assert gap.is_gap.tolist() == [False, True, False]


def test_a_weekend_is_a_gap_only_where_there_are_weekends():
    days = pd.bdate_range("2024-01-25", periods=12)
    business = read(pd.DataFrame({"date": days.drop(days[7]), "x": 0.0})).clock
    # Only the day that was dropped is missing.
    assert np.flatnonzero(business.is_gap).tolist() == [6]
    every = pd.date_range("2024-01-25", periods=12)
    all_days = read(pd.DataFrame({"date": every.drop(every[2:4]), "x": 0.0})).clock
    assert np.flatnonzero(all_days.is_gap).tolist() == [1]


@pytest.fixture
def stepped():
    """y = 2 u(k-1) within stretches, with a step of 60 s and a restart."""
    u = [1.0, 4.0, 2.0, 3.0, 5.0, 0.0, 7.0, 1.0]
    y = [0.0, 2.0, 8.0, 99.0, 6.0, 10.0, 55.0, 14.0]
    return pd.DataFrame({"time": [0, 1, 2, 60, 61, 62, 0, 1], "u": u, "y": y})


@pytest.mark.parametrize(
    ("options", "cut"),
    [({}, 2), ({"gap": "2min"}, 1), ({"gap": "none"}, 1), ({"gap": 0.5}, 7), ({"time": "none"}, 0)],
)
def test_gaps_as_asked(stepped, options, cut):
    if options.get("gap") == 0.5:
        with pytest.raises(RecordError, match=r"no complete sample.*cut the lags of 7 rows"):
            identify(stepped, formula="y ~ 0 + lag(u)", **options)
        return
    found = identify(stepped, formula="y ~ 0 + lag(u)", rule="none", **options)
    assert found.samples.cut == cut and found.used == 7 - cut
    told = found.summary()["clock"]
    assert told is None if "time" in options else told["lags_cut"] == cut
    arx = identify(stepped, output="y", input="u", arx=(0, 1, 1), rule="none", **options)
    assert arx.samples.cut == cut and arx.used == 7 - cut


@pytest.mark.parametrize("gap", ["soon", "-1s", "0", -3, "nan"])
def test_gaps_that_are_none(stepped, gap):
    with pytest.raises(RecordError, match="must be a duration above zero"):
        read(stepped, gap=gap)


def test_a_model_without_lags_needs_no_clock(stepped):
    broken = stepped.assign(time=["?", "late", "x", "1", "2", "3", "4", "5"])
    found = identify(broken, formula="y ~ u")
    assert found.used == 8 and found.samples.clock is None
    assert found.samples.clock_in_words() == "no clock; lags count rows"


def test_columns_that_are_no_date_and_time(stepped):
    with pytest.raises(RecordError, match="'u' and 'y' of record are no date and time"):
        read(stepped, time="u,y")


@pytest.mark.parametrize("lag", [1, 2, 3, 4])
def test_islands_shorter_than_a_lag_are_skipped(lag):
    """Stretches of one to five rows; a sample is used where its lag is in its stretch."""
    time = np.concatenate([100.0 * k + np.arange(k) for k in range(1, 6)])
    rng = np.random.default_rng(3)
    frame = pd.DataFrame({"time": time, "u": rng.normal(size=15), "y": rng.normal(size=15)})
    expected = sum(max(k - lag, 0) for k in range(1, 6))
    assert identify(frame, formula=f"y ~ 0 + lag(u, {lag})").used == expected
    assert identify(frame, output="y", arx=(lag, 0, 0)).used == expected


@pytest.mark.parametrize("last", ["2024-01-05 24:00", "5-Jan-2024 23:59"])
def test_a_date_with_the_year_first_has_the_month_second(last):
    clock = clock_of(["2024-01-05 23:00", last])
    assert clock is not None and clock.values.iloc[0] == pd.Timestamp("2024-01-05 23:00")
    assert 0 < clock.steps[0] <= HOUR


@pytest.mark.parametrize("rows", [["2024-01-05", "x" * 200_000], ["9999-12-31 23:00", "24:00"]])
def test_stamps_that_a_parser_does_not_survive(rows):
    start = time.monotonic()
    with pytest.raises(RecordError, match="holds no times") as caught:
        clock_of(rows, time="stamp")
    assert time.monotonic() - start < QUICK and len(str(caught.value)) < 300


@pytest.mark.parametrize(("gap", "seconds"), [("99d", 99 * 86400), ("2 H", 7200), ("PT5M", 300)])
def test_gaps_in_spellings_that_pandas_gives_up(gap, seconds):
    assert clock_of(["10:00", "10:01"], gap=gap).gap == seconds
