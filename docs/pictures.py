"""The pictures of a page, drawn by the Python on it."""

from __future__ import annotations

import contextlib
import io
import re
from pathlib import Path
from typing import Any

from matplotlib import pyplot as plt

from forgetting.files import whole
from forgetting.plot import styled

PYTHON = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"^!\[[^]]*\]\(pictures/(?P<name>[^)]+)\)", re.MULTILINE)


def draw(page: Path) -> None:
    """Run the Python of a page and write the figure that each block leaves, in their order.

    The page names its pictures below the blocks that draw them: ``![...](pictures/name.png)``.

    Raises
    ------
    ValueError
        When a block with a picture below it draws none, or one without draws one.
    """
    text = page.read_text(encoding="utf-8")
    names: dict[str, Any] = {"__name__": page.stem}
    found = list(PYTHON.finditer(text))
    ends = [*(block.start() for block in found[1:]), len(text)]
    with styled(), contextlib.redirect_stdout(io.StringIO()):
        for block, end in zip(found, ends, strict=True):
            exec(compile(block[1], page.name, "exec"), names)
            pictures = [match["name"] for match in PICTURE.finditer(text, block.end(), end)]
            save(pictures, page, block[1])


def save(pictures: list[str], page: Path, block: str) -> None:
    """Write the figures that are open under their names, and close them."""
    figures = [plt.figure(number) for number in plt.get_fignums()]
    if len(figures) != len(pictures):
        count = f"{len(figures)} figures drawn, {len(pictures)} named"
        raise ValueError(f"{page.name}: {count} below {block!r}")
    for figure, name in zip(figures, pictures, strict=True):
        path = page.parent / "pictures" / name
        path.parent.mkdir(exist_ok=True)
        with whole(path) as written:
            figure.savefig(written, format="png", dpi=150, facecolor="white")
        plt.close(figure)
