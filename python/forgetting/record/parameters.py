"""The final values of an identification, as they are told."""

from __future__ import annotations

from typing import Any

from forgetting.words.rounding import with_error


def final(found: Any) -> list[tuple[str, str, float, float]]:
    """Output, regressor, final value and its standard error, output by output.

    Fixed values come last, with an error of 0. `found` is an `Identification`.
    """
    errors, outputs = found.final_standard_error, found.samples.outputs
    estimated = [
        (output, name, float(found.theta[-1, i, j]), float(errors[i, j]))
        for j, output in enumerate(outputs)
        for i, name in enumerate(found.samples.regressors)
    ]
    given = found.known.fixed.items()
    return estimated + [(outputs[0], name, value, 0.0) for name, value in given]


def table(found: Any) -> tuple[list[str], list[tuple[str, ...]]]:
    """`final` in words, a row each, and the names of the columns behind value and error.

    With several outputs a parameter is told with its own.
    """
    several = len(found.samples.outputs) > 1
    values = final(found)
    units = any(found.unit(output, name) for output, name, *_ in values)
    rows = [
        (
            f"{output}: {name}" if several else name,
            *with_error(value, error),
            *([found.unit(output, name) or ""] if units else []),
            *([found.known.words(name)] if found.known else []),
        )
        for output, name, value, error in values
    ]
    return ["unit"] * units + ["known before"] * bool(found.known), rows
