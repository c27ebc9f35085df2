"""The README's tables, made from the registries."""

from __future__ import annotations

import re
from pathlib import Path

import forgetting as fg

README = Path(__file__).resolve().parents[1] / "README.md"


def _claim(words: str) -> str:
    return {"always": "always", "no": "no"}.get(words, words)


def rules_table() -> str:
    """One line a rule: what it does and what it guarantees."""
    lines = [
        "| rule | what it does | proper | P bounded above | P bounded below | cost |",
        "|---|---|---|---|---|---|",
    ]
    for rule in fg.rules():
        cells = [
            f"`{rule['name']}`",
            rule["summary"].rstrip("."),
            *(_claim(rule[claim]) for claim in ("proper", "bounded_above", "bounded_below")),
            rule["cost"].replace("n^2", "n²").replace("n^3", "n³"),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def page(text: str) -> str:
    """The README with its tables made again."""
    made = f"<!-- rules -->\n\n{rules_table()}\n\n<!-- /rules -->"
    return re.sub(r"<!-- rules -->.*<!-- /rules -->", lambda _: made, text, flags=re.DOTALL)


def write() -> None:
    """Write the README again."""
    README.write_text(page(README.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    write()
