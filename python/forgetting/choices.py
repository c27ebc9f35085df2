"""Rules, rates, weightings and gates as Python objects, made from the registries of the Rust core.

Every entry of a registry becomes a class here, under the name of its Rust type: its constructor
takes the entry's parameters, checks their names, and leaves their values to the core to check.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from numbers import Real
from typing import Any, ClassVar, TypeAlias, TypeVar

import numpy as np

from . import _core

ForgettingFactor: TypeAlias = "float | Rate | str | Callable[[_core.Evidence], float]"


class Choice:
    """A name of a registry and the values of its parameters."""

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    parameters: dict[str, Any]

    def __init__(self, *arguments: Any, **named: Any) -> None:
        bound = inspect.signature(type(self)).bind(*arguments, **named)
        bound.apply_defaults()
        values = dict(bound.arguments)
        for entry in self.about["parameters"]:
            values[entry["name"]] = _plain(values[entry["name"]], entry["kind"])
        self._take(values)

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


def _plain(value: Any, kind: str) -> Any:
    """The value as Python's own numbers and lists, so that choices print and compare alike.

    A value that does not fit is left for the core to refuse.
    """
    if kind in ("matrix", "list") and value is not None and not isinstance(value, str):
        try:
            return np.asarray(value, dtype=float).tolist()
        except (TypeError, ValueError):
            return value
    if isinstance(value, Real) and not isinstance(value, bool):
        number = float(value)
        return int(number) if kind == "whole" and number.is_integer() else number
    return value


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
        if "factors" in values and not isinstance(
            self.forgetting_factor, int | float | Rate | None
        ):
            # a list in the place of the common factor: one for each block
            values["factors"], self.forgetting_factor = self.forgetting_factor, None
        for entry in self.about["parameters"]:
            if entry["kind"] == "rule":
                inner = values[entry["name"]]
                if isinstance(inner, str):
                    inner = values[entry["name"]] = rule(inner)
                self.forgetting_factor = getattr(inner, "forgetting_factor", None)
        self.forgetting_factor = _as_rate(self.forgetting_factor)
        self.parameters = values

    def _arguments(self) -> dict[str, Any]:
        if not self.about["forgetting_factor"] or self.forgetting_factor is None:
            return self.parameters
        return {"forgetting_factor": self.forgetting_factor, **self.parameters}


class Rate(Choice):
    """How much to forget: what a rule takes in place of a forgetting factor."""


class Weighting(Choice):
    """How far to trust a sample."""


class Gate(Choice):
    """Whether a sample is used."""


def _as_rate(given: Any) -> Any:
    """A number, or a rate made from what else may stand for a forgetting factor."""
    if isinstance(given, str):
        return rate(given)
    if isinstance(given, type):
        raise _core.InvalidInput(
            f"forgetting_factor = {given.__name__}, allowed: a rate, {given.__name__}(...)"
        )
    if callable(given):
        return rate("function", function=given)
    if isinstance(given, Rate) and given.name == "constant":
        return given.parameters["forgetting_factor"]
    return _plain(given, "real")


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
        "__module__": __package__,
        "__signature__": _signature(about),
    }
    return type(about["type_name"], (base,), body)


RULES: dict[str, type[Rule]] = {a["name"]: _make(Rule, a) for a in _core.rules()}  # type: ignore[misc]
RATES: dict[str, type[Rate]] = {a["name"]: _make(Rate, a) for a in _core.rates()}  # type: ignore[misc]
WEIGHTINGS: dict[str, type[Weighting]] = {
    a["name"]: _make(Weighting, a)  # type: ignore[misc]
    for a in _core.weightings()
}
GATES: dict[str, type[Gate]] = {a["name"]: _make(Gate, a) for a in _core.gates()}  # type: ignore[misc]
CLASSES: dict[str, type[Choice]] = {
    kind.__name__: kind
    for registry in (RULES, RATES, WEIGHTINGS, GATES)
    for kind in registry.values()
}

AnyChoice = TypeVar("AnyChoice", bound=Choice)


def _named(
    what: str, registry: Mapping[str, type[AnyChoice]], name: str, parameters: dict[str, Any]
) -> AnyChoice:
    if name not in registry:
        raise _core.InvalidInput(f"{what} = {name!r}, allowed: {', '.join(registry)}")
    kind = registry[name]
    try:
        return kind(**parameters)
    except TypeError as error:
        known = ", ".join(inspect.signature(kind).parameters) or "none"
        raise _core.InvalidInput(f"{what} {name}: {error}; its parameters: {known}") from None


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
    return _named("rule", RULES, name, parameters)


def rate(name: str, **parameters: Any) -> Rate:
    """Make the rate of this registry name.

    Parameters
    ----------
    name : str
        Registry name, one of ``[r["name"] for r in forgetting.rates()]``.
    **parameters
        The rate's parameters.

    Raises
    ------
    InvalidInput
        For a name that is not in the registry, or a parameter that the rate does not have.

    Examples
    --------
    >>> import forgetting as fg
    >>> fg.rate("unity_zone", smallest=0.8)
    UnityZone(sensitivity=0.05, smallest=0.8, largest=1.0)
    """
    return _named("rate", RATES, name, parameters)


def weighting(name: str, **parameters: Any) -> Weighting:
    """Make the weighting of this registry name.

    Parameters
    ----------
    name : str
        Registry name, one of ``[w["name"] for w in forgetting.weightings()]``.
    **parameters
        The weighting's parameters.

    Raises
    ------
    InvalidInput
        For a name that is not in the registry, or a parameter that the weighting does not have.

    Examples
    --------
    >>> import forgetting as fg
    >>> fg.weighting("huber")
    Huber(threshold=1.345)
    """
    return _named("weighting", WEIGHTINGS, name, parameters)


def gate(name: str, **parameters: Any) -> Gate:
    """Make the gate of this registry name.

    Parameters
    ----------
    name : str
        Registry name, one of ``[g["name"] for g in forgetting.gates()]``.
    **parameters
        The gate's parameters.

    Raises
    ------
    InvalidInput
        For a name that is not in the registry, or a parameter that the gate does not have.

    Examples
    --------
    >>> import forgetting as fg
    >>> fg.gate("dead_zone", width=2)
    DeadZone(width=2.0, otherwise='hold')
    """
    return _named("gate", GATES, name, parameters)


def rule_from_description(description: Mapping[str, Any], dtype: str) -> Rule:
    """The rule that `RLS.describe` describes."""
    described = _rounded(description, dtype)
    return _described(described["rule"], described["rate"])


def weighting_from_description(description: Mapping[str, Any], dtype: str) -> Weighting:
    """The weighting that `RLS.describe` describes."""
    described = _rounded(description["weighting"], dtype)
    return weighting(described["name"], **described["parameters"])


def gate_from_description(description: Mapping[str, Any], dtype: str) -> Gate:
    """The gate that `RLS.describe` describes."""
    described = _rounded(description["gate"], dtype)
    return gate(described["name"], **described["parameters"])


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
    made = RULES[described["name"]]
    values = dict(described["parameters"])
    for entry in made.about["parameters"]:
        if entry["kind"] == "rule":
            values[entry["name"]] = _described(values[entry["name"]], rate_)
    if made.about["forgetting_factor"]:
        values["forgetting_factor"] = rate(rate_["name"], **rate_["parameters"])
    return made(**values)
