"""The head of a Rust file, which is the documentation of a rule or the like, taken apart."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

GUARANTEES = ("Proper", "P̄ bounded", "P bounded")
USE, NOT, COST, REFERENCE = "Use it", "Not ", "Cost:", "Reference:"


@dataclass
class Header:
    """What a head says, by what it is about; every part is Markdown on one line.

    Attributes
    ----------
    summary : str
        The first sentence.
    equations : list of str
        The lines of the block of formulas.
    symbols : dict
        The symbol of each parameter, by its name.
    ranges : dict
        Its allowed values, in words.
    use, not_use, guarantees, cost, notes : list of str
        The items of the list.
    paragraphs : list of str
        What stands outside that list: sentences, or another list.
    reference : str
        Where it comes from.
    """

    summary: str = ""
    equations: list[str] = field(default_factory=list)
    symbols: dict[str, str] = field(default_factory=dict)
    ranges: dict[str, str] = field(default_factory=dict)
    use: list[str] = field(default_factory=list)
    not_use: list[str] = field(default_factory=list)
    guarantees: list[str] = field(default_factory=list)
    cost: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    paragraphs: list[str] = field(default_factory=list)
    reference: str = ""


def parsed(text: str) -> Header:
    """Take a head apart.

    Examples
    --------
    >>> head = parsed("Forgets.\\n\\n```text\\nF = 0\\n```\\n\\n- Cost: O(n).\\n- Use it\\n  now.")
    >>> head.summary, head.equations, head.cost, head.use
    ('Forgets.', ['F = 0'], ['Cost: O(n).'], ['Use it now.'])
    """
    head = Header()
    for part in re.split(r"\n\s*\n", text.strip()):
        lines = part.splitlines()
        if not head.summary:
            head.summary = " ".join(lines)
        elif lines[0].startswith("```"):
            head.equations = lines[1:-1]
        elif lines[0].startswith("|"):
            _table(head, lines[2:])
        elif lines[0].startswith("- "):
            _list(head, _items(lines))
        elif lines[0].startswith(REFERENCE):
            head.reference = " ".join(lines).removeprefix(REFERENCE).strip()
        else:
            head.paragraphs.append(" ".join(lines))
    return head


def _table(head: Header, rows: list[str]) -> None:
    """Read the table of parameters."""
    for row in rows:
        symbol, name, allowed, _ = (cell.strip() for cell in row.strip("|").split("|"))
        head.symbols[name], head.ranges[name] = symbol, allowed


def _items(lines: list[str]) -> list[str]:
    """The items of a list, each on one line."""
    items: list[str] = []
    for line in lines:
        if line.startswith("- "):
            items.append(line[2:])
        else:
            items[-1] += f" {line.strip()}"
    return items


def _list(head: Header, items: list[str]) -> None:
    """Put each item where it belongs; a list before that of the properties stays as it is."""
    if any(item.startswith(COST) for item in items):
        for item in items:
            _place(head, item)
    else:
        head.paragraphs.append("\n".join(f"- {item}" for item in items))


def _place(head: Header, item: str) -> None:
    """Put an item where it belongs."""
    if item.startswith(GUARANTEES):
        head.guarantees.append(item)
    elif item.startswith(USE):
        head.use.append(item)
    elif item.startswith(NOT):
        head.not_use.append(item)
    elif item.startswith(COST):
        head.cost.append(item)
    else:
        head.notes.append(item)
