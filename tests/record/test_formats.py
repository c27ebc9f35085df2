"""Files of other formats than text: the same numbers, whatever holds them."""

from __future__ import annotations

import bz2
import datetime
import gc
import gzip
import lzma
import os
import struct
import sys
import warnings
import zipfile

import numpy as np
import pandas as pd
import pytest

from forgetting.record import RecordError, identify, read

ROWS = 40


@pytest.fixture
def frame() -> pd.DataFrame:
    t = 0.5 * np.arange(ROWS)
    return pd.DataFrame({"time": t, "u": np.sin(t), "y": 1 + 2 * np.sin(t)})


def same(record, frame):
    for name in ("u", "y"):
        np.testing.assert_array_equal(record.frame[name], frame[name])
    found = identify(record, formula="y ~ u", rule="none", initial_covariance=1e9)
    assert found.parameters["value"].tolist() == pytest.approx([1, 2])


@pytest.mark.parametrize(
    ("packed", "pack"),
    [("gzip", gzip.compress), ("xz", lzma.compress), ("bzip2", bz2.compress)],
)
def test_packed_text(tmp_path, frame, packed, pack):
    (tmp_path / "r").write_bytes(pack(frame.to_csv(index=False).encode()))
    record = read(tmp_path / "r")
    assert record.found.details["packed"] == packed
    same(record, frame)
    (tmp_path / "r").write_bytes(pack(frame.to_csv(index=False).encode())[:-30])
    with pytest.raises(RecordError, match=f"cannot be unpacked \\({packed}\\)"):
        read(tmp_path / "r")


def test_zstandard(tmp_path, frame):
    import pyarrow as pa

    with pa.CompressedOutputStream(str(tmp_path / "r.csv.zst"), "zstd") as stream:
        stream.write(frame.to_csv(index=False).encode())
    same(read(tmp_path / "r.csv.zst"), frame)


def test_zip(tmp_path, frame):
    with zipfile.ZipFile(tmp_path / "r.zip", "w") as made:
        made.writestr("a.csv", frame.to_csv(index=False))
    same(read(tmp_path / "r.zip"), frame)
    with zipfile.ZipFile(tmp_path / "r.zip", "a") as made:
        made.writestr("b.csv", "x\n1\n")
    with pytest.raises(RecordError, match=r"has 2 files; name one by --part: 'a\.csv', 'b\.csv'"):
        read(tmp_path / "r.zip")
    same(read(tmp_path / "r.zip", part="a.csv"), frame)
    with pytest.raises(RecordError, match=r"has no file 'c\.csv'"):
        read(tmp_path / "r.zip", part="c.csv")


def test_columnar(tmp_path, frame):
    import pyarrow as pa

    frame.to_parquet(tmp_path / "a")
    frame.to_feather(tmp_path / "b")
    table = pa.Table.from_pandas(frame)
    with (
        pa.OSFile(str(tmp_path / "c"), "wb") as stream,
        pa.ipc.new_stream(stream, table.schema) as made,
    ):
        made.write_table(table)
    for name in "abc":
        same(read(tmp_path / name), frame)


def test_a_folder_of_parquet(tmp_path, frame):
    for k in range(4):
        frame.iloc[10 * k : 10 * k + 10].to_parquet(tmp_path / f"part-{k}.parquet")
    (tmp_path / "notes.txt").write_text("no part")
    (tmp_path / ".part.parquet").write_text("half of one that is being written")
    record = read(tmp_path)
    same(record, frame)
    assert record.found.details == {"files": "4"} and not record.clock.is_gap.any()


def test_json(tmp_path, frame):
    frame.to_json(tmp_path / "a", orient="records", lines=True, double_precision=15)
    frame.to_json(tmp_path / "b", orient="records", double_precision=15)
    for name in "ab":
        found = identify(tmp_path / name, formula="y ~ u", rule="none", initial_covariance=1e9)
        assert found.parameters["value"].tolist() == pytest.approx([1, 2])
    (tmp_path / "a").write_text('{"x": 1}\n{"x": \n')
    with pytest.raises(RecordError, match="is not JSON lines"):
        read(tmp_path / "a")


