"""One file per rate: ``Rate(**parameters)`` with ``factor(step)`` and ``after(step, covariance)``.

``factor`` returns the lambda_k that the rule uses at step k, clipped to [smallest, largest].
Rates whose published lambda is for the *next* sample return the stored value and adapt in
``after``. ``reference.rates.NAMES`` lists the files.
"""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType

NAMES = sorted(m.name for m in pkgutil.iter_modules(__path__) if m.name != "clip")


def load(name: str) -> ModuleType:
    """The module of one rate; ``KeyError`` when there is no reference for it."""
    if name not in NAMES:
        raise KeyError(f"no reference for rate {name!r}")
    return importlib.import_module(f"{__name__}.{name}")
