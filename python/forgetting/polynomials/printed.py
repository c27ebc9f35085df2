"""A model in letters: its equation and its polynomials, each coefficient with its ±."""

from __future__ import annotations

from typing import Any

import numpy as np

from forgetting.polynomials.structure import Block
from forgetting.words.rounding import brief, with_error

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def printed(model: Any) -> str:
    """The equation, the polynomials, the noise, and whether it is stable."""
    blocks = [block for block in model.structure.blocks() if len(block.lags)]
    rows = [f"{named(model, block)} = {polynomial(model, block)}" for block in blocks]
    if model.structure.offset:
        rows.append(f"offset = {number(model, model.structure.parameters - 1)}")
    noise, poles = model.noise_variance, model.poles().modulus.value
    facts = ["stable" if model.is_stable else f"unstable: a pole of modulus {brief(poles[0])}"]
    facts.append(f"sample time {brief(model.sample_time)}")
    if noise is not None:
        facts.append(f"noise variance {brief(noise)}")
    return "\n".join([equation(model), *(f"  {row}" for row in rows), f"  {', '.join(facts)}"])


def equation(model: Any) -> str:
    """The equation of the model, without the polynomials that are 1."""
    y, several = model.output_name, model.structure.inputs > 1
    left = f"A(q) {y}" if model.structure.na else y
    terms = []
    for i, name in enumerate(model.input_names):
        if not model.structure.nb[i]:
            continue
        mark = f"_{name}" if several else ""
        below = f"/F{mark}(q)" if model.structure.nf[i] else ""
        terms.append(f"B{mark}(q){below} {name}")
    above = "C(q)" if model.structure.nc else ("1" if model.structure.nd else "")
    below = "/D(q)" if model.structure.nd else ""
    terms.append(f"{above}{below} e".strip())
    return f"{left} = {' + '.join(terms)}" + (" + offset" if model.structure.offset else "")


def named(model: Any, block: Block) -> str:
    """A(q), or B_u1(q) where there are several inputs."""
    of_one = block.input is None or model.structure.inputs == 1
    return block.letter.upper() + ("" if of_one else f"_{model.input_names[block.input]}") + "(q)"


def polynomial(model: Any, block: Block) -> str:
    """The polynomial with its coefficients, as many digits as their errors leave."""
    made = "" if block.letter == "b" else "1"
    coefficients = model.structure.polynomial(model.theta, block)
    for place, lag in enumerate(block.lags, block.start):
        value = coefficients[lag]
        sign = "−" if value < 0 else "+"
        power = f" q{str(-lag).translate(SUPERSCRIPT)}" if lag else ""
        joint = f" {sign} " if made else ("−" if value < 0 else "")
        made += f"{joint}{number(model, place, abs(value))}{power}"
    return made


def number(model: Any, place: int, value: float | None = None) -> str:
    """A parameter with its ±, one standard error, where that is known."""
    value = float(model.theta[place]) if value is None else value
    error = float(model.standard_errors[place])
    if np.isnan(error):
        return brief(value, 5)
    shown, off = with_error(value, error)
    return f"{shown}(±{off})"
