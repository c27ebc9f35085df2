"""Formulas in a page that was written as Markdown with plain formulas, its signs escaped."""

from __future__ import annotations

import re

from .prose import prose

ESCAPED = re.compile(r"\\([_^<|\[\]*])")
SPECIAL = re.compile(r"[_^<>|\[\]]|(?<!\w)\*|\\")
"""What would mean something else in Markdown if it were no longer escaped."""
CELL = re.compile(r"(?<!\\)\|")
FORMULA = re.compile(r"\$[^$]*\$")
EMPHASIS = re.compile(r"\*\*?[^*]+\*\*?|<br>|`[^`]*`|\[[^\]]*\]\([^)]*\)")


def page(text: str) -> str:
    """The page with its formulas typeset where that is safe, line by line and cell by cell.

    A cell in which something of Markdown's would be left unescaped stays as it is.

    Examples
    --------
    >>> print(page("| Example 1 | P\\\\_k⁻¹ ≤ 2 | falls from 3 to 1 |"))
    | Example 1 | $P_{k}^{-1} \\le  2$ | falls from 3 to 1 |
    """
    return "\n".join(_line(line) for line in text.split("\n"))


def _line(line: str) -> str:
    if line.startswith(("#", "    ", "|---", "```")):
        return line
    cells = CELL.split(line)
    first = 2 if len(cells) > 1 else 0  # the first column names a source
    return "|".join([*cells[:first], *map(_cell, cells[first:])])


def _cell(cell: str) -> str:
    """One cell, or the whole of a line that is in no table; notes in emphasis by themselves."""
    parts = re.split(r"(<br>\*.*\*|\*\*[^*]+\*\*)", cell)
    return "".join(part if number % 2 else _text(part) for number, part in enumerate(parts))


def _text(text: str) -> str:
    try:
        made = prose(ESCAPED.sub(r"\1", text))
    except ValueError:  # a sign that no formula of ours has
        return text
    left = EMPHASIS.sub("", FORMULA.sub("", made))
    return text if SPECIAL.search(left) else made
