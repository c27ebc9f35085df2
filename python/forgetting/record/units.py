"""Units of outputs, regressors and parameters, where the record names those of its columns."""

from __future__ import annotations

import re
from collections.abc import Mapping

DELAYED = re.compile(r"^(?P<name>.+)\(k(-\d+)?\)$")
LAGGED = re.compile(r"^lag\((?P<name>[^,()]+)(,\s*\d+)?\)$")
CONSTANTS = ("Intercept", "offset", "1")


def regressor_unit(name: str, units: Mapping[str, str]) -> str | None:
    """Unit of a regressor by its name; "" for a constant, None where it is not known.

    Examples
    --------
    >>> units = {"V": "V", "I": "A"}
    >>> [regressor_unit(name, units) for name in ("I(k-1)", "lag(V)", "V:I", "offset", "log(I)")]
    ['A', 'V', 'V·A', '', None]
    """
    if name in units:
        return units[name]
    if name in CONSTANTS:
        return ""
    for pattern in (DELAYED, LAGGED):
        found = pattern.match(name)
        if found is not None:
            return units.get(found["name"].strip().strip("`"))
    factors = [units.get(factor.strip().strip("`")) for factor in name.split(":")]
    known = [unit for unit in factors if unit is not None]
    return "·".join(known) if len(known) == len(factors) else None


def parameter_unit(output: str, regressor: str, units: Mapping[str, str]) -> str | None:
    """Unit of a parameter: of the output by that of its regressor; None where one is not known.

    Examples
    --------
    >>> units = {"V": "mV", "I": "A"}
    >>> [parameter_unit("V", name, units) for name in ("I(k)", "V(k-1)", "offset", "T")]
    ['mV/A', '1', 'mV', None]
    """
    above, below = units.get(output), regressor_unit(regressor, units)
    if above is None or below is None:
        return None
    if not below:
        return above
    if above == below:
        return "1"
    return f"{above}/({below})" if re.search(r"[·*/ ]", below) else f"{above}/{below}"
