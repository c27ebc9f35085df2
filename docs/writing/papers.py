"""The pages of the papers: claims, errata, and figures, all computed when they are written."""

from __future__ import annotations

from pathlib import Path

from forgetting.papers import PAPERS, all_checks, all_pictures
from forgetting.papers.errata.markdown import escaped, page
from forgetting.papers.table import summary

from . import typeset
from .write import write

SEEDS = 50
"""Noise realisations for the table of claims on its page; `forgetting reproduce` uses 200."""


def pages(docs: Path) -> None:
    """Write the pages of claims and errata, and a script for each figure."""
    write(docs / "errata.md", typeset.page(page()))
    write(docs / "papers.md", typeset.page(claims()))
    write(docs / "figures" / "README.rst", FIGURES)
    for each in all_pictures():
        write(docs / "figures" / f"plot_{each.name}.py", script(each))


def claims() -> str:
    """Every claim of the papers beside what was measured."""
    found = [(check, check(SEEDS)) for check in all_checks()]
    parts = [CLAIMS.format(summary=summary([claim for _, claim in found]), seeds=SEEDS)]
    for name, title in PAPERS.items():
        parts += [f"## {title}\n", "| source | printed | measured | verdict |", "|---|---|---|---|"]
        for check, claim in found:
            if check.module.startswith(name + "."):
                why = f"<br>*{escaped(claim.reason)}*" if claim.reason else ""
                cells = map(escaped, (claim.source, claim.printed, claim.measured))
                verdict = claim.verdict if claim.holds else f"**fails** ({claim.verdict})"
                parts.append(f"| {' | '.join(cells)}{why} | {verdict} |")
        parts.append("")
    return "\n".join(parts)


CLAIMS = """# The papers, claim by claim

    forgetting reproduce                      # all of it: figures, this table, a report page
    forgetting reproduce vdf --example 9
    forgetting reproduce opd --seeds 200

{summary}. The table was measured when this page was built, the Monte Carlo claims over {seeds}
noise realisations. *Reproduced*: holds as printed. *Corrected*: fails as printed and holds as
stated in italics. *Not reproducible*: the text does not say enough; what can be said was measured.
See also the [figures](auto_figures/index.rst) and the [errata](errata.md).
"""

FIGURES = """Figures of the papers
=====================

Each is drawn by one short function of ``forgetting.papers`` when this page is built; its page shows
the function and the claims that belong to it.
"""


def script(each) -> str:
    """The example that draws one figure."""
    module = each.module
    source = f"../python/forgetting/papers/{module.replace('.', '/')}.py"
    title = f"{each.source}"
    head = f'"""\n{title}\n{"=" * len(title)}\n\n{each.caption}\n"""\n'
    return head + SCRIPT.format(
        module=module.rsplit(".", 1)[0],
        part=module.rsplit(".", 1)[1],
        name=attribute(each),
        source=source,
    )


def attribute(each) -> str:
    """The name of the picture in its module."""
    return each.draw.__name__


SCRIPT = """
# sphinx_gallery_thumbnail_number = 1
from forgetting.papers.claim import checks
from forgetting.papers.{module} import {part}
from forgetting.plot import styled

with styled():
    {part}.{name}()

# %%
# What the paper says of it, and what was measured:
for check in checks({part}):
    claim = check(seeds=50)
    print(f"{{claim.source}}: {{claim.printed}}")
    print(f"    {{claim.verdict}}: {{claim.measured}}")

# %%
# The whole module:
#
# .. literalinclude:: /{source}
#    :language: python
"""