def test_excel(tmp_path, frame):
    pytest.importorskip("python_calamine")
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(["Operator", "x"])
    sheet = book.create_sheet("Data")
    for row in (["Test 7"], [], ["Time", "u", "y", "when"], ["(s)", "(V)", "(A)", None]):
        sheet.append(row)
    start = datetime.datetime(2024, 1, 1)
    for k, (t, u, y) in enumerate(frame.itertuples(index=False)):
        sheet.append([t, u, y if k != 3 else "?", start + datetime.timedelta(seconds=k)])
    book.save(tmp_path / "r.xlsx")
    record = read(tmp_path / "r.xlsx")
    assert record.found.units == {"Time": "s", "u": "V", "y": "A"}
    assert record.found.details["sheet"] == "'Data', one of 2"
    assert record.frame["y"].isna().tolist() == [k == 3 for k in range(ROWS)]
    same_rows = record.frame.drop(index=3)
    # The library that wrote the file kept 16 digits.
    np.testing.assert_allclose(same_rows["u"], frame.drop(index=3)["u"], rtol=1e-15)
    when = read(tmp_path / "r.xlsx", time="when").clock
    assert when is not None and when.steps.tolist() == [1.0] * (ROWS - 1)
    with pytest.raises(RecordError, match="has no sheet 'data'; close are 'Data'"):
        read(tmp_path / "r.xlsx", part="data")
    (tmp_path / "r.xlsx").write_bytes((tmp_path / "r.xlsx").read_bytes()[:2000])
    with pytest.raises(RecordError, match="is not a whole ZIP archive"):
        read(tmp_path / "r.xlsx")


def test_matlab(tmp_path, frame):
    pytest.importorskip("pymatreader")
    io = pytest.importorskip("scipy.io")
    t, u, y = (frame[name].to_numpy() for name in frame)
    content = {"t": t, "u": u[:, None], "y": y[None, :], "K": np.eye(3), "s": {"a": u, "b": y}}
    io.savemat(tmp_path / "r.mat", content)
    record = read(tmp_path / "r.mat")
    same(record, frame)
    assert record.clock is not None and record.clock.name == "t"
    assert record.found.skipped == (f"of another length than {ROWS}: K",)
    assert list(read(tmp_path / "r.mat", part="s").frame.columns) == ["a", "b"]
    (tmp_path / "r.mat").write_bytes(b"MATLAB 5.0 MAT-file" + bytes(range(256)))
    with pytest.raises(RecordError, match="is not a MAT file"):
        read(tmp_path / "r.mat")


def test_matlab_on_hdf5(tmp_path, frame):
    pytest.importorskip("pymatreader")
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "r.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for name in frame:
            made = file.create_dataset(name, data=frame[name].to_numpy()[None, :])
            made.attrs["MATLAB_class"] = np.bytes_("double")
    head = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM"
    path.write_bytes(head.ljust(512, b"\x00") + path.read_bytes()[512:])
    same(read(path), frame)


def test_tdms(tmp_path, frame):
    library = pytest.importorskip("nptdms")
    about = {"wf_increment": 0.5, "wf_start_offset": 0.0}
    channels = [
        library.ChannelObject("run", "u", frame["u"].to_numpy(), {**about, "unit_string": "V"}),
        library.ChannelObject("run", "y", frame["y"].to_numpy(), about),
    ]
    other = library.ChannelObject("notes", "z", np.arange(3.0))
    for path, objects in (("one", channels), ("two", [*channels, other])):
        with library.TdmsWriter(tmp_path / path) as writer:
            writer.write_segment(objects)
    record = read(tmp_path / "one")
    same(record, frame)
    assert record.clock is not None and record.clock.steps.tolist() == [0.5] * (ROWS - 1)
    assert record.found.units["u"] == "V"
    with pytest.raises(RecordError, match=r"has 2 groups; name one by --part: '(run|notes)'"):
        read(tmp_path / "two")
    same(read(tmp_path / "two", part="run"), frame)


def test_mdf(tmp_path, frame):
    library = pytest.importorskip("asammdf")
    t, u, y = (frame[name].to_numpy() for name in frame)
    with library.MDF(version="4.10") as file:
        file.append([library.Signal(u, t, name="u", unit="V"), library.Signal(y, t, name="y")])
        file.save(tmp_path / "r.mf4", overwrite=True)
    record = read(tmp_path / "r.mf4")
    same(record, frame)
    assert record.found.units == {"time": "s", "u": "V"}


