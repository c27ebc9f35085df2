"""Lines as sensors write them: separators, decimal commas, JSON, clocks, missing values."""

from __future__ import annotations

import json

import numpy as np
import pytest

from forgetting.stream import Settings, Stream
from forgetting.stream.parse import FEW
from forgetting.words.errors import RecordError

from .conftest import arx, as_csv, fed, plant, rows

FIELDS = "row,measured,theta,skipped"


def same(data: bytes, **settings) -> None:
    """These lines give what the same numbers give as CSV."""
    expected = rows(fed(as_csv(plant(60)), arx(), FIELDS).lines)
    assert rows(fed(data, arx(**settings), FIELDS).lines) == expected


def lines_of(form: str, table: np.ndarray) -> bytes:
    return "".join(form.format(*map(repr, row)) + "\n" for row in table.tolist()).encode()


@pytest.mark.parametrize("separator", [";", "\t", "|", " ", "  "])
def test_separators(separator):
    head = separator.join(["t_s", "u", "y"])
    same(f"{head}\n".encode() + lines_of(separator.join(["{}"] * 3), plant(60)))


def test_decimal_comma():
    same(b"t_s;u;y\n" + lines_of("{};{};{}", plant(60)).replace(b".", b","))


def test_windows_lines_comments_blank_lines_and_a_byte_order_mark():
    body = lines_of("{},{},{}", plant(60)).replace(b"\n", b"\r\n\r\n")
    same(b"\xef\xbb\xbf# a logger\r\nt_s,u,y\r\n# more\r\n" + body)


def test_names_given():
    same(lines_of("{},{},{}", plant(60)), names=("t_s", "u", "y"))
    same(as_csv(plant(60)), names=("t_s", "u", "y"))


def test_separator_given():
    same(b"t_s|u|y\n" + lines_of("{}|{}|{}", plant(60)), separator="|")


def test_names_again_are_no_row():
    lines = as_csv(plant(60)).splitlines(keepends=True)
    same(b"".join([*lines[:20], lines[0], *lines[20:]]))


def test_json_lines():
    same(lines_of('{{"t_s": {}, "u": {}, "y": {}, "note": "x"}}', plant(60)))
    same(lines_of('{{"y": {2}, "more": {{"a": [1]}}, "t_s": {0}, "u": {1}}}', plant(60)))


def test_whole_numbers_and_text_in_json():
    data = b'{"u": 1, "y": 2}\n{"u": "3", "y": 4.5}\n' * (2 * FEW)
    told = rows(fed(data, Settings(output=("y",), input=("u",)), "measured,skipped").lines)
    assert [each["measured"] for each in told[:2]] == [2.0, 4.5]
    assert {each["skipped"] for each in told} == {"used"}


@pytest.mark.parametrize("many", [3, 5 * FEW])
@pytest.mark.parametrize("word", ["", "NaN", "null", "n/a", "?", "-200", "ERR", "sensor off"])
def test_missing_values(word, many):
    lines = as_csv(plant(many)).split(b"\n")
    lines[2] = b",".join([*lines[2].split(b",")[:2], word.encode()])
    stream = fed(b"\n".join(lines), arx(missing=("-200", "sensor off")), "skipped")
    assert [each["skipped"] for each in rows(stream.lines)][:4] == ["missing"] * 3 + ["used"] * (
        many > 3
    )
    assert stream.tally.malformed == 0


def test_both_ways_of_reading_give_the_same_bits():
    """A block goes through Arrow, a few lines through Python."""
    rng = np.random.default_rng(0)
    values = rng.normal(size=(400, 2)) * 10.0 ** rng.integers(-200, 200, size=(400, 2))
    data = as_csv(values, "u,y")
    settings = Settings(output=("y",), input=("u",))
    whole, single = (Stream(settings, fields="measured") for _ in range(2))
    expected = [{"measured": value} for value in values[:, 1].tolist()]
    assert rows(whole.feed(data).lines) == expected
    lines = [line for each in data.splitlines(keepends=True) for line in single.feed(each).lines]
    assert rows(lines) == expected


