"""A block of formulas, each with its note, as a table of two columns."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from .formula import formula, is_formula
from .prose import prose
from .symbols import FUNCTIONS

APART = re.compile(r" {2,}")
INDENTED = " " * 20
"""A line that begins in the column of the notes."""
WORDS = re.compile(rf"(?<![A-Za-z_])(?!(?:{'|'.join(FUNCTIONS)})\b)[A-Za-z]{{3,}}")
OR = "or"
"""The one word that may stand alone before a formula: this line is another case of the last."""


@dataclass
class Row:
    """A line of the table: formulas, and what is said of them."""

    formulas: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def markdown(self, names: tuple[str, ...]) -> str:
        """The line as an item of a list table."""
        left = formula("   ".join(each.rstrip(",;") for each in self.formulas))
        shown = rf"$\displaystyle {left}$" if left else ""
        said = ""
        for note in self.notes:
            made = f"${formula(note)}$" if _plain(note) else prose(note, names)
            apart = "; " if _plain(note) and said[-1:].isalnum() else " "
            said = f"{said}{apart}{made}" if said else made
        return f"* - {shown}\n  - {said}"


def block(lines: list[str], names: tuple[str, ...] = ()) -> str:
    """The table of a block: formulas on the left, what is said of them on the right.

    Parameters
    ----------
    lines : list of str
        As they stand in the file. Two spaces or more part formulas and notes; a line that has
        only a note goes on with that of the line above.
    names : tuple of str
        Names of parameters, which may stand in a formula.
    """
    rows: list[Row] = []
    for line in filter(str.strip, lines):
        row = _parted(line)
        if rows and not row.formulas and line.startswith(" "):
            rows[-1].notes += row.notes
        else:
            rows.append(row)
    shown = [row.markdown(names) for row in rows]
    return "\n".join([":::{list-table}", ":class: formulas", "", *shown, ":::"])


def _parted(line: str) -> Row:
    """Formulas until the first note; only the first may have words in it."""
    cells = APART.split(line.strip())
    first = not line.startswith(INDENTED)
    for number, cell in enumerate(cells):
        if not (_plain(cell) or (number == 0 and (cell == OR or (first and is_formula(cell))))):
            return Row(cells[:number], cells[number:])
    return Row(cells)


def _plain(cell: str) -> bool:
    """Whether a cell is a formula without words, and no number of an equation."""
    return is_formula(cell) and not (WORDS.search(cell) or cell.startswith("("))