def ulog(u, y, topics=("motor",)):
    """A ULog file, message by message, of numbers every 20 ms."""

    def message(kind, body):
        return struct.pack("<HB", len(body), ord(kind)) + body

    made = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0)
    made += message("F", b"motor:uint64_t timestamp;double u;double y;")
    for number, _ in enumerate(topics):
        made += message("A", struct.pack("<BH", number, number) + b"motor")
    for k, values in enumerate(zip(u, y, strict=True)):
        for number, _ in enumerate(topics):
            made += message("D", struct.pack("<HQdd", number, 20_000 * k, *values))
    return made


def test_ulog(tmp_path, frame):
    pytest.importorskip("pyulog")
    u, y = frame["u"], frame["y"]
    (tmp_path / "one").write_bytes(ulog(u, y))
    record = read(tmp_path / "one")
    same(record, frame)
    assert record.clock is not None and record.clock.name == "timestamp"
    assert record.clock.steps.tolist() == pytest.approx([0.02] * (ROWS - 1))
    (tmp_path / "two").write_bytes(ulog(u, y, ("motor", "motor")))
    with pytest.raises(RecordError, match=r"has 2 topics; name one by --part: 'motor\.0'"):
        read(tmp_path / "two")
    same(read(tmp_path / "two", part="motor.1"), frame)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.parametrize("kind", ["TDMS", "MDF", "ULog"])
def test_broken_files_of_measuring_systems(tmp_path, kind):
    mark, module = {
        "TDMS": (b"TDSm", "nptdms"),
        "MDF": (b"UnFinMF ", "asammdf"),
        "ULog": (b"ULog\x01\x12\x35\x01", "pyulog"),
    }[kind]
    pytest.importorskip(module)
    (tmp_path / "r").write_bytes(mark + bytes(reversed(range(200))))
    with pytest.raises(RecordError, match=f"whole {kind} file|no group|no topic"):
        read(tmp_path / "r")


@pytest.mark.parametrize("content", [b"UnFinMF ", b"MDF     4.10    "])
def test_half_an_mdf_file_leaves_nothing_open(tmp_path, monkeypatch, content):
    pytest.importorskip("asammdf")
    lost: list[object] = []
    monkeypatch.setattr(sys, "unraisablehook", lambda told: lost.append(told.exc_value))
    (tmp_path / "r").write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ResourceWarning)
        with pytest.raises(RecordError, match="whole MDF file"):
            read(tmp_path / "r")
        gc.collect()
    assert lost == []


@pytest.mark.parametrize(
    ("mark", "module", "line"),
    [
        (b"TDSm", "nptdms", r"reading TDMS needs nptdms: pip install 'forgetting\[tdms\]'"),
        (b"MDF     4.10", "asammdf", r"pip install 'forgetting\[mdf\]'"),
        (b"ULog\x01\x12\x35", "pyulog", r"pip install 'forgetting\[ulog\]'"),
        (b"MATLAB 5.0", "pymatreader", r"pip install 'forgetting\[cli\]'"),
        (b"\xd0\xcf\x11\xe0", "python_calamine", r"pip install 'forgetting\[cli\]'"),
    ],
)
def test_a_missing_library_is_told_with_its_line(tmp_path, monkeypatch, mark, module, line):
    (tmp_path / "r").write_bytes(mark + b"\x00" * 100)
    monkeypatch.setitem(__import__("sys").modules, module, None)
    with pytest.raises(ImportError, match=line):
        read(tmp_path / "r")


def test_xarray_and_arrow_streams(frame):
    xarray = pytest.importorskip("xarray")
    data = xarray.Dataset.from_dataframe(frame.set_index("time"))
    record = read(data)
    same(record, frame)
    assert record.clock is not None and record.clock.name == "time"
    with pytest.raises(RecordError, match="have 2: a, b"):
        read(xarray.DataArray(np.ones((2, 2)), dims=("a", "b"), name="x"))


def test_anything_that_shows_itself_by_arrows_protocol(frame):
    import pyarrow as pa

    class Stranger:
        def __arrow_c_stream__(self, requested_schema=None):
            return pa.Table.from_pandas(frame).__arrow_c_stream__(requested_schema)

    same(read(Stranger()), frame)


def test_a_pipe(tmp_path, frame):
    import threading

    path = tmp_path / "pipe"
    os.mkfifo(path)
    text = frame.to_csv(index=False)
    writer = threading.Thread(target=path.write_text, args=(text,))
    writer.start()
    same(read(path), frame)
    writer.join()
