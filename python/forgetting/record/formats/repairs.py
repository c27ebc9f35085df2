"""What is checked and put right in the rows of a text after pandas has read them."""

from __future__ import annotations

import pandas as pd

from forgetting.record.formats import cells
from forgetting.record.formats.dialect import Dialect, trimmed
from forgetting.record.formats.layout import Layout
from forgetting.words.errors import RecordError


def check_names(source: str, frame: pd.DataFrame, found: Layout) -> None:
    """Refuse cells beyond the last name of the header."""
    named = len(trimmed(found.names))
    if found.header is None or named == frame.shape[1]:
        return
    beyond = frame.iloc[:, named:].notna()
    if beyond.to_numpy().any():
        row = int(beyond.any(axis=1).to_numpy().argmax())
        cells = named + int(beyond.iloc[row].to_numpy().nonzero()[0][-1]) + 1
        which = "its first row" if row == 0 else f"row {row + 1}"
        raise RecordError(f"{source} has {cells} cells in {which} but {named} names in its header")


def with_points(column: pd.Series, form: Dialect) -> pd.Series:
    """Write numbers with a point where they stand among words, so that pandas left them alone."""
    if form.decimal == "." and form.thousands is None:
        return column
    text = column.astype("string").str.strip()
    plain = text.str.replace(form.thousands, "", regex=False) if form.thousands else text
    if form.decimal == ",":
        plain = plain.str.replace(",", ".", regex=False)
    number = text.str.match(cells.NUMBER).fillna(False).astype(bool)
    return column.where(~number, plain).astype(object)


def without_headers(frame: pd.DataFrame) -> tuple[pd.DataFrame, list[str]]:
    """Drop rows that say the names again, as where files were put behind one another.

    Where a line of words stands above them, another table begins there, and this one ends.
    """
    named = [i for i, name in enumerate(frame.columns) if name]
    if not named or any(frame.iloc[:, i].dtype.kind in "fiub" for i in named):
        return frame, []
    again = pd.Series(True, index=frame.index)
    for place in named:
        again &= frame.iloc[:, place].astype("string").str.strip() == str(frame.columns[place])
    again = again.fillna(False).astype(bool)
    if not again.any():
        return frame, []
    first = int(again.to_numpy().argmax())
    if first and frame.iloc[first - 1].notna().sum() == 1 < len(named):
        return frame.iloc[: first - 1], [f"{len(frame) - first + 1} lines of another table below"]
    count = int(again.sum())
    return frame[~again], [f"{count} line{'s' * (count > 1)} with the names again"]
