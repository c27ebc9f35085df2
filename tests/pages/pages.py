"""What the pages for readers hold: Python, what it prints, and command lines."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
MARK = "not run by the tests"
"""A comment with these words stands in a block of Python, or behind a command, that needs what no
test has: a broker, a device, hours."""
FENCE = re.compile(r"^```")


@dataclass(frozen=True)
class Block:
    """A block of a page.

    Attributes
    ----------
    kind : str
        "python" or "command".
    text : str
        As it stands on the page, a command without its indentation.
    printed : str or None
        The block of text below a block of Python.
    """

    kind: str
    text: str
    printed: str | None = None

    @property
    def is_run(self) -> bool:
        """Whether the page says nothing to the contrary."""
        return MARK not in self.text


def blocks(page: str) -> list[Block]:
    """All Python and all command lines of a page, in their order."""
    found: list[Block] = []
    lines = page.splitlines()
    # Indented lines are code behind a blank line, but not within a list.
    at, code, in_list = 0, True, False
    while at < len(lines):
        line = lines[at]
        if FENCE.match(line):
            end = next(i for i in range(at + 1, len(lines)) if FENCE.match(lines[i]))
            found += fenced(line[3:].strip(), lines[at + 1 : end], found, lines[at - 1])
            at = end
            code = in_list = False
        elif not line.strip():
            code = True
        elif line.startswith("    ") and code and not in_list:
            begun = found and found[-1].text.endswith("\\")
            before = found.pop().text[:-1] if begun else ""
            found.append(Block("command", before + line.strip()))
        else:
            code = False
            in_list = line.startswith(("- ", "* ", "  ")) or line[:2].rstrip(".").isdigit()
        at += 1
    return found


def fenced(kind: str, lines: list[str], found: list[Block], above: str) -> list[Block]:
    """The block between two fences; text directly below Python becomes what that prints."""
    text = "".join(line + "\n" for line in lines)
    if kind == "text" and found and FENCE.match(above):
        found[-1] = Block(found[-1].kind, found[-1].text, text)
        return []
    return [Block("python", text)] if kind == "python" else []
