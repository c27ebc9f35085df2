"""Rules, rates and weightings as Python objects, made from the registries of the Rust core.

Every entry of a registry becomes a class here, under the name of its Rust type: its constructor
takes the entry's parameters, checks their names, and leaves their values to the core to check.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any, ClassVar

from . import _core


class Choice:
    """A name of a registry and the values of its parameters."""

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    parameters: dict[str, Any]

    def __init__(self, *arguments: Any, **named: Any) -> None:
        bound = inspect.signature(type(self)).bind(*arguments, **named)
        bound.apply_defaults()
        self._take(dict(bound.arguments))

    def _take(self, values: dict[str, Any]) -> None:
        self.parameters = values

    def _arguments(self) -> dict[str, Any]:
        return self.parameters

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self._arguments().items())
        return f"{type(self).__name__}({given})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))


class Rule(Choice):
    """Where to forget.

    Attributes
    ----------
    forgetting_factor : float or Rate or None
        How much to forget; None for a rule that does not use it. A rule around another rule
        has that of the other.
    parameters : dict
        The rule's own parameters.
    """

    forgetting_factor: float | Rate | None = None

    def _take(self, values: dict[str, Any]) -> None:
        self.forgetting_factor = values.pop("forgetting_factor", None)
        for entry in self.about["parameters"]:
            if entry["kind"] == "rule":
                inner = values[entry["name"]]
                if isinstance(inner, str):
                    inner = values[entry["name"]] = rule(inner)
                self.forgetting_factor = getattr(inner, "forgetting_factor", None)
        self.parameters = values

    def _arguments(self) -> dict[str, Any]:
        if not self.about["forgetting_factor"]:
            return self.parameters
        return {"forgetting_factor": self.forgetting_factor, **self.parameters}


class Rate(Choice):
    """How much to forget."""


class Weighting(Choice):
    """How far to trust a sample."""


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
    required_first = sorted(parameters, key=lambda p: p.default is not inspect.Parameter.empty)
    return inspect.Signature(required_first)


def _make(base: type[Choice], about: Mapping[str, Any]) -> type[Choice]:
    """The class of a registry entry."""
    body = {
        "about": about,
        "name": about["name"],
        "__doc__": about["header"],
        "__module__": __name__,
        "__signature__": _signature(about),
    }
    return type(about["type_name"], (base,), body)


RULES: dict[str, type[Rule]] = {a["name"]: _make(Rule, a) for a in _core.rules()}  # type: ignore[misc]
RATES: dict[str, type[Rate]] = {a["name"]: _make(Rate, a) for a in _core.rates()}  # type: ignore[misc]
WEIGHTINGS: dict[str, type[Weighting]] = {
    a["name"]: _make(Weighting, a)  # type: ignore[misc]
    for a in _core.weightings()
}
CLASSES: dict[str, type[Choice]] = {
    kind.__name__: kind
    for registry in (RULES, RATES, WEIGHTINGS)
    for kind in registry.values()  # type: ignore[attr-defined]
}
globals().update(CLASSES)


def _named(what: str, registry: Mapping[str, type[Any]], name: str) -> type[Any]:
    if name not in registry:
        raise _core.InvalidInput(f"{what} = {name!r}, allowed: {', '.join(registry)}")
    return registry[name]


def rule(name: str, **parameters: Any) -> Rule:
    """Make the rule of this registry name.

    Parameters
    ----------
    name : str
        Registry name, one of ``[r["name"] for r in forgetting.rules()]``.
    **parameters
        The forgetting factor, if the rule uses one, and the rule's own parameters.

    Raises
    ------
    InvalidInput
        For a name that is not in the registry, or a parameter that the rule does not have.

    Examples
    --------
    >>> import forgetting as fg
    >>> fg.rule("subspace", forgetting_factor=0.98, threshold=1e-3)
    Subspace(forgetting_factor=0.98, threshold=0.001)
    """
    kind: type[Rule] = _named("rule", RULES, name)
    try:
        return kind(**parameters)
    except TypeError as error:
        known = ", ".join(inspect.signature(kind).parameters) or "none"
        raise _core.InvalidInput(f"rule {name}: {error}; its parameters: {known}") from None


def from_description(description: Mapping[str, Any]) -> Rule:
    """The rule that `RLS.describe` describes."""
    return _described(description["rule"], description["rate"])


def _described(described: Mapping[str, Any], rate: Mapping[str, Any]) -> Rule:
    """The rule of this name and these parameters, which uses the rate where it has one."""
    made = RULES[described["name"]]
    values = dict(described["parameters"])
    for entry in made.about["parameters"]:
        if entry["kind"] == "rule":
            values[entry["name"]] = _described(values[entry["name"]], rate)
    if made.about["forgetting_factor"]:
        if rate["name"] == "constant":
            values["forgetting_factor"] = rate["parameters"]["forgetting_factor"]
        else:
            values["forgetting_factor"] = RATES[rate["name"]](**rate["parameters"])
    return made(**values)
