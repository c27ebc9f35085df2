"""Rules, rates, weightings and gates as Python objects, made from the registries of the Rust core.

Every entry of a registry becomes a class here, under the name of its Rust type: its constructor
takes the entry's parameters, checks their names, and leaves their values to the core to check.
Every axis, of which the core has the list, gets a base class, a function that makes an entry by
name and one that lists the entries: for rules ``Rule``, ``rule`` and ``rules``.

>>> import forgetting as fg
>>> fg.rule("subspace", forgetting_factor=0.98, threshold=1e-3)
Subspace(forgetting_factor=0.98, threshold=0.001)
>>> fg.rate("unity_zone", smallest=0.8)
UnityZone(sensitivity=0.05, smallest=0.8, largest=1.0)
>>> fg.gate("dead_zone", width=2)
DeadZone(width=2.0, otherwise='hold')
"""

from __future__ import annotations

import copy
import inspect
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np

from . import _core
from .choice import Choice, plain
from .words.duration import seconds_of
from .words.suggestion import close

ForgettingFactor: TypeAlias = "float | Rate | str | Callable[[_core.Evidence], float]"


class Rule(Choice):
    """Where to forget.

    Attributes
    ----------
    forgetting_factor : float or Rate or None
        How much to forget; None for a rule that does not use it. A rule around another rule
        has that of the other. In its place ``half_life`` may be given: after that time half of the
        information is left, a number in the unit of the times that come with the samples (in
        samples if none come), or a text such as "10min", in seconds.
    parameters : dict
        The rule's own parameters.
    """

    forgetting_factor: float | Rate | None = None

    def _take(self, values: dict[str, Any]) -> None:
        half_life = values.pop("half_life", None)
        self.forgetting_factor = values.pop("forgetting_factor", None)
        if half_life is not None:
            self.forgetting_factor = _factor_of(half_life)
        if "factors" in values and not isinstance(
            self.forgetting_factor, int | float | Rate | None
        ):
            # a list in the place of the common factor: one for each block
            values["factors"], self.forgetting_factor = self.forgetting_factor, None
        for entry in self.about["parameters"]:
            if entry["kind"] == "rule":
                inner = values[entry["name"]]
                if isinstance(inner, str):
                    inner = values[entry["name"]] = AXES["rule"].make(inner)
                self.forgetting_factor = getattr(inner, "forgetting_factor", None)
        self.forgetting_factor = _as_rate(self.forgetting_factor)
        self.parameters = values

    def arguments(self) -> dict[str, Any]:
        if not self.about["forgetting_factor"] or self.forgetting_factor is None:
            return self.parameters
        return {"forgetting_factor": self.forgetting_factor, **self.parameters}

    def _all_arguments(self) -> dict[str, Any]:
        rate = {"forgetting_factor": self.forgetting_factor}
        return {**(rate if self.about["forgetting_factor"] else {}), **self.parameters}


class Rate(Choice):
    """How much to forget: what a rule takes in place of a forgetting factor."""


class Weighting(Choice):
    """How far to trust a sample."""


class Gate(Choice):
    """Whether a sample is used."""


class Mixer(Choice):
    """What weighs the members of a bank; see `forgetting.mixers`."""


def _factor_of(half_life: Any) -> Any:
    """The factor of one unit of time that leaves half of the information after this one: 2^(-1/h).

    Examples
    --------
    >>> _factor_of("1s"), _factor_of([1, 2])
    (0.5, [0.5, 0.7071067811865476])
    """
    if isinstance(half_life, list | tuple | np.ndarray):
        return [_factor_of(each) for each in half_life]
    try:
        seconds = seconds_of(half_life)
    except ValueError as error:
        raise _core.InvalidInput(f"half_life = {half_life!r}: {error}") from None
    if not seconds > 0:
        raise _core.InvalidInput(f"half_life = {half_life!r}, allowed: (0, inf)")
    return 2.0 ** (-1.0 / seconds)


def _as_rate(given: Any) -> Any:
    """A number, or a rate made from what else may stand for a forgetting factor."""
    if isinstance(given, str):
        return AXES["rate"].make(given)
    if isinstance(given, type):
        raise _core.InvalidInput(
            f"forgetting_factor = {given.__name__}, allowed: a rate, {given.__name__}(...)"
        )
    if callable(given):
        return AXES["rate"].make("function", function=given)
    if isinstance(given, Rate) and given.name == "constant":
        return given.parameters["forgetting_factor"]
    return plain(given, "real")


def _signature(about: Mapping[str, Any]) -> inspect.Signature:
    """The constructor of a registry entry; the forgetting factor comes first."""
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    parameters = [
        inspect.Parameter(
            entry["name"],
            kind,
            default=inspect.Parameter.empty if entry["required"] else entry["default"],
        )
        for entry in about["parameters"]
    ]
    if about.get("forgetting_factor"):
        parameters.insert(0, inspect.Parameter("forgetting_factor", kind, default=0.99))
        last = inspect.Parameter("half_life", inspect.Parameter.KEYWORD_ONLY, default=None)
        parameters.append(last)
    required_first = sorted(
        parameters, key=lambda p: (p.kind, p.default is not inspect.Parameter.empty)
    )
    return inspect.Signature(required_first)


