"""Which modules and names are public, and under which headings they are shown."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from dataclasses import dataclass

import forgetting
from forgetting.choices import AXES

CLASSES = {kind.__name__ for axis in AXES.values() for kind in axis.classes.values()}
"""They have pages of their own."""


@dataclass(frozen=True)
class Module:
    """A page.

    Attributes
    ----------
    name : str
        The module; its docstring is the head of the page.
    title : str
        Of the page.
    groups : tuple of (str, tuple of str)
        Headings and names; what of ``__all__`` is in none of them comes last, in its order.
    more : tuple of str
        Names that are not in ``__all__``, with their module where it is another.
    """

    name: str
    title: str
    groups: tuple[tuple[str, tuple[str, ...]], ...] = ()
    more: tuple[str, ...] = ()

    def names(self) -> list[str]:
        """All public names that this page has to show."""
        listed = getattr(importlib.import_module(self.name), "__all__", ())
        own = [name for name in listed if name not in CLASSES and name != "__version__"]
        if self.name != forgetting.__name__:  # what `import forgetting` shows is on its page
            own = [name for name in own if not _shown_above(self.name, name)]
        return [*own, *self.more]

    def parted(self) -> Iterator[tuple[str, list[str]]]:
        """Headings and the names below each."""
        grouped = [name for _, names in self.groups for name in names]
        for heading, names in self.groups:
            yield heading, list(names)
        rest = [name for name in self.names() if name not in grouped]
        if rest:
            yield ("More" if self.groups else ""), rest


def _shown_above(module: str, name: str) -> bool:
    value = getattr(importlib.import_module(module), name)
    return getattr(forgetting, name, None) is value


MODULES = (
    Module(
        "forgetting",
        "forgetting",
        (
            ("One estimator", ("RLS", "Update", "Run", "Evidence")),
            (
                "How far to trust it",
                (
                    "Health",
                    "ExcitationMeter",
                    "predict",
                    "Prediction",
                    "Intervals",
                    "DelayedIntervals",
                    "bounded",
                ),
            ),
            ("Several on one stream", ("Bank", "BankUpdate")),
            (
                "Dynamic models",
                (
                    *("ARX", "FIR", "AR", "ARMA", "ARMAX", "OE", "BJ"),
                    *("PolynomialModel", "forecasts", "Forecasts"),
                ),
            ),
            ("Choosing settings", ("tune", "tune_arx", "tune_model", "Tuning")),
            ("Many streams", ("Fleet", "FleetUpdate", "FleetHealth")),
            ("Errors and codes", ("InvalidInput", "NumericalRange", "GATE", "SKIPPED")),
            (
                "Choices",
                tuple(n for a in AXES.values() for n in (a.kind.__name__, a.name, a.plural)),
            ),
        ),
    ),
    Module("forgetting.models", "Models"),
    Module("forgetting.polynomials", "Polynomial models"),
    Module("forgetting.tuning", "Tuning"),
    Module("forgetting.record", "Records"),
    Module("forgetting.judgement", "Judgement"),
    Module("forgetting.analysis", "Analysis"),
    Module("forgetting.plot", "Plots"),
    Module("forgetting.report", "Reports"),
    Module("forgetting.stream", "Streams"),
    Module("forgetting.tables", "Tables"),
    Module("forgetting.frames", "Data frames"),
    Module("forgetting.sklearn", "scikit-learn"),
    Module("forgetting.river", "river"),
    Module("forgetting.files", "Files", more=("whole",)),
    Module("forgetting.demo", "Demonstrations"),
    Module(
        "forgetting.papers",
        "Papers",
        more=("forgetting.papers.picture.Picture", "forgetting.papers.errata.Erratum"),
    ),
)
DATA = {
    "GATE": "What a gate says, by the code in ``run.gate``: update, freeze or hold.",
    "SKIPPED": "Why a sample was left out, by the code in ``run.skipped``; None: it was used.",
    "PALETTE": "Colours that the colour-blind can tell apart, as hexadecimal text.",
    "PAPERS": "Titles of the papers, by their short names.",
    "SEEDS": "Noise realisations of a Monte Carlo claim where the number is not given.",
    "DEMOS": "The demonstrations by name: each takes a folder and returns what came out.",
    "Severity": "How much a finding weighs: a word, one of those that `Finding` lists.",
}
"""What is neither a class nor a function, in a sentence."""
DESCRIBED = ("spark",)
"""Modules that cannot be imported without a Java runtime; a page by hand says what they offer."""
INTERNAL = (
    "_core",
    "choice",
    "choices",
    "cli",
    "delayed",
    "extras",
    "fleet",
    "health",
    "meter",
    "prediction",
    "registry",
    "words",
)
"""Modules that users do not import from: what is public of them is in `forgetting`."""
