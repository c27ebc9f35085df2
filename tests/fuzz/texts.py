"""Text files as loggers, spreadsheets and people write them, and what befalls them on the way."""

from __future__ import annotations

from dataclasses import dataclass

from hypothesis import strategies as st

SEPARATORS = (",", ";", "\t", "|", " ", "  ", ", ", "\x1f")
ENDS = ("\n", "\r\n", "\r", "\n\n")
CODES = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32", "cp1252", "cp1251", "shift_jis")
MISSING = ("", "NaN", "NA", "?", "--", "No Data", "null", "#DIV/0!", "inf", "-inf")
UNITS = ("V", "[A]", "(°C)", "m/s²", "s", "min", "-", "TS", "kW·h", "%")
ASIDES = ("# made by a logger", "% t I V", "// x", "Serial: 12", "", '"a;b,c', "1", "1,2,3", ";;;")
NUMBERS = ("0", "1", "-1", "1.5", "2,5", "1e308", "1e999", "-0", "1.234,5", "1,234.5", "0x1F", "१२")
DATES = (
    "2024-01-05 10:30:00", "2024-01-05T10:30:00Z", "2024-01-05T10:30+02:00", "05.01.2024 10:30",
    "1/5/2024", "13/1/2024", "5-Jan-2024", "10:30:00", "24:00", "999:59:59", "20240105",
    "1704447000", "1704447000000", "1:30 PM", "0001-01-01", "9999-12-31 23:59:59.999999999",
    "31.02.2024", "2024-02-30", "1 days 02:03:04", "99999999999999999999:00", "2024-W01-1",
)  # fmt: skip
"""Times in many forms, some of which are none."""
NAMES = ("time", "Time / s", "t", "I", "V", "x", "x", "", "lag", "np", "`a`", "a b", "Datum", "é\n")


@dataclass(frozen=True)
class File:
    """Bytes, and the options with which they are read."""

    content: bytes
    time: str | None
    missing: tuple[str, ...]
    encoding: str | None


def numbers() -> st.SearchStrategy[str]:
    """Numbers as text."""
    return st.one_of(
        st.sampled_from(NUMBERS),
        st.floats(allow_nan=False, width=32).map(repr),
        st.integers(-(10**30), 10**30).map(str),
        st.decimals(-1000, 1000, places=2).map(lambda x: str(x).replace(".", ",")),
    )


def column() -> st.SearchStrategy[st.SearchStrategy[str]]:
    """What one column holds: mostly one kind of cell."""
    odd = st.one_of(st.sampled_from(MISSING), st.text(max_size=8), numbers())
    kinds = [
        numbers(),
        st.floats(-100, 100).map(lambda x: f"{x:.3f}"),
        st.integers(0, 10**6).map(str),
        st.sampled_from(DATES),
        st.datetimes().map(str),
        st.timedeltas().map(str),
        st.sampled_from(DATES).map(lambda date: date),
        st.just("7"),
        st.text(max_size=5),
        st.sampled_from(('"a\nb"', '"', "'", "a;b", '""""', "a\x00b", "x" * 200_000)),
    ]
    return st.sampled_from([st.one_of(kind, kind, kind, kind, kind, odd) for kind in kinds])


@st.composite
def text(draw: st.DrawFn) -> str:
    """A table with a header, units, lines before and after it, and a counting time column."""
    kinds = draw(st.lists(column(), min_size=1, max_size=5))
    length = draw(st.integers(0, 12))
    rows = [[draw(kind) for kind in kinds] for _ in range(length)]
    if draw(st.booleans()):
        rows = [[str(number), *row] for number, row in enumerate(rows)]
        kinds = [st.just(""), *kinds]
    head = st.lists(st.sampled_from(NAMES), min_size=len(kinds), max_size=len(kinds))
    unit = st.lists(st.sampled_from(UNITS), min_size=len(kinds), max_size=len(kinds))
    top = [draw(each) for each in (head, unit) if draw(st.integers(0, 3))]
    separator, end = draw(st.sampled_from(SEPARATORS)), draw(st.sampled_from(ENDS))
    asides = st.lists(st.sampled_from(ASIDES), max_size=3)
    lines = [*draw(asides), *map(separator.join, [*top, *rows]), *draw(asides)]
    more = draw(st.sampled_from((1, 1, 1, 1, 50)))
    return end.join(lines * more) + draw(st.sampled_from(("", end)))


@st.composite
def damaged(draw: st.DrawFn, whole: bytes) -> bytes:
    """Bytes after a cut, a byte more, a byte changed, a stretch twice or a stretch of one byte."""
    content = bytearray(whole)
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, len(content)))
        end = min(len(content), at + draw(st.integers(0, 40)))
        kind = draw(st.sampled_from(("cut", "byte", "more", "twice", "gone", "long")))
        if kind == "cut":
            del content[at:]
        elif kind == "byte" and at < len(content):
            content[at] = draw(st.integers(0, 255))
        elif kind == "more":
            content[at:at] = draw(st.binary(max_size=8))
        elif kind == "twice":
            content[at:at] = content[at:end]
        elif kind == "gone":
            del content[at:end]
        elif kind == "long":
            content[at:at] = bytes([draw(st.integers(0, 255))]) * draw(
                st.sampled_from((3, 300, 200_000))
            )
    return bytes(content)


@st.composite
def files(draw: st.DrawFn) -> File:
    """A text in some encoding, whole or damaged, or bytes that are no text at all."""
    code = draw(st.sampled_from(CODES))
    content = draw(text()).encode(code, "replace")
    content = draw(st.one_of(st.just(content), damaged(content), st.binary(max_size=200)))
    return File(
        content,
        draw(st.sampled_from((None, None, None, "none", "time", "t", "x,time", "I", ""))),
        tuple(draw(st.lists(st.sampled_from(("7", "-200", "off", "", "nan")), max_size=2))),
        draw(st.sampled_from((None, None, None, "utf-8", "cp1252", "utf-16", "ebcdic?", "idna"))),
    )
