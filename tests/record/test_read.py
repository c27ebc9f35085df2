"""Reading records: what is accepted, and the sentence for everything else."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

from forgetting.record import RecordError, identify, read


def test_missing_file(tmp_path):
    with pytest.raises(RecordError, match=r"there is no file .*nothing\.csv"):
        read(tmp_path / "nothing.csv")


def test_folder(tmp_path):
    with pytest.raises(RecordError, match="is a folder without Parquet files"):
        read(tmp_path)


def test_empty_file(csv):
    with pytest.raises(RecordError, match=r"record\.csv is empty"):
        read(csv(""))


def test_blank_file(csv):
    with pytest.raises(RecordError, match="is empty: it has no line with anything in it"):
        read(csv("\n\n"))


def test_header_only(csv):
    with pytest.raises(RecordError, match="has a header and no rows"):
        read(csv("x,y\n"))


def test_the_ending_of_a_name_decides_nothing(csv):
    for name in ("record.log", "record", "record.parquet", "record.xlsx"):
        assert read(csv("x\n1\n2\n", name)).frame["x"].tolist() == [1, 2]


def test_half_a_parquet_file(tmp_path):
    path = tmp_path / "record.parquet"
    pd.DataFrame({"x": np.arange(100.0)}).to_parquet(path)
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(RecordError, match="is no Parquet file"):
        read(path)


def test_ragged_rows(csv):
    with pytest.raises(RecordError, match=r"3 cells in row 2 but 2 names in its header"):
        read(csv("x,y\n1,2\n1,2,3\n"))
    with pytest.raises(
        RecordError, match=r"cannot be read as CSV: line 4 has 3 cells, the table 2"
    ):
        read(csv("x,y\n1,2\n1,2\n1,2,3\n1,2\n1,2\n"))


def test_rows_longer_than_the_header(csv):
    with pytest.raises(RecordError, match="3 cells in its first row but 2 names in its header"):
        read(csv("x,y\n0,2,3\n1,5,6\n"))


def test_a_name_that_occurs_twice_is_refused_where_it_is_used(csv):
    path = csv("x,y,x\n1,2,3\n2,4,5\n3,6,5\n")
    with pytest.raises(RecordError, match=r"has 2 columns named 'x'; say which: 'x \(column 1\)'"):
        identify(path, formula="y ~ 0 + x")
    found = identify(path, formula="y ~ 0 + `x (column 1)`", rule="none", initial_covariance=1e9)
    assert found.parameters["value"].tolist() == pytest.approx([2])


def test_text_in_a_number_column(csv):
    path = csv("x,y\n1,2\n2,4\nbroken,6\n4,8\n")
    with pytest.raises(RecordError, match=r"column 'x' of record.csv .* row 3 is 'broken'"):
        identify(path, formula="y ~ 0 + x")


def test_infinite_cell(csv):
    with pytest.raises(RecordError, match=r"column 'x' of record\.csv is infinite in row 2"):
        identify(csv("x,y\n1,2\ninf,4\n3,6\n"), formula="y ~ 0 + x")


def test_unknown_column_names_the_close_ones(csv):
    path = csv("voltage,current\n1,2\n2,4\n")
    with pytest.raises(RecordError, match="no column 'volts'; close are 'voltage'"):
        identify(path, output="volts", input="current", arx=(1, 1, 0))


def test_unknown_column_far_from_all(csv):
    path = csv("voltage,current\n1,2\n2,4\n")
    with pytest.raises(RecordError, match="its columns are 'voltage', 'current'"):
        identify(path, formula="voltage ~ zzz")


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_separators(csv, separator):
    text = "time,x,y\n0,1,2\n1,2,4\n2,3,6\n".replace(",", separator)
    record = read(csv(text))
    assert list(record.frame.columns) == ["time", "x", "y"]
    assert record.frame["y"].tolist() == [2, 4, 6]


def test_byte_order_mark_and_spaces(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("x, y\n1, 2\n", encoding="utf-8-sig")
    assert list(read(path).frame.columns) == ["x", "y"]


def test_parquet_is_the_same_record_as_csv(tmp_path, plant):
    plant.to_csv(tmp_path / "plant.csv", index=False)
    plant.to_parquet(tmp_path / "plant.parquet")
    model = {"output": "y1", "input": ["u1", "u2"], "arx": (1, 1, 1)}
    one = identify(tmp_path / "plant.csv", **model)
    other = identify(tmp_path / "plant.parquet", **model)
    assert np.array_equal(one.theta, other.theta)


@pytest.mark.parametrize("library", ["polars", "pyarrow"])
def test_frames_of_other_libraries_are_the_same_record(plant, library):
    other = pytest.importorskip(library)
    plant.loc[100, "u1"] = np.nan
    plant["time"] = pd.to_datetime(plant["time"], unit="s")
    plant["phase"] = np.where(np.arange(400) < 200, "up", "down")
    if library == "polars":
        frame = other.DataFrame({name: plant[name].to_numpy() for name in plant.columns})
        frame = frame.fill_nan(None)  # a missing cell of its own kind
    else:
        frame = other.Table.from_pandas(plant)
    formula = "y1 ~ 0 + lag(y1) + u1 + C(phase)"
    one, same = identify(plant, formula=formula), identify(frame, formula=formula)
    assert np.array_equal(one.theta, same.theta) and one.missing == same.missing == 2
    assert one.samples.regressors == same.samples.regressors
    assert one.samples.clock is not None and same.samples.clock is not None
    assert np.array_equal(one.samples.clock.seconds(), same.samples.clock.seconds())


@pytest.mark.parametrize("thing", [3, [1.0, 2.0], {"x": [1.0]}, np.ones((3, 2)), pd.Series([1.0])])
def test_things_that_are_no_record(thing):
    with pytest.raises(RecordError, match="a record is a file or a data frame in memory, but got"):
        read(thing)


def test_a_lazy_frame_is_refused():
    polars = pytest.importorskip("polars")
    with pytest.raises(RecordError, match=r"but got polars\..*LazyFrame"):
        read(polars.LazyFrame({"x": [1.0]}))


def test_tables_in_memory_keep_their_times():
    index = pd.date_range("2024-01-01", periods=3, freq="min")
    record = read(pd.DataFrame({"x": [1.0, 2.0, 3.0]}, index=index))
    assert record.clock is not None and record.clock.seconds().tolist() == [0.0, 60.0, 120.0]
    assert list(read(pd.DataFrame({"x": [1.0]}, index=[7])).frame.columns) == ["x"]


def test_parquet_with_a_time_index(tmp_path):
    index = pd.date_range("2024-01-01", periods=3, freq="h", name="time")
    pd.DataFrame({"x": [1.0, 2.0, 3.0]}, index=index).to_parquet(tmp_path / "r.parquet")
    record = read(tmp_path / "r.parquet")
    assert record.clock is not None and record.clock.is_datetime
    assert record.clock.seconds().tolist() == [0.0, 3600.0, 7200.0]
