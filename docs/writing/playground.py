"""The playground, a page of its own: linked from the front page where it has been built."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

MARK = "<!-- playground -->"
CARD = """:::{grid-item-card} Playground
:link: playground/index.html
:link-type: url

Drop a table, choose a model, switch the input off and watch: in this browser, nothing leaves it.
:::"""


def built(docs: Path) -> Path | None:
    """Its folder, if its page is there."""
    folder = docs / "playground"
    return folder if (folder / "index.html").is_file() else None


def link(app: Any, docname: str, source: list[str]) -> None:
    """Put its card on the front page, or nothing."""
    if docname == "index":
        card = CARD if built(Path(app.srcdir)) else ""
        source[0] = source[0].replace(MARK, card)


def copy(app: Any, error: Exception | None) -> None:
    """Put it among the built pages."""
    folder = built(Path(app.srcdir))
    if folder is not None and error is None:
        shutil.copytree(folder, Path(app.outdir) / "playground", dirs_exist_ok=True)


def setup(app: Any) -> dict[str, bool]:
    """Tell Sphinx."""
    app.connect("source-read", link)
    app.connect("build-finished", copy)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
