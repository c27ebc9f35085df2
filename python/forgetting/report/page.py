"""A report page: titled blocks of text, tables and pictures in one HTML file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

import forgetting as fg
from forgetting.files import write_text
from forgetting.judgement import Judgement


@dataclass(frozen=True)
class Table:
    """A table; cells are text already, all columns but the first are right-aligned.

    `prose` aligns all to the left and breaks their lines.
    """

    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    prose: bool = False


@dataclass(frozen=True)
class Block:
    """A part of a page: any of its fields may be empty.

    Attributes
    ----------
    title, text : str
        Heading and paragraph.
    table : Table, optional
    pictures : sequence of Markup
        Inline SVG, from `forgetting.report.svg.inline`.
    folded : bool
        Whether it starts closed.
    """

    title: str = ""
    text: str = ""
    table: Table | None = None
    pictures: Sequence[Markup] = ()
    folded: bool = False


@dataclass(frozen=True)
class Figure:
    """A key number with its name and a remark."""

    name: str
    value: str
    remark: str = ""


@dataclass(frozen=True)
class Page:
    """A whole report.

    Attributes
    ----------
    title, subtitle : str
    facts : sequence of pairs of str
        A word and what it is, at the top: how the record was read.
    verdicts : sequence of str
        Sentences.
    judgement : Judgement, optional
        The verdict, in its colour, above everything else.
    figures : sequence of Figure
        Key numbers.
    blocks : sequence of Block
        The parts below.
    """

    title: str
    subtitle: str = ""
    facts: Sequence[tuple[str, str]] = ()
    verdicts: Sequence[str] = ()
    figures: Sequence[Figure] = ()
    blocks: Sequence[Block] = field(default_factory=tuple)
    judgement: Judgement | None = None


def write(page: Page, path: str | Path) -> None:
    """Render a page to a file."""
    environment = Environment(
        loader=PackageLoader("forgetting.report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    html = environment.get_template("page.html.j2").render(page=page, version=fg.__version__)
    write_text(path, html)
