"""A measured record: read from a file, or taken from a data frame of any library."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import pandas as pd

from forgetting.record.clock import Clock, find_clock, gap_of
from forgetting.record.formats import Table, load
from forgetting.record.found import Found
from forgetting.record.frames import to_pandas, with_index
from forgetting.record.missing import Words, without_numbers, without_words
from forgetting.record.names import distinct
from forgetting.record.release import release
from forgetting.words.errors import RecordError

if TYPE_CHECKING:
    from narwhals.typing import IntoDataFrame


@dataclass(frozen=True)
class Record:
    """A table of signals, one row per sample, and its clock when it has one.

    Attributes
    ----------
    frame : pandas.DataFrame
        The columns: numbers with NaN for missing cells, times and text as read.
    clock : Clock or None
        The parsed time column.
    name : str
        Where it came from, for messages and titles.
    found : Found
        How it was read.
    """

    frame: pd.DataFrame
    clock: Clock | None = None
    name: str = field(default="record")
    found: Found = field(default_factory=Found)

    def describe(self) -> list[tuple[str, str]]:
        """What was recognised, as pairs of a word and what it is."""
        rows, columns = self.frame.shape
        pairs = [
            ("record", self.name),
            ("read as", self.found.words()),
            ("rows", f"{rows} of {columns} columns"),
            ("clock", "none" if self.clock is None else str(self.clock)),
            ("columns", ", ".join(map(str, self.frame.columns[:40]))),
        ]
        if columns > 40:
            pairs[-1] = ("columns", f"{pairs[-1][1]} and {columns - 40} more")
        if self.found.units:
            pairs.append(("units", self.found.names_with_units()))
        pairs.append(("left out", "; ".join(self.found.skipped) or "nothing"))
        return pairs


def read(
    source: str | Path | IntoDataFrame | Record | Callable[[], Record],
    time: str | None = None,
    *,
    gap: str | float | None = None,
    missing: str | float | Words = (),
    part: str | None = None,
    encoding: str | None = None,
) -> Record:
    """Read a record, say how it was read, and find its clock.

    Parameters
    ----------
    source : path, data frame, Record or callable
        A file of any name, recognised by its content: delimited text (any common separator,
        decimal comma or point, encoding, lines before the table, a row of units), Parquet (also a
        folder of it), Arrow and Feather, Excel, MAT, JSON lines, TDMS, MDF, ULog; packed by gzip,
        xz, bzip2, Zstandard or ZIP; ``"-"`` is standard input. Or a table in memory: a data frame
        of pandas, Polars, PyArrow, xarray or any other library that narwhals or Arrow knows. Or a
        function that makes a Record: whoever passes it does not hold the table meanwhile.
    time : str, optional
        Name of the time column, two with a comma for a date and a time of day, or "none". Without
        it the column is taken that runs most like time.
    gap : str or float, optional
        The longest step that is no gap, such as "5min" or 0.5 (seconds); "none" for no limit.
        Without it 1.5 median steps.
    missing : str, float or sequence of them
        What stands for a missing value beside empty cells, ``NaN``, ``?``, ``No Data`` and other
        usual words: words, or numbers such as −200, in all columns but the clock.
    part : str, optional
        Which sheet, group, topic, structure, or file of an archive.
    encoding : str, optional
        Encoding of text, when the guess is wrong.

    Returns
    -------
    Record

    Raises
    ------
    RecordError
        When the file is missing, empty, has no rows or cannot be parsed, a column named as clock
        holds no times, or the source is something else.

    Examples
    --------
    >>> import pandas as pd
    >>> record = read(pd.DataFrame({"time": [0.0, 0.1, 0.2, 5.0], "x": [1.0, -200.0, 3.0, 4.0]}),
    ...               missing=-200)
    >>> print(record.clock)
    'time' (numbers, taken as seconds), 1 gap: 1 step over 0.15 s
    >>> record.found.skipped
    ('-200 taken as missing, 1 cell',)
    """
    words = [missing] if isinstance(missing, str | int | float) else list(missing)
    if callable(source):
        source = source()
    if isinstance(source, Record):
        again = time is not None or gap is not None or words
        return with_clock(source, time, gap, words) if again else source
    if isinstance(source, str | Path):
        path = Path(source)
        name = "standard input" if str(path) == "-" else path.name or str(path)
        table = load(path, str(path) if str(path) != "-" else name, part, encoding)
        record = from_table(table, name, None if str(path) == "-" else path)
    else:
        record = from_table(Table(to_pandas(source), "data frame"), "record", None)
    release(len(record.frame))  # what reading took besides
    if len(record.frame) == 0:
        raise RecordError(f"{record.name} has a header and no rows")
    return with_clock(record, time, gap, words)


def from_table(table: Table, name: str, path: Path | None) -> Record:
    """A record of a table, its columns named and its index a column."""
    frame = table.frame
    units = dict(table.units)
    columns = frame.shape[1]
    frame = with_index(frame)
    shift = frame.shape[1] - columns
    names = distinct(frame.columns)
    frame = frame.set_axis(names, axis=1)
    by_name = {names[place + shift]: unit for place, unit in units.items() if place < columns}
    for place, column in enumerate(names):
        if frame.iloc[:, place].dtype.kind == "m":
            frame = frame.assign(**{column: frame[column].dt.total_seconds()})
            by_name.setdefault(column, "s")
    found = Found(path, table.format, table.details, by_name, tuple(table.skipped))
    return Record(frame, None, name, found)


def with_clock(
    record: Record, time: str | None, gap: str | float | None, missing: Sequence[str | float]
) -> Record:
    """Take words and numbers for missing values, and find the clock."""
    frame, met = without_words(record.frame, missing)
    clock = find_clock(frame, time, gap_of(gap), record.found.units, record.name)
    of_clock = () if clock is None else [clock.name, *clock.name.split(" + ")]
    frame, marked = without_numbers(frame, missing, of_clock)
    found = replace(record.found, skipped=(*record.found.skipped, *in_words(met + marked)))
    return Record(frame, clock, record.name, found)


def in_words(counts: Mapping[str, int]) -> list[str]:
    """Say what was taken as missing, and how often."""
    return [
        f"{word} taken as missing, {count} cell{'s' * (count > 1)}"
        for word, count in Counter(counts).most_common()
    ]