@pytest.mark.parametrize(
    ("stamps", "gaps"),
    [
        (["2024-03-01T00:00:00Z", "2024-03-01T00:00:01Z", "2024-03-01T00:00:09Z"], 1),
        (["2024-03-01 00:00:00", "2024-03-01 00:00:01.5", "2024-03-01 00:00:02"], 0),
        (["2024-03-01T00:00:00+01:00", "2024-03-01T00:00:01+01:00", "2024-02-29T23:00:09Z"], 1),
        (["1709251200000000001", "1709251201000000002", "1709251209000000003"], 1),
        (["1709251200.25", "1709251201.25", "1709251209"], 1),
    ],
)
def test_clocks(stamps, gaps):
    """Date-times, and numbers of which no digit may be lost, come out as they went in."""
    data = "time,u,y\n" + "".join(f"{each},{k},{k}\n" for k, each in enumerate(stamps))
    stream = fed(data.encode(), arx(gap=2.0), "time")
    assert stream.tally.gaps == gaps
    times = [each["time"] for each in rows(stream.lines)]
    assert times == [float(each) if "." in stamps[0] and "-" not in each else number(each)
                     for each in stamps]  # fmt: skip


def number(text: str):
    """Whole numbers as such, date-times as text."""
    return int(text) if text.isdigit() else text


def test_clock_named_and_none():
    data = as_csv(plant(50), "a,u,y")
    assert "time" not in rows(fed(data, arx()).lines)[0]
    assert rows(fed(data, arx(time="a")).lines)[3]["time"] == 0.3
    assert "time" not in rows(fed(as_csv(plant(50)), arx(time="none")).lines)[0]


@pytest.mark.parametrize(
    ("data", "settings", "words"),
    [
        (b"t_s,u,y\n0,1,2\n", dict(output=("Y2",)), "has no column 'Y2'"),
        (b"t_s,u,y\n0,1,2\n", dict(output=("yy",)), "close are 'y'"),
        (b"05/01/2024,u,y\n", dict(names=("t", "u", "y"), time="t"), "ISO|date-times as in"),
        (b"hello\nworld\n", {}, "no numbers stand below it"),
        (b"{oops\n", {}, "no JSON object"),
        (b"u,y\n1,2\n", dict(fields="time"), "the stream has no clock"),
        (b"u,y\n1,2\n", dict(fields="gate"), "a bank has none"),
        (b"u,y\n1,2\n", dict(fields="memry"), "close are 'memory'"),
        (b"u,y\n1,2\n", dict(fields="error,error"), "twice"),
        (b"u,y\n1,2\n", dict(output=()), "say the model"),
        (b"u,y\n1,2\n", dict(formula="y ~ u"), "not both"),
        (b"u,y\n1,2\n", dict(rule="subspace", half_life="5s"), "the stream has none"),
        (b"u,y\n1,2\n", dict(half_life="5s"), "not auto"),
        (b"u,y\n1,2\n", dict(rule="subspace", half_life="soon"), "half_life is 'soon'"),
    ],
)
def test_refusals(data, settings, words):
    given = dict(settings)
    fields = given.pop("fields", None)
    if given.get("names"):
        data = data.replace(b"u,y", b"1,2")
    with pytest.raises(RecordError, match=words):
        fed(data, arx(**given), fields)


@pytest.mark.parametrize(
    ("term", "named"),
    [
        ("center(u)", "center()"),
        ("scale(u)", "scale()"),
        ("poly(u, 2)", "poly()"),
        ("bs(u, df=4)", "bs()"),
        ("C(u)", "C()"),
        ("u.rolling(3).mean()", ".mean"),
        ("u.cumsum()", ".cumsum"),
        ("u.shift(1)", ".shift"),
        ("np.mean(u)", "np.mean"),
        ("np.cumsum(u)", "np.cumsum"),
        ("lag(u, -1)", "lag"),
    ],
)
def test_what_a_formula_cannot_tell_row_by_row_is_named(term, named):
    with pytest.raises(RecordError) as refused:
        fed(as_csv(plant(5)), Settings(formula=f"y ~ {term}"))
    assert named in str(refused.value)


