"""Formulas for KaTeX, which lies in `_static/katex` and typesets them in the reader's browser."""

from __future__ import annotations

from typing import Any

from docutils import nodes


def inline(self: Any, node: Any) -> None:
    """A formula in a line."""
    self.body.append(f'<span class="formula">{self.encode(node.astext())}</span>')
    raise nodes.SkipNode


def display(self: Any, node: Any) -> None:
    """A formula on lines of its own."""
    text = node.astext()
    if "\\\\" in text and "\\begin" not in text:
        text = f"\\begin{{aligned}}{text}\\end{{aligned}}"
    self.body.append(f'<div class="formula">{self.encode(text)}</div>')
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Tell Sphinx of the renderer `katex`."""
    app.add_html_math_renderer("katex", (inline, None), (display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
