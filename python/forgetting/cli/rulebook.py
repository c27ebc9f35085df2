"""From option texts to a forgetting rule and a gate."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import forgetting as fg
from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion


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


def rule_or_auto(
    name: str | None,
    forgetting_factor: float | None,
    threshold: float | None,
    settings: list[str],
) -> Any:
    """The rule; "auto" where nothing is said of it, `subspace` where only its parameters are."""
    if name is None and forgetting_factor is None and threshold is None and not settings:
        return "auto"
    if name == "auto":
        if forgetting_factor is not None or threshold is not None or settings:
            raise RecordError("the rule 'auto' has no parameters")
        return name
    return make_rule(name or "subspace", forgetting_factor, threshold, settings)


def make_gate(text: str | None) -> Any:
    """Make the gate of ``name:parameter=value,...``; None without a gate."""
    if text is None:
        return None
    name, _, settings = text.partition(":")
    known = {entry["name"]: entry["parameters"] for entry in fg.gates()}
    usable = [key for key, own in known.items() if all(p["kind"] != "function" for p in own)]
    if name not in usable:
        raise RecordError(f"there is no gate {name!r}{suggestion(usable, name, 'the gates are')}")
    pairs = [parse(setting, "--gate") for setting in settings.split(",") if settings]
    allowed = [parameter["name"] for parameter in known[name]]
    for key, _ in pairs:
        if key not in allowed:
            has = f"it has {', '.join(allowed)}" if allowed else "it has none"
            raise RecordError(f"the gate {name!r} has no parameter {key!r}; {has}")
    return fg.gate(name, **dict(pairs))


def about(name: str) -> Mapping[str, Any]:
    """The registry's entry of a rule."""
    known: dict[str, Mapping[str, Any]] = {each["name"]: each for each in fg.rules()}
    if name in known:
        return known[name]
    raise RecordError(f"there is no rule {name!r}{suggestion(list(known), name, 'the rules are')}")


def parameter_names(name: str) -> list[str]:
    """Parameters of a rule, the forgetting factor first when it has one."""
    entry = about(name)
    own = [parameter["name"] for parameter in entry["parameters"]]
    return ["forgetting_factor", *own] if entry["forgetting_factor"] else own


def parse(setting: str, option: str = "--set") -> tuple[str, Any]:
    """Read ``name=value``; a value may be a number, numbers with commas, or a word."""
    key, equals, text = setting.partition("=")
    if not equals or not key.strip() or not text.strip():
        raise RecordError(f"{option} takes name=value, but got {setting!r}")
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
