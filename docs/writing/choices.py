"""The pages of rules, rates, weightings, gates and mixers."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from forgetting.choices import Axis

from . import example, figure
from .advice import when_not
from .header import Header, parsed
from .live import live
from .shown import made
from .typeset import block, formula, prose
from .write import write

CAPTION = {
    "rule": "Two parameters that drift. First the second input falls silent, then both do, then "
    "both return.",
    "rate": "Two parameters that drift, under `exponential` with this rate. First the second input "
    "falls silent, then both do, then both return.",
    "weighting": "Two parameters that drift, under `subspace` with this weighting, and a gross "
    "error of 20 standard deviations in one of 25 samples. First the second input falls silent, "
    "then both do, then both return.",
    "gate": "Two parameters that drift, under `exponential` with this gate. First the second input "
    "falls silent, then both do, then both return.",
    "mixer": "Two parameters that drift, followed by the eight members of a bank with this mixer. "
    "Below, the weight of each member, from a long memory (dark) to a short one (bright).",
}
UNITS = " The noise has variance 1; made by `{made}`."


def pages(docs: Path, axis: Axis) -> None:
    """Write the pages of an axis, with their figures."""
    folder = docs / axis.plural
    (folder / "figures").mkdir(parents=True, exist_ok=True)
    for about in axis.entries:
        figure.save(axis.name, about, folder / "figures" / f"{about['name']}.png")
        write(folder / f"{about['name']}.md", page(axis, about))
    write(folder / "index.md", overview(axis))


def page(axis: Axis, about: Mapping[str, Any]) -> str:
    """The page of one choice."""
    head = parsed(about["header"])
    names = tuple(parameter["name"] for parameter in about["parameters"])
    parts = [
        f"# {about['name']}",
        prose(head.summary, names),
        picture(axis, about),
        *live(axis.name, about),
        *use(axis, head, about, names),
        *equations(head, names),
        *properties(axis, head, names),
        *python(axis, about, head),
        *(["## Reference", head.reference] if head.reference else []),
    ]
    return "\n\n".join(parts) + "\n"


def picture(axis: Axis, about: Mapping[str, Any]) -> str:
    """The figure with its caption."""
    caption = CAPTION[axis.name] + UNITS.format(made=made(about))
    alt = f"Estimates of two parameters with their bands, and the eigenvalues of P: {about['name']}"
    return f":::{{figure}} figures/{about['name']}.png\n:alt: {alt}\n\n{caption}\n:::"


def use(axis: Axis, head: Header, about: Mapping[str, Any], names: tuple[str, ...]) -> list[str]:
    """When to use it, and when not."""
    good = [prose(item, names) for item in head.use]
    bad = [prose(item, names) for item in (*head.not_use, *when_not(axis.name, about))]
    parts = ["## When to use it", "\n\n".join(good)] if good else []
    return [*parts, *(["**When not**", listed(bad)] if bad else [])]


def equations(head: Header, names: tuple[str, ...]) -> list[str]:
    """The formulas and what belongs to them."""
    around = [
        "\n".join(prose(line, names) for line in each.split("\n")) for each in head.paragraphs
    ]
    return ["## Equations", block(head.equations, names), *around]


def properties(axis: Axis, head: Header, names: tuple[str, ...]) -> list[str]:
    """What is guaranteed, what it costs and what else is to be known."""
    parts = []
    if head.guarantees:
        link = "A1 to A3 are conditions of [the theory](../theory.md#when-is-it-stable)."
        parts += ["## Guarantees", link, listed(prose(each, names) for each in head.guarantees)]
    rest = [*head.notes, *head.cost]
    return [*parts, "## Good to know", listed(prose(each, names) for each in rest)]


def python(axis: Axis, about: Mapping[str, Any], head: Header) -> list[str]:
    """The class, and an example with what it prints."""
    text = example.code(axis.name, about)
    name = f'Its registry name is `{about["name"]}`, as in `fg.{axis.name}("{about["name"]}")`.'
    return [
        "## In Python",
        signature(axis, about, head),
        name,
        f"```python\n{text}```",
        f"```text\n{example.printed(text)}```",
    ]


def signature(axis: Axis, about: Mapping[str, Any], head: Header) -> str:
    """The class with its parameters, as an entry of the index."""
    kind = axis.classes[about["name"]]
    lines = [
        "```{eval-rst}",
        f".. py:class:: forgetting.{kind.__name__}{inspect.signature(kind)}",
        "",
    ]
    rated = "how much to forget: a number in (0, 1], or a rate, its name, or a function of yours"
    if about.get("forgetting_factor"):
        lines.append(f"   :param forgetting_factor: {rated}.")
        lines.append(
            "   :param half_life: in its place, the time after which half is forgotten: a number "
            'in the unit of your times, or a text such as ``"10min"``.'
        )
    for parameter in about["parameters"]:
        symbol = head.symbols.get(parameter["name"], "")
        shown = f":math:`{formula(symbol)}`, " if symbol else ""
        allowed = head.ranges.get(parameter["name"]) or parameter["range"]
        lines.append(f"   :param {parameter['name']}: {shown}{parameter['about']}; {allowed}.")
    return "\n".join([*lines, "```"])


def overview(axis: Axis) -> str:
    """The list of a registry, with the figure of each."""
    cards = "\n\n".join(card(about) for about in axis.entries)
    names = "\n".join(about["name"] for about in axis.entries)
    return OVERVIEW.format(
        title=axis.plural.capitalize(), summary=axis.summary, cards=cards, names=names
    )


OVERVIEW = """# {title}

{summary}

[How to choose](../choosing.md) comes first. All are shown on the same record; each page says when
to use it, when not, and what it guarantees.

::::{{grid}} 1 2 2 3
:gutter: 2

{cards}
::::

```{{toctree}}
:hidden:

{names}
```
"""


def card(about: Mapping[str, Any]) -> str:
    """A small figure and a sentence that lead to a page."""
    name = about["name"]
    return (
        f":::{{grid-item-card}} {name}\n:link: {name}\n:link-type: doc\n"
        f":img-bottom: figures/{name}.png\n\n{prose(about['summary'])}\n:::"
    )


def listed(items: Any) -> str:
    """A list in Markdown."""
    return "\n".join(f"- {item}" for item in items)
