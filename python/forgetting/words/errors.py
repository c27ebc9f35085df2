"""What a user can get wrong besides the numbers of an estimator."""

from __future__ import annotations

HEAD, TAIL = 700, 200
"""Characters that a sentence keeps of its begin and its end where it is longer than both."""


class RecordError(ValueError):
    """One sentence that names the file, column, row or option at fault.

    It is one line, and no longer than a screen: names of columns, cells and formulas come from
    files and may be of any length.

    Examples
    --------
    >>> str(RecordError("no column 'a\\nb'"))
    "no column 'a b'"
    >>> len(str(RecordError("x" * 100_000)))
    903
    """

    def __init__(self, sentence: str) -> None:
        line = " ".join(sentence.splitlines())
        if len(line) > HEAD + TAIL:
            line = f"{line[:HEAD]} … {line[-TAIL:]}"
        super().__init__(line)


def first_line(error: BaseException) -> str:
    """Shorten a library's message to its first line."""
    return str(error).strip().splitlines()[0].rstrip(".") if str(error).strip() else "unreadable"
