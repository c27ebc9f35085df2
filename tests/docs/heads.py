"""The heads of the Rust files, as they stand there now."""

from __future__ import annotations

from pathlib import Path

from forgetting.choices import AXES

SOURCE = Path(__file__).parents[2] / "crates" / "forgetting" / "src"


def heads() -> dict[str, tuple[str, tuple[str, ...]]]:
    """By axis and name: the head of the file, and the names of the parameters."""
    found = {}
    for axis in AXES.values():
        for about in axis.entries:
            text = (SOURCE / axis.plural / f"{about['name']}.rs").read_text(encoding="utf-8")
            lines = (line for line in text.splitlines() if line.startswith("//!"))
            head = "\n".join(line.removeprefix("//!").removeprefix(" ") for line in lines)
            names = tuple(parameter["name"] for parameter in about["parameters"])
            found[f"{axis.plural}/{about['name']}"] = head, names
    return found
