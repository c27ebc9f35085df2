"""From option texts to a forgetting rule."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import forgetting as fg
from forgetting.record.columns import suggestion
from forgetting.record.errors import RecordError


def make_rule(
    name: str,
    forgetting_factor: float | None,
    threshold: float | None,
    settings: list[str],
) -> Any:
    """Make the rule `name` from its options; unknown parameters are refused by name."""
    allowed = parameter_names(name)
    parameters: dict[str, Any] = {}
    for key, value in (("forgetting_factor", forgetting_factor), ("threshold", threshold)):
        if value is not None:
            parameters[key] = value
    for setting in settings:
        key, value = parse(setting)
        if key in parameters:
            raise RecordError(f"{key} is given twice")
        parameters[key] = value
    for key in parameters:
        if key not in allowed:
            has = f"it has {', '.join(allowed)}" if allowed else "it has none"
            raise RecordError(f"the rule {name!r} has no parameter {key!r}; {has}")
    return fg.rule(name, **parameters)


def about(name: str) -> Mapping[str, Any]:
    """What the registry says of a rule."""
    known: dict[str, Mapping[str, Any]] = {each["name"]: each for each in fg.rules()}
    if name in known:
        return known[name]
    raise RecordError(f"there is no rule {name!r}{suggestion(list(known), name, 'the rules are')}")


def parameter_names(name: str) -> list[str]:
    """Parameters of a rule, the forgetting factor first when it has one."""
    entry = about(name)
    own = [parameter["name"] for parameter in entry["parameters"]]
    return ["forgetting_factor", *own] if entry["forgetting_factor"] else own


def parse(setting: str) -> tuple[str, Any]:
    """Read ``name=value``; a value may be a number, numbers with commas, or a word."""
    key, equals, text = setting.partition("=")
    if not equals or not key.strip() or not text.strip():
        raise RecordError(f"--set takes name=value, but got {setting!r}")
    return key.strip().replace("-", "_"), value_of(text.strip())


def value_of(text: str) -> Any:
    """Read a value."""
    if "," in text:
        return [value_of(part.strip()) for part in text.split(",")]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text.lower(), text)
