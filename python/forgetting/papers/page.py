"""The report page: every claim and every figure in one file that opens without a network."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

import forgetting as fg
from forgetting.files import write_text
from forgetting.report.svg import themed

from .catalogue import PAPERS
from .claim import Check, Claim
from .picture import Picture
from .table import summary

IDENTIFIER = re.compile(r'(\bid="|url\(#|href="#)')


@dataclass(frozen=True)
class Part:
    """One paper on the page."""

    title: str
    claims: Sequence[Claim]
    figures: Sequence[tuple[Picture, Markup]]


def write_page(
    claims: Sequence[Claim],
    checks: Sequence[Check],
    pictures: Sequence[Picture],
    folder: Path,
    path: Path,
) -> None:
    """Render the page.

    Parameters
    ----------
    claims : sequence of Claim
        In the order of `checks`.
    checks, pictures : sequence
    folder : Path
        Where the figures were saved.
    path : Path
        The file to write.
    """
    paper_of = [check.module.split(".")[0] for check in checks]
    parts = []
    for name, title in PAPERS.items():
        mine = [claim for claim, paper in zip(claims, paper_of, strict=True) if paper == name]
        drawn = [
            (each, embedded(each, folder))
            for each in pictures
            if each.module.startswith(name + ".")
        ]
        if mine:
            parts.append(Part(title, mine, drawn))
    loader = ChoiceLoader(
        [PackageLoader("forgetting.papers", "."), PackageLoader("forgetting.report", ".")]
    )
    environment = Environment(loader=loader, autoescape=True, undefined=StrictUndefined)
    page = environment.get_template("report.html.j2")
    html = page.render(parts=parts, summary=summary(claims), version=fg.__version__)
    write_text(path, html)


def embedded(each: Picture, folder: Path) -> Markup:
    """The saved SVG, with names of its own so that figures on one page do not mix."""
    svg = (folder / f"{each.name}.svg").read_text(encoding="utf-8")
    return Markup(themed(IDENTIFIER.sub(rf"\g<1>{each.name}-", svg), each.caption))