def _make(base: type[Choice], about: Mapping[str, Any]) -> type[Choice]:
    """The class of a registry entry."""
    body = {
        "about": about,
        "name": about["name"],
        "__doc__": about["header"],
        "__module__": __package__,
        "__signature__": _signature(about),
    }
    return type(about["type_name"], (base,), body)


class Axis:
    """A question that every estimator answers with an entry of one registry.

    Attributes
    ----------
    name, plural : str
        What one entry is called, and several: "rule", "rules".
    summary : str
        What the axis is.
    entries : list of dict
        What the registry says of each.
    kind : type
        The class that those of the entries derive from.
    classes : dict
        The class of each entry, by its registry name.
    """

    def __init__(self, described: Mapping[str, Any]) -> None:
        self.name: str = described["name"]
        self.plural: str = described["plural"]
        self.summary: str = described["summary"]
        self.entries: list[dict[str, Any]] = described["entries"]
        self.kind = _base(self.name, self.summary)
        self.classes = {about["name"]: _make(self.kind, about) for about in self.entries}

    def make(self, name: str, **parameters: Any) -> Any:
        """Make the entry of this registry name."""
        if name not in self.classes:
            allowed, meant = ", ".join(self.classes), close(list(self.classes), str(name))
            raise _core.InvalidInput(f"{self.name} = {name!r}, allowed: {allowed}{meant}")
        kind = self.classes[name]
        try:
            return kind(**parameters)
        except TypeError as error:
            known = ", ".join(inspect.signature(kind).parameters) or "none"
            raise _core.InvalidInput(
                f"{self.name} {name}: {error}; its parameters: {known}"
            ) from None

    def exports(self) -> dict[str, Any]:
        """What users see of the axis, by name."""

        def make(name: str, **parameters: Any) -> Any:
            return self.make(name, **parameters)

        def entries() -> list[dict[str, Any]]:
            return copy.deepcopy(self.entries)

        article = {"name": self.name, "plural": self.plural}
        functions = {self.name: (make, _MAKE), self.plural: (entries, _ENTRIES)}
        for name, (function, documentation) in functions.items():
            function.__name__ = function.__qualname__ = name
            function.__module__ = __package__
            function.__doc__ = documentation.format(**article)
        named = {kind.__name__: kind for kind in (self.kind, *self.classes.values())}
        return {**named, **{name: function for name, (function, _) in functions.items()}}


_MAKE = """Make the {name} of this registry name.

Parameters
----------
name : str
    Registry name, one of ``[each["name"] for each in forgetting.{plural}()]``.
**parameters
    Its parameters by name; a forgetting factor is one, if it takes one.

Raises
------
InvalidInput
    For a name that is not in the registry, or a parameter that the {name} does not have.
"""

_ENTRIES = """List the registry of {plural}.

Returns
-------
list of dict
    For each {name} its name, type_name, summary, header (its documentation) and parameters; for a
    rule also forgetting_factor, largest_rows, proper, bounded_above, bounded_below and cost.
"""


def _base(name: str, summary: str) -> type[Choice]:
    """The class that entries of an axis derive from: the one above, if there is one."""
    written = {kind.__name__.lower(): kind for kind in (Rule, Rate, Weighting, Gate, Mixer)}
    body = {"__doc__": summary, "__module__": __package__}
    return written.get(name) or type(name.capitalize(), (Choice,), body)


AXES = {described["name"]: Axis(described) for described in _core.axes()}
"""The axes by name, in the order in which the core lists them."""


def rule_from_description(description: Mapping[str, Any], dtype: str) -> Rule:
    """The rule that `RLS.describe` describes."""
    described = _rounded(description, dtype)
    return _described(described["rule"], described["rate"])


def weighting_from_description(description: Mapping[str, Any], dtype: str) -> Weighting:
    """The weighting that `RLS.describe` describes."""
    described = _rounded(description["weighting"], dtype)
    made: Weighting = AXES["weighting"].make(described["name"], **described["parameters"])
    return made


def gate_from_description(description: Mapping[str, Any], dtype: str) -> Gate:
    """The gate that `RLS.describe` describes."""
    described = _rounded(description["gate"], dtype)
    made: Gate = AXES["gate"].make(described["name"], **described["parameters"])
    return made


def _rounded(value: Any, dtype: str) -> Any:
    """The shortest numbers that the number type rounds to those described."""
    if isinstance(value, Mapping):
        return {name: _rounded(inner, dtype) for name, inner in value.items()}
    if isinstance(value, list):
        return [_rounded(inner, dtype) for inner in value]
    if isinstance(value, float) and dtype == "float32":
        return float(str(np.float32(value)))
    return value


def _described(described: Mapping[str, Any], rate_: Mapping[str, Any]) -> Rule:
    """The rule of this name and these parameters, which uses the rate where it has one."""
    made = AXES["rule"].classes[described["name"]]
    values = dict(described["parameters"])
    for entry in made.about["parameters"]:
        if entry["kind"] == "rule":
            values[entry["name"]] = _described(values[entry["name"]], rate_)
    if made.about["forgetting_factor"]:
        values["forgetting_factor"] = AXES["rate"].make(rate_["name"], **rate_["parameters"])
    rule: Rule = made(**values)  # type: ignore[assignment]
    return rule
