"""One file per rule, named like its registry line.

Every module has

* ``Dense(n, **parameters)``: the rule as Theorem 1 needs it (F_k, Gamma_k; ``step.Rule``);
* ``Published(theta, covariance, **parameters)``: the algorithm in its own printed variables, on
  whitened data: ``update(phi, y, factor)``, ``theta``, ``covariance``;
* ``cases(n)``: parameter sets to test, named as in the registry (without the forgetting factor);
* ``RATED``: whether the rule takes a forgetting factor.
"""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType

NAMES = sorted(m.name for m in pkgutil.iter_modules(__path__) if m.name not in ("criteria", "form"))


def load(name: str) -> ModuleType:
    """The module of one rule; ``KeyError`` when there is no reference for it."""
    if name not in NAMES:
        raise KeyError(f"no reference for rule {name!r}")
    return importlib.import_module(f"{__name__}.{name}")
