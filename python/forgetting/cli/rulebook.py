"""From option texts to a forgetting rule, a rate and a gate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import forgetting as fg
from forgetting.words.errors import RecordError
from forgetting.words.suggestion import suggestion


def make_rule(
    name: str,
    forgetting_factor: float | None,
    threshold: float | None,
    settings: list[str],
    rate: str | None = None,
) -> Any:
    """Make the rule `name` from its options; unknown parameters are refused by name."""
    allowed = parameter_names(name)
    parameters: dict[str, Any] = {}
    if rate is not None and forgetting_factor is not None:
        raise RecordError("say --forgetting-factor or --rate, not both")
    factor = forgetting_factor if rate is None else make_rate(rate)
    for key, value in (("forgetting_factor", factor), ("threshold", threshold)):
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
    rate: str | None = None,
) -> Any:
    """The rule; "auto" where nothing is said of it, `subspace` where only its parameters are."""
    said = forgetting_factor is not None or threshold is not None or settings or rate is not None
    if name is None and not said:
        return "auto"
    if name == "auto":
        if said:
            raise RecordError("the rule 'auto' has no parameters")
        return name
    return make_rule(name or "subspace", forgetting_factor, threshold, settings, rate)


def check_half_life(
    half_life: str | None, forgetting_factor: float | None, rate: str | None
) -> None:
    """Refuse a half-life beside what it takes the place of."""
    if half_life is not None and (forgetting_factor is not None or rate is not None):
        raise RecordError("--half-life goes without --forgetting-factor and --rate")


def make_gate(text: str | None) -> Any:
    """Make the gate of ``name:parameter=value,...``; None without a gate."""
    if text is None:
        return None
    name, values = with_parameters(text, "gate", fg.gates())
    return fg.gate(name, **values)


def make_rate(text: str) -> Any:
    """Make the rate of ``name:parameter=value,...``."""
    name, values = with_parameters(text, "rate", fg.rates())
    return fg.rate(name, **values)


def with_parameters(
    text: str, kind: str, registry: Sequence[Mapping[str, Any]]
) -> tuple[str, dict[str, Any]]:
    """Read ``name:parameter=value,...`` of an entry that needs no function of the user's."""
    name, _, settings = text.partition(":")
    known = {entry["name"]: entry["parameters"] for entry in registry}
    usable = [key for key, own in known.items() if all(p["kind"] != "function" for p in own)]
    if name not in usable:
        near = suggestion(usable, name, f"the {kind}s are")
        raise RecordError(f"there is no {kind} {name!r}{near}")
    pairs = [parse(setting, f"--{kind}") for setting in settings.split(",") if settings]
    allowed = [parameter["name"] for parameter in known[name]]
    for key, _ in pairs:
        if key not in allowed:
            has = f"it has {', '.join(allowed)}" if allowed else "it has none"
            raise RecordError(f"the {kind} {name!r} has no parameter {key!r}; {has}")
    return name, dict(pairs)


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
