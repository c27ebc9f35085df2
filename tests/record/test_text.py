"""Delimited text as instruments and spreadsheets write it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forgetting.record import RecordError, identify, read


@pytest.fixture
def table(tmp_path: Path):
    """Read text or bytes as a file."""

    def made(content: str | bytes, written: str = "utf-8", **options):
        path = tmp_path / "record.dat"
        path.write_bytes(content if isinstance(content, bytes) else content.encode(written))
        return read(path, **options)

    return made


def columns(record):
    return {name: record.frame[name].tolist() for name in record.frame.columns}


@pytest.mark.parametrize(
    ("text", "separator"),
    [
        ("t|I|V\n0|1|2.5\n1|2|3.5\n", "bar"),
        ("t\tI\tV\r\n0\t1\t2.5\r\n1\t2\t3.5\r\n", "tab"),
        ("   t     I    V\n 0.0   1.0  2.5\n 1.0   2.0  3.5\n", "white space"),
        ("t;I;V;;\n0;1;2,5;;\n1;2;3,5;;\n", "semicolon"),
        ("# logger 3\n# t, I, V\n0, 1, 2.5\n1, 2, 3.5\n", "comma"),
        ("%t I V\n0 1 2.5\n1 2 3.5\n", "white space"),
        ('"t","I","V"\n"0","1","2,5"\n"1","2","3,5"\n', "comma"),
        ("t,I,V\n0,1,2.5\n1,2,3.5\n\nEnd of data\n", "comma"),
    ],
)
def test_separators(table, text, separator):
    record = table(text)
    assert record.found.details["separator"] == separator
    assert columns(record) == {"t": [0, 1], "I": [1, 2], "V": [2.5, 3.5]}


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("x;y\n1.234,5;2\n12.000,25;3\n", [1234.5, 12000.25]),
        ('x,y\n"1,234.5",2\n"12,000.25",3\n', [1234.5, 12000.25]),
        ("x;y\n1,234;2\n0,5;3\n", [1.234, 0.5]),
        ("x\n1,5\n2,5\n", [1.5, 2.5]),
        ("x;y\n1.234;2\n2.5;3\n", [1.234, 2.5]),
        ("x y\n-1,5E-3 2\n+2,0e1 3\n", [-0.0015, 20.0]),
    ],
)
def test_decimal_signs(table, text, values):
    assert table(text).frame["x"].tolist() == values


def test_decimal_commas_far_down(table):
    """The first lines of a long file have whole numbers only."""
    rows = [f"{k};{k}" for k in range(40_000)] + ["40000;0,5", "40001;1,5"]
    record = table("t;y\n" + "\n".join(rows) + "\n")
    assert record.frame["y"].iloc[-1] == 1.5 and record.frame["y"].iloc[7] == 7


@pytest.mark.parametrize("lines", [1, 7, 450, 5000])
def test_lines_before_the_table(table, lines):
    head = "".join(f"Setting {k}: {k * 1.5} V, {k}\n" for k in range(lines))
    body = "".join(f"{k},{k % 5},{2 + 3 * (k % 5)}\n" for k in range(60))
    record = table(f"{head}\ntime,I,V\ns,mA,V\n{body}")
    assert list(record.frame.columns) == ["time", "I", "V"] and len(record.frame) == 60
    assert record.found.units == {"time": "s", "I": "mA", "V": "V"}
    assert record.found.skipped == (f"{lines + 1} lines above the names",)


def test_a_format_row_below_the_names(table):
    text = "agency\tdatetime\tflow\n5s\t20d\t14n\n"
    text += "A\t2021-01-01 00:00\t5\nA\t2021-01-01 00:15\tIce\nA\t2021-01-01 00:30\t6\n"
    record = table("# remarks\n#\n" + text)
    assert record.found.units == {} and record.frame["flow"].isna().sum() == 1
    assert "1 line between names and numbers" in record.found.skipped
    assert "Ice taken as missing, 1 cell" in record.found.skipped


def test_a_name_over_two_lines(table):
    assert columns(table('"Temp\n[°C]",y\n1,2\n2,3\n')) == {"Temp [°C]": [1, 2], "y": [2, 3]}


def test_without_names(table):
    record = table("0;1,5\n1;2,5\n")
    assert list(record.frame.columns) == ["column 1", "column 2"]
    assert "names" in record.found.details


def test_a_bad_cell_in_the_first_row_is_no_name(table, tmp_path):
    table("I,V\nlow,2\n2,4\n3,6\n")
    with pytest.raises(RecordError, match=r"column 'I' .* row 1 is 'low'.*--missing"):
        identify(tmp_path / "record.dat", formula="V ~ I")


@pytest.mark.parametrize(
    "encoding",
    ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp1252", "cp850",
     "mac_roman"],
)  # fmt: skip
def test_encodings(table, encoding):
    record = table("Zeit [s];Temp [°C]\n0;20,5\n1;21,5\n", encoding)
    assert columns(record) == {"Zeit [s]": [0, 1], "Temp [°C]": [20.5, 21.5]}


def test_cyrillic_is_guessed_and_others_are_named(table):
    assert "Время" in table("Время;Ток\n0;1,5\n1;2,5\n", "cp1251").frame.columns
    assert "電流" in table("t,電流\n0,1\n1,2\n", "shift_jis", encoding="shift_jis").frame.columns
    with pytest.raises(RecordError, match="is not utf-9 text"):
        table("t,x\n0,1\n", encoding="utf-9")
    with pytest.raises(RecordError, match="is not ascii text"):
        table("t,°\n0,1\n", encoding="ascii")


def test_words_for_missing_values(table):
    text = "x,y,z\n1,?,OK\nNo Data,2,OK\n3,n/a,Bad\n--,4,OK\n-200,5,OK\n"
    record = table(text, missing=[-200, "sensor off"])
    np.testing.assert_array_equal(record.frame["x"], [1, np.nan, 3, np.nan, np.nan])
    np.testing.assert_array_equal(record.frame["y"], [np.nan, 2, np.nan, 4, 5])
    assert record.frame["z"].tolist() == ["OK", "OK", "Bad", "OK", "OK"]
    assert "-200 taken as missing, 1 cell" in record.found.skipped
    off = table("x\n1\nsensor off\n3\n", missing="Sensor Off")
    assert off.frame["x"].isna().tolist() == [False, True, False]


def test_a_missing_number_is_not_looked_for_in_the_clock(table):
    record = table("time,x\n0,5\n1,0\n2,7\n", missing=0)
    assert record.frame["time"].tolist() == [0, 1, 2] and record.frame["x"].isna().sum() == 1


def test_a_very_long_cell(table):
    assert table("x,note\n1," + "a" * 200_000 + "\n2,b\n").frame["x"].tolist() == [1, 2]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"\x00\x01\x02\x03junk" * 50, "no table: it is neither text nor a known format"),
        (b"\x89PNG\r\n\x1a\n" + bytes(range(32)) * 9, "no table"),
        (b"%PDF-1.4 1 2 3\n", "is PDF"),
        (b"<!DOCTYPE html><p>404", "is HTML or XML"),
        (b"no numbers here\nnor here\n", "no line of it holds one"),
        (b"   \n\n\t\n", "is empty"),
    ],
)
def test_what_is_no_table(table, content, words):
    with pytest.raises(RecordError, match=words):
        table(content)


def test_random_bytes_never_end_in_a_traceback(table):
    rng = np.random.default_rng(0)
    signs = np.frombuffer(b"0123456789.,;\t\n\r \"'-+eE#%abc:/\xe9\x00\xff", dtype=np.uint8)
    read_ones = 0
    for _ in range(300):
        try:
            table(rng.choice(signs, size=rng.integers(1, 120)).tobytes())
            read_ones += 1
        except RecordError:
            pass
    assert read_ones > 0
