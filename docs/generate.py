"""Pages that are written from the package itself, so that they cannot drift from it."""

from __future__ import annotations

from pathlib import Path

from forgetting.choices import AXES, Axis
from forgetting.papers import PAPERS, all_checks, all_pictures
from forgetting.papers.errata.markdown import escaped, page
from forgetting.papers.table import summary

SEEDS = 50
"""Noise realisations for the table of claims on its page; `forgetting reproduce` uses 200."""


def generate(docs: Path) -> None:
    """Write every generated page under `docs`."""
    write(docs / "errata.md", page())
    write(docs / "papers.md", claims())
    for axis in AXES.values():
        for about in axis.entries:
            write(docs / axis.plural / f"{about['name']}.md", choice(about))
        write(docs / axis.plural / "index.md", overview(axis))
    write(docs / "figures" / "README.rst", FIGURES)
    for each in all_pictures():
        write(docs / "figures" / f"plot_{each.name}.py", script(each))


def write(path: Path, text: str) -> None:
    """Write a page unless it says that already: Sphinx then reads only what changed."""
    path.parent.mkdir(exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def choice(about: dict) -> str:
    """The page of a rule, rate, weighting or gate: its header, and how it is written."""
    rated = [("forgetting_factor", "0.99, or a [rate](../rates/index.md)")]
    first = rated if about.get("forgetting_factor") else []
    shown = [*first, *((p["name"], default(p)) for p in about["parameters"])]
    lines = [f"- `{name}`: default {value}" for name, value in shown] or ["It has no parameters."]
    facts = f"The class is `forgetting.{about['type_name']}`, its registry name `{about['name']}`."
    return (
        f"# {about['name']}\n\n{about['header'].strip()}\n\n## In Python\n\n{facts}\n\n"
        + "\n".join(lines)
        + "\n"
    )


def default(parameter: dict) -> str:
    """How a default is shown."""
    return "none: must be given" if parameter["required"] else f"`{parameter['default']!r}`"


def overview(axis: Axis) -> str:
    """The list of a registry."""
    rows = [f"| [{e['name']}]({e['name']}.md) | {escaped(e['summary'])} |" for e in axis.entries]
    names = "\n".join(e["name"] for e in axis.entries)
    table = "\n".join(["| name | |", "|---|---|", *rows])
    words = f"{axis.summary}\n\n{PAGES}"
    title = axis.plural.capitalize()
    return f"# {title}\n\n{words}\n\n{table}\n\n```{{toctree}}\n:hidden:\n\n{names}\n```\n"


PAGES = (
    "One page each, written from the head of the file that implements it. "
    "[How to choose](../choosing.md) comes first."
)


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
