"""Matplotlib figures as inline SVG that follows the page's light or dark theme."""

from __future__ import annotations

import io
import re

from markupsafe import Markup
from matplotlib import pyplot as plt
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from forgetting.plot.style import (
    BLUE,
    FAINT,
    GREEN,
    GRID,
    INK,
    ORANGE,
    PURPLE,
    SKY,
    VERMILLION,
)

VARIABLES = {
    INK: "--ink",
    FAINT: "--faint",
    GRID: "--grid",
    BLUE: "--blue",
    VERMILLION: "--vermillion",
    GREEN: "--green",
    PURPLE: "--purple",
    ORANGE: "--orange",
    SKY: "--sky",
}
"""Colours of `forgetting.plot.style` and the CSS variables that stand for them in a page."""

PREAMBLE = re.compile(r"^.*?(?=<svg)", re.DOTALL)
METADATA = re.compile(r"<metadata>.*?</metadata>", re.DOTALL)
NAMESPACES = re.compile(r'\s+xmlns(:\w+)?="[^"]*"')
FONT = re.compile(r"font: ([^;\"]*?)px '[^;\"]*")
PATH = re.compile(r' d="[^"]*"')
DIGITS = re.compile(r"(\.\d)\d+")
"""A path's points are in 1/72 inch: one decimal is finer than a screen, and a third of the file."""


def inline(figure: Figure, description: str) -> Markup:
    """Render a figure and close it.

    Parameters
    ----------
    figure : Figure
        Drawn inside ``with forgetting.plot.styled():``.
    description : str
        What the picture shows, for those who cannot see it.
    """
    for patch in (figure.patch, *(axes.patch for axes in figure.axes)):
        patch.set_visible(False)
    stream = io.StringIO()
    # `savefig` draws twice, once to lay out and once to write; an SVG is laid out as it is written
    FigureCanvasSVG(figure).print_svg(stream, metadata={"Date": None})  # type: ignore[no-untyped-call]
    plt.close(figure)
    return Markup(themed(stream.getvalue(), description))


def themed(svg: str, description: str) -> str:
    """Strip what HTML does not need and put the page's colours and font in."""
    svg = PREAMBLE.sub("", svg, count=1)
    svg = NAMESPACES.sub("", METADATA.sub("", svg))
    svg = PATH.sub(lambda path: DIGITS.sub(r"\1", path[0]), svg)
    for colour, variable in VARIABLES.items():
        svg = svg.replace(colour, f"var({variable})")
    svg = FONT.sub(r"font: \1px var(--font)", svg)
    label = description.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
    return svg.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1)
