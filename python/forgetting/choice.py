"""What every rule, rate, weighting, gate and mixer is in Python: a name and its parameters."""

from __future__ import annotations

import copy
import inspect
from collections.abc import Mapping
from numbers import Real
from typing import Any, ClassVar

from . import _core


class Choice:
    """A name of a registry and the values of its parameters."""

    about: ClassVar[Mapping[str, Any]]
    name: ClassVar[str]
    parameters: dict[str, Any]

    def __init__(self, *arguments: Any, **named: Any) -> None:
        bound = inspect.signature(type(self)).bind(*arguments, **named)
        if {"forgetting_factor", "half_life"} <= bound.arguments.keys():
            raise _core.InvalidInput("forgetting_factor and half_life are given: allowed is one")
        bound.apply_defaults()
        values = dict(bound.arguments)
        for entry in self.about["parameters"]:
            values[entry["name"]] = plain(values[entry["name"]], entry["kind"])
        self._take(values)

    def _take(self, values: dict[str, Any]) -> None:
        self.parameters = values

    def arguments(self) -> dict[str, Any]:
        """What its constructor takes to make the same again."""
        return self.parameters

    def _all_arguments(self) -> dict[str, Any]:
        return dict(self.parameters)

    def get_params(self, deep: bool = True) -> dict[str, Any]:
        """The constructor's arguments by name, as scikit-learn asks for them.

        Those of an argument that is a choice itself follow with `deep`, as in
        ``forgetting_factor__memory``.

        Examples
        --------
        >>> import forgetting as fg
        >>> fg.Exponential(fg.Fortescue()).get_params()["forgetting_factor__memory"]
        100.0
        """
        shallow = self._all_arguments()
        nested = {
            f"{name}__{inner}": value
            for name, choice in shallow.items()
            if deep and isinstance(choice, Choice)
            for inner, value in choice.get_params().items()
        }
        return {**shallow, **nested}

    def set_params(self, **parameters: Any) -> Choice:
        """Set arguments by name, in place; names are those of `get_params`.

        Estimators that were made with this choice before keep it as it was.

        Raises
        ------
        InvalidInput
            For a name that does not exist; nothing is set.
        """
        values = self.get_params(deep=False)
        if "half_life" in parameters:  # in the place of the factor
            values.pop("forgetting_factor", None)
        nested: dict[str, dict[str, Any]] = {}
        for name, value in parameters.items():
            first, _, rest = name.partition("__")
            if first not in inspect.signature(type(self)).parameters:
                raise _core.InvalidInput(f"{self.name} has no parameter {name!r}{self._known()}")
            if rest:
                nested.setdefault(first, {})[rest] = value
            else:
                values[first] = value
        for name, inner in nested.items():
            values[name] = _with_params(name, values.get(name), inner)
        vars(self).update(vars(type(self)(**values)))
        return self

    def _known(self) -> str:
        return "; its parameters: " + (
            ", ".join(inspect.signature(type(self)).parameters) or "none"
        )

    def __sklearn_clone__(self) -> Choice:
        return copy.deepcopy(self)

    def __repr__(self) -> str:
        given = ", ".join(f"{name}={value!r}" for name, value in self.arguments().items())
        return f"{type(self).__name__}({given})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))


def _with_params(name: str, given: Any, parameters: dict[str, Any]) -> Choice:
    """A copy of the choice `given`, the argument `name` of another, with these parameters."""
    if not isinstance(given, Choice):
        first = next(iter(parameters))
        raise _core.InvalidInput(f"{name} is {given!r}, which has no parameter {first!r}")
    return copy.deepcopy(given).set_params(**parameters)


def plain(value: Any, kind: str) -> Any:
    """The value as Python's own numbers and lists, so that choices print and compare alike.

    A value that does not fit is left for the core to refuse.
    """
    if kind in ("matrix", "list") and value is not None and not isinstance(value, str):
        try:
            return _core.numbers(kind, value).tolist()
        except _core.InvalidInput:
            return value
    if isinstance(value, Real) and not isinstance(value, bool):
        number = float(value)
        return int(number) if kind == "whole" and number.is_integer() else number
    return value