def test_an_infinite_term_is_missing():
    data = b"u,y\n1,2\n0,3\n2,4\n"
    told = rows(fed(data, Settings(formula="y ~ np.log(u)"), "skipped").lines)
    assert [each["skipped"] for each in told] == ["used", "missing", "used"]


def test_quotation_marks_hold_no_lines_together():
    """A mark that is left open ends with its line, also in a column that nobody uses."""
    lines = as_csv(plant(60), "t_s,u,y,note").replace(b"\n", b",x\n").splitlines(keepends=True)
    lines[0] = b"t_s,u,y,note\n"
    expected = fed(b"".join(lines), arx(), FIELDS).lines
    lines[20] = lines[20].replace(b"x", b'"x')
    lines[30] = lines[30].replace(b"x", b'x"')
    lines[40] = lines[40].replace(b"x", b'"a, b"')
    assert fed(b"".join(lines), arx(), FIELDS).lines == expected


def test_names_with_signs_of_templates():
    data = b'"u %b","y ""q"" %"\n1,2\n3,4\n'
    stream = fed(data, Settings(output=('y "q" %',), input=("u %b",)), "theta")
    assert list(rows(stream.lines)[0]["theta"]) == ["u %b(k)", "offset"]
    header = fed(data, Settings(output=('y "q" %',), input=("u %b",)), "error", "csv").lines[0]
    assert header == b'"error:y ""q"" %"\n'


def test_json_is_json():
    for line in fed(as_csv(plant(400)), arx()).lines:
        json.loads(line, parse_constant=lambda word: pytest.fail(word))


UNITS = [b"s,A,V", b"[s],[A],[V]", b"s,1,V", b",A,V", b"s,-,"]


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("block", [1, 10_000])
def test_a_row_of_units_is_kept_and_no_row(units, block):
    head, *body = as_csv(plant(60)).splitlines(keepends=True)
    lines = [head, units + b"\n", *body]
    stream = Stream(arx(), "json", FIELDS)
    made = [stream.feed(b"".join(lines[k : k + block])).lines for k in range(0, len(lines), block)]
    expected = rows(fed(as_csv(plant(60)), arx(), FIELDS).lines)
    assert rows([line for some in made for line in some]) == expected
    bare = [cell.strip("[]") for cell in units.decode().split(",")]
    known = {name: unit for name, unit in zip(("t_s", "u", "y"), bare, strict=True)}
    assert stream.form.units == {n: unit for n, unit in known.items() if unit not in ("", "1", "-")}


def test_the_row_of_units_says_what_the_clock_counts_in():
    table = plant(60)
    table[:, 0] *= 1000
    head, *body = as_csv(table, "t,u,y").splitlines(keepends=True)
    stream = fed(b"".join([head, b"ms,A,V\n", *body]), arx(time="t"))
    assert stream.stamps.scale == 1e-3


def test_units_come_again_with_the_names_of_a_further_file():
    head, *body = as_csv(plant(60)).splitlines(keepends=True)
    stream = Stream(arx(), "json", FIELDS)
    made = stream.feed(b"".join([head, b"s,A,V\n", *body[:30]])).lines
    stream.further_input()
    made += stream.feed(b"".join([head, b"# next\n", b"s,A,V\n", *body[30:]])).lines
    assert rows(made) == rows(fed(as_csv(plant(60)), arx(), FIELDS).lines)


def test_a_saved_state_keeps_units():
    head, *body = as_csv(plant(60)).splitlines(keepends=True)
    first, second = Stream(arx(), "json", FIELDS), Stream(arx(), "json", FIELDS)
    made = first.feed(b"".join([head, b"s,A,V\n", *body[:30]])).lines
    second.restore(json.loads(json.dumps(first.state())))
    made += second.feed(b"".join(body[30:])).lines
    assert second.form.units == {"t_s": "s", "u": "A", "y": "V"}
    assert rows(made) == rows(fed(as_csv(plant(60)), arx(), FIELDS).lines)


def test_words_under_the_names_are_no_units():
    with pytest.raises(RecordError, match="no numbers stand below it"):
        fed(b"t_s,u,y\nfirst run,second run,third run\n0,1,2\n", arx())
